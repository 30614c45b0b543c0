//! The can crush (V-29): a can with a fixed bottom under a plate that falls on it tilted, and folds upon itself.
//!
//! `cargo test --test verification_scenes can_crush:: -- --nocapture` prints the numbers of docs/verification.md. It crushes a can
//! of a fifth of the elements; the cans of the decks, which take minutes, are part of `make verify`.

use crate::support::meshes::recipe;
use crate::support::penetration::{Skin, nothing_deeper};
use crate::support::run::{Run, run_on};
use crate::support::{at_least, between, close};
use urto::mesh::Mesh;

const DECK: &str = include_str!("../../decks/can_crush.i");
const RECIPE: &str = include_str!("../../meshes/can_crush.mesh");
const PAPER_DECK: &str = include_str!("../../decks/can_crush_paper.i");
const PAPER_RECIPE: &str = include_str!("../../meshes/can_crush_paper.mesh");

/// A text with one part, which must be there, changed.
fn with(text: &str, old: &str, new: &str) -> String {
    assert!(text.contains(old), "there is no {old:?} any more");
    text.replace(old, new)
}

#[test]
fn v29_meshes_are_those_of_the_paper() {
    for text in [RECIPE, PAPER_RECIPE] {
        let mesh = recipe(text);
        assert_eq!((mesh.element_count(), mesh.coordinates.len()), (7152, 10088));
    }
}

#[test]
fn v29_energy_of_the_plates() {
    // ½ ρ V v² of 16 x 8 x 2.5 and of 22 x 11 x 2.5 cubic inches at 5000 in/s.
    let at_rest = |deck: &str, end: &str| with(deck, end, "TERMINATION TIME, 1.E-6");
    let run = run_on(2, &at_rest(DECK, "TERMINATION TIME, 4.3E-3"), &recipe(RECIPE)).whole();
    close("V-29", "initial kinetic energy", run.initial_energy, 0.5 * 7.324e-4 * 320.0 * 25e6, 1e-12);
    let run = run_on(2, &at_rest(PAPER_DECK, "TERMINATION TIME, 3.2E-3"), &recipe(PAPER_RECIPE)).whole();
    close("V-29 paper", "initial kinetic energy", run.initial_energy, 5.551e6, 1e-3);
}

#[test]
fn v29_coarse_can_is_crushed() {
    let text = with(RECIPE, "3,       40,     40,    HALF", "2,       24,     24,    HALF");
    let mesh = recipe(&with(&text, "28, 28, 3", "14, 14, 2"));
    // In as many states as show touches that last for microseconds.
    let run = run_on(2, &with(DECK, "PLOT TIME, 1.E-4", "PLOT TIME, 5.E-6"), &mesh).whole();
    // 12 to 14 of its 1,875 nodes in twelve runs with the plate faster by parts of a thousandth; 13 to 15 while bent lines did not hold each other, and nodes
    // did instead.
    check("V-29 coarse", &run, &mesh, [0.006, 0.05]);
    at_least(
        "V-29 coarse",
        "way aside of a node of the rim, over that of its neighbours",
        least_way_aside(&run, &mesh),
        0.3,
    );
}

#[test]
#[ignore = "minutes; make verify runs it"]
fn v29_can_is_crushed() {
    let mesh = recipe(RECIPE);
    let run = run_on(2, &with(DECK, "PLOT TIME, 1.E-4", "PLOT TIME, 2.E-5"), &mesh).whole();
    check("V-29", &run, &mesh, [0.0075, 0.05]);
}

#[test]
#[ignore = "minutes; make verify runs it"]
fn v29_can_of_the_paper_is_crushed() {
    let mesh = recipe(PAPER_RECIPE);
    let run = run_on(2, &with(PAPER_DECK, "PLOT TIME, 1.E-4", "PLOT TIME, 2.E-5"), &mesh).whole();
    check("V-29 paper", &run, &mesh, [0.0075, 0.05]);
}

/// Energy, at least this part of the nodes in folds that touch, no node inside anything, and no edge deeper than this part of a face.
fn check(case: &str, run: &Run, mesh: &Mesh, [least_folded, deepest_edge]: [f64; 2]) {
    between(case, "worst energy balance", run.worst_balance(), 0.0, 0.02);
    // What contact takes is booked apart, but must be as small: an elastic impact takes nothing.
    let taken = -run.last().totals.contact / run.initial_energy;
    between(case, "work of contact forces over the initial energy", taken, -1e-6, 0.02);
    // Every can is crushed in earnest: it takes up at least half of what the smaller plate brings.
    let lost = run.initial_energy - run.last().totals.kinetic;
    at_least(case, "energy that the can has taken up", lost, 0.5 * 2.9296e6);
    // A part, since which nodes meet hangs on digits, and how many on the mesh.
    at_least(case, "part of the can's nodes that have touched the can in a state", folded(run, mesh), least_folded);
    nothing_deeper(case, run, (mesh, &Skin::with_symmetry(mesh, 1)), [0.05, deepest_edge]);
}

/// The part of the can's nodes that meet an element of the can in any state.
fn folded(run: &Run, mesh: &Mesh) -> f64 {
    let can = mesh.blocks[0].len();
    let of_can = |element: f64| mesh.element_ids[..can].binary_search(&(element as i64)).is_ok();
    let mut nodes: Vec<u32> = mesh.blocks[0].nodes.clone();
    nodes.sort_unstable();
    nodes.dedup();
    let meets = |n: u32| run.states.iter().any(|state| of_can(state.nodal("CONTFACE")[n as usize]));
    nodes.iter().filter(|&&n| meets(n)).count() as f64 / nodes.len() as f64
}

/// While the plate pushes the outer rim aside: how far a node of it goes along x between two states, over what the two beside it go on average; the least
/// of all. What goes along with its neighbours has about 1, what is stopped or thrown back 0 and less.
fn least_way_aside(run: &Run, mesh: &Mesh) -> f64 {
    let angle = |n: usize| mesh.coordinates[n][1].atan2(mesh.coordinates[n][0]);
    let is_rim = |n: &usize| {
        let [x, y, z] = mesh.coordinates[*n];
        z.abs() < 1e-9 && x.hypot(y) > 5.24
    };
    let of_can = mesh.blocks[0].nodes.iter().map(|&n| n as usize).collect::<std::collections::BTreeSet<usize>>();
    let mut rim: Vec<usize> = of_can.into_iter().filter(is_rim).collect();
    rim.sort_by(|a, b| angle(*a).total_cmp(&angle(*b)));
    // Every fourth state: in 20 microseconds what is pushed goes some way.
    let pushed = run.states.iter().step_by(4).filter(|state| (2.9e-4..=6.01e-4).contains(&state.time));
    let places = pushed.map(|state| state.positions(mesh));
    let x: Vec<Vec<f64>> = places.map(|places| rim.iter().map(|&n| places[n][0]).collect()).collect();
    let mut least = f64::INFINITY;
    for states in x.windows(2) {
        let ways: Vec<f64> = states[0].iter().zip(&states[1]).map(|(before, after)| after - before).collect();
        for three in ways.windows(3) {
            let beside = 0.5 * (three[0] + three[2]);
            // What hardly moves is not pushed.
            if beside.abs() > 0.02 {
                least = least.min(three[1] / beside);
            }
        }
    }
    least
}
