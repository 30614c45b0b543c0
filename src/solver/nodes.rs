//! Nodes of one rank: position and velocity side by side in one cache line, and the force sums.

use crate::lanes::{Force, Row};
use std::ops::Range;

pub use crate::vector::{add, cross, dot, scaled, subtract};

/// The nodes that a rank's elements use; behind them the rotations of those that can turn, each like a node of its own: see
/// [`Rotations`](super::Rotations).
#[derive(Default)]
pub struct Nodes {
    /// `[x, y, z, m, vx, vy, vz, 1/m]` per node; of a rotation the integral of its rate, rotary inertia and rate.
    pub rows: Vec<Row>,
    /// Force sums, moments of rotations; zero between steps.
    pub forces: Vec<Force>,
    /// Positions in the mesh, lengths.
    pub initial: Vec<[f64; 3]>,
    /// How many of them are nodes of the mesh: the first ones.
    pub places: usize,
    /// Node of the mesh file.
    pub file: Vec<u32>,
    /// Whether this rank answers for the node: one rank does, of those that share it.
    pub owned: Vec<bool>,
    /// Nodes that are not integrated, ascending: those inside rigid bodies, on which no force acts.
    pub passive: Vec<Range<usize>>,
}

impl Nodes {
    /// Number of nodes, rotations and whatever else is behind them.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Position of a local node.
    pub fn position(&self, node: u32) -> [f64; 3] {
        let r = &self.rows[node as usize].0;
        [r[0], r[1], r[2]]
    }

    /// Mass of a local node.
    pub fn mass(&self, node: u32) -> f64 {
        self.rows[node as usize].0[3]
    }

    /// Velocity of a local node.
    pub fn velocity(&self, node: u32) -> [f64; 3] {
        let r = &self.rows[node as usize].0;
        [r[4], r[5], r[6]]
    }

    /// Force sum of a local node.
    pub fn force(&self, node: u32) -> [f64; 3] {
        let f = &self.forces[node as usize].0;
        [f[0], f[1], f[2]]
    }

    /// Acceleration f/m of a local node.
    pub fn acceleration(&self, node: u32) -> [f64; 3] {
        scaled(self.force(node), self.rows[node as usize].0[7])
    }

    /// v ← v + Δt̄ f/m, x ← x + Δt v, f ← 0 (central differences with a changing step).
    pub fn integrate(&mut self, kick: f64, drift: f64) {
        let end = self.rows.len();
        let mut begin = 0;
        for range in self.passive.iter().cloned().chain(std::iter::once(end..end)) {
            integrate(&mut self.rows[begin..range.start], &mut self.forces[begin..range.start], kick, drift);
            begin = range.end;
        }
    }
}

fn integrate(rows: &mut [Row], forces: &mut [Force], kick: f64, drift: f64) {
    for (row, force) in rows.iter_mut().zip(forces) {
        let r = &mut row.0;
        for i in 0..3 {
            let velocity = r[4 + i] + kick * (force.0[i] * r[7]);
            r[4 + i] = velocity;
            r[i] += drift * velocity;
        }
        *force = Force::default();
    }
}
