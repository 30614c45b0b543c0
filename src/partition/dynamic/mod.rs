//! Sharing out points that move: a decomposition of space that follows them (Attaway et al. 1996, "Recursive
//! Coordinate Bisectioning"), and two simpler ones to compare it with.
//!
//! [`balance`] finds the cuts, [`Bisection`] says whose a point is and which ranks a box reaches.

mod balance;
mod bisection;
mod median;
mod place;

pub use balance::{Axes, Balanced, balance};
pub use bisection::Bisection;

#[cfg(test)]
mod tests;
