//! Contact against known answers, and in random scenes: what it must never do.

mod abutting;
mod bars;
mod cases;
mod edges;
mod energy;
mod erosion;
mod extremes;
mod flush;
mod flying;
mod friction;
mod grazing;
mod joints;
mod matching;
mod overlaps;
mod passing;
mod press_fit;
mod rigid;
mod rigid_driven;
mod rims;
mod room;
mod shells;
mod sliding;
mod solids;
mod struck;
mod through;
mod tied;
mod tied_refusals;
mod touching;

#[path = "../support/mod.rs"]
mod support;
