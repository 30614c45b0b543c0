//! V-10: one material point on prescribed paths, against closed forms.

// Formulas run over indices of several arrays at once.
#![allow(clippy::needless_range_loop)]

use super::point::{IDENTITY, Point, close, sym};
use super::*;
use nalgebra::{Matrix3 as Matrix, Rotation3};

fn steel(beta: f64) -> Law {
    Law::ElasticPlastic(ElasticPlastic { young: 200e9, poisson: 0.3, yield_stress: 400e6, hardening: 2e9, beta })
}

/// Hardening rules with stress in MPa and equivalent plastic strain at +0.02, −0.02, +0.02.
const UNIAXIAL: [(f64, [f64; 3], [f64; 3]); 3] = [
    (0.0, [435.64, -435.64, 435.64], [0.01782, 0.05347, 0.08911]),
    (0.5, [435.64, -470.93, 505.88], [0.01782, 0.05329, 0.08841]),
    (1.0, [435.64, -506.23, 575.41], [0.01782, 0.05311, 0.08770]),
];

#[test]
fn uniaxial_stress_there_and_back() {
    for (beta, stresses, plastic_strains) in UNIAXIAL {
        let mut point = Point::new(steel(beta));
        for (leg, (from, to)) in [(0.0, 0.02), (0.02, -0.02), (-0.02, 0.02)].into_iter().enumerate() {
            for _ in 0..400 {
                point.stretch_freely((to - from) / 400.0);
            }
            close("stress", point.stress[0], 1e6 * stresses[leg], 1e-4);
            close("plastic strain", point.eqps(), plastic_strains[leg], 3e-4);
            assert!(point.stress[1].abs() < 1.0 && point.stress[3] == 0.0);
        }
    }
}

#[test]
fn simple_shear_there_and_back() {
    for (beta, back) in [(0.0, -262.00), (0.5, -292.80), (1.0, -323.59)] {
        let mut point = Point::new(steel(beta));
        for _ in 0..100 {
            point.strain([0.0, 0.0, 0.0, 0.5 * 0.05 / 100.0, 0.0, 0.0]);
        }
        close("shear stress", point.stress[3], 262.00e6, 1e-4);
        for _ in 0..100 {
            point.strain([0.0, 0.0, 0.0, -0.5 * 0.1 / 100.0, 0.0, 0.0]);
        }
        close("shear stress back", point.stress[3], back * 1e6, 1e-4);
    }
}

#[test]
fn uniaxial_strain() {
    for steps in [1, 100] {
        let mut point = Point::new(steel(1.0));
        for _ in 0..steps {
            point.strain([0.02 / f64::from(steps), 0.0, 0.0, 0.0, 0.0, 0.0]);
        }
        // On a straight path radial return is exact for any increment.
        close("axial stress", point.stress[0], 3615.3e6, 1e-4);
        close("lateral stress", point.stress[1], 3192.3e6, 1e-4);
        close("plastic strain", point.eqps(), 0.011_500, 1e-4);
    }
}

#[test]
fn elastic_law_is_that_of_hooke() {
    let mut point = Point::new(Law::Elastic(Elastic { young: 200e9, poisson: 0.3 }));
    point.strain([1e-3, 0.0, 0.0, 0.0, 2e-3, 0.0]);
    close("axial", point.stress[0], 269.230_769_23e6, 1e-10);
    close("lateral", point.stress[1], 115.384_615_38e6, 1e-10);
    close("shear", point.stress[4], 2.0 * 76.923_076_923e9 * 2e-3, 1e-10);
    assert_eq!(point.returned, 1.0);
}

/// A history seen from turned axes gives the turned stress and back stress.
#[test]
fn combined_hardening_is_objective() {
    let r = Rotation3::from_euler_angles(0.4, -0.9, 1.7).into_inner();
    let frame: Matrix3<f64> = std::array::from_fn(|i| std::array::from_fn(|j| r[(i, j)]));
    let full = |t: [f64; 6]| Matrix::from_fn(|i, j| sym(t).matrix()[i][j]);
    let flat = |m: Matrix<f64>| [m[(0, 0)], m[(1, 1)], m[(2, 2)], m[(0, 1)], m[(1, 2)], m[(2, 0)]];
    for beta in [0.0, 0.4, 1.0] {
        let (mut here, mut turned) = (Point::new(steel(beta)), Point::new(steel(beta)));
        for k in 0..200 {
            let t = f64::from(k) * 0.05;
            let d = [t.sin(), t.cos(), -0.4, (2.0 * t).sin(), 0.3 * (3.0 * t).cos(), 0.2].map(|c| 2e-4 * c);
            here.strain(d);
            // `turned` lives in axes that are the columns of r.
            turned.strain(flat(r.transpose() * full(d) * r));
        }
        let back = r * full(turned.stress) * r.transpose();
        assert!((back - full(here.stress)).amax() < 1e-3, "{:e}", (back - full(here.stress)).amax());
        for (a, b) in turned.plotted(&frame).into_iter().zip(here.plotted(&IDENTITY)) {
            assert!((a - b).abs() < 1e-3 + 1e-12 * b.abs(), "beta {beta}: {a:e}, {b:e}");
        }
    }
}

/// RADIUS is √⅔ (Y₀ + β H ε̄ᵖ), ALPHA the shift of its centre: together they hold the stress.
#[test]
fn plotted_state_describes_the_yield_surface() {
    for beta in [0.0, 0.25, 1.0] {
        let mut point = Point::new(steel(beta));
        for k in 0..50 {
            point.strain([2e-4, -1e-4, 0.0, 1e-4 * f64::from(k % 7), 0.0, 5e-5]);
        }
        let plotted = point.plotted(&IDENTITY);
        let names: Vec<_> = point.law.entry().state.iter().map(|v| v.name).collect();
        assert_eq!(names[..2], ["EQPS", "RADIUS"]);
        assert_eq!(names.len(), plotted.len());
        close("radius", plotted[1], (2.0f64 / 3.0).sqrt() * (400e6 + beta * 2e9 * plotted[0]), 1e-12);
        let alpha = sym(std::array::from_fn(|i| plotted[2 + i]));
        let xi = sym(point.stress).deviator().zip(alpha, |s, a| s - a);
        close("stress on the surface", xi.contract(xi).sqrt(), plotted[1], 1e-9);
        assert!(alpha.trace().abs() < 1e-3);
        if beta == 1.0 {
            assert_eq!(plotted[2..], [0.0; 6]);
        }
    }
}

/// The factor by which the return scaled the trial deviator is what hourglass control uses.
#[test]
fn returned_share_is_that_of_the_deviator() {
    let mut point = Point::new(steel(1.0));
    point.strain([1e-4, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(point.returned, 1.0);
    let before = sym(point.stress);
    point.strain([1e-2, -5e-3, -5e-3, 1e-3, 0.0, 0.0]);
    let m = point.law.moduli();
    let trial = before.deviator().zip(sym([1e-2, -5e-3, -5e-3, 1e-3, 0.0, 0.0]), |s, e| s + m.two_mu * e);
    close("factor", point.returned, sym(point.stress).deviator().xx / trial.xx, 1e-12);
    assert!(point.returned > 0.0 && point.returned < 1.0);
}

/// Extreme 22 and the like: no strength, no hardening, no strain, huge strains, never a NaN.
#[test]
fn return_is_safe_at_the_limits() {
    let limits = [(0.0, 0.0), (0.0, 2e9), (400e6, 0.0), (1e-300, 0.0), (400e6, 1e15)];
    for (yield_stress, hardening) in limits {
        for beta in [0.0, 0.5, 1.0] {
            let law = Law::ElasticPlastic(ElasticPlastic { young: 200e9, poisson: 0.3, yield_stress, hardening, beta });
            for size in [0.0, 1e-320, 1e-160, 1e-12, 1.0, 1e6, 1e60] {
                let mut point = Point::new(law.clone());
                for _ in 0..3 {
                    point.strain([size, -0.3 * size, 0.1 * size, 0.5 * size, 0.0, -size]);
                    assert!(point.stress.iter().all(|s| s.is_finite()), "{law:?}, {size}: {:?}", point.stress);
                    assert!(point.plotted(&IDENTITY).iter().all(|s| s.is_finite()));
                    assert!((0.0..=1.0).contains(&point.returned), "{law:?}, {size}: {}", point.returned);
                    assert!(point.eqps() >= 0.0);
                }
            }
        }
    }
    // A fluid: pressure and nothing else.
    let mut fluid = Point::new(Law::ElasticPlastic(ElasticPlastic {
        young: 200e9,
        poisson: 0.3,
        yield_stress: 0.0,
        hardening: 0.0,
        beta: 1.0,
    }));
    fluid.strain([-1e-3, 0.0, 0.0, 2e-3, 0.0, 0.0]);
    let pressure = 200e9 / (3.0 * 0.4) * 1e-3;
    for i in 0..3 {
        close("pressure", -fluid.stress[i], pressure, 1e-12);
    }
    assert_eq!(fluid.stress[3..], [0.0; 3]);
}

/// Moduli from E and ν and back.
#[test]
fn moduli_of_steel() {
    let m = Moduli::from_young(200e9, 0.3);
    close("lambda", m.lambda, 115.384_615_384_6e9, 1e-12);
    close("2 mu", m.two_mu, 153.846_153_846_2e9, 1e-12);
    close("dilatational", m.dilatational(), 269.230_769_230_8e9, 1e-12);
    close("nu", m.poisson(), 0.3, 1e-12);
}
