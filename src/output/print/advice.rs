//! What the scene did not need, and what it lacked, at the end of the log and on the terminal.

use super::heading;
use crate::common::numbers::scientific;
use crate::output::print::TimeTable;
use crate::solver::Section;
use crate::studies::advice::{Advice, Promise};
use std::fmt::Write;

/// Part of the time of a section below which nothing is said of it.
const WORTH_WORDS: f64 = 0.01;
/// Part of the time above which output is much, and seconds below which it is none the less too little for advice.
const MUCH_OUTPUT: f64 = 1.0 / 3.0;
const LITTLE_OUTPUT: f64 = 0.5;

/// The part of a run's time that advice is about; `None` where it is about no section.
pub fn share(advice: &Advice, table: &TimeTable) -> Option<f64> {
    let (section, part) = advice.cost?;
    Some(part * of_section(section, table))
}

fn of_section(section: Section, table: &TimeTable) -> f64 {
    let name = Section::ALL.iter().find(|(known, _)| *known == section).map_or("", |(_, name)| name);
    let seconds = table.sections.iter().find(|balance| balance.name == name).map_or(0.0, |balance| balance.spread.mean);
    if table.wall > 0.0 { seconds / table.wall } else { 0.0 }
}

/// The parts of the log with all advice; nothing where there is none.
pub(super) fn advice(list: &[Advice], table: &TimeTable) -> String {
    let mut out = String::new();
    for (lacked, title) in [(false, "WHAT THE SCENE DID NOT NEED"), (true, "WHAT THE SCENE LACKED")] {
        let own: Vec<&Advice> = list.iter().filter(|advice| advice.lacked == lacked).collect();
        if own.is_empty() {
            continue;
        }
        out += &heading(title);
        for advice in own {
            let _ = writeln!(out, "  {}", sentence(advice));
            if let Some(share) = share(advice, table).filter(|share| *share >= WORTH_WORDS) {
                let _ = writeln!(out, "    {:.0} % of the time went there", 100.0 * share);
            }
        }
    }
    out
}

/// Advice in a line: what was seen, the command, and what it keeps.
pub fn sentence(advice: &Advice) -> String {
    let kept = if advice.kept().is_empty() { String::new() } else { format!(" gives {}", advice.kept()) };
    format!("{}: {}{kept}", advice.words, advice.instead)
}

/// What to say of output that took much of the time, below the table of it.
pub(super) fn of_output(table: &TimeTable) -> String {
    let share = of_section(Section::Output, table);
    if share < MUCH_OUTPUT {
        return String::new();
    }
    format!(
        "\n              output took {:.0} % of the time: PLOT TIME and OUTPUT TIME say how often, PLOT NODAL and PLOT ELEMENT what\n",
        100.0 * share
    )
}

/// Advice on output that took much of a run's time, where that is time worth saving. It is of the clock, and so not in the part of
/// the log that is the same for all runs. `states` were written, one every `interval` where the deck asks for them.
pub fn output(table: &TimeTable, states: usize, interval: Option<f64>) -> Option<Advice> {
    let share = of_section(Section::Output, table);
    if share < MUCH_OUTPUT || share * table.wall < LITTLE_OUTPUT {
        return None;
    }
    let words = format!("output took {:.0} % of the time, with {states} plot states", 100.0 * share);
    let instead = match interval {
        Some(interval) => format!("every other state, PLOT TIME, {}, where it is left,", scientific(2.0 * interval, 3)),
        None => "a longer OUTPUT TIME or HISTORY TIME".to_string(),
    };
    Some(Advice {
        lacked: false,
        words,
        instead,
        promise: Promise::Bits,
        cost: Some((Section::Output, if interval.is_some() { 0.5 } else { 1.0 })),
    })
}
