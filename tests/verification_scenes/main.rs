//! Whole scenes: the examples of the founding paper.

mod brick_wall;
mod can_crush;

#[path = "../support/mod.rs"]
mod support;
