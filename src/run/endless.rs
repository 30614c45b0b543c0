//! Runs that cannot come to an end.

use crate::output::print::scientific;

/// Steps that nobody waits for: at a microsecond each, the least that a step of the smallest mesh takes, they are
/// twelve days.
const MOST_STEPS: f64 = 1e12;

/// A run whose steps are so short that it does not reach its termination time.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the run would not come to an end: steps of {} take {:.0e} to TERMINATION TIME, {}",
    scientific(self.step, 4), self.steps, scientific(self.termination, 4)
)]
pub struct Endless {
    step: f64,
    steps: f64,
    termination: f64,
}

impl Endless {
    /// Whether a run that is at a time and takes a step of this size is such a run.
    pub fn at(time: f64, step: f64, termination: f64) -> Option<Endless> {
        let steps = (termination - time) / step;
        (steps > MOST_STEPS).then_some(Endless { step, steps, termination })
    }

    /// What to do.
    pub fn advice(&self) -> &'static str {
        "a modulus, a density or a length is in another unit than the times of the deck, or TIME STEP SCALE is small"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_takes_longer_than_anybody_waits_is_endless() {
        assert_eq!(Endless::at(0.0, 1e-9, 1.0), None);
        assert_eq!(Endless::at(0.9e3, 1e-9, 1e3), None);
        let endless = Endless::at(0.0, 2e-13, 1.0).map(|endless| endless.to_string());
        let words = "the run would not come to an end: steps of 2.0000e-13 take 5e12 to TERMINATION TIME, 1.0000e+00";
        assert_eq!(endless.as_deref(), Some(words));
    }
}
