//! What the enforcement on one rank asks of the other ranks.

use super::accounts::certificate::Sums;
use super::constraint::{Constraint, ConstraintState, Response};
use crate::comm::{Communicator, ExactSum, gather_for_all};

/// Of what all ranks learn the largest value before the first iteration.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InitialMaxima {
    /// 1 where a rank has a gap to close, else 0.
    pub wanted: f64,
    /// 1 where a rank has a constraint that yields, else 0.
    pub yields: f64,
    /// 1 where a rank has a constraint with a thickness, else 0.
    pub thick: f64,
    /// Deepest penetration that motion had made before the step, as a part of the face's size.
    pub deepest: f64,
    /// The deepest one as a length, of those that are more than a ten-thousandth of the face's size; else 0.
    pub depth: f64,
    /// Farthest that a contact would move along its normal in the step without contact forces, a length; not of nodes above planes.
    pub travel: f64,
    /// Deepest penetration between members that nothing can move, as a part of the face's size.
    pub held: f64,
}

impl InitialMaxima {
    /// As numbers, for messages.
    pub fn to_array(self) -> [f64; 7] {
        let InitialMaxima { wanted, yields, thick, deepest, depth, travel, held } = self;
        [wanted, yields, thick, deepest, depth, travel, held]
    }

    /// From these numbers.
    pub fn from_array([wanted, yields, thick, deepest, depth, travel, held]: [f64; 7]) -> InitialMaxima {
        InitialMaxima { wanted, yields, thick, deepest, depth, travel, held }
    }
}

/// What ranks tell each other in the course of the iterations; nothing on one rank.
pub trait OtherRanks {
    /// Appends the constraints of others that act on points which this rank answers for, and sends them those that act on
    /// theirs.
    fn copy(&mut self, constraints: &mut Vec<Constraint>, states: &mut Vec<ConstraintState>);
    /// Brings what others know of points that are theirs: how far forces move them, and what constraints weigh there. Beside that, since
    /// whoever waits for one can wait for both: the largest of all ranks' values, each by itself.
    fn share(&mut self, responses: &mut [Response], largest: &mut [f64]);
    /// Replaces sums by those over all ranks.
    fn sum(&mut self, sums: &mut Sums);
    /// The same of any sums.
    fn merge(&mut self, sums: &mut [ExactSum]);
    /// The numbers of all ranks one after another, the own among them.
    fn gather(&mut self, own: Vec<f64>) -> Vec<f64>;
    /// Whether there are any.
    fn are_there(&self) -> bool;
}

/// The numbers of all ranks one after another; all ranks call it.
pub fn gather_numbers(own: &[f64], comm: &mut dyn Communicator) -> Vec<f64> {
    let bytes = gather_for_all(own.iter().flat_map(|number| number.to_le_bytes()).collect(), comm);
    bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect()
}

/// Replaces values by the largest of all ranks, each by itself. All ranks call it, with as many values, and nobody is asked where there are none.
pub fn find_largest(values: &mut [f64], comm: &mut dyn Communicator) {
    if !values.is_empty() {
        values.iter_mut().for_each(|value| *value = -*value);
        comm.all_min(values);
        values.iter_mut().for_each(|value| *value = -*value);
    }
}

/// There are no others.
pub struct NoOtherRanks;

impl OtherRanks for NoOtherRanks {
    fn copy(&mut self, _: &mut Vec<Constraint>, _: &mut Vec<ConstraintState>) {}

    fn share(&mut self, _: &mut [Response], _: &mut [f64]) {}

    fn sum(&mut self, _: &mut Sums) {}

    fn merge(&mut self, _: &mut [ExactSum]) {}

    fn gather(&mut self, own: Vec<f64>) -> Vec<f64> {
        own
    }

    fn are_there(&self) -> bool {
        false
    }
}

/// Others, of whose points none is a point here as well, but for those of rigid bodies: planes alone.
pub struct Elsewhere<'a>(pub &'a mut dyn Communicator);

impl OtherRanks for Elsewhere<'_> {
    fn copy(&mut self, _: &mut Vec<Constraint>, _: &mut Vec<ConstraintState>) {}

    fn share(&mut self, _: &mut [Response], largest: &mut [f64]) {
        find_largest(largest, self.0);
    }

    fn sum(&mut self, sums: &mut Sums) {
        ExactSum::merge_ranks(&mut sums.0, self.0);
    }

    fn merge(&mut self, sums: &mut [ExactSum]) {
        ExactSum::merge_ranks(sums, self.0);
    }

    fn gather(&mut self, own: Vec<f64>) -> Vec<f64> {
        gather_numbers(&own, self.0)
    }

    fn are_there(&self) -> bool {
        true
    }
}
