//! Nodes that the deck holds or drives on both sides of a contact go into each other, or leave what is between them, or a rigid body, too
//! little room: no force can keep them apart.

use crate::comm::Communicator;
use crate::solver::health::finding::{Evidence, Spot, percent};
use crate::solver::health::place::{first_of_all, node_id};
use crate::solver::health::symptoms::{Symptom, When};
use crate::solver::health::watch::Exam;

pub const SYMPTOM: Symptom = Symptom {
    code: 14,
    when: When::Energies,
    threshold: 0.0,
    cause: 0.0,
    measure: |exam, comm| {
        // Of planes alone each rank knows its own.
        let mut least = [exam.solver.domain.contact.as_ref().map_or(0.0, |contact| -contact.tally.held)];
        comm.all_min(&mut least);
        vec![Evidence { share: -least[0], ..Evidence::default() }]
    },
    place,
    label: |_| "contact between nodes that the deck moves".into(),
    words: |evidence| {
        format!(
            "nodes have gone into faces out of which contact cannot move them, by {} of a face: the deck holds or drives both, or faces \
             on both sides of them or of their rigid body; the deepest: {}",
            percent(evidence.share),
            evidence.places()
        )
    },
    advice: "let one of the bodies move along the direction in which they meet, or prescribe motions that keep them apart and leave room \
             for what is between them, a sheet's thickness or a rigid body",
};

/// The deepest of these nodes.
fn place(exam: &Exam, evidence: &mut Evidence, comm: &mut dyn Communicator) {
    let own = exam.solver.domain.contact.as_ref().and_then(|contact| contact.held_deepest());
    let key = own.map_or([f64::INFINITY; 2], |(part, node)| [-part, f64::from(node)]);
    let Some(node) = first_of_all(key, comm) else { return };
    let (id, at) = node_id(exam, node as u32, comm);
    evidence.spots[0] = Some(Spot { node: Some(id), element: None, at });
}
