//! Where the variables of the last state are least and greatest.

use crate::exodus::{Results, ResultsError};

/// The least and the greatest value of a variable in the last state, and where they are.
#[derive(Debug, Clone, PartialEq)]
pub struct Extreme {
    /// The variable.
    pub name: String,
    /// What it is of: `node` or `element`.
    pub of: &'static str,
    /// Value, and number of the node or element.
    pub least: (f64, i64),
    /// The same.
    pub greatest: (f64, i64),
}

/// All nodal and element variables of the last state, but for those that only say what there is.
///
/// # Errors
/// When values cannot be read.
pub fn find(results: &Results) -> Result<Vec<Extreme>, ResultsError> {
    let Some(last) = results.times().len().checked_sub(1) else { return Ok(Vec::new()) };
    let mut found = Vec::new();
    let codes =
        |name: &&String| !["CONTSTAT", "CONTFACE", "DEATH", "STATUS"].iter().any(|c| name.eq_ignore_ascii_case(c));
    let ids = results.node_ids()?;
    for name in results.nodal_names().iter().filter(codes) {
        found.extend(extreme(name, "node", &results.nodal(name, last)?, &ids, &[]));
    }
    let gone = gone(results, last)?;
    let ids = results.element_ids()?;
    for name in results.element_names().iter().filter(codes) {
        found.extend(extreme(name, "element", &results.element(name, last)?, &ids, &gone));
    }
    Ok(found)
}

/// Which elements have been taken away; empty where none can be.
fn gone(results: &Results, state: usize) -> Result<Vec<bool>, ResultsError> {
    let has = |wanted: &str| results.element_names().iter().any(|name| name.eq_ignore_ascii_case(wanted));
    if !has("DEATH") {
        return Ok(Vec::new());
    }
    Ok(results.element("DEATH", state)?.into_iter().map(|death| death == 1.0).collect())
}

fn extreme(name: &str, of: &'static str, values: &[f64], ids: &[i64], gone: &[bool]) -> Option<Extreme> {
    let there = |place: usize| !gone.get(place).copied().unwrap_or(false);
    let valued = values.iter().zip(ids).enumerate().filter(|(place, (value, _))| value.is_finite() && there(*place));
    let mut valued = valued.map(|(_, (value, id))| (*value, *id));
    let first = valued.next()?;
    let (least, greatest) = valued.fold((first, first), |(least, greatest), one| {
        (if one.0 < least.0 { one } else { least }, if one.0 > greatest.0 { one } else { greatest })
    });
    Some(Extreme { name: name.to_owned(), of, least, greatest })
}

/// The state in which a variable, or the length of a vector with this stem, is largest in size; `None` where there is no
/// such variable.
///
/// # Errors
/// When values cannot be read.
pub fn largest_state(results: &Results, name: &str) -> Result<Option<usize>, ResultsError> {
    let stem = name.trim_matches('|');
    let has = |names: &[String], name: &str| names.iter().any(|known| known.eq_ignore_ascii_case(name));
    let nodal = results.nodal_names();
    let components = ["X", "Y", "Z"].map(|axis| format!("{stem}{axis}"));
    let mut best: Option<(usize, f64)> = None;
    for state in 0..results.times().len() {
        let size = if has(results.element_names(), stem) {
            largest(&results.element(stem, state)?)
        } else if has(nodal, stem) {
            largest(&results.nodal(stem, state)?)
        } else if components.iter().all(|name| has(nodal, name)) {
            let mut squares: Vec<f64> = Vec::new();
            for name in &components {
                let values = results.nodal(name, state)?;
                squares.resize(values.len(), 0.0);
                squares.iter_mut().zip(values).for_each(|(square, value)| *square += value * value);
            }
            largest(&squares)
        } else {
            return Ok(None);
        };
        if best.is_none_or(|(_, most)| size > most) {
            best = Some((state, size));
        }
    }
    Ok(best.map(|(state, _)| state))
}

fn largest(values: &[f64]) -> f64 {
    values.iter().filter(|value| value.is_finite()).fold(0.0, |most, value| f64::max(most, value.abs()))
}
