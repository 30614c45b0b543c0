//! The same bits wherever they are computed: on any number of ranks, with any instructions; and ranks that fail.

mod comm;
mod instruction_sets;
mod parallel;
mod stress;

#[path = "../program/mod.rs"]
mod program;
#[path = "../support/mod.rs"]
mod support;
