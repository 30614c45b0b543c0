//! What a run tells of itself: on the terminal, in the log, in the last line; quiet, strict, on any number of ranks, and
//! after a restart.

use crate::program::{Desk, Left};
use crate::warning_scenes::{
    STEEL, Scene, crossed, dented, desk, driven_and_held, driven_through_a_plane, overlapping, rigid_without_room,
    scenes, sloshing,
};
use urto::exodus::{RestartHeader, read_restart, write_restart};

/// A load that rises softly supplies next to nothing for long: whatever its hourglass energy is a part of, it is told of once there is as
/// much as a tenth of what comes in the end, not at the first of two hundred lines that finds it.
#[test]
fn hourglass_energy_is_told_when_it_amounts_to_something() {
    let rise: String = (0..=20)
        .map(|i| f64::from(i) / 20.0)
        .map(|x| format!("{}, {}\n", 0.05 * x, x.powi(3) * (10.0 - 15.0 * x + 6.0 * x * x)))
        .collect();
    let deck = format!(
        "TERMINATION TIME, 0.1\nOUTPUT TIME, 5.E-4\nPRESCRIBED FORCE, Z, 2, 1, 1.E4\nFUNCTION, 1\n{rise}END\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nMATERIAL, 4, ELASTIC, 7800.\n{STEEL}"
    );
    let recipe = "BOX, 4, 0., 0., 0., 1., 0.1, 0.1, 10, 1, 1\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 1.\n";
    let desk = desk(&deck, recipe);
    let left = desk.urto(&["case.i", "--ranks", "1"]).with(0);
    let told = lines(&left.err, "warning: ").concat();
    let number = |text: &str, before: &str| {
        let rest = text.split(before).nth(1).unwrap_or_default();
        rest.trim_start_matches([' ', '.']).split([',', ' ', ':', '\n']).next().and_then(|word| word.parse().ok())
    };
    let amount: Option<f64> = number(&told, "hourglass energy of block 4 is ");
    let (Some(amount), Some(whole)) = (amount, number(&desk.text("case.o"), "HOURGLASS ENERGY ..")) else {
        panic!("no numbers: {told}")
    };
    assert!(amount > 0.1 * whole && whole > 0.0, "{amount} of {whole}: {told}");
    let time: Option<f64> = number(&told, "time ");
    assert!(time.is_some_and(|time| time < 0.06), "not at the end only: {told}");
}

/// A free beam of one element across, one half of which is thrown: it bends by hourglass modes alone. What warns of that must not be
/// silent because all of it flies.
#[test]
fn hourglass_energy_is_told_of_what_flies_as_of_what_rests() {
    let told = |flight: f64, precision: &str| {
        let deck = format!(
            "TERMINATION TIME, 2.E-3\nOUTPUT TIME, 1.E-4\nINITIAL VELOCITY MATERIAL, 4, {flight}, 0., 1.\n\
             INITIAL VELOCITY MATERIAL, 5, {flight}, 0., -1.\n{precision}MATERIAL, 4, ELASTIC, 7800.\n{STEEL}\
             MATERIAL, 5, ELASTIC, 7800.\n{STEEL}"
        );
        let recipe = "BOX, 4, 0., 0., 0., 0.5, 0.1, 0.1, 5, 1, 1\nBOX, 5, 0.5, 0., 0., 0.5, 0.1, 0.1, 5, 1, 1\nMERGE\n";
        lines(&desk(&deck, recipe).urto(&["case.i", "--ranks", "2"]).with(0).err, "warning: ").concat()
    };
    for precision in ["", "PRECISION, SINGLE\n"] {
        let [rests, flies] = [0.0, 2000.0].map(|flight| told(flight, precision));
        assert!(rests.contains("hourglass energy of block 4") && rests.contains("of block 5"), "{rests}");
        assert!(flies.contains("hourglass energy of block 4") && flies.contains("of block 5"), "{flies}");
    }
    let alone = "TERMINATION TIME, 2.E-3\nOUTPUT TIME, 1.E-4\nINITIAL VELOCITY MATERIAL, 4, 2000., 0., 0.\nPRECISION, SINGLE\n\
                 MATERIAL, 4, ELASTIC, 7800.\n";
    let desk = desk(&format!("{alone}{STEEL}"), "BOX, 4, 0., 0., 0., 0.5, 0.1, 0.1, 5, 1, 1\n");
    desk.urto(&["case.i", "--strict", "--ranks", "1"]).with(0);
}

/// In half a period water swings twice as far as a slow pull would move it, its surface inclined by a/g: its centre by
/// 2 a L²/(12 g H). With the factor that the advice names it does so, and nothing is warned of; without it does not come half as far.
#[test]
fn water_sloshes_with_the_factor_that_is_advised() {
    let swing = 2.0 * 0.2 / (12.0 * 9.81 * 0.5);
    let shift = |desk: &Desk| {
        let centre = desk.results("case.h").global_history("DISPLX_BLOCK1").expect("the variable");
        centre.last().map_or(0.0, |x| x / swing)
    };
    let stopped = sloshing(1.0);
    stopped.urto(&["case.i", "--ranks", "1"]).with(0).says(&["HOURGLASS CONTROL, ASSUMED STRAIN, 0.01"]);
    assert!(shift(&stopped) < 0.55, "{}", shift(&stopped));
    let free = sloshing(0.01);
    free.urto(&["case.i", "--ranks", "1", "--strict"]).with(0);
    assert!((shift(&free) - 1.0).abs() < 0.06, "{}", shift(&free));
}

/// What is warned of names the factor that the deck has and a smaller one, never the deck's own as a way out.
#[test]
fn advice_on_damped_flow_begins_with_the_factor_of_the_deck() {
    let half = sloshing(0.5).urto(&["case.i", "--ranks", "1"]).with(0);
    half.says(&["its factor is 0.5, and with HOURGLASS CONTROL, ASSUMED STRAIN, 0.005 it is a hundredth"]);
    assert!(!half.err.contains("ASSUMED STRAIN, 0.5"), "{}", half.err);
}

/// Energies of nothing but round-off: a plug of water that flies freely has internal energies of 1e-30 of its kinetic one, some of them below zero;
/// water that lies in a tank and on which gravity has acted for one step has accounts of v⁻·v⁺ with a v⁻ that is round-off.
#[test]
fn round_off_is_no_finding() {
    let water = "MATERIAL, 1, HYDRODYNAMIC, 1000.\nPRESSURE CUTOFF = 0.\nEND\n\
                 EQUATION OF STATE, 1, MG US-UP\nC0 = 1480.\nS = 1.92\nGAMMA = 0.1\nEND\n";
    let flight = format!("TERMINATION TIME, 2.E-4\nINITIAL VELOCITY MATERIAL, 1, 30., 20., -500.\n{water}");
    let flying = desk(&flight, "BOX, 1, 0., 0., 0.5, 10., 10., 10., 2, 2, 20\n");
    flying.urto(&["case.i", "--ranks", "1", "--strict"]).with(0);
    let rest = format!(
        "TERMINATION TIME, 2.E-5\nFUNCTION, 2\n0., 0.\n0.3, 1.\nEND\nGRAVITY, 0., 0., -9.81, 2\nTIME STEP MAXIMUM, 2.E-5\nCONTACT MATERIAL\nSHELL THICKNESS, 2, 0.01\nRIGID BODY, 2\n\
         NO DISPLACEMENT, X, 3\nNO DISPLACEMENT, Y, 3\nNO DISPLACEMENT, Z, 3\n{water}MATERIAL, 2, ELASTIC, 7800.\n{STEEL}"
    );
    let recipe = "BOX, 1, 0., 0., 0., 1., 0.1, 0.5, 12, 1, 6\nSHEET, 2, -0.005, -0.005, -0.005, 1.01, 0.11, 0., 6, 1\nNODE SET BLOCK, 3, 2\n";
    let lying = desk(&rest, recipe);
    lying.urto(&["case.i", "--ranks", "1", "--strict", "--summary", "end.json"]).with(0);
    let summary = lying.text("end.json");
    let error = summary.split("\"energy_error\":").nth(1).and_then(|rest| rest.split([',', '}']).next());
    let error: Option<f64> = error.and_then(|number| number.trim().parse().ok());
    // Against a thousandth of ½ m v² after the first kick; against accounts that are round-off themselves it is 5e-4, and up to 1.
    assert!(error.is_some_and(|error| error.abs() < 1e-7), "{summary}");
}

/// What has no room is told as such, whatever happens to it then; a plane that was gone through was touched.
#[test]
fn what_has_no_room_is_told() {
    let left = driven_through_a_plane().urto(&["case.i", "--ranks", "2"]).with(0);
    left.says(&["warning: ", "nodes have gone into faces out of which contact cannot move them"]);
    let desk = driven_through_a_plane();
    desk.urto(&["case.i", "--ranks", "1"]).with(0).says(&["contact cannot move them"]);
    assert!(!desk.text("case.o").contains("never touched"), "{}", desk.text("case.o"));
    let left = rigid_without_room().urto(&["case.i", "--ranks", "1"]);
    let first = left.err.lines().find(|line| line.starts_with("warning")).unwrap_or_default();
    assert!(first.contains("contact cannot move them"), "{}", left.err);
}

/// Rigid bricks that fly together, each turned in its own way, and nothing that holds or drives them: what passes that have not settled leave
/// of an overlap is no lack of room.
#[test]
fn free_rigid_bodies_have_room() {
    let places = [-0.16, 0.0, 0.16];
    let centre = |i: usize| [places[i / 9], places[i / 3 % 3], places[i % 3]];
    let (mut mesh, mut deck) =
        (String::new(), "TERMINATION TIME, 0.06\nOUTPUT TIME, 0.002\nTIME STEP MAXIMUM, 2.E-4\n".to_string());
    // Few passes leave much.
    deck += "CONTACT MATERIAL, ALL\nCONTACT PASSES, 3, 1.E-5, 3\nCONTACT DATA, ALL, ALL, 0.3\n";
    for (block, [x, y, z]) in (0..27).map(|i| (i + 1, centre(i))) {
        mesh += &format!("BOX, {block}, {}, {}, {}, 0.09, 0.07, 0.06, 2, 2, 2\n", x - 0.045, y - 0.035, z - 0.03);
        for (axis, turn) in [('X', 1.7), ('Y', 2.3), ('Z', 3.1)] {
            mesh += &format!("ROTATE, {block}, {axis}, {}, {x}, {y}, {z}\n", 40.0 * (turn * block as f64).sin());
        }
        deck += &format!(
            "RIGID BODY, {block}\nINITIAL VELOCITY MATERIAL, {block}, {}, {}, {}\n",
            -20.0 * x,
            -20.0 * y,
            -20.0 * z
        );
        deck += &format!("MATERIAL, {block}, ELASTIC, 2000.\n{STEEL}");
    }
    let left = desk(&deck, &mesh).urto(&["case.i", "--ranks", "1"]).with(0);
    assert!(!left.err.contains("contact cannot move them"), "{}", left.err);
}

/// Lines of a text that begin like this, which differ on no number of ranks.
fn lines<'a>(text: &'a str, with: &str) -> Vec<&'a str> {
    text.lines().filter(|line| line.contains(with)).collect()
}

/// A rule that watches what solids do not have, or the wrong way round, takes all elements at once: nothing moves, and nothing else tells.
#[test]
fn elements_that_are_gone_from_the_start_are_told() {
    for rule in ["THICKNESS, MIN, 0.1", "EQPS, MIN, 0.5", "VOLUME, MIN, 2."] {
        let deck = format!(
            "TERMINATION TIME, 1.E-5\nDEATH, 1, {rule}\nMATERIAL, 1, ELASTIC PLASTIC, 7800.\nYOUNGS MODULUS = 200.E9\n\
             POISSONS RATIO = 0.3\nYIELD STRESS = 1.E9\nHARDENING MODULUS = 0.\nBETA = 1.\nEND\n"
        );
        let desk = desk(&deck, "BOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\n");
        let told = ["DEATH takes 8 elements of block 1 away at the first state", "MIN and MAX"];
        desk.urto(&["case.i", "-q", "--strict"]).with(1).says(&told);
    }
}

/// What no force can keep apart overlaps in the log as well, and nothing is said of a first force.
#[test]
fn overlaps_that_nothing_can_move_are_in_the_log() {
    let desk = driven_and_held();
    desk.urto(&["case.i", "-q"]).with(0);
    let log = desk.text("case.o");
    let left = lines(&log, "LARGEST OVERLAP LEFT").concat();
    // The driven block goes 2 mm down and begins 0.1 mm above: 1.9 mm of a face of 10/3 mm.
    assert!(left.ends_with("5.7000e-01"), "{left}");
    assert!(!log.contains("inf"), "{log}");
}

/// What the run will do with bodies that overlap in the mesh is said by the check in the run's own words, whatever the deck wants done with
/// them; what it lets stay is a note. The upper block begins 0.01 below the top of the lower one, its nine lower nodes behind four faces,
/// and the middle of these behind the upper one's.
#[test]
fn the_check_tells_of_overlaps_what_the_run_tells() {
    let told = |left: &Left| left.err.lines().filter(|line| !line.is_empty()).map(String::from).collect::<Vec<_>>();
    for (treatment, note) in [
        ("", None),
        ("CONTACT OVERLAP, REMOVE\n", None),
        ("CONTACT OVERLAP, KEEP\n", Some("KEEP leaves them there, and lets none sink deeper")),
        (
            "CONTACT OVERLAP, STRESS, 1.E-5\n",
            Some("STRESS pushes them apart through the strain of the bodies until time 1.0000e-5"),
        ),
    ] {
        let desk = overlapping(0.01);
        desk.put("case.i", &desk.text("case.i").replace("CONTACT OVERLAP, REMOVE\n", treatment));
        let checked = desk.urto(&["check", "case.i"]).with(0);
        let run = desk.urto(&["case.i", "-q"]).with(0);
        let Some(note) = note else {
            assert!(told(&run).concat().contains("nodes were moved out of faces before the run"), "{}", run.err);
            assert_eq!(told(&checked), told(&run), "{treatment}");
            checked.says(&["deck and mesh can be run, but see the warnings"]);
            desk.urto(&["check", "case.i", "--strict"]).with(1);
            continue;
        };
        assert!(
            !run.err.contains("overlap in the mesh") && !run.err.contains("begin deep"),
            "{treatment}: {}",
            run.err
        );
        checked
            .says(&["note: bodies overlap in the mesh: 10 nodes begin behind faces, the deepest by 1.0000e-2", note]);
        assert!(desk.text("case.o").contains("NODES BEHIND FACES    DEEPEST"), "{treatment}");
        desk.urto(&["check", "case.i", "--strict"]).with(0).says(&["deck and mesh are sound"]);
    }
}

/// A row of bars through a block has several nodes within half of its outer elements, which would all go to the same place on its face: bars
/// without length. It is refused before the run, as is a block inside another one where it has to be moved; where it need not be, it is told
/// that nothing holds it. So is what is nearer to faces than half an element, but not to those at which it looks.
#[test]
fn overlaps_that_cannot_be_taken_out_are_told_before_the_run() {
    let solid =
        |block: u32| format!("MATERIAL, {block}, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.\nEND\n");
    let deck = |more: &str| format!("TERMINATION TIME, 1.E-3\nCONTACT MATERIAL\n{more}{}{}", solid(1), solid(2));
    let bars = "BOX, 1, -1., -1., -0.5, 2., 2., 1., 4, 4, 2\nLINE, 2, 0.1, 0.1, -2., 0.1, 0.1, 2.1, 40\n";
    for treatment in ["", "CONTACT OVERLAP, REMOVE\n"] {
        let desk = desk(&deck(&format!("BEAM SECTION, 2, ROD, 0.04\n{treatment}")), bars);
        for command in [&["check", "case.i"][..], &["case.i"]] {
            desk.urto(command).with(2).says(&["4 elements have nodes at the same place", "CONTACT OVERLAP, KEEP"]);
        }
    }
    let inside = "BOX, 1, -1., -1., -1., 2., 2., 2., 1, 1, 1\nBOX, 2, -.2, -.1, -.15, .3, .3, .3, 1, 1, 1\n";
    let deep = "8 nodes of contact surfaces begin deep inside";
    desk(&deck(""), inside).urto(&["check", "case.i"]).with(2).says(&[
        "8 nodes cannot",
        "half an element below every face that they look at",
        "8.5000e-1 below the nearest",
    ]);
    kept(&deck("CONTACT OVERLAP, REMOVE\n"), inside, &[deep, "8.5000e-1 below the nearest"]);
    let elements = "1 elements begin inside another body, of blocks 1 and 2";
    desk(&deck("CONTACT OVERLAP, STRESS\n"), inside).urto(&["check", "case.i"]).with(2).says(&[elements]);
    kept(&deck("CONTACT OVERLAP, KEEP\n"), inside, &[elements]);
    // A post that has come nearly through a plate of elements so large that no node of theirs is in it.
    let through = "BOX, 1, -1.5, -1.5, -0.1, 3., 3., 0.1, 3, 3, 1\nBOX, 2, -.2, -.1, -.09, .3, .3, 1., 1, 1, 1\n";
    let nodes = "4 nodes of contact surfaces begin deep inside";
    kept(&deck("CONTACT OVERLAP, KEEP\n"), through, &[nodes, "1.0000e-2 below the nearest face"]);
    let refused = desk(&deck("CONTACT OVERLAP, STRESS\n"), through).urto(&["check", "case.i"]).with(2);
    refused.says(&["4 nodes cannot", "half an element below every face that they look at"]);
    // Half as deep it looks at the face above it, and contact knows it.
    let shallow = desk(&deck("CONTACT OVERLAP, KEEP\n"), &through.replace("-.09", "-.04"));
    let checked = shallow.urto(&["check", "case.i", "--strict"]).with(0);
    assert!(!checked.err.contains("warning"), "{}", checked.err);
}

/// Asserts that the check and the run tell this of bodies that may stay in each other.
#[track_caller]
fn kept(deck: &str, shapes: &str, told: &[&str]) {
    let kept = desk(deck, shapes);
    for command in [&["check", "case.i"][..], &["case.i"]] {
        kept.urto(command).with(0).says(told);
    }
}

#[test]
fn every_warning_stands_in_three_places_and_is_the_same_on_any_ranks() {
    for Scene { desk, label, words } in scenes() {
        let left = desk.urto(&["case.i", "--ranks", "1"]).with(0);
        let told = lines(&left.err, "warning: ");
        let of_it = |line: &str| words.iter().all(|word| line.contains(word));
        assert_eq!(told.iter().filter(|line| of_it(line)).count(), 1, "{label}: once on the terminal\n{}", left.err);
        let log = desk.text("case.o");
        let in_log = lines(&log, "***** WARNING: AT STEP");
        assert_eq!(in_log.iter().filter(|line| of_it(line)).count(), 1, "{label}: once in the log\n{log}");
        assert_eq!(left.err.matches("help: ").count(), told.len(), "{label}: each with advice\n{}", left.err);
        assert_eq!(log.matches("\n  advice: ").count(), in_log.len(), "{label}: each with advice\n{log}");
        let count = told.len();
        let done = lines(&left.out, "done: ");
        let end = format!(", with {count} warning");
        assert!(done.len() == 1 && done[0].contains(&end) && done[0].contains(label), "{label}: {done:?}");
        assert!(log.contains("W A R N I N G S") && log.contains(&label.to_uppercase()), "{label}: at the end\n{log}");
        for ranks in ["2", "3"] {
            let again = desk.urto(&["case.i", "--ranks", ranks, "-o", "more"]).with(0);
            assert_eq!(lines(&again.err, "warning: "), told, "{label} on {ranks} ranks");
            assert_eq!(lines(&desk.text("more.o"), "WARNING"), lines(&log, "WARNING"), "{label} on {ranks} ranks");
        }
    }
}

/// A cube whose hourglass mode a viscosity stops within a step: as the work of that is booked, the balance is off by all of it, and the help
/// names the viscosity, not shocks in gases. Without it the balance closes.
#[test]
fn the_balance_of_a_hourglass_viscosity_is_told_as_that() {
    let deck = |viscosity: &str| {
        format!(
            "TERMINATION TIME, 1.E-3\nOUTPUT TIME, 1.E-4\nHOURGLASS STIFFENING, 0.05{viscosity}\n\
             INITIAL VELOCITY NODESET, 1, 0., 0., 1.\nINITIAL VELOCITY NODESET, 2, 0., 0., -1.\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}"
        )
    };
    let cube = "BOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 1\nNODE SET EDGE, 1, X, 0., Y, 0.\nNODE SET EDGE, 1, X, 1., Y, 1.\n\
                NODE SET EDGE, 2, X, 1., Y, 0.\nNODE SET EDGE, 2, X, 0., Y, 1.\n";
    let stopped = desk(&deck(", 0.3"), cube).urto(&["case.i", "-q"]).with(1);
    stopped.says(&["the energy balance is off", "help: the viscosity of HOURGLASS STIFFENING is booked"]);
    assert!(!stopped.err.contains("shock in a gas"), "{}", stopped.err);
    let swings = desk(&deck(""), cube).urto(&["case.i", "-q"]).with(0);
    assert!(!swings.err.contains("the energy balance is off"), "{}", swings.err);
}

/// Where no node is inside, contact sees nothing of an overlap. `urto check` says so in the words of the run; with STRESS, which is to part what
/// overlaps, it is an error, and what is meant to be so is left alone.
#[test]
fn edges_through_faces_are_told_before_a_run() {
    let desk = crossed("");
    let told = |err: &str| lines(err, "going through faces").concat();
    let checked = desk.urto(&["check", "case.i", "--strict"]).with(1);
    let ran = desk.urto(&["case.i", "-q", "--strict"]).with(1);
    let words = told(&checked.err);
    // Three lines of the upright sheet at x = -0.7, 0 and 0.7 and those of the other at x = -0.5, 0 and 0.5.
    assert!(words.starts_with("warning: 6 edges of contact surfaces"), "{words}");
    assert_eq!(told(&ran.err).split_once(": ").map(|(_, text)| text), words.split_once(": ").map(|(_, text)| text));
    let refused = crossed("CONTACT OVERLAP, STRESS\n").urto(&["case.i"]).with(2);
    refused.says(&["error: bodies overlap in the mesh: 6 edges of contact surfaces", "help: "]);
    let apart = crossed("CONTACT EXCLUSION, 1, 2\n").urto(&["check", "case.i"]).with(0);
    assert_eq!(told(&apart.err), "");
}

#[test]
fn quiet_runs_warn_and_strict_ones_fail() {
    let desk = overlapping(0.01);
    let quiet = desk.urto(&["case.i", "--quiet"]).with(0);
    assert_eq!(quiet.out, "");
    assert!(quiet.err.starts_with("warning: bodies overlap in the mesh"), "{}", quiet.err);
    let strict = desk.urto(&["case.i", "--quiet", "--strict"]).with(1);
    assert!(
        strict.err.contains("error: the run ended, with 1 warning: nodes moved out of initial overlaps"),
        "{}",
        strict.err
    );
    assert!(desk.text("case.o").contains("THE RUN IS COMPLETE, WITH 1 WARNING"), "strict runs are whole");
    // Warnings of the deck count, too, and are not kept back.
    desk.put("bar.i", &crate::program::bar_deck(1e-5, "TIME STEP SCALE, 1.01\n"));
    desk.put_mesh("bar.g", &crate::program::box_mesh([1, 1, 2], [0.01, 0.01, 0.04], false));
    let of_deck = desk.urto(&["bar.i", "-q", "--strict"]).with(1);
    of_deck.says(&["TIME STEP SCALE: the factor is above 1", "with 1 warning: of the deck or the mesh"]);
    desk.put("bar.i", &crate::program::bar_deck(1e-5, ""));
    let sound: Left = desk.urto(&["bar.i", "-q", "--strict"]).with(0);
    assert_eq!((sound.out.as_str(), sound.err.as_str()), ("", ""));
    desk.put("bar.i", &crate::program::bar_deck(1e-8, ""));
    let brief = desk.urto(&["bar.i", "-q"]).with(0);
    assert!(brief.err.contains("the run is one step, made shorter to end there"), "{}", brief.err);
}

/// A pulse that falls between two steps moves nothing; one of many steps is followed.
#[test]
fn pulses_that_steps_hardly_see_are_told() {
    let deck = |length: f64| {
        let pulse =
            format!("FUNCTION, 7\n0., 0.\n1.E-4, 0.\n{:?}, 1.\n{:?}, 0.\nEND\n", 1e-4 + 0.5 * length, 1e-4 + length);
        format!("TERMINATION TIME, 1.E-3\n{pulse}PRESCRIBED FORCE, X, 1, 7, 1.\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}")
    };
    let mesh = "BOX, 1, 0., 0., 0., 1., 1., 1., 5, 5, 5\nNODE SET PLANE, 1, X, 0.\n";
    let short = desk(&deck(2e-5), mesh);
    short
        .urto(&["check", "case.i"])
        .with(0)
        .says(&["foretold: function 7 goes up or down and comes back within 1.08 steps"]);
    let told = short.urto(&["case.i", "-q"]).with(0);
    assert!(told.err.contains("warning: function 7 goes up or down and comes back within 1.08 steps"), "{}", told.err);
    let long = desk(&deck(8e-4), mesh).urto(&["case.i", "-q"]).with(0);
    assert!(!long.err.contains("function 7"), "{}", long.err);
}

/// What has been warned of before a restart is not told again, but counts.
#[test]
fn a_continued_run_knows_what_it_was_warned_of() {
    let desk = dented(0.7);
    let deck = desk.text("case.i");
    desk.put("case.i", &deck.replace("EXIT", "WRITE RESTART, 9.E-3\nEXIT"));
    let whole = desk.urto(&["case.i", "-o", "whole", "--ranks", "2"]).with(0);
    let told = lines(&whole.err, "warning: ").len();
    assert!(told > 0 && lines(&whole.err, "corners of").len() == 1, "{}", whole.err);
    let state = desk.path("whole.rsout.1");
    let state = if state.exists() { state } else { desk.path("whole.rsout") };
    let state = state.display().to_string();
    let rest = desk.urto(&["case.i", "-o", "rest", "--restart", &state, "--ranks", "3", "--strict"]).with(1);
    assert_eq!(lines(&rest.err, "warning: "), [""; 0], "{}", rest.err);
    rest.says(&[&format!(", with {told} warning"), "corners inside out in block 1"]);
}

/// The state of a version that knew nothing of all this.
#[test]
fn a_state_without_findings_is_refused() {
    let desk = dented(0.1);
    let deck = desk.text("case.i");
    desk.put("case.i", &deck.replace("EXIT", "WRITE RESTART, 5.E-3\nEXIT"));
    desk.urto(&["case.i", "-q"]).with(0);
    let found = read_restart(&desk.path("case.rsout")).expect("a restart file");
    // The form is the first line, whatever its number is now.
    let (_, rest) = found.identity.split_once('\n').expect("more than a form");
    let identity = format!("format: 1\n{rest}");
    assert_ne!(identity, found.identity);
    let header =
        RestartHeader { mesh: &found.mesh, title: "old", qa: [const { String::new() }; 4], info: Vec::new(), identity };
    let old = desk.path("old.rsout");
    write_restart(&old, &header, found.snapshot, || Ok(())).expect("it can be written");
    let left = desk.urto(&["case.i", "--restart", "old.rsout"]).with(2);
    left.says(&[
        "error: old.rsout is of another version",
        "form 1",
        "needs form 8",
        "what contact has made",
        "help: run from the start",
    ]);
}

/// A block that is pushed through itself: long before its step collapses, its corners turn inside out.
#[test]
fn what_came_first_is_named_first() {
    let desk = dented(1.6);
    let left = desk.urto(&["case.i", "-q", "--ranks", "2"]).with(1);
    let error = lines(&left.err, "error: ");
    assert_eq!(error.len(), 1, "{}", left.err);
    let (first, then) = (error[0].find("corners of 2 elements"), error[0].find("time step has collapsed"));
    assert!(first.is_some() && first < then, "{}", error[0]);
    assert!(error[0].contains("that came first, at step"), "{}", error[0]);
    // A block that is coarse and bent has hourglass energy as well, which is worth a warning but no cause. It waits until the energy
    // supplied no longer doubles within a tenth of the run.
    let told = lines(&left.err, "warning: ");
    assert!(told[0].contains("corners of 2 elements") && told[1].contains("hourglass energy of block 1"), "{told:?}");
    assert!(desk.text("case.o").contains("***** ERROR: AT STEP"));
}

/// The field that is plotted, and DEATH by it.
#[test]
fn corners_are_plotted_and_may_end_an_element() {
    let desk = dented(0.7);
    desk.urto(&["case.i", "-q"]).with(0);
    let results = desk.results("case.e");
    let at = |state: usize| results.element("CORNER", state).expect("the variable");
    let last = results.times().len() - 1;
    assert!(at(0).iter().all(|corner| (corner - 1.0).abs() < 1e-12), "{:?}", at(0));
    // A corner at (0.3, 0.3) of a square of unit edges: its Jacobian is 1 − 2·0.7 = −0.4, the mean one 1 − 0.7 = 0.3.
    let expected = -0.4 / 0.3;
    assert!(at(last).iter().all(|corner| (corner - expected).abs() < 0.05), "{:?}, {expected}", at(last));
    let deck = desk.text("case.i");
    desk.put("case.i", &deck.replace("EXIT", "DEATH, 1, CORNER, MIN, 0.\nEXIT"));
    desk.urto(&["case.i", "-o", "dead"]).with(0);
    assert!(desk.text("dead.o").contains("ELEMENTS TAKEN AWAY"));
    assert!(!desk.text("dead.o").contains("INSIDE OUT"), "they are gone before a line is due");
}

/// A displacement of a centimetre from the start on, in a step of a microsecond: 10 km/s.
#[test]
fn displacements_that_jump_are_told() {
    let deck = |first: f64| {
        format!(
            "TERMINATION TIME, 1.E-4\nTIME STEP MAXIMUM, 1.E-6\nFUNCTION, 1\n0., {first}\n1.E-3, 0.01\nEND\n\
             PRESCRIBED DISPLACEMENT, X, 1, 1\nMATERIAL, 1, ELASTIC, 7800.\n{STEEL}"
        )
    };
    let mesh = "BOX, 1, 0., 0., 0., 1., 1., 1., 5, 5, 5\nNODE SET PLANE, 1, X, 0.\n";
    let jumps = desk(&deck(0.01), mesh);
    let told = "node set 1 jumps by 1.0000e-2 in X within the first step, at a velocity of 1.000e4";
    jumps.urto(&["check", "case.i"]).with(0).says(&[told]);
    let told = jumps.urto(&["case.i", "-q"]).with(0);
    let words = "PRESCRIBED DISPLACEMENT, X of node set 1 is 1.0000e-2 at the start instead of 0: its nodes jump there within the first \
                 step, at a velocity of 1.000e4";
    assert!(told.err.contains(words), "{}", told.err);
    let rises = desk(&deck(0.0), mesh).urto(&["case.i", "-q"]).with(0);
    assert!(!rises.err.contains("jump"), "{}", rises.err);
}
