//! `urto report`: a run as one page of HTML, for somebody else: what was modelled, how it went, what it looks like, its
//! curves, its deck. Everything is in the one file.
//!
//! `log` reads the print log, `pictures` and `curves` draw from the results, `extremes` finds where variables are
//! largest, `page` puts it together with `html`.

mod curves;
mod error;
mod extremes;
mod html;
mod log;
mod page;
mod pictures;

pub use error::ReportError;

use crate::common::files;
use crate::exodus::Results;
use crate::postprocess::depiction::Depiction;
use crate::postprocess::means::Means;
use crate::postprocess::plot::Class;
use crate::postprocess::view::ViewOptions;
use crate::run::{Files, first_part_of, last_part_of};
use std::path::{Path, PathBuf};

/// What a report shows.
#[derive(Debug, Clone)]
pub struct ReportOptions {
    /// How pictures look; the states are chosen by `states`.
    pub view: ViewOptions,
    /// States that are shown side by side; without any, four spread over the run.
    pub states: Vec<crate::postprocess::view::StateChoice>,
    /// Filter of accelerations, which are shown beside what they are without it.
    pub filter: Option<Class>,
    /// How long a second is in the deck's units of time.
    pub second: f64,
}

/// What was put into a report, for the line that is printed about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Reported {
    /// Number of pictures of the body.
    pub pictures: usize,
    /// Number of plots.
    pub plots: usize,
    /// What could not be shown, and why.
    pub missing: Vec<String>,
}

/// The files of a run, by its base name or by the name of one of them; that of a later part stands for the whole run.
pub fn files_of(named: &Path) -> Files {
    let named = &first_part_of(named);
    let suffixes = ["e", "o", "h", "i", "g"];
    let is_one = named.extension().is_some_and(|suffix| suffixes.iter().any(|known| suffix == *known));
    if is_one { Files::of(&named.with_extension("")) } else { Files::of(named) }
}

/// Everything that the page is made of.
struct Material {
    title: String,
    files: Files,
    /// The deck, as the results carry it.
    deck: Vec<String>,
    /// Program, version, date and time of the run.
    made_by: Vec<[String; 4]>,
    times: Vec<f64>,
    log: Option<log::Log>,
    pictures: Vec<pictures::Figure>,
    curves: Vec<curves::Group>,
    extremes: Vec<extremes::Extreme>,
    missing: Vec<String>,
}

/// Writes the report of a run.
///
/// # Errors
/// When the results cannot be read, or the page cannot be written. A picture that cannot be drawn is left out and told.
pub fn report(files: &Files, output: &Path, options: &ReportOptions) -> Result<Reported, ReportError> {
    // Of a run that went on the last part has its end; curves and extremes of the whole are read from all parts or told by theirs.
    let last = last_part_of(&files.plot);
    let results = Results::open(&last)?;
    if results.times().is_empty() {
        return Err(ReportError::NoStates(last));
    }
    let mut missing = Vec::new();
    let material = Material {
        title: results.title().trim().to_owned(),
        files: files.clone(),
        deck: Means::without(Depiction::without(results.info())),
        made_by: results.qa(),
        times: results.times().to_vec(),
        log: log::Log::read(&files.print),
        extremes: extremes::find(&results)?,
        pictures: pictures::draw(&results, &last, options, &mut missing),
        curves: curves::draw(files, options, &mut missing),
        missing,
    };
    let plots = material.curves.iter().map(|group| group.plots.len()).sum();
    let text = page::compose(&material);
    files::replace(output, text.as_bytes())
        .map_err(|source| ReportError::Write { path: PathBuf::from(output), reason: source.to_string() })?;
    Ok(Reported { pictures: material.pictures.len(), plots, missing: material.missing })
}
