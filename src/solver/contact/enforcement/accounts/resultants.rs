//! Resultants of contact forces that the deck asks for: of rigid surfaces on a side set, and between blocks.
//!
//! Contact pushes in blows: the force of one step says little. What is kept are the impulse and the works of all steps so far,
//! in exact sums, so that neither the order of constraints nor the number of ranks shows; the force that is told is the change
//! of impulse over the interval since the last state, and its sum over all intervals is the change of momentum.

use crate::comm::{Communicator, ExactSum};
use crate::common::vector::{add, dot, scaled};
use crate::restart::Archive;
use crate::solver::constraints::StepTimes;
use crate::solver::contact::enforcement::constraint::Constraint;

/// Numbers of a resultant: force (three), works (two), energy dissipated by friction.
pub const COUNT: usize = 6;

/// Columns in restart files: what it is, its numbers, a number of the value, the value.
const WIDTH: usize = 5;

/// What a value in a restart file is beyond the sums: the time and the impulse of the last state.
const TIME: usize = COUNT;

/// More parts than any sum of doubles has: what is not finite has no parts.
const PARTS: usize = 64;

/// Whose contact forces are summed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// Rigid surfaces on the nodes of this side set.
    Wall(i64),
    /// What the second block of the mesh does to the first; numbers of blocks.
    Pair(i64, i64),
    /// What all other blocks do to this one; its number.
    Others(i64),
}

impl Subject {
    /// As numbers in a restart file.
    fn key(self) -> [f64; 3] {
        match self {
            Subject::Wall(id) => [0.0, id as f64, 0.0],
            Subject::Pair(first, second) => [1.0, first as f64, second as f64],
            Subject::Others(block) => [2.0, block as f64, 0.0],
        }
    }

    /// Which of two sides are the first and the second that it tells of: `[first, second]` for each. A block against itself has both
    /// sides as its first.
    fn roles(self, [one, other]: [Side; 2]) -> [[bool; 2]; 2] {
        let matches = |one: Side, other: Side| match (self, one, other) {
            (Subject::Wall(id), Side::Block(_), Side::Wall(wall)) => id == wall,
            (Subject::Pair(first, second), Side::Block(a), Side::Block(b)) => first == a && second == b,
            (Subject::Others(block), Side::Block(a), Side::Block(b)) => block == a && block != b,
            _ => false,
        };
        let (forth, back) = (matches(one, other), matches(other, one));
        [[forth, back && !forth], [back, forth && !back]]
    }
}

/// One side of a constraint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The block with this number.
    Block(i64),
    /// Rigid surfaces for the side set with this number.
    Wall(i64),
}

/// What the forces of a constraint do to one of its sides in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Share {
    /// Impulse, mass times velocity.
    impulse: [f64; 3],
    /// Works of all forces with the velocities half a step before and after, energies.
    works: [f64; 2],
    /// The parts of friction in them.
    friction: [f64; 2],
}

impl Share {
    /// Adds what a constraint does to a member that weighs `weight` in it and moves with the velocities `around` the present time.
    pub fn add(&mut self, c: &Constraint, weight: f64, around: [[f64; 3]; 2], kick: f64) {
        let friction = scaled(c.carried.tangential_force, weight * kick);
        let impulse = add(scaled(c.normal, weight * kick * c.carried.normal_force), friction);
        self.impulse = add(self.impulse, impulse);
        for (half, velocity) in around.into_iter().enumerate() {
            self.works[half] += 0.5 * dot(impulse, velocity);
            self.friction[half] += 0.5 * dot(friction, velocity);
        }
    }
}

/// The resultants of one rank.
#[derive(Debug, Clone, Default)]
pub struct Resultants {
    accounts: Vec<Account>,
}

#[derive(Debug, Clone)]
struct Account {
    subject: Subject,
    /// Of all steps so far, on this rank.
    sums: [ExactSum; COUNT],
    /// What of them belongs to the time after the present state: the second half of this step.
    later: Vec<[f64; COUNT]>,
    /// Time and impulse of the last state that was due.
    last: Option<(f64, [f64; 3])>,
}

impl Resultants {
    /// Nothing so far.
    pub fn new(subjects: impl IntoIterator<Item = Subject>) -> Resultants {
        let account = |subject| Account {
            subject,
            sums: std::array::from_fn(|_| ExactSum::new()),
            later: Vec::new(),
            last: None,
        };
        Resultants { accounts: subjects.into_iter().map(account).collect() }
    }

    /// Whether nobody asks.
    pub fn is_empty(&self) -> bool {
        self.accounts.is_empty()
    }

    /// A new step begins: the last one is past.
    pub fn begin_step(&mut self) {
        self.accounts.iter_mut().for_each(|account| account.later.clear());
    }

    /// Books what a constraint does to its two sides in a step that begins at the present state.
    pub fn book(&mut self, sides: [Side; 2], shares: &[Share; 2], step: &StepTimes) {
        // The first step brings velocities from the start to the middle of a step: all of it is later.
        let starts = step.time == 0.0;
        for account in &mut self.accounts {
            let roles = account.subject.roles(sides);
            if roles == [[false; 2]; 2] {
                continue;
            }
            let (mut whole, mut later) = ([0.0; COUNT], [0.0; COUNT]);
            for ([first, second], share) in roles.into_iter().zip(shares) {
                let [before, after] = share.works;
                let [friction_before, friction_after] = share.friction;
                if first {
                    (0..3).for_each(|i| whole[i] += share.impulse[i]);
                    whole[3] += before + after;
                    later[3] += after;
                }
                if second {
                    whole[4] += before + after;
                    later[4] += after;
                }
                whole[5] -= friction_before + friction_after;
                later[5] -= friction_after;
            }
            (0..3).for_each(|i| later[i] = 0.5 * whole[i]);
            account.sums.iter_mut().zip(whole).for_each(|(sum, value)| sum.add(value));
            account.later.push(if starts { whole } else { later });
        }
    }

    /// For each subject the mean force on its first side since the last state that was due, a force; the works on its first
    /// and second side so far, and what friction has dissipated between them, energies. On all ranks, which all call it.
    pub fn values(&mut self, time: f64, due: bool, comm: &mut dyn Communicator) -> Vec<[f64; COUNT]> {
        let mut sums: Vec<ExactSum> = self.accounts.iter().flat_map(Account::now).collect();
        if !sums.is_empty() {
            ExactSum::merge_ranks(&mut sums, comm);
        }
        let of = |(account, sums): (&mut Account, &[ExactSum])| {
            let mut values: [f64; COUNT] = std::array::from_fn(|i| sums[i].value());
            let impulse = [values[0], values[1], values[2]];
            let force = match account.last {
                Some((then, before)) if time > then => [0, 1, 2].map(|i| (impulse[i] - before[i]) / (time - then)),
                _ => [0.0; 3],
            };
            if due {
                account.last = Some((time, impulse));
            }
            values[..3].copy_from_slice(&force);
            values
        };
        self.accounts.iter_mut().zip(sums.chunks_exact(COUNT)).map(of).collect()
    }

    /// Visits the state between two steps.
    pub fn visit_state(&mut self, archive: &mut dyn Archive) {
        let mut sums: Vec<ExactSum> = self.accounts.iter().flat_map(|account| account.sums.clone()).collect();
        if !sums.is_empty() && !archive.loading() {
            ExactSum::merge_ranks(&mut sums, archive.comm());
        }
        let mut rows: Vec<f64> = Vec::new();
        if archive.comm().rank() == 0 {
            for (account, sums) in self.accounts.iter().zip(sums.chunks_exact(COUNT)) {
                let mut put = |place: usize, value: f64| {
                    rows.extend(account.subject.key());
                    rows.extend([place as f64, value]);
                };
                sums.iter().enumerate().for_each(|(i, sum)| parts(sum).into_iter().for_each(|part| put(i, part)));
                if let Some((time, impulse)) = account.last {
                    put(TIME, time);
                    (1..).zip(impulse).for_each(|(i, part)| put(TIME + i, part));
                }
            }
        }
        archive.list("CONTRESULT", WIDTH, &mut rows);
        if archive.loading() {
            let first = archive.comm().rank() == 0;
            self.accounts.iter_mut().for_each(|account| account.take_up(rows.as_chunks().0, first));
        }
    }
}

impl Account {
    /// The sums up to the present state.
    fn now(&self) -> [ExactSum; COUNT] {
        let mut now = self.sums.clone();
        for later in &self.later {
            now.iter_mut().zip(later).for_each(|(sum, value)| sum.add(-value));
        }
        now
    }

    /// Goes on from rows of a restart file; sums do not depend on which rank keeps them.
    fn take_up(&mut self, rows: &[[f64; WIDTH]], keeps_sums: bool) {
        *self = Account { subject: self.subject, ..Resultants::new([self.subject]).accounts.remove(0) };
        let key = self.subject.key();
        for &[.., place, value] in rows.iter().filter(|row| row[..3] == key) {
            let place = place as usize;
            match self.sums.get_mut(place) {
                Some(sum) if keeps_sums => sum.add(value),
                Some(_) => (),
                None => {
                    let (time, impulse) = self.last.get_or_insert((0.0, [0.0; 3]));
                    match place - TIME {
                        0 => *time = value,
                        i => impulse.iter_mut().skip(i - 1).take(1).for_each(|part| *part = value),
                    }
                }
            }
        }
    }
}

/// A sum as doubles that add up to it exactly, the largest first.
fn parts(sum: &ExactSum) -> Vec<f64> {
    let mut rest = sum.clone();
    let mut parts = Vec::new();
    while parts.len() < PARTS {
        let part = rest.value();
        if part == 0.0 {
            break;
        }
        parts.push(part);
        rest.add(-part);
        if !part.is_finite() {
            break;
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_add_up_to_the_sum() {
        let mut sum = ExactSum::new();
        (0..1000).for_each(|i| sum.add(1.1f64.powi(i % 97 - 48) * f64::from(i - 400)));
        let mut again = ExactSum::new();
        let parts = parts(&sum);
        assert!(parts.len() < 5, "{parts:?}");
        parts.iter().for_each(|part| again.add(*part));
        again.add(-sum.value());
        let mut rest = sum.clone();
        rest.add(-sum.value());
        assert_eq!(again.value(), rest.value());
        assert!(super::parts(&ExactSum::new()).is_empty());
    }

    #[test]
    fn sides_have_their_roles() {
        let blocks = |a, b| [Side::Block(a), Side::Block(b)];
        let (first, second, none) = ([true, false], [false, true], [false, false]);
        assert_eq!(Subject::Pair(1, 2).roles(blocks(1, 2)), [first, second]);
        assert_eq!(Subject::Pair(1, 2).roles(blocks(2, 1)), [second, first]);
        assert_eq!(Subject::Pair(1, 2).roles(blocks(2, 3)), [none, none]);
        assert_eq!(Subject::Pair(1, 1).roles(blocks(1, 1)), [first, first]);
        assert_eq!(Subject::Others(1).roles(blocks(1, 1)), [none, none]);
        assert_eq!(Subject::Others(1).roles(blocks(7, 1)), [second, first]);
        assert_eq!(Subject::Wall(1).roles([Side::Block(1), Side::Wall(1)]), [first, second]);
        assert_eq!(Subject::Wall(1).roles(blocks(1, 1)), [none, none]);
    }
}
