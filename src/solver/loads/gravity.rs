//! GRAVITY: a body acceleration of the whole model.

use super::{Account, Key, Load, LoadEntry, Places, Setting, Turn, function_number};
use crate::common::numbers::number;
use crate::common::vector::{add, dot, scaled};
use crate::model::{Function, Gravity, Model};
use crate::solver::constraints::StepTimes;
use crate::solver::domain::ABSENT;
use crate::solver::nodes::Nodes;

pub(super) static ENTRY: LoadEntry = LoadEntry {
    command: "GRAVITY",
    works: "GRAVITYW",
    key: Key::Node(0),
    turn: Turn::Body,
    echo,
    make: |setting| {
        let gravities = setting.model.gravities.clone();
        let load = || BodyForce {
            gravities: gravities.clone(),
            acceleration: [0.0; 3],
            work: vec![0.0; setting.nodes],
            of_bodies: of_bodies(setting),
        };
        (!gravities.is_empty()).then(|| Box::new(load()) as Box<dyn Load>)
    },
};

fn echo(model: &Model) -> (&'static str, &'static str, Vec<String>) {
    let line = |gravity: &Gravity| {
        let name = gravity.function.map_or("NONE".to_string(), |f| function_number(model, f).to_string());
        let [x, y, z] = gravity.acceleration.map(number);
        format!("{x:>13}{y:>13}{z:>13}{name:>10}")
    };
    ("GRAVITY", "            X            Y            Z  FUNCTION", model.gravities.iter().map(line).collect())
}

/// Local nodes of rigid bodies, whose weight acts on the bodies as wholes; empty where there are none.
fn of_bodies(setting: &Setting) -> Vec<bool> {
    let shapes = &setting.body.rigid;
    let mut found = vec![false; if shapes.is_empty() { 0 } else { setting.nodes }];
    let all = shapes.iter().flat_map(|shape| &shape.nodes).map(|&node| setting.local[node as usize]);
    all.filter(|&node| node != ABSENT).for_each(|node| found[node as usize] = true);
    found
}

/// The acceleration of gravity at a time.
pub fn gravity_now(gravities: &[Gravity], functions: &[Function], time: f64) -> [f64; 3] {
    gravities.iter().fold([0.0; 3], |sum, gravity| {
        let factor = gravity.function.map_or(1.0, |f| functions[f].value(time));
        add(sum, scaled(gravity.acceleration, factor))
    })
}

/// Gravity of the whole model.
struct BodyForce {
    /// The model's gravities.
    gravities: Vec<Gravity>,
    /// Acceleration now.
    acceleration: [f64; 3],
    /// Work on each local node so far.
    work: Vec<f64>,
    /// Nodes of rigid bodies; empty where there are none.
    of_bodies: Vec<bool>,
}

impl Load for BodyForce {
    fn entry(&self) -> &'static LoadEntry {
        &ENTRY
    }

    /// Adds m g(t) to every node.
    fn apply(&mut self, nodes: &mut Nodes, functions: &[Function], step: &StepTimes) {
        self.acceleration = gravity_now(&self.gravities, functions, step.time);
        for (node, (force, row)) in nodes.forces.iter_mut().zip(&nodes.rows[..nodes.places]).enumerate() {
            if self.of_bodies.get(node) == Some(&true) {
                continue;
            }
            for i in 0..3 {
                force.0[i] += row.0[3] * self.acceleration[i];
            }
        }
    }

    /// Books half the step's work with the present velocities.
    fn book(&mut self, nodes: &Nodes, half_step: f64) {
        for (node, (work, row)) in self.work.iter_mut().zip(&nodes.rows[..nodes.places]).enumerate() {
            if self.of_bodies.get(node) == Some(&true) {
                continue;
            }
            let v = [row.0[4], row.0[5], row.0[6]];
            *work += half_step * row.0[3] * dot(self.acceleration, v);
        }
    }

    fn accounts(&mut self, places: &Places, visit: &mut dyn FnMut(Account)) {
        let BodyForce { gravities: _, acceleration: _, work, of_bodies: _ } = self;
        for (node, work) in (0..).zip(work).take(places.nodes.places) {
            visit(Account { key: [places.node(node), 0.0, 0.0, 0.0], own: places.owns(node), work });
        }
    }
}
