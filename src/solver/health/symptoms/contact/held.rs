//! Nodes that the deck holds or drives on both sides of a contact go into each other, or leave what is between them too little room: no
//! force can keep them apart.

use crate::comm::Communicator;
use crate::solver::health::finding::{Evidence, Spot, percent};
use crate::solver::health::place::{first_of_all, node_id};
use crate::solver::health::symptoms::{Symptom, When};
use crate::solver::health::watch::Exam;

pub const SYMPTOM: Symptom = Symptom {
    code: 14,
    when: When::Lines,
    threshold: 0.05,
    cause: f64::INFINITY,
    measure: |exam, _| {
        let report = exam.solver.domain.contact.as_ref().and_then(|contact| contact.report());
        let share = report.map_or(0.0, |report| report.tally.held);
        vec![Evidence { share, ..Evidence::default() }]
    },
    place,
    label: |_| "contact between nodes that the deck moves".into(),
    words: |evidence| {
        format!(
            "nodes have gone into faces out of which contact cannot move them, by {} of a face: the deck holds or drives both, or faces \
             on both sides of them; the deepest: {}",
            percent(evidence.share),
            evidence.places()
        )
    },
    advice: "let one of the bodies move along the direction in which they meet, or prescribe motions that keep them apart and leave room \
             for what is between them, a sheet's thickness",
};

/// The deepest of these nodes.
fn place(exam: &Exam, evidence: &mut Evidence, comm: &mut dyn Communicator) {
    let own = exam.solver.domain.contact.as_ref().and_then(|contact| contact.held_deepest());
    let key = own.map_or([f64::INFINITY; 2], |(part, node)| [-part, f64::from(node)]);
    let Some(node) = first_of_all(key, comm) else { return };
    let (id, at) = node_id(exam, node as u32, comm);
    evidence.spots[0] = Some(Spot { node: Some(id), element: None, at });
}
