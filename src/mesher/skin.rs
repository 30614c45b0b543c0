//! Faces on the outside of a mesh: those that belong to one element only.

use super::body::Sides;
use crate::mesh::{HEX_SIDES, Mesh};

/// The exterior faces among those whose four nodes `keep` accepts, in the order of the elements.
///
/// Both elements at an interior face name the same four nodes, so that a selection by nodes finds a face on both
/// sides or on neither, and never takes an interior face for an exterior one.
pub fn exterior(mesh: &Mesh, keep: impl Fn(&[u32; 4]) -> bool) -> Sides {
    let mut faces: Vec<([u32; 4], u32, u8)> = Vec::new();
    for ((_, hex), element) in mesh.elements().zip(0..) {
        for (corners, side) in HEX_SIDES.iter().zip(0..) {
            let mut nodes = corners.map(|corner| hex[corner]);
            if keep(&nodes) {
                nodes.sort_unstable();
                faces.push((nodes, element, side));
            }
        }
    }
    faces.sort_unstable();
    let mut sides: Sides = faces
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|same| same.len() == 1)
        .flat_map(|same| same.iter().map(|&(_, element, side)| (element, side)))
        .collect();
    sides.sort_unstable();
    sides
}

/// The four nodes of a face, counter-clockwise seen from outside.
pub fn nodes(hex: &[u32; 8], side: u8) -> [u32; 4] {
    HEX_SIDES[usize::from(side) % 6].map(|corner| hex[corner])
}

/// The nodes of all elements, to be looked up by element.
pub fn hexes(mesh: &Mesh) -> Vec<&[u32; 8]> {
    mesh.elements().map(|(_, hex)| hex).collect()
}
