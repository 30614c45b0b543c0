//! One line per OUTPUT TIME.

use super::scientific;
use crate::solver::{ElementPlace, Totals};

/// What a line shows.
pub struct StepLine<'a> {
    /// Steps taken.
    pub step: u64,
    /// Time.
    pub time: f64,
    /// Time step.
    pub time_step: f64,
    /// Energies and momenta.
    pub totals: &'a Totals,
    /// Kinetic energy at the start.
    pub initial_energy: f64,
    /// Element that controls the time step.
    pub controlling: ElementPlace,
    /// Seconds per element and cycle since the last line.
    pub grind: f64,
    /// Seconds of wall clock per unit of problem time since the last line.
    pub dilatation: f64,
    /// Seconds to the termination time at that rate.
    pub to_go: f64,
}

/// Two-line heads and widths of the columns: PRONTO's five first, those that time the machine among them and last.
const COLUMNS: [(&str, &str, usize); 17] = [
    ("TIME STEP", "NUMBER", 13),
    ("CURRENT", "TIME", 13),
    ("KINETIC", "ENERGY", 13),
    ("SECONDS PER", "ELEMENT CYCLE", 15),
    ("TIME DILATATION", "FACTOR", 17),
    ("TIME", "STEP", 13),
    ("SET BY", "ELEMENT", 11),
    ("OF", "BLOCK", 7),
    ("INTERNAL", "ENERGY", 13),
    ("HOURGLASS", "ENERGY", 13),
    ("BULK VISC.", "ENERGY", 13),
    ("FRICTION", "ENERGY", 13),
    ("EXTERNAL", "WORK", 13),
    ("CONTACT", "WORK", 13),
    ("ERODED", "ENERGY", 13),
    ("ENERGY", "ERROR", 11),
    ("SECONDS", "TO GO", 10),
];

/// Column heads.
pub fn step_header() -> String {
    let [mut upper, mut lower] = [String::from("\n"), String::new()];
    for (first, second, width) in COLUMNS {
        upper += &format!("{first:>width$}");
        lower += &format!("{second:>width$}");
    }
    format!("{upper}\n{lower}\n")
}

/// One line.
pub fn step_line(line: &StepLine) -> String {
    let t = line.totals;
    let energy = |value: f64| scientific(value, 4);
    let cells = [
        line.step.to_string(),
        energy(line.time),
        energy(t.kinetic),
        scientific(line.grind, 3),
        scientific(line.dilatation, 3),
        energy(line.time_step),
        line.controlling.element.to_string(),
        line.controlling.block.to_string(),
        energy(t.internal),
        energy(t.hourglass),
        energy(t.bulk_viscosity),
        energy(t.friction),
        energy(t.external),
        energy(t.contact),
        energy(t.eroded),
        scientific(t.relative_error(line.initial_energy), 2),
        scientific(line.to_go, 1),
    ];
    let cells = cells.iter().zip(COLUMNS).map(|(cell, (.., width))| format!("{cell:>width$}"));
    cells.collect::<String>() + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_stand_under_their_heads() {
        let totals = Totals { kinetic: -1.0e-300, ..Totals::default() };
        let controlling = ElementPlace { element: 123_456_789, block: 99_999, centre: [0.0; 3], volume: 1.0 };
        let line = step_line(&StepLine {
            step: 12_345_678,
            time: 1e-6,
            time_step: 1e-9,
            totals: &totals,
            initial_energy: 1.0,
            controlling,
            grind: 1e-8,
            dilatation: 1e5,
            to_go: 60.0,
        });
        let head = step_header();
        let ends = |text: &str| text.lines().next_back().map(|last| last.len());
        assert_eq!(ends(&head), ends(&line));
        assert_eq!(line.split_whitespace().count(), COLUMNS.len());
    }
}
