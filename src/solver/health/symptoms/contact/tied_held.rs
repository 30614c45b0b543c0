//! Nodes that follow others by TIED CONTACT are held or driven by the deck otherwise than these: what is said of them has no effect.

use crate::solver::health::finding::Evidence;
use crate::solver::health::symptoms::{Symptom, When};

pub const SYMPTOM: Symptom = Symptom {
    code: 13,
    when: When::Start,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure: |exam, _| {
        let count = exam.facts.tied_held.0 as u64;
        vec![Evidence { share: count as f64, count, ..Evidence::default() }]
    },
    place: |exam, evidence, _| evidence.spots[0] = exam.facts.tied_held.1,
    label: |_| "tied nodes that are held".into(),
    words: |evidence| {
        let Evidence { count, .. } = evidence;
        format!(
            "{count} nodes that the deck holds or drives follow others by TIED CONTACT, not all of which it holds or drives alike, and \
             go where those go: the first is {}",
            evidence.places()
        )
    },
    advice: "hold or drive the nodes that they follow as well, such as all of a plane of symmetry on both sides of the joint, or \
             change the order of the side sets",
};
