//! What the log says of restarts.

use super::scientific;
use crate::solver::Solver;
use std::path::Path;

/// Where a run goes on.
pub fn continued(path: &Path, step: f64, time: f64) -> String {
    format!(
        "\n     RESTART FILE {} READ: THE RUN GOES ON AT STEP {step}, TIME {}\n",
        path.display(),
        scientific(time, 6)
    )
}

/// That a state was written.
pub fn restart_written(solver: &Solver) -> String {
    format!("     RESTART FILE WRITTEN AT TIME {}, STEP {}\n", scientific(solver.time, 6), solver.step)
}
