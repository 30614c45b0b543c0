//! All points on every rank: each rank sends what it owns to all others.

use super::points::Points;
use super::setup::ABSENT;
use crate::comm::{Communicator, Peer, numbers_of_others};
use crate::solver::nodes::Nodes;

/// Who owns which point, and buffers to tell the others.
pub struct Gather {
    /// Points that this rank answers for, ascending.
    own: Vec<u32>,
    /// Points of each peer.
    theirs: Vec<Vec<u32>>,
    peers: Vec<Peer>,
}

impl Gather {
    /// `None` on one rank. All ranks call it.
    pub fn new(here: &[u32], nodes: &Nodes, comm: &mut dyn Communicator) -> Option<Gather> {
        if comm.size() == 1 {
            return None;
        }
        let owned = |node: u32| node != ABSENT && nodes.owned[node as usize];
        let own: Vec<u32> = (0..here.len() as u32).filter(|&point| owned(here[point as usize])).collect();
        let (ranks, theirs): (Vec<usize>, Vec<Vec<u32>>) = numbers_of_others(&own, comm).into_iter().unzip();
        let peers = ranks.into_iter().map(|rank| Peer { rank, ..Default::default() }).collect();
        Some(Gather { own, theirs, peers })
    }

    /// Inverse masses of all points.
    pub fn share_masses(&mut self, points: &mut Points, comm: &mut dyn Communicator) {
        let own: Vec<f64> = self.own.iter().flat_map(|&point| points.inverse_mass[point as usize]).collect();
        self.exchange(own, 3, comm);
        for (theirs, peer) in self.theirs.iter().zip(&self.peers) {
            for (&point, values) in theirs.iter().zip(peer.receive.chunks_exact(3)) {
                points.inverse_mass[point as usize].copy_from_slice(values);
            }
        }
    }

    /// Positions and predicted velocities of all points.
    pub fn share_motion(&mut self, points: &mut Points, drift: f64, comm: &mut dyn Communicator) {
        let motion = |&point: &u32| {
            let ([x, y, z], [u, v, w]) = (points.start[point as usize], points.velocity[point as usize]);
            [x, y, z, u, v, w]
        };
        let own: Vec<f64> = self.own.iter().flat_map(motion).collect();
        self.exchange(own, 6, comm);
        for (theirs, peer) in self.theirs.iter().zip(&self.peers) {
            for (&point, m) in theirs.iter().zip(peer.receive.chunks_exact(6)) {
                points.set(point as usize, [m[0], m[1], m[2]], [m[3], m[4], m[5]], drift);
            }
        }
    }

    fn exchange(&mut self, own: Vec<f64>, width: usize, comm: &mut dyn Communicator) {
        for (peer, theirs) in self.peers.iter_mut().zip(&self.theirs) {
            peer.send.clone_from(&own);
            peer.receive.resize(width * theirs.len(), 0.0);
        }
        comm.start_exchange(&mut self.peers);
        comm.finish_exchange(&mut self.peers);
    }
}
