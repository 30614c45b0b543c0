//! TIED CONTACT: surfaces that do not match and are joined as if they did.
//!
//! The nodes of one surface follow those of the other by fixed weights (`mortar`). They are no unknowns any more: their
//! forces go to the nodes that they follow, by the same weights, and so does their mass, at the start. Their places begin
//! where the weights put them, so that x_s = Σ W x_I holds at every state: momentum and angular momentum are kept, and
//! rigid motion strains nothing.
//!
//! What a follower exerts and what its leaders do is known to all ranks, in the bits in which one of them computed it; each
//! then finds the sums that it needs in the order of the followers.

mod driven;
mod edges;
mod mortar;
mod ratio;

pub use mortar::{Face, Follower, Joint, followers};

use super::Body;
use super::domain::ABSENT;
use super::nodes::Nodes;
use crate::comm::Communicator;
use crate::common::vector::{add, dot, scaled, subtract};
use crate::mesh::Mesh;
use crate::model::{Model, Tie, Unknown};
use driven::against_leaders;
use ratio::Masses;
use std::collections::BTreeMap;

/// The tied nodes of a body, and what was done to them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tied {
    /// Those that follow, ascending.
    pub followers: Vec<Follower>,
    /// Mass that each of them had before it was handed over.
    pub handed: Vec<f64>,
    /// How much faster than its elements a joint can vibrate: the largest eigenvalue of the masses of its nodes, as its elements have
    /// them, over those that are computed with, less 1; 0 where all weights are positive.
    pub excess: f64,
    /// Those that the deck holds or drives otherwise than what they follow, and the first of them, a node of the mesh.
    pub held: (usize, u32),
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
        let joints: Vec<Joint> = model.ties.iter().map(|tie| joint(mesh, tie)).collect();
        let mut all = Tied { followers: followers(&joints, |node| positions[node as usize]), ..Tied::default() };
        let moved = all.followers.iter().map(|one| {
            let there = weighted(one, |node| positions[node as usize]);
            let path = subtract(there, positions[one.node as usize]);
            dot(path, path).sqrt()
        });
        let moved: Vec<f64> = moved.collect();
        for tie in &model.ties {
            let nodes = mesh.side_set_nodes(tie.side_sets[0]);
            let tied = nodes.iter().filter_map(|node| all.place_of(*node));
            let (mut count, mut farthest) = (0, 0.0);
            tied.for_each(|place| (count, farthest) = (count + 1, f64::max(farthest, moved[place])));
            let report =
                TiedReport { side_sets: tie.side_sets, tied: count, left: nodes.len() - count, moved: farthest };
            all.reports.push(report);
        }
        all.place(positions);
        all.held = against_leaders(mesh, model, &all.followers);
        all
    }

    /// Puts followers where those that they follow put them.
    pub fn place(&self, positions: &mut [[f64; 3]]) {
        for one in &self.followers {
            positions[one.node as usize] = weighted(one, |node| positions[node as usize]);
        }
    }

    /// Gives the masses of followers to those that they follow.
    pub fn hand_over(&mut self, masses: &mut [f64]) {
        let before = masses.to_vec();
        self.handed = self.followers.iter().map(|one| std::mem::take(&mut masses[one.node as usize])).collect();
        for (one, mass) in self.followers.iter().zip(&self.handed) {
            one.leaders.iter().for_each(|(node, weight)| masses[*node as usize] += weight * mass);
        }
        let joint = Masses::of(&self.followers, &self.handed, &before, masses);
        self.excess = joint.map_or(1.0, |joint| joint.largest_ratio()) - 1.0;
    }

    /// Nodes that others follow, by their numbers, ascending.
    pub fn leaders(&self) -> Vec<u32> {
        let all = self.followers.iter().flat_map(|one| one.leaders.iter().map(|(node, _)| *node));
        let mut leaders: Vec<u32> = all.collect();
        leaders.sort_unstable();
        leaders.dedup();
        leaders
    }

    /// Part of the stable step of the elements at which joints are stable.
    pub fn step_part(&self) -> f64 {
        1.0 / (1.0 + self.excess).sqrt()
    }

    /// Nodes that are joined with each other, by their numbers, each with those that it follows or that follow it, ascending.
    pub fn joined(&self) -> Vec<(u32, Vec<u32>)> {
        let pairs = self.followers.iter().flat_map(|one| one.leaders.iter().map(|(leader, _)| [one.node, *leader]));
        let mut all: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for [follower, leader] in pairs {
            all.entry(follower).or_default().push(leader);
            all.entry(leader).or_default().push(follower);
        }
        all.values_mut().for_each(|others| others.sort_unstable());
        all.into_iter().collect()
    }

    /// Why the ties cannot be; `None` where they can. `masses` are those of the nodes once masses have been handed over.
    pub fn refusal(&self, mesh: &Mesh, model: &Model, masses: &[f64]) -> Option<String> {
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
        let help = match self.heavy_follower(mesh, model, without as u32, masses[without]) {
            Some((node, weight)) => format!(
                "node {} follows it with a weight of {weight:.4e}, and its POINT MASS is too heavy for that: change the order of the side \
                 sets, so that it does not follow, or give the mass to nodes that do not follow",
                mesh.node_ids.get(node as usize)?
            ),
            None => "a coarse surface follows a finer one that it covers only in part: change the order of the side sets, so that the finer \
                     one follows, or let them cover the same area"
                .to_string(),
        };
        Some(format!(
            "error: TIED CONTACT: node {} at {x:.4e} {y:.4e} {z:.4e} would have a mass of {:.4e} with what follows it\nhelp: {help}",
            mesh.node_ids.get(without)?,
            masses[without]
        ))
    }

    /// The node, with its weight, whose POINT MASS takes most off the mass of a node that it follows; `None` where that would not be
    /// positive without such masses either.
    fn heavy_follower(&self, mesh: &Mesh, model: &Model, leader: u32, mass: f64) -> Option<(u32, f64)> {
        let mut masses: BTreeMap<u32, f64> = BTreeMap::new();
        for point in &model.point_masses {
            let shares = mesh.shares_of(point.node_set).into_iter();
            shares.for_each(|(node, factor)| *masses.entry(node).or_default() += factor * point.mass);
        }
        let point_mass = |node: u32| masses.get(&node).copied().unwrap_or_default();
        let weight = |one: &Follower| one.leaders.iter().find(|(node, _)| *node == leader).map(|(_, weight)| *weight);
        let given = |one: &Follower| weight(one).map(|weight| (one.node, weight, weight * point_mass(one.node)));
        let given: Vec<(u32, f64, f64)> = self.followers.iter().filter_map(given).collect();
        let without = mass - given.iter().map(|(_, _, mass)| mass).sum::<f64>();
        let (node, weight, _) = given.into_iter().min_by(|a, b| a.2.total_cmp(&b.2)).filter(|_| without > 0.0)?;
        Some((node, weight))
    }

    /// Place of a node among those that follow.
    fn place_of(&self, node: u32) -> Option<usize> {
        self.followers.binary_search_by_key(&node, |one| one.node).ok()
    }

    /// Whether a node follows others.
    pub fn follows(&self, node: u32) -> bool {
        self.place_of(node).is_some()
    }

    /// 1/m of a follower, as a force on it sees it alone: Σ W²/m. `None` of other nodes.
    pub fn inverse_mass(&self, node: u32, masses: &[f64]) -> Option<f64> {
        let leaders = self.followers[self.place_of(node)?].leaders.iter();
        Some(leaders.map(|(leader, weight)| weight * weight / masses[*leader as usize]).sum())
    }
}

/// Nodes whose positions the deck holds or drives along each axis, ascending.
pub fn held_nodes(mesh: &Mesh, model: &Model) -> [Vec<u32>; 3] {
    let still = model.no_displacements.iter().map(|c| (c.of, c.direction, c.node_set));
    let moving = model.prescribed_motions.iter().map(|c| (c.of, c.direction, c.node_set));
    let mut held: [Vec<u32>; 3] = Default::default();
    for (_, direction, set) in still.chain(moving).filter(|(of, ..)| *of == Unknown::Position) {
        held[direction.axis()].extend(mesh.node_set(set).map_or(&[][..], |set| &set.nodes));
    }
    held.iter_mut().for_each(|nodes| nodes.sort_unstable());
    held
}

/// Σ W of a vector of the leaders.
fn weighted(one: &Follower, of: impl Fn(u32) -> [f64; 3]) -> [f64; 3] {
    one.leaders.iter().fold([0.0; 3], |sum, (node, weight)| add(sum, scaled(of(*node), *weight)))
}

/// The surfaces that a TIED CONTACT joins.
fn joint(mesh: &Mesh, tie: &Tie) -> Joint {
    let [following, leading] = tie.side_sets.map(|set| faces(mesh, set));
    Joint { following, leading, tolerance: tie.tolerance }
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
    /// Mass that each of them has handed over.
    handed: Vec<f64>,
    /// Part of the stable step of the elements at which joints are stable.
    pub step_part: f64,
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
        let numbers = body.tied.leaders();
        let place = |node: u32| numbers.partition_point(|&other| other < node);
        let follower = |one: &Follower| {
            let leaders = one.leaders.iter().map(|(node, weight)| (place(*node), *weight));
            (local[one.node as usize], leaders.collect())
        };
        Some(Ties {
            followers: all.iter().map(follower).collect(),
            handed: body.tied.handed.clone(),
            step_part: body.tied.step_part(),
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

    /// Moves forces of contact on: local nodes that this rank answers for, and the force on each. Forces of followers
    /// before are taken back. All ranks call it.
    pub fn push(&self, nodes: &mut Nodes, contact: impl Iterator<Item = (u32, [f64; 3])>, comm: &mut dyn Communicator) {
        let mut of_node = BTreeMap::new();
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

    /// Lets followers and those that they follow set off together, with the momentum that they have. All ranks call it.
    pub fn set_off(&self, nodes: &mut Nodes, comm: &mut dyn Communicator) {
        let own = Ties::known(nodes, self.followers.iter().map(|(node, _)| *node), |node| nodes.velocity(node), comm);
        let before = Ties::known(nodes, self.leaders.iter().copied(), |node| nodes.velocity(node), comm);
        for ((velocity, handed), (_, leaders)) in own.iter().zip(&self.handed).zip(&self.followers) {
            // What they would not have by following alone.
            let more = subtract(*velocity, sum(leaders, &before));
            for (leader, weight) in leaders.iter().filter(|(leader, _)| self.leaders[*leader] != ABSENT) {
                let row = &mut nodes.rows[self.leaders[*leader] as usize].0;
                let share = weight * handed / row[3];
                (0..3).for_each(|i| row[4 + i] += share * more[i]);
            }
        }
        let velocities = Ties::known(nodes, self.leaders.iter().copied(), |node| nodes.velocity(node), comm);
        for (node, leaders) in self.followers.iter().filter(|(node, _)| *node != ABSENT) {
            nodes.rows[*node as usize].0[4..7].copy_from_slice(&sum(leaders, &velocities));
        }
    }
}

fn sum(leaders: &[(usize, f64)], of: &[[f64; 3]]) -> [f64; 3] {
    leaders.iter().fold([0.0; 3], |sum, (leader, weight)| add(sum, scaled(of[*leader], *weight)))
}
