//! Fixed rigid planes: a node that would cross is stopped on the plane within the step, with Coulomb friction.

use super::constraints::StepTimes;
use super::nodes::{Nodes, dot, scaled, subtract};
use crate::model::RigidSurface;

/// Square of the part of a normal that a node can move along, below which the plane cannot move the node.
const SMALLEST_SHARE: f64 = 1e-6;

/// One node that a plane watches.
#[derive(Debug, Clone)]
pub struct PlaneNode {
    /// Local node.
    pub node: u32,
    /// Index into the model's rigid surfaces.
    pub surface: usize,
    /// Directions in which a constraint moves the node; the plane has no say there.
    pub held: [bool; 3],
    /// Gap that the mesh had at the start where it was negative: a node that begins behind the plane is held where
    /// it is, not thrown out.
    pub allowed: f64,
    /// Normal force now, along the plane's normal.
    pub normal_force: [f64; 3],
    /// Friction force now.
    pub friction_force: [f64; 3],
    /// Work of the normal force so far: what the impact of nodal masses on the plane takes out.
    pub normal_work: f64,
    /// Work of friction so far; it takes energy out, but for the half step in which a node turns back.
    pub friction_work: f64,
}

impl PlaneNode {
    /// A node at its initial position.
    pub fn new(node: u32, surface: usize, plane: &RigidSurface, position: [f64; 3], held: [bool; 3]) -> PlaneNode {
        let gap = dot(subtract(position, plane.point), plane.normal);
        PlaneNode {
            node,
            surface,
            held,
            allowed: gap.min(0.0),
            normal_force: [0.0; 3],
            friction_force: [0.0; 3],
            normal_work: 0.0,
            friction_work: 0.0,
        }
    }

    /// Adds the normal force that closes the predicted gap exactly, m g/(Δt Δt̄), and friction that stops sliding
    /// up to μ times it. Constraints have been applied: in the directions they hold, motion is what they say, and the
    /// plane's forces act in the others only.
    pub fn apply(&mut self, nodes: &mut Nodes, plane: &RigidSurface, step: &StepTimes) {
        (self.normal_force, self.friction_force) = ([0.0; 3], [0.0; 3]);
        let n = self.node;
        let free = |a: [f64; 3]| [0, 1, 2].map(|i| if self.held[i] { 0.0 } else { a[i] });
        let (mass, force) = (nodes.mass(n), nodes.force(n));
        let (x, v, a) = (nodes.position(n), nodes.velocity(n), nodes.acceleration(n));
        let velocity = [0, 1, 2].map(|i| v[i] + step.kick * a[i]);
        let predicted = [0, 1, 2].map(|i| x[i] + step.drift * velocity[i]);
        let gap = dot(subtract(predicted, plane.point), plane.normal) - self.allowed;
        let along = free(plane.normal);
        let share = dot(along, along);
        if gap >= 0.0 || share < SMALLEST_SHARE {
            return;
        }
        let push = mass * -gap / (step.drift * step.kick * share);
        self.normal_force = scaled(along, push);
        if plane.friction > 0.0 {
            let sliding = free(subtract(velocity, scaled(plane.normal, dot(velocity, plane.normal))));
            let speed = dot(sliding, sliding).sqrt();
            let stick = mass * speed / step.kick;
            if speed > 0.0 {
                self.friction_force = scaled(sliding, -stick.min(plane.friction * push) / speed);
            }
        }
        let sum = &mut nodes.forces[n as usize].0;
        for i in 0..3 {
            sum[i] = force[i] + self.normal_force[i] + self.friction_force[i];
        }
    }

    /// Books half the step's work with the present velocity.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        let v = nodes.velocity(self.node);
        self.normal_work += half_step * dot(self.normal_force, v);
        self.friction_work += half_step * dot(self.friction_force, v);
    }
}
