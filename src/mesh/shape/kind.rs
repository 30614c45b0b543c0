//! What the elements of a block are in a file: of a shape, or hexahedra that the file gives with fewer nodes.

use super::Shape;
use super::hexahedron::Form;

/// What one finds in a file, before it becomes a block of a [`Mesh`](super::Mesh).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A solid, in the mesh a hexahedron.
    Solid(Form),
    /// An element of another shape.
    Other(Shape),
    /// A triangle of a two-dimensional mesh, in the mesh a quadrilateral whose last two nodes are one.
    Triangle,
}

impl Kind {
    /// All kinds that are known in so many dimensions.
    pub fn all(dimensions: usize) -> &'static [Kind] {
        if dimensions == 2 { &[Kind::Other(Shape::Plane), Kind::Triangle] } else { &Kind::ALL }
    }

    /// Those of space.
    const ALL: [Kind; 7] = [
        Kind::Solid(Form::Hexahedron),
        Kind::Solid(Form::Wedge),
        Kind::Solid(Form::Pyramid),
        Kind::Solid(Form::Tetrahedron),
        Kind::Other(Shape::Quadrilateral),
        Kind::Other(Shape::Triangle),
        Kind::Other(Shape::Bar),
    ];

    /// Its shape in the mesh.
    pub fn shape(self) -> Shape {
        match self {
            Kind::Solid(_) => Shape::Hexahedron,
            Kind::Other(shape) => shape,
            Kind::Triangle => Shape::Plane,
        }
    }

    /// Number of nodes in the file.
    pub fn nodes(self) -> usize {
        match self {
            Kind::Solid(form) => form.nodes(),
            Kind::Other(shape) => shape.corners(),
            Kind::Triangle => 3,
        }
    }

    /// One of them in words.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Solid(form) => form.name(),
            Kind::Other(shape) => shape.names()[0],
            Kind::Triangle => "triangle",
        }
    }

    /// Whether an element type of a file, in capitals, means this kind, if the number of nodes agrees. A file may leave the
    /// type of hexahedra out.
    pub fn is_named(self, element_type: &str) -> bool {
        let stems = match self {
            Kind::Solid(Form::Wedge) => &["WED"],
            Kind::Solid(Form::Pyramid) => &["PYR"],
            Kind::Solid(Form::Tetrahedron) => &["TET"],
            Kind::Triangle => &["TRI"],
            Kind::Solid(Form::Hexahedron) | Kind::Other(_) => self.shape().exodus_stems(),
        };
        let left_out = element_type.is_empty()
            && matches!(self, Kind::Solid(Form::Hexahedron) | Kind::Other(Shape::Plane) | Kind::Triangle);
        left_out || stems.iter().any(|stem| element_type.starts_with(stem))
    }

    /// The nodes of the mesh's element, from those in the file.
    pub fn expand(self, given: &[u32]) -> impl Iterator<Item = u32> {
        let solid: [usize; 8] = match self {
            Kind::Solid(form) => form.corners(),
            Kind::Triangle => [0, 1, 2, 2, 2, 2, 2, 2],
            Kind::Other(_) => [0, 1, 2, 3, 4, 5, 6, 7],
        };
        (0..self.shape().corners()).map(move |corner| given.get(solid[corner]).copied().unwrap_or_default())
    }

    /// The side of the mesh's element that each side in the file becomes.
    pub fn sides(self) -> &'static [u8] {
        match self {
            Kind::Solid(form) => form.sides(),
            Kind::Other(shape) => &[0, 1, 2, 3, 4, 5][..shape.sides().len()],
            Kind::Triangle => &[0, 1, 3],
        }
    }
}
