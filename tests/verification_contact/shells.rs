//! Contact of shells, trusses and beams: at their thickness, on both sides, with each other, with solids and with themselves.
//!
//! `cargo test --test verification_contact shells:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::bodies::nodes_of;
use crate::support::continued::{Case, assert_same};
use crate::support::meshes::recipe;
use crate::support::run::{Run, State, run_on};
use crate::support::surfaces::Surfaces;
use crate::support::{between, close};
use urto::mesh::Mesh;

/// Thickness of the sheets.
const T: f64 = 2e-3;

/// A deck that lets all blocks touch; `more` are further commands.
fn deck(end: f64, more: &str, blocks: i64) -> String {
    let elastic = "YOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";
    let materials: String = (1..=blocks).map(|block| format!("MATERIAL, {block}, ELASTIC, 8000.\n{elastic}")).collect();
    format!(
        "TITLE\n SHELLS THAT TOUCH\nTERMINATION TIME, {end}\nOUTPUT TIME, {0}\nPLOT TIME, {0}\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT\nCONTACT MATERIAL\n{more}{materials}EXIT\n",
        end / 20.0
    )
}

/// The same scene on one rank and on three, which must give the same bits.
fn on_ranks(text: &str, mesh: &Mesh) -> Run {
    let (one, three) = (run_on(1, text, mesh).whole(), run_on(3, text, mesh).whole());
    for name in ["DISPLX", "DISPLY", "DISPLZ"] {
        assert!(one.end().nodal(name) == three.end().nodal(name), "{name} has not the same bits on three ranks");
    }
    one
}

/// Nothing goes through anything in any state; energy and momentum; returns the least distance between surfaces, in `thickness`.
fn sound(case: &str, run: &Run, mesh: &Mesh, thickness: f64) -> f64 {
    let surfaces = Surfaces::new(mesh);
    let mut least = f64::INFINITY;
    for state in &run.states {
        let at = state.positions(mesh);
        assert_eq!(surfaces.pierced(&at), [], "{case}, time {}", state.time);
        least = least.min(surfaces.nearest(&at).0);
    }
    println!("{case} least distance over thickness: {:.4}", least / thickness);
    between(
        case,
        "work of contact over the initial energy",
        run.last().totals.contact / run.initial_energy,
        -1.0,
        1e-12,
    );
    between(case, "energy balance", run.worst_balance(), 0.0, 5e-3);
    least / thickness
}

/// Two sheets one above the other, `gap` between their middle surfaces; nodes do not meet nodes, and the upper one is turned
/// upside down where `flipped`.
fn two_sheets(gap: f64, flipped: bool) -> Mesh {
    let mut mesh = two_sheets_of(gap, "");
    if flipped {
        mesh.blocks[1].nodes.chunks_exact_mut(4).for_each(|nodes| nodes.swap(1, 3));
    }
    mesh
}

/// The same with more lines of the recipe.
fn two_sheets_of(gap: f64, more: &str) -> Mesh {
    recipe(&format!(
        "TITLE\n TWO SHEETS\nSHEET, 1,  0., 0., 0.,  0.1, 0.1, 0.,  5, 5\n\
         SHEET, 2,  0.013, 0.011, {gap},  0.07, 0.07, 0.,  4, 4\n{more}"
    ))
}

/// A sheet that falls on another one, free to move, from above or from below, whichever way the sheets look: they stop
/// each other with half the thickness of each in between, and go on with the momentum that came.
#[test]
fn sheets_stop_each_other_at_their_thickness() {
    for (gap, flipped, factor) in [(1.5, false, 1.0), (1.5, true, 1.0), (-1.5, false, 1.0), (-1.5, true, 0.5)] {
        let mesh = two_sheets(gap * T, flipped);
        let more = format!(
            "SHELL THICKNESS, 1, {T}\nSHELL THICKNESS, 2, {T}\nINITIAL VELOCITY MATERIAL, 2, 0., 0., {}\n\
             CONTACT THICKNESS, 1, {factor}\nCONTACT THICKNESS, 2, {factor}\n",
            -10.0 * f64::signum(gap)
        );
        let run = on_ranks(&deck(5e-4, &more, 2), &mesh);
        let least = sound("sheets", &run, &mesh, T);
        between("sheets", "least distance over that at which they touch", least / factor, 0.999, 1.001);
        close("sheets", "momentum", run.last().totals.momentum[2], run.lines[0].totals.momentum[2], 1e-10);
    }
}

/// Two sheets in exactly one plane that come together in it, edge to edge and corner to edge, whichever way they look: they stop each
/// other with half of each thickness in between.
#[test]
fn sheets_in_one_plane_meet_edge_to_edge() {
    for (turned, flipped, triangles) in [
        (0.0, false, ""),
        (0.0, true, ""),
        (45.0, false, ""),
        (45.0, true, ""),
        (0.0, false, "TRIANGLES, 1\nTRIANGLES, 2\n"),
    ] {
        // Turned by 45 degrees about its middle, a corner comes first.
        let half = if turned == 0.0 { 0.035 } else { 0.035 * std::f64::consts::SQRT_2 };
        let mut mesh = recipe(&format!(
            "TITLE\n TWO SHEETS\nSHEET, 1,  0., 0., 0.,  0.1, 0.1, 0.,  5, 5\n\
             SHEET, 2,  -0.035, -0.035, 0.,  0.07, 0.07, 0.,  4, 4\nROTATE, 2, Z, {turned}\n\
             TRANSLATE, 2, {}, 0.047, 0.\n{triangles}",
            0.1 + half + 1.5 * T
        ));
        if flipped {
            mesh.blocks[1].nodes.chunks_exact_mut(4).for_each(|nodes| nodes.swap(1, 3));
        }
        let more =
            format!("SHELL THICKNESS, 1, {T}\nSHELL THICKNESS, 2, {T}\nINITIAL VELOCITY MATERIAL, 2, -10., 0., 0.\n");
        let run = on_ranks(&deck(5e-4, &more, 2), &mesh);
        let least = sound("one plane", &run, &mesh, T);
        between("one plane", "least distance over that at which they touch", least, 0.99, 1.01);
        close("one plane", "momentum", run.last().totals.momentum[0], run.lines[0].totals.momentum[0], 1e-10);
        let (speeds, nodes) = (run.end().nodal("VELX"), nodes_of(&mesh, 1));
        let mean = nodes.iter().map(|&node| speeds[node]).sum::<f64>() / nodes.len() as f64;
        between("one plane", "mean velocity of the sheet that was at rest", mean, -10.0, -1.0);
    }
}

/// The same where one of the sheets, or both, are of triangles.
#[test]
fn sheets_of_triangles_stop_each_other_at_their_thickness() {
    for (gap, triangles) in
        [(1.5, "TRIANGLES, 1\n"), (-1.5, "TRIANGLES, 2\n"), (1.5, "TRIANGLES, 1\nTRIANGLES, 2, CROSS\n")]
    {
        let mesh = two_sheets_of(gap * T, triangles);
        let speed = -10.0 * f64::signum(gap);
        let more = format!(
            "SHELL THICKNESS, 1, {T}\nSHELL THICKNESS, 2, {T}\nINITIAL VELOCITY MATERIAL, 2, 0., 0., {speed}\n"
        );
        let run = on_ranks(&deck(5e-4, &more, 2), &mesh);
        let least = sound("triangles", &run, &mesh, T);
        between("triangles", "least distance over that at which they touch", least, 0.999, 1.001);
        close("triangles", "momentum", run.last().totals.momentum[2], run.lines[0].totals.momentum[2], 1e-10);
    }
}

/// Sheets so thin and so fast that each goes by several thicknesses in a step: none passes the other unseen. They would pass with
/// all nodes in the same step, with nothing through anything before and after it: then the lower one would not be pushed.
#[test]
fn a_fast_thin_sheet_does_not_pass_through_another() {
    for (thin, speed, flipped) in [(5e-5, 100.0, false), (5e-5, 100.0, true), (1e-4, 300.0, false), (1e-4, 300.0, true)]
    {
        let mesh = two_sheets(7.3e-3, flipped);
        let more = format!(
            "SHELL THICKNESS, 1, {thin}\nSHELL THICKNESS, 2, {thin}\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -{speed}\n"
        );
        let run = on_ranks(&deck(2e-4, &more, 2), &mesh);
        let surfaces = Surfaces::new(&mesh);
        for state in &run.states {
            assert_eq!(surfaces.pierced(&state.positions(&mesh)), [], "{speed} m/s, time {}", state.time);
        }
        let speeds = run.end().nodal("VELZ");
        let mean = |block| {
            let nodes = nodes_of(&mesh, block);
            nodes.iter().map(|&n| speeds[n]).sum::<f64>() / nodes.len() as f64
        };
        between("fast sheets", "speed of the lower over that of the upper", mean(1) / mean(2), 0.7, 1e3);
    }
}

/// Sheets that the mesh has nearer to each other than their thickness are not thrown apart, and not let through: they rest as
/// they are, and are told of.
#[test]
fn sheets_without_room_stay_as_near_as_they_are() {
    let mesh = two_sheets(0.4 * T, false);
    let more = format!("SHELL THICKNESS, 1, {T}\nSHELL THICKNESS, 2, {T}\n");
    let text = deck(1e-4, &more, 2);
    let run = on_ranks(&text, &mesh);
    assert!(run.end().nodal("DISPLZ").iter().all(|u| *u == 0.0), "they have moved");
    let crowded =
        urto::solver::Body::new(&mesh, &crate::support::run::model(&text, &mesh)).expect("a body").overlap.crowded;
    assert_eq!(crowded.nodes, 25 + 16, "all of the smaller sheet, and what lies under it");
    close("sheets without room", "least room", crowded.least, 0.4, 1e-9);
    let pressed = format!("{more}INITIAL VELOCITY MATERIAL, 2, 0., 0., -5.\n");
    let run = on_ranks(&deck(3e-4, &pressed, 2), &mesh);
    let least = sound("sheets without room", &run, &mesh, T);
    between("sheets without room", "least distance", least, 0.399, 0.401);
}

/// A sheet on a block of hexahedra keeps half of its thickness, from above and with its edge.
#[test]
fn a_sheet_rests_on_a_solid() {
    for sheet in [
        "SHEET, 1,  0.013, 0.011, 2.E-3,  0.07, 0.07, 0.,  4, 4",
        "SHEET, 1,  0.013, 0.051, 2.E-3,  0.07, 0., 0.04,  4, 3",
    ] {
        let mesh =
            recipe(&format!("TITLE\n SHEET ON BLOCK\n{sheet}\nBOX, 2,  0., 0., -0.05,  0.1, 0.1, 0.05,  5, 5, 2\n"));
        let more = format!("SHELL THICKNESS, 1, {T}\nINITIAL VELOCITY MATERIAL, 1, 0., 0., -10.\n");
        let run = on_ranks(&deck(3e-4, &more, 2), &mesh);
        sound("sheet on a block", &run, &mesh, T);
        let lowest = run.states.iter().flat_map(|state| {
            let at = state.positions(&mesh);
            let top = nodes_of(&mesh, 2).into_iter().map(|n| at[n][2]).fold(f64::NEG_INFINITY, f64::max);
            nodes_of(&mesh, 1).into_iter().map(move |n| at[n][2] - top).collect::<Vec<_>>()
        });
        let least = lowest.fold(f64::INFINITY, f64::min);
        between("sheet on a block", "least height over half the thickness", least / (0.5 * T), 0.99, 1.01);
    }
}

/// Two sheets that stand on edge across each other: only their edges meet, between the nodes.
#[test]
fn edges_of_sheets_meet_at_their_thickness() {
    let mesh = recipe(
        "TITLE\n CROSS\nSHEET, 1,  -0.05, 0., -0.06,  0.1, 0., 0.06,  5, 3\nSHEET, 2,  0., -0.05, 4.E-3,  0., 0.1, 0.06,  5, 3\n",
    );
    let more =
        format!("SHELL THICKNESS, 1, {T}\nSHELL THICKNESS, 2, {T}\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -10.\n");
    let run = on_ranks(&deck(4e-4, &more, 2), &mesh);
    sound("edges", &run, &mesh, T);
    // Where they cross, each edge is straight between two nodes.
    let least = run.states.iter().map(|state| {
        let at = state.positions(&mesh);
        let middle = |block: i64, axis: usize, z: f64| {
            let near =
                |n: &usize| (mesh.coordinates[*n][2] - z).abs() < 1e-9 && mesh.coordinates[*n][axis].abs() < 0.011;
            let ends: Vec<f64> = nodes_of(&mesh, block).into_iter().filter(near).map(|n| at[n][2]).collect();
            assert_eq!(ends.len(), 2);
            0.5 * (ends[0] + ends[1])
        };
        middle(2, 1, 4e-3) - middle(1, 0, 0.0)
    });
    let least = least.fold(f64::INFINITY, f64::min);
    between("edges", "least distance over thickness", least / T, 0.999, 1.001);
}

/// A tube that is pressed flat between plates: its walls come to lie upon each other, one thickness apart.
#[test]
fn walls_of_a_flat_tube_are_a_thickness_apart() {
    let thick = 1e-3;
    let mesh = recipe(
        "TITLE\n TUBE\nSHEET TUBE, 1, 0.02, 0.02, 32, 3\nROTATE, 1, X, 90.\n\
         BOX, 2,  -0.04, -0.03, 0.0206,  0.08, 0.04, 0.01,  4, 3, 1\nBOX, 3,  -0.04, -0.03, -0.0306,  0.08, 0.04, 0.01,  4, 3, 1\n\
         NODE SET PLANE, 1, Z, 0.0306\nNODE SET PLANE, 2, Z, -0.0306\n",
    );
    // What is driven comes 2 x 1.96 cm together: two walls and a half of a thickness in between.
    let more = format!(
        "SHELL THICKNESS, 1, {thick}\nFUNCTION, 1\n0., 0.\n1.E-4, 1.\n1.E-3, 1.\n1.1E-3, 0.\n2.E-3, 0.\nEND\n\
         PRESCRIBED VELOCITY, Z, 1, 1, -19.\nPRESCRIBED VELOCITY, Z, 2, 1, 19.\n"
    );
    let text = deck(1.2e-3, &more, 3).replace(
        "MATERIAL, 1, ELASTIC, 8000.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\n",
        "MATERIAL, 1, ELASTIC PLASTIC, 8000.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 200.E6\n\
         HARDENING MODULUS = 2.E8\nBETA = 1.\n",
    );
    let run = run_on(2, &text, &mesh).whole();
    let surfaces = Surfaces::new(&mesh);
    let mut least = f64::INFINITY;
    for state in &run.states {
        let at = state.positions(&mesh);
        assert_eq!(surfaces.pierced(&at), [], "time {}", state.time);
        least = least.min(surfaces.nearest(&at).0);
    }
    between("flat tube", "least distance over thickness", least / thick, 0.98, 1.02);
    between("flat tube", "energy balance", run.worst_balance(), 0.0, 0.02);
    assert!(run.last().totals.contact < 0.01 * run.last().totals.internal, "contact makes energy");
}

/// A row of trusses and one of beams on a sheet: they keep their radius and half of its thickness.
#[test]
fn bars_touch_at_their_radius() {
    for (section, radius) in [("BEAM SECTION, 2, ROD, 3.E-3", 3e-3), ("TRUSS AREA, 2, 2.82743E-5", 3e-3)] {
        let mesh = recipe(
            "TITLE\n BAR\nSHEET, 1,  0., 0., 0.,  0.1, 0.1, 0.,  5, 5\nLINE, 2,  0.013, 0.047, 6.E-3,  0.087, 0.053, 6.E-3,  7\n",
        );
        let more = format!("SHELL THICKNESS, 1, {T}\n{section}\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -10.\n");
        let run = on_ranks(&deck(4e-4, &more, 2), &mesh);
        let surfaces = Surfaces::new(&mesh);
        let mut least = f64::INFINITY;
        for state in &run.states {
            let at = state.positions(&mesh);
            assert_eq!(surfaces.pierced(&at), []);
            let of_block = |block| nodes_of(&mesh, block).into_iter().map(|n| at[n]).collect::<Vec<_>>();
            // The sheet bends little here: the node of it that is nearest in the plane says how high it is.
            for x in of_block(2) {
                let near = |p: &[f64; 3]| (p[0] - x[0]).hypot(p[1] - x[1]);
                let under = of_block(1).into_iter().min_by(|a, b| near(a).total_cmp(&near(b))).expect("nodes");
                least = least.min(x[2] - under[2]);
            }
        }
        between("bars", "least height over radius and half the thickness", least / (radius + 0.5 * T), 0.99, 1.01);
        between(
            "bars",
            "work of contact over the initial energy",
            run.last().totals.contact / run.initial_energy,
            -1.0,
            1e-12,
        );
    }
}

/// A bar falls along the bottom of a hollow and along a ridge, both held: nodes stay at their distance from both flanks of a hollow,
/// whose faces reach over each other, and ahead of a ridge so sharp that neither of its flanks sees them in front.
#[test]
fn a_bar_keeps_its_distance_in_a_hollow_and_ahead_of_a_ridge() {
    for (case, degrees) in
        [("hollow of 15 degrees", 7.5_f64), ("of 30", 15.0), ("of 90", 45.0), ("ridge of 160", -80.0)]
    {
        let slope = degrees.to_radians().tan();
        let mut mesh = recipe(
            "TITLE\n FLANKS\nSHEET, 1,  -0.05, -0.01, 0.,  0.1, 0.02, 0.,  5, 2\nLINE, 2,  -0.037, 2.E-4, 7.E-3,  0.037, 2.E-4, 7.E-3,  7\n\
             NODE SET BOX, 1, -0.06, 0.06, -0.02, 0.02, -1.E-6, 1.E-6\n",
        );
        for node in nodes_of(&mesh, 1) {
            mesh.coordinates[node][2] = slope * mesh.coordinates[node][1].abs();
        }
        let held: String = ["X", "Y", "Z"].map(|axis| format!("NO DISPLACEMENT, {axis}, 1\n")).concat();
        let more = format!(
            "SHELL THICKNESS, 1, {T}\nTRUSS AREA, 2, 2.82743E-5\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -10.\n{held}"
        );
        let run = on_ranks(&deck(4e-4, &more, 2), &mesh);
        let (radius, end) = (3e-3, [0.01, 0.01 * slope]);
        // Everything is alike along the bar: a flank is a segment from the line in the middle.
        let to_flank = |[y, z]: [f64; 2]| {
            let along = ((y.abs() * end[0] + z * end[1]) / (end[0] * end[0] + end[1] * end[1])).clamp(0.0, 1.0);
            (y.abs() - along * end[0]).hypot(z - along * end[1])
        };
        let mut least = f64::INFINITY;
        for state in &run.states {
            let at = state.positions(&mesh);
            for node in nodes_of(&mesh, 2) {
                least = least.min(to_flank([at[node][1], at[node][2]]));
            }
        }
        between(case, "least distance over radius and half the thickness", least / (radius + 0.5 * T), 0.995, 1.001);
        let given = run.last().totals.contact / run.initial_energy;
        // All of it, but for round-off.
        between(case, "work of contact over the initial energy", given, -1.0 - 1e-9, 1e-12);
    }
}

/// A block that breaks through two sheets, one behind the other, whose elements go, and through a row of trusses: the same bits on
/// any number of ranks and when continued; contact gives nothing.
#[test]
fn what_breaks_through_sheets_has_the_same_bits() {
    let mesh = recipe(
        "TITLE\n SHEETS\nSHEET, 1,  -0.05, -0.05, 0.,  0.1, 0.1, 0.,  10, 10\nSHEET, 3,  -0.05, -0.05, -6.E-3,  0.1, 0.1, 0.,  9, 9\n\
         BOX, 2,  -0.012, -0.014, 1.E-3,  0.027, 0.027, 0.03,  3, 3, 3\nLINE, 4,  -0.04, 0.001, -9.E-3,  0.04, 0.002, -9.E-3,  9\n\
         NODE SET PLANE, 1, X, -0.05\nNODE SET PLANE, 1, X, 0.05\nNODE SET PLANE, 1, Y, -0.05\nNODE SET PLANE, 1, Y, 0.05\n\
         NODE SET BOX, 2,  -0.041, -0.039,  -0.01, 0.01,  -0.01, -0.008\nNODE SET BOX, 2,  0.039, 0.041,  -0.01, 0.01,  -0.01, -0.008\n",
    );
    let more = "PLOT ELEMENT, STATUS\nSHELL THICKNESS, 1, 1.E-3\nSHELL THICKNESS, 3, 1.E-3\nTRUSS AREA, 4, 4.E-6\n\
                INITIAL VELOCITY MATERIAL, 2, 30., 0., -300.\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
                NO DISPLACEMENT, X, 2\nNO DISPLACEMENT, Y, 2\nNO DISPLACEMENT, Z, 2\n\
                DEATH, 1, EQPS, MAX, 0.1\nDEATH, 3, EQPS, MAX, 0.1\nDEATH, 4, EQPS, MAX, 0.15\nCONTACT DATA, ALL, ALL, 0.1\n";
    let mut text = deck(9e-5, more, 4);
    for block in [1, 3, 4] {
        text = text.replace(
            &format!("MATERIAL, {block}, ELASTIC, 8000.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\n"),
            &format!(
                "MATERIAL, {block}, ELASTIC PLASTIC, 8000.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 300.E6\n\
                 HARDENING MODULUS = 1.E9\nBETA = 1.\n"
            ),
        );
    }
    let run = on_ranks(&text, &mesh);
    let gone = run.end().element("STATUS").iter().filter(|status| **status == 0.0).count();
    println!("{gone} elements have gone");
    assert!(gone > 10, "only {gone} elements have gone");
    between("sheets that break", "energy balance", run.worst_balance(), 0.0, 1e-2);
    let scale = run.initial_energy;
    between("sheets that break", "work of contact", run.last().totals.contact / scale, -1.0, 1e-9);
    let case = Case::new(&text, mesh);
    let steps = run.last().step as usize;
    let whole = case.part(1, None, steps);
    for at in [steps / 3, 2 * steps / 3] {
        let first = case.part(2, None, at);
        let rest = case.part(3, Some(&first.end), steps - at);
        assert_same("sheets that break", &whole, &rest);
    }
}

/// Displacement of the top of a stack of sheets, with 200 passes in every step; a length.
const SETTLED_STACK: f64 = -2.5406e-6;

/// Force with which a flat strip resists being pressed along itself, over that of its section, E h b ε. `more` are lines of its recipe and of
/// its deck.
fn resistance(cells: &str, thickness: f64, [recipe_lines, deck_lines]: [&str; 2]) -> f64 {
    let (length, width, modulus, density) = (0.05, 0.01, 2e9, 1200.0);
    let mesh = recipe(&format!(
        "TITLE\n strip\nSHEET, 1, 0., 0., 0., {length}, {width}, 0., {cells}\n{recipe_lines}\
         NODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, {length}\nNODE SET PLANE, 3, Y, 0.\n"
    ));
    let (end, speed, ramp) = (4e-4, 2.5, 1.2e-4);
    let deck = format!(
        "TITLE\n strip\nTERMINATION TIME, {end}\nPLOT TIME, {0}\nPLOT NODAL, DISPLACEMENT, REACTION\nSHELL THICKNESS, 1, {thickness}\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Z, 1\nNO DISPLACEMENT, Z, 2\nNO DISPLACEMENT, Y, 3\nPRESCRIBED VELOCITY, X, 2, 1, -{speed}\n\
         FUNCTION, 1\n0., 0.\n{ramp}, 1.\n{end}, 1.\nEND\n{deck_lines}\
         MATERIAL, 1, ELASTIC, {density}\nYOUNGS MODULUS = {modulus:?}\nPOISSONS RATIO = 0.\nEND\n",
        end / 80.0
    );
    let run = run_on(1, &deck, &mesh);
    let driven = &mesh.node_set(2).expect("the driven end").nodes;
    let force = |state: &State| driven.iter().map(|&node| state.nodal("RX")[node as usize].abs()).sum::<f64>();
    // The mean over the last half, over which waves go to and fro.
    let half: Vec<&State> = run.states.iter().filter(|state| state.time > 0.5 * end).collect();
    let strain = |time: f64| speed * (time - 0.5 * ramp) / length;
    half.iter().map(|state| force(state) / (modulus * thickness * width * strain(state.time))).sum::<f64>()
        / half.len() as f64
}

/// A sheet that is thicker than its elements are long has neighbours of neighbours within its thickness. They resisted with up to seven times
/// its stiffness from two lengths on, for long elements and triangles earlier.
#[test]
fn a_thick_sheet_does_not_touch_itself_where_it_is_flat() {
    for (cells, thickness, lines) in [
        ("20, 4", 0.0045, ""),
        ("20, 4", 0.005, ""),
        ("20, 4", 0.01, ""),
        ("20, 1", 0.00525, ""),
        ("20, 4, 10.", 0.0025, ""),
        ("20, 4", 0.00375, "TRIANGLES, 1\n"),
    ] {
        let with = resistance(cells, thickness, [lines, "CONTACT MATERIAL\n"]);
        let without = resistance(cells, thickness, [lines, ""]);
        println!("{cells}, {thickness}: {with:.4}, without contact {without:.4}");
        assert_eq!(with, without, "a sheet of {cells} elements, {thickness} thick");
        // The bar of E A ε; waves of the ramp are not all gone.
        close("strip", "resistance", without, 1.0, 0.05);
    }
}

/// Three sheets between two blocks of which the upper one is pressed: with 20 passes a step forces do not settle, the sheets drift apart ever
/// faster, and the stack gives way by half again as much. Passes that may go on let it rest; the same with 200 in each step.
#[test]
fn a_stack_of_sheets_between_plates_rests() {
    let mesh = recipe(
        "TITLE\n stack\nBOX, 1, 0., 0., -0.01, 0.04, 0.04, 0.01, 5, 5, 2\nSHEET, 3, 0.002, 0.003, 0.0005, 0.036, 0.034, 0., 7, 8\n\
         SHEET, 4, 0.002, 0.003, 0.0015, 0.036, 0.034, 0., 11, 12\nSHEET, 5, 0.002, 0.003, 0.0025, 0.036, 0.034, 0., 4, 5\n\
         BOX, 2, 0.001, 0.001, 0.003, 0.038, 0.038, 0.01, 4, 6, 2\nNODE SET FACE, 9, 1, BOTTOM\nNODE SET FACE, 10, 2, TOP\n\
         SIDE SET FACE, 20, 2, TOP\n",
    );
    let law =
        |block: i64| format!("MATERIAL, {block}, ELASTIC, 2700.\nYOUNGS MODULUS = 7.E9\nPOISSONS RATIO = 0.3\nEND\n");
    let end = 4e-3;
    let deck = format!(
        "TITLE\n stack\nTERMINATION TIME, {end}\nPLOT TIME, {end}\nPLOT NODAL, DISPLACEMENT\nCONTACT MATERIAL\nSHELL THICKNESS, 3, 0.001\n\
         SHELL THICKNESS, 4, 0.001\nSHELL THICKNESS, 5, 0.001\nNO DISPLACEMENT, X, 9\nNO DISPLACEMENT, Y, 9\nNO DISPLACEMENT, Z, 9\n\
         FUNCTION, 1\n0., 0.\n0.001, 1.\n{end}, 1.\nEND\nPRESSURE, 20, 1, 1.E6\n{}",
        (1..=5).map(law).collect::<String>()
    );
    let run = run_on(1, &deck, &mesh);
    let top = &mesh.node_set(10).expect("the top of the stack").nodes;
    let sinks = top.iter().map(|&node| run.end().nodal("DISPLZ")[node as usize]).sum::<f64>() / top.len() as f64;
    // CONTACT PASSES, 200 gives SETTLED; 20 and no more -3.92e-6 m. At most 200 where they do not settle move it by 0.3 % (measured).
    close("stack", "displacement of its top over that of settled forces", sinks, SETTLED_STACK, 0.02);
}
