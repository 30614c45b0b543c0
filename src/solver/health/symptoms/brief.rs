//! A run that is over within its first step: a time in another unit, most likely.

use super::{Symptom, When, nowhere};
use crate::solver::health::finding::Evidence;

pub const SYMPTOM: Symptom = Symptom {
    code: 12,
    when: When::Start,
    // The first step is more than twice as long as the run.
    threshold: 2.0,
    cause: f64::INFINITY,
    measure: |exam, _| {
        let ratio = exam.solver.steps_too_long();
        let evidence = ratio.map(|share| Evidence { share, amount: exam.solver.whole_step, ..Evidence::default() });
        evidence.into_iter().collect()
    },
    place: nowhere,
    label: |_| "the run is shorter than a step".into(),
    words: |evidence| {
        let Evidence { share, amount, .. } = *evidence;
        format!(
            "TERMINATION TIME is {:.1e} of the first time step, {amount:.4e}: the run is one step, made shorter to end there",
            1.0 / share
        )
    },
    advice: "TERMINATION TIME is in another unit than moduli, densities and lengths give, or its exponent is wrong",
};
