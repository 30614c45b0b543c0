//! Prescribed displacements that are not zero at the start: bodies begin where the mesh has them.

use super::{Direction, Function, MotionKind, Unknown};
use crate::model::Model;

/// Part of the largest displacement below which the first one is round-off.
const NOTHING: f64 = 1e-6;

/// A displacement that is prescribed for the first instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// Node set that jumps.
    pub node_set: i64,
    /// Direction.
    pub direction: Direction,
    /// Displacement, a length.
    pub size: f64,
}

impl Model {
    /// The largest of all jumps.
    pub fn largest_jump(&self) -> Option<Jump> {
        let displaced = |motion: &&super::PrescribedMotion| {
            motion.kind == MotionKind::Displacement && motion.of == Unknown::Position
        };
        let jumps = self.prescribed_motions.iter().filter(displaced).filter_map(|motion| {
            let first = self.functions.get(motion.function)?.begins_with()?;
            Some(Jump { node_set: motion.node_set, direction: motion.direction, size: motion.scale * first })
        });
        jumps.filter(|jump| jump.size != 0.0).max_by(|a, b| a.size.abs().total_cmp(&b.size.abs()))
    }
}

impl Function {
    /// Its value at time zero, unless that is zero but for round-off.
    fn begins_with(&self) -> Option<f64> {
        let first = self.value(0.0);
        let largest = self.points.iter().fold(0.0, |largest: f64, (_, value)| largest.max(value.abs()));
        (first.abs() > NOTHING * largest).then_some(first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_begin_where_they_are_at_time_zero() {
        let begins = |points: &[(f64, f64)]| Function { id: 1, points: points.to_vec() }.begins_with();
        assert_eq!(begins(&[(-1.0, 0.0), (1.0, 4.0)]), Some(2.0));
        assert_eq!(begins(&[(1.0, -3.0), (2.0, 0.0)]), Some(-3.0));
        assert_eq!(begins(&[(0.0, 0.0), (1.0, 4.0)]), None);
        assert_eq!(begins(&[(0.0, 1e-16), (1.0, 1.0)]), None);
        assert_eq!(begins(&[(0.0, 0.0)]), None);
    }
}
