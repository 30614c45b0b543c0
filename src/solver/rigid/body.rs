//! One rigid body: its six unknowns, what acts on them, and how they go on.

use super::hold::{Hold, independent};
use super::shape::{BodyShape, Matrix};
use super::turn::{self, Quaternion, STRAIGHT, matrix, moved, rotation, solved, times, turned};
use crate::common::vector::{add, cross, dot, scaled};
use crate::model::{Function, Unknown};
use crate::solver::constraints::StepTimes;
use std::f64::consts::PI;

/// A force and its moment about the centre, or a velocity of the centre and an angular velocity.
pub type Six = [f64; 6];

/// What six forces do to six velocities.
pub type Compliance = [[f64; 6]; 6];

/// a · b
pub fn product(a: &Six, b: &Six) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// C f
pub fn applied(c: &Compliance, f: &Six) -> Six {
    std::array::from_fn(|i| product(&c[i], f))
}

/// What turns about the centre of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turning {
    /// Its inertia in space.
    pub inertia: Matrix,
    /// Its angular momentum.
    pub momentum: [f64; 3],
    /// Its kinetic energy.
    pub energy: f64,
}

/// A rigid body. All ranks have the same, to the bit.
#[derive(Debug, Clone)]
pub struct RigidBody {
    /// What it is.
    pub shape: BodyShape,
    /// Centre of mass now.
    pub centre: [f64; 3],
    /// Velocity of the centre over the last step, length per time.
    pub velocity: [f64; 3],
    /// Angular momentum about the centre over the last step.
    pub momentum: [f64; 3],
    /// How far it has turned since the start.
    pub turn: Quaternion,
    /// What holds or drives it.
    pub holds: Vec<Hold>,
    /// Work of its weight, and of the moment on it.
    pub load_work: f64,
    /// Of the step: its matrix of rotation and its inertia in space.
    pub frame: Matrix,
    inertia: Matrix,
    /// What forces do to its velocities, with what holds it.
    pub compliance: Compliance,
    /// The same if nothing held it.
    pub free: Compliance,
    /// Holds that are independent of each other at the start. Others are checked, but not enforced: what would only become
    /// independent as the body moves, would set in with a blow.
    enforced: Vec<usize>,
    /// Those of them that are so now, and how they resist each other.
    chosen: Vec<usize>,
    resistance: Vec<Vec<f64>>,
    /// Force and moment that act in the step, without contact and holds.
    load: Six,
    /// Acceleration of gravity in the step.
    pub gravity: [f64; 3],
    /// Moment of the step that is prescribed for nodes without a rotation of their own.
    pub moment: [f64; 3],
    /// Velocity and angular momentum over the coming step.
    next: ([f64; 3], [f64; 3]),
    /// The last step taken: its rotation and its length.
    last: Option<(Quaternion, f64)>,
}

impl RigidBody {
    /// A body at rest.
    pub fn new(shape: BodyShape, holds: Vec<Hold>) -> RigidBody {
        let mut body = RigidBody {
            centre: shape.centre,
            velocity: [0.0; 3],
            momentum: [0.0; 3],
            turn: STRAIGHT,
            holds,
            load_work: 0.0,
            frame: matrix(STRAIGHT),
            inertia: shape.inertia,
            compliance: [[0.0; 6]; 6],
            free: [[0.0; 6]; 6],
            enforced: Vec::new(),
            chosen: Vec::new(),
            resistance: Vec::new(),
            load: [0.0; 6],
            gravity: [0.0; 3],
            moment: [0.0; 3],
            next: ([0.0; 3], [0.0; 3]),
            last: None,
            shape,
        };
        let free = body.freely();
        let rows: Vec<Six> = body.holds.iter().map(|hold| hold.row(hold.arm)).collect();
        body.enforced = independent(&rows, free).0;
        body
    }

    /// Gives it the momentum and the angular momentum, about the centre, of the velocities and rotation rates of its nodes.
    pub fn set_off(&mut self, [px, py, pz, lx, ly, lz]: Six) {
        self.velocity = scaled([px, py, pz], 1.0 / self.shape.mass);
        // Nodes go and turn as they were told to; the inertia is that of the volume.
        self.momentum = times(&self.shape.inertia, solved(&self.shape.of_nodes, [lx, ly, lz]));
        self.begin();
        // What is held still takes up what it does not allow.
        let still = |hold: &&Hold| hold.motion.is_none();
        let rows: Vec<Six> = self.holds.iter().filter(still).map(|hold| self.row(hold)).collect();
        let (chosen, _) = independent(&rows, self.free);
        let [[u, v, w], [x, y, z]] = self.motion(false);
        let missed: Vec<f64> = chosen.iter().map(|&i| product(&rows[i], &[u, v, w, x, y, z])).collect();
        let impulses = eliminated(&resistance(&rows, &chosen, &self.free), &missed);
        let mut motion = (self.velocity, self.momentum);
        for (&i, impulse) in chosen.iter().zip(impulses) {
            self.strike(&mut motion, &rows[i], -impulse);
        }
        (self.velocity, self.momentum) = motion;
        self.begin();
    }

    /// What it is told and does not do, beyond a hundredth of its size, or of a radian.
    pub fn astray(&self) -> Option<&Hold> {
        let trace: f64 = (0..3).map(|i| self.shape.inertia[i][i]).sum();
        let size = (trace / self.shape.mass).sqrt();
        let limit = |hold: &Hold| ASTRAY * if hold.of == Unknown::Position { size } else { 1.0 };
        self.holds.iter().find(|hold| hold.strayed.is_nan() || hold.strayed.abs() > limit(hold))
    }

    /// Finds frame and inertia of the present state; before a step.
    pub fn begin(&mut self) {
        self.frame = matrix(self.turn);
        self.inertia = turned(&self.frame, &self.shape.inertia);
        self.next = (self.velocity, self.momentum);
        self.free = self.freely();
        let rows: Vec<Six> = self.enforced.iter().map(|&i| self.row(&self.holds[i])).collect();
        let (chosen, compliance) = independent(&rows, self.free);
        self.resistance = resistance(&rows, &chosen, &self.free);
        self.compliance = compliance;
        self.chosen = chosen.into_iter().map(|i| self.enforced[i]).collect();
    }

    /// What forces do to its velocities if nothing holds it.
    fn freely(&self) -> Compliance {
        let (light, inverse) = (1.0 / self.shape.mass, turn::inverse(&self.inertia));
        let mut free = [[0.0; 6]; 6];
        for i in 0..3 {
            free[i][i] = light;
            free[3 + i][3..].copy_from_slice(&inverse[i]);
        }
        free
    }

    /// Arm of a point at `arm` from the centre at the start.
    pub fn arm(&self, arm: [f64; 3]) -> [f64; 3] {
        times(&self.frame, arm)
    }

    /// Force and moment about the centre of a unit reaction of a hold now.
    fn row(&self, hold: &Hold) -> Six {
        hold.row(self.arm(hold.arm))
    }

    /// Adds an impulse along a row to a velocity and an angular momentum.
    fn strike(&self, (velocity, momentum): &mut ([f64; 3], [f64; 3]), row: &Six, impulse: f64) {
        for axis in 0..3 {
            velocity[axis] += row[axis] * impulse / self.shape.mass;
            momentum[axis] += row[3 + axis] * impulse;
        }
    }

    /// Angular velocity at the present state of an angular momentum.
    fn spin(&self, momentum: [f64; 3]) -> [f64; 3] {
        solved(&self.inertia, momentum)
    }

    /// Velocity and angular velocity at the present state before the step's kick, or after it.
    pub fn motion(&self, after: bool) -> [[f64; 3]; 2] {
        let (velocity, momentum) = if after { self.next } else { (self.velocity, self.momentum) };
        [velocity, self.spin(momentum)]
    }

    /// Kinetic energy at the present state that is not in the rows of its nodes; see `RigidBody::turning`.
    pub fn surplus_energy(&self, kicked: bool) -> f64 {
        self.turning(&self.shape.surplus, kicked).energy
    }

    /// What each of its blocks, by its position in the mesh, has at the present state that is not in the rows of its nodes.
    pub fn surplus_of_blocks(&self, kicked: bool) -> impl Iterator<Item = (usize, Turning)> + '_ {
        self.shape.surplus_of.iter().map(move |(block, inertia)| (*block, self.turning(inertia, kicked)))
    }

    /// What an inertia at the start has from turning with the body, at the present state: between the velocities before the kick and
    /// after it, or by those before alone where it is the initial condition and not yet `kicked`.
    fn turning(&self, at_start: &Matrix, kicked: bool) -> Turning {
        let [[_, before], [_, after]] = [self.motion(false), self.motion(kicked)];
        let inertia = turned(&self.frame, at_start);
        let energy = 0.5 * dot(before, times(&inertia, after));
        Turning { inertia, momentum: times(&inertia, scaled(add(before, after), 0.5)), energy }
    }

    /// Finds the velocities of the coming step under these forces and their moment about the centre, its weight and the moment on it.
    pub fn load(&mut self, force: &Six, functions: &[Function], step: &StepTimes) {
        self.load = *force;
        (0..3).for_each(|i| self.load[i] += self.shape.mass * self.gravity[i]);
        (0..3).for_each(|i| self.load[3 + i] += self.moment[i]);
        self.push([0.0; 6], functions, step);
    }

    /// The same with forces of contact, and their moment about the centre, beside them.
    pub fn push(&mut self, contact: Six, functions: &[Function], step: &StepTimes) {
        let force: Six = std::array::from_fn(|i| self.load[i] + contact[i]);
        let velocity = [0, 1, 2].map(|i| self.velocity[i] + step.kick * (force[i] / self.shape.mass));
        let momentum = [0, 1, 2].map(|i| self.momentum[i] + step.kick * force[3 + i]);
        self.next = (velocity, momentum);
        if self.holds.is_empty() {
            return;
        }
        let mut impulses = vec![0.0; self.chosen.len()];
        // Rotations in a step are small, and each pass is better than the one before by as much.
        for _ in 0..PASSES {
            let missed = self.missed(functions, step);
            let missed: Vec<f64> = self.chosen.iter().map(|&i| missed[i] / step.drift).collect();
            let change = eliminated(&self.resistance, &missed);
            impulses.iter_mut().zip(&change).for_each(|(impulse, change)| *impulse -= change);
            let mut next = (velocity, momentum);
            for (&i, impulse) in self.chosen.iter().zip(&impulses) {
                self.strike(&mut next, &self.row(&self.holds[i]), *impulse);
            }
            self.next = next;
            let settled = change.iter().zip(&impulses).all(|(change, impulse)| change.abs() <= SETTLED * impulse.abs());
            if settled {
                break;
            }
        }
        let missed = self.missed(functions, step);
        for (hold, missing) in self.holds.iter_mut().zip(missed) {
            (hold.reaction, hold.missing) = (0.0, missing);
        }
        for (&i, impulse) in self.chosen.iter().zip(&impulses) {
            self.holds[i].reaction = impulse / step.kick;
        }
    }

    /// By how much the coming step goes too far for each hold.
    fn missed(&self, functions: &[Function], step: &StepTimes) -> Vec<f64> {
        let turn = rotation(&self.inertia, scaled(self.next.1, step.drift));
        let of = |hold: &Hold| {
            let arm = self.arm(hold.arm);
            let at = self.centre[hold.axis] + arm[hold.axis];
            let gone = step.drift * self.next.0[hold.axis] + moved(turn, arm)[hold.axis];
            hold.missed([at, gone], turn, functions, step)
        };
        self.holds.iter().map(of).collect()
    }

    /// Books half the step's work of what drives it, of its weight and of the moment on it, before or after the kick.
    pub fn book(&mut self, half_step: f64, after: bool) {
        let [velocity, spin] = self.motion(after);
        self.load_work += half_step * self.shape.mass * dot(self.gravity, velocity);
        self.load_work += half_step * dot(self.moment, spin);
        let frame = self.frame;
        for hold in self.holds.iter_mut().filter(|hold| hold.motion.is_some() || hold.begins) {
            let row = hold.row(times(&frame, hold.arm));
            let [u, v, w] = velocity;
            let [x, y, z] = spin;
            hold.work += half_step * hold.reaction * product(&row, &[u, v, w, x, y, z]);
        }
    }

    /// Takes the step. Returns its rotation.
    pub fn drift(&mut self, drift: f64) -> Quaternion {
        (self.velocity, self.momentum) = self.next;
        let turn = rotation(&self.inertia, scaled(self.momentum, drift));
        for hold in &mut self.holds {
            let arm = times(&self.frame, hold.arm);
            let gone = drift * self.velocity[hold.axis] + moved(turn, arm)[hold.axis];
            hold.go(gone, turn, drift);
        }
        self.centre = add(self.centre, scaled(self.velocity, drift));
        self.turn = turn::then(self.turn, turn);
        self.last = Some((turn, drift));
        turn
    }

    /// Velocity over the last step of a point that was at `arm` from the centre before it.
    pub fn chord(&self, arm: [f64; 3], turn: Quaternion, drift: f64) -> [f64; 3] {
        add(self.velocity, scaled(moved(turn, arm), 1.0 / drift))
    }

    /// The last step that this run has taken: rotation and length.
    pub fn last(&self) -> Option<(Quaternion, f64)> {
        self.last
    }

    /// An upper bound of the angle by which it has turned in the last step, radians.
    pub fn last_angle(&self) -> f64 {
        // An arc sine is at most half of π times the sine.
        self.last.map_or(0.0, |([_, x, y, z], _)| PI * dot([x, y, z], [x, y, z]).sqrt())
    }

    /// Angular velocity, radians per time, at the present state.
    pub fn rate(&self) -> f64 {
        let spin = self.spin(self.momentum);
        dot(spin, spin).sqrt()
    }

    /// Longest step in which it turns little, a time; without end for a body that does not turn.
    pub fn longest_step(&self) -> f64 {
        MOST_TURN / self.rate()
    }

    /// Velocity at the present state of a point at `arm` now.
    pub fn velocity_at(&self, [velocity, spin]: [[f64; 3]; 2], arm: [f64; 3]) -> [f64; 3] {
        add(velocity, cross(spin, arm))
    }
}

/// What unit reactions of the chosen holds, by their rows, do to each other's velocities.
fn resistance(rows: &[Six], chosen: &[usize], free: &Compliance) -> Vec<Vec<f64>> {
    let resists = |a: &usize| chosen.iter().map(|b| product(&rows[*a], &applied(free, &rows[*b]))).collect();
    chosen.iter().map(resists).collect()
}

/// A body turns by no more than this in a step, radians.
const MOST_TURN: f64 = 0.1;

/// A body is astray where it is farther than this from where it is told to be: a part of its size, or an angle.
const ASTRAY: f64 = 0.01;

/// Passes over what holds a body at most.
const PASSES: usize = 30;

/// Passes end when impulses change by less than this part.
const SETTLED: f64 = 4e-16;

/// x with A x = b of a symmetric positive matrix.
fn eliminated(a: &[Vec<f64>], b: &[f64]) -> Vec<f64> {
    let (mut a, mut x) = (a.to_vec(), b.to_vec());
    let count = x.len();
    for k in 0..count {
        let pivot = a[k].clone();
        for i in k + 1..count {
            let factor = a[i][k] / pivot[k];
            (k..count).for_each(|j| a[i][j] -= factor * pivot[j]);
            x[i] -= factor * x[k];
        }
    }
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|j| a[k][j] * x[j]).sum();
        x[k] = (x[k] - known) / a[k][k];
    }
    x
}
