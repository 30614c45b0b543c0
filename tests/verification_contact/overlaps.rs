//! What bodies overlap in the mesh at the start of a run: what is moved, and what is told.

use crate::support::meshes::recipe;
use crate::support::run::model;
use urto::solver::Body;
use urto::solver::contact::Overlap;

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
