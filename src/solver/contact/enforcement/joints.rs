//! Nodes that TIED CONTACT joins: a force on one that follows moves those that it follows, and with them all that follow these.
//!
//! To the enforcement the leaders are what rigid bodies are (`mobility`): forces on all points of a joint are summed at them, by the
//! weights of the followers, and each point answers with the weighted sum of what its leaders do. This operator, W M⁻¹ Wᵀ, is
//! symmetric and positive, which is all that the certificate of energy asks of it. The inverse mass of a follower alone, Σ W²/m, is not
//! enough: several followers that are pushed together move their leader several times as far as each of them alone.

use super::constraint::Response;
use super::iterates::Iterates;
use super::other_ranks::OtherRanks;
use crate::comm::ExactSum;
use crate::common::vector::{add, scaled};
use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::Body;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::surface::layout::ABSENT;
use crate::solver::tied::held_nodes;

/// Sums over what pushes a leader: force, load.
const SUMS: usize = 4;

/// The joints of a model, known to all ranks.
#[derive(Debug, Clone, Default)]
pub struct Joints {
    /// Their nodes, by their numbers in the mesh, ascending.
    nodes: Vec<u32>,
    /// For each of them the leaders that carry it, each with its weight; a leader carries itself.
    carriers: Vec<Vec<(u32, f64)>>,
    /// For each of them 1/m if nothing held its leaders, as a force on it alone sees it: Σ W²/m.
    free: Vec<f64>,
    /// What forces do to the leaders.
    leaders: Vec<LeaderMobility>,
}

/// What forces do to a leader.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LeaderMobility {
    /// 1/m along each axis; 0 where a constraint says how it moves.
    inverse_mass: [f64; 3],
    /// 1/m if nothing held it.
    free: f64,
}

impl Joints {
    /// The joints of a model of which any node is one of some contact nodes, by their numbers in the mesh, ascending.
    pub fn of(mesh: &Mesh, model: &Model, body: &Body, contact_nodes: &[u32]) -> Option<Joints> {
        let followers = &body.tied.followers;
        let leaders = body.tied.leaders();
        let place = |node: u32| leaders.partition_point(|&other| other < node) as u32;
        let mut all: Vec<(u32, Vec<(u32, f64)>)> = followers
            .iter()
            .map(|one| (one.node, one.leaders.iter().map(|(node, weight)| (place(*node), *weight)).collect()))
            .chain(leaders.iter().map(|&node| (node, vec![(place(node), 1.0)])))
            .collect();
        all.sort_unstable_by_key(|(node, _)| *node);
        if all.iter().all(|(node, _)| contact_nodes.binary_search(node).is_err()) {
            return None;
        }
        let held = held_nodes(mesh, model);
        let mobility = |&node: &u32| {
            let free = 1.0 / body.node_mass[node as usize];
            let along = |held: &Vec<u32>| if held.binary_search(&node).is_ok() { 0.0 } else { free };
            LeaderMobility { inverse_mass: held.each_ref().map(along), free }
        };
        let leaders: Vec<LeaderMobility> = leaders.iter().map(mobility).collect();
        let (nodes, carriers): (Vec<u32>, Vec<Vec<(u32, f64)>>) = all.into_iter().unzip();
        let alone = |carriers: &Vec<(u32, f64)>| {
            carriers.iter().map(|&(leader, w)| w * w * leaders[leader as usize].free).sum()
        };
        Some(Joints { nodes, free: carriers.iter().map(alone).collect(), carriers, leaders })
    }

    /// Whether there are any, also where none of their nodes is a point of this rank.
    pub fn are_there(&self) -> bool {
        !self.nodes.is_empty()
    }

    /// Place among the nodes of joints of a node of the mesh, or [`u32::MAX`].
    pub fn place(&self, node: u32) -> u32 {
        self.nodes.binary_search(&node).map_or(ABSENT, |place| place as u32)
    }

    /// 1/m along each axis of a node of a joint, by its place, as a force on it alone sees it.
    pub fn inverse_mass(&self, place: u32) -> [f64; 3] {
        let parts = self.carriers[place as usize].iter();
        parts.fold([0.0; 3], |sum, &(leader, w)| add(sum, scaled(self.leaders[leader as usize].inverse_mass, w * w)))
    }
}

/// Sums of forces and loads at the leaders that a step's constraints push, while these are gone through.
#[derive(Debug, Clone, Default)]
pub struct JointSums {
    /// Place of each leader among those that are pushed, or [`ABSENT`].
    slots: Vec<u32>,
    sums: Vec<ExactSum>,
}

impl JointSums {
    /// Finds the leaders that the constraints of any rank may push. All ranks call it.
    pub fn begin(&mut self, iterates: &Iterates, motion: &NodeMotion, others: &mut dyn OtherRanks) {
        let mobility = &motion.mobility;
        let mut pushed = vec![false; mobility.joints.leaders.len()];
        for own in iterates.normal.iter().filter(|own| own.own) {
            for (carriers, _) in parts(own.members, own.weights, own.count, motion) {
                carriers.iter().for_each(|&(leader, _)| pushed[leader as usize] = true);
            }
        }
        if others.are_there() {
            let mut counts = vec![ExactSum::new(); pushed.len()];
            counts.iter_mut().zip(&pushed).filter(|(_, pushed)| **pushed).for_each(|(count, _)| count.add(1.0));
            others.merge(&mut counts);
            pushed.iter_mut().zip(&counts).for_each(|(pushed, count)| *pushed = count.value() > 0.0);
        }
        let mut count = 0;
        self.slots.clear();
        self.slots.extend(pushed.iter().map(|&pushed| {
            let slot = if pushed { count } else { ABSENT };
            count += u32::from(pushed);
            slot
        }));
        self.sums.resize(SUMS * count as usize, ExactSum::new());
    }

    /// Sums forces and loads of all active constraints at the leaders, and lets these points answer as their joints do.
    pub fn answer(
        &mut self,
        (points, iterates): (&[u32], &Iterates),
        motion: &NodeMotion,
        kick: f64,
        responses: &mut [Response],
        others: &mut dyn OtherRanks,
    ) {
        self.add(iterates, motion);
        others.merge(&mut self.sums);
        let mobility = &motion.mobility;
        for &point in points {
            let Some(place) = mobility.joint(point as usize) else { continue };
            responses[point as usize] = self.response(&mobility.joints, place, kick);
        }
    }

    fn add(&mut self, iterates: &Iterates, motion: &NodeMotion) {
        self.sums.fill(ExactSum::new());
        for (i, own) in iterates.normal.iter().enumerate().filter(|(_, own)| own.own && own.active) {
            let force = iterates.force(i);
            for (carriers, w) in parts(own.members, own.weights, own.count, motion) {
                for &(leader, share) in carriers {
                    let sums = &mut self.sums[SUMS * self.slots[leader as usize] as usize..][..SUMS];
                    sums.iter_mut().zip(force).for_each(|(sum, part)| sum.add(w * share * part));
                    sums[SUMS - 1].add((w * share).abs() * own.strength);
                }
            }
        }
    }

    /// What all forces do to a node of a joint, and the load that constraints of its own would have to share its mass with to be
    /// as soft as with all those that push its leaders.
    fn response(&self, joints: &Joints, place: u32, kick: f64) -> Response {
        let (mut velocity_change, mut shared) = ([0.0; 3], 0.0);
        for &(leader, w) in &joints.carriers[place as usize] {
            let LeaderMobility { inverse_mass, free } = joints.leaders[leader as usize];
            let slot = self.slots[leader as usize];
            if slot != ABSENT {
                let sums = &self.sums[SUMS * slot as usize..][..SUMS];
                let of = |i: usize| w * (kick * (sums[i].value() * inverse_mass[i]));
                velocity_change = add(velocity_change, [of(0), of(1), of(2)]);
                shared += w.abs() * sums[SUMS - 1].value() * free;
            }
        }
        let alone = joints.free[place as usize];
        Response { velocity_change, load: if alone > 0.0 { shared / alone } else { 0.0 } }
    }
}

/// Leaders of those members of a constraint that are nodes of joints, each with the member's weight.
fn parts<const N: usize>(
    members: [u32; N],
    weights: [f64; N],
    count: u8,
    motion: &NodeMotion,
) -> impl Iterator<Item = (&[(u32, f64)], f64)> {
    let mobility = &motion.mobility;
    let all = members.into_iter().zip(weights).take(count.into());
    all.filter_map(|(point, w)| Some((&mobility.joints.carriers[mobility.joint(point as usize)? as usize][..], w)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two followers of one leader: pushed together they move it, and each other, twice as far as one alone.
    #[test]
    fn followers_move_each_other() {
        let leader = LeaderMobility { inverse_mass: [0.5, 0.5, 0.0], free: 0.5 };
        let joints = Joints {
            nodes: vec![3, 4, 7],
            carriers: vec![vec![(0, 1.0)], vec![(0, 0.5)], vec![(0, 0.5)]],
            free: vec![0.5, 0.125, 0.125],
            leaders: vec![leader],
        };
        let mut sums = JointSums { slots: vec![0], sums: vec![ExactSum::new(); SUMS] };
        for _ in 0..2 {
            sums.sums[0].add(0.5 * 8.0);
            sums.sums[2].add(0.5 * 8.0);
            sums.sums[SUMS - 1].add(0.5 * 3.0);
        }
        // The leader's mass is 2: 8 N s on it make 4 m/s, half of it at a follower; along z it is held.
        let follower = sums.response(&joints, joints.place(7), 1.0);
        assert_eq!(follower.velocity_change, [2.0, 0.0, 0.0]);
        assert_eq!(sums.response(&joints, joints.place(3), 1.0).velocity_change, [4.0, 0.0, 0.0]);
        // Its softness alone is 1/8, with both 1/2 · 3 · 1/2 over 3 times that.
        assert_eq!(follower.load * joints.inverse_mass(joints.place(7))[0], 0.5 * 3.0 * 0.5);
        assert_eq!((joints.place(5), joints.inverse_mass(joints.place(7))), (ABSENT, [0.125, 0.125, 0.0]));
    }
}
