//! Records on their way to other ranks.

use crate::comm::Communicator;
use std::ops::Range;

/// Records, each an id and `width` numbers, packed for the ranks they go to; those that stay are not packed.
#[derive(Debug, Clone)]
pub struct Parcels {
    rank: usize,
    own: Records,
    /// One message per rank.
    messages: Vec<Vec<u8>>,
}

/// Records that have come.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Records {
    /// Numbers per record.
    pub width: usize,
    /// The id of each record.
    pub ids: Vec<u32>,
    /// The numbers of each record, one record after the other.
    pub values: Vec<f64>,
    /// Ranks that sent any, ascending, and which records they sent.
    pub senders: Vec<(usize, Range<usize>)>,
}

impl Parcels {
    /// Empty parcels for the ranks of a communicator and records of `width` numbers.
    pub fn new(comm: &dyn Communicator, width: usize) -> Parcels {
        let own = Records { width, ..Records::default() };
        Parcels { rank: comm.rank(), own, messages: vec![Vec::new(); comm.size()] }
    }

    /// Adds a record of `width` numbers for `rank`, which may be this one.
    pub fn add(&mut self, rank: u32, id: u32, values: &[f64]) {
        debug_assert_eq!(values.len(), self.own.width, "a record of another width");
        if rank as usize == self.rank {
            self.own.ids.push(id);
            self.own.values.extend_from_slice(values);
            return;
        }
        let message = &mut self.messages[rank as usize];
        message.extend_from_slice(&id.to_le_bytes());
        values.iter().for_each(|value| message.extend_from_slice(&value.to_le_bytes()));
    }

    /// Sends all records and returns those for this rank, by ascending sender and then in the order in which they
    /// were added; every rank calls it, with the same width. One sparse exchange.
    pub fn exchange(self, comm: &mut dyn Communicator) -> Records {
        let Parcels { rank, own, messages } = self;
        let outgoing = messages.into_iter().enumerate().filter(|(_, message)| !message.is_empty()).collect();
        let mut before = comm.sparse_exchange(outgoing);
        let behind = before.split_off(before.partition_point(|(sender, _)| *sender < rank));
        let mut records = Records { width: own.width, ..Records::default() };
        // Each message is gone when the next is unpacked.
        before.into_iter().for_each(|(sender, message)| records.unpack_all(sender, &message));
        records.append(rank, own);
        behind.into_iter().for_each(|(sender, message)| records.unpack_all(sender, &message));
        records
    }
}

impl Records {
    /// Number of records.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// The numbers of a record.
    pub fn values(&self, record: usize) -> &[f64] {
        &self.values[record * self.width..][..self.width]
    }

    /// The ids of all records with their numbers, of which there are `W`.
    pub fn rows<const W: usize>(&self) -> impl Iterator<Item = (u32, [f64; W])> + '_ {
        debug_assert_eq!(W, self.width, "records of another width");
        self.ids.iter().copied().zip(self.values.as_chunks().0.iter().copied())
    }

    /// The records by ascending id, those of one id by sender: an order that does not depend on which rank sent
    /// them, if ids are distinct.
    pub fn by_id(&self) -> Vec<u32> {
        let mut order: Vec<u32> = (0..self.len() as u32).collect();
        order.sort_by_key(|record| self.ids[*record as usize]);
        order
    }

    /// Appends what this rank keeps.
    fn append(&mut self, rank: usize, own: Records) {
        let first = self.ids.len();
        if first == 0 {
            (self.ids, self.values) = (own.ids, own.values);
        } else {
            self.ids.extend(own.ids);
            self.values.extend(own.values);
        }
        if self.ids.len() > first {
            self.senders.push((rank, first..self.ids.len()));
        }
    }

    /// Appends what another rank has sent.
    fn unpack_all(&mut self, sender: usize, message: &[u8]) {
        let (first, length) = (self.ids.len(), 4 + 8 * self.width);
        self.ids.reserve(message.len() / length);
        self.values.reserve(message.len() / length * self.width);
        message.chunks_exact(length).for_each(|record| self.unpack(record));
        self.senders.push((sender, first..self.ids.len()));
    }

    fn unpack(&mut self, record: &[u8]) {
        let (words, doubles) = record.split_at(4);
        self.ids.extend(words.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])));
        let number = |b: &[u8]| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]);
        self.values.extend(doubles.chunks_exact(8).map(number));
    }
}
