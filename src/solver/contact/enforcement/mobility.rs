//! How points of contact answer to forces: by their own masses, with all of a rigid body, or with what TIED CONTACT joins.
//!
//! A body is to the enforcement what a node is: forces on all of its points move it, and the constraints on it share its mass.
//! The operator that turns forces into velocities is then no longer diagonal over points, but it is still symmetric and
//! positive, which is all that the certificate of energy asks of it.

use super::constraint::{Constraint, MEMBERS, Response};
use super::iterates::Iterates;
use super::joints::Joints;
use crate::comm::ExactSum;
use crate::common::vector::{add, cross, subtract};
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::surface::layout::ABSENT;
use crate::solver::rigid::{Compliance, Six, applied, product};
use std::sync::Arc;

/// Sums over the points of a body: force, moment, load.
const SUMS: usize = 7;

/// Which points belong to rigid bodies, and how these answer to forces.
#[derive(Debug, Clone, Default)]
pub struct Mobility {
    /// Body of each point, or [`u32::MAX`]; empty where there are no bodies.
    pub body: Vec<u32>,
    /// The bodies in this step.
    pub bodies: Vec<BodyMobility>,
    /// Place of each point among the nodes of joints, or [`u32::MAX`]; empty where contact meets no joint.
    pub joint: Vec<u32>,
    /// The joints.
    pub joints: Arc<Joints>,
}

/// A rigid body in a step.
#[derive(Debug, Clone, Copy)]
pub struct BodyMobility {
    /// Centre of mass.
    pub centre: [f64; 3],
    /// What forces and moments about the centre do to its velocities.
    pub compliance: Compliance,
    /// The same if nothing held it: what round-off of the former is measured by.
    pub free: Compliance,
}

impl Mobility {
    /// Body of a point.
    #[inline]
    pub fn of(&self, point: usize) -> Option<usize> {
        self.body.get(point).copied().filter(|body| *body != ABSENT).map(|body| body as usize)
    }

    /// Whether members of a constraint belong to rigid bodies, and all others cannot be moved.
    pub fn is_rigid(&self, mut parts: impl Iterator<Item = (usize, f64)>, inverse_mass: &[[f64; 3]]) -> bool {
        let mut some_are = false;
        let mut is_or_rests = |point: usize| {
            let is_of_body = self.of(point).is_some();
            some_are |= is_of_body;
            is_of_body || inverse_mass[point].iter().all(|m| *m <= 0.0)
        };
        !self.bodies.is_empty() && parts.all(|(point, _)| is_or_rests(point)) && some_are
    }

    /// Place of a point among the nodes of joints.
    #[inline]
    pub fn joint(&self, point: usize) -> Option<u32> {
        self.joint.get(point).copied().filter(|place| *place != ABSENT)
    }

    /// Whether points move with each other beside the constraints.
    pub fn is_coupled(&self) -> bool {
        !self.bodies.is_empty() || self.joints.are_there()
    }
}

/// A force at an arm with its moment.
fn wrench(arm: [f64; 3], [x, y, z]: [f64; 3]) -> Six {
    let [a, b, c] = cross(arm, [x, y, z]);
    [x, y, z, a, b, c]
}

impl BodyMobility {
    /// Whether forces can move it at all when nothing holds it.
    pub fn is_movable(&self) -> bool {
        self.free.iter().flatten().any(|part| *part != 0.0)
    }

    fn arm(&self, motion: &NodeMotion, point: usize) -> [f64; 3] {
        subtract(motion.start(point as u32), self.centre)
    }

    /// What unit forces on these points, times their weights, do to their weighted sum of velocities: along a direction, and
    /// along any at most.
    fn answer(&self, parts: &[([f64; 3], f64)], normal: [f64; 3]) -> [f64; 2] {
        let along = total(parts, normal);
        [product(&along, &applied(&self.compliance, &along)), most(parts, &self.compliance)]
    }
}

/// Force and moment of unit forces in a direction on these points, times their weights.
fn total(parts: &[([f64; 3], f64)], direction: [f64; 3]) -> Six {
    parts.iter().fold([0.0; 6], |sum, (arm, w)| {
        let one = wrench(*arm, direction);
        std::array::from_fn(|i| sum[i] + w * one[i])
    })
}

/// What such forces do along any direction at most.
fn most(parts: &[([f64; 3], f64)], compliance: &Compliance) -> f64 {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| total(parts, axis));
    let answers = axes.map(|axis| applied(compliance, &axis));
    // No eigenvalue is above the largest sum of a row.
    let row = |i: usize| axes.iter().map(|axis| product(axis, &answers[i]).abs()).sum::<f64>();
    row(0).max(row(1)).max(row(2))
}

/// Completes what is known of a constraint with the points of bodies: adds to what a unit force does to it along its
/// normal, and to what single points do at most; finds what each of them shares.
pub fn weigh(
    c: &Constraint,
    motion: &NodeMotion,
    softness: &mut [[f64; 2]; MEMBERS],
    [inverse, isotropic]: [&mut f64; 2],
) {
    let mobility = &motion.mobility;
    let of = |i: usize| mobility.of(c.members[i] as usize);
    for i in (0..c.count).filter(|&i| of(i).is_some()) {
        let Some(body) = of(i) else { continue };
        // Once for each body, at the first of its points.
        if (0..i).any(|before| of(before) == Some(body)) {
            continue;
        }
        let own = &mobility.bodies[body];
        let mut parts = [([0.0; 3], 0.0); MEMBERS];
        let mut count = 0;
        for j in (i..c.count).filter(|&j| of(j) == Some(body)) {
            parts[count] = (own.arm(motion, c.members[j] as usize), c.weights[j]);
            *isotropic += self::most(&parts[count..=count], &own.free);
            count += 1;
        }
        let [along, most] = own.answer(&parts[..count], c.normal);
        let weight: f64 = parts[..count].iter().map(|(_, w)| w.abs()).sum();
        *inverse += along;
        // The points share as one: their shares of the load add up to that of all their weights.
        for j in (i..c.count).filter(|&j| of(j) == Some(body)) {
            let part = if weight > 0.0 { c.weights[j].abs() / (weight * weight) } else { 0.0 };
            softness[j] = [part * along, part * most];
        }
    }
}

/// Sums of forces and loads over the points of bodies, while constraints are gone through.
pub struct BodySums(Vec<ExactSum>);

impl BodySums {
    /// Of all constraints that this rank has made and that are active.
    pub fn of(iterates: &Iterates, motion: &NodeMotion) -> BodySums {
        let mobility = &motion.mobility;
        let mut sums = vec![ExactSum::new(); SUMS * mobility.bodies.len()];
        for (i, own) in iterates.normal.iter().enumerate().filter(|(_, own)| own.own && own.active) {
            let force = iterates.force(i);
            for (&point, w) in own.members.iter().zip(own.weights).take(own.count.into()) {
                let Some(body) = mobility.of(point as usize) else { continue };
                let one = wrench(mobility.bodies[body].arm(motion, point as usize), force);
                let sums = &mut sums[SUMS * body..][..SUMS];
                sums.iter_mut().zip(one).for_each(|(sum, part)| sum.add(w * part));
                sums[SUMS - 1].add(w.abs() * own.strength);
            }
        }
        BodySums(sums)
    }

    /// The sums, to be merged over ranks.
    pub fn sums(&mut self) -> &mut [ExactSum] {
        &mut self.0
    }

    /// Lets these points answer as their bodies do.
    pub fn answer(&self, points: &[u32], motion: &NodeMotion, kick: f64, responses: &mut [Response]) {
        let mobility = &motion.mobility;
        let answer = |(body, sums): (&BodyMobility, &[ExactSum])| {
            let change = applied(&body.compliance, &std::array::from_fn(|i| kick * sums[i].value()));
            (change, sums[SUMS - 1].value())
        };
        let answers: Vec<(Six, f64)> = mobility.bodies.iter().zip(self.0.chunks_exact(SUMS)).map(answer).collect();
        for &point in points {
            let Some(body) = mobility.of(point as usize) else { continue };
            let ([u, v, w, a, b, c], load) = answers[body];
            let arm = mobility.bodies[body].arm(motion, point as usize);
            responses[point as usize] = Response { velocity_change: add([u, v, w], cross([a, b, c], arm)), load };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point on the outside of a body that is free: 1/m + (r × n)·I⁻¹(r × n).
    #[test]
    fn a_point_of_a_body_answers_with_its_inertia() {
        let mut compliance = [[0.0; 6]; 6];
        (0..3).for_each(|i| (compliance[i][i], compliance[i + 3][i + 3]) = (0.5, 0.25));
        let body = BodyMobility { centre: [0.0; 3], compliance, free: compliance };
        let [along, most] = body.answer(&[([2.0, 0.0, 0.0], 1.0)], [0.0, 1.0, 0.0]);
        assert!((along - 1.5).abs() < 1e-15 && (most - 1.5).abs() < 1e-15, "{along} {most}");
        // Two points pushed apart do not move a body.
        let [along, _] = body.answer(&[([2.0, 0.0, 0.0], 1.0), ([2.0, 1.0, 0.0], -1.0)], [0.0, 1.0, 0.0]);
        assert!(along.abs() < 1e-15, "{along}");
    }
}
