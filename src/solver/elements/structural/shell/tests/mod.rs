//! The shell alone: its operators, patch tests, single elements that are moved by hand.

mod linear;
mod numbering;
mod operators;
mod points;
mod rig;
