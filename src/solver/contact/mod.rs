//! Contact of deformable surfaces.

pub mod search;
