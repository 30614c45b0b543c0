//! The shapes that a recipe can name: each makes a body of its own.

pub(super) mod cylinder;
pub(super) mod hex_box;
pub(super) mod line;
pub(super) mod patch;
pub(super) mod pole;
pub(super) mod section;
pub(super) mod sheet;
pub(super) mod spacing;
pub(super) mod sphere;
pub(super) mod tube;
