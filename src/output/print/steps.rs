//! One line per OUTPUT TIME.

use super::scientific;
use crate::model::StepColumns;
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

/// The two lines of a head, and the width of its column.
type Column = (&'static str, &'static str, usize);

/// PRONTO's five columns, those that time the machine among them; every log has them.
const PRONTO: [Column; 5] = [
    ("TIME STEP", "NUMBER", 13),
    ("CURRENT", "TIME", 13),
    ("KINETIC", "ENERGY", 13),
    ("SECONDS PER", "ELEMENT CYCLE", 15),
    ("TIME DILATATION", "FACTOR", 17),
];

/// The columns of what STEP LOG asks for.
fn columns(asked: StepColumns) -> &'static [Column] {
    match asked {
        StepColumns::Pronto => &[],
        StepColumns::TimeStep => &[("TIME", "STEP", 13), ("SET BY", "ELEMENT", 11), ("OF", "BLOCK", 7)],
        StepColumns::Energy => &[
            ("INTERNAL", "ENERGY", 13),
            ("HOURGLASS", "ENERGY", 13),
            ("BULK VISC.", "ENERGY", 13),
            ("FRICTION", "ENERGY", 13),
            ("EXTERNAL", "WORK", 13),
            ("CONTACT", "WORK", 13),
            ("ERODED", "ENERGY", 13),
            ("ENERGY", "ERROR", 11),
        ],
        StepColumns::EnergyError => &[("ENERGY", "ERROR", 11)],
        StepColumns::Momentum => &[("MOMENTUM", "IN X", 13), ("MOMENTUM", "IN Y", 13), ("MOMENTUM", "IN Z", 13)],
        StepColumns::ToGo => &[("SECONDS", "TO GO", 10)],
    }
}

/// What a line shows in these columns.
fn cells(asked: StepColumns, line: &StepLine) -> Vec<String> {
    let t = line.totals;
    let value = |value: f64| scientific(value, 4);
    match asked {
        StepColumns::Pronto => Vec::new(),
        StepColumns::TimeStep => {
            vec![value(line.time_step), line.controlling.element.to_string(), line.controlling.block.to_string()]
        }
        StepColumns::Energy => {
            let accounts =
                [t.internal, t.hourglass, t.bulk_viscosity, t.friction, t.external, t.contact, t.eroded].map(value);
            accounts.into_iter().chain([error(line)]).collect()
        }
        StepColumns::EnergyError => vec![error(line)],
        StepColumns::Momentum => t.momentum.map(value).into(),
        StepColumns::ToGo => vec![scientific(line.to_go, 1)],
    }
}

/// The error of the energy balance.
fn error(line: &StepLine) -> String {
    scientific(line.totals.relative_error(line.initial_energy), 2)
}

/// Column heads.
pub fn step_header(asked: &[StepColumns]) -> String {
    let [mut upper, mut lower] = [String::from("\n"), String::new()];
    for (first, second, width) in PRONTO.iter().chain(asked.iter().flat_map(|asked| columns(*asked))) {
        upper += &format!("{first:>width$}");
        lower += &format!("{second:>width$}");
    }
    format!("{upper}\n{lower}\n")
}

/// One line.
pub fn step_line(asked: &[StepColumns], line: &StepLine) -> String {
    let first = [
        line.step.to_string(),
        scientific(line.time, 4),
        scientific(line.totals.kinetic, 4),
        scientific(line.grind, 3),
        scientific(line.dilatation, 3),
    ];
    let cells = first.into_iter().chain(asked.iter().flat_map(|asked| cells(*asked, line)));
    let columns = PRONTO.iter().chain(asked.iter().flat_map(|asked| columns(*asked)));
    let cells = cells.zip(columns).map(|(cell, (.., width))| format!("{cell:>width$}"));
    cells.collect::<String>() + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_stand_under_their_heads() {
        let totals = Totals { kinetic: -1.0e-300, ..Totals::default() };
        let controlling = ElementPlace { element: 123_456_789, block: 99_999, centre: [0.0; 3], volume: 1.0 };
        let line = StepLine {
            step: 12_345_678,
            time: 1e-6,
            time_step: 1e-9,
            totals: &totals,
            initial_energy: 1.0,
            controlling,
            grind: 1e-8,
            dilatation: 1e5,
            to_go: 60.0,
        };
        let ends = |text: &str| text.lines().next_back().map(|last| last.len());
        let mut asked: Vec<Vec<StepColumns>> = StepColumns::ALL.iter().map(|one| vec![*one]).collect();
        asked.extend([StepColumns::ALL.to_vec(), StepColumns::USUAL.to_vec()]);
        for asked in asked {
            let (head, cells) = (step_header(&asked), step_line(&asked, &line));
            assert_eq!(ends(&head), ends(&cells), "{asked:?}");
            let columns = PRONTO.len() + asked.iter().map(|asked| columns(*asked).len()).sum::<usize>();
            assert_eq!(cells.split_whitespace().count(), columns, "{asked:?}");
            // What a log has without STEP LOG fits PRONTO's page.
            assert!(asked != StepColumns::USUAL || cells.trim_end().len() <= 132, "{cells}");
        }
    }
}
