//! The option table: what `--help` and the man page are made of.

mod meshes;
mod results;
mod runs;

pub use meshes::{Mesh, Refine};
pub use results::{Diff, Join, MapName, Plot, Report, View};
pub use runs::{Check, DecompositionName, MachineName, Run, Scale, Sweep, Trade};

use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Explicit transient dynamics of solids: PRONTO decks in, EXODUS results out
///
/// An analyst's deck in PRONTO's command language and a GENESIS mesh go in; a parallel Lagrangian finite element
/// code integrates the motion; EXODUS results come out. `urto DECK` is short for `urto run DECK`.
#[derive(Debug, Parser)]
#[command(
    name = "urto",
    version,
    override_usage = "urto DECK [OPTIONS OF RUN]\n       urto VERB ...",
    after_help = "Exit codes: 0 done, 1 the run failed or files differ, 2 the input is wrong, 130 and 143 stopped by \
                  SIGINT and SIGTERM, 128 and its number by another signal.",
    after_long_help = AFTER_HELP
)]
pub struct Options {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

/// What stands below the options in the long help of the program.
const AFTER_HELP: &str = "\
Examples:
  urto check decks/taylor_bar.i             what would be modelled, and what it would cost
  urto decks/taylor_bar.i                   runs it on all cores
  urto view taylor_bar.e -v EQPS            draws the last state
  urto plot taylor_bar.e                    its energies over time
  urto report taylor_bar                    all of it on one page, for somebody else
  urto explain INITIAL VELOCITY MATERIAL    a command of the deck
  mpiexec -n 4 urto decks/taylor_bar.i      the same bits, over MPI

Exit codes: 0 done, 1 the run failed or files differ, 2 the input is wrong, 130 and 143 stopped by SIGINT and SIGTERM,\n128 and its number by another signal.";

/// What can be done. Each verb's own type says what it does, in short and at length.
#[derive(Debug, Subcommand)]
#[allow(missing_docs)] // A text here would hide the verbs' own.
pub enum Verb {
    Run(Run),
    Check(Check),
    Explain(Explain),
    Sweep(Sweep),
    Trade(Trade),
    Mesh(Mesh),
    Refine(Refine),
    View(View),
    Plot(Box<Plot>),
    Report(Report),
    Diff(Diff),
    Scale(Scale),
    Join(Join),
    #[command(hide = true)]
    Generate(Generate),
    #[command(hide = true)]
    Probe(Probe),
}

/// Where deck and mesh are.
#[derive(Debug, Args)]
pub struct Input {
    /// The deck, x.i; the suffix may be left out
    pub deck: PathBuf,
    /// The mesh, or a recipe of one; else x.g or x.mesh beside the deck, or in meshes/ beside the deck's folder
    #[arg(short, long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// Gives a name in the expressions of deck and recipe this value, in place of what {NAME = ...} gives it there
    #[arg(short = 'D', long, value_name = "NAME=VALUE")]
    pub define: Vec<String>,
    /// Multiplies every number of elements along an edge, of a mesh that is made from a recipe; what the deck gives per node of a set
    /// keeps its total
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub refine: u32,
}

/// Explains a command of decks or mesh recipes
///
/// Syntax, arguments, units, defaults, an example and where the form comes from; laws with their formulas and numbers worked
/// through. Without a command, lists all. Names of material models, of their properties and of variables lead to the page
/// that they stand on, words of other codes (wall, tied, mass scaling, d3plot) to what is here in their place, and other
/// words to all pages whose text has them. --curve draws how the law of a block answers to tension, compression and shear
/// of one element, before anything is run.
#[derive(Debug, Args)]
pub struct Explain {
    /// The command's words, quoted or not: urto explain INITIAL VELOCITY MATERIAL
    pub words: Vec<String>,
    /// Draws stress over strain of the law that a deck gives a block
    #[arg(long, num_args = 2, value_names = ["DECK", "BLOCK"], conflicts_with = "words")]
    pub curve: Vec<String>,
    /// The picture to write; else the deck's name with _blockN.png, here
    #[arg(short, long, value_name = "FILE", requires = "curve")]
    pub output: Option<PathBuf>,
    /// Largest strain, logarithmic; in shear that of the tensor, half of the angle
    #[arg(long, value_name = "S", default_value_t = 0.5, requires = "curve")]
    pub strain: f64,
    /// Strain rate, for laws that know it
    #[arg(long, value_name = "R", default_value_t = 1.0, requires = "curve")]
    pub rate: f64,
    /// Gives a name in the deck's expressions this value
    #[arg(short = 'D', long, value_name = "NAME=VALUE", requires = "curve")]
    pub define: Vec<String>,
}

/// Prints man pages and shell completions.
#[derive(Debug, Args)]
pub struct Generate {
    /// What to print
    pub what: Generated,
}

/// Reads all of an EXODUS file and says nothing: other processes learn by it whether the file can be read
#[derive(Debug, Args)]
pub struct Probe {
    /// The file
    pub file: PathBuf,
}

/// What `generate` prints.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Generated {
    /// urto.1
    Man,
    /// urto-deck.5
    ManDeck,
    /// urto-mesh.5
    ManMesh,
    /// Completion for bash
    Bash,
    /// Completion for zsh
    Zsh,
    /// Completion for fish
    Fish,
}

/// The command line as clap knows it.
pub fn command() -> clap::Command {
    Options::command()
}
