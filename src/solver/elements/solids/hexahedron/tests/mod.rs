//! Tests of the element against theory: what must hold for any shape, any motion, any instruction set.

// Formulas run over indices of several arrays at once.
#![allow(clippy::needless_range_loop)]

mod assumed_strain;
mod bits;
mod collapsed;
mod crushed;
mod energy;
mod extremes;
mod fluid;
mod kinematics;
mod operators;
mod patch;
mod time_step;

use super::kinematics::rotation_matrix;
use super::{Hexahedron, geometry, rows};
use crate::lanes::{Force, Row};
use crate::material::{Elastic, Law};
use crate::mesh::UNIT_CUBE as CUBE;
use crate::model::{BulkViscosity, Hourglass, Precision, Spin, StepModuli};
use crate::solver::elements::{Element, ElementBlock, NewElement, PassOutcome, PassSettings, Sink, by_hand};
use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3};

type Corners = [[f64; 3]; 8];

const DENSITY: f64 = 7850.0;
const STEEL: Elastic = Elastic { young: 200e9, poisson: 0.3 };
const ASSUMED: Hourglass = Hourglass::AssumedStrain { factor: 1.0 };
const NONE: Hourglass = Hourglass::FlanaganBelytschko { stiffness: 0.0, viscosity: 0.0 };

fn flanagan_belytschko(stiffness: f64) -> Hourglass {
    Hourglass::FlanaganBelytschko { stiffness, viscosity: 0.0 }
}

fn elastic(poisson: f64) -> Law {
    Law::Elastic(Elastic { poisson, ..STEEL })
}

/// Numbers that look random and are the same every time (splitmix64).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly spread over −1 to 1.
    fn next(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> [f64; 3] {
        [self.next(), self.next(), self.next()]
    }

    fn rotation(&mut self) -> Matrix3<f64> {
        let axis = Vector3::from(self.vector());
        Rotation3::new(axis.normalize() * (3.0 * self.next())).into_inner()
    }

    /// A cube whose corners are each moved by up to `amplitude` edges, with positive volume.
    fn warped(&mut self, amplitude: f64) -> Corners {
        loop {
            let corners = CUBE.map(|c| {
                let d = self.vector();
                [0, 1, 2].map(|i| c[i] + amplitude * d[i])
            });
            if volume(&corners) > 0.02 {
                return corners;
            }
        }
    }
}

fn volume(corners: &Corners) -> f64 {
    gradient(corners).volume192 / 192.0
}

fn gradient(corners: &Corners) -> geometry::Gradient<f64> {
    geometry::gradient(&relative(corners).map(|x| geometry::modes(&x)))
}

/// Coordinates by direction, seen from the first corner.
fn relative(corners: &Corners) -> [[f64; 8]; 3] {
    [0, 1, 2].map(|i| corners.map(|c| c[i] - corners[0][i]))
}

fn mapped(corners: &Corners, m: &Matrix3<f64>) -> Corners {
    corners.map(|c| (m * Vector3::from(c)).into())
}

/// Some elements whose nodes are moved by hand.
struct Rig {
    block: ElementBlock,
    nodes: Vec<Row>,
    forces: Vec<Force>,
    pass: PassSettings,
}

impl Rig {
    fn new(points: &[[f64; 3]], cells: &[[u32; 8]], law: Law, hourglass: Hourglass) -> Rig {
        Rig::of(Precision::Double, points, cells, law, hourglass)
    }

    fn of(precision: Precision, points: &[[f64; 3]], cells: &[[u32; 8]], law: Law, hourglass: Hourglass) -> Rig {
        let elements: Vec<NewElement> = cells
            .iter()
            .enumerate()
            .map(|(place, &nodes)| {
                let corners = nodes.map(|n| points[n as usize]);
                let mass = DENSITY * volume(&corners);
                NewElement { place: place as u32, ..by_hand::single(&nodes, &corners, mass) }
            })
            .collect();
        let element = Element::Hexahedron(Hexahedron { hourglass, precision, spin: Spin::default() });
        Rig {
            block: by_hand::block(&element, &law, DENSITY, &elements),
            nodes: points.iter().copied().map(by_hand::at_rest).collect(),
            forces: vec![Force::default(); points.len()],
            pass: by_hand::settings(),
        }
    }

    fn single(corners: &Corners, law: Law, hourglass: Hourglass) -> Rig {
        Rig::new(corners, &[[0, 1, 2, 3, 4, 5, 6, 7]], law, hourglass)
    }

    fn with_spin(mut self, spin: Spin) -> Rig {
        if let Element::Hexahedron(own) = &mut self.block.element {
            own.spin = spin;
        }
        self
    }

    /// Moves every node with its velocity over a step and evaluates the elements there.
    fn step(&mut self, time_step: f64, velocity: impl Fn(usize) -> [f64; 3]) -> PassOutcome {
        for (node, row) in self.nodes.iter_mut().enumerate() {
            row.0[4..7].copy_from_slice(&velocity(node));
            for i in 0..3 {
                row.0[i] += time_step * row.0[4 + i];
            }
        }
        self.forces.fill(Force::default());
        // Half of the kick after a step belongs to it.
        self.pass.kick = 0.5 * (self.pass.time_step + time_step);
        self.pass.time_step = time_step;
        self.block.run(&self.nodes, &[], Sink::Nodes { forces: &mut self.forces, border: &[] }, &self.pass)
    }

    /// Moves every node to a place in one step, along a straight line.
    fn step_to(&mut self, time_step: f64, place: impl Fn(usize) -> [f64; 3]) -> PassOutcome {
        let now: Vec<_> = (0..self.nodes.len()).map(|n| self.position(n)).collect();
        self.step(time_step, |n| {
            let target = place(n);
            [0, 1, 2].map(|i| (target[i] - now[n][i]) / time_step)
        })
    }

    /// One central difference step of free nodes, each with `mass`, under the elements' forces.
    fn fly(&mut self, mass: f64, time_step: f64) -> PassOutcome {
        let v: Vec<[f64; 3]> = (0..self.nodes.len())
            .map(|n| {
                let (v, f) = (self.velocity(n), self.force(n));
                [0, 1, 2].map(|i| v[i] - time_step * f[i] / mass)
            })
            .collect();
        self.step(time_step, |n| v[n])
    }

    fn position(&self, node: usize) -> [f64; 3] {
        let r = &self.nodes[node].0;
        [r[0], r[1], r[2]]
    }

    fn velocity(&self, node: usize) -> [f64; 3] {
        let r = &self.nodes[node].0;
        [r[4], r[5], r[6]]
    }

    /// What the elements ask of a node: to be subtracted from its forces.
    fn force(&self, node: usize) -> [f64; 3] {
        let f = &self.forces[node].0;
        [-f[0], -f[1], -f[2]]
    }

    fn state(&self, row: usize) -> f64 {
        self.block.interior.value(0, row)
    }

    fn set_state(&mut self, row: usize, value: f64) {
        self.block.interior.state[row].0 = [value; 8];
    }

    /// A symmetric tensor of the first element's state as a matrix, in its frame.
    fn tensor(&self, first: usize) -> Matrix3<f64> {
        let [xx, yy, zz, xy, yz, zx] = self.block.interior.values(0, first);
        Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz)
    }

    /// Columns are the axes of the first element's frame.
    fn frame(&self) -> Matrix3<f64> {
        let m = rotation_matrix(&self.block.interior.values::<4>(0, rows::FRAME));
        Matrix3::from_fn(|i, j| m[i][j])
    }

    /// Cauchy stress of the first element in space.
    fn stress(&self) -> Matrix3<f64> {
        let r = self.frame();
        r * self.tensor(rows::STRESS) * r.transpose()
    }
}

/// The 24 × 24 stiffness of an element by central differences of its corner forces about the unstressed state.
/// `prepare` may change the element first.
fn stiffness(corners: &Corners, law: Law, hourglass: Hourglass, prepare: impl Fn(&mut Rig)) -> DMatrix<f64> {
    let size = corners.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs()));
    let h = 1e-6 * size.min(volume(corners) / (size * size));
    let force = |dof: usize, h: f64| {
        let mut rig = Rig::single(corners, law.clone(), hourglass);
        prepare(&mut rig);
        rig.step(1.0, |node| [0, 1, 2].map(|i| if 3 * node + i == dof { h } else { 0.0 }));
        rig
    };
    let mut k = DMatrix::zeros(24, 24);
    for dof in 0..24 {
        let (plus, minus) = (force(dof, h), force(dof, -h));
        for node in 0..8 {
            for i in 0..3 {
                k[(3 * node + i, dof)] = (plus.force(node)[i] - minus.force(node)[i]) / (2.0 * h);
            }
        }
    }
    k
}

/// Asserts |a − b| ≤ tolerance with both numbers in the message.
#[track_caller]
fn close(what: &str, a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{what}: {a:e} instead of {b:e}, off by {:e} > {tolerance:e}", (a - b).abs());
}
