//! What contact has met in a run, beside its forces: what the deck could leave out, and what the scene lacked, follow from it.

pub mod arcs;
pub mod meetings;
pub mod report;
pub mod seen;
