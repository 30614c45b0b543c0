//! The certificate that contact creates no energy, however far the iterations got.
//!
//! Contact forces P (impulses) that act where the relative velocity was u⁻ before the step and is u⁺ after it do the work
//! W = ½ P·(u⁻ + u⁺), which is what central differences gain. With the velocity u* without contact, the symmetric operator
//! A that turns impulses into velocities, and a target t for u⁺,
//!
//! u⁺ = u* + A P,    s = clamp(P·(t − u*) / P·A P, 0, 1)   gives   s P·(u⁺ − t) ≤ 0,   so   W ≤ ½ s P·(u⁻ + t),
//!
//! for any P at all, whether or not it solves anything. Targets that ask for no more than −u⁻ therefore can give nothing.
//! An overlap that motion has made may be lifted out faster, and that is paid from a [`Bank`] which the losses of making it
//! have filled: sinking in against a force takes the energy that lifting gives back. What contact takes when bodies land on
//! each other never enters, nor does friction. So the sum of W over all steps is never positive.

use super::enforce::{Constraint, State};
use crate::comm::ExactSum;
use crate::solver::nodes::{dot, subtract};

/// A ray shortened by less than this is not shortened: round-off of its sums.
const ROUND_OFF: f64 = 8.0 * f64::EPSILON;

/// What earlier losses allow contact to give back, and the sums of its work. The same on every rank.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bank {
    /// Energy that may be given back, at least 0.
    pub balance: f64,
    /// Energy that the last step's forces would have given back, had all lifts been granted.
    pub asked: f64,
    /// Work of all contact forces so far.
    pub work: f64,
    /// Energy that contact has given beyond what the bank had; stays at round-off.
    pub gain: f64,
}

impl Bank {
    /// Part of the lifts that is granted at the beginning of a step: half of what the balance would pay at the last step's
    /// forces.
    pub fn part(&self) -> f64 {
        if self.balance <= 0.0 {
            0.0
        } else if self.asked > 0.5 * self.balance {
            0.5 * self.balance / self.asked
        } else {
            1.0
        }
    }
}

/// Number of [`Sums`].
pub const COUNT: usize = 7;

/// What a step's forces amount to, over all constraints of all ranks. Forces times velocities: with the step's kick Δt̄ they
/// are energies.
#[derive(Debug, Clone)]
pub struct Sums(pub [ExactSum; COUNT]);

impl Default for Sums {
    fn default() -> Sums {
        Sums(std::array::from_fn(|_| ExactSum::new()))
    }
}

impl Sums {
    /// Adds the terms of a constraint.
    pub fn add(&mut self, terms: &Terms) {
        self.0.iter_mut().zip(terms.0).for_each(|(sum, term)| sum.add(term));
    }

    /// The sums as numbers.
    pub fn terms(&self) -> Terms {
        Terms(std::array::from_fn(|i| self.0[i].value()))
    }
}

/// The terms of one constraint, or the sums of many: force times target without lift − u*, force times lift; force times
/// change of velocity and force times (u⁻ + u*), each normal and of friction; work of landing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Terms(pub [f64; COUNT]);

impl Terms {
    /// The terms of one constraint whose forces are final; `change` is the relative velocity that all forces give it.
    pub fn of(c: &Constraint, state: &State, change: [f64; 3]) -> Terms {
        let (push, drag) = (c.carried.push, c.carried.drag);
        let along = dot(change, c.normal);
        let mut terms = [0.0; COUNT];
        terms[0] = push * (state.target.least - state.free);
        terms[1] = push * state.target.lift;
        terms[2] = push * along;
        terms[4] = push * (state.before + state.free);
        if state.target.lands {
            terms[6] = 0.5 * push * (state.before + state.target.least).min(0.0);
        }
        if drag != [0.0; 3] {
            // Friction that goes with the sliding of before may at most turn it round.
            terms[0] -= dot(drag, state.slip_before).max(0.0) + dot(drag, state.slip);
            terms[3] = dot(drag, change);
            terms[5] = dot(drag, state.slip_before) + dot(drag, state.slip);
        }
        Terms(terms)
    }

    /// Adds the terms of another constraint of the same island.
    pub fn add(&mut self, other: &Terms) {
        self.0.iter_mut().zip(other.0).for_each(|(sum, term)| *sum += term);
    }

    /// How far to go along the ray of these forces with this part of the lifts, 0 to 1.
    pub fn ray(&self, part: f64) -> f64 {
        let (wanted, resisted) = (self.0[0] + part * self.0[1], self.0[2] + self.0[3]);
        if resisted.is_nan() || wanted.is_nan() {
            return 0.0;
        }
        if wanted >= resisted * (1.0 - ROUND_OFF) { 1.0 } else { (wanted / resisted).max(0.0) }
    }

    /// How far to go along the ray of these forces so that the bank can pay, and what that does to the bank. `part` of the
    /// lifts was granted when the forces were found, `kick` is the step's Δt̄.
    pub fn settle(&self, part: f64, kick: f64, bank: &mut Bank) -> f64 {
        let asked = 0.5 * kick * self.0[1];
        let part = if part * asked > bank.balance { bank.balance / asked } else { part };
        let ray = self.ray(part);
        let work = |free: f64, resisted: f64| 0.5 * kick * ray * (free + ray * resisted);
        let (normal, friction) = (work(self.0[4], self.0[2]), work(self.0[5], self.0[3]));
        let landing = kick * ray * self.0[6];
        bank.work += normal + friction;
        bank.gain += (normal + friction - bank.balance).max(0.0);
        bank.balance = (bank.balance - (normal + friction.max(0.0) - landing)).max(0.0);
        bank.asked = ray * asked;
        ray
    }
}

/// What velocity along its normal a constraint is to have after the step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Target {
    /// Without any lift.
    pub least: f64,
    /// What may be added where the bank pays.
    pub lift: f64,
    /// Whether there was no overlap at the beginning of the step.
    pub lands: bool,
}

impl Target {
    /// The target of a constraint with a gap at the end of a step of length `drift` if it goes with velocity `free`, where
    /// it has had the velocity `before`.
    pub fn of(gap: f64, sunk: f64, [before, free]: [f64; 2], drift: f64) -> Target {
        let now = gap - drift * free;
        let wanted = if now >= 0.0 || sunk >= -now {
            // What closes the gap exactly.
            free - gap / drift
        } else {
            sunk / drift
        };
        let lift = before + wanted;
        let least = if lift > 0.0 { -before } else { wanted };
        Target { least, lift: lift.max(0.0), lands: now >= 0.0 }
    }
}

/// Overlap that motion has made, after a step to `gap` in which the contact went with velocity `after`.
pub fn sunk(before: f64, gap: f64, after: f64, drift: f64) -> f64 {
    (before - drift * after).min(-gap).max(0.0)
}

/// Part of a velocity in the plane of a normal.
pub fn tangential(v: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    let along = dot(v, normal);
    subtract(v, [along * normal[0], along * normal[1], along * normal[2]])
}
