//! Words to the user. Nothing fails when nobody reads: `urto explain | head -1` closes the pipe early.

use std::fmt::Display;
use std::io::Write;

/// A line on the standard output.
pub fn say(text: impl Display) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// A line on the standard error.
pub fn complain(text: impl Display) {
    let _ = writeln!(std::io::stderr(), "{text}");
}
