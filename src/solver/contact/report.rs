//! What contact asks of this rank: for the log, and to price it on other machines.

use super::Contact;

/// Contact of one rank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Points that this rank knows the motion of: those it looks after, and the corners of faces that these may meet.
    pub points: u64,
    /// Pairs of these points and faces that the last search left to be checked in detail.
    pub candidates: u64,
    /// Constraints of the last step.
    pub constraints: u64,
    /// Passes over the constraints of each step, in all steps so far.
    pub passes: u64,
}

impl Contact {
    /// What contact has asked of this rank.
    pub fn work(&self) -> Work {
        let [_, candidates] = self.arena.locator.counts();
        Work {
            points: self.arena.cast.points.len() as u64,
            candidates: candidates as u64,
            constraints: self.arena.constraints.len() as u64,
            passes: self.tally.passes,
        }
    }
}
