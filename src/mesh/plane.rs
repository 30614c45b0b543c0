//! Geometry of four-node elements of a two-dimensional mesh, in the plane and turned about the y axis.
//!
//! All is per radian of a body of revolution, x its radius, or per unit of thickness.

use super::check::{Problem, short};
use super::{Coordinates, Mesh};

/// Positions of the four corners, of which x and y count.
pub type Corners = [[f64; 3]; 4];

/// Area of a quadrilateral, length²; positive when its corners turn counter-clockwise.
pub fn area(corners: &Corners) -> f64 {
    let [a, b] = [[0, 2], [1, 3]].map(|[i, j]: [usize; 2]| [0, 1].map(|k: usize| corners[j][k] - corners[i][k]));
    0.5 * (a[0] * b[1] - a[1] * b[0])
}

/// Length that a wave takes a stable step for, A/√(B:B) with B = ∂A/∂x: (1/a² + 1/b²)^-½ in a rectangle.
pub fn wave_length(corners: &Corners) -> f64 {
    let square = |i: usize| {
        let (a, b) = (corners[(i + 3) % 4], corners[(i + 1) % 4]);
        0.25 * ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]))
    };
    area(corners) / (0..4).map(square).sum::<f64>().sqrt()
}

/// Volume that a quadrilateral sweeps per radian about the y axis, ∫ x dA, length³ (Pappus; exact).
pub fn swept(corners: &Corners) -> f64 {
    let of_edge = |i: usize| {
        let ([a, b], [c, d]) = ([corners[i][0], corners[i][1]], [corners[(i + 1) % 4][0], corners[(i + 1) % 4][1]]);
        (a * a + a * c + c * c) * (d - b)
    };
    (0..4).map(of_edge).sum::<f64>() / 6.0
}

/// The part of an element's mass that belongs to each corner.
///
/// A quarter each in a quadrilateral of plane strain, however it is distorted, as in the hexahedron. In a triangle, and about
/// the axis, ∫ N_I dm / m by 2 × 2 points, which is exact: a quarter would move the centre of mass, and a node on the axis
/// would have too much.
pub fn mass_shares(nodes: &[u32; 4], corners: &Corners, about_axis: bool) -> [f64; 4] {
    if !about_axis && !is_triangle(nodes) {
        return [0.25; 4];
    }
    let (mut shares, mut sum) = ([0.0; 4], 0.0);
    for point in SIGNS {
        let [xi, eta] = point.map(|sign| sign / 3f64.sqrt());
        let weights = SIGNS.map(|[a, b]| 0.25 * (1.0 + a * xi) * (1.0 + b * eta));
        let slopes = SIGNS.map(|[a, b]| [0.25 * a * (1.0 + b * eta), 0.25 * b * (1.0 + a * xi)]);
        let along =
            |direction: usize, axis: usize| (0..4).map(|i| slopes[i][direction] * corners[i][axis]).sum::<f64>();
        let jacobian = along(0, 0) * along(1, 1) - along(0, 1) * along(1, 0);
        let radius = if about_axis { (0..4).map(|i| weights[i] * corners[i][0]).sum() } else { 1.0 };
        let here = jacobian * radius;
        (0..4).for_each(|i| shares[i] += weights[i] * here);
        sum += here;
    }
    shares.map(|share| share / sum)
}

/// A node is on the axis when it is nearer to it than this part of the mesh's size.
const ON_AXIS: f64 = 1e-9;

/// Positions of a mesh that is turned about the y axis: what is on the axis up to round-off is on it.
pub fn on_axis(mesh: &Mesh) -> Coordinates {
    let size = mesh.coordinates.iter().fold(0.0, |most, x| f64::max(most, x[0].abs()));
    let snapped = |&[x, y, z]: &[f64; 3]| [if x.abs() <= ON_AXIS * size { 0.0 } else { x }, y, z];
    mesh.coordinates.iter().map(snapped).collect()
}

/// Natural coordinates of the corners.
const SIGNS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

/// Whether two neighbouring corners are one node.
pub fn is_triangle(nodes: &[u32; 4]) -> bool {
    (0..4).any(|i| nodes[i] == nodes[(i + 1) % 4])
}

/// The least Jacobian of the corners over the mean one: 1 in a parallelogram, 0 or less where a corner is flat or points
/// inwards. In a triangle of the corners that have two edges.
pub fn least_corner(nodes: &[u32; 4], corners: &Corners) -> f64 {
    let at = |i: usize| [corners[i % 4][0], corners[i % 4][1]];
    let turn = |i: usize| {
        let ([x, y], [a, b], [c, d]) = (at(i), at(i + 1), at(i + 3));
        (a - x) * (d - y) - (b - y) * (c - x)
    };
    let sharp = (0..4).filter(|&i| nodes[i] != nodes[(i + 1) % 4] && nodes[i] != nodes[(i + 3) % 4]);
    let least = sharp.map(turn).fold(f64::INFINITY, f64::min);
    let whole = area(corners).abs();
    if least.is_finite() && whole > 0.0 { least / whole } else { 1.0 }
}

/// Whether a point is inside a quadrilateral, as far out as a part of its size where it is not: the farthest distance beyond
/// an edge over that of the edge from the centre.
pub fn outside(corners: &Corners, point: [f64; 3]) -> f64 {
    let centre = [0, 1].map(|k: usize| corners.iter().map(|c| c[k]).sum::<f64>() / 4.0);
    (0..4).fold(f64::NEG_INFINITY, |most, i| {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        let normal = [b[1] - a[1], a[0] - b[0]];
        if normal == [0.0; 2] {
            return most; // The edge of a triangle that is none.
        }
        let middle = [0, 1].map(|k: usize| 0.5 * (a[k] + b[k]));
        let along = |x: f64, y: f64| normal[0] * (x - middle[0]) + normal[1] * (y - middle[1]);
        let depth = -along(centre[0], centre[1]);
        if depth > 0.0 { most.max(along(point[0], point[1]) / depth) } else { f64::INFINITY }
    })
}

/// Nodes of a solid as eight: those of an element of the plane twice.
pub fn eight(nodes: &[u32]) -> [u32; 8] {
    std::array::from_fn(|corner| nodes.get(corner % nodes.len().max(1)).copied().unwrap_or_default())
}

/// Corners of a solid: those of a hexahedron as they are, those of an element of the plane, each given twice, as a prism that
/// is as thick as the element is wide. Its first four sides are the element's edges.
pub fn solid(corners: &[[f64; 3]; 8]) -> [[f64; 3]; 8] {
    if corners[..4] != corners[4..] {
        return *corners;
    }
    let width = (0..4)
        .map(|i| (corners[i][0] - corners[(i + 2) % 4][0]).abs() + (corners[i][1] - corners[(i + 2) % 4][1]).abs());
    let half = 0.5 * width.fold(0.0, f64::max);
    std::array::from_fn(|i| [corners[i][0], corners[i][1], if i < 4 { -half } else { half }])
}

/// Why an element of a mesh, given by its nodes, cannot be computed with, if it cannot.
pub fn fault(mesh: &Mesh, nodes: &[u32; 4]) -> Option<Problem> {
    let corners = nodes.map(|node| mesh.coordinates[node as usize]);
    if nodes[0] == nodes[2] || nodes[1] == nodes[3] {
        return Some(Problem::new(
            "two opposite corners are one node",
            "a triangle is a quadrilateral whose last two nodes are one",
        ));
    }
    let area = area(&corners);
    let extent = (0..2).map(|axis| {
        let values = corners.iter().map(|c| c[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    });
    let smallest = 4.0 * f64::EPSILON * extent.fold(0.0, f64::max).powi(2);
    (area.is_nan() || area <= smallest).then(|| {
        let help = if area < -smallest {
            "its nodes must turn counter-clockwise in the x-y plane; here they turn the other way, or the mesh is mirrored"
        } else {
            "the element is flat or twisted; look at the positions and the order of its nodes"
        };
        Problem::new(format!("its area is {}, it must be positive", short(area)), help)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const BENT: Corners = [[1.0, 0.0, 0.0], [2.5, 0.25, 0.0], [2.0, 1.5, 0.0], [0.75, 1.0, 0.0]];

    #[test]
    fn volumes_and_shares_are_those_of_the_bilinear_map() {
        // A ring of rectangular section: V = A r̄ per radian.
        let ring = [[1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 0.5, 0.0], [1.0, 0.5, 0.0]];
        assert!((area(&ring) - 1.0).abs() < 1e-15 && (swept(&ring) - 2.0).abs() < 1e-15);
        // First moments of the shares are those of the body.
        let shares = mass_shares(&[0, 1, 2, 3], &ring, true);
        let radius: f64 = (0..4).map(|i| shares[i] * ring[i][0]).sum();
        assert!((radius - 26.0 / 12.0).abs() < 1e-14 && (shares[0] - shares[3]).abs() < 1e-15, "{shares:?}");
        let bent = mass_shares(&[0, 1, 2, 3], &BENT, true);
        assert!((bent.iter().sum::<f64>() - 1.0).abs() < 1e-15 && bent.iter().all(|share| *share > 0.15));
        assert_eq!(mass_shares(&[0, 1, 2, 3], &BENT, false), [0.25; 4]);
        // A triangle has a third at each node.
        let triangle = [BENT[0], BENT[1], BENT[2], BENT[2]];
        let thirds = mass_shares(&[0, 1, 2, 2], &triangle, false);
        assert!([thirds[0], thirds[1], thirds[2] + thirds[3]].iter().all(|share| (share - 1.0 / 3.0).abs() < 1e-14));
    }

    #[test]
    fn corners_and_points() {
        let nodes = [0, 1, 2, 3];
        let square = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
        assert_eq!(least_corner(&nodes, &square), 1.0);
        let mut pushed = square;
        pushed[2] = [0.9, 0.9, 0.0];
        assert!(least_corner(&nodes, &pushed) < 0.0 && area(&pushed) > 0.0);
        assert!(least_corner(&[0, 1, 2, 2], &[square[0], square[1], square[2], square[2]]) > 1.0);
        assert_eq!(outside(&square, [1.0, 1.0, 0.0]), -1.0);
        assert!((outside(&square, [1.0, 2.5, 0.0]) - 0.5).abs() < 1e-15);
    }
}
