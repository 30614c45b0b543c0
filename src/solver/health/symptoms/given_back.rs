//! A resistance has given back more than it took: of hourglass modes, by bulk viscosity, or by friction.

use super::{Symptom, When, nowhere};
use crate::solver::health::finding::{Evidence, percent};

/// Their names, in the order of [`Totals::given_back`](crate::solver::Totals::given_back).
const NAMES: [&str; 3] = ["hourglass stiffness", "bulk viscosity", "friction"];

pub const SYMPTOM: Symptom = Symptom {
    code: 5,
    when: When::Energies,
    threshold: 0.01,
    cause: 0.01,
    measure: |exam, _| {
        let all = exam.totals.given_back().into_iter().enumerate();
        let (which, amount) = all.fold((0, 0.0), |most, one| if one.1 > most.1 { one } else { most });
        let count = which as u64;
        vec![Evidence { share: amount / exam.supplied, amount, count, of: exam.supplied, ..Evidence::default() }]
    },
    place: nowhere,
    label: |evidence| format!("{} makes energy", name(evidence)),
    words: |evidence| {
        let Evidence { share, amount, .. } = *evidence;
        format!(
            "{} has given back {amount:.4e} more than it took, {} of the largest energy supplied so far",
            name(evidence),
            percent(share)
        )
    },
    advice: "elements that are drawn out or squashed beyond measure are the usual cause: look at the last plot state, and \
             try a mesh that deforms less, DEATH for such elements, or a smaller TIME STEP SCALE",
};

fn name(evidence: &Evidence) -> &'static str {
    NAMES[(evidence.count as usize).min(NAMES.len() - 1)]
}
