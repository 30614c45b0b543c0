//! Messages in the iterations: what owner ranks tell each other of constraints that act on points of both.

use super::communication_plan::CommunicationPlan;
use super::traffic::{MessagePattern, VariableMessages};
use crate::comm::{Communicator, ExactSum};
use crate::model::Friction;
use crate::solver::contact::enforcement::accounts::certificate::Sums;
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::enforcement::constraint::{Constraint, ConstraintState, MEMBERS, Origin, Response};
use crate::solver::contact::enforcement::other_ranks::{OtherRanks, find_largest, gather_numbers};
use crate::solver::contact::local_problem::Numbering;

/// What owner ranks tell each other in a step.
#[derive(Default)]
pub struct IterationMessages {
    rank: u32,
    /// Owner rank of each point of the local problem, where constraints may act on it.
    owner_ranks: Vec<u32>,
    /// Points by number of the layout: those of the local problem, then its ghosts.
    points: Vec<u32>,
    ghosts: Vec<u32>,
    shares: MessagePattern,
    letters: VariableMessages,
}

impl IterationMessages {
    /// The messages of `plan` between points of a local problem with this numbering, whose owner ranks are given by their
    /// places.
    pub fn new(
        rank: u32,
        owner_ranks: Vec<u32>,
        numbering: &Numbering,
        shares: MessagePattern,
        plan: &CommunicationPlan,
    ) -> IterationMessages {
        let letters = VariableMessages::new(plan.partners.iter().map(|&rank| rank as usize));
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
        IterationExchange { iteration_messages: self, comm }
    }
}

/// What owner ranks tell each other, with the means to do it.
pub struct IterationExchange<'a> {
    iteration_messages: &'a mut IterationMessages,
    comm: &'a mut dyn Communicator,
}

impl OtherRanks for IterationExchange<'_> {
    fn copy(&mut self, constraints: &mut Vec<Constraint>, states: &mut Vec<ConstraintState>) {
        let IterationMessages { rank, owner_ranks, points, ghosts, letters, .. } = &mut *self.iteration_messages;
        let number = |point: u32| match points.get(point as usize) {
            Some(&number) => number,
            None => ghosts[point as usize - points.len()],
        };
        let place = |number: u32| match points.binary_search(&number) {
            Ok(place) => place as u32,
            Err(_) => {
                let ghost = ghosts.binary_search(&number).expect("the communication plan tells of every member");
                (points.len() + ghost) as u32
            }
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
            |letter| come.extend(letter.as_chunks().0.iter().map(|numbers| unpack(numbers, place))),
            self.comm,
        );
        for (constraint, state) in come {
            constraints.push(constraint);
            states.push(state);
        }
    }

    fn share(&mut self, responses: &mut [Response], largest: &mut [f64]) {
        let shares = &mut self.iteration_messages.shares;
        shares.send(|point| responses[point as usize].to_array(), self.comm);
        find_largest(largest, self.comm);
        shares.receive(|point, values| responses[point as usize] = Response::from_array(values), self.comm);
    }

    fn sum(&mut self, sums: &mut Sums) {
        ExactSum::merge_ranks(&mut sums.0, self.comm);
    }

    fn merge(&mut self, sums: &mut [ExactSum]) {
        ExactSum::merge_ranks(sums, self.comm);
    }

    fn gather(&mut self, own: Vec<f64>) -> Vec<f64> {
        gather_numbers(&own, self.comm)
    }

    fn are_there(&self) -> bool {
        true
    }
}

/// Numbers of a constraint on its way.
const COPY: usize = 4 * MEMBERS + 23;

/// A row of numbers that is written or read from its beginning to its end.
struct Row {
    numbers: [f64; COPY],
    at: usize,
}

impl Row {
    fn put<const N: usize>(&mut self, values: [f64; N]) {
        self.numbers[self.at..self.at + N].copy_from_slice(&values);
        self.at += N;
    }

    fn take<const N: usize>(&mut self) -> [f64; N] {
        let at = self.at;
        self.at += N;
        std::array::from_fn(|i| self.numbers[at + i])
    }
}

/// A constraint as numbers, but for what only the rank that has made it asks for; `members` are numbers of the layout.
fn pack(c: &Constraint, state: &ConstraintState, members: [u32; MEMBERS]) -> [f64; COPY] {
    let Friction { at_rest, high_speed, decay } = c.friction;
    let mut row = Row { numbers: [0.0; COPY], at: 0 };
    row.put(members.map(f64::from));
    row.put(c.weights);
    row.put(c.normal);
    row.put(c.carried.tangential_force);
    row.put(state.slip);
    row.put([at_rest, high_speed, decay]);
    row.put([c.count as f64, c.size, c.share, c.carried.normal_force, state.closing, state.strength]);
    row.put([f64::from(u8::from(c.yields)), state.compliance]);
    row.put(c.origin.to_array());
    state.softness.into_iter().for_each(|of_member| row.put(of_member));
    row.numbers
}

/// A constraint from these numbers; `place` gives the local number of a point of the layout.
fn unpack(numbers: &[f64; COPY], place: impl Fn(u32) -> u32) -> (Constraint, ConstraintState) {
    let mut row = Row { numbers: *numbers, at: 0 };
    let members = row.take::<MEMBERS>().map(|number| place(number as u32));
    let weights = row.take();
    let normal = row.take();
    let tangential_force = row.take();
    let slip = row.take();
    let [at_rest, high_speed, decay] = row.take();
    let [count, size, share, normal_force, closing, strength] = row.take();
    let [yields, compliance] = row.take();
    let origin = Origin::from_array(row.take());
    let softness = std::array::from_fn(|_| row.take());
    let constraint = Constraint {
        members,
        weights,
        normal,
        size,
        share,
        count: count as usize,
        friction: Friction { at_rest, high_speed, decay },
        yields: yields != 0.0,
        // Only its own rank asks for these.
        gap: 0.0,
        growth: 0.0,
        persists: true,
        is_thick: false,
        carried: Carried { penetration: 0.0, normal_force, tangential_force },
        origin,
    };
    (constraint, ConstraintState { strength, softness, slip, closing, compliance, ..Default::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constraint_arrives_as_it_was_sent() {
        for origin in [Origin::Face(7, 2), Origin::Edges(3, 9), Origin::Plane(5)] {
            let constraint = Constraint {
                members: [10, 11, 12, 13, 14],
                weights: [1.0, -0.1, -0.2, -0.3, -0.4],
                count: 5,
                normal: [0.6, -0.0, 0.8],
                gap: 0.0,
                growth: 0.0,
                persists: true,
                yields: true,
                is_thick: false,
                size: 0.01,
                share: 0.5,
                friction: Friction { at_rest: 0.3, high_speed: 0.2, decay: 4.0 },
                carried: Carried { penetration: 0.0, normal_force: 17.0, tangential_force: [1.5, -2.5, 3.5] },
                origin,
            };
            let state = ConstraintState {
                strength: 6.0,
                compliance: 0.7,
                softness: [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0], [9.0, 10.0]],
                slip: [0.1, 0.2, -0.3],
                closing: -1e-3,
                ..Default::default()
            };
            let numbers = pack(&constraint, &state, constraint.members.map(|place| place + 100));
            let (unpacked, its_state) = unpack(&numbers, |number| number - 100);
            assert_eq!(unpacked, constraint);
            assert_eq!(pack(&unpacked, &its_state, constraint.members.map(|place| place + 100)), numbers);
            assert_eq!((its_state.strength, its_state.closing, its_state.slip), (6.0, -1e-3, state.slip));
            assert_eq!(its_state.compliance, 0.7);
            assert_eq!(its_state.softness, state.softness);
        }
    }
}
