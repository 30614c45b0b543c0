//! A function of time that goes up and comes back within a few steps: what follows it once a step misses a part of it, or all.

use super::{Symptom, When, nowhere};
use crate::model::Pulse;
use crate::solver::health::finding::Evidence;

pub const SYMPTOM: Symptom = Symptom {
    code: 16,
    when: When::Start,
    threshold: 1.0 / Pulse::STEPS,
    cause: f64::INFINITY,
    measure: |exam, _| {
        let of = |Pulse { function, start, length }: Pulse| Evidence {
            share: exam.solver.whole_step / length,
            amount: start,
            count: function.unsigned_abs(),
            ..Evidence::default()
        };
        exam.facts.pulse.map(of).into_iter().collect()
    },
    place: nowhere,
    label: |evidence| format!("a pulse of function {} that steps hardly see", evidence.count),
    words: |evidence| {
        let Evidence { share, amount, count, .. } = *evidence;
        format!(
            "function {count} goes up or down and comes back within {:.2} steps from time {amount:.4e} on: it is looked at once a step, and of so \
             short a pulse impulse or displacement may be off by half, or all be missed",
            1.0 / share
        )
    },
    advice: "a smaller TIME STEP SCALE, so that eight steps and more see it; or a longer pulse of the same area, which is as good where \
             nothing moves far meanwhile",
};
