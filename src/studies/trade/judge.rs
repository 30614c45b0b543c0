//! Errors of all variants, the front, and the cheapest that is good enough.

use super::estimate::{Refinement, refinement};
use super::knobs::Knob;
use super::quantities::Quantity;
use super::{Measured, Row};

/// Part of a value by which meshes may differ without telling anything, as momenta do that are the same on all.
const ROUND_OFF: f64 = 1e-9;

/// What is known of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// The quantity.
    pub quantity: Quantity,
    /// What refinement says.
    pub refinement: Refinement,
    /// Part of the value by which round-off scatters it: the least error that is claimed.
    pub scatter: f64,
    /// Best value that is known: the limit of refinement, or else of the finest mesh.
    pub best: f64,
    /// Bound on the error of the finest mesh, as a part of the best value; infinite where nothing is known of it.
    pub finest: f64,
    /// Refinements with their values.
    pub meshes: Vec<(f64, f64)>,
    /// Difference of each row from the best value, as a part of it; NaN where there is none. An error only if the quantity converges.
    pub errors: Vec<f64>,
}

/// All of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// One for each quantity.
    pub verdicts: Vec<Verdict>,
    /// Largest error of each row over all quantities that converge; NaN where it was not measured, or none does.
    pub errors: Vec<f64>,
    /// Rows than which none is both cheaper and better, the cheapest first.
    pub front: Vec<usize>,
}

impl Verdict {
    /// Whether meshes show where it goes, so that errors can be claimed; where there is one mesh, differences from it.
    pub fn converges(&self) -> bool {
        !matches!(self.refinement, Refinement::Wanders { .. })
    }
}

impl Judgement {
    /// Judges rows, the first of which is the deck as it is.
    pub fn of(quantities: &[Quantity], rows: &[Row]) -> Judgement {
        let verdicts: Vec<Verdict> =
            (0..quantities.len()).map(|place| verdict(&quantities[place], place, rows)).collect();
        let believed: Vec<&Verdict> = verdicts.iter().filter(|verdict| verdict.converges()).collect();
        let largest = |row: usize| {
            if rows[row].outcome.is_err() || believed.is_empty() {
                return f64::NAN;
            }
            believed.iter().map(|verdict| verdict.errors[row].max(verdict.scatter)).fold(0.0, f64::max)
        };
        let errors: Vec<f64> = (0..rows.len()).map(largest).collect();
        let front = front(rows, &errors);
        Judgement { verdicts, errors, front }
    }

    /// The cheapest row whose error is no larger than a part of the values.
    pub fn cheapest(&self, within: f64, rows: &[Row]) -> Option<usize> {
        let good = (0..rows.len()).filter(|&row| offered(&rows[row]) && self.errors[row] <= within);
        good.min_by(|&a, &b| seconds(&rows[a]).total_cmp(&seconds(&rows[b])))
    }

    /// Of the knobs that were turned to something no less exact, the one with the largest effect on a quantity, with that effect.
    pub fn largest_part(&self, rows: &[Row]) -> Option<(Knob, f64)> {
        let base = rows.first()?.outcome.as_ref().ok()?;
        let mut parts: Vec<(Knob, f64)> = Vec::new();
        for row in rows.iter().filter(|row| row.variant.is_finer()) {
            let Ok(found) = &row.outcome else { continue };
            let change = |place: usize| ((found.values[place] - base.values[place]) / self.verdicts[place].best).abs();
            let most = (0..self.verdicts.len()).map(change).filter(|change| change.is_finite()).fold(0.0, f64::max);
            parts.push((row.variant.knob, most));
        }
        parts.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Whether a row can be advised: a perturbation is no choice.
fn offered(row: &Row) -> bool {
    row.variant.knob != Knob::RoundOff && row.outcome.is_ok()
}

fn seconds(row: &Row) -> f64 {
    row.outcome.as_ref().map_or(f64::INFINITY, |measured| measured.seconds)
}

fn verdict(quantity: &Quantity, place: usize, rows: &[Row]) -> Verdict {
    let value = |row: &Row| row.outcome.as_ref().ok().map(|measured: &Measured| measured.values[place]);
    let base = rows.first().and_then(value).unwrap_or(f64::NAN);
    let noisy = rows.iter().find(|row| row.variant.knob == Knob::RoundOff).and_then(value);
    let scatter = noisy.map_or(0.0, |noisy| (noisy - base).abs());
    let on_mesh = |row: &&Row| matches!(row.variant.knob, Knob::None | Knob::Mesh);
    let mut meshes: Vec<(f64, f64)> =
        rows.iter().filter(on_mesh).filter_map(|row| Some((f64::from(row.variant.refine), value(row)?))).collect();
    meshes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let refinement = refinement(&meshes, scatter.max(ROUND_OFF * base.abs()));
    let finest = meshes.last().map_or(base, |mesh| mesh.1);
    let (best, bound) = match refinement {
        Refinement::Converges { limit, finest, .. } => (limit, finest),
        Refinement::Wanders { change } => (finest, change),
        Refinement::Unknown => (base, f64::INFINITY),
    };
    let part = |difference: f64| (difference / best).abs();
    // What is not more exact than the deck may come nearer by chance, where errors cancel: that is not believed.
    let error = |row: &Row| {
        let value = value(row)?;
        let exact = row.variant.is_finer() || row.variant.knob == Knob::None;
        Some(if exact { part(value - best) } else { part(base - best) + part(value - base) })
    };
    let errors = rows.iter().map(|row| error(row).unwrap_or(f64::NAN)).collect();
    Verdict {
        quantity: quantity.clone(),
        refinement,
        scatter: part(scatter),
        best,
        finest: part(bound),
        meshes,
        errors,
    }
}

fn front(rows: &[Row], errors: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..rows.len()).filter(|&row| offered(&rows[row]) && errors[row].is_finite()).collect();
    order.sort_by(|&a, &b| seconds(&rows[a]).total_cmp(&seconds(&rows[b])).then(errors[a].total_cmp(&errors[b])));
    let mut best = f64::INFINITY;
    order.retain(|&row| {
        let better = errors[row] < best;
        best = best.min(errors[row]);
        better
    });
    order
}
