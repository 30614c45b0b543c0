//! Joints that carry no moments, and bars that go through bars: what a deck and its mesh are warned of.

use urto::{deck::Source, model::examine};

/// What is warned of with this recipe; its blocks are elastic.
fn warnings(commands: &str, recipe: &str, blocks: &[i64]) -> Vec<String> {
    let mesh = urto::mesher::make(&format!("{recipe}MERGE\n"), "t.mesh", 1).expect("a mesh");
    let materials: String = blocks
        .iter()
        .map(|block| format!("MATERIAL, {block}, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n"))
        .collect();
    let problem = examine(Source::new("t.i", format!("TERMINATION TIME, 1.\n{commands}{materials}")), Some(&mesh));
    let problem = problem.expect("a problem");
    problem.diagnostics.warnings().map(|warning| warning.message.clone()).collect()
}

/// A cube of 4 × 4 × 4 elements that ends at x = 0.
const CUBE: &str = "BOX, 1, -0.4, -0.2, -0.2, 0.4, 0.4, 0.4, 4, 4, 4\n";
const BEAM: &str = "BEAM SECTION, 2, ROD, 0.01\n";
const SHELL: &str = "SHELL THICKNESS, 2, 0.01\n";

/// One node is a hinge, a line of them one about it; three that are not in a line carry any moment.
#[test]
fn beams_and_shells_that_solids_leave_free_to_turn_are_told() {
    let beam = |from: f64| format!("{CUBE}LINE, 2, {from}, 0., 0., 1., 0., 0., 10\n");
    let on_face = warnings(BEAM, &beam(0.0), &[1, 2]);
    assert_eq!(on_face.len(), 1, "{on_face:?}");
    assert!(on_face[0].contains("beams or shells of block 2 are hinged to solids by node"), "{on_face:?}");
    assert!(on_face[0].contains("at (0.0000e0, 0.0000e0, 0.0000e0)"), "{on_face:?}");
    let inside = format!("{CUBE}LINE, 2, -0.1, 0., 0., 1., 0., 0., 11\n");
    let inside = warnings(BEAM, &inside, &[1, 2]);
    assert!(inside.len() == 1 && inside[0].contains("turn freely about it, from node"), "{inside:?}");
    let edge = warnings(SHELL, &format!("{CUBE}SHEET, 2, 0., -0.2, 0., 1., 0.4, 0., 10, 4\n"), &[1, 2]);
    assert!(edge.len() == 1 && edge[0].contains("in one line only"), "{edge:?}");
    assert!(edge[0].contains("-2.0000e-1, 0.0000e0)") && edge[0].contains(" 2.0000e-1, 0.0000e0)"), "{edge:?}");
    let two = format!("{}LINE, 2, 0., 0.1, 0., 1., 0.1, 0., 10\n", beam(0.0));
    let two = warnings(BEAM, &two, &[1, 2]);
    assert!(two.len() == 1 && two[0].contains("in 2 places in all"), "{two:?}");
}

/// Skins, frames on several feet, and what conditions or rigid bodies hold carry their moments; trusses have none.
#[test]
fn joints_that_carry_moments_are_not_told() {
    let beam = format!("{CUBE}LINE, 2, 0., 0., 0., 1., 0., 0., 10\nNODE SET POINT, 1, 1., 0., 0.\n");
    let skin = format!("{CUBE}SHEET, 2, -0.4, -0.2, 0.2, 0.4, 0.4, 0., 4, 4\n");
    let carried_on = format!("{CUBE}SHEET, 2, -0.1, -0.2, 0., 1.1, 0.4, 0., 11, 4\n");
    let frame = format!("{beam}LINE, 2, 0., 0.1, 0., 1., 0., 0., 10\nLINE, 2, 0., 0., 0.1, 1., 0., 0., 10\n");
    let on_edge = format!("{CUBE}SHEET, 2, 0., -0.2, 0., 1., 0.4, 0., 10, 4\nNODE SET PLANE, 1, X, 1.\n");
    for (commands, recipe) in [
        (SHELL, skin.as_str()),
        (SHELL, &carried_on),
        (BEAM, &frame),
        ("TRUSS AREA, 2, 0.01\n", &beam),
        ("BEAM SECTION, 2, ROD, 0.01\nRIGID BODY, 1\n", &beam),
        ("BEAM SECTION, 2, ROD, 0.01\nNO ROTATION, X, 1\n", &beam),
        ("SHELL THICKNESS, 2, 0.01\nINTEGRATION POINTS, 2, 1\n", &on_edge),
    ] {
        assert_eq!(warnings(commands, recipe, &[1, 2]), Vec::<String>::new(), "{commands}\n{recipe}");
    }
    // Held in place only, along a second line: together they hold all.
    let held = "SHELL THICKNESS, 2, 0.01\nNO DISPLACEMENT, Z, 1\n";
    assert_eq!(warnings(held, &on_edge, &[1, 2]), Vec::<String>::new());
}

/// Bars that may meet bars are told once; not those that are built together, or kept apart.
#[test]
fn bars_that_go_through_bars_are_told() {
    let crossing = "LINE, 1, -1., 0., 0., 1., 0., 0., 8\nLINE, 2, 0., -1., 0.1, 0., 1., 0.1, 8\n";
    let joined = "LINE, 1, -1., 0., 0., 1., 0., 0., 8\nLINE, 2, 0., -1., 0., 0., 1., 0., 8\n";
    let areas = "TRUSS AREA, 1, 0.01\nTRUSS AREA, 2, 0.01\n";
    let of = |commands: &str, recipe: &str| warnings(&format!("{areas}{commands}"), recipe, &[1, 2]);
    let words = "CONTACT MATERIAL: bars go through bars, those of block 2 through those of block 1";
    assert_eq!(of("CONTACT MATERIAL\n", crossing), [words]);
    for (commands, recipe) in [
        ("CONTACT MATERIAL\n", joined),
        ("CONTACT MATERIAL\nCONTACT EXCLUSION, 2, 1\n", crossing),
        ("CONTACT MATERIAL\nCONTACT EXCLUSION, ALL, 1\n", crossing),
        ("CONTACT MATERIAL, 1\n", crossing),
        ("", crossing),
    ] {
        assert_eq!(of(commands, recipe), Vec::<String>::new(), "{commands}");
    }
}
