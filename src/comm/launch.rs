//! Starts the ranks of a run and tells how it ended.

use super::{Communicator, RankLost, Serial, threads};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Stack of each rank's thread, in bytes. Kernels of fluids, on eight elements at once, need between 2 and 3 MB where the compiler does not
/// optimize, since every vector has a place of its own then. The 2 MB that threads get by default are too little; ranks on the main thread
/// and MPI processes have 8 MB on Linux. The system takes memory only for what is touched.
const STACK: usize = 16 << 20;

/// Why a run on several ranks did not end well, from the first rank that can tell.
#[derive(Debug, thiserror::Error)]
pub enum RankFailure<E> {
    /// A rank returned an error.
    #[error("{error}")]
    Failed {
        /// The rank.
        rank: usize,
        /// What it returned.
        error: E,
    },
    /// A rank panicked: a defect of the program.
    #[error("rank {rank} panicked: {message}")]
    Panicked {
        /// The rank.
        rank: usize,
        /// The panic's message.
        message: String,
    },
    /// A rank waited for one that had already returned: a defect of the program.
    #[error("rank {lost} had ended when rank {rank} waited for it")]
    Lost {
        /// The rank that waited.
        rank: usize,
        /// The rank that had ended.
        lost: usize,
    },
    /// The system did not give us the threads.
    #[error("cannot start the thread of rank {rank}: {source}")]
    Thread {
        /// The rank.
        rank: usize,
        /// What the system said.
        source: std::io::Error,
    },
}

/// Runs `body` on `size` ranks, each a thread of this process, and returns their results in rank order.
///
/// One rank runs on the calling thread. When a rank fails, those that wait for it end too, at their next call of
/// the communicator; the errors that ranks return come before panics, and both before the ranks merely lost by
/// that, each by rank number. `size` is at least 1.
///
/// # Errors
///
/// The first failure in the order above.
pub fn run_threads<T, E>(
    size: usize,
    body: impl Fn(&mut dyn Communicator) -> Result<T, E> + Sync,
) -> Result<Vec<T>, RankFailure<E>>
where
    T: Send,
    E: Send,
{
    if size <= 1 {
        return outcome(0, || body(&mut Serial)).map(|result| vec![result]);
    }
    let body = &body;
    let outcomes: Vec<_> = std::thread::scope(|scope| {
        let ranks: Vec<_> = (threads(size).into_iter().enumerate())
            .map(|(rank, mut communicator)| {
                let thread = std::thread::Builder::new().name(format!("rank {rank}")).stack_size(STACK);
                thread.spawn_scoped(scope, move || outcome(rank, move || body(&mut communicator)))
            })
            .collect();
        let join = |(rank, thread): (usize, std::io::Result<std::thread::ScopedJoinHandle<'_, _>>)| match thread {
            Ok(handle) => handle.join().unwrap_or_else(|payload| Err(failure(rank, &*payload))),
            Err(source) => Err(RankFailure::Thread { rank, source }),
        };
        ranks.into_iter().enumerate().map(join).collect()
    });
    let mut results = Vec::with_capacity(size);
    let mut failures = Vec::new();
    for outcome in outcomes {
        match outcome {
            Ok(result) => results.push(result),
            Err(failure) => failures.push(failure),
        }
    }
    match failures.into_iter().min_by_key(severity) {
        Some(failure) => Err(failure),
        None => Ok(results),
    }
}

/// The number of processes when an MPI launcher (mpiexec, srun with PMI) started this one, `None` otherwise.
///
/// Where a launcher tells only the rank, the number is what is sure: one more than the rank, and at least 2.
pub fn launched_by_mpi() -> Option<usize> {
    launched_size(|name| std::env::var(name).ok())
}

/// Open MPI, MPICH and its kin, MVAPICH; then PMIx under Slurm and others.
fn launched_size(variable: impl Fn(&str) -> Option<String>) -> Option<usize> {
    let number = |name: &str| variable(name).and_then(|text| text.trim().parse::<usize>().ok());
    let size = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"].into_iter().find_map(number);
    size.or_else(|| {
        let rank = ["PMIX_RANK", "PMI_RANK", "PALS_RANKID"].into_iter().find_map(number)?;
        Some(number("SLURM_STEP_NUM_TASKS").unwrap_or(2).max(rank + 1))
    })
}

/// Runs one rank to its end, a panic included. The communicator inside `body` is gone when this returns.
fn outcome<T, E>(rank: usize, body: impl FnOnce() -> Result<T, E>) -> Result<T, RankFailure<E>> {
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(result) => result.map_err(|error| RankFailure::Failed { rank, error }),
        Err(payload) => Err(failure(rank, &*payload)),
    }
}

/// What a panic's payload says.
fn failure<E>(rank: usize, payload: &(dyn Any + Send)) -> RankFailure<E> {
    if let Some(lost) = payload.downcast_ref::<RankLost>() {
        return RankFailure::Lost { rank, lost: lost.rank };
    }
    let text = payload.downcast_ref::<&str>().map(|text| text.to_string());
    let message = text.or_else(|| payload.downcast_ref::<String>().cloned());
    RankFailure::Panicked { rank, message: message.unwrap_or_else(|| "no message".into()) }
}

/// Causes before consequences.
fn severity<E>(failure: &RankFailure<E>) -> u8 {
    match failure {
        RankFailure::Thread { .. } => 0,
        RankFailure::Failed { .. } => 1,
        RankFailure::Panicked { .. } => 2,
        RankFailure::Lost { .. } => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn launchers_are_known_by_their_variables() {
        let size = |variables: &[(&str, &str)]| {
            launched_size(|name| variables.iter().find(|(known, _)| *known == name).map(|(_, value)| value.to_string()))
        };
        assert_eq!(size(&[]), None);
        assert_eq!(size(&[("SLURM_STEP_NUM_TASKS", "4")]), None);
        assert_eq!(size(&[("OMPI_COMM_WORLD_SIZE", "4"), ("PMIX_RANK", "1")]), Some(4));
        assert_eq!(size(&[("PMI_SIZE", "1"), ("PMI_RANK", "0")]), Some(1));
        assert_eq!(size(&[("PMIX_RANK", "0"), ("SLURM_STEP_NUM_TASKS", "8")]), Some(8));
        assert_eq!(size(&[("PMIX_RANK", "5")]), Some(6));
        assert_eq!(size(&[("PMI_SIZE", "many")]), None);
    }

    #[test]
    fn the_cause_is_reported_not_the_ranks_lost_by_it() {
        let error = run_threads(5, |communicator| {
            let rank = communicator.rank();
            communicator.barrier();
            if rank == 3 {
                return Err("disk full");
            }
            communicator.all_min(&mut [0.0]);
            Ok(rank)
        });
        assert!(matches!(error, Err(RankFailure::Failed { rank: 3, error: "disk full" })));
    }

    #[test]
    fn a_rank_that_returns_too_early_is_named() {
        let error = run_threads(3, |communicator| {
            if communicator.rank() != 1 {
                communicator.barrier();
            }
            Ok::<_, ()>(())
        });
        assert!(matches!(error, Err(RankFailure::Lost { .. })));
    }

    #[test]
    fn threads_of_ranks_have_room_for_what_is_not_optimized() {
        // A frame of 6 MB: more than the default of threads and than any kernel needs, less than what is stated.
        #[inline(never)]
        fn touched() -> u64 {
            let room = std::hint::black_box([1u64; (6 << 20) / 8]);
            room.iter().sum()
        }
        let sums = run_threads(2, |_| Ok::<_, ()>(touched()));
        assert_eq!(sums.ok(), Some(vec![(6 << 20) / 8; 2]));
    }

    #[test]
    fn one_rank_runs_on_the_calling_thread() {
        let here = std::thread::current().id();
        let same =
            run_threads(1, |communicator| Ok::<_, ()>((communicator.size(), std::thread::current().id() == here)));
        assert_eq!(same.ok(), Some(vec![(1, true)]));
    }
}
