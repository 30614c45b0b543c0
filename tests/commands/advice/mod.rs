//! What a run says at its end of what its scene did not need: each claim is held against a run of the advised deck.

mod contact;

use crate::program::Desk;
use serde_json::Value;
use std::path::Path;
use urto::exodus::Results;

const STEEL: &str = "YOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\n";

/// Two steel bars, one of which strikes the other, and a third far away; the second is held at its end.
fn deck(speed: f64, commands: &str, law: &str) -> String {
    let material = |block: usize| {
        let plastic =
            if law == "ELASTIC" || block == 2 { "" } else { "YIELD STRESS = 500.E6\nHARDENING MODULUS = 1.E9\n" };
        let law = if block == 2 { "ELASTIC" } else { law };
        format!("MATERIAL, {block}, {law}, 7850.\n{STEEL}{plastic}END\n")
    };
    format!(
        "TITLE\n BARS\nTERMINATION TIME, 40.E-6\nPLOT TIME, 4.E-6\nPLOT NODAL, VELOCITY, CONTACT\nPLOT ELEMENT, STRESS, ENERGY\n\
         NO DISPLACEMENT, X, 2\nINITIAL VELOCITY MATERIAL, 1, {speed}, 0., 0.\n{commands}{}{}{}EXIT\n",
        material(1),
        material(2),
        material(3)
    )
}

fn desk() -> Desk {
    let desk = Desk::new();
    desk.put(
        "bars.mesh",
        "TITLE\n BARS\nBOX, 1, 0., 0., 0., 0.04, 0.01, 0.01, 8, 2, 2\nBOX, 2, 0.0401, -0.002, -0.002, 0.04, 0.014, 0.014, 8, 2, 2\n\
         BOX, 3, 0., 0.1, 0., 0.01, 0.01, 0.01, 2, 2, 2\nNODE SET FACE, 2, 2, RIGHT\nSIDE SET FACE, 100, 3, LEFT\n",
    );
    desk
}

/// Runs a deck and returns what it was advised.
fn advised(desk: &Desk, name: &str, deck: &str, more: &[&str]) -> Vec<Value> {
    desk.put(&format!("{name}.i"), deck);
    let (input, summary) = (format!("{name}.i"), format!("{name}.json"));
    let arguments = ["run", &input, "-m", "bars.mesh", "-q", "--summary", &summary];
    desk.urto(&[&arguments[..], more].concat()).with(0);
    let found: Value = serde_json::from_str(&desk.text(&summary)).expect("JSON");
    found["advice"].as_array().expect("a list").clone()
}

fn about<'a>(advice: &'a [Value], words: &str) -> Option<&'a Value> {
    advice.iter().find(|one| one["words"].as_str().is_some_and(|text| text.contains(words)))
}

/// Whether two files have the same times and bits, and the largest difference of any value over the largest of that variable.
fn difference(a: &Path, b: &Path) -> (bool, f64) {
    let [a, b] = [a, b].map(|path| Results::open(path).expect("results"));
    assert_eq!(a.times().len(), b.times().len());
    let (mut same, mut worst) = (a.times() == b.times(), 0.0f64);
    for state in 0..a.times().len() {
        let nodal = a.nodal_names().iter().map(|name| (a.nodal(name, state), b.nodal(name, state)));
        let element = a.element_names().iter().map(|name| (a.element(name, state), b.element(name, state)));
        for (one, other) in nodal.chain(element) {
            let (one, other) = (one.expect("values"), other.expect("values"));
            let largest = one.iter().fold(f64::MIN_POSITIVE, |most, value| value.abs().max(most));
            for (x, y) in one.iter().zip(&other) {
                same &= x.to_bits() == y.to_bits();
                worst = worst.max((x - y).abs() / largest);
            }
        }
    }
    (same, worst)
}

#[test]
fn what_a_slow_impact_did_not_need_changes_no_bit() {
    let desk = desk();
    let contact = "CONTACT MATERIAL\nCONTACT DATA, 1, 2, 0.3\nRIGID SURFACE, 100, -1., 0., 0., 1., 0., 0.\nDEATH, 1, EQPS, MAX, 0.5\n";
    let whole = deck(5.0, contact, "ELASTIC PLASTIC");
    let advice = advised(&desk, "whole", &whole, &[]);
    for ranks in ["2", "3"] {
        let again = advised(&desk, "again", &whole, &["--ranks", ranks]);
        let words = |list: &[Value]| list.iter().map(|one| one["words"].clone()).collect::<Vec<_>>();
        assert_eq!(words(&advice), words(&again));
    }
    let steps = [
        ("block 1 never flowed", "MATERIAL, 1, ELASTIC"),
        ("block 3 never flowed", "MATERIAL, 3, ELASTIC"),
        ("block 3 touched nothing", "CONTACT MATERIAL, 1, 2"),
        ("no edge touched another", "CONTACT EDGES, OFF"),
        ("the rigid plane of side set 100 was never touched", "a deck without it"),
        ("the rule of DEATH took nothing away", "a deck without DEATH"),
        ("nothing touched before time", "bodies that begin closer"),
    ];
    for (words, instead) in steps {
        let found = about(&advice, words).unwrap_or_else(|| panic!("{words}: {advice:#?}"));
        assert!(found["instead"].as_str().is_some_and(|text| text.contains(instead)), "{found}");
    }
    assert_eq!(advice.iter().filter(|one| one["kind"] == "spare" && one["keeps"] == "the same bits").count(), 6);
    // All that promises the same bits, at once and one by one.
    let lean = "CONTACT MATERIAL, 1, 2\nCONTACT DATA, 1, 2, 0.3\nCONTACT EDGES, OFF\n";
    let others = [
        ("lean", deck(5.0, lean, "ELASTIC")),
        (
            "elastic",
            deck(5.0, contact, "ELASTIC").replace("DEATH, 1, EQPS, MAX, 0.5\n", "DEATH, 1, VOLUME, MIN, 0.01\n"),
        ),
        ("edges", deck(5.0, &format!("{contact}CONTACT EDGES, OFF\n"), "ELASTIC PLASTIC")),
        ("blocks", deck(5.0, &contact.replace("MATERIAL\n", "MATERIAL, 1, 2\n"), "ELASTIC PLASTIC")),
        ("plane", whole.lines().filter(|line| !line.starts_with("RIGID")).collect::<Vec<_>>().join("\n")),
    ];
    for (name, other) in others {
        advised(&desk, name, &other, &[]);
        let found = difference_of_common(&desk, "whole", name);
        assert!(found.0, "{name}: {found:?}");
    }
}

/// The same of the variables that both files have.
fn difference_of_common(desk: &Desk, a: &str, b: &str) -> (bool, f64) {
    difference(&desk.path(&format!("{b}.e")), &desk.path(&format!("{a}.e")))
}

#[test]
fn what_was_needed_is_not_advised_against() {
    let desk = desk();
    // Fast enough to flow.
    let advice = advised(&desk, "fast", &deck(200.0, "CONTACT MATERIAL\n", "ELASTIC PLASTIC"), &[]);
    assert!(
        about(&advice, "block 1 never flowed").is_none() && about(&advice, "block 3 never flowed").is_some(),
        "{advice:#?}"
    );
    // Nothing is in the way.
    let advice = advised(&desk, "away", &deck(-5.0, "CONTACT MATERIAL\n", "ELASTIC"), &[]);
    let nothing = about(&advice, "nothing touched anything").expect("that is seen");
    assert_eq!(nothing["keeps"], "the same bits");
    advised(&desk, "without", &deck(-5.0, "", "ELASTIC").replace(", CONTACT", ""), &[]);
    let found = difference(&desk.path("without.e"), &desk.path("away.e"));
    assert!(found.0, "{found:?}");
}

#[test]
fn laws_that_never_flow_keep_what_is_promised() {
    let desk = desk();
    let elastic = deck(5.0, "CONTACT MATERIAL, 1, 2\n", "ELASTIC");
    advised(&desk, "elastic", &elastic, &[]);
    let laws = [
        ("EP POWER HARD", "YIELD STRESS = 500.E6\nHARDENING CONSTANT = 1.E9\nHARDENING EXPONENT = 0.5\n"),
        ("VISCOPLASTIC", "YIELD STRESS = 500.E6\nHARDENING MODULUS = 1.E9\nGAMMA = 1000.\nP = 2.\n"),
    ];
    for (law, properties) in laws {
        let plastic = elastic.replace(
            &format!("MATERIAL, 1, ELASTIC, 7850.\n{STEEL}"),
            &format!("MATERIAL, 1, {law}, 7850.\n{STEEL}{properties}"),
        );
        let advice = advised(&desk, "plastic", &plastic, &[]);
        let found = about(&advice, "block 1 never flowed").expect("it does not");
        assert_eq!(found["keeps"], "the same digits", "{law}");
        let (_, worst) = difference(&desk.path("elastic.e"), &desk.path("plastic.e"));
        // Round-off of sums of stress parts, over some hundred steps.
        assert!(worst < 1e-9, "{law}: {worst}");
    }
}

/// Of three plates of one element a rigid one does not bend, and one of eight points has stiffness in bending.
#[test]
fn walls_that_resist_bending_are_not_foretold() {
    let desk = desk();
    let plate = |block: u32| format!("BOX, {block}, 0., {block}., 0., 0.2, 0.02, 0.005, 20, 2, 1\n");
    desk.put("walls.mesh", &format!("TITLE\n WALLS\n{}", [1, 2, 3].map(plate).concat()));
    let law = |block: u32| format!("MATERIAL, {block}, ELASTIC, 7850.\n{STEEL}END\n");
    let laws = [1, 2, 3].map(law).concat();
    desk.put(
        "walls.i",
        &format!("TITLE\n WALLS\nTERMINATION TIME, 1.E-3\nRIGID BODY, 1\nELEMENT, 2, EIGHT POINTS\n{laws}EXIT\n"),
    );
    let told = desk.urto(&["check", "walls.i"]).with(0).out;
    let walls: Vec<&str> = told.lines().filter(|line| line.contains("is a wall of one element")).collect();
    assert!(walls.len() == 1 && walls[0].contains("block 3"), "{told}");
}

/// A plate of one element that bends, a single sliver, and states too far apart.
#[test]
fn what_a_scene_lacked_is_said() {
    let desk = desk();
    desk.put(
        "bars.mesh",
        "TITLE\n PLATE\nBOX, 1, 0., 0., 0., 0.2, 0.02, 0.005, 20, 2, 1\nNODE SET FACE, 1, 1, LEFT\nNODE SET FACE, 2, 1, RIGHT\n",
    );
    let plate = format!(
        "TITLE\n PLATE\nTERMINATION TIME, 20.E-3\nPLOT TIME, 5.E-3\nOUTPUT TIME, 0.1E-3\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n\
         NO DISPLACEMENT, Z, 1\nINITIAL VELOCITY NODESET, 2, 0., 0., 5.\nMATERIAL, 1, ELASTIC, 7850.\n{STEEL}END\nEXIT\n"
    );
    let advice = advised(&desk, "plate", &plate, &[]);
    let wall = about(&advice, "block 1 is a wall of one element that bends").expect("it is");
    assert_eq!(wall["kind"], "lacked");
    assert!(about(&advice, "and the kinetic energy turned").is_some(), "{advice:#?}");
    let log = desk.text("plate.o");
    assert!(log.contains("W H A T   T H E   S C E N E   L A C K E D"));
    // The same plate in four elements through its thickness has no such fault.
    let fine = std::fs::read_to_string(desk.path("bars.mesh")).expect("the recipe").replace("20, 2, 1", "40, 4, 4");
    desk.put("bars.mesh", &fine);
    let short = plate.replace("TERMINATION TIME, 20.E-3", "TERMINATION TIME, 2.E-3");
    assert!(about(&advised(&desk, "fine", &short, &[]), "wall of one element").is_none());
}

#[test]
fn a_sliver_that_sets_the_step_is_found_and_priced() {
    let desk = desk();
    desk.put(
        "bars.mesh",
        "TITLE\n SLIVER\nBOX, 1, 0., 0., 0., 0.1, 0.1, 0.1, 10, 10, 10\nBOX, 2, 0.2, 0., 0., 0.001, 0.01, 0.01, 1, 1, 1\n",
    );
    let deck = format!(
        "TITLE\n SLIVER\nTERMINATION TIME, 1.E-5\nINITIAL VELOCITY MATERIAL, 1, 1., 0., 0.\nMATERIAL, 1, ELASTIC, 7850.\n{STEEL}END\n\
         MATERIAL, 2, ELASTIC, 7850.\n{STEEL}END\nEXIT\n"
    );
    let advice = advised(&desk, "sliver", &deck, &[]);
    let found =
        about(&advice, "one element of 1001 set the step at the start").unwrap_or_else(|| panic!("{advice:#?}"));
    // The sliver has 1e-4 of the mass: as much again would make its step √2 times as long.
    assert!(found["words"].as_str().is_some_and(|text| text.contains("1.4 times as long")), "{found}");
    // The command as it is told is taken, and buys what is promised.
    let command = found["instead"].as_str().and_then(|text| text.split(", or").next()).expect("a command");
    advised(&desk, "scaled", &deck.replace("TITLE\n", &format!("{command}\nTITLE\n")), &[]);
    let steps = |name: &str| -> f64 {
        let read: Value = serde_json::from_str(&desk.text(name)).expect("JSON");
        read["steps"].as_f64().expect("a number")
    };
    let gain = steps("sliver.json") / steps("scaled.json");
    assert!((gain - 1.41).abs() < 0.05, "{gain}");
}

fn material(block: usize, law: &str, more: &str) -> String {
    format!("MATERIAL, {block}, {law}, 7850.\n{STEEL}{more}END\n")
}

/// What all these tests ask for, with `commands`, over 40 µs.
fn scene(commands: &str, materials: &[String]) -> String {
    format!(
        "TITLE\n SCENE\nTERMINATION TIME, 40.E-6\nPLOT TIME, 4.E-6\nPLOT NODAL, VELOCITY, CONTACT\nPLOT ELEMENT, STRESS, ENERGY\n\
         {commands}{}EXIT\n",
        materials.concat()
    )
}

fn words(list: &[Value]) -> Vec<&str> {
    list.iter().filter_map(|one| one["words"].as_str()).collect()
}

/// The command that an advice tells, up to what is said about it.
fn command(found: &Value) -> &str {
    found["instead"].as_str().and_then(|text| text.split(" leaves").next()).expect("a command")
}

/// States as often as steps: what output takes is said, and every other state has the same bits.
#[test]
fn output_that_takes_the_time_is_told_and_may_be_rarer() {
    let desk = desk();
    desk.put("bars.mesh", "TITLE\n BAR\nBOX, 1, 0., 0., 0., 0.1, 0.02, 0.02, 50, 10, 10\n");
    let deck = |apart: &str| {
        format!(
            "TITLE\n BAR\nTERMINATION TIME, 200.E-6\nPLOT TIME, {apart}\nPLOT NODAL, DISPLACEMENT, VELOCITY, ACCELERATION\n\
             PLOT ELEMENT, STRESS, STRAIN, ENERGY, PRESSURE, VONMISES\nINITIAL VELOCITY MATERIAL, 1, 1., 0., 0.\n{}EXIT\n",
            material(1, "ELASTIC", "")
        )
    };
    let advice = advised(&desk, "often", &deck("1.E-7"), &[]);
    let found = about(&advice, "output took").unwrap_or_else(|| panic!("{advice:#?}"));
    assert!(found["instead"].as_str().is_some_and(|text| text.contains("PLOT TIME, 2.000e-07")), "{found}");
    let share = found["share"].as_f64().expect("a share");
    assert!(share > 0.15 && share < 0.5, "{found}");
    advised(&desk, "rarely", &deck("2.E-7"), &[]);
    let [often, rarely] = ["often.e", "rarely.e"].map(|name| desk.results(name));
    let mut states = 0;
    for (state, time) in rarely.times().iter().enumerate() {
        let Some(same) = often.times().iter().position(|other| other == time) else { continue };
        states += 1;
        for name in ["VELX", "ACCLX"] {
            assert_eq!(rarely.nodal(name, state).expect("values"), often.nodal(name, same).expect("values"));
        }
    }
    assert!(states > rarely.times().len() / 2, "{states}");
}

/// Every kind of element, single precision, a rigid block, ties: a block that never flowed gives the same bits when it is ELASTIC.
#[test]
fn what_never_flowed_is_elastic_to_the_bit_in_every_element() {
    let desk = desk();
    let bar = "BOX, 1, 0., 0., 0., 0.02, 0.02, 0.05, 3, 3, 6\nNODE SET PLANE, 1, Z, 0.\n";
    let sheet = "SHEET, 1, 0., 0., 0., 0.05, 0.05, 0., 8, 8\nNODE SET PLANE, 1, X, 0.\n";
    let line = "LINE, 1, 0., 0., 0., 0.1, 0., 0., 10\nNODE SET PLANE, 1, X, 0.\n";
    let section = "RECTANGLE, 1, 0., 0., 0.02, 0.05, 6, 12\nNODE SET PLANE, 1, Y, 0.\n";
    let blow = "NO DISPLACEMENT, Z, 1\nNO DISPLACEMENT, X, 1\nINITIAL VELOCITY MATERIAL, 1, 1., 0., -2.\n";
    let of_plane = "NO DISPLACEMENT, Y, 1\nINITIAL VELOCITY MATERIAL, 1, 0., -2.\n";
    let tied = "BOX, 1, 0., 0., 0., 0.02, 0.02, 0.05, 3, 3, 6\nBOX, 2, 0., 0., -0.02, 0.02, 0.02, 0.02, 4, 4, 4\n\
                SIDE SET FACE, 200, 1, BOTTOM\nSIDE SET FACE, 100, 2, TOP\nNODE SET PLANE, 1, Z, -0.02\n";
    let triangles = format!("{sheet}TRIANGLES, 1\n");
    let scenes = [
        ("hexahedra", bar, "", blow),
        ("eight points", bar, "ELEMENT, 1, EIGHT POINTS\n", blow),
        ("single precision", bar, "PRECISION, SINGLE\n", blow),
        ("rigid body", tied, "RIGID BODY, 2\nCONTACT MATERIAL\n", "INITIAL VELOCITY MATERIAL, 1, 0., 0., -2.\n"),
        ("ties", tied, "TIED CONTACT, 100, 200\n", blow),
        ("shells", sheet, "SHELL THICKNESS, 1, 0.001\n", blow),
        ("triangles", &triangles, "SHELL THICKNESS, 1, 0.001\n", blow),
        ("beams", line, "BEAM SECTION, 1, ROD, 0.01\n", blow),
        ("trusses", line, "TRUSS AREA, 1, 1.E-4\n", blow),
        ("plane strain", section, "PLANE STRAIN\n", of_plane),
        ("body of revolution", section, "AXISYMMETRIC\n", of_plane),
    ];
    for (name, mesh, commands, motion) in scenes {
        desk.put("bars.mesh", &format!("TITLE\n SCENE\n{mesh}"));
        let blocks = if mesh == tied { 2 } else { 1 };
        let deck = |law: &str, more: &str| {
            let materials: Vec<String> = (1..=blocks).map(|block| material(block, law, more)).collect();
            scene(&format!("{commands}{motion}"), &materials).replace(", CONTACT\n", "\n")
        };
        let plastic = deck("ELASTIC PLASTIC", "YIELD STRESS = 50.E9\nHARDENING MODULUS = 1.E9\n");
        let advice = advised(&desk, "plastic", &plastic, &[]);
        let found = about(&advice, "block 1 never flowed").unwrap_or_else(|| panic!("{name}: {:#?}", words(&advice)));
        assert_eq!(found["keeps"], "the same bits", "{name}");
        assert_eq!(words(&advice), words(&advised(&desk, "again", &plastic, &["--ranks", "2"])), "{name}");
        advised(&desk, "elastic", &deck("ELASTIC", ""), &[]);
        assert!(difference_of_common(&desk, "plastic", "elastic").0, "{name}");
    }
    // What goes with the variable is told, and the deck is taken then.
    desk.put("bars.mesh", &format!("TITLE\n SCENE\n{bar}"));
    let deck = |law: &str, more: &str, commands: &str| scene(&format!("{commands}{blow}"), &[material(1, law, more)]);
    let eqps = "DEATH, 1, EQPS, MAX, 0.5\nPLOT STATE, EQPS\n";
    let plastic = "YIELD STRESS = 50.E9\nHARDENING MODULUS = 1.E9\n";
    let advice = advised(&desk, "watched", &deck("ELASTIC PLASTIC", plastic, eqps).replace(", CONTACT\n", "\n"), &[]);
    let found = about(&advice, "block 1 never flowed").expect("it does not");
    assert_eq!(found["instead"], "MATERIAL, 1, ELASTIC, without the DEATH that watches it and PLOT STATE, EQPS,");
    advised(&desk, "bare", &deck("ELASTIC", "", "").replace(", CONTACT\n", "\n"), &[]);
    assert!(difference_of_common(&desk, "watched", "bare").0);
}

/// A run that goes on from a restart has not seen its beginning: it says nothing of contact.
#[test]
fn what_goes_on_says_nothing_of_what_it_has_not_seen() {
    let desk = desk();
    let whole = deck(5.0, "CONTACT MATERIAL\nWRITE RESTART, 15.E-6\n", "ELASTIC");
    let advice = advised(&desk, "whole", &whole, &[]);
    assert!(about(&advice, "block 3 touched nothing").is_some(), "{:#?}", words(&advice));
    let further = whole.replace("TERMINATION TIME, 40.E-6", "TERMINATION TIME, 60.E-6");
    let advice = advised(&desk, "further", &further, &["--restart", "whole.rsout"]);
    assert!(
        words(&advice).iter().all(|told| !told.contains("touched") && !told.contains("edge")),
        "{:#?}",
        words(&advice)
    );
}
