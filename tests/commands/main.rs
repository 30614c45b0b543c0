//! The program at the shell: what it takes, what it says, and what its verbs do.

mod advice;
mod check;
mod cli;
mod endings;
mod input;
mod scale;
mod sweep;
mod trade;
mod warning_scenes;
mod warnings;

#[path = "../program/mod.rs"]
mod program;
#[path = "../support/mod.rs"]
mod support;
