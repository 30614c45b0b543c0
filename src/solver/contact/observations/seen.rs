//! What contact has met in a run: what the deck could leave out follows from what is missing here.

use super::meetings::Meetings;
use crate::comm::Communicator;
use crate::common::vector::dot;
use crate::solver::contact::enforcement::constraint::Constraint;
use crate::solver::contact::enforcement::iterations::{LOOSER, Outcome};

/// What a looser tolerance would have spared in all steps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Looser {
    /// Iterations, of all steps.
    pub iterations: u64,
    /// How far those of one step moved a constraint at most, as a part of the face's size.
    pub moved: f64,
}

/// What has been met so far. On several ranks each knows its own until [`Seen::merged`].
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// Which blocks have met which.
    pub met: Meetings,
    /// For each rigid plane, whether it had a say in anything.
    pub planes: Vec<bool>,
    /// Time of the first force, infinite where there was none.
    pub first: f64,
    /// Steps before it.
    pub steps_before: f64,
    /// Largest part of the greatest possible friction that was used, without dimension; negative where none was possible.
    pub friction: f64,
    /// Whether friction was ever as large as it can be, also while the forces of a step were sought.
    pub slid: bool,
    /// Steps in which iterations were made.
    pub steps: u64,
    /// Iterations made.
    pub iterations: u64,
    /// What tolerances so many times as large would have spared; the same on all ranks.
    pub looser: [Looser; LOOSER.len()],
}

impl Seen {
    /// Nothing yet.
    pub fn nothing(blocks: usize, planes: usize) -> Seen {
        Seen {
            met: Meetings::new(blocks),
            planes: vec![false; planes],
            first: f64::INFINITY,
            steps_before: f64::INFINITY,
            friction: -1.0,
            slid: false,
            steps: 0,
            iterations: 0,
            looser: Default::default(),
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

    /// A plane that had a say.
    pub fn push(&mut self, plane: u32) {
        if let Some(pushed) = self.planes.get_mut(plane as usize) {
            *pushed = true;
        }
    }

    /// The iterations of a step.
    pub fn iterate(&mut self, outcome: &Outcome) {
        self.steps += u64::from(outcome.iterations > 0);
        self.iterations += u64::from(outcome.iterations);
        for (all, spared) in self.looser.iter_mut().zip(&outcome.looser) {
            all.iterations += u64::from(spared.iterations);
            all.moved = all.moved.max(spared.moved);
        }
    }

    /// What all ranks have met, on all of them. All ranks call it.
    pub fn merged(&self, comm: &mut dyn Communicator) -> Seen {
        let missing = |met: &bool| if *met { 0.0 } else { 1.0 };
        let mut votes: Vec<f64> = self.planes.iter().chain([&self.slid]).map(missing).collect();
        votes.extend([self.first, self.steps_before, -self.friction]);
        comm.all_min(&mut votes);
        let met = |vote: &f64| *vote == 0.0;
        let (planes, rest) = votes.split_at(self.planes.len());
        Seen {
            met: self.met.merged(comm),
            planes: planes.iter().map(met).collect(),
            slid: rest.first().is_some_and(met),
            first: rest[1],
            steps_before: rest[2],
            friction: -rest[3],
            ..*self
        }
    }
}
