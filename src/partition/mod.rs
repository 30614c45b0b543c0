//! Cutting a mesh into one share per rank: [`rcb`] says which rank computes which element, [`space_filling_order`]
//! in which order elements are numbered, and a [`Decomposition`] what each rank holds and exchanges. Points that
//! move are shared out anew, by all ranks together, in [`dynamic`].

mod curve;
pub mod dynamic;
mod halo;
mod rcb;
mod spread;

pub use curve::space_filling_order;
pub use halo::{Contributors, Decomposition, LocalGroup, Neighbour, Share, SharedNode, Source};
pub use rcb::rcb;
