//! Elements begin inside other bodies without any node that contact knows to be there.

use super::unheld;
use crate::solver::contact::unheld::ADVICE_ON_ELEMENTS;
use crate::solver::health::symptoms::{Symptom, When};

pub const SYMPTOM: Symptom = Symptom {
    code: 22,
    when: When::Start,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure: |exam, _| exam.facts.unheld[1].iter().map(unheld::evidence).collect(),
    place: |_, _, _| (),
    label: |_| "elements inside other bodies in the mesh".into(),
    words: |evidence| unheld::told(evidence).elements_in_words(),
    advice: ADVICE_ON_ELEMENTS,
};
