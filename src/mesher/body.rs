//! One meshed shape: its nodes, its hexahedra, quadrilaterals or bars, and its faces by name.

/// The elements of one shape. No two of its nodes coincide.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Body {
    /// Node positions.
    pub coordinates: Vec<[f64; 3]>,
    /// Eight zero-based node indices per element, in EXODUS order.
    pub hexes: Vec<[u32; 8]>,
    /// Two zero-based node indices per two-node element.
    pub bars: Vec<[u32; 2]>,
    /// Whether only the lowest layer of the hexahedra is meant, as quadrilaterals of a two-dimensional mesh.
    pub flat: bool,
    /// Four zero-based node indices per quadrilateral of a surface, counter-clockwise seen from its top.
    pub quads: Vec<[u32; 4]>,
    /// The faces of the shape that have a name; of a surface its two sides, and its edges.
    pub faces: Vec<(Face, Sides)>,
}

/// Sides of elements as `(zero-based element index, zero-based local side)`, see [`crate::mesh::Shape::sides`]. The index counts the
/// hexahedra of a body, or its quadrilaterals where it has no hexahedra.
pub type Sides = Vec<(u32, u8)>;

/// Names of the faces of shapes, in the directions in which a shape is made, before it is moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// Smallest x.
    Left,
    /// Largest x.
    Right,
    /// Smallest y.
    Front,
    /// Largest y.
    Back,
    /// Smallest z.
    Bottom,
    /// Largest z.
    Top,
    /// The inner wall of a hollow shape.
    Inner,
    /// The curved outer surface.
    Outer,
    /// The plane x = 0 at which a quarter or octant model is cut.
    CutX,
    /// The plane y = 0 at which a half, quarter or octant model is cut.
    CutY,
    /// The plane z = 0 at which an octant model is cut.
    CutZ,
}

/// The planes at which part of a round shape is cut away, by axis.
pub const CUTS: [Face; 3] = [Face::CutX, Face::CutY, Face::CutZ];

impl Face {
    /// The faces of a box across x, y and z, with the smaller coordinate first.
    pub const ACROSS: [[Face; 2]; 3] =
        [[Face::Left, Face::Right], [Face::Front, Face::Back], [Face::Bottom, Face::Top]];

    /// All names.
    pub const ALL: [Face; 11] = [
        Face::Left,
        Face::Right,
        Face::Front,
        Face::Back,
        Face::Bottom,
        Face::Top,
        Face::Inner,
        Face::Outer,
        Face::CutX,
        Face::CutY,
        Face::CutZ,
    ];

    /// The face on the other side of the shape, of those that have one.
    pub fn opposite(self) -> Option<Face> {
        let walls = [Face::Inner, Face::Outer];
        Face::ACROSS
            .into_iter()
            .chain([walls])
            .find(|pair| pair.contains(&self))
            .map(|[a, b]| if self == a { b } else { a })
    }

    /// The axis across which the face of a box lies.
    pub fn axis(self) -> Option<usize> {
        Face::ACROSS.iter().position(|pair| pair.contains(&self))
    }

    /// The words of a recipe.
    pub fn words(self) -> &'static str {
        match self {
            Face::Left => "LEFT",
            Face::Right => "RIGHT",
            Face::Front => "FRONT",
            Face::Back => "BACK",
            Face::Bottom => "BOTTOM",
            Face::Top => "TOP",
            Face::Inner => "INNER",
            Face::Outer => "OUTER",
            Face::CutX => "CUT X",
            Face::CutY => "CUT Y",
            Face::CutZ => "CUT Z",
        }
    }
}

impl Body {
    /// Adds element faces to the face of this name.
    pub fn add_to_face(&mut self, face: Face, sides: impl IntoIterator<Item = (u32, u8)>) {
        match self.faces.iter_mut().find(|(name, _)| *name == face) {
            Some((_, list)) => list.extend(sides),
            None => self.faces.push((face, sides.into_iter().collect())),
        }
    }
}

/// How much of a round shape is modelled; what is left out follows by symmetry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// All of it.
    Full,
    /// y ≥ 0.
    Half,
    /// x ≥ 0 and y ≥ 0.
    Quarter,
    /// x ≥ 0, y ≥ 0 and z ≥ 0.
    Octant,
}

impl Extent {
    /// The extent by its word in a recipe; unknown words mean all of it.
    pub fn from_word(word: &str) -> Extent {
        match word {
            "HALF" => Extent::Half,
            "QUARTER" => Extent::Quarter,
            "OCTANT" => Extent::Octant,
            _ => Extent::Full,
        }
    }

    /// Whether only the positive side of each axis is modelled.
    pub fn cut(self) -> [bool; 3] {
        match self {
            Extent::Full => [false; 3],
            Extent::Half => [false, true, false],
            Extent::Quarter => [true, true, false],
            Extent::Octant => [true; 3],
        }
    }

    /// The planes at which the model is cut.
    pub fn cuts(self) -> impl Iterator<Item = Face> {
        CUTS.into_iter().zip(self.cut()).filter(|(_, cut)| *cut).map(|(face, _)| face)
    }

    /// Quadrants of the x-y plane that are modelled: 4, 2 or 1.
    pub fn quadrants(self) -> usize {
        match self {
            Extent::Full => 4,
            Extent::Half => 2,
            Extent::Quarter | Extent::Octant => 1,
        }
    }
}

/// A solid that a recipe can ask for.
pub trait Shape {
    /// Number of elements; a real number, as it may be too large for any other before it is refused.
    fn elements(&self, refine: usize) -> f64;

    /// The faces that have a name.
    fn faces(&self) -> Vec<Face>;

    /// The mesh with every number of cells multiplied by `refine`. Curved surfaces are evaluated anew.
    fn body(&self, refine: usize) -> Body;
}
