//! What contact has met in a run: what the deck could leave out follows from what is missing here.

use super::enforcement::constraint::Constraint;
use crate::comm::Communicator;
use crate::vector::dot;

/// What has been met so far. On several ranks each knows its own until [`Seen::merged`].
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// For each block of the mesh, whether a face of it, or a node of such a face, was in a contact with a force.
    pub blocks: Vec<bool>,
    /// For each rigid plane, whether it pushed.
    pub planes: Vec<bool>,
    /// Whether an edge pushed another.
    pub edges: bool,
    /// Time of the first force, infinite where there was none.
    pub first: f64,
    /// Steps before it.
    pub steps_before: f64,
    /// Largest part of the greatest possible friction that was used, without dimension; negative where none was possible.
    pub friction: f64,
}

impl Seen {
    /// Nothing yet.
    pub fn nothing(blocks: usize, planes: usize) -> Seen {
        Seen {
            blocks: vec![false; blocks],
            planes: vec![false; planes],
            edges: false,
            first: f64::INFINITY,
            steps_before: f64::INFINITY,
            friction: -1.0,
        }
    }

    /// A contact with a force in a step that begins at `time`, after `steps` others.
    pub fn touch(&mut self, constraint: &Constraint, (time, steps): (f64, u64)) {
        if self.first.is_infinite() {
            (self.first, self.steps_before) = (time, steps as f64);
        }
        let friction = &constraint.friction;
        let coefficient =
            if friction.decay > 0.0 { friction.at_rest.min(friction.high_speed) } else { friction.at_rest };
        let limit = coefficient * constraint.carried.normal_force;
        if limit > 0.0 {
            let force = constraint.carried.tangential_force;
            self.friction = self.friction.max(dot(force, force).sqrt() / limit);
        }
    }

    /// Whether a block has not been met yet.
    pub fn lacks_blocks(&self) -> bool {
        self.blocks.contains(&false)
    }

    /// A block that was met.
    pub fn meet(&mut self, block: u32) {
        if let Some(met) = self.blocks.get_mut(block as usize) {
            *met = true;
        }
    }

    /// A plane that pushed.
    pub fn push(&mut self, plane: u32) {
        if let Some(pushed) = self.planes.get_mut(plane as usize) {
            *pushed = true;
        }
    }

    /// What all ranks have met, on all of them. All ranks call it.
    pub fn merged(&self, comm: &mut dyn Communicator) -> Seen {
        let missing = |met: &bool| if *met { 0.0 } else { 1.0 };
        let mut votes: Vec<f64> = self.blocks.iter().chain(&self.planes).chain([&self.edges]).map(missing).collect();
        votes.extend([self.first, self.steps_before, -self.friction]);
        comm.all_min(&mut votes);
        let met = |vote: &f64| *vote == 0.0;
        let (blocks, rest) = votes.split_at(self.blocks.len());
        let (planes, rest) = rest.split_at(self.planes.len());
        Seen {
            blocks: blocks.iter().map(met).collect(),
            planes: planes.iter().map(met).collect(),
            edges: rest.first().is_some_and(met),
            first: rest[1],
            steps_before: rest[2],
            friction: -rest[3],
        }
    }
}
