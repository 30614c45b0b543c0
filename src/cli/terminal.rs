//! Words to the user. Nothing fails when nobody reads: `urto explain | head -1` closes the pipe early. Words that are lost
//! for another reason, such as a full disk behind the standard output, make the exit code say so.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};
use std::sync::OnceLock;

/// Why words to the standard output were lost, the first time that they were.
static LOST: OnceLock<String> = OnceLock::new();

/// A line on the standard output.
pub fn say(text: impl Display) {
    note(writeln!(io::stdout(), "{text}"));
}

/// Text on the standard output as it stands.
pub fn print(text: &str) {
    note(io::stdout().write_all(text.as_bytes()));
}

/// Why words to the standard output were lost, if any were that somebody waited for.
pub fn lost() -> Option<&'static str> {
    note(io::stdout().flush());
    LOST.get().map(String::as_str)
}

/// Keeps the reason of a failure, unless it is that the reader has left.
pub fn note(outcome: io::Result<()>) {
    if let Err(error) = outcome
        && error.kind() != ErrorKind::BrokenPipe
    {
        LOST.get_or_init(|| error.to_string());
    }
}

/// A line on the standard error.
pub fn complain(text: impl Display) {
    let _ = writeln!(std::io::stderr(), "{text}");
}
