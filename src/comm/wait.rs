//! How a rank waits: it polls, soon gives up its core to other ranks, and after a while sleeps.

use std::time::{Duration, Instant};

/// How long a rank keeps yielding before it begins to sleep between polls.
const YIELDING: Duration = Duration::from_millis(1);

/// Longest sleep between polls unless ranks are crowded on their cores.
pub(super) const LONGEST_SLEEP: Duration = Duration::from_millis(1);

/// Polls `ready` until it holds: `spins` times in a tight loop, then yielding the core between polls, and after a
/// millisecond sleeping an eighth of the time waited so far, at most `longest`.
///
/// Yielding alone would let many idle ranks take their full share of the cores from the one that still works; the
/// sleep costs at most an eighth of a wait that was long anyway.
pub(super) fn wait_until(spins: u32, longest: Duration, mut ready: impl FnMut() -> bool) {
    for _ in 0..spins {
        if ready() {
            return;
        }
        std::hint::spin_loop();
    }
    let start = Instant::now();
    while !ready() {
        let waited = start.elapsed();
        if waited < YIELDING {
            std::thread::yield_now();
        } else {
            std::thread::sleep((waited / 8).min(longest));
        }
    }
}
