//! `urto explain --curve`: how a block's law answers to simple motions.

use crate::cli::input::deck_alone;
use crate::cli::outputs::{ANOTHER_NAME, Inputs};
use crate::cli::terminal::say;
use crate::cli::{DONE, Failure, options};
use crate::common::files;
use crate::material::response::{Motion, curve as response};
use crate::output::print::scientific;
use crate::postprocess::plot::{self, Curve, PlotOptions, Texts};
use std::path::{Path, PathBuf};

/// Draws the answers, and says where they end.
pub fn curve(options: &options::Explain, deck: &str, block: &str) -> Result<u8, Failure> {
    for (name, value) in [("strain", options.strain), ("rate", options.rate)] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Failure::input(format_args!("error: --{name} is {value}; expected a positive number")));
        }
    }
    let id: i64 =
        block.parse().map_err(|_| Failure::input(format_args!("error: {block} is no number of an element block")))?;
    let (deck, problem) = deck_alone(Path::new(deck), &options.define)?;
    let Some(material) = problem.model.materials.iter().find(|material| material.block == id) else {
        let known: Vec<String> = problem.model.materials.iter().map(|material| material.block.to_string()).collect();
        return Err(Failure::input(format_args!(
            "error: {} has no MATERIAL {id}; it has {}",
            deck.display(),
            known.join(", ")
        )));
    };
    let stem = deck.file_stem().unwrap_or_default().to_string_lossy();
    let output = options.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}_block{id}.png")));
    Inputs::default().with("the deck", [&deck]).spare([&output], ANOTHER_NAME)?;
    let curves: Vec<Curve> = Motion::ALL
        .into_iter()
        .map(|(motion, name)| {
            let points = response(&material.law, motion, options.strain, options.rate);
            let (x, y) = points.into_iter().map(|[x, y]| (x, y)).unzip();
            Curve::of(name, x, y)
        })
        .collect();
    let texts = Texts {
        title: format!("Block {id}: {}", material.law.entry().name),
        origin: format!("urto {} · {}", env!("CARGO_PKG_VERSION"), deck.display()),
        below: "strain".to_owned(),
        left: "stress".to_owned(),
        right: String::new(),
    };
    let bytes = plot::picture(&output, &curves, &texts, &PlotOptions::default()).map_err(Failure::input_error)?;
    files::replace(&output, &bytes)
        .map_err(|e| Failure::run(format_args!("error: cannot write {}: {e}", output.display())))?;
    say(format_args!("{}: block {id}, {}", output.display(), material.law.entry().name));
    for curve in &curves {
        let Some(extremes) = curve.extremes() else { continue };
        let [at, most] = extremes.farthest();
        let [most, at, end] = [most, at, extremes.last[0]].map(|value| scientific(value, 4));
        say(format_args!("{:<26}largest stress {most} at strain {at}, followed to {end}", curve.label));
    }
    Ok(DONE)
}
