//! What a run tells the person who watches.

use crate::output::print::StepLine;
use crate::solver::Finding;

/// Somebody to show progress to; rank 0 has one.
pub trait Display {
    /// A line of the print log has been written.
    fn line(&mut self, line: &StepLine);
    /// The run has found out something about itself that a person must know.
    fn warning(&mut self, finding: &Finding);
    /// A step has been prepared. Called at every step: cheap most of the time.
    fn progress(&mut self, step: u64, time: f64, time_step: f64);
    /// The last step is done.
    fn finish(&mut self);
}

/// Shows nothing.
pub struct Quiet;

impl Display for Quiet {
    fn line(&mut self, _: &StepLine) {}
    fn warning(&mut self, _: &Finding) {}
    fn progress(&mut self, _: u64, _: f64, _: f64) {}
    fn finish(&mut self) {}
}
