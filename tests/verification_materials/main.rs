//! Material laws at work in whole runs: shocks, detonations, gases and large expansion, impact.

mod crush;
mod fluids;
mod gas_scenes;
mod impact;
mod shocks;

#[path = "../support/mod.rs"]
mod support;
