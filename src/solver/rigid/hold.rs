//! What holds or drives a rigid body: nodes of node sets, each along one axis.
//!
//! A node that is held says something of all six unknowns of its body. Of the many nodes of a set four are enough, that do not lie
//! in a plane: if they go where they shall, all do, as far as a rigid body can.

use super::body::{Compliance, Six, applied, product};
use super::turn::Quaternion;
use crate::mesh::Mesh;
use crate::model::{Function, Model, MotionKind, Unknown};
use crate::solver::constraints::{Motion, StepTimes};
use crate::vector::{cross, dot, scaled, subtract};

/// A node that holds or drives its body along an axis, or about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// Node of the mesh.
    pub node: u32,
    /// Where it is from the centre of the body at the start.
    pub arm: [f64; 3],
    /// Axis.
    pub axis: usize,
    /// Along it, or about it.
    pub of: Unknown,
    /// What is prescribed; `None` holds it still.
    pub motion: Option<Motion>,
    /// Coordinate at the start.
    pub start: f64,
    /// Velocity over the last step.
    pub speed: f64,
    /// Angle so far.
    pub turned: f64,
    /// Force or moment now.
    pub reaction: f64,
    /// Work done so far.
    pub work: f64,
}

impl Hold {
    /// Force and moment about the centre of a unit reaction, with the arm as it is now.
    pub fn row(&self, arm: [f64; 3]) -> Six {
        let mut axis = [0.0; 3];
        axis[self.axis] = 1.0;
        let moment = cross(arm, axis);
        match self.of {
            Unknown::Position => [axis[0], axis[1], axis[2], moment[0], moment[1], moment[2]],
            Unknown::Rotation => [0.0, 0.0, 0.0, axis[0], axis[1], axis[2]],
        }
    }

    /// By how much a step goes too far that begins `at` a coordinate and goes on by `gone`, or turns.
    pub fn missed(&self, [at, gone]: [f64; 2], turn: Quaternion, functions: &[Function], step: &StepTimes) -> f64 {
        let wanted = |held: f64, so_far: f64| match self.motion {
            None => held,
            Some(Motion { kind, function, scale }) => {
                let value = |t: f64| scale * functions[function].value(t);
                match kind {
                    MotionKind::Displacement => value(step.time + step.drift) - so_far,
                    MotionKind::Velocity => step.drift * value(step.time + 0.5 * step.drift),
                    MotionKind::Acceleration => step.drift * (self.speed + step.kick * value(step.time)),
                }
            }
        };
        match self.of {
            Unknown::Position => gone - wanted(self.start - at, at - self.start),
            Unknown::Rotation => angle(turn, self.axis) - wanted(0.0, self.turned),
        }
    }

    /// Remembers a step.
    pub fn go(&mut self, gone: f64, turn: Quaternion, drift: f64) {
        let angle = angle(turn, self.axis);
        self.turned += angle;
        self.speed = match self.of {
            Unknown::Position => gone,
            Unknown::Rotation => angle,
        } / drift;
    }
}

/// 2 tan(θ/2) about an axis: the spin of straight paths times the step.
pub fn angle(turn: Quaternion, axis: usize) -> f64 {
    2.0 * turn[1 + axis] / turn[0]
}

/// A row that the others hold by all but this part of its own is held by them.
const DEPENDENT: f64 = 1e-8;

/// Rows that do not follow from others, the strongest first, and what forces do to what they leave free.
pub fn independent(rows: &[Six], free: Compliance) -> (Vec<usize>, Compliance) {
    let (mut chosen, mut left) = (Vec::new(), free);
    let own: Vec<f64> = rows.iter().map(|row| product(row, &applied(&free, row))).collect();
    while chosen.len() < 6 {
        let part = |i: usize| product(&rows[i], &applied(&left, &rows[i])) / own[i];
        let best = (0..rows.len())
            .map(|i| (i, part(i)))
            .fold((0, DEPENDENT), |best, one| if one.1 > best.1 { one } else { best });
        if best.1 <= DEPENDENT {
            break;
        }
        let along = applied(&left, &rows[best.0]);
        let over = 1.0 / product(&rows[best.0], &along);
        for i in 0..6 {
            for j in 0..6 {
                left[i][j] -= along[i] * along[j] * over;
            }
        }
        chosen.push(best.0);
    }
    (chosen, left)
}

/// What the deck holds and drives of a body with these nodes and this centre.
pub fn holds(mesh: &Mesh, model: &Model, (nodes, centre): (&[u32], [f64; 3]), positions: &[[f64; 3]]) -> Vec<Hold> {
    let still = model.no_displacements.iter().map(|c| (c.node_set, c.of, c.direction, None));
    let moving = model.prescribed_motions.iter().map(|m| {
        let motion = Motion { kind: m.kind, function: m.function, scale: m.scale };
        (m.node_set, m.of, m.direction, Some(motion))
    });
    let mut holds: Vec<Hold> = Vec::new();
    for (set, of, direction, motion) in still.chain(moving) {
        let axis = direction.axis();
        let of_set = mesh.node_set(set).map_or(&[][..], |set| &set.nodes);
        let mut own: Vec<u32> = of_set.iter().filter(|node| nodes.binary_search(node).is_ok()).copied().collect();
        own.sort_unstable();
        own.dedup();
        if of == Unknown::Rotation {
            // The body turns as one.
            own.truncate(1);
            if holds.iter().any(|hold| hold.of == of && hold.axis == axis) {
                continue;
            }
        }
        for node in spanning(&own, positions) {
            // A node is held once in each direction, the first command counts.
            if holds.iter().any(|hold| hold.node == node && hold.axis == axis && hold.of == of) {
                continue;
            }
            let (at, start) = (positions[node as usize], mesh.coordinates[node as usize][axis]);
            let arm = subtract(at, centre);
            holds.push(Hold { node, arm, axis, of, motion, start, speed: 0.0, turned: 0.0, reaction: 0.0, work: 0.0 });
        }
    }
    holds
}

/// At most four of some nodes, far from each other: as many as it takes to say where all are.
fn spanning(nodes: &[u32], positions: &[[f64; 3]]) -> Vec<u32> {
    let Some(&first) = nodes.first() else { return Vec::new() };
    let from = |node: u32| subtract(positions[node as usize], positions[first as usize]);
    let mut chosen = vec![first];
    let mut rests: Vec<[f64; 3]> = nodes.iter().map(|&node| from(node)).collect();
    let mut size = 0.0;
    while chosen.len() < 4 {
        let length = |i: usize| dot(rests[i], rests[i]).sqrt();
        let farthest =
            (0..rests.len()).fold((0, 0.0), |best, i| if length(i) > best.1 { (i, length(i)) } else { best });
        size = f64::max(size, farthest.1);
        if farthest.1 <= 1e-6 * size || farthest.1 == 0.0 {
            break;
        }
        let along = scaled(rests[farthest.0], 1.0 / farthest.1);
        rests.iter_mut().for_each(|rest| *rest = subtract(*rest, scaled(along, dot(*rest, along))));
        chosen.push(nodes[farthest.0]);
    }
    chosen
}
