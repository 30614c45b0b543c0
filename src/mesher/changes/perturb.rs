//! PERTURB: interior nodes pushed off their places, for tests that a regular mesh would pass by luck.

use crate::mesh::{Mesh, Shape};
use crate::mesher::{distance, skin};

/// Moves the interior nodes of one block, or of all blocks.
///
/// Each coordinate changes by at most `amplitude` times the shortest element edge at the node, by a number that
/// depends on the node's number and the coordinate alone. Nodes on the outside and nodes shared by blocks
/// stay, and so do ends of bars, so that the shape and the interfaces do.
pub fn perturb(mesh: &mut Mesh, block: Option<i64>, amplitude: f64) -> usize {
    let mut reach = vec![f64::INFINITY; mesh.coordinates.len()];
    for (shape, nodes) in mesh.shaped() {
        for [a, b] in shape.edges().iter().map(|ends| ends.map(|corner| nodes[corner] as usize)) {
            let length = distance(mesh.coordinates[a], mesh.coordinates[b]);
            reach[a] = reach[a].min(length);
            reach[b] = reach[b].min(length);
        }
    }
    let elements = mesh.connectivity();
    for (element, side) in skin::exterior(mesh, |_| true) {
        skin::nodes(&elements, element, side).iter().for_each(|&node| reach[node as usize] = 0.0);
    }
    for other in mesh.blocks.iter().filter(|other| block.is_some_and(|id| id != other.id)) {
        other.nodes.iter().for_each(|&node| reach[node as usize] = 0.0);
    }
    hold_between_blocks(mesh, &mut reach);
    hold_ends_of_bars(mesh, &mut reach);
    for (node, (x, reach)) in mesh.coordinates.iter_mut().zip(&reach).enumerate() {
        for (axis, x) in x.iter_mut().enumerate().take(mesh.dimension.count()) {
            *x += amplitude * reach * between_minus_one_and_one(3 * node as u64 + axis as u64);
        }
    }
    reach.iter().filter(|&&reach| reach > 0.0).count()
}

/// Nodes that blocks share stay.
fn hold_between_blocks(mesh: &Mesh, reach: &mut [f64]) {
    let mut block_at = vec![None; reach.len()];
    for (index, block) in mesh.blocks.iter().enumerate() {
        for &node in &block.nodes {
            if *block_at[node as usize].get_or_insert(index) != index {
                reach[node as usize] = 0.0;
            }
        }
    }
}

/// Ends of bars, which have no faces to be outside, stay: nodes of a single bar.
fn hold_ends_of_bars(mesh: &Mesh, reach: &mut [f64]) {
    let mut bars = vec![0u32; reach.len()];
    for block in mesh.blocks.iter().filter(|block| block.shape == Shape::Bar) {
        block.nodes.iter().for_each(|&node| bars[node as usize] += 1);
    }
    bars.iter().zip(reach).filter(|(bars, _)| **bars == 1).for_each(|(_, reach)| *reach = 0.0);
}

/// A number from −1 to 1 that looks random: the mixing steps of SplitMix64 (Steele, Lea and Flood 2014), recalled.
fn between_minus_one_and_one(seed: u64) -> f64 {
    let mut z = seed.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^= z >> 31;
    (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use crate::mesher::make;

    /// How far nodes are moved, of a recipe with and without PERTURB.
    fn moved(recipe: &str, perturb: &str) -> Vec<([f64; 3], f64)> {
        let mesh = |recipe: &str| make(recipe, "recipe", 1).unwrap_or_else(|found| panic!("{}", found.render(false)));
        let (before, after) = (mesh(recipe), mesh(&format!("{recipe}{perturb}\n")));
        let pairs = before.coordinates.iter().zip(after.coordinates.iter());
        pairs.map(|(a, b)| (*a, crate::mesher::distance(*a, *b))).collect()
    }

    /// Of two boxes of 4 x 4 x 2 elements that share a face, 9 nodes on the plane of each are inside; those of the face stay.
    #[test]
    fn nodes_between_blocks_stay() {
        let boxes = "BOX, 1, 0., 0., 0., 1., 1., 1., 4, 4, 2\nBOX, 2, 0., 0., 1., 1., 1., 1., 4, 4, 2\nMERGE\n";
        let nodes = moved(boxes, "PERTURB, 0.3");
        assert_eq!(nodes.iter().filter(|(_, by)| *by > 0.0).count(), 18);
        assert!(nodes.iter().all(|([_, _, z], by)| *by == 0.0 || *z == 0.5 || *z == 1.5));
        assert_eq!(moved(boxes, "PERTURB, 0.3, 2").iter().filter(|(_, by)| *by > 0.0).count(), 9);
    }

    #[test]
    fn ends_of_bars_stay() {
        let nodes = moved("LINE, 1, 0., 0., 0., 1., 0., 0., 5\n", "PERTURB, 0.3");
        assert!(nodes.iter().all(|([x, ..], by)| (*by == 0.0) == (*x == 0.0 || *x == 1.0)), "{nodes:?}");
    }
}
