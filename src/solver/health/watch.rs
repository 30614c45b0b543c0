//! Looking, and remembering what was found.

use super::finding::{Evidence, Finding, ROW, Spot};
use super::symptoms::contact::{overlap_deep, overlap_moved, overlap_stuck};
use super::symptoms::{SYMPTOMS, When};
use super::{energy, symptoms};
use crate::comm::Communicator;
use crate::mesh::{Mesh, counts_from_one};
use crate::model::{Hourglass, Jump, Model, Pulse};
use crate::partition::Share;
use crate::restart::Archive;
use crate::solver::contact::Overlap;
use crate::solver::contact::unheld::Told;
use crate::solver::elements::quadrilateral::hourglass::of_fluids;
use crate::solver::nodes::{dot, subtract};
use crate::solver::{Body, Solver, Stop, Totals, totals};

/// Steps between looks at what contact alone has made.
const CONTACT_INTERVAL: u64 = 10;

/// What does not change in a run.
#[derive(Debug, Clone, Default)]
pub struct Facts {
    /// The analyst's number of each local node; empty where nodes have the numbers of their places in the file, from 1.
    pub node_id: Vec<i64>,
    /// Number, mass and elements of each block of the mesh.
    pub blocks: Vec<BlockFacts>,
    /// Energy below which nothing is said about energies.
    pub energy_floor: f64,
    /// Internal energy that gases and explosives hold at the start.
    pub stored_energy: f64,
    /// Kinetic energy that all had together at the start along axes where nothing holds the model: it stays that.
    pub flight_energy: f64,
    /// Part of the whole damping by which hourglass modes of fluids are resisted.
    pub damping: f64,
    /// Whether hourglass modes have a viscosity.
    pub viscous_modes: bool,
    /// Time at which the run ends.
    pub termination_time: f64,
    /// Part of the largest energy supplied at which a gain of contact ends the run.
    pub contact_limit: f64,
    /// Overlaps of the mesh.
    pub overlap: Overlap,
    /// The node that was moved farthest out of them, and the one that is left deepest inside an element,
    /// and the deepest of those that could not be moved.
    pub overlap_spots: [Option<Spot>; 3],
    /// Edges that begin going through faces, and elements that begin inside other bodies, which contact does not see.
    pub unheld: [Option<Told>; 2],
    /// How many tied nodes are held although they follow others, and the first of them.
    pub tied_held: (usize, Option<Spot>),
    /// The shortest pulse of the functions that drive and load.
    pub pulse: Option<Pulse>,
    /// The largest displacement that is prescribed for the first instant.
    pub jump: Option<Jump>,
}

/// A block of the mesh.
#[derive(Debug, Clone, Copy, Default)]
pub struct BlockFacts {
    /// Its number.
    pub id: i64,
    /// Its mass at the start.
    pub mass: f64,
    /// Number of its elements at the start.
    pub elements: usize,
    /// Square of the speed of dilatational waves in it at the start, energy/mass.
    pub speed_squared: f64,
}

/// What a run has found out about itself.
#[derive(Debug, Clone, Default)]
pub struct Watch {
    facts: Facts,
    /// Largest energy supplied so far.
    pub supplied: f64,
    /// The same when everything was looked at, at the ends of the last two intervals of [`WINDOW`].
    supplied_before: [f64; 2],
    /// Time at the end of the last one.
    interval_end: f64,
    /// Step of the last look at what is due at some lines only, see [`When::SomeLines`].
    last_of_some: u64,
    /// What is worth a warning, in the order in which it was seen.
    findings: Vec<Finding>,
    /// How many of these have been handed out.
    told: usize,
    /// What can be why an element inverts or energy runs away, in the order in which it was seen.
    causes: Vec<Finding>,
}

/// What a look looks at.
pub struct Exam<'a> {
    /// The run.
    pub solver: &'a Solver,
    /// What does not change in it.
    pub facts: &'a Facts,
    /// Energies of the present state.
    pub totals: Totals,
    /// Largest energy supplied so far, not below the one that is worth words.
    pub supplied: f64,
    /// Whether it has grown so much of late that what it will be compared with is yet to come.
    pub begins: bool,
    /// Whether this look is the last one of the run, at its end or where it cannot go on.
    pub ends: bool,
}

/// Supplied energy that has grown by this factor within one or two intervals is that of a beginning: of loads that rise, of fits
/// that are pressed.
const BEGINS: f64 = 2.0;

/// Length of an interval as a part of the termination time. By looks that follow each other closely nothing grows, however soft a
/// load begins. What a load supplies that rises in proportion to time through all of a run ceases to be a beginning after four of ten.
const WINDOW: f64 = 0.1;

impl Watch {
    /// What there is to know of a run before its first step.
    pub fn new(
        mesh: &Mesh,
        model: &Model,
        body: &Body,
        share: &Share,
        [initial_energy, flight_energy]: [f64; 2],
    ) -> Watch {
        let masses = body.block_masses(mesh.blocks.len());
        let block = |((block, mass), &material): ((&crate::mesh::Block, f64), &usize)| {
            let material = &model.materials[material];
            let speed_squared = material.law.moduli().dilatational() / material.density;
            BlockFacts { id: block.id, mass, elements: block.len(), speed_squared }
        };
        let facts = Facts {
            node_id: node_numbers(mesh, share),
            blocks: mesh.blocks.iter().zip(masses).zip(body.block_material.iter()).map(block).collect(),
            energy_floor: energy::energy_floor(body, model),
            stored_energy: energy::stored_energy(body, model),
            flight_energy,
            damping: of_fluids(model.hourglass),
            viscous_modes: matches!(model.hourglass, Hourglass::FlanaganBelytschko { viscosity, .. } if viscosity > 0.0),
            termination_time: model.termination_time,
            contact_limit: model.contact.control.energy_limit,
            overlap: body.overlap,
            overlap_spots: [farthest_moved(mesh, body), left_deepest(mesh, body), stuck_deepest(mesh, body)],
            unheld: [&body.overlap.pierced, &body.overlap.engulfed].map(|unheld| Told::of(unheld, mesh)),
            tied_held: tied_held(mesh, body),
            pulse: model.shortest_pulse(),
            jump: model.largest_jump(),
        };
        Watch { facts, supplied: initial_energy, supplied_before: [initial_energy; 2], ..Watch::default() }
    }

    /// What has been found so far.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// What has been found since the last call.
    pub fn news(&mut self) -> Vec<Finding> {
        let from = std::mem::replace(&mut self.told, self.findings.len());
        self.findings[from..].to_vec()
    }

    /// Energy below which nothing is said about energies.
    pub fn energy_floor(&self) -> f64 {
        self.facts.energy_floor
    }

    /// Energy supplied so far, not below the one that is worth words.
    fn base(&self) -> f64 {
        self.supplied.max(self.facts.energy_floor)
    }

    /// Looks for the symptoms that are due; of a run that ends, for all that may be its reason.
    fn look(&mut self, solver: &Solver, totals: Totals, due: When, ends: bool, comm: &mut dyn Communicator) {
        // Lines are due at about a tenth as often as not: by the nearest boundary each of them counts for the same interval in any run.
        let interval = |time: f64| (time / (WINDOW * self.facts.termination_time)).round();
        if due != When::Energies && interval(solver.time) > interval(self.interval_end) {
            self.supplied_before = [self.supplied_before[1], self.base()];
            self.interval_end = solver.time;
        }
        let begins = self.base() > BEGINS * self.supplied_before[0] && !ends;
        let exam = Exam { solver, facts: &self.facts, totals, supplied: self.base(), begins, ends };
        for symptom in SYMPTOMS.iter().filter(|symptom| symptom.when.is_due(due, solver.step)) {
            for evidence in (symptom.measure)(&exam, comm) {
                let mut found = Finding::new(symptom, solver, evidence);
                let is_news = found.is_news_in(&mut self.findings) && evidence.share > symptom.threshold;
                let is_cause = found.is_news_in(&mut self.causes) && evidence.share > symptom.cause;
                if is_news || is_cause {
                    (symptom.place)(&exam, &mut found.evidence, comm);
                }
                self.findings.extend(is_news.then_some(found));
                self.causes.extend(is_cause.then_some(found));
            }
        }
    }

    /// Visits the state between two steps.
    pub fn visit_state(&mut self, archive: &mut dyn Archive) {
        let Watch { facts: _, supplied, supplied_before: [earlier, before], interval_end, last_of_some, .. } = self;
        archive.number("SUPPLIED", supplied);
        archive.number("SUPPLIEDEARLIER", earlier);
        archive.number("SUPPLIEDBEFORE", before);
        archive.number("SUPPLIEDTIME", interval_end);
        archive.count("LOOKED", last_of_some);
        let Watch { findings, told, causes, .. } = self;
        // Empty lists leave no trace in a file; this says that there was somebody who looked.
        let mut count = findings.len() as u64;
        archive.count("FINDINGS", &mut count);
        visit(archive, "FINDING", findings);
        visit(archive, "CAUSE", causes);
        if archive.loading() {
            *told = findings.len();
        }
    }
}

/// Visits findings, which every rank knows.
fn visit(archive: &mut dyn Archive, name: &str, findings: &mut Vec<Finding>) {
    let first = archive.comm().rank() == 0;
    let mut rows: Vec<f64> = if first { findings.iter().flat_map(Finding::row).collect() } else { Vec::new() };
    archive.list(name, ROW, &mut rows);
    if archive.loading() {
        *findings = rows.chunks_exact(ROW).filter_map(Finding::from_row).collect();
        findings.sort_by_key(|finding| finding.step);
    }
}

impl Solver {
    /// What the run has found out about itself so far; the same on all ranks.
    pub fn findings(&self) -> &[Finding] {
        self.watch.findings()
    }

    /// What it has found out since the last call.
    pub fn new_findings(&mut self) -> Vec<Finding> {
        self.watch.news()
    }

    /// Looks at everything: where a line of the log or a plot state is due. All ranks call it, and all get the same.
    ///
    /// # Errors
    /// When the run must not go on.
    pub fn look(&mut self, comm: &mut dyn Communicator) -> Result<(), Stop> {
        self.examine(When::Lines, comm)
    }

    /// Looks at what is due at every step.
    pub(in crate::solver) fn glance(&mut self, comm: &mut dyn Communicator) -> Result<(), Stop> {
        let due = energy::check_due(self.step);
        if due || (self.step.is_multiple_of(CONTACT_INTERVAL) && self.contact_is_suspect(comm)) {
            return self.examine(When::Energies, comm);
        }
        Ok(())
    }

    /// Internal energy that gases and explosives held at the start, beside the one that is summed.
    pub fn stored_energy(&self) -> f64 {
        self.watch.facts.stored_energy
    }

    /// Whether contact has made so much that all energies must be looked at.
    fn contact_is_suspect(&mut self, comm: &mut dyn Communicator) -> bool {
        // Without contact nobody says anything.
        totals::contact_gain(&mut self.domain, comm) > symptoms::contact::gain::THRESHOLD * self.watch.base()
    }

    fn examine(&mut self, due: When, comm: &mut dyn Communicator) -> Result<(), Stop> {
        self.complete_contact(comm);
        let totals = self.look_for(due, self.is_at_end(), comm);
        self.check_energies(&totals, comm).map_err(|stop| self.because(stop))
    }

    fn look_for(&mut self, due: When, ends: bool, comm: &mut dyn Communicator) -> Totals {
        let totals = self.totals(comm);
        let mut watch = std::mem::take(&mut self.watch);
        let is_some_time_ago = self.step >= watch.last_of_some + When::SOME_TIME;
        let due = if due == When::Lines && (is_some_time_ago || ends) { When::SomeLines } else { due };
        if due == When::SomeLines {
            watch.last_of_some = self.step;
        }
        let supplied = self.initial_energy + watch.facts.stored_energy + totals.external.max(0.0) + totals.press_fit;
        watch.supplied = watch.supplied.max(supplied);
        watch.look(self, totals, due, ends, comm);
        self.watch = watch;
        totals
    }

    /// Looks a last time at a run that cannot go on, and names what came first.
    pub(in crate::solver) fn post_mortem(&mut self, stop: Stop, comm: &mut dyn Communicator) -> Stop {
        self.look_for(When::Lines, true, comm);
        self.because(stop)
    }

    /// The reason to stop with the cause that came before it.
    fn because(&self, stop: Stop) -> Stop {
        let own = matches!(stop, Stop::Contact { .. }).then_some(symptoms::contact::gain::CODE);
        // What the moves of nodes did to elements stops a run at its first state.
        let is_moved = |found: &&Finding| self.step == 0 && found.code == overlap_moved::SYMPTOM.code;
        let moved = self.watch.findings.iter().find(is_moved);
        // Of those seen in one look the first in the list.
        match moved.or(self.watch.causes.first()).copied().filter(|first| Some(first.code) != own) {
            Some(first) => Stop::After { first: Box::new(first), stop: Box::new(stop) },
            None => stop,
        }
    }

    /// Ends a run whose energies mean nothing any more.
    fn check_energies(&self, totals: &Totals, comm: &mut dyn Communicator) -> Result<(), Stop> {
        let facts = &self.watch.facts;
        let share = totals.contact_gain / self.watch.base();
        if share > facts.contact_limit {
            let exam =
                Exam { solver: self, facts, totals: *totals, supplied: self.watch.base(), begins: false, ends: true };
            let mut evidence = Evidence { share, amount: totals.contact_gain, ..Evidence::default() };
            symptoms::contact::gain::place(&exam, &mut evidence, comm);
            return Err(Stop::Contact { evidence: Box::new(evidence), limit: facts.contact_limit });
        }
        energy::check(totals, self.initial_energy, self.watch.supplied, facts.energy_floor)
    }
}

/// What the first look of a run will find of overlaps in the mesh.
pub fn of_overlaps(mesh: &Mesh, body: &Body) -> Vec<Finding> {
    let moved = (overlap_moved::SYMPTOM.code, overlap_moved::evidence(&body.overlap), farthest_moved(mesh, body));
    let deep = (overlap_deep::SYMPTOM.code, overlap_deep::evidence(&body.overlap), left_deepest(mesh, body));
    let stuck = (overlap_stuck::SYMPTOM.code, overlap_stuck::evidence(&body.overlap), stuck_deepest(mesh, body));
    let found = [moved, deep, stuck].into_iter().filter(|(_, evidence, _)| evidence.count > 0);
    let finding = |(code, mut evidence, spot): (u32, Evidence, Option<Spot>)| {
        evidence.spots[0] = spot;
        Finding { code, step: 0, time: 0.0, evidence, worst: evidence.share }
    };
    found.map(finding).collect()
}

/// See [`Facts::node_id`]. Rotations have no numbers of their own.
fn node_numbers(mesh: &Mesh, share: &Share) -> Vec<i64> {
    let of_place = |&node: &u32| mesh.node_ids.get(node as usize).copied();
    if counts_from_one(&mesh.node_ids) { Vec::new() } else { share.nodes.iter().map_while(of_place).collect() }
}

/// The node that was moved farthest out of an initial overlap.
fn farthest_moved(mesh: &Mesh, body: &Body) -> Option<Spot> {
    if body.overlap.nodes == 0 {
        return None;
    }
    let displacement = |node: usize| {
        if body.tied.follows(node as u32) {
            return 0.0;
        }
        let displacement = subtract(body.positions[node], mesh.coordinates[node]);
        dot(displacement, displacement)
    };
    let farthest = (0..mesh.coordinates.len())
        .fold(0, |best, node| if displacement(node) > displacement(best) { node } else { best });
    Some(Spot { node: Some(mesh.node_ids[farthest]), element: None, at: mesh.coordinates[farthest] })
}

/// Tied nodes that are held although they follow others, and the first of them.
fn tied_held(mesh: &Mesh, body: &Body) -> (usize, Option<Spot>) {
    let (count, first) = body.tied.held;
    let spot = |node: usize| {
        Some(Spot { node: Some(*mesh.node_ids.get(node)?), element: None, at: *mesh.coordinates.get(node)? })
    };
    (count, if count > 0 { spot(first as usize) } else { None })
}

/// The node that begins deepest inside an element.
fn left_deepest(mesh: &Mesh, body: &Body) -> Option<Spot> {
    let left = body.overlap.deep;
    (left.nodes > 0).then(|| Spot {
        node: mesh.node_ids.get(left.node as usize).copied(),
        element: mesh.element_ids.get(left.element as usize).copied(),
        at: mesh.coordinates.get(left.node as usize).copied().unwrap_or_default(),
    })
}

/// The deepest of what could not be moved out, though it is not deep.
fn stuck_deepest(mesh: &Mesh, body: &Body) -> Option<Spot> {
    let left = body.overlap.stuck;
    (left.nodes > 0).then(|| Spot {
        node: mesh.node_ids.get(left.node as usize).copied(),
        element: None,
        at: mesh.coordinates.get(left.node as usize).copied().unwrap_or_default(),
    })
}
