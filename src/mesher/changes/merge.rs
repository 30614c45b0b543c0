//! MERGE: nodes of different parts that coincide become one.

use crate::common::disjoint_sets::DisjointSets;
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

    #[test]
    fn only_nodes_of_different_parts_become_one() {
        let coordinates = [[0.0; 3], [1e-9, 0.0, 0.0], [0.0, -1e-9, 0.0], [1.0, 0.0, 0.0], [1.0, 1e-9, 1e-9]];
        let becomes = representatives(&coordinates, &[0..2, 2..4, 4..5], 1e-6);
        assert_eq!(becomes, [0, 0, 0, 3, 3]);
        let apart = representatives(&coordinates, &[0..2, 2..4, 4..5], 1e-10);
        assert_eq!(apart, [0, 1, 2, 3, 4]);
    }
}
