//! Positions of all nodes.

use crate::common::shared::Shared;

/// A list of positions, lengths: mesh, body and nodes have the same one until it is changed.
pub type Coordinates = Shared<[f64; 3]>;
