//! The front, and how quantities answer to refinement, as pictures.

use super::knobs::Knob;
use super::{Judgement, Row};
use crate::common::files;
use crate::postprocess::plot::{self, Curve, Log, PlotError, PlotOptions, Texts};
use std::path::{Path, PathBuf};

/// Least error that is drawn, where there is none: it has no logarithm.
const LEAST: f64 = 1e-9;

/// Writes both into a folder, and returns their names; what has no points is not drawn.
///
/// # Errors
/// When a picture cannot be drawn or written.
pub fn pictures(folder: &Path, title: &str, judgement: &Judgement, rows: &[Row]) -> Result<Vec<PathBuf>, PlotError> {
    let mut made = Vec::new();
    let front = front(judgement, rows);
    if front.iter().any(|curve| !curve.x.is_empty()) {
        let texts = texts(title, "processor time, s", "largest error, %");
        let log = Log { x: true, y: true, right: false };
        made.push(draw(folder.join("front.png"), &front, &texts, log)?);
    }
    let meshes = meshes(judgement);
    if meshes.iter().any(|curve| curve.x.len() > 1) {
        let texts = texts(title, "width of the mesh, of that given", "value, of the best known");
        made.push(draw(folder.join("refinement.png"), &meshes, &texts, Log { x: false, y: false, right: false })?);
    }
    Ok(made)
}

fn texts(title: &str, below: &str, left: &str) -> Texts {
    Texts {
        title: title.to_owned(),
        origin: format!("urto {}", env!("CARGO_PKG_VERSION")),
        below: below.to_owned(),
        left: left.to_owned(),
        right: String::new(),
    }
}

fn draw(path: PathBuf, curves: &[Curve], texts: &Texts, log: Log) -> Result<PathBuf, PlotError> {
    let options = PlotOptions { log, ..PlotOptions::default() };
    let bytes = plot::picture(&path, curves, texts, &options)?;
    files::replace(&path, &bytes)
        .map_err(|error| PlotError::Write { path: path.clone(), reason: error.to_string() })?;
    Ok(path)
}

fn curve(label: String, points: &[[f64; 2]]) -> Curve {
    let (x, y) = points.iter().map(|&[x, y]| (x, y)).unzip();
    Curve { points: true, ..Curve::of(label, x, y) }
}

/// Knobs whose way is drawn: all that were turned, in the order of the rows.
fn turned(rows: &[Row]) -> Vec<Knob> {
    let mut knobs: Vec<Knob> = Vec::new();
    for knob in rows.iter().map(|row| row.variant.knob) {
        if !matches!(knob, Knob::None | Knob::RoundOff) && !knobs.contains(&knob) {
            knobs.push(knob);
        }
    }
    knobs
}

/// The front as a line, and for each knob the way that it goes from the deck as it is, from the cheapest to the dearest.
fn front(judgement: &Judgement, rows: &[Row]) -> Vec<Curve> {
    let point = |row: usize| -> Option<[f64; 2]> {
        let measured = rows[row].outcome.as_ref().ok()?;
        let error = judgement.errors[row];
        error.is_finite().then_some([measured.seconds.max(1e-3), 100.0 * error.max(LEAST)])
    };
    let line: Vec<[f64; 2]> = judgement.front.iter().filter_map(|&row| point(row)).collect();
    let front_of = |knob: Knob| {
        let own = (1..rows.len()).filter(|&row| rows[row].variant.knob == knob).filter_map(point);
        let mut points: Vec<[f64; 2]> = own.chain(point(0)).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        (points.len() > 1).then(|| curve(knob.name().into(), &points))
    };
    [curve("front".into(), &line)].into_iter().chain(turned(rows).into_iter().filter_map(front_of)).collect()
}

fn meshes(judgement: &Judgement) -> Vec<Curve> {
    let of = |verdict: &super::Verdict| {
        let points: Vec<[f64; 2]> = verdict.meshes.iter().map(|(r, value)| [1.0 / r, value / verdict.best]).collect();
        curve(verdict.quantity.to_string(), &points)
    };
    judgement.verdicts.iter().map(of).collect()
}
