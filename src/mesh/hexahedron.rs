//! The hexahedron, and elements with fewer corners as hexahedra some of whose corners coincide.

use super::Mesh;
use super::check::Problem;

/// Corners of a unit cube in the order of a hexahedron's nodes.
pub const UNIT_CUBE: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

/// Local nodes of the six faces of a hexahedron in EXODUS order, each turning counter-clockwise seen from outside.
pub const HEX_SIDES: [[usize; 4]; 6] =
    [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [0, 4, 7, 3], [0, 3, 2, 1], [4, 5, 6, 7]];

/// The twelve edges of a hexahedron, by its local nodes.
pub(super) const EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];

/// Less than this part of an eighth of its element's mass makes a node of a collapsed element too light: a fifth of what
/// a regular pyramid leaves its apex.
const LEAST_SHARE: f64 = 0.1;

/// What an element is in the file. In a [`Mesh`] all are hexahedra with repeated nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Eight nodes.
    Hexahedron,
    /// Six nodes: a triangle and the one above it.
    Wedge,
    /// Five nodes: a quadrilateral and the apex above it.
    Pyramid,
    /// Four nodes: a triangle and the apex above it.
    Tetrahedron,
}

impl Form {
    /// The element's own node at each corner of the hexahedron.
    pub fn corners(self) -> [usize; 8] {
        match self {
            Form::Hexahedron => [0, 1, 2, 3, 4, 5, 6, 7],
            Form::Wedge => [0, 1, 2, 2, 3, 4, 5, 5],
            Form::Pyramid => [0, 1, 2, 3, 4, 4, 4, 4],
            Form::Tetrahedron => [0, 1, 2, 2, 3, 3, 3, 3],
        }
    }

    /// Number of nodes.
    pub fn nodes(self) -> usize {
        match self {
            Form::Hexahedron => 8,
            Form::Wedge => 6,
            Form::Pyramid => 5,
            Form::Tetrahedron => 4,
        }
    }

    /// The name, as messages have it.
    pub fn name(self) -> &'static str {
        match self {
            Form::Hexahedron => "hexahedron",
            Form::Wedge => "wedge",
            Form::Pyramid => "pyramid",
            Form::Tetrahedron => "tetrahedron",
        }
    }

    /// The side of the hexahedron that each of the element's own sides, in EXODUS order, becomes.
    pub fn sides(self) -> &'static [u8] {
        match self {
            Form::Hexahedron => &[0, 1, 2, 3, 4, 5],
            Form::Wedge => &[0, 1, 3, 4, 5],
            Form::Pyramid => &[0, 1, 2, 3, 4],
            Form::Tetrahedron => &[0, 1, 3, 4],
        }
    }
}

/// What an element is by the number of its nodes that are different; what has seven counts as a hexahedron.
pub fn form(nodes: &[u32; 8]) -> Form {
    match (0..8).filter(|&corner| !nodes[..corner].contains(&nodes[corner])).count() {
        7 | 8 => Form::Hexahedron,
        6 => Form::Wedge,
        5 => Form::Pyramid,
        _ => Form::Tetrahedron,
    }
}

/// Whether some corners of an element are one node.
pub fn is_collapsed(nodes: &[u32; 8]) -> bool {
    (1..8).any(|corner| nodes[..corner].contains(&nodes[corner]))
}

/// A node that is repeated at corners which no edges of the hexahedron join through corners of that node: such an element
/// is pinched, not collapsed.
pub fn pinched_at(nodes: &[u32; 8]) -> Option<u32> {
    let joined = |a: usize, b: usize| {
        // Two corners that share two sides are ends of an edge.
        HEX_SIDES.iter().filter(|side| side.contains(&a) && side.contains(&b)).count() == 2
    };
    (0..8).map(|corner| nodes[corner]).find(|node| {
        let same: Vec<usize> = (0..8).filter(|&corner| nodes[corner] == *node).collect();
        let mut reached = vec![same[0]];
        while let Some(&next) = same.iter().find(|&&c| !reached.contains(&c) && reached.iter().any(|&r| joined(r, c))) {
            reached.push(next);
        }
        reached.len() < same.len()
    })
}

/// The part of an element's mass that belongs to each corner.
///
/// An eighth each for a hexahedron, however it is distorted. Where corners coincide that would move the centre of mass,
/// for a pyramid to half of its height. There each corner gets ∫ N_I dV / V, the row sum of the consistent mass matrix
/// (exact by 2 × 2 × 2 points): an undistorted wedge has a sixth of its mass at each node, a tetrahedron a quarter, a
/// pyramid a quarter at its apex, and the centre of mass is always where it should be.
pub fn mass_shares(nodes: &[u32; 8], corners: &[[f64; 3]; 8]) -> [f64; 8] {
    if !is_collapsed(nodes) {
        return [0.125; 8];
    }
    let near = corners.map(|c| [0, 1, 2].map(|i| c[i] - corners[0][i]));
    let (mut shares, mut volume) = ([0.0; 8], 0.0);
    for point in SIGNS {
        let at = point.map(|sign| sign / 3f64.sqrt());
        let one = |corner: [f64; 3], d: usize| 1.0 + corner[d] * at[d];
        let mut jacobian = [[0.0; 3]; 3];
        for (corner, x) in SIGNS.iter().zip(&near) {
            let [a, b, c] = [0, 1, 2].map(|d| one(*corner, d));
            let slope = [corner[0] * b * c, corner[1] * c * a, corner[2] * a * b];
            for i in 0..3 {
                for j in 0..3 {
                    jacobian[i][j] += x[i] * slope[j];
                }
            }
        }
        let density = determinant(&jacobian);
        volume += density;
        for (share, corner) in shares.iter_mut().zip(SIGNS) {
            *share += density * (0..3).map(|d| one(corner, d)).product::<f64>() / 8.0;
        }
    }
    shares.map(|share| share / volume)
}

/// The least part of a node's eighths that [`mass_shares`] leaves it with: 1 for a hexahedron, 2/3 for an undistorted
/// wedge, 1/2 for a pyramid and a tetrahedron. Frequencies are at most 1/√ of it above those with an eighth at each
/// corner, for which the stable step is bounded.
pub fn least_share(nodes: &[u32; 8], shares: &[f64; 8]) -> f64 {
    let of_node = |node: u32| {
        let own = nodes.iter().zip(shares).filter(|(other, _)| **other == node);
        let (count, sum) = own.fold((0.0, 0.0), |(count, sum), (_, share)| (count + 1.0, sum + share));
        sum * 8.0 / count
    };
    nodes.iter().map(|&node| of_node(node)).fold(f64::INFINITY, f64::min)
}

/// Why an element cannot be computed with, if it cannot.
pub(super) fn fault(mesh: &Mesh, nodes: &[u32; 8], corners: &[[f64; 3]; 8]) -> Option<Problem> {
    let volume = hexahedron_volume(corners);
    if volume <= smallest_volume(corners) || volume.is_nan() {
        let what = format!("its volume is {}, it must be positive", super::check::short(volume));
        return Some(Problem::new(what, volume_hint(mesh, nodes, corners, volume)));
    }
    if !is_collapsed(nodes) {
        return None;
    }
    if let Some(node) = pinched_at(nodes) {
        let what = format!("node {} stands at corners that no edge joins", mesh.node_ids[node as usize]);
        return Some(Problem::new(what, "only the ends of edges may be one node, as in wedges and pyramids"));
    }
    let least = least_share(nodes, &mass_shares(nodes, corners));
    (least.is_nan() || least < LEAST_SHARE).then(|| {
        Problem::new(
            "it is so distorted that one of its nodes would have hardly any of its mass",
            "give it a shape nearer to that of a regular wedge or pyramid",
        )
    })
}

/// What may be wrong with an element that has no positive volume.
fn volume_hint(mesh: &Mesh, nodes: &[u32; 8], corners: &[[f64; 3]; 8], volume: f64) -> String {
    let repeated = (1..8).find(|&i| nodes[..i].contains(&nodes[i]));
    let [a, b, c, d, e, f, g, h] = *corners;
    let upside_down = [e, f, g, h, a, b, c, d];
    match repeated {
        Some(_) if volume < 0.0 => {
            "its base must turn counter-clockwise seen from its apex, a wedge's first triangle seen from \
                                    the second"
                .into()
        }
        Some(i) => format!("node {} appears more than once among its nodes", mesh.node_ids[nodes[i] as usize]),
        None if volume < 0.0 && hexahedron_volume(&upside_down) > 0.0 => {
            "nodes 1-2-3-4 must turn counter-clockwise seen from nodes 5-6-7-8; here the two faces are exchanged \
             or the mesh is mirrored"
                .into()
        }
        None => "the element is flat or twisted; look at the positions and the order of its nodes".into(),
    }
}

/// Exact volume of the trilinear hexahedron, equal to the mean-quadrature volume of Flanagan and Belytschko (1981).
///
/// By the divergence theorem it is the sum over the six faces of the volume between the face and the first corner;
/// for a bilinear face that is the mean of the two ways to cut it into triangles.
pub fn hexahedron_volume(corners: &[[f64; 3]; 8]) -> f64 {
    let from_first = corners.map(|c| [c[0] - corners[0][0], c[1] - corners[0][1], c[2] - corners[0][2]]);
    let six_fold = |a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    let mut sum = 0.0;
    for face in &HEX_SIDES {
        let [a, b, c, d] = face.map(|i| &from_first[i]);
        sum += six_fold(a, b, c) + six_fold(a, c, d) + six_fold(a, b, d) + six_fold(b, c, d);
    }
    sum / 12.0
}

/// The volume below which an element counts as flat: round-off of the cube of its extent.
fn smallest_volume(corners: &[[f64; 3]; 8]) -> f64 {
    let extent = (0..3).map(|axis| {
        let values = corners.iter().map(|c| c[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    });
    4.0 * f64::EPSILON * extent.fold(0.0, f64::max).powi(3)
}

/// Natural coordinates of the corners, each ±1; the first four, in ξ and η, are those of a quadrilateral.
pub const SIGNS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

fn determinant(m: &[[f64; 3]; 3]) -> f64 {
    let minor = |i: usize, j: usize| m[1][i] * m[2][j] - m[1][j] * m[2][i];
    m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Corners of an element given by its own nodes.
    fn element(shape: Form, nodes: &[[f64; 3]]) -> ([u32; 8], [[f64; 3]; 8]) {
        (shape.corners().map(|n| n as u32), shape.corners().map(|n| nodes[n]))
    }

    /// Mass of each of the element's own nodes, and their centre of mass.
    fn weighed(shape: Form, nodes: &[[f64; 3]]) -> (Vec<f64>, [f64; 3]) {
        let (numbers, corners) = element(shape, nodes);
        let shares = mass_shares(&numbers, &corners);
        let mut masses = vec![0.0; shape.nodes()];
        numbers.iter().zip(shares).for_each(|(&node, share)| masses[node as usize] += share);
        let centre = [0, 1, 2].map(|i| masses.iter().zip(nodes).map(|(m, x)| m * x[i]).sum());
        (masses, centre)
    }

    fn near(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-14, "{a} is not {b}");
    }

    #[test]
    fn masses_of_undistorted_elements() {
        let wedge =
            [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.3, 0.2, 3.0], [2.3, 0.2, 3.0], [0.8, 1.2, 3.0]];
        let (masses, centre) = weighed(Form::Wedge, &wedge);
        masses.iter().for_each(|&m| near(m, 1.0 / 6.0));
        near(centre[2], 1.5);
        let pyramid = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.7, 0.1, 4.0]];
        let (masses, centre) = weighed(Form::Pyramid, &pyramid);
        masses[..4].iter().for_each(|&m| near(m, 3.0 / 16.0));
        near(masses[4], 0.25);
        near(centre[2], 1.0); // A quarter of the height.
        let tetrahedron = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.7, 0.1, 4.0]];
        let (masses, _) = weighed(Form::Tetrahedron, &tetrahedron);
        masses.iter().for_each(|&m| near(m, 0.25));
    }

    /// A truncated wedge, cut into three tetrahedra whose sides are planes: their centre of mass is known.
    #[test]
    fn centre_of_mass_of_a_tapered_wedge() {
        let t = 0.4;
        let base = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let nodes: Vec<[f64; 3]> =
            (base.iter().map(|&[x, y]| [x, y, 0.0])).chain(base.iter().map(|&[x, y]| [t * x, t * y, 1.0])).collect();
        let mut sums = [0.0; 4];
        for tet in [[0, 1, 2, 3], [1, 2, 3, 4], [2, 3, 4, 5]] {
            let [a, b, c, d] = tet.map(|n: usize| nodes[n]);
            let edge = |p: [f64; 3]| [0, 1, 2].map(|i| p[i] - a[i]);
            let volume = determinant(&[edge(b), edge(c), edge(d)]).abs() / 6.0;
            sums[3] += volume;
            (0..3).for_each(|i| sums[i] += volume * 0.25 * (a[i] + b[i] + c[i] + d[i]));
        }
        let (_, centre) = weighed(Form::Wedge, &nodes);
        (0..3).for_each(|i| near(centre[i], sums[i] / sums[3]));
    }

    #[test]
    fn what_is_left_of_the_eighths() {
        let unit = SIGNS.map(|s| s.map(|x| 0.5 * (x + 1.0)));
        for (shape, expected) in
            [(Form::Hexahedron, 1.0), (Form::Wedge, 2.0 / 3.0), (Form::Pyramid, 0.5), (Form::Tetrahedron, 0.5)]
        {
            let nodes: Vec<[f64; 3]> = match shape {
                Form::Wedge => [0, 1, 2, 4, 5, 6].map(|c| unit[c]).to_vec(),
                Form::Tetrahedron => [0, 1, 2, 4].map(|c| unit[c]).to_vec(),
                _ => unit[..shape.nodes()].to_vec(),
            };
            let (numbers, corners) = element(shape, &nodes);
            near(least_share(&numbers, &mass_shares(&numbers, &corners)), expected);
        }
    }

    #[test]
    fn the_number_of_different_nodes_tells_the_shape() {
        for shape in [Form::Hexahedron, Form::Wedge, Form::Pyramid, Form::Tetrahedron] {
            assert_eq!(form(&shape.corners().map(|n| n as u32)), shape);
        }
        assert_eq!(form(&[0, 1, 2, 2, 4, 5, 6, 7]), Form::Hexahedron);
    }

    #[test]
    fn pinched_elements_are_told_from_collapsed_ones() {
        for shape in [Form::Hexahedron, Form::Wedge, Form::Pyramid, Form::Tetrahedron] {
            assert_eq!(pinched_at(&shape.corners().map(|n| n as u32)), None);
        }
        assert_eq!(pinched_at(&[0, 1, 0, 3, 4, 5, 6, 7]), Some(0));
        assert_eq!(pinched_at(&[0, 1, 2, 3, 4, 5, 0, 7]), Some(0));
        assert_eq!(pinched_at(&[0, 1, 2, 3, 4, 5, 6, 4]), None);
    }

    /// The sides as the EXODUS manual lists them, by the elements' own nodes from 1.
    #[test]
    fn sides_have_the_nodes_that_the_format_says() {
        let wedge: [&[usize]; 5] = [&[1, 2, 5, 4], &[2, 3, 6, 5], &[1, 4, 6, 3], &[1, 3, 2], &[4, 5, 6]];
        let pyramid: [&[usize]; 5] = [&[1, 2, 5], &[2, 3, 5], &[3, 4, 5], &[1, 5, 4], &[1, 4, 3, 2]];
        let tetrahedron: [&[usize]; 4] = [&[1, 2, 4], &[2, 3, 4], &[1, 4, 3], &[1, 3, 2]];
        let shapes = [(Form::Wedge, &wedge[..]), (Form::Pyramid, &pyramid[..]), (Form::Tetrahedron, &tetrahedron[..])];
        for (shape, sides) in shapes {
            assert_eq!(shape.sides().len(), sides.len());
            for (&side, nodes) in shape.sides().iter().zip(sides) {
                let mut turn: Vec<usize> = HEX_SIDES[side as usize].map(|corner| shape.corners()[corner] + 1).to_vec();
                turn.dedup();
                if turn.first() == turn.last() {
                    turn.pop();
                }
                assert_eq!(turn.iter().collect::<BTreeSet<_>>(), nodes.iter().collect::<BTreeSet<_>>(), "{shape:?}");
                // The same sense of rotation.
                let first = turn.iter().position(|n| *n == nodes[0]).expect("it is there");
                turn.rotate_left(first);
                assert_eq!(turn, *nodes, "{shape:?}");
            }
        }
    }
}
