//! The neighbourhood search: which contact nodes can meet which faces within a step.
//!
//! Everything that moves is enclosed in a capture box: a face in the box around its corners at both ends of the step, a
//! node in the box of its own reach, so that fast debris does not make the boxes of the others larger. A node and a face
//! whose boxes overlap are candidates for the detailed check, unless the node is a corner of the face.
//!
//! There are three searches. They find the same candidates and differ in time only. `cargo bench --bench search` compares
//! them, and the fastest is the default.

mod bvh;
mod candidates;
mod grid;
pub mod locate;
pub mod neighbourhood;
pub mod occupancy;
mod point_in_box;
mod sizes;
pub mod surroundings;
#[cfg(test)]
mod tests;

pub use bvh::Bvh;
pub use candidates::Candidates;
pub use grid::Grid;
pub use point_in_box::PointInBox;

/// A box along the axes, its surface included. Lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Box3 {
    /// Smallest coordinates.
    pub low: [f64; 3],
    /// Largest coordinates.
    pub high: [f64; 3],
}

impl Box3 {
    /// The box that holds nothing.
    pub fn empty() -> Box3 {
        Box3 { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] }
    }

    /// The smallest box around some points.
    pub fn around(points: &[[f64; 3]]) -> Box3 {
        points.iter().fold(Box3::empty(), |all, point| all.including(*point))
    }

    /// The smallest box around this one and a point.
    pub fn including(self, point: [f64; 3]) -> Box3 {
        self.joined(&Box3 { low: point, high: point })
    }

    /// The smallest box around this one and another.
    pub fn joined(self, other: &Box3) -> Box3 {
        Box3 {
            low: [0, 1, 2].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1, 2].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// The box with all its sides moved outwards by `margin`.
    pub fn grown(self, margin: f64) -> Box3 {
        Box3 { low: self.low.map(|x| x - margin), high: self.high.map(|x| x + margin) }
    }

    /// Whether the boxes have a point in common; touching counts.
    pub fn overlaps(&self, other: &Box3) -> bool {
        // Without short cuts, which searches would mispredict half the time.
        (0..3).fold(true, |all, axis| all & (self.low[axis] <= other.high[axis]) & (other.low[axis] <= self.high[axis]))
    }

    /// Whether the box holds a point and all its coordinates are finite. Searches leave other boxes out.
    pub fn is_sound(&self) -> bool {
        (0..3)
            .all(|axis| self.low[axis] <= self.high[axis] && self.low[axis].is_finite() && self.high[axis].is_finite())
    }

    /// The longest edge.
    pub fn extent(&self) -> f64 {
        (0..3).map(|axis| self.high[axis] - self.low[axis]).fold(0.0, f64::max)
    }
}

/// A way to find all candidates. What takes little memory is kept from call to call.
pub trait Search {
    /// Finds all pairs of a node and a face whose boxes overlap, but for nodes that are corners of the face. Face `f` has
    /// the box `faces[f]` and the corners `connectivity[f]`, which are indices into `nodes`; a triangle names one of its
    /// corners twice. Boxes that are empty or not finite find nothing and are not found.
    fn find(&mut self, nodes: &[Box3], faces: &[Box3], connectivity: &[[u32; 4]], found: &mut Candidates);

    /// The name in messages and tables.
    fn name(&self) -> &'static str;
}

/// The searches by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SearchKind {
    /// Three sorted lists, by Swegle and coworkers: the reference.
    PointInBox,
    /// Grids of cells, one for each class of sizes.
    #[default]
    Grid,
    /// A tree of boxes around the faces.
    Bvh,
}

impl SearchKind {
    /// All of them.
    pub const ALL: [SearchKind; 3] = [SearchKind::PointInBox, SearchKind::Grid, SearchKind::Bvh];

    /// A new search of this kind.
    pub fn make(self) -> Box<dyn Search> {
        match self {
            SearchKind::PointInBox => Box::new(PointInBox::default()),
            SearchKind::Grid => Box::new(Grid::default()),
            SearchKind::Bvh => Box::new(Bvh::default()),
        }
    }
}

/// A lower bound of the low corners of all boxes that reach up to `low` and are at most `extent` long. It is rounded
/// outwards, so that a box that just touches is not lost.
fn lowest_start(low: f64, extent: f64) -> f64 {
    (low - extent.next_up()).next_down()
}
