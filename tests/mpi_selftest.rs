//! The stress test of `ranks/comm.rs` over MPI. Started by a launcher (`mpiexec -n 4 mpi_selftest-…`) it is one rank;
//! started by `cargo test --features mpi` it runs itself under mpiexec, and says so when there is none.

#[path = "ranks/stress.rs"]
mod stress;

use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};
use stress::stress;
use urto::comm::mpi::World;
use urto::comm::{Communicator, launched_by_mpi};

/// Set to make the last rank panic instead of taking part.
const PANIC: &str = "URTO_SELFTEST_PANIC";

fn main() -> ExitCode {
    if launched_by_mpi().is_some() { run_rank() } else { run_jobs() }
}

fn run_rank() -> ExitCode {
    let mut world = match World::start() {
        Ok(world) => world,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    if std::env::var_os(PANIC).is_some() && world.rank() + 1 == world.size() {
        panic!("on purpose");
    }
    let size = world.size();
    stress(&mut world, 400, size);
    large_messages(&mut world);
    if world.rank() == 0 {
        println!("{size} ranks agree");
    }
    ExitCode::SUCCESS
}

/// Messages long enough for the library's rendezvous protocol.
fn large_messages(world: &mut World) {
    let (rank, size) = (world.rank(), world.size());
    let next = (rank + 1) % size;
    let received = world.sparse_exchange(vec![(next, vec![rank as u8; 5_000_000])]);
    assert_eq!(received, [((rank + size - 1) % size, vec![((rank + size - 1) % size) as u8; 5_000_000])]);
    let gathered = world.gather(vec![rank as u8; 3_000_000 + rank]);
    assert!(gathered.into_iter().flatten().enumerate().all(|(rank, bytes)| bytes.len() == 3_000_000 + rank));
}

fn run_jobs() -> ExitCode {
    if Command::new("mpiexec").arg("--version").stdout(Stdio::null()).status().is_err() {
        println!("skipped: no mpiexec here");
        return ExitCode::SUCCESS;
    }
    let good = [1, 2, 3, 4, 7].into_iter().all(|ranks| job(ranks, false) == Some(true));
    let aborts = job(3, true) == Some(false);
    println!("mpi_selftest: agreement {good}, a panic ends the job {aborts}");
    if good && aborts { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Runs this program on MPI ranks: whether it succeeded, or `None` when it had to be stopped after a minute.
fn job(ranks: usize, panic: bool) -> Option<bool> {
    let mut command = Command::new("mpiexec");
    command.args(["-n", &ranks.to_string()]).arg(std::env::current_exe().ok()?);
    // Open MPI refuses root and more ranks than cores otherwise; other libraries ignore these.
    for permission in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"]
    {
        command.env(permission, "1");
    }
    command.env("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe");
    if panic {
        command.env(PANIC, "1").stderr(Stdio::null());
    }
    let mut child = command.spawn().ok()?;
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(60) {
        if let Some(status) = child.try_wait().ok()? {
            return Some(status.success());
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().ok()?;
    None
}
