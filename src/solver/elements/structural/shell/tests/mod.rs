//! The shell alone: its operators, patch tests, single elements that are moved by hand.

mod linear;
mod operators;
mod points;
mod rig;
