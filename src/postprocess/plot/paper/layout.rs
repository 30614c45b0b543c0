//! Where everything stands on a plot: margins follow from the texts, so that none runs into another.

use super::axis::Axis;
use super::legend::flow;
use super::stroke::Box2;
use crate::postprocess::plot::PlotError;
use crate::postprocess::plot::curve::Curve;
use crate::postprocess::plot::options::PlotOptions;
use crate::postprocess::view::text::{Style, Typeface};

/// Texts around the curves.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Texts {
    /// First line.
    pub title: String,
    /// Lower right corner: program and file.
    pub origin: String,
    /// Below the lower axis.
    pub below: String,
    /// Above the left axis.
    pub left: String,
    /// Above the right axis.
    pub right: String,
}

/// Sizes of letters in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Letters {
    /// Of the title.
    pub title: f64,
    /// Of axes and legend.
    pub text: f64,
    /// Of marks.
    pub mark: f64,
    /// Of the origin.
    pub small: f64,
}

/// A mark of an axis: its place in pixels along it, and its text.
pub type Mark = (f64, String);

/// An entry of the legend: place of its line's left end, and its text.
pub type Entry = ([f64; 2], String);

/// The plan of a plot.
pub struct Layout {
    /// Pixels per pixel of a picture of 1200 by 800.
    pub unit: f64,
    /// Where curves are drawn.
    pub field: Box2,
    /// Lower, left and right axis; the left one is missing when all curves are on the right.
    pub axes: (Axis, Option<Axis>, Option<Axis>),
    /// Marks of the three.
    pub marks: [Vec<Mark>; 3],
    /// One for each curve that has room.
    pub legend: Vec<Entry>,
    /// What does not fit into the legend, in words, and where they stand.
    pub more: Option<Entry>,
    /// Texts, shortened to their room.
    pub texts: Texts,
    /// Sizes of letters.
    pub letters: Letters,
    /// Baseline's middle of the line of axis texts.
    pub head: f64,
}

/// Length of a legend's line in pixels of a picture of 1200 by 800, and what stands between line, text and next entry.
pub const SAMPLE: f64 = 30.0;
const GAPS: (f64, f64) = (8.0, 26.0);
/// Share of the picture's height that a legend may take.
const LEGEND_SHARE: f64 = 0.3;
const EDGE: f64 = 26.0;

impl Layout {
    /// Plans a plot.
    ///
    /// # Errors
    /// When no curve has a value that can be drawn.
    pub fn new(curves: &[Curve], texts: &Texts, options: &PlotOptions, face: &Typeface) -> Result<Layout, PlotError> {
        let (width, height) = (f64::from(options.size.0), f64::from(options.size.1));
        let unit = (width / 1200.0).min(height / 800.0);
        let size = |pixels: f64| (pixels * unit).max(9.0);
        let letters = Letters { title: size(21.0), text: size(16.0), mark: size(15.0), small: size(12.5) };
        let edge = EDGE * unit;
        let room = width - 2.0 * edge;
        let fit = |text: &str, room: f64, style: Style| face.fit(text, room as f32, style);
        let mut texts = Texts {
            title: fit(&texts.title, room, style(letters.title, true)),
            origin: fit(&texts.origin, room, style(letters.small, false)),
            below: fit(&texts.below, room, style(letters.text, true)),
            ..texts.clone()
        };
        let both = !texts.left.is_empty() && !texts.right.is_empty();
        let half = if both { 0.48 * room } else { room };
        texts.left = fit(&texts.left, half, style(letters.text, true));
        texts.right = fit(&texts.right, half, style(letters.text, true));

        let mut top = edge + if texts.title.is_empty() { 0.0 } else { 1.6 * letters.title };
        let (legend, more, rows) = legend(curves, face, &letters, unit, [edge, top, room, height]);
        top += rows as f64 * 1.6 * letters.text;
        let headed = !(texts.left.is_empty() && texts.right.is_empty());
        let head = top + 0.7 * letters.text;
        top += if headed { 1.7 * letters.text } else { 0.6 * letters.text };
        let bottom = height - edge - 1.8 * letters.small - 1.7 * letters.text - 1.9 * letters.mark;

        let axes = axes(curves, options)?;
        let tall = (bottom - top).max(1.0);
        let upright = |axis: &Option<Axis>| {
            let wanted = ((tall / (3.0 * letters.mark)) as usize).clamp(2, 8);
            let marks = axis.as_ref().map(|axis| placed(axis, wanted, bottom, top));
            marks.unwrap_or_default()
        };
        let (left_marks, right_marks) = (upright(&axes.1), upright(&axes.2));
        let mark = style(letters.mark, false);
        let widest =
            |marks: &[Mark]| marks.iter().map(|(_, text)| f64::from(face.width(text, mark))).fold(0.0, f64::max);
        let beside = |marks: &[Mark]| if marks.is_empty() { edge } else { edge + widest(marks) + 14.0 * unit };
        let (left, mut right) = (beside(&left_marks), width - beside(&right_marks));
        let across = |wanted: usize, right: f64| placed(&axes.0, wanted, left, right);
        let mut lower = across(2, right);
        for wanted in (2..=10).rev() {
            lower = across(wanted, right);
            if apart(&lower, face, mark) {
                break;
            }
        }
        // The last mark's text may reach beyond the field.
        let overhang =
            lower.last().map_or(0.0, |(x, text)| x + 0.5 * f64::from(face.width(text, mark)) - (width - 4.0 * unit));
        if overhang > 0.0 {
            right -= overhang;
            lower = across(lower.len().max(2), right);
        }
        if !apart(&lower, face, mark) {
            lower = lower.into_iter().step_by(2).collect();
        }
        let field = Box2 { left, top, right: right.max(left + 1.0), bottom: bottom.max(top + 1.0) };
        Ok(Layout { unit, field, axes, marks: [lower, left_marks, right_marks], legend, more, texts, letters, head })
    }

    /// Where a point of a curve stands; NaN where it has no place.
    pub fn spot(&self, x: f64, y: f64, right: bool) -> [f64; 2] {
        let field = self.field;
        let axis = if right { &self.axes.2 } else { &self.axes.1 };
        let up = axis.as_ref().map_or(f64::NAN, |axis| axis.fraction(y));
        let along = self.axes.0.fraction(x);
        [field.left + along * (field.right - field.left), field.bottom + up * (field.top - field.bottom)]
    }
}

/// A style for measuring.
pub fn style(size: f64, bold: bool) -> Style {
    Style { size: size as f32, bold, colour: [0.0; 3] }
}

fn axes(curves: &[Curve], options: &PlotOptions) -> Result<(Axis, Option<Axis>, Option<Axis>), PlotError> {
    let [below, left, right] = options.ranges;
    let x = curves.iter().flat_map(|curve| curve.x.iter().copied());
    let y =
        |right: bool| curves.iter().filter(move |curve| curve.right == right).flat_map(|curve| curve.y.iter().copied());
    let nothing = || match options.log {
        log if log.x || log.y || log.right => PlotError::Nothing("no value is positive, as a logarithmic axis needs"),
        _ => PlotError::Nothing("there are no numbers"),
    };
    // Marks at a time's end say where the run ended, so time has no margins; other variables do.
    let lower = Axis::around(x, options.log.x, below, options.over.is_some()).ok_or_else(nothing)?;
    let upright = |on_right: bool, log: bool, range| match y(on_right).next() {
        Some(_) => Axis::around(y(on_right), log, range, true).ok_or_else(nothing).map(Some),
        None => Ok(None),
    };
    Ok((lower, upright(false, options.log.y, left)?, upright(true, options.log.right, right)?))
}

fn placed(axis: &Axis, wanted: usize, from: f64, to: f64) -> Vec<Mark> {
    axis.marks(wanted).into_iter().map(|(value, text)| (from + axis.fraction(value) * (to - from), text)).collect()
}

/// Whether no text of a lower axis comes near the next one.
fn apart(marks: &[Mark], face: &Typeface, style: Style) -> bool {
    let half = |text: &str| 0.5 * f64::from(face.width(text, style));
    let gap = 1.2 * f64::from(style.size);
    marks.windows(2).all(|pair| pair[1].0 - half(&pair[1].1) - pair[0].0 - half(&pair[0].1) > gap)
}

/// Entries in rows below the title; none for a single curve, whose name stands at its axis.
fn legend(
    curves: &[Curve],
    face: &Typeface,
    letters: &Letters,
    unit: f64,
    [left, top, room, height]: [f64; 4],
) -> (Vec<Entry>, Option<Entry>, usize) {
    if curves.len() < 2 {
        return (Vec::new(), None, 0);
    }
    let text_style = style(letters.text, false);
    let (sample, gap, next) = (SAMPLE * unit, GAPS.0 * unit, GAPS.1 * unit);
    let two_axes = curves.iter().any(|curve| curve.right) && curves.iter().any(|curve| !curve.right);
    let said =
        |curve: &Curve| if two_axes && curve.right { format!("{} (right)", curve.label) } else { curve.label.clone() };
    let texts: Vec<String> =
        curves.iter().map(|curve| face.fit(&said(curve), (room - sample - gap - next) as f32, text_style)).collect();
    let widths: Vec<f64> =
        texts.iter().map(|text| sample + gap + f64::from(face.width(text, text_style)) + next).collect();
    let pitch = 1.6 * letters.text;
    let rows = ((LEGEND_SHARE * height / pitch) as usize).max(1);
    let mut places = flow(&widths, room + next, rows);
    if places.len() < curves.len() {
        // The last row says how many have no room.
        let last = places.last().map_or(0, |(row, _)| *row);
        if rows > 1 {
            places.retain(|(row, _)| *row < last);
        }
    }
    let at = |(row, x): (usize, f64)| [left + x, top + (row as f64 + 0.5) * pitch];
    let entries: Vec<Entry> = places.iter().zip(texts).map(|(&place, text)| (at(place), text)).collect();
    let used = places.last().map_or(0, |(row, _)| row + 1);
    let missing = curves.len() - entries.len();
    let more = (missing > 0).then(|| (at((used, 0.0)), format!("and {missing} more")));
    let rows = used + usize::from(more.is_some());
    (entries, more, rows)
}
