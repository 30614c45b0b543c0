//! What the enforcement on one rank asks of the other ranks.

use super::certificate::Sums;
use super::constraint::{Constraint, ConstraintState, Response};

/// Numbers of which all ranks learn the largest in a pass: how much it moved, whether anybody wants it, and of the overlaps
/// that motion has made so far the deepest in face sizes, the deepest, and the farthest motion of the step.
pub const VOTES: usize = 6;

/// What ranks tell each other in the course of the passes; nothing on one rank.
pub trait OtherRanks {
    /// Appends the constraints of others that act on points which this rank answers for, and sends them those that act on
    /// theirs.
    fn copy(&mut self, constraints: &mut Vec<Constraint>, states: &mut Vec<ConstraintState>);
    /// Brings what others know of points that are theirs: how far forces move them, and what constraints weigh there.
    fn share(&mut self, responses: &mut [Response]);
    /// The largest of all ranks' values, of each kind.
    fn largest(&mut self, values: [f64; VOTES]) -> [f64; VOTES];
    /// Replaces sums by those over all ranks.
    fn sum(&mut self, sums: &mut Sums);
    /// Whether there are any.
    fn are_there(&self) -> bool;
}

/// There are no others.
pub struct NoOtherRanks;

impl OtherRanks for NoOtherRanks {
    fn copy(&mut self, _: &mut Vec<Constraint>, _: &mut Vec<ConstraintState>) {}

    fn share(&mut self, _: &mut [Response]) {}

    fn largest(&mut self, values: [f64; VOTES]) -> [f64; VOTES] {
        values
    }

    fn sum(&mut self, _: &mut Sums) {}

    fn are_there(&self) -> bool {
        false
    }
}
