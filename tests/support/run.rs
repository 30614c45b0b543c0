//! Runs a deck on a mesh as the program does, but keeps in memory what the program would write.

use urto::comm::{Communicator, run_threads};
use urto::deck::Source;
use urto::mesh::Mesh;
use urto::model::{Model, examine};
use urto::output::{Collector, FieldList, Schedule, block_energies};
use urto::solver::contact::Tally;
use urto::solver::{Body, Request, Solver, Stop, Totals};

/// A finished run.
pub struct Run {
    /// What was simulated.
    pub model: Model,
    /// The plot states, chosen by PLOT TIME.
    pub states: Vec<State>,
    /// The step lines, chosen by OUTPUT TIME.
    pub lines: Vec<Line>,
    /// Kinetic energy at the start.
    pub initial_energy: f64,
    /// Why it ended early, if it did.
    pub stop: Option<Stop>,
    /// Searches of contact.
    pub searches: u64,
    /// Pairs of points and faces that the last search found.
    pub pairs: usize,
    /// What the passes of contact took.
    pub tally: Tally,
}

/// A plot state.
pub struct State {
    /// Its time.
    pub time: f64,
    nodal: Vec<(String, Vec<f64>)>,
    element: Vec<(String, Vec<f64>)>,
}

/// A step line.
#[derive(Clone)]
pub struct Line {
    /// Steps taken so far.
    pub step: u64,
    /// Time of the state.
    pub time: f64,
    /// Step to the next state.
    pub time_step: f64,
    /// Stable step of the state.
    pub stable_step: f64,
    /// Energies and momenta.
    pub totals: Totals,
    /// Relative error of the energy balance.
    pub balance: f64,
    /// Kinetic energy of each block, in scenes with rigid bodies.
    pub block_kinetic: Vec<f64>,
}

impl State {
    /// A nodal variable by its EXODUS name, one value per node in the mesh's order.
    pub fn nodal(&self, name: &str) -> &[f64] {
        named(&self.nodal, name)
    }

    /// An element variable by its EXODUS name, one value per element in the mesh's order.
    pub fn element(&self, name: &str) -> &[f64] {
        named(&self.element, name)
    }

    /// Positions of all nodes.
    pub fn positions(&self, mesh: &Mesh) -> Vec<[f64; 3]> {
        let u = ["DISPLX", "DISPLY", "DISPLZ"].into_iter().take(mesh.dimension.count()).map(|name| self.nodal(name));
        let u: Vec<&[f64]> = u.collect();
        let moved = |n: usize, i: usize| u.get(i).map_or(0.0, |u| u[n]);
        mesh.coordinates.iter().enumerate().map(|(n, x)| [0, 1, 2].map(|i| x[i] + moved(n, i))).collect()
    }
}

fn named<'a>(variables: &'a [(String, Vec<f64>)], name: &str) -> &'a [f64] {
    let found = variables.iter().find(|(known, _)| known == name);
    &found.unwrap_or_else(|| panic!("the deck does not ask for {name}")).1
}

impl Run {
    /// The last plot state.
    pub fn end(&self) -> &State {
        self.states.last().expect("a run has states")
    }

    /// The last step line.
    pub fn last(&self) -> &Line {
        self.lines.last().expect("a run has lines")
    }

    /// The plot state nearest to a time.
    pub fn at(&self, time: f64) -> &State {
        let distance = |s: &&State| (s.time - time).abs();
        self.states.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("a run has states")
    }

    /// Largest absolute value of the relative error of the energy balance.
    pub fn worst_balance(&self) -> f64 {
        self.lines.iter().fold(0.0, |worst, line| line.balance.abs().max(worst))
    }

    /// The run, which must have reached its termination time.
    #[track_caller]
    pub fn whole(self) -> Run {
        if let Some(stop) = &self.stop {
            panic!("the run stopped: {stop}");
        }
        self
    }
}

/// Reads a deck and holds it against a mesh.
#[track_caller]
pub fn model(deck: &str, mesh: &Mesh) -> Model {
    match examine(Source::new("test deck", deck), Some(mesh)) {
        Ok(problem) => problem.model,
        Err(found) => panic!("{}", found.render(false)),
    }
}

/// Runs a deck on one rank to its termination time.
#[track_caller]
pub fn run(deck: &str, mesh: &Mesh) -> Run {
    run_on(1, deck, mesh).whole()
}

/// Runs a deck on several ranks, to wherever it comes.
#[track_caller]
pub fn run_on(ranks: usize, deck: &str, mesh: &Mesh) -> Run {
    let model = model(deck, mesh);
    let body = Body::new(mesh, &model).expect("materials");
    let cut = body.cut(ranks);
    let contributors = body.contributors(&cut);
    let decomposition = body.decomposition(&contributors, ranks);
    let results = run_threads(ranks, |comm| {
        let share = decomposition.share(comm.rank());
        let mut solver = Solver::new(mesh, &model, &body, &share, comm);
        Ok::<_, ()>(steps(&mut solver, &model, mesh, comm))
    });
    let Ok(mut results) = results else { panic!("a rank failed") };
    let Record { states, lines, initial_energy, stop, searches, pairs, tally } = results.swap_remove(0);
    Run { model, states, lines, initial_energy, stop, searches, pairs, tally }
}

struct Record {
    states: Vec<State>,
    lines: Vec<Line>,
    initial_energy: f64,
    stop: Option<Stop>,
    searches: u64,
    pairs: usize,
    tally: Tally,
}

/// The program's own step loop (`urto::run`) without its files, and without the shorter steps at its end: it ends with the state
/// nearest to the termination time. Energies are measured with the step, and a change of it is seen in their balance.
fn steps(solver: &mut Solver, model: &Model, mesh: &Mesh, comm: &mut dyn Communicator) -> Record {
    let fields = FieldList::new(model, solver);
    let collector = Collector::new(solver, mesh.coordinates.len(), mesh.element_count(), comm);
    let mut plots = Schedule::new(model.plot.start, model.plot.interval, model.plot.stop);
    let mut log = Schedule::new(0.0, Some(model.output_interval), f64::INFINITY);
    let mut record = Record {
        states: Vec::new(),
        lines: Vec::new(),
        initial_energy: solver.initial_energy,
        stop: None,
        searches: 0,
        pairs: 0,
        tally: Tally::default(),
    };
    loop {
        if let Err(stop) = solver.prepare(Request::Continue, comm) {
            record.lines.push(line(solver, mesh, comm));
            record.states.push(state(solver, &fields, &collector, comm));
            record.stop = Some(stop);
            return record;
        }
        let last = solver.time + 0.5 * solver.time_step >= model.termination_time;
        if log.due(solver.time, solver.time_step) || last || solver.step == 0 {
            record.lines.push(line(solver, mesh, comm));
        }
        if plots.due(solver.time, solver.time_step) || last || solver.step == 0 {
            record.states.push(state(solver, &fields, &collector, comm));
        }
        if last {
            if let Some(report) = solver.domain.contact.as_ref().and_then(|contact| contact.report()) {
                (record.searches, record.pairs, record.tally) = (report.searches, report.pairs, report.tally);
            }
            return record;
        }
        solver.advance();
    }
}

fn line(solver: &mut Solver, mesh: &Mesh, comm: &mut dyn Communicator) -> Line {
    let totals = solver.totals(comm);
    let mut energies = Vec::new();
    if solver.domain.rigid.is_some() {
        solver.refresh();
        energies = block_energies(mesh.blocks.len(), solver, comm);
    }
    Line {
        step: solver.step,
        time: solver.time,
        time_step: solver.time_step,
        stable_step: solver.stable_step,
        totals,
        balance: totals.relative_error(solver.initial_energy),
        block_kinetic: energies.chunks_exact(4).map(|of_block| of_block[0]).collect(),
    }
}

fn state(solver: &mut Solver, fields: &FieldList, collector: &Collector, comm: &mut dyn Communicator) -> State {
    let (nodal, element) = (fields.nodal_names(), fields.element_names());
    let nodal_values = collector.nodal(fields.nodal_values(solver, comm), nodal.len(), comm);
    let element_values = collector.element(fields.element_values(solver, comm.rank()), element.len(), comm);
    State {
        time: solver.time,
        nodal: nodal.into_iter().zip(nodal_values.unwrap_or_default()).collect(),
        element: element.into_iter().zip(element_values.unwrap_or_default()).collect(),
    }
}
