//! What is read is not written over: outputs are held against inputs before any file is opened for writing.

use super::Failure;
use crate::common::files::{Identity, identity};
use std::path::{Path, PathBuf};

/// Advice of verbs that write one file.
pub const ANOTHER_NAME: &str = "name another file with --output";

/// The files that a verb reads, each with what it is to the user.
#[derive(Debug, Default)]
pub struct Inputs(Vec<(&'static str, PathBuf, Identity)>);

impl Inputs {
    /// Adds files of one kind, such as "the deck".
    pub fn with<P: Into<PathBuf>>(mut self, what: &'static str, paths: impl IntoIterator<Item = P>) -> Inputs {
        let known = paths.into_iter().map(Into::into);
        self.0.extend(known.filter_map(|path: PathBuf| identity(&path).map(|identity| (what, path, identity))));
        self
    }

    /// Refuses outputs that are one of these files; `help` says how to name others.
    ///
    /// # Errors
    /// With the output, the input and the advice.
    pub fn spare<P: AsRef<Path>>(&self, outputs: impl IntoIterator<Item = P>, help: &str) -> Result<(), Failure> {
        for output in outputs {
            let output = output.as_ref();
            let Some(there) = identity(output) else { continue };
            if let Some((what, input, _)) = self.0.iter().find(|(_, _, identity)| *identity == there) {
                let name = if input == output { String::new() } else { format!(" {}", input.display()) };
                return Err(Failure::input(format_args!(
                    "error: {} is {what}{name}, and would be written over\nhelp: {help}",
                    output.display()
                )));
            }
        }
        Ok(())
    }
}

/// Whether a file can be made in a folder, tried by making one; an empty name is the present folder.
///
/// # Errors
/// With the folder and the system's reason.
pub fn writable(folder: &Path) -> Result<(), Failure> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let trial = here.join(format!(".urto-{}", std::process::id()));
    match std::fs::File::create(&trial) {
        Ok(_) => {
            let _ = std::fs::remove_file(&trial); // It is empty, and named so that nobody takes it for a result.
            Ok(())
        }
        Err(error) => {
            Err(Failure::run(format_args!("error: cannot write into the folder {}: {error}", here.display())))
        }
    }
}
