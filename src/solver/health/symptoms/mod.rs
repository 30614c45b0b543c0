//! What a run may suffer from, one file each: a measure, a threshold, words and advice.

mod below_rest;
mod beyond_law;
mod brief;
pub mod contact;
mod corners;
mod damped_flow;
mod dead_at_start;
mod debris;
mod given_back;
pub mod hourglass;
pub mod imbalance;
mod jump;
mod runaway;
mod short_pulse;

use contact::{
    body_inside, edges_through, gain, held, overlap_deep, overlap_moved, overlap_stuck, passes, sunk, tied_held,
};

use super::finding::Evidence;
use super::watch::Exam;
use crate::comm::Communicator;

/// Something that goes wrong in a run while it seems to go well.
pub struct Symptom {
    /// What restart files call it. It never changes, and grows along the list.
    pub code: u32,
    /// When it is looked at.
    pub when: When,
    /// The share above which it is worth a warning.
    pub threshold: f64,
    /// The share above which it can be why an element inverts or energy runs away; infinite where it never is.
    pub cause: f64,
    /// Measures it now, for the whole body or for each block. All ranks call it and get the same.
    pub measure: fn(&Exam, &mut dyn Communicator) -> Vec<Evidence>,
    /// Finds where it is worst, once it has passed the threshold. All ranks call it and get the same.
    pub place: fn(&Exam, &mut Evidence, &mut dyn Communicator),
    /// What it is called in a list of warnings.
    pub label: fn(&Evidence) -> String,
    /// What was seen, with number and place.
    pub words: fn(&Evidence) -> String,
    /// What the analyst can try.
    pub advice: &'static str,
}

/// All symptoms. Of those seen in one look the first counts as the one that came first.
pub static SYMPTOMS: [Symptom; 24] = [
    dead_at_start::SYMPTOM,
    overlap_moved::SYMPTOM,
    overlap_deep::SYMPTOM,
    overlap_stuck::SYMPTOM,
    gain::SYMPTOM,
    held::SYMPTOM,
    hourglass::SYMPTOM,
    given_back::SYMPTOM,
    corners::SYMPTOM,
    runaway::SYMPTOM,
    imbalance::SYMPTOM,
    passes::SYMPTOM,
    sunk::SYMPTOM,
    debris::SYMPTOM,
    brief::SYMPTOM,
    tied_held::SYMPTOM,
    short_pulse::SYMPTOM,
    jump::SYMPTOM,
    beyond_law::BEYOND_HUGONIOT,
    beyond_law::BEYOND_DATA,
    damped_flow::SYMPTOM,
    below_rest::SYMPTOM,
    edges_through::SYMPTOM,
    body_inside::SYMPTOM,
];

/// When a symptom is looked at, from seldom to often.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum When {
    /// At the first state: what the mesh begins with.
    Start,
    /// Where a line of the log or a plot state is due and the last such look was some time ago, see [`When::SOME_TIME`], and at the end: what
    /// costs as much as several steps.
    SomeLines,
    /// Where a line of the log or a plot state is due: what costs about as much as a step.
    Lines,
    /// Whenever energies are summed.
    Energies,
}

impl When {
    /// Steps between looks at what is due at [`When::SomeLines`]: lines may be as close as a run is short, and must not cost more than it.
    pub const SOME_TIME: u64 = 100;

    /// Whether it is due at a step where `look` is.
    pub fn is_due(self, look: When, step: u64) -> bool {
        match self {
            When::Start => step == 0,
            When::SomeLines => look == When::SomeLines,
            When::Lines => look != When::Energies,
            When::Energies => true,
        }
    }
}

/// Has no place.
fn nowhere(_: &Exam, _: &mut Evidence, _: &mut dyn Communicator) {}
