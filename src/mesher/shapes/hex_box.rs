//! BOX and HEXAHEDRON: nx × ny × nz cells between eight corners.

use crate::mesher::{
    body::{Body, Face, Shape},
    shapes::spacing::Spacing,
};

/// A solid with six faces, mapped trilinearly from a cube. A box is the special case of right angles.
#[derive(Debug, Clone, PartialEq)]
pub struct Hexahedron {
    /// The corners in the order of an element's nodes: four around the bottom, four above them.
    pub corners: [[f64; 3]; 8],
    /// Cells from corner 1 to 2, from 1 to 4 and from 1 to 5.
    pub cells: [Spacing; 3],
}

/// The faces by local side, in the order of [`crate::mesh::HEX_SIDES`].
const SIDES: [Face; 6] = [Face::Front, Face::Right, Face::Back, Face::Left, Face::Bottom, Face::Top];

impl Hexahedron {
    /// The box between `corner` and `corner + size`.
    pub fn right_angled(corner: [f64; 3], size: [f64; 3], cells: [Spacing; 3]) -> Hexahedron {
        let far = [0, 1, 2].map(|axis| corner[axis] + size[axis]);
        let at = |high: [bool; 3]| [0, 1, 2].map(|axis| if high[axis] { far[axis] } else { corner[axis] });
        let ring = [[false, false], [true, false], [true, true], [false, true]];
        let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|n| at([ring[n % 4][0], ring[n % 4][1], n > 3]));
        Hexahedron { corners, cells }
    }

    /// The point with coordinates s from 0 to 1 along the three directions.
    fn point(&self, s: [f64; 3]) -> [f64; 3] {
        let c = &self.corners;
        let edge = |a: usize, b: usize, axis: usize| between(c[a][axis], c[b][axis], s[0]);
        [0, 1, 2].map(|axis| {
            let bottom = between(edge(0, 1, axis), edge(3, 2, axis), s[1]);
            let top = between(edge(4, 5, axis), edge(7, 6, axis), s[1]);
            between(bottom, top, s[2])
        })
    }
}

/// From a to b, exact at both ends and where they are equal.
pub fn between(a: f64, b: f64, s: f64) -> f64 {
    if s == 1.0 { b } else { a + s * (b - a) }
}

impl Shape for Hexahedron {
    fn elements(&self, refine: usize) -> f64 {
        self.cells.iter().map(|s| s.cells as f64 * refine as f64).product()
    }

    fn faces(&self) -> Vec<Face> {
        SIDES.to_vec()
    }

    fn body(&self, refine: usize) -> Body {
        let [x, y, z] = self.cells.map(|s| s.positions(refine));
        let [nx, ny, nz] = [x.len() - 1, y.len() - 1, z.len() - 1];
        let node = |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
        let mut body = Body::default();
        for &w in &z {
            for &v in &y {
                body.coordinates.extend(x.iter().map(|&u| self.point([u, v, w])));
            }
        }
        for face in SIDES {
            body.faces.push((face, Vec::new()));
        }
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let element = body.hexes.len() as u32;
                    let ring = |k| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
                    let ([a, b, c, d], [e, f, g, h]) = (ring(k), ring(k + 1));
                    body.hexes.push([a, b, c, d, e, f, g, h]);
                    let outside = [j == 0, i + 1 == nx, j + 1 == ny, i == 0, k == 0, k + 1 == nz];
                    for side in (0..6).filter(|&side| outside[side]) {
                        body.faces[side].1.push((element, side as u8));
                    }
                }
            }
        }
        body
    }
}
