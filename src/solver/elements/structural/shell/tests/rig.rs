//! One square shell of edge 1 whose nodes are moved by hand.

use crate::common::vector::{add, cross, dot, scaled};
use crate::lanes::{Force, Row};
use crate::material::{Elastic, Law};
use crate::solver::elements::shell::{QUADRILATERAL, Shell};
use crate::solver::elements::{Element, ElementBlock, PassOutcome, PassSettings, Sink, by_hand};
use std::marker::PhantomData;

pub const STEEL: Law = Law::Elastic(Elastic { young: 200e9, poisson: 0.3 });
const DENSITY: f64 = 7800.0;

pub struct Rig {
    pub block: ElementBlock,
    pub nodes: Vec<Row>,
    pub forces: Vec<Force>,
    pub outcome: PassOutcome,
    pub settings: PassSettings,
}

pub fn close(what: &str, a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{what}: {a:e} instead of {b:e}");
}

impl Rig {
    pub fn new(law: Law, points: Vec<[f64; 2]>, thickness: f64) -> Rig {
        Rig::of([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]], law, points, thickness)
    }

    /// A shell with these corners, and the mass of one of area 1.
    pub fn of(corners: [[f64; 3]; 4], law: Law, points: Vec<[f64; 2]>, thickness: f64) -> Rig {
        let element = Element::Shell(Shell { kind: PhantomData, thickness: Some(thickness), scale: 1.0, points });
        let new = by_hand::single(&[0, 1, 2, 3, 4, 5, 6, 7], &corners, DENSITY * thickness);
        let block = by_hand::block(&element, &law, DENSITY, &[new]);
        let nodes = corners.into_iter().chain([[0.0; 3]; 4]).map(by_hand::at_rest).collect();
        let (forces, settings) = (vec![Force::default(); 8], by_hand::settings());
        Rig { block, nodes, forces, outcome: PassOutcome::NOTHING, settings }
    }

    /// A step of one second with these velocities and rotation rates.
    pub fn step(&mut self, v: [[f64; 3]; 4], omega: [[f64; 3]; 4]) {
        for (row, rate) in self.nodes.iter_mut().zip(v.into_iter().chain(omega)) {
            row.0[4..7].copy_from_slice(&rate);
            (0..3).for_each(|i| row.0[i] += rate[i]);
        }
        self.forces.fill(Force::default());
        self.settings.time_step = 1.0;
        let sink = Sink::Nodes { forces: &mut self.forces, border: &[] };
        self.outcome = self.block.run(&self.nodes, &[], sink, &self.settings);
    }

    /// Stretches along x by a strain of the start.
    pub fn stretch(&mut self, strain: f64, steps: usize) {
        let v = [strain / steps as f64, 0.0, 0.0];
        (0..steps).for_each(|_| self.step([[0.0; 3], v, v, [0.0; 3]], [[0.0; 3]; 4]));
    }

    /// Bends to a curvature along x.
    pub fn bend(&mut self, curvature: f64, steps: usize) {
        let half = 0.5 * curvature / steps as f64;
        let (minus, plus) = ([0.0, -half, 0.0], [0.0, half, 0.0]);
        (0..steps).for_each(|_| self.step([[0.0; 3]; 4], [minus, plus, plus, minus]));
    }

    /// Turns the whole about an axis.
    pub fn turn(&mut self, axis: [f64; 3], angle: f64) {
        let turned = |x: [f64; 3]| {
            let (c, s) = (angle.cos(), angle.sin());
            let along = scaled(axis, dot(axis, x) * (1.0 - c));
            add(add(scaled(x, c), scaled(cross(axis, x), s)), along)
        };
        let v = [0, 1, 2, 3].map(|i: usize| {
            let x = [self.nodes[i].0[0], self.nodes[i].0[1], self.nodes[i].0[2]];
            let to = turned(x);
            [0, 1, 2].map(|k| to[k] - x[k])
        });
        // The spin of a motion along chords.
        self.step(v, [scaled(axis, 2.0 * (0.5 * angle).tan()); 4]);
    }

    pub fn state(&self, row: usize) -> f64 {
        self.block.interior.value(0, row)
    }

    pub fn point(&self, point: usize, row: usize) -> f64 {
        self.state(self.block.first_of_point(point) + row)
    }

    pub fn lose(&mut self, point: usize) {
        let row = self.block.first_of_point(point) + super::super::point_rows::LOST;
        self.block.interior.set_value(0, row, 1.0);
        assert!(row >= QUADRILATERAL.points);
    }
}
