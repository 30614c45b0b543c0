//! What the outside world wants of a run: signals and the shutdown file.

use crate::solver::Request;
use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
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
        for number in [SIGINT, SIGTERM] {
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
        match self.signal.load(Ordering::Relaxed) as i32 {
            SIGINT => return Request::Interrupt,
            SIGTERM => return Request::Terminate,
            _ => {}
        }
        let elapsed = self.begun.elapsed().as_millis() as u64;
        if elapsed < self.next_look.load(Ordering::Relaxed) {
            return Request::Continue;
        }
        self.next_look.store(elapsed + LOOK_INTERVAL.as_millis() as u64, Ordering::Relaxed);
        if self.shutdown.exists() { Request::Shutdown } else { Request::Continue }
    }
}
