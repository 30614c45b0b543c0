//! What is pressed and slides stays on the surface: along an edge between warped faces, and over ridges.
//!
//! A rigid base is held, and a cube that stands on one of its corners is driven over it; base and corner are in the plane y = 0, where
//! the height of the surface is known.

use crate::support::bodies::{mean_velocity, nodes_of};
use crate::support::meshes::{nodes_where, recipe};
use crate::support::run::run;
use crate::support::{between, close};
use urto::mesh::Mesh;

/// Cells of the base along x, each as long as 1.
const CELLS: f64 = 4.0;

/// Where the corner begins.
const BEGIN: f64 = 0.3;

/// A base whose upper nodes are lifted by `height` of x and y, and a cube on the lowest of its corners.
fn corner_on_base(height: impl Fn(f64, f64) -> f64) -> Mesh {
    let mut mesh = recipe(
        "TITLE\n corner on base\nBOX, 1, 0., -1., -1., 4., 2., 1., 4, 2, 1\nBOX, 2, -0.25, -0.25, -0.25, 0.5, 0.5, 0.5, 1, 1, 1\n\
         ROTATE, 2, X, 45.\nROTATE, 2, Y, 35.2643897\nNODE SET BLOCK, 1, 1\nNODE SET BLOCK, 2, 2\n",
    );
    let lifted = nodes_where(&mesh, |[_, _, z]| z == 0.0);
    let cube = mesh.node_set(2).expect("a node set").nodes.clone();
    let lowest = *cube
        .iter()
        .min_by(|a, b| mesh.coordinates[**a as usize][2].total_cmp(&mesh.coordinates[**b as usize][2]))
        .expect("a corner");
    for &node in lifted.iter().filter(|node| !cube.contains(node)) {
        let [x, y, z] = &mut mesh.coordinates[node as usize];
        *z = height(*x, *y);
    }
    let from = mesh.coordinates[lowest as usize];
    let to = [BEGIN, 0.0, height_at(&height, BEGIN)];
    for &node in &cube {
        for (axis, x) in mesh.coordinates[node as usize].iter_mut().enumerate() {
            *x += to[axis] - from[axis];
        }
    }
    mesh
}

/// Height of the base at y = 0.
fn height_at(height: &impl Fn(f64, f64) -> f64, x: f64) -> f64 {
    let cell = x.floor().min(CELLS - 1.0);
    height(cell, 0.0) + (x - cell) * (height(cell + 1.0, 0.0) - height(cell, 0.0))
}

/// Least and largest height of the corner above the surface while it goes at a velocity from one end of the base to the other.
fn heights(height: impl Fn(f64, f64) -> f64, (velocity, gravity): (f64, f64)) -> [f64; 2] {
    let mesh = corner_on_base(&height);
    let end = 3.4 / velocity;
    let deck = format!(
        "TITLE\n corner on base\nTERMINATION TIME, {end}\nOUTPUT TIME, {0}\nPLOT TIME, {1}\nRIGID BODY, 1\n\
         MATERIAL, 1, ELASTIC, 7800.\nYOUNGS MODULUS = 2.E11\nPOISSONS RATIO = 0.3\nEND\n\
         MATERIAL, 2, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.3\nEND\n\
         CONTACT MATERIAL\nCONTACT EDGES, OFF\nCONTACT DATA, 1, 2, 0., 1.\nNO DISPLACEMENT, Y, 2\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n\
         NO DISPLACEMENT, Z, 1\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESCRIBED VELOCITY, X, 2, 1, {velocity}\nGRAVITY, 0., 0., -{gravity}\n",
        end / 10.0,
        end / 500.0
    );
    let run = run(&deck, &mesh);
    let corner = nodes_where(&mesh, |[x, y, _]| (x - BEGIN).abs() < 1e-9 && y.abs() < 1e-9);
    let node = *corner.first().expect("the corner") as usize;
    let above = run.states.iter().map(|state| {
        let [x, _, z] = state.positions(&mesh)[node];
        z - height_at(&height, x)
    });
    above.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], h| [least.min(h), most.max(h)])
}

/// The faces on both sides of the straight edge y = 0 are warped, each the other way than the one before. Along the mean of their mean
/// normals, which leans by a tenth along the edge, the corner would sink and rise by 8 and 4 % of a face.
#[test]
fn what_slides_along_an_edge_of_warped_faces_keeps_its_height() {
    let warped = |x: f64, y: f64| if x.rem_euclid(2.0) == 0.0 { 0.1 * y.abs() } else { -0.1 * y.abs() };
    let [least, most] = heights(warped, (170.0, 3e4));
    between("along an edge", "least height over a face", least, -1e-6, 0.0);
    between("along an edge", "largest height over a face", most, 0.0, 1e-6);
}

/// Over ridges that the surface turns away at, by 0.1 each. Were the far side of a ridge taken as soon as the corner ends a step over
/// it, the corner would be kept as deep behind its plane as it was before the ridge: 0.14 % of a face here, with every ridge anew.
#[test]
fn what_slides_over_ridges_does_not_sink() {
    let [least, _] = heights(|x, _| -0.05 * (x - 2.0) * (x - 2.0), (170.0, 3e5));
    between("over ridges", "least height over a face", least, -1e-5, 0.0);
}

/// Rigid bodies that slide obliquely over two ridges, or over two rails with the rims of sheets, which sag below the nodes ahead by next to nothing: their walls and their rims
/// pass over these nodes. Without friction they keep their speed; a wall whose border was level with a node, or a sheet that had one
/// beneath its rim, was stopped and thrown back.
#[test]
fn what_slides_obliquely_over_ridges_and_rails_keeps_its_speed() {
    let ridges = "BOX, 1, -5., -0.5, -0.5, 10., 1., 1., 20, 2, 2\nROTATE, 1, X, 45.\nTRANSLATE, 1, 0., 1., -0.7071067811865476\n\
                  COPY, 1, 1, 0., -2., 0.\nNODE SET BOX, 1, , , , , , -0.3, 1\n";
    let rails = "BOX, 1, -5., -0.5, -1., 10., 1., 1., 20, 2, 2\nTRANSLATE, 1, 0., 1., 0.\nCOPY, 1, 1, 0., -2., 0.\n\
                 NODE SET BOX, 1, , , , , , -0.4, 1\n";
    let block = "BOX, 2, -1.2, -1.75, 0., 2.4, 3.5, 0.5, 5, 7, 1\n";
    let sheets = "SHEET, 2, -1., -1.75, 0., 0., 3.5, 1., 7, 2\nCOPY, 2, 2, 2., 0., 0.\n";
    let law = |block| format!("MATERIAL, {block}, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.\nEND\n");
    for (below, slider, height, gravity) in [
        (ridges, block, 1e-7, ""),
        (ridges, block, 1e-6, "GRAVITY, 0., 0., -2.\n"),
        (rails, sheets, 0.025001, "GRAVITY, 0., 0., -2.\n"),
    ] {
        let thickness = if slider == sheets { "SHELL THICKNESS, 2, 0.05\n" } else { "" };
        let mesh = recipe(&format!(
            "TITLE\n slider\n{below}{slider}ROTATE, 2, Z, 25.\nTRANSLATE, 2, -2.1, 0.03, {height:?}\n"
        ));
        let deck = format!(
            "TITLE\n slider\nTERMINATION TIME, 0.3\nPLOT TIME, 0.1\nPLOT NODAL, VELOCITY, MASS\nCONTACT MATERIAL\n{gravity}{thickness}\
             NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nINITIAL VELOCITY MATERIAL, 2, 10., 0., 0.\n\
             RIGID BODY, 2\n{}{}EXIT\n",
            law(1),
            law(2)
        );
        let after = mean_velocity(run(&deck, &mesh).end(), &nodes_of(&mesh, 2));
        // What the weight presses into the ridges leans on them by its own depth, thousandths of the speed.
        close("oblique slider", "speed kept", after[0], 10.0, 2e-3);
    }
}

/// A sled of plastic blocks that falls askew on two soft ridges while it slides along them, with friction of 0.1: in a step it comes down by more than
/// its border is level with the nodes ahead. What it loses along its way is a tenth of the impulse that throws it up; its front, stopped by
/// the nodes of a ridge, lost almost three times that at the step of the mesh, and at four fifths of it the right part.
#[test]
fn what_falls_on_ridges_as_it_slides_loses_what_friction_takes() {
    let mesh = recipe(
        "TITLE\n sled\nBOX, 1, -3., -0.4, -0.4, 6., 0.8, 0.8, 15, 2, 2\nROTATE, 1, X, 45.\nTRANSLATE, 1, 0., 0.9, -0.5656854249\n\
         COPY, 1, 1, 0., -1.8, 0.\nNODE SET BOX, 1, , , , , , -0.5, 1\nBOX, 2, -1., -1.5, 0., 2., 3., 0.4, 6, 9, 2\nROTATE, 2, Z, 20.\n\
         TRANSLATE, 2, -1.5, 0., 0.03\n",
    );
    for scale in ["1.", "0.8"] {
        let deck = format!(
            "TITLE\n sled\nTERMINATION TIME, 0.04\nTIME STEP SCALE, {scale}\nPLOT TIME, 0.04\nPLOT NODAL, VELOCITY, MASS\nCONTACT MATERIAL\n\
             CONTACT DATA, 1, 2, 0.1\nGRAVITY, 0., 0., -10.\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
             INITIAL VELOCITY MATERIAL, 2, 20., 2., -4.\n\
             MATERIAL, 1, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E8\nPOISSONS RATIO = 0.3\nEND\n\
             MATERIAL, 2, ELASTIC PLASTIC, 2000.\nYOUNGS MODULUS = 5.E8\nPOISSONS RATIO = 0.3\nYIELD STRESS = 2.E6\n\
             HARDENING MODULUS = 1.E7\nBETA = 1.\nEND\nEXIT\n"
        );
        let after = mean_velocity(run(&deck, &mesh).end(), &nodes_of(&mesh, 2));
        let impulse = after[2] + 4.0 + 10.0 * 0.04;
        // Along x, of a way that leans by a tenth; flanks that the sled presses down push it a little as well.
        close("sled on ridges", "speed lost", 20.0 - after[0], 0.1 * impulse / 1.01f64.sqrt(), 0.03);
    }
}

/// What touches by side sets, elastic, without friction: the recipe, what holds it and what it is, the velocities that its first block keeps, and the end.
fn by_side_sets(recipe_lines: &str, lines: &str, velocity: &[f64], end: f64) -> Vec<f64> {
    let mesh = recipe(&format!("TITLE\n SIDE SETS\n{recipe_lines}"));
    let law = "ELASTIC, 0.001\nYOUNGS MODULUS = 200.\nPOISSONS RATIO = 0.3\nEND";
    let begins = velocity.iter().map(|v| format!("{v:?}")).collect::<Vec<_>>().join(", ");
    let deck = format!(
        "TITLE\n SIDE SETS\nTERMINATION TIME, {end:?}\nOUTPUT TIME, {end:?}\nPLOT TIME, {end:?}\nPLOT NODAL, VELOCITY\n{lines}\
         INITIAL VELOCITY MATERIAL, 1, {begins}\nMATERIAL, 1, {law}\nMATERIAL, 2, {law}\nEXIT\n"
    );
    let slid = run(&deck, &mesh);
    let nodes = nodes_of(&mesh, 1);
    let axes = ["VELX", "VELY", "VELZ"].into_iter().take(velocity.len());
    axes.map(|axis| nodes.iter().map(|&node| slid.end().nodal(axis)[node]).sum::<f64>() / nodes.len() as f64).collect()
}

/// A side set may be the whole outside of a body. Nodes of what it slides on, flush, come through its front wall by round-off, and no face of theirs looks at
/// that: 5 became -0.7. So it was only with CONTACT SURFACE, which did not ask.
#[test]
fn what_slides_flush_between_side_sets_goes_on() {
    let held = "NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n";
    // Front and bottom of the block alone, and all of it; on a plate, whose top is the other set.
    for set in ["SIDE SET BLOCK, 101, 1", "SIDE SET FACE, 101, 1, FRONT\nSIDE SET FACE, 101, 1, RIGHT"] {
        let plate = format!(
            "RECTANGLE, 1, 0.5, 0., 4., 2., 3, 1\nRECTANGLE, 2, -3., -2., 24., 2., 9, 1\nNODE SET FACE, 1, 2, FRONT\n{set}\nSIDE SET FACE, 200, 2, BACK\n"
        );
        let kept = by_side_sets(&plate, &format!("PLANE STRAIN\n{held}CONTACT SURFACE, 101, 200\n"), &[5.0, 0.0], 0.8);
        close(set, "velocity along the plate", kept[0], 5.0, 1e-9);
    }
    // Beside a flush wall, in space.
    let wall = "BOX, 1, 0., 0., 0., 4., 4., 4., 3, 3, 3\nBOX, 2, 4., -1., -9., 3., 6., 20., 2, 3, 7\nNODE SET FACE, 1, 2, RIGHT\n\
                SIDE SET BLOCK, 101, 1\nSIDE SET BLOCK, 201, 2\n";
    let all = format!("{held}NO DISPLACEMENT, Z, 1\nCONTACT SURFACE, 101, 201\n");
    let [x, y, z] = by_side_sets(wall, &all, &[0.0, 0.0, -5.0], 1.0)[..] else { panic!("three axes") };
    close("wall", "velocity beside the wall", z, -5.0, 1e-9);
    assert!(x.abs() < 1e-9 && y.abs() < 1e-9, "{x} {y}");
    // A shaft that slides while it is pressed in a tube, axisymmetric. What still vibrates is some thousandths.
    let tube = "RECTANGLE, 1, 0., 0.5, 10.01, 4., 4, 3\nRECTANGLE, 2, 10., -3., 5., 24., 3, 9\nNODE SET FACE, 1, 2, RIGHT\n\
                SIDE SET BLOCK, 101, 1\nSIDE SET FACE, 200, 2, LEFT\n";
    let pressed = format!("AXISYMMETRIC\n{held}CONTACT OVERLAP, STRESS, 0.1\nCONTACT SURFACE, 101, 200\n");
    let kept = by_side_sets(tube, &pressed, &[0.0, 5.0], 0.8);
    close("shaft", "velocity along the tube", kept[1], 5.0, 0.01);
}

/// The walls of a block are a side set, and its bottom is in none: with its lower rim it strikes a free plate of twice its mass all the same, since the
/// bottom is known to be a side of its body. It does not go through, and momentum is kept.
#[test]
fn a_side_that_is_in_no_set_strikes_with_its_rim() {
    let walls = ["LEFT", "RIGHT", "FRONT", "BACK"].map(|face| format!("SIDE SET FACE, 101, 1, {face}\n")).concat();
    let blocks = format!(
        "BOX, 1, 1., 1., 0.05, 2., 2., 2., 2, 2, 2\nBOX, 2, 0., 0., -1., 4., 4., 1., 3, 3, 1\n{walls}SIDE SET FACE, 200, 2, TOP\n"
    );
    let after = by_side_sets(&blocks, "CONTACT SURFACE, 101, 200\n", &[0.0, 0.0, -5.0], 0.1);
    // Alone it would go on at -5; if it sticks to the plate it has a third of that.
    assert!(after[2] > -5.0 / 3.0 - 0.2, "{after:?}");
}

/// Where the side around a corner is not known, nothing is ruled out: at a mitre, where it is of another element, a frame of which only the walls are a set falls
/// flat on a plate, and at the end that a block of its body leaves bare as it is deleted a bar strikes a wall. Both are thrown back, as by CONTACT MATERIAL.
#[test]
fn sides_that_are_not_known_hold() {
    let held = "NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n";
    let side = |points: &str| format!("QUADRILATERAL, 1, 8, 2\n{points}\nEND\n");
    let frame =
        ["0, 0\n8, 0\n6, 2\n2, 2", "8, 0\n8, 8\n6, 6\n6, 2", "8, 8\n0, 8\n2, 6\n6, 6", "0, 8\n0, 0\n2, 2\n2, 6"]
            .map(side);
    let mitred = format!(
        "{}TRANSLATE, 1, 0., 0.05\nMERGE\nRECTANGLE, 2, -4., -3., 16., 3., 24, 4\nNODE SET FACE, 1, 2, FRONT\nSIDE SET FACE, 200, 2, BACK\n\
         SIDE SET PLANE, 101, X, 0.\nSIDE SET PLANE, 101, X, 8.\n",
        frame.concat()
    );
    let after = by_side_sets(&mitred, &format!("PLANE STRAIN\n{held}CONTACT SURFACE, 101, 200\n"), &[0.0, -5.0], 0.3);
    assert!(after[1] > 1.0, "{after:?}");
    let bar = "BOX, 1, 0., 0., 0., 4., 4., 2., 4, 4, 2\nBOX, 3, 4., 0., 0., 1., 4., 2., 1, 4, 2\nBOX, 2, 5.5, -1.3, -1.3, 2., 6., 4., 2, 6, 4\n\
               MERGE, 1, 3\nSIDE SET FACE, 200, 2, LEFT\nNODE SET FACE, 1, 2, RIGHT\nSIDE SET BLOCK, 101, 1\nSIDE SET BLOCK, 101, 3\n";
    let third = "MATERIAL, 3, ELASTIC, 0.001\nYOUNGS MODULUS = 200.\nPOISSONS RATIO = 0.3\nEND\nINITIAL VELOCITY MATERIAL, 3, 5., 0., 0.\n";
    let lines = format!("{held}NO DISPLACEMENT, Z, 1\n{third}DELETE MATERIAL, 3, 0.02\nCONTACT SURFACE, 101, 200\n");
    let after = by_side_sets(bar, &lines, &[5.0, 0.0, 0.0], 0.6);
    assert!(after[0] < -1.0, "{after:?}");
}
