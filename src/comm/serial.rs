//! One rank alone: every call is free.

use super::{Communicator, Peer};

/// The only rank of a run on one core.
#[derive(Debug, Clone, Copy, Default)]
pub struct Serial;

impl Communicator for Serial {
    fn rank(&self) -> usize {
        0
    }

    fn size(&self) -> usize {
        1
    }

    fn start_exchange(&mut self, _: &mut [Peer]) {}

    fn finish_exchange(&mut self, peers: &mut [Peer]) {
        for peer in peers {
            peer.receive.copy_from_slice(&peer.send);
        }
    }

    fn all_min(&mut self, _: &mut [f64]) {}

    fn all_sum(&mut self, _: &mut [u64]) {}

    fn sparse_exchange(&mut self, outgoing: Vec<(usize, Vec<u8>)>) -> Vec<(usize, Vec<u8>)> {
        outgoing
    }

    fn gather(&mut self, bytes: Vec<u8>) -> Option<Vec<Vec<u8>>> {
        Some(vec![bytes])
    }

    fn broadcast(&mut self, _: &mut Vec<u8>) {}

    fn barrier(&mut self) {}
}
