//! Nodes that follow and are held or driven by the deck all the same: whether what they follow does that anyhow.

use super::Follower;
use crate::mesh::Mesh;
use crate::model::{Model, MotionKind, Unknown};
use std::collections::BTreeMap;

/// Part of the largest scale by which a follower's may differ from the sum of those of its leaders: round-off of the weights.
const ROUND_OFF: f64 = 1e-9;

/// What drives a position along an axis; `None` holds it.
type Drive<'a> = Option<(MotionKind, &'a [(f64, f64)])>;

/// The scales of what the deck does to a node along an axis. One that is held has the scale 0 of everything.
type Drives<'a> = Vec<(Drive<'a>, f64)>;

/// How many of those that follow the deck holds or drives otherwise than what they follow makes them go; and the first.
pub fn against_leaders(mesh: &Mesh, model: &Model, followers: &[Follower]) -> (usize, u32) {
    let axes = drives(mesh, model);
    let against = |one: &&Follower| axes.iter().any(|nodes| is_against(nodes, one));
    let mut all = followers.iter().filter(against).map(|one| one.node);
    let first = all.next();
    (first.map_or(0, |_| 1 + all.count()), first.unwrap_or(0))
}

/// What the deck does to the position of each node that it holds or drives, by axis.
fn drives<'a>(mesh: &Mesh, model: &'a Model) -> [BTreeMap<u32, Drives<'a>>; 3] {
    let still = model.no_displacements.iter().map(|c| (c.of, c.direction, c.node_set, None, 0.0));
    let moving = model.prescribed_motions.iter().map(|c| {
        let drive = model.functions.get(c.function).map(|function| (c.kind, &function.points[..]));
        (c.of, c.direction, c.node_set, drive, c.scale)
    });
    let mut axes: [BTreeMap<u32, Drives>; 3] = Default::default();
    for (_, direction, set, drive, scale) in still.chain(moving).filter(|(of, ..)| *of == Unknown::Position) {
        for node in mesh.distinct_nodes(set) {
            let own = axes[direction.axis()].entry(node).or_default();
            // Said twice, it is done once.
            if !own.contains(&(drive, scale)) {
                own.push((drive, scale));
            }
        }
    }
    axes
}

/// Whether a follower is driven otherwise than the weighted sum of its leaders, each of which must be driven for that to be known.
fn is_against(nodes: &BTreeMap<u32, Drives>, one: &Follower) -> bool {
    let Some(own) = nodes.get(&one.node) else { return false };
    let mut left = own.clone();
    let mut most = own.iter().map(|(_, scale)| scale.abs()).fold(0.0, f64::max);
    for (leader, weight) in &one.leaders {
        let Some(theirs) = nodes.get(leader) else { return true };
        for (drive, scale) in theirs {
            most = most.max((weight * scale).abs());
            match left.iter_mut().find(|(other, _)| other == drive) {
                Some((_, sum)) => *sum -= weight * scale,
                None => left.push((*drive, -weight * scale)),
            }
        }
    }
    left.iter().any(|(_, rest)| rest.abs() > ROUND_OFF * most)
}
