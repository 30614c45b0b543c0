//! Messages in the iterations: what owner ranks tell each other of constraints that act on points of both.

use super::communication_plan::CommunicationPlan;
use super::traffic::{Lists, MessagePattern, VariableMessages};
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
    /// Owner rank of each point of the local problem and of its ghosts, where constraints may act on it.
    owner_ranks: Vec<u32>,
    /// Points by number of the layout: those of the local problem, then its ghosts.
    points: Vec<u32>,
    ghosts: Vec<u32>,
    letters: VariableMessages,
    /// Between members of the constraints of this step that act on points of several ranks.
    shares: MessagePattern,
}

impl IterationMessages {
    /// The messages of `plan` between points of a local problem with this numbering.
    pub fn new(rank: u32, numbering: &Numbering, plan: &CommunicationPlan) -> IterationMessages {
        let Numbering { points, ghosts, .. } = numbering;
        let mut messages = IterationMessages {
            rank,
            owner_ranks: vec![rank; points.len() + ghosts.len()],
            points: points.clone(),
            ghosts: ghosts.clone(),
            letters: VariableMessages::new(plan.partners.iter().map(|&rank| rank as usize)),
            shares: MessagePattern::default(),
        };
        for (&owner_rank, come) in &plan.receive {
            for &point in come {
                let place = messages.place(point) as usize;
                messages.owner_ranks[place] = owner_rank;
            }
        }
        messages
    }

    /// With the means to send them.
    pub fn over<'a>(&'a mut self, comm: &'a mut dyn Communicator) -> IterationExchange<'a> {
        IterationExchange { iteration_messages: self, comm }
    }

    /// Number of a point in the layout.
    fn number(&self, place: u32) -> u32 {
        let place = place as usize;
        self.points.get(place).copied().unwrap_or_else(|| self.ghosts[place - self.points.len()])
    }

    /// Local number of a point of the layout.
    fn place(&self, number: u32) -> u32 {
        let ghost = || self.ghosts.binary_search(&number).expect("the communication plan tells of every member");
        self.points.binary_search(&number).unwrap_or_else(|_| self.points.len() + ghost()) as u32
    }

    /// Lets the owner ranks of these constraints' members, and the rank that has made each, tell each other how all its members respond:
    /// of the points on which constraints may act until the next search, a few in a hundred.
    fn connect<'a>(&mut self, crossing: impl Iterator<Item = (u32, &'a Constraint)>) {
        let (mut send, mut receive) = (Lists::new(), Lists::new());
        let mut ranks: Vec<u32> = Vec::new();
        for (maker, c) in crossing {
            ranks.clear();
            ranks
                .extend(c.parts().map(|(point, _)| self.owner_ranks[point]).chain([maker]).filter(|&r| r != self.rank));
            for (point, _) in c.parts() {
                match self.owner_ranks[point] {
                    owner_rank if owner_rank == self.rank => {
                        ranks.iter().for_each(|&to| send.entry(to as usize).or_default().push(point as u32));
                    }
                    owner_rank => receive.entry(owner_rank as usize).or_default().push(point as u32),
                }
            }
        }
        for list in send.values_mut().chain(receive.values_mut()) {
            list.sort_unstable_by_key(|&point| self.number(point));
            list.dedup();
        }
        self.shares = MessagePattern::new(send, receive, self.rank as usize);
    }
}

/// What owner ranks tell each other, with the means to do it.
pub struct IterationExchange<'a> {
    iteration_messages: &'a mut IterationMessages,
    comm: &'a mut dyn Communicator,
}

impl OtherRanks for IterationExchange<'_> {
    fn copy(&mut self, constraints: &mut Vec<Constraint>, states: &mut Vec<ConstraintState>) {
        let messages = &mut *self.iteration_messages;
        let mut letters = std::mem::take(&mut messages.letters);
        let acts_on = |c: &Constraint, rank: u32| c.parts().any(|(point, _)| messages.owner_ranks[point] == rank);
        let is_crossing = |c: &Constraint| c.parts().any(|(point, _)| messages.owner_ranks[point] != messages.rank);
        let own: Vec<usize> = (0..constraints.len()).filter(|&i| is_crossing(&constraints[i])).collect();
        let mut come: Vec<(u32, Constraint, ConstraintState)> = Vec::new();
        letters.exchange(
            |to, letter| {
                for &i in own.iter().filter(|&&i| acts_on(&constraints[i], to as u32)) {
                    let members = constraints[i].members.map(|member| messages.number(member));
                    letter.extend(pack(&constraints[i], &states[i], members));
                }
            },
            |from, letter| {
                come.extend(letter.as_chunks().0.iter().map(|numbers| {
                    let (constraint, state) = unpack(numbers, |number| messages.place(number));
                    (from as u32, constraint, state)
                }));
            },
            self.comm,
        );
        messages.letters = letters;
        let made_here = own.iter().map(|&i| (messages.rank, &constraints[i]));
        let crossing: Vec<(u32, &Constraint)> = made_here.chain(come.iter().map(|(from, c, _)| (*from, c))).collect();
        messages.connect(crossing.into_iter());
        for (_, constraint, state) in come {
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

    fn example(members: [u32; MEMBERS], count: usize, origin: Origin) -> Constraint {
        Constraint {
            members,
            weights: [1.0, -0.1, -0.2, -0.3, -0.4],
            count,
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
        }
    }

    #[test]
    fn a_constraint_arrives_as_it_was_sent() {
        for origin in [Origin::Face(7, 2), Origin::Edges(3, 9), Origin::Plane(5)] {
            let constraint = example([10, 11, 12, 13, 14], 5, origin);
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

    #[test]
    fn members_of_what_acts_on_several_ranks_are_shared_and_no_others() {
        // Points 0, 1 and 2 are of these ranks, and 3 and 4 of the last; the first rank makes a constraint on 0, 1 and 3, and one on 0 alone.
        let owner_ranks = [0, 1, 2, 2, 2];
        let told = crate::comm::run_threads(3, |comm| {
            let rank = comm.rank();
            let mut messages = IterationMessages {
                rank: rank as u32,
                owner_ranks: owner_ranks.to_vec(),
                points: (10..15).collect(),
                ghosts: Vec::new(),
                letters: VariableMessages::new((0..3).filter(|&other| other != rank)),
                shares: MessagePattern::default(),
            };
            let (mut constraints, mut states) = (Vec::new(), Vec::new());
            if rank == 0 {
                constraints =
                    vec![example([0, 1, 3, 0, 0], 3, Origin::Face(1, 0)), example([0; MEMBERS], 1, Origin::Plane(1))];
                states = vec![ConstraintState::default(); 2];
            }
            let mut others = messages.over(comm);
            others.copy(&mut constraints, &mut states);
            // Each rank knows how its own points respond.
            let own = |owner_rank: u32| if owner_rank as usize == rank { 1.0 + owner_rank as f64 } else { 0.0 };
            let mut responses = owner_ranks.map(|owner_rank| Response { load: own(owner_rank), ..Response::default() });
            let mut largest = [rank as f64, -(rank as f64)];
            others.share(&mut responses, &mut largest);
            assert_eq!((largest, constraints.len()), ([2.0, 0.0], if rank == 0 { 2 } else { 1 }));
            Ok::<_, ()>(responses.map(|response| response.load))
        });
        let expected = [[1.0, 2.0, 0.0, 3.0, 0.0], [1.0, 2.0, 0.0, 3.0, 0.0], [1.0, 2.0, 3.0, 3.0, 3.0]];
        assert_eq!(told.unwrap(), expected);
    }
}
