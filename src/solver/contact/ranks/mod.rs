//! Contact on many ranks: who computes what, and the messages.

pub mod communication_plan;
pub mod iteration_messages;
pub mod node_ranks;
pub mod owner_ranks;
pub mod regional;
pub mod remote;
pub mod routing;
pub mod traffic;
