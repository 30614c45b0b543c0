//! Options of the verbs that run a deck, or look at it before it is run.

use super::Input;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Runs a deck
///
/// Writes the print log x.o and the plot states x.e in the present folder; an old print log is kept as x.o.1, x.o.2 and so on.
/// A second run with the same output is refused while one is writing. Results are the same to the bit on any number of ranks.
/// To stop a run in good order, create a file x.shutdown beside the log or send SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2 or
/// SIGXCPU: it writes a last state and leaves. With WRITE RESTART in the deck it also leaves x.rsout, the state one step later, from which
/// --restart or READ RESTART goes on; a run that comes to its end leaves the one before its last twenty steps. The run looks at itself: what it has to warn of, such as contact that makes energy or corners that
/// turn inside out, stands on the terminal, in the log and in the last line.
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

/// Reads deck and mesh and says what would be modelled; runs nothing
///
/// Prints what is modelled and why, the first time step and the element that controls it, and the memory and time to
/// expect.
#[derive(Debug, Args)]
pub struct Check {
    /// Where deck and mesh are.
    #[command(flatten)]
    pub input: Input,
    /// Warnings count as a failure: all is told, but the exit code is 1
    #[arg(long)]
    pub strict: bool,
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
    /// Multiplies every number of elements along an edge, of a mesh that is made from a recipe; what the deck gives per node of a set
    /// keeps its total
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub refine: u32,
    /// Ranks of each run
    #[arg(short, long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub ranks: u32,
    /// Runs at a time; else as many as have a core for each of their ranks
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub jobs: Option<u32>,
    /// Variables of results and histories that the table has, with commas between, as for `plot`
    #[arg(short, long, alias = "variable", value_name = "NAMES", value_delimiter = ',')]
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
/// refinement does come into a folder, as text, CSV and PNG, with the cheapest variant that is good enough in words. Forces and masses
/// per node of a set keep their totals on finer meshes. What was run
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
