//! Nodes of one rank: position and velocity side by side in one cache line, and the force sums.

use crate::lanes::{Force, Row};
use crate::mesh::Coordinates;
use std::ops::Range;

pub use crate::common::vector::{add, cross, dot, scaled, subtract};

/// The nodes that a rank's elements use; behind them the rotations of those that can turn, each like a node of its own: see
/// [`Rotations`](super::Rotations).
#[derive(Default)]
pub struct Nodes {
    /// `[x, y, z, m, vx, vy, vz, 1/m]` per node; of a rotation the integral of its rate, rotary inertia and rate.
    pub rows: Vec<Row>,
    /// Force sums, moments of rotations; zero between steps.
    pub forces: Vec<Force>,
    /// Positions of all nodes of the mesh, lengths, in the order of its file.
    pub mesh: Coordinates,
    /// Positions of the nodes that are not of the mesh, the last ones, lengths.
    pub beside: Vec<[f64; 3]>,
    /// How many of them are nodes of the mesh: the first ones.
    pub places: usize,
    /// Node of the mesh file.
    pub file: Vec<u32>,
    /// Whether this rank answers for the node: one rank does, of those that share it.
    pub owned: Vec<bool>,
    /// What elements of fluids hear of their neighbours.
    pub rates: Rates,
    /// Nodes that are not integrated, ascending: those inside rigid bodies, on which no force acts.
    pub passive: Vec<Range<usize>>,
}

/// Mean rates, at each node, at which the volumes of the elements of fluids there grow; empty where there are no such elements.
#[derive(Debug, Clone, Default)]
pub struct Rates {
    /// Whether there are such elements on any rank.
    wanted: bool,
    /// One over the number of corners of such elements at a node of the mesh, zero where there are none. Elements that are gone
    /// go on to count, as if their volumes stood still.
    shares: Vec<f64>,
    /// Means of the last pass over the elements, 1/time.
    pub means: Vec<f64>,
}

impl Rates {
    /// From the number of corners at each node; before the first pass nothing is known.
    pub fn new(corners: &[u32]) -> Rates {
        let share = |&count: &u32| if count == 0 { 0.0 } else { 1.0 / f64::from(count) };
        Rates { wanted: true, shares: corners.iter().map(share).collect(), means: vec![0.0; corners.len()] }
    }

    /// Whether any element asks for them.
    pub fn are_wanted(&self) -> bool {
        self.wanted
    }

    /// Takes the sums of a pass, which come subtracted as forces do, out of these.
    fn take(&mut self, forces: &mut [Force]) {
        for ((mean, share), force) in self.means.iter_mut().zip(&self.shares).zip(forces) {
            *mean = -share * std::mem::take(&mut force.0[3]);
        }
    }
}

impl Nodes {
    /// Keeps what the elements of fluids have said of their rates in the last pass. Forces are forces alone from then on.
    pub fn keep_rates(&mut self) {
        self.rates.take(&mut self.forces);
    }

    /// Number of nodes, rotations and whatever else is behind them.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Position of a local node in the mesh, a length; zero of a rotation, which has none.
    pub fn initial(&self, node: u32) -> [f64; 3] {
        let (node, first) = (node as usize, self.len() - self.beside.len());
        let place = if node < first { self.mesh.get(self.file[node] as usize) } else { self.beside.get(node - first) };
        place.copied().unwrap_or_default()
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
