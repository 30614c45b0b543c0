//! Options of the verbs that read results.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

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
    #[arg(short, long, alias = "variables", value_name = "NAME")]
    pub variable: Option<String>,
    /// State: its number from 1, last, t=TIME for the nearest one, or mesh for the mesh before the run; several, with commas
    /// between, side by side in one picture [default: last]
    #[arg(short, long, alias = "states", value_name = "STATE", conflicts_with = "time")]
    pub state: Option<String>,
    /// State nearest to a time
    #[arg(short, long, value_name = "T")]
    pub time: Option<f64>,
    /// Side to look from: front, back, left, right, top, bottom, iso, or AZIMUTH,ELEVATION in degrees
    #[arg(short, long, value_name = "SIDE", default_value = "iso", allow_hyphen_values = true)]
    pub from: String,
    /// Factor on displacements
    #[arg(long, value_name = "F", default_value_t = 1.0, allow_negative_numbers = true)]
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

/// Maps of colours that `view` knows.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum MapName {
    /// From dark to light
    Sequential,
    /// From white at zero both ways
    Diverging,
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
    #[arg(short, long, alias = "variable", value_name = "NAMES", value_delimiter = ',')]
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
    #[arg(short, long, alias = "variables", value_name = "NAME")]
    pub variable: Option<String>,
    /// States side by side, with commas between, as for `view`; else four from the first to the last
    #[arg(short, long, alias = "state", value_name = "STATES")]
    pub states: Option<String>,
    /// Side to look from, as for `view`
    #[arg(short, long, value_name = "SIDE", default_value = "iso", allow_hyphen_values = true)]
    pub from: String,
    /// Factor on displacements
    #[arg(long, value_name = "F", default_value_t = 1.0, allow_negative_numbers = true)]
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
    #[arg(short, long, value_name = "T", default_value_t = 0.0, value_parser = not_negative)]
    pub tolerance: f64,
    /// Values both below this count as equal
    #[arg(long, value_name = "F", default_value_t = 0.0, value_parser = not_negative)]
    pub floor: f64,
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

/// A number of at least 0.
fn not_negative(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "expected a number".to_owned())?;
    if number >= 0.0 { Ok(number) } else { Err("expected a number of at least 0".to_owned()) }
}
