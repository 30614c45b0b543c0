//! Restart files of a run: the one that it goes on from, when others are due, and how many are kept.
//!
//! `BASE.rsout` is always the newest state, `BASE.rsout.1` the one before, and so on. A state gets its name when all of it
//! is on the disk, so that at any instant the newest good one is there.

use super::files::with_suffix;
use super::identity::identity;
use super::{Job, RunError};
use crate::comm::Communicator;
use crate::exodus::{RestartHeader, ResultsError, write_restart};
use crate::output::Schedule;
use crate::output::print::scientific;
use crate::restart::{INTERVAL, Snapshot};
use crate::solver::Solver;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::RwLock;

/// A state to go on from; it has been found to fit the problem.
#[derive(Debug)]
pub struct Continuation {
    /// The file that it comes from.
    pub path: PathBuf,
    step: f64,
    time: f64,
    /// The state, until all ranks of this process have taken their shares.
    state: RwLock<Option<Snapshot>>,
}

impl Continuation {
    /// From the state of a file.
    pub fn new(path: PathBuf, snapshot: Snapshot) -> Continuation {
        let step = snapshot.number("NSTEPS").unwrap_or(0.0);
        Continuation { path, step, time: snapshot.time(), state: RwLock::new(Some(snapshot)) }
    }

    /// The time of the state.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Puts a rank's solver into the state; all ranks call it once.
    pub(super) fn restore(&self, solver: &mut Solver, comm: &mut dyn Communicator) -> Result<(), RunError> {
        let outcome = match self.state.read().as_deref() {
            Ok(Some(snapshot)) => solver.restore(snapshot, comm).map_err(RunError::Incomplete),
            _ => Err(RunError::Elsewhere("another rank failed before this one had taken up the state".into())),
        };
        comm.barrier();
        if let Ok(mut state) = self.state.write() {
            state.take();
        }
        outcome
    }

    /// Where the run goes on.
    pub fn in_words(&self) -> String {
        format!(
            "{} is read: the run goes on at step {}, time {}",
            self.path.display(),
            self.step,
            scientific(self.time, 6)
        )
    }
}

/// The restart files that a run writes.
pub(super) struct RestartFiles<'a> {
    path: PathBuf,
    keep: u32,
    interval: f64,
    schedule: Schedule,
    header: RestartHeader<'a>,
    /// Whether states on the disk may be those of another run.
    strange: bool,
    /// Whether this run has written any.
    written: bool,
}

impl<'a> RestartFiles<'a> {
    /// Of a run that begins, or that goes on from the state of the solver; `None` when the deck asks for none.
    pub fn new(job: &Job<'a>, solver: &Solver) -> Option<RestartFiles<'a>> {
        let asked = job.model.restarts.write?;
        let mut schedule = Schedule::new(asked.interval, Some(asked.interval), f64::INFINITY);
        if job.continuation.is_some() {
            schedule.pass(solver.time, solver.time_step);
        }
        Some(RestartFiles {
            path: job.files.restart.clone(),
            keep: asked.keep,
            interval: asked.interval,
            schedule,
            header: RestartHeader {
                mesh: job.mesh,
                title: &job.model.title,
                qa: job.qa.clone(),
                info: job.deck.lines().map(String::from).collect(),
                identity: identity(job.model, job.mesh),
            },
            strange: job.continuation.is_none(),
            written: false,
        })
    }

    /// Whether the state after a step is to be written: the nearest to an asked time, if the next step is as long as the
    /// one before.
    pub fn due(&mut self, solver: &Solver) -> bool {
        self.schedule.due(solver.time, solver.time_step)
    }

    /// Makes sure that the last state that was written is still there.
    ///
    /// # Errors
    /// When it is not.
    pub fn in_place(&self) -> Result<(), ResultsError> {
        let is_there = !self.written || self.path.is_file();
        let gone = || io::Error::new(io::ErrorKind::NotFound, "it was removed or moved away after it was written");
        if is_there { Ok(()) } else { Err(ResultsError::io("keep", &self.path)(gone())) }
    }

    /// Writes a state beside the last one and puts it into its place.
    ///
    /// # Errors
    /// When it cannot be written; the last one is still there then.
    pub fn write(&mut self, mut snapshot: Snapshot) -> Result<(), ResultsError> {
        snapshot.numbers.push((INTERVAL.to_string(), self.interval));
        let unfinished = with_suffix(&self.path, ".new");
        write_restart(&unfinished, &self.header, snapshot, || {
            if self.strange {
                remove_older(&self.path)?;
            } else {
                shift(&self.path, self.keep)?;
            }
            std::fs::rename(&unfinished, &self.path)
        })?;
        (self.strange, self.written) = (false, true);
        Ok(())
    }
}

/// The name of an older state: `run.rsout.1` is the one before `run.rsout`.
fn older(path: &Path, age: u32) -> PathBuf {
    if age == 0 { path.to_path_buf() } else { with_suffix(path, &format!(".{age}")) }
}

/// All states that a restart file has with it, itself included: the newest first.
pub fn states_beside(path: &Path) -> Vec<PathBuf> {
    (0..).map(|age| older(path, age)).take_while(|path| path.is_file()).collect()
}

/// Where states of an earlier run of the same name are kept: no run reads them there unless it is told to.
pub fn aside(path: &Path) -> PathBuf {
    with_suffix(path, ".old")
}

/// Moves states that are there out of the way of a run that begins anew: it may never write one, and they would be gone on
/// from as if they were its own. What was set aside before goes. Tells whether there were any.
///
/// # Errors
/// When a file cannot be renamed or removed.
pub fn set_aside(path: &Path) -> io::Result<bool> {
    // The older ones count without the newest, too: they would stand beside the newest of the new run.
    let newest = path.is_file().then_some(0);
    let ages: Vec<u32> = newest.into_iter().chain((1..).take_while(|&age| older(path, age).is_file())).collect();
    if ages.is_empty() {
        return Ok(false);
    }
    let old = aside(path);
    states_beside(&old).iter().rev().try_for_each(std::fs::remove_file)?;
    ages.iter().try_for_each(|&age| std::fs::rename(older(path, age), older(&old, age)))?;
    Ok(true)
}

/// Removes older states: those of a run that began anew would be taken for its own.
fn remove_older(path: &Path) -> io::Result<()> {
    states_beside(path).iter().skip(1).rev().try_for_each(std::fs::remove_file)
}

/// Makes every state one older, and forgets the oldest of so many; the newest keeps its name until another takes it.
fn shift(path: &Path, keep: u32) -> io::Result<()> {
    let oldest = keep - 1;
    for age in (1..oldest).rev().filter(|&age| older(path, age).is_file()) {
        std::fs::rename(older(path, age), older(path, age + 1))?;
    }
    if oldest == 0 || !path.is_file() {
        return Ok(());
    }
    let second = older(path, 1);
    let _ = std::fs::remove_file(&second); // There may be none.
    // Two names of one file, so that it never is without a name; where the file system cannot do that, it has the older
    // one only until the new state comes.
    std::fs::hard_link(path, &second).or_else(|_| std::fs::rename(path, &second))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(path: &Path) -> Vec<String> {
        states_beside(path).iter().map(|path| std::fs::read_to_string(path).unwrap()).collect()
    }

    #[test]
    fn states_of_an_earlier_run_are_set_aside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.rsout");
        assert!(!set_aside(&path).unwrap());
        for (age, text) in ["newest", "older", "oldest"].iter().enumerate() {
            std::fs::write(older(&path, age as u32), text).unwrap();
        }
        assert!(set_aside(&path).unwrap());
        assert_eq!(
            (texts(&path), texts(&aside(&path))),
            (vec![], ["newest", "older", "oldest"].map(String::from).to_vec())
        );
        std::fs::write(&path, "another").unwrap();
        assert!(set_aside(&path).unwrap());
        assert_eq!((texts(&path), texts(&aside(&path))), (vec![], vec!["another".to_string()]));
    }

    #[test]
    fn the_newest_states_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.rsout");
        let write = |text: &str, keep: u32| {
            shift(&path, keep).unwrap();
            let new = with_suffix(&path, ".new");
            std::fs::write(&new, text).unwrap();
            std::fs::rename(new, &path).unwrap();
        };
        for (text, left) in
            [("1", vec!["1"]), ("2", vec!["2", "1"]), ("3", vec!["3", "2", "1"]), ("4", vec!["4", "3", "2"])]
        {
            write(text, 3);
            assert_eq!(texts(&path), left);
        }
        write("5", 1);
        assert_eq!(texts(&path)[0], "5");
        remove_older(&path).unwrap();
        assert_eq!(texts(&path), ["5"]);
    }
}
