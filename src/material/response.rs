//! How a law answers to simple motions of one element: for a look at a law before anything is run.

use super::{Kernel, KernelVisitor, Law, Response, Start, Step};
use crate::lanes::{Row, Sym3};
use nalgebra::{Matrix3, SymmetricEigen};

/// A motion along a straight path of strains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Motion {
    /// Along x, with sides that are free of stress in the mean.
    Tension,
    /// The same against x.
    Compression,
    /// Against x, with sides that are held.
    Confined,
    /// In the plane of x and y.
    Shear,
}

impl Motion {
    /// All motions with their names.
    pub const ALL: [(Motion, &'static str); 4] = [
        (Motion::Tension, "tension, free sides"),
        (Motion::Compression, "compression, free sides"),
        (Motion::Confined, "compression, held sides"),
        (Motion::Shear, "shear"),
    ];
}

/// Increments of a path.
const STEPS: u32 = 500;
/// Secants for the strain of the sides, and what is left of their stress, relative to the axial one.
const SECANTS: usize = 40;
const FREE: f64 = 1e-9;

/// Size of the strain and of the stress that belongs to it (force/length²), from zero to the largest strain at a rate
/// (1/time). The curve ends early where the law has no numbers. Logarithmic strain; in shear the tensor's, half of the
/// angle.
pub fn curve(law: &Law, motion: Motion, largest: f64, rate: f64) -> Vec<[f64; 2]> {
    let mut point = Point::new(law.clone(), largest / f64::from(STEPS) / rate);
    let mut curve = vec![[0.0, 0.0]];
    let increment = largest / f64::from(STEPS);
    for step in 1..=STEPS {
        let stress = match motion {
            Motion::Tension => point.stretch_freely(increment),
            Motion::Compression => point.stretch_freely(-increment).map(|stress| -stress),
            Motion::Confined => {
                point.strain([-increment, 0.0, 0.0, 0.0, 0.0, 0.0]);
                Some(-point.stress[0])
            }
            Motion::Shear => {
                point.strain([0.0, 0.0, 0.0, increment, 0.0, 0.0]);
                Some(point.stress[3])
            }
        };
        match stress.filter(|stress| stress.is_finite()) {
            Some(stress) => curve.push([f64::from(step) * increment, stress]),
            None => break,
        }
    }
    curve
}

/// Stress, stored state and motion of one material point.
#[derive(Clone)]
struct Point {
    law: Law,
    stress: [f64; 6],
    stored: Vec<Row>,
    /// Right stretch.
    stretch: Matrix3<f64>,
    /// Internal energy per initial volume.
    energy: f64,
    time: f64,
    time_step: f64,
}

impl Point {
    fn new(law: Law, time_step: f64) -> Point {
        let frame = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let start = law.start(&Start { centre: [0.0; 3], length: 1.0, frame });
        let stored = start.into_iter().map(|value| Row([value; 8])).collect();
        Point { law, stress: [0.0; 6], stored, stretch: Matrix3::identity(), energy: 0.0, time: 0.0, time_step }
    }

    fn strain(&mut self, increment: [f64; 6]) {
        self.time += self.time_step;
        let law = self.law.clone();
        law.accept(Increment(self, increment));
    }

    /// A strain along x with such strains of the sides that their mean stress is zero; the stress along x. `None` where no
    /// strain of the sides is found.
    fn stretch_freely(&mut self, axial: f64) -> Option<f64> {
        let tried = |point: &Point, side: f64| {
            let mut trial = point.clone();
            trial.strain([axial, side, side, 0.0, 0.0, 0.0]);
            let sides = 0.5 * (trial.stress[1] + trial.stress[2]);
            (trial, sides)
        };
        let (mut a, mut b) = (-0.3 * axial, -0.5 * axial);
        let mut at_a = tried(self, a).1;
        for _ in 0..SECANTS {
            let (trial, at_b) = tried(self, b);
            if at_b.abs() <= FREE * trial.stress[0].abs() || at_a == at_b {
                *self = trial;
                return Some(self.stress[0]);
            }
            let next = b - at_b * (b - a) / (at_b - at_a);
            (a, at_a, b) = (b, at_b, next);
            if !next.is_finite() {
                return None;
            }
        }
        None
    }
}

/// One increment, carried to the law's kernel.
struct Increment<'a>(&'a mut Point, [f64; 6]);

impl KernelVisitor for Increment<'_> {
    type Output = ();
    fn visit<K: Kernel>(self, kernel: K) {
        let Increment(point, [xx, yy, zz, xy, yz, zx]) = self;
        let strain = Sym3 { xx, yy, zz, xy, yz, zx };
        let full = Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz);
        let half = exponential(0.5 * full);
        let middle = (half * point.stretch).determinant();
        let turned = half * half * point.stretch;
        point.stretch = 0.5 * (turned + turned.transpose());
        let u = &point.stretch;
        let [xx, yy, zz, xy, yz, zx] = point.stress;
        let before = Sym3 { xx, yy, zz, xy, yz, zx };
        let step = Step {
            strain,
            biot_strain: Sym3 {
                xx: u[(0, 0)],
                yy: u[(1, 1)],
                zz: u[(2, 2)],
                xy: u[(0, 1)],
                yz: u[(1, 2)],
                zx: u[(2, 0)],
            }
            .add_diagonal(-1.0),
            volume: if K::VOLUME { u.determinant() } else { 1.0 },
            middle_volume: middle,
            energy: point.energy + 0.5 * before.contract(strain) * middle,
            swept: strain.trace() * middle,
            time: point.time,
            time_step: point.time_step,
        };
        let mut stress = before;
        let _: Response<f64> = kernel.update::<f64>(&step, &mut stress, &mut point.stored, 0);
        point.energy += before.zip(stress, |a, b| 0.5 * (a + b)).contract(strain) * middle;
        point.stress = stress.to_array();
    }
}

fn exponential(m: Matrix3<f64>) -> Matrix3<f64> {
    let eigen = SymmetricEigen::new(m);
    eigen.eigenvectors * Matrix3::from_diagonal(&eigen.eigenvalues.map(libm::exp)) * eigen.eigenvectors.transpose()
}

#[cfg(test)]
mod tests {
    use super::super::point::{close, made};
    use super::*;

    #[test]
    fn an_elastic_law_answers_with_its_moduli() {
        let law = made("ELASTIC", 1.0, &[("YOUNGS MODULUS", 200.0), ("POISSONS RATIO", 0.25)], &[]);
        let end = |motion| curve(&law, motion, 0.01, 1.0).last().map_or(f64::NAN, |end| end[1]);
        close("free", end(Motion::Tension), 200.0 * 0.01, 1e-7);
        close("free", end(Motion::Compression), 200.0 * 0.01, 1e-7);
        close("held", end(Motion::Confined), 240.0 * 0.01, 1e-12);
        close("shear", end(Motion::Shear), 2.0 * 80.0 * 0.01, 1e-12);
    }

    #[test]
    fn plastic_and_rate_dependent_laws_are_followed() {
        let given = [("YOUNGS MODULUS", 200e3), ("POISSONS RATIO", 0.3), ("YIELD STRESS", 300.0)];
        let hardening = [("HARDENING MODULUS", 1000.0), ("BETA", 1.0)];
        let law = made("ELASTIC PLASTIC", 1.0, &[&given[..], &hardening[..]].concat(), &[]);
        let found = curve(&law, Motion::Tension, 0.5, 1.0);
        // Total strain is elastic and plastic: s = (300 + 1000 e)/(1 + 1000/200e3).
        close("tension", found.last().map_or(f64::NAN, |end| end[1]), (300.0 + 500.0) / 1.005, 1e-4);
        assert_eq!(found.len(), STEPS as usize + 1);
    }
}
