//! MERGE: nodes of different parts that coincide become one.

use crate::common::disjoint_sets::DisjointSets;
use std::collections::BTreeSet;
use std::ops::Range;

/// For every node the node it becomes, which is itself or one with a smaller index at the same place.
///
/// Nodes coincide when all their coordinates agree to the tolerance. Only nodes of different parts are joined: within
/// a part none coincide, whatever the tolerance. The result depends on the order of the nodes alone.
pub fn representatives(coordinates: &[[f64; 3]], parts: &[Range<usize>], tolerance: f64) -> Vec<u32> {
    let grid = Grid { width: 8.0 * tolerance };
    let mut places: Vec<([i64; 3], u32, u32)> = Vec::new();
    for (part, nodes) in parts.iter().zip(0..).map(|(nodes, part)| (part, nodes.clone())) {
        places.extend(nodes.map(|node| (grid.cell(coordinates[node]), node as u32, part)));
    }
    places.sort_unstable();
    let mut joined = DisjointSets::new(coordinates.len());
    for &(_, node, part) in &places {
        let here = coordinates[node as usize];
        for cell in grid.cells_around(here, tolerance) {
            let first = places.partition_point(|place| place.0 < cell);
            for &(_, other, _) in places[first..].iter().take_while(|p| p.0 == cell).filter(|p| p.2 < part) {
                let there = coordinates[other as usize];
                if (0..3).all(|axis| (here[axis] - there[axis]).abs() <= tolerance) {
                    joined.join(node, other);
                }
            }
        }
    }
    joined.into_least()
}

/// Of the nodes that were joined, as they are now, those at which no edge of an element is common to two parts: there meshes do not match, and
/// hang together by single nodes. `edges` are those of the elements of solids and surfaces, of nodes as they were; `nodes` those of the parts.
pub fn single(becomes: &[u32], edges: impl Iterator<Item = [u32; 2]>, nodes: &[Range<usize>]) -> BTreeSet<u32> {
    let mut is_joined = vec![false; becomes.len()];
    let moved = becomes.iter().zip(0u32..).filter(|&(&becomes, node)| becomes != node);
    moved.for_each(|(&becomes, _)| is_joined[becomes as usize] = true);
    let part = |node: u32| nodes.partition_point(|range| range.end <= node as usize);
    let mut known: Vec<([u32; 2], usize)> = edges
        .filter_map(|edge| {
            let [a, b] = edge.map(|node| becomes[node as usize]);
            (is_joined[a as usize] && is_joined[b as usize]).then(|| ([a.min(b), a.max(b)], part(edge[0])))
        })
        .collect();
    known.sort_unstable();
    known.dedup();
    for same in known.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
        same[0].0.iter().for_each(|&node| is_joined[node as usize] = false);
    }
    is_joined.into_iter().zip(0..).filter_map(|(single, node)| single.then_some(node)).collect()
}

/// Space cut into cubes, a few tolerances wide so that most nodes are far from their borders.
struct Grid {
    width: f64,
}

impl Grid {
    fn cell(&self, x: [f64; 3]) -> [i64; 3] {
        x.map(|x| (x / self.width).floor() as i64)
    }

    /// The cells within the tolerance of a point.
    fn cells_around(&self, x: [f64; 3], tolerance: f64) -> impl Iterator<Item = [i64; 3]> {
        let low = self.cell(x.map(|x| x - tolerance));
        let high = self.cell(x.map(|x| x + tolerance));
        (low[0]..=high[0])
            .flat_map(move |i| (low[1]..=high[1]).flat_map(move |j| (low[2]..=high[2]).map(move |k| [i, j, k])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two parts with an edge in common, and beside it a node that is joined alone.
    #[test]
    fn nodes_without_a_common_edge_are_single() {
        let becomes = [0, 1, 2, 0, 1, 2];
        let edges = [[0, 1], [1, 2], [3, 4]];
        assert_eq!(single(&becomes, edges.into_iter(), &[0..3, 3..6]).into_iter().collect::<Vec<_>>(), [2]);
    }

    #[test]
    fn only_nodes_of_different_parts_become_one() {
        let coordinates = [[0.0; 3], [1e-9, 0.0, 0.0], [0.0, -1e-9, 0.0], [1.0, 0.0, 0.0], [1.0, 1e-9, 1e-9]];
        let becomes = representatives(&coordinates, &[0..2, 2..4, 4..5], 1e-6);
        assert_eq!(becomes, [0, 0, 0, 3, 3]);
        let apart = representatives(&coordinates, &[0..2, 2..4, 4..5], 1e-10);
        assert_eq!(apart, [0, 1, 2, 3, 4]);
    }
}
