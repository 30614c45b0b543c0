//! Files that a deck includes.

use std::path::{Path, PathBuf};

use crate::deck::text::source::Source;

/// Bytes of an included file at most.
const LARGEST: u64 = 64 << 20;

/// A file found and read.
pub(super) struct Found {
    pub source: Source,
    /// What tells whether two names mean the same file.
    pub identity: PathBuf,
}

/// Reads a file that `includer` names: beside the file that includes it, or else where the program runs. The error says
/// why not; `None` when there is no such file.
pub(super) fn open(name: &str, includer: &Source) -> Result<Option<Found>, String> {
    let beside = Path::new(includer.name()).parent().map(|folder| folder.join(name));
    let Some(path) = beside.into_iter().chain([PathBuf::from(name)]).find(|path| path.exists()) else {
        return Ok(None);
    };
    let about = std::fs::metadata(&path).map_err(|e| e.to_string())?;
    if !about.is_file() {
        let what = if about.is_dir() { "a folder" } else { "a pipe, a socket or a device" };
        return Err(format!("this is {what}, not a file of text"));
    }
    if about.len() > LARGEST {
        return Err(format!("the file has {} MB; at most {} MB are read", about.len() >> 20, LARGEST >> 20));
    }
    let source = Source::open(&path).map_err(|e| e.to_string())?;
    if source.text().contains('\0') {
        return Err("this is not a file of text".into());
    }
    let identity = path.canonicalize().unwrap_or(path);
    Ok(Some(Found { source, identity }))
}
