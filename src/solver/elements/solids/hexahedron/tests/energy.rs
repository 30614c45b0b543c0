//! Energy booked by elements against the work of their corner forces.

use super::*;
use crate::material::ElasticPlastic;

/// Moves an element along a closed path around its first place in `steps` steps: every corner on its own ellipses of
/// size `amplitude`, the whole turning by `turn` radians and back. Returns work done by the corner forces against
/// the motion, energy booked, and the largest energy on the way.
fn cycle(hourglass: Hourglass, law: Law, steps: usize, amplitude: f64, turn: f64) -> (f64, f64, f64) {
    let mut random = Random(9);
    let corners = random.warped(0.15);
    let wiggle: Vec<[[f64; 3]; 3]> = (0..8).map(|_| [random.vector(), random.vector(), random.vector()]).collect();
    let axis = Vector3::from(random.vector()).normalize();
    let place = |step: usize, n: usize| {
        let t = std::f64::consts::TAU * step as f64 / steps as f64;
        let phase = [t.sin(), 1.0 - t.cos(), (2.0 * t).sin()];
        let local =
            (0..3).fold(Vector3::from(corners[n]), |x, k| x + Vector3::from(wiggle[n][k]) * (amplitude * phase[k]));
        let r = Rotation3::new(axis * (turn * 0.5 * (1.0 - t.cos())));
        (r * local).into()
    };
    let mut rig = Rig::single(&corners, law, hourglass);
    rig.pass.bulk_viscosity = BulkViscosity { linear: 0.06, quadratic: 1.2 };
    let (mut work, mut peak) = (0.0, 0.0f64);
    let mut last = [[0.0; 3]; 8];
    let time_step = 1.0 / steps as f64;
    let booked = |rig: &Rig| {
        rig.state(rows::INTERNAL_ENERGY) + rig.state(rows::HOURGLASS_ENERGY) + rig.state(rows::VISCOUS_ENERGY)
    };
    for step in 1..=steps {
        rig.step_to(time_step, |n| place(step, n));
        for n in 0..8 {
            let (v, f) = (rig.velocity(n), rig.force(n));
            work += (0..3).map(|i| 0.5 * time_step * v[i] * (last[n][i] + f[i])).sum::<f64>();
            last[n] = f;
        }
        peak = peak.max(booked(&rig).abs());
    }
    (work, booked(&rig), peak)
}

const CONTROLS: [Hourglass; 4] = [
    NONE,
    ASSUMED,
    Hourglass::FlanaganBelytschko { stiffness: 0.05, viscosity: 0.0 },
    Hourglass::FlanaganBelytschko { stiffness: 0.05, viscosity: 0.03 },
];

fn plastic() -> Law {
    Law::ElasticPlastic(ElasticPlastic { young: 200e9, poisson: 0.3, yield_stress: 100e6, hardening: 1e9, beta: 0.5 })
}

/// Without rotation both are midpoint rules of the same integral and differ by next to nothing; the viscous hourglass
/// force is booked as it stands at the end of the step, which is of first order.
#[test]
fn booked_energy_is_the_work_of_the_forces() {
    for control in CONTROLS {
        for law in [elastic(0.3), plastic()] {
            let (work, booked, peak) = cycle(control, law, 400, 1e-3, 0.0);
            let viscous = matches!(control, Hourglass::FlanaganBelytschko { viscosity, .. } if viscosity > 0.0);
            close("work", work, booked, if viscous { 1e-4 } else { 2e-6 } * peak);
        }
    }
}

/// An elastic element gives back what it took, but for what viscosity keeps (none of it at this pace) and for the
/// second-order path dependence of hypoelasticity, which falls with the amplitude of the strain.
#[test]
fn closed_elastic_cycle_returns_its_energy() {
    for control in &CONTROLS[..3] {
        for amplitude in [1e-3, 1e-4] {
            let (_, booked, peak) = cycle(*control, elastic(0.3), 400, amplitude, 0.0);
            close("energy left", booked, 0.0, amplitude * peak);
        }
    }
    let (_, booked, peak) = cycle(ASSUMED, plastic(), 400, 3e-3, 0.0);
    assert!(booked > 0.3 * peak, "plastic flow keeps its energy: {booked} of {peak}");
}

/// In a rotation by θ per step a force acts at one end of the step and moves along a chord: its work differs from
/// the booked one by ¼ θ² Δσ : I, a property of central differences. It falls with the square of the step.
#[test]
fn energy_error_of_a_turning_element_is_of_second_order() {
    for control in CONTROLS {
        let error = |steps| {
            let (work, booked, peak) = cycle(control, elastic(0.3), steps, 1e-3, 1.0);
            (work - booked).abs() / peak
        };
        let (coarse, fine) = (error(100), error(200));
        assert!((3.5..4.5).contains(&(coarse / fine)), "{control:?}: {coarse:e}, {fine:e}");
        // A corner turns by at most π/400 per step here.
        assert!(error(400) < 5e-3, "{control:?}: {:e}", error(400));
    }
}
