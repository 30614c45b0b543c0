//! The iterations: each closes every gap as if its constraint were alone, with shares of the masses, and goes on a little.

use super::constraint::{Constraint, Origin};
use super::enforcer::Enforcer;
use super::node_pairs;
use super::other_ranks::{InitialMaxima, OtherRanks};
use super::sweep::{self, Moved, Pace};
use crate::solver::contact::geometry::motion::NodeMotion;

/// Iterations go on until they move nothing by more than so many times the tolerance, as a part of the farthest motion of a
/// contact in the step: by default a five-hundredth. What sinks in while loads are small can be lifted only at the price of the
/// loads that come.
const SETTLED: f64 = 200.0;

/// Iterations whose last one still moves this part of that motion have run out, whatever they leave: contacts creep.
const UNSETTLED: f64 = 0.1;

/// Iterations that may go on do so while they still move this part of it. Sheets that lie on each other between plates drift apart ever
/// faster at a tenth, and not at this.
const NEARLY_SETTLED: f64 = 0.02;

/// After so many steps in a row in which they have not settled iterations may go on.
const MANY_IN_A_ROW: u64 = 32;

/// Where fewer iterations may be made nothing yields, nor gives way.
const FEW: u32 = 8;

/// What yields takes no force in the first of so many parts of the iterations: what has not settled by then will hardly do so for its sake.
const QUIET: u32 = 4;

/// So many iterations, the default, are made where fewer have left something this many times deeper than the farthest motion of a contact in
/// a step so far: one alone lets solids whose corners have turned inside out sink by many motions.
const ENOUGH: u32 = 20;
/// See [`ENOUGH`].
const TOO_DEEP: f64 = 1.0;

/// Penetrations up to this part of the face's size are not measured in motions: where next to nothing moves, any is many of them.
const NOTICED: f64 = 1e-4;

/// How far the iterations go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest number of iterations that settle.
    pub iterations: u32,
    /// Largest number of those that still leave an overlap or move contacts by a part of the step's motion, see [`Limits::after`]; not less.
    pub unsettled: u32,
    /// Overlap that is left alone, as a part of the face's size; what iterations may still move follows it.
    pub tolerance: f64,
    /// Whether what has a thickness may give way where they run out, see `giving_way`: not what is pressed for many steps.
    pub may_give_way: bool,
    /// Farthest motion of a contact along its normal in a step so far, a length; infinite where ranks do not hear how deep others are.
    pub farthest: f64,
}

impl Limits {
    /// Whether an iteration that has moved constraints so far, as a part of the face's size and as a length, was the last: with a
    /// tolerance so many times looser. `travel` is the farthest motion of a contact in the step.
    fn are_met(&self, looser: f64, [residual, moved, travel]: [f64; 3]) -> bool {
        let tolerance = looser * self.tolerance;
        residual <= tolerance && moved <= part_of_travel(tolerance) * travel
    }

    /// How far iterations that have settled may still move a constraint of this size, a length; see [`Limits::are_met`].
    pub(super) fn left(&self, size: f64, travel: f64) -> f64 {
        (self.tolerance * size).min(part_of_travel(self.tolerance) * travel)
    }

    /// Whether so many iterations may be made that contacts may yield to others.
    pub(super) fn let_some_yield(&self) -> bool {
        self.iterations >= FEW
    }

    /// Whether so many iterations are enough, though the last of them has moved constraints so far, see [`Limits::are_met`].
    fn are_reached(&self, iterations: u32, [residual, moved, travel]: [f64; 3]) -> bool {
        let has_nearly_settled = residual <= self.tolerance && moved <= NEARLY_SETTLED * travel;
        iterations >= self.unsettled || (iterations >= self.iterations && has_nearly_settled)
    }

    /// The limits of a step after so many in a row in which iterations have not settled within the usual number, when no contact has moved
    /// farther in a step than this length. What only now and then does not settle is left at that: in folds that close more iterations push
    /// tangled corners farther.
    pub fn after(self, unsettled_steps: u64, farthest: f64) -> Limits {
        let goes_on = unsettled_steps >= MANY_IN_A_ROW;
        Limits {
            unsettled: if goes_on { self.unsettled } else { self.iterations },
            may_give_way: self.may_give_way && !goes_on,
            farthest: self.farthest.max(farthest),
            ..self
        }
    }

    /// The limits of a step that begins with something as deep as a length, see [`ENOUGH`].
    fn where_as_deep(self, depth: f64) -> Limits {
        if depth <= TOO_DEEP * self.farthest {
            return self;
        }
        Limits { iterations: self.iterations.max(ENOUGH), unsettled: self.unsettled.max(ENOUGH), ..self }
    }

    /// Whether a step has settled within the usual number of iterations.
    pub fn are_kept_by(&self, outcome: &Outcome) -> bool {
        !outcome.ran_out && outcome.iterations <= self.iterations
    }
}

/// How far iterations that have settled to a tolerance may still move a constraint, as a part of the farthest motion of a contact in the step.
fn part_of_travel(tolerance: f64) -> f64 {
    (SETTLED * tolerance).min(UNSETTLED)
}

/// What became of a step's constraints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Iterations made.
    pub iterations: u32,
    /// Whether they ran out: the last of them left more than the tolerance, or moved a contact by a good part of the step's motion.
    pub ran_out: bool,
    /// Whether they ran out by far where something has a thickness; see `giving_way`.
    pub lacks_room: bool,
    /// How much the last iteration still moved, as a part of the face's size: about the largest overlap left.
    pub residual: f64,
    /// Deepest overlap that motion had made before the step, as a part of the face's size.
    pub deepest: f64,
    /// The deepest one as a length, of those that are more than a ten-thousandth of the face's size; else 0.
    pub depth: f64,
    /// Farthest that a contact would move along its normal in the step without contact forces, a length; not of nodes above planes.
    pub travel: f64,
    /// Deepest penetration between members that nothing can move, as a part of the face's size.
    pub held: f64,
    /// What looser tolerances would have spared.
    pub looser: [Spared; LOOSER.len()],
}

/// Looser tolerances that are held beside the deck's: so many times as large.
pub const LOOSER: [f64; 2] = [10.0, 100.0];

/// Iterations of a step that a looser tolerance would not have made.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spared {
    /// Their number.
    pub iterations: u32,
    /// How far they moved a constraint, the farthest of each added up, as a part of the face's size.
    pub moved: f64,
}

/// Times that turn velocities into displacements and forces into velocities.
#[derive(Clone, Copy)]
pub(super) struct Times {
    /// The step, by which velocities change positions; a time.
    pub(super) drift: f64,
    /// The mean of this step and the last, by which forces change velocities; a time.
    pub(super) kick: f64,
    /// Their product, time².
    pub(super) both: f64,
}

impl Enforcer {
    /// Iterates with the forces of [`Enforcer::iterates`]; `None` where nobody has a gap to close.
    pub(super) fn iterate(
        &mut self,
        constraints: &[Constraint],
        motion: &NodeMotion,
        times: Times,
        limits: Limits,
        wanted: bool,
        others: &mut dyn OtherRanks,
    ) -> Option<Outcome> {
        let mut all = self.initial_maxima(constraints, times.drift, wanted).to_array();
        self.scatter(motion, times, &mut all, others);
        let InitialMaxima { wanted, yields, thick, deepest, depth, travel, held } = InitialMaxima::from_array(all);
        self.held_anywhere = held;
        if wanted == 0.0 {
            return None;
        }
        for own in self.iterates.normal.iter_mut().filter(|own| own.yields) {
            own.closing += node_pairs::left_by_yielding(own.size, limits.tolerance, travel);
        }
        let limits = limits.where_as_deep(depth);
        let mut outcome = Outcome { deepest, depth, travel, ..Default::default() };
        let (mut momentum, mut ended) = (Momentum::new(), [false; LOOSER.len()]);
        // With few passes there is no time for it.
        let mut some_yield = limits.let_some_yield();
        loop {
            let pace = momentum.next(some_yield);
            let Enforcer { instructions, iterates, responses, .. } = &mut *self;
            let Moved { residual, length } = sweep::correct(*instructions, iterates, responses, (times, pace));
            let mut farthest = [residual, length];
            // Others tell whether this iteration was the last beside what only a further one needs: one wait instead of two.
            if others.are_there() {
                self.scatter(motion, times, &mut farthest, others);
            }
            let [residual, moved] = farthest;
            momentum.watch(moved);
            let mut looser = outcome.looser;
            let by_looser = |factor: f64| limits.are_met(factor, [residual, moved, travel]);
            for (spared, _) in looser.iter_mut().zip(ended).filter(|(_, ended)| *ended) {
                *spared = Spared { iterations: spared.iterations + 1, moved: spared.moved + residual };
            }
            // What has yielded must have its turn, whatever the tolerance.
            let may_end = !(some_yield && yields > 0.0);
            ended.iter_mut().zip(LOOSER).for_each(|(ended, factor)| *ended |= may_end && by_looser(factor));
            let (iterations, is_unsettled) = (outcome.iterations + 1, moved > UNSETTLED * travel);
            let ran_out = residual > limits.tolerance || is_unsettled;
            let lacks_room = is_unsettled && thick > 0.0 && limits.iterations >= FEW && limits.may_give_way;
            outcome = Outcome { residual, iterations, ran_out, lacks_room, looser, ..outcome };
            let is_settled = by_looser(1.0);
            if (is_settled && may_end) || limits.are_reached(iterations, [residual, moved, travel]) {
                return Some(outcome);
            }
            // Where the rest has settled, or does not, what has yielded sees to it that nothing is open to it.
            some_yield &= !is_settled && QUIET * (iterations + 1) < limits.iterations;
            if !others.are_there() {
                self.scatter(motion, times, &mut [], others);
            }
        }
    }

    /// The values of this rank, see [`InitialMaxima`].
    fn initial_maxima(&self, constraints: &[Constraint], drift: f64, wanted: bool) -> InitialMaxima {
        let flag = |holds: bool| f64::from(u8::from(holds));
        let of_all = InitialMaxima {
            wanted: flag(wanted),
            yields: flag(constraints.iter().any(|c| c.yields)),
            thick: flag(self.states.iter().any(|state| state.compliance > 0.0)),
            held: self.held.0,
            ..Default::default()
        };
        let known = self.states.iter().zip(&self.iterates.normal);
        let own = constraints.iter().zip(known).filter(|(_, (state, _))| state.own && state.strength > 0.0);
        own.fold(of_all, |all, (c, (state, iterate))| {
            let penetration = c.carried.penetration;
            // A node above a plane, or that another contact may push to a face, is no contact until it reaches it.
            let is_ahead = matches!(c.origin, Origin::Plane(_)) || c.gap > 0.0 && !c.persists;
            let is_contact = iterate.active || !is_ahead;
            let travel = if is_contact { (drift * state.free).abs() } else { 0.0 };
            let depth = if penetration > NOTICED * c.size { penetration } else { 0.0 };
            InitialMaxima {
                deepest: (penetration / c.size).max(all.deepest),
                depth: depth.max(all.depth),
                travel: travel.max(all.travel),
                ..all
            }
        })
    }
}

/// An iteration that moves a constraint this many times farther than the first one did is on its way to nowhere.
const GROWS: f64 = 2.0;

/// How the iterations of a step go on.
struct Momentum {
    /// The sequence of Beck and Teboulle (2009).
    next: f64,
    /// How far the first iteration moved a constraint, a length.
    first: Option<f64>,
    grows: bool,
}

impl Momentum {
    fn new() -> Momentum {
        Momentum { next: 1.0, first: None, grows: false }
    }

    fn next(&mut self, some_yield: bool) -> Pace {
        if self.grows {
            return Pace { ahead: 0.0, cautious: true, some_yield };
        }
        let before = self.next;
        self.next = 0.5 * (1.0 + (1.0 + 4.0 * before * before).sqrt());
        Pace { ahead: (before - 1.0) / self.next, cautious: false, some_yield }
    }

    /// Hears how far an iteration moved a constraint, the farthest of all ranks. With friction iterations need not converge: what a
    /// force along one normal changes along another comes back multiplied by the coefficient.
    fn watch(&mut self, moved: f64) {
        self.grows |= moved > GROWS * *self.first.get_or_insert(moved);
    }
}
