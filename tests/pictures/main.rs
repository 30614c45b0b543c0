//! What people look at: pictures, curves, the page of a run.

mod looked_at;
mod plot;
mod plot_forces;
mod report;
mod view;

#[path = "../program/mod.rs"]
mod program;
