//! Overlaps of the mesh were taken out by moving nodes before the run.

use crate::solver::contact::Overlap;
use crate::solver::health::finding::Evidence;
use crate::solver::health::symptoms::{Symptom, When};

pub const SYMPTOM: Symptom = Symptom {
    code: 1,
    when: When::Start,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure: |exam, _| vec![evidence(&exam.facts.overlap)],
    place: |exam, evidence, _| evidence.spots[0] = exam.facts.overlap_spots[0],
    label: |_| "nodes moved out of initial overlaps".into(),
    words: |evidence| {
        let Evidence { count, amount, .. } = evidence;
        format!(
            "bodies overlap in the mesh: {count} nodes were moved out of faces before the run, by up to {amount:.4e}: {}",
            evidence.places()
        )
    },
    advice: "look at the first plot state: the run begins with the shapes that it shows; a mesh with a gap there, or with \
             faces that lie upon each other, needs no moves",
};

/// What there is to see in the mesh.
pub fn evidence(overlap: &Overlap) -> Evidence {
    let (count, amount) = (overlap.nodes as u64, overlap.farthest);
    Evidence { share: count as f64, count, amount, ..Evidence::default() }
}
