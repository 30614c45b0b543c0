//! The program at the shell: exit codes, files, words.

use crate::program::{Desk, bar_deck, box_mesh, project, put_bar};

/// A time that the bar reaches at once.
const SOON: f64 = 1e-5;

#[test]
fn a_run_leaves_its_files_and_says_so() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    desk.urto(&["run", "bar.i"]).with(0).says(&["A bar: 32 elements on", "energy error", "done:", "bar.e", "bar.o"]);
    assert!(desk.results("bar.e").times().len() > 1);
    assert!(desk.text("bar.o").ends_with("THE RUN IS COMPLETE\n"));
}

#[test]
fn a_deck_alone_means_run() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    for arguments in
        [&["bar.i"][..], &["bar"], &["./bar.i"], &["--quiet", "bar.i"], &["-q", "--ranks=2", "bar"], &["run", "bar"]]
    {
        desk.urto(arguments).with(0);
        std::fs::remove_file(desk.path("bar.e")).expect("results of this run");
    }
}

#[test]
fn quiet_is_silent_but_for_warnings() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    let left = desk.urto(&["run", "bar.i", "--quiet"]).with(0);
    assert_eq!((left.out.as_str(), left.err.as_str()), ("", ""));
    put_bar(&desk, SOON, "FUNCTION, 7\n0., 1.\nEND\n");
    let left = desk.urto(&["run", "bar.i", "--quiet"]).with(0);
    assert!(left.out.is_empty() && left.err.starts_with("warning: FUNCTION 7 is used by no command"), "{}", left.err);
    desk.urto(&["run", "bar.i"]).with(0).says(&["warning", "FUNCTION 7 is used by no command"]);
    assert!(desk.text("bar.o").contains("FUNCTION 7 is used by no command"), "warnings stand in the log too");
}

#[test]
fn results_go_where_the_user_stands() {
    let desk = Desk::new();
    desk.put("decks/bar.i", &bar_deck(SOON, ""));
    std::fs::create_dir(desk.path("meshes")).expect("a folder");
    desk.put_mesh("meshes/bar.g", &box_mesh([1, 1, 2], [1.0; 3], false));
    desk.urto(&["decks/bar.i"]).with(0);
    assert!(desk.has("bar.e") && desk.has("bar.o"));
    let beside = |folder: &str| std::fs::read_dir(desk.path(folder)).expect("a folder").count();
    assert_eq!((beside("decks"), beside("meshes")), (1, 1));
}

#[test]
fn output_names_base_and_folder() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    desk.urto(&["run", "bar.i", "--output", "out/deep/case1.5"]).with(0).says(&["out/deep/case1.5.e"]);
    assert!(desk.has("out/deep/case1.5.e") && desk.has("out/deep/case1.5.o"));
    desk.urto(&["run", "bar.i", "-o", "new/"]).with(0);
    desk.urto(&["run", "bar.i", "-o", "out"]).with(0);
    desk.urto(&["run", "bar.i", "-o", "q.e"]).with(0);
    assert!(desk.has("q.e") && desk.has("q.o") && !desk.has("q.e.e"), "the name of one file names them all");
    assert!(desk.has("new/bar.e") && desk.has("out/bar.e"), "a folder takes the deck's name");
    assert!(!desk.has("bar.o"));
}

#[test]
fn old_print_logs_are_kept() {
    let desk = Desk::new();
    for (title, kept) in [("first", vec![]), ("second", vec!["first"]), ("third", vec!["first", "second"])] {
        put_bar(&desk, SOON, "");
        desk.put("bar.i", &bar_deck(SOON, "").replace("A bar", title));
        desk.urto(&["bar.i", "-q"]).with(0);
        assert!(desk.text("bar.o").contains(title));
        for (number, title) in kept.iter().enumerate() {
            assert!(desk.text(&format!("bar.o.{}", number + 1)).contains(title));
        }
    }
}

#[test]
fn a_missing_mesh_comes_with_advice() {
    let desk = Desk::new();
    desk.put("decks/bar.i", &bar_deck(SOON, ""));
    let lost = desk.urto(&["decks/bar.i"]).with(2);
    lost.says(&["no mesh for decks/bar.i", "decks/bar.g", "meshes/bar.g", "--mesh", "urto mesh"]);
    desk.urto(&["decks/bar.i", "--mesh", "other.g"]).with(2).says(&["other.g"]);
    assert!(!desk.has("bar.o"), "wrong input leaves no files");
    desk.put("meshes/bar.mesh", "BOX, 1, 0., 0., 0., 1., 1., 2., 1, 1, 2\n");
    desk.urto(&["decks/bar.i"]).with(0).says(&["2 elements"]);
}

#[test]
fn a_mesh_can_be_named() {
    let desk = Desk::new();
    desk.put("bar.i", &bar_deck(SOON, ""));
    desk.put_mesh("other.g", &box_mesh([1, 1, 2], [1.0; 3], false));
    desk.urto(&["bar.i", "-m", "other.g"]).with(0);
}

#[test]
fn wrong_input_ends_in_two_and_shows_every_mistake() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "PRESURE, 100, 1\nNO DISPLACEMENT, W, 1\nNO DISPLACEMENT, X, 77\n");
    let left = desk.urto(&["bar.i"]).with(2);
    left.says(&["bar.i:9", "PRESURE", "PRESSURE", "bar.i:10", "bar.i:11", "77", "^^^"]);
    assert!(!desk.has("bar.o") && !desk.has("bar.e"));
    desk.put("mesh.g", "not a mesh");
    desk.urto(&["bar.i", "--mesh", "mesh.g"]).with(2).says(&["mesh.g", "PRESURE"]);
    desk.urto(&["nothing.i"]).with(2).says(&["there is no deck nothing.i"]);
    desk.urto(&["run", "nothing"]).with(2).says(&["there is no deck nothing, nor nothing.i"]);
}

#[test]
fn the_command_line_is_checked() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    for ranks in ["0", "two", "2.5", "70000"] {
        desk.urto(&["run", "bar.i", "--ranks", ranks]).with(2).says(&["--ranks"]);
    }
    desk.urto(&["bar.i", "--rank-count", "2"]).with(2).says(&["--rank-count"]);
    desk.urto(&["mehs", "x"]).with(2).says(&["there is no verb and no deck mehs(.i)", "did you mean mesh?"]);
    desk.urto(&["nothere"]).with(2).says(&["there is no verb and no deck nothere(.i)", "urto --help"]);
    desk.urto(&[]).with(2).says(&["Usage: urto DECK", "check"]);
    desk.urto(&["run", "bar.i", "--ranks", "64", "-q"]).with(0);
}

#[test]
fn places_that_cannot_be_written_are_named() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "");
    desk.urto(&["bar.i", "-o", "bar.g/x"]).with(1).says(&["error", "bar.g"]);
    std::fs::create_dir(desk.path("taken.e")).expect("a folder");
    desk.urto(&["bar.i", "-o", "taken"]).with(1).says(&["error", "taken.e"]);
}

#[test]
fn explain_knows_the_language() {
    let desk = Desk::new();
    desk.urto(&["explain"]).with(0).says(&["PRESSURE", "RIGID SURFACE", "ELASTIC PLASTIC"]);
    desk.urto(&["explain", "INITIAL VELOCITY MATERIAL"]).with(0).says(&["length/time", "Example", "block"]);
    desk.urto(&["explain", "initial", "velocity", "material"]).with(0).says(&["length/time"]);
    desk.urto(&["explain", "FLURB"]).with(2).says(&["FLURB", "urto explain"]);
    desk.urto(&["explain", "poissons", "ratio"]).with(0).says(&["ELASTIC PLASTIC"]);
    desk.urto(&["explain", "CONTE"]).with(0).says(&["work of normal contact forces"]);
    desk.urto(&["explain", "SIDE SET NORMAL"]).with(0).says(&["Form", "Example"]);
    desk.urto(&["explain", "CYLINDR"]).with(2).says(&["did you mean CYLINDER?"]);
    desk.urto(&["explain", "PRESURE"]).with(2).says(&["PRESSURE"]);
}

#[test]
fn meshes_are_made_from_recipes() {
    let desk = Desk::new();
    let recipe = project("meshes/commands.mesh").display().to_string();
    desk.urto(&["mesh", &recipe]).with(0).says(&["commands.g: 81 nodes, 32 elements in 2 block"]);
    desk.urto(&["mesh", &recipe, "--refine", "2", "-o", "fine.g"]).with(0).says(&["256 elements"]);
    desk.put("wrong.mesh", "BOXX, 1\n");
    desk.urto(&["mesh", "wrong.mesh"]).with(2).says(&["wrong.mesh:1:1", "BOX"]);
    desk.urto(&["mesh", "nothing.mesh"]).with(2).says(&["nothing.mesh"]);
    desk.urto(&["mesh", &recipe, "--refine", "0"]).with(2).says(&["--refine"]);
    desk.urto(&["mesh", &recipe, "-o", "no/such/folder.g"]).with(1).says(&["no/such/folder.g"]);
}

#[test]
fn diff_tells_same_from_different_from_incomparable() {
    let desk = Desk::new();
    let plot = "PLOT NODAL, DISPLACEMENT\nPLOT ELEMENT, DENSITY\n";
    put_bar(&desk, SOON, plot);
    desk.put("other.i", &bar_deck(SOON, plot).replace("-10.", "-10.001"));
    desk.urto(&["bar.i", "-q"]).with(0);
    desk.urto(&["bar.i", "-q", "-o", "again"]).with(0);
    desk.urto(&["other.i", "-q", "-m", "bar.g"]).with(0);
    desk.urto(&["diff", "bar.e", "again.e"]).with(0).says(&["same"]);
    desk.urto(&["diff", "bar.e", "other.e"]).with(1).says(&["DISPLZ", "node"]);
    desk.urto(&["diff", "bar.e", "other.e", "--tolerance", "1e-3", "--floor", "1e-9"]).with(0);
    desk.urto(&["diff", "bar.e", "other.e", "--tolerance", "1e-5", "--floor", "1e-9"]).with(1);
    desk.urto(&["diff", "bar.e", "other.e", "--floor", "nan"]).with(2).says(&["expected a number of at least 0"]);
    desk.urto(&["plot", "bar.e", "--reference", "other.e"]).with(2).says(&["other.e", "is no text", "CSV"]);
    let missing = desk.urto(&["diff", "bar.e", "nothing.e"]).with(2);
    missing.says(&["nothing.e"]);
    assert!(!missing.err.contains("error: error:"));
    desk.put("text.e", "no results");
    desk.urto(&["diff", "bar.e", "text.e"]).with(2).says(&["text.e"]);
    desk.put_mesh("coarse.g", &box_mesh([1, 1, 2], [1.0; 3], false));
    desk.urto(&["bar.i", "-q", "-m", "coarse.g", "-o", "coarse"]).with(0);
    desk.urto(&["diff", "bar.e", "coarse.e"]).with(2).says(&["cannot compare"]);
}

#[test]
fn view_draws_or_says_why_not() {
    let desk = Desk::new();
    put_bar(&desk, SOON, "PLOT ELEMENT, STRESS\n");
    desk.urto(&["bar.i", "-q"]).with(0);
    desk.urto(&["view", "bar.e", "--variable", "SIGZZ", "--mirror", "xy", "--size", "200x150"])
        .with(0)
        .says(&["bar.png"]);
    assert!(std::fs::read(desk.path("bar.png")).expect("a picture").starts_with(b"\x89PNG"));
    desk.urto(&["view", "bar.e", "--variable", "EQPS"]).with(2).says(&["EQPS", "SIGZZ", "DISPLX"]);
    desk.urto(&["view", "bar.e", "--state", "999"]).with(2).says(&["999"]);
    for state in ["last", "mesh", "1", "t=0.5E-5"] {
        desk.urto(&["view", "bar.e", "--state", state]).with(0);
    }
    desk.urto(&["view", "bar.e", "--state", "first"]).with(2).says(&["state is first", "mesh", "t=TIME"]);
    desk.urto(&["view", "bar.e", "-o", "bar.jpg"]).with(2).says(&["bar.jpg", ".png"]);
    desk.urto(&["view", "bar.e", "-o", "bar.png", "--animate", "--size", "200x150"]).with(0);
    desk.urto(&["view", "bar.e", "-o", "bar.gif"]).with(2).says(&["bar.gif", "--animate"]);
    desk.urto(&["view", "bar.g"]).with(0).says(&["bar.png: blocks"]);
    desk.urto(&["view", "bar.g", "--animate"]).with(2).says(&["no states", "--state mesh"]);
    desk.urto(&["view", "bar.g", "--state", "1"]).with(2).says(&["no states"]);
    desk.urto(&["view", "bar.e", "--size", "large"]).with(2).says(&["--size"]);
    desk.urto(&["view", "bar.e", "--mirror", "w"]).with(2).says(&["--mirror"]);
    desk.urto(&["view", "bar.e", "--from", "behind"]).with(2).says(&["behind"]);
    desk.urto(&["view", "bar.e", "--range", "1"]).with(2).says(&["--range"]);
    desk.urto(&["view", "nothing.e"]).with(2).says(&["nothing.e"]);
}

#[test]
fn help_helps() {
    let desk = Desk::new();
    desk.urto(&["--help"]).with(0).says(&["run", "check", "explain", "mesh", "view", "diff", "Exit codes", "Examples"]);
    desk.urto(&["help", "run"]).with(0).says(&["--ranks"]);
    desk.urto(&["--version"]).with(0).says(&["urto ", env!("CARGO_PKG_VERSION")]);
    for (verb, words) in [
        ("run", &["--ranks", "--output", "--quiet", "--mesh", "shutdown", ".o.1"][..]),
        ("check", &["--mesh", "first time step"]),
        ("explain", &["INITIAL VELOCITY MATERIAL"]),
        ("mesh", &["--refine", "--output", "recipe"]),
        ("view", &["--variable", "--state", "--time", "--from", "--mirror", "--magnify", "--animate"]),
        ("diff", &["--tolerance", "--floor", "|a - b|"]),
    ] {
        let long = desk.urto(&[verb, "--help"]).with(0);
        long.says(words);
        assert!(long.out.lines().all(|line| line.chars().count() <= 120), "{verb}");
        desk.urto(&[verb, "-h"]).with(0);
    }
}

#[test]
fn radial_velocities_point_away_from_a_point_or_an_axis() {
    let desk = Desk::new();
    let velocity = "INITIAL VELOCITY MATERIAL, 1, 0., 0., -10.\n";
    for (command, axis) in [("RADIAL, 1, 7., 0., 0., -0.01", None), ("RADIAL, 1, -7., 0., 0., 0., 0., 0., 2.", Some(2))]
    {
        put_bar(&desk, SOON, "PLOT NODAL, VELOCITY\n");
        let deck = desk.text("bar.i").replace(velocity, &format!("INITIAL VELOCITY {command}\n"));
        desk.put("bar.i", &deck);
        desk.urto(&["bar.i", "-q", "--ranks", "2"]).with(0);
        let results = desk.results("bar.e");
        let mesh = results.mesh().expect("the mesh");
        let found = ["VELX", "VELY", "VELZ"].map(|name| results.nodal(name, 0).expect("velocities"));
        for (node, &[x, y, z]) in mesh.coordinates.iter().enumerate() {
            let arm = if axis.is_some() { [x, y, 0.0] } else { [x, y, z + 0.01] };
            let length = arm.iter().map(|x| x * x).sum::<f64>().sqrt();
            let speed = if axis.is_some() { -7.0 } else { 7.0 };
            for i in 0..3 {
                let expected = if length > 0.0 { speed * arm[i] / length } else { 0.0 };
                // Three operations of seven units each are less than 1e-14.
                assert!((found[i][node] - expected).abs() < 1e-14, "{command}: node {node}, {:?}", found[i][node]);
            }
        }
    }
}

#[test]
fn completions_are_made() {
    let desk = Desk::new();
    for shell in ["bash", "zsh", "fish"] {
        desk.urto(&["generate", shell]).with(0).says(&["urto", "explain"]);
    }
}

#[test]
fn the_log_is_in_the_order_of_prontos() {
    let desk = Desk::new();
    desk.put("commands.i", &std::fs::read_to_string(project("decks/commands.i")).expect("the deck"));
    desk.put_mesh("commands.g", &crate::program::commands_mesh());
    desk.urto(&["commands.i", "-q", "--ranks", "2"]).with(0);
    let log = desk.text("commands.o");
    let mut rest = log.as_str();
    for heading in [
        "urto 0.1.0",
        "I N P U T   S T R E A M",
        "   1: $ Every command",
        "P R O B L E M   T I T L E",
        "P R O B L E M   D E F I N I T I O N",
        "NUMBER OF ELEMENTS ........................           32",
        "W H A T   I S   M O D E L L E D",
        "M A T E R I A L   D E F I N I T I O N S",
        "INITIAL DILATATIONAL WAVE SPEED .........   4.5856e+03",
        "F U N C T I O N S",
        "N O   D I S P L A C E M E N T",
        "G R A V I T Y",
        "I N I T I A L   V E L O C I T I E S",
        "R I G I D   S U R F A C E S",
        "E N D   O F   D A T A   I N P U T   P H A S E",
        "T O T A L   M A S S   O F   E A C H   M A T E R I A L",
        "E N D   O F   D A T A   I N I T I A L I Z A T I O N   P H A S E",
        "V A R I A B L E S   O N   P L O T T I N G   D A T A   B A S E",
        "TIME DILATATION",
        "E N E R G Y   B A L A N C E",
        "W H E R E   T H E   T I M E   W E N T",
        "E N D   O F   S O L U T I O N   P H A S E",
        "THE RUN IS COMPLETE",
    ] {
        let at = rest.find(heading).unwrap_or_else(|| panic!("{heading:?} is missing or out of order in\n{log}"));
        rest = &rest[at + heading.len()..];
    }
    assert!(!log.contains('\u{1b}'), "no terminal codes in files");
}

/// Every example runs as it stands: its mesh, or the recipe of it, is where a deck's mesh is looked for.
#[test]
fn every_example_is_sound_without_options() {
    let desk = Desk::new();
    let decks = std::fs::read_dir(project("decks")).expect("the examples").map(|entry| entry.expect("a file").path());
    for deck in decks.filter(|path| path.extension().is_some_and(|suffix| suffix == "i")) {
        // The deck of all commands has some without effect.
        let is_all = deck.file_stem().is_some_and(|name| name == "commands");
        let end = if is_all { "deck and mesh can be run, but see the warnings" } else { "deck and mesh are sound" };
        desk.urto(&["check", &deck.display().to_string()]).with(0).says(&[end]);
    }
}

/// The first deck of the README is one of ours, line by line.
#[test]
fn the_readme_shows_a_deck_of_ours() {
    let words = |text: &str| -> Vec<String> {
        let lines = text.lines().map(|line| line.split('$').next().unwrap_or("").trim().to_string());
        lines.filter(|line| !line.is_empty()).collect()
    };
    let readme = std::fs::read_to_string(project("README.md")).expect("the README");
    let shown = readme.lines().skip_while(|line| line.trim() != "TITLE").take_while(|line| !line.starts_with("Units"));
    let deck = std::fs::read_to_string(project("decks/taylor_bar.i")).expect("the deck");
    assert_eq!(words(&shown.collect::<Vec<_>>().join("\n")), words(&deck));
}

#[test]
fn values_from_the_command_line_stand_for_those_of_deck_and_recipe() {
    let desk = Desk::new();
    desk.put("box.mesh", "TITLE\n box\n$ {n = 2}\nBOX, 1, 0., 0., 0., 1., 1., 1., {n}, 1, 1\n");
    desk.urto(&["mesh", "box.mesh"]).with(0).says(&["2 elements"]);
    desk.urto(&["mesh", "box.mesh", "-D", "n=5"]).with(0).says(&["5 elements"]);
    desk.urto(&["mesh", "box.mesh", "-D", "m=5"]).with(2).says(&["-D gives a value to m", "no expression"]);
    desk.urto(&["mesh", "box.mesh", "-D", "n"]).with(2).says(&["NAME=VALUE"]);
    desk.urto(&["mesh", "box.mesh", "-D", "n="]).with(2).says(&["-D n=: the value is missing"]);
    desk.urto(&["mesh", "box.mesh", "-D", "n=1,5"]).with(2).says(&["two fields", "decimals follow a point, as in 1.5"]);
    desk.put(
        "box.i",
        "TITLE\n box\n$ {speed = 10.}\nTERMINATION TIME, 1.E-5\nMATERIAL, 1, ELASTIC, 7800.\nYOUNGS MODULUS = 2.E11\n\
         POISSONS RATIO = 0.3\nEND\nINITIAL VELOCITY MATERIAL, 1, {speed}, 0., 0.\nEXIT\n",
    );
    std::fs::remove_file(desk.path("box.g")).expect("the mesh of the recipe");
    // A name may be the deck's or the recipe's.
    desk.urto(&["check", "box.i", "-D", "n=3", "-D", "speed=20"]).with(0).says(&["3 elements"]);
    desk.urto(&["check", "box.i", "-D", "sped=20"]).with(2).says(&["-D gives a value to sped"]);
    // Half of 7800 times the square of 20.
    desk.urto(&["run", "box.i", "-q", "-D", "speed=20", "-m", "box.mesh"]).with(0);
    let energy = desk.results("box.e").global(0).expect("the first state")[0];
    assert!((energy - 0.5 * 7800.0 * 400.0).abs() < 1e-6, "{energy}");
}

/// A plane mesh, of a recipe or of a file, becomes hexahedra: drawn out and held across it moves as in plane strain, turned it weighs
/// what the body of revolution does.
#[test]
fn plane_meshes_become_solids() {
    let desk = Desk::new();
    let recipe = "RECTANGLE, 1, 0., 0., 0.01, 0.04, 2, 8\nSIDE SET FACE, 100, 1, FRONT\nNODE SET PLANE, 1, X, 0.\n";
    desk.put("plane.mesh", recipe);
    desk.urto(&["mesh", "plane.mesh"]).with(0);
    let drawn = desk.urto(&["mesh", "plane.mesh", "--extrude", "0.015", "--cells", "3", "-o", "drawn.g"]).with(0);
    drawn.says(&["drawn.g: 108 nodes, 48 elements in 1 block(s); sets 101 and 102 are its ends"]);
    let turned = desk.urto(&["mesh", "plane.g", "--revolve", "90", "--cells", "6", "-o", "turned.g"]).with(0);
    turned.says(&["turned.g: 135 nodes, 96 elements", "sets 101 and 102"]);
    desk.urto(&["mesh", "plane.g", "--revolve", "360", "--cells", "8", "-o", "whole.g"]).with(0);
    let deck = |more: &str| {
        format!(
            "TITLE\n a bar\nTERMINATION TIME, 2.E-5\nPLOT GLOBAL, BLOCK ENERGY\nMATERIAL, 1, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\n\
             POISSONS RATIO = 0.33\nEND\n{more}EXIT\n"
        )
    };
    let plane = "INITIAL VELOCITY MATERIAL, 1, 0., -10.\nRIGID SURFACE, 100, 0., 0., 0., 1.\n";
    let space = "INITIAL VELOCITY MATERIAL, 1, 0., -10., 0.\nRIGID SURFACE, 100, 0., 0., 0., 0., 1., 0.\n";
    desk.put("plane.i", &deck(&format!("PLANE STRAIN\n{plane}")));
    desk.put("drawn.i", &deck(&format!("NO DISPLACEMENT, Z, 101\nNO DISPLACEMENT, Z, 102\n{space}")));
    desk.put("axis.i", &deck(&format!("AXISYMMETRIC\n{plane}")));
    desk.put("turned.i", &deck(&format!("NO DISPLACEMENT, Z, 101\nNO DISPLACEMENT, X, 102\n{space}")));
    let energy = |name: &str, mesh: &str| {
        desk.urto(&[name, "-q", "--ranks", "1", "-m", mesh]).with(0);
        let results = desk.results(&name.replace(".i", ".e"));
        let place = results.global_names().iter().position(|n| n == "KE_BLOCK1").expect("an energy");
        [0, results.times().len() - 1].map(|state| results.global(state).expect("a state")[place])
    };
    let (plane, drawn) = (energy("plane.i", "plane.g"), energy("drawn.i", "drawn.g"));
    // Elements of the layer have other steps than squares do, so that the ends are alike only but for the step.
    for (state, most) in [(0, 1e-12), (1, 2e-2)] {
        let part = drawn[state] / (0.015 * plane[state]);
        assert!((part - 1.0).abs() < most, "{state}: {part}");
    }
    // Chords of 15 degrees for an arc: sin(15)/15 of its area.
    let (axis, turned) = (energy("axis.i", "plane.g"), energy("turned.i", "turned.g"));
    let chords = 15f64.to_radians().sin() / 15f64.to_radians();
    assert!((4.0 * turned[0] / (chords * axis[0]) - 1.0).abs() < 1e-12, "{turned:?} {axis:?}");
    assert!((4.0 * turned[1] / (chords * axis[1]) - 1.0).abs() < 0.1, "{turned:?} {axis:?}");
    let wrong = |more: &[&str], words: &str| {
        desk.urto(&[&["mesh", "plane.mesh", "-o", "wrong.g"], more].concat()).with(2).says(&[words]);
    };
    wrong(&["--revolve", "400", "--cells", "3"], "--revolve is 400");
    wrong(&["--extrude=-1", "--cells", "3"], "--extrude is -1");
    wrong(&["--extrude", "1"], "--cells");
    wrong(&["--extrude", "1", "--revolve", "90", "--cells", "3"], "cannot be used with");
    desk.urto(&["mesh", "drawn.g", "--revolve", "90", "--cells", "3"]).with(2).says(&["only a two-dimensional mesh"]);
}
