//! Small displacements: the stiffness of whole structures, put together from the element's own rates, and problems with known
//! answers.

use crate::material::Moduli;
use crate::solver::elements::shell::geometry::{Corners, Geometry};
use crate::solver::elements::shell::stable_step::{Body, Stiffness, weighted_for_tests};
use nalgebra::{DMatrix, DVector};

/// A structure of shells: nodes, elements, thickness, elastic constants.
struct Structure {
    nodes: Vec<[f64; 3]>,
    shells: Vec<[usize; 4]>,
    thickness: f64,
    young: f64,
    poisson: f64,
}

/// A mesh of m × n shells over a map of the unit square.
fn mapped([m, n]: [usize; 2], at: impl Fn(f64, f64) -> [f64; 3]) -> (Vec<[f64; 3]>, Vec<[usize; 4]>) {
    let node = |i: usize, j: usize| j * (m + 1) + i;
    let places = (0..=n).flat_map(|j| (0..=m).map(move |i| (i, j)));
    let nodes = places.map(|(i, j)| at(i as f64 / m as f64, j as f64 / n as f64)).collect();
    let cells = (0..n).flat_map(|j| (0..m).map(move |i| (i, j)));
    (nodes, cells.map(|(i, j)| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]).collect())
}

impl Structure {
    fn new(cells: [usize; 2], [thickness, young, poisson]: [f64; 3], at: impl Fn(f64, f64) -> [f64; 3]) -> Structure {
        let (nodes, shells) = mapped(cells, at);
        Structure { nodes, shells, thickness, young, poisson }
    }

    fn stiffness(&self) -> DMatrix<f64> {
        let moduli = Moduli::from_young(self.young, self.poisson);
        let stiffness = Stiffness { moduli, bending: 1.0, shear_correction: 5.0 / 6.0 };
        let body = Body { mass: 4.0, inertia: 1.0, thickness: self.thickness, drill: 0.01 };
        let mut matrix = DMatrix::zeros(6 * self.nodes.len(), 6 * self.nodes.len());
        for shell in &self.shells {
            let corners: Corners<f64> = shell.map(|node| self.nodes[node]);
            let geometry = Geometry::new(&corners);
            let place = |dof: usize| 6 * shell[dof % 12 / 3] + 3 * (dof / 12) + dof % 3;
            let columns: Vec<Vec<f64>> = (0..24)
                .map(|dof| {
                    let mut fields = [[[0.0; 3]; 4]; 2];
                    fields[dof / 12][dof % 12 / 3][dof % 3] = 1.0;
                    weighted_for_tests(&geometry, &fields, &stiffness, &body)
                })
                .collect();
            for a in 0..24 {
                for b in 0..24 {
                    let entry: f64 = columns[a].iter().zip(&columns[b]).map(|(x, y)| x * y).sum();
                    matrix[(place(a), place(b))] += entry;
                }
            }
        }
        matrix
    }

    /// Displacements and rotations under forces, with some of them given; six numbers a node.
    fn solve(&self, forces: &[(usize, f64)], given: impl Fn(usize, [f64; 3]) -> [Option<f64>; 6]) -> Vec<f64> {
        let matrix = self.stiffness();
        let known: Vec<Option<f64>> = self.nodes.iter().enumerate().flat_map(|(n, x)| given(n, *x)).collect();
        let free: Vec<usize> = (0..known.len()).filter(|&dof| known[dof].is_none()).collect();
        let mut right = DVector::zeros(known.len());
        forces.iter().for_each(|&(dof, force)| right[dof] += force);
        let value = DVector::from_iterator(known.len(), known.iter().map(|value| value.unwrap_or(0.0)));
        let rest = &right - &matrix * &value;
        let reduced = matrix.select_rows(&free).select_columns(&free);
        let found = reduced.cholesky().expect("a stiffness without zero modes").solve(&rest.select_rows(&free));
        let mut all: Vec<f64> = value.iter().copied().collect();
        free.iter().zip(found.iter()).for_each(|(&dof, value)| all[dof] = *value);
        all
    }
}

fn ratio(what: &str, found: f64, expected: f64, tolerance: f64) {
    println!("{what}: {found:e}, {:.4} of {expected:e}", found / expected);
    assert!((found / expected - 1.0).abs() < tolerance, "{what}: {:.4} of {expected:e}", found / expected);
}

/// V-14: MacNeal and Harder's beam, twisted by 90 degrees, under a force at its tip in its plane and out of it. The thin one is
/// that of Belytschko, Wong and Chiang.
#[test]
fn v14_twisted_beam() {
    let twisted = |cells: [usize; 2], thickness: f64| {
        Structure::new(cells, [thickness, 29e6, 0.22], |s, r| {
            let (angle, y) = (std::f64::consts::FRAC_PI_2 * s, 1.1 * (r - 0.5));
            [12.0 * s, y * angle.cos(), y * angle.sin()]
        })
    };
    // At the tip the width stands along z.
    for (cells, thickness, load, along_z, along_y, tolerance) in [
        ([12, 2], 0.32, 1.0, 5.424e-3, 1.754e-3, 0.03),
        ([24, 4], 0.32, 1.0, 5.424e-3, 1.754e-3, 0.02),
        ([12, 2], 0.0032, 1e-6, 5.256e-3, 1.294e-3, 0.03),
    ] {
        let beam = twisted(cells, thickness);
        for (axis, expected) in [(2, along_z), (1, along_y)] {
            let tip: Vec<usize> = (0..beam.nodes.len()).filter(|&n| beam.nodes[n][0] > 11.999).collect();
            let edge = |n: usize| beam.nodes[n][2].abs() > 0.5499;
            let share = |n: usize| load * if edge(n) { 0.5 } else { 1.0 } / cells[1] as f64;
            let forces: Vec<(usize, f64)> = tip.iter().map(|&n| (6 * n + axis, share(n))).collect();
            let found = beam.solve(&forces, |_, x| [(x[0] < 1e-9).then_some(0.0); 6]);
            let deflection = found[6 * tip[cells[1] / 2] + axis];
            ratio(&format!("V-14 {cells:?} t {thickness} axis {axis}"), deflection, expected, tolerance);
        }
    }
}

/// Constant membrane strain and constant bending are exact on a flat mesh however irregular.
#[test]
fn patch_tests_of_membrane_and_bending() {
    let (young, poisson) = (1e6, 0.25);
    let patch = Structure {
        nodes: [
            [0.0, 0.0],
            [0.24, 0.0],
            [0.24, 0.12],
            [0.0, 0.12],
            [0.04, 0.02],
            [0.18, 0.03],
            [0.16, 0.08],
            [0.08, 0.08],
        ]
        .map(|[x, y]| [x, y, 0.0])
        .to_vec(),
        shells: vec![[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]],
        thickness: 0.001,
        young,
        poisson,
    };
    let membrane = |x: [f64; 3]| [1e-3 * (x[0] + x[1] / 2.0), 1e-3 * (x[1] + x[0] / 2.0), 0.0, 0.0, 0.0, 0.0];
    let bending = |x: [f64; 3]| {
        let w = 5e-4 * (x[0] * x[0] + x[0] * x[1] + x[1] * x[1]);
        [0.0, 0.0, w, 5e-4 * (x[0] + 2.0 * x[1]), -5e-4 * (2.0 * x[0] + x[1]), 0.0]
    };
    for (what, exact, tolerance) in
        [("membrane", &membrane as &dyn Fn([f64; 3]) -> [f64; 6], 1e-12), ("bending", &bending, 1e-10)]
    {
        let found = patch.solve(&[], |n, x| if n < 4 { exact(x).map(Some) } else { [None; 6] });
        for (n, x) in patch.nodes.iter().enumerate() {
            for (i, value) in exact(*x).into_iter().enumerate() {
                let error = (found[6 * n + i] - value).abs();
                assert!(error < tolerance, "{what} node {n} component {i}: {error:e}");
            }
        }
    }
}

/// S2: the roof of Scordelis and Lo under its weight; the middle of its free edge sinks by 0.3024.
#[test]
fn s2_scordelis_lo_roof() {
    for (cells, expected) in [(8, 1.007), (16, 1.000)] {
        let roof = Structure::new([cells; 2], [0.25, 4.32e8, 0.0], |s, r| {
            let angle = (40.0 * s).to_radians();
            [25.0 * angle.sin(), 25.0 * r, 25.0 * angle.cos()]
        });
        let mut forces = Vec::new();
        for shell in &roof.shells {
            let area = Geometry::new(&shell.map(|n| roof.nodes[n])).area;
            forces.extend(shell.iter().map(|&n| (6 * n + 2, -90.0 * area / 4.0)));
        }
        // y = 0 is the diaphragm, y = 25 the middle; x = 0 the crown.
        let found = roof.solve(&forces, |_, x| {
            let (wall, middle, crown) = (x[1] < 1e-9, x[1] > 24.999, x[0] < 1e-9);
            let zero = |held: bool| held.then_some(0.0);
            [zero(wall || crown), zero(middle), zero(wall), zero(middle), zero(crown), zero(middle || crown)]
        });
        let edge = (0..roof.nodes.len())
            .find(|&n| roof.nodes[n][1] > 24.999 && roof.nodes[n][0] > 25.0 * 40f64.to_radians().sin() - 1e-6)
            .expect("a node");
        ratio(&format!("S2 {cells}"), -found[6 * edge + 2], 0.3024 * expected, 0.01);
    }
}

/// S3: a cylinder with diaphragms at its ends, pinched in the middle; 1.8248e-5 under the forces.
#[test]
fn s3_pinched_cylinder() {
    for (cells, expected) in [(8, 0.760), (16, 0.936)] {
        let cylinder = Structure::new([cells; 2], [3.0, 3e6, 0.3], |s, r| {
            let angle = std::f64::consts::FRAC_PI_2 * s;
            [300.0 * angle.sin(), 300.0 * r, 300.0 * angle.cos()]
        });
        let top = (0..cylinder.nodes.len())
            .find(|&n| cylinder.nodes[n][1] > 299.9 && cylinder.nodes[n][0] < 1e-9)
            .expect("a node");
        let found = cylinder.solve(&[(6 * top + 2, -0.25)], |_, x| {
            let (wall, middle, x0, z0) = (x[1] < 1e-9, x[1] > 299.999, x[0] < 1e-6, x[2] < 1e-6);
            let zero = |held: bool| held.then_some(0.0);
            [zero(wall || x0), zero(middle), zero(wall || z0), zero(middle || z0), zero(x0 || z0), zero(middle || x0)]
        });
        ratio(&format!("S3 {cells}"), -found[6 * top + 2], 1.8248e-5 * expected, 0.02);
    }
}
