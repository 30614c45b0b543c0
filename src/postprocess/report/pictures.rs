//! Pictures of the body: before the run, in some states side by side, at the end, and where the variable shown is largest.

use super::{ReportOptions, extremes};
use crate::common::numbers::number;
use crate::exodus::Results;
use crate::postprocess::view::{self, StateChoice, ViewError, ViewOptions};
use std::path::Path;

/// A picture with what is said below it.
pub struct Figure {
    /// What is said below it.
    pub caption: String,
    /// The picture, a PNG.
    pub png: Vec<u8>,
    /// It takes the whole width of the page.
    pub wide: bool,
}

/// States side by side where none are asked for.
const SHOWN: usize = 4;
/// Sizes of pictures, in pixels.
const SINGLE: (u32, u32) = (1000, 750);
const ROW: (u32, u32) = (1600, 680);

/// Draws them all; what cannot be drawn is told.
pub fn draw(results: &Results, path: &Path, options: &ReportOptions, missing: &mut Vec<String>) -> Vec<Figure> {
    let mut figures = Vec::new();
    let mut add = |what: &str, wide: bool, drawn: Result<(Vec<u8>, Option<String>), ViewError>| match drawn {
        Ok((png, shown)) => {
            let caption = shown.map_or(what.to_owned(), |variable| format!("{what}: {variable}"));
            figures.push(Figure { caption, png, wide });
        }
        Err(error) => missing.push(format!("{what}: {error}")),
    };
    let with = |state: StateChoice, size| ViewOptions { state, size, ..options.view.clone() };
    let one = |state: StateChoice| {
        let (png, summary) = view::picture(path, &with(state, SINGLE))?;
        Ok((png, summary.variable))
    };
    let mesh = ViewOptions { variable: None, arrows: None, range: None, ..with(StateChoice::Mesh, SINGLE) };
    add("The mesh, coloured by block", false, view::picture(path, &mesh).map(|(png, _)| (png, None)));
    let last = one(StateChoice::Last);
    let variable = last.as_ref().ok().and_then(|(_, variable)| variable.clone());
    let times = results.times();
    let at_end = format!("The last state, at time {}", times.last().map_or(String::new(), |time| number(*time)));
    add(&at_end, false, last);
    let states = if options.states.is_empty() { spread(times.len()) } else { options.states.clone() };
    if states.len() > 1 {
        let row = view::picture_of_row(path, &states, &with(StateChoice::Last, ROW));
        let row = row.map(|(png, shown)| (png, shown.first().and_then(|summary| summary.variable.clone())));
        add("Through the run, with one meaning of the colours", true, row);
    }
    let largest = variable.as_ref().and_then(|name| extremes::largest_state(results, name).ok().flatten());
    if let Some(state) = largest.filter(|state| *state > 0 && state + 1 < times.len()) {
        let what = format!("Where it is largest of all states, at time {}", number(times[state]));
        add(&what, false, one(StateChoice::Number(state + 1)));
    }
    figures
}

/// Some states from the first to the last.
fn spread(count: usize) -> Vec<StateChoice> {
    let shown = SHOWN.min(count);
    let mut states: Vec<usize> = (0..shown).map(|place| place * (count - 1) / (shown - 1).max(1)).collect();
    states.dedup();
    states.into_iter().map(|state| StateChoice::Number(state + 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn states_are_spread_from_first_to_last() {
        let numbers = |count: usize| {
            let states = spread(count).into_iter();
            states.map(|s| if let StateChoice::Number(n) = s { n } else { 0 }).collect::<Vec<_>>()
        };
        assert_eq!((numbers(1), numbers(2), numbers(100)), (vec![1], vec![1, 2], vec![1, 34, 67, 100]));
    }
}
