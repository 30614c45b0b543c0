//! Elements that know their thickness or cross section: bars, beams and shells.

pub mod beam;
pub mod shell;
pub mod truss;
mod uniaxial;

/// Part of their stable step that bars take. Their bound is exact, and a chain of them swings at it: there a disturbance
/// that comes again, as contact is, makes an oscillation grow without end. Other elements stay below theirs.
const BAR_STEP: f64 = 0.99;
