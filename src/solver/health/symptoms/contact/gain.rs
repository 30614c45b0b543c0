//! Contact gives energy, which it may only take.

use crate::comm::Communicator;
use crate::solver::health::finding::{Evidence, percent};
use crate::solver::health::place::worst_nodes;
use crate::solver::health::symptoms::{Symptom, When};
use crate::solver::health::watch::Exam;

/// What restart files call it.
pub const CODE: u32 = 3;

/// Part of the largest energy supplied so far.
pub const THRESHOLD: f64 = 0.01;

pub const SYMPTOM: Symptom = Symptom {
    code: CODE,
    when: When::Energies,
    threshold: THRESHOLD,
    cause: THRESHOLD,
    measure: |exam, _| {
        let given = exam.totals.contact_gain;
        vec![Evidence { share: given / exam.supplied, amount: given, of: exam.supplied, ..Evidence::default() }]
    },
    place,
    label: |_| "contact makes energy".into(),
    words,
    advice: "look at the last plot state there, with PLOT NODAL, CONTACT: bodies that overlap or are held on both sides, \
             squashed elements and soft layers between stiff ones are the usual causes; try half the TIME STEP SCALE, \
             other CONTACT PASSES, a finer mesh of the softer body, or DEATH for elements that fold",
};

/// Nodes at which the work of contact is the greatest.
pub fn place(exam: &Exam, evidence: &mut Evidence, comm: &mut dyn Communicator) {
    let works: Vec<(u32, f64)> = exam.solver.domain.contact.iter().flat_map(|contact| contact.node_works()).collect();
    evidence.spots = worst_nodes(exam, &works, comm);
}

fn words(evidence: &Evidence) -> String {
    let Evidence { share, amount, .. } = evidence;
    format!(
        "contact has made an energy of {amount:.4e}, {} of the largest supplied so far; its work is the greatest at {}",
        percent(*share),
        evidence.places()
    )
}
