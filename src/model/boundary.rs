//! Motions that are held or driven, and loads.

use super::{
    Direction, Gravity, MotionKind, NoDisplacement, PointMass, PrescribedForce, PrescribedMotion, Pressure, Unknown,
    Unknown::{Position, Rotation},
    problem::{Draft, Setter},
};
use crate::deck::Card;

pub(super) const COMMANDS: &[Setter] = &[
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
pub(super) fn direction(card: &Card) -> Direction {
    match card.text("direction") {
        "X" => Direction::X,
        "Y" => Direction::Y,
        _ => Direction::Z,
    }
}
