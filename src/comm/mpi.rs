//! Ranks as MPI processes.
//!
//! Nothing here blocks inside MPI: every wait polls and yields, because an MPI library that spins while ranks outnumber
//! cores is slower by a factor of hundreds. A panic aborts the job; otherwise the other ranks would wait for ever.

use super::pending::{Pending, SPINS};
use super::reduce::{key, number};
use super::wait::{LONGEST_SLEEP, wait_until};
use super::{Communicator, Peer};
use mpi::Threading;
use mpi::collective::SystemOperation;
use mpi::environment::Universe;
use mpi::request::{Request, Scope, scope};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator as _, CommunicatorCollectives as _, Root as _};
use std::ffi::c_int;

const EXCHANGE: c_int = 1;
const SPARSE_SIZE: c_int = 2;
const SPARSE_DATA: c_int = 3;
const GATHER_SIZE: c_int = 4;
const GATHER_DATA: c_int = 5;

/// Bytes per call of a broadcast, whose count must fit a C int.
const LONGEST_BROADCAST: usize = 1 << 30;
/// What a job ends with when a rank panics: the exit code of a Rust program that panics.
const PANICKED: c_int = 101;

/// Why MPI cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StartError {
    /// MPI was started twice in this process.
    #[error("MPI was already initialised in this process")]
    AlreadyStarted,
    /// The library cannot serve the main thread while others exist.
    #[error("this MPI library does not support MPI_THREAD_SERIALIZED")]
    Threading,
}

/// This process among all those of the MPI job. MPI is finalised when it is dropped, which must happen on the thread
/// that started it, and on every rank: a rank that leaves alone calls [`World::abort`].
pub struct World {
    rank: usize,
    size: usize,
    exchange: Pending<f64>,
    values: Vec<u64>,
    result: Vec<u64>,
    universe: Universe,
}

impl World {
    /// Initialises MPI; from here on a panic anywhere in the process aborts the whole job. To be called only in a
    /// process that a launcher started (see [`super::launched_by_mpi`]): alone, MPI takes up to a second to start.
    ///
    /// # Errors
    ///
    /// MPI was started before, or cannot be called from one thread at a time.
    pub fn start() -> Result<Self, StartError> {
        let (universe, threading) =
            mpi::initialize_with_threading(Threading::Serialized).ok_or(StartError::AlreadyStarted)?;
        if threading < Threading::Serialized {
            return Err(StartError::Threading);
        }
        let report = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            report(panic);
            SimpleCommunicator::world().abort(PANICKED);
        }));
        let world = universe.world();
        let (rank, size) = (world.rank() as usize, world.size() as usize);
        Ok(Self { rank, size, exchange: Pending::new(), values: Vec::new(), result: Vec::new(), universe })
    }

    /// Ends all processes of the job with this exit code, for a failure that this rank alone knows of.
    pub fn abort(&self, code: i32) -> ! {
        self.universe.world().abort(code)
    }

    /// Combines `self.values` over all ranks into `self.result`. `operation` must be exact and commutative.
    fn reduce(&mut self, operation: SystemOperation) {
        let world = self.universe.world();
        self.result.clear();
        self.result.resize(self.values.len(), 0);
        let (values, result) = (&self.values[..], &mut self.result[..]);
        scope(|scope| wait(world.immediate_all_reduce_into(scope, values, result, operation)));
    }

    /// How many messages are addressed to this rank, given to how many this rank addresses each: figure 5's fold.
    fn count_incoming(&self, outgoing: &[u64]) -> usize {
        let mut count = 0u64;
        let (world, count_here) = (self.universe.world(), &mut count);
        scope(|scope| {
            wait(world.immediate_reduce_scatter_block_into(scope, outgoing, count_here, SystemOperation::sum()));
        });
        count as usize
    }
}

/// Polls a request to its end.
fn wait<'a, T: ?Sized, S: Scope<'a>>(request: Request<'a, T, S>) {
    let mut pending = Some(request);
    wait_until(SPINS, LONGEST_SLEEP, || {
        pending = pending.take().and_then(|request| request.test().err());
        pending.is_none()
    });
}

impl Communicator for World {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.size
    }

    fn start_exchange(&mut self, peers: &mut [Peer]) {
        let world = self.universe.world();
        for peer in &mut *peers {
            let buffer = std::mem::take(&mut peer.receive);
            self.exchange.receive(&world, Some(peer.rank), EXCHANGE, buffer);
        }
        for peer in peers {
            self.exchange.send(&world, peer.rank, EXCHANGE, std::mem::take(&mut peer.send));
        }
    }

    fn finish_exchange(&mut self, peers: &mut [Peer]) {
        peers.iter_mut().zip(self.exchange.take_received()).for_each(|(peer, buffer)| peer.receive = buffer);
        peers.iter_mut().zip(self.exchange.take_sent()).for_each(|(peer, buffer)| peer.send = buffer);
    }

    fn all_min(&mut self, values: &mut [f64]) {
        self.values.clear();
        self.values.extend(values.iter().map(|value| key(*value)));
        self.reduce(SystemOperation::min());
        values.iter_mut().zip(&self.result).for_each(|(value, key)| *value = number(*key));
    }

    fn all_sum(&mut self, values: &mut [u64]) {
        self.values.clear();
        self.values.extend_from_slice(values);
        self.reduce(SystemOperation::sum());
        values.copy_from_slice(&self.result);
    }

    fn sparse_exchange(&mut self, outgoing: Vec<(usize, Vec<u8>)>) -> Vec<(usize, Vec<u8>)> {
        let world = self.universe.world();
        let mut counts = vec![0; self.size];
        outgoing.iter().for_each(|(to, _)| counts[*to] += 1);
        let incoming = self.count_incoming(&counts);

        // A rank may only announce messages once all ranks have entered this exchange, since its fold needs them
        // all: announcements from any source cannot be those of a later exchange.
        let mut announcements = Pending::<u64>::new();
        (0..incoming).for_each(|_| announcements.receive(&world, None, SPARSE_SIZE, vec![0; 2]));
        for (to, bytes) in &outgoing {
            announcements.send(&world, *to, SPARSE_SIZE, vec![self.rank as u64, bytes.len() as u64]);
        }
        let mut sizes: Vec<_> = announcements.take_received().map(|words| (words[0] as usize, words[1])).collect();
        sizes.sort_by_key(|(from, _)| *from);

        let mut data = Pending::new();
        for (from, size) in &sizes {
            data.receive(&world, Some(*from), SPARSE_DATA, vec![0u8; *size as usize]);
        }
        outgoing.into_iter().for_each(|(to, bytes)| data.send(&world, to, SPARSE_DATA, bytes));
        sizes.iter().map(|(from, _)| *from).zip(data.take_received()).collect()
    }

    fn gather(&mut self, bytes: Vec<u8>) -> Option<Vec<Vec<u8>>> {
        let world = self.universe.world();
        let ranks = if self.rank == 0 { 0..self.size } else { 0..0 };
        let mut sizes = Pending::new();
        ranks.clone().for_each(|from| sizes.receive(&world, Some(from), GATHER_SIZE, vec![0u64]));
        sizes.send(&world, 0, GATHER_SIZE, vec![bytes.len() as u64]);
        let mut data = Pending::new();
        for (from, size) in ranks.zip(sizes.take_received()) {
            data.receive(&world, Some(from), GATHER_DATA, vec![0u8; size[0] as usize]);
        }
        data.send(&world, 0, GATHER_DATA, bytes);
        let received: Vec<_> = data.take_received().collect();
        (self.rank == 0).then_some(received)
    }

    fn broadcast(&mut self, bytes: &mut Vec<u8>) {
        let world = self.universe.world();
        let root = world.process_at_rank(0);
        let mut size = bytes.len() as u64;
        scope(|scope| wait(root.immediate_broadcast_into(scope, &mut size)));
        bytes.resize(size as usize, 0);
        for part in bytes.chunks_mut(LONGEST_BROADCAST) {
            scope(|scope| wait(root.immediate_broadcast_into(scope, part)));
        }
    }

    fn barrier(&mut self) {
        self.values.clear();
        self.values.push(0);
        self.reduce(SystemOperation::sum());
    }
}
