//! A run from its first state to its last: steps the solver, writes what is due, and ends in good order.

mod endless;
mod files;
mod identity;
mod memory;
mod plots;
mod report;
mod restart;
mod table;

pub use endless::Endless;
pub use files::{Files, keep_old_print_files};
pub use identity::{differences, other_form, told};
pub use memory::processor;
pub use report::{Display, Quiet};
pub use restart::{Continuation, states_beside};

use crate::comm::{Communicator, Counted};
use crate::exodus::{ResultsError, ResultsHeader, ResultsWriter};
use crate::mesh::Mesh;
use crate::model::{Model, StepColumns};
use crate::needs::{self, Advice, Scene};
use crate::output::print::{self, Echo, Ending, PrintLog, StepLine};
use crate::output::{FieldList, HistoryPlan, Schedule, block_energy_names, global_names};
use crate::partition::{Decomposition, Share};
use crate::restart::Snapshot;
use crate::solver::contact::Contact;
use crate::solver::{Body, Finding, Request, Section, Solver, Stop};
use plots::Plots;
use restart::RestartFiles;
use std::path::PathBuf;
use std::time::Instant;

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
    /// The body in canonical order.
    pub body: &'a Body,
    /// Which rank computes what.
    pub decomposition: &'a Decomposition<'a>,
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
}

/// Runs one rank to the end. Files and display are rank 0's business, but for pieces of the plot states.
///
/// # Errors
/// When the simulation cannot go on, after its last state has been written, or when results cannot be written.
pub fn run(job: &Job, comm: &mut dyn Communicator, display: &mut dyn Display) -> Result<Ended, RunError> {
    let comm = &mut Counted::new(comm);
    let share = job.decomposition.share(comm.rank());
    let mut solver = Solver::new(job.mesh, job.model, job.body, &share, comm);
    if let Some(continuation) = job.continuation {
        continuation.restore(&mut solver, comm)?;
    }
    let mut writer = Writer::new(job, &solver, &share, comm);
    writer.start(job, comm)?;
    let begun = Instant::now();
    let outcome = steps(job, &mut solver, &mut writer, comm, display);
    display.finish();
    writer.finish(job, &mut solver, comm, begun, outcome)
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
        if solver.is_ending() && !writer.restarts_closed {
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

/// Plot file and print log of a run; the log is open on rank 0 only, but every rank takes part in collecting.
struct Writer<'a> {
    fields: FieldList,
    names: [Vec<String>; 3],
    plots: Plots,
    log: Option<PrintLog>,
    watched: HistoryPlan,
    histories: Option<ResultsWriter>,
    restarts: Option<RestartFiles<'a>>,
    files: &'a Files,
    step_log: &'a [StepColumns],
    elements: usize,
    first_step: u64,
    last_restart: Option<u64>,
    /// The last state of whole steps has been written; those after it are of no use to go on from.
    restarts_closed: bool,
    termination_time: f64,
    last_line: (Instant, u64, f64),
    last_state: Option<u64>,
    /// Time and kinetic energy of each line, and times of the plot states.
    lines: Vec<[f64; 2]>,
    states: Vec<f64>,
    /// Number of warnings from reading deck and mesh.
    told_before: usize,
}

impl<'a> Writer<'a> {
    fn new(job: &Job<'a>, solver: &Solver, share: &Share, comm: &mut dyn Communicator) -> Writer<'a> {
        let fields = FieldList::new(job.model, solver);
        let mut globals: Vec<String> = global_names(job.model).map(String::from).collect();
        if job.model.plot_requests.block_energies {
            globals.extend(block_energy_names(job.mesh));
        }
        let names = [fields.nodal_names(), fields.element_names(), globals];
        Writer {
            plots: Plots::new(job, solver, share, [names[0].len(), names[1].len()], comm),
            fields,
            names,
            log: None,
            watched: HistoryPlan::new(job.mesh, job.model, solver),
            histories: None,
            restarts: RestartFiles::new(job, solver),
            files: job.files,
            step_log: &job.model.step_log,
            elements: job.mesh.element_count(),
            first_step: solver.step,
            last_restart: None,
            restarts_closed: false,
            termination_time: job.model.termination_time,
            last_line: (Instant::now(), solver.step, solver.time),
            last_state: None,
            lines: Vec::new(),
            states: Vec::new(),
            told_before: job.warnings.len(),
        }
    }

    /// Opens the files and prints the front part of the log on rank 0; all ranks learn whether it worked.
    fn start(&mut self, job: &Job, comm: &mut dyn Communicator) -> Result<(), RunError> {
        let [nodal, element, global] = self.names.clone();
        let header = ResultsHeader {
            mesh: job.mesh,
            title: job.model.title.clone(),
            global,
            nodal,
            element,
            qa: same_qa(&job.qa, comm),
            info: job.deck.lines().map(String::from).collect(),
        };
        let opened = self.plots.open(&self.files.plot, &header, comm.rank());
        let outcome = opened.and_then(|()| if comm.rank() == 0 { self.open(job, &header) } else { Ok(()) });
        together(outcome, comm)
    }

    fn open(&mut self, job: &Job, header: &ResultsHeader) -> Result<(), RunError> {
        self.histories = self.open_histories(header)?;
        let mut log = PrintLog::create(&self.files.print).map_err(|e| self.print_error(e))?;
        let echo = Echo {
            banner: job.banner,
            deck: job.deck,
            assumed: job.assumed,
            warnings: job.warnings,
            model: job.model,
            mesh: job.mesh,
            overlap: job.body.overlap,
            masses: &job.body.block_masses(job.mesh.blocks.len()),
            added: &job.body.added_mass.blocks,
            variables: [&self.names[0], &self.names[1], &self.names[2]],
            seconds: [(job.clock[1] - job.clock[0]).as_secs_f64(), job.clock[1].elapsed().as_secs_f64()],
            memory: memory::resident().map(|(now, _)| now),
        };
        let from = job.continuation.map_or(String::new(), |from| print::continued(&from.in_words()));
        let front = print::problem(&echo) + &from + &print::step_header(&job.model.step_log);
        log.write(&front).map_err(|e| self.print_error(e))?;
        self.log = Some(log);
        Ok(())
    }

    /// Opens the file of histories, when points are watched.
    fn open_histories(&self, of_plot: &ResultsHeader) -> Result<Option<ResultsWriter>, RunError> {
        if self.watched.is_empty() {
            return Ok(None);
        }
        let header = ResultsHeader {
            mesh: &self.watched.mesh(of_plot.mesh),
            global: self.watched.names(),
            nodal: Vec::new(),
            element: Vec::new(),
            info: [self.watched.records(), of_plot.info.clone()].concat(),
            title: of_plot.title.clone(),
            qa: of_plot.qa.clone(),
        };
        Ok(Some(ResultsWriter::create(&self.files.history, &header)?))
    }

    /// Appends a state to the histories; all ranks learn whether that worked. What was due is compared with the next one.
    fn history(&mut self, solver: &mut Solver, comm: &mut dyn Communicator, due: bool) -> Result<(), RunError> {
        if self.watched.is_empty() {
            return Ok(());
        }
        solver.clock.start();
        let values = self.watched.values(solver, comm, due);
        let outcome = match (&mut self.histories, values) {
            (Some(file), Some(values)) => file.write_state(solver.time, &values, &[], &[]).map_err(RunError::from),
            _ => Ok(()),
        };
        let outcome = together(outcome, comm);
        solver.clock.stop(Section::Output);
        outcome
    }

    fn print_error(&self, source: std::io::Error) -> RunError {
        RunError::Print { path: self.files.print.clone(), source }
    }

    fn print(&mut self, text: &str) -> Result<(), RunError> {
        match self.log.as_mut().map(|log| log.write(text)) {
            Some(Err(e)) => Err(self.print_error(e)),
            _ => Ok(()),
        }
    }

    /// Writes a plot state, once per step.
    fn state(&mut self, solver: &mut Solver, comm: &mut dyn Communicator) -> Result<(), RunError> {
        if self.last_state.replace(solver.step) == Some(solver.step) {
            return Ok(());
        }
        self.states.push(solver.time);
        solver.clock.start();
        let totals = solver.totals(comm);
        let outcome = self.plots.write(solver, &self.fields, &totals, comm);
        let outcome = together(outcome, comm);
        solver.clock.stop(Section::Output);
        outcome
    }

    /// Tells what the run has found out about itself.
    fn warnings(
        &mut self,
        solver: &mut Solver,
        comm: &mut dyn Communicator,
        display: &mut dyn Display,
    ) -> Result<(), RunError> {
        let news = solver.new_findings();
        // All ranks have found the same.
        if news.is_empty() {
            return Ok(());
        }
        news.iter().for_each(|finding| display.warning(finding));
        let text: String = news.iter().map(print::warning).collect();
        let printed = self.print(&text);
        together(printed, comm)
    }

    /// Writes a line of the log.
    fn line(
        &mut self,
        solver: &mut Solver,
        comm: &mut dyn Communicator,
        display: &mut dyn Display,
    ) -> Result<(), RunError> {
        solver.clock.start();
        let totals = solver.totals(comm);
        self.lines.push([solver.time, totals.kinetic]);
        let controlling = solver.controlling_element(comm);
        let (since, step, time) = std::mem::replace(&mut self.last_line, (Instant::now(), solver.step, solver.time));
        let seconds = since.elapsed().as_secs_f64();
        let per = |quantity: f64| if quantity > 0.0 { seconds / quantity } else { 0.0 };
        let dilatation = per(solver.time - time);
        let line = StepLine {
            step: solver.step,
            time: solver.time,
            time_step: solver.time_step,
            totals: &totals,
            initial_energy: solver.initial_energy,
            controlling,
            grind: per((solver.step - step) as f64 * self.elements as f64),
            dilatation,
            to_go: dilatation * (self.termination_time - solver.time).max(0.0),
        };
        let printed = self.print(&print::step_line(self.step_log, &line));
        display.line(&line);
        let outcome = together(printed, comm);
        solver.clock.stop(Section::Output);
        outcome
    }

    /// The present state between two steps, where it may be the last one from which a run can go on to another end as if
    /// there had never been this one. All ranks call it.
    fn before_the_end(&mut self, solver: &mut Solver, comm: &mut dyn Communicator) -> Option<Snapshot> {
        let may_be = self.restarts.is_some() && !self.restarts_closed && solver.nears_end();
        if !may_be {
            return None;
        }
        solver.clock.start();
        let snapshot = self.plots.snapshot(solver, comm);
        solver.clock.stop(Section::Output);
        snapshot
    }

    /// Writes the last state that steps of their whole length have led to, unless it is on the disk.
    fn last_whole_state(
        &mut self,
        snapshot: Option<Snapshot>,
        solver: &mut Solver,
        comm: &mut dyn Communicator,
    ) -> Result<(), RunError> {
        self.restarts_closed = true;
        if self.restarts.is_none() || self.last_restart == Some(solver.step) {
            return Ok(());
        }
        self.write_restart(snapshot, solver, comm)
    }

    /// Writes the state between two steps.
    fn restart(&mut self, solver: &mut Solver, comm: &mut dyn Communicator) -> Result<(), RunError> {
        solver.clock.start();
        let snapshot = self.plots.snapshot(solver, comm);
        solver.clock.stop(Section::Output);
        self.write_restart(snapshot, solver, comm)
    }

    fn write_restart(
        &mut self,
        snapshot: Option<Snapshot>,
        solver: &mut Solver,
        comm: &mut dyn Communicator,
    ) -> Result<(), RunError> {
        solver.clock.start();
        let outcome = match (&mut self.restarts, snapshot) {
            (Some(restarts), Some(snapshot)) => restarts.write(snapshot).map_err(RunError::from),
            _ => Ok(()),
        };
        self.last_restart = Some(solver.step);
        let outcome = together(outcome, comm).and_then(|()| self.print(&print::restart_written(solver)));
        solver.clock.stop(Section::Output);
        together(outcome, comm)
    }

    /// Leaves the state to go on from at the end of a run, unless it has just been written: that after the step that
    /// follows.
    fn last_restart(&mut self, solver: &mut Solver, comm: &mut dyn Communicator) -> Result<(), RunError> {
        if self.restarts.is_none() || self.restarts_closed || self.last_restart == Some(solver.step) {
            return Ok(());
        }
        solver.advance();
        self.restart(solver, comm)
    }

    /// Closes the log and says how the run ended.
    fn finish(
        mut self,
        job: &Job,
        solver: &mut Solver,
        comm: &mut Counted,
        begun: Instant,
        outcome: Result<Request, RunError>,
    ) -> Result<Ended, RunError> {
        let (step, time, time_step, totals) = (solver.step, solver.time, solver.time_step, solver.totals(comm));
        // What a run saw that came to no end says nothing of the whole.
        let scene = Scene {
            mesh: job.mesh,
            model: job.model,
            solver,
            lines: &self.lines,
            states: &self.states,
            continued: job.continuation.is_some(),
        };
        let complete = matches!(outcome, Ok(Request::Continue));
        let advice = if complete { needs::advice(&scene, comm) } else { Vec::new() };
        let outcome = outcome.and_then(|by| self.last_restart(solver, comm).map(|()| by));
        let wall = begun.elapsed().as_secs_f64();
        let table = table::time_table(solver, comm, wall, [step - self.first_step, self.elements as u64]);
        let states = self.plots.states();
        let initial_energy = solver.initial_energy;
        let warnings = print::labels(self.told_before, solver.findings());
        let ending = Ending {
            outcome: &(in_words(&outcome, step, time, time_step) + &print::with_warnings(&warnings).to_uppercase()),
            findings: solver.findings(),
            steps: step,
            states,
            totals: &totals,
            initial_energy,
            stored_energy: solver.stored_energy(),
            contact: solver.domain.contact.as_ref().and_then(Contact::report),
            gone: solver.domain.erosion.as_ref().map(|erosion| erosion.gone),
            advice: &advice,
        };
        let printed = self.print(&print::closing(&table, &ending));
        let by = outcome?;
        together(printed, comm)?;
        Ok(Ended {
            by,
            steps: step,
            time,
            states,
            restart: self.restarts.is_some(),
            energy_error: totals.relative_error(initial_energy),
            warnings,
            grind: table.grind(),
            wall,
            findings: solver.findings().to_vec(),
            sections: table.sections.iter().map(|part| (part.name.clone(), part.spread.mean)).collect(),
            memory: table.memory,
            advice: advice.iter().map(|advice| (advice.clone(), print::share(advice, &table))).collect(),
        })
    }
}

/// How a run ended, for the log.
fn in_words(outcome: &Result<Request, RunError>, step: u64, time: f64, time_step: f64) -> String {
    match outcome {
        Ok(Request::Continue) => "THE RUN IS COMPLETE".to_string(),
        Ok(by) => {
            format!("STOPPED {} AT STEP {step}, TIME {time:.6e}; THE LAST STATE IS WRITTEN", reason(*by))
        }
        Err(RunError::Stopped { stop, .. }) => format!(
            "***** ERROR: AT STEP {step}, TIME {time:.6e}, TIME STEP {time_step:.6e}: {stop}\n  advice: {}",
            stop.advice().join("\n  advice: ")
        ),
        Err(error) => format!("***** ERROR: {error}"),
    }
}

fn reason(by: Request) -> &'static str {
    match by {
        Request::Continue => "",
        Request::Shutdown => "BY THE SHUTDOWN FILE",
        Request::Interrupt => "BY SIGINT",
        Request::Terminate => "BY SIGTERM",
    }
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
