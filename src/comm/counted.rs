//! Counting what a rank says to the others: messages, bytes and collective calls, by the part of a run that they serve.

use super::{Communicator, Peer};

/// The part of a run that messages serve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Traffic {
    /// All before the first step.
    Setup,
    /// Forces of elements at shared nodes.
    Elements,
    /// What all ranks agree on: the size of the step, requests, failures.
    Step,
    /// Elements that are taken away.
    Erosion,
    /// Finding what contact has to look at: who treats which points and faces.
    ContactSearch,
    /// Motion to where contact is computed, and forces back, once a step.
    ContactMotion,
    /// Contact forces, in every pass.
    ContactPasses,
    /// Sums of energies, the log and the files.
    Output,
}

impl Traffic {
    /// All parts with their names in the log.
    pub const ALL: [(Traffic, &'static str); 8] = [
        (Traffic::Setup, "SETUP"),
        (Traffic::Elements, "ELEMENTS"),
        (Traffic::Step, "STEP"),
        (Traffic::Erosion, "EROSION"),
        (Traffic::ContactSearch, "CONTACT SEARCH"),
        (Traffic::ContactMotion, "CONTACT MOTION"),
        (Traffic::ContactPasses, "CONTACT PASSES"),
        (Traffic::Output, "OUTPUT"),
    ];
}

/// Messages in one direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Flow {
    /// How many. A buffer with nothing in it is none.
    pub messages: u64,
    /// Bytes in them.
    pub bytes: u64,
    /// How many of these go from node to node.
    pub far_bytes: u64,
}

/// What one rank sent and received from rank to rank, and its collective calls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Count {
    /// What it sent.
    pub sent: Flow,
    /// What it received.
    pub received: Flow,
    /// Collective calls.
    pub collectives: u64,
    /// Bytes that this rank sends in them, when a call is made of ⌈log₂ ranks⌉ rounds in which ranks talk in pairs.
    pub collective_bytes: u64,
}

impl Flow {
    fn add(&mut self, bytes: usize, far: bool) {
        self.messages += u64::from(bytes > 0);
        self.bytes += bytes as u64;
        self.far_bytes += if far { bytes as u64 } else { 0 };
    }

    fn and(self, other: Flow) -> Flow {
        Flow {
            messages: self.messages + other.messages,
            bytes: self.bytes + other.bytes,
            far_bytes: self.far_bytes + other.far_bytes,
        }
    }
}

impl Count {
    /// Both together.
    pub fn and(self, other: Count) -> Count {
        Count {
            sent: self.sent.and(other.sent),
            received: self.received.and(other.received),
            collectives: self.collectives + other.collectives,
            collective_bytes: self.collective_bytes + other.collective_bytes,
        }
    }
}

/// Rounds of a collective call in which ranks talk in pairs: ⌈log₂ ranks⌉.
pub fn rounds(ranks: usize) -> u32 {
    usize::BITS - ranks.saturating_sub(1).leading_zeros()
}

/// The counts of one rank, part by part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts([Count; Traffic::ALL.len()]);

impl Counts {
    /// What one part sent.
    pub fn of(&self, part: Traffic) -> Count {
        self.0[part as usize]
    }
}

/// A communicator that counts what goes through it, from [`Traffic::Setup`] on. What it passes on is unchanged.
pub struct Counted<'a> {
    inner: &'a mut dyn Communicator,
    part: Traffic,
    rounds: u64,
    node: usize,
    ranks_of_node: usize,
    counts: Counts,
}

impl<'a> Counted<'a> {
    /// Counts what goes through `inner`; every rank is a node of its own.
    pub fn new(inner: &'a mut dyn Communicator) -> Counted<'a> {
        Counted::on_nodes(inner, 1)
    }

    /// Counts what goes through `inner`, when so many consecutive ranks, at least one, are on each node.
    pub fn on_nodes(inner: &'a mut dyn Communicator, ranks_of_node: usize) -> Counted<'a> {
        let (rounds, node) = (u64::from(rounds(inner.size())), inner.rank() / ranks_of_node);
        Counted { inner, part: Traffic::Setup, rounds, node, ranks_of_node, counts: Counts::default() }
    }

    /// What was counted so far.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    fn count(&mut self) -> &mut Count {
        &mut self.counts.0[self.part as usize]
    }

    fn sends(&mut self, to: usize, bytes: usize) {
        let far = to / self.ranks_of_node != self.node;
        self.count().sent.add(bytes, far);
    }

    fn receives(&mut self, from: usize, bytes: usize) {
        let far = from / self.ranks_of_node != self.node;
        self.count().received.add(bytes, far);
    }

    /// A collective call in which this rank sends so many bytes in all. Alone there is nobody to call.
    fn collective(&mut self, bytes: u64) {
        if self.rounds > 0 {
            let count = self.count();
            count.collectives += 1;
            count.collective_bytes += bytes;
        }
    }

    /// Every round of a reduction passes on all values, of eight bytes each.
    fn reduction(&mut self, values: usize) {
        self.collective(8 * values as u64 * self.rounds);
    }
}

/// Bytes of a buffer of numbers.
fn bytes(numbers: &[f64]) -> usize {
    std::mem::size_of_val(numbers)
}

impl Communicator for Counted<'_> {
    fn rank(&self) -> usize {
        self.inner.rank()
    }

    fn size(&self) -> usize {
        self.inner.size()
    }

    fn enter(&mut self, part: Traffic) {
        self.part = part;
        self.inner.enter(part);
    }

    fn start_exchange(&mut self, peers: &mut [Peer]) {
        peers.iter().for_each(|peer| self.sends(peer.rank, bytes(&peer.send)));
        self.inner.start_exchange(peers);
    }

    fn finish_exchange(&mut self, peers: &mut [Peer]) {
        self.inner.finish_exchange(peers);
        peers.iter().for_each(|peer| self.receives(peer.rank, bytes(&peer.receive)));
    }

    fn all_min(&mut self, values: &mut [f64]) {
        self.reduction(values.len());
        self.inner.all_min(values);
    }

    fn all_sum(&mut self, values: &mut [u64]) {
        self.reduction(values.len());
        self.inner.all_sum(values);
    }

    fn sparse_exchange(&mut self, outgoing: Vec<(usize, Vec<u8>)>) -> Vec<(usize, Vec<u8>)> {
        // Who sends to whom is folded first: half of one number a rank, then a quarter, and so on.
        self.collective(8 * (self.inner.size() as u64 - 1));
        outgoing.iter().for_each(|(to, bytes)| self.sends(*to, bytes.len()));
        let incoming = self.inner.sparse_exchange(outgoing);
        incoming.iter().for_each(|(from, bytes)| self.receives(*from, bytes.len()));
        incoming
    }

    fn gather(&mut self, bytes: Vec<u8>) -> Option<Vec<Vec<u8>>> {
        self.collective(bytes.len() as u64);
        self.inner.gather(bytes)
    }

    fn broadcast(&mut self, bytes: &mut Vec<u8>) {
        self.inner.broadcast(bytes);
        self.collective(bytes.len() as u64);
    }

    fn barrier(&mut self) {
        self.collective(0);
        self.inner.barrier();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::run_threads;

    #[test]
    fn rounds_are_logarithms() {
        assert_eq!([1, 2, 3, 4, 5, 8, 9, 1024].map(rounds), [0, 1, 2, 2, 3, 3, 4, 10]);
    }

    /// A ring of four in which each rank sends as many numbers as its own rank says, so that rank 0 sends nothing.
    #[test]
    fn every_kind_of_call_is_counted_in_its_part() {
        let counts = run_threads(4, |inner| {
            let comm = &mut Counted::on_nodes(inner, 2);
            let rank = comm.rank();
            comm.all_sum(&mut [1, 2, 3]);
            comm.enter(Traffic::Elements);
            let (to, from) = ((rank + 1) % 4, (rank + 3) % 4);
            let mut peers = [
                Peer { rank: to, send: vec![0.0; rank], receive: Vec::new() },
                Peer { rank: from, send: Vec::new(), receive: vec![0.0; from] },
            ];
            comm.start_exchange(&mut peers);
            comm.finish_exchange(&mut peers);
            comm.enter(Traffic::ContactSearch);
            comm.sparse_exchange(vec![(0, vec![7; 5]), (to, vec![7; 2])]);
            comm.enter(Traffic::Output);
            comm.gather(vec![0; 11]);
            comm.broadcast(&mut vec![0; if rank == 0 { 9 } else { 1 }]);
            comm.barrier();
            Ok::<_, ()>(comm.counts())
        });
        for (rank, counts) in (0u64..).zip(counts.unwrap()) {
            let from = (rank + 3) % 4;
            let setup = counts.of(Traffic::Setup);
            assert_eq!(setup, Count { collectives: 1, collective_bytes: 2 * 24, ..Count::default() });
            let elements = counts.of(Traffic::Elements);
            assert_eq!((elements.sent.messages, elements.sent.bytes), (u64::from(rank > 0), 8 * rank));
            assert_eq!((elements.received.messages, elements.received.bytes), (u64::from(from > 0), 8 * from));
            // Ranks 1 and 3 end a node.
            assert_eq!(elements.sent.far_bytes, if rank % 2 == 1 { 8 * rank } else { 0 });
            assert_eq!(elements.received.far_bytes, if from % 2 == 1 { 8 * from } else { 0 });
            let search = counts.of(Traffic::ContactSearch);
            assert_eq!((search.sent.messages, search.sent.bytes), (2, 7));
            // Each hears from the one before; rank 0 also from all four, itself included.
            let [others, heard] = if rank == 0 { [4, 22] } else { [0, 2] };
            assert_eq!((search.received.messages, search.received.bytes), (1 + others, heard));
            assert_eq!((search.collectives, search.collective_bytes), (1, 24));
            let output = counts.of(Traffic::Output);
            assert_eq!(output, Count { collectives: 3, collective_bytes: 20, ..Count::default() });
            assert_eq!(counts.of(Traffic::Step), Count::default());
        }
    }

    #[test]
    fn one_rank_calls_nobody() {
        let counts = run_threads(1, |inner| {
            let comm = &mut Counted::new(inner);
            comm.all_min(&mut [1.0]);
            comm.barrier();
            Ok::<_, ()>(comm.counts())
        });
        assert_eq!(counts.unwrap(), [Counts::default()]);
    }
}
