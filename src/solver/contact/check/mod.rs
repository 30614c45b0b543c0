//! The detailed check: which candidates touch in the coming step, and which nodes are where they should not be.

mod behind;
mod body_pairs;
mod deep;
pub mod edge_edge;
pub mod embedded;
mod enclosing;
mod engulfed;
pub mod initial_overlap;
pub mod node_face;
pub mod overlap;
mod pierced;
pub mod planes;
mod sunk;
pub mod unheld;

/// Cosine of the angle between two planes that count as one.
const FLUSH: f64 = 0.99;
