//! Motions that are held or driven, and loads.

use super::{
    Direction, Gravity, MotionKind, NoDisplacement, PrescribedForce, PrescribedMotion, Pressure,
    problem::{Draft, Setter},
};
use crate::deck::Card;

pub(super) const COMMANDS: &[Setter] = &[
    ("NO DISPLACEMENT", no_displacement),
    ("PRESCRIBED DISPLACEMENT", |card, draft| prescribed_motion(MotionKind::Displacement, card, draft)),
    ("PRESCRIBED VELOCITY", |card, draft| prescribed_motion(MotionKind::Velocity, card, draft)),
    ("PRESCRIBED ACCELERATION", |card, draft| prescribed_motion(MotionKind::Acceleration, card, draft)),
    ("PRESCRIBED FORCE", prescribed_force),
    ("PRESSURE", pressure),
    ("GRAVITY", gravity),
    ("SILENT BC", |card, draft| draft.model.silent_boundaries.push(card.integer("side_set"))),
];

fn no_displacement(card: &Card, draft: &mut Draft) {
    let held = NoDisplacement { direction: direction(card), node_set: card.integer("node_set") };
    draft.model.no_displacements.push(held);
}

fn prescribed_motion(kind: MotionKind, card: &Card, draft: &mut Draft) {
    let Some(function) = draft.function(card) else { return };
    draft.model.prescribed_motions.push(PrescribedMotion {
        kind,
        direction: direction(card),
        node_set: card.integer("node_set"),
        function,
        scale: card.number("scale"),
    });
}

fn prescribed_force(card: &Card, draft: &mut Draft) {
    let Some(function) = draft.function(card) else { return };
    draft.model.prescribed_forces.push(PrescribedForce {
        direction: direction(card),
        node_set: card.integer("node_set"),
        function,
        scale: card.number("scale"),
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
