//! Fluids: hourglass modes and corners are resisted by viscosity, and the energy is exactly the work of all corner forces.

use super::*;
use crate::material::{ElasticPlasticHydrodynamic, EquationOfState, Hydrodynamic, IdealGas};

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

/// A mode weighs M/64 per unit of its rate, which is eight times its speed, and is slowed by nine tenths in a stable step.
#[test]
fn hourglass_modes_are_slowed_in_a_stable_step() {
    for factor in [1.0, 0.25] {
        let mut rig = gas(1e5);
        if let Element::Hexahedron(element) = &mut rig.block.element {
            element.hourglass = Hourglass::AssumedStrain { factor };
        }
        let speed = 1e-3;
        let outcome = rig.step(1e-9, |n| [speed * modes(n)[0], 0.0, 0.0]);
        let expected = factor * 0.9 * DENSITY / 64.0 * 8.0 * speed / outcome.stable_step;
        close("resistance", rig.state(rows::HOURGLASS), expected, 1e-7 * expected);
    }
}

/// Whatever the motion and however the steps change, what an element of a fluid or a solid with an equation of state books is
/// the work of its corner forces, ½ (Δt̄ₙ fₙ + Δt̄ₙ₊₁ fₙ₊₁)·v, to round-off; here with a corner that comes close to turning
/// inside out. The last forces are booked with the last step for Δt̄.
#[test]
fn booked_energy_is_exactly_the_work_of_the_forces() {
    let equation = EquationOfState::IdealGas(IdealGas { gamma: GAMMA, initial_energy: 1e5 });
    let gas = Law::Hydrodynamic(Hydrodynamic { equation, tension: 0.0, points: [].into() });
    let [young, poisson, yield_stress] = [1e5, 0.3, 1e3];
    let solid = ElasticPlasticHydrodynamic { equation, young, poisson, yield_stress, hardening: 0.0, tension: 1e9 };
    for (law, accounts) in [
        (gas, &[rows::INTERNAL_ENERGY, rows::VISCOUS_ENERGY, rows::HOURGLASS_ENERGY][..]),
        (Law::ElasticPlasticHydrodynamic(solid), &[rows::INTERNAL_ENERGY, rows::VISCOUS_ENERGY]),
    ] {
        let mut random = Random(5);
        let fluid = law.is_fluid();
        // Without hourglass resistance, whose work in solids is booked by another rule.
        let mut rig = Rig::single(&random.warped(0.1), law, if fluid { ASSUMED } else { NONE });
        rig.pass.bulk_viscosity = BulkViscosity { linear: 0.06, quadratic: 1.2 };
        let (mut work, mut overdue, mut size, mut held) = (0.0, 0.0, 0.0_f64, 0.0_f64);
        let (mut last, mut last_step) = ([[0.0; 3]; 8], 0.0);
        for step in 0..60 {
            let time_step = 1e-3 * (1.0 + 0.5 * random.next());
            let wiggle: Vec<[f64; 3]> = (0..8).map(|_| random.vector()).collect();
            let inwards = if (20..35).contains(&step) { 25.0 } else { 0.0 };
            let kick = 0.5 * (last_step + time_step);
            // What was booked for the last forces with the last step becomes what it should be.
            work += overdue * (kick - last_step);
            overdue = 0.0;
            rig.step(time_step, |n| {
                let push = if n == 6 { inwards } else { 0.0 };
                wiggle[n].map(|w| 3.0 * w - push)
            });
            for n in 0..8 {
                let (v, f) = (rig.velocity(n), rig.force(n));
                let own = |f: [f64; 3]| (0..3).map(|i| 0.5 * v[i] * f[i]).sum::<f64>();
                work += kick * own(last[n]) + time_step * own(f);
                overdue += own(f);
                size = size.max(work.abs());
            }
            last = std::array::from_fn(|n| rig.force(n));
            last_step = time_step;
            if fluid {
                held = (0..8).fold(held, |most, corner| most.max(rig.state(rows::LAW + corner).abs()));
            }
        }
        let booked: f64 = accounts.iter().map(|&row| rig.state(row)).sum();
        close("work", booked, work, 1e-12 * size);
        assert!(!fluid || held > 0.0, "no corner came close");
    }
}

/// In a strong shock viscosity alone sets the stable step. At that step no hourglass mode grows, alone or with its partner,
/// in a cube or a flat box, and each has lost nine tenths within twenty steps. Two partners make a truncated pyramid of the
/// cube, which has more room: after eight steps the pressure that has risen until then drives them on, which is no matter of
/// the viscosity.
#[test]
fn hourglass_viscosity_is_stable_at_the_full_step() {
    let alone = (0..12).map(|i| vec![(i / 4, i % 4)]);
    let with_partners = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| vec![(i, j), (j, i)]);
    for shape in alone.chain(with_partners) {
        let steps = if shape.len() == 1 { 20 } else { 8 };
        for thickness in [1.0, 0.1] {
            let (greatest, left) = shaken(&shape, thickness, steps);
            assert!(greatest <= 1.0 + 1e-9, "{shape:?}, {thickness}: grows to {greatest}");
            assert!(left < 0.1, "{shape:?}: {left} is left");
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
