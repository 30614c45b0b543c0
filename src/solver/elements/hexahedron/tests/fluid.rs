//! Hourglass resistance of fluids: a viscosity of the bulk viscosity's size, whose work is heat.

use super::*;
use crate::material::{EquationOfState, Hydrodynamic, IdealGas};

const GAMMA: f64 = 5.0 / 3.0;
const QUADRATIC: f64 = 1.2;

fn gas(initial_energy: f64) -> Rig {
    gas_in(&CUBE, initial_energy)
}

fn gas_in(corners: &[[f64; 3]; 8], initial_energy: f64) -> Rig {
    let equation = EquationOfState::IdealGas(IdealGas { gamma: GAMMA, initial_energy });
    let law = Law::Hydrodynamic(Hydrodynamic { equation, tension: 0.0, points: [].into() });
    let mut rig = Rig::single(corners, law, ASSUMED);
    rig.pass.bulk_viscosity = BulkViscosity { linear: 0.0, quadratic: QUADRATIC };
    rig
}

/// Modes ηζ, ζξ, ξη and ξηζ at a corner.
fn modes(corner: usize) -> [f64; 4] {
    let [xi, eta, zeta] = CUBE[corner].map(|c| 2.0 * c - 1.0);
    [eta * zeta, zeta * xi, xi * eta, xi * eta * zeta]
}

/// Shaken in an hourglass mode, which leaves volume and internal energy as they were, a gas grows hotter: its pressure is
/// (γ − 1) times all the energy that it took up.
#[test]
fn hourglass_work_heats_a_fluid() {
    let mut rig = gas(1e5);
    for step in 0..40 {
        let speed = 20.0 * f64::from(step).sin();
        rig.step(1e-3, |n| [speed * modes(n)[0], 0.0, 0.0]);
    }
    rig.step(1e-3, |_| [0.0; 3]);
    let heat = rig.state(rows::HOURGLASS_ENERGY);
    assert!(heat > 10.0, "too little to see: {heat}");
    // The step at rest books its own work after the law has looked, and that is none.
    let pressure = (GAMMA - 1.0) * (1e5 + heat);
    close("pressure", -rig.state(rows::STRESS), pressure, 1e-12 * pressure);
    close("internal energy", rig.state(rows::INTERNAL_ENERGY), 0.0, 1e-9);
}

/// A cold gas that is compressed resists a mode by η = b₂² |tr D| (λ+2μ) Δt̂², b₂² |tr D| ρh²/3 on a cube, in the place of
/// μΔt: Q = ½ η (H₂₂ + H₃₃) q̇/64 after the first step, H = 4h/3. In expansion it does not.
#[test]
fn hourglass_viscosity_follows_compression() {
    for (rate, expected) in [(-1.0, 1.0), (1.0, 0.0)] {
        let mut rig = gas(1e-9);
        let speed = 1e-3;
        rig.step(1e-9, |n| {
            let [x, y, z] = CUBE[n].map(|c| rate * c);
            [x + speed * modes(n)[0], y, z]
        });
        let viscosity = QUADRATIC * QUADRATIC * 3.0 * DENSITY / 3.0;
        let full = 0.5 * viscosity * (8.0 / 3.0) * 8.0 * speed / 64.0;
        close("resistance", rig.state(rows::HOURGLASS), expected * full, 1e-7 * full);
    }
}

/// In a strong shock viscosity alone sets the stable step. At that step no hourglass mode grows, alone or with its partner,
/// in a cube or a flat box. Within twenty steps each has lost nine tenths in the cube; along a flat box steps are short for
/// modes that are slow. Two partners make a truncated pyramid of the cube, which has more room: after eight steps the
/// pressure that has risen until then drives them on, which is no matter of the viscosity.
#[test]
fn hourglass_viscosity_is_stable_at_the_full_step() {
    let alone = (0..12).map(|i| vec![(i / 4, i % 4)]);
    let with_partners = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| vec![(i, j), (j, i)]);
    for shape in alone.chain(with_partners) {
        let steps = if shape.len() == 1 { 20 } else { 8 };
        for thickness in [1.0, 0.1] {
            let (greatest, left) = shaken(&shape, thickness, steps);
            assert!(greatest <= 1.0 + 1e-9, "{shape:?}, {thickness}: grows to {greatest}");
            // The gas heats up as it goes, and the viscosity over its stiffness falls: hence not quite to nothing.
            assert!(left < 0.1 || thickness < 1.0, "{shape:?}: {left} is left");
        }
    }
}

/// Compresses a box of a cold gas that is `thickness` high and shaken in modes of (direction, mode), all alike at first. The
/// greatest speed in so many steps, and the last, against that at first.
fn shaken(shape: &[(usize, usize)], thickness: f64, steps: usize) -> (f64, f64) {
    let corners = CUBE.map(|[x, y, z]| [x, y, thickness * z]);
    let mut rig = gas_in(&corners, 1e-9);
    let node_mass = DENSITY * thickness / 8.0;
    let first = 1e-6;
    let (mut speeds, mut time_step, mut greatest) = (vec![first; shape.len()], 1e-9, 0.0_f64);
    let size =
        |speeds: &[f64]| speeds.iter().map(|v| v * v).sum::<f64>().sqrt() / (first * (speeds.len() as f64).sqrt());
    for _ in 0..steps {
        let places: Vec<_> = (0..8).map(|n| rig.position(n)).collect();
        let outcome = rig.step(time_step, |n| {
            let mut v = places[n].map(|x| -x);
            shape.iter().zip(&speeds).for_each(|(&(direction, mode), speed)| v[direction] += speed * modes(n)[mode]);
            v
        });
        time_step = outcome.stable_step;
        for (&(direction, mode), speed) in shape.iter().zip(&mut speeds) {
            let force: f64 = (0..8).map(|n| rig.force(n)[direction] * modes(n)[mode] / 8.0).sum();
            *speed -= time_step * force / node_mass;
        }
        greatest = greatest.max(size(&speeds));
    }
    (greatest, size(&speeds))
}
