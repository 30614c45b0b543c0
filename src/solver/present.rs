//! What the present, prepared state says to whoever looks at it.

use super::{Axis, RigidBodies, Solver, Totals, nodes, totals};
use crate::comm::Communicator;

impl Solver {
    /// Brings what nobody asks for in a step up to the present, prepared state: nodes inside rigid bodies. Whoever looks at nodes
    /// one by one needs it.
    pub fn refresh(&mut self) {
        if let Some(rigid) = &mut self.domain.rigid {
            rigid.refresh(&mut self.domain.nodes);
        }
    }

    /// Energies and momenta of the present, prepared state.
    pub fn totals(&mut self, comm: &mut dyn Communicator) -> Totals {
        match self.last_totals {
            Some((step, totals)) if step == self.step => totals,
            _ => {
                self.refresh();
                let kick = [self.kick, self.longer()];
                let mut totals = totals::totals(&mut self.domain, kick, comm);
                totals.know(self.watch.supplied, self.watch.energy_floor());
                self.last_totals = Some((self.step, totals));
                totals
            }
        }
    }

    /// By how much the kick of the present, prepared state is longer than the step that led to it; none at the start, where no step has
    /// booked anything. See [`ElementBlock::add_energies`](super::elements::ElementBlock::add_energies).
    pub fn longer(&self) -> f64 {
        if self.step == 0 { 0.0 } else { self.kick - self.pass.time_step }
    }

    /// Velocity of a local node at the time of the present state: the mean of those half a step before and after.
    /// At the start it is the initial one, or that which is prescribed: the work of reaching it is done in the first step.
    pub fn velocity_now(&self, node: u32) -> [f64; 3] {
        let (mut v, a) = (self.domain.nodes.velocity(node), self.domain.nodes.acceleration(node));
        if self.step > 0 {
            return nodes::add(v, nodes::scaled(a, 0.5 * self.kick));
        }
        let first = self.prescribed.partition_point(|(other, ..)| *other < node);
        self.prescribed[first..]
            .iter()
            .take_while(|(other, ..)| *other == node)
            .for_each(|(_, i, value)| v[*i] = *value);
        v
    }

    /// Velocities of a local node half a step before and after the present state; both are the initial one at the start.
    pub fn velocities_around(&self, node: u32) -> [[f64; 3]; 2] {
        let (v, a) = (self.domain.nodes.velocity(node), self.domain.nodes.acceleration(node));
        let between = if self.step == 0 { 0.0 } else { self.kick };
        [v, nodes::add(v, nodes::scaled(a, between))]
    }

    /// Brings what contact has found beside its forces to the nodes, where it is computed elsewhere; before
    /// [`Solver::reactions`] and [`Contact::node_values`](super::contact::Contact::node_values). All ranks call it.
    pub fn complete_contact(&mut self, comm: &mut dyn Communicator) {
        self.refresh();
        if let Some(contact) = &mut self.domain.contact {
            contact.complete(comm);
        }
    }

    /// What HISTORY watches of contact, in the order of the deck; see
    /// [`Contact::resultants`](super::contact::Contact::resultants). All ranks call it.
    pub fn contact_resultants(&mut self, due: bool, comm: &mut dyn Communicator) -> Vec<[f64; 6]> {
        let time = self.time;
        self.domain.contact.as_mut().map(|contact| contact.resultants(time, due, comm)).unwrap_or_default()
    }

    /// Forces of constraints, prescribed motions and rigid surfaces now, one per local node.
    pub fn reactions(&self) -> Vec<[f64; 3]> {
        let mut reactions = vec![[0.0; 3]; self.domain.nodes.len()];
        for constraint in &self.domain.constraints {
            reactions[constraint.node as usize][constraint.axis] += constraint.reaction;
        }
        for (node, force) in self.domain.axis.iter().flat_map(Axis::reactions) {
            reactions[node as usize][0] += force;
        }
        for (file, axis, force) in self.domain.rigid.iter().flat_map(RigidBodies::reactions) {
            let here = self.domain.nodes.file[..self.domain.nodes.places].iter().position(|&node| node == file);
            here.into_iter().for_each(|node| reactions[node][axis] += force);
        }
        for (node, force) in self.domain.contact.iter().flat_map(|contact| contact.plane_forces()) {
            let sum = &mut reactions[node as usize];
            *sum = nodes::add(*sum, force);
        }
        reactions
    }
}
