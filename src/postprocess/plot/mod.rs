//! Curves from results: variables over time or over each other, filtered, differentiated, compared, as a picture (PNG,
//! SVG) or as numbers (CSV).
//!
//! Data flows one way: files become a `run`, its variables `curve`s (`pick`, `reference`), which are worked on
//! (`work`, `filter`, `signal`) and end on `paper` or in `table`s of numbers.

mod curve;
mod error;
mod filter;
mod options;
mod paper;
mod pick;
mod reference;
mod run;
mod signal;
mod table;
mod work;

use crate::common::files;
use std::path::Path;

pub use curve::{Curve, Extremes};
pub use error::PlotError;
pub use filter::{Before, Class};
pub use options::{Log, PlotOptions, Range};
pub use paper::Texts;
pub use run::{Run, Site};

/// What a plot shows, for the lines that are printed about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The title of the first run.
    pub title: String,
    /// The curves, as they are drawn.
    pub curves: Vec<Curve>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// The curves that are asked for, worked on.
///
/// # Errors
/// [`PlotError`], when a file cannot be read, lacks what is asked for, or holds nothing that can be worked on.
pub fn curves(options: &PlotOptions) -> Result<Drawn, PlotError> {
    options.check()?;
    let runs = options.files.iter().map(|path| Run::open(path)).collect::<Result<Vec<_>, _>>()?;
    let (mut curves, mut warnings) = pick::curves(&runs, options)?;
    warnings.extend(work::on(&mut curves, &runs, options)?);
    for path in &options.references {
        curves.extend(reference::read(path)?);
    }
    let title = runs.first().map(Run::title).unwrap_or_default();
    Ok(Drawn { title, curves, warnings })
}

/// All variables of the whole body in a file and what belongs to it, as they are.
///
/// # Errors
/// When it cannot be read, or has no states.
pub fn whole_body(path: &Path) -> Result<Vec<Curve>, PlotError> {
    let run = Run::open(path)?;
    let curve = |name: &String| {
        let y = run.values(name, Site::Global)?;
        Ok(Curve { means: run.is_mean(name), ..Curve::of(name, run.times().to_vec(), y) })
    };
    run.names(Site::Global).iter().map(curve).collect()
}

/// What is written around the curves. The name of an axis' only curve stands at the axis.
fn texts(drawn: &Drawn, options: &PlotOptions) -> Texts {
    let only = |right: bool| {
        let mut own = drawn.curves.iter().filter(|curve| curve.right == right);
        own.next().filter(|_| own.next().is_none()).map(|curve| curve.label.clone())
    };
    let [below, left, right] = options.labels.clone();
    let name = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let files: Vec<String> = options.files.iter().map(|path| name(path)).collect();
    Texts {
        title: options.title.clone().unwrap_or_else(|| drawn.title.clone()),
        origin: format!("urto {} · {}", env!("CARGO_PKG_VERSION"), files.join(", ")),
        below: below.unwrap_or_else(|| options.x_name()),
        left: left.or_else(|| only(false)).unwrap_or_default(),
        right: right.or_else(|| only(true)).unwrap_or_default(),
    }
}

/// The same as a picture, whose kind the suffix of `picture` tells: `.png` or `.svg`.
///
/// # Errors
/// Those of [`curves`], and when the picture cannot be drawn or written.
pub fn draw(picture: &Path, options: &PlotOptions) -> Result<Drawn, PlotError> {
    let drawn = curves(options)?;
    let bytes = paper::draw(picture, &drawn.curves, &texts(&drawn, options), options)?;
    write(picture, &bytes)?;
    Ok(drawn)
}

/// Curves that the caller has made, as the bytes of a picture, whose kind the suffix of `name` tells.
///
/// # Errors
/// When they hold nothing that can be drawn.
pub fn picture(name: &Path, curves: &[Curve], texts: &Texts, options: &PlotOptions) -> Result<Vec<u8>, PlotError> {
    options.check()?;
    paper::draw(name, curves, texts, options)
}

/// The same as comma-separated values.
///
/// # Errors
/// Those of [`curves`], and when the file cannot be written.
pub fn tabulate(path: &Path, options: &PlotOptions) -> Result<Drawn, PlotError> {
    let drawn = curves(options)?;
    write(path, table::csv(&drawn.curves, &options.x_name()).as_bytes())?;
    Ok(drawn)
}

/// What there is to plot in each file, as lines of text.
///
/// # Errors
/// When a file cannot be read.
pub fn contents(files: &[std::path::PathBuf]) -> Result<String, PlotError> {
    let runs = files.iter().map(|path| Run::open(path)).collect::<Result<Vec<_>, _>>()?;
    Ok(runs.iter().map(Run::contents).collect::<Vec<_>>().join("\n"))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), PlotError> {
    files::replace(path, bytes).map_err(|error| PlotError::Write { path: path.to_owned(), reason: error.to_string() })
}
