//! Conditions of the body: what is held, driven, loaded, and how it moves at the start.

pub(super) mod boundary;
pub(super) mod doubts;
pub(super) mod function;
pub(super) mod initial;
pub(super) mod jump;
pub(super) mod pulse;

pub use boundary::{
    Direction, Gravity, MotionKind, NoDisplacement, PointMass, PrescribedForce, PrescribedMotion, Pressure, Unknown,
};
pub use function::Function;
pub use initial::InitialVelocity;
pub use jump::Jump;
pub use pulse::Pulse;
