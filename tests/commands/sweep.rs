//! Studies, summaries and meshes made finer: what a script builds on.

use crate::program::{Desk, URTO, put_bar};
use serde_json::Value;

/// A box in n x 2 x 2 elements that flies, and takes its speed, stiffness and length from expressions.
fn put_box(desk: &Desk, more: &str) {
    desk.put("box.mesh", "TITLE\n A CUBE\nBOX, 1, 0., 0., 0., 1., 1., 1., {n = 2}, 2, 2\nNODE SET PLANE, 1, X, 0.\n");
    desk.put(
        "box.i",
        &format!(
            "TITLE\n A BOX THAT STRIKES\nTERMINATION TIME, 1.E-2\nPLOT TIME, 1.E-3\nHISTORY TIME, 1.E-4\nOUTPUT TIME, 1.E-3\n\
             PLOT NODAL, VELOCITY\nHISTORY, BLOCK, 1\nNO DISPLACEMENT, X, 1\n\
             INITIAL VELOCITY MATERIAL, 1, {{speed = 10.}}, 0., 0.\n{more}\
             MATERIAL, 1, ELASTIC, 2700.\nYOUNGS MODULUS = {{modulus = 1.E11}}\nPOISSONS RATIO = 0.\nEND\nEXIT\n"
        ),
    );
}

fn json(desk: &Desk, name: &str) -> Value {
    serde_json::from_str(&desk.text(name)).expect("JSON")
}

#[test]
fn a_summary_has_what_a_script_wants_to_know() {
    let desk = Desk::new();
    put_box(&desk, "");
    let run = ["run", "box.i", "-q", "-D", "speed=20", "--refine", "2", "--summary", "out/s.json", "-o", "out/box"];
    desk.urto(&run).with(0);
    let found = json(&desk, "out/s.json");
    assert_eq!((found["ended"].as_str(), found["exit_code"].as_u64()), (Some("complete"), Some(0)));
    assert_eq!((found["elements"].as_u64(), found["refine"].as_u64()), (Some(64), Some(2)));
    assert_eq!(found["parameters"]["speed"], "20");
    let log = desk.text("out/box.o");
    let line = log.lines().find(|line| line.contains("TIME STEPS TAKEN")).expect("the closing table");
    assert!(line.ends_with(&found["steps"].to_string()), "{line}");
    // Half of the mass times the square of the speed: nodes that are held do not move.
    let kinetic = &found["globals"]["KE"];
    assert!(kinetic["greatest"].as_f64().is_some_and(|most| most > 0.7 * 0.5 * 2700.0 * 400.0));
    assert_eq!(kinetic["greatest_at"].as_f64(), Some(0.0));
    assert!(found["histories"].as_object().is_some_and(|all| all.len() > 10));
    assert!(found["energy_error"].as_f64().is_some_and(|error| error.abs() < 0.05));
    assert_eq!(found["warnings"].as_array().map(Vec::len), Some(0));
    assert!(found["seconds"]["sections"]["ELEMENTS"].as_f64().is_some());
    // A mesh file is not made anew.
    desk.urto(&["mesh", "box.mesh", "-o", "box.g"]).with(0);
    desk.urto(&["run", "box.i", "--refine", "2"]).with(2).says(&["is a mesh file", "urto refine box.g"]);
    desk.urto(&["run", "box.i", "--summary", "box.i"]).with(2).says(&["box.i is the deck"]);
    desk.urto(&["run", "box.i", "--summary", "box.o"]).with(2).says(&["box.o is a file of the results"]);
}

#[test]
fn the_summary_of_a_run_that_failed_says_why() {
    let desk = Desk::new();
    put_box(&desk, "TIME STEP SCALE, 3.\n");
    desk.urto(&["run", "box.i", "-q", "--summary", "s.json"]).with(1);
    let found = json(&desk, "s.json");
    assert_eq!((found["ended"].as_str(), found["exit_code"].as_u64()), (Some("failed"), Some(1)));
    assert!(found["reason"].as_str().is_some_and(|reason| reason.contains("stopped at step")), "{found}");
    assert_eq!(found["warnings"][0]["step"], Value::Null, "the warning of the deck comes first: {found}");
}

/// A run that cannot write says how far it had come; one that cannot begin says nothing of it.
#[test]
#[cfg(unix)]
fn the_summary_of_a_run_that_cannot_write_says_how_far_it_came() {
    let desk = Desk::new();
    put_bar(&desk, 1e-3, "PLOT TIME, 1.E-7\nPLOT NODAL, VELOCITY\n");
    // A limit on the size of files stands for the full disk.
    let line = "ulimit -f 200; exec \"$0\" run bar.i -q --ranks 1 --summary s.json";
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", line, URTO]).current_dir(desk.path("."));
    assert_eq!(shell.output().expect("a shell").status.code(), Some(1));
    let found = json(&desk, "s.json");
    assert!(found["reason"].as_str().is_some_and(|reason| reason.contains("bar.e")), "{found}");
    assert!(found["steps"].as_u64().is_some_and(|steps| steps > 0), "{found}");
    assert!(found["time"].as_f64().is_some_and(|time| time > 0.0), "{found}");
    std::fs::create_dir(desk.path("folder.e")).expect("a folder");
    desk.urto(&["run", "bar.i", "-q", "-o", "folder", "--summary", "s.json"]).with(1);
    let found = json(&desk, "s.json");
    assert_eq!((&found["steps"], &found["time"]), (&Value::Null, &Value::Null), "{found}");
}

#[test]
fn a_study_runs_all_combinations_once_and_goes_on_where_one_fails() {
    let desk = Desk::new();
    put_box(&desk, "{if (speed > 25)}\nTIME STEP SCALE, 3.\n{endif}\n");
    let study = ["sweep", "box.i", "-D", "speed=10:30:10", "-D", "n=2,3", "-v", "KE,VELX_BLOCK1", "--filter", "CFC60"];
    let left = desk.urto(&study).with(1);
    left.says(&["6 runs", "error: speed=30 n=2 has failed", "error: speed=30 n=3 has failed"]);
    assert_eq!(left.err.matches("has failed").count(), 2);
    let table = desk.text("box_sweep/table.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 7);
    assert_eq!(rows[0][..7], ["speed", "n", "ended", "steps", "energy error", "warnings", "KE last"]);
    assert_eq!((rows[0][13], rows[0].len()), ("VELX_BLOCK1 filtered peak", 14));
    assert_eq!([rows[1][2], rows[4][2], rows[5][2]], ["complete", "complete", "failed"]);
    // Twice the speed is four times the energy: the body is elastic, and moves little.
    let peak = |row: usize| rows[row][7].parse::<f64>().expect("a number");
    assert!((peak(3) / peak(1) - 4.0).abs() < 1e-12 && rows[1][8] == "0e0");
    assert!(desk.has("box_sweep/KE.png") && desk.has("box_sweep/VELX_BLOCK1.png"));
    assert_eq!(json(&desk, "box_sweep/speed=20,n=3/summary.json")["elements"].as_u64(), Some(12));

    // A second time only what failed runs; after a change of the recipe everything does.
    desk.urto(&study).with(1).says(&["6 runs, 4 of them done before", "2 of 2"]);
    let cut = desk.path("box_sweep/speed=20,n=3/box.e");
    let whole = std::fs::read(&cut).expect("results");
    for bytes in [Some(&whole[..whole.len() / 2]), None] {
        bytes
            .map_or_else(|| std::fs::remove_file(&cut), |bytes| std::fs::write(&cut, bytes))
            .expect("it may be changed");
        desk.urto(&study).with(1).says(&["its results are cut or gone", "delete the folder box_sweep/speed=20,n=3 "]);
    }
    std::fs::write(&cut, whole).expect("it may be changed");
    std::thread::sleep(std::time::Duration::from_millis(20));
    desk.put("box.mesh", &(desk.text("box.mesh") + "$ changed\n"));
    let left = desk.urto(&["sweep", "box.i", "-D", "speed=10,20", "-D", "n=2,3", "-j", "2"]).with(0);
    left.says(&["4 runs, 2 at a time", "4 of 4"]);
}

#[test]
fn a_study_that_cannot_be_is_refused_before_anything_runs() {
    let desk = Desk::new();
    put_box(&desk, "");
    let refused = |values: &[&str], words: &str| {
        let defined: Vec<&str> = values.iter().flat_map(|value| ["-D", value]).collect();
        desk.urto(&[&["sweep", "box.i"], &defined[..]].concat()).with(2).says(&[words]);
        assert!(!desk.has("box_sweep"));
    };
    refused(&["speed=1:2"], "a range has three numbers");
    refused(&["sped=1,2"], "-D gives a value to sped");
    refused(&["speed=1,1"], "it is there twice");
    refused(&["speed=1:1e6:1", "n=1:9:1"], "ten thousand");
}

/// The same solid on a mesh made finer in either way: by the recipe, and element by element.
#[test]
fn a_divided_mesh_is_the_same_body() {
    let desk = Desk::new();
    put_box(&desk, "");
    desk.urto(&["mesh", "box.mesh", "-o", "box.g"]).with(0);
    desk.urto(&["refine", "box.g", "-o", "fine.g"]).with(0).says(&["fine.g: 125 nodes, 64 elements", "27 nodes, 8"]);
    desk.urto(&["refine", "fine.g"]).with(0).says(&["fine_fine.g: ", "512 elements"]);
    for (mesh, more, output) in [("fine.g", "1", "a"), ("box.mesh", "2", "b")] {
        desk.urto(&["run", "box.i", "-q", "-m", mesh, "--refine", more, "-o", output]).with(0);
    }
    // Node numbers differ, and with them the order of sums.
    let last = |name: &str| desk.results(name).global_history("KE").expect("energies");
    let pairs = last("a.e").into_iter().zip(last("b.e"));
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() <= 1e-9 * 2e5), "{:?} {:?}", last("a.e"), last("b.e"));
    desk.urto(&["refine", "box.mesh"]).with(2).says(&["is a recipe", "urto mesh box.mesh --refine 2"]);
    desk.urto(&["refine", "box.g", "-o", "box.g"]).with(2).says(&["would be written over"]);
}
