//! The two sweeps of an iteration over all constraints: forces go to the nodes, and what the nodes do comes back.
//!
//! They take most of the time of enforcement, so that they are written in whole vectors: three components of a velocity and the
//! load of a node are one.

use super::accounts::certificate::tangential;
use super::carried::Carried;
use super::constraint::{Constraint, ConstraintState, MEMBERS, Response};
use super::iterations::Times;
use crate::common::vector::{add, dot, scaled, subtract};
use crate::lanes::{InstructionSet, Vectors, array};

/// How an iteration goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pace {
    /// Part by which forces go further in the direction of their last correction.
    pub(super) ahead: f64,
    /// Whether friction goes only half of its way.
    pub(super) cautious: bool,
}

/// How far a sweep moved its constraints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Moved {
    /// Farthest, as a part of the face's size.
    pub(super) residual: f64,
    /// Farthest, a length.
    pub(super) length: f64,
}

/// Adds the forces of the active constraints, and what they weigh, to the sums at their members, in the order of the constraints.
pub(super) fn scatter(
    instructions: InstructionSet,
    constraints: &[Constraint],
    states: &[ConstraintState],
    sums: &mut [Response],
) {
    match instructions.vectors() {
        // SAFETY: an instruction set is one that this processor has, and AVX-512 includes AVX2.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 | Vectors::Avx512 => unsafe { scatter_avx2(constraints, states, sums) },
        _ => scatter_each(constraints, states, sums),
    }
}

/// The same with four numbers to a register. `unsafe` for an eighth of the instructions of a run's enforcement.
///
/// # Safety
///
/// The processor must have AVX2.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
unsafe fn scatter_avx2(constraints: &[Constraint], states: &[ConstraintState], sums: &mut [Response]) {
    scatter_each(constraints, states, sums)
}

// Inlined, so that it is compiled for the instructions of its caller.
#[inline(always)]
fn scatter_each(constraints: &[Constraint], states: &[ConstraintState], sums: &mut [Response]) {
    for (c, state) in constraints.iter().zip(states).filter(|(_, state)| state.active) {
        let [x, y, z] = c.force();
        let force = [x, y, z, state.strength];
        match c.count {
            MEMBERS => scatter_one::<MEMBERS>(c, force, sums),
            count => (0..count).for_each(|i| scatter_to(c, i, force, sums)),
        }
    }
}

#[inline(always)]
fn scatter_one<const COUNT: usize>(c: &Constraint, force: [f64; 4], sums: &mut [Response]) {
    for i in 0..COUNT {
        scatter_to(c, i, force, sums);
    }
}

#[inline(always)]
fn scatter_to(c: &Constraint, member: usize, force: [f64; 4], sums: &mut [Response]) {
    let w = c.weights[member];
    let (sum, w) = (&mut sums[c.members[member] as usize], [w, w, w, w.abs()]);
    let [x, y, z, load] = {
        let before = sum.to_array();
        array!(i in 4 => before[i] + force[i] * w[i])
    };
    *sum = Response { velocity_change: [x, y, z], load };
}

/// Corrects every constraint that something can move by the responses of its members to all forces, at a pace.
pub(super) fn correct(
    instructions: InstructionSet,
    constraints: &mut [Constraint],
    states: &mut [ConstraintState],
    responses: &[Response],
    (times, pace): (Times, Pace),
) -> Moved {
    match instructions.vectors() {
        // SAFETY: an instruction set is one that this processor has, and AVX-512 includes AVX2.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 | Vectors::Avx512 => unsafe { correct_avx2(constraints, states, responses, (times, pace)) },
        _ => correct_each(constraints, states, responses, (times, pace)),
    }
}

/// The same with four numbers to a register, `unsafe` as [`scatter_avx2`] is.
///
/// # Safety
///
/// The processor must have AVX2.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
unsafe fn correct_avx2(
    constraints: &mut [Constraint],
    states: &mut [ConstraintState],
    responses: &[Response],
    how: (Times, Pace),
) -> Moved {
    correct_each(constraints, states, responses, how)
}

// Inlined, so that it is compiled for the instructions of its caller.
#[inline(always)]
fn correct_each(
    constraints: &mut [Constraint],
    states: &mut [ConstraintState],
    responses: &[Response],
    (times, pace): (Times, Pace),
) -> Moved {
    let mut farthest = Moved::default();
    for (c, state) in constraints.iter_mut().zip(states).filter(|(_, state)| state.strength > 0.0) {
        let moved = match c.count {
            MEMBERS => correct_one::<MEMBERS>(c, state, responses, times, pace),
            4 => correct_one::<4>(c, state, responses, times, pace),
            _ => correct_one::<1>(c, state, responses, times, pace),
        };
        farthest.residual = farthest.residual.max(moved / c.size);
        farthest.length = farthest.length.max(moved);
    }
    farthest
}

/// Closes the gap of one constraint as if it were alone with its shares of the masses, and goes on in this direction. How far it
/// moves, a length.
#[inline(always)]
fn correct_one<const COUNT: usize>(
    c: &mut Constraint,
    state: &mut ConstraintState,
    responses: &[Response],
    times: Times,
    Pace { ahead, cautious }: Pace,
) -> f64 {
    let of = |i: usize| responses[c.members[i] as usize].to_array();
    let mut change = [0.0; 4];
    let mut loads = [0.0; COUNT];
    for i in 0..COUNT {
        let (response, w) = (of(i), c.weights[i]);
        change = array!(j in 4 => change[j] + response[j] * w);
        loads[i] = response[3];
    }
    let change = [change[0], change[1], change[2]];
    let gap = state.closing + times.drift * dot(change, c.normal);
    let Carried { normal_force: tried, tangential_force: tried_tangential, .. } = c.carried;
    if tried == 0.0 && gap >= 0.0 {
        (c.carried.tangential_force, state.last, state.active) = ([0.0; 3], (0.0, [0.0; 3]), false);
        return 0.0;
    }
    let (mut inverse, mut sliding) = (0.0, 0.0);
    for i in 0..COUNT {
        // A constraint that has just become active is not yet in the load.
        let own = if state.active { 0.0 } else { c.weights[i].abs() };
        let share = loads[i] / state.strength + own;
        inverse += share * state.softness[i][0];
        sliding += share * state.softness[i][1];
    }
    let normal_force = (tried - gap / (times.both * inverse)).max(0.0);
    let mut moved = (normal_force - tried).abs() * times.both * inverse;
    let normal_ahead = further(tried, normal_force, state.last.0, ahead).max(0.0);
    if c.friction.is_some() {
        let slip = add(state.slip, tangential(change, c.normal));
        let wanted = subtract(tried_tangential, scaled(slip, 1.0 / (times.kick * sliding)));
        let (size, most) = (dot(wanted, wanted).sqrt(), c.friction.coefficient(slip) * normal_force);
        state.slid |= size > most && normal_force > 0.0;
        let mut tangential_force = if size > most { scaled(wanted, most / size) } else { wanted };
        if cautious {
            let half = scaled(add(tangential_force, tried_tangential), 0.5);
            tangential_force = scaled(half, (most / dot(half, half).sqrt()).min(1.0));
        }
        let turn = subtract(tangential_force, tried_tangential);
        moved = moved.max(dot(turn, turn).sqrt() * times.both * sliding);
        c.carried.tangential_force =
            [0, 1, 2].map(|i| further(tried_tangential[i], tangential_force[i], state.last.1[i], ahead));
        state.last.1 = tangential_force;
    }
    (c.carried.normal_force, state.last.0, state.active) = (normal_ahead, normal_force, true);
    state.touched = true;
    moved
}

/// From `new` further by a part `ahead` of the change from the last iteration to this one, unless the correction goes back.
#[inline(always)]
fn further(tried: f64, new: f64, last: f64, ahead: f64) -> f64 {
    let turns_back = (tried - new) * (new - last) > 0.0;
    if turns_back { new } else { new + ahead * (new - last) }
}
