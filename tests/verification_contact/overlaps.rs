//! What bodies overlap in the mesh at the start of a run: what is moved, and what is told.

use crate::support::close;
use crate::support::meshes::recipe;
use crate::support::run::{model, run, run_on};
use urto::solver::contact::Overlap;
use urto::solver::{Body, of_overlaps};

/// Overlaps of a recipe with two blocks and CONTACT MATERIAL, with more commands.
fn overlap_of(shapes: &str, commands: &str) -> Overlap {
    let mesh = recipe(&format!("TITLE\n overlap\n{shapes}"));
    let material =
        |block: i64| format!("MATERIAL, {block}, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.\nEND\n");
    let materials: String = mesh.blocks.iter().map(|block| material(block.id)).collect();
    let sheets = mesh.blocks.iter().filter(|block| block.shape.is_surface());
    let thickness: String = sheets.map(|block| format!("SHELL THICKNESS, {}, 0.02\n", block.id)).collect();
    let deck = format!("TITLE\n overlap\nTERMINATION TIME, 1.E-3\nCONTACT MATERIAL\n{commands}{thickness}{materials}");
    Body::new(&mesh, &model(&deck, &mesh)).expect("materials").overlap
}

/// A bar with its ridge up, at z = 0 from x = 0 on, and a box whose bottom is at a height and whose side is beyond the end of the ridge.
fn box_over_a_ridge(height: f64) -> String {
    format!(
        "BOX, 1, 0., -0.5, -0.5, 3., 1., 1., 3, 1, 1\nROTATE, 1, X, 45.\nTRANSLATE, 1, 0., 0., {}\n\
         BOX, 2, -1., -1., 0., 2., 2., 0.5, 1, 1, 1\nROTATE, 2, Z, 25.\nTRANSLATE, 2, -0.6, 0.03, {height:e}\n",
        -std::f64::consts::FRAC_1_SQRT_2
    )
}

/// A sheet that stands on a block, with its lower rim at a height over the top of the block; the rim has nodes at 0.1 from the block's side.
fn sheet_on_a_block(height: f64) -> String {
    format!("BOX, 1, -1., -1., -1., 2., 2., 1., 4, 4, 2\nSHEET, 2, -1.5, 0.13, {height:e}, 3., 0., 2., 5, 2\n")
}

/// The node at the end of the ridge is in the plane of the box's bottom or below it, but deep behind the plane of its side: it was moved
/// out there, by half a box.
#[test]
fn what_touches_or_nearly_touches_is_not_moved() {
    for height in [0.0, 1e-12, 1e-9, 1e-6] {
        for shapes in [box_over_a_ridge(height), sheet_on_a_block(height)] {
            let overlap = overlap_of(&shapes, "");
            assert_eq!((overlap.nodes, overlap.deep.nodes), (0, 0), "{shapes}");
        }
    }
}

/// The shortest way out is up or down, by the depth below the plane; the way to the side is tens of times as long.
#[test]
fn nodes_are_moved_by_no_more_than_the_overlap() {
    for depth in [1e-6, 1e-3] {
        for shapes in [box_over_a_ridge(-depth), sheet_on_a_block(-depth)] {
            let overlap = overlap_of(&shapes, "");
            assert!(overlap.nodes > 0 && overlap.deep.nodes == 0, "{overlap:?} of {shapes}");
            // Round-off of heights around 1.
            assert!(overlap.farthest <= depth + 1e-15, "{overlap:?} of {shapes}");
        }
    }
}

/// What CONTACT OVERLAP may say.
const TREATMENTS: [&str; 4] = ["", "CONTACT OVERLAP, REMOVE\n", "CONTACT OVERLAP, KEEP\n", "CONTACT OVERLAP, STRESS\n"];

/// Two bars with roof ridges that cross, the upper one so deep in the lower one.
fn knives(depth: f64) -> String {
    format!(
        "BOX, 1, -1.75, -0.5, -0.5, 3.5, 1., 1., 7, 2, 2\nROTATE, 1, X, 45.\n\
         BOX, 2, -0.5, -1.75, -0.5, 1., 3.5, 1., 2, 7, 2\nROTATE, 2, Y, 45.\nTRANSLATE, 2, 0., 0., {}\n",
        std::f64::consts::SQRT_2 - depth
    )
}

/// A corner of a cube that sticks through a plate: three edges, whose ends are above and below it. The plate is 0.1 thick. A sheet through a
/// sheet: each of the five lines of either goes through the other. A sheet without nodes in the block, 0.3 deep: its lower rim, and the
/// five lines of the block's top. Ridges that cross by 0.1: the flanks are at 45 degrees.
#[test]
fn edges_that_go_through_faces_are_told() {
    let corner = "BOX, 1, -2., -2., -0.1, 4., 4., 0.1, 4, 4, 1\nBOX, 2, -0.5, -0.5, -0.5, 1., 1., 1., 2, 2, 2\n\
                  ROTATE, 2, X, 45.\nROTATE, 2, Y, 35.2644\nTRANSLATE, 2, 0.3, 0.3, 0.666\n";
    let sheets = "SHEET, 1, -2., -2., 0., 4., 4., 0., 8, 8\nSHEET, 2, -1.1, 0.13, -0.8, 2.2, 0., 2., 4, 4\n";
    let rim = "BOX, 1, -1., -1., -1., 2., 2., 1., 4, 4, 2\nSHEET, 2, -1.5, 0.13, -0.3, 3., 0., 2., 1, 1\n";
    for (shapes, edges, depth) in [
        (corner, 3, 0.05),
        (sheets, 10, 0.0),
        (rim, 6, 0.3),
        (&knives(0.1), 2, 0.1 * std::f64::consts::FRAC_1_SQRT_2),
        (&knives(0.02), 2, 0.02 * std::f64::consts::FRAC_1_SQRT_2),
    ] {
        for treatment in TREATMENTS {
            let overlap = overlap_of(shapes, treatment);
            let pierced = overlap.pierced;
            assert_eq!((pierced.count, pierced.pairs, pierced.place.blocks), (edges, 1, [1, 2]), "{treatment}{shapes}");
            // The corner is turned by an angle with six digits.
            assert!((pierced.place.deepest - depth).abs() < 1e-6, "{pierced:?} {shapes}");
            assert_eq!((overlap.nodes, overlap.deep.nodes, overlap.engulfed.count), (0, 0, 0), "{shapes}");
            let mesh = recipe(&format!("TITLE\n overlap\n{shapes}"));
            assert_eq!(overlap.refusal(&mesh).is_some(), treatment.contains("STRESS"), "{treatment}{shapes}");
            assert_eq!(overlap.warnings_of_unheld(&mesh).len(), 1, "{treatment}{shapes}");
        }
    }
}

/// Flush bricks whose nodes do not match, a brick on a brick with common nodes that are not merged, a knife that lies on a face, a sheet
/// that stands on one, a sheet that ends at one, ridges that cross and touch or that edges hold, a column that nodes hold.
#[test]
fn what_touches_or_is_held_does_not_go_through() {
    let bricks = "BOX, 1, 0., 0., 0., 1., 1., 1., 3, 3, 3\nBOX, 2, 0.3, 0.2, 1., 1., 1., 1., 4, 4, 4\n";
    let alike = "BOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\nBOX, 2, 0., 0., 1., 1., 1., 1., 2, 2, 2\n";
    let knife = "BOX, 1, -1., -1., -1., 2., 2., 1., 3, 3, 2\nBOX, 2, -1.5, -0.5, -0.5, 3., 1., 1., 2, 2, 2\n\
                 ROTATE, 2, X, 45.\nTRANSLATE, 2, 0., 0.1, 0.70710678118654752\n";
    let shelf = "BOX, 1, -1., -1., -1., 2., 2., 2., 4, 4, 4\nSHEET, 2, 1., -1.3, 0.1, 1., 2.6, 0., 2, 5\n";
    let column = "BOX, 1, -1., -1., -1., 2., 2., 1., 2, 2, 1\nBOX, 2, -0.3, -0.3, -0.12, 0.6, 0.6, 1., 6, 6, 20\n";
    for shapes in [bricks, alike, knife, shelf, &sheet_on_a_block(0.0), &knives(0.0), &knives(0.004), column] {
        for treatment in TREATMENTS {
            let overlap = overlap_of(shapes, treatment);
            assert_eq!((overlap.pierced.count, overlap.engulfed.count), (0, 0), "{treatment}{shapes}: {overlap:?}");
        }
    }
}

/// What the deck leaves out of contact, and what is one rigid body.
#[test]
fn what_is_kept_apart_does_not_go_through() {
    let same = "BOX, 1, -1., -1., -1., 2., 2., 2., 2, 2, 2\nBOX, 2, -1., -1., -1., 2., 2., 2., 2, 2, 2\n";
    for shapes in [&knives(0.1), same] {
        for commands in ["CONTACT EXCLUSION, 1, 2\n", "RIGID BODY, 1, 2\nTIME STEP MAXIMUM, 1.E-4\n"] {
            let overlap = overlap_of(shapes, commands);
            assert_eq!((overlap.pierced.count, overlap.engulfed.count), (0, 0), "{commands}{shapes}: {overlap:?}");
        }
    }
}

/// The same body twice, with the same mesh and with another, and a small one in the middle of a large element: no node tells contact.
#[test]
fn bodies_inside_bodies_are_told() {
    let same = "BOX, 1, -1., -1., -1., 2., 2., 2., 2, 2, 2\nBOX, 2, -1., -1., -1., 2., 2., 2., 2, 2, 2\n";
    let other = "BOX, 1, -1., -1., -1., 2., 2., 2., 2, 2, 2\nBOX, 2, -1., -1., -1., 2., 2., 2., 3, 3, 3\n";
    let small = "BOX, 1, -1., -1., -1., 2., 2., 2., 1, 1, 1\nBOX, 2, -0.2, -0.1, -0.15, 0.3, 0.3, 0.3, 1, 1, 1\n";
    // The middle one of the finer elements has no outer face.
    for (shapes, elements) in [(same, 16), (other, 26), (small, 1)] {
        for treatment in &TREATMENTS[2..] {
            let overlap = overlap_of(shapes, treatment);
            assert_eq!((overlap.engulfed.count, overlap.engulfed.pairs), (elements, 1), "{treatment}{shapes}");
            let mesh = recipe(&format!("TITLE\n overlap\n{shapes}"));
            assert!(overlap.refusal(&mesh).is_some(), "{shapes}");
            assert_eq!(overlap.warnings_of_unheld(&mesh).len(), 1, "{treatment}{shapes}");
        }
    }
    let mesh = recipe(&format!("TITLE\n overlap\n{same}"));
    let told = overlap_of(same, "").refusal(&mesh).unwrap_or_default();
    assert!(told.contains("16 elements begin inside another body, of blocks 1 and 2"), "{told}");
}

/// In the plane: a bar across a bar, with no node in either, and a bar flush on a bar.
#[test]
fn bars_across_bars_in_the_plane_are_told() {
    let overlap = |shapes: &str| overlap_of(shapes, "PLANE STRAIN\n");
    let across = overlap("RECTANGLE, 1, -1., -0.1, 2., 0.2, 2, 1\nRECTANGLE, 2, 0.4, -1., 0.2, 2., 1, 1\n");
    // Two long sides of each go through two of the other; the middle of a bar is 0.1 below its sides.
    assert_eq!(across.pierced.count, 4, "{across:?}");
    assert!((across.pierced.place.deepest - 0.1).abs() < 1e-12, "{across:?}");
    let flush = overlap("RECTANGLE, 1, -1., -0.1, 2., 0.2, 3, 1\nRECTANGLE, 2, -0.7, 0.1, 0.2, 2., 2, 4\n");
    assert_eq!((flush.pierced.count, flush.nodes), (0, 0), "{flush:?}");
}

/// The nodes of a tube that follow the chords of a coarser one around it do so in the mean: between them they are in its elements, or out of them.
/// What TIED CONTACT joins is no overlap; such tubes were refused for nodes "deeper than half an element", a fortieth of one deep.
#[test]
fn what_is_tied_to_a_curved_surface_does_not_overlap_it() {
    for (inner, outer) in [(12, 3), (3, 12)] {
        for tie in ["TIED CONTACT, 100, 200, 0.5\n", "TIED CONTACT, 200, 100, 0.5\n"] {
            let shapes = format!(
                "TUBE, 1, 0.10, 0.12, 0.2, 4, {inner}, 8, QUARTER\nTUBE, 2, 0.12, 0.13, 0.2, 2, {outer}, 4, QUARTER\n\
                 SIDE SET FACE, 100, 1, OUTER\nSIDE SET FACE, 200, 2, INNER\n"
            );
            let overlap = overlap_of(&shapes, tie);
            assert_eq!((overlap.nodes, overlap.deep.nodes), (0, 0), "{inner}, {outer}, {tie}: {overlap:?}");
        }
    }
}

/// A column whose flanks stand upright on the face in which it is, and a bar on its edge, sunk in so deep that its upper flanks look up at
/// that face from inside: contact knows the nodes below, and what is held with them is not told as deep, for which a press fit would
/// be refused. The bar's elements are larger than the others, so that none is inside one of these.
#[test]
fn what_is_held_with_its_body_is_not_deep() {
    let column = "BOX, 1, -1., -1., -1., 2., 2., 1., 3, 3, 1\nBOX, 2, -0.3, -0.3, -0.12, 0.6, 0.6, 1.02, 6, 6, 12\n";
    let bar = "BOX, 1, -1., -1., -1., 2., 2., 1., 20, 20, 1\nBOX, 2, 0., -0.52, 0., 0.2, 1.04, 0.2, 2, 1, 2\n\
               ROTATE, 2, Y, 45.\nTRANSLATE, 2, -0.091421356, 0., -0.118578644\n";
    for (shapes, deepest) in [(column, 0.12), (bar, 0.26)] {
        let overlap = overlap_of(shapes, "CONTACT OVERLAP, STRESS\n");
        assert_eq!((overlap.deep.nodes, overlap.engulfed.count), (0, 0), "{shapes}: {overlap:?}");
        assert!((overlap.kept.deepest - deepest).abs() < 1e-6, "{shapes}: {overlap:?}");
    }
}

/// Bodies of elements thinner than the overlap that begin in a block, or in a ring: what is known at their surface says nothing of what is deeper than that. A pin
/// through a block, and one wholly in it; one whose end is deeper than half an element of the block; a box of which one end is known and
/// the other one deeper; a pin and a ring both of fine elements, of which neither is known; a pin in the wall of a ring.
#[test]
fn fine_bodies_inside_bodies_are_refused() {
    let block = "BOX, 1, -1., -1., -1., 2., 2., 2., 4, 4, 4\n";
    let pin = |length: f64, along: usize, from: f64| {
        format!("{block}CYLINDER, 2, 0.3, {length:?}, 2, {along}, FULL, 8\nTRANSLATE, 2, 0.03, 0.02, {from:?}\n")
    };
    let tilted = format!(
        "{block}BOX, 2, -0.6, -0.3, 0., 1.2, 0.6, 2., 12, 6, 20\nROTATE, 2, Y, 30.\nTRANSLATE, 2, 0., 0., 0.85\n"
    );
    let both = "TUBE, 1, 0.1, 0.2, 0.1, 100, 16, 2\nCYLINDER, 2, 0.104, 0.1, 4, 2, FULL, 40\n";
    let wall = "TUBE, 1, 0.1, 0.2, 0.1, 2, 32, 4\nCYLINDER, 2, 0.02, 0.1, 2, 4, FULL, 20\nTRANSLATE, 2, 0.12, 0., 0.\n";
    for shapes in [&pin(4.0, 40, -2.0), &pin(1.0, 10, -0.5), &pin(3.0, 40, 0.4), &tilted, both, wall] {
        let overlap = overlap_of(shapes, "CONTACT OVERLAP, STRESS\n");
        let mesh = recipe(&format!("TITLE\n overlap\n{shapes}"));
        assert!(overlap.refusal(&mesh).is_some(), "{shapes}: {overlap:?}");
    }
    // The end of a pin that is no deeper than half an element is known, and with it the nodes of the block in the pin.
    let overlap = overlap_of(&pin(3.0, 40, 0.8), "CONTACT OVERLAP, STRESS\n");
    assert_eq!((overlap.deep.nodes, overlap.engulfed.count), (0, 0), "{overlap:?}");
}

/// Rigid bodies are not moved out of each other. What stays is told and held: two that overlap by 0.1, of masses 1 and 2, of which the
/// first flies at 1 into the second, go on together at a third, as with CONTACT OVERLAP, KEEP; they went through each other.
#[test]
fn rigid_bodies_that_overlap_stay_and_touch() {
    let mesh = recipe(
        "TITLE\n rigid\nBOX, 1, 0., 0., 0., 4., 4., 4., 2, 2, 2\nBOX, 2, -2., -2., 3.9, 8., 8., 2., 5, 5, 2\n\
         BOX, 3, 20., 0., 0., 1., 1., 1., 1, 1, 1\n",
    );
    let steel = "ELASTIC, 7.85E-3\nYOUNGS MODULUS = 210.E3\nPOISSONS RATIO = 0.3\nEND\n";
    for treatment in ["REMOVE", "KEEP"] {
        let deck = format!(
            "TITLE\n rigid\nTERMINATION TIME, 0.02\nOUTPUT TIME, 0.01\nPLOT TIME, 0.02\nPLOT NODAL, VELOCITY\nCONTACT MATERIAL\n\
             CONTACT OVERLAP, {treatment}\nINITIAL VELOCITY MATERIAL, 1, 0., 0., 1.\nRIGID BODY, 1\nRIGID BODY, 2\n\
             MATERIAL, 1, {steel}MATERIAL, 2, {steel}MATERIAL, 3, {steel}"
        );
        let speeds = |run: &crate::support::run::Run| {
            [0, 1].map(|block: usize| run.end().nodal("VELZ")[mesh.blocks[block].nodes[0] as usize])
        };
        let together = run(&deck, &mesh);
        for speed in speeds(&together) {
            close("overlap", &format!("{treatment}: speed of both"), speed, 1.0 / 3.0, 1e-9);
        }
        assert_eq!(speeds(&run_on(3, &deck, &mesh).whole()), speeds(&together), "{treatment}");
        let body = Body::new(&mesh, &model(&deck, &mesh)).expect("materials");
        let told: String = of_overlaps(&mesh, &body).iter().map(|found| found.words()).collect();
        let is_told = told.contains("nodes stay behind faces") && told.contains("the deepest by 1.0000e-1");
        assert_eq!(is_told, treatment == "REMOVE", "{told}");
    }
}

/// The same of a body that is driven into one that the deck holds: neither can be moved, and what is 0.3 deep is told.
#[test]
fn what_the_deck_holds_stays_and_is_told() {
    let shapes = "BOX, 1, 0., 0., 0., 10., 10., 4., 5, 5, 2\nBOX, 2, 1., 1., 3.7, 8., 8., 4., 5, 5, 2\n\
                  NODE SET BLOCK, 1, 1\nNODE SET BLOCK, 1, 2\n";
    let overlap = overlap_of(shapes, "CONTACT OVERLAP, REMOVE\nNO DISPLACEMENT, Z, 1\n");
    assert_eq!(overlap.nodes, 0, "{overlap:?}");
    assert!(overlap.stuck.nodes >= 36 && (overlap.stuck.deepest - 0.3).abs() < 1e-9, "{overlap:?}");
}
