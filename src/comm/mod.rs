//! Ranks that exchange messages. The solver is written once against [`Communicator`]; threads of one process and
//! MPI processes both provide it.

mod counted;
mod exact_sum;
mod launch;
#[cfg(feature = "mpi")]
pub mod mpi;
#[cfg(feature = "mpi")]
mod pending;
pub(crate) mod reduce;
mod serial;
mod spread;
mod threads;
mod wait;

pub use counted::{Count, Counted, Counts, Flow, Traffic, rounds};
pub use exact_sum::ExactSum;
pub use launch::{RankFailure, launched_by_mpi, run_threads};
pub use serial::Serial;
pub use spread::{Spread, spreads};
pub use threads::{RankLost, Threads, threads};

/// What one rank can say to the others. Every call but the point-to-point exchange is collective: all ranks make
/// the same collective calls in the same order. A call that waits for a rank that has failed does not return.
pub trait Communicator: Send {
    /// This rank's number, 0 ≤ rank < size.
    fn rank(&self) -> usize;
    /// Number of ranks.
    fn size(&self) -> usize;
    /// Says which part of a run the calls from here on serve; only a communicator that counts listens.
    fn enter(&mut self, _: Traffic) {}
    /// Starts sending every peer's `send` buffer; returns at once so that work can overlap. Until the exchange is
    /// finished both buffers belong to the communicator: their contents and lengths mean nothing. One exchange may
    /// be under way at a time; other calls may come before it is finished. Each rank comes once among the peers.
    fn start_exchange(&mut self, peers: &mut [Peer]);
    /// Completes the exchange begun by `start_exchange` with the same peers: fills every `receive` buffer. The
    /// `send` buffers have their lengths again, but not their contents.
    fn finish_exchange(&mut self, peers: &mut [Peer]);
    /// Element-wise minimum over all ranks, the same on every rank. NaN counts as smaller than any number, and −0
    /// as smaller than +0.
    fn all_min(&mut self, values: &mut [f64]);
    /// Element-wise wrapping sum of integers over all ranks, the same on every rank.
    fn all_sum(&mut self, values: &mut [u64]);
    /// Unstructured exchange (Attaway et al. 1996, figure 5): sends each `(rank, bytes)`, returns what others sent
    /// here as `(rank, bytes)` in ascending rank order. No rank needs to know who will send to it.
    fn sparse_exchange(&mut self, outgoing: Vec<(usize, Vec<u8>)>) -> Vec<(usize, Vec<u8>)>;
    /// Every rank's bytes on rank 0, in rank order; `None` on the others.
    fn gather(&mut self, bytes: Vec<u8>) -> Option<Vec<Vec<u8>>>;
    /// Rank 0's bytes on every rank.
    fn broadcast(&mut self, bytes: &mut Vec<u8>);
    /// Waits for all ranks.
    fn barrier(&mut self);
}

/// The numbers that every other rank gives, by rank; all ranks call it.
pub fn numbers_of_others(own: &[u32], comm: &mut dyn Communicator) -> Vec<(usize, Vec<u32>)> {
    let bytes: Vec<u8> = own.iter().flat_map(|number| number.to_le_bytes()).collect();
    let others = (0..comm.size()).filter(|&rank| rank != comm.rank());
    let incoming = comm.sparse_exchange(others.map(|rank| (rank, bytes.clone())).collect());
    let number = |b: &[u8]| u32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    incoming.into_iter().map(|(rank, bytes)| (rank, bytes.chunks_exact(4).map(number).collect())).collect()
}

/// Every rank's bytes one after the other, in rank order, on every rank. Two collective calls: by way of rank 0 they go once to each
/// rank.
pub fn gather_for_all(own: Vec<u8>, comm: &mut dyn Communicator) -> Vec<u8> {
    let mut all = comm.gather(own).map_or_else(Vec::new, |parts| parts.concat());
    comm.broadcast(&mut all);
    all
}

/// One neighbour of a fixed exchange pattern, with buffers that live as long as the pattern.
#[derive(Debug, Clone, Default)]
pub struct Peer {
    /// The neighbour's rank.
    pub rank: usize,
    /// What goes there.
    pub send: Vec<f64>,
    /// What comes from there; its length is fixed by the pattern.
    pub receive: Vec<f64>,
}
