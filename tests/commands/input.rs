//! Input that is not what it seems, and outputs that cannot be what they should: every one is answered with a message and
//! an exit code, soon, and no file is lost.

use crate::program::{Desk, Left, bar_deck, box_mesh, project, put_bar, wait_for};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use urto::exodus::Results;

const SOON: f64 = 1e-5;
/// Everything here ends at once; what does not by then never will.
const PATIENCE: Duration = Duration::from_secs(100);

/// Runs the program, and ends it when it does not end by itself.
fn urto_in_time(desk: &Desk, arguments: &[&str]) -> Left {
    let mut child = desk.start(arguments);
    let begun = Instant::now();
    while child.try_wait().expect("a process").is_none() {
        if begun.elapsed() > PATIENCE {
            child.kill().expect("a process");
            panic!("urto {} does not end", arguments.join(" "));
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    Left::of(child.wait_with_output().expect("its words"))
}

/// A folder with a bar, its recipe, and a deck of that.
fn desk_with_a_recipe() -> Desk {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    desk.put("r.mesh", "{include(\"r.inc\")}\n");
    desk.put("r.inc", "BOX, 1, 0., 0., 0., 1., 1., 2., 1, 1, 2\n");
    desk.put("r.i", &bar_deck(SOON, ""));
    desk
}

/// Files and their texts, of which none may change.
fn contents(desk: &Desk) -> Vec<(std::path::PathBuf, Vec<u8>)> {
    let files = std::fs::read_dir(desk.path(".")).expect("a folder").map(|entry| entry.expect("a file").path());
    let mut contents: Vec<_> =
        files.filter(|path| path.is_file()).map(|path| (path.clone(), std::fs::read(path).expect("a file"))).collect();
    contents.sort();
    contents
}

/// A second run of the same base would destroy the results of both; a killed one is in nobody's way.
#[test]
#[cfg(unix)]
fn two_runs_do_not_write_the_same_results() {
    let desk = Desk::new();
    put_bar(&desk, 1e3, "OUTPUT TIME, 1.\n");
    let mut first = desk.start(&["bar.i", "--ranks", "1"]);
    assert!(wait_for(|| desk.has("bar.lock") && desk.has("bar.o") && desk.has("bar.e")), "the run does not begin");
    let words = ["another run is writing bar.o", "another base with -o", "bar.lock"];
    desk.urto(&["bar.i", "--ranks", "1", "--summary", "s.json"]).with(2).says(&words);
    desk.urto(&["bar.i", "--ranks", "2", "--split"]).with(2).says(&words);
    assert!(desk.has("bar.lock") && !desk.has("bar.o.1") && !desk.has("s.json"));
    put_bar(&desk, SOON, "");
    desk.urto(&["bar.i", "--ranks", "1", "-o", "other"]).with(0);
    first.kill().expect("a process");
    first.wait().expect("its end");
    desk.urto(&["bar.i", "--ranks", "1"]).with(0);
    assert!(desk.has("bar.o.1") && !desk.has("bar.lock") && !desk.has("other.lock"));
}

#[test]
#[cfg(unix)]
fn no_output_takes_the_place_of_a_device() {
    use std::os::unix::fs::FileTypeExt;
    use std::os::unix::net::UnixListener;
    let desk = desk_with_a_recipe();
    put_bar(&desk, SOON, "");
    desk.urto(&["bar.i", "-q", "--ranks", "2", "--split"]).with(0);
    // Anybody can make a socket; to what a device is, programs have no other right than the superuser's.
    let _open = UnixListener::bind(desk.path("socket")).expect("a socket");
    let words = ["cannot write socket", "a pipe, a socket or a device, not a file"];
    desk.urto(&["mesh", "r.mesh", "-o", "socket"]).with(1).says(&words);
    desk.urto(&["join", "bar.e", "-o", "socket"]).with(1).says(&words);
    let kind = std::fs::metadata(desk.path("socket")).expect("still there").file_type();
    assert!(kind.is_socket() && !desk.has("socket.part"));
}

#[test]
#[cfg(unix)]
fn no_output_is_written_over_an_input() {
    use std::os::unix::fs::symlink;
    let desk = desk_with_a_recipe();
    desk.put("deck.e", &bar_deck(SOON, ""));
    desk.put("deck.shutdown", &bar_deck(SOON, ""));
    desk.put("deck.o", &bar_deck(SOON, ""));
    desk.put("top.i", "{include(\"top.e\")}");
    desk.put("top.e", &bar_deck(SOON, ""));
    std::fs::copy(desk.path("bar.g"), desk.path("me.e")).expect("a copy");
    std::fs::copy(desk.path("bar.g"), desk.path("mine.e.part")).expect("a copy");
    std::fs::copy(desk.path("bar.g"), desk.path("picture.png")).expect("a copy");
    std::fs::hard_link(desk.path("bar.g"), desk.path("hard.e")).expect("a link");
    std::fs::hard_link(desk.path("r.inc"), desk.path("hard.g")).expect("a link");
    symlink("bar.g", desk.path("soft.e")).expect("a link");
    symlink("r.mesh", desk.path("soft.g")).expect("a link");
    std::fs::create_dir(desk.path("sub")).expect("a folder");
    desk.put("data.csv", "0, 1\n1, 2\n");
    let before = contents(&desk);
    for (arguments, words) in [
        (&["mesh", "r.mesh", "-o", "r.mesh"][..], "r.mesh is the recipe, and would be written over"),
        (&["mesh", "r.mesh", "-o", "./sub/../r.mesh"], "is the recipe r.mesh"),
        (&["mesh", "r.mesh", "-o", "soft.g"], "soft.g is the recipe r.mesh"),
        (&["mesh", "r.mesh", "-o", "hard.g"], "hard.g is the recipe r.inc"),
        (&["mesh", "r.mesh", "-o", "r.inc"], "r.inc is the recipe"),
        (&["deck.e", "-m", "bar.g"], "deck.e is the deck"),
        (&["deck.o", "-m", "bar.g"], "deck.o is the deck"),
        (&["deck.shutdown", "-m", "bar.g"], "deck.shutdown is the deck"),
        (&["top.i", "-m", "bar.g"], "top.e is the deck"),
        (&["bar.i", "-m", "me.e", "-o", "me"], "me.e is the mesh"),
        (&["bar.i", "-m", "mine.e.part", "-o", "mine"], "mine.e.part is the mesh"),
        (&["bar.i", "-o", "soft"], "soft.e is the mesh bar.g"),
        (&["bar.i", "-o", "hard"], "hard.e is the mesh bar.g"),
        (&["r.i", "-m", "r.mesh", "-o", "r.mesh", "-q", "--ranks", "1", "--split", "--restart", "r.mesh"], "r.mesh"),
        (&["view", "picture.png"], "picture.png is the file to draw"),
        (&["view", "bar.g", "-o", "picture.png", "--animate"], "no states"),
        (
            &["plot", "me.e", "-v", "KE", "--reference", "data.csv", "--csv", "-o", "data.csv"],
            "data.csv is the reference",
        ),
        (&["scale", "bar.i", "--ranks", "1", "--csv", "bar.i"], "bar.i is the deck"),
        (&["scale", "bar.i", "--ranks", "1", "--csv", "bar.g"], "bar.g is the mesh"),
        (&["scale", "r.i", "--ranks", "1", "--csv", "r.inc"], "r.inc is the recipe of the mesh"),
    ] {
        let left = desk.urto(arguments).with(2);
        left.says(&[words]);
        assert!(contents(&desk) == before, "urto {} changes files", arguments.join(" "));
    }
    // Outputs of their own names do no harm, and old results are replaced.
    desk.urto(&["mesh", "r.mesh", "-o", "r.g"]).with(0);
    desk.urto(&["mesh", "r.mesh", "-o", "r.g"]).with(0);
    desk.urto(&["bar.i", "-q", "--split", "--ranks", "2"]).with(0);
    desk.urto(&["join", "bar.e", "-o", "bar.e.2.1"]).with(2).says(&["bar.e.2.1 is one of the pieces"]);
    desk.urto(&["join", "bar.e"]).with(0);
    desk.urto(&["join", "bar.e"]).with(0);
}

/// A run that begins anew leaves nothing of older runs beside its results that would be taken for a part of them.
#[test]
fn results_of_old_runs_do_not_stay_beside_new_ones() {
    let desk = Desk::new();
    let there = |name: &str| desk.path(name).exists();
    put_bar(&desk, SOON, "WRITE RESTART, 5.E-6\n");
    desk.urto(&["bar.i", "-q", "--ranks", "2"]).with(0);
    desk.put("bar.i", &bar_deck(2.0 * SOON, "WRITE RESTART, 5.E-6\nREAD RESTART\n"));
    desk.urto(&["bar.i", "-q", "--ranks", "2"]).with(0);
    assert!(there("bar.e") && there("bar.e-s0002"));
    // Pictures of the first part say that another follows; a report has the end of the last.
    desk.urto(&["view", "bar.e"]).with(0).says(&["bar.e goes on in bar.e-s0002"]);
    desk.urto(&["report", "bar"]).with(0);
    let end = urto::output::print::scientific(2.0 * SOON, 4);
    assert!(desk.text("bar.html").contains(&end), "the report ends at {end}");
    desk.put("bar.i", &bar_deck(SOON, ""));
    desk.urto(&["bar.i", "-q", "--ranks", "2", "--split"]).with(0);
    assert!(!there("bar.e") && !there("bar.e-s0002") && there("bar.e.2.0"));
    desk.urto(&["bar.i", "-q", "--ranks", "3", "--split"]).with(0);
    assert!(!there("bar.e.2.0") && there("bar.e.3.0"));
    desk.urto(&["bar.i", "-q", "--ranks", "2"]).with(0);
    assert!(there("bar.e") && !there("bar.e.3.0"));
}

/// A continued run tells in its histories where their first interval begins, the state that was due last, and in its plot states where it
/// goes on, which is later: each file its own time, once.
#[test]
fn parts_of_a_run_tell_where_they_begin() {
    let desk = Desk::new();
    let asks = "WRITE RESTART, 1.E-6\nHISTORY BLOCK, 1\nHISTORY TIME, 3.E-6\nPLOT TIME, 3.E-6\n";
    put_bar(&desk, SOON, asks);
    desk.urto(&["bar.i", "-q"]).with(0);
    desk.put("bar.i", &bar_deck(2.0 * SOON, &format!("{asks}READ RESTART\n")));
    desk.urto(&["bar.i", "-q"]).with(0);
    let told = |name: &str| -> f64 {
        let lines = Results::open(&desk.path(name)).expect("results").info();
        let since: Vec<&str> = lines.iter().filter_map(|line| line.strip_prefix("$ MEANS SINCE: ")).collect();
        assert_eq!(since.len(), 1, "{name}: {since:?}");
        since[0].trim().parse().expect("a time")
    };
    let [history, plot] = ["bar.h-s0002", "bar.e-s0002"].map(told);
    let due = Results::open(&desk.path("bar.h")).expect("a history").times().to_vec();
    let last = due.iter().copied().filter(|time| *time <= plot).fold(0.0, f64::max);
    assert!(history == last && history < plot, "histories since {history}, last due at {last}, goes on at {plot}");
}

#[test]
fn a_restart_file_is_not_written_over_by_results() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "WRITE RESTART, 5.E-6\n");
    desk.urto(&["bar.i", "-q"]).with(0);
    std::fs::copy(desk.path("bar.rsout"), desk.path("again.o")).expect("a copy");
    desk.put("bar.i", &bar_deck(2.0 * SOON, "WRITE RESTART, 5.E-6\n"));
    desk.urto(&["bar.i", "-q", "--restart", "again.o", "-o", "again"]).with(2).says(&["again.o is the restart file"]);
    // Its own restart states are what a run that goes on replaces.
    desk.urto(&["bar.i", "-q", "--restart", "bar.rsout"]).with(0);
}

#[test]
fn a_run_that_cannot_end_is_refused() {
    let desk = Desk::new();
    put_bar(&desk, 1e9, "");
    desk.urto(&["check", "bar.i"]).with(2).says(&["would not come to an end", "TERMINATION TIME", "help: "]);
    desk.urto(&["bar.i", "-q", "--ranks", "2"]).with(2).says(&["would not come to an end"]);
    put_bar(&desk, SOON, "TIME STEP SCALE, 1.E-20\n");
    desk.urto(&["bar.i", "-q"]).with(2).says(&["would not come to an end", "TIME STEP SCALE"]);
}

#[test]
#[cfg(unix)]
fn pipes_devices_and_folders_are_not_waited_for() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    for name in ["pipe", "pipe.mesh", "pipe.i"] {
        assert!(Command::new("mkfifo").arg(desk.path(name)).status().expect("mkfifo").success());
    }
    std::os::unix::fs::symlink("/dev/zero", desk.path("zero.mesh")).expect("a link");
    desk.put("include.i", "{include(\"pipe\")}\n");
    desk.put("zero.i", "{include(\"zero.mesh\")}\n");
    let no_file = "a pipe, a socket or a device, not a file";
    for (arguments, words) in [
        (&["pipe.i"][..], "there is no deck pipe.i"),
        (&["check", "/dev/zero"], "there is no deck /dev/zero"),
        (&["check", "bar.i", "-m", "pipe"], no_file),
        (&["check", "bar.i", "-m", "pipe.mesh"], no_file),
        (&["check", "bar.i", "-m", "zero.mesh"], no_file),
        (&["check", "bar.i", "-m", "/dev/zero"], no_file),
        (&["check", "bar.i", "-m", "."], "a folder, not a file"),
        (&["check", "include.i", "-m", "bar.g"], no_file),
        (&["check", "zero.i", "-m", "bar.g"], no_file),
        (&["mesh", "pipe"], no_file),
        (&["view", "pipe"], no_file),
        (&["diff", "bar.g", "pipe"], no_file),
        (&["bar.i", "--restart", "pipe"], no_file),
    ] {
        let left = urto_in_time(&desk, arguments).with(2);
        left.says(&[words]);
    }
}

#[test]
fn rubbish_is_given_up_on_after_a_hundred_messages() {
    let desk = Desk::new();
    let mesh = box_mesh([1, 1, 2], [1.0; 3], false);
    for (name, line, count) in [
        ("unknown.i", "COMMANDO, 1, 2\n", 300_000),
        ("numbers.i", "1 2 3\n", 300_000),
        ("braces.i", "{\n", 300_000),
        ("ends.i", "{endif}\n", 100_000),
        ("undefined.i", "{x} {y}\n", 100_000),
        ("choices.i", "PLOT NODAL, FORCE\n", 100_000),
    ] {
        desk.put(name, &line.repeat(count));
        desk.put_mesh(&name.replace(".i", ".g"), &mesh);
        let left = urto_in_time(&desk, &["check", name]).with(2);
        assert!(left.err.len() < 100_000, "{name}: {} bytes of messages", left.err.len());
    }
    desk.urto(&["check", "unknown.i"]).says(&["line 101 and those after it are not read", "100 errors"]);
    let group = format!("{}MATERIAL, 2, ELASTIC, 1.\n{}END\n", bar_deck(SOON, ""), "STIFFNESS = 1.\n".repeat(100_000));
    desk.put("group.i", &group.replace("EXIT\n", ""));
    desk.put_mesh("group.g", &mesh);
    urto_in_time(&desk, &["check", "group.i"]).with(2).says(&["STIFFNESS"]);
}

#[test]
#[cfg(target_os = "linux")]
fn words_that_are_lost_show_in_the_exit_code() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").expect("the device that is full");
    for arguments in [&["explain"][..], &["check", "bar.i"], &["generate", "man"], &["--help"], &["run", "bar.i"]] {
        let output = desk.command(arguments).stdout(full()).stderr(Stdio::piped()).output().expect("it starts");
        let left = Left::of(output).with(1);
        left.says(&["cannot write to the standard output: No space left on device"]);
        assert!(!left.err.contains("panicked"), "{}", left.err);
    }
    // With nobody to complain to.
    let status = desk.command(&["check", "bar.i"]).stdout(full()).stderr(full()).status().expect("it starts");
    assert_eq!(status.code(), Some(1));
    let table = desk.urto(&["scale", "bar.i", "--ranks", "1", "--steps", "1", "--csv", "/dev/full"]);
    table.with(1).says(&["/dev/full", "No space left"]);
    std::os::unix::fs::symlink("/dev/full", desk.path("full.png")).expect("a link");
    desk.urto(&["view", "bar.g", "-o", "full.png"]).with(1).says(&["cannot write full.png: No space left"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_folder_that_cannot_be_written_is_called_so() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    // Not even the administrator makes files there.
    desk.urto(&["bar.i", "-q", "-o", "/sys/bar"]).with(1).says(&["cannot write into the folder /sys"]);
    desk.urto(&["view", "bar.g", "-o", "/sys/bar.png"]).with(1).says(&["cannot write /sys/bar.png"]);
    desk.urto(&["view", "bar.g", "-o", "none/bar.png"]).with(1).says(&["cannot write none/bar.png"]);
}

#[test]
#[cfg(unix)]
fn files_that_may_not_grow_are_a_message() {
    let desk = desk_with_a_recipe();
    for arguments in ["mesh r.mesh --refine 20 -o large.g", "view bar.g -o large.png", "run bar.i --quiet"] {
        let script = format!("ulimit -f 2; exec '{}' {arguments}", crate::program::URTO);
        let output = Command::new("sh").args(["-c", &script]).current_dir(desk.path(".")).output().expect("sh");
        Left::of(output).with(1).says(&["error: ", "File too large"]);
    }
}

#[test]
fn carriage_returns_alone_end_lines() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    desk.put("old.i", &bar_deck(SOON, "$ {x = 1}\nPLOT TIME, {x}\n").replace('\n', "\r"));
    desk.urto(&["old.i", "-q", "-m", "bar.g"]).with(0);
    desk.put("wrong.i", &bar_deck(SOON, "PRESURE, 1, 1\n").replace('\n', "\r"));
    desk.urto(&["check", "wrong.i", "-m", "bar.g"]).with(2).says(&["wrong.i:9:1", "9 | PRESURE, 1, 1\n"]);
}

#[test]
fn damaged_hdf5_files_are_refused() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    for name in ["damaged_panic.g", "damaged_crash_1.g", "damaged_crash_2.g"] {
        let file = project("tests/fixtures").join(name).display().to_string();
        for arguments in [&["check", "bar.i", "-m", &file][..], &["view", &file], &["diff", &file, "bar.g"]] {
            let left = urto_in_time(&desk, arguments).with(2);
            left.says(&[name, "the HDF5 library fails on it", "help: the file is damaged"]);
            assert!(!left.err.contains("panicked"), "{}", left.err);
        }
    }
    let sound = project("tests/fixtures/netcdf4_compressed.g").display().to_string();
    desk.urto(&["view", &sound]).with(0);
}

#[test]
fn a_piece_is_not_taken_for_the_whole() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    desk.urto(&["bar.i", "-q", "--split", "--ranks", "2", "-o", "cut"]).with(0);
    let left = desk.urto(&["check", "bar.i", "-m", "cut.e.2.0"]).with(2);
    left.says(&["cut.e.2.0: this is one of the 2 pieces", "urto join cut.e", "epu"]);
    // A piece can be looked at all the same.
    desk.urto(&["view", "cut.e.2.0", "-o", "piece.png"]).with(0);
}

#[test]
fn blocks_and_sets_may_be_number_zero() {
    let desk = Desk::new();
    let mut mesh = box_mesh([2, 2, 8], [0.01, 0.01, 0.04], false);
    mesh.blocks[0].id = 0;
    mesh.node_sets[0].id = 0;
    mesh.side_sets[0].id = 0;
    mesh.node_ids = (0..mesh.node_ids.len() as i64).collect();
    mesh.element_ids = (0..mesh.element_ids.len() as i64).collect();
    desk.put_mesh("bar.g", &mesh);
    let loads = "NO DISPLACEMENT, X, 0\nRIGID SURFACE, 0, 0., 0., -1., 0., 0., 1.\nCONTACT MATERIAL, 0\n\
                 DEATH, 0, VOLUME, MIN, 0.1\nPLOT NODAL, CONTACT\n";
    desk.put("bar.i", &bar_deck(SOON, loads).replace("MATERIAL, 1,", "MATERIAL, 0,"));
    desk.urto(&["bar.i", "-q", "--ranks", "3"]).with(0);
    assert_eq!(desk.results("bar.e").mesh().expect("a mesh").blocks[0].id, 0);
    desk.put("bar.i", &bar_deck(SOON, loads).replace("MATERIAL, 1,", "MATERIAL, -1,"));
    desk.urto(&["bar.i", "-q"]).with(2).says(&["it must be 0 or more, as the number of every block is"]);
}

/// Beams along the vector of their section, or nearly: 1e-4 of it across them is a sine of 1e-4. One of 0.01 says where y is.
#[test]
fn vectors_along_beams_are_refused() {
    let desk = Desk::new();
    desk.put("case.mesh", "TITLE\n column\nLINE, 1, 0., 0., 0., 1., 0., 0., 2\nLINE, 1, 1., 0., 0., 1., 0., 3., 4\n");
    let deck = |vector: &str| {
        format!(
            "TITLE\n column\nTERMINATION TIME, 1.E-6\nBEAM SECTION, 1, RECTANGLE, 0.1, 0.2, , , {vector}\nMATERIAL, 1, ELASTIC, 7800.\n\
             YOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\nEXIT\n"
        )
    };
    for vector in ["0., 0., 1.", "1.E-4, 0., 1.", "0., 0., -5."] {
        desk.put("case.i", &deck(vector));
        for arguments in [&["check", "case.i"][..], &["case.i", "-q"]] {
            let told = desk.urto(arguments).with(2);
            let words = "block 1: BEAM SECTION: the vector lies along beam 3, and 3 more";
            assert!(told.err.contains(words) && told.err.contains("such as 1.0, 0.0, 0.0"), "{}", told.err);
        }
    }
    for vector in ["0.01, 0., 1.", "0., 1., 0."] {
        desk.put("case.i", &deck(vector));
        desk.urto(&["check", "case.i"]).with(0);
    }
}
