//! The command language and what is written about it: decks, recipes, manual pages, the tutorial.

mod decks;
mod fixtures;
mod joints;
mod man;
mod mutilated;
mod properties;
mod recipes;
mod tutorial;

#[path = "../program/mod.rs"]
mod program;
