//! Messages in the passes: what homes tell each other of constraints that act on points of both.

use super::contract::CommunicationPlan;
use super::traffic::{MessagePattern, VariableMessages};
use crate::comm::{Communicator, ExactSum};
use crate::model::Friction;
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::enforcement::certificate::Sums;
use crate::solver::contact::enforcement::constraint::{Constraint, ConstraintState, MEMBERS, Origin, Response};
use crate::solver::contact::enforcement::other_ranks::{OtherRanks, VOTES};
use crate::solver::contact::local_problem::Numbering;

/// What homes tell each other in a step.
#[derive(Default)]
pub struct IterationMessages {
    rank: u32,
    /// Home of each point of the arena, where constraints may act on it.
    owner_ranks: Vec<u32>,
    /// Points by number of the layout: those of the arena, then its ghosts.
    points: Vec<u32>,
    ghosts: Vec<u32>,
    shares: MessagePattern,
    letters: VariableMessages,
}

impl IterationMessages {
    /// The messages of `contract` between points of an arena with this cast, whose homes are given by their places.
    pub fn new(
        rank: u32,
        owner_ranks: Vec<u32>,
        numbering: &Numbering,
        shares: MessagePattern,
        contract: &CommunicationPlan,
    ) -> IterationMessages {
        let letters = VariableMessages::new(contract.partners.iter().map(|&rank| rank as usize));
        IterationMessages {
            rank,
            owner_ranks,
            points: numbering.points.clone(),
            ghosts: numbering.ghosts.clone(),
            shares,
            letters,
        }
    }

    /// With the means to send them.
    pub fn over<'a>(&'a mut self, comm: &'a mut dyn Communicator) -> IterationExchange<'a> {
        IterationExchange { links: self, comm }
    }
}

/// What homes tell each other, with the means to do it.
pub struct IterationExchange<'a> {
    links: &'a mut IterationMessages,
    comm: &'a mut dyn Communicator,
}

impl OtherRanks for IterationExchange<'_> {
    fn copy(&mut self, constraints: &mut Vec<Constraint>, states: &mut Vec<ConstraintState>) {
        let IterationMessages { rank, owner_ranks, points, ghosts, letters, .. } = &mut *self.links;
        let number = |point: u32| match points.get(point as usize) {
            Some(&number) => number,
            None => ghosts[point as usize - points.len()],
        };
        let place = |number: u32| match points.binary_search(&number) {
            Ok(place) => place as u32,
            Err(_) => ghosts.binary_search(&number).map_or(0, |ghost| (points.len() + ghost) as u32),
        };
        let acts_on = |c: &Constraint, rank: u32| c.parts().any(|(point, _)| owner_ranks[point] == rank);
        let own: Vec<(usize, [u32; MEMBERS])> = (constraints.iter().enumerate())
            .filter(|(_, c)| c.parts().any(|(point, _)| owner_ranks[point] != *rank))
            .map(|(i, c)| (i, c.members.map(number)))
            .collect();
        let mut come: Vec<(Constraint, ConstraintState)> = Vec::new();
        letters.exchange(
            |to, letter| {
                for (i, members) in own.iter().filter(|(i, _)| acts_on(&constraints[*i], to as u32)) {
                    letter.extend(pack(&constraints[*i], &states[*i], *members));
                }
            },
            |letter| come.extend(letter.chunks_exact(COPY).map(|v| unpack(v, place))),
            self.comm,
        );
        for (constraint, state) in come {
            constraints.push(constraint);
            states.push(state);
        }
    }

    fn share(&mut self, responses: &mut [Response]) {
        self.links.shares.exchange(
            responses,
            |responses, point| {
                let Response { velocity_change: [x, y, z], load } = responses[point as usize];
                [x, y, z, load]
            },
            |responses, point, [x, y, z, load]| {
                responses[point as usize] = Response { velocity_change: [x, y, z], load }
            },
            self.comm,
        );
    }

    fn largest(&mut self, values: [f64; VOTES]) -> [f64; VOTES] {
        let mut least = values.map(|value| -value);
        self.comm.all_min(&mut least);
        least.map(|value| -value)
    }

    fn sum(&mut self, sums: &mut Sums) {
        ExactSum::merge_ranks(&mut sums.0, self.comm);
    }

    fn are_there(&self) -> bool {
        true
    }
}

/// Numbers of a constraint on its way.
const COPY: usize = 36 + 2 * MEMBERS;

fn pack(c: &Constraint, state: &ConstraintState, members: [u32; MEMBERS]) -> [f64; COPY] {
    let mut v = Vec::with_capacity(COPY);
    v.extend(members.map(f64::from));
    v.extend(c.weights);
    v.extend(c.normal);
    v.extend(c.carried.tangential_force);
    v.extend(state.slip);
    let Friction { at_rest, high_speed, decay } = c.friction;
    let (kind, a, b) = match c.origin {
        Origin::Face(a, b) => (0, a, b),
        Origin::Edges(a, b) => (1, a, b),
        Origin::Plane(a) => (2, a, 0),
    };
    v.extend([
        at_rest,
        high_speed,
        decay,
        state.closing,
        c.size,
        c.share,
        c.carried.normal_force,
        state.strength,
        c.count as f64,
    ]);
    v.extend([kind, a, b].map(f64::from));
    v.extend(state.softness.as_flattened());
    v.resize(COPY, 0.0);
    v.try_into().unwrap_or([0.0; COPY])
}

fn unpack(v: &[f64], place: impl Fn(u32) -> u32) -> (Constraint, ConstraintState) {
    let three = |at: usize| [v[at], v[at + 1], v[at + 2]];
    let (a, b) = (v[29] as u32, v[30] as u32);
    let mut state = ConstraintState { strength: v[26], slip: three(16), closing: v[22], ..Default::default() };
    state.softness.as_flattened_mut().copy_from_slice(&v[31..31 + 2 * MEMBERS]);
    let constraint = Constraint {
        members: [0, 1, 2, 3, 4].map(|i| place(v[i] as u32)),
        weights: [5, 6, 7, 8, 9].map(|i| v[i]),
        normal: three(10),
        friction: Friction { at_rest: v[19], high_speed: v[20], decay: v[21] },
        // Only its own rank asks for these.
        gap: 0.0,
        persists: true,
        size: v[23],
        share: v[24],
        carried: Carried { penetration: 0.0, normal_force: v[25], tangential_force: three(13) },
        count: v[27] as usize,
        origin: match v[28] as u32 {
            0 => Origin::Face(a, b),
            1 => Origin::Edges(a, b),
            _ => Origin::Plane(a),
        },
    };
    (constraint, state)
}
