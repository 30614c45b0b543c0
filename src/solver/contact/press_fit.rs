//! Press fits: overlaps of the mesh that CONTACT OVERLAP, STRESS pushes apart through the strain of the bodies.
//!
//! Contact tolerates what bodies overlap in the mesh. Here the tolerated overlap δ goes to zero as
//! δ(t) = δ₀ ½ (1 + cos πt/T), slowly against the waves in the bodies, so that what is left is the static stress of the fit.
//! To contact it is a surface that grows with the velocity r = −dδ/dt: relative velocities are counted from the growing
//! surface, so that the certificate holds for what it holds without, and the work ∫ λ r dt that the growth does is energy
//! supplied, with an account of its own.

use crate::mesh::Mesh;
use crate::model::{ContactOverlap, Model};
use crate::solver::body::Body;
use crate::solver::constraints::StepTimes;

/// Transits of a wave through the whole model in which overlaps are pushed apart, where the deck does not say.
const TRANSITS: f64 = 40.0;

/// How overlaps of the mesh are pushed apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressFit {
    /// Time at which nothing overlaps any more.
    pub duration: f64,
}

impl PressFit {
    /// The press fit that the deck asks for, if any.
    pub fn of(mesh: &Mesh, model: &Model, body: &Body) -> Option<PressFit> {
        let ContactOverlap::Stress(duration) = model.contact.control.overlap else { return None };
        Some(PressFit { duration: PressFit::duration_of(duration, mesh, model, body) })
    }

    /// Time until which a press fit lasts, by what a deck says of it.
    pub fn duration_of(said: Option<f64>, mesh: &Mesh, model: &Model, body: &Body) -> f64 {
        said.unwrap_or_else(|| TRANSITS * transit(mesh, model, body))
    }

    /// Factor on the tolerated overlap over this step; 1 once nothing is tolerated any more.
    pub fn remaining(&self, step: &StepTimes) -> f64 {
        if step.time >= self.duration {
            return 1.0;
        }
        let part = |time: f64| 0.5 * (1.0 + libm::cos(std::f64::consts::PI * (time / self.duration).clamp(0.0, 1.0)));
        let now = part(step.time);
        if now > 0.0 { part(step.time + step.drift) / now } else { 0.0 }
    }
}

/// Time of the slowest dilatational wave through the longest side of the box around the mesh.
fn transit(mesh: &Mesh, model: &Model, body: &Body) -> f64 {
    let (low, high) = body.positions.iter().fold(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]), |(low, high), at| {
        ([0, 1, 2].map(|i| at[i].min(low[i])), [0, 1, 2].map(|i| at[i].max(high[i])))
    });
    let longest = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
    let speed = |block: usize| {
        let material = &model.materials[body.block_material[block]];
        (material.law.moduli().dilatational() / material.density).sqrt()
    };
    let slowest = (0..mesh.blocks.len()).map(speed).filter(|speed| *speed > 0.0).fold(f64::INFINITY, f64::min);
    longest / slowest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_falls_from_all_to_nothing() {
        let fit = PressFit { duration: 2.0 };
        let left = (0..25)
            .fold(1.0, |left, i| left * fit.remaining(&StepTimes { time: 0.1 * f64::from(i), kick: 0.1, drift: 0.1 }));
        assert!(left.abs() < 1e-15, "{left}");
        let half = (0..10)
            .fold(1.0, |left, i| left * fit.remaining(&StepTimes { time: 0.1 * f64::from(i), kick: 0.1, drift: 0.1 }));
        // ½ (1 + cos π/2).
        assert!((half - 0.5).abs() < 1e-14, "{half}");
        assert_eq!(fit.remaining(&StepTimes { time: 2.0, kick: 0.1, drift: 0.1 }), 1.0);
    }
}
