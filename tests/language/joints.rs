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
    let loose = urto::solver::loose(&mesh, &problem.model).into_iter().map(|joint| joint.what);
    problem.diagnostics.warnings().map(|warning| warning.message.clone()).chain(loose).collect()
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

/// Skins, frames on several feet, and what conditions or rigid bodies hold carry their moments.
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

const TRUSS: &str = "TRUSS AREA, 2, 0.01\n";
/// Another cube, from x = 1 on.
const OTHER: &str = "BOX, 3, 1., -0.2, -0.2, 0.4, 0.4, 0.4, 4, 4, 4\n";

/// A strut of several trusses folds, one with a free end swings, a frame on one foot turns about it.
#[test]
fn trusses_that_nothing_holds_across_are_told() {
    let strut = |pieces: usize| format!("{CUBE}{OTHER}LINE, 2, 0., 0., 0., 1., 0., 0., {pieces}\n");
    let several = warnings(TRUSS, &strut(10), &[1, 2, 3]);
    assert_eq!(several.len(), 1, "{several:?}");
    assert!(
        several[0].starts_with("trusses of block 2 do not hold node") && several[0].contains(" and 8 more"),
        "{several:?}"
    );
    let inside = format!("{CUBE}{OTHER}LINE, 2, -0.1, 0., 0., 1.1, 0., 0., 12\n");
    let inside = warnings(TRUSS, &inside, &[1, 2, 3]);
    assert!(inside.len() == 1 && inside[0].contains(" and 8 more"), "{inside:?}");
    let free = warnings(TRUSS, &format!("{CUBE}LINE, 2, 0., 0., 0., 1., 0., 0., 1\n"), &[1, 2]);
    assert!(free.len() == 1 && free[0].contains("at (1.0000e0, 0.0000e0, 0.0000e0) in all directions"), "{free:?}");
    let ends = ["0., 0., 0.", "1., 0., 0.", "0.5, 0.5, 0.", "0.5, 0., 0.5"];
    let edges = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    let frame: String = edges.iter().map(|[a, b]| format!("LINE, 2, {}, {}, 1\n", ends[*a], ends[*b])).collect();
    let frame = warnings(TRUSS, &format!("{CUBE}{frame}"), &[1, 2]);
    assert!(frame.len() == 1 && frame[0].contains("trusses of block 2 turn freely about node"), "{frame:?}");
}

/// What is held in all directions, and what is held by the deck alone.
#[test]
fn trusses_that_are_held_are_not_told() {
    let strut =
        |pieces: usize| format!("{CUBE}{OTHER}LINE, 2, 0., 0., 0., 1., 0., 0., {pieces}\nNODE SET BLOCK, 1, 2\n");
    let tripod = ["0., 0., 0.", "0., 0.1, 0.", "0., 0., 0.1"].map(|foot| format!("LINE, 2, {foot}, 1., 0., 0., 1\n"));
    let tripod = format!("{CUBE}{}", tripod.concat());
    let across = format!("{TRUSS}NO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n");
    for (commands, recipe, blocks) in [
        (TRUSS, strut(1), &[1, 2, 3][..]),
        (TRUSS, format!("{CUBE}LINE, 2, -0.4, 0., 0., 0., 0., 0., 4\n"), &[1, 2]),
        (TRUSS, tripod, &[1, 2]),
        (&across, strut(10), &[1, 2, 3]),
        (TRUSS, "LINE, 2, 0., 0., 0., 1., 0., 0., 4\n".to_string(), &[2]),
    ] {
        assert_eq!(warnings(commands, &recipe, blocks), Vec::<String>::new(), "{commands}\n{recipe}");
    }
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
