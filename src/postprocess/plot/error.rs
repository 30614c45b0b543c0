//! Why there is no plot.

use std::path::PathBuf;

use crate::exodus::ResultsError;
use crate::exodus::pieces::JoinError;

/// Why curves could not be read, worked on or drawn, said for the person who asked for them.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// A results file cannot be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// Pieces do not belong together.
    #[error(transparent)]
    Pieces(#[from] JoinError),
    /// The files hold no states.
    #[error("{}: the file has no states yet", .0.display())]
    NoStates(PathBuf),
    /// Nothing says what to plot, and the file has no energies.
    #[error("{}: say with -v what to plot; the file has: {}", path.display(), known.join(", "))]
    Unsaid {
        /// The file.
        path: PathBuf,
        /// Names there are.
        known: Vec<String>,
    },
    /// There is no such variable.
    #[error("{}: there is no variable {name}{hint}", path.display())]
    NoVariable {
        /// The file.
        path: PathBuf,
        /// The name asked for.
        name: String,
        /// What there is in its place.
        hint: String,
    },
    /// There is no such node or element.
    #[error("{}: there is no {kind} {id}", path.display())]
    NoPlace {
        /// The file.
        path: PathBuf,
        /// "node" or "element".
        kind: &'static str,
        /// The number asked for.
        id: i64,
    },
    /// A file of numbers is not one.
    #[error("{}{}: {what}", path.display(), line.map_or(String::new(), |line| format!(", line {line}")))]
    Numbers {
        /// The file.
        path: PathBuf,
        /// The line, from one.
        line: Option<usize>,
        /// What is wrong.
        what: String,
    },
    /// A curve cannot be filtered or differentiated.
    #[error("{curve}: {what}")]
    Work {
        /// The curve.
        curve: String,
        /// Why.
        what: String,
    },
    /// An option cannot be used.
    #[error("{option} is {got}; expected {expected}")]
    Option {
        /// Which option.
        option: &'static str,
        /// What was given.
        got: String,
        /// What would do.
        expected: &'static str,
    },
    /// Nothing is left to be drawn.
    #[error("there is nothing to draw: {0}")]
    Nothing(&'static str),
    /// The picture cannot be drawn.
    #[error("cannot draw {}: {reason}", path.display())]
    Draw {
        /// The picture.
        path: PathBuf,
        /// What the library says.
        reason: String,
    },
    /// The picture cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The picture.
        path: PathBuf,
        /// What the system says.
        reason: String,
    },
}

impl PlotError {
    pub(super) fn option(option: &'static str, got: impl Into<String>, expected: &'static str) -> Self {
        PlotError::Option { option, got: got.into(), expected }
    }
}
