//! The surface that the deck lets touch: found in the mesh, laid out as points, faces and edges, and what holds where its parts meet.

pub mod construction;
pub mod exclusions;
pub mod layout;
pub mod pairings;
pub mod reshape;
pub mod skin;
pub mod touching;
