//! What the outside world wants of a run: signals and the shutdown file.

use crate::solver::Request;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Time between looks for the shutdown file.
const LOOK_INTERVAL: Duration = Duration::from_millis(200);

/// A file that may not grow further, by `ulimit -f` or by its file system, is to fail with a reason, as a full disk does:
/// the signal that comes with it would end the process without a word.
pub fn survive_full_files() {
    // Where there is no such signal, there is nothing to survive.
    let _ = signal_hook::flag::register(SIGXFSZ, Arc::default());
}

/// Signals that end a run in good order: of its terminal, of its user, and of batch systems before its time is over.
const HEARD: [i32; 6] = [SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU];

/// Whether a signal is heard: not the end of the terminal where `nohup` has said that it is to be ignored.
fn is_heard(signal: i32) -> bool {
    signal != SIGHUP || !is_ignored(signal)
}

/// Whether whoever started the program wants a signal to be ignored; false where the system does not tell.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}

/// Ears for signals and the shutdown file.
pub struct Wishes {
    signal: Arc<AtomicUsize>,
    shutdown: PathBuf,
    begun: Instant,
    next_look: AtomicU64,
}

impl Wishes {
    /// Starts listening. A shutdown file left from before is removed. A second signal of the same kind ends the
    /// program at once, as it would without us.
    ///
    /// # Errors
    ///
    /// The system does not let the program listen, or an old shutdown file cannot be removed.
    pub fn listen(shutdown: PathBuf) -> std::io::Result<Wishes> {
        match std::fs::remove_file(&shutdown) {
            // Under MPI every process tidies up, and one comes first.
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
        let signal = Arc::new(AtomicUsize::new(0));
        for number in HEARD.into_iter().filter(|&number| is_heard(number)) {
            let again = Arc::new(std::sync::atomic::AtomicBool::new(false));
            signal_hook::flag::register_conditional_default(number, again.clone())?;
            signal_hook::flag::register(number, again)?;
            signal_hook::flag::register_usize(number, signal.clone(), number as usize)?;
        }
        Ok(Wishes { signal, shutdown, begun: Instant::now(), next_look: AtomicU64::new(0) })
    }

    /// Removes the shutdown file that was obeyed, so that it asks nothing of the next run.
    pub fn obeyed(&self) {
        let _ = std::fs::remove_file(&self.shutdown);
    }

    /// What is wanted now. Cheap: the file system is asked a few times a second.
    pub fn now(&self) -> Request {
        match self.signal.load(Ordering::Relaxed) {
            0 => (),
            number => return Request::Signal(number as u8),
        }
        let elapsed = self.begun.elapsed().as_millis() as u64;
        if elapsed < self.next_look.load(Ordering::Relaxed) {
            return Request::Continue;
        }
        self.next_look.store(elapsed + LOOK_INTERVAL.as_millis() as u64, Ordering::Relaxed);
        if self.shutdown.exists() { Request::Shutdown } else { Request::Continue }
    }
}
