//! A run from its first state to its last: steps the solver, writes what is due, and ends in good order.

mod files;
mod memory;
mod report;
mod table;

pub use files::{Files, keep_old_print_files};
pub use report::{Display, Quiet};

use crate::comm::{Communicator, Counted};
use crate::exodus::{ResultsError, ResultsHeader, ResultsWriter};
use crate::mesh::Mesh;
use crate::model::Model;
use crate::output::print::{self, Echo, Ending, PrintLog, StepLine};
use crate::output::{Collector, FieldList, GLOBAL_VARIABLES, HistoryPlan, Schedule, global_values};
use crate::partition::Decomposition;
use crate::solver::contact::Contact;
use crate::solver::{Body, Request, Section, Solver, Stop};
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
    /// Relative error of the energy balance at the end.
    pub energy_error: f64,
    /// Wall-clock seconds per element and cycle.
    pub grind: f64,
    /// Wall-clock seconds of the step loop.
    pub wall: f64,
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
        stop: Stop,
        /// Why the last state could not be written, if it could not.
        unwritten: Option<Box<RunError>>,
    },
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
    /// Rank 0 could not write; the others leave with it.
    #[error("rank 0 could not write its files")]
    Elsewhere,
}

/// Runs one rank to the end. Files and display are rank 0's business.
///
/// # Errors
/// When the simulation cannot go on, after its last state has been written, or when results cannot be written.
pub fn run(job: &Job, comm: &mut dyn Communicator, display: &mut dyn Display) -> Result<Ended, RunError> {
    let comm = &mut Counted::new(comm);
    let mut solver = Solver::new(job.mesh, job.model, job.body, &job.decomposition.share(comm.rank()), comm);
    let mut writer = Writer::new(job, &solver, comm)?;
    writer.start(job, comm)?;
    let begun = Instant::now();
    let outcome = steps(job, &mut solver, &mut writer, comm, display);
    display.finish();
    writer.finish(&mut solver, comm, begun.elapsed().as_secs_f64(), outcome)
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
    loop {
        let agreed = match solver.prepare((job.wish)(), comm) {
            Ok(agreed) => agreed,
            Err(stop) => return give_up(stop, solver, writer, comm),
        };
        // The last state is the one nearest to the termination time.
        let last = agreed != Request::Continue || solver.time + 0.5 * solver.time_step >= model.termination_time;
        let plot_due = plots.due(solver.time, solver.time_step);
        let line_due = lines.due(solver.time, solver.time_step) || last || solver.step == 0;
        if (line_due || plot_due)
            && let Err(stop) = solver.check_energy(comm)
        {
            return give_up(stop, solver, writer, comm);
        }
        if line_due {
            writer.line(solver, comm, display)?;
        }
        if plot_due || last || solver.step == 0 {
            writer.state(solver, comm)?;
        }
        display.progress(solver.step, solver.time, solver.time_step);
        if last {
            return Ok(agreed);
        }
        solver.advance();
    }
}

/// Writes the state in which a run cannot go on, and says why.
fn give_up(
    stop: Stop,
    solver: &mut Solver,
    writer: &mut Writer,
    comm: &mut dyn Communicator,
) -> Result<Request, RunError> {
    let written = writer.state(solver, comm).and_then(|()| writer.last_history(solver, comm));
    let unwritten = written.err().map(Box::new);
    Err(RunError::Stopped { step: solver.step, time: solver.time, stop, unwritten })
}

/// Plot file and print log of a run; files are open on rank 0 only, but every rank takes part in collecting.
struct Writer<'a> {
    fields: FieldList,
    names: [Vec<String>; 3],
    collector: Collector,
    results: Option<ResultsWriter>,
    log: Option<PrintLog>,
    watched: HistoryPlan,
    histories: Option<ResultsWriter>,
    files: &'a Files,
    elements: usize,
    termination_time: f64,
    last_line: (Instant, u64, f64),
    last_state: Option<u64>,
}

impl<'a> Writer<'a> {
    fn new(job: &Job<'a>, solver: &Solver, comm: &mut dyn Communicator) -> Result<Writer<'a>, RunError> {
        let fields = FieldList::new(job.model);
        let (nodes, elements) = (job.mesh.coordinates.len(), job.mesh.element_count());
        Ok(Writer {
            names: [
                fields.nodal_names(),
                fields.element_names(),
                GLOBAL_VARIABLES.iter().map(|(name, _)| name.to_string()).collect(),
            ],
            fields,
            collector: Collector::new(solver, nodes, elements, comm),
            results: None,
            log: None,
            watched: HistoryPlan::new(job.mesh, job.model),
            histories: None,
            files: job.files,
            elements,
            termination_time: job.model.termination_time,
            last_line: (Instant::now(), 0, 0.0),
            last_state: None,
        })
    }

    /// Opens the files and prints the front part of the log, all on rank 0; all ranks learn whether it worked.
    fn start(&mut self, job: &Job, comm: &mut dyn Communicator) -> Result<(), RunError> {
        let outcome = if comm.rank() == 0 { self.open(job) } else { Ok(()) };
        together(outcome, comm)
    }

    fn open(&mut self, job: &Job) -> Result<(), RunError> {
        let [nodal, element, global] = &self.names;
        let header = ResultsHeader {
            mesh: job.mesh,
            title: job.model.title.clone(),
            global: global.clone(),
            nodal: nodal.clone(),
            element: element.clone(),
            qa: job.qa.clone(),
            info: job.deck.lines().map(String::from).collect(),
        };
        self.results = Some(ResultsWriter::create(&self.files.plot, &header)?);
        self.histories = self.open_histories(&header)?;
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
            variables: [nodal, element, global],
            seconds: [(job.clock[1] - job.clock[0]).as_secs_f64(), job.clock[1].elapsed().as_secs_f64()],
            memory: memory::resident().map(|(now, _)| now),
        };
        let front = print::problem(&echo) + &print::step_header();
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

    /// Appends a state to the histories of material points.
    fn history(&mut self, solver: &Solver, comm: &mut dyn Communicator) -> Result<(), RunError> {
        if self.watched.is_empty() {
            return Ok(());
        }
        let values = self.watched.values(solver, comm);
        match (&mut self.histories, values) {
            (Some(file), Some(values)) => Ok(file.write_state(solver.time, &values, &[], &[])?),
            _ => Ok(()),
        }
    }

    /// Appends the state in which a run cannot go on; all ranks learn whether that worked.
    fn last_history(&mut self, solver: &Solver, comm: &mut dyn Communicator) -> Result<(), RunError> {
        let outcome = self.history(solver, comm);
        together(outcome, comm)
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
        solver.clock.start();
        let totals = solver.totals(comm);
        let (nodal_count, element_count) = (self.names[0].len(), self.names[1].len());
        let nodal = self.collector.nodal(self.fields.nodal_values(solver), nodal_count, comm);
        let values = self.fields.element_values(solver, comm.rank());
        let element = self.collector.element(values, element_count, comm);
        let outcome = match (&mut self.results, nodal, element) {
            (Some(results), Some(nodal), Some(element)) => results
                .write_state(solver.time, &global_values(solver, &totals), &nodal, &element)
                .map_err(RunError::from),
            _ => Ok(()),
        };
        let outcome = together(outcome, comm);
        solver.clock.stop(Section::Output);
        outcome
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
        let printed = self.print(&print::step_line(&line));
        display.line(&line);
        let outcome = self.history(solver, comm).and(printed);
        let outcome = together(outcome, comm);
        solver.clock.stop(Section::Output);
        outcome
    }

    /// Closes the log and says how the run ended.
    fn finish(
        mut self,
        solver: &mut Solver,
        comm: &mut Counted,
        wall: f64,
        outcome: Result<Request, RunError>,
    ) -> Result<Ended, RunError> {
        let table = table::time_table(solver, comm, wall, self.elements);
        let totals = solver.totals(comm);
        let words = match &outcome {
            Ok(Request::Continue) => "THE RUN IS COMPLETE".to_string(),
            Ok(by) => format!(
                "STOPPED {} AT STEP {}, TIME {:.6e}; THE LAST STATE IS WRITTEN",
                reason(*by),
                solver.step,
                solver.time
            ),
            Err(RunError::Stopped { stop, .. }) => format!(
                "***** ERROR: AT STEP {}, TIME {:.6e}, TIME STEP {:.6e}: {stop}\n  advice: {}",
                solver.step,
                solver.time,
                solver.time_step,
                stop.advice()
            ),
            Err(error) => format!("***** ERROR: {error}"),
        };
        let states = self.results.as_ref().map_or(0, ResultsWriter::states);
        let initial_energy = solver.initial_energy;
        let ending = Ending {
            outcome: &words,
            steps: solver.step,
            states,
            totals: &totals,
            initial_energy,
            contact: solver.domain.contact.as_ref().and_then(Contact::report),
            gone: solver.domain.erosion.as_ref().map(|erosion| erosion.gone),
        };
        let printed = self.print(&print::closing(&table, &ending));
        let by = outcome?;
        together(printed, comm)?;
        Ok(Ended {
            by,
            steps: solver.step,
            time: solver.time,
            states,
            energy_error: totals.relative_error(initial_energy),
            grind: table.grind(),
            wall,
        })
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

/// All ranks learn whether rank 0's work succeeded, so that they leave together when it did not.
fn together(outcome: Result<(), RunError>, comm: &mut dyn Communicator) -> Result<(), RunError> {
    let mut good = [if outcome.is_ok() { 1.0 } else { 0.0 }];
    comm.all_min(&mut good);
    match outcome {
        Ok(()) if good[0] == 0.0 => Err(RunError::Elsewhere),
        outcome => outcome,
    }
}
