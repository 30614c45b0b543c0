//! The table of a study: one row per number of ranks.

use super::{Case, Machine, Price, RankWork};
use crate::comm::Spread;
use std::fmt::Write;

/// A problem on a number of ranks, counted and priced. Messages, bytes and calls are those of a mean step.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Number of ranks.
    pub ranks: usize,
    /// Elements of the whole problem.
    pub total: u64,
    /// Elements of a rank.
    pub elements: Spread,
    /// Contact points of a rank.
    pub contact_points: Spread,
    /// Pairs of points and faces of a rank.
    pub candidates: Spread,
    /// Constraints times passes of a rank.
    pub corrections: Spread,
    /// Messages that a rank sends.
    pub messages: Spread,
    /// Bytes in them.
    pub bytes: Spread,
    /// Collective calls.
    pub collectives: f64,
    /// Bytes that a rank sends in them.
    pub collective_bytes: f64,
    /// Computing of contact on the busiest rank over that of the mean one; 1 where there is none.
    pub contact_imbalance: f64,
    /// Seconds of a step.
    pub price: Price,
    /// Efficiency relative to the first row: processor time per element there over that here.
    pub efficiency: f64,
}

impl Row {
    /// How many times faster than one rank an element is computed, when the first row is taken as fully efficient.
    pub fn speed_up(&self) -> f64 {
        self.efficiency * self.ranks as f64
    }

    /// Processor seconds per element.
    fn processor_time(&self) -> f64 {
        self.price.total() * self.ranks as f64 / self.total as f64
    }

    fn new(case: &Case, machine: &Machine) -> Row {
        let spread = |of: &dyn Fn(&RankWork) -> u64| Spread::of(case.work.iter().map(of));
        let in_a_step = |of: &dyn Fn(&RankWork) -> u64| spread(of).over(case.steps.max(1) as f64);
        Row {
            ranks: case.work.len(),
            total: case.work.iter().map(|rank| rank.elements).sum(),
            elements: spread(&|rank| rank.elements),
            contact_points: in_a_step(&|rank| rank.contact_points),
            candidates: in_a_step(&|rank| rank.candidates),
            corrections: in_a_step(&|rank| rank.corrections),
            messages: in_a_step(&|rank| rank.of_steps().sent.messages),
            bytes: in_a_step(&|rank| rank.of_steps().sent.bytes),
            collectives: in_a_step(&|rank| rank.of_steps().collectives).most,
            collective_bytes: in_a_step(&|rank| rank.of_steps().collective_bytes).most,
            contact_imbalance: contact_imbalance(case, machine),
            price: machine.price(case),
            efficiency: 1.0,
        }
    }
}

fn contact_imbalance(case: &Case, machine: &Machine) -> f64 {
    let work = || case.work.iter().map(|rank| machine.contact_work(rank));
    let (most, sum) = (work().fold(0.0, f64::max), work().sum::<f64>());
    if sum > 0.0 { most * case.work.len() as f64 / sum } else { 1.0 }
}

/// The rows of a study.
pub fn rows(cases: &[Case], machine: &Machine) -> Vec<Row> {
    let mut rows: Vec<Row> = cases.iter().map(|case| Row::new(case, machine)).collect();
    let first = rows.first().map_or(1.0, Row::processor_time);
    rows.iter_mut().for_each(|row| row.efficiency = first / row.processor_time());
    rows
}

/// The table for people, with what was assumed of the machine above it.
pub fn text(rows: &[Row], machine: &Machine) -> String {
    let mut out = assumed(machine);
    let _ = writeln!(
        out,
        "\n{:>6}{:>10} |{:>9}{:>9}{:>9} |{:>9}{:>9}{:>9} |{:>8}{:>7}{:>11}{:>7} |{:>12}{:>7}{:>9}{:>8}",
        "",
        "",
        "elements",
        "of a",
        "rank",
        "contact",
        "pairs",
        "passes x",
        "messages",
        "",
        "bytes",
        "calls",
        "us",
        "talk",
        "speed-",
        "effi-"
    );
    let _ = writeln!(
        out,
        "{:>6}{:>10} |{:>9}{:>9}{:>9} |{:>9}{:>9}{:>9} |{:>8}{:>7}{:>11}{:>7} |{:>12}{:>7}{:>9}{:>8}",
        "ranks",
        "elements",
        "least",
        "mean",
        "most",
        "nodes",
        "",
        "constr.",
        "mean",
        "most",
        "most",
        "",
        "a step",
        "%",
        "up",
        "ciency"
    );
    for row in rows {
        let price = row.price;
        let talk = 100.0 * (1.0 - price.computing / price.total());
        let _ = writeln!(
            out,
            "{:>6}{:>10} |{:>9.0}{:>9.1}{:>9.0} |{:>9.0}{:>9.0}{:>9.0} |{:>8.2}{:>7.1}{:>11.0}{:>7.2} |{:>12.1}{:>7.1}{:>9.2}{:>8.3}",
            row.ranks,
            row.total,
            row.elements.least,
            row.elements.mean,
            row.elements.most,
            row.contact_points.most,
            row.candidates.most,
            row.corrections.most,
            row.messages.mean,
            row.messages.most,
            row.bytes.most,
            row.collectives,
            1e6 * price.total(),
            talk,
            row.speed_up(),
            row.efficiency
        );
    }
    out
}

fn assumed(machine: &Machine) -> String {
    let [element, point, candidate, correction] =
        [machine.element, machine.contact_point, machine.candidate, machine.correction].map(|s| 1e9 * s);
    format!(
        "machine {}: element {element:.0} ns, contact node {point:.1} ns, pair {candidate:.1} ns, constraint in a pass \
         {correction:.1} ns,\nlatency {:.2} us, bandwidth of a rank {:.1} MB/s, and {:.1} MB/s among the {} ranks of a node\n",
        machine.name,
        1e6 * machine.latency,
        1e-6 * machine.bandwidth,
        1e-6 * machine.node_bandwidth,
        machine.ranks_of_node
    )
}

/// The table for programs: comma-separated, with a line of names. Seconds and bytes.
pub fn csv(rows: &[Row]) -> String {
    let names = ["elements", "contact_points", "candidates", "corrections", "messages", "bytes"];
    let spread_names = names.map(|name| format!("{name}_min,{name}_mean,{name}_max")).join(",");
    let mut out = format!(
        "ranks,total_elements,{spread_names},collectives,collective_bytes,contact_imbalance,seconds_elements,seconds_agreement,seconds_contact,\
         seconds_computing,seconds_step,speed_up,efficiency\n"
    );
    for row in rows {
        let spreads = [row.elements, row.contact_points, row.candidates, row.corrections, row.messages, row.bytes];
        let spreads = spreads.map(|spread| format!("{},{},{}", spread.least, spread.mean, spread.most)).join(",");
        let Price { elements, agreement, contact, computing } = row.price;
        let _ = writeln!(
            out,
            "{},{},{spreads},{},{},{},{elements:e},{agreement:e},{contact:e},{computing:e},{:e},{},{}",
            row.ranks,
            row.total,
            row.collectives,
            row.collective_bytes,
            row.contact_imbalance,
            row.price.total(),
            row.speed_up(),
            row.efficiency
        );
    }
    out
}
