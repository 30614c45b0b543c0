//! A square tube of sheet metal that folds (V-33): force, folds, and nothing through anything.
//!
//! `cargo test --test verification_structural square_tube:: -- --nocapture` prints the numbers of docs/verification.md; the
//! whole deck is part of `make verify`.

use crate::support::meshes::recipe;
use crate::support::run::{Run, run_on};
use crate::support::surfaces::Surfaces;
use crate::support::{at_least, between};
use urto::mesh::Mesh;

const DECK: &str = include_str!("../../decks/square_tube.i");
const RECIPE: &str = include_str!("../../meshes/square_tube.mesh");

/// Width, thickness, flow stress.
const C: f64 = 37.07e-3;
const T: f64 = 1.152e-3;
const FLOW: f64 = 300e6;

/// Mean force over the fold lengths that are used up (Wierzbicki and Abramowicz 1983, effective stroke of 0.73).
fn foretold() -> f64 {
    13.06 * FLOW * T.powf(5.0 / 3.0) * C.cbrt()
}

/// Force that would do the work that the head has done, of the whole tube, until the end of the run.
fn mean_force(run: &Run) -> f64 {
    // The head comes to 10 m/s in half a millisecond.
    let way = 10.0 * (run.last().time - 0.25e-3);
    4.0 * run.last().totals.external / way
}

/// Lobes of a side along its middle at the end, in and out by more than two thicknesses.
fn lobes(run: &Run, mesh: &Mesh) -> usize {
    let at = run.end().positions(mesh);
    let mut middle: Vec<usize> = (0..at.len()).filter(|&n| mesh.coordinates[n][0].abs() < 1e-9).collect();
    middle.sort_by(|&a, &b| mesh.coordinates[a][2].total_cmp(&mesh.coordinates[b][2]));
    let out = |n: &usize| at[*n][1] - 0.5 * C;
    let sides: Vec<bool> = middle.iter().map(out).filter(|out| out.abs() > 2.0 * T).map(|out| out > 0.0).collect();
    usize::from(!sides.is_empty()) + sides.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

fn check(case: &str, run: &Run, mesh: &Mesh, folds: f64) {
    between(case, "mean force over that foretold", mean_force(run) / foretold(), 0.8, 1.2);
    at_least(case, "lobes of a side", lobes(run, mesh) as f64, folds);
    between(case, "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    let worked = run.last().totals.external;
    between(case, "work of contact over the work of the head", run.last().totals.contact / worked, -0.01, 1e-9);
    let surfaces = Surfaces::new(mesh);
    let (mut least, mut pair) = (f64::INFINITY, String::new());
    for state in &run.states {
        let at = state.positions(mesh);
        assert_eq!(surfaces.pierced(&at), [], "{case}: time {}", state.time);
        let (distance, node, face) = surfaces.nearest(&at);
        if distance < least {
            least = distance;
            pair = format!("node {node} and face {face:?} at {:.3e}", state.time);
        }
    }
    at_least(case, &format!("least distance of walls over the thickness, {pair}"), least / T, 0.97);
}

#[test]
fn v33_coarse_tube_begins_to_fold() {
    let mesh = recipe(&RECIPE.replace("8, 60", "5, 40"));
    let run = run_on(2, &DECK.replace("TERMINATION TIME, 9.E-3", "TERMINATION TIME, 4.E-3"), &mesh).whole();
    check("V-33 coarse", &run, &mesh, 2.0);
}

#[test]
#[ignore = "minutes; make verify runs it"]
fn v33_tube_folds() {
    let mesh = recipe(RECIPE);
    let run = run_on(2, DECK, &mesh).whole();
    check("V-33", &run, &mesh, 4.0);
}
