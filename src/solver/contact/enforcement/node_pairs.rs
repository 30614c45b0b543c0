//! Nodes that lie on nodes: two contacts join the same two nodes, one each way, and nearly say the same.
//!
//! Where meshes match, node a is held by a face of node b and node b by a face of node a, each with most of the weight. In the middle of
//! flat faces both agree. Wherever velocities change from node to node they do not: the one closes its gap with a force that leaves the other
//! open, and iterations that give each its share of the masses hand the force over by no more than the small disagreement in each of them,
//! in hundreds. One of two is enough, so that one of two *yields* to the other: that with the larger gap at the end of the step before. It takes no
//! force until the rest has settled, or a quarter of the iterations is used up. Then it sees to it that nothing is open to it: the other may be gone.
//! Where it has become the deeper one by little it leaves that to the next step, in which the other yields to it.

use super::constraint::{Constraint, Origin};
use super::enforcer::Enforcer;
use crate::common::vector::dot;

/// A foot that has at least this part of its weight at one corner is on that node. Where it has less, the force of one of two contacts that take turns
/// shakes the nodes around: at a half the column at rest and the patch test were torn apart.
const ON_NODE: f64 = 0.85;

/// What yields leaves so many times what iterations that settle leave alone, and no more than a part of the farthest motion of a contact in the step.
const LEFT_BY_YIELDING: f64 = 16.0;
/// See [`LEFT_BY_YIELDING`].
const LEFT_OF_TRAVEL: f64 = 0.03;

/// Cosine of the angle between the normals of two contacts that say the same. At the ridges of round bodies one of them alone would push its node
/// aside.
const OPPOSITE: f64 = -0.999;

/// No constraint.
const NONE: u32 = u32::MAX;

/// The other member of a constraint of a node that lies on a node.
fn node_below(c: &Constraint) -> Option<u32> {
    let is_face = matches!(c.origin, Origin::Face(..));
    let corner = (1..c.count).find(|&i| c.weights[i] <= -ON_NODE).filter(|_| is_face);
    corner.map(|i| c.members[i])
}

/// How deep what yields may be for the rest of the step, a length: by a `tolerance` of so many face sizes, where the farthest motion of a contact in
/// the step is `travel`.
pub(super) fn left_by_yielding(size: f64, tolerance: f64, travel: f64) -> f64 {
    (LEFT_BY_YIELDING * tolerance * size).min(LEFT_OF_TRAVEL * travel)
}

impl Enforcer {
    /// Finds which of the constraints yield at first in the next step, once all forces are known. `left` is how far iterations that have settled may
    /// still move a constraint of a size, both lengths. All ranks that own a member of one of two constraints have both, with the same bits, and
    /// decide alike.
    pub(super) fn find_yielding(&mut self, constraints: &[Constraint], drift: f64, left: impl Fn(f64) -> f64) {
        let mut on_nodes = std::mem::take(&mut self.on_nodes);
        on_nodes.clear();
        on_nodes.extend((0u32..).zip(constraints).filter(|(_, c)| node_below(c).is_some()).map(|(i, _)| i));
        self.first_of_node.resize(self.responses.len(), NONE);
        let node = |i: u32| constraints[i as usize].members[0] as usize;
        on_nodes.iter().rev().for_each(|&i| self.first_of_node[node(i)] = i);
        for i in on_nodes.iter().map(|&i| i as usize) {
            let partner = self.partner(constraints, i).filter(|_| self.states[i].own);
            let yields = partner.is_some_and(|j| self.yields_to(constraints, [i, j], drift, &left));
            self.states[i].yields = yields;
        }
        on_nodes.iter().for_each(|&i| self.first_of_node[node(i)] = NONE);
        self.on_nodes = on_nodes;
    }

    /// The constraint of the node below back onto the node of a constraint, if the two have only each other.
    fn partner(&self, constraints: &[Constraint], i: usize) -> Option<usize> {
        let j = self.backwards(constraints, i)?;
        (self.backwards(constraints, j)? == i).then_some(j)
    }

    /// The first constraint of the node on which the node of the `i`-th lies, back onto that and the other way.
    fn backwards(&self, constraints: &[Constraint], i: usize) -> Option<usize> {
        let c = &constraints[i];
        let below = node_below(c)?;
        let first = *self.first_of_node.get(below as usize)? as usize;
        let of_node = constraints.get(first..)?.iter().take_while(|other| other.members[0] == below);
        let is_back =
            |other: &Constraint| node_below(other) == Some(c.members[0]) && dot(other.normal, c.normal) < OPPOSITE;
        of_node.zip(first..).find(|(other, _)| is_back(other)).map(|(_, j)| j)
    }

    /// Whether the first of two constraints of the same nodes yields to the second.
    fn yields_to(&self, constraints: &[Constraint], pair: [usize; 2], drift: f64, left: impl Fn(f64) -> f64) -> bool {
        if pair.iter().all(|&i| constraints[i].carried.normal_force == 0.0) {
            return false;
        }
        let [own, other] = pair.map(|i| {
            let c = &constraints[i];
            self.states[i].closing + drift * dot(c.velocity_change(&self.responses), c.normal)
        });
        let left = pair.iter().fold(f64::INFINITY, |least, &i| least.min(left(constraints[i].size)));
        if (own - other).abs() > left {
            return own > other;
        }
        // Where they agree the same one goes on, and of two that meet anew the one that comes later.
        let [has_yielded, has_other] = pair.map(|i| constraints[i].yields);
        let [origin, of_other] = pair.map(|i| constraints[i].origin);
        if has_yielded == has_other { origin > of_other } else { has_yielded }
    }
}
