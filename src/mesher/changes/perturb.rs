//! PERTURB: interior nodes pushed off their places, for tests that a regular mesh would pass by luck.

use crate::mesh::Mesh;
use crate::mesher::{distance, skin};

/// Moves the interior nodes of one block, or of all blocks.
///
/// Each coordinate changes by at most `amplitude` times the shortest element edge at the node, by a number that
/// depends on the node's number and the coordinate alone. Nodes on the outside and nodes shared with another block
/// stay, so that the shape and the interfaces do.
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
    for (node, (x, reach)) in mesh.coordinates.iter_mut().zip(&reach).enumerate() {
        for (axis, x) in x.iter_mut().enumerate().take(mesh.dimension.count()) {
            *x += amplitude * reach * between_minus_one_and_one(3 * node as u64 + axis as u64);
        }
    }
    reach.iter().filter(|&&reach| reach > 0.0).count()
}

/// A number from −1 to 1 that looks random: the mixing steps of SplitMix64 (Steele, Lea and Flood 2014), recalled.
fn between_minus_one_and_one(seed: u64) -> f64 {
    let mut z = seed.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^= z >> 31;
    (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}
