//! The iterations: each closes every gap as if its constraint were alone, with shares of the masses, and goes on a little.

use super::carried::Carried;
use super::certificate::tangential;
use super::constraint::{Constraint, ConstraintState, Response};
use super::enforcer::Enforcer;
use super::other_ranks::{Largest, OtherRanks};
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::vector::{add, dot, scaled, subtract};

/// Iterations go on until they move nothing by more than this part of the farthest motion of a contact in the step. What sinks
/// in while loads are small can be lifted only at the price of the loads that come.
const SETTLED: f64 = 0.002;

/// How far the iterations go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest number of iterations.
    pub iterations: u32,
    /// Overlap that is left alone, as a part of the face's size.
    pub tolerance: f64,
}

/// What became of a step's constraints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Iterations made.
    pub iterations: u32,
    /// How much the last iteration still moved, as a part of the face's size: about the largest overlap left.
    pub residual: f64,
    /// Deepest overlap that motion had made before the step, as a part of the face's size.
    pub deepest: f64,
    /// The deepest one as a length.
    pub depth: f64,
    /// Farthest that a constraint would move along its normal in the step without contact, a length.
    pub travel: f64,
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
    /// Iterates; `None` where nobody has a gap to close. Others are asked with the first: where somebody wants them, and that is
    /// nearly always, it costs nothing.
    pub(super) fn iterate(
        &mut self,
        constraints: &mut [Constraint],
        motion: &NodeMotion,
        times: Times,
        limits: Limits,
        wanted: bool,
        others: &mut dyn OtherRanks,
    ) -> Option<Outcome> {
        let (mut outcome, mut momentum) = (Outcome::default(), Momentum::new());
        let mut own = self.extent(constraints, times.drift);
        own.wanted = f64::from(u8::from(wanted));
        loop {
            self.scatter(constraints, motion, times, others);
            let ahead = momentum.next();
            (own.residual, own.moved) = (0.0, 0.0);
            for (c, state) in constraints.iter_mut().zip(&mut self.states).filter(|(_, state)| state.strength > 0.0) {
                let moved = correct(c, state, &self.responses, times, ahead);
                (own.residual, own.moved) = (f64::max(own.residual, moved / c.size), f64::max(own.moved, moved));
            }
            let Largest { residual, wanted, deepest, depth, travel, moved } = others.largest(own);
            if wanted == 0.0 {
                return None;
            }
            outcome = Outcome { residual, iterations: outcome.iterations + 1, deepest, depth, travel };
            let settled = residual <= limits.tolerance && moved <= SETTLED * travel;
            if settled || outcome.iterations == limits.iterations {
                return Some(outcome);
            }
        }
    }

    /// Deepest penetration that motion has made, and the farthest that a constraint of this rank would move.
    fn extent(&self, constraints: &[Constraint], drift: f64) -> Largest {
        let own = constraints.iter().zip(&self.states).filter(|(_, state)| state.own && state.strength > 0.0);
        own.fold(Largest::default(), |all, (c, state)| {
            let penetration = c.carried.penetration;
            Largest {
                deepest: (penetration / c.size).max(all.deepest),
                depth: penetration.max(all.depth),
                travel: (drift * state.free).abs().max(all.travel),
                ..all
            }
        })
    }
}

/// How far the next iteration goes on in the direction of the one before.
struct Momentum(f64);

impl Momentum {
    fn new() -> Momentum {
        Momentum(1.0)
    }

    fn next(&mut self) -> f64 {
        let before = self.0;
        self.0 = 0.5 * (1.0 + (1.0 + 4.0 * before * before).sqrt());
        (before - 1.0) / self.0
    }
}

/// Closes the gap of one constraint as if it were alone with its shares of the masses, and goes on in this direction by a
/// part `ahead`. How far it moves, a length.
fn correct(c: &mut Constraint, state: &mut ConstraintState, responses: &[Response], times: Times, ahead: f64) -> f64 {
    let change = c.velocity_change(responses);
    let gap = state.closing + times.drift * dot(change, c.normal);
    let Carried { normal_force: tried, tangential_force: tried_tangential, .. } = c.carried;
    if tried == 0.0 && gap >= 0.0 {
        (c.carried.tangential_force, state.last, state.active) = ([0.0; 3], (0.0, [0.0; 3]), false);
        return 0.0;
    }
    let (mut inverse, mut sliding) = (0.0, 0.0);
    for ((point, w), softness) in c.parts().zip(&state.softness) {
        // A constraint that has just become active is not yet in the load.
        let own = if state.active { 0.0 } else { w.abs() };
        let share = responses[point].load / state.strength + own;
        inverse += share * softness[0];
        sliding += share * softness[1];
    }
    let normal_force = (tried - gap / (times.both * inverse)).max(0.0);
    let mut moved = (normal_force - tried).abs() * times.both * inverse;
    let normal_ahead = further(tried, normal_force, state.last.0, ahead).max(0.0);
    if c.friction.is_some() {
        let slip = add(state.slip, tangential(change, c.normal));
        let wanted = subtract(tried_tangential, scaled(slip, 1.0 / (times.kick * sliding)));
        let (size, most) = (dot(wanted, wanted).sqrt(), c.friction.coefficient(slip) * normal_force);
        let tangential_force = if size > most { scaled(wanted, most / size) } else { wanted };
        let turn = subtract(tangential_force, tried_tangential);
        moved = moved.max(dot(turn, turn).sqrt() * times.both * sliding);
        c.carried.tangential_force =
            [0, 1, 2].map(|i| further(tried_tangential[i], tangential_force[i], state.last.1[i], ahead));
        state.last.1 = tangential_force;
    }
    (c.carried.normal_force, state.last.0, state.active) = (normal_ahead, normal_force, true);
    moved
}

/// From `new` further by a part `ahead` of the change from the last iteration to this one, unless the correction goes back.
fn further(tried: f64, new: f64, last: f64, ahead: f64) -> f64 {
    let turns_back = (tried - new) * (new - last) > 0.0;
    if turns_back { new } else { new + ahead * (new - last) }
}
