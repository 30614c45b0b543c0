//! Contact: a predictor finds where nodes would go, and forces take the overlaps out (Attaway et al. 1996).
//!
//! [`Contact::apply`] is steps 1.6 to 1.9 of the paper's figure 1: predict, locate, check in detail, enforce. Nodes of this
//! rank are `ContactNodes`; check and enforcement happen in a `LocalProblem`, of whole bodies on one rank, of a region
//! of space on many (`remote`). Nothing that comes out depends on how many there are.

pub mod check;
pub mod enforcement;
pub mod geometry;
mod local_problem;
mod nodes;
mod observations;
mod press_fit;
mod ranks;
pub mod search;
mod state;
mod surface;

use super::constraints::{Constraint as HeldDirection, StepTimes};
use super::erosion::Erosion;
use super::nodes::Nodes;
use super::rigid::{RigidBodies, RigidBody};
use crate::comm::{Communicator, Traffic};
use crate::model::{ContactDecomposition, RigidSurface};
use check::edge_edge;
use check::edge_edge::EdgeContact;
use check::node_face::{FaceContact, NONE};
use check::planes::PlaneNode;
use enforcement::accounts::certificate::Bank;
use enforcement::accounts::gain::Gain;
use enforcement::accounts::resultants::Resultants;
use enforcement::iterations::{Limits, Outcome};
use enforcement::joints::Joints;
use enforcement::mobility::BodyMobility;
use enforcement::other_ranks::{Elsewhere, NoOtherRanks};
use geometry::paths::PathRange;
use local_problem::{History, LocalProblem, StepInput};
use nodes::ContactNodes;
use observations::arcs::{self, Arcs};
use ranks::remote::Remote;
use search::locate::Reach;
use search::surroundings::Surroundings;
use search::{Search, neighbourhood};
use std::borrow::Cow;
use std::sync::Arc;
use surface::construction::alone;
use surface::layout::{ABSENT, Layout};
use surface::pairings::Pairings;
use surface::skin::Skin;

pub use check::embedded::EmbeddedNode;
pub use check::initial_overlap::remove as remove_overlap;
pub use check::overlap::{Crowded, DeepOverlap, Overlap, Stuck};
pub use check::unheld;
pub use enforcement::iterations::LOOSER;
pub use observations::report::{Report, Tally, Work};
pub use observations::seen::{Looser, Seen};
pub use press_fit::PressFit;
pub(in crate::solver) use surface::construction::{Surfaces, surfaces};

/// Steps after which edges look for lines of faces anew. What sinks in between nodes does so slowly, as the nodes hold the rest; pairs that come
/// fast are looked at in every step.
const LINES_EVERY: u64 = 4;

/// Contact of one rank: surfaces, rigid planes, and the account of their forces.
pub struct Contact {
    layout: Layout,
    skin: Skin,
    pairings: Pairings,
    /// Contact nodes of this rank.
    contact_nodes: ContactNodes,
    problem: LocalProblem,
    /// The other ranks, where there are any that this one must know.
    remote: Option<Remote>,
    /// History that the next search puts back, where the local problem has been given up.
    carried: Option<History>,
    /// For each axis of each local node, the constraint that holds it, or [`ABSENT`].
    held: Vec<[u32; 3]>,
    /// Canonical numbers of the elements that are here, ascending.
    elements: Vec<u32>,
    /// Local nodes of each face whose element is here, and of the side across the element from it.
    thicknesses: Vec<(u32, [[u32; 4]; 2])>,
    search: Box<dyn Search>,
    decomposition: ContactDecomposition,
    reach: Reach,
    planes: Vec<RigidSurface>,
    /// Mean size of the faces: what overlaps with planes are small against.
    mean_size: f64,
    /// All nodes that may meet planes.
    plane_nodes: Vec<PlaneNode>,
    /// What TIED CONTACT joins, where it may be touched.
    joints: Option<Arc<Joints>>,
    limits: Limits,
    /// How overlaps of the mesh are pushed apart, if they are.
    press_fit: Option<PressFit>,
    /// Work of normal and friction forces at points that are gone, those of this rank.
    lost_work: Vec<[f64; 2]>,
    /// What contact may give back of what it has taken.
    bank: Bank,
    /// Energy that contact has made.
    gain: Gain,
    /// What the log tells.
    pub tally: Tally,
    /// Deepest penetration so far between nodes that nothing can move, of contacts of this rank: as a part of the face's size, and the
    /// number of a node in the mesh.
    held_deepest: Option<(f64, u32)>,
    /// What has been met so far.
    seen: Seen,
    /// What of the surface has touched when; nothing once elements have gone.
    arcs: Arcs,
    /// Forces and works that the deck watches, and the numbers of the blocks.
    resultants: Resultants,
    block_ids: Vec<i64>,
    /// Number of searches so far.
    searches: u64,
    /// Number of steps so far.
    age: u64,
    /// Slave nodes and pairs of the last search, of all ranks.
    counts: [u64; 2],
}

impl Contact {
    /// Lets the surface grow inwards after elements have gone: `dead` are their canonical numbers, ascending.
    pub fn erode(&mut self, dead: &[u32], erosion: &Erosion, nodes: &Nodes, comm: &mut dyn Communicator) {
        let history = self.carried.take().unwrap_or_else(|| self.problem.history());
        self.skin.delete(dead, &self.layout, |node| erosion.keeps(node));
        let old = self.lay_out_anew();
        surface::reshape::take_over(&mut self.layout, &old);
        let old_contact_nodes = std::mem::take(&mut self.contact_nodes);
        self.carried = Some(renumbered(history, &old, &self.layout));
        self.attach_to_nodes(|node| erosion.local()[node as usize], nodes, comm);
        // What is laid bare may be thinner than it was.
        self.update_depths(nodes, comm);
        for (contact_node, work) in old_contact_nodes.list.iter().zip(&old_contact_nodes.works) {
            match self.contact_nodes.of(self.layout.point(old.nodes[contact_node.point as usize])) {
                Some(now) => self.contact_nodes.works[now] = *work,
                None if contact_node.owned => self.lost_work.push(*work),
                None => (),
            }
        }
    }

    /// Lays out the surface that is left when elements have gone; what counts by its numbers is renumbered or forgotten. The layout of
    /// before.
    fn lay_out_anew(&mut self) -> Layout {
        let old = std::mem::replace(&mut self.layout, self.skin.layout());
        self.arcs = Arcs::default();
        for plane_node in &mut self.plane_nodes {
            plane_node.point = self.layout.point(old.nodes[plane_node.point as usize]);
        }
        old
    }

    /// Finds the contact forces of the step and adds them to the nodes; along directions that are held, the
    /// constraint's reaction takes them up.
    pub fn apply(
        &mut self,
        nodes: &mut Nodes,
        held: &mut [HeldDirection],
        rigid: Option<&RigidBodies>,
        step: &StepTimes,
        comm: &mut dyn Communicator,
    ) {
        self.update_rigid_bodies(rigid, nodes, comm);
        self.bring_motion(nodes, step, comm);
        comm.enter(Traffic::ContactPasses);
        let outcome = self.enforce(step, comm);
        // The age counts this step already.
        self.problem.record(&mut self.seen, (step.time, self.age.saturating_sub(1)));
        self.seen.iterate(&outcome);
        if self.age.is_multiple_of(arcs::EVERY) {
            self.problem.record_arcs(&mut self.arcs, (self.age / arcs::EVERY) as u32);
        }
        self.book_resultants(step);
        self.note_held();
        self.count(outcome);
        comm.enter(Traffic::ContactMotion);
        self.bring_forces(nodes, comm);
        self.contact_nodes.hand_over(nodes, |holder, force| held[holder as usize].reaction -= force);
    }

    /// Takes over how rigid bodies answer to forces in the step, and which points are theirs where that is not known yet.
    fn update_rigid_bodies(&mut self, rigid: Option<&RigidBodies>, nodes: &Nodes, comm: &dyn Communicator) {
        let Some(rigid) = rigid else { return };
        let ContactNodes { motion, list, .. } = &mut self.contact_nodes;
        let of = |body: &RigidBody| BodyMobility { centre: body.centre, compliance: body.compliance, free: body.free };
        motion.mobility.bodies = rigid.bodies.iter().map(of).collect();
        self.problem.motion.mobility.bodies.clone_from(&motion.mobility.bodies);
        let is_known = motion.mobility.body.len() == list.len();
        if !is_known {
            self.contact_nodes.belong(|node| rigid.of_node(node), nodes);
        }
        self.contact_nodes.turn(rigid.bodies.iter().map(RigidBody::last_angle));
        if !is_known {
            self.tell_who_answers(comm);
        }
    }

    /// Tells the local problem of planes alone on many ranks for which nodes this one answers.
    fn tell_who_answers(&mut self, comm: &dyn Communicator) {
        if self.remote.is_none() && comm.size() > 1 {
            self.problem.answers = self.contact_nodes.list.iter().map(|contact_node| contact_node.owned).collect();
        }
    }

    /// Forces on the local nodes that this rank answers for.
    pub fn forces_of_nodes(&self) -> impl Iterator<Item = (u32, [f64; 3])> + '_ {
        self.contact_nodes.own_forces()
    }

    /// Looks at where the nodes would go, searches if that is due, and brings their motion to the local problem, which keeps the
    /// nodes until it brings the forces.
    fn bring_motion(&mut self, nodes: &mut Nodes, step: &StepTimes, comm: &mut dyn Communicator) {
        self.contact_nodes.survey(nodes, step);
        comm.enter(Traffic::ContactSearch);
        let reshaped = self.reshape(nodes, comm);
        self.contact_nodes.motion.borrow(nodes);
        if !self.layout.interfaces.is_empty() {
            let expired = self.expired(comm);
            if expired || reshaped {
                self.search(comm);
            }
        }
        comm.enter(Traffic::ContactMotion);
        let Contact { contact_nodes, problem, remote, .. } = self;
        match remote {
            Some(remote) => remote.send_motion(contact_nodes, problem, comm),
            // The points of the local problem are the contact nodes: their motion is lent, not copied.
            None => std::mem::swap(&mut problem.motion, &mut contact_nodes.motion),
        }
    }

    /// Gives the nodes back and brings the forces that the local problem has found to the contact nodes.
    fn bring_forces(&mut self, nodes: &mut Nodes, comm: &mut dyn Communicator) {
        let Contact { contact_nodes, problem, remote, .. } = self;
        problem.motion.give_back(nodes);
        match remote {
            Some(remote) => remote.send_forces(contact_nodes, problem, comm),
            None => {
                std::mem::swap(&mut problem.motion, &mut contact_nodes.motion);
                contact_nodes.loaded.clear();
                contact_nodes
                    .loaded
                    .extend(problem.loaded.iter().map(|&point| (point, problem.results[point as usize])));
            }
        }
    }

    /// Brings what [`Contact::node_values`] and [`Contact::plane_forces`] tell beside forces to the nodes; before them,
    /// and all ranks call it.
    pub fn complete(&mut self, comm: &mut dyn Communicator) {
        let Contact { contact_nodes, problem, remote, .. } = self;
        if let Some(remote) = remote {
            remote.send_details(contact_nodes, problem, comm);
        }
    }

    /// Whether any rank needs a search. All ranks hear how far nodes go on any of them: what sleeps on one may be nodes of another.
    fn expired(&mut self, comm: &mut dyn Communicator) -> bool {
        let expired = self.contact_nodes.expired;
        if self.remote.is_none() {
            return expired;
        }
        let range = self.contact_nodes.motion.range();
        let [a, b, c, d, e, f, g] = range.to_array();
        let mut least = [a, b, c, d, e, f, g, -f64::from(u8::from(expired))];
        comm.all_min(&mut least);
        let [a, b, c, d, e, f, g, vote] = least;
        *range = PathRange::from_array([a, b, c, d, e, f, g]);
        vote < 0.0
    }

    /// Gives all contact nodes new search boxes. All ranks call it.
    fn renew_boxes(&mut self, comm: &mut dyn Communicator) {
        let Contact { layout, contact_nodes, remote, reach, .. } = self;
        contact_nodes.motion.find_all();
        contact_nodes.fly_along(reach.steps, reach.least, comm);
        contact_nodes.renew(reach.steps, reach.least);
        // Without a least reach there is no speed that counts as fast.
        if reach.least > 0.0 {
            let all = || (0..layout.faces.len() as u32).collect();
            let here: Cow<[u32]> = remote.as_ref().map_or_else(all, |remote| remote.faces().into());
            let surroundings = Surroundings::of(&here, (layout, contact_nodes), *reach, comm);
            contact_nodes.widen(reach.steps, |of, path| surroundings.near(of, path));
        }
    }

    /// Finds all candidates anew.
    fn search(&mut self, comm: &mut dyn Communicator) {
        self.renew_boxes(comm);
        let Contact { layout, contact_nodes, problem, remote, carried, search, plane_nodes, .. } = self;
        let depth = self.reach.depth;
        self.searches += 1;
        if let Some(remote) = remote {
            let is_heir = carried.is_none() && self.searches > 1;
            let history = carried.take().unwrap_or_else(|| problem.history());
            let new = remote.decompose(&mut **search, (layout, plane_nodes, depth), contact_nodes, history, comm);
            let old = std::mem::replace(problem, new);
            if is_heir {
                problem.locator.take_over(&old.locator, [&problem.numbering, &old.numbering]);
            }
        } else {
            let found = neighbourhood::find_alone(&mut **search, layout, contact_nodes);
            if carried.is_some() || self.searches == 1 {
                *problem = alone(layout, contact_nodes, plane_nodes, found, depth);
                problem.restore(carried.take().unwrap_or_default());
            } else {
                problem.renew(found, depth);
            }
        }
        let LocalProblem { locator, numbering, .. } = &mut *problem;
        let moving = locator.moving().iter().map(|&point| numbering.points[point as usize]);
        let moving = moving.filter_map(|point| contact_nodes.of(point)).collect::<Vec<usize>>();
        contact_nodes.count(moving.into_iter().chain(remote.iter().flat_map(Remote::sent)));
        self.counts = self.problem.locator.counts().map(|count| count as u64);
        self.problem.count_candidates(&mut self.seen.met);
        if self.remote.is_some() {
            comm.all_sum(&mut self.counts);
        }
    }

    fn enforce(&mut self, step: &StepTimes, comm: &mut dyn Communicator) -> Outcome {
        let coupled = comm.size() > 1 && self.problem.motion.mobility.is_coupled();
        let Contact { problem, remote, pairings, planes, mean_size, limits, press_fit, bank, age, seen, tally, .. } =
            self;
        let remaining = press_fit.map_or(1.0, |fit| fit.remaining(step));
        let lines = age.is_multiple_of(LINES_EVERY);
        let limits = limits.after(tally.unsettled, tally.farthest);
        let setting = StepInput { pairings, planes, mean_size: *mean_size, limits, remaining, lines };
        problem.find_constraints(&setting, step, &mut seen.met);
        let outcome = match remote {
            Some(remote) => problem.find_forces(&setting, step, bank, &mut remote.others(comm)),
            None if coupled => problem.find_forces(&setting, step, bank, &mut Elsewhere(comm)),
            None => problem.find_forces(&setting, step, bank, &mut NoOtherRanks),
        };
        problem.meet_struck(&mut seen.met);
        outcome
    }

    /// Books what the deck watches.
    fn book_resultants(&mut self, step: &StepTimes) {
        let Contact { problem, resultants, planes, block_ids, contact_nodes, remote, .. } = self;
        if resultants.is_empty() {
            return;
        }
        // Of planes alone each rank knows its nodes, and those that it shares are known twice.
        let alone = remote.is_none();
        let mine = |point: usize| !alone || contact_nodes.list.get(point).is_none_or(|node| node.owned);
        problem.book(resultants, (planes, block_ids), step, mine);
    }

    /// Remembers the deepest penetration that nothing can take out.
    fn note_held(&mut self) {
        let before = self.held_deepest.map_or(0.0, |(part, _)| part);
        if let Some((part, point)) = self.problem.held().filter(|(part, _)| *part > before) {
            self.held_deepest = Some((part, self.layout.nodes[point as usize]));
        }
    }

    fn count(&mut self, outcome: Outcome) {
        let Outcome { iterations, ran_out, residual, deepest, depth, travel, held, .. } = outcome;
        self.tally.held = self.tally.held.max(held);
        self.tally.deepest = self.tally.deepest.max(deepest);
        self.tally.farthest = self.tally.farthest.max(travel);
        if depth > 0.0 {
            self.tally.motions = self.tally.motions.max(depth / self.tally.farthest);
        }
        self.tally.steps += u64::from(iterations > 0);
        self.tally.iterations += u64::from(iterations);
        if iterations > 0 {
            self.tally.unsettled = if self.limits.are_kept_by(&outcome) { 0 } else { self.tally.unsettled + 1 };
        }
        self.tally.capped += u64::from(ran_out && self.limits.tolerance.is_finite());
        self.tally.left = self.tally.left.max(residual);
    }

    /// Books half the step's work with the present velocities.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        self.contact_nodes.book(nodes, half_step);
    }

    /// For each that HISTORY watches, in the order of the deck: the mean force since the last state that was `due`, the works on
    /// both sides so far and what friction has dissipated between them. All ranks call it.
    pub fn resultants(&mut self, time: f64, due: bool, comm: &mut dyn Communicator) -> Vec<[f64; 6]> {
        self.resultants.values(time, due, comm)
    }

    /// Forgets the forces of this step.
    pub fn forget(&mut self) {
        self.contact_nodes.loaded.clear();
        self.problem.forget();
    }
}

/// A history in the numbers of a new layout.
fn renumbered(history: History, old: &Layout, new: &Layout) -> History {
    let point = |point: u32| new.point(old.nodes[point as usize]);
    let face = |past: FaceContact| match past.face {
        NONE => past,
        face => FaceContact { face: new.face(old.faces.number[face as usize]), ..past },
    };
    let edge = |edge: u32| new.edge(old.edges[edge as usize].ends.map(|point| old.nodes[point as usize]));
    let points = history.points.into_iter().map(|(p, pasts)| (point(p), pasts.map(face)));
    let edges = history
        .edges
        .into_iter()
        .filter_map(|past| Some(EdgeContact { pair: [edge(past.pair[0])?, edge(past.pair[1])?], ..past }))
        .filter_map(|past| edge_edge::in_order(past, &new.edges));
    History {
        points: points.filter(|(point, _)| *point != ABSENT).collect(),
        edges: edges.collect(),
        planes: history.planes,
        costs: history.costs.iter().map(|&(p, cost)| (point(p), cost)).filter(|(p, _)| *p != ABSENT).collect(),
    }
}
