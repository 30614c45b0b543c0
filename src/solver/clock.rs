//! Where the time goes: wall-clock time by section of the step.

use std::time::{Duration, Instant};

/// Sections of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Section {
    /// Element forces.
    Elements,
    /// Loads.
    Assembly,
    /// Waiting for and talking to other ranks.
    Communication,
    /// Rigid surfaces and contact.
    Contact,
    /// Elements that are taken away.
    Erosion,
    /// Constraints, work and the update of nodes.
    Integration,
    /// Sums, logs and files.
    Output,
}

impl Section {
    /// All sections with their names in the closing table.
    pub const ALL: [(Section, &'static str); 7] = [
        (Section::Elements, "ELEMENTS"),
        (Section::Assembly, "ASSEMBLY AND LOADS"),
        (Section::Communication, "COMMUNICATION"),
        (Section::Contact, "CONTACT"),
        (Section::Erosion, "EROSION"),
        (Section::Integration, "INTEGRATION"),
        (Section::Output, "OUTPUT"),
    ];
}

/// A stopwatch with one account per section.
#[derive(Debug, Clone, Default)]
pub struct Clock {
    spent: [Duration; 7],
    since: Option<Instant>,
}

impl Clock {
    /// Starts measuring.
    pub fn start(&mut self) {
        self.since = Some(Instant::now());
    }

    /// Books the time since the last `start` or `stop` and goes on measuring.
    pub fn stop(&mut self, section: Section) {
        let now = Instant::now();
        if let Some(since) = self.since.replace(now) {
            self.spent[section as usize] += now - since;
        }
    }

    /// Time booked on a section.
    pub fn spent(&self, section: Section) -> Duration {
        self.spent[section as usize]
    }
}
