//! A single material point on a prescribed path: what the tests of all laws are made with.

use super::{
    EQUATIONS_OF_STATE, Entry, EquationOfState, Given, Kernel, KernelVisitor, Law, MATERIALS, Property, Response,
    Start, Step,
};
use crate::lanes::{Lanes, Matrix3, Pair, Row, Sym3};
use nalgebra::{Matrix3 as Matrix, SymmetricEigen};

pub(super) type Tensor = [f64; 6];

pub(super) fn sym([xx, yy, zz, xy, yz, zx]: Tensor) -> Sym3<f64> {
    Sym3 { xx, yy, zz, xy, yz, zx }
}

pub(super) fn full(t: Tensor) -> Matrix<f64> {
    let m = sym(t).matrix();
    Matrix::from_fn(|i, j| m[i][j])
}

pub(super) fn flat(m: Matrix<f64>) -> Tensor {
    [m[(0, 0)], m[(1, 1)], m[(2, 2)], m[(0, 1)], m[(1, 2)], m[(2, 0)]]
}

pub(super) const IDENTITY: Matrix3<f64> = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Step<f64> {
    /// A small increment from a point at rest, for laws that look at nothing else.
    pub(super) fn of(strain: Tensor) -> Step<f64> {
        let none = sym([0.0; 6]);
        let [volume, middle_volume, energy, swept, time, time_step] = [1.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        Step { strain: sym(strain), biot_strain: none, volume, middle_volume, energy, swept, time, time_step }
    }
}

/// Asserts that two numbers differ by no more than a part of the second.
#[track_caller]
pub(super) fn close(what: &str, a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{what}: {a:e} instead of {b:e}, off by {:e}", a / b - 1.0);
}

/// Values of an entry's properties from those given by keyword, and defaults.
#[track_caller]
fn values<T>(entry: &Entry<T>, given: &[(&str, f64)]) -> Vec<f64> {
    for (keyword, _) in given {
        assert!(entry.properties.iter().any(|p| p.keyword == *keyword), "{} has no {keyword}", entry.name);
    }
    let value = |p: &Property| {
        let value = given.iter().find(|(keyword, _)| *keyword == p.keyword).map(|(_, value)| *value);
        value.or(p.default).unwrap_or_else(|| panic!("{} is missing", p.keyword))
    };
    entry.properties.iter().map(value).collect()
}

/// The law of a table entry, made as a deck makes it: its properties by keyword, functions by number.
#[track_caller]
pub(super) fn made(name: &str, density: f64, given: &[(&str, f64)], functions: &[(i64, &[(f64, f64)])]) -> Law {
    let entry = MATERIALS.iter().find(|entry| entry.name == name).expect("a law of this name");
    let values = values(entry, given);
    let function = |id| functions.iter().find(|f| f.0 == id).map(|f| f.1.to_vec());
    let given = Given { function: &function, ..Given::new(&values, density) };
    (entry.build)(&given).unwrap_or_else(|refusal| panic!("{} {}", refusal.keyword, refusal.reason))
}

/// An equation of state by name and properties.
#[track_caller]
pub(super) fn equation(name: &str, density: f64, given: &[(&str, f64)]) -> EquationOfState {
    let entry = EQUATIONS_OF_STATE.iter().find(|entry| entry.name == name).expect("an equation of this name");
    let given = values(entry, given);
    (entry.build)(&Given::new(&given, density))
        .unwrap_or_else(|refusal| panic!("{} {}", refusal.keyword, refusal.reason))
}

/// Stress, stored state and motion of one point, driven by strain increments.
#[derive(Clone)]
pub(super) struct Point {
    pub law: Law,
    pub stress: Tensor,
    pub stored: Vec<Row>,
    /// Factor of the last return.
    pub returned: f64,
    /// λ + 2μ of the last step, for laws that say it.
    pub dilatational: f64,
    /// Modulus of the last answer, for laws that crush.
    pub answering: f64,
    /// Right stretch.
    pub stretch: Matrix<f64>,
    /// Internal energy per initial volume, by the trapezoidal rule.
    pub energy: f64,
    /// Bulk viscosity that acts on the point, as a mean stress, and the energy that it gave.
    pub viscous: f64,
    pub time: f64,
    /// Duration of every increment.
    pub time_step: f64,
}

/// One increment, carried to the law's kernel: in the only lane, and once more in the second of two, which must agree.
struct Increment<'a>(&'a mut Point, Tensor);

impl KernelVisitor for Increment<'_> {
    type Output = ();
    fn visit<K: Kernel>(self, kernel: K) {
        let Increment(point, strain) = self;
        let half = exponential(0.5 * full(strain));
        let middle = (half * point.stretch).determinant();
        let stretch = half * half * point.stretch;
        point.stretch = 0.5 * (stretch + stretch.transpose());
        let mean_of_start = sym(point.stress).zip(sym([0.0; 6]), |a, b| 0.5 * (a + b)).add_diagonal(point.viscous);
        let step = Step {
            strain: sym(strain),
            biot_strain: sym(flat(point.stretch)).add_diagonal(-1.0),
            volume: if K::VOLUME { point.stretch.determinant() } else { f64::NAN },
            middle_volume: middle,
            energy: point.energy + mean_of_start.contract(sym(strain)) * middle,
            swept: sym(strain).trace() * middle,
            time: point.time,
            time_step: point.time_step,
        };
        let mut pair_stored = point.stored.clone();
        for row in &mut pair_stored {
            row.0[1] = row.0[0];
        }
        let mut pair_stress = spread(sym(point.stress));
        let pair_response = kernel.update::<Pair<f64>>(&pairs(&step), &mut pair_stress, &mut pair_stored, 0);
        let mut stress = sym(point.stress);
        let Response { returned, stiffness, answering } =
            kernel.update::<f64>(&step, &mut stress, &mut point.stored, 0);
        (point.returned, point.dilatational, point.answering) = (returned, stiffness.dilatational, answering);
        for (one, two) in stress.to_array().into_iter().zip(pair_stress.to_array()) {
            let mut row = Row::default();
            two.store(&mut row, 0);
            assert!(row.0[1].to_bits() == one.to_bits() || one.is_nan(), "lanes disagree: {one:e}, {:e}", row.0[1]);
        }
        let mut row = Row::default();
        pair_response.returned.store(&mut row, 0);
        assert!(row.0[1].to_bits() == returned.to_bits() || returned.is_nan());
        let mean = sym(point.stress).zip(stress, |a, b| 0.5 * (a + b)).add_diagonal(point.viscous);
        point.energy += mean.contract(sym(strain)) * middle;
        point.stress = stress.to_array();
    }
}

fn spread(t: Sym3<f64>) -> Sym3<Pair<f64>> {
    let [xx, yy, zz, xy, yz, zx] = t.to_array().map(Pair::splat);
    Sym3 { xx, yy, zz, xy, yz, zx }
}

fn pairs(step: &Step<f64>) -> Step<Pair<f64>> {
    Step {
        strain: spread(step.strain),
        biot_strain: spread(step.biot_strain),
        volume: Pair::splat(step.volume),
        middle_volume: Pair::splat(step.middle_volume),
        energy: Pair::splat(step.energy),
        swept: Pair::splat(step.swept),
        time: step.time,
        time_step: step.time_step,
    }
}

fn exponential(m: Matrix<f64>) -> Matrix<f64> {
    let eigen = SymmetricEigen::new(m);
    eigen.eigenvectors * Matrix::from_diagonal(&eigen.eigenvalues.map(libm::exp)) * eigen.eigenvectors.transpose()
}

impl Point {
    /// Unstressed, at time zero, in a frame along the axes; one time unit per increment.
    pub fn new(law: Law) -> Point {
        let start = law.start(&Start { centre: [0.0; 3], length: 1.0, frame: IDENTITY });
        Point {
            law,
            stress: [0.0; 6],
            stored: start.into_iter().map(|x| Row([x; 8])).collect(),
            returned: 1.0,
            dilatational: f64::NAN,
            answering: f64::NAN,
            stretch: Matrix::identity(),
            energy: 0.0,
            viscous: 0.0,
            time: 0.0,
            time_step: 1.0,
        }
    }

    pub fn strain(&mut self, increment: Tensor) {
        self.time += self.time_step;
        let law = self.law.clone();
        law.accept(Increment(self, increment));
    }

    /// A straight path of so many increments.
    pub fn strain_in(&mut self, steps: usize, total: Tensor) {
        for _ in 0..steps {
            self.strain(total.map(|c| c / steps as f64));
        }
    }

    /// One axial increment with the lateral strain that leaves no lateral stress, found by secants.
    pub fn stretch_freely(&mut self, axial: f64) {
        let lateral_stress = |lateral: f64| {
            let mut trial = self.clone();
            trial.strain([axial, lateral, lateral, 0.0, 0.0, 0.0]);
            trial.stress[1]
        };
        let (mut a, mut b) = (-0.3 * axial, -0.5 * axial);
        let (mut fa, mut fb) = (lateral_stress(a), lateral_stress(b));
        for _ in 0..30 {
            if fb == fa || fb.abs() < 1e-3 {
                break;
            }
            let c = b - fb * (b - a) / (fb - fa);
            (a, fa) = (b, fb);
            (b, fb) = (c, lateral_stress(c));
        }
        self.strain([axial, b, b, 0.0, 0.0, 0.0]);
    }

    /// The first stored variable, by habit the equivalent plastic strain.
    pub fn eqps(&self) -> f64 {
        self.stored[0].0[0]
    }

    /// State variables as plotted, in a frame.
    pub fn plotted(&self, frame: &Matrix3<f64>) -> Vec<f64> {
        let stored: Vec<f64> = self.stored.iter().map(|row| row.0[0]).collect();
        self.law.state(&stored, frame)
    }

    /// A state variable by its name in the plot file.
    #[track_caller]
    pub fn state(&self, name: &str) -> f64 {
        let at = self.law.entry().state.iter().position(|v| v.name == name).expect("a state variable of this name");
        self.plotted(&IDENTITY)[at]
    }

    pub fn mean(&self) -> f64 {
        sym(self.stress).trace() / 3.0
    }

    pub fn von_mises(&self) -> f64 {
        let s = sym(self.stress).deviator();
        (1.5 * s.contract(s)).sqrt()
    }

    #[track_caller]
    pub fn assert_finite(&self) {
        assert!(self.stress.iter().all(|s| s.is_finite()), "{:?}: {:?}", self.law, self.stress);
        assert!(self.plotted(&IDENTITY).iter().all(|s| s.is_finite()), "{:?}: {:?}", self.law, self.stored);
        assert!((0.0..=1.0).contains(&self.returned), "{:?}: returned {}", self.law, self.returned);
    }
}
