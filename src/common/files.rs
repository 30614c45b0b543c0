//! What a path leads to: whether it is a file at all, and whether two paths lead to one file.

use std::fs::File;
use std::io;
use std::path::Path;

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
