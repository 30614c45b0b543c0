//! What can go wrong with a mesh file or a results file, said for the person who must mend it.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::mesh::check::{Problem, Problems};

/// Why a mesh was refused: every problem found in the file, each with a hint.
///
/// Displayed as one `error:` paragraph per problem, ready for the terminal.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshError {
    /// The file as the user named it.
    pub path: PathBuf,
    /// The problems found, in the order of the file; at least one.
    pub problems: Problems,
}

impl MeshError {
    /// A refusal with one reason.
    pub(in crate::exodus) fn single(path: &Path, what: impl Into<String>, help: impl Into<String>) -> Self {
        let mut problems = Problems::default();
        problems.add(|| Problem::new(what, help));
        MeshError { path: path.to_owned(), problems }
    }
}

impl std::error::Error for MeshError {}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems.list().iter().enumerate() {
            let separator = if i == 0 { "" } else { "\n" };
            write!(f, "{separator}error: {}: {}", self.path.display(), problem.what)?;
            if !problem.help.is_empty() {
                write!(f, "\n  help: {}", problem.help)?;
            }
        }
        match self.problems.unlisted() {
            0 => Ok(()),
            n => write!(f, "\nerror: {}: {n} more problems are not shown", self.path.display()),
        }
    }
}

/// Why a results file could not be written, read or compared.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// The operating system refused.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// What was tried: "read", "write", …
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The netCDF library refused.
    #[error("cannot {action} {}: {source}", path.display())]
    Netcdf {
        /// What was tried: "read time_whole from", …
        action: String,
        /// The file.
        path: PathBuf,
        /// The library's reason.
        source: netcdf::Error,
    },
    /// The mesh inside the file is not usable; see [`MeshError`].
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The file is not what it should be.
    #[error("{}: {what}", path.display())]
    Unusable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        what: String,
    },
    /// A variable was asked for that the file does not hold.
    #[error("{}: there is no {kind} variable {name}; the file has: {}", path.display(), known.join(", "))]
    NoVariable {
        /// The file.
        path: PathBuf,
        /// "global", "nodal" or "element".
        kind: &'static str,
        /// The name asked for.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// A state was asked for that the file does not hold.
    #[error("{}: there is no state {}; the file has {count} states", path.display(), state + 1)]
    NoState {
        /// The file.
        path: PathBuf,
        /// Zero-based state asked for.
        state: usize,
        /// Number of states there are.
        count: usize,
    },
    /// Arrays handed to the writer do not fit the header it was created with.
    #[error("{}: {what} has {got} values where {expected} belong", path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// Which array.
        what: String,
        /// Its length.
        got: usize,
        /// The length it should have.
        expected: usize,
    },
    /// Two files hold different meshes, so that their values cannot be set against each other.
    #[error("cannot compare {} and {}: {reason}", a.display(), b.display())]
    DifferentMeshes {
        /// The first file.
        a: PathBuf,
        /// The second file.
        b: PathBuf,
        /// What differs.
        reason: String,
    },
}

impl ResultsError {
    /// Whether a file could not be written; otherwise one could not be read or is wrong.
    pub fn is_of_writing(&self) -> bool {
        match self {
            ResultsError::Io { action, .. } => *action != "read",
            ResultsError::Netcdf { action, .. } => action.starts_with("write"),
            _ => false,
        }
    }

    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        move |source| ResultsError::Io { action, path: path.to_owned(), source }
    }

    pub(in crate::exodus) fn netcdf(action: impl Into<String>, path: &Path) -> impl FnOnce(netcdf::Error) -> Self {
        move |source| ResultsError::Netcdf { action: action.into(), path: path.to_owned(), source }
    }
}
