//! The two sweeps of an iteration over all constraints: forces go to the nodes, and what the nodes do comes back.
//!
//! They take most of the time of enforcement, so that they are written in whole vectors: three components of a velocity and the
//! load of a node are one.

use super::accounts::certificate::tangential;
use super::constraint::{MEMBERS, Response};
use super::iterates::{FrictionIterate, Iterate, Iterates};
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
    /// Whether what yields does so.
    pub(super) some_yield: bool,
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
pub(super) fn scatter(instructions: InstructionSet, iterates: &Iterates, sums: &mut [Response]) {
    match instructions.vectors() {
        // SAFETY: an instruction set is one that this processor has, and AVX-512 includes AVX2.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 | Vectors::Avx512 => unsafe { scatter_avx2(iterates, sums) },
        _ => scatter_each(iterates, sums),
    }
}

/// The same with four numbers to a register. `unsafe` for an eighth of the instructions of a run's enforcement.
///
/// # Safety
///
/// The processor must have AVX2.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
unsafe fn scatter_avx2(iterates: &Iterates, sums: &mut [Response]) {
    scatter_each(iterates, sums)
}

// Inlined, so that it is compiled for the instructions of its caller.
#[inline(always)]
fn scatter_each(iterates: &Iterates, sums: &mut [Response]) {
    for (i, own) in iterates.normal.iter().enumerate().filter(|(_, own)| own.active) {
        let [x, y, z] = iterates.force(i);
        let force = [x, y, z, own.strength];
        match usize::from(own.count) {
            MEMBERS => scatter_one::<MEMBERS>(own, force, sums),
            count => (0..count).for_each(|i| scatter_to(own, i, force, sums)),
        }
    }
}

#[inline(always)]
fn scatter_one<const COUNT: usize>(own: &Iterate, force: [f64; 4], sums: &mut [Response]) {
    for i in 0..COUNT {
        scatter_to(own, i, force, sums);
    }
}

#[inline(always)]
fn scatter_to(own: &Iterate, member: usize, force: [f64; 4], sums: &mut [Response]) {
    let w = own.weights[member];
    let (sum, w) = (&mut sums[own.members[member] as usize], [w, w, w, w.abs()]);
    let before = sum.to_array();
    *sum = Response::from_array(array!(i in 4 => before[i] + force[i] * w[i]));
}

/// Corrects every constraint that something can move by the responses of its members to all forces, at a pace.
pub(super) fn correct(
    instructions: InstructionSet,
    iterates: &mut Iterates,
    responses: &[Response],
    (times, pace): (Times, Pace),
) -> Moved {
    match instructions.vectors() {
        // SAFETY: an instruction set is one that this processor has, and AVX-512 includes AVX2.
        #[cfg(target_arch = "x86_64")]
        Vectors::Avx2 | Vectors::Avx512 => unsafe { correct_avx2(iterates, responses, (times, pace)) },
        _ => correct_each(iterates, responses, (times, pace)),
    }
}

/// The same with four numbers to a register, `unsafe` as [`scatter_avx2`] is.
///
/// # Safety
///
/// The processor must have AVX2.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
unsafe fn correct_avx2(iterates: &mut Iterates, responses: &[Response], how: (Times, Pace)) -> Moved {
    correct_each(iterates, responses, how)
}

// Inlined, so that it is compiled for the instructions of its caller.
#[inline(always)]
fn correct_each(iterates: &mut Iterates, responses: &[Response], (times, pace): (Times, Pace)) -> Moved {
    let mut farthest = Moved::default();
    let Iterates { normal, friction } = iterates;
    let takes_part = |own: &Iterate| own.strength > 0.0 && !(own.yields && pace.some_yield);
    for (i, own) in normal.iter_mut().enumerate().filter(|(_, own)| takes_part(own)) {
        let friction = friction.get_mut(i).filter(|own| own.friction.is_some());
        let moved = match own.count {
            FACE => correct_one::<MEMBERS>(own, friction, responses, times, pace),
            EDGES => correct_one::<4>(own, friction, responses, times, pace),
            _ => correct_one::<1>(own, friction, responses, times, pace),
        };
        farthest.residual = farthest.residual.max(moved / own.size);
        farthest.length = farthest.length.max(moved);
    }
    farthest
}

/// Members of a constraint of a point and a face, and of two edges.
const FACE: u8 = MEMBERS as u8;
const EDGES: u8 = 4;

/// Closes the gap of one constraint as if it were alone with its shares of the masses, and goes on in this direction. How far it
/// moves, a length.
#[inline(always)]
fn correct_one<const COUNT: usize>(
    own: &mut Iterate,
    friction: Option<&mut FrictionIterate>,
    responses: &[Response],
    times: Times,
    pace: Pace,
) -> f64 {
    let mut change = [0.0; 4];
    let mut shares = [0.0; COUNT];
    for i in 0..COUNT {
        let (response, w) = (responses[own.members[i] as usize].to_array(), own.weights[i]);
        change = array!(j in 4 => change[j] + response[j] * w);
        shares[i] = response[3];
    }
    let change = [change[0], change[1], change[2]];
    let tried = own.normal_force;
    let gap = own.closing + times.drift * dot(change, own.normal) + times.both * own.compliance * tried;
    if tried == 0.0 && gap >= 0.0 {
        (own.last, own.active) = (0.0, false);
        if let Some(friction) = friction {
            (friction.tangential_force, friction.last) = ([0.0; 3], [0.0; 3]);
        }
        return 0.0;
    }
    // A constraint that has just become active is not yet in the load.
    let unseen = if own.active { 0.0 } else { 1.0 };
    for i in 0..COUNT {
        shares[i] = shares[i] / own.strength + unseen * own.weights[i].abs();
    }
    let inverse = (0..COUNT).fold(0.0, |sum, i| sum + shares[i] * own.softness[i]);
    let normal_force = (tried - gap / (times.both * (inverse + own.compliance))).max(0.0);
    let moved = (normal_force - tried).abs() * times.both * inverse;
    let moved = match friction {
        Some(friction) => moved.max(friction.correct(own.normal, (normal_force, &shares), change, times, pace)),
        None => moved,
    };
    let normal_ahead = further(tried, normal_force, own.last, pace.ahead).max(0.0);
    (own.normal_force, own.last, own.active, own.touched) = (normal_ahead, normal_force, true, true);
    moved
}

impl FrictionIterate {
    /// Corrects the friction force under a normal force; the members claim these shares of their masses. How far it moves what
    /// slides, a length.
    #[inline(always)]
    fn correct(
        &mut self,
        normal: [f64; 3],
        (normal_force, shares): (f64, &[f64]),
        change: [f64; 3],
        times: Times,
        Pace { ahead, cautious, .. }: Pace,
    ) -> f64 {
        let sliding = shares.iter().zip(&self.softness).fold(0.0, |sum, (share, softness)| sum + share * softness);
        let tried = self.tangential_force;
        let slip = add(self.slip, tangential(change, normal));
        let wanted = subtract(tried, scaled(slip, 1.0 / (times.kick * sliding)));
        let (size, most) = (dot(wanted, wanted).sqrt(), self.friction.coefficient(slip) * normal_force);
        self.slid |= size > most && normal_force > 0.0;
        let mut force = if size > most { scaled(wanted, most / size) } else { wanted };
        if cautious {
            let half = scaled(add(force, tried), 0.5);
            force = scaled(half, (most / dot(half, half).sqrt()).min(1.0));
        }
        let turn = subtract(force, tried);
        self.tangential_force = [0, 1, 2].map(|i| further(tried[i], force[i], self.last[i], ahead));
        self.last = force;
        dot(turn, turn).sqrt() * times.both * sliding
    }
}

/// From `new` further by a part `ahead` of the change from the last iteration to this one, unless the correction goes back.
#[inline(always)]
fn further(tried: f64, new: f64, last: f64, ahead: f64) -> f64 {
    let turns_back = (tried - new) * (new - last) > 0.0;
    if turns_back { new } else { new + ahead * (new - last) }
}
