//! What a language is, as data: commands with their fields, as `.cards` files have them.

pub(super) mod fields;
pub(super) mod grammar;
pub(super) mod language;
pub(super) mod plane;
