//! Contact: a predictor finds where nodes would go, and forces take the overlaps out (Attaway et al. 1996).
//!
//! [`Contact::apply`] is steps 1.6 to 1.9 of the paper's figure 1: predict, locate, check in detail, enforce. All of it
//! works on [`points::Points`], the nodes of the surface in the order of the mesh. Every rank holds all of them and
//! comes to the same forces; nothing depends on the decomposition.

mod bounds;
mod cubic;
pub mod detect;
mod edges;
pub mod enforce;
mod face;
pub mod faces;
mod friction;
mod gather;
mod locate;
mod overlap;
mod planes;
pub mod points;
pub mod search;
mod setup;
pub mod surface;
mod work;

use super::body::Body;
use super::constraints::{Constraint as HeldDirection, StepTimes};
use super::erosion::Erosion;
use super::nodes::{Nodes, add, dot};
use crate::comm::Communicator;
use crate::mesh::Mesh;
use crate::model::{ContactSearch, Model, RigidSurface};
use detect::{Check, NONE, Past, TOUCHES, Touch, UNTOUCHED};
use edges::{Edge, EdgeCheck, PastPair};
use enforce::{Alone, Constraint, Enforcer, Limits, MEMBERS, Origin, Outcome};
use faces::Faces;
use gather::Gather;
use locate::{Locator, Near, Reach, Rule};
use planes::PlanePoint;
use points::Points;
use search::SearchKind;
use setup::{ABSENT, Layout, Pairings, Skin};

pub use overlap::{Overlap, remove as remove_overlap};
pub use work::Work;

/// Contact of one rank: surfaces, rigid planes, and the account of their forces.
pub struct Contact {
    /// The points.
    pub points: Points,
    layout: Layout,
    skin: Skin,
    pairings: Pairings,
    /// Local node of each point, or [`ABSENT`].
    here: Vec<u32>,
    /// For each axis of each local node, the constraint that holds it, or [`ABSENT`].
    held: Vec<[u32; 3]>,
    /// The same for each point.
    holder: Vec<[u32; 3]>,
    gather: Option<Gather>,
    locator: Locator,
    history: Vec<[Past; TOUCHES]>,
    edges: Vec<Edge>,
    edges_wanted: bool,
    edge_history: Vec<PastPair>,
    planes: Vec<RigidSurface>,
    /// Mean size of the faces: what overlaps with planes are small against.
    mean_size: f64,
    plane_points: Vec<PlanePoint>,
    constraints: Vec<Constraint>,
    enforcer: Enforcer,
    limits: Limits,
    /// Points with a force now, ascending.
    pushed: Vec<u32>,
    /// Work of the normal forces at each point so far.
    normal_work: Vec<f64>,
    /// Work of the friction forces at each point so far.
    friction_work: Vec<f64>,
    /// Normal and friction work at points that are gone, those of this rank.
    lost_work: Vec<[f64; 2]>,
    /// What the log tells.
    pub tally: Tally,
    near: Vec<Near>,
    near_faces: Vec<u32>,
    strict: Vec<bool>,
    touches: Vec<Touch>,
}

/// Contact in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Points of contact.
    pub points: usize,
    /// Faces that they may touch.
    pub faces: usize,
    /// Edges that stand out.
    pub edges: usize,
    /// Points that the last search found near faces.
    pub watched: usize,
    /// Pairs of these points and faces.
    pub pairs: usize,
    /// Searches so far.
    pub searches: u64,
    /// Enforcement.
    pub tally: Tally,
}

/// Counts for the log.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    /// Steps in which anything was enforced.
    pub steps: u64,
    /// Passes in all of them.
    pub passes: u64,
    /// Steps in which the passes ran out.
    pub capped: u64,
    /// Largest overlap that was left, as a part of the face's size.
    pub left: f64,
}

impl Contact {
    /// Contact as the model asks for it; `None` when it does not. `held[i]` says which constraint holds which
    /// direction of local node i; `local` gives the local node of a node of the mesh.
    pub fn new(
        mesh: &Mesh,
        model: &Model,
        body: &Body,
        nodes: &Nodes,
        held: Vec<[u32; 3]>,
        local: &[u32],
        comm: &mut dyn Communicator,
    ) -> Option<Contact> {
        if !model.contact.is_some() && model.rigid_surfaces.is_empty() {
            return None;
        }
        let watched: Vec<Vec<u32>> =
            model.rigid_surfaces.iter().map(|plane| mesh.side_set_nodes(plane.side_set)).collect();
        let skin = Skin::new(mesh, model, body, watched.concat());
        let layout = skin.layout();
        let here: Vec<u32> = layout.nodes.iter().map(|&node| local[node as usize]).collect();
        let count = here.len();
        let mut contact = Contact {
            points: Points::new(count),
            holder: here.iter().map(|&n| if n == ABSENT { [ABSENT; 3] } else { held[n as usize] }).collect(),
            gather: None,
            locator: Locator::new(kind(model.contact.control.search), reach(model, &layout)),
            history: vec![UNTOUCHED; count],
            edges: Vec::new(),
            edge_history: Vec::new(),
            planes: model.rigid_surfaces.clone(),
            mean_size: mean_size(&layout),
            plane_points: plane_points(&watched, model, body, &layout),
            constraints: Vec::new(),
            enforcer: Enforcer::new(count),
            limits: limits(model, &watched),
            pushed: Vec::new(),
            normal_work: vec![0.0; count],
            friction_work: vec![0.0; count],
            lost_work: Vec::new(),
            tally: Tally::default(),
            near: Vec::new(),
            near_faces: Vec::new(),
            strict: Vec::new(),
            touches: Vec::new(),
            pairings: Pairings::new(mesh, model, body),
            skin,
            layout,
            here,
            held,
            edges_wanted: model.contact.control.edges,
        };
        contact.meet(nodes, comm);
        if contact.layout.interfaces.is_empty() {
            // Planes alone need nobody else's nodes.
            contact.plane_points.retain(|watch| contact.here[watch.point as usize] != ABSENT);
        }
        Some(contact)
    }

    /// Gets to know the points of other ranks.
    fn meet(&mut self, nodes: &Nodes, comm: &mut dyn Communicator) {
        self.weigh(nodes);
        self.find_edges();
        if !self.layout.interfaces.is_empty() {
            self.gather = Gather::new(&self.here, nodes, comm);
            if let Some(gather) = &mut self.gather {
                gather.share_masses(&mut self.points, comm);
            }
        }
    }

    /// Lets the surface grow inwards after elements have gone: `dead` are their canonical numbers, ascending.
    pub fn erode(&mut self, dead: &[u32], erosion: &Erosion, nodes: &Nodes, comm: &mut dyn Communicator) {
        self.skin.delete(dead, &self.layout, |node| erosion.keeps(node));
        let old = std::mem::replace(&mut self.layout, self.skin.layout());
        let new = &self.layout;
        let count = new.nodes.len();
        let before: Vec<u32> = new.nodes.iter().map(|&node| old.point(node)).collect();
        let carry =
            |values: &[f64]| before.iter().map(|&p| if p == ABSENT { 0.0 } else { values[p as usize] }).collect();
        let here = |node: u32| erosion.local()[node as usize];
        for (p, &node) in old.nodes.iter().enumerate() {
            let local = self.here[p];
            if new.point(node) == ABSENT && local != ABSENT && nodes.owned[local as usize] {
                self.lost_work.push([self.normal_work[p], self.friction_work[p]]);
            }
        }
        self.normal_work = carry(&self.normal_work);
        self.friction_work = carry(&self.friction_work);
        let face = |past: Past| match past.face {
            NONE => past,
            face => Past { face: new.face(old.faces.number[face as usize]), ..past },
        };
        self.history = (before.iter())
            .map(|&p| if p == ABSENT { UNTOUCHED } else { tidy(self.history[p as usize].map(face)) })
            .collect();
        self.plane_points.iter_mut().for_each(|watch| watch.point = new.point(old.nodes[watch.point as usize]));
        self.here = new.nodes.iter().map(|&node| here(node)).collect();
        self.holder =
            self.here.iter().map(|&n| if n == ABSENT { [ABSENT; 3] } else { self.held[n as usize] }).collect();
        self.points = Points::new(count);
        self.enforcer = Enforcer::new(count);
        self.forget();
        self.locator.forget();
        let old_edges = std::mem::take(&mut self.edges);
        self.meet(nodes, comm);
        self.carry_edges(&old, &old_edges);
    }

    /// Gives the pairs of edges that touched before an erosion their new numbers.
    fn carry_edges(&mut self, old: &Layout, old_edges: &[Edge]) {
        let new = |edge: u32| {
            let ends = old_edges[edge as usize].ends.map(|point| self.layout.point(old.nodes[point as usize]));
            self.edges.binary_search_by(|edge| edge.ends.cmp(&ends)).ok().map(|edge| edge as u32)
        };
        let carried = self.edge_history.iter().filter_map(|past| {
            let (first, second) = (new(past.pair[0])?, new(past.pair[1])?);
            Some(PastPair { pair: [first, second], ..*past })
        });
        self.edge_history = carried.collect();
    }

    /// Inverse masses of the points that are here; none along directions that a constraint holds.
    fn weigh(&mut self, nodes: &Nodes) {
        for (point, &node) in self.here.iter().enumerate().filter(|(_, node)| **node != ABSENT) {
            let inverse = nodes.rows[node as usize].0[7];
            self.points.inverse_mass[point] =
                self.holder[point].map(|holder| if holder == ABSENT { inverse } else { 0.0 });
        }
    }

    /// Edges of the faces that CONTACT MATERIAL lets touch, as sharp as they are in the mesh.
    fn find_edges(&mut self) {
        self.edges.clear();
        if let Some(automatic) = self.layout.automatic().filter(|_| self.edges_wanted) {
            let positions = self.skin.positions(&self.layout.nodes);
            self.edges = edges::standing_out(&automatic.faces, &self.layout.faces, &positions);
        }
    }

    /// Finds the contact forces of the step and adds them to the nodes; along directions that are held, the
    /// constraint's reaction takes them up.
    pub fn apply(
        &mut self,
        nodes: &mut Nodes,
        held: &mut [HeldDirection],
        step: &StepTimes,
        comm: &mut dyn Communicator,
    ) {
        self.predict(nodes, step);
        if let Some(gather) = &mut self.gather {
            gather.share_motion(&mut self.points, step.drift, comm);
        }
        self.constraints.clear();
        if !self.layout.interfaces.is_empty() {
            if self.locator.locate(&self.points, &self.layout.faces, &self.layout.interfaces, &self.edges) {
                self.forget_strangers();
            }
            self.check();
            self.check_edges();
        }
        let always = !self.layout.interfaces.is_empty();
        for (number, watch) in self.plane_points.iter_mut().enumerate() {
            let number = number as u32;
            self.constraints.extend(watch.constraint(number, &self.planes, &self.points, self.mean_size, always));
        }
        self.enforce(step);
        self.hand_over(nodes, held);
    }

    /// Where the points would go without contact.
    fn predict(&mut self, nodes: &Nodes, step: &StepTimes) {
        for (point, &node) in self.here.iter().enumerate() {
            if node != ABSENT {
                let (row, force) = (&nodes.rows[node as usize].0, &nodes.forces[node as usize].0);
                let velocity = [0, 1, 2].map(|i| row[4 + i] + step.kick * (force[i] * row[7]));
                self.points.set(point, [row[0], row[1], row[2]], velocity, step.drift);
            }
        }
    }

    /// A point that has no candidates any more has no history either: whether it is looked at must not depend on when the
    /// search is made.
    fn forget_strangers(&mut self) {
        let mut watched = self.locator.watched().iter().peekable();
        for (point, past) in self.history.iter_mut().enumerate() {
            if watched.next_if(|&&next| next as usize == point).is_none() {
                *past = UNTOUCHED;
            }
        }
    }

    /// The detailed check of every point with candidates; what it touches becomes constraints and history.
    fn check(&mut self) {
        let Contact {
            points, layout, pairings, locator, history, constraints, near, near_faces, strict, touches, ..
        } = self;
        let check = Check { points, faces: &layout.faces };
        for i in 0..locator.watched().len() {
            let point = locator.watched()[i];
            let past = &mut history[point as usize];
            locator.near(i, points, &layout.faces, past, near);
            if near.is_empty() {
                *past = UNTOUCHED;
                continue;
            }
            near_faces.clear();
            near_faces.extend(near.iter().map(|near| near.face));
            strict.clear();
            strict.extend(near.iter().map(|near| layout.interfaces[near.interface as usize].rule == Rule::Blocks));
            check.point(point, near_faces, strict, past, touches);
            let before = std::mem::replace(past, UNTOUCHED);
            for (place, touch) in touches.iter().enumerate() {
                let interface = near.iter().find(|near| near.face == touch.face).map_or(0, |near| near.interface);
                if let Some(mut constraint) = constraint(layout, pairings, point, touch, interface) {
                    (constraint.push, constraint.drag) = push_before(&layout.faces, &before, touches, touch);
                    constraint.origin = Origin::Face(point, place as u32);
                    constraints.push(constraint);
                }
                past[place] = Past { face: touch.face, allowed: touch.allowed, ..UNTOUCHED[0] };
            }
        }
    }

    /// The check of every pair of edges that may cross.
    fn check_edges(&mut self) {
        let Contact { points, layout, pairings, locator, edges, edge_history, constraints, .. } = self;
        let check = EdgeCheck { points, faces: &layout.faces, edges };
        let block = |edge: u32| layout.faces.block[edges[edge as usize].faces[0] as usize];
        let before = std::mem::take(edge_history);
        for &pair in locator.edge_pairs() {
            let past = before.binary_search_by(|past| past.pair.cmp(&pair)).ok().map(|i| &before[i]);
            let mut pairing = pairings.of(Rule::Blocks, block(pair[0]), block(pair[1]));
            // Neither edge is the master.
            pairing.share = 0.5;
            if let Some((now, constraint)) = check.pair(pair, past, pairing) {
                edge_history.push(now);
                constraints.push(constraint);
            }
        }
    }

    fn enforce(&mut self, step: &StepTimes) {
        let Outcome { passes, left } =
            self.enforcer.solve(&mut self.constraints, &self.points, step, self.limits, &mut Alone);
        self.remember();
        self.tally.steps += u64::from(passes > 0);
        self.tally.passes += u64::from(passes);
        self.tally.capped += u64::from(left > self.limits.tolerance && self.limits.tolerance.is_finite());
        self.tally.left = self.tally.left.max(left);
    }

    /// Keeps the forces: the passes of the next step begin with them.
    fn remember(&mut self) {
        for c in &self.constraints {
            match c.origin {
                Origin::Face(point, place) => {
                    let past = &mut self.history[point as usize][place as usize];
                    (past.push, past.drag) = (c.push, c.drag);
                }
                Origin::Edges(first, second) => {
                    if let Ok(i) = self.edge_history.binary_search_by(|past| past.pair.cmp(&[first, second])) {
                        (self.edge_history[i].push, self.edge_history[i].drag) = (c.push, c.drag);
                    }
                }
                Origin::Plane(watch) => self.plane_points[watch as usize].remember(c.push, c.drag),
            }
        }
    }

    /// Adds the forces to the nodes that are here.
    fn hand_over(&mut self, nodes: &mut Nodes, held: &mut [HeldDirection]) {
        self.pushed.clear();
        let active = self.constraints.iter().filter(|constraint| constraint.push > 0.0);
        self.pushed.extend(active.flat_map(|c| c.parts().map(|(point, _)| point as u32)));
        self.pushed.sort_unstable();
        self.pushed.dedup();
        self.pushed.retain(|&point| self.here[point as usize] != ABSENT);
        for &point in &self.pushed {
            let p = point as usize;
            let force = add(self.enforcer.normal_force[p], self.enforcer.friction_force[p]);
            let sum = &mut nodes.forces[self.here[p] as usize].0;
            for i in 0..3 {
                match self.holder[p][i] {
                    ABSENT => sum[i] += force[i],
                    holder => held[holder as usize].reaction -= force[i],
                }
            }
        }
    }

    /// Books half the step's work with the present velocities.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        for &point in &self.pushed {
            let p = point as usize;
            let v = nodes.velocity(self.here[p]);
            self.normal_work[p] += half_step * dot(self.enforcer.normal_force[p], v);
            self.friction_work[p] += half_step * dot(self.enforcer.friction_force[p], v);
        }
    }

    /// Work of normal and of friction forces so far, at every point that this rank owns, and of points now gone.
    pub fn works<'a>(&'a self, nodes: &'a Nodes) -> impl Iterator<Item = [f64; 2]> + 'a {
        let owned = |node: u32| node != ABSENT && nodes.owned[node as usize];
        let works = self.normal_work.iter().zip(&self.friction_work);
        let here = self.here.iter().zip(works).filter(move |(node, _)| owned(**node)).map(|(_, (&n, &f))| [n, f]);
        here.chain(self.lost_work.iter().copied())
    }

    /// Forces of rigid planes at local nodes.
    pub fn plane_forces(&self) -> impl Iterator<Item = (u32, [f64; 3])> + '_ {
        let planes = self.constraints.iter().filter(|constraint| constraint.count == 1 && constraint.push > 0.0);
        planes.filter_map(|c| {
            let node = self.here[c.members[0] as usize];
            (node != ABSENT).then(|| (node, [0, 1, 2].map(|i| c.push * c.normal[i] + c.drag[i])))
        })
    }

    /// At each local node on the surface: contact force, overlap that contact closes in the coming step, status (0 free,
    /// 1 pushed, 2 pushed by its own contact with a face), and the place in the mesh file, from 1, of the element whose face it meets.
    pub fn node_values(&self) -> Vec<(u32, [f64; 6])> {
        let mut values = vec![[0.0; 6]; self.points.len()];
        for &point in &self.pushed {
            let p = point as usize;
            let [x, y, z] = add(self.enforcer.normal_force[p], self.enforcer.friction_force[p]);
            values[p] = [x, y, z, 0.0, 1.0, 0.0];
        }
        for c in self.constraints.iter().filter(|c| c.push > 0.0) {
            let of_point = &mut values[c.members[0] as usize];
            of_point[3] = of_point[3].min(c.gap);
            let past = self.history[c.members[0] as usize][0];
            if c.count == MEMBERS && past.face != NONE {
                of_point[4] = 2.0;
                of_point[5] = self.skin.file_number(self.layout.faces.number[past.face as usize]);
            }
        }
        self.here
            .iter()
            .zip(values)
            .filter(|(node, _)| **node != ABSENT)
            .map(|(&node, values)| (node, values))
            .collect()
    }

    /// Forgets the forces of this step.
    pub fn forget(&mut self) {
        self.pushed.clear();
        self.constraints.clear();
    }

    /// What the log tells at the end; nothing of planes alone, of which each rank knows its own only.
    pub fn report(&self) -> Option<Report> {
        let [watched, pairs] = self.locator.counts();
        (!self.layout.interfaces.is_empty()).then_some(Report {
            points: self.points.len(),
            faces: self.layout.faces.len(),
            edges: self.edges.len(),
            watched,
            pairs,
            searches: self.locator.searches,
            tally: self.tally,
        })
    }
}

/// The force of the last step at a touch. A point that has slid on to the next face takes the force along.
fn push_before(faces: &Faces, before: &[Past; TOUCHES], touches: &[Touch], touch: &Touch) -> (f64, [f64; 3]) {
    let same = before.iter().find(|past| past.face == touch.face);
    let left = |past: &&Past| past.face != NONE && touches.iter().all(|touch| touch.face != past.face);
    let beside = || before.iter().filter(left).find(|past| faces.touch(past.face, touch.face));
    same.or_else(beside).map_or((0.0, [0.0; 3]), |past| (past.push, past.drag))
}

/// Pasts with the faces that are left first.
fn tidy(mut pasts: [Past; TOUCHES]) -> [Past; TOUCHES] {
    pasts.sort_by_key(|past| past.face == NONE);
    pasts
}

fn kind(search: ContactSearch) -> SearchKind {
    match search {
        ContactSearch::PointInBox => SearchKind::PointInBox,
        ContactSearch::Grid => SearchKind::Grid,
        ContactSearch::Tree => SearchKind::Bvh,
    }
}

/// Mean size of the faces, 1 where there are none.
fn mean_size(layout: &Layout) -> f64 {
    let sizes = &layout.faces.size;
    if sizes.is_empty() { 1.0 } else { sizes.iter().sum::<f64>() / sizes.len() as f64 }
}

fn reach(model: &Model, layout: &Layout) -> Reach {
    let control = &model.contact.control;
    let mean = mean_size(layout);
    // A reach of one step at least: the search must hold for the step it is made for.
    let least = if control.reach > 0.0 { control.margin * mean } else { 0.0 };
    Reach { steps: control.reach.max(1.0), least, depth: detect::KEEP }
}

/// How far the passes go. All ranks must make the same number of them. With surfaces every rank sees all constraints and
/// stops at the same pass; planes alone are each rank's own, and get as many passes as they can need.
fn limits(model: &Model, watched: &[Vec<u32>]) -> Limits {
    let control = &model.contact.control;
    if model.contact.is_some() {
        return Limits { passes: control.passes, tolerance: control.tolerance };
    }
    let mut nodes = watched.concat();
    nodes.sort_unstable();
    let alone = nodes.windows(2).all(|pair| pair[0] != pair[1]);
    Limits { passes: if alone { 1 } else { control.passes }, tolerance: f64::NEG_INFINITY }
}

fn plane_points(watched: &[Vec<u32>], model: &Model, body: &Body, layout: &Layout) -> Vec<PlanePoint> {
    let mut list = Vec::new();
    for (number, (plane, nodes)) in model.rigid_surfaces.iter().zip(watched).enumerate() {
        for &node in nodes {
            if let Ok(point) = layout.nodes.binary_search(&node) {
                list.push(PlanePoint::new(point as u32, number, plane, body.positions[node as usize]));
            }
        }
    }
    list
}

/// The constraint of a point on a face. `None` where the point is to be the master only.
fn constraint(layout: &Layout, pairings: &Pairings, point: u32, touch: &Touch, interface: u32) -> Option<Constraint> {
    let (faces, face) = (&layout.faces, touch.face as usize);
    let rule = layout.interfaces[interface as usize].rule;
    let pairing = pairings.of(rule, layout.point_block[point as usize], faces.block[face]);
    // A point without faces of its own cannot be the master of anything.
    let share = if faces.around(point).is_empty() { 1.0 } else { pairing.share };
    if share <= 0.0 {
        return None;
    }
    let mut constraint = Constraint {
        members: [point; MEMBERS],
        weights: [1.0; MEMBERS],
        count: MEMBERS,
        normal: touch.stand.normal,
        gap: touch.stand.gap - touch.allowed,
        size: faces.size[face],
        share,
        friction: pairing.friction,
        push: 0.0,
        drag: [0.0; 3],
        origin: Origin::Face(point, 0),
    };
    constraint.members[1..].copy_from_slice(&faces.corners[face]);
    for (weight, n) in constraint.weights[1..].iter_mut().zip(touch.stand.weights) {
        *weight = -n;
    }
    Some(constraint)
}
