//! The axis of a body of revolution: a plane of symmetry that no node passes.
//!
//! Nodes that begin on it are constraints. All others may come to it and leave it again: a node that would be at a negative
//! radius at the end of the step gets the force that lets it end on the axis, as a fixed rigid plane without friction would.
//! Nodes are looked at twice in a step: before contact, which then knows where they go, and after it, since its forces
//! may press them on or take them away. The second look begins without the force of the first, so that no force pulls.

use super::ABSENT;
use super::constraints::{Constraint, StepTimes};
use super::nodes::Nodes;
use crate::solver::loads::{Account, Places};

/// The axis, as the nodes of one rank meet it.
#[derive(Debug, Clone, Default)]
pub struct Axis {
    meets: Vec<Meeting>,
    /// Which of them it pushes now.
    pushed: Vec<u32>,
}

/// A node that may come to the axis.
#[derive(Debug, Clone, Copy)]
struct Meeting {
    /// Local node.
    node: u32,
    /// Force on it now, away from the axis.
    reaction: f64,
    /// Work of that force so far.
    work: f64,
}

impl Axis {
    /// With all nodes whose radius nothing else prescribes: `is_free` says so of a local node.
    pub fn new(nodes: &Nodes, is_free: impl Fn(u32) -> bool) -> Axis {
        // Nodes that are not of the mesh stand in for elements that are gone.
        let may_come = |&node: &u32| nodes.file[node as usize] != ABSENT && is_free(node);
        let meet = |node: u32| Meeting { node, reaction: 0.0, work: 0.0 };
        Axis { meets: (0..nodes.len() as u32).filter(may_come).map(meet).collect(), pushed: Vec::new() }
    }

    /// Keeps nodes from ending the step beyond the axis, in place of what it did before in this step.
    pub fn hold(&mut self, nodes: &mut Nodes, step: &StepTimes) {
        let Axis { meets, pushed } = self;
        pushed.clear();
        for (number, Meeting { node, reaction, .. }) in (0..).zip(meets) {
            let row = &nodes.rows[*node as usize].0;
            let force = &mut nodes.forces[*node as usize].0[0];
            let (radius, mass, velocity, inverse_mass) = (row[0], row[3], row[4], row[7]);
            if *reaction != 0.0 {
                *force -= std::mem::take(reaction);
            }
            let end = radius + step.drift * (velocity + step.kick * (*force * inverse_mass));
            // What has been dropped with the last of its elements has no mass, and goes nowhere.
            if end < 0.0 && mass > 0.0 {
                *reaction = -end / (step.drift * step.kick * inverse_mass);
                *force += *reaction;
                pushed.push(number);
            }
        }
    }

    /// Lets go of forces that are of a step before: those on nodes are gone.
    pub fn begin(&mut self) {
        let Axis { meets, pushed } = self;
        pushed.drain(..).for_each(|number| meets[number as usize].reaction = 0.0);
    }

    /// Books half the step's work with the present velocity.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        for &number in &self.pushed {
            let Meeting { node, reaction, work } = &mut self.meets[number as usize];
            *work += half_step * *reaction * nodes.velocity(*node)[0];
        }
    }

    /// Local nodes that it pushes, and the forces.
    pub fn reactions(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        let pushed = self.pushed.iter().map(|&number| &self.meets[number as usize]);
        pushed.map(|meeting| (meeting.node, meeting.reaction))
    }

    /// Hands out all works with their nodes.
    pub fn accounts(&mut self, places: &Places, visit: &mut dyn FnMut(Account)) {
        for Meeting { node, work, reaction: _ } in &mut self.meets {
            visit(Account { key: [places.node(*node), 0.0, 0.0, 0.0], own: places.owns(*node), work });
        }
    }
}

/// Holds nodes that begin on the axis on it; `taken` says which constraint takes each direction of each node.
pub fn hold_on_it(nodes: &Nodes, taken: &mut [[u32; 3]], constraints: &mut Vec<Constraint>) {
    for (node, taken) in (0..nodes.len() as u32).zip(taken) {
        // Nodes that are not of the mesh stand in for elements that are gone, at rest.
        let of_mesh = nodes.file[node as usize] != ABSENT;
        if of_mesh && taken[0] == ABSENT && nodes.position(node)[0] == 0.0 {
            taken[0] = constraints.len() as u32;
            constraints.push(Constraint { node, axis: 0, motion: None, begins: true, reaction: 0.0, work: 0.0 });
        }
    }
}
