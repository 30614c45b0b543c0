//! Elements that fill their volume, in space and in the plane, and what only these share.

mod answer;
pub mod eight_points;
pub(in crate::solver) mod exact;
mod fluid;
pub mod hexahedron;
pub mod quadrilateral;
mod step_modulus;
