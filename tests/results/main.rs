//! Files that a run leaves: in pieces, for other programs, when it is killed, and to go on from.

mod earlier_runs;
mod ends;
mod kill;
mod other_programs;
mod pieces;
mod restart;
mod restart_files;
mod restart_of_eroded;
mod restart_of_fits;
mod restart_of_others;
mod rigid_blocks;
mod vanished;

#[path = "../program/mod.rs"]
mod program;
#[path = "../support/mod.rs"]
mod support;
