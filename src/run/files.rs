//! Names of a run's files: PRONTO's suffixes on one base name.

use super::restart::states_beside;
use crate::exodus::names_in_writing;
use crate::exodus::pieces::{all_pieces_of, any_pieces_of, piece_path};
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
    /// Newest restart state, `.rsout`.
    pub restart: PathBuf,
    /// Its appearance asks the run to stop, `.shutdown`.
    pub shutdown: PathBuf,
    /// Locked while a run writes the others, `.lock`; it goes with the run.
    pub lock: PathBuf,
}

/// `base` with a suffix appended; what looks like a suffix of `base` stays.
pub(super) fn with_suffix(base: &Path, suffix: &str) -> PathBuf {
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
            restart: with_suffix(base, ".rsout"),
            shutdown: with_suffix(base, ".shutdown"),
            lock: with_suffix(base, ".lock"),
        }
    }
}

impl Files {
    /// Every name that the run may write, rename or remove, but for restart states, on so many ranks; a single one writes
    /// whole files.
    pub fn written(&self, pieces: usize) -> Vec<PathBuf> {
        let pieces = (0..pieces).map(|rank| piece_path(&self.plot, pieces, rank));
        let results = pieces.chain([self.plot.clone(), self.history.clone()]);
        let results = results.flat_map(|path| names_in_writing(&path));
        results.chain([self.print.clone(), self.shutdown.clone(), self.lock.clone()]).collect()
    }

    /// Results of earlier runs of this name that a run which begins anew on so many ranks would leave beside its own, where they would
    /// be taken for its: what runs that went on have written, the whole beside pieces or pieces beside the whole, and histories,
    /// which a run may not have. States to go on from are set aside instead.
    pub fn stale(&self, pieces: usize) -> Vec<PathBuf> {
        let parts = [&self.plot, &self.history].into_iter().flat_map(|first| {
            let later = (2..=9999).map(move |number| part_of(first, number));
            later.map(with_pieces).take_while(|files| !files.is_empty()).flatten()
        });
        let own: Vec<PathBuf> = (0..pieces).map(|rank| piece_path(&self.plot, pieces, rank)).collect();
        let other_pieces = all_pieces_of(&self.plot).into_iter().filter(|path| !own.contains(path));
        let whole = (pieces > 0 && self.plot.is_file()).then(|| self.plot.clone());
        let history = self.history.is_file().then(|| self.history.clone());
        parts.chain(other_pieces).chain(whole).chain(history).collect()
    }

    /// The same of restart states: the newest, the one that is being written, and older ones.
    pub fn restarts_written(&self) -> Vec<PathBuf> {
        let unfinished = names_in_writing(&with_suffix(&self.restart, ".new"));
        states_beside(&self.restart).into_iter().chain(unfinished).chain([self.restart.clone()]).collect()
    }

    /// Whether the run has histories, in its first part or in one that went on.
    pub fn has_histories(&self) -> bool {
        let there_is = |number: &u32| *number == 1 || part_of(&self.plot, *number).exists();
        (1..=9999).take_while(there_is).any(|number| part_of(&self.history, number).exists())
    }

    /// Plot files and histories that are there under these names, of all parts; of pieces the first.
    pub fn results_there(&self) -> Vec<PathBuf> {
        let of = |number: u32| [part_of(&self.plot, number), part_of(&self.history, number)];
        let there = (1..=9999).map(|number| of(number).into_iter().filter_map(first_file).collect::<Vec<_>>());
        there.take_while(|files| !files.is_empty()).flatten().collect()
    }

    /// All files of a run that is continued. Plot states and histories that are there already, whole or in pieces, are left
    /// alone: those of the continued run come into `base.e-s0002` and so on, which viewers string together.
    pub fn continuing(base: &Path) -> Files {
        let first = Files::of(base);
        let named = |number: u32| Files {
            plot: part_of(&first.plot, number),
            history: part_of(&first.history, number),
            ..first.clone()
        };
        let free = |files: &Files| !files.plot.exists() && !files.history.exists() && !any_pieces_of(&files.plot);
        (1..=9999).map(named).find(free).unwrap_or_else(|| first.clone())
    }
}

/// The name of what the `number`-th start of the program writes into: `run.e`, `run.e-s0002`, ...
pub fn part_of(first: &Path, number: u32) -> PathBuf {
    if number == 1 { first.to_owned() } else { with_suffix(first, &format!("-s{number:04}")) }
}

/// The first of them by the name of any: `run.e` of `run.e-s0002`; other names as they are.
pub fn first_part_of(named: &Path) -> PathBuf {
    let parted = named.to_str().and_then(|name| name.rsplit_once("-s"));
    let is_number = |number: &str| number.len() == 4 && number.bytes().all(|digit| digit.is_ascii_digit());
    let of_run = |first: &Path| ["e", "h"].iter().any(|suffix| first.extension().is_some_and(|own| own == *suffix));
    match parted {
        Some((first, number)) if is_number(number) && of_run(Path::new(first)) => PathBuf::from(first),
        _ => named.to_owned(),
    }
}

/// The last of them that is there, whole; `first` where none follows.
pub fn last_part_of(first: &Path) -> PathBuf {
    let parts = (2..=9999).map(|number| part_of(first, number)).take_while(|path| path.is_file());
    parts.last().unwrap_or_else(|| first.to_owned())
}

/// A file, or else the first of its pieces that is there.
fn first_file(path: PathBuf) -> Option<PathBuf> {
    if path.is_file() { Some(path) } else { all_pieces_of(&path).into_iter().next() }
}

/// A file and its pieces, those that are there.
fn with_pieces(path: PathBuf) -> Vec<PathBuf> {
    let mut all = all_pieces_of(&path);
    all.extend(path.is_file().then_some(path));
    all
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_part_tells_the_first() {
        for (named, first) in [
            ("a/m.e-s0002", "a/m.e"),
            ("m.h-s0013", "m.h"),
            ("m.e", "m.e"),
            ("m-s0002", "m-s0002"),
            ("m.e-s2", "m.e-s2"),
        ] {
            assert_eq!(first_part_of(Path::new(named)), Path::new(first));
        }
        assert_eq!(first_part_of(&part_of(Path::new("m.e"), 7)), Path::new("m.e"));
    }
}
