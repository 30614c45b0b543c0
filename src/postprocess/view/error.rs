//! Why a picture could not be made.

use std::path::PathBuf;

use crate::exodus::{MeshError, ResultsError};

/// Why a picture could not be made, said for the person who asked for it.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// The results file cannot be read.
    #[error(transparent)]
    Results(#[from] ResultsError),
    /// The mesh in the file cannot be used.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The file holds a mesh only.
    #[error("{}: the file has no states yet\n  help: `urto view --state mesh` draws the mesh alone", path.display())]
    NoStates {
        /// The results file.
        path: PathBuf,
    },
    /// A state was asked for that the file does not hold.
    #[error("{}: there is no state {number}; the file has states 1 to {count}", path.display())]
    NoState {
        /// The results file.
        path: PathBuf,
        /// The state asked for, counted from 1.
        number: usize,
        /// Number of states there are.
        count: usize,
    },
    /// A variable was asked for that the file does not hold.
    #[error("{}: there is no variable {name}{}; the file has: {}", path.display(), hint(near), listed(known))]
    NoVariable {
        /// The results file.
        path: PathBuf,
        /// The name asked for.
        name: String,
        /// The name most like it, if one is.
        near: Option<String>,
        /// The names there are: vectors' stems, nodal and element variables.
        known: Vec<String>,
    },
    /// A block was asked for that the file does not hold.
    #[error("{}: there is no block {id}; the file has: {}", path.display(), listed(known))]
    NoBlock {
        /// The results file.
        path: PathBuf,
        /// The number asked for.
        id: i64,
        /// The numbers there are.
        known: Vec<String>,
    },
    /// Nothing is left to be seen.
    #[error("{}: there is nothing to draw: {reason}", path.display())]
    Nothing {
        /// The results file.
        path: PathBuf,
        /// Where everything went.
        reason: &'static str,
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
    /// The picture cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The picture.
        path: PathBuf,
        /// What the system or the encoder says.
        reason: String,
    },
}

impl ViewError {
    pub(super) fn option(option: &'static str, got: impl Into<String>, expected: &'static str) -> Self {
        ViewError::Option { option, got: got.into(), expected }
    }
}

fn hint(near: &Option<String>) -> String {
    near.as_ref().map(|name| format!(" (did you mean {name}?)")).unwrap_or_default()
}

fn listed(known: &[String]) -> String {
    if known.is_empty() { "none".to_owned() } else { known.join(", ") }
}
