//! Enforcement: forces that close the gaps of all contact constraints, and the account of their energy.

pub mod carried;
pub mod certificate;
pub mod constraint;
pub mod enforcer;
pub mod friction;
pub mod gain;
pub mod iterations;
pub mod ledger;
pub mod mobility;
pub mod other_ranks;
pub mod resultants;
mod sweep;
