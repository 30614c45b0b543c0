//! The detailed check: which candidates touch in the coming step, and which nodes are where they should not be.

pub mod edge_edge;
pub mod embedded;
pub mod initial_overlap;
pub mod node_face;
pub mod overlap;
pub mod planes;

/// Cosine of the angle between two planes that count as one.
const FLUSH: f64 = 0.99;
