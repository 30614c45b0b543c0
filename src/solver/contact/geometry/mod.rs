//! Geometry of contact: faces and edges of the surface, the motion of the contact nodes, projections, crossing times, swept boxes.

pub mod crossing;
pub mod edges;
pub mod faces;
mod grown_together;
pub mod motion;
pub mod paths;
pub mod projection;
pub mod sides;
pub mod strip;
pub mod surface;
pub mod swept_box;
