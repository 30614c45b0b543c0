//! A run from its first state to its last: steps the solver, writes what is due, and ends in good order.

mod endless;
mod files;
mod identity;
mod lock;
mod memory;
mod parts;
mod plots;
mod report;
mod restart;
mod table;
mod writer;

pub use endless::Endless;
pub use files::{Files, first_part_of, keep_old_print_files, last_part_of, part_of};
pub use identity::{differences, other_form, told, without_effect};
pub use lock::Lock;
pub use memory::processor;
pub use parts::Parts;
pub use report::{Display, Quiet};
pub use restart::{Continuation, aside, set_aside, states_beside};

use crate::comm::{Communicator, Counted};
use crate::exodus::ResultsError;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::output::Schedule;
use crate::solver::{Finding, Request, Solver, Stop};
use crate::studies::advice::Advice;
use std::path::PathBuf;
use std::time::Instant;
use writer::Writer;

/// Everything that all ranks know.
pub struct Job<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// What to simulate.
    pub model: &'a Model,
    /// Text of the deck, for the records.
    pub deck: &'a str,
    /// What was assumed in reading it.
    pub assumed: &'a [String],
    /// Warnings from reading it.
    pub warnings: &'a [String],
    /// When the program began, and when it had read deck and mesh.
    pub clock: [Instant; 2],
    /// Banner of the print log.
    pub banner: &'a [String],
    /// QA record of this run: program, version, date, time.
    pub qa: [String; 4],
    /// Where results go.
    pub files: &'a Files,
    /// The body in canonical order, and which rank computes what of it.
    pub parts: &'a Parts,
    /// Each rank writes its piece of the plot states.
    pub split: bool,
    /// The state that the run goes on from, if it does.
    pub continuation: Option<&'a Continuation>,
    /// What the outside world wants of the run: signals, a shutdown file.
    pub wish: &'a (dyn Fn() -> Request + Sync),
}

/// How a run ended that did not fail.
#[derive(Debug, Clone, PartialEq)]
pub struct Ended {
    /// `Continue` when it reached the termination time, else what stopped it.
    pub by: Request,
    /// Steps taken.
    pub steps: u64,
    /// Time reached.
    pub time: f64,
    /// Plot states written.
    pub states: usize,
    /// Whether a restart state was written.
    pub restart: bool,
    /// Relative error of the energy balance at the end.
    pub energy_error: f64,
    /// What the run warned of, in a few words each.
    pub warnings: Vec<String>,
    /// Wall-clock seconds per element and cycle.
    pub grind: f64,
    /// Wall-clock seconds of the step loop.
    pub wall: f64,
    /// What it has found out about itself.
    pub findings: Vec<Finding>,
    /// Wall-clock seconds of each section of the step, the mean over all ranks.
    pub sections: Vec<(String, f64)>,
    /// Most memory held by this process, in bytes, where the system tells.
    pub memory: Option<f64>,
    /// What the scene did not need, and what it lacked, each with the part of the time that it is about.
    pub advice: Vec<(Advice, Option<f64>)>,
}

/// Why a run failed.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The simulation could not go on; its last state has been written.
    #[error("the run stopped at step {step}, time {time:.6e}: {stop}")]
    Stopped {
        /// Step.
        step: u64,
        /// Time.
        time: f64,
        /// Cause.
        stop: Box<Stop>,
        /// Why the last state could not be written, if it could not.
        unwritten: Option<Box<RunError>>,
        /// What the run had found out about itself.
        findings: Vec<Finding>,
    },
    /// The first step is so short that the run would take for ever.
    #[error(transparent)]
    Endless(#[from] Endless),
    /// The plot file.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// The print log.
    #[error("cannot write {}: {source}", path.display())]
    Print {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The state to go on from lacks something.
    #[error("the restart file lacks {}", .0.join(", "))]
    Incomplete(Vec<String>),
    /// Another rank could not write; all leave with it, and with its words.
    #[error("{0}")]
    Elsewhere(String),
    /// One of these, once the steps had begun.
    #[error("{source}")]
    Underway {
        /// Step that was reached.
        step: u64,
        /// Time that was reached.
        time: f64,
        /// Cause.
        source: Box<RunError>,
        /// What the run had found out about itself.
        findings: Vec<Finding>,
    },
}

impl RunError {
    /// The same with how far the run had come, where that is not told already.
    fn at(self, solver: &Solver) -> RunError {
        match self {
            told @ (RunError::Stopped { .. } | RunError::Underway { .. } | RunError::Endless(_)) => told,
            other => RunError::Underway {
                step: solver.step,
                time: solver.time,
                source: Box::new(other),
                findings: solver.findings().to_vec(),
            },
        }
    }
}

/// Runs one rank to the end. Files and display are rank 0's business, but for pieces of the plot states.
///
/// # Errors
/// When the simulation cannot go on, after its last state has been written, or when results cannot be written.
pub fn run(job: &Job, comm: &mut dyn Communicator, display: &mut dyn Display) -> Result<Ended, RunError> {
    let comm = &mut Counted::new(comm);
    let (body, share) = job.parts.take(comm.rank());
    let mut solver = Solver::new(job.mesh, job.model, &body, &share, comm);
    if let Some(continuation) = job.continuation {
        continuation.restore(&mut solver, comm)?;
    }
    let mut writer = Writer::new(job, &solver, (&body, &share), comm);
    writer.start(job, &body, comm)?;
    // What only setting up asks for makes room for the steps.
    drop((body, share));
    let begun = Instant::now();
    let outcome = steps(job, &mut solver, &mut writer, comm, display).map_err(|error| error.at(&solver));
    display.finish();
    writer.finish(job, &mut solver, comm, begun, outcome).map_err(|error| error.at(&solver))
}

/// The step loop. Ends with what stopped the run, or with the reason why it cannot go on.
fn steps(
    job: &Job,
    solver: &mut Solver,
    writer: &mut Writer,
    comm: &mut dyn Communicator,
    display: &mut dyn Display,
) -> Result<Request, RunError> {
    let model = job.model;
    let mut plots = Schedule::new(model.plot.start, model.plot.interval, model.plot.stop);
    let mut lines = Schedule::new(0.0, Some(model.output_interval), f64::INFINITY);
    let every = model.history_interval.unwrap_or(model.output_interval);
    let mut histories = Schedule::new(0.0, Some(every), f64::INFINITY);
    if job.continuation.is_some() {
        plots.pass(solver.previous_time, solver.time_step);
        lines.pass(solver.previous_time, solver.time_step);
        histories.pass(solver.previous_time, solver.time_step);
    }
    solver.end_at(model.termination_time);
    loop {
        let before = writer.before_the_end(solver, comm);
        let agreed = match solver.prepare((job.wish)(), comm) {
            Ok(agreed) => agreed,
            Err(stop) => return give_up(stop, solver, writer, comm, display),
        };
        if solver.step == writer.first_step
            && let Some(endless) = Endless::at(solver.time, solver.time_step, model.termination_time)
        {
            return Err(endless.into());
        }
        let last = agreed != Request::Continue || solver.is_at_end();
        if !solver.is_ending() {
            // Steps may become so short that an end that was near is far again.
            writer.restarts_closed = false;
        } else if !writer.restarts_closed {
            writer.last_whole_state(before, solver, comm)?;
        }
        let plot_due = plots.due(solver.time, solver.time_step);
        let line_due = lines.due(solver.time, solver.time_step) || last || solver.step == 0;
        if (line_due || plot_due)
            && let Err(stop) = solver.look(comm)
        {
            return give_up(stop, solver, writer, comm, display);
        }
        writer.warnings(solver, comm, display)?;
        let history_due = histories.due(solver.time, solver.time_step);
        if line_due {
            writer.line(solver, comm, display)?;
        }
        if history_due || last || solver.step == 0 {
            writer.history(solver, comm, history_due)?;
        }
        if plot_due || last || solver.step == 0 {
            writer.state(solver, comm)?;
        }
        display.progress(solver.step, solver.time, solver.time_step);
        if last {
            return Ok(agreed);
        }
        solver.advance();
        let due = !writer.restarts_closed && writer.restarts.as_mut().is_some_and(|restarts| restarts.due(solver));
        if due {
            writer.restart(solver, comm)?;
        }
    }
}

/// Writes the state in which a run cannot go on, and says why.
fn give_up(
    stop: Stop,
    solver: &mut Solver,
    writer: &mut Writer,
    comm: &mut dyn Communicator,
    display: &mut dyn Display,
) -> Result<Request, RunError> {
    let written = writer.warnings(solver, comm, display).and_then(|()| writer.state(solver, comm));
    let written = written.and_then(|()| writer.history(solver, comm, false));
    let unwritten = written.err().map(Box::new);
    let findings = solver.findings().to_vec();
    Err(RunError::Stopped { step: solver.step, time: solver.time, stop: Box::new(stop), unwritten, findings })
}

/// All ranks learn whether every rank's work succeeded, so that they leave together when it did not, with the words of
/// the first that failed.
fn together(outcome: Result<(), RunError>, comm: &mut dyn Communicator) -> Result<(), RunError> {
    let mut good = [if outcome.is_ok() { 1.0 } else { 0.0 }];
    comm.all_min(&mut good);
    if good[0] != 0.0 {
        return outcome;
    }
    let own = outcome.as_ref().err().map_or(String::new(), RunError::to_string);
    let all = comm.gather(own.into_bytes()).unwrap_or_default();
    let mut words = all.into_iter().find(|words| !words.is_empty()).unwrap_or_default();
    comm.broadcast(&mut words);
    outcome.and_then(|()| Err(RunError::Elsewhere(String::from_utf8_lossy(&words).into_owned())))
}

/// Rank 0's QA record on every rank: processes do not start in the same second, but pieces must tell that they are of
/// one run.
fn same_qa(own: &[String; 4], comm: &mut dyn Communicator) -> [String; 4] {
    let mut bytes = own.join("\n").into_bytes();
    comm.broadcast(&mut bytes);
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let mut lines = text.split('\n').map(String::from);
    std::array::from_fn(|_| lines.next().unwrap_or_default())
}
