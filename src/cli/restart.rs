//! Finds the state that a run goes on from, and holds it against deck and mesh.

use super::input::Given;
use super::{Failure, options};
use crate::exodus::{Restart, Results, read_restart, restart_number};
use crate::output::print::scientific;
use crate::postprocess::means::Means;
use crate::restart::{INTERVAL, Snapshot, TIME};
use crate::run::{Files, differences, other_form, states_beside, told, without_effect};
use crate::solver::Body;
use std::path::{Path, PathBuf};

/// The state to go on from, its file, and what of the deck has no effect on it; `None` for a run from the beginning. `base` is the base name of the results.
///
/// # Errors
/// When there is none, it cannot be read, or it is the state of another problem.
pub fn find(
    options: &options::Run,
    given: &Given,
    body: &Body,
    base: &Path,
) -> Result<Option<(PathBuf, Snapshot, Vec<String>)>, Failure> {
    let model = &given.problem.model;
    let read = model.restarts.read;
    if options.restart.is_none() && read.is_none() {
        return Ok(None);
    }
    let newest = match &options.restart {
        Some(path) => path.clone(),
        None => beside(base, &given.deck)?,
    };
    let path = match read.and_then(|read| read.time) {
        Some(time) => nearest(&newest, time)?,
        None => newest,
    };
    let restart = read_restart(&path).map_err(|error| unreadable(&path, error))?;
    if let Some(reason) = other_form(&restart) {
        return Err(Failure::input(format_args!(
            "error: {} is of another version: {reason}\nhelp: run from the start, or go on with the version that wrote it",
            path.display()
        )));
    }
    let differ = differences(&restart, &given.mesh, model, body);
    if !differ.is_empty() {
        return Err(Failure::input(format_args!(
            "error: {} is the state of another problem\n{}\n\
             help: times, outputs, loads and constraints may be changed when a run goes on, the numbers of materials, and of contact \
             all but what may touch: friction, partitions, passes, CONTACT OVERLAP and the like; mesh, laws, densities, CONTACT MATERIAL, \
             CONTACT NODE SET, CONTACT EXCLUSION and the side sets of CONTACT SURFACE and RIGID SURFACE may not",
            path.display(),
            told(&differ)
        )));
    }
    something_left(&path, &restart, model.termination_time)?;
    same_run(&path, &restart, base)?;
    let idle = without_effect(&restart, &given.mesh, model, body);
    Ok(Some((path, restart.snapshot, idle)))
}

/// `x.rsin`, or else `x.rsout`, beside the results or else beside the deck.
fn beside(base: &Path, deck: &Path) -> Result<PathBuf, Failure> {
    let named = |suffix: &str| {
        let mut of_results = base.as_os_str().to_owned();
        of_results.push(suffix);
        [PathBuf::from(of_results), deck.with_extension(&suffix[1..])]
    };
    let places = [named(".rsin"), named(".rsout")].concat();
    places.iter().find(|path| path.is_file()).cloned().ok_or_else(|| {
        Failure::input(format_args!(
            "error: READ RESTART: there is neither {} nor {}, and none beside the deck\n\
             help: WRITE RESTART in the deck of a run makes the latter; --restart names a file elsewhere",
            places[0].display(),
            places[2].display()
        ))
    })
}

/// Of a restart file and the older ones beside it the one whose state is nearest to a time.
fn nearest(newest: &Path, time: f64) -> Result<PathBuf, Failure> {
    let mut states = Vec::new();
    for (age, path) in states_beside(newest).into_iter().enumerate() {
        match restart_number(&path, TIME) {
            Ok(at) => states.push((at, path)),
            Err(error) if age == 0 => return Err(unreadable(&path, error)),
            Err(_) => {} // An older one that is damaged is not missed unless it is asked for.
        }
    }
    let distance = |at: f64| (at - time).abs();
    let best = states.iter().min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)));
    let Some((at, path)) = best else {
        return Err(Failure::input(format_args!("error: there is no restart file {}", newest.display())));
    };
    let interval = restart_number(path, INTERVAL).map_err(|error| unreadable(path, error))?;
    if distance(*at) <= 0.5 * interval {
        return Ok(path.clone());
    }
    let there: Vec<String> = states.iter().map(|(at, _)| scientific(*at, 6)).collect();
    Err(Failure::input(format_args!(
        "error: READ RESTART: there is no state at {}; {} and what is kept beside it have {}\n\
         help: ask for one of these, or leave the time out for the newest; WRITE RESTART, dt, keep sets how many are kept",
        scientific(time, 6),
        newest.display(),
        there.join(", ")
    )))
}

fn something_left(path: &Path, restart: &Restart, termination: f64) -> Result<(), Failure> {
    let time = restart.snapshot.time();
    if time < termination {
        return Ok(());
    }
    Err(Failure::input(format_args!(
        "error: the state in {} is at time {}, and the run ends at {}\nhelp: a later TERMINATION TIME lets it go on",
        path.display(),
        scientific(time, 6),
        scientific(termination, 6)
    )))
}

/// The state must be of the run whose results the new ones stand behind, as they are read as one run: the same start of the
/// program wrote both, or another that went on from this very state.
fn same_run(path: &Path, restart: &Restart, base: &Path) -> Result<(), Failure> {
    let there = Files::of(base).results_there();
    let opened: Vec<(&PathBuf, Results)> =
        there.iter().filter_map(|path| Some((path, Results::open(path).ok()?))).collect();
    let writer = restart.mesh.qa.last().cloned();
    let belongs = |(_, results): &(&PathBuf, Results)| {
        let since = Means::read(&results.info()).since;
        results.qa().pop() == writer || since == Some(restart.snapshot.time())
    };
    match opened.first() {
        Some((first, _)) if !opened.iter().any(belongs) => Err(Failure::input(format_args!(
            "error: {} is no state of the run that wrote {}: what goes on from it would be read as one run with that\n\
             help: name another base with -o, or move the results of the other run away",
            path.display(),
            first.display()
        ))),
        _ => Ok(()),
    }
}

/// A file that cannot be read, and what else there is.
fn unreadable(path: &Path, error: crate::exodus::ResultsError) -> Failure {
    let text = error.to_string();
    let text = if text.starts_with("error:") { text } else { format!("error: {text}") };
    let mut older = path.as_os_str().to_owned();
    older.push(".1");
    let older = PathBuf::from(older);
    if older.is_file() {
        return Failure::input(format_args!("{text}\nhelp: {} is the state before it", older.display()));
    }
    Failure::input(text)
}
