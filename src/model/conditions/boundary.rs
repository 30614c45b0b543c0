//! Motions that are held or driven, and loads.

use self::Unknown::{Position, Rotation};
use crate::deck::Card;
use crate::model::problem::{Draft, Setter};

/// A coordinate direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// x
    X,
    /// y
    Y,
    /// z
    Z,
}

impl Direction {
    /// 0, 1 or 2.
    pub fn axis(self) -> usize {
        self as usize
    }
}

/// What of a node is held, driven or loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Its position, by forces.
    Position,
    /// Its rotation, by moments.
    Rotation,
}

/// NO DISPLACEMENT and NO ROTATION.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoDisplacement {
    /// Position or rotation.
    pub of: Unknown,
    /// Direction held.
    pub direction: Direction,
    /// Node set number.
    pub node_set: i64,
}

/// PRESCRIBED DISPLACEMENT, VELOCITY, ACCELERATION, ROTATION or ANGULAR VELOCITY.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrescribedMotion {
    /// Position or rotation.
    pub of: Unknown,
    /// Which derivative of the position is given.
    pub kind: MotionKind,
    /// Direction of the motion.
    pub direction: Direction,
    /// Node set number.
    pub node_set: i64,
    /// Index into [`Model::functions`](crate::model::Model::functions).
    pub function: usize,
    /// Factor on the function.
    pub scale: f64,
}

/// What a prescribed motion prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionKind {
    /// Displacement from the initial position.
    Displacement,
    /// Velocity.
    Velocity,
    /// Acceleration.
    Acceleration,
}

/// PRESCRIBED FORCE or PRESCRIBED MOMENT on every node of a set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrescribedForce {
    /// Position, for a force, or rotation, for a moment.
    pub of: Unknown,
    /// Direction of the force.
    pub direction: Direction,
    /// Node set number.
    pub node_set: i64,
    /// Index into [`Model::functions`](crate::model::Model::functions).
    pub function: usize,
    /// Factor on the function.
    pub scale: f64,
}

/// POINT MASS at every node of a set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMass {
    /// Node set number.
    pub node_set: i64,
    /// Mass per node.
    pub mass: f64,
    /// Rotary inertia per node, the same about all axes.
    pub inertia: f64,
}

/// PRESSURE on the deformed faces of a side set; positive pushes on the face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressure {
    /// Side set number.
    pub side_set: i64,
    /// Index into [`Model::functions`](crate::model::Model::functions).
    pub function: usize,
    /// Factor on the function.
    pub scale: f64,
}

/// GRAVITY: a body acceleration of the whole model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gravity {
    /// Acceleration vector, length/time².
    pub acceleration: [f64; 3],
    /// Index into [`Model::functions`](crate::model::Model::functions) of a factor; constant 1 without it.
    pub function: Option<usize>,
}

pub(in crate::model) const COMMANDS: &[Setter] = &[
    ("NO DISPLACEMENT", |card, draft| held(Position, card, draft)),
    ("NO ROTATION", |card, draft| held(Rotation, card, draft)),
    ("PRESCRIBED DISPLACEMENT", |card, draft| driven(Position, MotionKind::Displacement, card, draft)),
    ("PRESCRIBED VELOCITY", |card, draft| driven(Position, MotionKind::Velocity, card, draft)),
    ("PRESCRIBED ACCELERATION", |card, draft| driven(Position, MotionKind::Acceleration, card, draft)),
    ("PRESCRIBED ROTATION", |card, draft| driven(Rotation, MotionKind::Displacement, card, draft)),
    ("PRESCRIBED ANGULAR VELOCITY", |card, draft| driven(Rotation, MotionKind::Velocity, card, draft)),
    ("PRESCRIBED FORCE", |card, draft| loaded(Position, card, draft)),
    ("PRESCRIBED MOMENT", |card, draft| loaded(Rotation, card, draft)),
    ("POINT MASS", point_mass),
    ("PRESSURE", pressure),
    ("GRAVITY", gravity),
    ("SILENT BC", |card, draft| draft.model.silent_boundaries.push(card.integer("side_set"))),
];

fn held(of: Unknown, card: &Card, draft: &mut Draft) {
    let held = NoDisplacement { of, direction: direction(card), node_set: card.integer("node_set") };
    draft.model.no_displacements.push(held);
}

fn driven(of: Unknown, kind: MotionKind, card: &Card, draft: &mut Draft) {
    let Some(function) = draft.function(card) else { return };
    draft.model.prescribed_motions.push(PrescribedMotion {
        of,
        kind,
        direction: direction(card),
        node_set: card.integer("node_set"),
        function,
        scale: card.number("scale"),
    });
}

fn loaded(of: Unknown, card: &Card, draft: &mut Draft) {
    let Some(function) = draft.function(card) else { return };
    draft.model.prescribed_forces.push(PrescribedForce {
        of,
        direction: direction(card),
        node_set: card.integer("node_set"),
        function,
        scale: card.number("scale"),
    });
}

fn point_mass(card: &Card, draft: &mut Draft) {
    draft.model.point_masses.push(PointMass {
        node_set: card.integer("node_set"),
        mass: card.number("mass"),
        inertia: card.number("inertia"),
    });
}

fn pressure(card: &Card, draft: &mut Draft) {
    let Some(function) = draft.function(card) else { return };
    let pressure = Pressure { side_set: card.integer("side_set"), function, scale: card.number("scale") };
    draft.model.pressures.push(pressure);
}

fn gravity(card: &Card, draft: &mut Draft) {
    let function = draft.function(card);
    draft.model.gravities.push(Gravity { acceleration: card.vector(["gx", "gy", "gz"]), function });
}

/// The direction in a card's field of that name.
pub(in crate::model) fn direction(card: &Card) -> Direction {
    match card.text("direction") {
        "X" => Direction::X,
        "Y" => Direction::Y,
        _ => Direction::Z,
    }
}
