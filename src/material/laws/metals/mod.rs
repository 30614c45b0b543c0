//! Laws of metals: von Mises plasticity, each with its own hardening.

// Law files take from this room all that a law is made of.
use super::*;

pub mod elastic_plastic;
pub mod johnson_cook;
pub mod piecewise_plastic;
pub mod plastic;
pub mod power_hardening;
pub mod viscoplastic;
