//! The option table: what `--help` and the man page are made of.

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
                  SIGINT and SIGTERM.",
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

Exit codes: 0 done, 1 the run failed or files differ, 2 the input is wrong, 130 and 143 stopped by SIGINT and SIGTERM.";

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
    /// Multiplies every number of elements along an edge, of a mesh that is made from a recipe
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub refine: u32,
}

/// Runs a deck
///
/// Writes the print log x.o and the plot states x.e in the present folder; an old print log is kept as x.o.1, x.o.2
/// and so on. Results are the same to the bit on any number of ranks. To stop a run in good order, create a file
/// x.shutdown beside the log or send SIGINT or SIGTERM: it writes a last state and leaves. With WRITE RESTART in the deck
/// it also leaves x.rsout, from which --restart or READ RESTART goes on. The run looks at itself: what it has to warn of, such
/// as contact that makes energy or corners that turn inside out, stands on the terminal, in the log and in the last line.
#[derive(Debug, Args)]
pub struct Run {
    /// Where deck and mesh are.
    #[command(flatten)]
    pub input: Input,
    /// Number of ranks, as threads of this process; else as many as there are cores [under mpiexec: its processes]
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub ranks: Option<u32>,
    /// Base name of everything written, with its folder, which is made; a suffix .e, .o, .i or .g is dropped; else the
    /// deck's name, here
    #[arg(short, long, value_name = "BASE")]
    pub output: Option<PathBuf>,
    /// Each rank writes its piece of the plot states, x.e.4.0 to x.e.4.3 on four ranks; `urto join` joins them
    #[arg(long)]
    pub split: bool,
    /// The restart file to go on from; else, when the deck has READ RESTART, x.rsin or x.rsout
    #[arg(long, value_name = "FILE")]
    pub restart: Option<PathBuf>,
    /// Nothing on the terminal but errors and warnings
    #[arg(short, long)]
    pub quiet: bool,
    /// Warnings count as a failure: the run goes on to its end, but the exit code is 1
    #[arg(long)]
    pub strict: bool,
    /// Writes at the end, for other programs, how it went: JSON with how it ended, warnings, energies, extremes and times
    #[arg(long, value_name = "FILE")]
    pub summary: Option<PathBuf>,
}

/// Runs a deck with all combinations of some values
///
/// Each -D gives a name of the deck's or the recipe's expressions its values: start:end:step, or a list with commas between.
/// Every combination runs in a folder of its own, called by its values, several at a time as there are cores. What has come
/// to its end is not run again when the study is started again, unless deck or mesh have changed since. A table of results
/// (last value, peak and its time, and filtered peak) goes to table.txt and table.csv, and a plot of each variable's peak
/// over the first parameter to VARIABLE.png. The peak of a variable is its value farthest from zero. A member that fails is
/// named, and the others go on; the exit code is 1 then.
#[derive(Debug, Args)]
pub struct Sweep {
    /// The deck, x.i; the suffix may be left out
    pub deck: PathBuf,
    /// The mesh, or a recipe of one; else as for `run`
    #[arg(short, long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// A name and its values: angle=0:40:10, or foam=0.2,0.3
    #[arg(short = 'D', long, value_name = "NAME=VALUES", required = true)]
    pub define: Vec<String>,
    /// Folder of the study; else the deck's name with _sweep, here
    #[arg(short, long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Multiplies every number of elements along an edge, of a mesh that is made from a recipe
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub refine: u32,
    /// Ranks of each run
    #[arg(short, long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub ranks: u32,
    /// Runs at a time; else as many as have a core for each of their ranks
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub jobs: Option<u32>,
    /// Variables of results and histories that the table has, with commas between, as for `plot`
    #[arg(short, long, value_name = "NAMES", value_delimiter = ',')]
    pub variables: Vec<String>,
    /// Numbers of nodes at which nodal variables are taken
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    pub node: Vec<i64>,
    /// Numbers of elements in which element variables are taken
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    pub element: Vec<i64>,
    /// Filter of the filtered peak, as for `plot`: CFC60, CFC180, ...
    #[arg(long, value_name = "CFCnnn")]
    pub filter: Option<String>,
    /// How long a second is in the deck's units of time, for the filter
    #[arg(long, value_name = "T", default_value_t = 1.0)]
    pub second: f64,
}

/// Measures what the knobs of a deck cost and gain
///
/// Runs the deck in variants, one at a time: as it is, with a perturbation of the size of round-off, on finer meshes, and with each
/// knob that the scene has turned by itself. Each is measured: processor time, steps, memory, and the error of what you care for,
/// against the finest mesh and what its convergence says lies behind it. The table, the front of time over error and what
/// refinement does come into a folder, as text, CSV and PNG, with the cheapest variant that is good enough in words. What was run
/// before is not run again: it can be stopped and continued, with a larger budget, too.
#[derive(Debug, Args)]
pub struct Trade {
    /// The deck, x.i; the suffix may be left out
    pub deck: PathBuf,
    /// The mesh, or a recipe of one; else as for `run`
    #[arg(short, long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// Gives a name in the expressions of deck and recipe this value
    #[arg(short = 'D', long, value_name = "NAME=VALUE")]
    pub define: Vec<String>,
    /// Folder of the study; else the deck's name with _trade, here
    #[arg(short, long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// What you care for, with commas between: a global variable or one of a history, or DISPLACEMENT, the largest of all nodes; each
    /// with :peak behind it, or :last; else what the deck watches
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub quantity: Vec<String>,
    /// Error that is good enough, in per cent
    #[arg(long, value_name = "PERCENT", default_value_t = 1.0)]
    pub within: f64,
    /// Time for all runs: 90s, 10m, 2h; what would not fit is not run
    #[arg(long, value_name = "TIME", default_value = "10m")]
    pub budget: String,
    /// Another termination time, to save time
    #[arg(long, value_name = "T")]
    pub end: Option<f64>,
    /// How many times finer the finer meshes are; a mesh that no recipe makes is divided: 2,4
    #[arg(long, value_name = "N,N", value_delimiter = ',', default_value = "2,4")]
    pub levels: Vec<u32>,
    /// Ranks of each run
    #[arg(short, long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub ranks: u32,
    /// Writes the cheapest variant that is good enough as a deck
    #[arg(long, value_name = "FILE")]
    pub write: Option<PathBuf>,
}

/// Reads deck and mesh and says what would be modelled; runs nothing
///
/// Prints what is modelled and why, the first time step and the element that controls it, and the memory and time to
/// expect.
#[derive(Debug, Args)]
pub struct Check {
    /// Where deck and mesh are.
    #[command(flatten)]
    pub input: Input,
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
    /// Multiplies every number of elements along an edge
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
/// surface: curved sides keep their facets. A model that is run on both meshes tells how far it is from converged. Recipes
/// are better made anew: `urto mesh x.mesh --refine 2`.
#[derive(Debug, Args)]
pub struct Refine {
    /// The mesh, x.g
    pub mesh: PathBuf,
    /// The mesh to write; else the mesh's name with _fine.g, here
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Draws a picture of results
///
/// A PNG of the deformed outer surface coloured by a variable; needs no display. A file without states, such as the
/// mesh x.g, is drawn as it is, coloured by block.
#[derive(Debug, Args)]
pub struct View {
    /// The results, x.e, or a mesh, x.g
    pub results: PathBuf,
    /// The picture to write; else the results' name with .png (.gif for an animation), here
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Variable that colours it: a nodal or element variable, or a vector such as VEL
    #[arg(short, long, value_name = "NAME")]
    pub variable: Option<String>,
    /// State: its number from 1, last, t=TIME for the nearest one, or mesh for the mesh before the run; several, with commas
    /// between, side by side in one picture [default: last]
    #[arg(short, long, value_name = "STATE", conflicts_with = "time")]
    pub state: Option<String>,
    /// State nearest to a time
    #[arg(short, long, value_name = "T")]
    pub time: Option<f64>,
    /// Side to look from: front, back, left, right, top, bottom, iso, or AZIMUTH,ELEVATION in degrees
    #[arg(short, long, value_name = "SIDE", default_value = "iso", allow_hyphen_values = true)]
    pub from: String,
    /// Factor on displacements
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub magnify: f64,
    /// Shows the mirror image of a half or quarter model too: any of x, y, z; or with their places, such as x=5,z=0
    #[arg(long, value_name = "PLANES", default_value = "", hide_default_value = true)]
    pub mirror: String,
    /// Draws these blocks only
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    pub block: Vec<i64>,
    /// Leaves these blocks out
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    pub hide: Vec<i64>,
    /// Takes off what stands between a plane and the eye, and shows the section: z=50, or several planes with commas between
    #[arg(long, value_name = "PLANES", default_value = "", hide_default_value = true)]
    pub cut: String,
    /// Draws only the elements whose centre is in a box, where they are in the picture: x=0:5,z=:3; an end may be left out
    #[arg(long, value_name = "BOX", default_value = "", hide_default_value = true)]
    pub region: String,
    /// Draws only the elements in which a variable is in a range: EQPS=0.2:, or several with commas between; an end may be
    /// left out
    #[arg(long = "where", value_name = "RANGES", default_value = "", hide_default_value = true)]
    pub criteria: String,
    /// Draws a nodal vector, such as VEL or CONT, as arrows too
    #[arg(long, value_name = "NAME")]
    pub arrows: Option<String>,
    /// Turns a two-dimensional body about its y axis by so many degrees: 270 leaves a quarter open to the eye
    #[arg(long, value_name = "DEGREES")]
    pub revolve: Option<f64>,
    /// Draws shells as thick as they are
    #[arg(long)]
    pub thickness: bool,
    /// Leaves out the rigid planes of the deck
    #[arg(long)]
    pub no_planes: bool,
    /// Colours: sequential from dark to light, diverging from white at zero; else as suits the signs of the values
    #[arg(long, value_name = "NAME")]
    pub map: Option<MapName>,
    /// Range of colours: LOW,HIGH
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true)]
    pub range: Option<String>,
    /// Size in pixels: WIDTHxHEIGHT
    #[arg(long, value_name = "SIZE", default_value = "1200x900")]
    pub size: String,
    /// Leaves out element edges
    #[arg(long)]
    pub no_edges: bool,
    /// All states as an animated GIF; with -o NAME.png as numbered pictures
    #[arg(long)]
    pub animate: bool,
}

/// Plots curves from results and histories
///
/// Variables over time, or over each other, of any number of .e and .h files, as a PNG or an SVG, or with --csv as numbers.
/// Without -v the energies of the body. What continued runs left beside a file (x.e-s0002) and pieces of a split run are read
/// as one with it. Curves are made in this order: --minus, --derive, --integrate, --filter, --scale. A curve that is filtered
/// is first brought to even times. Prints each curve's least, greatest and last value.
#[derive(Debug, Args)]
pub struct Plot {
    /// Results, x.e, and histories, x.h
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// The file to write; else the first file's name with _curves.png, here
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Variables, with commas between; * stands for any letters; a vector's stem, such as VEL, for its length
    #[arg(short, long, value_name = "NAMES", value_delimiter = ',')]
    pub variables: Vec<String>,
    /// Variables that have their axis on the right
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub right: Vec<String>,
    /// Variable to plot over, in place of time: force over displacement
    #[arg(short = 'x', long, value_name = "NAME")]
    pub over: Option<String>,
    /// Numbers of nodes at which nodal variables are taken
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    pub node: Vec<i64>,
    /// Numbers of elements in which element variables are taken
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    pub element: Vec<i64>,
    /// Subtracts a variable of the same file, or the same variables of another file
    #[arg(long, value_name = "NAME|FILE")]
    pub minus: Option<String>,
    /// Derivative with respect to time
    #[arg(long)]
    pub derive: bool,
    /// Integral over time from the first state; what a history holds as means over its intervals (accelerations, forces of
    /// contact) adds up to the change of velocity or momentum, all else is integrated by trapezoids
    #[arg(long)]
    pub integrate: bool,
    /// Channel frequency class of SAE J211 (ISO 6487): CFC60, CFC180, CFC600, CFC1000 or another number of hertz
    #[arg(long, value_name = "CFCnnn")]
    pub filter: Option<String>,
    /// How long a second is in the deck's units of time: 1000 where they are milliseconds
    #[arg(long, value_name = "T", default_value_t = 1.0)]
    pub second: f64,
    /// Factor on the values
    #[arg(long, value_name = "F", default_value_t = 1.0, allow_hyphen_values = true)]
    pub scale: f64,
    /// Draws the columns of a CSV file beside the curves, over its first column
    #[arg(long, value_name = "FILE")]
    pub reference: Vec<PathBuf>,
    /// Logarithmic axes: any of x, y, and r for the one on the right
    #[arg(long, value_name = "AXES", default_value = "", hide_default_value = true)]
    pub log: String,
    /// Ends of the axis below
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true)]
    pub x_range: Option<String>,
    /// Ends of the axis on the left
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true)]
    pub y_range: Option<String>,
    /// Ends of the axis on the right
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true)]
    pub right_range: Option<String>,
    /// Title; else that of the first run
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    /// What stands at the axis below
    #[arg(long, value_name = "TEXT")]
    pub x_label: Option<String>,
    /// What stands at the axis on the left
    #[arg(long, value_name = "TEXT")]
    pub y_label: Option<String>,
    /// What stands at the axis on the right
    #[arg(long, value_name = "TEXT")]
    pub right_label: Option<String>,
    /// Size in pixels: WIDTHxHEIGHT
    #[arg(long, value_name = "SIZE", default_value = "1200x800")]
    pub size: String,
    /// Writes the numbers to the place of -o in place of a picture
    #[arg(long)]
    pub csv: bool,
    /// Lists what there is to plot; draws nothing
    #[arg(long)]
    pub list: bool,
}

/// Makes a page of a run, for somebody else
///
/// One file of HTML that opens anywhere, without a network, and can be printed: how the run went and what it warned of,
/// pictures of the mesh, of some states and of where the variable shown is largest, what was modelled, curves of energies
/// and of all histories, extremes, contact, where the time went, and the deck. It is made from x.e, and from x.o and x.h
/// where they are.
#[derive(Debug, Args)]
pub struct Report {
    /// The run: its base name, or one of its files, x.e
    pub run: PathBuf,
    /// The page to write; else the run's name with .html, here
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Variable that colours the pictures, as for `view`
    #[arg(short, long, value_name = "NAME")]
    pub variable: Option<String>,
    /// States side by side, with commas between, as for `view`; else four from the first to the last
    #[arg(short, long, value_name = "STATES")]
    pub states: Option<String>,
    /// Side to look from, as for `view`
    #[arg(short, long, value_name = "SIDE", default_value = "iso", allow_hyphen_values = true)]
    pub from: String,
    /// Factor on displacements
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub magnify: f64,
    /// Planes of symmetry, as for `view`
    #[arg(long, value_name = "PLANES", default_value = "", hide_default_value = true)]
    pub mirror: String,
    /// Planes that cut the body open, as for `view`
    #[arg(long, value_name = "PLANES", default_value = "", hide_default_value = true)]
    pub cut: String,
    /// Leaves these blocks out
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    pub hide: Vec<i64>,
    /// Shows accelerations of histories filtered too: CFC60, CFC180, ...
    #[arg(long, value_name = "CFCnnn")]
    pub filter: Option<String>,
    /// How long a second is in the deck's units of time, for the filter
    #[arg(long, value_name = "T", default_value_t = 1.0)]
    pub second: f64,
}

/// Maps of colours that `view` knows.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum MapName {
    /// From dark to light
    Sequential,
    /// From white at zero both ways
    Diverging,
}

/// Compares two EXODUS files: 0 same, 1 differ, 2 cannot compare
///
/// Says where the largest difference of each variable is. Variables and states that only one file has count as
/// differences; titles, QA and info records do not. Meshes of different shape cannot be compared. Without a tolerance,
/// values must be equal to the bit.
#[derive(Debug, Args)]
pub struct Diff {
    /// One file
    pub first: PathBuf,
    /// The other
    pub second: PathBuf,
    /// Relative difference |a - b| / max(|a|, |b|) that counts as none
    #[arg(short, long, value_name = "T", default_value_t = 0.0)]
    pub tolerance: f64,
    /// Values both below this count as equal
    #[arg(long, value_name = "F", default_value_t = 0.0)]
    pub floor: f64,
}

/// Counts what a run would do on many ranks, and what that would cost
///
/// Takes the first steps of a deck on each number of ranks, as threads of this process however few cores there are,
/// writes no results, and counts each rank's elements, contact work, messages and bytes. Times of crowded threads mean
/// nothing: instead a machine is assumed on which every rank has a core of its own. A step takes there: elements x
/// element cost + messages x latency + bytes / bandwidth, on the slowest rank; plus the same for contact; plus the
/// collective calls, each of log2(ranks) messages. A message counts where it is sent or received, whichever is more.
/// Messages do not overlap with computing, and output is left out. Speed-up and efficiency are relative to the first
/// number of ranks, and per element where the mesh grows.
#[derive(Debug, Args)]
pub struct Scale {
    /// Where deck and mesh are.
    #[command(flatten)]
    pub input: Input,
    /// Numbers of ranks, with commas between
    #[arg(short, long, value_name = "LIST", value_delimiter = ',', default_value = "1,2,4,8,16,32,64",
          value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub ranks: Vec<u32>,
    /// Steps to count
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..))]
    pub steps: u32,
    /// Makes the mesh anew for each number of ranks, whose recipe must use the name `ranks` in an expression
    #[arg(long)]
    pub scaled: bool,
    /// How contact is shared out, in place of what the deck says with CONTACT DECOMPOSITION
    #[arg(long, value_name = "NAME")]
    pub decomposition: Option<DecompositionName>,
    /// Machine to price for; the options below replace single costs of it
    #[arg(long, value_name = "NAME", default_value = "cluster")]
    pub machine: MachineName,
    /// Microseconds for an element in a step; the costs of contact change in proportion
    #[arg(long, value_name = "US", value_parser = cost, allow_negative_numbers = true)]
    pub element_cost: Option<f64>,
    /// Microseconds for a message, whatever its length
    #[arg(long, value_name = "US", value_parser = cost, allow_negative_numbers = true)]
    pub latency: Option<f64>,
    /// Megabytes a second that one rank can send while all others send too
    #[arg(long, value_name = "MB/S", value_parser = cost, allow_negative_numbers = true)]
    pub bandwidth: Option<f64>,
    /// Writes the table as comma-separated values too, in seconds and bytes
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

/// Ways of CONTACT DECOMPOSITION.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum DecompositionName {
    /// Recursive coordinate bisection of where the nodes are
    Rcb,
    /// Slices across one axis
    Slices,
    /// With the elements
    Static,
}

/// Machines that `scale` knows.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum MachineName {
    /// Intel Paragon of 1995: element 435 us, latency 70 us, 170 MB/s
    Paragon,
    /// A present cluster: element 0.08 us, latency 1.5 us, 10 GB/s of a node shared by 32 cores
    Cluster,
}

/// A positive, finite number.
fn cost(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| *number > 0.0 && number.is_finite());
    number.ok_or_else(|| "expected a number above 0".to_string())
}

/// Joins the pieces that `run --split` wrote
///
/// The joined file is the one that a run without --split writes. All pieces must be there; states that not all of them
/// have, as a killed run leaves, are left out. The pieces stay. They have the form of Nemesis, so that other programs read
/// and join them too.
#[derive(Debug, Args)]
pub struct Join {
    /// What is in pieces, x.e, or one of the pieces, x.e.4.0
    pub pieces: PathBuf,
    /// The file to write; else x.e beside the pieces
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
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
