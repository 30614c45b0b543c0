//! What the members of a study have reached.

use crate::postprocess::plot::{self, Class, PlotError, PlotOptions};
use std::path::Path;

/// What is looked for in each member.
#[derive(Debug, Clone, Default)]
pub struct Wanted {
    /// Variables, in the manner of plots.
    pub variables: Vec<String>,
    /// Numbers of nodes at which nodal variables are taken.
    pub nodes: Vec<i64>,
    /// Numbers of elements in which element variables are taken.
    pub elements: Vec<i64>,
    /// Filter of the filtered peak.
    pub filter: Option<Class>,
    /// How long a second is in the deck's units.
    pub second: f64,
}

/// What a variable has reached in a member.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The variable, with its place.
    pub label: String,
    /// Its last value.
    pub last: f64,
    /// The value farthest from zero, with its sign.
    pub peak: f64,
    /// When that was.
    pub peak_time: f64,
    /// The same of the filtered variable, if a filter was asked for.
    pub filtered: Option<f64>,
}

/// What was looked for, in the history or else in the results of a run.
///
/// # Errors
/// When neither has it, or it cannot be filtered.
pub fn found(results: &Path, history: &Path, wanted: &Wanted) -> Result<Vec<Found>, PlotError> {
    let mut all = Vec::new();
    for variable in &wanted.variables {
        let from = |file: &Path| of(file, variable, wanted);
        all.extend(match history.exists().then(|| from(history)) {
            Some(Ok(found)) => found,
            _ => from(results)?,
        });
    }
    Ok(all)
}

fn of(file: &Path, variable: &str, wanted: &Wanted) -> Result<Vec<Found>, PlotError> {
    let mut options = PlotOptions {
        files: vec![file.to_owned()],
        variables: vec![variable.to_owned()],
        nodes: wanted.nodes.clone(),
        elements: wanted.elements.clone(),
        second: wanted.second,
        ..PlotOptions::default()
    };
    let curves = plot::curves(&options)?.curves;
    options.filter = wanted.filter;
    let filtered = if wanted.filter.is_some() { plot::curves(&options)?.curves } else { Vec::new() };
    let one = |(place, curve): (usize, &plot::Curve)| {
        let extremes = curve.extremes()?;
        let [peak_time, peak] = extremes.farthest();
        let filtered = filtered.get(place).and_then(|curve| Some(curve.extremes()?.farthest()[1]));
        Some(Found { label: curve.label.clone(), last: extremes.last[1], peak, peak_time, filtered })
    };
    Ok(curves.iter().enumerate().filter_map(one).collect())
}
