//! Results as other programs read them: Python's netCDF4, the EXODUS library, and VTK, which is ParaView's reader, where it is
//! installed. `.ci/packages` installs the former two; without one of them, its tests say that they were skipped.

use crate::program::{Desk, box_mesh, project};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use urto::exodus;

/// The interpreter on the PATH need not be the one that the system's packages belong to.
const INTERPRETERS: [&str; 2] = ["python3", "/usr/bin/python3"];

/// Names in the order of the deck below.
const NODAL: [&str; 6] = ["DISPLX", "DISPLY", "DISPLZ", "VELX", "VELY", "VELZ"];
const ELEMENT: [&str; 7] = ["SIGXX", "SIGYY", "SIGZZ", "TAUXY", "TAUYZ", "TAUZX", "EQPS"];

/// What another program found in a file: values by key.
type Seen = BTreeMap<String, Vec<String>>;

/// An elastic block on a plastic one, which hits a wall obliquely: no two nodes move alike.
fn ran() -> Desk {
    let desk = Desk::new();
    desk.put_mesh("two.g", &box_mesh([2, 3, 4], [0.02, 0.03, 0.05], true));
    desk.put(
        "two.i",
        "TITLE\n two blocks\nTERMINATION TIME, 1.E-5\nPLOT TIME, 2.E-6\nPLOT NODAL, VELOCITY\nPLOT ELEMENT, STRESS\n\
         PLOT STATE, EQPS\nMATERIAL, 1, ELASTIC PLASTIC, 7800.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\n\
         YIELD STRESS = 100.E6\nHARDENING MODULUS = 1.E9\nBETA = 1.\nEND\nMATERIAL, 2, ELASTIC, 2700.\n\
         YOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.33\nEND\nNO DISPLACEMENT, Z, 3\n\
         INITIAL VELOCITY MATERIAL, 1, 1., -2., -100.\nINITIAL VELOCITY MATERIAL, 2, 3., 0.5, -100.\nEXIT\n",
    );
    desk.urto(&["two.i", "-q", "--ranks", "2"]).with(0);
    desk
}

/// What a library sees, or why no interpreter could tell.
fn read_with(library: &str, results: &Path) -> Result<Seen, String> {
    let out = run_script("tests/python/read_results.py", &[Path::new(library), results])?;
    Ok(out.lines().filter_map(line).collect())
}

/// What a script prints, or why no interpreter could run it.
fn run_script(script: &str, arguments: &[&Path]) -> Result<String, String> {
    let mut missing = Vec::new();
    for interpreter in INTERPRETERS {
        let left = match Command::new(interpreter).arg(project(script)).args(arguments).output() {
            Err(why) => {
                missing.push(format!("{interpreter}: {why}"));
                continue;
            }
            Ok(left) => left,
        };
        let (out, err) = (String::from_utf8_lossy(&left.stdout), String::from_utf8_lossy(&left.stderr));
        match left.status.code() {
            Some(0) => return Ok(out.into_owned()),
            Some(3) => missing.push(format!("{interpreter}: {}", err.trim())),
            _ => panic!("{interpreter} {script} {arguments:?}:\n{out}{err}"),
        }
    }
    Err(missing.join("; "))
}

fn line(text: &str) -> Option<(String, Vec<String>)> {
    let (key, values) = text.split_once(':')?;
    Some((key.to_string(), values.split_whitespace().map(str::to_string).collect()))
}

/// Tells past the test harness, which hides what passing tests print.
fn skipped(library: &str, why: &str) {
    let _ = writeln!(std::io::stderr(), "SKIPPED: results are not read with {library}: {why}");
}

#[track_caller]
fn same(seen: &Seen, key: &str, expected: &[f64]) {
    let values: Vec<f64> = seen.get(key).into_iter().flatten().map(|v| v.parse().expect("a number")).collect();
    assert_eq!(values, expected, "{key}");
}

/// Holds what was seen against the mesh that the test made and the values that our own reader finds: the same bits.
fn compare(desk: &Desk, seen: &Seen) {
    let mesh = box_mesh([2, 3, 4], [0.02, 0.03, 0.05], true);
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let expected: Vec<f64> = mesh.coordinates.iter().map(|x| x[axis]).collect();
        same(seen, &format!("coordinates {name}"), &expected);
    }
    let results = desk.results("two.e");
    let times = results.times();
    // States stand at the step nearest to the wanted time.
    assert_eq!(times.len(), 6);
    assert!(times.iter().enumerate().all(|(i, t)| (t - 2e-6 * i as f64).abs() < 1e-6), "{times:?}");
    same(seen, "times", times);
    for state in 0..times.len() {
        for name in NODAL {
            same(seen, &format!("{name} {state}"), &results.nodal(name, state).expect("a nodal variable"));
        }
        for name in ["SIGZZ", "TAUXY", "EQPS"] {
            same(seen, &format!("{name} {state}"), &results.element(name, state).expect("an element variable"));
        }
    }
    // And against the deck, which knows nothing of readers: the first velocities are the initial ones.
    let upper_corner: f64 = seen["VELX 0"].last().expect("nodes").parse().expect("a number");
    assert_eq!(upper_corner, 3.0);
    let flows = seen["EQPS 5"].iter().filter(|v| **v != "0.0").count();
    assert!(flows > 0 && flows <= 12, "the lower block of 12 elements flows, the other cannot: {flows}");
}

#[test]
fn netcdf4_reads_our_results() {
    let desk = ran();
    match read_with("netcdf", &desk.path("two.e")) {
        Ok(seen) => {
            assert_eq!(seen["nodal names"], NODAL);
            assert_eq!(seen["element names"], ELEMENT);
            compare(&desk, &seen);
        }
        Err(why) => skipped("netCDF4", &why),
    }
}

#[test]
fn vtk_reads_our_results() {
    let desk = ran();
    match read_with("vtk", &desk.path("two.e")) {
        Ok(seen) => compare(&desk, &seen),
        Err(why) => skipped("VTK", &why),
    }
}

/// More ranks than elements along any axis, and so many that some pieces are empty.
#[test]
fn netcdf4_joins_our_pieces_by_their_numbers() {
    let desk = ran();
    for ranks in [3, 40] {
        desk.urto(&["two.i", "-q", "--split", "--ranks", &ranks.to_string(), "-o", "split"]).with(0);
        let whole = desk.path("two.e");
        let pieces: Vec<_> =
            (0..ranks).map(|rank| exodus::pieces::piece_path(&desk.path("split.e"), ranks, rank)).collect();
        let files: Vec<&Path> = [&whole].into_iter().chain(&pieces).map(|path| path.as_path()).collect();
        match run_script("tests/python/join_pieces.py", &files) {
            // Six variables at 60 nodes at least, seven in 24 elements, in six states.
            Ok(out) => {
                let compared: usize = out.split_whitespace().next().and_then(|n| n.parse().ok()).unwrap_or(0);
                assert!(compared >= 6 * (6 * 60 + 7 * 24), "{out}");
            }
            Err(why) => skipped("netCDF4", &why),
        }
    }
}

/// Histories of blocks, node sets and nodes against sums over full plot states that another program makes from scratch, and
/// the same bits on any number of ranks, split or not.
#[test]
fn histories_are_sums_over_full_states() {
    let desk = ran();
    let deck = desk.text("two.i").replace("PLOT TIME, 2.E-6\nPLOT NODAL, VELOCITY\nPLOT ELEMENT, STRESS\n", "");
    let asked = "PLOT TIME, 1.E-6\nHISTORY TIME, 1.E-6\nPLOT NODAL, VELOCITY, REACTION\nPLOT ELEMENT, ENERGY\n\
         PLOT GLOBAL, BLOCK ENERGY\nHISTORY, BLOCK\nHISTORY, NODE SET, 3, 1\nHISTORY, NODE, 7, 31\nEXIT\n";
    desk.put("watch.i", &deck.replace("EXIT\n", asked));
    desk.put_mesh("watch.g", &box_mesh([2, 3, 4], [0.02, 0.03, 0.05], true));
    desk.urto(&["watch.i", "-q", "--ranks", "1"]).with(0);
    let values = |name: &str| {
        let file = desk.results(name);
        let states = 0..file.times().len();
        states.flat_map(|s| file.global(s).expect("a state")).map(f64::to_bits).collect::<Vec<_>>()
    };
    let bits = values("watch.h");
    for more in [&["--ranks", "2"][..], &["--ranks", "5", "--split"]] {
        desk.urto(&[&["watch.i", "-q", "-o", "more"], more].concat()).with(0);
        assert_eq!(values("more.h"), bits, "{more:?}");
    }
    let (plot, history) = (desk.path("watch.e"), desk.path("watch.h"));
    let arguments = [plot.as_path(), history.as_path(), Path::new("7800"), Path::new("2700")];
    match run_script("tests/python/sum_histories.py", &arguments) {
        // Eleven states of 20 variables of two blocks and 12 of two sets and two nodes.
        Ok(out) => {
            let compared: usize = out.split_whitespace().next().and_then(|n| n.parse().ok()).unwrap_or(0);
            assert!(compared >= 11 * (2 * 18 + 4 * 12), "{out}");
        }
        Err(why) => skipped("netCDF4", &why),
    }
}

/// A block strikes two others obliquely, with friction, and one of these lies on a floor.
const STRIKES: &str = "TITLE\n a block strikes two\nTERMINATION TIME, 30.E-6\nPLOT TIME, 1.E-6\nHISTORY TIME, 1.E-6\n\
     OUTPUT TIME, 1.E-6\nPLOT NODAL, VELOCITY\nPLOT GLOBAL, BLOCK ENERGY\nHISTORY, CONTACT, 1, 2\nHISTORY, CONTACT, 1, 3\n\
     HISTORY, CONTACT, 1\nHISTORY, CONTACT, 2, 1\nHISTORY, RIGID SURFACE, 100\nCONTACT MATERIAL\nCONTACT DATA, ALL, ALL, 0.3\n\
     RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.2\nINITIAL VELOCITY MATERIAL, 1, 30., 10., -60.\n\
     MATERIAL, 1, ELASTIC, 7800.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n\
     MATERIAL, 2, ELASTIC, 7800.\nYOUNGS MODULUS = 100.E9\nPOISSONS RATIO = 0.3\nEND\n\
     MATERIAL, 3, ELASTIC, 7800.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.2\nEND\nEXIT\n";

/// Momentum and energy of blocks that strike each other and a floor against what contact is said to do to them, by another program;
/// and the same bits on any number of ranks, split or not, and after a restart.
#[test]
fn contact_forces_change_momentum_and_works_change_energy() {
    let desk = Desk::new();
    desk.put("strikes.i", STRIKES);
    desk.put(
        "strikes.mesh",
        "BOX, 2, 0., 0., 0., 0.02, 0.02, 0.01, 4, 4, 2\nBOX, 3, 0.021, 0., 0.0005, 0.02, 0.02, 0.0095, 3, 3, 2\n\
         BOX, 1, 0.007, 0.004, 0.0101, 0.02, 0.01, 0.01, 5, 3, 3\nSIDE SET FACE, 100, 2, BOTTOM\n",
    );
    desk.urto(&["mesh", "strikes.mesh", "-o", "strikes.g"]).with(0);
    desk.urto(&["strikes.i", "-q", "--ranks", "1"]).with(0);
    let values = |name: &str| {
        let file = desk.results(name);
        let states = 0..file.times().len();
        states.flat_map(|s| file.global(s).expect("a state")).map(f64::to_bits).collect::<Vec<_>>()
    };
    let bits = values("strikes.h");
    for more in [&["--ranks", "2"][..], &["--ranks", "5", "--split"]] {
        desk.urto(&[&["strikes.i", "-q", "-o", "more"], more].concat()).with(0);
        assert_eq!(values("more.h"), bits, "{more:?}");
    }
    // The state in the middle is no plot state: sums, impulses and times of the last one are carried.
    desk.put("first.i", &STRIKES.replace("PLOT TIME", "WRITE RESTART, 10.3E-6, 9\nPLOT TIME"));
    desk.urto(&["first.i", "-q", "-m", "strikes.g", "--ranks", "3"]).with(0);
    desk.put("second.i", &STRIKES.replace("PLOT TIME", "READ RESTART, 10.3E-6\nPLOT TIME"));
    desk.urto(&["second.i", "-q", "-m", "strikes.g", "--ranks", "2", "--restart", "first.rsout"]).with(0);
    let again = values("second.h");
    assert!(bits.ends_with(&again[again.len() / 3..]) && again.len() > 10, "{} {}", again.len(), bits.len());
    let (plot, history) = (desk.path("strikes.e"), desk.path("strikes.h"));
    match run_script("tests/python/contact_histories.py", &[plot.as_path(), history.as_path(), Path::new("7800")]) {
        Ok(out) => {
            let compared: usize = out.split_whitespace().next().and_then(|n| n.parse().ok()).unwrap_or(0);
            assert!(compared >= 31 * (5 * 3 + 7), "{out}");
        }
        Err(why) => skipped("netCDF4", &why),
    }
}

/// By the calls of programs that join pieces: load balance, maps, and what pieces share.
#[test]
fn the_exodus_library_finds_what_our_pieces_share() {
    let desk = ran();
    for ranks in [3, 40] {
        desk.urto(&["two.i", "-q", "--split", "--ranks", &ranks.to_string(), "-o", "shared"]).with(0);
        let pieces: Vec<_> =
            (0..ranks).map(|rank| exodus::pieces::piece_path(&desk.path("shared.e"), ranks, rank)).collect();
        let files: Vec<&Path> = pieces.iter().map(|path| path.as_path()).collect();
        match run_script("tests/python/nemesis_pieces.py", &files) {
            // The 24 elements and 60 nodes, and those that several pieces have.
            Ok(out) => {
                let compared: usize = out.split_whitespace().next().and_then(|n| n.parse().ok()).unwrap_or(0);
                assert!(compared > 24 + 60, "{out}");
            }
            Err(why) => skipped("the EXODUS library", &why),
        }
    }
}
