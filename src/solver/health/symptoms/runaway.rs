//! Energy grows beyond all that was supplied: the sign of a step above the stable one.

use super::{Symptom, When, nowhere};
use crate::solver::health::energy::two_kinds;
use crate::solver::health::finding::Evidence;

pub const SYMPTOM: Symptom = Symptom {
    code: 7,
    when: When::Energies,
    // Near the stability limit energies swing beyond their sum though nothing grows.
    threshold: 4.0,
    cause: 4.0,
    measure: |exam, _| {
        // What contact has made is told by itself.
        let supplied = exam.supplied + exam.totals.contact_gain;
        let [kinetic, internal] = two_kinds(&exam.totals).map(f64::abs);
        let amount = kinetic.max(internal);
        vec![Evidence { share: amount / supplied, amount, of: supplied, ..Evidence::default() }]
    },
    place: nowhere,
    label: |_| "energy outgrows what was supplied".into(),
    words: |evidence| {
        let Evidence { share, amount, of, .. } = evidence;
        format!(
            "energy has grown to {amount:.4e}, {share:.1} times the {of:.4e} supplied, as in a step that is not stable"
        )
    },
    advice: "TIME STEP SCALE above 1, TIME STEP MODULI, EFFECTIVE, strong hourglass viscosity, or loads that change within \
             one step are the usual causes",
};
