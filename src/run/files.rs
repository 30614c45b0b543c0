//! Names of a run's files: PRONTO's suffixes on one base name.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The files of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Files {
    /// Print log, `.o`.
    pub print: PathBuf,
    /// Plot states, `.e`.
    pub plot: PathBuf,
    /// Histories of material points, `.h`.
    pub history: PathBuf,
    /// Its appearance asks the run to stop, `.shutdown`.
    pub shutdown: PathBuf,
}

/// `base` with a suffix appended; what looks like a suffix of `base` stays.
fn with_suffix(base: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(base);
    name.push(suffix);
    PathBuf::from(name)
}

impl Files {
    /// All files of a base name.
    pub fn of(base: &Path) -> Files {
        Files {
            print: with_suffix(base, ".o"),
            plot: with_suffix(base, ".e"),
            history: with_suffix(base, ".h"),
            shutdown: with_suffix(base, ".shutdown"),
        }
    }
}

/// Keeps an old print file: `run.o` becomes `run.o.1`, or the next free number.
///
/// # Errors
/// When it cannot be renamed.
pub fn keep_old_print_files(print: &Path) -> std::io::Result<()> {
    if !print.exists() {
        return Ok(());
    }
    let free = (1..).map(|n| with_suffix(print, &format!(".{n}"))).find(|path| !path.exists());
    free.map_or(Ok(()), |path| std::fs::rename(print, path))
}
