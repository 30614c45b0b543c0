//! What contact and tied surfaces may suffer from, one file each.

pub mod body_inside;
pub mod edges_through;
pub mod gain;
pub mod held;
pub mod overlap_deep;
pub mod overlap_moved;
pub mod overlap_stuck;
pub mod passes;
pub mod sunk;
pub mod tied_held;
mod unheld;
