//! Why there is no report.

use crate::exodus::ResultsError;
use std::path::PathBuf;

/// Why a report could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The results cannot be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// The results hold no states.
    #[error("{}: the file has no states yet", .0.display())]
    NoStates(PathBuf),
    /// The page cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The page.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
}
