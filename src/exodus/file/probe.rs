//! HDF5 files are tried by another process first.
//!
//! The HDF5 library follows addresses that stand in the file. On some damaged files it reads where there is no memory, which
//! ends the process without a word, or never comes to an end; and the binding panics where the library gives up in the
//! middle of a file. No header check short of a reader of HDF5 tells such files from sound ones, so a process of its own
//! reads the file before this one does. It costs the start of a process, some hundredths of a second, for every HDF5
//! file that is opened; files of the classic formats, such as all of our own, are read by their header and need none.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use crate::exodus::file::arrays::Arrays;
use crate::exodus::results::Results;

/// The program that tries files, and what stands before the file on its command line.
static PROGRAM: OnceLock<(PathBuf, Vec<OsString>)> = OnceLock::new();

/// How long the library may take for a file.
const PATIENCE: Duration = Duration::from_secs(60);
/// Files up to this size are read whole when they are tried; of larger ones all but the values.
const READ_WHOLE: u64 = 64 << 20;

/// Names the program that tries HDF5 files: it is called with these arguments and a file, calls [`try_out`], and leaves with
/// exit code 0. Without one, as in programs that use this crate as a library, files are read untried. Only the
/// first call counts.
pub fn probe_with(program: PathBuf, arguments: impl IntoIterator<Item = OsString>) {
    let _ = PROGRAM.set((program, arguments.into_iter().collect()));
}

/// Asks the library for everything in a file, and forgets the answers: what matters is that it answers.
pub fn try_out(path: &Path) {
    let Ok(length) = fs::metadata(path).map(|file| file.len()) else { return };
    let whole = length <= READ_WHOLE;
    if let Ok(arrays) = Arrays::open(path, length) {
        arrays.touch(whole);
    }
    if whole && let Ok(results) = Results::open(path) {
        let _ = results.mesh();
    }
}

/// Lets another process try a file.
///
/// # Errors
/// When it does not survive the file.
pub(in crate::exodus) fn vouch(path: &Path) -> Result<(), String> {
    let Some((program, arguments)) = PROGRAM.get() else { return Ok(()) };
    let mut command = Command::new(program);
    command.args(arguments).arg(path).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    // Where no process can be started, the file is read untried.
    let Ok(child) = command.spawn() else { return Ok(()) };
    match wait(child) {
        Ok(Some(status)) if status.success() => Ok(()),
        Ok(Some(status)) => Err(format!("the HDF5 library fails on it ({})", ended(status))),
        Ok(None) => Err(format!("the HDF5 library comes to no end with it in {} seconds", PATIENCE.as_secs())),
        Err(_) => Ok(()),
    }
}

/// How the process ended; `None` when it had to be ended.
fn wait(mut child: Child) -> io::Result<Option<ExitStatus>> {
    let begun = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        if begun.elapsed() > PATIENCE {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(50));
    }
}

fn ended(status: ExitStatus) -> String {
    #[cfg(unix)]
    {
        use std::os::unix::process::ExitStatusExt;
        if let Some(signal) = status.signal() {
            return format!("signal {signal}");
        }
    }
    status.code().map_or("it ends".into(), |code| format!("exit code {code}"))
}
