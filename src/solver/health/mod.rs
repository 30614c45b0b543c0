//! A run that looks at itself: symptoms of what goes wrong while it seems to go well, what they were first, and when it
//! must end.
//!
//! A symptom is a measure, a threshold, words and advice: a file in `symptoms` and a line in its list. Each that passes
//! its threshold becomes a [`Finding`], once, or once for each block where it is measured by blocks. Energies are looked
//! at every hundred steps, everything else only where a line of the log or a plot state is due. All ranks look together
//! and find the same.

mod energy;
mod finding;
mod place;
pub(super) mod stop;
mod symptoms;
#[cfg(test)]
mod tests;
mod watch;

pub(super) use finding::percent;
pub use finding::{Evidence, Finding, Spot};
pub(super) use place::elements;
pub(super) use watch::Watch;
pub use watch::of_overlaps;
