//! The print log: what was asked, what is being modelled, one line per OUTPUT TIME, and where the time went; in
//! PRONTO's order, with PRONTO's columns first.

mod advice;
mod contact;
mod echo;
mod modelled;
mod restart;
mod steps;
mod summary;
mod warnings;

pub use crate::common::numbers::scientific;
pub use advice::{output as advice_on_output, sentence, share};
pub use modelled::{Feature, features};
pub use restart::{continued, restart_written};
pub use steps::{StepLine, step_header, step_line};
pub use summary::{Balance, Ending, TimeTable, closing};
pub use warnings::{labels, warning, warning_on_terminal, with_warnings};

use crate::common::files;
use crate::common::numbers::number;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

pub use echo::{Echo, problem};

/// A print file being written. Every block of text is handed to the system at once, so a killed run leaves it whole.
pub struct PrintLog {
    out: BufWriter<File>,
}

impl PrintLog {
    /// Starts a print file.
    ///
    /// # Errors
    /// When it cannot be created.
    pub fn create(path: &Path) -> io::Result<PrintLog> {
        Ok(PrintLog { out: BufWriter::new(File::create(path)?) })
    }

    /// Makes sure that the file still has its name.
    ///
    /// # Errors
    /// When it has been removed or replaced.
    pub fn in_place(&self, path: &Path) -> io::Result<()> {
        files::in_place(self.out.get_ref(), path)
    }

    /// Appends text.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&mut self, text: &str) -> io::Result<()> {
        self.out.write_all(text.as_bytes())?;
        self.out.flush()
    }
}

/// A heading with its letters spread out, as PRONTO prints them.
fn heading(text: &str) -> String {
    let words: Vec<String> =
        text.split(' ').map(|word| word.chars().map(String::from).collect::<Vec<_>>().join(" ")).collect();
    let line = words.join("   ");
    format!("\n\n{:>width$}\n\n", line, width = 40 + line.len() / 2)
}

/// A line with dot leaders.
fn leader(name: &str, value: &str) -> String {
    let dots = ".".repeat(42usize.saturating_sub(name.len()));
    format!("              {name} {dots} {value:>12}\n")
}
