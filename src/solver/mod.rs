//! The explicit method: central differences with velocities at mid-step, a lumped mass and a step that changes.
//!
//! One step, from state n to state n + 1, is [`Solver::prepare`], which finds forces and the step size at state n,
//! then whatever wants to look at state n, then [`Solver::advance`]. The solver knows no deck words and no files.

mod body;
mod clock;
mod constraints;
pub mod contact;
mod domain;
pub mod elements;
mod erosion;
mod exchange;
mod frequency;
mod function;
mod health;
pub mod loads;
mod mass_scaling;
pub mod nodes;
mod remembered;
pub mod rigid;
mod rotations;
mod slivers;
mod state;
mod stop;
pub mod tied;
mod totals;
mod trial;

pub use body::{Body, Cut, NoMaterial, centroid};
pub use clock::{Clock, Section};
pub use domain::{Domain, state_names};
pub use health::{Evidence, Finding, Spot};
pub use mass_scaling::{AddedMass, BlockMass};
pub use remembered::Remembered;
pub use rigid::{BodyShape, RigidBodies};
pub use rotations::Rotations;
pub use slivers::Slivers;
pub use stop::{ElementPlace, Stop};
pub use tied::{Tied, TiedReport, Ties};
pub use totals::Totals;
pub use trial::BlockTrial;

use crate::comm::{Communicator, Traffic};
use crate::lanes::{Force, InstructionSet};
use crate::mesh::{Mesh, Shape};
use crate::model::{Function, Model, MotionKind, Precision, StepEstimate, TimeStepControl, Unknown};
use crate::partition::Share;
use constraints::StepTimes;
use elements::{PassOutcome, PassSettings, Sink, Steps};
use frequency::{GlobalStep, Votes};
use health::Watch;
use std::collections::BTreeSet;

/// Part of a step within which a time counts as reached.
const REACHED: f64 = 1e-6;

/// So many steps at the end are made alike, and shorter by a twentieth at most, so that the last one reaches the end.
const LAST_STEPS: f64 = 20.0;

/// Accounts below this part of the largest energy supplied so far are round-off: all has come to rest.
const AT_REST: f64 = 1e-6;

/// One rank's solver.
pub struct Solver {
    /// This rank's part of the problem.
    pub domain: Domain,
    /// Where the time went.
    pub clock: Clock,
    /// Number of steps taken.
    pub step: u64,
    /// Time of the present state.
    pub time: f64,
    /// Time of the state before; that of the first one is its own.
    pub previous_time: f64,
    /// Step that leads from the present state to the next, a time.
    pub time_step: f64,
    /// The same, had the end of the run not made it shorter.
    pub whole_step: f64,
    /// Largest stable step of the present state, a time.
    pub stable_step: f64,
    /// The largest that every element alone allows.
    pub own_step: f64,
    /// Kinetic energy at the start.
    pub initial_energy: f64,
    /// What histories compare the present state with.
    pub remembered: Remembered,
    /// What the first state says of the elements that set the step; `None` in a run that goes on from another.
    pub slivers: Option<Slivers>,
    /// Energies and momenta when they were last summed, and the step at which that was.
    last_totals: Option<(u64, Totals)>,
    kick: f64,
    first_stable_step: Option<f64>,
    /// The stable step of the mesh as a whole, where the deck asks for it.
    global_step: Option<GlobalStep>,
    /// What the run has found out about itself.
    watch: Watch,
    local: PassOutcome,
    control: TimeStepControl,
    /// Time that the last step shall reach, where there is one.
    end: Option<f64>,
    /// Whether steps have been made shorter for it.
    ending: bool,
    pass: PassSettings,
    functions: Vec<Function>,
    /// Velocities that are prescribed at the start: local node, axis and value, ascending.
    prescribed: Vec<(u32, usize, f64)>,
}

/// Something that all ranks agree on at every step; the largest request of any rank wins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Request {
    /// Go on.
    Continue,
    /// Write a last state and leave: a shutdown file was found.
    Shutdown,
    /// Write a last state and leave: SIGINT.
    Interrupt,
    /// Write a last state and leave: SIGTERM.
    Terminate,
}

impl Request {
    fn from_number(n: f64) -> Request {
        match n as u8 {
            0 => Request::Continue,
            1 => Request::Shutdown,
            2 => Request::Interrupt,
            _ => Request::Terminate,
        }
    }
}

/// Why blocks of a mesh cannot be computed as the model has them, each with the number of the block.
pub fn unfit_blocks(mesh: &Mesh, model: &Model) -> Vec<(i64, elements::Unfit)> {
    let unfit = |block: &crate::mesh::Block| Some((block.id, elements::Element::of_block(block, model).err()?));
    let all = mesh.blocks.iter().filter_map(unfit);
    all.chain(without_eight_points(mesh, model)).chain(beyond_single(mesh, model)).collect()
}

/// Blocks whose numbers single precision cannot hold.
fn beyond_single(mesh: &Mesh, model: &Model) -> Vec<(i64, elements::Unfit)> {
    let asked = |block: &&crate::mesh::Block| {
        let one_point = block.shape == Shape::Hexahedron && !elements::eight_points::asked_for(block.id, model);
        one_point && model.precision == Precision::Single
    };
    let unfit = |block: &crate::mesh::Block| {
        let material = model.materials.iter().find(|material| material.block == block.id)?;
        let body = (material.density, material.law.moduli());
        Some((block.id, elements::hexahedron::range::beyond(block, &mesh.coordinates, body)?))
    };
    mesh.blocks.iter().filter(asked).filter_map(unfit).collect()
}

/// Blocks that are to have eight points and whose elements have not eight corners.
fn without_eight_points(mesh: &Mesh, model: &Model) -> Vec<(i64, elements::Unfit)> {
    let asked = |block: &&crate::mesh::Block| elements::eight_points::asked_for(block.id, model);
    let others = mesh.blocks.iter().filter(|block| block.shape != Shape::Hexahedron).filter(asked);
    let unfit = |block: &crate::mesh::Block| {
        let [_, shapes] = block.shape.names();
        let reason = format!("ELEMENT, EIGHT POINTS is for hexahedra, and these are {shapes}");
        (block.id, elements::Unfit { reason, help: "take the line out".to_string() })
    };
    others.map(unfit).collect()
}

/// Node sets of whose rotations the model speaks though none of their nodes can turn, ascending.
pub fn idle_rotations(mesh: &Mesh, model: &Model) -> Vec<i64> {
    let turns = |block: &&crate::mesh::Block| {
        elements::Element::of_block(block, model).is_ok_and(|element| element.entry().rotations)
    };
    let turning: BTreeSet<u32> = mesh.blocks.iter().filter(turns).flat_map(|block| &block.nodes).copied().collect();
    // A rigid body turns with any of its nodes; a moment needs one of its own.
    let is_rigid = |block: &&crate::mesh::Block| model.rigid_bodies.iter().any(|body| body.contains(&block.id));
    let rigid: BTreeSet<u32> = mesh.blocks.iter().filter(is_rigid).flat_map(|block| &block.nodes).copied().collect();
    let loads =
        |set: i64| model.prescribed_forces.iter().any(|force| force.of == Unknown::Rotation && force.node_set == set);
    let can_turn = |set: i64, node: &u32| turning.contains(node) || (rigid.contains(node) && !loads(set));
    let idle = |set: &&i64| mesh.node_set(**set).is_some_and(|own| !own.nodes.iter().any(|node| can_turn(**set, node)));
    let held = model.no_displacements.iter().map(|held| (held.of, held.node_set));
    let driven = model.prescribed_motions.iter().map(|motion| (motion.of, motion.node_set));
    let loaded = model.prescribed_forces.iter().map(|force| (force.of, force.node_set));
    let all = held.chain(driven).chain(loaded).filter(|(of, _)| *of == Unknown::Rotation).map(|(_, set)| set);
    all.collect::<BTreeSet<i64>>().iter().filter(idle).copied().collect()
}

fn prescribed_at_start(domain: &Domain, functions: &[Function]) -> Vec<(u32, usize, f64)> {
    let start = |constraint: &constraints::Constraint| {
        let motion = constraint.motion.filter(|motion| motion.kind == MotionKind::Velocity)?;
        Some((constraint.node, constraint.axis, motion.scale * functions[motion.function].value(0.0)))
    };
    let mut all: Vec<_> = domain.constraints.iter().filter_map(start).collect();
    all.sort_by_key(|(node, axis, _)| (*node, *axis));
    all
}

impl Solver {
    /// One rank's share of the problem in its initial state.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, share: &Share, comm: &mut dyn Communicator) -> Solver {
        let mut domain = Domain::new(mesh, model, body, share, comm);
        let global_step = (model.step_estimate == StepEstimate::Global).then(|| GlobalStep::new(&mut domain));
        let initial_energy = totals::initial_kinetic_energy(&domain, comm);
        Solver {
            prescribed: prescribed_at_start(&domain, &model.functions),
            watch: Watch::new(mesh, model, body, share, initial_energy),
            domain,
            clock: Clock::default(),
            step: 0,
            time: 0.0,
            previous_time: 0.0,
            time_step: 0.0,
            whole_step: 0.0,
            stable_step: 0.0,
            own_step: 0.0,
            initial_energy,
            remembered: Remembered::default(),
            slivers: None,
            last_totals: None,
            kick: 0.0,
            first_stable_step: None,
            global_step,
            local: PassOutcome::NOTHING,
            control: model.time_step,
            end: None,
            ending: false,
            pass: PassSettings {
                time: 0.0,
                time_step: 0.0,
                kick: 0.0,
                bulk_viscosity: model.bulk_viscosity,
                moduli: model.time_step.moduli,
                instructions: InstructionSet::detect(),
            },
            functions: model.functions.clone(),
        }
    }

    /// Chooses the instruction set of the element kernels; results do not depend on it.
    pub fn use_instructions(&mut self, instructions: InstructionSet) {
        self.pass.instructions = instructions;
    }

    /// Lets the last steps be shorter, so that they reach this time. Without it, steps are as long as they can be.
    pub fn end_at(&mut self, time: f64) {
        self.end = Some(time);
    }

    /// Whether the present, prepared state is the one at the end.
    pub fn is_at_end(&self) -> bool {
        self.end.is_some_and(|end| end - self.time <= REACHED * self.whole_step)
    }

    /// Whether the step from the present, prepared state, or one before it, is shorter than it could be, so that the run ends
    /// where it shall.
    pub fn is_ending(&self) -> bool {
        self.ending
    }

    /// Whether the next step may be shorter than it could be: what is left is no more than so many of the largest that may
    /// follow.
    pub fn nears_end(&self) -> bool {
        let longest = if self.step == 0 { f64::INFINITY } else { self.control.growth * self.time_step };
        self.end.is_some_and(|end| end - self.time <= LAST_STEPS * longest)
    }

    /// How often what is left until the end would fit into the step that could be taken, where it is there to be reached.
    pub(in crate::solver) fn steps_too_long(&self) -> Option<f64> {
        self.end.map(|end| self.whole_step / (end - self.time)).filter(|ratio| *ratio > 0.0)
    }

    /// Finds the forces of the present state and the step to the next one; `request` is this rank's wish, the
    /// answer what all ranks agreed on. After an error the state can still be looked at, but not advanced.
    ///
    /// # Errors
    ///
    /// The state makes no sense any more: see [`Stop`].
    pub fn prepare(&mut self, request: Request, comm: &mut dyn Communicator) -> Result<Request, Stop> {
        comm.enter(Traffic::Erosion);
        self.erode(comm);
        self.domain.rigid.iter_mut().for_each(RigidBodies::begin);
        comm.enter(Traffic::Elements);
        // Where the mesh as a whole bounds the step, a few elements do not.
        let kept = (self.step == 0 && self.global_step.is_none()).then(|| self.keep_steps());
        self.internal_forces(comm);
        comm.enter(Traffic::Step);
        let agreed = match self.agree(request, comm) {
            Ok(agreed) => agreed,
            Err(stop) => {
                // The forces of a failed element are no numbers; the state is shown as it was reached, without them.
                self.domain.nodes.forces.fill(Force::default());
                self.domain.forget_reactions();
                comm.enter(Traffic::Output);
                return Err(self.post_mortem(stop, comm));
            }
        };
        self.external_forces(comm);
        // Until the next step, all that is said is for sums, log and files.
        comm.enter(Traffic::Output);
        if let Some(kept) = kept.filter(|_| self.own_step.is_finite()) {
            self.weigh_steps(&kept, comm);
        }
        if self.step == 0 {
            // The first state is the initial condition itself; its velocities stand at time zero, not half a step before.
            self.last_totals = Some((0, totals::totals(&mut self.domain, [0.0; 2], comm)));
        }
        self.book_work(false);
        self.glance(comm)?;
        Ok(agreed)
    }

    /// Takes the prepared step.
    pub fn advance(&mut self) {
        self.clock.start();
        self.domain.nodes.integrate(self.kick, self.time_step);
        self.clock.stop(Section::Integration);
        self.book_work(true);
        if let Some(rigid) = &mut self.domain.rigid {
            self.clock.start();
            rigid.drift(&mut self.domain.nodes, self.time_step);
            self.clock.stop(Section::Integration);
        }
        self.previous_time = self.time;
        self.time += self.time_step;
        if self.ending {
            // The end is met to the bit.
            let end = self.end.filter(|end| (end - self.time).abs() <= REACHED * self.whole_step);
            self.time = end.unwrap_or(self.time);
        }
        self.step += 1;
    }

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
                let mut totals = totals::totals(&mut self.domain, [self.kick, self.pass.time_step], comm);
                totals.least_scale = AT_REST * self.watch.supplied;
                self.last_totals = Some((self.step, totals));
                totals
            }
        }
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
    /// [`Solver::reactions`] and [`Contact::node_values`](contact::Contact::node_values). All ranks call it.
    pub fn complete_contact(&mut self, comm: &mut dyn Communicator) {
        self.refresh();
        if let Some(contact) = &mut self.domain.contact {
            contact.complete(comm);
        }
    }

    /// What HISTORY watches of contact, in the order of the deck; see [`Contact::resultants`](contact::Contact::resultants). All
    /// ranks call it.
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

    /// Stress, viscosity and hourglass forces of all elements and the pressures on their faces, summed at the nodes
    /// in canonical order. What other ranks wait for is computed and sent first.
    fn internal_forces(&mut self, comm: &mut dyn Communicator) {
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

    /// Takes failed elements away, and lets the surface grow inwards.
    fn erode(&mut self, comm: &mut dyn Communicator) {
        let Domain { erosion, blocks, nodes, element_canonical, contact, pressure_faces, loads, .. } = &mut self.domain;
        let Some(erosion) = erosion else { return };
        self.clock.start();
        let steps = Steps { time_step: self.time_step, kick: self.kick };
        if let Some(dead) = erosion.advance(blocks, element_canonical, nodes, self.time, steps, comm) {
            loads::all(pressure_faces, loads).for_each(|load| load.lose(&dead, false));
            self.global_step.iter_mut().for_each(GlobalStep::forget);
            if let Some(contact) = contact {
                comm.enter(Traffic::ContactSearch);
                contact.erode(&dead, erosion, nodes, comm);
            }
        }
        self.clock.stop(Section::Erosion);
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

    /// The step that all ranks take, the wish that all ranks follow, and whether any element has failed.
    fn agree(&mut self, request: Request, comm: &mut dyn Communicator) -> Result<Request, Stop> {
        let failed = self.local.failed.map_or(f64::INFINITY, |place| self.canonical(place));
        let mut votes = [self.local.stable_step, failed, -f64::from(request as u8), f64::INFINITY, 1.0];
        self.clock.start();
        let of_mesh = self.global_step.as_ref().map(|global| global.votes(&self.domain));
        let cast = match of_mesh {
            Some(Votes { rest, ratio }) => {
                (votes[3], votes[4]) = (rest, ratio);
                5
            }
            None => 3,
        };
        comm.all_min(&mut votes[..cast]);
        self.clock.stop(Section::Communication);
        let [stable_step, failed, wish, rest, ratio] = votes;
        (self.stable_step, self.own_step) = (stable_step, stable_step);
        if failed.is_finite() {
            let place = self.locate(failed, comm);
            // Positions may be sound while velocities are not; a volume that is not finite says nothing of inversion.
            let inverted = place.volume.is_finite() && place.centre.iter().all(|x| x.is_finite());
            return Err(if inverted { Stop::Inverted(place) } else { Stop::NotFinite(place) });
        }
        self.estimate(Votes { rest, ratio }, comm);
        let bodies = self.domain.rigid.as_ref().map_or(f64::INFINITY, RigidBodies::longest_step);
        self.stable_step *= self.domain.ties.as_ref().map_or(1.0, |ties| ties.step_part);
        self.stable_step = self.stable_step.min(bodies).min(self.control.longest / self.control.scale);
        self.check_step(comm)?;
        let last = self.time_step;
        let wanted = self.control.scale * self.stable_step;
        self.whole_step = if self.step == 0 { wanted } else { wanted.min(self.control.growth * self.whole_step) };
        let agreed = Request::from_number(-wish);
        // A run that is stopped before its end goes on with the step that it would have taken.
        self.time_step = if agreed == Request::Continue { self.up_to_the_end(last) } else { self.whole_step };
        self.ending |= self.time_step < self.whole_step;
        self.kick = 0.5 * (if self.step == 0 { 0.0 } else { last } + self.time_step);
        Ok(agreed)
    }

    /// The step that is taken after one of length `last`. The last ones share what is left: the error of the energy balance,
    /// prescribed displacements and contact all feel a step that suddenly is another.
    fn up_to_the_end(&self, last: f64) -> f64 {
        let Some(end) = self.end else { return self.whole_step };
        let left = end - self.time;
        match (left / self.whole_step - REACHED).ceil() {
            // Nothing follows; energies are those of steps that are alike.
            steps if steps < 1.0 => {
                if self.ending {
                    last
                } else {
                    self.whole_step
                }
            }
            steps if steps > LAST_STEPS => self.whole_step,
            // What whole steps bring within reach is of the run without an end, to the bit.
            steps => (left / steps).min(self.whole_step),
        }
    }

    /// Lets the mesh as a whole bound the step, where the deck asks for it.
    fn estimate(&mut self, mut votes: Votes, comm: &mut dyn Communicator) {
        let Some(global) = &mut self.global_step else { return };
        self.clock.start();
        let own = self.stable_step;
        if global.is_due(self.step, votes) {
            global.estimate(&mut self.domain, self.step, own, &self.pass, comm);
            votes.ratio = 1.0;
        }
        self.stable_step = global.step(own, votes);
        self.clock.stop(Section::Elements);
    }

    /// Forces from outside, from constraints, and from contact on what the constraints leave free.
    fn external_forces(&mut self, comm: &mut dyn Communicator) {
        self.clock.start();
        let step = StepTimes { time: self.time, kick: self.kick, drift: self.time_step };
        let Domain { nodes, loads, contact, constraints, rigid, ties, .. } = &mut self.domain;
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
                ties.follow(nodes, comm);
            }
            self.clock.stop(Section::Contact);
        }
    }

    /// Books half the step's work of everything that acts from outside, with the velocities as they stand.
    /// These are those before the kick, or after it.
    fn book_work(&mut self, after: bool) {
        self.clock.start();
        let half_step = 0.5 * self.kick;
        let Domain { nodes, loads, contact, constraints, pressure_faces, rigid, .. } = &mut self.domain;
        rigid.iter_mut().for_each(|rigid| rigid.book(half_step, after));
        loads::all(pressure_faces, loads).for_each(|load| load.book(nodes, half_step));
        contact.iter_mut().for_each(|contact| contact.book(nodes, half_step));
        constraints.iter_mut().for_each(|constraint| constraint.book(nodes, half_step));
        self.clock.stop(Section::Integration);
    }
}
