//! The certificate that contact creates no energy, however far the iterations got.
//!
//! Contact forces P (impulses) that act where the relative velocity was u⁻ before the step and is u⁺ after it do the work
//! W = ½ P·(u⁻ + u⁺), which is what central differences gain. With the velocity u* without contact, the symmetric operator
//! A that turns impulses into velocities, and a target t for u⁺,
//!
//! u⁺ = u* + A P,    s = max(0, P·(t − u*) / P·A P)   gives   s P·(u⁺ − t) ≤ 0,   so   W ≤ ½ s P·(u⁻ + t),
//!
//! for any P at all, whether or not it solves anything. Targets that ask for no more than −u⁻ therefore can give nothing.
//! An overlap that motion has made may be lifted out faster, and that is paid from a [`Bank`] which the losses of making it
//! have filled: sinking in against a force takes the energy that lifting gives back. What contact takes when bodies land on
//! each other never enters, nor does friction. So the sum of W over all steps is never positive.

use crate::comm::ExactSum;
use crate::common::vector::{dot, scaled, subtract};
use crate::solver::contact::enforcement::constraint::{Constraint, ConstraintState};

/// How far to go along the ray at most. Iterations that begin with less than the last forces end below what is needed, and
/// everything that is pressed would creep into each other; the ray makes up for it on the whole.
const FARTHEST: f64 = 2.0;

/// A ray shortened by less than this is not shortened: round-off of its sums.
const ROUND_OFF: f64 = 8.0 * f64::EPSILON;

/// Part of what a lift has cost in one step that the next one expects it to cost at least. Forces that are granted less of
/// it cost less: what is granted grows by so much a step until it meets what can be paid.
const REMEMBERED: f64 = 0.7;

/// What earlier losses allow contact to give back, and the sums of its work. The same on every rank.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bank {
    /// Energy that may be given back, at least 0.
    pub balance: f64,
    /// Energy that the last step's forces would have given back, had all been granted: by bringing to rest what rises, and by
    /// lifting, of which earlier steps are remembered.
    pub asked: [f64; 2],
    /// Work of all contact forces so far.
    pub work: f64,
    /// Energy that contact has given beyond what the bank had; stays at round-off.
    pub gain: f64,
    /// Work of surfaces that grow: energy supplied, and no part of `work`.
    pub growth: f64,
}

/// Parts, 0 to 1, that are granted of bringing to rest what rises, and of lifting.
pub type Granted = [f64; 2];

/// Part of a claim that an amount pays.
fn paid(claim: f64, amount: f64) -> f64 {
    if amount <= 0.0 { 0.0 } else { (amount / claim.max(amount)).min(1.0) }
}

impl Bank {
    /// What is granted at the beginning of a step, at the last step's forces. To rise and to be brought to rest again cost the
    /// same, one after the other: what is lifted is paid twice in advance, or it would sink back and chatter.
    pub fn granted(&self) -> Granted {
        let [rest, lift] = self.asked;
        [paid(rest, self.balance), paid(2.0 * lift, self.balance - rest)]
    }
}

/// Number of [`Sums`].
pub const COUNT: usize = 9;

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
        self.0.iter_mut().zip(terms.to_array()).for_each(|(sum, term)| sum.add(term));
    }

    /// The sums as numbers.
    pub fn terms(&self) -> Terms {
        Terms::from_array(std::array::from_fn(|i| self.0[i].value()))
    }
}

/// What the forces of one constraint, or of many, amount to: forces times velocities, all of one dimension.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Terms {
    /// Forces times what they may give for nothing: the least targets less u*.
    pub least: f64,
    /// Normal forces times what brings to rest.
    pub rest: f64,
    /// Normal forces times what lifts.
    pub lift: f64,
    /// Half of what normal forces take where members meet anew, at most 0.
    pub landing: f64,
    /// Normal forces times the change of velocity that all forces make, P·A P.
    pub normal_change: f64,
    /// Friction forces times the change of velocity that all forces make.
    pub friction_change: f64,
    /// Normal forces times u⁻ + u*.
    pub normal_free: f64,
    /// Friction forces times sliding velocities, before the step and without contact.
    pub friction_free: f64,
    /// Normal forces times the velocity with which surfaces grow.
    pub growth: f64,
}

impl Terms {
    /// The terms of one constraint whose forces are final; `change` is the relative velocity that all forces give it.
    pub fn of(c: &Constraint, state: &ConstraintState, change: [f64; 3]) -> Terms {
        let (normal_force, tangential_force) = (c.carried.normal_force, c.carried.tangential_force);
        let mut terms = Terms {
            least: normal_force * (state.target.least - state.free),
            rest: normal_force * state.target.rest,
            lift: normal_force * state.target.lift,
            normal_change: normal_force * dot(change, c.normal),
            normal_free: normal_force * (state.before + state.free),
            growth: normal_force * c.growth,
            ..Default::default()
        };
        if state.target.lands {
            terms.landing = 0.5 * normal_force * (state.before + state.target.least).min(0.0);
        }
        if tangential_force != [0.0; 3] {
            // Friction that goes with the sliding of before may at most turn it round.
            terms.least -= dot(tangential_force, state.slip_before).max(0.0) + dot(tangential_force, state.slip);
            terms.friction_change = dot(tangential_force, change);
            terms.friction_free = dot(tangential_force, state.slip_before) + dot(tangential_force, state.slip);
        }
        terms
    }

    /// As numbers, for sums over ranks.
    fn to_array(self) -> [f64; COUNT] {
        let Terms { least, rest, lift, landing, normal_change, friction_change, normal_free, friction_free, growth } =
            self;
        [least, rest, lift, landing, normal_change, friction_change, normal_free, friction_free, growth]
    }

    /// From these numbers.
    fn from_array(numbers: [f64; COUNT]) -> Terms {
        let [least, rest, lift, landing, normal_change, friction_change, normal_free, friction_free, growth] = numbers;
        Terms { least, rest, lift, landing, normal_change, friction_change, normal_free, friction_free, growth }
    }

    /// Adds the terms of another constraint of the same node.
    pub fn add(&mut self, other: &Terms) {
        let (own, other) = (self.to_array(), other.to_array());
        *self = Terms::from_array(std::array::from_fn(|i| own[i] + other[i]));
    }

    /// How far to go along the ray of these forces with these parts granted: to where they do no work against the targets, which is
    /// also where they fit best.
    pub fn ray(&self, [rest, lift]: Granted) -> f64 {
        let wanted = self.least + rest * self.rest + lift * self.lift;
        let resisted = self.normal_change + self.friction_change;
        if resisted.is_nan() || wanted.is_nan() {
            return 0.0;
        }
        if (wanted - resisted).abs() <= ROUND_OFF * resisted.abs() {
            return 1.0;
        }
        // Where bodies slide, friction wants more than it may have: that must not press harder.
        let farthest = if self.friction_change == 0.0 && self.friction_free == 0.0 { FARTHEST } else { 1.0 };
        if resisted > 0.0 { (wanted / resisted).clamp(0.0, farthest) } else { 1.0 }
    }

    /// How far to go along the ray of these forces so that the bank can pay, and what that does to the bank. These parts were
    /// `granted` when the forces were found; `kick` is the step's Δt̄.
    pub fn settle(&self, granted: Granted, kick: f64, bank: &mut Bank) -> f64 {
        let asked = [0.5 * kick * self.rest, 0.5 * kick * self.lift];
        let rest = granted[0].min(paid(asked[0], bank.balance));
        let lift = granted[1].min(paid(asked[1], bank.balance - rest * asked[0]));
        let (claim, is_cut) = (rest * asked[0] + lift * asked[1], rest < granted[0] || lift < granted[1]);
        let ray = self.ray([rest, lift]);
        // Longer forces claim more.
        let ray = if ray * claim > bank.balance { ray.min(1.0) } else { ray };
        let work = |free: f64, resisted: f64| 0.5 * kick * ray * (free + ray * resisted);
        let (normal, friction) =
            (work(self.normal_free, self.normal_change), work(self.friction_free, self.friction_change));
        let landing = kick * ray * self.landing;
        bank.work += normal + friction;
        bank.growth += kick * ray * self.growth;
        bank.gain += (normal + friction - bank.balance).max(0.0);
        bank.balance = (bank.balance - (normal + friction.max(0.0) - landing)).max(0.0);
        // Forces that were sought for a lift which cannot be paid may come to nothing. What it would have cost is known all the same:
        // a bank that was asked for nothing would grant all of it in the next step, and the forces would come to nothing again.
        let length = if is_cut { ray.max(1.0) } else { ray };
        bank.asked = [ray * asked[0], (length * asked[1]).max(REMEMBERED * bank.asked[1])];
        ray
    }
}

/// What velocity along its normal, length per time, a constraint is to have after the step, in parts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Target {
    /// What costs nothing.
    pub least: f64,
    /// What is added to bring to rest what rises, where the bank pays.
    pub rest: f64,
    /// What is added to lift, where the bank pays.
    pub lift: f64,
    /// Whether its members meet anew: what they lose is no overlap's.
    pub lands: bool,
}

impl Target {
    /// The target of a constraint that would go with velocity `free` over a step of length `drift`, and has had the velocity
    /// `before`.
    pub fn of(c: &Constraint, [before, free]: [f64; 2], drift: f64) -> Target {
        let (gap, penetration) = (c.gap, c.carried.penetration);
        let now = gap - drift * free;
        let wanted = if now >= 0.0 || penetration >= -now {
            // What closes the gap exactly.
            free - gap / drift
        } else {
            penetration / drift
        };
        let at_rest = wanted.min(0.0);
        // Below −u⁻ work is negative for any force.
        let least = at_rest.min(-before);
        Target { least, rest: at_rest - least, lift: wanted - at_rest, lands: now >= 0.0 && !c.persists }
    }

    /// The target between bodies that store no energy, which have had the velocity `before`: what they have sunk in was not pressed in
    /// against a stiffness that would push them out again. They are lifted no faster than they move anyway.
    pub fn without_store(self, before: f64) -> Target {
        Target { lift: self.lift.min((before.abs() - self.least - self.rest).max(0.0)), ..self }
    }

    /// The target with these parts granted, length per time.
    pub fn with(&self, [rest, lift]: Granted) -> f64 {
        self.least + rest * self.rest + lift * self.lift
    }
}

/// Overlap that motion has made, after a step to `gap` in which the contact went with velocity `after`.
pub fn penetration_after(before: f64, gap: f64, after: f64, drift: f64) -> f64 {
    (before - drift * after).min(-gap).max(0.0)
}

/// Part of a velocity in the plane of a normal.
pub fn tangential(v: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
    subtract(v, scaled(normal, dot(v, normal)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forces that were sought for a lift the bank cannot pay press where nothing needs them, and have no ray without it.
    #[test]
    fn a_lift_that_was_too_dear_is_not_granted_again_at_once() {
        let terms = Terms { least: -1.0, lift: 100.0, normal_change: 90.0, ..Default::default() };
        let mut bank = Bank { balance: 0.1, ..Default::default() };
        let granted = bank.granted();
        assert_eq!((granted, terms.settle(granted, 1.0, &mut bank)), ([1.0; 2], 0.0));
        let [_, mut lift] = bank.granted();
        assert!(lift < 0.01, "{lift}");
        // Nothing is asked for any more: it is granted again by and by.
        for _ in 0..30 {
            Terms::default().settle(bank.granted(), 1.0, &mut bank);
            let [_, next] = bank.granted();
            assert!(next > lift || next == 1.0, "{lift} {next}");
            lift = next;
        }
        assert_eq!(lift, 1.0);
    }
}
