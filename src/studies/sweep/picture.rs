//! What a study found, drawn: the peak of each variable over the first parameter that is a number.

use super::table::labels;
use super::{Axis, Row};
use crate::common::files;
use crate::postprocess::plot::{self, Curve, PlotError, PlotOptions, Texts};
use std::path::{Path, PathBuf};

/// Writes a picture for each variable into a folder, and returns their names. One curve for each combination of the other
/// parameters; nothing where no parameter has two or more numbers.
///
/// # Errors
/// When a picture cannot be drawn or written.
pub fn pictures(folder: &Path, title: &str, axes: &[Axis], rows: &[Row]) -> Result<Vec<PathBuf>, PlotError> {
    let numbers = |axis: &Axis| axis.values.iter().filter_map(|value| value.parse::<f64>().ok()).count();
    let Some(over) = axes.iter().position(|axis| numbers(axis) >= 2 && numbers(axis) == axis.values.len()) else {
        return Ok(Vec::new());
    };
    let mut made = Vec::new();
    for (label, filtered) in labels(rows) {
        let curves = curves(rows, over, &label);
        if curves.iter().all(|curve| curve.extremes().is_none()) {
            continue;
        }
        let path = folder.join(file_name(&label));
        let what = if filtered { "filtered peak" } else { "peak" };
        let texts = Texts {
            title: title.to_owned(),
            origin: format!("urto {}", env!("CARGO_PKG_VERSION")),
            below: axes[over].name.clone(),
            left: format!("{what} of {label}"),
            right: String::new(),
        };
        let bytes = plot::picture(&path, &curves, &texts, &PlotOptions::default())?;
        files::replace(&path, &bytes)
            .map_err(|error| PlotError::Write { path: path.clone(), reason: error.to_string() })?;
        made.push(path);
    }
    Ok(made)
}

/// A variable's peaks, a curve for each combination of the parameters but one.
fn curves(rows: &[Row], over: usize, label: &str) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for row in rows {
        let mut values = row.member.values.clone();
        let (_, x) = values.remove(over);
        let others: Vec<String> = values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        let name = if others.is_empty() { label.to_owned() } else { others.join(", ") };
        let found = row.found.iter().flatten().find(|found| found.label == label);
        let y = found.map_or(f64::NAN, |found| found.filtered.unwrap_or(found.peak));
        let place = curves.iter().position(|curve| curve.label == name).unwrap_or_else(|| {
            curves.push(Curve { points: true, ..Curve::of(name, Vec::new(), Vec::new()) });
            curves.len() - 1
        });
        curves[place].x.push(x.parse().unwrap_or(f64::NAN));
        curves[place].y.push(y);
    }
    curves
}

/// A name that every file system takes.
fn file_name(label: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = label.chars().map(plain).collect();
    format!("{}.png", name.trim_matches('_'))
}
