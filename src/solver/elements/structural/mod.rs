//! Elements that know their thickness or cross section: bars, beams and shells.

pub mod beam;
pub mod shell;
pub mod truss;
mod uniaxial;
