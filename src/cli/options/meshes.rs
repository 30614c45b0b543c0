//! Options of the verbs that make meshes.

use clap::Args;
use std::path::PathBuf;

/// Makes a mesh from a recipe
///
/// A recipe lists parts (boxes, cylinders, tubes, spheres; in two dimensions rectangles, discs, rings), transformations and
/// sets in the manner of a deck. See meshes/*.mesh for examples. With --revolve or --extrude a two-dimensional mesh, of a
/// recipe or of a file, becomes a solid; the faces at both ends are node sets and side sets of their own.
#[derive(Debug, Args)]
pub struct Mesh {
    /// The recipe, x.mesh; with --revolve or --extrude also a two-dimensional mesh, x.g
    pub recipe: PathBuf,
    /// The mesh to write; else the recipe's name with .g, here
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Multiplies every number of elements along an edge; node sets get distribution factors, with which they bear what a deck gives
    /// per node as often as without
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub refine: u32,
    /// Turns a two-dimensional mesh about its y axis by so many degrees into hexahedra
    #[arg(long, value_name = "DEGREES", conflicts_with = "extrude", requires = "cells")]
    pub revolve: Option<f64>,
    /// Draws a two-dimensional mesh out along z by a length into hexahedra
    #[arg(long, value_name = "LENGTH", requires = "cells")]
    pub extrude: Option<f64>,
    /// Number of layers that --revolve and --extrude make
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub cells: Option<u32>,
    /// Gives a name in the recipe's expressions this value, in place of what {NAME = ...} gives it there
    #[arg(short = 'D', long, value_name = "NAME=VALUE")]
    pub define: Vec<String>,
    /// Value of the name `ranks` in the recipe's expressions
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub ranks: Option<u32>,
}

/// Divides every element of a mesh
///
/// Hexahedra become eight, quadrilaterals four, bars two, wedges six hexahedra, pyramids four hexahedra and four pyramids.
/// Old nodes keep their numbers, elements are numbered anew; blocks, sets, names and attributes stay, and so does the
/// surface: curved sides keep their facets. Node sets get distribution factors, with which forces and masses per node add up to the same
/// as before. A model that is run on both meshes tells how far it is from converged. Recipes
/// are better made anew: `urto mesh x.mesh --refine 2`.
#[derive(Debug, Args)]
pub struct Refine {
    /// The mesh, x.g
    pub mesh: PathBuf,
    /// The mesh to write; else the mesh's name with _fine.g, here
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}
