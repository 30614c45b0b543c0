//! Advice about contact and joints.

use super::{STEEL, about, advised, command, deck, desk, difference_of_common, material, scene, words};
use crate::program::Desk;
use serde_json::Value;

/// Two bars side by side strike a plate, which both touch; they never touch each other, nothing touches itself, and their friction
/// holds.
#[test]
fn blocks_that_never_touch_each_other_are_left_out_to_the_bit() {
    let desk = desk();
    desk.put(
        "bars.mesh",
        "TITLE\n PAIRS\nBOX, 1, 0., 0., 0.001, 0.01, 0.01, 0.03, 4, 4, 8\n\
         BOX, 2, -0.005, -0.005, -0.01, 0.035, 0.02, 0.01, 10, 6, 3\nBOX, 3, 0.0102, 0., 0.001, 0.01, 0.01, 0.03, 4, 4, 8\n\
         NODE SET FACE, 2, 2, BOTTOM\n",
    );
    let steel: Vec<String> = (1..=3).map(|block| material(block, "ELASTIC", "")).collect();
    let contact = "CONTACT MATERIAL\nCONTACT DATA, ALL, ALL, 5.\n";
    let deck = |more: &str| {
        let motion = "NO DISPLACEMENT, Z, 2\nINITIAL VELOCITY MATERIAL, 1, 0., 0., -60.\nINITIAL VELOCITY MATERIAL, 3, 0., 0., -60.\n";
        scene(&format!("{motion}{contact}{more}"), &steel)
    };
    let advice = advised(&desk, "whole", &deck(""), &[]);
    let told = words(&advice);
    for ranks in ["2", "3"] {
        assert_eq!(told, words(&advised(&desk, "again", &deck(""), &["--ranks", ranks])));
    }
    let mut all = String::new();
    for (seen, wanted) in [
        ("blocks 1 and 3 never touched each other", "CONTACT EXCLUSION, 1, 3"),
        ("no block touched itself", "CONTACT EXCLUSION, ALL"),
    ] {
        let found = about(&advice, seen).unwrap_or_else(|| panic!("{seen}: {told:#?}"));
        assert_eq!((command(found), &found["keeps"]), (wanted, &Value::from("the same bits")), "{found}");
        for ranks in ["1", "3"] {
            advised(&desk, "apart", &deck(&format!("{wanted}\n")), &["--ranks", ranks]);
            assert!(difference_of_common(&desk, "whole", "apart").0, "{wanted} on {ranks} ranks");
        }
        all += &format!("{wanted}\n");
    }
    // Both at once leave less to look at, and nothing to be advised of any more.
    let advice = advised(&desk, "apart", &deck(&all), &[]);
    assert!(difference_of_common(&desk, "whole", "apart").0);
    assert!(about(&advice, "never touched").is_none() && about(&advice, "touched itself").is_none(), "{advice:#?}");
    let pairs = |name: &str| {
        let log = desk.text(name);
        let line = log.lines().find(|line| line.contains("PAIRS OF THEM")).expect("contact").to_string();
        line.split_whitespace().next_back().and_then(|number| number.parse::<f64>().ok()).expect("a number")
    };
    assert!(pairs("apart.o") < 0.8 * pairs("whole.o"), "{} {}", pairs("apart.o"), pairs("whole.o"));
    // What is kept apart against what happens goes through.
    let advice = advised(&desk, "through", &deck("CONTACT EXCLUSION, 1, 2\n"), &[]);
    assert!(!difference_of_common(&desk, "whole", "through").0);
    assert!(about(&advice, "block 1 touched nothing").is_some(), "{:#?}", words(&advice));
}

/// A block on a rough floor, struck by another, beside a wall far away that flies past: the floor's friction holds.
#[test]
fn a_plane_that_is_never_touched_and_friction_that_holds_change_no_bit() {
    let desk = desk();
    desk.put(
        "bars.mesh",
        "TITLE\n PLANES\nBOX, 1, 0., 0., 0.0201, 0.02, 0.02, 0.02, 4, 4, 4\nBOX, 2, -0.01, -0.01, 0., 0.04, 0.04, 0.02, 8, 8, 4\n\
         SIDE SET FACE, 100, 2, BOTTOM\nSIDE SET FACE, 200, 1, LEFT\nBOX, 3, 0., 0.2, 0., 0.01, 0.01, 0.01, 2, 2, 2\n",
    );
    let steel: Vec<String> = (1..=3).map(|block| material(block, "ELASTIC", "")).collect();
    let deck = |friction: f64, more: &str| {
        let floor = format!("RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., {friction}\n");
        let motion = "INITIAL VELOCITY MATERIAL, 1, 0., 0., -30.\nINITIAL VELOCITY MATERIAL, 3, 500., 0., 0.\nCONTACT MATERIAL\n";
        scene(&format!("{motion}{floor}{more}"), &steel)
    };
    let wall = "RIGID SURFACE, 200, -5., 0., 0., 1., 0., 0.\n";
    let advice = advised(&desk, "whole", &deck(5.0, wall), &[]);
    let told = words(&advice);
    assert_eq!(told, words(&advised(&desk, "again", &deck(5.0, wall), &["--ranks", "3"])));
    for seen in ["the rigid plane of side set 200 was never touched", "friction never slid"] {
        let found = about(&advice, seen).unwrap_or_else(|| panic!("{seen}: {told:#?}"));
        assert_eq!(found["keeps"], "the same bits");
    }
    assert!(about(&advice, "the rigid plane of side set 100").is_none());
    advised(&desk, "open", &deck(5.0, ""), &[]);
    assert!(difference_of_common(&desk, "whole", "open").0);
    advised(&desk, "rougher", &deck(50.0, wall), &[]);
    assert!(difference_of_common(&desk, "whole", "rougher").0);
    // With next to no friction it slides.
    let advice = advised(&desk, "slides", &deck(1e-3, wall), &[]);
    assert!(about(&advice, "friction").is_none(), "{:#?}", words(&advice));
    assert!(!difference_of_common(&desk, "whole", "slides").0);
    // Where a plane pushes, leaving an idle block out of contact promises nothing.
    let found = about(&advice, "block 3 touched nothing").expect("it flies away");
    assert_eq!(found["keeps"], "", "{found}");
}

/// A pile of blocks of unlike meshes, struck from above at an angle: passes whose leaving out is priced.
#[test]
fn a_looser_tolerance_spares_the_passes_that_it_is_said_to() {
    let desk = desk();
    let block = |i: usize| {
        let cells = 3 + i % 2;
        format!("BOX, {}, 0., 0., {}, 0.02, 0.02, 0.01, {cells}, {cells}, 2\n", i + 1, 0.01 * i as f64)
    };
    let blocks: String = (0..8).map(block).collect();
    desk.put("bars.mesh", &format!("TITLE\n PILE\n{blocks}SIDE SET FACE, 100, 1, BOTTOM\n"));
    let steel: Vec<String> = (1..=8).map(|block| material(block, "ELASTIC", "")).collect();
    let deck = |more: &str| {
        let motion = "INITIAL VELOCITY MATERIAL, 8, 3., 0., -40.\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.3\n";
        let contact = "CONTACT MATERIAL\nCONTACT DATA, ALL, ALL, 0.2\n";
        scene(&format!("{motion}{contact}{more}"), &steel)
    };
    let tight = "CONTACT PASSES, 100, 1.E-7\n";
    let advice = advised(&desk, "tight", &deck(tight), &[]);
    let found = about(&advice, "of the passes of contact").unwrap_or_else(|| panic!("{:#?}", words(&advice)));
    assert_eq!(found["keeps"], "", "no digit is promised");
    assert_eq!(words(&advice), words(&advised(&desk, "again", &deck(tight), &["--ranks", "3"])));
    let share: f64 = found["words"].as_str().and_then(|text| text.split(" %").next()?.parse().ok()).expect("a share");
    advised(&desk, "loose", &deck(&format!("{}\n", command(found))), &[]);
    let passes = |name: &str| {
        let log = desk.text(name);
        let of = |label: &str| -> f64 {
            let line = log.lines().find(|line| line.contains(label)).expect("contact").to_string();
            line.split_whitespace().next_back().and_then(|number| number.parse().ok()).expect("a number")
        };
        of("STEPS WITH CONTACT FORCES") * of("PASSES IN SUCH A STEP")
    };
    // The passes of the steps that come are those of a motion that is not quite the same.
    let spared = 100.0 * (1.0 - passes("loose.o") / passes("tight.o"));
    assert!((spared - share).abs() < 5.0, "{spared} % instead of {share} %");
    assert!(!difference_of_common(&desk, "tight", "loose").0);
    // Nothing but the tolerance says when passes end: a coarser one than usual saves them as well.
    advised(&desk, "usual", &deck(""), &[]);
    advised(&desk, "coarse", &deck("CONTACT PASSES, 20, 1.E-3\n"), &[]);
    let [usual, coarse] = ["usual.o", "coarse.o"].map(passes);
    println!("{usual} passes as usual, {coarse} to 1.E-3");
    assert!(coarse < 0.5 * usual, "{coarse} instead of {usual}");
}

/// A ball on a plate: coarse, it touches with a node or two; fine, with many elements.
#[test]
fn a_ball_that_touches_with_single_nodes_lacked_elements() {
    let desk = desk();
    let balls = |cells: usize, plate: usize| {
        format!(
            "TITLE\n BALL\nSPHERE, 1, 0.01, {cells}\nTRANSLATE, 1, 0., 0., 0.0101\n\
             BOX, 2, -0.01, -0.01, -0.01, 0.02, 0.02, 0.01, {plate}, {plate}, 4\nNODE SET FACE, 2, 2, BOTTOM\n"
        )
    };
    let deck = scene(
        "NO DISPLACEMENT, Z, 2\nINITIAL VELOCITY MATERIAL, 1, 0., 0., -100.\nCONTACT MATERIAL\n",
        &[material(1, "ELASTIC", ""), material(2, "ELASTIC", "")],
    );
    desk.put("bars.mesh", &balls(2, 8));
    let seen = "block 1 touched where it is curved, but never with two elements side by side along the arc";
    let advice = advised(&desk, "coarse", &deck, &[]);
    assert_eq!(about(&advice, seen).map(|found| &found["kind"]), Some(&Value::from("lacked")), "{:#?}", words(&advice));
    assert!(about(&advice, "block 2 touched where").is_none());
    assert_eq!(words(&advice), words(&advised(&desk, "again", &deck, &["--ranks", "3"])));
    desk.put("bars.mesh", &balls(10, 20));
    let advice = advised(&desk, "fine", &deck, &[]);
    assert!(about(&advice, "where it is curved").is_none(), "{:#?}", words(&advice));
}

/// What geometry and the speeds of the start tell is told before a run, and the run agrees.
#[test]
fn check_foretells_who_meets_nobody_and_when_contact_can_begin() {
    let desk = desk();
    desk.put("bars.i", &deck(5.0, "CONTACT MATERIAL\n", "ELASTIC"));
    let told = desk.urto(&["check", "bars.i", "-m", "bars.mesh"]).with(0).out;
    assert!(told.contains("foretold: block 3 reaches no other at the speeds of the start"), "{told}");
    // A tenth of a millimetre at no more than twice 5 m/s.
    assert!(
        told.contains("foretold: no two blocks touch before time 1.000e-05 at the speeds of the start, 25 %"),
        "{told}"
    );
    let advice = advised(&desk, "bars", &deck(5.0, "CONTACT MATERIAL\n", "ELASTIC"), &[]);
    assert!(about(&advice, "block 3 touched nothing").is_some());
    let seen =
        about(&advice, "nothing touched before time").and_then(|found| found["words"].as_str()).expect("it is late");
    let time: f64 =
        seen.split_whitespace().nth(4).and_then(|text| text.trim_end_matches(',').parse().ok()).expect("a time");
    assert!(time >= 1e-5, "{seen}");
}

/// Mass is added for a longer step, and joints take it away again: both are said in one place, before the run and after it, and with the other side following
/// the step is what was asked for, so that the run takes as much fewer steps.
#[test]
fn joints_that_take_back_what_mass_was_added_for_are_told() {
    let desk = Desk::new();
    desk.put(
        "bars.mesh",
        "TITLE\n TIED\nBOX, 1, 0., 0., 0., 0.02, 0.02, 0.02, 8, 8, 4\nBOX, 2, 0., 0., 0.02, 0.02, 0.02, 0.02, 2, 2, 2\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n",
    );
    let deck = |follows: &str| {
        format!(
            "TITLE\n TIED\nTERMINATION TIME, 40.E-6\nPLOT TIME, 40.E-6\nTIED CONTACT, {follows}\nMASS SCALING, ALL, STEP, 8.E-7, 10.\n\
             MATERIAL, 1, ELASTIC, 7850.\n{STEEL}END\nMATERIAL, 2, ELASTIC, 7850.\n{STEEL}END\nEXIT\n"
        )
    };
    let words = "joints of TIED CONTACT make all steps";
    let coarse = advised(&desk, "coarse", &deck("200, 100"), &[]);
    let told = about(&coarse, words).unwrap_or_else(|| panic!("{coarse:#?}"));
    assert!(
        told["words"].as_str().is_some_and(|text| text.contains("of the step of 8.000e-07 that MASS SCALING asks"))
    );
    assert!(told["instead"].as_str().is_some_and(|text| text.contains("TIED CONTACT, 100, 200")), "{told}");
    desk.urto(&["check", "coarse.i", "-m", "bars.mesh"]).with(0).says(&[words, "by joints of TIED CONTACT, set by"]);
    let fine = advised(&desk, "fine", &deck("100, 200"), &[]);
    assert!(about(&fine, words).is_none(), "{fine:#?}");
    let steps = |name: &str| {
        let found: Value = serde_json::from_str(&desk.text(&format!("{name}.json"))).expect("JSON");
        found["steps"].as_u64().expect("steps")
    };
    // 40 microseconds in steps of 0.8; nothing moves, so that no element gets another step.
    assert_eq!(steps("fine"), 50);
    assert!(steps("coarse") > 60, "{}", steps("coarse"));
}
