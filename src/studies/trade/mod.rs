//! The trade of time for accuracy, measured on the user's own deck: variants of it, what each costs, and how wrong each is.
//!
//! [`knobs::variants`] makes decks that differ from the given one in one thing each; they are run one after the other; `estimate`
//! says what the finest mesh is worth, and how far round-off alone scatters results; [`Judgement`] puts errors, the front and
//! words together.

mod edit;
mod estimate;
mod judge;
pub mod knobs;
mod pictures;
mod quantities;
mod table;

pub use edit::with_command;
pub use estimate::{Refinement, refinement};
pub use judge::{Judgement, Verdict};
pub use knobs::{Knob, Variant};
pub use pictures::pictures;
pub use quantities::{Quantity, Wanted, found, of_deck};
pub use table::{csv, text, words};

/// What came of a variant.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Seconds of processor, or of the clock where the system does not tell.
    pub seconds: f64,
    /// Seconds of the clock that the whole run took.
    pub wall: f64,
    /// Steps taken.
    pub steps: u64,
    /// Time reached.
    pub time: f64,
    /// Most memory held, in bytes, where the system tells.
    pub memory: Option<f64>,
    /// The quantities, in the order in which they were asked for.
    pub values: Vec<f64>,
}

/// A variant with what came of it, or why nothing did.
#[derive(Debug, Clone)]
pub struct Row {
    /// The variant.
    pub variant: Variant,
    /// What was measured, or the reason.
    pub outcome: Result<Measured, String>,
}
