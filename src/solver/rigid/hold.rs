//! What holds or drives a rigid body: nodes of node sets, each along one axis.
//!
//! Nodes that go alike along an axis say something of all six unknowns of their body: where one of them is along the axis,
//! and, unless they lie on a line aslant, that the body turns about no other axis.

use super::body::{Compliance, Six, applied, product};
use super::turn::Quaternion;
use crate::common::vector::{cross, dot, scaled, subtract};
use crate::mesh::Mesh;
use crate::model::{Function, Model, MotionKind, Unknown};
use crate::solver::constraints::{Motion, StepTimes};

/// A node that holds or drives its body along an axis, or about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// Node of the mesh.
    pub node: u32,
    /// Its number in the file.
    pub id: i64,
    /// Where it is from the centre of the body at the start.
    pub arm: [f64; 3],
    /// Axis.
    pub axis: usize,
    /// Along it, or about it.
    pub of: Unknown,
    /// What is prescribed; `None` holds it still.
    pub motion: Option<Motion>,
    /// What the command that asks for it holds or drives, along which axis, and how.
    pub asked: (Unknown, usize, Option<MotionKind>),
    /// Coordinate at the start; of what begins to be held when a run goes on, where it is then.
    pub start: f64,
    /// Whether it begins to be held in the coming step: that stops what moves, which is work.
    pub begins: bool,
    /// Velocity over the last step.
    pub speed: f64,
    /// Angle so far.
    pub turned: f64,
    /// How far the node is from where it is to be, a length, or an angle: the body cannot do all that it is told.
    pub strayed: f64,
    /// By how much the coming step misses.
    pub missing: f64,
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

    /// The command that asks for it, with its axis.
    pub fn command(&self) -> String {
        let (of, axis, kind) = self.asked;
        let name = match (of, kind) {
            (Unknown::Position, None) => "NO DISPLACEMENT",
            (Unknown::Position, Some(MotionKind::Displacement)) => "PRESCRIBED DISPLACEMENT",
            (Unknown::Position, Some(MotionKind::Velocity)) => "PRESCRIBED VELOCITY",
            (Unknown::Position, Some(MotionKind::Acceleration)) => "PRESCRIBED ACCELERATION",
            (Unknown::Rotation, None) => "NO ROTATION",
            (Unknown::Rotation, Some(MotionKind::Displacement)) => "PRESCRIBED ROTATION",
            (Unknown::Rotation, Some(_)) => "PRESCRIBED ANGULAR VELOCITY",
        };
        format!("{name}, {}", ["X", "Y", "Z"][axis])
    }

    /// Remembers a step.
    pub fn go(&mut self, gone: f64, turn: Quaternion, drift: f64) {
        self.begins = false;
        self.strayed = match self.motion.map(|motion| motion.kind) {
            None | Some(MotionKind::Displacement) => self.missing,
            Some(MotionKind::Velocity | MotionKind::Acceleration) => self.strayed + self.missing,
        };
        let angle = angle(turn, self.axis);
        self.turned += angle;
        self.speed = match self.of {
            Unknown::Position => gone,
            Unknown::Rotation => angle,
        } / drift;
    }
}

/// θ n of the rotation about an axis n by the angle θ, along one axis.
fn angle([real, x, y, z]: Quaternion, axis: usize) -> f64 {
    let q = [x, y, z];
    let sine = dot(q, q).sqrt();
    if sine > 0.0 { 2.0 * libm::atan2(sine, real) * (q[axis] / sine) } else { 0.0 }
}

/// 2 tan(θ/2) n along an axis: the spin of straight paths times the step.
pub fn spin_of_chords(turn: Quaternion, axis: usize) -> f64 {
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
    if chosen.len() == 6 {
        // What is left is round-off.
        left = [[0.0; 6]; 6];
    }
    (chosen, left)
}

/// Nodes of a body that the deck holds or drives alike along an axis.
struct Alike {
    of: Unknown,
    axis: usize,
    motion: Option<Motion>,
    nodes: Vec<u32>,
}

/// What the deck holds and drives of a body with these nodes and this centre.
pub fn holds(mesh: &Mesh, model: &Model, (nodes, centre): (&[u32], [f64; 3]), positions: &[[f64; 3]]) -> Vec<Hold> {
    let hold = |node: u32, (of, axis): (Unknown, usize), alike: &Alike| Hold {
        node,
        id: mesh.node_ids.get(node as usize).copied().unwrap_or(0),
        arm: subtract(positions[node as usize], centre),
        axis,
        of,
        // Where all go alike along an axis, nothing turns about the others.
        motion: if of == alike.of { alike.motion } else { None },
        asked: (alike.of, alike.axis, alike.motion.map(|motion| motion.kind)),
        start: mesh.coordinates[node as usize][axis],
        begins: false,
        speed: 0.0,
        turned: 0.0,
        strayed: 0.0,
        missing: 0.0,
        reaction: 0.0,
        work: 0.0,
    };
    let mut holds: Vec<Hold> = Vec::new();
    for alike in held_alike(mesh, model, nodes) {
        let (of, axis) = (alike.of, alike.axis);
        // The body turns as one.
        let most = if of == Unknown::Rotation { 1 } else { MOST_SPANNING };
        let own = spanning(&alike.nodes, positions, most);
        if of == Unknown::Rotation || !are_level(&own, axis, positions) {
            holds.extend(own.into_iter().map(|node| hold(node, (of, axis), &alike)));
            continue;
        }
        let first = own.first().copied();
        holds.extend(first.map(|node| hold(node, (of, axis), &alike)));
        let across = [(axis + 1) % 3, (axis + 2) % 3];
        holds.extend(first.iter().flat_map(|&node| across.map(|other| hold(node, (Unknown::Rotation, other), &alike))));
    }
    holds
}

/// The commands that hold or drive nodes of a body, with the nodes, ascending. A node is held once in each direction, the
/// first command counts.
fn held_alike(mesh: &Mesh, model: &Model, nodes: &[u32]) -> Vec<Alike> {
    let still = model.no_displacements.iter().map(|c| (c.node_set, c.of, c.direction, None));
    let moving = model.prescribed_motions.iter().map(|m| {
        let motion = Motion { kind: m.kind, function: m.function, scale: m.scale };
        (m.node_set, m.of, m.direction, Some(motion))
    });
    let mut all: Vec<Alike> = Vec::new();
    for (set, of, direction, motion) in still.chain(moving) {
        let axis = direction.axis();
        let taken = |node: &u32| {
            let mut before = all.iter().filter(|alike| alike.of == of && alike.axis == axis);
            before.any(|alike| alike.nodes.binary_search(node).is_ok())
        };
        let mut own = mesh.distinct_nodes(set);
        own.retain(|node| nodes.binary_search(node).is_ok() && (of == Unknown::Rotation || !taken(node)));
        match all.iter_mut().find(|alike| (alike.of, alike.axis, alike.motion) == (of, axis, motion)) {
            Some(alike) => {
                alike.nodes.extend(own);
                alike.nodes.sort_unstable();
            }
            None => all.push(Alike { of, axis, motion, nodes: own }),
        }
    }
    all
}

/// Whether nodes that go alike along an axis, of which these span the others, let their body turn about that axis only.
/// Their differences d keep their components along the axis a: u = Rᵀa with u·d = a·d for all of them. Two differences in
/// different directions leave a itself and its mirror image in their plane; one leaves a circle, which is a point where d
/// is along a. Equations for the single nodes would say less: those of differences in a plane with a are of second order,
/// and hold only once the body has turned.
fn are_level(spanning: &[u32], axis: usize, positions: &[[f64; 3]]) -> bool {
    match *spanning {
        [] | [_] => false,
        [a, b] => {
            let d = subtract(positions[b as usize], positions[a as usize]);
            d[axis].abs() >= (1.0 - 1e-6) * dot(d, d).sqrt()
        }
        _ => true,
    }
}

/// Nodes that say how a body may turn: a third that is not on the line of two others ends the question.
const MOST_SPANNING: usize = 3;

/// At most so many of some nodes, far from each other: those that span the line or plane of all.
fn spanning(nodes: &[u32], positions: &[[f64; 3]], most: usize) -> Vec<u32> {
    let Some(&first) = nodes.first() else { return Vec::new() };
    let from = |node: u32| subtract(positions[node as usize], positions[first as usize]);
    let mut chosen = vec![first];
    let mut rests: Vec<[f64; 3]> = nodes.iter().map(|&node| from(node)).collect();
    let mut size = 0.0;
    while chosen.len() < most {
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
