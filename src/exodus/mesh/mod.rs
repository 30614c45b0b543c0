//! Meshes in files: read from EXODUS II and GENESIS, checked, and written.

pub(in crate::exodus) mod genesis;
pub(in crate::exodus) mod read;
pub mod tables;
pub(in crate::exodus) mod write;
