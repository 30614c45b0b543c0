//! Rigid bodies: blocks that move as one, with six unknowns and no work of elements.
//!
//! Nodes follow their body. Between elements and contact they are nodes like any others: before forces are asked for, their
//! rows hold the velocities of the body at the present state, and afterwards the forces that give them those after the
//! kick, so that energies, momenta, accelerations and contact need no second account. Works are booked with these
//! velocities, and so the balance of a body is closed exactly; elements that share nodes with it see the straight paths of
//! the step, as they do of all nodes.
//!
//! Nodes on which no force can act, inside a body, are brought up to date only where somebody looks.

mod body;
mod hold;
mod shape;
mod turn;

pub use body::{Compliance, RigidBody, Six, Turning, applied, product};
pub use hold::Hold;
pub use shape::{BodyShape, bodies_of_blocks, shapes};

use super::Body;
use super::constraints::StepTimes;
use super::domain::ABSENT;
use super::loads;
use super::nodes::Nodes;
use crate::comm::{Communicator, ExactSum};
use crate::common::vector::{add, cross, scaled, subtract};
use crate::mesh::Mesh;
use crate::model::{Function, Gravity, Model, Unknown};
use crate::restart::Archive;
use std::ops::Range;

/// All rigid bodies, and this rank's nodes of them.
pub struct RigidBodies {
    /// The bodies, in the order of the deck.
    pub bodies: Vec<RigidBody>,
    /// Nodes on which forces can act.
    near: Vec<Follower>,
    /// All others.
    deep: Vec<Follower>,
    /// Rotations of nodes that can turn.
    turning: Vec<Follower>,
    /// Body of each local node, or [`ABSENT`].
    of_node: Vec<u32>,
    gravities: Vec<Gravity>,
    moments: Vec<BodyMoment>,
    /// Whether the present state has its forces.
    prepared: bool,
    /// Whether the nodes inside have been brought up to date, so that they have forces.
    refreshed: bool,
    kick: f64,
}

/// A local node that follows a body.
#[derive(Debug, Clone, Copy)]
struct Follower {
    node: u32,
    body: u32,
    /// Where it is from the centre at the start.
    arm: [f64; 3],
}

/// PRESCRIBED MOMENT on nodes of a body that have no rotation of their own.
#[derive(Debug, Clone, Copy)]
struct BodyMoment {
    body: u32,
    axis: usize,
    function: usize,
    /// Factor on the function, times the number of nodes.
    scale: f64,
}

impl RigidBodies {
    /// Those of a model, with what of them is here; `None` without any. `local` gives the local node of a node of the mesh.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, local: &[u32], nodes: &Nodes) -> Option<RigidBodies> {
        if body.rigid.is_empty() {
            return None;
        }
        let (mut near, mut deep, mut turning) = (Vec::new(), Vec::new(), Vec::new());
        let mut of_node = vec![ABSENT; nodes.len()];
        let mut bodies = Vec::new();
        for (number, shape) in (0..).zip(&body.rigid) {
            for (&file, &is_near) in shape.nodes.iter().zip(&shape.near) {
                let arm = subtract(body.positions[file as usize], shape.centre);
                let here = local[file as usize];
                if here != ABSENT {
                    of_node[here as usize] = number;
                    let list = if is_near { &mut near } else { &mut deep };
                    list.push(Follower { node: here, body: number, arm });
                }
                let rotation = body.rotations.of(file).map(|rotation| local[rotation as usize]);
                if let Some(node) = rotation.filter(|node| *node != ABSENT) {
                    turning.push(Follower { node, body: number, arm });
                }
            }
            let holds = hold::holds(mesh, model, (&shape.nodes, shape.centre), &body.positions);
            bodies.push(RigidBody::new(shape.clone(), holds));
        }
        near.sort_by_key(|follower| follower.node);
        deep.sort_by_key(|follower| follower.node);
        let gravities = model.gravities.clone();
        Some(RigidBodies {
            bodies,
            near,
            deep,
            turning,
            of_node,
            gravities,
            moments: moments(mesh, model, body),
            prepared: false,
            refreshed: false,
            kick: 0.0,
        })
    }

    /// Nodes on which no force can act, in ranges, ascending.
    pub fn inside(&self) -> Vec<Range<usize>> {
        let mut ranges: Vec<Range<usize>> = Vec::new();
        for node in self.deep.iter().map(|follower| follower.node as usize) {
            match ranges.last_mut().filter(|range| range.end == node) {
                Some(range) => range.end += 1,
                None => ranges.push(node..node + 1),
            }
        }
        ranges
    }

    /// Body of a local node.
    pub fn of_node(&self, node: u32) -> Option<u32> {
        self.of_node.get(node as usize).copied().filter(|body| *body != ABSENT)
    }

    /// Takes momentum and angular momentum from the initial velocities of the nodes, which then move as their bodies do.
    /// All ranks call it.
    pub fn set_off(&mut self, nodes: &mut Nodes, comm: &mut dyn Communicator) {
        let mut sums = self.sums();
        for follower in self.near.iter().chain(&self.deep).filter(|f| nodes.owned[f.node as usize]) {
            let momentum = scaled(nodes.velocity(follower.node), nodes.mass(follower.node));
            take(&mut sums, follower.body, momentum, follower.arm);
        }
        for follower in self.turning.iter().filter(|f| nodes.owned[f.node as usize]) {
            take_moment(&mut sums, follower.body, scaled(nodes.velocity(follower.node), nodes.mass(follower.node)));
        }
        ExactSum::merge_ranks(&mut sums, comm);
        for (body, sums) in self.bodies.iter_mut().zip(sums.chunks_exact(6)) {
            body.set_off(std::array::from_fn(|i| sums[i].value()));
        }
        self.tangents(nodes);
        for follower in &self.deep {
            let body = &self.bodies[follower.body as usize];
            let velocity = body.velocity_at(body.motion(false), body.arm(follower.arm));
            nodes.rows[follower.node as usize].0[4..7].copy_from_slice(&velocity);
        }
    }

    /// Begins a step: finds where the bodies stand.
    pub fn begin(&mut self) {
        self.bodies.iter_mut().for_each(RigidBody::begin);
        self.prepared = false;
    }

    fn sums(&self) -> Vec<ExactSum> {
        vec![ExactSum::new(); 6 * self.bodies.len()]
    }

    /// Longest step in which no body turns too far.
    pub fn longest_step(&self) -> f64 {
        self.fastest().map_or(f64::INFINITY, RigidBody::longest_step)
    }

    /// The body that turns fastest.
    pub fn fastest(&self) -> Option<&RigidBody> {
        self.bodies.iter().min_by(|a, b| a.longest_step().total_cmp(&b.longest_step()))
    }

    /// A body that is not where it is told to be, with what tells it: its motions contradict each other.
    pub fn astray(&self) -> Option<(&RigidBody, &Hold)> {
        self.bodies.iter().find_map(|body| Some((body, body.astray()?)))
    }

    /// Gives the nodes the velocities of their bodies at the present state; after the elements, before everything else.
    pub fn tangents(&mut self, nodes: &mut Nodes) {
        let motions: Vec<_> = self.bodies.iter().map(|body| body.motion(false)).collect();
        for follower in &self.near {
            let body = &self.bodies[follower.body as usize];
            let velocity = body.velocity_at(motions[follower.body as usize], body.arm(follower.arm));
            nodes.rows[follower.node as usize].0[4..7].copy_from_slice(&velocity);
        }
        for follower in &self.turning {
            nodes.rows[follower.node as usize].0[4..7].copy_from_slice(&motions[follower.body as usize][1]);
        }
        self.prepared = false;
    }

    /// Sums the forces on the nodes, finds how the bodies go on without contact, and gives the nodes the forces of that. All ranks
    /// call it.
    pub fn predict(
        &mut self,
        nodes: &mut Nodes,
        functions: &[Function],
        step: &StepTimes,
        comm: &mut dyn Communicator,
    ) {
        let mut sums = self.sums();
        for follower in self.near.iter().filter(|f| nodes.owned[f.node as usize]) {
            let force = nodes.force(follower.node);
            if force != [0.0; 3] {
                take(&mut sums, follower.body, force, self.bodies[follower.body as usize].arm(follower.arm));
            }
        }
        for follower in self.turning.iter().filter(|f| nodes.owned[f.node as usize]) {
            take_moment(&mut sums, follower.body, nodes.force(follower.node));
        }
        ExactSum::merge_ranks(&mut sums, comm);
        let gravity = loads::gravity_now(&self.gravities, functions, step.time);
        self.bodies.iter_mut().for_each(|body| (body.gravity, body.moment) = (gravity, [0.0; 3]));
        for moment in &self.moments {
            let now = moment.scale * functions[moment.function].value(step.time);
            self.bodies[moment.body as usize].moment[moment.axis] += now;
        }
        for (body, sums) in self.bodies.iter_mut().zip(sums.chunks_exact(6)) {
            body.load(&std::array::from_fn(|i| sums[i].value()), functions, step);
        }
        (self.prepared, self.kick) = (true, step.kick);
        self.follow(nodes);
    }

    /// The same with the forces of contact: local nodes that this rank answers for, and the force on each. All ranks call it.
    pub fn push(
        &mut self,
        nodes: &mut Nodes,
        forces: impl Iterator<Item = (u32, [f64; 3])>,
        functions: &[Function],
        step: &StepTimes,
        comm: &mut dyn Communicator,
    ) {
        let mut sums = self.sums();
        for (node, force) in forces {
            if let Some(body) = self.of_node(node) {
                let arm = subtract(nodes.position(node), self.bodies[body as usize].centre);
                take(&mut sums, body, force, arm);
            }
        }
        ExactSum::merge_ranks(&mut sums, comm);
        for (body, sums) in self.bodies.iter_mut().zip(sums.chunks_exact(6)) {
            body.push(std::array::from_fn(|i| sums[i].value()), functions, step);
        }
        self.follow(nodes);
    }

    /// Gives the nodes the forces that let them go with their bodies.
    fn follow(&self, nodes: &mut Nodes) {
        let changes: Vec<_> = self.bodies.iter().map(change).collect();
        for follower in &self.near {
            let arm = self.bodies[follower.body as usize].arm(follower.arm);
            let [velocity, spin] = changes[follower.body as usize];
            let mass = nodes.mass(follower.node) / self.kick;
            let force = scaled(add(velocity, cross(spin, arm)), mass);
            nodes.forces[follower.node as usize].0[..3].copy_from_slice(&force);
        }
        for follower in &self.turning {
            let inertia = nodes.mass(follower.node) / self.kick;
            let moment = scaled(changes[follower.body as usize][1], inertia);
            nodes.forces[follower.node as usize].0[..3].copy_from_slice(&moment);
        }
    }

    /// Books half the step's work of what drives bodies, of their weight and of moments on them, before or after the kick.
    pub fn book(&mut self, half_step: f64, after: bool) {
        self.bodies.iter_mut().for_each(|body| body.book(half_step, after));
    }

    /// Takes the step: the nodes go where their bodies are, and have the velocities of straight paths.
    pub fn drift(&mut self, nodes: &mut Nodes, drift: f64) {
        let turns: Vec<_> = self.bodies.iter_mut().map(|body| body.drift(drift)).collect();
        let after: Vec<_> = self.bodies.iter().map(|body| turn::matrix(body.turn)).collect();
        for follower in &self.near {
            self.place(follower, nodes, &after, drift, &turns);
        }
        for follower in &self.turning {
            let row = &mut nodes.rows[follower.node as usize].0;
            // What integration has added is taken back.
            for i in 0..3 {
                let angle = hold::spin_of_chords(turns[follower.body as usize], i);
                row[i] += angle - drift * row[4 + i];
                row[4 + i] = angle / drift;
            }
        }
        if std::mem::take(&mut self.refreshed) {
            self.deep.iter().for_each(|follower| nodes.forces[follower.node as usize] = Default::default());
        }
        self.prepared = false;
    }

    fn place(
        &self,
        follower: &Follower,
        nodes: &mut Nodes,
        after: &[shape::Matrix],
        drift: f64,
        turns: &[turn::Quaternion],
    ) {
        let number = follower.body as usize;
        let body = &self.bodies[number];
        // The frame is still that before the step.
        let velocity = body.chord(body.arm(follower.arm), turns[number], drift);
        let position = add(body.centre, turn::times(&after[number], follower.arm));
        let row = &mut nodes.rows[follower.node as usize].0;
        row[..3].copy_from_slice(&position);
        row[4..7].copy_from_slice(&velocity);
    }

    /// Brings the nodes inside the bodies up to the present, prepared state.
    pub fn refresh(&mut self, nodes: &mut Nodes) {
        self.refreshed = true;
        for follower in &self.deep {
            let body = &self.bodies[follower.body as usize];
            let arm = body.arm(follower.arm);
            let row = &mut nodes.rows[follower.node as usize].0;
            row[..3].copy_from_slice(&add(body.centre, arm));
            row[4..7].copy_from_slice(&body.velocity_at(body.motion(false), arm));
            let [velocity, spin] = if self.prepared { change(body) } else { [[0.0; 3]; 2] };
            let mass = if self.prepared { row[3] / self.kick } else { 0.0 };
            let force = scaled(add(velocity, cross(spin, arm)), mass);
            nodes.forces[follower.node as usize].0[..3].copy_from_slice(&force);
        }
    }

    /// Brings them to the state between two steps.
    fn refresh_between(&self, nodes: &mut Nodes) {
        let after: Vec<_> = self.bodies.iter().map(|body| turn::matrix(body.turn)).collect();
        let last: Option<Vec<_>> = self.bodies.iter().map(RigidBody::last).collect();
        let Some(last) = last else { return };
        let (turns, drifts): (Vec<_>, Vec<_>) = last.into_iter().unzip();
        for follower in &self.deep {
            self.place(follower, nodes, &after, drifts[follower.body as usize], &turns);
        }
    }

    /// Work of all that drives bodies, of their weight and of moments on them: the same on all ranks.
    pub fn works(&self) -> impl Iterator<Item = f64> + '_ {
        self.bodies.iter().flat_map(|body| body.holds.iter().map(|hold| hold.work).chain([body.load_work]))
    }

    /// Kinetic energy at the present state, `kicked` or the initial one, that is not in the nodes: the same on all ranks.
    pub fn surplus_energies(&self, kicked: bool) -> impl Iterator<Item = f64> + '_ {
        self.bodies.iter().map(move |body| body.surplus_energy(kicked))
    }

    /// What blocks, by their positions in the mesh, have from turning that is not in the nodes: the same on all ranks.
    pub fn surplus_of_blocks(&self, kicked: bool) -> impl Iterator<Item = (usize, Turning)> + '_ {
        self.bodies.iter().flat_map(move |body| body.surplus_of_blocks(kicked))
    }

    /// Forces that hold and drive bodies: node of the mesh, axis, force.
    pub fn reactions(&self) -> impl Iterator<Item = (u32, usize, f64)> + '_ {
        let holds = self.bodies.iter().flat_map(|body| &body.holds);
        holds.filter(|hold| hold.of == Unknown::Position).map(|hold| (hold.node, hold.axis, hold.reaction))
    }

    /// Forgets the forces of the present state.
    pub fn forget(&mut self) {
        self.prepared = false;
        self.bodies.iter_mut().flat_map(|body| &mut body.holds).for_each(|hold| hold.reaction = 0.0);
    }

    /// Visits the state between two steps; before that of the nodes.
    pub fn visit_state(&mut self, archive: &mut dyn Archive, nodes: &mut Nodes) {
        if !archive.loading() {
            self.refresh_between(nodes);
        }
        for (number, body) in self.bodies.iter_mut().enumerate() {
            let name = |what: &str| format!("RIGID{}.{what}", number + 1);
            for i in 0..3 {
                archive.number(&name(["X", "Y", "Z"][i]), &mut body.centre[i]);
                archive.number(&name(["VELX", "VELY", "VELZ"][i]), &mut body.velocity[i]);
                archive.number(&name(["ANGX", "ANGY", "ANGZ"][i]), &mut body.momentum[i]);
            }
            for i in 0..4 {
                archive.number(&name(["Q0", "Q1", "Q2", "Q3"][i]), &mut body.turn[i]);
            }
            archive.number(&name("WEIGHTW"), &mut body.load_work);
            visit_holds(archive, &name("HOLD"), body);
        }
    }
}

/// Numbers of a hold in files: node, axis, whether about it, whether it holds still, and what it carries.
const HOLD: usize = 9;

/// A deck may hold other nodes when a run is continued, where they are then; the work of those that are no more stays with the weight.
fn visit_holds(archive: &mut dyn Archive, name: &str, body: &mut RigidBody) {
    let key =
        |hold: &hold::Hold| [f64::from(hold.node), hold.axis as f64, f64::from(u8::from(hold.of == Unknown::Rotation))];
    let mut rows = Vec::new();
    if archive.comm().rank() == 0 && !archive.loading() {
        for hold in &body.holds {
            rows.extend(key(hold));
            rows.push(f64::from(u8::from(hold.motion.is_none())));
            rows.extend([hold.start, hold.speed, hold.turned, hold.work, hold.strayed]);
        }
    }
    archive.list(name, HOLD, &mut rows);
    if !archive.loading() {
        return;
    }
    let frame = turn::matrix(body.turn);
    let places: Vec<[f64; 3]> = body.holds.iter().map(|hold| add(body.centre, turn::times(&frame, hold.arm))).collect();
    for (hold, place) in body.holds.iter_mut().zip(places).filter(|(hold, _)| hold.motion.is_none()) {
        (hold.begins, hold.start) = (true, place[hold.axis]);
    }
    for row in rows.chunks_exact(HOLD) {
        match body.holds.iter_mut().find(|hold| key(hold)[..] == row[..3]) {
            Some(hold) => {
                if hold.motion.is_none() && row[3] != 0.0 {
                    (hold.begins, hold.start) = (false, row[4]);
                }
                [hold.speed, hold.turned, hold.work, hold.strayed] = [row[5], row[6], row[7], row[8]];
            }
            None => body.load_work += row[7],
        }
    }
}

/// What PRESCRIBED MOMENT asks for of nodes of bodies that have no rotation of their own.
fn moments(mesh: &Mesh, model: &Model, body: &Body) -> Vec<BodyMoment> {
    let mut moments = Vec::new();
    for load in model.prescribed_forces.iter().filter(|load| load.of == Unknown::Rotation) {
        for (number, shape) in (0..).zip(&body.rigid) {
            let nodes = shape.without_rotation(mesh, load.node_set, &body.rotations);
            let (axis, scale) = (load.direction.axis(), load.scale * nodes);
            moments.push(BodyMoment { body: number, axis, function: load.function, scale });
        }
    }
    moments.retain(|moment| moment.scale != 0.0);
    moments
}

/// Changes of velocity and angular velocity in the kick of the step.
fn change(body: &RigidBody) -> [[f64; 3]; 2] {
    let ([v, w], [u, s]) = (body.motion(true), body.motion(false));
    [subtract(v, u), subtract(w, s)]
}

/// Adds a force, or a momentum, and its moment to the sums of a body.
fn take(sums: &mut [ExactSum], body: u32, force: [f64; 3], arm: [f64; 3]) {
    (0..3).for_each(|i| sums[6 * body as usize + i].add(force[i]));
    take_moment(sums, body, cross(arm, force));
}

/// Adds a moment, or an angular momentum, to the sums of a body.
fn take_moment(sums: &mut [ExactSum], body: u32, moment: [f64; 3]) {
    (0..3).for_each(|i| sums[6 * body as usize + 3 + i].add(moment[i]));
}
