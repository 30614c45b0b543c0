//! What must hold for the rates and forces of any element, however warped.

use crate::material::Moduli;
use crate::solver::elements::shell::geometry::{Corners, Geometry, Rates, Resultants};
use crate::solver::elements::shell::stable_step::{Body, Stiffness, stable_step};
use crate::vector::{add, cross, dot, scaled, subtract};

/// A generator of numbers from −1 to 1.
pub struct Numbers(u64);

impl Numbers {
    pub fn new() -> Numbers {
        Numbers(42)
    }

    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.next())
    }

    /// A quadrilateral of edge 1 that is warped and skewed.
    pub fn warped(&mut self) -> Corners<f64> {
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| add([x, y, 0.0], scaled(self.vector(), 0.25)))
    }
}

fn all(rates: &Rates<f64>) -> Vec<f64> {
    let planes = [&rates.strain[..], &rates.curvature, &rates.shear, &rates.membrane, &rates.bending, &rates.twist];
    planes.concat().into_iter().chain(rates.drill).collect()
}

#[test]
fn rigid_motion_does_not_strain() {
    let mut numbers = Numbers::new();
    for _ in 0..50 {
        let x = numbers.warped();
        let (move_by, turn) = (numbers.vector(), numbers.vector());
        let v = x.map(|x| add(move_by, cross(turn, x)));
        let rates = Geometry::new(&x).rates(&v, &[turn; 4]);
        assert!(all(&rates).iter().all(|rate| rate.abs() < 1e-14), "{:?}", all(&rates));
    }
}

/// Forces have the power of the resultants for any motion, so also no resultant and no moment.
#[test]
fn forces_are_the_transpose_of_the_rates() {
    let mut numbers = Numbers::new();
    for _ in 0..50 {
        let x = numbers.warped();
        let geometry = Geometry::new(&x);
        let [v, omega] = [0; 2].map(|_| [0; 4].map(|_| numbers.vector()));
        let mut pair = || [numbers.next(), numbers.next()];
        let s = Resultants {
            shear: pair(),
            membrane: pair(),
            bending: pair(),
            twist: pair(),
            force: [numbers.next(), numbers.next(), numbers.next()],
            moment: numbers.vector(),
            drill: [0; 4].map(|_| numbers.next()),
        };
        let r = geometry.rates(&v, &omega);
        let plane = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + 2.0 * a[2] * b[2];
        let two = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let drill: f64 = (0..4).map(|i| r.drill[i] * s.drill[i]).sum();
        let inside = plane(r.strain, s.force) + plane(r.curvature, s.moment) + two(r.shear, s.shear) + drill;
        let inside = inside + two(r.membrane, s.membrane) + two(r.bending, s.bending) + two(r.twist, s.twist);
        let [force, moment] = geometry.forces(&s);
        let outside: f64 = (0..4).map(|i| dot(force[i], v[i]) + dot(moment[i], omega[i])).sum();
        assert!((inside - outside).abs() < 1e-13, "{inside} {outside}");
        let sum = force.iter().fold([0.0; 3], |sum, f| add(sum, *f));
        let about = (0..4).fold([0.0; 3], |sum, i| add(sum, add(cross(x[i], force[i]), moment[i])));
        assert!(sum.iter().chain(&about).all(|c| c.abs() < 1e-13), "{sum:?} {about:?}");
    }
}

/// A field that is affine in the plane of a warped element strains it as it should, and moves no hourglass field.
#[test]
fn affine_fields_in_the_plane_are_exact() {
    let mut numbers = Numbers::new();
    for _ in 0..20 {
        let x = numbers.warped();
        let geometry = Geometry::new(&x);
        let gradient = [0; 2].map(|_| [numbers.next(), numbers.next()]);
        let v = x.map(|x| {
            let at = [0, 1].map(|a: usize| dot(geometry.e[a], subtract(x, [0.5; 3])));
            (0..2).fold([0.0; 3], |v, a| add(v, scaled(geometry.e[a], gradient[a][0] * at[0] + gradient[a][1] * at[1])))
        });
        let rates = geometry.rates(&v, &[[0.0; 3]; 4]);
        let [xx, yy, xy] = rates.strain;
        let exact = [gradient[0][0], gradient[1][1], 0.5 * (gradient[0][1] + gradient[1][0])];
        assert!([xx, yy, xy].iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-14));
        assert!(rates.membrane.iter().all(|rate| rate.abs() < 1e-14), "{:?}", rates.membrane);
    }
}

const STEEL: Stiffness =
    Stiffness { moduli: Moduli { lambda: 1.2e11, two_mu: 1.6e11 }, bending: 1.0, shear_correction: 5.0 / 6.0 };

/// Highest frequency by the power method on the corners' own matrix.
fn highest(x: &Corners<f64>, body: &Body) -> f64 {
    let corner = 0.25 * body.mass;
    let geometry = Geometry::new(x);
    let over = [1.0 / corner.sqrt(), 1.0 / (corner * body.inertia).sqrt()];
    let columns: Vec<Vec<f64>> = (0..24)
        .map(|place| {
            let mut fields = [[[0.0; 3]; 4]; 2];
            fields[place / 12][place % 12 / 3][place % 3] = over[place / 12];
            super::super::stable_step::weighted_for_tests(&geometry, &fields, &STEEL, body)
        })
        .collect();
    let matrix = nalgebra::DMatrix::from_fn(18, 24, |i, j| columns[j][i]);
    (&matrix * matrix.transpose()).symmetric_eigenvalues().max().sqrt()
}

/// The step is below that of the element's highest frequency, and not by more than a twelfth.
#[test]
fn the_stable_step_is_a_bound_and_a_close_one() {
    let mut numbers = Numbers::new();
    for case in 0..200 {
        let x = numbers.warped();
        let thickness = 10f64.powf(-3.0 + 2.5 * f64::from(case % 7) / 6.0);
        let area = Geometry::new(&x).area;
        let inertia = (thickness * thickness / 12.0).max(area / 8.0);
        let body = Body { mass: 7800.0 * area * thickness, inertia, thickness, drill: 0.1 };
        let (step, exact) = (stable_step(&x, &STEEL, &body), 2.0 / highest(&x, &body));
        assert!(step <= exact * (1.0 + 1e-12) && step > exact / 1.12, "{case}: {}", step / exact);
    }
}
