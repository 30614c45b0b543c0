//! Bodies with flush sides, hollow corners and rims: a little beyond a border, or exactly at it, nodes and edges are still held.
//!
//! Depths are measured by `crate::support::penetration`, which knows nothing of the solver's contact. The scenes were found among
//! random ones.

use crate::support::bodies::{mean_velocity, nodes_of};
use crate::support::meshes::recipe;
use crate::support::penetration::{Skin, nothing_deeper};
use crate::support::run::run;
use crate::support::{between, close};

/// The jaws of a clamp, of the thickness `jaw`, whose rim is flush with the plate between them.
fn clamp(jaw: f64, cells: u32, opening: f64, plate: &str) -> String {
    let upper = jaw + opening;
    format!(
        "TITLE\n clamp\nBOX, 1, 0., 0., 0., 1., 0.3, {jaw}, {cells}, 2, 1\nBOX, 1, 0., 0., {upper}, 1., 0.3, {jaw}, {cells}, 2, 1\n\
         BOX, 1, 0., 0., {jaw}, {}, 0.3, {opening}, 1, 2, 1\nMERGE, 1\nNODE SET PLANE, 2, Z, {}\nNODE SET PLANE, 1, Z, 0.\n{plate}",
        1.0 / f64::from(cells),
        upper + jaw
    )
}

/// The upper jaw comes down with this velocity until `until`; `materials` are those of clamp and plate.
fn closing(velocity: f64, until: f64, end: f64, materials: &str) -> String {
    format!(
        "TITLE\n clamp\nTERMINATION TIME, {end}\nOUTPUT TIME, {0}\nPLOT TIME, {0}\n{materials}CONTACT MATERIAL\nNO DISPLACEMENT, Z, 1\n\
         FUNCTION, 1\n0., 1.\n{until}, 1.\n{1}, 0.\n1., 0.\nEND\nPRESCRIBED VELOCITY, Z, 2, 1, -{velocity}\n",
        end / 10.0,
        1.03 * until
    )
}

/// Asserts that no node and no point of an edge is deeper inside anything than these parts of a face, and that the balance closes.
fn nothing_comes_through(case: &str, (deck, mesh): (&str, &str), most: [f64; 2]) {
    let mesh = recipe(mesh);
    let run = run(deck, &mesh);
    nothing_deeper(case, &run, (&mesh, &Skin::new(&mesh)), most);
    between(case, "worst energy balance", run.worst_balance(), 0.0, 1e-3);
}

/// A thin plate is pressed flat; the nodes at its rim are pressed outwards by some millionths of a face and down beside the rim of
/// the lower jaw, nearer to it than they are deep. Their edges cross that rim, and hold them.
#[test]
fn what_is_pressed_over_a_flush_rim_is_held_by_its_edges() {
    let materials = "MATERIAL, 1, ELASTIC PLASTIC, 1145.\nYOUNGS MODULUS = 594.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 4.36E9\n\
                     HARDENING MODULUS = 30.E9\nBETA = 1.\nEND\nMATERIAL, 2, ELASTIC, 659.\nYOUNGS MODULUS = 4.66E9\n\
                     POISSONS RATIO = 0.45\nEND\n";
    let plate = "BOX, 2, 0.27, 0., 0.153, 0.65, 0.3, 0.0033, 4, 2, 1\n";
    nothing_comes_through(
        "rim",
        (&closing(318.0, 1.11e-5, 3.7e-5, materials), &clamp(0.153, 4, 0.0064, plate)),
        [0.01, 0.01],
    );
}

/// A soft block slides into the corner between web and lower jaw: behind the web by what passes leave of an overlap, its lower nodes
/// are beyond the border of the jaw by as much. Its upper edge is lost later: the motion without contact takes it past the end of the
/// web's (docs/decisions.md, "A little beyond a border").
#[test]
fn what_slides_into_a_corner_is_held_by_both_sides() {
    let materials = "MATERIAL, 1, ELASTIC, 1478.\nYOUNGS MODULUS = 1.71E11\nPOISSONS RATIO = 0.\nEND\nMATERIAL, 2, ELASTIC, 57.8\n\
                     YOUNGS MODULUS = 2.85E8\nPOISSONS RATIO = 0.\nEND\n";
    let block = "BOX, 2, 0.3533333333333333, 0., 0.1431, 0.5666666666666667, 0.3, 0.077, 1, 2, 1\n";
    nothing_comes_through(
        "corner",
        (&closing(27.0, 5.55e-4, 1.85e-3, materials), &clamp(0.1431, 3, 0.0797, block)),
        [0.01, f64::INFINITY],
    );
}

/// A rigid plate of one shell, thickness 1.2 mm, whose corner hangs over the rim of a cube of 8 mm, tilted towards that corner by some degrees:
/// falls at 5 m/s. What stops it are its borders on the rim. Least height of the plate over the rim where its borders cross it, mm.
fn least_height_over_the_rim(tilt: f64, shells_first: bool) -> f64 {
    let cube = "BOX, 2, -8.E-3, -4.E-3, -8.E-3, 8.E-3, 8.E-3, 8.E-3, 1, 1, 1\n";
    let plate = "SHEET, 1, -3.75E-3, -3.75E-3, 0., 7.5E-3, 7.5E-3, 0., 1, 1\n";
    let parts = if shells_first { [plate, cube] } else { [cube, plate] }.concat();
    let mesh = recipe(&format!(
        "TITLE\n plate\n{parts}ROTATE, 1, Z, 45.\nTRANSLATE, 1, -3.4E-3, 0.3E-3, 0.\nROTATE, 1, Y, {tilt}\nTRANSLATE, 1, 0., 0., 0.65E-3\n\
         NODE SET BLOCK, 2, 2\n"
    ));
    let law =
        |block: u32| format!("MATERIAL, {block}, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n");
    let deck = format!(
        "TITLE\n plate\nTERMINATION TIME, 3.E-4\nPLOT TIME, 5.E-6\nCONTACT MATERIAL\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-7\n\
         SHELL THICKNESS, 1, 1.2E-3\nINITIAL VELOCITY MATERIAL, 1, 0., 0., -5.\nNO DISPLACEMENT, X, 2\nNO DISPLACEMENT, Y, 2\n\
         NO DISPLACEMENT, Z, 2\n{}{}",
        law(1),
        law(2)
    );
    let run = run(&deck, &mesh);
    let plate = &mesh.blocks.iter().find(|block| block.id == 1).expect("the plate").nodes;
    let height = |positions: &[[f64; 3]]| {
        let corners: Vec<[f64; 3]> = plate.iter().map(|&node| positions[node as usize]).collect();
        let crossing = |i: usize| {
            let ([ax, _, az], [bx, _, bz]) = (corners[i], corners[(i + 1) % 4]);
            (ax * bx < 0.0).then(|| 1e3 * (az + ax / (ax - bx) * (bz - az)))
        };
        (0..4).filter_map(crossing).fold(f64::INFINITY, f64::min)
    };
    run.states.iter().map(|state| height(&state.positions(&mesh))).fold(f64::INFINITY, f64::min)
}

/// Whichever of shells and solids the mesh has first. Edges of shells that came first took the faces at the rim for a wall over which they slide,
/// where they were flush with them: the plate fell through the cube. Half of the thickness is 0.6 mm; contact tolerates a hundredth of it.
#[test]
fn borders_of_shells_are_stopped_by_rims_of_solids_in_any_order() {
    for tilt in [0.0, 0.5, 4.0, 8.0, 15.0] {
        for shells_first in [false, true] {
            let least = least_height_over_the_rim(tilt, shells_first);
            between(&format!("tilt {tilt}, shells first: {shells_first}"), "height over the rim", least, 0.594, 0.65);
        }
    }
}

/// Velocity downwards, of 20, of a steel cube that has come down with a corner on a steel block, so far inside its rim.
fn velocity_after_a_corner_at_the_rim(inside: f64) -> f64 {
    let mut mesh = recipe(
        "TITLE\n corner\nBOX, 1, 0., -0.4, -0.2, 1., 1., 0.2, 1, 1, 1\nBOX, 2, 0., 0., 0., 0.2, 0.2, 0.2, 1, 1, 1\n",
    );
    // The corner at the origin downwards: its diagonal is upright, and one of its faces looks at the side of the block.
    let half = 0.5f64.sqrt();
    let [x, y, z] =
        [[half, -half, 0.0], [1.0, 1.0, -2.0].map(|c: f64| c / 6f64.sqrt()), [1.0; 3].map(|c: f64| c / 3f64.sqrt())];
    for node in nodes_of(&mesh, 2) {
        let at = mesh.coordinates[node];
        let along = |axis: [f64; 3]| (0..3).map(|i| axis[i] * at[i]).sum::<f64>();
        mesh.coordinates[node] = [along(y) + inside, -along(x), along(z) + 1e-3];
    }
    let material =
        |block| format!("MATERIAL, {block}, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n");
    let deck = format!(
        "TITLE\n corner\nTERMINATION TIME, 3.E-4\nPLOT TIME, 1.E-4\nPLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nCONTACT MATERIAL\n\
         INITIAL VELOCITY MATERIAL, 2, 0., 0., -20.\n{}{}",
        material(1),
        material(2)
    );
    let run = run(&deck, &mesh);
    -mean_velocity(run.end(), &nodes_of(&mesh, 2))[2]
}

/// A corner that comes down on a block within a micrometre of its rim is over the block, however near: it was taken for one that slides down the side, and
/// went in without a force.
#[test]
fn a_corner_is_stopped_at_any_distance_from_a_rim() {
    let far = velocity_after_a_corner_at_the_rim(1e-3);
    between("corner a millimetre inside a rim", "velocity after, of 20", far, -20.0, 18.0);
    for inside in [1e-5, 1e-6, 1e-7, 0.0] {
        let near = velocity_after_a_corner_at_the_rim(inside);
        // The rim gives way with two of the corners of its face: a millimetre in a metre makes as little difference.
        close(&format!("corner {inside} inside a rim"), "velocity after", near, far, 0.02);
    }
}
