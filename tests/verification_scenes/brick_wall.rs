//! The brick wall (V-28): a rod hits a stack of 17 bricks that leans on a wall, and everything may hit everything.
//!
//! There are no published numbers. What has to hold: nothing passes through anything, momenta stay, energy balances.
//! `cargo test --test verification_scenes brick_wall:: -- --nocapture` prints the numbers of docs/verification.md; the whole run,
//! which takes minutes, is part of `make verify`.

use crate::support::meshes::recipe;
use crate::support::momentum::{angular_momentum, nodal_masses, size};
use crate::support::penetration::{Skin, nothing_deeper};
use crate::support::run::{Run, run_on};
use crate::support::{at_least, between};
use urto::mesh::Mesh;

const DECK: &str = include_str!("../../decks/brick_wall.i");
const RECIPE: &str = include_str!("../../meshes/brick_wall.mesh");

/// The deck over a shorter time, with plot states as dense.
fn shorter(end: f64, plots: f64) -> String {
    let of_deck = ["TERMINATION TIME, 15.E-3", "PLOT TIME, 2.5E-4"];
    assert!(of_deck.iter().all(|line| DECK.contains(line)), "the deck has changed");
    DECK.replace(of_deck[0], &format!("TERMINATION TIME, {end:e}"))
        .replace(of_deck[1], &format!("PLOT TIME, {plots:e}"))
}

#[test]
fn v28_seventeen_bricks_of_54_elements_apart_at_first() {
    let mesh = recipe(RECIPE);
    let skin = Skin::new(&mesh);
    let count = |block: usize| mesh.blocks[block].len();
    assert_eq!(mesh.element_count(), 8400);
    assert_eq!((count(1) / 54, count(2) / 27, skin.bodies()), (11, 6, 1 + 17 + 1));
    assert_eq!(skin.inside(&mesh.coordinates), []);
}

#[test]
fn v28_brick_wall_at_first() {
    let mesh = recipe(RECIPE);
    let run = run_on(2, &shorter(1.2e-3, 5e-5), &mesh).whole();
    check("V-28 first 1.2 ms", &run, &mesh);
    // Most of the energy that will be absorbed is by then: the stack has been hit in earnest.
    let part = run.last().totals.internal / run.initial_energy;
    at_least("V-28 first 1.2 ms", "internal energy over initial energy", part, 0.3);
}

#[test]
fn v28_brick_wall_is_the_same_on_any_number_of_ranks() {
    let mesh = recipe(RECIPE);
    let [one, three] = [1, 3].map(|ranks| run_on(ranks, &shorter(1.2e-4, 1.2e-4), &mesh).whole());
    let bits = |run: &Run| run.end().positions(&mesh).concat().iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
    assert!(bits(&one) == bits(&three), "positions differ");
}

#[test]
#[ignore = "minutes; make verify runs it"]
fn v28_brick_wall_to_the_end() {
    let mesh = recipe(RECIPE);
    let run = run_on(2, &shorter(15e-3, 5e-5), &mesh).whole();
    check("V-28", &run, &mesh);
    let bricks = Skin::new(&mesh);
    // Scattered: the bricks' centres are farther from their mean than at first.
    let spread = |positions: &[[f64; 3]]| spread(&bricks.centres(positions)[1..18]);
    let grown = spread(&run.end().positions(&mesh)) / spread(&mesh.coordinates);
    at_least("V-28", "root mean square distance of bricks from their middle, over the first", grown, 1.3);
}

/// What holds at all times.
fn check(case: &str, run: &Run, mesh: &Mesh) {
    between(case, "worst energy balance", run.worst_balance(), 0.0, 0.02);
    // What contact takes is booked apart, but must be as small: an elastic impact takes nothing.
    let taken = -run.last().totals.contact / run.initial_energy;
    between(case, "work of contact forces over the initial energy", taken, -1e-6, 0.02);
    let first = run.lines[0].totals.momentum;
    let drift = |p: [f64; 3]| size([0, 1, 2].map(|i| p[i] - first[i])) / size(first);
    let worst = run.lines.iter().map(|line| drift(line.totals.momentum)).fold(0.0, f64::max);
    between(case, "drift of linear momentum", worst, 0.0, 1e-9);
    let masses = nodal_masses(mesh, &run.model);
    let first = angular_momentum(&masses, &run.states[0], mesh);
    let drift = |l: [f64; 3]| size([0, 1, 2].map(|i| l[i] - first[i])) / size(first);
    let worst = run.states.iter().map(|state| drift(angular_momentum(&masses, state, mesh))).fold(0.0, f64::max);
    between(case, "drift of angular momentum", worst, 0.0, 1e-9);
    nothing_deeper(case, run, (mesh, &Skin::new(mesh)), [0.05; 2]);
}

/// Root mean square distance of points from their mean.
fn spread(points: &[[f64; 3]]) -> f64 {
    let n = points.len() as f64;
    let mean = [0, 1, 2].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / n);
    let square = |p: &[f64; 3]| (0..3).map(|i| (p[i] - mean[i]).powi(2)).sum::<f64>();
    (points.iter().map(square).sum::<f64>() / n).sqrt()
}
