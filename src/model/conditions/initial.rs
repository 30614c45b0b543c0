//! Velocities at time zero.

use crate::common::vector::unit;
use crate::deck::{Card, Diagnostic};
use crate::model::problem::{Draft, Setter};

/// INITIAL VELOCITY.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InitialVelocity {
    /// Every node of an element block.
    Material {
        /// Element block number.
        block: i64,
        /// Velocity vector.
        velocity: [f64; 3],
    },
    /// Every node of a node set.
    NodeSet {
        /// Node set number.
        node_set: i64,
        /// Velocity vector.
        velocity: [f64; 3],
    },
    /// Every node of an element block, away from a point or from an axis.
    Radial {
        /// Element block number.
        block: i64,
        /// Speed, negative towards the point or the axis.
        speed: f64,
        /// The point, or a point of the axis.
        point: [f64; 3],
        /// Direction of the axis, unit length; `None` for the point alone.
        axis: Option<[f64; 3]>,
    },
    /// Rotation of an element block about an axis, added to the velocity the nodes already have.
    Angular {
        /// Element block number.
        block: i64,
        /// Angular velocity ω about the axis, radians/time, right-hand rule.
        omega: f64,
        /// A point of the axis.
        point: [f64; 3],
        /// Direction of the axis, unit length.
        axis: [f64; 3],
    },
}

pub(in crate::model) const COMMANDS: &[Setter] = &[
    ("INITIAL VELOCITY MATERIAL", of_block),
    ("INITIAL VELOCITY NODESET", of_node_set),
    ("INITIAL VELOCITY ANGULAR", angular),
    ("INITIAL VELOCITY RADIAL", radial),
];

/// The velocity of a card; components that are left out are zero, but not all of them can be meant to be.
fn velocity(card: &Card, draft: &mut Draft) -> [f64; 3] {
    let components = ["vx", "vy", "vz"];
    if !components.iter().any(|component| card.given(component)) {
        draft.report(
            Diagnostic::error(format!("{}: the velocity is missing", card.name))
                .at(card.record, "expected one component at least: vx, vy, vz")
                .help("a component that is left out is zero: 1, , , -190."),
        );
    }
    card.vector(components)
}

fn of_block(card: &Card, draft: &mut Draft) {
    let velocity = velocity(card, draft);
    draft.model.initial_velocities.push(InitialVelocity::Material { block: card.integer("block"), velocity });
}

fn of_node_set(card: &Card, draft: &mut Draft) {
    let velocity = velocity(card, draft);
    draft.model.initial_velocities.push(InitialVelocity::NodeSet { node_set: card.integer("node_set"), velocity });
}

fn angular(card: &Card, draft: &mut Draft) {
    let Some(axis) = unit(card.vector(["ax", "ay", "az"])) else {
        let place = card.place("ax").join(card.place("az"));
        return draft.report(
            Diagnostic::error("INITIAL VELOCITY ANGULAR: the axis has length zero")
                .at(place, "a direction is expected here")
                .help("for a rotation about z, leave the axis out or give 0., 0., 1."),
        );
    };
    draft.model.initial_velocities.push(InitialVelocity::Angular {
        block: card.integer("block"),
        omega: card.number("omega"),
        point: card.vector(["x", "y", "z"]),
        axis,
    });
}

fn radial(card: &Card, draft: &mut Draft) {
    draft.model.initial_velocities.push(InitialVelocity::Radial {
        block: card.integer("block"),
        speed: card.number("speed"),
        point: card.vector(["x", "y", "z"]),
        axis: unit(card.vector(["ax", "ay", "az"])),
    });
}
