//! Contacts that only the forces of other contacts bring about in a step: what is struck lies on something, what is stopped by one wall meets another.

use crate::support::meshes::recipe;
use crate::support::run::{State, run, run_on};
use crate::support::{at_least, between, close};
use urto::mesh::Mesh;

const STEEL: &str = "ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";

/// Least and largest coordinate along an axis of a block's nodes.
fn extent(state: &State, mesh: &Mesh, block: usize, axis: usize) -> [f64; 2] {
    let at = state.positions(mesh);
    let along = mesh.blocks[block].nodes.iter().map(|&node| at[node as usize][axis]);
    along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [x.min(low), x.max(high)])
}

/// A cube strikes a sheet of 0.1 mm that lies on another one, so hard that a step takes it as far. The sheets stay a thickness apart, to the hundredth that
/// passes of contact may leave. At 20 m/s they were in the same place after the first step, and stayed so.
#[test]
fn a_sheet_that_is_struck_stays_on_the_one_on_which_it_lies() {
    let mesh = recipe(
        "BOX, 1, -0.001, -0.001, 5.1E-5, 0.012, 0.012, 0.01, 1, 1, 1\nSHEET, 2, 0., 0., 0., 0.01, 0.01, 0., 1, 1\n\
         SHEET, 3, 0., 0., -0.0001, 0.01, 0.01, 0., 1, 1\n",
    );
    let film = "ELASTIC, 1200.\nYOUNGS MODULUS = 2.E9\nPOISSONS RATIO = 0.3\nEND\n";
    for speed in [5.0, 20.0] {
        let films = [2, 3].map(|block| format!("SHELL THICKNESS, {block}, 0.0001\nMATERIAL, {block}, {film}")).concat();
        let deck = format!(
            "TITLE\n films\nTERMINATION TIME, 5.E-5\nPLOT TIME, 2.E-6\nPLOT NODAL, DISPLACEMENT\nRIGID BODY, 1\n\
             INITIAL VELOCITY MATERIAL, 1, 0., 0., -{speed}\nCONTACT MATERIAL\nMATERIAL, 1, {STEEL}{films}EXIT\n"
        );
        let run = run(&deck, &mesh);
        let apart = run.states.iter().map(|state| {
            let [upper, lower] = [1, 2].map(|block| extent(state, &mesh, block, 2));
            (upper[0] - lower[1]) / 1e-4
        });
        at_least("struck sheets", "distance over the thickness", apart.fold(f64::INFINITY, f64::min), 0.99);
        assert!(extent(run.end(), &mesh, 2, 2)[1] < -1.5e-4, "{speed}: they have been struck");
    }
}

/// A rigid cube strikes a rigid coin of 1 mm that lies on a rigid plate of 4 mm that is held, in steps in which it goes half a millimetre. The coin stays
/// on the plate, but for a fifth of a step's way, which passes of contact that run out leave in the first one; it fell through it at 42 m/s.
#[test]
fn a_coin_that_is_struck_does_not_fall_through_the_plate_on_which_it_lies() {
    let mesh = recipe(
        "BOX, 1, 0.001, 0.001, 0.00102, 0.008, 0.008, 0.008, 2, 2, 2\nBOX, 2, 0., 0., 0., 0.01, 0.01, 0.001, 3, 3, 1\n\
         BOX, 3, -0.01, -0.01, -0.004, 0.03, 0.03, 0.004, 5, 5, 1\nNODE SET BLOCK, 1, 3\n",
    );
    let laws = [1, 2, 3].map(|block| format!("RIGID BODY, {block}\nMATERIAL, {block}, {STEEL}")).concat();
    let deck = format!(
        "TITLE\n coin\nTERMINATION TIME, 0.0006\nPLOT TIME, 1.E-5\nPLOT NODAL, DISPLACEMENT\nTIME STEP MAXIMUM, 1.E-5\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
         INITIAL VELOCITY MATERIAL, 1, 0., 0., -50.0\nCONTACT MATERIAL\n{laws}EXIT\n"
    );
    let one = run_on(1, &deck, &mesh).whole();
    let lowest = one.states.iter().map(|state| extent(state, &mesh, 1, 2)[0]).fold(f64::INFINITY, f64::min);
    at_least("coin", "lowest place over the way of a step", lowest / 5e-4, -0.2);
    between("coin", "work of contact", one.last().totals.contact, f64::NEG_INFINITY, 0.0);
    let three = run_on(3, &deck, &mesh).whole();
    assert!(one.end().nodal("DISPLZ") == three.end().nodal("DISPLZ"), "not the same bits on three ranks");
}

/// The nodes of a cube that DEATH takes away fly into the inner corner of an L and into one of sheets, and so do the nodes of a wire. They all stay outside; half of them came out behind, with one component of their velocities as it was.
#[test]
fn what_flies_into_a_corner_stays_in_it() {
    let walls = "BOX, 2, 0., 0.04, 0., 0.04, 0.01, 0.04, 4, 1, 4\nBOX, 2, 0.04, 0., 0., 0.01, 0.04, 0.04, 1, 4, 4\n\
                 BOX, 2, 0.04, 0.04, 0., 0.01, 0.01, 0.04, 1, 1, 4\n";
    let (cube, wire) = (
        "BOX, 1, 0.0195, {y}, 0.0195, 0.001, 0.001, 0.001, 1, 1, 1\n",
        "LINE, 1, 0.0195, {y}, 0.01, 0.0195, {y}, 0.03, 5\n",
    );
    let eroded = "DEATH, 1, VOLUME, MIN, 2.\n";
    let sheets =
        "SHEET, 2, 0., 0.04, 0., 0.04, 0., 0.04, 5, 5\nSHEET, 2, 0.04, 0., 0., 0., 0.04, 0.04, 5, 5\nMERGE, 2\n";
    let merged = format!("{walls}MERGE, 2\n");
    for (what, bodies, walls, more) in [
        ("one body", cube, merged.as_str(), eroded),
        ("wire", wire, merged.as_str(), "TRUSS AREA, 1, 1.E-8\nCONTACT THICKNESS, 1, 0.\n"),
        ("sheets", cube, sheets, "DEATH, 1, VOLUME, MIN, 2.\nSHELL THICKNESS, 2, 0.001\n"),
    ] {
        for y in ["0.01949", "0.01947"] {
            let mesh = recipe(&format!("{}{walls}NODE SET BLOCK, 2, 2\n", bodies.replace("{y}", y)));
            let deck = format!(
                "TITLE\n corner\nTERMINATION TIME, 1.3E-4\nPLOT TIME, 5.E-6\nPLOT NODAL, DISPLACEMENT\n\
                 NO DISPLACEMENT, X, 2\nNO DISPLACEMENT, Y, 2\nNO DISPLACEMENT, Z, 2\n\
                 INITIAL VELOCITY MATERIAL, 1, 300., 300., 0.\nCONTACT MATERIAL\n{more}\
                 MATERIAL, 1, ELASTIC, 2000.\nYOUNGS MODULUS = 10.E9\nPOISSONS RATIO = 0.3\nEND\nMATERIAL, 2, {STEEL}EXIT\n"
            );
            let run = run(&deck, &mesh);
            let farthest = [0, 1].map(|axis| {
                let of = |state: &State| extent(state, &mesh, 0, axis)[1];
                run.states.iter().map(of).fold(f64::NEG_INFINITY, f64::max)
            });
            // A thousandth of an element is what passes of contact may leave where things come at a twentieth of the speed of sound.
            between(what, "farthest along x and y", farthest[0].max(farthest[1]), 0.035, 0.04 + 1e-5);
            close(what, "where they end", extent(run.end(), &mesh, 0, 0)[1], 0.0395, 0.02);
        }
    }
}
