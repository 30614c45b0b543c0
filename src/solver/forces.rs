//! The forces of a step, in the order in which they act, and their work.

use super::constraints::StepTimes;
use super::elements::{PassOutcome, Sink};
use super::{Axis, Domain, Section, Solver, loads};
use crate::comm::Communicator;

impl Solver {
    /// Stress, viscosity and hourglass forces of all elements and the pressures on their faces, summed at the nodes
    /// in canonical order. What other ranks wait for is computed and sent first.
    pub(super) fn internal_forces(&mut self, comm: &mut dyn Communicator) {
        (self.pass.time, self.pass.time_step, self.pass.kick) = (self.time, self.time_step, self.kick);
        let mut found = PassOutcome::NOTHING;
        self.clock.start();
        found = found.and(self.border_elements());
        self.clock.stop(Section::Elements);
        self.loaded_faces();
        self.domain.exchange.start(comm);
        self.clock.stop(Section::Communication);
        found = found.and(self.interior_elements());
        self.clock.stop(Section::Elements);
        self.add_faces();
        self.clock.stop(Section::Assembly);
        self.domain.exchange.finish(comm, &mut self.domain.nodes.forces);
        self.domain.nodes.keep_rates();
        self.clock.stop(Section::Communication);
        self.local = found;
    }

    fn border_elements(&mut self) -> PassOutcome {
        let mut found = PassOutcome::NOTHING;
        let Domain { blocks, nodes, exchange, .. } = &mut self.domain;
        let mut slots = &mut exchange.slots[..];
        for block in blocks {
            let (own, rest) = slots.split_at_mut(block.border.force_count());
            found = found.and(block.run(&nodes.rows, &nodes.rates.means, Sink::Apart(own), &self.pass));
            block.border.forget_forces_of_gone(own);
            slots = rest;
        }
        found
    }

    fn interior_elements(&mut self) -> PassOutcome {
        let mut found = PassOutcome::NOTHING;
        let Domain { blocks, nodes, exchange, .. } = &mut self.domain;
        let mut slots = &exchange.slots[..];
        for block in blocks {
            let (border, rest) = slots.split_at(block.border.force_count());
            let sink = Sink::Nodes { forces: &mut nodes.forces, border };
            found = found.and(block.run(&nodes.rows, &nodes.rates.means, sink, &self.pass));
            slots = rest;
        }
        found
    }

    fn loaded_faces(&mut self) {
        let Domain { pressure_faces, nodes, exchange, .. } = &mut self.domain;
        let slots = exchange.slots[exchange.first_face..].chunks_exact_mut(4);
        for (face, slots) in pressure_faces.0.iter_mut().zip(slots) {
            face.evaluate(nodes, &self.functions, self.time);
            slots.copy_from_slice(&face.slots());
        }
    }

    fn add_faces(&mut self) {
        let Domain { pressure_faces, nodes, .. } = &mut self.domain;
        for face in &pressure_faces.0 {
            for (&node, force) in face.nodes.iter().zip(face.force) {
                for (sum, f) in nodes.forces[node as usize].0.iter_mut().zip(force) {
                    *sum += f;
                }
            }
        }
    }

    /// Forces from outside, from constraints, and from contact on what the constraints leave free.
    pub(super) fn external_forces(&mut self, comm: &mut dyn Communicator) {
        self.clock.start();
        let step = StepTimes { time: self.time, kick: self.kick, drift: self.time_step };
        let Domain { nodes, loads, contact, constraints, axis, rigid, ties, .. } = &mut self.domain;
        axis.iter_mut().for_each(Axis::begin);
        rigid.iter_mut().for_each(|rigid| rigid.tangents(nodes));
        loads.iter_mut().for_each(|load| load.apply(nodes, &self.functions, &step));
        self.clock.stop(Section::Assembly);
        if let Some(ties) = ties {
            ties.hand_on(nodes, comm);
        }
        if let Some(rigid) = rigid {
            rigid.predict(nodes, &self.functions, &step, comm);
        }
        for constraint in constraints.iter_mut() {
            constraint.apply(nodes, &self.functions, &step);
        }
        axis.iter_mut().for_each(|axis| axis.hold(nodes, &step));
        if let Some(ties) = ties {
            ties.follow(nodes, comm);
        }
        self.clock.stop(Section::Integration);
        if let Some(contact) = contact {
            contact.apply(nodes, constraints, rigid.as_ref(), &step, comm);
            if let Some(rigid) = rigid {
                rigid.push(nodes, contact.forces_of_nodes(), &self.functions, &step, comm);
            }
            if let Some(ties) = ties {
                // What is held stays so: reactions take up what is handed on to it.
                let held: Vec<f64> = constraints.iter().map(|c| nodes.forces[c.node as usize].0[c.axis]).collect();
                ties.push(nodes, contact.forces_of_nodes(), comm);
                for (c, before) in constraints.iter_mut().zip(held) {
                    let force = &mut nodes.forces[c.node as usize].0[c.axis];
                    c.reaction -= *force - before;
                    *force = before;
                }
            }
            axis.iter_mut().for_each(|axis| axis.hold(nodes, &step));
            if let Some(ties) = ties {
                ties.follow(nodes, comm);
            }
            self.clock.stop(Section::Contact);
        }
    }

    /// Books half the step's work of everything that acts from outside, with the velocities as they stand.
    /// These are those before the kick, or after it.
    pub(super) fn book_work(&mut self, after: bool) {
        self.clock.start();
        let half_step = 0.5 * self.kick;
        let Domain { nodes, loads, contact, constraints, axis, pressure_faces, rigid, .. } = &mut self.domain;
        rigid.iter_mut().for_each(|rigid| rigid.book(half_step, after));
        loads::all(pressure_faces, loads).for_each(|load| load.book(nodes, half_step));
        contact.iter_mut().for_each(|contact| contact.book(nodes, half_step));
        constraints.iter_mut().for_each(|constraint| constraint.book(nodes, half_step));
        axis.iter_mut().for_each(|axis| axis.book(nodes, half_step));
        self.clock.stop(Section::Integration);
    }
}
