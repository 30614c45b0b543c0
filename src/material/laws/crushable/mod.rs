//! Laws of what is crushed for good by pressure: foams, honeycomb, soils.

// Law files take from this room all that a law is made of.
use super::*;

pub mod low_density_foam;
pub mod orthotropic_crush;
pub mod soil;
mod strength;
