//! The end of the print log.

use super::{heading, leader, number, scientific};
use crate::comm::Spread;
use crate::solver::contact::Report;
use crate::solver::{Finding, Totals};
use crate::studies::advice::Advice;
use std::fmt::Write;

/// Where the time of a run went, and over how many ranks.
pub struct TimeTable {
    /// Seconds of each section of the step.
    pub sections: Vec<Balance>,
    /// Work and messages of a step.
    pub balance: Vec<Balance>,
    /// Wall-clock seconds of the whole step loop.
    pub wall: f64,
    /// Number of ranks.
    pub ranks: usize,
    /// Elements times steps.
    pub element_cycles: f64,
    /// Most memory held by this process, in bytes, where the system tells.
    pub memory: Option<f64>,
}

/// How a quantity is spread over the ranks.
pub struct Balance {
    /// What it is.
    pub name: String,
    /// Over the ranks.
    pub spread: Spread,
}

impl TimeTable {
    /// Wall-clock seconds per element and cycle.
    pub fn grind(&self) -> f64 {
        if self.element_cycles > 0.0 { self.wall / self.element_cycles } else { 0.0 }
    }
}

/// How a run ended.
pub struct Ending<'a> {
    /// In words.
    pub outcome: &'a str,
    /// Steps taken.
    pub steps: u64,
    /// Plot states written.
    pub states: usize,
    /// Energies and momenta at the end.
    pub totals: &'a Totals,
    /// Kinetic energy at the start.
    pub initial_energy: f64,
    /// Internal energy that equations of state held at the start.
    pub stored_energy: f64,
    /// What the run has found out about itself.
    pub findings: &'a [Finding],
    /// Contact, where there was any.
    pub contact: Option<Report>,
    /// Elements that were taken away, where that was asked for.
    pub gone: Option<u64>,
    /// What the scene did not need, and what it lacked.
    pub advice: &'a [Advice],
}

/// The closing part: the energies, where the time went, and how the run ended.
pub fn closing(table: &TimeTable, ending: &Ending) -> String {
    let mut out = balance(ending);
    out += &ending.contact.as_ref().map_or(String::new(), |report| contact(report, ending.steps));
    out += &ending.gone.map_or(String::new(), |gone| leader("ELEMENTS TAKEN AWAY", &gone.to_string()));
    out += &super::warnings::table(ending.findings);
    out += &super::advice::advice(ending.advice, table);
    out += &sections(table);
    out += &super::advice::of_output(table);
    out += &balance_of_ranks(table);
    out += "\n";
    out += &leader("NUMBER OF RANKS", &table.ranks.to_string());
    out += &leader("TIME STEPS TAKEN", &ending.steps.to_string());
    out += &leader("PLOT STATES WRITTEN", &ending.states.to_string());
    out += &leader("SECONDS PER ELEMENT CYCLE (GRIND TIME)", &scientific(table.grind(), 3));
    if table.wall > 0.0 {
        out += &leader("ELEMENT CYCLES PER SECOND", &number(table.element_cycles / table.wall));
    }
    if let Some(bytes) = table.memory {
        out += &leader("LARGEST MEMORY OF THIS PROCESS, MB", &format!("{:.1}", bytes / 1e6));
    }
    out += &heading("END OF SOLUTION PHASE");
    let _ = writeln!(out, "  {}", ending.outcome);
    out
}

/// What was supplied, and where it is.
fn balance(ending: &Ending) -> String {
    let t = ending.totals;
    let mut out = heading("ENERGY BALANCE AT THE END");
    out += &leader("INITIAL KINETIC ENERGY", &number(ending.initial_energy));
    out += &leader("WORK OF LOADS AND PRESCRIBED MOTIONS", &number(t.external));
    out += &leader("WORK OF NORMAL CONTACT FORCES", &number(t.contact));
    if t.press_fit != 0.0 {
        out += &leader("OF THESE THE WORK OF PRESS FITS", &number(t.press_fit));
    }
    out += &leader("ENERGY MADE BY CONTACT", &number(t.contact_gain));
    out += &leader("KINETIC ENERGY", &number(t.kinetic));
    out += &leader("INTERNAL ENERGY", &number(t.internal));
    if ending.stored_energy != 0.0 {
        out += &leader("INITIAL ENERGY OF MATERIALS, NOT IN IT", &number(ending.stored_energy));
    }
    out += &leader("HOURGLASS ENERGY", &number(t.hourglass));
    out += &leader("DISSIPATED BY BULK VISCOSITY", &number(t.bulk_viscosity));
    out += &leader("DISSIPATED BY FRICTION", &number(t.friction));
    out += &leader("ENERGY OF ERODED ELEMENTS", &number(t.eroded));
    out += &leader("RELATIVE ERROR OF THE BALANCE", &number(t.relative_error(ending.initial_energy)));
    out
}

/// What contact had to do.
fn contact(report: &Report, steps: u64) -> String {
    let tally = &report.tally;
    let mut out = heading("CONTACT");
    out += &leader("CONTACT NODES", &report.points.to_string());
    out += &leader("CONTACT FACES", &report.faces.to_string());
    out += &leader("EDGES THAT MAY TOUCH EDGES", &report.edges.to_string());
    out += &leader("NODES NEAR FACES AT THE LAST SEARCH", &report.watched.to_string());
    out += &leader("PAIRS OF THEM", &report.pairs.to_string());
    let per = |count: u64, of: u64| if of > 0 { count as f64 / of as f64 } else { 0.0 };
    out += &leader("SEARCHES", &report.searches.to_string());
    if report.searches > 0 {
        out += &leader("STEPS THAT A SEARCH LASTED", &format!("{:.1}", per(steps, report.searches)));
    }
    out += &leader("STEPS WITH CONTACT FORCES", &tally.steps.to_string());
    out += &leader("PASSES IN SUCH A STEP", &format!("{:.2}", per(tally.iterations, tally.steps)));
    out += &leader("STEPS IN WHICH THE PASSES RAN OUT", &tally.capped.to_string());
    out += &leader("LARGEST OVERLAP LEFT, IN FACE SIZES", &number(tally.left.max(tally.held)));
    out
}

fn sections(table: &TimeTable) -> String {
    let mut out = heading("WHERE THE TIME WENT");
    let share = |seconds: f64| 100.0 * seconds / table.wall.max(1e-9);
    let _ = writeln!(
        out,
        "              {:<20}{:>12}{:>12}{:>12}{:>10}",
        "SECTION", "MIN s", "MEAN s", "MAX s", "% OF ALL"
    );
    for Balance { name, spread: Spread { least, mean, most } } in &table.sections {
        let percent = share(*mean);
        let _ = writeln!(out, "              {name:<20}{least:>12.3}{mean:>12.3}{most:>12.3}{percent:>10.1}");
    }
    let accounted: f64 = table.sections.iter().map(|section| section.spread.mean).sum();
    let rest = (table.wall - accounted).max(0.0);
    let _ = writeln!(out, "              {:<20}{:>12}{rest:>12.3}{:>12}{:>10.1}", "OTHER", "", "", share(rest));
    let _ = writeln!(out, "              {:<20}{:>12}{:>12.3}", "TOTAL", "", table.wall);
    out
}

/// How evenly the work is spread, and what ranks have to say to each other.
fn balance_of_ranks(table: &TimeTable) -> String {
    let mut out = heading("WHAT A RANK HAS TO DO IN A STEP");
    let _ = writeln!(out, "              {:<32}{:>14}{:>14}{:>14}", "OVER ALL RANKS", "MIN", "MEAN", "MAX");
    for Balance { name, spread: Spread { least, mean, most } } in &table.balance {
        let _ = writeln!(out, "              {name:<32}{least:>14.2}{mean:>14.2}{most:>14.2}");
    }
    out
}
