//! Overlaps of the mesh that moving nodes could not remove: of rigid bodies, between held nodes or between others.

use crate::solver::contact::Overlap;
use crate::solver::health::finding::Evidence;
use crate::solver::health::symptoms::{Symptom, When};

pub const SYMPTOM: Symptom = Symptom {
    code: 23,
    when: When::Start,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure: |exam, _| vec![evidence(&exam.facts.overlap)],
    place: |exam, evidence, _| evidence.spots[0] = exam.facts.overlap_spots[2],
    label: |_| "overlaps that could not be taken out".into(),
    words: |evidence| {
        let Evidence { count, amount, .. } = evidence;
        format!(
            "bodies overlap in the mesh, and {count} nodes stay behind faces, since rigid bodies, nodes that the deck holds and what \
             is between others are not moved; the deepest by {amount:.4e}: {}",
            evidence.places()
        )
    },
    advice: "contact lets none of them sink deeper, as with CONTACT OVERLAP, KEEP; move the bodies apart in the mesh where they \
             shall begin without an overlap",
};

/// What there is to see in the mesh.
pub fn evidence(overlap: &Overlap) -> Evidence {
    let (count, amount) = (overlap.stuck.nodes as u64, overlap.stuck.deepest);
    Evidence { share: count as f64, count, amount, ..Evidence::default() }
}
