//! V-09: what the stable step bounds, for any shape and either hourglass control.

use super::*;
use crate::material::ElasticPlastic;

/// 2/√λ_max of M⁻¹K with the lumped mass of the element.
fn exact_step(k: &DMatrix<f64>, corners: &Corners) -> f64 {
    let symmetric = (k + k.transpose()) * 0.5;
    let largest = symmetric.symmetric_eigenvalues().max();
    2.0 / (largest * 8.0 / (DENSITY * volume(corners))).sqrt()
}

/// The step that the element asks for at rest.
fn bound(corners: &Corners, law: Law, hourglass: Hourglass, prepare: impl Fn(&mut Rig)) -> f64 {
    let mut rig = Rig::single(corners, law, hourglass);
    prepare(&mut rig);
    rig.step(0.0, |_| [0.0; 3]).stable_step
}

fn ratio(corners: &Corners, law: Law, hourglass: Hourglass, prepare: impl Fn(&mut Rig)) -> f64 {
    let k = stiffness(corners, law.clone(), hourglass, &prepare);
    exact_step(&k, corners) / bound(corners, law, hourglass, &prepare)
}

/// Warped elements, then flat, needle-shaped and skewed ones, each in several degrees.
fn shapes(count: usize) -> Vec<Corners> {
    let mut random = Random(5);
    let mut shapes = Vec::new();
    for i in 0..count {
        let warped = random.warped(0.1 + 0.35 * (i as f64 / count as f64));
        let thin = 10f64.powf(-1.7 * (random.next() + 1.0) / 2.0);
        let shear = 3.0 * random.next();
        let form = match i % 4 {
            0 => Matrix3::identity(),
            1 => Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, thin)),
            2 => Matrix3::from_diagonal(&Vector3::new(1.0, thin, thin)),
            _ => Matrix3::new(1.0, 0.0, shear, 0.0, 1.0, 0.3 * shear, 0.0, 0.0, 1.0),
        };
        shapes.push(mapped(&warped, &(random.rotation() * form)));
    }
    shapes
}

/// Smallest ratio over shapes and Poisson's ratios.
fn worst(shapes: &[Corners], poisson: &[f64], hourglass: Hourglass) -> f64 {
    let ratios = shapes.iter().flat_map(|s| poisson.iter().map(|&nu| ratio(s, elastic(nu), hourglass, |_| ())));
    ratios.fold(f64::INFINITY, f64::min)
}

const POISSON: [f64; 4] = [-0.3, 0.0, 0.3, 0.49];
/// What differencing the forces leaves of the exact eigenvalue.
const NOISE: f64 = 1e-5;

#[test]
fn step_of_a_cube_and_of_plates() {
    let law = elastic(0.3);
    let c = (269.230_769_230_769e9 / DENSITY).sqrt();
    close("cube", bound(&CUBE, law.clone(), ASSUMED, |_| ()) * c, 1.0 / 3.0f64.sqrt(), 1e-12);
    // B:B V⁻² = ½ (1/h² + 2) for a square plate of edge 1 and thickness h.
    for thickness in [0.1f64, 0.02] {
        let expected = thickness / (1.0 + 2.0 * thickness * thickness).sqrt();
        let plate = mapped(&CUBE, &Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, thickness)));
        close("plate", bound(&plate, law.clone(), ASSUMED, |_| ()) * c, expected, 1e-12);
    }
    // The exact step of a cube is the smaller of L √(ρ/3K) and L √(ρ/2μ).
    for nu in [0.0, 0.3, 0.45, 0.499] {
        let m = elastic(nu).moduli();
        let gain = (3.0 * m.dilatational() / (3.0 * m.lambda + m.two_mu).max(m.two_mu)).sqrt();
        close("cube, exact over bound", ratio(&CUBE, elastic(nu), NONE, |_| ()), gain, NOISE);
    }
}

/// Flanagan and Belytschko's claim, for the element without hourglass control.
#[test]
fn one_point_element_never_exceeds_its_bound() {
    let worst = worst(&shapes(400), &POISSON, NONE);
    assert!(worst >= 1.0 - NOISE, "exact step over bound {worst}");
}

/// Parallelepipeds of any form, with the frame along their axes and, as after large deformation, elsewhere.
#[test]
fn parallelepipeds_never_exceed_the_bound() {
    let mut random = Random(6);
    for i in 0..200 {
        let turn = random.rotation();
        let sizes = Vector3::from(random.vector()).map(|e| 10f64.powf(-1.5 * e.abs()));
        let stretch = turn * Matrix3::from_diagonal(&sizes) * turn.transpose();
        let corners = mapped(&CUBE, &stretch);
        let poisson = POISSON[i % 4];
        for control in [ASSUMED, flanagan_belytschko(0.15), flanagan_belytschko(1.0)] {
            for own_axes in [true, false] {
                let frame = |rig: &mut Rig| {
                    if !own_axes {
                        (0..4).for_each(|k| rig.set_state(rows::FRAME + k, if k == 0 { 1.0 } else { 0.0 }));
                    }
                };
                let ratio = ratio(&corners, elastic(poisson), control, frame);
                assert!(ratio >= 1.0 - NOISE, "{control:?}, nu {poisson}, sizes {sizes:?}: {ratio}");
            }
        }
    }
}

/// In warped elements hourglass vectors are not orthogonal to the gradient operator. What that costs single elements
/// whose corners are displaced by up to 45 % of an edge, thin ones included: next to nothing for the usual
/// coefficients, and κ above 0.15 is looked after.
#[test]
fn warped_elements_with_hourglass_control() {
    let shapes = shapes(400);
    for (control, least) in [
        (flanagan_belytschko(0.05), 0.99),
        (flanagan_belytschko(0.15), 0.97),
        (flanagan_belytschko(0.5), 1.0),
        (flanagan_belytschko(1.0), 1.0),
        (ASSUMED, 0.95),
    ] {
        let worst = worst(&shapes, &POISSON, control);
        assert!(worst >= least - NOISE, "{control:?}: exact step over bound {worst}");
    }
}

/// The highest frequency of a mesh lies below that of its elements: what single warped elements lack, their
/// neighbours make up for.
#[test]
fn irregular_meshes_never_exceed_the_bound() {
    let mut random = Random(7);
    for control in [flanagan_belytschko(0.15), ASSUMED] {
        for (amplitude, thin) in [(0.1, 1.0), (0.2, 0.1), (0.3, 0.02), (0.3, 1.0)] {
            for _ in 0..3 {
                let ratio = assembled_ratio(&mut random, amplitude, thin, control);
                assert!(ratio >= 1.0, "{control:?}, {amplitude}, {thin}: {ratio}");
            }
        }
    }
}

/// Exact step of a mesh of 2 × 2 × 2 irregular elements over the smallest element bound.
fn assembled_ratio(random: &mut Random, amplitude: f64, thin: f64, control: Hourglass) -> f64 {
    let law = elastic(0.3);
    let id = |i: usize, j: usize, k: usize| i + 3 * j + 9 * k;
    let points: Vec<[f64; 3]> = (0..27)
        .map(|n| {
            let d = random.vector().map(|d| amplitude * d);
            [(n % 3) as f64 + d[0], (n / 3 % 3) as f64 + d[1], thin * ((n / 9) as f64 + d[2])]
        })
        .collect();
    let mut k = DMatrix::<f64>::zeros(81, 81);
    let mut mass = [0.0; 27];
    let mut smallest = f64::INFINITY;
    for cell in 0..8 {
        let nodes: [usize; 8] = CUBE.map(|c| {
            let [x, y, z] = c.map(|c| c as usize);
            id(cell % 2 + x, cell / 2 % 2 + y, cell / 4 + z)
        });
        let corners = nodes.map(|n| points[n]);
        smallest = smallest.min(bound(&corners, law.clone(), control, |_| ()));
        let own = stiffness(&corners, law.clone(), control, |_| ());
        for p in 0..24 {
            for q in 0..24 {
                k[(3 * nodes[p / 3] + p % 3, 3 * nodes[q / 3] + q % 3)] += 0.5 * (own[(p, q)] + own[(q, p)]);
            }
        }
        nodes.iter().for_each(|&n| mass[n] += DENSITY * volume(&corners) / 8.0);
    }
    for p in 0..81 {
        for q in 0..81 {
            k[(p, q)] /= (mass[p / 3] * mass[q / 3]).sqrt();
        }
    }
    2.0 / k.symmetric_eigenvalues().max().sqrt() / smallest
}

/// On a cube the highest viscous hourglass mode is damped with the force one half step behind; its free decay must
/// stay bounded at the step that the element allows and grow beyond 1.05 of it.
#[test]
fn viscous_hourglass_control_limits_the_step() {
    for viscosity in [0.03, 0.1, 0.3] {
        let control = Hourglass::FlanaganBelytschko { stiffness: 0.05, viscosity };
        let limit = bound(&CUBE, elastic(0.3), control, |_| ());
        let free = bound(&CUBE, elastic(0.3), NONE, |_| ());
        // √((λ+2μ)/2μ)/32 for ν = 0.3; just above it the elastic step no longer suffices.
        assert_eq!(viscosity > 0.0413, limit < 0.999 * free, "epsilon {viscosity}");
        let growth = |step: f64| {
            let mut rig = Rig::single(&CUBE, elastic(0.3), control);
            let mass = DENSITY / 8.0;
            let mut v = CUBE.map(|[x, y, z]| [1e-6 * (2.0 * x - 1.0) * (2.0 * y - 1.0) * (2.0 * z - 1.0), 0.0, 0.0]);
            for _ in 0..100 {
                rig.step(step, |n| v[n]);
                for n in 0..8 {
                    let f = rig.force(n);
                    (0..3).for_each(|i| v[n][i] -= step * f[i] / mass);
                }
            }
            v.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs())) / 1e-6
        };
        assert!(growth(0.999 * limit) < 10.0, "epsilon {viscosity}: grows by {}", growth(0.999 * limit));
        if limit < 0.9 * free {
            assert!(growth(1.05 * limit) > 1e3, "epsilon {viscosity}: limit is not sharp");
        }
    }
}

/// Bulk viscosity lowers the step as its damping ratio demands: √(1 + e²) − e.
#[test]
fn bulk_viscosity_takes_its_share_of_the_step() {
    let mut rig = Rig::single(&CUBE, elastic(0.3), ASSUMED);
    let free = rig.step(0.0, |_| [0.0; 3]).stable_step;
    rig.pass.bulk_viscosity = BulkViscosity { linear: 0.06, quadratic: 1.2 };
    let damped = rig.step(0.0, |_| [0.0; 3]).stable_step;
    close("linear", damped / free, (1.0f64 + 0.06 * 0.06).sqrt() - 0.06, 1e-12);
    // Compression at rate −r adds b₂² Δt̂ r, expansion nothing.
    let rate = 0.3 / free;
    let mut compressed = Rig::single(&CUBE, elastic(0.3), ASSUMED);
    compressed.pass.bulk_viscosity = rig.pass.bulk_viscosity;
    let found = compressed.step(1e-12, |n| [-rate * CUBE[n][0], 0.0, 0.0]);
    let e = 0.06f64 + 1.44 * 0.3;
    close("quadratic", found.stable_step / free, (1.0 + e * e).sqrt() - e, 1e-6);
    let q = -e * 269.230_769_230_769e9 * 0.3;
    close("q", compressed.state(rows::VISCOUS_STRESS), q, 1e-6 * q.abs());
}

/// With effective moduli the viscosity follows the modulus M̂ of the flowing element, so that b₁ stays its damping
/// ratio: q = b₁ M̂ Δt̂ tr D, where Δt̂ = √(ρ/3M̂) on a cube.
#[test]
fn bulk_viscosity_follows_effective_moduli() {
    let law = Law::ElasticPlastic(ElasticPlastic {
        young: 200e9,
        poisson: 0.3,
        yield_stress: 1e8,
        hardening: 0.0,
        beta: 1.0,
    });
    let rate = 1.0;
    let squeezed = |linear: f64| {
        let mut rig = Rig::single(&CUBE, law.clone(), ASSUMED);
        rig.pass.bulk_viscosity = BulkViscosity { linear, quadratic: 0.0 };
        rig.pass.moduli = StepModuli::Effective;
        let found = [2e-3, 1e-6].map(|step| rig.step(step, |n| [-rate * CUBE[n][0], 0.0, 0.0]).stable_step);
        (found[1], rig.state(rows::VISCOUS_STRESS))
    };
    let (free, _) = squeezed(0.0);
    let modulus = DENSITY / (3.0 * free * free);
    // Perfect plasticity in uniaxial strain: the bulk modulus alone is left.
    close("modulus", modulus, 200e9 / (3.0 * 0.4), 0.01 * modulus);
    let (damped, q) = squeezed(0.06);
    close("step", damped / free, (1.0f64 + 0.06 * 0.06).sqrt() - 0.06, 1e-9);
    close("q", q, -0.06 * modulus * free * rate, 0.01 * q.abs());
}
