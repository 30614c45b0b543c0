//! MPI messages under way, which own their buffers. All of the program's raw MPI is here.

use super::wait::{LONGEST_SLEEP, wait_until};
use mpi::ffi;
use mpi::raw::AsRaw;
use mpi::topology::SimpleCommunicator;
use mpi::traits::Equivalence;
use std::ffi::{c_int, c_void};

/// Polls of MPI before a waiting rank yields its core.
pub(super) const SPINS: u32 = 200;
/// Elements per MPI message, whose count must fit a C int; longer buffers go as several messages.
const LONGEST: usize = 1 << 27;

/// Messages under way and their buffers.
///
/// MPI reads and writes a buffer from the start of a message until its request completes. So the buffers are owned
/// here and cannot be reached in between; if a `Pending` is dropped before they are complete, they are leaked.
#[derive(Debug, Default)]
pub(super) struct Pending<T> {
    requests: Vec<ffi::MPI_Request>,
    sent: Vec<Vec<T>>,
    received: Vec<Vec<T>>,
}

// SAFETY: request handles may be used from any thread, one at a time (MPI_THREAD_SERIALIZED, which `World::start`
// insists on), and `&mut self` on all methods that touch MPI makes it one at a time.
unsafe impl<T: Send> Send for Pending<T> {}

impl<T: Equivalence> Pending<T> {
    pub(super) fn new() -> Self {
        Self { requests: Vec::new(), sent: Vec::new(), received: Vec::new() }
    }

    /// Starts to receive from a rank, or whichever rank it be, as many elements as `buffer` has.
    pub(super) fn receive(&mut self, world: &SimpleCommunicator, from: Option<usize>, tag: c_int, mut buffer: Vec<T>) {
        // SAFETY: a constant of the MPI library.
        let from = from.map_or(unsafe { ffi::RSMPI_ANY_SOURCE }, |rank| rank as c_int);
        for part in pieces(&mut buffer, LONGEST) {
            let mut request = std::mem::MaybeUninit::uninit();
            let pointer = part.as_mut_ptr().cast::<c_void>();
            let datatype = T::equivalent_datatype().as_raw();
            // SAFETY: pointer and count describe `part`, which lives on the heap, owned by `self.received` from here
            // on until the request is complete. An error aborts the job (MPI's default), so the request is set.
            let request = unsafe {
                let count = part.len() as c_int;
                ffi::MPI_Irecv(pointer, count, datatype, from, tag, world.as_raw(), request.as_mut_ptr());
                request.assume_init()
            };
            self.requests.push(request);
        }
        self.received.push(buffer);
    }

    /// Starts to send `buffer` to a rank.
    pub(super) fn send(&mut self, world: &SimpleCommunicator, to: usize, tag: c_int, mut buffer: Vec<T>) {
        for part in pieces(&mut buffer, LONGEST) {
            let mut request = std::mem::MaybeUninit::uninit();
            let pointer = part.as_ptr().cast::<c_void>();
            let datatype = T::equivalent_datatype().as_raw();
            // SAFETY: as in `receive`, with `self.sent` as the owner.
            let request = unsafe {
                let count = part.len() as c_int;
                ffi::MPI_Isend(pointer, count, datatype, to as c_int, tag, world.as_raw(), request.as_mut_ptr());
                request.assume_init()
            };
            self.requests.push(request);
        }
        self.sent.push(buffer);
    }

    /// Waits for all messages. Afterwards [`Pending::take_received`] and [`Pending::take_sent`] give the buffers.
    pub(super) fn wait(&mut self) {
        wait_until(SPINS, LONGEST_SLEEP, || self.is_complete());
    }

    fn is_complete(&mut self) -> bool {
        let mut complete = 0;
        // SAFETY: the requests were made above and are tested until they are complete, then forgotten.
        unsafe {
            let count = self.requests.len() as c_int;
            ffi::MPI_Testall(count, self.requests.as_mut_ptr(), &mut complete, ffi::RSMPI_STATUSES_IGNORE);
        }
        if complete != 0 {
            self.requests.clear();
        }
        complete != 0
    }

    /// The received buffers in the order of their start; waits for all messages first.
    pub(super) fn take_received(&mut self) -> std::vec::Drain<'_, Vec<T>> {
        self.wait();
        self.received.drain(..)
    }

    /// The buffers that were sent, in the order of their start; waits for all messages first.
    pub(super) fn take_sent(&mut self) -> std::vec::Drain<'_, Vec<T>> {
        self.wait();
        self.sent.drain(..)
    }
}

/// The parts of a buffer that go as one message each, none above `longest`; an empty buffer is one empty message.
fn pieces<T>(buffer: &mut [T], longest: usize) -> impl Iterator<Item = &mut [T]> {
    let count = buffer.len().div_ceil(longest).max(1);
    let mut rest = buffer;
    (0..count).map(move |_| {
        let length = rest.len().min(longest);
        let (part, after) = std::mem::take(&mut rest).split_at_mut(length);
        rest = after;
        part
    })
}

impl<T> Drop for Pending<T> {
    fn drop(&mut self) {
        if !self.requests.is_empty() {
            std::mem::forget(std::mem::take(&mut self.sent));
            std::mem::forget(std::mem::take(&mut self.received));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_cover_the_buffer() {
        let lengths = |count: usize| pieces(&mut vec![0u8; count], 4).map(|part| part.len()).collect::<Vec<_>>();
        assert_eq!(lengths(0), [0]);
        assert_eq!(lengths(4), [4]);
        assert_eq!(lengths(9), [4, 4, 1]);
    }
}
