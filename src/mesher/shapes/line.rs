//! LINE: a row of two-node elements between two points.

use crate::mesher::body::{Body, Face, Shape};

/// Two-node elements from one point to another.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Where it begins and ends.
    pub ends: [[f64; 3]; 2],
    /// Number of elements.
    pub cells: usize,
}

impl Shape for Line {
    fn elements(&self, refine: usize) -> f64 {
        self.cells as f64 * refine as f64
    }

    fn faces(&self) -> Vec<Face> {
        Vec::new()
    }

    fn body(&self, refine: usize) -> Body {
        let (count, [a, b]) = (self.cells * refine, self.ends);
        let at = |i: usize| [0, 1, 2].map(|axis| a[axis] + (b[axis] - a[axis]) * (i as f64 / count as f64));
        Body {
            coordinates: (0..=count).map(at).collect(),
            bars: (0..count as u32).map(|i| [i, i + 1]).collect(),
            ..Body::default()
        }
    }
}
