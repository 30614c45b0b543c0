//! Why a run ends before its time, in words that help.

use super::{Evidence, Finding, percent};

/// A run that cannot go on. The state it stopped in has been reached on every rank and can be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Stop {
    /// An element was turned inside out.
    #[error("element {} of block {} has no positive volume any more: it is inverted, at ({:.6e}, {:.6e}, {:.6e})", .0.element, .0.block, .0.centre[0], .0.centre[1], .0.centre[2])]
    Inverted(ElementPlace),
    /// Numbers of an element are no longer finite.
    #[error("the motion of element {} of block {} is no longer a number, at ({:.6e}, {:.6e}, {:.6e})", .0.element, .0.block, .0.centre[0], .0.centre[1], .0.centre[2])]
    NotFinite(ElementPlace),
    /// An energy is no longer a number, though the motions of all elements are.
    #[error("an energy is no longer a number, though elements are sound")]
    MotionNotFinite,
    /// A rigid body does not do all that the deck tells it.
    #[error("the rigid body of block {block} cannot do all that it is told: node {node} is {} where {command} wants it", how_far(*strayed))]
    Astray {
        /// First block of the body.
        block: i64,
        /// Node that is held or driven.
        node: i64,
        /// What holds or drives it, with its axis.
        command: String,
        /// How far it is from where it is to be: a length, or an angle in radians.
        strayed: f64,
    },
    /// A rigid body turns so fast that steps become hopelessly small.
    #[error(
        "the rigid body of block {block} turns at {rate:.4e} radians a time: the step in which it turns little is {ratio:.1e} of the first step"
    )]
    Spin {
        /// First block of the body.
        block: i64,
        /// Its rate of rotation, 1/time.
        rate: f64,
        /// Its longest step over the first stable step of the run.
        ratio: f64,
    },
    /// The stable step has become hopelessly small.
    #[error("the stable time step has collapsed to {step:.6e}, {ratio:.1e} of its first value; element {} of block {} controls it, at ({:.6e}, {:.6e}, {:.6e})", .place.element, .place.block, .place.centre[0], .place.centre[1], .place.centre[2])]
    TimeStep {
        /// Stable step now.
        step: f64,
        /// Stable step over the first one.
        ratio: f64,
        /// Element that controls it.
        place: ElementPlace,
    },
    /// Kinetic or internal energy has outgrown all that was put in.
    #[error(
        "energy is running away: kinetic {kinetic:.6e} and internal {internal:.6e} against {supplied:.6e} supplied"
    )]
    Energy {
        /// Kinetic energy.
        kinetic: f64,
        /// Internal energy with hourglass energy.
        internal: f64,
        /// Initial energy and external work.
        supplied: f64,
    },
    /// The energy balance does not close by far.
    #[error("the energy balance is off by {:.0} % of the largest account", 100.0 * .error)]
    Balance {
        /// Energy accounted for minus energy supplied, over the largest account.
        error: f64,
    },
    /// Contact has made more energy than the deck allows.
    #[error("contact has made an energy of {:.4e}, {} of the largest supplied, and the limit is {}; its work is the greatest at {}", .evidence.amount, percent(.evidence.share), percent(*.limit), .evidence.places())]
    Contact {
        /// How much, and where most.
        evidence: Box<Evidence>,
        /// Limit, a part of the largest energy supplied.
        limit: f64,
    },
    /// What ends the run is not what came first.
    #[error("{}; that came first, at step {}, time {:.6e}; then: {stop}", .first.words(), .first.step, .first.time)]
    After {
        /// What came first.
        first: Box<Finding>,
        /// What ends the run.
        stop: Box<Stop>,
    },
}

/// An element as the analyst knows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementPlace {
    /// Element number.
    pub element: i64,
    /// Block number.
    pub block: i64,
    /// Mean of its corners, lengths.
    pub centre: [f64; 3],
    /// Its volume, length³.
    pub volume: f64,
}

impl Stop {
    /// What ends the run, whatever came before it.
    pub fn event(&self) -> &Stop {
        match self {
            Stop::After { stop, .. } => stop.event(),
            _ => self,
        }
    }

    /// What the analyst can try, what helps against that which came first before the rest.
    pub fn advice(&self) -> Vec<&'static str> {
        match self {
            Stop::After { first, stop } => [vec![first.advice()], stop.advice()].concat(),
            _ => vec![self.own_advice()],
        }
    }

    fn own_advice(&self) -> &'static str {
        match self {
            Stop::After { first, .. } => first.advice(),
            Stop::Contact { .. } => {
                "look at the last plot state there, with PLOT NODAL, CONTACT: bodies that overlap or are held on both \
                 sides, squashed elements and soft layers between stiff ones are the usual causes; try half the TIME STEP \
                 SCALE, or other CONTACT PASSES; CONTACT ENERGY LIMIT lets the run go on"
            }
            Stop::NotFinite(_) => {
                "a load or a prescribed motion of absurd size is the usual cause, or an unstable step: see whether TIME \
                 STEP SCALE is above 1, and what the last plot state shows there"
            }
            Stop::Astray { .. } => {
                "motions of one RIGID BODY contradict each other: leave what follows from the others out, or let the block deform"
            }
            Stop::Spin { .. } => {
                "a light body that is hit hard, or driven by moments, turns ever faster: see its forces, or hold it with NO ROTATION"
            }
            Stop::MotionNotFinite => {
                "prescribed motions or loads of absurd size are the usual cause, or motions of one RIGID BODY that contradict each other: \
                 see what the deck holds and drives, and the last plot state"
            }
            Stop::Inverted(_) => {
                "look at the last plot state around it; try a finer or better shaped mesh there, more hourglass \
                 stiffness, or a smaller TIME STEP SCALE"
            }
            Stop::TimeStep { .. } => {
                "the element is nearly flat: look at the last plot state around it; a coarser mesh there, or a law \
                 that stiffens less, keeps the step"
            }
            Stop::Energy { .. } | Stop::Balance { .. } => {
                "the integration is unstable: TIME STEP SCALE above 1, strong hourglass viscosity, or loads that \
                 change within one step are the usual causes"
            }
        }
    }
}

/// How far a node of a rigid body is from where it is to be, in words.
fn how_far(length: f64) -> String {
    if length.is_nan() { "beyond any reach of".to_owned() } else { format!("{:.4e} from", length.abs()) }
}
