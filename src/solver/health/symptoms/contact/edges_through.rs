//! Edges begin going through faces where no node is inside, which contact does not see.

use super::unheld;
use crate::solver::contact::unheld::ADVICE_ON_EDGES;
use crate::solver::health::symptoms::{Symptom, When};

pub const SYMPTOM: Symptom = Symptom {
    code: 21,
    when: When::Start,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure: |exam, _| exam.facts.unheld[0].iter().map(unheld::evidence).collect(),
    place: |_, _, _| (),
    label: |_| "edges that go through faces in the mesh".into(),
    words: |evidence| unheld::told(evidence).edges_in_words(),
    advice: ADVICE_ON_EDGES,
};
