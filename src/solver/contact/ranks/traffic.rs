//! Fixed patterns of messages: between two searches the same entries go the same ways.

use crate::comm::{Communicator, Peer};
use std::collections::BTreeMap;

/// Entries by the rank that they go to or come from, each list in an order on which both sides agree.
pub type Lists = BTreeMap<usize, Vec<u32>>;

/// Which entries go where.
#[derive(Debug, Clone, Default)]
pub struct MessagePattern {
    peers: Vec<Peer>,
    send: Vec<Vec<u32>>,
    receive: Vec<Vec<u32>>,
    /// Entries that stay here: from, to.
    own: Vec<(u32, u32)>,
}

impl MessagePattern {
    /// A pattern that sends `send` and receives `receive`. Lists of this rank itself are copied.
    pub fn new(mut send: Lists, mut receive: Lists, rank: usize) -> MessagePattern {
        let [from, to] = [send.remove(&rank), receive.remove(&rank)].map(Option::unwrap_or_default);
        let mut ranks: Vec<usize> = send.keys().chain(receive.keys()).copied().collect();
        ranks.sort_unstable();
        ranks.dedup();
        let lists = |of: &mut Lists| ranks.iter().map(|rank| of.remove(rank).unwrap_or_default()).collect();
        MessagePattern {
            own: from.into_iter().zip(to).collect(),
            send: lists(&mut send),
            receive: lists(&mut receive),
            peers: ranks.iter().map(|&rank| Peer { rank, ..Default::default() }).collect(),
        }
    }

    /// Entries that go to other ranks.
    pub fn sent(&self) -> impl Iterator<Item = u32> + '_ {
        self.send.iter().flatten().copied()
    }

    /// Sends `W` numbers of every entry to where it goes, on this rank too.
    pub fn exchange<const W: usize, D: ?Sized>(
        &mut self,
        data: &mut D,
        give: impl Fn(&D, u32) -> [f64; W],
        take: impl Fn(&mut D, u32, [f64; W]),
        comm: &mut dyn Communicator,
    ) {
        self.send(|entry| give(data, entry), comm);
        for &(from, to) in &self.own {
            let values = give(data, from);
            take(data, to, values);
        }
        self.receive(|entry, values| take(data, entry, values), comm);
    }

    /// Sends `W` numbers of every entry to other ranks; [`MessagePattern::receive`] must follow.
    pub fn send<const W: usize>(&mut self, give: impl Fn(u32) -> [f64; W], comm: &mut dyn Communicator) {
        for ((peer, send), receive) in self.peers.iter_mut().zip(&self.send).zip(&self.receive) {
            peer.send.clear();
            peer.send.extend(send.iter().flat_map(|&entry| give(entry)));
            peer.receive.resize(W * receive.len(), 0.0);
        }
        comm.start_exchange(&mut self.peers);
    }

    /// Takes what other ranks have sent.
    pub fn receive<const W: usize>(&mut self, mut take: impl FnMut(u32, [f64; W]), comm: &mut dyn Communicator) {
        comm.finish_exchange(&mut self.peers);
        for (peer, receive) in self.peers.iter().zip(&self.receive) {
            for (&entry, values) in receive.iter().zip(peer.receive.chunks_exact(W)) {
                let mut row = [0.0; W];
                row.copy_from_slice(values);
                take(entry, row);
            }
        }
    }
}

/// Messages whose length differs from step to step, between ranks that know each other.
#[derive(Debug, Clone, Default)]
pub struct VariableMessages {
    peers: Vec<Peer>,
    lengths: Vec<Peer>,
}

impl VariableMessages {
    /// Between this rank and others, each of which names this one.
    pub fn new(ranks: impl IntoIterator<Item = usize>) -> VariableMessages {
        let peers: Vec<Peer> = ranks.into_iter().map(|rank| Peer { rank, ..Default::default() }).collect();
        VariableMessages { lengths: peers.clone(), peers }
    }

    /// Sends to each rank what `fill` writes for it, and hands what has come to `read`, with the rank that has sent it, by ascending rank.
    pub fn exchange(
        &mut self,
        mut fill: impl FnMut(usize, &mut Vec<f64>),
        mut read: impl FnMut(usize, &[f64]),
        comm: &mut dyn Communicator,
    ) {
        for (peer, length) in self.peers.iter_mut().zip(&mut self.lengths) {
            peer.send.clear();
            fill(peer.rank, &mut peer.send);
            length.send.clear();
            length.send.push(peer.send.len() as f64);
            length.receive.resize(1, 0.0);
        }
        comm.start_exchange(&mut self.lengths);
        comm.finish_exchange(&mut self.lengths);
        for (peer, length) in self.peers.iter_mut().zip(&self.lengths) {
            peer.receive.resize(length.receive[0] as usize, 0.0);
        }
        comm.start_exchange(&mut self.peers);
        comm.finish_exchange(&mut self.peers);
        self.peers.iter().for_each(|peer| read(peer.rank, &peer.receive));
    }
}
