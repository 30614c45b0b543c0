//! Ranks as threads of one process: messages are buffers that change hands, never copies.
//!
//! Between every ordered pair of ranks lies one [`Mailbox`]. Collective calls meet in one of two [`Meeting`]s, used
//! in turn: the second after this one can only begin when every rank has entered the next and so has left this
//! one, which makes its buffers free again without a further signal.
//!
//! A rank that ends, in whatever way, is marked as gone. A rank that waits for one that is gone unwinds with
//! [`RankLost`] and so is gone itself: however a run fails, no rank is left waiting.

use super::reduce::{key, number};
use super::wait::{LONGEST_SLEEP, wait_until};
use super::{Communicator, Peer};
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Polls before a waiting rank yields its core, when every rank has a core of its own.
const SPINS: u32 = 2000;

/// Those that wait sleep longer by the ranks to a core over this number, where that is more than one: the polls of a thousand ranks, one a millisecond each,
/// would leave two cores no time for anything else.
const CROWD: usize = 4;

/// The payload with which a rank unwinds when it waits for a rank that has ended.
#[derive(Debug, Clone, Copy)]
pub struct RankLost {
    /// The rank waited for in vain.
    pub rank: usize,
}

/// One rank of a world of threads, made by [`threads`].
#[derive(Debug)]
pub struct Threads {
    rank: usize,
    world: Arc<World>,
    /// Number of collective calls so far.
    meetings: u64,
    keys: Vec<u64>,
}

/// All ranks of a world whose members may go to one thread each.
pub fn threads(size: usize) -> Vec<Threads> {
    let world = Arc::new(World::new(size));
    (0..size).map(|rank| Threads { rank, world: world.clone(), meetings: 0, keys: Vec::new() }).collect()
}

/// What the ranks share.
#[derive(Debug)]
struct World {
    size: usize,
    spins: u32,
    /// Longest sleep between the polls of a rank that waits.
    longest_sleep: Duration,
    /// Mailbox of the message from rank `a` to rank `b` at `a * size + b`.
    mailboxes: Vec<Mailbox>,
    meetings: [Mutex<Meeting>; 2],
    /// Number of collective calls that every rank has entered.
    met: AtomicU64,
    gone: Vec<AtomicBool>,
    /// Some rank that is gone, or `size`.
    lost: AtomicUsize,
}

/// At most one message on its way; its own cache line, as two ranks write it in turn.
#[derive(Debug, Default)]
#[repr(align(64))]
struct Mailbox {
    full: AtomicBool,
    buffer: Mutex<Vec<f64>>,
}

/// Where one collective call comes together.
#[derive(Debug, Default)]
struct Meeting {
    name: &'static str,
    arrived: usize,
    values: Vec<u64>,
    /// Messages for each rank as `(sender, bytes)`.
    inboxes: Vec<Vec<(usize, Vec<u8>)>>,
    announcement: Arc<Vec<u8>>,
}

impl World {
    fn new(size: usize) -> Self {
        let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
        let meeting = || Mutex::new(Meeting { inboxes: vec![Vec::new(); size], ..Meeting::default() });
        Self {
            size,
            spins: if size <= cores { SPINS } else { 0 },
            longest_sleep: LONGEST_SLEEP * (size / (CROWD * cores)).max(1) as u32,
            mailboxes: (0..size * size).map(|_| Mailbox::default()).collect(),
            meetings: [meeting(), meeting()],
            met: AtomicU64::new(0),
            gone: (0..size).map(|_| AtomicBool::new(false)).collect(),
            lost: AtomicUsize::new(size),
        }
    }

    /// Waits until `ready`; unwinds if `lost` names a rank that is gone and what was waited for has not come.
    fn wait(&self, ready: impl Fn() -> bool, lost: impl Fn() -> Option<usize>) {
        let mut gone = None;
        wait_until(self.spins, self.longest_sleep, || {
            gone = lost();
            gone.is_some() || ready()
        });
        // Asked again after `lost`: what a rank did before it ended still counts.
        if let Some(rank) = gone.filter(|_| !ready()) {
            resume_unwind(Box::new(RankLost { rank }));
        }
    }

    fn wait_for_rank(&self, rank: usize, ready: impl Fn() -> bool) {
        self.wait(ready, || self.gone[rank].load(Ordering::Acquire).then_some(rank));
    }

    fn wait_for_all(&self, ready: impl Fn() -> bool) {
        self.wait(ready, || Some(self.lost.load(Ordering::Acquire)).filter(|rank| *rank < self.size));
    }
}

impl Threads {
    /// One collective call: adds this rank's part with `enter`, which also hears whether it is the first to come,
    /// waits for all others, and returns the meeting for this rank to take its result.
    fn meet(&mut self, name: &'static str, enter: impl FnOnce(&mut Meeting, bool)) -> MutexGuard<'_, Meeting> {
        self.meetings += 1;
        let (world, number) = (&*self.world, self.meetings);
        let meeting = &world.meetings[(number % 2) as usize];
        let mut guard = lock(meeting);
        let first = guard.arrived == 0;
        if first {
            guard.name = name;
        }
        assert_eq!(guard.name, name, "rank {} is in another collective call than the others", self.rank);
        enter(&mut guard, first);
        guard.arrived += 1;
        if guard.arrived == world.size {
            guard.arrived = 0;
            world.met.store(number, Ordering::Release);
            return guard;
        }
        drop(guard);
        world.wait_for_all(|| world.met.load(Ordering::Acquire) >= number);
        lock(meeting)
    }

    /// Combines the ranks' values in the order of their arrival, so `combine` must be exact and commutative.
    fn reduce(&mut self, name: &'static str, values: &mut [u64], combine: impl Fn(u64, u64) -> u64) {
        let meeting = self.meet(name, |meeting, first| {
            if first {
                meeting.values.clear();
                meeting.values.extend_from_slice(values);
            } else {
                assert_eq!(meeting.values.len(), values.len(), "ranks disagree on the length of {name}");
                meeting.values.iter_mut().zip(&*values).for_each(|(sum, value)| *sum = combine(*sum, *value));
            }
        });
        values.copy_from_slice(&meeting.values);
    }

    /// Delivers messages and returns this rank's own in ascending order of their senders.
    fn deliver(&mut self, name: &'static str, messages: Vec<(usize, Vec<u8>)>) -> Vec<(usize, Vec<u8>)> {
        let rank = self.rank;
        let mut received = {
            let mut meeting = self.meet(name, |meeting, _| {
                messages.into_iter().for_each(|(to, bytes)| meeting.inboxes[to].push((rank, bytes)));
            });
            std::mem::take(&mut meeting.inboxes[rank])
        };
        received.sort_by_key(|(from, _)| *from);
        received
    }
}

impl Communicator for Threads {
    fn rank(&self) -> usize {
        self.rank
    }

    fn size(&self) -> usize {
        self.world.size
    }

    fn start_exchange(&mut self, peers: &mut [Peer]) {
        for peer in peers {
            let mailbox = &self.world.mailboxes[self.rank * self.world.size + peer.rank];
            self.world.wait_for_rank(peer.rank, || !mailbox.full.load(Ordering::Acquire));
            let length = peer.send.len();
            std::mem::swap(&mut *lock(&mailbox.buffer), &mut peer.send);
            // What came back is the buffer of an earlier message, in a steady exchange of the same length.
            peer.send.resize(length, 0.0);
            mailbox.full.store(true, Ordering::Release);
        }
    }

    fn finish_exchange(&mut self, peers: &mut [Peer]) {
        for peer in peers {
            let mailbox = &self.world.mailboxes[peer.rank * self.world.size + self.rank];
            self.world.wait_for_rank(peer.rank, || mailbox.full.load(Ordering::Acquire));
            let length = peer.receive.len();
            std::mem::swap(&mut *lock(&mailbox.buffer), &mut peer.receive);
            assert_eq!(peer.receive.len(), length, "rank {} sent another length than expected", peer.rank);
            mailbox.full.store(false, Ordering::Release);
        }
    }

    fn all_min(&mut self, values: &mut [f64]) {
        let mut keys = std::mem::take(&mut self.keys);
        keys.clear();
        keys.extend(values.iter().map(|value| key(*value)));
        self.reduce("all_min", &mut keys, u64::min);
        values.iter_mut().zip(&keys).for_each(|(value, key)| *value = number(*key));
        self.keys = keys;
    }

    fn all_sum(&mut self, values: &mut [u64]) {
        self.reduce("all_sum", values, u64::wrapping_add);
    }

    fn sparse_exchange(&mut self, outgoing: Vec<(usize, Vec<u8>)>) -> Vec<(usize, Vec<u8>)> {
        self.deliver("sparse_exchange", outgoing)
    }

    fn gather(&mut self, bytes: Vec<u8>) -> Option<Vec<Vec<u8>>> {
        let received = self.deliver("gather", vec![(0, bytes)]);
        (self.rank == 0).then(|| received.into_iter().map(|(_, bytes)| bytes).collect())
    }

    fn broadcast(&mut self, bytes: &mut Vec<u8>) {
        let announcement = (self.rank == 0).then(|| Arc::new(std::mem::take(bytes)));
        let announcement = self
            .meet("broadcast", |meeting, _| meeting.announcement = announcement.unwrap_or(meeting.announcement.clone()))
            .announcement
            .clone();
        bytes.clear();
        bytes.extend_from_slice(&announcement);
    }

    fn barrier(&mut self) {
        drop(self.meet("barrier", |_, _| ()));
    }
}

impl Drop for Threads {
    /// Tells the others that nothing more will come from this rank.
    fn drop(&mut self) {
        self.world.gone[self.rank].store(true, Ordering::Release);
        self.world.lost.store(self.rank, Ordering::Release);
    }
}

/// Locks; the data of a rank that panicked inside stays usable, and the other ranks soon find that it is gone.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
