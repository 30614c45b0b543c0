//! The points of contact: nodes on the outside, where they are, where they would go, and how heavy they are.

use crate::solver::nodes::{add, scaled};

/// Contact points, structure of arrays, in the order of the mesh's nodes.
#[derive(Debug, Clone, Default)]
pub struct Points {
    /// Position at the present state.
    pub start: Vec<[f64; 3]>,
    /// Velocity over the coming step as it would be without contact.
    pub velocity: Vec<[f64; 3]>,
    /// Position at the end of that step.
    pub end: Vec<[f64; 3]>,
    /// 1/m along each axis; 0 where a constraint says how the node moves.
    pub inverse_mass: Vec<[f64; 3]>,
}

impl Points {
    /// So many points at the origin.
    pub fn new(count: usize) -> Points {
        let zero = vec![[0.0; 3]; count];
        Points { start: zero.clone(), velocity: zero.clone(), end: zero.clone(), inverse_mass: zero }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.start.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.start.is_empty()
    }

    /// Puts a point where it is and lets it go its way for a step `drift`.
    #[inline]
    pub fn set(&mut self, point: usize, start: [f64; 3], velocity: [f64; 3], drift: f64) {
        self.start[point] = start;
        self.velocity[point] = velocity;
        self.end[point] = add(start, scaled(velocity, drift));
    }

    /// How far a point goes.
    pub fn path(&self, point: u32) -> ([f64; 3], [f64; 3]) {
        let (start, end) = (self.start[point as usize], self.end[point as usize]);
        (start, [end[0] - start[0], end[1] - start[1], end[2] - start[2]])
    }
}
