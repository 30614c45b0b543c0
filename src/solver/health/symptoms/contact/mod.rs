//! What contact and tied surfaces may suffer from, one file each.

pub mod gain;
pub mod held;
pub mod overlap_deep;
pub mod overlap_moved;
pub mod passes;
pub mod sunk;
pub mod tied_held;
