//! Sharing out points that move: a decomposition of space that follows them (Attaway et al. 1996, "Recursive
//! Coordinate Bisectioning"), and a simpler one to compare it with.
//!
//! [`balance`] finds the cuts of a [`Bisection`], from those of the step before if need be; [`Bisection::owner`] says
//! whose a point is, and [`Parcels`] carry it there. With one axis for all cuts the regions are slices.

mod balance;
mod bisection;
mod median;
mod parcels;
mod place;

pub use balance::{Axes, Balanced, Earlier, balance};
pub use bisection::Bisection;
pub use parcels::{Parcels, Records};

#[cfg(test)]
mod tests;
