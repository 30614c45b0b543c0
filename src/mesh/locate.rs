//! Which element a point lies in.

use super::{HEX_SIDES, Mesh};

/// An element that holds a point, or is nearest to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Located {
    /// Zero-based element.
    pub element: u32,
    /// How far the point is outside of the planes of the element's faces, as a fraction of its size; 0 or less inside.
    pub outside: f64,
}

/// The element that a point lies in. A face counts as the plane through its centre across its mean normal, so between
/// warped faces the answer may be the neighbour. On a common face it is the element that comes first in the mesh.
/// Outside the mesh it is the element whose farthest violated face is nearest. `None` for a mesh without elements.
pub fn locate(mesh: &Mesh, point: [f64; 3]) -> Option<Located> {
    let mut best: Option<Located> = None;
    for (element, (_, nodes)) in mesh.elements().enumerate() {
        let corners = nodes.map(|node| mesh.coordinates[node as usize]);
        let outside = distance(&corners, point);
        // Round-off must not make the neighbour of a common face the nearer one.
        let inside = outside <= ROUND_OFF;
        let outside = if inside { 0.0 } else { outside };
        if best.is_none_or(|best| outside < best.outside) {
            best = Some(Located { element: element as u32, outside });
        }
        if inside {
            break;
        }
    }
    best
}

/// Points on a face are inside, up to this fraction of the element's size.
const ROUND_OFF: f64 = 1e-9;

/// The largest distance of a point outside of a face's plane, over the distance of that plane from the centre.
fn distance(corners: &[[f64; 3]; 8], point: [f64; 3]) -> f64 {
    let mean = |places: &[usize]| -> [f64; 3] {
        [0, 1, 2].map(|i| places.iter().map(|&p| corners[p][i]).sum::<f64>() / places.len() as f64)
    };
    let centre = mean(&[0, 1, 2, 3, 4, 5, 6, 7]);
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    HEX_SIDES.iter().fold(f64::NEG_INFINITY, |most, side| {
        let (a, b) = (minus(corners[side[2]], corners[side[0]]), minus(corners[side[3]], corners[side[1]]));
        let normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let face = mean(side);
        let depth = dot(normal, minus(face, centre));
        let out = dot(normal, minus(point, face)) / depth;
        if depth > 0.0 { most.max(out) } else { f64::INFINITY }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesher;

    #[test]
    fn points_are_found_inside_on_faces_and_near() {
        let mesh = mesher::make("BOX, 1, 0, 0, 0, 2, 3, 4, 2, 3, 4\nROTATE, 1, Z, 30.\n", "t", 1).expect("a mesh");
        for (element, (_, nodes)) in mesh.elements().enumerate() {
            let corners = nodes.map(|node| mesh.coordinates[node as usize]);
            // A point nearer to a corner than to the centre.
            let centre = crate::solver::centroid(&corners);
            let point = [0, 1, 2].map(|i| 0.2 * centre[i] + 0.8 * corners[6][i]);
            assert_eq!(locate(&mesh, point), Some(Located { element: element as u32, outside: 0.0 }));
        }
        // On the face between elements 0 and 1, the first of them.
        let shared: Vec<[f64; 3]> =
            [1, 2, 5, 6].map(|c| mesh.coordinates[mesh.blocks[0].connectivity[0][c] as usize]).to_vec();
        let point = [0, 1, 2].map(|i| shared.iter().map(|x| x[i]).sum::<f64>() / 4.0);
        assert_eq!(locate(&mesh, point).map(|l| l.element), Some(0));
        // Half an element, which is its whole distance from centre to face, above the top.
        let above = locate(&mesh, [0.0, 0.0, 4.5]).expect("the nearest");
        assert!((above.outside - 1.0).abs() < 1e-12, "{above:?}");
        assert_eq!(locate(&Mesh::default(), [0.0; 3]), None);
    }
}
