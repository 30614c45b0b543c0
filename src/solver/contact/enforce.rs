//! Enforcement: equal and opposite forces that take the overlaps out of the coming step.
//!
//! Every contact is a constraint on the points that take part, with weights that add up to zero: +1 for a point and
//! −N for the corners of its face; four weights for two edges; +1 alone against a rigid plane. A force λ ≥ 0 along the
//! normal acts on each point times its weight, so linear momentum is kept to round-off whatever λ is, and angular
//! momentum too where the points meet along the normal.
//!
//! λ is found in passes. Within a pass a point that takes part in several constraints gives each a share of its mass,
//! and every constraint closes its gap as if it were alone with these shares (mass splitting: Tonge, Benevolenski and
//! Voroshilov 2012); the shares add up to the whole, so passes cannot overshoot. For points of equal overlap on a flat
//! face this is the partitioned kinematic method of Attaway et al. (1996), eqs. 15–27, with eq. 25 solved for the
//! acceleration of the face: λ = m_s δ/Δτ · m_I/(m_I + Σ N m_s), and one pass closes the gap.

use super::points::Points;
use crate::model::Friction;
use crate::solver::constraints::StepTimes;
use crate::solver::nodes::{add, dot, scaled, subtract};

/// Points that one constraint can join: a point and four corners.
pub const MEMBERS: usize = 5;

/// A gap to be closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// Points that take part; the first `count` count.
    pub members: [u32; MEMBERS],
    /// Their weights.
    pub weights: [f64; MEMBERS],
    /// Number of members.
    pub count: usize,
    /// Unit normal along which the first member is pushed.
    pub normal: [f64; 3],
    /// Gap at the end of the step without contact; closed when it is negative.
    pub gap: f64,
    /// Length that the gap is small against.
    pub size: f64,
    /// Weight of this constraint where points share their mass among several: the slave share of the partition.
    pub share: f64,
    /// Coulomb friction.
    pub friction: Friction,
    /// Normal force λ, found by [`Enforcer::solve`].
    pub push: f64,
    /// Friction force on the first member.
    pub drag: [f64; 3],
}

impl Constraint {
    /// Members with their weights.
    pub fn parts(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.members.iter().zip(&self.weights).take(self.count).map(|(&point, &weight)| (point as usize, weight))
    }

    /// Relative value of a field of vectors: Σ w u.
    fn relative(&self, field: &[[f64; 3]]) -> [f64; 3] {
        self.parts().fold([0.0; 3], |sum, (point, weight)| add(sum, scaled(field[point], weight)))
    }
}

/// How far the passes go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest number of passes.
    pub passes: u32,
    /// Overlap that is left alone, as a part of the face's size.
    pub tolerance: f64,
}

/// What became of a step's constraints.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Passes made.
    pub passes: u32,
    /// Largest overlap left, as a part of the face's size.
    pub left: f64,
}

/// Buffers of the passes, one entry per point.
#[derive(Debug, Clone, Default)]
pub struct Enforcer {
    /// Normal forces on the points.
    pub normal_force: Vec<[f64; 3]>,
    /// Friction forces on the points.
    pub friction_force: Vec<[f64; 3]>,
    /// Change of velocity that the forces make.
    change: Vec<[f64; 3]>,
    /// Sum of what the constraints at a point weigh there.
    load: Vec<f64>,
    /// Reduced mass of each constraint alone, times its share.
    strength: Vec<f64>,
}

/// 1/m along a direction.
fn along(inverse_mass: [f64; 3], n: [f64; 3]) -> f64 {
    inverse_mass[0] * n[0] * n[0] + inverse_mass[1] * n[1] * n[1] + inverse_mass[2] * n[2] * n[2]
}

impl Enforcer {
    /// Buffers for so many points.
    pub fn new(points: usize) -> Enforcer {
        let zero = vec![[0.0; 3]; points];
        Enforcer {
            normal_force: zero.clone(),
            friction_force: zero.clone(),
            change: zero,
            load: vec![0.0; points],
            strength: Vec::new(),
        }
    }

    /// Finds the forces of all constraints and their sums at the points. The order of the constraints is that of the
    /// sums and must not depend on the decomposition.
    pub fn solve(
        &mut self,
        constraints: &mut [Constraint],
        points: &Points,
        step: &StepTimes,
        limits: Limits,
    ) -> Outcome {
        self.clear(constraints);
        self.strength.clear();
        self.strength.extend(constraints.iter().map(|constraint| {
            let inverse: f64 =
                constraint.parts().map(|(point, w)| w * w * along(points.inverse_mass[point], constraint.normal)).sum();
            // Where all members are held there is nothing to move.
            if inverse > 0.0 { constraint.share / inverse } else { 0.0 }
        }));
        let mut outcome = Outcome::default();
        loop {
            outcome.left = self.overlap(constraints, step);
            // One pass is made for the smallest overlap. Under small loads a step's overlap is far below any tolerance;
            // left alone until it has grown, it would come out as a row of blows instead of a steady force.
            let enough = outcome.left <= limits.tolerance && (outcome.passes > 0 || outcome.left <= 0.0);
            if enough || outcome.passes == limits.passes {
                return outcome;
            }
            self.pass(constraints, points, step);
            outcome.passes += 1;
        }
    }

    /// Change of velocity that the forces make at a point of the last constraints.
    pub fn change(&self, point: usize) -> [f64; 3] {
        self.change[point]
    }

    /// Forgets the forces of the last step at the points of these constraints.
    fn clear(&mut self, constraints: &mut [Constraint]) {
        for constraint in constraints {
            (constraint.push, constraint.drag) = (0.0, [0.0; 3]);
            for &point in &constraint.members[..constraint.count] {
                self.change[point as usize] = [0.0; 3];
            }
        }
    }

    /// The gap at the end of the step with the forces found so far.
    fn gap(&self, constraint: &Constraint, step: &StepTimes) -> f64 {
        constraint.gap + step.drift * dot(constraint.relative(&self.change), constraint.normal)
    }

    /// Largest overlap in units of the faces' sizes.
    fn overlap(&self, constraints: &[Constraint], step: &StepTimes) -> f64 {
        constraints
            .iter()
            .zip(&self.strength)
            .filter(|(_, strength)| **strength > 0.0)
            .fold(0.0, |worst, (c, _)| f64::max(worst, -self.gap(c, step) / c.size))
    }

    /// One pass: shares, forces, sums.
    fn pass(&mut self, constraints: &mut [Constraint], points: &Points, step: &StepTimes) {
        for constraint in constraints.iter() {
            constraint.parts().for_each(|(point, _)| self.load[point] = 0.0);
        }
        for i in 0..constraints.len() {
            let c = &constraints[i];
            if c.push > 0.0 || self.gap(c, step) < 0.0 {
                c.parts().for_each(|(point, w)| self.load[point] += w.abs() * self.strength[i]);
            }
        }
        for i in 0..constraints.len() {
            if self.strength[i] > 0.0 {
                self.correct(&mut constraints[i], self.strength[i], points, step);
            }
        }
        self.gather(constraints, points, step);
    }

    /// Closes the gap of one constraint as if it were alone with its shares of the masses.
    fn correct(&self, c: &mut Constraint, strength: f64, points: &Points, step: &StepTimes) {
        let gap = self.gap(c, step);
        if c.push == 0.0 && gap >= 0.0 {
            return;
        }
        let (mut inverse, mut sliding) = (0.0, 0.0);
        for (point, w) in c.parts() {
            let share = w.abs() * self.load[point] / strength;
            let m = points.inverse_mass[point];
            inverse += share * along(m, c.normal);
            sliding += share * m[0].max(m[1]).max(m[2]);
        }
        c.push = (c.push - gap / (step.drift * step.kick * inverse)).max(0.0);
        if c.friction.is_some() {
            let velocity = add(c.relative(&points.velocity), c.relative(&self.change));
            let slip = subtract(velocity, scaled(c.normal, dot(velocity, c.normal)));
            let wanted = subtract(c.drag, scaled(slip, 1.0 / (step.kick * sliding)));
            let (size, most) = (dot(wanted, wanted).sqrt(), c.friction.coefficient(slip) * c.push);
            c.drag = if size > most { scaled(wanted, most / size) } else { wanted };
        }
    }

    /// Sums the forces at the points, in the order of the constraints.
    fn gather(&mut self, constraints: &[Constraint], points: &Points, step: &StepTimes) {
        for (point, _) in constraints.iter().flat_map(|c| c.parts()) {
            (self.normal_force[point], self.friction_force[point]) = ([0.0; 3], [0.0; 3]);
        }
        for c in constraints.iter().filter(|c| c.push > 0.0) {
            for (point, w) in c.parts() {
                self.normal_force[point] = add(self.normal_force[point], scaled(c.normal, w * c.push));
                self.friction_force[point] = add(self.friction_force[point], scaled(c.drag, w));
            }
        }
        for (point, _) in constraints.iter().flat_map(|c| c.parts()) {
            let force = add(self.normal_force[point], self.friction_force[point]);
            let m = points.inverse_mass[point];
            self.change[point] = [0, 1, 2].map(|i| step.kick * (force[i] * m[i]));
        }
    }
}
