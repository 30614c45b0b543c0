//! What a look at the run has found: numbers, places, and when. Words are made from these, so that they survive a restart.

use super::symptoms::{SYMPTOMS, Symptom, hourglass, imbalance};
use crate::solver::Solver;

/// Places that a finding names at most.
pub const SPOTS: usize = 3;

/// Columns of a finding in a restart file.
pub const ROW: usize = 9 + 5 * SPOTS;

/// Stands for a number that there is not.
const NO_NUMBER: f64 = -1.0;

/// A place, with the numbers that the analyst's mesh gives to what is there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spot {
    /// The node.
    pub node: Option<i64>,
    /// The element, or the element whose face the node meets.
    pub element: Option<i64>,
    /// Where it is now, lengths.
    pub at: [f64; 3],
}

/// What was measured.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Evidence {
    /// What is held against the threshold.
    pub share: f64,
    /// The energy or the length behind it.
    pub amount: f64,
    /// How many there are.
    pub count: u64,
    /// Of how many, or of how much.
    pub of: f64,
    /// Number of the element block, 0 where it is the whole body.
    pub block: i64,
    /// Where it is worst.
    pub spots: [Option<Spot>; SPOTS],
}

/// Evidence that has passed the threshold of a symptom for the first time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finding {
    /// Code of the symptom.
    pub(super) code: u32,
    /// Steps taken when it was seen.
    pub step: u64,
    /// Time of the state.
    pub time: f64,
    /// What was seen.
    pub evidence: Evidence,
    /// The largest share seen so far.
    pub worst: f64,
}

impl Finding {
    /// What a symptom shows now.
    pub(super) fn new(symptom: &Symptom, solver: &Solver, evidence: Evidence) -> Finding {
        Finding { code: symptom.code, step: solver.step, time: solver.time, evidence, worst: evidence.share }
    }

    /// Whether a list does not have it yet; what it has learns how far it has gone.
    pub(super) fn is_news_in(&self, list: &mut [Finding]) -> bool {
        let same = |known: &&mut Finding| known.code == self.code && known.evidence.block == self.evidence.block;
        let known = list.iter_mut().find(same);
        known.map(|known| known.worst = known.worst.max(self.worst)).is_none()
    }

    fn symptom(&self) -> &'static Symptom {
        SYMPTOMS.iter().find(|symptom| symptom.code == self.code).unwrap_or(&SYMPTOMS[0])
    }

    /// The number of the block whose hourglass energy this is about, and the largest part of its internal energy that it was.
    pub fn of_hourglass(&self) -> Option<(i64, f64)> {
        (self.code == hourglass::SYMPTOM.code).then_some((self.evidence.block, self.worst))
    }

    /// In a few words, for a list of warnings.
    pub fn label(&self) -> String {
        (self.symptom().label)(&self.evidence)
    }

    /// With number and place, as it was when it was seen.
    pub fn words(&self) -> String {
        (self.symptom().words)(&self.evidence)
    }

    /// What the analyst can try.
    pub fn advice(&self) -> &'static str {
        if self.code == imbalance::SYMPTOM.code {
            return imbalance::advice(&self.evidence);
        }
        self.symptom().advice
    }

    /// As a row of numbers.
    pub(super) fn row(&self) -> [f64; ROW] {
        let Finding { code, step, time, evidence, worst } = self;
        let Evidence { share, amount, count, of, block, spots } = evidence;
        let mut row = [NO_NUMBER; ROW];
        let first = [f64::from(*code), *block as f64, *step as f64, *time, *share, *amount, *count as f64, *of, *worst];
        row[..9].copy_from_slice(&first);
        for (cells, spot) in row[9..].chunks_exact_mut(5).zip(spots) {
            let Some(Spot { node, element, at: [x, y, z] }) = *spot else { continue };
            let number = |number: Option<i64>| number.map_or(NO_NUMBER, |number| number as f64);
            cells.copy_from_slice(&[number(node), number(element), x, y, z]);
        }
        row
    }

    /// A finding from its row; `None` for a symptom that is not known.
    pub(super) fn from_row(row: &[f64]) -> Option<Finding> {
        let [code, block, step, time, share, amount, count, of, worst] = *row.first_chunk::<9>()?;
        let number = |cell: f64| (cell != NO_NUMBER).then_some(cell as i64);
        let mut spots = [None; SPOTS];
        for (spot, cells) in spots.iter_mut().zip(row[9..].chunks_exact(5)) {
            let (node, element) = (number(cells[0]), number(cells[1]));
            if node.is_some() || element.is_some() {
                *spot = Some(Spot { node, element, at: [cells[2], cells[3], cells[4]] });
            }
        }
        let evidence = Evidence { share, amount, count: count as u64, of, block: block as i64, spots };
        let known = SYMPTOMS.iter().find(|symptom| f64::from(symptom.code) == code)?;
        Some(Finding { code: known.code, step: step as u64, time, evidence, worst })
    }
}

impl std::fmt::Display for Spot {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let [x, y, z] = self.at;
        let place = format!("at ({x:.4e}, {y:.4e}, {z:.4e})");
        match (self.node, self.element) {
            (Some(node), Some(element)) => write!(f, "node {node} on element {element} {place}"),
            (Some(node), None) => write!(f, "node {node} {place}"),
            (None, Some(element)) => write!(f, "element {element} {place}"),
            (None, None) => write!(f, "{place}"),
        }
    }
}

impl Evidence {
    /// The places in words.
    pub fn places(&self) -> String {
        let known: Vec<String> = self.spots.iter().flatten().map(Spot::to_string).collect();
        if known.is_empty() { "an unknown place".to_string() } else { known.join(", ") }
    }
}

/// A share in words: in per cent, or as a multiple when it is large.
pub fn percent(share: f64) -> String {
    match 100.0 * share {
        percent if percent < 10.0 => format!("{percent:.1} %"),
        percent if percent < 1000.0 => format!("{percent:.0} %"),
        _ if share < 1e4 => format!("{share:.0} times"),
        _ => format!("{share:.1e} times"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_survives_a_restart_file() {
        let spots = [
            Some(Spot { node: Some(17), element: None, at: [1.0, -1.0, 0.5] }),
            Some(Spot { node: Some(0), element: Some(4), at: [0.0; 3] }),
            None,
        ];
        let evidence = Evidence { share: 0.25, amount: -3.0, count: 12, of: 48.0, block: 7, spots };
        for symptom in &SYMPTOMS {
            let finding = Finding { code: symptom.code, step: 99, time: 1e-6, evidence, worst: 0.5 };
            assert_eq!(Finding::from_row(&finding.row()), Some(finding));
        }
        assert_eq!(Finding::from_row(&[0.0; ROW]), None, "0 is no code");
        assert_eq!(Finding::from_row(&[]), None);
    }

    #[test]
    fn shares_are_told_in_per_cent() {
        assert_eq!([0.0123, 0.31, 6.76].map(percent), ["1.2 %", "31 %", "676 %"]);
        assert_eq!([676.4, 3.56e26].map(percent), ["676 times", "3.6e26 times"]);
    }
}
