//! What must not go through: coarse rods across each other, fast edges through the lines of faces, anything through thin rigid bodies; and
//! rigid bodies for which tools leave no room.

use crate::support::meshes::recipe;
use crate::support::run::{Run, run, run_on};
use crate::support::{between, close};
use urto::mesh::Mesh;

const STEEL: &str = "ELASTIC PLASTIC, 7800.\nYOUNGS MODULUS = 2.E11\nPOISSONS RATIO = 0.3\nYIELD STRESS = 300.E6\n\
                     HARDENING MODULUS = 500.E6\nBETA = 1.\nEND\n";
const RIGID: &str = "ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.3\nEND\n";

/// Mean of a nodal value over the nodes of a block.
fn mean(run: &Run, mesh: &Mesh, block: usize, name: &str) -> f64 {
    let mut nodes: Vec<u32> = mesh.blocks[block].nodes.clone();
    nodes.sort_unstable();
    nodes.dedup();
    let values = run.end().nodal(name);
    nodes.iter().map(|&node| values[node as usize]).sum::<f64>() / nodes.len() as f64
}

/// Two equal rods of solids cross at a right angle, the upper falls on the lower, free one. Their elements are longer than the rods are
/// thick, so that no node of one ever comes near a face of the other, and no bend around the rods is as sharp as 30 degrees. By
/// momentum they share the speed between them; rods that bend and yield do not part with more than half of it again.
#[test]
fn rods_of_long_elements_do_not_go_through_each_other() {
    for (around, along) in [(2, 5), (2, 9)] {
        let mesh = recipe(&format!(
            "TITLE\n RODS\nCYLINDER, 1, 0.05, 1., {around}, {along}\nROTATE, 1, Y, 90.\nTRANSLATE, 1, -0.5, 0., 0.\n\
             CYLINDER, 2, 0.05, 1., {around}, {along}\nROTATE, 2, X, -90.\nTRANSLATE, 2, 0., -0.5, 0.102\n"
        ));
        let deck = format!(
            "TERMINATION TIME, 8.E-3\nPLOT TIME, 8.E-3\nPLOT NODAL, VELOCITY, DISPLACEMENT\nCONTACT MATERIAL\n\
             INITIAL VELOCITY MATERIAL, 2, 0., 0., -20.\nMATERIAL, 1, {STEEL}MATERIAL, 2, {STEEL}"
        );
        let run = run(&deck, &mesh);
        let [lower, upper] = [0, 1].map(|block| mean(&run, &mesh, block, "VELZ"));
        let case = format!("rods of {along} elements");
        // Through each other they would keep 0 and -20. Means over nodes are near those over masses.
        between(&case, "speed of the lower over that of the impact", lower / -20.0, 0.45, 0.8);
        between(&case, "speed of the upper over that of the impact", upper / -20.0, 0.2, 0.55);
    }
}

/// A rigid wedge, its edge one element long, strikes a block at a twentieth of its wave speed. The lines of the faces hold the edge as
/// they do in a tenth of the step.
#[test]
fn a_fast_edge_does_not_sink_between_nodes() {
    let mesh = recipe(
        "TITLE\n WEDGE\nBOX, 2, -0.1, -0.8, -0.1, 0.2, 1.6, 0.2, 1, 1, 1\nROTATE, 2, Y, 45.\nTRANSLATE, 2, 0.0625, 0., 0.3934214\n\
         BOX, 1, -0.5, -0.5, 0., 1., 1., 0.25, 8, 8, 2\nNODE SET FACE, 1, 1, BOTTOM\n",
    );
    let energy = |scale: f64| {
        let deck = format!(
            "TERMINATION TIME, 2.6667E-4\nTIME STEP SCALE, {scale}\nCONTACT MATERIAL\nRIGID BODY, 2\nNO DISPLACEMENT, Z, 1\n\
             INITIAL VELOCITY MATERIAL, 2, 0., 0., -300.\nMATERIAL, 1, {STEEL}MATERIAL, 2, {STEEL}"
        );
        run(&deck, &mesh).last().totals.kinetic
    };
    // Without lines twice as much is left. 3 % is the difference of the steps: whole motions of a step are 4 % of an element.
    close("fast edge", "kinetic energy left over that of a tenth of the step", energy(1.0), energy(0.1), 0.03);
}

/// A block at 200 m/s on a held rigid plate thinner than the motion of a step: whatever is left of the gap in the step of the impact,
/// the plate holds it.
#[test]
fn a_thin_rigid_plate_holds_what_is_fast() {
    for gap in [1.0e-3, 1.1e-3, 1.3e-3, 1.6e-3, 1.8e-3, 2.3e-3] {
        let mesh = recipe(&format!(
            "TITLE\n THIN PLATE\nBOX, 1, -0.5, -0.5, -0.002, 1., 1., 0.002, 4, 4, 1\n\
             BOX, 2, -0.15, -0.15, {gap}, 0.3, 0.3, 0.3, 3, 3, 3\nROTATE, 2, Z, 10.\nNODE SET BLOCK, 1, 1\n"
        ));
        let deck = format!(
            "TERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-4\nPLOT NODAL, DISPLACEMENT\nCONTACT MATERIAL\nRIGID BODY, 1\n\
             NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
             INITIAL VELOCITY MATERIAL, 2, 0., 0., -200.\nMATERIAL, 1, {STEEL}MATERIAL, 2, {STEEL}"
        );
        let run = run(&deck, &mesh);
        let lowest = (run.states.iter())
            .flat_map(|state| state.positions(&mesh).into_iter().skip(50))
            .fold(f64::INFINITY, |low, [_, _, z]| low.min(z));
        between(&format!("thin plate, gap {gap}"), "lowest node of the block [m]", lowest, -1e-6, gap);
    }
}

/// A rigid block on a free rigid plate, with motions of four plates in a step: the impact is plastic, ½ m²v²/(m + M).
#[test]
fn a_rigid_block_on_a_thin_free_rigid_plate() {
    let mesh = recipe(
        "TITLE\n PLATE\nBOX, 1, -0.5, -0.5, -0.05, 1., 1., 0.05, 1, 1, 1\nBOX, 2, -0.05, -0.05, 0.05, 0.1, 0.1, 0.1, 1, 1, 1\n\
         BOX, 3, 9., 9., 9., 1., 1., 1., 1, 1, 1\n",
    );
    for step in [2e-4, 2e-5] {
        let deck = format!(
            "TERMINATION TIME, 4.E-3\nTIME STEP MAXIMUM, {step}\nCONTACT MATERIAL\nRIGID BODY, 1\nRIGID BODY, 2\n\
             INITIAL VELOCITY MATERIAL, 2, 0., 0., -1000.\nMATERIAL, 1, {RIGID}MATERIAL, 2, {RIGID}MATERIAL, 3, {RIGID}"
        );
        let kinetic = run(&deck, &mesh).last().totals.kinetic;
        close(&format!("step {step}"), "kinetic energy [J]", kinetic, 0.5 * 1e6 / 51.0, 1e-6);
    }
}

/// A tool that is driven half a millimetre farther than there is room for a free rigid blank on a held die, and rests then. Rigid bodies
/// store nothing: no more than the tool's own motion can be left in the blank, ½ m v² with m = 4 kg and v = 4 m/s at most, and not
/// hundreds of joules that the blank carries off through the tool.
#[test]
fn a_tool_that_leaves_a_rigid_blank_no_room() {
    let mesh = recipe(
        "TITLE\n BLANK\nBOX, 1, 0., 0., 0., 0.2, 0.2, 0.1, 2, 2, 1\nBOX, 2, 0.05, 0.05, 0.12, 0.06, 0.06, 0.1, 1, 1, 1\n\
         NODE SET BLOCK, 2, 2\nBOX, 3, 0., 0., -0.05, 0.2, 0.2, 0.03, 1, 1, 1\nNODE SET BLOCK, 5, 3\n\
         BOX, 4, 9., 9., 9., 1., 1., 1., 1, 1, 1\n",
    );
    let deck = format!(
        "TERMINATION TIME, 0.03\nOUTPUT TIME, 2.E-3\nPLOT TIME, 0.01\nPLOT NODAL, DISPLACEMENT\nCONTACT MATERIAL\n\
         RIGID BODY, 1\nRIGID BODY, 2\nRIGID BODY, 3\nFUNCTION, 1\n0., 0.\n1.E-2, 1.\n1., 1.\nEND\nTIME STEP MAXIMUM, 1.E-4\n\
         NO DISPLACEMENT, X, 5\nNO DISPLACEMENT, Y, 5\nNO DISPLACEMENT, Z, 5\nPRESCRIBED DISPLACEMENT, Z, 2, 1, -0.0405\n\
         MATERIAL, 1, {RIGID}MATERIAL, 2, {RIGID}MATERIAL, 3, {RIGID}MATERIAL, 4, {RIGID}"
    );
    let alone = run(&deck, &mesh);
    between("no room", "kinetic energy left [J]", alone.last().totals.kinetic, -0.1, 0.5 * 4.0 * 4.0 * 4.0);
    let lowest = |run: &Run| run.end().positions(&mesh)[..18].iter().fold(f64::INFINITY, |low, at| low.min(at[2]));
    between("no room", "lowest node of the blank [m]", lowest(&alone), -0.02 - 2e-3, 0.1);
    // What one rank shares, all share.
    let together = run_on(2, &deck, &mesh);
    assert_eq!(together.last().totals.kinetic.to_bits(), alone.last().totals.kinetic.to_bits());
}
