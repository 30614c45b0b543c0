//! `urto`: explicit transient dynamics of solids in the PRONTO3D tradition.
//!
//! Data flows one way: a deck's text becomes commands ([`deck`]), commands become a [`model`]; a mesh file
//! ([`exodus`]) becomes a [`mesh`]; both are cut into domains ([`partition`]), one per rank ([`comm`]), which the
//! [`solver`] integrates in time; [`output`] writes what it finds.
#![warn(missing_docs)]

pub mod cli;
pub mod comm;
pub mod common;
pub mod deck;
pub mod exodus;
pub mod lanes;
pub mod material;
pub mod mesh;
pub mod mesher;
pub mod model;
pub mod output;
pub mod partition;
pub mod postprocess;
pub mod restart;
pub mod run;
pub mod solver;
pub mod studies;
