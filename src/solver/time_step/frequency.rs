//! TIME STEP ESTIMATE, GLOBAL: the stable step of the mesh as a whole.
//!
//! The bound of an element is that of an element alone. In a mesh neighbours share their nodes and cannot all swing as each would
//! like to, and the largest ω of M⁻¹K is smaller. Lanczos iterations find it from below: θ ≤ λ = ω². From a start that is uniform on
//! the sphere of M^½ v the chance that θ < (1 − ε) λ after k of them is at most
//!
//! ```text
//! 1.648 √n exp(−√ε (2k − 1))            (Kuczyński and Woźniakowski 1992, for n unknowns, whatever the spectrum)
//! ```
//!
//! so that k follows from the chance that is granted, and 2/ω ≥ Δt = 2 √((1 − ε)/θ) but for that chance. It is no proof:
//! none is to be had for less than a factorisation. It is kept small enough for a run to be estimated a million times,
//! every estimate begins with numbers of its own, and the step never falls below the elements' own bound, which is proved.
//!
//! Between estimates this limit is multiplied by the least ratio so far of the elements' own steps now and then, where that is below one,
//! and by that of their heights ([`Heights`]): squeezing and shocks are answered at once. The step itself stays as it is while it is below
//! the limit. One that followed every vibration would be short whenever elements are pressed and long whenever they are pulled, in phase
//! with their stiffness; near the limit that feeds the highest frequencies as a swing is fed, and a cube whose corners ring gained three
//! quarters of its energy. So it falls with something to spare, and becomes longer at estimates only, where that is worth it.

use super::heights::Heights;
use crate::comm::{Communicator, ExactSum};
use crate::lanes::{CHUNK, Force, Row};
use crate::restart::Archive;
use crate::solver::domain::{ABSENT, Domain};
use crate::solver::elements::{PassOutcome, PassSettings, Probe, Sink};
use crate::solver::lanczos::{iterations, largest_eigenvalue, normal};

/// ε: share of λ that the iterations may miss; the step gives away half of it.
const MISSED: f64 = 0.06;

/// Chance of an estimate that misses more.
const CHANCE: f64 = 1e-8;

/// Steps between estimates, and at most where they gain nothing.
const INTERVAL: u64 = 250;
const LONGEST_INTERVAL: u64 = 4000;

/// Steps between estimates at least, whatever happens.
const SHORTEST_INTERVAL: u64 = 25;

/// An estimate that is better than the elements' by less is not worth its price.
const WORTH: f64 = 1.03;

/// Ratio of elements' steps below which the estimate is made again.
const CHANGED: f64 = 0.9;

/// Part of the limit that is taken, so that what rings by less changes the step at no time. From the whole limit one fall at the start
/// already made 3 per cent of a ringing cube's energy.
const SPARE: f64 = 0.98;

/// A step becomes longer only by this factor at least.
const LONGER: f64 = 1.02;

/// The stable step of the mesh, and when it was found.
pub struct GlobalStep {
    /// Which blocks take part; of the others the elements' own steps hold.
    takes_part: Vec<bool>,
    /// Stable step of these blocks when it was found last; 0 while it is not known.
    found: f64,
    /// Least ratio of the elements' steps and heights since then; at most 1.
    shrunk: f64,
    /// The step that is taken, below their product.
    taken: f64,
    /// Step at which it was found.
    at: u64,
    /// Steps until it is found again.
    interval: u64,
    /// Whether elements have gone since.
    stale: bool,
    /// The elements' own steps then, in each block by group.
    then: Vec<[Vec<Row>; 2]>,
    /// How their heights have changed since.
    heights: Heights,
    /// Estimates so far.
    pub estimates: u64,
}

/// What the elements say of the step.
#[derive(Debug, Clone, Copy)]
pub struct Votes {
    /// Least own step of elements that take no part.
    pub rest: f64,
    /// Least ratio of own steps now and when the estimate was made.
    pub ratio: f64,
    /// The same of heights, infinite at steps that do not look.
    pub height: f64,
    /// Least step in which elements change their shape by no more than they may, whatever the mesh's frequencies are.
    pub motion: f64,
}

impl GlobalStep {
    /// For the blocks of a rank; their elements' steps are kept from now on.
    pub fn new(domain: &mut Domain) -> GlobalStep {
        domain.blocks.iter_mut().for_each(|block| block.keeps_steps = true);
        GlobalStep {
            takes_part: domain.blocks.iter().map(|block| !block.rigid && block.element.vibrates(&block.law)).collect(),
            found: 0.0,
            shrunk: 1.0,
            taken: 0.0,
            at: 0,
            interval: 0,
            stale: true,
            then: domain
                .blocks
                .iter()
                .map(|block| [&block.border, &block.interior].map(|g| none(g.mass.len())))
                .collect(),
            heights: Heights::none(domain),
            estimates: 0,
        }
    }

    /// Learns that elements have gone: others have lost mass that they leant on.
    pub fn forget(&mut self) {
        self.stale = true;
    }

    /// What this rank's elements say.
    pub fn votes(&self, step: u64, domain: &Domain, found: &PassOutcome) -> Votes {
        let height = self.heights.vote(step - self.at, domain, &self.takes_part);
        let mut votes = Votes { rest: f64::INFINITY, ratio: 1.0, height, motion: found.motion_step };
        let blocks = domain.blocks.iter().zip(&self.takes_part).zip(&self.then);
        for ((block, takes_part), then) in blocks.filter(|((block, _), _)| !block.rigid) {
            for (group, then) in block.groups().into_iter().zip(then) {
                for i in (0..group.len()).filter(|&i| group.is_alive(i)) {
                    let now = group.steps[i / CHUNK].0[i % CHUNK];
                    if *takes_part {
                        votes.ratio = votes.ratio.min(now / then[i / CHUNK].0[i % CHUNK]);
                    } else {
                        votes.rest = votes.rest.min(now);
                    }
                }
            }
        }
        votes
    }

    /// Whether an estimate is due, by what all ranks have agreed on.
    pub fn is_due(&mut self, step: u64, votes: Votes) -> bool {
        let since = step - self.at;
        self.heights.learn(votes.height);
        self.shrunk = self.shrunk.min(votes.ratio).min(self.heights.ratio());
        let wanted = self.stale || since >= self.interval || self.shrunk < CHANGED;
        self.estimates == 0 || (wanted && since >= SHORTEST_INTERVAL.min(self.interval))
    }

    /// The stable step, by what all ranks have agreed on and the elements' own bound.
    pub fn step(&mut self, own: f64, votes: Votes) -> f64 {
        if self.stale {
            return own;
        }
        let limit = self.found * self.shrunk;
        if self.taken > limit {
            self.taken = SPARE * limit;
        }
        own.max(self.taken.min(votes.rest)).min(votes.motion)
    }

    /// Finds the stable step anew. All ranks call it, when the elements have had their pass.
    pub fn estimate(
        &mut self,
        domain: &mut Domain,
        step: u64,
        own: f64,
        settings: &PassSettings,
        comm: &mut dyn Communicator,
    ) {
        let mut operator = Operator::new(domain, &self.takes_part, settings, comm);
        self.found = operator.stable_step(step, comm);
        if SPARE * self.found > LONGER * self.taken {
            self.taken = SPARE * self.found;
        }
        (self.shrunk, self.at, self.stale) = (1.0, step, false);
        self.estimates += 1;
        self.heights.begin(domain, &self.takes_part);
        let gains = self.found > WORTH * own;
        self.interval = if gains { INTERVAL } else { (2 * self.interval).clamp(INTERVAL, LONGEST_INTERVAL) };
        for (block, then) in domain.blocks.iter().zip(&mut self.then) {
            for (group, then) in block.groups().into_iter().zip(then) {
                then.clone_from(&group.steps);
                then.resize(group.mass.len(), Row([f64::INFINITY; CHUNK]));
            }
        }
    }

    /// Visits what the next steps need.
    pub(in crate::solver) fn visit_state(&mut self, archive: &mut dyn Archive, domain: &Domain) {
        let GlobalStep { takes_part: _, found, shrunk, taken, at, interval, stale, then, heights, estimates } = self;
        heights.visit_state(archive, domain);
        archive.number("GLOBALSTEP", found);
        archive.number("GLOBALSHRUNK", shrunk);
        archive.number("GLOBALTAKEN", taken);
        archive.count("GLOBALAT", at);
        archive.count("GLOBALEVERY", interval);
        archive.count("GLOBALCOUNT", estimates);
        let mut gone = u64::from(*stale);
        archive.count("GLOBALSTALE", &mut gone);
        *stale = gone > 0;
        let groups = then.iter_mut().flatten().map(|rows| rows.iter_mut().flat_map(|row| &mut row.0));
        visit_by_element("GLOBALTHEN", groups, domain, archive);
    }
}

/// Visits a number of each element, given by group in the order of the blocks. What a group has beyond its elements fills its last
/// chunk.
pub(super) fn visit_by_element<'a>(
    name: &str,
    groups: impl Iterator<Item = impl Iterator<Item = &'a mut f64>>,
    domain: &Domain,
    archive: &mut dyn Archive,
) {
    let of_mesh = domain.blocks.iter().flat_map(|block| block.groups());
    let mut numbers: Vec<(u32, &mut f64)> =
        of_mesh.zip(groups).flat_map(|(group, own)| group.places.iter().copied().zip(own)).collect();
    let mut values = vec![0.0; domain.element_file.len()];
    numbers.iter().for_each(|(place, number)| values[*place as usize] = **number);
    archive.element(name, &mut values);
    if archive.loading() {
        numbers.iter_mut().for_each(|(place, number)| **number = values[*place as usize]);
    }
}

fn none(chunks: usize) -> Vec<Row> {
    vec![Row([f64::INFINITY; CHUNK]); chunks]
}

/// M^-½ K M^-½ of the blocks that take part, on what is free to move.
struct Operator<'a> {
    domain: &'a mut Domain,
    takes_part: &'a [bool],
    settings: PassSettings,
    /// 1/√m by unknown, 0 where nothing moves.
    scale: Vec<[f64; 3]>,
    /// Nodes as passes see them, with displacements for velocities.
    rows: Vec<Row>,
    forces: Vec<Force>,
}

impl<'a> Operator<'a> {
    fn new(
        domain: &'a mut Domain,
        takes_part: &'a [bool],
        settings: &PassSettings,
        comm: &mut dyn Communicator,
    ) -> Operator<'a> {
        let mut scale = vec![[1.0; 3]; domain.nodes.len()];
        for constraint in &domain.constraints {
            scale[constraint.node as usize][constraint.axis] = 0.0;
        }
        let of_mesh = domain.nodes.file.iter().map(|&file| file != ABSENT);
        scale.iter_mut().zip(of_mesh).filter(|(_, of_mesh)| !of_mesh).for_each(|(scale, _)| *scale = [0.0; 3]);
        let rows = domain.nodes.rows.clone();
        let forces = vec![Force::default(); rows.len()];
        let mut operator = Operator { domain, takes_part, settings: *settings, scale, rows, forces };
        operator.pass(Probe::Mass, comm);
        for (scale, force) in operator.scale.iter_mut().zip(&operator.forces) {
            let mass = force.0[0];
            let root = if mass > 0.0 { 1.0 / mass.sqrt() } else { 0.0 };
            *scale = scale.map(|free| free * root);
        }
        operator
    }

    /// Lets all elements give their forces on displacements `rows`, and sums them over ranks.
    fn pass(&mut self, probe: Probe, comm: &mut dyn Communicator) {
        self.forces.fill(Force::default());
        let Domain { blocks, exchange, .. } = &mut *self.domain;
        exchange.slots.fill(Force::default());
        let mut slots = &mut exchange.slots[..];
        for (block, takes_part) in blocks.iter_mut().zip(self.takes_part) {
            let (own, rest) = slots.split_at_mut(block.border.force_count());
            if *takes_part {
                block.probe(probe, &self.rows, Sink::Apart(own), &self.settings);
                // What stands in for an element that is gone has no part in its nodes, of which other ranks would sum it up.
                let group = &block.border;
                for i in (0..group.len()).filter(|&i| !group.is_alive(i)) {
                    own[i * group.unknowns..(i + 1) * group.unknowns].fill(Force::default());
                }
            }
            slots = rest;
        }
        exchange.start(comm);
        let mut slots = &exchange.slots[..];
        for (block, takes_part) in blocks.iter_mut().zip(self.takes_part) {
            let (border, rest) = slots.split_at(block.border.force_count());
            if *takes_part {
                let sink = Sink::Nodes { forces: &mut self.forces, border };
                block.probe(probe, &self.rows, sink, &self.settings);
            }
            slots = rest;
        }
        exchange.finish(comm, &mut self.forces);
    }

    /// Replaces a vector by the operator's image of it.
    fn apply(&mut self, v: &[[f64; 3]], image: &mut [[f64; 3]], comm: &mut dyn Communicator) {
        for ((row, v), scale) in self.rows.iter_mut().zip(v).zip(&self.scale) {
            for i in 0..3 {
                row.0[4 + i] = v[i] * scale[i];
            }
        }
        self.pass(Probe::Stiffness, comm);
        for ((image, force), scale) in image.iter_mut().zip(&self.forces).zip(&self.scale) {
            for i in 0..3 {
                // Passes subtract.
                image[i] = -force.0[i] * scale[i];
            }
        }
    }

    /// a · b over all ranks, each node once.
    fn product(&self, a: &[[f64; 3]], b: &[[f64; 3]], comm: &mut dyn Communicator) -> f64 {
        let mut sum = [ExactSum::new()];
        for ((a, b), _) in a.iter().zip(b).zip(&self.domain.nodes.owned).filter(|(_, owned)| **owned) {
            (0..3).for_each(|i| sum[0].add(a[i] * b[i]));
        }
        ExactSum::merge_ranks(&mut sum, comm);
        sum[0].value()
    }

    /// Normal numbers that depend on unknown and step alone, 0 where nothing moves.
    fn start(&self, step: u64) -> Vec<[f64; 3]> {
        let normal = |file: u32, axis: usize| {
            normal(step.wrapping_mul(0xd134_2543_de82_ef95) ^ (3 * u64::from(file) + axis as u64))
        };
        let unknowns = self.domain.nodes.file.iter().zip(&self.scale);
        unknowns.map(|(&file, scale)| [0, 1, 2].map(|i| if scale[i] > 0.0 { normal(file, i) } else { 0.0 })).collect()
    }

    /// 2 √((1 − ε)/θ) after as many Lanczos iterations as the number of unknowns asks for; infinite where nothing moves.
    fn stable_step(&mut self, step: u64, comm: &mut dyn Communicator) -> f64 {
        let mut v = self.start(step);
        let mut free = [self.domain.nodes.owned.iter().zip(&self.scale).fold(0u64, |count, (owned, scale)| {
            count + if *owned { scale.iter().filter(|scale| **scale > 0.0).count() as u64 } else { 0 }
        })];
        comm.all_sum(&mut free);
        let length = self.product(&v, &v, comm).sqrt();
        if length == 0.0 {
            return f64::INFINITY;
        }
        v.iter_mut().flatten().for_each(|v| *v /= length);
        let mut before = vec![[0.0; 3]; v.len()];
        let mut image = vec![[0.0; 3]; v.len()];
        let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
        for _ in 0..iterations(free[0], MISSED, CHANCE) {
            self.apply(&v, &mut image, comm);
            let along = self.product(&v, &image, comm);
            let last = beside.last().copied().unwrap_or(0.0);
            for ((image, v), before) in image.iter_mut().zip(&v).zip(&before) {
                for i in 0..3 {
                    image[i] -= along * v[i] + last * before[i];
                }
            }
            diagonal.push(along);
            let rest = self.product(&image, &image, comm).sqrt();
            // What is left is round-off: the whole space has been seen.
            if rest.partial_cmp(&(1e-10 * along.abs())) != Some(std::cmp::Ordering::Greater) {
                break;
            }
            beside.push(rest);
            std::mem::swap(&mut before, &mut v);
            for (v, image) in v.iter_mut().zip(&image) {
                *v = image.map(|image| image / rest);
            }
        }
        let largest = largest_eigenvalue(&diagonal, &beside);
        if largest > 0.0 { 2.0 * ((1.0 - MISSED) / largest).sqrt() } else { f64::INFINITY }
    }
}
