//! Laws of metals: von Mises plasticity, each with its own hardening.

// Law files take from this room all that a law is made of.
use super::*;

pub mod elastic_plastic;
mod fracture;
pub mod johnson_cook;
pub mod piecewise_plastic;
pub mod plastic;
pub mod power_hardening;
pub mod viscoplastic;

/// √(2/3): the radius of the yield surface in the space of deviators, over the yield stress of a bar in tension.
const ROOT_TWO_THIRDS: f64 = 0.816_496_580_927_726;
