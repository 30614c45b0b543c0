//! The contact nodes of this rank: where they would go, and what contact does to them.

use super::geometry::motion::{NodeMotion, larger};
use super::geometry::swept_box::SweptBox;
use super::layout::{ABSENT, inverse};
use super::node_result::NodeResult;
use crate::solver::constraints::StepTimes;
use crate::solver::nodes::{Nodes, add, dot, scaled, subtract};

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
    /// Box that the last search gave each. Coordinates beyond 3e38 have none, and meet nothing.
    search_boxes: Vec<SweptBox>,
    /// Whether there was a search, and whether one is due: a contact node leaves its box in this step, or there was none.
    searched: bool,
    pub expired: bool,
    /// What contact says of each, in this step.
    pub results: Vec<NodeResult>,
    /// Contact nodes on which forces act now, ascending.
    pub loaded: Vec<u32>,
    /// Rank that computes the contact of each; empty on one rank.
    pub owner_ranks: Vec<u32>,
    /// Work of normal and of friction forces so far, energies.
    pub works: Vec<[f64; 2]>,
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
            list,
            motion: NodeMotion::new(count, origin),
            results: vec![NodeResult::FREE; count],
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
    pub fn belong(&mut self, body: impl Fn(u32) -> Option<u32>) {
        let of = |contact_node: &ContactNode| body(contact_node.node).unwrap_or(ABSENT);
        self.motion.mobility.body = self.list.iter().map(of).collect();
    }

    /// Local nodes of this rank that it answers for and on which forces act, and these forces.
    pub fn own_forces(&self) -> impl Iterator<Item = (u32, [f64; 3])> + '_ {
        let own = self.loaded.iter().map(|&i| i as usize).filter(|&i| self.list[i].owned);
        own.map(|i| (self.list[i].node, add(self.results[i].normal_force, self.results[i].tangential_force)))
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

    /// The contact node of a point.
    #[inline]
    pub fn of(&self, point: u32) -> Option<usize> {
        self.places.get(point as usize).filter(|&&place| place != ABSENT).map(|&place| place as usize)
    }

    /// Where the contact nodes would go without contact, and whether one of them leaves the box that the last search gave it.
    pub fn predict(&mut self, nodes: &Nodes, step: &StepTimes) {
        self.search_boxes.resize(self.list.len(), SweptBox::EVERYTHING);
        self.motion.begin(step.drift);
        let motion = |contact_node: &ContactNode| {
            let (row, force) = (&nodes.rows[contact_node.node as usize].0, &nodes.forces[contact_node.node as usize].0);
            let velocity = std::array::from_fn(|i| row[4 + i] + step.kick * (force[i] * row[7]));
            ([row[0], row[1], row[2], row[3]], velocity)
        };
        let leaves = self.motion.set_all(self.list.iter().map(motion), &self.search_boxes);
        self.expired = leaves || !self.searched;
    }

    /// Velocity of a contact node over the step before.
    pub fn velocity_before(&self, contact_node: u32, nodes: &Nodes) -> [f64; 3] {
        nodes.velocity(self.list[contact_node as usize].node)
    }

    /// Gives every contact node a new search box: around the path that it would go in `steps` of the present one, with room on
    /// all sides for a turn, but at least `least`.
    pub fn renew(&mut self, steps: f64, least: f64) {
        self.searched = true;
        self.search_boxes.clear();
        for contact_node in 0..self.list.len() as u32 {
            let of = self.box_ahead(contact_node, steps, least);
            self.search_boxes.push(of);
        }
    }

    /// Box around the path that a contact node would go in `steps` of the present one, with room on all sides for a turn, but at
    /// least `least`; seen from the origin of the points.
    pub fn box_ahead(&self, contact_node: u32, steps: f64, least: f64) -> SweptBox {
        let (start, path) = self.motion.path(contact_node);
        let half = scaled(path, 0.5 * steps);
        let longest = half.iter().fold(0.0, |longest, half| larger(half.abs(), longest));
        let room = larger(SIDE * longest, least);
        let centre = subtract(add(start, half), self.motion.origin());
        let side = half.map(|half| half.abs() + room);
        SweptBox::around(subtract(centre, side), add(centre, side))
    }

    /// Boxes in which the contact nodes stay until the next search, seen from the origin of the points.
    pub fn search_boxes(&self) -> &[SweptBox] {
        &self.search_boxes
    }

    /// Normal and friction force on a contact node, forces.
    pub fn forces(&self, contact_node: usize) -> [[f64; 3]; 2] {
        let NodeResult { normal_force, tangential_force, .. } = self.results[contact_node];
        [normal_force, tangential_force]
    }

    /// Adds the forces to the nodes; what a constraint holds, its reaction takes up.
    pub fn hand_over(&self, nodes: &mut Nodes, mut react: impl FnMut(u32, f64)) {
        for &i in &self.loaded {
            let (contact_node, result) = (&self.list[i as usize], &self.results[i as usize]);
            let holders = &self.holders[i as usize];
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
        for &i in &self.loaded {
            let v = nodes.velocity(self.list[i as usize].node);
            let [normal, friction] = self.forces(i as usize);
            let work = &mut self.works[i as usize];
            work[0] += half_step * dot(normal, v);
            work[1] += half_step * dot(friction, v);
        }
    }
}
