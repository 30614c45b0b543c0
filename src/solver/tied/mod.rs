//! TIED CONTACT: surfaces that do not match and are joined as if they did.
//!
//! The nodes of one surface follow those of the other by fixed weights (`mortar`). They are no unknowns any more: their forces go to the nodes
//! that they follow, by the same weights, and so does their mass, at the start. Their places begin where the weights put them, so that
//! x_s = Σ W x_I holds at every state: momentum and angular momentum are kept, and rigid motion strains nothing.
//!
//! What a follower exerts and what its leaders do is known to all ranks, in the bits in which one of them computed it; each then finds the
//! sums that it needs in the order of the followers.

mod mortar;

pub use mortar::{Face, Follower, followers};

use super::Body;
use super::domain::ABSENT;
use super::nodes::Nodes;
use crate::comm::Communicator;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::vector::{add, dot, scaled, subtract};

/// The tied nodes of a body, and what was done to them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tied {
    /// Those that follow, ascending.
    pub followers: Vec<Follower>,
    /// For each command: nodes that follow, nodes of its first side set that do not, and the farthest that one was moved, a length.
    pub reports: Vec<TiedReport>,
}

/// What came of a TIED CONTACT.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TiedReport {
    /// Numbers of the side sets.
    pub side_sets: [i64; 2],
    /// Nodes that follow.
    pub tied: usize,
    /// Nodes of the first side set that found no face to follow.
    pub left: usize,
    /// Farthest that a node was moved onto the other surface, a length.
    pub moved: f64,
}

impl Tied {
    /// Of a model, with the nodes where `positions` has them; moves those that follow to where they are to be.
    pub fn new(mesh: &Mesh, model: &Model, positions: &mut [[f64; 3]]) -> Tied {
        let mut all = Tied::default();
        for tie in &model.ties {
            let [first, second] = tie.side_sets.map(|set| faces(mesh, set));
            let mut found = followers(&first, &second, |node| positions[node as usize], tie.tolerance);
            // A node follows once: the first command counts.
            found.retain(|one| all.followers.binary_search_by_key(&one.node, |other| other.node).is_err());
            let mut report = TiedReport { side_sets: tie.side_sets, tied: found.len(), left: 0, moved: 0.0 };
            let nodes = mesh.side_set_nodes(tie.side_sets[0]);
            report.left = nodes.len().saturating_sub(found.len());
            for one in &found {
                let there = weighted(one, |node| positions[node as usize]);
                let path = subtract(there, positions[one.node as usize]);
                report.moved = report.moved.max(dot(path, path).sqrt());
                positions[one.node as usize] = there;
            }
            all.followers.extend(found);
            all.followers.sort_by_key(|one| one.node);
            all.reports.push(report);
        }
        all
    }

    /// Gives the masses of followers to those that they follow.
    pub fn hand_over(&self, masses: &mut [f64]) {
        for one in &self.followers {
            let mass = std::mem::take(&mut masses[one.node as usize]);
            one.leaders.iter().for_each(|(node, weight)| masses[*node as usize] += weight * mass);
        }
    }

    /// Why the ties cannot be; `None` where they can. `masses` are those of the nodes once masses have been handed over.
    pub fn refusal(&self, mesh: &Mesh, masses: &[f64]) -> Option<String> {
        if let Some(TiedReport { side_sets: [first, second], .. }) = self.reports.iter().find(|report| report.tied == 0)
        {
            return Some(format!(
                "error: TIED CONTACT of side sets {first} and {second} ties nothing: no node of {first} is near a face of {second}\n\
                 help: see whether the numbers are those that are meant, or raise the tolerance to the gap between them"
            ));
        }
        let leaders = self.followers.iter().flat_map(|one| one.leaders.iter().map(|(node, _)| *node as usize));
        let without = leaders.filter(|&node| masses[node] <= 0.0 || masses[node].is_nan()).min()?;
        let [x, y, z] = mesh.coordinates.get(without)?;
        Some(format!(
            "error: TIED CONTACT: node {} at {x:.4e} {y:.4e} {z:.4e} would have a mass of {:.4e} with what follows it\n\
             help: a coarse surface follows a finer one that it covers only in part: change the order of the side sets, so that the finer \
             one follows, or let them cover the same area",
            mesh.node_ids.get(without)?,
            masses[without]
        ))
    }

    /// Whether a node follows others.
    pub fn follows(&self, node: u32) -> bool {
        self.followers.binary_search_by_key(&node, |one| one.node).is_ok()
    }

    /// 1/m of a follower, as a force on it sees it alone: Σ W²/m. `None` of other nodes.
    pub fn inverse_mass(&self, node: u32, masses: &[f64]) -> Option<f64> {
        let found = self.followers.binary_search_by_key(&node, |one| one.node).ok()?;
        let leaders = self.followers[found].leaders.iter();
        Some(leaders.map(|(leader, weight)| weight * weight / masses[*leader as usize]).sum())
    }
}

/// Σ W of a vector of the leaders.
fn weighted(one: &Follower, of: impl Fn(u32) -> [f64; 3]) -> [f64; 3] {
    one.leaders.iter().fold([0.0; 3], |sum, (node, weight)| add(sum, scaled(of(*node), *weight)))
}

/// Faces of a side set, each once.
fn faces(mesh: &Mesh, set: i64) -> Vec<Face> {
    let elements: Vec<_> = mesh.shaped().collect();
    let mut sides = mesh.side_set(set).map_or(Vec::new(), |set| set.sides.clone());
    sides.sort_unstable();
    sides.dedup();
    let face = |(element, side): (u32, u8)| {
        let (shape, nodes) = elements[element as usize];
        shape.face(nodes, side)
    };
    sides.into_iter().filter_map(face).collect()
}

/// The tied nodes of a rank.
pub struct Ties {
    /// Followers, by places in the list of leaders.
    followers: Vec<(u32, Vec<(usize, f64)>)>,
    /// Local node of each leader, or [`ABSENT`].
    leaders: Vec<u32>,
}

impl Ties {
    /// Those of a body; `None` without any. `local` gives the local node of a node of the mesh.
    pub fn new(body: &Body, local: &[u32]) -> Option<Ties> {
        let all = &body.tied.followers;
        if all.is_empty() {
            return None;
        }
        let mut numbers: Vec<u32> = all.iter().flat_map(|one| one.leaders.iter().map(|(node, _)| *node)).collect();
        numbers.sort_unstable();
        numbers.dedup();
        let place = |node: u32| numbers.partition_point(|&other| other < node);
        let follower = |one: &Follower| {
            let leaders = one.leaders.iter().map(|(node, weight)| (place(*node), *weight));
            (local[one.node as usize], leaders.collect())
        };
        Some(Ties {
            followers: all.iter().map(follower).collect(),
            leaders: numbers.iter().map(|&node| local[node as usize]).collect(),
        })
    }

    /// A vector of each of these local nodes, as the rank that answers for it has it. All ranks call it.
    fn known(
        nodes: &Nodes,
        list: impl Iterator<Item = u32>,
        of: impl Fn(u32) -> [f64; 3],
        comm: &mut dyn Communicator,
    ) -> Vec<[f64; 3]> {
        if comm.size() == 1 {
            return list.map(of).collect();
        }
        // One rank answers for each: the sum of bits is its bits.
        let bits = |node: u32| {
            let own = node != ABSENT && nodes.owned[node as usize];
            if own { of(node).map(f64::to_bits) } else { [0; 3] }
        };
        let mut all: Vec<u64> = list.flat_map(bits).collect();
        comm.all_sum(&mut all);
        all.as_chunks::<3>().0.iter().map(|bits| bits.map(f64::from_bits)).collect()
    }

    /// Moves the forces on followers to those that they follow. All ranks call it.
    pub fn hand_on(&self, nodes: &mut Nodes, comm: &mut dyn Communicator) {
        let forces = Ties::known(nodes, self.followers.iter().map(|(node, _)| *node), |node| nodes.force(node), comm);
        self.give(nodes, &forces);
        for (node, _) in self.followers.iter().filter(|(node, _)| *node != ABSENT) {
            nodes.forces[*node as usize] = Default::default();
        }
    }

    /// Adds forces on followers to those that they follow.
    fn give(&self, nodes: &mut Nodes, forces: &[[f64; 3]]) {
        for ((_, leaders), force) in self.followers.iter().zip(forces) {
            for (leader, weight) in leaders.iter().filter(|(leader, _)| self.leaders[*leader] != ABSENT) {
                let sum = &mut nodes.forces[self.leaders[*leader] as usize].0;
                (0..3).for_each(|i| sum[i] += weight * force[i]);
            }
        }
    }

    /// Moves forces of contact on: local nodes that this rank answers for, and the force on each. Forces of followers before are taken back. All
    /// ranks call it.
    pub fn push(&self, nodes: &mut Nodes, contact: impl Iterator<Item = (u32, [f64; 3])>, comm: &mut dyn Communicator) {
        let mut of_node = std::collections::BTreeMap::new();
        contact.for_each(|(node, force)| _ = of_node.insert(node, force));
        let force = |node: u32| of_node.get(&node).copied().unwrap_or_default();
        let forces = Ties::known(nodes, self.followers.iter().map(|(node, _)| *node), force, comm);
        self.give(nodes, &forces);
    }

    /// Gives followers the forces that let them follow, once those of the leaders are known. All ranks call it.
    pub fn follow(&self, nodes: &mut Nodes, comm: &mut dyn Communicator) {
        let accelerations = Ties::known(nodes, self.leaders.iter().copied(), |node| nodes.acceleration(node), comm);
        for (node, leaders) in self.followers.iter().filter(|(node, _)| *node != ABSENT) {
            let wanted = sum(leaders, &accelerations);
            let inverse = nodes.rows[*node as usize].0[7];
            nodes.forces[*node as usize].0[..3].copy_from_slice(&wanted.map(|a| a / inverse));
        }
    }

    /// Lets followers go with those that they follow at the start. All ranks call it.
    pub fn set_off(&self, nodes: &mut Nodes, comm: &mut dyn Communicator) {
        let velocities = Ties::known(nodes, self.leaders.iter().copied(), |node| nodes.velocity(node), comm);
        for (node, leaders) in self.followers.iter().filter(|(node, _)| *node != ABSENT) {
            nodes.rows[*node as usize].0[4..7].copy_from_slice(&sum(leaders, &velocities));
        }
    }
}

fn sum(leaders: &[(usize, f64)], of: &[[f64; 3]]) -> [f64; 3] {
    leaders.iter().fold([0.0; 3], |sum, (leader, weight)| add(sum, scaled(of[*leader], *weight)))
}
