//! What must hold for the rates and forces of any element, however warped.

use crate::common::vector::{add, cross, dot, scaled, subtract};
use crate::material::Moduli;
use crate::solver::elements::shell::facet::{Corners, Facet, Kind, Rates, Resultants};
use crate::solver::elements::shell::geometry::{Quadrilateral, RESISTANCES};
use crate::solver::elements::shell::stable_step::{Body, Stiffness, stable_step, weighted};
use crate::solver::elements::shell::triangle::Three;

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

    /// An element of edge 1 that is warped and skewed.
    pub fn warped<S: Kind<C, R>, const C: usize, const R: usize>(&mut self) -> Corners<f64, C> {
        S::PLAIN.map(|[x, y]| add([x, y, 0.0], scaled(self.vector(), 0.25)))
    }
}

/// Thickness where it is of no account, or of little.
const THICK: f64 = 0.1;

fn all<const R: usize>(rates: &Rates<f64, R>) -> Vec<f64> {
    let strains = [&rates.strain[..], &rates.curvature, &rates.shear];
    strains.concat().into_iter().chain(rates.resisted).collect()
}

fn rigid_motion<S: Kind<C, R>, const C: usize, const R: usize>() {
    let mut numbers = Numbers::new();
    for _ in 0..50 {
        let x = numbers.warped::<S, C, R>();
        let (move_by, turn) = (numbers.vector(), numbers.vector());
        let v = x.map(|x| add(move_by, cross(turn, x)));
        let rates = S::Facet::<f64>::new(&x, THICK).rates(&v, &[turn; C]);
        assert!(all(&rates).iter().all(|rate| rate.abs() < 1e-14), "{:?}", all(&rates));
    }
}

#[test]
fn rigid_motion_does_not_strain() {
    rigid_motion::<Quadrilateral, 4, RESISTANCES>();
    rigid_motion::<Three, 3, 4>();
}

/// Forces have the power of the resultants for any motion, so also no resultant and no moment.
fn transposed<S: Kind<C, R>, const C: usize, const R: usize>() {
    let mut numbers = Numbers::new();
    for _ in 0..50 {
        let x = numbers.warped::<S, C, R>();
        let geometry = S::Facet::<f64>::new(&x, THICK);
        let [v, omega] = [0; 2].map(|_| [0; C].map(|_| numbers.vector()));
        let s = Resultants {
            shear: [numbers.next(), numbers.next()],
            force: numbers.vector(),
            moment: numbers.vector(),
            resisted: [0; R].map(|_| numbers.next()),
        };
        let r = geometry.rates(&v, &omega);
        let plane = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + 2.0 * a[2] * b[2];
        let many = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let inside = plane(r.strain, s.force) + plane(r.curvature, s.moment) + many(&r.shear, &s.shear);
        let inside = inside + many(&r.resisted, &s.resisted);
        let [force, moment] = geometry.forces(&s);
        let outside: f64 = (0..C).map(|i| dot(force[i], v[i]) + dot(moment[i], omega[i])).sum();
        assert!((inside - outside).abs() < 1e-13, "{inside} {outside}");
        let sum = force.iter().fold([0.0; 3], |sum, f| add(sum, *f));
        let about = (0..C).fold([0.0; 3], |sum, i| add(sum, add(cross(x[i], force[i]), moment[i])));
        assert!(sum.iter().chain(&about).all(|c| c.abs() < 1e-13), "{sum:?} {about:?}");
    }
}

#[test]
fn forces_are_the_transpose_of_the_rates() {
    transposed::<Quadrilateral, 4, RESISTANCES>();
    transposed::<Three, 3, 4>();
}

/// A field that is affine in the plane of a warped element strains it as it should, and moves no hourglass field.
fn affine<S: Kind<C, R>, const C: usize, const R: usize>() {
    let mut numbers = Numbers::new();
    for _ in 0..20 {
        let x = numbers.warped::<S, C, R>();
        let geometry = S::Facet::<f64>::new(&x, THICK);
        let e = geometry.axes();
        let gradient = [0; 2].map(|_| [numbers.next(), numbers.next()]);
        let v = x.map(|x| {
            let at = [0, 1].map(|a: usize| dot(e[a], subtract(x, [0.5; 3])));
            (0..2).fold([0.0; 3], |v, a| add(v, scaled(e[a], gradient[a][0] * at[0] + gradient[a][1] * at[1])))
        });
        let rates = geometry.rates(&v, &[[0.0; 3]; C]);
        let [xx, yy, xy] = rates.strain;
        let exact = [gradient[0][0], gradient[1][1], 0.5 * (gradient[0][1] + gradient[1][0])];
        assert!([xx, yy, xy].iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-14));
        // Without rotations the drills see the field turn.
        let others = &rates.resisted[..R - C];
        assert!(others.iter().take(2).all(|rate| rate.abs() < 1e-14), "{others:?}");
    }
}

#[test]
fn affine_fields_in_the_plane_are_exact() {
    affine::<Quadrilateral, 4, RESISTANCES>();
    affine::<Three, 3, 4>();
}

const STEEL: Stiffness =
    Stiffness { moduli: Moduli { lambda: 1.2e11, two_mu: 1.6e11 }, bending: 1.0, shear_correction: 5.0 / 6.0 };

/// Highest frequency, from the corners' own matrix.
fn highest<S: Kind<C, R>, const C: usize, const R: usize, const W: usize>(x: &Corners<f64, C>, body: &Body) -> f64 {
    let corner = body.mass / C as f64;
    let geometry = S::Facet::<f64>::new(x, body.thickness);
    let over = [1.0 / corner.sqrt(), 1.0 / (corner * body.inertia).sqrt()];
    let columns: Vec<[f64; W]> = (0..6 * C)
        .map(|place| {
            let mut fields = [[[0.0; 3]; C]; 2];
            fields[place / (3 * C)][place % (3 * C) / 3][place % 3] = over[place / (3 * C)];
            weighted::<S, C, R, W>(&geometry, &fields, &STEEL, body)
        })
        .collect();
    let matrix = nalgebra::DMatrix::from_fn(W, 6 * C, |i, j| columns[j][i]);
    (&matrix * matrix.transpose()).symmetric_eigenvalues().max().sqrt()
}

/// The step is below that of the element's highest frequency, and not by more than a twelfth.
fn bounded<S: Kind<C, R>, const C: usize, const R: usize, const W: usize>() {
    let mut numbers = Numbers::new();
    for case in 0..200 {
        let x = numbers.warped::<S, C, R>();
        let thickness = 10f64.powf(-3.0 + 2.5 * f64::from(case % 7) / 6.0);
        let area = S::Facet::<f64>::new(&x, thickness).area();
        let inertia = (thickness * thickness / 12.0).max(area * S::INERTIA);
        let body = Body { mass: 7800.0 * area * thickness, inertia, thickness, drill: 0.1 };
        let step = stable_step::<S, C, R, W>(&x, &STEEL, &body);
        let exact = 2.0 / highest::<S, C, R, W>(&x, &body);
        assert!(step <= exact * (1.0 + 1e-12) && step > exact / 1.12, "{case}: {}", step / exact);
    }
}

#[test]
fn the_stable_step_is_a_bound_and_a_close_one() {
    bounded::<Quadrilateral, 4, RESISTANCES, 18>();
    bounded::<Three, 3, 4, 12>();
}
