//! Elements: from positions and velocities to corner forces, block by block in chunks of eight.

mod block;
pub mod geometry;
pub mod hex8;
pub mod hourglass;
pub mod kinematics;
mod pass;

pub use block::{ElementBlock, Group, NewElement};
pub use pass::{PassOutcome, PassSettings, Sink, run};

#[cfg(test)]
mod tests;
