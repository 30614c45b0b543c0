//! The contact nodes of this rank: where they would go, and what contact does to them.

mod frame;
pub mod result;
pub mod sparse;

use crate::comm::Communicator;
use crate::lanes::Vectors;
use crate::solver::constraints::StepTimes;
use crate::solver::contact::enforcement::joints::Joints;
use crate::solver::contact::geometry::motion::{NodeMotion, larger, smaller};
use crate::solver::contact::geometry::paths::PathRange;
use crate::solver::contact::geometry::swept_box::SweptBox;
use crate::solver::contact::search::Box3;
use crate::solver::contact::surface::layout::{ABSENT, inverse};
use crate::solver::nodes::{Nodes, add, dot, scaled, subtract};
use frame::Frame;
use result::NodeResult;
use std::sync::Arc;

/// A contact node that is a node of this rank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactNode {
    /// Its number in the layout.
    pub point: u32,
    /// The local node.
    pub node: u32,
    /// Whether this rank answers for the node.
    pub owned: bool,
}

/// Room of a contact node's box on all sides, as a part of half the path that the box is made for: at full
/// speed a node turns little.
const SIDE: f64 = 0.25;

/// How far the box of a node goes that may be struck, as a part of the path of what strikes it, and the room that it has then on all
/// sides. Twice the room leads to as many searches of a can under a plate, and to a tenth more time.
const STRUCK: f64 = 0.7;
const STRUCK_SIDE: f64 = 0.1;

/// Search boxes are carried along where the way that nodes have in common is longer than so many rooms of nodes at rest, three faces.
/// Shorter ways bring few candidates, and what slows down stays in a box that holds its whole way, but leaves one that flies on: the
/// container that falls on a punch took 33 searches instead of 9.
const FAR: f64 = 30.0;

/// Contact nodes of this rank, in the order of their numbers in the layout.
#[derive(Debug, Clone, Default)]
pub struct ContactNodes {
    /// Who they are.
    pub list: Vec<ContactNode>,
    /// Where each point is in the list, or [`ABSENT`].
    places: Vec<u32>,
    /// For each axis of each, the constraint that holds the node, or [`ABSENT`].
    holders: Vec<[u32; 3]>,
    /// Where they are, would go, and how heavy they are.
    pub motion: NodeMotion,
    /// Whether each counts among the paths, all bits or none, and how many do.
    counts: Vec<u64>,
    counted: usize,
    /// How far from the centre of each rigid body its farthest contact node here is, a length.
    arms: Vec<f64>,
    /// By how much the path of one of them in the last step may differ from its velocity times the step, a length.
    turned: f64,
    /// Box that the last search gave each, and the frame that has carried them all along since. Coordinates beyond 3e38 have none,
    /// and meet nothing.
    search_boxes: Vec<SweptBox>,
    frame: Frame,
    /// Whether there was a search, and whether one is due: a contact node leaves its box in this step, or there was none.
    searched: bool,
    pub expired: bool,
    /// Contact nodes on which forces act now, ascending, and what contact says of each in this step.
    pub loaded: Vec<(u32, NodeResult)>,
    /// Rank that computes the contact of each; empty on one rank.
    pub owner_ranks: Vec<u32>,
    /// Work of normal and of friction forces so far, energies.
    pub works: Vec<[f64; 2]>,
}

/// Whose motions a survey finds for the rest of the step.
#[derive(Clone, Copy)]
enum Finds {
    All,
    Counted,
    Nothing,
}

impl ContactNodes {
    /// Those of all points that are here: `here` gives the local node of a point, or [`ABSENT`], `held` the constraints of nodes.
    pub fn new(
        (points, origin): (usize, [f64; 3]),
        here: impl Fn(u32) -> u32,
        held: &[[u32; 3]],
        nodes: &Nodes,
    ) -> ContactNodes {
        let contact_node = |point: u32| {
            let node = here(point);
            (node != ABSENT).then(|| ContactNode { point, node, owned: nodes.owned[node as usize] })
        };
        let list: Vec<ContactNode> = (0..points as u32).filter_map(contact_node).collect();
        let count = list.len();
        let held = |contact_node: &ContactNode| held.get(contact_node.node as usize).copied().unwrap_or([ABSENT; 3]);
        let mut contact_nodes = ContactNodes {
            holders: list.iter().map(held).collect(),
            places: inverse(list.iter().map(|contact_node| contact_node.point), points),
            motion: NodeMotion::of_nodes(list.iter().map(|contact_node| contact_node.node), origin),
            counts: vec![0; count],
            list,
            works: vec![[0.0; 2]; count],
            ..Default::default()
        };
        for (i, contact_node) in contact_nodes.list.iter().enumerate() {
            let inverse = nodes.rows[contact_node.node as usize].0[7];
            contact_nodes.motion.inverse_mass[i] =
                contact_nodes.holders[i].map(|holder| if holder == ABSENT { inverse } else { 0.0 });
        }
        contact_nodes
    }

    /// Learns which of them belong to rigid bodies.
    pub fn belong(&mut self, body: impl Fn(u32) -> Option<u32>, nodes: &Nodes) {
        let of = |contact_node: &ContactNode| body(contact_node.node).unwrap_or(ABSENT);
        self.motion.mobility.body = self.list.iter().map(of).collect();
        self.arms = vec![0.0; self.motion.mobility.bodies.len()];
        for (contact_node, &body) in self.list.iter().zip(&self.motion.mobility.body) {
            if let Some(body_mobility) = self.motion.mobility.bodies.get(body as usize) {
                let arm = subtract(nodes.position(contact_node.node), body_mobility.centre);
                self.arms[body as usize] = self.arms[body as usize].max(dot(arm, arm).sqrt());
            }
        }
    }

    /// Learns which of them TIED CONTACT joins, and how these answer to a force alone.
    pub fn join(&mut self, joints: &Arc<Joints>, nodes: &Nodes) {
        let mobility = &mut self.motion.mobility;
        let place = |contact_node: &ContactNode| joints.place(nodes.file[contact_node.node as usize]);
        mobility.joint = self.list.iter().map(place).collect();
        mobility.joints = joints.clone();
        for (inverse, &place) in self.motion.inverse_mass.iter_mut().zip(&mobility.joint) {
            if place != ABSENT {
                *inverse = joints.inverse_mass(place);
            }
        }
    }

    /// Hears by how much each rigid body has turned in the last step, radians. Velocities of its nodes are those of an
    /// instant then, at the end of an arc: from the arc's chord each differs by half the angle, and by as much again where
    /// the axis turns.
    pub fn turn(&mut self, angles: impl Iterator<Item = f64>) {
        self.turned = self.arms.iter().zip(angles).map(|(arm, angle)| arm * angle * angle).fold(0.0, f64::max);
    }

    /// Local nodes of this rank that it answers for and on which forces act, and these forces.
    pub fn own_forces(&self) -> impl Iterator<Item = (u32, [f64; 3])> + '_ {
        let own =
            self.loaded.iter().map(|(i, result)| (&self.list[*i as usize], result)).filter(|(node, _)| node.owned);
        own.map(|(contact_node, result)| (contact_node.node, add(result.normal_force, result.tangential_force)))
    }

    /// All points as contact nodes, for a search around them as they are.
    pub fn still(motion: &NodeMotion) -> ContactNodes {
        let contact_node = |point: u32| ContactNode { point, node: point, owned: true };
        let list: Vec<ContactNode> = (0..motion.len() as u32).map(contact_node).collect();
        let holders = vec![[ABSENT; 3]; list.len()];
        let places = (0..motion.len() as u32).collect();
        let mut contact_nodes = ContactNodes { list, places, holders, motion: motion.clone(), ..Default::default() };
        contact_nodes.renew(1.0, 0.0);
        contact_nodes
    }

    /// Position of a contact node.
    pub fn position(&self, contact_node: usize, nodes: &Nodes) -> [f64; 3] {
        nodes.position(self.list[contact_node].node)
    }

    /// The contact node of a point.
    #[inline]
    pub fn of(&self, point: u32) -> Option<usize> {
        self.places.get(point as usize).filter(|&&place| place != ABSENT).map(|&place| place as usize)
    }

    /// Looks at where all contact nodes would go in a step without contact: how far those go that count, and whether one of them
    /// leaves the box that the last search gave it.
    pub fn survey(&mut self, nodes: &Nodes, step: &StepTimes) {
        self.search_boxes.resize(self.list.len(), SweptBox::EVERYTHING);
        let is_crowded = |points: usize| self.motion.is_crowded(points);
        let how = match (is_crowded(self.list.len()), is_crowded(self.counted)) {
            (true, _) => Finds::All,
            (_, true) => Finds::Counted,
            _ => Finds::Nothing,
        };
        let last_drift = self.motion.drift();
        self.frame.advance(last_drift);
        self.motion.begin([step.drift, step.kick]);
        let leaves = match self.motion.instructions().vectors() {
            // SAFETY: an instruction set is one that this processor has, and AVX-512 includes AVX2.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 | Vectors::Avx512 => unsafe { self.survey_avx2(nodes, last_drift, how) },
            _ => self.survey_each(nodes, last_drift, how),
        };
        self.motion.range().widen(self.turned);
        self.expired = leaves || !self.searched;
    }

    /// The same with four numbers to a register. `unsafe` for a twelfth of contact on a crushed can (docs/performance.md).
    ///
    /// # Safety
    ///
    /// The processor must have AVX2.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn survey_avx2(&mut self, nodes: &Nodes, last_drift: f64, how: Finds) -> bool {
        self.survey_each(nodes, last_drift, how)
    }

    // Inlined, so that it is compiled for the instructions of its caller.
    #[inline(always)]
    fn survey_each(&mut self, nodes: &Nodes, last_drift: f64, how: Finds) -> bool {
        let of_each = (&self.counts[..], &self.search_boxes[..], self.frame.gone());
        self.motion.count_found(match how {
            Finds::All => self.list.len(),
            Finds::Counted => self.counted,
            Finds::Nothing => 0,
        });
        match how {
            Finds::All => self.motion.survey::<true, false>(nodes, last_drift, of_each),
            Finds::Counted => self.motion.survey::<false, true>(nodes, last_drift, of_each),
            Finds::Nothing => self.motion.survey::<false, false>(nodes, last_drift, of_each),
        }
    }

    /// Chooses the contact nodes that count among the paths.
    pub fn count(&mut self, chosen: impl Iterator<Item = usize>) {
        self.counts.fill(0);
        chosen.for_each(|contact_node| self.counts[contact_node] = u64::MAX);
        self.counted = self.counts.iter().filter(|counts| **counts != 0).count();
    }

    /// Lets the next search boxes, which are for so many steps and have at least that room, be carried along with what most of all
    /// contact nodes have in common. All ranks call it.
    pub fn fly_along(&mut self, steps: f64, least: f64, comm: &mut dyn Communicator) {
        let ContactNodes { list, motion, .. } = self;
        let owned = (0..).zip(list.iter()).filter(|(_, contact_node)| contact_node.owned);
        let frame = Frame::of(owned.map(|(i, _)| motion.velocity(i)), comm);
        let way = frame.path(steps * motion.drift());
        self.frame = if dot(way, way).sqrt() > FAR * least { frame } else { Frame::default() };
    }

    /// Gives every contact node a new search box: around the path that it would go in `steps` of the present one, with room on
    /// all sides for a turn, but at least `least`. The frame goes the first part of the way with it, and each step's own path is
    /// seen from where the frame is at its beginning.
    pub fn renew(&mut self, steps: f64, least: f64) {
        self.searched = true;
        self.motion.count_anew();
        self.search_boxes.clear();
        for contact_node in 0..self.list.len() {
            let half_step = scaled(self.path(contact_node), 0.5);
            let half = scaled(self.path_in_frame(contact_node), 0.5 * (steps - 1.0));
            let side = [0, 1, 2].map(|i| half[i].abs() + half_step[i].abs());
            let room = larger(SIDE * side.iter().fold(0.0, |longest, side| larger(*side, longest)), least);
            let start = subtract(self.motion.start(contact_node as u32), self.motion.origin());
            let centre = add(start, add(half, half_step));
            let side = side.map(|side| side + room);
            self.search_boxes.push(SweptBox::around(subtract(centre, side), add(centre, side)));
        }
    }

    /// Lets those contact nodes that are near something much faster go along with it, for so many steps; `near` is asked with the box
    /// of each and the path that it goes itself, and tells paths; all of them are seen from the frame.
    pub fn widen<'a>(&mut self, steps: f64, near: impl Fn(&Box3, [f64; 3]) -> Option<&'a PathRange>) {
        // In a step something goes along with the frame as well.
        let along = self.frame.path(self.motion.drift());
        for contact_node in 0..self.list.len() {
            let [low, high] = self.search_boxes[contact_node].corners();
            let Some(paths) = near(&Box3 { low, high }, self.path_in_frame(contact_node)) else { continue };
            let at = subtract(self.motion.start(contact_node as u32), self.motion.origin());
            let room = STRUCK_SIDE * steps * paths.paths().longest;
            let [backward, forward] = paths.bounds();
            let of = |path: f64, room: f64, at: f64| at + (STRUCK * steps * path + room);
            let least = [0, 1, 2].map(|i| smaller(of(backward[i], smaller(along[i], 0.0) - room, at[i]), low[i]));
            let most = [0, 1, 2].map(|i| larger(of(forward[i], larger(along[i], 0.0) + room, at[i]), high[i]));
            self.search_boxes[contact_node] = SweptBox::around(least, most);
        }
    }

    /// How far a contact node would go in the present step along each axis, seen from the frame of the search boxes, lengths.
    pub fn path_in_frame(&self, contact_node: usize) -> [f64; 3] {
        subtract(self.path(contact_node), self.frame.path(self.motion.drift()))
    }

    /// How far a contact node would go in the present step along each axis, lengths.
    pub fn path(&self, contact_node: usize) -> [f64; 3] {
        self.motion.path(contact_node as u32).1
    }

    /// Box around where four points stay until the next search, those of them that are contact nodes here; seen from the origin of
    /// the points.
    #[inline]
    pub fn reach(&self, points: [u32; 4]) -> Box3 {
        let of = |point: u32| self.of(point).map_or(&SweptBox::NOTHING, |place| &self.search_boxes[place]);
        let [low, high] = SweptBox::joined(points.map(of), 0.0).corners();
        Box3 { low, high }
    }

    /// What contact says of a contact node on which forces act.
    pub fn result(&mut self, contact_node: u32) -> Option<&mut NodeResult> {
        let place = self.loaded.binary_search_by_key(&contact_node, |(loaded, _)| *loaded).ok()?;
        Some(&mut self.loaded[place].1)
    }

    /// Adds the forces to the nodes; what a constraint holds, its reaction takes up.
    pub fn hand_over(&self, nodes: &mut Nodes, mut react: impl FnMut(u32, f64)) {
        for (i, result) in &self.loaded {
            let (contact_node, holders) = (&self.list[*i as usize], &self.holders[*i as usize]);
            let sum = &mut nodes.forces[contact_node.node as usize].0;
            for axis in 0..3 {
                let force = result.normal_force[axis] + result.tangential_force[axis];
                match holders[axis] {
                    ABSENT => sum[axis] += force,
                    holder => react(holder, force),
                }
            }
        }
    }

    /// Books half the step's work with the present velocities.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        for (i, result) in &self.loaded {
            let v = nodes.velocity(self.list[*i as usize].node);
            let work = &mut self.works[*i as usize];
            work[0] += half_step * dot(result.normal_force, v);
            work[1] += half_step * dot(result.tangential_force, v);
        }
    }
}
