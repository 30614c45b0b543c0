//! Kinematic constraints: directions held still and motions prescribed at nodes.
//!
//! A constraint replaces the force on its node by the one that gives the wanted velocity over the step; the
//! difference is the reaction, whose work is that of the analyst's actuator.

use super::nodes::Nodes;
use crate::model::{Function, MotionKind};

/// One constrained direction of one node.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// Local node.
    pub node: u32,
    /// Axis.
    pub axis: usize,
    /// What is prescribed; `None` holds the node still.
    pub motion: Option<Motion>,
    /// Whether its node has not been at rest yet: one that a run holds anew when it goes on may move, and to stop it is work.
    pub begins: bool,
    /// Force that the constraint adds now.
    pub reaction: f64,
    /// Work done so far.
    pub work: f64,
}

/// A prescribed motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Which derivative is given.
    pub kind: MotionKind,
    /// Function of time.
    pub function: usize,
    /// Factor on it.
    pub scale: f64,
}

/// Times of a step: state n at `time`, kick Δt̄ = ½(Δtₙ₋₁ + Δtₙ), drift Δtₙ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepTimes {
    /// tₙ, the time of the present state.
    pub time: f64,
    /// ½(Δtₙ₋₁ + Δtₙ), a time: forces times it change velocities.
    pub kick: f64,
    /// Δtₙ, a time: velocities times it change positions.
    pub drift: f64,
}

impl Constraint {
    /// Replaces the force on the node so that the step's velocity is the wanted one.
    pub fn apply(&mut self, nodes: &mut Nodes, functions: &[Function], step: &StepTimes) {
        let (n, i) = (self.node as usize, self.axis);
        let row = &nodes.rows[n].0;
        let (mass, velocity) = (row[3], row[4 + i]);
        let wanted_acceleration = match self.motion {
            None => -velocity / step.kick,
            Some(Motion { kind, function, scale }) => {
                let value = |t: f64| scale * functions[function].value(t);
                match kind {
                    MotionKind::Acceleration => value(step.time),
                    MotionKind::Velocity => (value(step.time + 0.5 * step.drift) - velocity) / step.kick,
                    MotionKind::Displacement => {
                        let target = nodes.initial(n as u32)[i] + value(step.time + step.drift);
                        ((target - row[i]) / step.drift - velocity) / step.kick
                    }
                }
            }
        };
        let force = mass * wanted_acceleration;
        self.reaction = force - nodes.forces[n].0[i];
        nodes.forces[n].0[i] = force;
    }

    /// Books half the step's work with the present velocity; a node held still does none once it has stopped.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        if self.motion.is_some() || self.begins {
            let velocity = nodes.velocity(self.node)[self.axis];
            self.work += half_step * self.reaction * velocity;
            self.begins &= velocity != 0.0;
        }
    }
}
