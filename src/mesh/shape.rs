//! Elements with fewer corners, as hexahedra some of whose corners coincide.

use super::HEX_SIDES;

/// What an element is in the file. In a [`Mesh`](super::Mesh) all are hexahedra with repeated nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Eight nodes.
    Hexahedron,
    /// Six nodes: a triangle and the one above it.
    Wedge,
    /// Five nodes: a quadrilateral and the apex above it.
    Pyramid,
    /// Four nodes: a triangle and the apex above it.
    Tetrahedron,
}

impl Shape {
    /// The element's own node at each corner of the hexahedron.
    pub fn corners(self) -> [usize; 8] {
        match self {
            Shape::Hexahedron => [0, 1, 2, 3, 4, 5, 6, 7],
            Shape::Wedge => [0, 1, 2, 2, 3, 4, 5, 5],
            Shape::Pyramid => [0, 1, 2, 3, 4, 4, 4, 4],
            Shape::Tetrahedron => [0, 1, 2, 2, 3, 3, 3, 3],
        }
    }

    /// Number of nodes.
    pub fn nodes(self) -> usize {
        match self {
            Shape::Hexahedron => 8,
            Shape::Wedge => 6,
            Shape::Pyramid => 5,
            Shape::Tetrahedron => 4,
        }
    }

    /// The name, as messages have it.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Hexahedron => "hexahedron",
            Shape::Wedge => "wedge",
            Shape::Pyramid => "pyramid",
            Shape::Tetrahedron => "tetrahedron",
        }
    }

    /// The side of the hexahedron that each of the element's own sides, in EXODUS order, becomes.
    pub fn sides(self) -> &'static [u8] {
        match self {
            Shape::Hexahedron => &[0, 1, 2, 3, 4, 5],
            Shape::Wedge => &[0, 1, 3, 4, 5],
            Shape::Pyramid => &[0, 1, 2, 3, 4],
            Shape::Tetrahedron => &[0, 1, 3, 4],
        }
    }
}

/// What an element is by the number of its nodes that are different; what has seven counts as a hexahedron.
pub fn kind(nodes: &[u32; 8]) -> Shape {
    match (0..8).filter(|&corner| !nodes[..corner].contains(&nodes[corner])).count() {
        7 | 8 => Shape::Hexahedron,
        6 => Shape::Wedge,
        5 => Shape::Pyramid,
        _ => Shape::Tetrahedron,
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

/// Natural coordinates of the corners.
const SIGNS: [[f64; 3]; 8] = [
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
    fn element(shape: Shape, nodes: &[[f64; 3]]) -> ([u32; 8], [[f64; 3]; 8]) {
        (shape.corners().map(|n| n as u32), shape.corners().map(|n| nodes[n]))
    }

    /// Mass of each of the element's own nodes, and their centre of mass.
    fn weighed(shape: Shape, nodes: &[[f64; 3]]) -> (Vec<f64>, [f64; 3]) {
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
        let (masses, centre) = weighed(Shape::Wedge, &wedge);
        masses.iter().for_each(|&m| near(m, 1.0 / 6.0));
        near(centre[2], 1.5);
        let pyramid = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.7, 0.1, 4.0]];
        let (masses, centre) = weighed(Shape::Pyramid, &pyramid);
        masses[..4].iter().for_each(|&m| near(m, 3.0 / 16.0));
        near(masses[4], 0.25);
        near(centre[2], 1.0); // A quarter of the height.
        let tetrahedron = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 1.0, 0.0], [0.7, 0.1, 4.0]];
        let (masses, _) = weighed(Shape::Tetrahedron, &tetrahedron);
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
        let (_, centre) = weighed(Shape::Wedge, &nodes);
        (0..3).for_each(|i| near(centre[i], sums[i] / sums[3]));
    }

    #[test]
    fn what_is_left_of_the_eighths() {
        let unit = SIGNS.map(|s| s.map(|x| 0.5 * (x + 1.0)));
        for (shape, expected) in
            [(Shape::Hexahedron, 1.0), (Shape::Wedge, 2.0 / 3.0), (Shape::Pyramid, 0.5), (Shape::Tetrahedron, 0.5)]
        {
            let nodes: Vec<[f64; 3]> = match shape {
                Shape::Wedge => [0, 1, 2, 4, 5, 6].map(|c| unit[c]).to_vec(),
                Shape::Tetrahedron => [0, 1, 2, 4].map(|c| unit[c]).to_vec(),
                _ => unit[..shape.nodes()].to_vec(),
            };
            let (numbers, corners) = element(shape, &nodes);
            near(least_share(&numbers, &mass_shares(&numbers, &corners)), expected);
        }
    }

    #[test]
    fn the_number_of_different_nodes_tells_the_shape() {
        for shape in [Shape::Hexahedron, Shape::Wedge, Shape::Pyramid, Shape::Tetrahedron] {
            assert_eq!(kind(&shape.corners().map(|n| n as u32)), shape);
        }
        assert_eq!(kind(&[0, 1, 2, 2, 4, 5, 6, 7]), Shape::Hexahedron);
    }

    #[test]
    fn pinched_elements_are_told_from_collapsed_ones() {
        for shape in [Shape::Hexahedron, Shape::Wedge, Shape::Pyramid, Shape::Tetrahedron] {
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
        let shapes =
            [(Shape::Wedge, &wedge[..]), (Shape::Pyramid, &pyramid[..]), (Shape::Tetrahedron, &tetrahedron[..])];
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
