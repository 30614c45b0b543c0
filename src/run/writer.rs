//! The files of a run: print log, plot states, histories and restart states, each written when it is due.

use super::memory;
use super::plots::Plots;
use super::restart::{Continuation, RestartFiles};
use super::table;
use super::{Display, Ended, Files, Job, RunError, same_qa, together};
use crate::comm::{Communicator, Counted};
use crate::exodus::{ResultsHeader, ResultsWriter};
use crate::mesh::Block;
use crate::model::StepColumns;
use crate::output::print::{self, Echo, Ending, PrintLog, StepLine};
use crate::output::{FieldList, HistoryPlan, block_energy_names, global_names};
use crate::partition::Share;
use crate::postprocess::depiction::{Depiction, RigidPlane};
use crate::postprocess::means::Means;
use crate::restart::Snapshot;
use crate::solver::contact::Contact;
use crate::solver::elements::{Element, Touch};
use crate::solver::{Body, Request, Section, Solver};
use crate::studies::advice::{self, Scene};
use std::time::Instant;

/// Plot file and print log of a run; the log is open on rank 0 only, but every rank takes part in collecting.
pub(super) struct Writer<'a> {
    fields: FieldList,
    names: [Vec<String>; 3],
    plots: Plots,
    log: Option<PrintLog>,
    watched: HistoryPlan,
    histories: Option<ResultsWriter>,
    /// When the last state of the histories was due in the run that this one continues.
    since: Option<f64>,
    pub(super) restarts: Option<RestartFiles<'a>>,
    files: &'a Files,
    step_log: &'a [StepColumns],
    elements: usize,
    pub(super) first_step: u64,
    last_restart: Option<u64>,
    /// The last state of whole steps has been written; those after it are of no use to go on from.
    pub(super) restarts_closed: bool,
    termination_time: f64,
    last_line: (Instant, u64, f64),
    last_state: Option<u64>,
    /// Time and kinetic energy of each line, and times of the plot states.
    lines: Vec<[f64; 2]>,
    states: Vec<f64>,
    /// Number of warnings from reading deck and mesh.
    told_before: usize,
    /// Number of nodes that were moved because surfaces overlapped in the mesh.
    moved: usize,
}

/// What pictures need of the deck.
fn depiction(job: &Job, body: &Body) -> Depiction {
    let planes = job.model.rigid_surfaces.iter();
    let planes = planes.map(|plane| RigidPlane { side_set: plane.side_set, point: plane.point, normal: plane.normal });
    let size = |(block, element): (&Block, &Element)| {
        // Where attributes differ in a block, the first element stands for all.
        let touch = element.touch(block.attributes_of(0));
        match touch {
            Touch::Outside => None,
            Touch::BothSides(half) => Some((block.id, 2.0 * half)),
            Touch::Nodes(radius) => Some((block.id, radius)),
        }
    };
    let sizes = job.mesh.blocks.iter().zip(&body.elements).filter_map(size);
    Depiction { planes: planes.collect(), sizes: sizes.collect() }
}

impl<'a> Writer<'a> {
    pub(super) fn new(
        job: &Job<'a>,
        solver: &Solver,
        (body, share): (&Body, &Share),
        comm: &mut dyn Communicator,
    ) -> Writer<'a> {
        let fields = FieldList::new(job.model, solver);
        let mut globals: Vec<String> = global_names(job.model).map(String::from).collect();
        if job.model.plot_requests.block_energies {
            globals.extend(block_energy_names(job.mesh));
        }
        let names = [fields.nodal_names(), fields.element_names(), globals];
        Writer {
            plots: Plots::new(job, solver, (body, share), comm),
            fields,
            names,
            log: None,
            watched: HistoryPlan::new(job.mesh, job.model, solver),
            histories: None,
            since: solver.remembered.since(),
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
            moved: body.overlap.nodes,
        }
    }

    /// Opens the files and prints the front part of the log on rank 0; all ranks learn whether it worked.
    pub(super) fn start(&mut self, job: &Job, body: &Body, comm: &mut dyn Communicator) -> Result<(), RunError> {
        let [nodal, element, global] = self.names.clone();
        // From when on this file replaces what the part before went on to.
        let since = Means { beginnings: Vec::new(), since: job.continuation.map(Continuation::time) };
        let header = ResultsHeader {
            mesh: job.mesh,
            title: job.model.title.clone(),
            global,
            nodal,
            element,
            qa: same_qa(&job.qa, comm),
            info: job.deck.lines().map(String::from).chain(depiction(job, body).lines()).chain(since.lines()).collect(),
        };
        let opened = self.plots.open(&self.files.plot, &header, comm.rank());
        let outcome = opened.and_then(|()| if comm.rank() == 0 { self.open(job, body, &header) } else { Ok(()) });
        together(outcome, comm)
    }

    fn open(&mut self, job: &Job, body: &Body, header: &ResultsHeader) -> Result<(), RunError> {
        self.histories = self.open_histories(header)?;
        let mut log = PrintLog::create(&self.files.print).map_err(|e| self.print_error(e))?;
        let echo = Echo {
            banner: job.banner,
            deck: job.deck,
            assumed: job.assumed,
            warnings: job.warnings,
            model: job.model,
            mesh: job.mesh,
            overlap: body.overlap,
            masses: &body.block_masses(job.mesh.blocks.len()),
            added: &body.added_mass.blocks,
            rigid: &body.rigid,
            ties: &body.tied.reports,
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
            // Histories begin their first interval where they were last due, and not where the run goes on.
            info: [self.watched.records(self.since), Means::without(of_plot.info.clone())].concat(),
            title: of_plot.title.clone(),
            qa: of_plot.qa.clone(),
        };
        Ok(Some(ResultsWriter::create(&self.files.history, &header)?))
    }

    /// Appends a state to the histories; all ranks learn whether that worked. What was due is compared with the next one.
    pub(super) fn history(
        &mut self,
        solver: &mut Solver,
        comm: &mut dyn Communicator,
        due: bool,
    ) -> Result<(), RunError> {
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
    pub(super) fn state(&mut self, solver: &mut Solver, comm: &mut dyn Communicator) -> Result<(), RunError> {
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
    pub(super) fn warnings(
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
    pub(super) fn line(
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
    pub(super) fn before_the_end(&mut self, solver: &mut Solver, comm: &mut dyn Communicator) -> Option<Snapshot> {
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
    pub(super) fn last_whole_state(
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
    pub(super) fn restart(&mut self, solver: &mut Solver, comm: &mut dyn Communicator) -> Result<(), RunError> {
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

    /// Makes sure that the files of this rank are still there.
    fn in_place(&self) -> Result<(), RunError> {
        self.plots.in_place()?;
        self.histories.as_ref().map_or(Ok(()), ResultsWriter::in_place)?;
        self.restarts.as_ref().map_or(Ok(()), RestartFiles::in_place)?;
        let log = self.log.as_ref().map_or(Ok(()), |log| log.in_place(&self.files.print));
        log.map_err(|error| self.print_error(error))
    }

    /// Closes the log and says how the run ended.
    pub(super) fn finish(
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
            moved: self.moved,
        };
        let complete = matches!(outcome, Ok(Request::Continue));
        let advice = if complete { advice::of_scene(&scene, comm) } else { Vec::new() };
        let outcome = outcome.and_then(|by| self.last_restart(solver, comm).map(|()| by));
        // What nobody finds is no result of a run that is done.
        let outcome = outcome.and_then(|by| together(self.in_place(), comm).map(|()| by));
        let wall = begun.elapsed().as_secs_f64();
        let table = table::time_table(solver, comm, wall, [step - self.first_step, self.elements as u64]);
        let states = self.plots.states();
        let initial_energy = solver.initial_energy;
        let warnings = print::labels(self.told_before, solver.findings());
        let ending = Ending {
            outcome: &in_words(&outcome, (step, time, time_step), &print::with_warnings(&warnings).to_uppercase()),
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
        let interval = job.model.plot.interval;
        let of_output = print::advice_on_output(&table, states, interval).filter(|_| complete);
        let told = advice.iter().cloned().chain(of_output).map(|advice| {
            let share = print::share(&advice, &table);
            (advice, share)
        });
        let told = told.collect();
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
            advice: told,
        })
    }
}

/// How a run ended, for the log.
fn in_words(outcome: &Result<Request, RunError>, (step, time, time_step): (u64, f64, f64), warnings: &str) -> String {
    let (ended, advice) = match outcome {
        Ok(Request::Continue) => ("THE RUN IS COMPLETE".to_string(), Vec::new()),
        Ok(by) => {
            let by = by.asked_by().unwrap_or_default().to_uppercase();
            (format!("STOPPED {by} AT STEP {step}, TIME {time:.6e}; THE LAST STATE IS WRITTEN"), Vec::new())
        }
        Err(RunError::Stopped { stop, .. }) => {
            let when = format!("AT STEP {step}, TIME {time:.6e}, TIME STEP {time_step:.6e}");
            (format!("***** ERROR: {when}: {stop}"), stop.advice())
        }
        Err(error) => (format!("***** ERROR: {error}"), Vec::new()),
    };
    let advice: String = advice.iter().map(|advice| format!("\n  advice: {advice}")).collect();
    format!("{ended}{warnings}{advice}")
}
