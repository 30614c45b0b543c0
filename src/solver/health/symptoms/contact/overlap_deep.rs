//! Nodes begin so deep inside elements that contact cannot say which way is out.

use crate::solver::contact::Overlap;
use crate::solver::health::finding::Evidence;
use crate::solver::health::symptoms::{Symptom, When};

pub const SYMPTOM: Symptom = Symptom {
    code: 2,
    when: When::Start,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure: |exam, _| vec![evidence(&exam.facts.overlap)],
    place: |exam, evidence, _| evidence.spots[0] = exam.facts.overlap_spots[1],
    label: |_| "nodes begin deep inside elements".into(),
    words: |evidence| {
        let Evidence { count, amount, .. } = evidence;
        format!(
            "{count} nodes of contact surfaces begin deep inside other elements and are not held by contact there, the \
             deepest {amount:.4e} below the nearest face: {}",
            evidence.places()
        )
    },
    advice: "bodies that go through each other in the mesh will not be parted: move them apart, or let them share nodes",
};

/// What there is to see in the mesh.
pub fn evidence(overlap: &Overlap) -> Evidence {
    let (count, amount) = (overlap.deep.nodes as u64, overlap.deep.deepest);
    Evidence { share: count as f64, count, amount, ..Evidence::default() }
}
