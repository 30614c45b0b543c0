//! Every deck in `decks/` against what it printed and computed before: `expected/x.log`, its print log, and
//! `expected/x.digest`, a digest of its results.
//!
//! `URTO_BLESS=1 cargo test --test golden` accepts what is different; `git diff tests/golden` shows what was accepted.
//! Large decks run on coarse meshes and some not to their end: see [`LIGHTER`].

mod digest;
mod log;
#[path = "../program/mod.rs"]
mod program;

use digest::Digest;
use program::{Desk, project};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// What is made lighter about a deck, so that all of them run in seconds.
struct Lighter {
    /// Name of the deck.
    deck: &'static str,
    /// Termination time to run to, in the deck's unit; `None` for its own.
    until: Option<f64>,
    /// Words of the recipe of its mesh, and those that take their place.
    mesh: &'static [(&'static str, &'static str)],
}

/// The decks that take more than a second as they are.
const LIGHTER: &[Lighter] = &[
    Lighter { deck: "bending_beam", until: None, mesh: &[("65, 30, 10", "16, 6, 2")] },
    Lighter { deck: "bending_beam_scaled", until: None, mesh: &[("60, {18 * ranks}, 6", "30, 9, 2")] },
    Lighter {
        deck: "brick_wall",
        until: Some(5e-3),
        mesh: &[("6, 35, 6", "3, 15, 3"), ("6, 3, 3", "3, 2, 2"), ("3, 3, 3", "2, 2, 2"), ("38, 4, 42", "10, 2, 12")],
    },
    Lighter {
        deck: "can_crush",
        until: None,
        mesh: &[("3,       40,     40", "2, 16, 20"), ("28, 28, 3", "10, 8, 2")],
    },
    Lighter {
        deck: "can_crush_paper",
        until: None,
        mesh: &[("3,       40,     40", "2, 16, 20"), ("28, 28, 3", "12, 8, 2")],
    },
    Lighter { deck: "can_crush_shell", until: None, mesh: &[("40,     40", "16,     20"), ("28, 28, 3", "10, 8, 2")] },
    Lighter { deck: "container_drop", until: Some(1.5e-3), mesh: &[] },
    Lighter { deck: "hertz", until: None, mesh: &[("16, QUARTER", "4, QUARTER")] },
    Lighter { deck: "rigid_ball", until: None, mesh: &[("48, 32, 4", "24, 16, 2"), ("4, FULL, 2", "3, FULL, 2")] },
    Lighter {
        deck: "perforation",
        until: None,
        mesh: &[
            ("10, 12, QUARTER", "4, 4, QUARTER"),
            ("24,      20,     12", "6, 8, 4"),
            ("5, 60, QUARTER", "2, 16, QUARTER"),
        ],
    },
    Lighter { deck: "lined_box", until: None, mesh: &[("10, 10, 20", "5, 5, 10")] },
    Lighter { deck: "plate_triangles", until: None, mesh: &[("24, 24", "8, 8")] },
    Lighter { deck: "sedov", until: None, mesh: &[("30, 30, 30", "10, 10, 10")] },
    Lighter { deck: "square_tube", until: Some(2e-3), mesh: &[("8, 60", "4, 20")] },
    Lighter { deck: "taylor_bar", until: None, mesh: &[("8, 160, QUARTER", "2, 40, QUARTER")] },
    Lighter { deck: "taylor_bar_axisymmetric", until: None, mesh: &[("16, 160", "6, 60")] },
    Lighter { deck: "taylor_bar_steel", until: None, mesh: &[("3, 81, QUARTER", "2, 40, QUARTER")] },
    Lighter { deck: "taylor_bar_wall", until: Some(30e-6), mesh: &[] },
];

/// Decks that go on from the last state of another.
const CONTINUED: &[(&str, &str)] = &[("wall_bar_further", "wall_bar")];

/// Elements times steps that a deck may take here: a second or two in the profile of tests.
const ALLOWED: f64 = 1e7;

/// Lines of the log and states of the plot file of a run.
const LINES: f64 = 20.0;
const STATES: f64 = 4.0;

#[test]
fn every_deck_prints_and_computes_what_it_did() {
    let decks = decks();
    assert!(decks.len() > 20, "only {} decks", decks.len());
    let forgotten: Vec<&str> =
        LIGHTER.iter().map(|l| l.deck).filter(|name| !decks.iter().any(|deck| deck == name)).collect();
    assert!(forgotten.is_empty(), "there is no deck for these lines of LIGHTER: {forgotten:?}");
    let next = AtomicUsize::new(0);
    let work = || {
        let claimed = std::iter::from_fn(|| decks.get(next.fetch_add(1, Ordering::Relaxed)));
        claimed.filter_map(|deck| differences(deck)).collect::<Vec<String>>()
    };
    let cores = std::thread::available_parallelism().map_or(1, |n| n.get());
    let found: Vec<String> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("no worker panics")).collect()
    });
    assert!(
        found.is_empty(),
        "\n{}\nURTO_BLESS=1 cargo test --test golden accepts this; git diff tests/golden then shows it",
        found.join("\n")
    );
}

#[test]
fn nothing_is_kept_for_decks_that_are_gone() {
    let decks = decks();
    let stale = listed("tests/golden/expected").into_iter().filter(|path| !decks.contains(&stem(path)));
    let stale: Vec<PathBuf> = stale.collect();
    assert!(stale.is_empty(), "{stale:?}");
}

/// What is different about a deck, in words; writes it down instead when asked to.
fn differences(deck: &str) -> Option<String> {
    let desk = Desk::new();
    let (log, digest) = match run(&desk, deck) {
        Ok(made) => made,
        Err(words) => return Some(format!("{deck}: {words}")),
    };
    let kept = ["log", "digest"].map(|suffix| project(&format!("tests/golden/expected/{deck}.{suffix}")));
    if std::env::var_os("URTO_BLESS").is_some() {
        fs::write(&kept[0], &log).and_then(|()| fs::write(&kept[1], digest.to_string())).expect("they can be written");
        return None;
    }
    let [old_log, old_digest] = kept.each_ref().map(|path| fs::read_to_string(path).unwrap_or_default());
    let old = match Digest::parse(&old_digest) {
        Ok(old) => old,
        Err(words) => return Some(format!("{deck}: {}: {words}", kept[1].display())),
    };
    let found = [old.differences(&digest), log::differences(&old_log, &log)].concat();
    (!found.is_empty()).then(|| format!("{deck} as kept and as it runs now differ\n  {}", found.join("\n  ")))
}

/// Runs a deck, after that which it goes on from, and returns its log without what depends on machine and day, and the
/// digest of its results.
fn run(desk: &Desk, deck: &str) -> Result<(String, Digest), String> {
    if let Some((_, first)) = CONTINUED.iter().find(|(further, _)| *further == deck) {
        run(desk, first)?;
        let [left, read] = [format!("{first}.rsout"), format!("{deck}.rsin")].map(|name| desk.path(&name));
        fs::rename(left, read).map_err(|e| format!("{first} leaves no state to go on from: {e}"))?;
    }
    let lighter = LIGHTER.iter().find(|lighter| lighter.deck == deck);
    desk.put(&format!("{deck}.i"), &timed(&text(&format!("decks/{deck}.i")), lighter.and_then(|l| l.until))?);
    let mut recipe = text(&format!("meshes/{deck}.mesh"));
    for (fine, coarse) in lighter.map_or(&[][..], |l| l.mesh) {
        if !recipe.contains(fine) {
            return Err(format!("there is no {fine:?} in the recipe that LIGHTER could replace"));
        }
        recipe = recipe.replace(fine, coarse);
    }
    desk.put(&format!("{deck}.mesh"), &recipe);
    let left = desk.urto(&[&format!("{deck}.i"), "--ranks", "1", "--quiet"]);
    if left.code != Some(0) {
        return Err(format!("it does not run:\n{}{}", left.out, left.err));
    }
    let results = desk.results(&format!("{deck}.e"));
    let digest = Digest::of(&results).map_err(|e| e.to_string())?;
    let cycles = digest.element_cycles();
    if cycles > ALLOWED {
        return Err(format!(
            "{cycles:.1e} elements times steps are more than {ALLOWED:.0e}: give it a line in LIGHTER"
        ));
    }
    Ok((log::lasting(&desk.text(&format!("{deck}.o"))), digest))
}

/// A deck with another termination time, if any, and with lines and states as often as is kept of them.
fn timed(deck: &str, until: Option<f64>) -> Result<String, String> {
    let own = deck.lines().find_map(|line| line.strip_prefix("TERMINATION TIME,"));
    let own = own.and_then(|rest| rest.split_whitespace().next()?.parse::<f64>().ok());
    let end = until.or(own).ok_or("no line `TERMINATION TIME, ...` as this test understands it")?;
    let times = ["TERMINATION TIME", "OUTPUT TIME", "PLOT TIME"];
    let mut out = String::new();
    for line in deck.lines().filter(|line| *line != "EXIT" && !times.iter().any(|time| line.starts_with(time))) {
        let _ = writeln!(out, "{line}");
    }
    let (lines, states) = (end / LINES, end / STATES);
    let _ = writeln!(out, "TERMINATION TIME, {end:e}\nOUTPUT TIME, {lines:e}\nPLOT TIME, {states:e}\nEXIT");
    Ok(out)
}

/// Names of all decks, in order.
fn decks() -> Vec<String> {
    let mut names: Vec<String> = listed("decks")
        .iter()
        .filter(|path| path.extension().is_some_and(|s| s == "i"))
        .map(|path| stem(path))
        .collect();
    names.sort();
    names
}

fn listed(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(project(folder)).expect("a folder of the project");
    entries.map(|entry| entry.expect("an entry").path()).collect()
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

fn text(name: &str) -> String {
    fs::read_to_string(project(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}
