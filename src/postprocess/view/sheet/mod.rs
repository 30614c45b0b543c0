//! What stands on the sheet: texts around the body, arrows, several states side by side or one after the other.

pub mod annotate;
pub mod arrows;
mod cover;
pub mod film;
pub mod planes;
pub mod row;
