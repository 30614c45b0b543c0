//! Enforcement: forces that close the gaps of all contact constraints, and the account of their energy.

pub mod accounts;
pub mod carried;
pub mod constraint;
pub mod enforcer;
pub mod friction;
mod giving_way;
pub mod iterates;
pub mod iterations;
pub mod joints;
pub mod mobility;
mod node_pairs;
pub mod other_ranks;
mod pinned;
pub mod pinned_bodies;
mod sweep;
