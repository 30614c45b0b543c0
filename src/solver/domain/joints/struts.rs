//! Trusses that are pinned to other elements and that nothing holds across: struts of several pieces, which fold between their ends, and
//! those of which one end is free, which swing.

use super::{Kind, Loose, STRAIGHT, Scene};
use crate::common::disjoint_sets::DisjointSets;
use crate::common::vector::{dot, normalized, scaled, subtract};
use crate::mesh::Block;
use std::collections::{BTreeMap, BTreeSet};

const HELP: &str = "make a strut of one truss from end to end, brace it, or give it a BEAM SECTION; a cable, or a weight that swings, can stay";

/// What is loose of the trusses of one part of the mesh.
struct Mechanism {
    /// The first node that moves freely.
    first: u32,
    /// How many do.
    count: usize,
    /// The line about which all turn together, where it is that.
    about: Option<[u32; 2]>,
}

/// All mechanisms, those of parts of the same blocks together.
pub(super) fn find(scene: &Scene) -> Vec<Loose> {
    if scene.blocks(Kind::Truss).next().is_none() {
        return Vec::new();
    }
    let mut parts = DisjointSets::new(scene.at.len());
    let mut ways: BTreeMap<u32, Vec<[f64; 3]>> = BTreeMap::new();
    for ends in scene.blocks(Kind::Truss).flat_map(Block::elements) {
        parts.join(ends[0], ends[1]);
        let along = normalized(scene.between(ends[0], ends[1]));
        ends.iter().for_each(|&end| ways.entry(end).or_default().extend(along));
    }
    let mut nodes_of: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    ways.keys().for_each(|&node| nodes_of.entry(parts.least(node)).or_default().push(node));
    let mechanisms = nodes_of.iter().filter_map(|(&root, nodes)| Some((root, mechanism(scene, nodes, &ways)?)));
    let mechanisms: BTreeMap<u32, Mechanism> = mechanisms.collect();
    told(scene, &mut parts, &mechanisms)
}

/// What is loose of a part with these nodes; `ways` are the directions of the trusses at each node. Parts that are held by conditions
/// of the deck alone are pendulums and cables, and meant to be.
fn mechanism(scene: &Scene, nodes: &[u32], ways: &BTreeMap<u32, Vec<[f64; 3]>>) -> Option<Mechanism> {
    if !nodes.iter().any(|&node| scene.at(node).body) {
        return None;
    }
    let is_free = |node: &&u32| !scene.at(**node).body;
    let mut loose = nodes.iter().filter(is_free).filter(|&&node| {
        let axes = (0..3)
            .filter(|&axis| scene.at(node).place[axis])
            .map(|axis| [0, 1, 2].map(|i| f64::from(u8::from(i == axis))));
        dimensions(ways[&node].iter().copied().chain(axes)) < 3
    });
    if let Some(&first) = loose.next() {
        return Some(Mechanism { first, count: 1 + loose.count(), about: None });
    }
    // A frame that holds itself may still turn about what holds it.
    let holds: Vec<u32> = nodes.iter().copied().filter(|node| !is_free(&node) || scene.at(*node).is_placed()).collect();
    let about = scene.line(&holds)?;
    let mut turning = nodes.iter().filter(is_free).filter(|&&node| about[0] == about[1] || !scene.is_on(about, node));
    let &first = turning.next()?;
    Some(Mechanism { first, count: 1 + turning.count(), about: Some(about) })
}

/// How many dimensions directions span.
fn dimensions(directions: impl Iterator<Item = [f64; 3]>) -> usize {
    let mut base: Vec<[f64; 3]> = Vec::new();
    for direction in directions {
        let rest = base.iter().fold(direction, |rest, own| subtract(rest, scaled(*own, dot(rest, *own))));
        if dot(rest, rest).sqrt() > STRAIGHT {
            base.extend(normalized(rest));
        }
    }
    base.len()
}

/// Mechanisms once for all parts of the same blocks.
fn told(scene: &Scene, parts: &mut DisjointSets, mechanisms: &BTreeMap<u32, Mechanism>) -> Vec<Loose> {
    let mut blocks_of: BTreeMap<u32, BTreeSet<i64>> = BTreeMap::new();
    for block in scene.blocks(Kind::Truss) {
        let roots = block.elements().map(|ends| parts.least(ends[0]));
        for root in roots.filter(|root| mechanisms.contains_key(root)) {
            blocks_of.entry(root).or_default().insert(block.id);
        }
    }
    let mut alike: BTreeMap<(Vec<i64>, bool), Vec<&Mechanism>> = BTreeMap::new();
    for (root, blocks) in blocks_of {
        if let Some(found) = mechanisms.get(&root) {
            alike.entry((blocks.into_iter().collect(), found.about.is_some())).or_default().push(found);
        }
    }
    let told = |((blocks, _), found): (&(Vec<i64>, bool), &Vec<&Mechanism>)| {
        let first = found.first()?;
        let (who, node) = (super::blocks(blocks), scene.told(first.first));
        let what = match first.about {
            None => {
                let count: usize = found.iter().map(|mechanism| mechanism.count).sum();
                let more = if count > 1 { format!(" and {} more", count - 1) } else { String::new() };
                format!(
                    "trusses of {who} do not hold {node}{more} in all directions: they carry no moment, and nothing else is there"
                )
            }
            Some([one, other]) => {
                let line = if one == other {
                    scene.told(one)
                } else {
                    format!("the line from {} to {}", scene.told(one), scene.told(other))
                };
                let more =
                    if found.len() > 1 { format!(", and so in {} places in all", found.len()) } else { String::new() };
                format!("trusses of {who} turn freely about {line}, which is all that holds them{more}")
            }
        };
        Some(Loose { what, help: HELP })
    };
    alike.iter().filter_map(told).collect()
}
