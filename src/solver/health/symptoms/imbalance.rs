//! The accounts of energy do not close.

use super::{Symptom, When, nowhere};
use crate::solver::health::finding::{Evidence, percent};

pub const SYMPTOM: Symptom = Symptom {
    code: 8,
    when: When::Energies,
    threshold: 0.01,
    cause: 0.05,
    measure: |exam, _| {
        // While all accounts are those of a beginning, halves of first steps that are booked later are a good part of them.
        if exam.begins {
            return Vec::new();
        }
        let initial = exam.solver.initial_energy;
        let (gap, scale) = (exam.totals.gap(initial), exam.totals.scale(initial).max(exam.supplied));
        // Kept with the finding: whether the work of a viscosity of hourglass modes may be what is missing.
        let count = u64::from(exam.facts.viscous_modes);
        vec![Evidence { share: gap.abs() / scale, amount: gap, of: scale, count, ..Evidence::default() }]
    },
    place: nowhere,
    label: |_| "energy balance does not close".into(),
    words: |evidence| {
        let Evidence { share, amount, .. } = *evidence;
        let change = if amount < 0.0 { "lost" } else { "gained" };
        format!(
            "the energy balance is off by {:.4e}, {} of the largest account: so much was {change} in the integration of time",
            amount.abs(),
            percent(share)
        )
    },
    advice: ADVICE,
};

const ADVICE: &str = "the time step is too large for what happens within it, such as a strong shock in a gas or a law that changes \
             within one step: try a TIME STEP SCALE of 0.5, and see whether the balance closes better";

/// Where HOURGLASS STIFFENING has a viscosity.
const ADVICE_ON_VISCOSITY: &str = "the viscosity of HOURGLASS STIFFENING is booked with the velocities before the step: where it stops modes within \
                                   a few steps, the balance is off by up to half of HGE; leave the viscosity out, or choose HOURGLASS CONTROL, \
                                   ASSUMED STRAIN, and see whether the balance closes; else try a TIME STEP SCALE of 0.5";

/// What can be tried where this was found.
pub fn advice(evidence: &Evidence) -> &'static str {
    if evidence.count > 0 { ADVICE_ON_VISCOSITY } else { ADVICE }
}
