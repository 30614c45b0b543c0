//! Restart files as users meet them: written at intervals, at signals and when a run is killed; read by decks that ask for
//! a time; refused when they belong to something else.

use crate::program::{Desk, Left, URTO, bar_deck, box_mesh, commands_mesh, mpiexec, project, put_bar, wait_for};
use std::path::Path;
use std::time::Duration;
use urto::exodus::{Restart, Results, read_restart};
use urto::mesh::Mesh;

/// Numbers of ranks that write and read.
const RANKS: [&str; 3] = ["1", "2", "5"];

/// The deck with every command, without those about restarts, and with these lines more.
fn commands(more: &str) -> String {
    let deck = std::fs::read_to_string(project("decks/commands.i")).expect("the deck");
    let rest = deck.lines().filter(|line| !line.contains("RESTART") && *line != "EXIT");
    rest.map(|line| format!("{line}\n")).collect::<String>() + more + "EXIT\n"
}

fn desk() -> Desk {
    let desk = Desk::new();
    desk.put_mesh("case.g", &commands_mesh());
    desk
}

fn run(desk: &Desk, deck: &str, arguments: &[&str]) -> Left {
    desk.urto(&[&[deck, "-m", "case.g", "-q"], arguments].concat())
}

/// All values of a state, as bits.
fn bits(results: &Results, state: usize) -> Vec<u64> {
    let mut values = vec![results.times()[state]];
    values.extend(results.global(state).expect("globals"));
    for name in results.nodal_names() {
        values.extend(results.nodal(name, state).expect("nodal values"));
    }
    for name in results.element_names() {
        values.extend(results.element(name, state).expect("element values"));
    }
    values.iter().map(|value| value.to_bits()).collect()
}

/// Asserts that a continued run's file holds the last states of the whole run's file, and several of them.
#[track_caller]
pub fn assert_tail(whole: &Path, continued: &Path) {
    let [whole, continued] = [whole, continued].map(|path| Results::open(path).expect("results"));
    let (all, some) = (whole.times().len(), continued.times().len());
    assert!((3..all).contains(&some), "{some} of {all} states");
    for state in 0..some {
        let place = all - some + state;
        assert!(bits(&whole, place) == bits(&continued, state), "state {place} of {all} differs");
    }
}

/// What a log says of the physics: step lines without the columns of time, and the final balance. A continued run begins
/// with a search, so searches are its own.
fn physics(desk: &Desk, log: &str) -> Vec<String> {
    let text = desk.text(log);
    let head = text.lines().position(|line| line.contains("TIME DILATATION")).expect("column heads");
    let end = text.lines().position(|line| line.contains("W H E R E") || line.contains("S C E N E"));
    let end = end.expect("the closing table");
    let lines = text.lines().skip(head + 2).take(end - head - 2);
    let own = ["RESTART FILE WRITTEN", "SEARCH", "PAIRS OF THEM", "PLOT STATES"];
    let lines = lines.filter(|line| own.iter().all(|word| !line.contains(word)));
    lines.map(|line| physical_cells(line).join(" ")).collect()
}

fn physical_cells(line: &str) -> Vec<&str> {
    let mut cells: Vec<&str> = line.split_whitespace().collect();
    if cells.len() >= 10 && cells[0].parse::<u64>().is_ok() {
        // Seconds to go are the last but one of a log without STEP LOG.
        for timed in [if cells.len() == 10 { 8 } else { 16 }, 4, 3] {
            cells.remove(timed);
        }
    }
    cells
}

fn restart(path: &Path) -> Restart {
    read_restart(path).unwrap_or_else(|error| panic!("{error}"))
}

/// Bits of everything in a restart file that physics made.
fn state(path: &Path) -> Vec<(String, Vec<u64>)> {
    let snapshot = restart(path).snapshot;
    let of = |name: &str, values: &[f64]| (name.to_string(), values.iter().map(|v| v.to_bits()).collect());
    let numbers = snapshot.numbers.iter().filter(|(name, _)| name != "CONTSEARCHES").map(|(name, v)| of(name, &[*v]));
    let arrays = snapshot.nodal.iter().chain(&snapshot.element).map(|(name, values)| of(name, values));
    numbers.chain(arrays).chain(snapshot.lists.iter().map(|list| of(&list.name, &list.values))).collect()
}

#[test]
fn continued_files_end_with_the_bits_of_a_run_that_never_stopped() {
    let desk = desk();
    desk.put("whole.i", &commands("WRITE RESTART, 10.E-6, 9\n"));
    desk.put("again.i", &commands("READ RESTART, 20.E-6\nWRITE RESTART, 10.E-6\n"));
    run(&desk, "whole.i", &["--ranks", "1"]).with(0);
    let expected = physics(&desk, "whole.o");
    for writing in RANKS {
        let written = format!("written{writing}");
        run(&desk, "whole.i", &["--ranks", writing, "-o", &written]).with(0);
        for reading in RANKS {
            let base = format!("read{writing}{reading}");
            // The file that one run leaves becomes what another reads.
            std::fs::copy(desk.path(&format!("{written}.rsout.3")), desk.path(&format!("{base}.rsin")))
                .expect("a copy");
            run(&desk, "again.i", &["--ranks", reading, "-o", &base]).with(0);
            assert_tail(&desk.path("whole.e"), &desk.path(&format!("{base}.e")));
            assert_tail(&desk.path("whole.h"), &desk.path(&format!("{base}.h")));
            let lines = physics(&desk, &format!("{base}.o"));
            assert!(lines.len() > 20 && expected.ends_with(&lines), "{base}: {lines:#?}");
            assert_eq!(state(&desk.path("whole.rsout")), state(&desk.path(&format!("{base}.rsout"))), "{base}");
        }
    }
    if let Some(mut mpi) = mpiexec(3) {
        // What threads wrote goes on as MPI processes, and these write as threads do.
        let arguments = ["again.i", "-m", "case.g", "-q", "-o", "mpi", "--restart", "whole.rsout"];
        Left::of(mpi.arg(URTO).args(arguments).current_dir(desk.path(".")).output().expect("mpiexec starts")).with(0);
        assert_tail(&desk.path("whole.e"), &desk.path("mpi.e"));
        assert_eq!(state(&desk.path("whole.rsout")), state(&desk.path("mpi.rsout")));
    }
}

/// In two dimensions: contact with friction, a rigid line, silent and loaded edges, DEATH; written and read on any ranks.
#[test]
fn runs_in_the_plane_go_on_with_the_same_bits() {
    let recipe = "TITLE\n two\nRECTANGLE, 1, 0., 0., 0.1, 0.02, 20, 4\nRECTANGLE, 2, 0.01, 0.02, 0.03, 0.03, 7, 6\n\
                  SIDE SET FACE, 100, 1, FRONT\nSIDE SET FACE, 200, 2, BACK\nSIDE SET FACE, 300, 1, RIGHT\n";
    let metal = "ELASTIC PLASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 1.E8\n\
                 HARDENING MODULUS = 2.E8\nBETA = 0.5\nEND\n";
    let deck = |analysis: &str, more: &str| {
        format!(
            "TITLE\n two\n{analysis}\nTERMINATION TIME, 5.E-5\nOUTPUT TIME, 2.E-6\nPLOT TIME, 2.E-6\n\
             PLOT NODAL, DISPLACEMENT, VELOCITY, REACTION, CONTACT\nPLOT ELEMENT, STRESS, STRAIN, ENERGY\nPLOT STATE, EQPS\n\
             HISTORY BLOCK, 1, 2\nHISTORY TIME, 1.E-6\nCONTACT MATERIAL\nCONTACT DATA, 1, 2, 0.3\nDEATH, 2, EQPS, MAX, 0.05\n\
             RIGID SURFACE, 100, 0., 0., 0., 1., 0.1\nSILENT BC, 300\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESSURE, 200, 1, 1.E7\n\
             INITIAL VELOCITY MATERIAL, 2, 10., -150.\nMATERIAL, 1, {metal}MATERIAL, 2, {metal}{more}EXIT\n"
        )
    };
    let mesh = urto::mesher::make(recipe, "case.mesh", 1).unwrap_or_else(|found| panic!("{}", found.render(false)));
    for analysis in ["AXISYMMETRIC", "PLANE STRAIN"] {
        let desk = Desk::new();
        desk.put_mesh("case.g", &mesh);
        desk.put("whole.i", &deck(analysis, "WRITE RESTART, 10.E-6, 9\n"));
        desk.put("again.i", &deck(analysis, "READ RESTART\nWRITE RESTART, 10.E-6\n"));
        run(&desk, "whole.i", &["--ranks", "1"]).with(0);
        let expected = physics(&desk, "whole.o");
        for [writing, reading] in [["1", "3"], ["3", "1"], ["2", "2"]] {
            let base = format!("part{writing}{reading}");
            run(&desk, "whole.i", &["--ranks", writing, "-o", &base]).with(0);
            let from = format!("{base}.rsout.2");
            run(&desk, "again.i", &["--ranks", reading, "-o", "go", "--restart", &from]).with(0);
            let last = |stem: &str| {
                let newer = (2..9).rev().map(|n| format!("go.{stem}-s{n:04}")).find(|name| desk.has(name));
                desk.path(&newer.unwrap_or_else(|| format!("go.{stem}")))
            };
            assert_tail(&desk.path("whole.e"), &last("e"));
            assert_tail(&desk.path("whole.h"), &last("h"));
            let lines = physics(&desk, "go.o");
            assert!(lines.len() > 8 && expected.ends_with(&lines), "{base}: {lines:#?}");
            let [whole, go] = ["whole", "go"].map(|base| state(&desk.path(&format!("{base}.rsout"))));
            let other: Vec<&str> =
                whole.iter().filter(|one| !go.contains(one)).map(|(name, _)| name.as_str()).collect();
            assert!(other.is_empty() && whole.len() == go.len(), "{base}: these differ: {other:?}");
        }
    }
}

#[test]
fn plot_files_and_histories_that_are_there_are_left_alone() {
    let desk = desk();
    desk.put("case.i", &commands("WRITE RESTART, 10.E-6\n"));
    run(&desk, "case.i", &[]).with(0);
    let first = ["case.e", "case.h"].map(|name| std::fs::read(desk.path(name)).expect("results"));
    let longer = commands("READ RESTART\n").replace("TERMINATION TIME, 50.E-6", "TERMINATION TIME, 60.E-6");
    desk.put("case.i", &longer);
    run(&desk, "case.i", &[]).with(0);
    run(&desk, "case.i", &[]).with(0);
    assert_eq!(first, ["case.e", "case.h"].map(|name| std::fs::read(desk.path(name)).expect("results")));
    for name in ["case.e-s0002", "case.h-s0002", "case.e-s0003", "case.h-s0003", "case.o", "case.o.1", "case.o.2"] {
        assert!(desk.has(name), "{name}");
    }
    // The newest state is the last one; the run ends ten microseconds later, as one that never stopped.
    desk.put("whole.i", &longer.replace("READ RESTART\n", ""));
    run(&desk, "whole.i", &[]).with(0);
    let [whole, part] = ["whole.e", "case.e-s0003"].map(|name| desk.results(name));
    let [end, last] = [&whole, &part].map(|results| results.times().len() - 1);
    assert!(bits(&whole, end) == bits(&part, last));
    // What goes on begins before the steps that the first run made shorter for its end.
    assert!(part.times()[0] > 40e-6, "{:?}", part.times());
}

/// Restart files stay whole when plot states are in pieces, and pieces that are there are left alone like whole files.
#[test]
fn runs_in_pieces_go_on() {
    let desk = desk();
    desk.put_mesh("case.g", &wedges(&commands_mesh()));
    desk.put("case.i", &commands("WRITE RESTART, 10.E-6, 9\n"));
    run(&desk, "case.i", &["-o", "whole", "--ranks", "2"]).with(0);
    run(&desk, "case.i", &["-o", "split", "--ranks", "3", "--split"]).with(0);
    for name in ["rsout", "rsout.1", "rsout.3"] {
        let [whole, split] = ["whole", "split"].map(|base| state(&desk.path(&format!("{base}.{name}"))));
        assert!(whole == split, "{name}");
    }
    let first = std::fs::read(desk.path("split.e.3.0")).expect("a piece");
    std::fs::remove_file(desk.path("split.h")).expect("the histories"); // The pieces alone keep their name.
    desk.put("again.i", &commands("READ RESTART, 20.E-6\n"));
    let on = |ranks: &str| {
        let arguments = ["-o", "split", "--ranks", ranks, "--split", "--restart", "split.rsout"];
        run(&desk, "again.i", &arguments).with(0);
    };
    on("2");
    on("3");
    assert_eq!(first, std::fs::read(desk.path("split.e.3.0")).expect("a piece"));
    for part in ["split.e-s0002", "split.e-s0003"] {
        desk.urto(&["join", part]).with(0);
        assert_tail(&desk.path("whole.e"), &desk.path(part));
    }
}

/// The same box of wedges, two in each hexahedron, on its diagonal seen along z.
fn wedges(mesh: &Mesh) -> Mesh {
    let halves = |[a, b, c, d, e, f, g, h]: [u32; 8]| [[a, b, c, c, e, f, g, g], [a, c, d, d, e, g, h, h]];
    let mut cut = mesh.clone();
    for block in &mut cut.blocks {
        block.nodes = block.hexahedra().iter().flat_map(|hex| halves(*hex)).flatten().collect();
    }
    for set in &mut cut.side_sets {
        // Bottom and top are cut, and the first half has the face where x is largest.
        let halves = |&(element, side): &(u32, u8)| [0, 1].map(|half| (2 * element + half, side));
        set.sides = set.sides.iter().flat_map(halves).filter(|(element, side)| *side > 3 || element % 2 == 0).collect();
    }
    cut.element_ids = (1..=cut.element_count() as i64).collect();
    cut
}

#[test]
fn only_as_many_states_as_asked_are_kept() {
    let desk = desk();
    for (keep, names) in [(1, vec!["case.rsout"]), (3, vec!["case.rsout", "case.rsout.1", "case.rsout.2"])] {
        desk.put("case.i", &commands(&format!("WRITE RESTART, 5.E-6, {keep}\n")));
        run(&desk, "case.i", &[]).with(0);
        let mut left: Vec<String> = std::fs::read_dir(desk.path("."))
            .expect("the folder")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .filter(|name| name.contains("rsout") && !name.contains("rsout.old"))
            .collect();
        left.sort();
        assert_eq!(left, names);
    }
    // A run that begins anew does not take another's states for its own.
    desk.put("case.i", &commands("WRITE RESTART, 40.E-6, 9\n"));
    run(&desk, "case.i", &[]).with(0);
    assert!(desk.has("case.rsout.1") && !desk.has("case.rsout.2"));
}

#[test]
fn a_signal_leaves_a_state_to_go_on_from() {
    let desk = Desk::new();
    let deck = |more: &str| {
        bar_deck(2e-3, &format!("RIGID SURFACE, 100, 0., 0., -1.E-3, 0., 0., 1.\nPLOT TIME, 1.E-4\n{more}"))
    };
    desk.put_mesh("case.g", &box_mesh([4, 4, 16], [0.01, 0.01, 0.04], false));
    desk.put("case.i", &deck("WRITE RESTART, 1.\n"));
    let mut child = desk.start(&["case.i", "--ranks", "2", "-o", "stopped"]);
    assert!(wait_for(
        || desk.has("stopped.e") && Results::open(&desk.path("stopped.e")).is_ok_and(|r| r.times().len() > 3)
    ));
    signal(&child, "TERM");
    let code = child.wait().expect("it ends").code();
    if code == Some(0) {
        return; // The machine was so slow to signal that the run had ended.
    }
    assert_eq!(code, Some(143));
    let log = desk.text("stopped.o");
    assert!(log.contains("STOPPED BY SIGTERM") && log.contains("RESTART FILE WRITTEN AT TIME"), "{log}");
    run(&desk, "case.i", &["-o", "whole"]).with(0);
    run(&desk, "case.i", &["-o", "stopped", "--ranks", "3", "--restart", "stopped.rsout"]).with(0);
    assert_tail(&desk.path("whole.e"), &desk.path("stopped.e-s0002"));
}

fn signal(child: &std::process::Child, name: &str) {
    let sent = std::process::Command::new("kill").args([format!("-{name}"), child.id().to_string()]).status();
    assert!(sent.expect("kill runs").success());
}

/// Kills; most of what this run does is writing states to go on from.
const KILLS: u64 = 16;

#[test]
fn a_kill_leaves_the_last_good_state() {
    let desk = Desk::new();
    put_bar(&desk, 1e-4, "WRITE RESTART, 1.E-12\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1.\n");
    let begun = std::time::Instant::now();
    desk.urto(&["bar.i", "-q", "-o", "whole"]).with(0);
    let (whole, end) = (begun.elapsed().as_micros() as u64, state(&desk.path("whole.rsout")));
    let mut continued = 0;
    for kill in 0..KILLS {
        let mut child = desk.start(&["bar.i", "-q"]);
        // Instants spread over the run by the golden ratio.
        std::thread::sleep(Duration::from_micros((kill * 618_034) % 1_000_000 * whole / 1_000_000));
        child.kill().expect("it can be killed");
        child.wait().expect("it ends");
        if !desk.has("bar.rsout") {
            continue;
        }
        let time = restart(&desk.path("bar.rsout")).snapshot.time();
        if desk.has("bar.rsout.1") {
            assert!(restart(&desk.path("bar.rsout.1")).snapshot.time() <= time);
        }
        if kill % 2 == 0 && time < 1e-4 {
            desk.urto(&["bar.i", "-q", "--restart", "bar.rsout"]).with(0);
            assert_eq!(state(&desk.path("bar.rsout")), end, "continued from {time}");
            continued += 1;
        }
        for name in ["bar.rsout", "bar.rsout.1"] {
            let _ = std::fs::remove_file(desk.path(name));
        }
    }
    assert!(continued > 1, "only {continued} of {KILLS} kills left something to go on from");
}

/// The message that refuses a restart; nothing must have been written over.
fn refused(desk: &Desk, arguments: &[&str]) -> String {
    let left = run(desk, "case.i", &[arguments, &["-o", "again"]].concat()).with(2);
    assert!(!desk.has("again.e") && !desk.has("again.o"), "nothing is written");
    left.err
}

/// A desk with `case.rsout` and `case.rsout.1` of the deck with every command.
fn written() -> Desk {
    let desk = desk();
    desk.put("case.i", &commands("WRITE RESTART, 20.E-6, 2\n"));
    run(&desk, "case.i", &[]).with(0);
    desk.put("case.i", &commands("").replace("TERMINATION TIME, 50", "TERMINATION TIME, 70"));
    desk
}

#[test]
fn files_that_are_no_restart_files_are_refused() {
    let desk = written();
    for (name, contents) in [("empty", &b""[..]), ("text", b"no netCDF at all")] {
        std::fs::write(desk.path(name), contents).expect("a file");
    }
    let good = std::fs::read(desk.path("case.rsout")).expect("the restart file");
    std::fs::write(desk.path("short"), &good[..good.len() - 100]).expect("a file");
    std::fs::write(desk.path("header"), &good[..1000]).expect("a file");
    let cases = [
        ("missing", "cannot be read"),
        ("empty", "it is empty"),
        ("text", "not a netCDF file"),
        ("short", "cut short"),
        ("header", "cut short"),
        ("case.g", "no restart file"),
        ("case.e", "no restart file"),
    ];
    for (file, words) in cases {
        let message = refused(&desk, &["--restart", file]);
        assert!(
            message.contains(words) && message.starts_with("error: ") && message.contains(file),
            "{file}: {message}"
        );
    }
    std::fs::copy(desk.path("short"), desk.path("case.rsout")).expect("a copy");
    let message = refused(&desk, &["--restart", "case.rsout"]);
    assert!(message.contains("case.rsout.1 is the state before it"), "{message}");
}

/// A bit that turns over anywhere: in the header, the mesh, the state, or the checksum itself.
#[test]
fn damaged_restart_files_are_refused() {
    let desk = written();
    let good = std::fs::read(desk.path("case.rsout")).expect("the restart file");
    let state = good.len() - 1000;
    for place in (0..good.len()).step_by(211).chain(state..good.len()) {
        let mut bad = good.clone();
        bad[place] ^= 1 << (place % 8);
        std::fs::write(desk.path("bad"), &bad).expect("a file");
        assert!(read_restart(&desk.path("bad")).is_err(), "byte {place} of {}", good.len());
    }
    let mut bad = good.clone();
    bad[state] ^= 1;
    std::fs::write(desk.path("case.rsout"), &bad).expect("a file");
    let message = refused(&desk, &["--restart", "case.rsout"]);
    for words in [
        "error: case.rsout: the restart file is damaged",
        "checksum",
        "help: a run from it could go wrong",
        "case.rsout.1 is the state before it",
    ] {
        assert!(message.contains(words), "{message}");
    }
    // Without its last bytes, as a program that writes netCDF anew would leave it.
    std::fs::write(desk.path("bare"), &good[..good.len() - 24]).expect("a file");
    let message = refused(&desk, &["--restart", "bare"]);
    assert!(message.contains("does not end in its checksum"), "{message}");
}

#[test]
fn states_of_other_problems_are_refused() {
    let desk = written();
    let deck = desk.text("case.i");
    let cases = [
        (
            "MATERIAL, 2, ELASTIC, 2700.",
            "MATERIAL, 2, ELASTIC, 2800.",
            "MATERIAL 2: it was ELASTIC of density 2700, it is",
        ),
        ("HOURGLASS CONTROL, FLANAGAN BELYTSCHKO", "HOURGLASS CONTROL, FLANAGAN BELYTSCHKO", ""),
        ("CONTACT MATERIAL, 1, 2 ", "CONTACT MATERIAL ", "CONTACT MATERIAL: it was 1 2, it is all blocks"),
        (
            "CONTACT SURFACE, 100, 300",
            "CONTACT SURFACE, 200, 300",
            "CONTACT SURFACE: it was 100 on 300, it is 200 on 300",
        ),
        ("RIGID SURFACE, 100,", "$ RIGID SURFACE, 100,", "it is none"),
    ];
    for (then, now, words) in cases.into_iter().filter(|case| !case.2.is_empty()) {
        assert!(deck.contains(then), "{then}");
        desk.put("case.i", &deck.replace(then, now));
        let message = refused(&desk, &["--restart", "case.rsout"]);
        assert!(message.contains(words) && message.contains("the state of another problem"), "{now}: {message}");
        assert!(
            message.contains("help: times, outputs") && message.contains("of contact all but what may touch"),
            "{message}"
        );
    }
    desk.put("case.i", &deck);
    let meshes = [
        (
            box_mesh([2, 2, 6], [0.01, 0.01, 0.04], true),
            "the mesh had 81 nodes and 32 elements, it has 63 nodes and 24",
        ),
        (box_mesh([2, 2, 8], [0.01, 0.01, 0.041], true), "is not where it was in the mesh"),
    ];
    for (mesh, words) in meshes {
        desk.put_mesh("case.g", &mesh);
        let message = refused(&desk, &["--restart", "case.rsout"]);
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn a_time_that_has_no_state_is_refused() {
    let desk = written();
    let deck = desk.text("case.i");
    let with = |line: &str| desk.put("case.i", &deck.replace("EXIT", &format!("{line}\nEXIT")));
    with("READ RESTART, 5.E-6");
    let message = refused(&desk, &["--restart", "case.rsout"]);
    assert!(
        message.contains("there is no state at 5.000000e-06") && message.contains("beside it have 4."),
        "{message}"
    );
    // Half an interval away is near enough: this is the state at 40 microseconds.
    with("READ RESTART, 31.E-6");
    run(&desk, "case.i", &["--restart", "case.rsout", "-o", "near"]).with(0);
    assert!(
        desk.text("near.o").contains("case.rsout.1 is read: the run goes on at step 101"),
        "{}",
        desk.text("near.o")
    );
    with("READ RESTART");
    for name in ["case.rsout", "case.rsout.1"] {
        std::fs::rename(desk.path(name), desk.path(&name.replace("case", "other"))).expect("renamed");
    }
    let message = refused(&desk, &[]);
    assert!(message.contains("there is neither again.rsin nor again.rsout"), "{message}");
    desk.put("case.i", &deck.replace("TERMINATION TIME, 70", "TERMINATION TIME, 30"));
    let message = refused(&desk, &["--restart", "other.rsout"]);
    assert!(message.contains("a later TERMINATION TIME lets it go on"), "{message}");
}

#[test]
fn loads_may_change_and_the_balance_still_closes() {
    let desk = written();
    let deck = desk.text("case.i");
    let gone = ["PRESSURE, 300", "PRESCRIBED FORCE", "GRAVITY", "SILENT BC", "PRESCRIBED VELOCITY"];
    let rest = deck.lines().filter(|line| !gone.iter().any(|load| line.starts_with(load)));
    let less: String = rest.map(|line| format!("{line}\n")).collect();
    desk.put("case.i", &less.replace("EXIT", "PRESSURE, 200, 1, 2.E6\nEXIT"));
    for ranks in ["1", "3"] {
        run(&desk, "case.i", &["--restart", "case.rsout", "--ranks", ranks, "-o", &format!("on{ranks}")]).with(0);
    }
    assert_eq!(physics(&desk, "on1.o"), physics(&desk, "on3.o"));
    let results = desk.results("on1.e");
    let last = results.times().len() - 1;
    let place = results.global_names().iter().position(|name| name == "EBAL").expect("the energy error");
    let errors = [0, last].map(|state| results.global(state).expect("globals")[place]);
    // Works of what is gone are several per cent of all; lost ones would show.
    println!("{errors:?}");
    assert!(errors[1].abs() < 1e-4, "{errors:?}");
}
