//! External forces: pressure on deformed faces, forces on node sets, gravity.
//!
//! Every loaded entity keeps its own work, ½ Δt̄ F·v⁻ before and ½ Δt̄ F·v⁺ after the kick of a step, so that the
//! energy balance is that of the discrete scheme and its sum does not depend on the decomposition.

use super::nodes::{Nodes, add, cross, dot, scaled};
use crate::lanes::Force;
use crate::model::{Function, Gravity};

/// Pressure on one face of this rank.
#[derive(Debug, Clone)]
pub struct PressureFace {
    /// Local nodes, counter-clockwise seen from outside.
    pub nodes: [u32; 4],
    /// Canonical number of its element.
    pub element: u32,
    /// Whether the element has been taken away; nothing presses then.
    pub gone: bool,
    /// Function of time.
    pub function: usize,
    /// Factor on it.
    pub scale: f64,
    /// Force on each node now.
    pub force: [[f64; 3]; 4],
    /// Work done so far.
    pub work: f64,
}

/// ∫ N_I n dA over a bilinear face: closed form, exact also for warped faces.
pub fn face_area_vectors(x: [[f64; 3]; 4]) -> [[f64; 3]; 4] {
    let combine =
        |s: [f64; 4]| [0, 1, 2].map(|i| 0.25 * (s[0] * x[0][i] + s[1] * x[1][i] + s[2] * x[2][i] + s[3] * x[3][i]));
    let (e1, e2) = (combine([-1.0, 1.0, 1.0, -1.0]), combine([-1.0, -1.0, 1.0, 1.0]));
    let h = combine([1.0, -1.0, 1.0, -1.0]);
    let (area, b, c) = (cross(e1, e2), cross(e1, h), cross(h, e2));
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(xi, eta)| [0, 1, 2].map(|i| area[i] + (xi * b[i] + eta * c[i]) / 3.0))
}

impl PressureFace {
    /// Forces of the pressure p(t) on the present face. Positive pressure pushes on it, against the outward normal.
    pub fn evaluate(&mut self, nodes: &Nodes, functions: &[Function], time: f64) {
        let pressure = if self.gone { 0.0 } else { self.scale * functions[self.function].value(time) };
        let corners = self.nodes.map(|n| nodes.position(n));
        self.force = face_area_vectors(corners).map(|area| scaled(area, -pressure));
    }

    /// Minus the forces, as slots to be subtracted like element forces.
    pub fn slots(&self) -> [Force; 4] {
        self.force.map(|f| Force([-f[0], -f[1], -f[2], 0.0]))
    }

    /// Books half the step's work with the present velocities.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        let power: f64 = self.nodes.iter().zip(self.force).map(|(&n, f)| dot(f, nodes.velocity(n))).sum();
        self.work += half_step * power;
    }
}

/// A force on one node of this rank.
#[derive(Debug, Clone)]
pub struct NodeForce {
    /// Local node.
    pub node: u32,
    /// Axis of the force.
    pub axis: usize,
    /// Function of time.
    pub function: usize,
    /// Factor on it.
    pub scale: f64,
    /// Force now.
    pub force: f64,
    /// Work done so far.
    pub work: f64,
}

impl NodeForce {
    /// Adds the force at time t to its node.
    pub fn apply(&mut self, nodes: &mut Nodes, functions: &[Function], time: f64) {
        self.force = self.scale * functions[self.function].value(time);
        nodes.forces[self.node as usize].0[self.axis] += self.force;
    }

    /// Books half the step's work with the present velocity.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        self.work += half_step * self.force * nodes.velocity(self.node)[self.axis];
    }
}

/// Gravity of the whole model.
#[derive(Debug, Clone, Default)]
pub struct BodyForce {
    /// The model's gravities.
    pub gravities: Vec<Gravity>,
    /// Acceleration now.
    pub acceleration: [f64; 3],
    /// Work on each local node so far; empty without gravity.
    pub work: Vec<f64>,
}

impl BodyForce {
    /// Adds m g(t) to every node.
    pub fn apply(&mut self, nodes: &mut Nodes, functions: &[Function], time: f64) {
        if self.gravities.is_empty() {
            return;
        }
        self.acceleration = self.gravities.iter().fold([0.0; 3], |sum, gravity| {
            let factor = gravity.function.map_or(1.0, |f| functions[f].value(time));
            add(sum, scaled(gravity.acceleration, factor))
        });
        for (force, row) in nodes.forces.iter_mut().zip(&nodes.rows) {
            for i in 0..3 {
                force.0[i] += row.0[3] * self.acceleration[i];
            }
        }
    }

    /// Books half the step's work with the present velocities.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        for (work, row) in self.work.iter_mut().zip(&nodes.rows) {
            let v = [row.0[4], row.0[5], row.0[6]];
            *work += half_step * row.0[3] * dot(self.acceleration, v);
        }
    }
}
