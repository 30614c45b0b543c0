//! Hexahedra against known answers: waves, bending, rigid motion, extremes, and what changes the step or the precision.

mod bending;
mod collapsed;
mod deletion;
mod eight_points;
mod elements;
mod extremes;
mod global_step;
mod mass_scaling;
mod silent;
mod single;
mod spin;
mod waves;

#[path = "../program/mod.rs"]
mod program;
#[path = "../support/mod.rs"]
mod support;
