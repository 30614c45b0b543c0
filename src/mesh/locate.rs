//! Which element a point lies in.

use super::{Mesh, Shape, plane};
use crate::common::vector::{add, cross, dot, subtract};

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
    let mut corners: Vec<[f64; 3]> = Vec::new();
    for (element, (shape, nodes)) in mesh.shaped().enumerate() {
        corners.clear();
        corners.extend(nodes.iter().map(|&node| mesh.coordinates[node as usize]));
        let outside = distance(shape, &corners, point);
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

/// How far a point is outside of an element, as a fraction of its size.
fn distance(shape: Shape, corners: &[[f64; 3]], point: [f64; 3]) -> f64 {
    let sum = corners.iter().fold([0.0; 3], |sum, corner| add(sum, *corner));
    let centre = sum.map(|sum| sum / corners.len() as f64);
    if let (Shape::Plane, Ok(corners)) = (shape, corners.try_into()) {
        plane::outside(corners, point)
    } else if shape.dimension() == 3 {
        outside_of_faces(shape, corners, centre, point)
    } else if shape.is_surface() {
        beside(corners, centre, point)
    } else {
        beyond(corners, centre, point)
    }
}

/// Part of its size by which a surface or a bar may lie beside a point that is in it: the mesh does not know how thick it is, and of what is
/// curved it has flat pieces.
const THICK: f64 = 0.05;

/// How far a point is beyond the edges of a surface or away from it, as a fraction of its size; not above 0 in it.
fn beside(corners: &[[f64; 3]], centre: [f64; 3], point: [f64; 3]) -> f64 {
    let around = |i: usize| subtract(corners[i % corners.len()], centre);
    let count = corners.len();
    let normal = (0..count).fold([0.0; 3], |sum, i| add(sum, cross(around(i), around(i + 1))));
    let offset = subtract(point, centre);
    let beyond_edge = |i: usize| {
        let outwards = cross(subtract(around(i + 1), around(i)), normal);
        dot(subtract(offset, around(i)), outwards) / dot(around(i), outwards)
    };
    let square = dot(normal, normal);
    // Twice the area, and the size is the root of the area.
    let away = (dot(offset, normal).abs() / square.sqrt()) / (0.5 * square.sqrt()).sqrt() - THICK;
    let outside = (0..count).map(beyond_edge).fold(away, f64::max);
    if outside.is_nan() { f64::INFINITY } else { outside }
}

/// The largest distance of a point outside of a face's plane, over the distance of that plane from the centre.
fn outside_of_faces(shape: Shape, corners: &[[f64; 3]], centre: [f64; 3], point: [f64; 3]) -> f64 {
    shape.faces().iter().fold(f64::NEG_INFINITY, |most, side| {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i: usize| corners[side[i.min(side.len() - 1)]]);
        let normal = cross(subtract(c, a), subtract(d, b));
        let face = side.iter().fold([0.0; 3], |sum, &corner| add(sum, corners[corner])).map(|x| x / side.len() as f64);
        let depth = dot(normal, subtract(face, centre));
        let out = dot(normal, subtract(point, face)) / depth;
        if depth > 0.0 { most.max(out) } else { f64::INFINITY }
    })
}

/// How far a point is beyond the ends of a bar or away from it, as fractions of half its length and of its length; not above 0 on it. What has no length
/// holds nothing.
fn beyond(corners: &[[f64; 3]], centre: [f64; 3], point: [f64; 3]) -> f64 {
    let [first, second] = *corners else { return f64::INFINITY };
    let (axis, offset) = (subtract(second, first), subtract(point, centre));
    let square = dot(axis, axis);
    let along = dot(offset, axis) / square;
    let aside = subtract(offset, axis.map(|x| along * x));
    let away = (dot(aside, aside) / square).sqrt() - THICK;
    let outside = away.max(2.0 * along.abs() - 1.0);
    if outside.is_nan() { f64::INFINITY } else { outside }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesher;

    #[test]
    fn points_are_found_inside_on_faces_and_near() {
        let mesh = mesher::make("BOX, 1, 0, 0, 0, 2, 3, 4, 2, 3, 4\nROTATE, 1, Z, 30.\n", "t", 1).expect("a mesh");
        for (element, (_, nodes)) in mesh.elements().enumerate() {
            let corners: Vec<[f64; 3]> = nodes.iter().map(|&node| mesh.coordinates[node as usize]).collect();
            // A point nearer to a corner than to the centre.
            let centre = crate::solver::centroid(&corners);
            let point = [0, 1, 2].map(|i| 0.2 * centre[i] + 0.8 * corners[6][i]);
            assert_eq!(locate(&mesh, point), Some(Located { element: element as u32, outside: 0.0 }));
        }
        // On the face between elements 0 and 1, the first of them.
        let shared: Vec<[f64; 3]> = [1, 2, 5, 6].map(|c| mesh.coordinates[mesh.blocks[0].nodes[c] as usize]).to_vec();
        let point = [0, 1, 2].map(|i| shared.iter().map(|x| x[i]).sum::<f64>() / 4.0);
        assert_eq!(locate(&mesh, point).map(|l| l.element), Some(0));
        // Half an element, which is its whole distance from centre to face, above the top.
        let above = locate(&mesh, [0.0, 0.0, 4.5]).expect("the nearest");
        assert!((above.outside - 1.0).abs() < 1e-12, "{above:?}");
        assert_eq!(locate(&Mesh::default(), [0.0; 3]), None);
    }

    #[test]
    fn points_are_found_in_surfaces() {
        let recipe = "SHEET, 1, 0, 0, 0, 2, 3, 0, 4, 3\nSHEET, 2, 0, 0, 1, 2, 3, 0, 4, 3\n";
        let mesh = mesher::make(recipe, "t", 1).expect("a mesh");
        for (element, (_, nodes)) in mesh.elements().enumerate() {
            let corners: Vec<[f64; 3]> = nodes.iter().map(|&node| mesh.coordinates[node as usize]).collect();
            let centre = crate::solver::centroid(&corners);
            // Near a corner, and a little above.
            let mut point = [0, 1, 2].map(|i| 0.2 * centre[i] + 0.8 * corners[2][i]);
            point[2] += 0.03;
            assert_eq!(locate(&mesh, point), Some(Located { element: element as u32, outside: 0.0 }));
        }
        let nearest = locate(&mesh, [0.1, 0.1, 0.3]).expect("the nearest");
        assert!(nearest.element == 0 && nearest.outside > 0.1, "{nearest:?}");
    }
    #[test]
    fn points_are_found_on_bars() {
        let mesh = mesher::make("LINE, 1, 0., 0., 0., 4., 0., 3., 2\n", "t", 1).expect("a mesh");
        // Two bars of 2.5 from the origin to (4, 0, 3): on the second, a fiftieth of it aside, and where both meet.
        for (place, aside, element) in [(0.7, 0.0, 1), (0.7, 0.05, 1), (1.0, 0.0, 1), (0.5, 0.0, 0), (0.1, -0.05, 0)] {
            let located = locate(&mesh, [4.0 * place, aside, 3.0 * place]);
            assert_eq!(located, Some(Located { element, outside: 0.0 }), "{place}, {aside}");
        }
        // A bar's length aside, and as far beyond the end.
        let outside = |point: [f64; 3]| locate(&mesh, point).map_or(f64::NAN, |located| located.outside);
        assert!((outside([1.0, 2.5, 0.75]) - 0.95).abs() < 1e-12);
        assert!((outside([6.0, 0.0, 4.5]) - 2.0).abs() < 1e-12);
    }
}
