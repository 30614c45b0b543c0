//! Beams and shells that solids, and what else holds them, leave free to turn about a point or a line.

use super::{Kind, Loose, Scene};
use crate::common::disjoint_sets::DisjointSets;
use crate::mesh::{Block, Shape};
use std::collections::{BTreeMap, BTreeSet};

const HELP: &str = "carry beams on into the solid through several nodes, lay shells on its face, or make a RIGID BODY of what is around the \
                    joint; against turning about a line only nodes aside of it help. A hinge that is meant can stay";

/// Parts of the mesh that hang together by elements whose nodes turn, as sets of nodes.
fn parts(scene: &Scene) -> DisjointSets {
    let mut parts = DisjointSets::new(scene.at.len());
    for nodes in scene.blocks(Kind::Turns).flat_map(Block::elements) {
        nodes.windows(2).for_each(|pair| parts.join(pair[0], pair[1]));
    }
    parts
}

/// All hinges, those of parts of the same blocks together.
pub(super) fn find(scene: &Scene) -> Vec<Loose> {
    if !scene.mesh.blocks.iter().any(|block| block.shape == Shape::Hexahedron)
        || scene.blocks(Kind::Turns).next().is_none()
    {
        return Vec::new();
    }
    let mut parts = parts(scene);
    let holds = (0u32..).zip(&scene.at).filter(|(_, at)| at.turns && (at.solid || at.is_placed() || at.rotation));
    let mut holds: Vec<(u32, u32)> = holds.map(|(node, _)| (parts.least(node), node)).collect();
    holds.sort_unstable();
    let mut hinges: BTreeMap<u32, [u32; 2]> = BTreeMap::new();
    for part in holds.chunk_by(|one, other| one.0 == other.0) {
        let nodes: Vec<u32> = part.iter().map(|(_, node)| *node).collect();
        if nodes.iter().any(|&node| scene.at(node).solid) && !nodes.iter().any(|&node| scene.at(node).rotation) {
            hinges.extend(scene.line(&nodes).map(|ends| (part[0].0, ends)));
        }
    }
    told(scene, &mut parts, &hinges)
}

/// Hinges by the ends of their lines, once for all parts of the same blocks.
fn told(scene: &Scene, parts: &mut DisjointSets, hinges: &BTreeMap<u32, [u32; 2]>) -> Vec<Loose> {
    if hinges.is_empty() {
        return Vec::new();
    }
    let mut blocks_of: BTreeMap<u32, BTreeSet<i64>> = BTreeMap::new();
    for block in scene.blocks(Kind::Turns) {
        for root in block.elements().map(|nodes| parts.least(nodes[0])).filter(|root| hinges.contains_key(root)) {
            blocks_of.entry(root).or_default().insert(block.id);
        }
    }
    let mut alike: BTreeMap<Vec<i64>, Vec<[u32; 2]>> = BTreeMap::new();
    for (root, blocks) in blocks_of {
        alike.entry(blocks.into_iter().collect()).or_default().extend(hinges.get(&root));
    }
    let told = |(blocks, hinges): (&Vec<i64>, &Vec<[u32; 2]>)| {
        let [first, last] = hinges.first()?.map(|node| scene.told(node));
        let how = if first == last {
            format!("hinged to solids by {first}, the only one that holds them")
        } else {
            format!(
                "held by solids, or nodes that are held, in one line only and turn freely about it, from {first} to {last}"
            )
        };
        let more = if hinges.len() > 1 { format!(", and so in {} places in all", hinges.len()) } else { String::new() };
        let who = super::blocks(blocks);
        let what =
            format!("beams or shells of {who} are {how}{more}: nodes of solids have no rotation and carry no moment");
        Some(Loose { what, help: HELP })
    };
    alike.iter().filter_map(told).collect()
}
