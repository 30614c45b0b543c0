//! The judgement as a table, as numbers, and in words.

use super::estimate::Refinement;
use super::knobs::Knob;
use super::{Judgement, Row, Verdict};
use crate::common::numbers::scientific;
use std::fmt::Write;

/// Scatter from which a quantity is called chaotic.
const CHAOS: f64 = 0.01;

/// A part in per cent, in two digits.
fn percent(part: f64) -> String {
    match 100.0 * part {
        percent if percent.is_nan() => "-".into(),
        0.0 => "0 %".into(),
        percent if percent >= 9.95 => format!("{percent:.0} %"),
        percent if percent >= 0.095 => format!("{percent:.1} %"),
        percent if percent >= 0.001 => format!("{percent:.3} %"),
        percent => format!("{} %", scientific(percent, 0)),
    }
}

/// The table for a person: a line for each variant, then one for each quantity.
pub fn text(judgement: &Judgement, rows: &[Row]) -> String {
    let mut lines =
        vec![["VARIANT", "KNOB", "SECONDS", "STEPS", "MB", "ERROR", "", "WHAT IT IS"].map(String::from).to_vec()];
    for (place, row) in rows.iter().enumerate() {
        let name = vec![row.variant.name.clone(), row.variant.knob.name().to_string()];
        let own = match &row.outcome {
            Ok(measured) => vec![
                format!("{:.2}", measured.seconds),
                measured.steps.to_string(),
                measured.memory.map_or("-".into(), |bytes| format!("{:.0}", bytes / 1e6)),
                percent(judgement.errors[place]),
                if judgement.front.contains(&place) { "front".into() } else { String::new() },
                row.variant.words.clone(),
            ],
            Err(reason) => ["-", "-", "-", "-", ""]
                .map(String::from)
                .into_iter()
                .chain([format!("{}: {reason}", row.variant.words)])
                .collect(),
        };
        lines.push([name, own].concat());
    }
    let mut out = columns(&lines, 2);
    out += "\n";
    let mut quantities =
        vec![["QUANTITY", "BEST VALUE", "AS IT IS", "SCATTER", "FINEST", "REFINEMENT"].map(String::from).to_vec()];
    for verdict in &judgement.verdicts {
        quantities.push(vec![
            verdict.quantity.to_string(),
            scientific(verdict.best, 4),
            percent(verdict.errors.first().copied().filter(|_| verdict.converges()).unwrap_or(f64::NAN)),
            percent(verdict.scatter),
            match verdict.finest {
                finest if !finest.is_finite() => "-".into(),
                finest if verdict.converges() => percent(finest),
                // The last change is the least that can be wrong.
                finest => format!("> {}", percent(finest)),
            },
            refined(verdict),
        ]);
    }
    out + &columns(&quantities, 1)
}

/// What refinement says of a quantity, in words.
fn refined(verdict: &Verdict) -> String {
    match verdict.refinement {
        Refinement::Unknown => "no finer mesh was run".into(),
        Refinement::Wanders { .. } => "DOES NOT CONVERGE on these meshes".into(),
        Refinement::Converges { order, .. } if order.is_nan() => "no change beyond the scatter".into(),
        Refinement::Converges { order, observed: true, .. } => format!("order {order:.1}"),
        Refinement::Converges { order, .. } => format!("order {order:.0}, taken for granted"),
    }
}

/// Cells in columns; the first ones are set to the left, the last one too, all others to the right.
fn columns(lines: &[Vec<String>], left: usize) -> String {
    let count = lines.first().map_or(0, Vec::len);
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..count).map(width).collect();
    let mut out = String::new();
    for line in lines {
        let cells = line.iter().zip(&widths).enumerate().map(|(place, (cell, width))| {
            if place < left || place + 1 == count { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
        });
        let _ = writeln!(out, "{}", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
    out
}

/// The same for programs, with all digits.
pub fn csv(judgement: &Judgement, rows: &[Row]) -> String {
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let mut out = String::from("variant,knob,what,seconds,steps,memory_bytes,error,on_front");
    judgement.verdicts.iter().for_each(|verdict| out += &format!(",{}", quoted(&verdict.quantity.to_string())));
    out += "\n";
    for (place, row) in rows.iter().enumerate() {
        let own = format!("{},{},{}", row.variant.name, row.variant.knob.name(), quoted(&row.variant.words));
        match &row.outcome {
            Ok(measured) => {
                let memory = measured.memory.map_or(String::new(), |bytes| format!("{bytes}"));
                let values: String = measured.values.iter().map(|value| format!(",{value:e}")).collect();
                let on_front = judgement.front.contains(&place);
                let error = judgement.errors[place];
                let error = if error.is_nan() { String::new() } else { format!("{error:e}") };
                let _ =
                    writeln!(out, "{own},{},{},{memory},{error},{on_front}{values}", measured.seconds, measured.steps);
            }
            Err(_) => {
                let _ = writeln!(out, "{own},,,,,{}", ",".repeat(judgement.verdicts.len()));
            }
        }
    }
    out
}

/// What the user wants to know, in sentences.
pub fn words(judgement: &Judgement, rows: &[Row], within: f64) -> String {
    let mut out = String::new();
    let Some(Ok(base)) = rows.first().map(|row| &row.outcome) else { return out };
    let known = judgement.verdicts.iter().any(|verdict| !matches!(verdict.refinement, Refinement::Unknown));
    if !known {
        out += "No finer mesh was run: the errors are differences from the deck as it is, and its own error is not known.\n";
    }
    let wanders = judgement.verdicts.iter().filter(|verdict| !verdict.converges()).count();
    match judgement.cheapest(within, rows) {
        _ if wanders > 0 && wanders == judgement.verdicts.len() => {
            out += "No quantity converges on these meshes: no error is known, and nothing can be advised. Finer meshes may tell more \
                    (--levels), or other quantities (--quantity).\n";
        }
        Some(row) => {
            let variant = &rows[row].variant;
            let seconds = rows[row].outcome.as_ref().map_or(f64::NAN, |measured| measured.seconds);
            let ratio = base.seconds / seconds;
            let than = match ratio {
                _ if row == 0 => String::new(),
                ratio if ratio >= 1.0 => format!(", {ratio:.1} times faster than the deck as it is"),
                ratio => format!(", {:.1} times slower than the deck as it is", 1.0 / ratio),
            };
            let what = if row == 0 {
                "the deck as it is".to_string()
            } else {
                format!("{} ({})", variant.name, variant.words)
            };
            let of = if wanders > 0 { ", in what converges" } else { "" };
            let _ = writeln!(out, "The cheapest within {}{of}: {what}{than}.", percent(within));
        }
        None => {
            let best = judgement.front.last().map_or("none", |&row| rows[row].variant.name.as_str());
            let error = judgement.front.last().map_or(f64::NAN, |&row| judgement.errors[row]);
            let _ = writeln!(
                out,
                "Nothing that was run is within {}; the best is {best}, with {}.",
                percent(within),
                percent(error)
            );
        }
    }
    for verdict in judgement.verdicts.iter().filter(|_| known) {
        let (name, error) = (&verdict.quantity, percent(verdict.errors.first().copied().unwrap_or(f64::NAN)));
        let _ = match verdict.refinement {
            Refinement::Wanders { .. } => {
                writeln!(out, "{name} does not converge on these meshes: no error is claimed for it.")
            }
            _ => writeln!(out, "The deck as it is: {name} is wrong by {error}."),
        };
        if verdict.scatter > CHAOS {
            let _ = writeln!(out, "{name} is chaotic: round-off alone changes it by {}.", percent(verdict.scatter));
        }
    }
    if let Some((knob, part)) = judgement.largest_part(rows).filter(|(_, part)| known && *part > 0.0) {
        let _ = match knob {
            Knob::RoundOff => writeln!(out, "No knob matters more than round-off."),
            _ => writeln!(
                out,
                "Most of it comes from the {}, which changes a quantity by {}.",
                knob.name(),
                percent(part)
            ),
        };
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::{Measured, Variant};
    use super::*;

    /// A row on a mesh so many times finer, with these values of the quantities.
    fn row(refine: u32, values: &[f64]) -> Row {
        let knob = if refine == 1 { Knob::None } else { Knob::Mesh };
        let name = format!("mesh-{refine}");
        let variant = Variant { name, knob, words: "a mesh".into(), change: Default::default(), refine, work: 1.0 };
        let [seconds, steps] = [f64::from(refine), 10.0 * f64::from(refine)];
        let (steps, values) = (steps as u64, values.to_vec());
        Row { variant, outcome: Ok(Measured { seconds, wall: seconds, steps, time: 1.0, memory: None, values }) }
    }

    /// What grows with each mesh does not converge. Nothing is claimed of it, neither in the table nor in words; of what converges beside it,
    /// the error is.
    #[test]
    fn no_error_is_claimed_where_nothing_converges() {
        let quantities = ["last A", "last B"].map(|name| name["last ".len()..].parse().expect("a quantity"));
        let all = [row(1, &[1.0, 1.5]), row(2, &[2.0, 1.25]), row(4, &[4.0, 1.125])];
        let one = all.clone().map(|row| Row {
            outcome: row.outcome.map(|measured| Measured { values: measured.values[..1].to_vec(), ..measured }),
            ..row
        });
        let judgement = Judgement::of(&quantities[..1], &one);
        assert!(judgement.errors.iter().all(|error| error.is_nan()) && judgement.front.is_empty());
        assert_eq!(judgement.cheapest(1e9, &one), None);
        let (told, table) = (words(&judgement, &one, 0.01), text(&judgement, &one));
        assert!(
            told.contains("No quantity converges") && !told.contains("within") && !told.contains("wrong by"),
            "{told}"
        );
        assert!(!table.contains("front") && table.lines().nth(1).is_some_and(|line| !line.contains('%')), "{table}");
        assert!(table.contains("-      0 %  > 50 %  DOES NOT CONVERGE"), "{table}");
        let judgement = Judgement::of(&quantities, &all);
        let told = words(&judgement, &all, 0.2);
        assert!((judgement.errors[0] - 0.5).abs() < 1e-12 && judgement.cheapest(0.2, &all) == Some(2), "{told}");
        assert!(told.contains("The cheapest within 20 %, in what converges: mesh-4"), "{told}");
        assert!(told.contains("last A does not converge") && told.contains("last B is wrong by 50 %"), "{told}");
    }
}
