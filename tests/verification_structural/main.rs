//! Shells, beams and trusses against known answers.

mod beams;
mod plotted;
mod shell_extremes;
mod shell_tubes;
mod shells;
mod square_tube;
mod trusses;

#[path = "../support/mod.rs"]
mod support;
