//! Sharing out points that move: a decomposition of space that follows them (Attaway et al. 1996, "Recursive
//! Coordinate Bisectioning"), and two simpler ones to compare it with.
//!
//! [`balance`] finds the cuts of a [`Bisection`], from those of the step before if need be; [`Bisection::owner`] says
//! whose a point is, [`Regions::ranks_meeting`] who else must know of a box, and [`Parcels`] carry it there. With one
//! axis for all cuts the regions are slices; [`Boxes`] are the boxes of what ranks hold by another decomposition.

mod balance;
mod bisection;
mod boxes;
mod median;
mod parcels;
mod place;

pub use balance::{Axes, Balanced, Earlier, balance};
pub use bisection::Bisection;
pub use boxes::Boxes;
pub use parcels::{Parcels, Records};

/// Which part of space concerns which rank.
#[derive(Debug, Clone, PartialEq)]
pub enum Regions {
    /// Regions between cuts, which fill space without overlapping: bisection or slices, by their [`Axes`].
    Cuts(Bisection),
    /// A box around what each rank holds.
    Boxes(Boxes),
}

impl Regions {
    /// Number of ranks.
    pub fn size(&self) -> usize {
        match self {
            Regions::Cuts(bisection) => bisection.size(),
            Regions::Boxes(boxes) => boxes.size(),
        }
    }

    /// Puts into `out` the ranks, ascending, whose regions the box from `low` to `high` reaches; touching counts. A
    /// side that is not a number reaches everywhere along its axis, and a box with a `low` above its `high` nothing.
    pub fn ranks_meeting(&self, low: [f64; 3], high: [f64; 3], out: &mut Vec<u32>) {
        match self {
            Regions::Cuts(bisection) => bisection.ranks_meeting(low, high, out),
            Regions::Boxes(boxes) => boxes.ranks_meeting(low, high, out),
        }
    }

    /// The lower and upper sides of a rank's region.
    pub fn region(&self, rank: usize) -> ([f64; 3], [f64; 3]) {
        match self {
            Regions::Cuts(bisection) => bisection.region(rank),
            Regions::Boxes(boxes) => boxes.region(rank),
        }
    }
}

#[cfg(test)]
mod tests;
