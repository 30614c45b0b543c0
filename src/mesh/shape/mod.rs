//! Shapes of elements: all that can be said of an element without knowing what it is made of or how it moves.

pub(super) mod kind;

use super::Mesh;
use super::check::Problem;
use super::hexahedron::{self, HEX_SIDES};
use super::plane;
use crate::common::vector::{cross, dot, subtract};

/// What the elements of a block look like. A solid with fewer corners is a hexahedron with repeated nodes, see
/// [`hexahedron::Form`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// Eight nodes: 1-2-3-4 around the bottom, 5-6-7-8 above them.
    #[default]
    Hexahedron,
    /// Four nodes of a surface, counter-clockwise seen from its top.
    Quadrilateral,
    /// Three nodes of a surface, in the same way.
    Triangle,
    /// Four nodes of a two-dimensional mesh, counter-clockwise; the last two are one node in a triangle.
    Plane,
    /// Two nodes.
    Bar,
}

/// Sides of a hexahedron, then those of a quadrilateral in EXODUS order: top, bottom and the four edges.
const HEXAHEDRON: [&[usize]; 6] =
    [&HEX_SIDES[0], &HEX_SIDES[1], &HEX_SIDES[2], &HEX_SIDES[3], &HEX_SIDES[4], &HEX_SIDES[5]];
const QUADRILATERAL: [&[usize]; 6] = [&[0, 1, 2, 3], &[0, 3, 2, 1], &[0, 1], &[1, 2], &[2, 3], &[3, 0]];
/// Sides of a triangle of a surface: top, bottom and the three edges.
const TRIANGLE: [&[usize]; 5] = [&[0, 1, 2], &[0, 2, 1], &[0, 1], &[1, 2], &[2, 0]];
/// Edges of a plane element in EXODUS order.
const PLANE: [&[usize]; 4] = [&[0, 1], &[1, 2], &[2, 3], &[3, 0]];
const BAR: [&[usize]; 2] = [&[0], &[1]];

impl Shape {
    /// All shapes.
    pub const ALL: [Shape; 5] = [Shape::Hexahedron, Shape::Quadrilateral, Shape::Triangle, Shape::Plane, Shape::Bar];

    /// Number of nodes.
    pub fn corners(self) -> usize {
        match self {
            Shape::Hexahedron => 8,
            Shape::Quadrilateral | Shape::Plane => 4,
            Shape::Triangle => 3,
            Shape::Bar => 2,
        }
    }

    /// 3 for a solid, 2 for a surface or an element of a plane, 1 for a line.
    pub fn dimension(self) -> usize {
        match self {
            Shape::Hexahedron => 3,
            Shape::Quadrilateral | Shape::Triangle | Shape::Plane => 2,
            Shape::Bar => 1,
        }
    }

    /// The element type that is written into EXODUS files.
    pub fn exodus_name(self) -> &'static str {
        match self {
            Shape::Hexahedron => "HEX8",
            Shape::Quadrilateral => "SHELL4",
            Shape::Triangle => "TRISHELL3",
            Shape::Plane => "QUAD4",
            Shape::Bar => "BAR2",
        }
    }

    /// How element types of EXODUS files begin that mean this shape.
    pub fn exodus_stems(self) -> &'static [&'static str] {
        match self {
            Shape::Hexahedron => &["HEX"],
            Shape::Quadrilateral => &["SHE", "QUA"],
            Shape::Triangle => &["TRI", "SHE"],
            Shape::Plane => &["QUA"],
            Shape::Bar => &["BAR", "TRU", "BEA"],
        }
    }

    /// One and several of them in words.
    pub fn names(self) -> [&'static str; 2] {
        match self {
            Shape::Hexahedron => ["hexahedron", "hexahedra"],
            Shape::Quadrilateral | Shape::Plane => ["quadrilateral", "quadrilaterals"],
            Shape::Triangle => ["triangle", "triangles"],
            Shape::Bar => ["bar", "bars"],
        }
    }

    /// Local nodes of each side in EXODUS order. Those with three or more turn counter-clockwise seen from outside.
    pub fn sides(self) -> &'static [&'static [usize]] {
        match self {
            Shape::Hexahedron => &HEXAHEDRON,
            Shape::Quadrilateral => &QUADRILATERAL,
            Shape::Triangle => &TRIANGLE,
            Shape::Plane => &PLANE,
            Shape::Bar => &BAR,
        }
    }

    /// Whether elements of this shape fill the space of their mesh, so that a face between two of them is inside.
    pub fn is_solid(self) -> bool {
        matches!(self, Shape::Hexahedron | Shape::Plane)
    }

    /// What kind of body elements of this shape are, in the words of the language of decks.
    pub fn kind(self) -> &'static str {
        match self {
            Shape::Hexahedron | Shape::Plane => "solids",
            Shape::Quadrilateral | Shape::Triangle => "surfaces",
            Shape::Bar => "bars",
        }
    }

    /// Whether elements of this shape are surfaces in space, which have two faces.
    pub fn is_surface(self) -> bool {
        matches!(self, Shape::Quadrilateral | Shape::Triangle)
    }

    /// The sides that are faces, first of all: those that can be seen, pressed or touched. In the plane they are edges.
    pub fn faces(self) -> &'static [&'static [usize]] {
        if self == Shape::Plane {
            return &PLANE;
        }
        let faces = self.sides().iter().take_while(|side| side.len() > 2).count();
        &self.sides()[..faces]
    }

    /// Whether a side, counted from 0, is a face; elements of shells and bars have edges and ends as sides as well.
    pub fn is_face(self, side: u8) -> bool {
        usize::from(side) < self.faces().len()
    }

    /// Local nodes at the ends of each edge.
    pub fn edges(self) -> &'static [[usize; 2]] {
        match self {
            Shape::Hexahedron => &hexahedron::EDGES,
            Shape::Quadrilateral | Shape::Plane => &[[0, 1], [1, 2], [2, 3], [3, 0]],
            Shape::Triangle => &[[0, 1], [1, 2], [2, 0]],
            Shape::Bar => &[[0, 1]],
        }
    }

    /// The four nodes of a face of an element given by its nodes, `None` for a side that is none. A triangle a-b-c is the face
    /// a-b-c-c; an edge a-b of a plane element is the face a-b-b-a: a strip that stands on the plane.
    pub fn face(self, nodes: &[u32], side: u8) -> Option<[u32; 4]> {
        let corners: [usize; 4] = match *self.faces().get(usize::from(side))? {
            &[a, b] => [a, b, b, a],
            &[a, b, c] => [a, b, c, c],
            corners => corners.try_into().ok()?,
        };
        Some(corners.map(|corner| nodes[corner]))
    }

    /// Why an element of a mesh, given by its nodes, cannot be computed with, if it cannot.
    pub fn fault(self, mesh: &Mesh, nodes: &[u32]) -> Option<Problem> {
        let at = |corner: usize| mesh.coordinates[nodes[corner] as usize];
        match self {
            Shape::Hexahedron => {
                let nodes: &[u32; 8] = nodes.try_into().ok()?;
                hexahedron::fault(mesh, nodes, &nodes.map(|node| mesh.coordinates[node as usize]))
            }
            Shape::Plane => plane::fault(mesh, nodes.try_into().ok()?),
            Shape::Quadrilateral => {
                let (a, b) = (subtract(at(2), at(0)), subtract(at(3), at(1)));
                let normal = cross(a, b);
                // At each corner the two edges turn as the whole does.
                let folded = (0..4).any(|i| {
                    let turn = cross(subtract(at((i + 1) % 4), at(i)), subtract(at((i + 3) % 4), at(i)));
                    let along = dot(turn, normal);
                    along.is_nan() || along <= 0.0
                });
                folded.then(|| {
                    Problem::new(
                        "it is flat to a line, or one of its corners points inwards",
                        "look at the positions and the order of its nodes, around the element",
                    )
                })
            }
            Shape::Triangle => {
                let normal = cross(subtract(at(1), at(0)), subtract(at(2), at(0)));
                let longest = (0..3).map(|i| subtract(at((i + 1) % 3), at(i))).map(|edge| dot(edge, edge));
                let smallest = 4.0 * f64::EPSILON * longest.fold(0.0, f64::max);
                let area = dot(normal, normal).sqrt();
                (area.is_nan() || area <= smallest).then(|| {
                    Problem::new("it is flat to a line", "look at the positions of its nodes; two of them may be one")
                })
            }
            Shape::Bar => {
                let along = subtract(at(1), at(0));
                let length = dot(along, along);
                let flat = length.is_nan() || length <= 0.0;
                flat.then(|| Problem::new("its length is 0, it must be positive", "its two nodes are at one place"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_and_edges_name_corners_that_there_are() {
        for shape in Shape::ALL {
            let places = shape.sides().iter().copied().flatten().chain(shape.edges().iter().flatten());
            assert!(places.into_iter().all(|&corner| corner < shape.corners()), "{shape:?}");
            assert!(shape.sides().len() <= super::super::exterior::SIDES, "{shape:?}");
            assert!(shape.exodus_stems().iter().any(|stem| shape.exodus_name().starts_with(stem)));
        }
        // Every edge of a hexahedron is an edge of two of its faces.
        for [a, b] in Shape::Hexahedron.edges() {
            let faces = HEX_SIDES.iter().filter(|side| side.contains(a) && side.contains(b)).count();
            assert_eq!(faces, 2);
        }
        assert_eq!(Shape::ALL.map(|shape| shape.faces().len()), [6, 2, 2, 4, 0]);
    }

    #[test]
    fn quadrilaterals_that_fold_and_bars_without_length_are_faults() {
        let coordinates = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0], [0.6, 0.6, 0.0], [0.0; 3]];
        let mesh = Mesh { coordinates: coordinates.into(), ..Mesh::default() };
        assert_eq!(Shape::Quadrilateral.fault(&mesh, &[0, 1, 2, 3]), None);
        assert!(Shape::Quadrilateral.fault(&mesh, &[0, 1, 3, 2]).is_some());
        assert!(Shape::Quadrilateral.fault(&mesh, &[1, 2, 3, 4]).is_some());
        assert_eq!(Shape::Triangle.fault(&mesh, &[0, 1, 2]), None);
        assert!(Shape::Triangle.fault(&mesh, &[0, 1, 5]).is_some());
        assert_eq!(Shape::Bar.fault(&mesh, &[0, 1]), None);
        assert!(Shape::Bar.fault(&mesh, &[0, 5]).is_some());
    }
}
