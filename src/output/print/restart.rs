//! What the log says of restarts.

use super::scientific;
use crate::solver::Solver;

/// Where a run goes on, told in words.
pub fn continued(words: &str) -> String {
    format!("\n     RESTART FILE {words}\n")
}

/// That a state was written.
pub fn restart_written(solver: &Solver) -> String {
    format!("     RESTART FILE WRITTEN AT TIME {}, STEP {}\n", scientific(solver.time, 6), solver.step)
}
