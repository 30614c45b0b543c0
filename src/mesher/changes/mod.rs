//! What happens to bodies that are there: moved, joined, divided, drawn out.

pub(super) mod merge;
pub(super) mod perturb;
pub(super) mod sweep;
pub(super) mod transform;
pub(super) mod triangles;
