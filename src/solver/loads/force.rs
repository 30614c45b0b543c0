//! PRESCRIBED FORCE and PRESCRIBED MOMENT: on the nodes of node sets.

use super::{Account, Key, Load, LoadEntry, Places, Setting, Turn, function_number};
use crate::common::numbers::number;
use crate::model::{Function, Model, PrescribedForce, Unknown};
use crate::solver::constraints::StepTimes;
use crate::solver::domain::ABSENT;
use crate::solver::nodes::Nodes;

pub(super) static ENTRY: LoadEntry =
    LoadEntry { command: "PRESCRIBED FORCE", works: "FORCEW", key: Key::Node(1), turn: Turn::Nodes, echo, make };

fn echo(model: &Model) -> (&'static str, &'static str, Vec<String>) {
    let line = |f: &PrescribedForce| {
        let axis = ["X", "Y", "Z"][f.direction.axis()];
        let axis = if f.of == Unknown::Rotation { format!("ABOUT {axis}") } else { axis.to_string() };
        format!("{:>13}{axis:>11}{:>10}{:>13}", f.node_set, function_number(model, f.function), number(f.scale))
    };
    let columns = "     NODE SET  DIRECTION  FUNCTION        SCALE";
    ("PRESCRIBED FORCES", columns, model.prescribed_forces.iter().map(line).collect())
}

fn make(setting: &Setting) -> Option<Box<dyn Load>> {
    let mut forces = Vec::new();
    for load in &setting.model.prescribed_forces {
        // A node that its set names twice gets the force once.
        let shares = setting.mesh.shares_of(load.node_set).into_iter();
        let unknown = |node: u32| match load.of {
            Unknown::Position => Some(node),
            Unknown::Rotation => setting.body.rotations.of(node),
        };
        let mut nodes: Vec<(u32, f64)> = shares
            .filter_map(|(node, factor)| Some((setting.local[unknown(node)? as usize], factor)))
            .filter(|(node, _)| *node != ABSENT)
            .collect();
        nodes.sort_by_key(|(node, _)| *node);
        let (axis, function) = (load.direction.axis(), load.function);
        forces.extend(nodes.into_iter().map(|(node, factor)| {
            let scale = load.scale * factor;
            NodeForce { node, axis, function, scale, force: 0.0, work: 0.0 }
        }));
    }
    (!forces.is_empty()).then(|| Box::new(NodeForces(forces)) as Box<dyn Load>)
}

/// All forces on nodes of a rank.
struct NodeForces(Vec<NodeForce>);

/// A force on one node of this rank.
#[derive(Debug, Clone)]
struct NodeForce {
    /// Local node, or its rotation.
    pub node: u32,
    /// Axis of the force or moment.
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
    fn apply(&mut self, nodes: &mut Nodes, functions: &[Function], time: f64) {
        self.force = self.scale * functions[self.function].value(time);
        nodes.forces[self.node as usize].0[self.axis] += self.force;
    }

    /// Books half the step's work with the present velocity.
    fn book(&mut self, nodes: &Nodes, half_step: f64) {
        self.work += half_step * self.force * nodes.velocity(self.node)[self.axis];
    }
}

impl Load for NodeForces {
    fn entry(&self) -> &'static LoadEntry {
        &ENTRY
    }

    fn apply(&mut self, nodes: &mut Nodes, functions: &[Function], step: &StepTimes) {
        self.0.iter_mut().for_each(|load| load.apply(nodes, functions, step.time));
    }

    fn book(&mut self, nodes: &Nodes, half_step: f64) {
        self.0.iter_mut().for_each(|load| load.book(nodes, half_step));
    }

    fn accounts(&mut self, places: &Places, visit: &mut dyn FnMut(Account)) {
        for NodeForce { node, axis, work, function: _, scale: _, force: _ } in &mut self.0 {
            visit(Account { key: [places.node(*node), *axis as f64, 0.0, 0.0], own: places.owns(*node), work });
        }
    }
}
