//! What a path leads to: whether it is a file at all, and whether two paths lead to one file; files that are replaced whole.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Refuses what is no file with an end, before it is opened: a pipe that nobody writes into keeps its reader waiting, and
/// some devices hand out bytes for ever.
///
/// # Errors
/// With what it is instead, or why nothing can be known of it.
pub fn regular(path: &Path) -> io::Result<()> {
    let kind = std::fs::metadata(path)?.file_type();
    if kind.is_file() {
        return Ok(());
    }
    let what = if kind.is_dir() { "a folder" } else { "a pipe, a socket or a device" };
    Err(io::Error::new(io::ErrorKind::InvalidInput, format!("this is {what}, not a file")))
}

/// Refuses names of what is no file, before a new file takes the name: as the superuser one would replace a device, and every
/// program that uses it would read our file instead.
///
/// # Errors
/// With what it is instead.
pub fn replaceable(path: &Path) -> io::Result<()> {
    match regular(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        other => other,
    }
}

/// The name of a file that is not complete yet: `run.e` is written as `run.e.part`.
pub fn unfinished(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".part");
    name.into()
}

/// Writes a file beside its place and puts it there when all of it is on the disk: a full disk leaves what was there before.
/// A link stays one; into what is no file, such as a pipe, it writes at once.
///
/// # Errors
/// When it cannot be written; nothing is left of it then.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if replaceable(path).is_err() {
        return std::fs::write(path, bytes);
    }
    // Of a link what it leads to; where nothing is there yet, the name itself.
    let place = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let unfinished = unfinished(&place);
    let written = write_onto_disk(&unfinished, bytes).and_then(|()| {
        // Who may read the old file may read the new one.
        let kept = std::fs::metadata(&place).map(|old| std::fs::set_permissions(&unfinished, old.permissions()));
        kept.unwrap_or(Ok(()))?;
        std::fs::rename(&unfinished, &place)
    });
    if written.is_err() {
        let _ = std::fs::remove_file(&unfinished); // It may not even exist; the first error is the one to tell.
    }
    written
}

/// Some systems find only then that a disk is full.
fn write_onto_disk(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// What two paths have in common that lead to one file, through symbolic and hard links and whatever their names: the
/// device and the number of the file on it.
#[cfg(unix)]
pub type Identity = (u64, u64);
/// The same where files have no numbers: the path without links.
#[cfg(not(unix))]
pub type Identity = std::path::PathBuf;

/// The identity of the file that a path leads to; `None` where there is none.
pub fn identity(path: &Path) -> Option<Identity> {
    #[cfg(unix)]
    return std::fs::metadata(path).ok().map(numbers);
    #[cfg(not(unix))]
    path.canonicalize().ok()
}

/// The identity of an open file, by which one tells whether a path still leads to it; `None` where files have no numbers: there an open
/// file cannot be removed.
pub fn identity_of_open(file: &File) -> Option<Identity> {
    #[cfg(unix)]
    return file.metadata().ok().map(numbers);
    #[cfg(not(unix))]
    None
}

/// Refuses where a path does not lead to an open file any more.
///
/// # Errors
/// With what has become of it.
pub fn in_place(file: &File, path: &Path) -> io::Result<()> {
    let Some(own) = identity_of_open(file) else { return Ok(()) };
    let what = match identity(path) {
        Some(there) if there == own => return Ok(()),
        Some(_) => "another file has taken its name while it was written; what was written is lost",
        None => "it was removed or moved away while it was written",
    };
    Err(io::Error::new(io::ErrorKind::NotFound, what))
}

#[cfg(unix)]
fn numbers(about: std::fs::Metadata) -> Identity {
    use std::os::unix::fs::MetadataExt;
    (about.dev(), about.ino())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_and_devices_are_no_files() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a");
        assert_eq!(regular(&file).unwrap_err().kind(), io::ErrorKind::NotFound);
        std::fs::write(&file, "").unwrap();
        assert!(regular(&file).is_ok());
        assert_eq!(regular(folder.path()).unwrap_err().to_string(), "this is a folder, not a file");
        assert!(replaceable(&file).is_ok() && replaceable(&folder.path().join("b")).is_ok());
        assert!(replaceable(folder.path()).is_err());
        #[cfg(unix)]
        assert_eq!(
            regular(Path::new("/dev/zero")).unwrap_err().to_string(),
            "this is a pipe, a socket or a device, not a file"
        );
    }

    #[test]
    #[cfg(unix)]
    fn links_lead_to_one_file() {
        let folder = tempfile::tempdir().unwrap();
        let [file, soft, hard, copy] = ["a", "b", "c", "d"].map(|name| folder.path().join(name));
        std::fs::write(&file, "x").unwrap();
        std::fs::copy(&file, &copy).unwrap();
        std::os::unix::fs::symlink("a", &soft).unwrap();
        std::fs::hard_link(&file, &hard).unwrap();
        assert!(identity(&file).is_some());
        assert_eq!(identity(&file), identity(&soft));
        assert_eq!(identity(&file), identity(&hard));
        assert_ne!(identity(&file), identity(&copy));
        assert_eq!(identity(&folder.path().join("e")), None);
    }
}
