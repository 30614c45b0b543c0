//! Contact on many ranks: who computes what, and the messages.

pub mod contract;
pub mod links;
pub mod regional;
pub mod remote;
pub mod routing;
pub mod traffic;
