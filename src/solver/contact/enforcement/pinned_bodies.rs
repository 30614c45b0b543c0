//! Rigid bodies that are pinned: between what cannot give way, with less room than they need.
//!
//! As with nodes (`pinned`) two constraints that push a body against each other along one line can each be met alone, but
//! not both. Unmet they would grow with every iteration, shake the body, and ask for more in the next step: what drives the tools would
//! pay for it without end. So constraints that ask for more than there is stay short by half of what is missing. Pushes against each
//! other along different lines can be met by a turn, as those on a lever, unless a third is in the way: they share where the iterations
//! have run out. All ranks hear of all such constraints, and share alike.

use super::constraint::{Constraint, ConstraintState, Origin};
use super::enforcer::HELD;
use super::other_ranks::OtherRanks;
use super::pinned::OPPOSED;
use crate::common::vector::{add, cross, dot, scaled};
use crate::solver::contact::geometry::motion::NodeMotion;

/// All directions of pushes are within this cosine of their mean where no two of them can be opposed.
const ALL_AROUND: f64 = 0.3;

/// A constraint that only one rigid body can meet.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Push {
    /// The body.
    body: usize,
    /// What the constraint comes from.
    origin: Origin,
    /// Where the force acts on the body, and in which direction.
    at: [f64; 3],
    direction: [f64; 3],
    /// How far it would stay behind its target, a length, negative where it would; and the length that is small against.
    closing: f64,
    size: f64,
}

/// Numbers of a [`Push`] in messages.
const WIDTH: usize = 12;

impl Push {
    /// The push of a constraint; `None` where another body or node gives way as well, or nothing does.
    fn of(c: &Constraint, state: &ConstraintState, motion: &NodeMotion) -> Option<Push> {
        let (mut body, mut weight, mut at) = (None, 0.0, [0.0; 3]);
        for ((point, w), [along, most]) in c.parts().zip(state.softness) {
            if along <= HELD * most {
                continue;
            }
            let own = motion.mobility.of(point)?;
            if *body.get_or_insert(own) != own {
                return None;
            }
            (weight, at) = (weight + w, add(at, scaled(motion.start(point as u32), w)));
        }
        let body = body.filter(|_| state.strength > 0.0 && weight != 0.0)?;
        Some(Push {
            body,
            origin: c.origin,
            at: scaled(at, 1.0 / weight),
            direction: scaled(c.normal, weight.signum()),
            closing: state.closing,
            size: c.size,
        })
    }

    fn to_array(self) -> [f64; WIDTH] {
        let [kind, a, b] = self.origin.to_array();
        let ([x, y, z], [u, v, w]) = (self.at, self.direction);
        [self.body as f64, kind, a, b, x, y, z, u, v, w, self.closing, self.size]
    }

    fn from_array([body, kind, a, b, x, y, z, u, v, w, closing, size]: [f64; WIDTH]) -> Push {
        let origin = Origin::from_array([kind, a, b]);
        Push { body: body as usize, origin, at: [x, y, z], direction: [u, v, w], closing, size }
    }

    /// Whether two pushes on a body are against each other.
    fn is_against(&self, other: &Push) -> bool {
        dot(self.direction, other.direction) <= OPPOSED
    }

    /// Whether they are so nearly along one line that no turn of the body can meet both.
    fn is_in_line_with(&self, other: &Push) -> bool {
        let arm = cross(add(self.at, scaled(other.at, -1.0)), self.direction);
        let reach = self.size.min(other.size);
        dot(arm, arm) <= reach * reach
    }
}

/// Which pushes against each other share the room.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::solver::contact) enum Among {
    /// Those along one line.
    OneLine,
    /// All.
    All,
}

/// Lets the constraints of pinned bodies ask for no more than there is; whether any of them asks for less now. All ranks call it where
/// there are bodies.
pub(in crate::solver::contact) fn share_room(
    constraints: &[Constraint],
    states: &mut [ConstraintState],
    motion: &NodeMotion,
    (among, others): (Among, &mut dyn OtherRanks),
) -> bool {
    let own = constraints.iter().zip(&*states).filter(|(_, state)| state.own);
    let own: Vec<f64> = own.filter_map(|(c, state)| Push::of(c, state, motion)).flat_map(Push::to_array).collect();
    let mut all: Vec<Push> =
        others.gather(own).as_chunks().0.iter().map(|numbers| Push::from_array(*numbers)).collect();
    all.sort_by_key(|push| (push.body, push.origin));
    let before: Vec<f64> = all.iter().map(|push| push.closing).collect();
    all.chunk_by_mut(|a, b| a.body == b.body).for_each(|pushes| share_of_body(pushes, among));
    let changed = all.iter().zip(before).filter(|(push, before)| push.closing != *before);
    let mut shorter: Vec<(Origin, f64)> = changed.map(|(push, _)| (push.origin, push.closing)).collect();
    shorter.sort_by_key(|(origin, _)| *origin);
    for (c, state) in constraints.iter().zip(states) {
        if let Ok(place) = shorter.binary_search_by_key(&c.origin, |(origin, _)| *origin) {
            (state.closing, state.pinned) = (shorter[place].1, true);
        }
    }
    !shorter.is_empty()
}

/// The same among the pushes on one body.
fn share_of_body(pushes: &mut [Push], among: Among) {
    let mean = pushes.iter().fold([0.0; 3], |sum, push| add(sum, push.direction));
    let length = dot(mean, mean).sqrt();
    if pushes.iter().all(|push| dot(push.direction, mean) > ALL_AROUND * length) {
        return;
    }
    for i in 0..pushes.len() {
        for j in i + 1..pushes.len() {
            let missing = -(pushes[i].closing + pushes[j].closing);
            let [one, other] = [&pushes[i], &pushes[j]];
            if missing > 0.0 && one.is_against(other) && (among == Among::All || one.is_in_line_with(other)) {
                pushes[i].closing += 0.5 * missing;
                pushes[j].closing += 0.5 * missing;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn push(x: f64, direction: f64, closing: f64) -> Push {
        let (at, direction) = ([x, 0.0, 0.0], [0.0, 0.0, direction]);
        Push { body: 1, origin: Origin::Edges(3, 7), at, direction, closing, size: 0.5 }
    }

    #[test]
    fn what_is_missing_is_shared_along_one_line() {
        let shared_among = |pushes: &[Push], among: Among| {
            let mut pushes = pushes.to_vec();
            share_of_body(&mut pushes, among);
            pushes.iter().map(|push| push.closing).collect::<Vec<f64>>()
        };
        let shared = |pushes: &[Push]| shared_among(pushes, Among::OneLine);
        // Up from below by nothing, down from above by 0.2: both give way by half.
        assert_eq!(shared(&[push(0.0, 1.0, 0.0), push(0.25, -1.0, -0.5)]), [0.25, -0.25]);
        // Farther apart, the body can turn.
        assert_eq!(shared(&[push(0.0, 1.0, 0.0), push(0.75, -1.0, -0.5)]), [0.0, -0.5]);
        assert_eq!(shared_among(&[push(0.0, 1.0, 0.0), push(0.75, -1.0, -0.5)], Among::All), [0.25, -0.25]);
        // There is room.
        assert_eq!(shared(&[push(0.0, 1.0, 0.5), push(0.0, -1.0, -0.5)]), [0.5, -0.5]);
        // From one side alone nothing is in the way.
        assert_eq!(shared(&[push(0.0, 1.0, -0.5), push(0.0, 1.0, -0.5)]), [-0.5, -0.5]);
    }

    #[test]
    fn pushes_go_through_messages_as_they_are() {
        for origin in [Origin::Face(4_000_000_000, 2), Origin::Edges(1, 2), Origin::Plane(9)] {
            let push = Push { origin, ..push(0.3, -1.0, -0.1) };
            assert_eq!(Push::from_array(push.to_array()), push);
        }
    }
}
