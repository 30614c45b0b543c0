//! What stands on the sheet: texts around the body, arrows, several states side by side or one after the other.

pub mod annotate;
pub mod arrows;
pub mod film;
pub mod row;
