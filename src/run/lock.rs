//! One run at a time writes the files of a base name.

use crate::common::files::{identity, identity_of_open};
use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

/// An advisory lock on an empty file beside the results. The system takes it away with the process, so that a run which was killed
/// keeps nobody from the next; the file that it leaves behind then means nothing.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    /// `None` where the file system has no locks, or something else has this name: the run goes on without one.
    file: Option<File>,
}

impl Lock {
    /// Takes the lock; `None` where another living process holds it.
    pub fn take(path: &Path) -> Option<Lock> {
        // Who held the file that was opened may have removed it since: then it is no longer the one that others find.
        while let Some(file) = open(path) {
            match file.try_lock() {
                Ok(()) if identity_of_open(&file).is_some_and(|own| identity(path) != Some(own)) => continue,
                Ok(()) => return Some(Lock { path: path.to_owned(), file: Some(file) }),
                Err(TryLockError::WouldBlock) => return None,
                Err(TryLockError::Error(_)) => break,
            }
        }
        Some(Lock { path: path.to_owned(), file: None })
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        if self.file.is_some() {
            let _ = std::fs::remove_file(&self.path); // While it is locked, so that it is nobody else's.
        }
    }
}

/// The file, made where there is none; what is no empty file is somebody's, and left alone.
fn open(path: &Path) -> Option<File> {
    let ours = |about: std::fs::Metadata| about.is_file() && about.len() == 0;
    if !std::fs::symlink_metadata(path).map_or(true, ours) {
        return None;
    }
    OpenOptions::new().write(true).create(true).truncate(false).open(path).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.lock");
        let lock = Lock::take(&path).expect("free");
        assert!(path.exists() && Lock::take(&path).is_none());
        drop(lock);
        assert!(!path.exists());
        // What a killed run leaves keeps nobody out; what somebody has written stays, and so does a folder that is not there.
        std::fs::write(&path, "").unwrap();
        drop(Lock::take(&path).expect("free"));
        assert!(!path.exists());
        std::fs::write(&path, "mine").unwrap();
        drop(Lock::take(&path).expect("gone without"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
        assert!(Lock::take(&folder.path().join("none").join("a.lock")).is_some());
    }
}
