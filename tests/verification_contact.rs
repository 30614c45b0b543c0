//! Contact of bars: collisions with answers from one-dimensional waves.
//!
//! `cargo test --test verification_contact -- --nocapture` prints the numbers of docs/verification.md.

mod support;

use support::bodies::{mean_velocity, nodes_of};
use support::meshes::recipe;
use support::run::{Run, run};
use support::{between, close, steel};
use urto::mesh::Mesh;

const TWO_BARS: &str = include_str!("../decks/two_bars.i");
const TWO_BARS_MESH: &str = include_str!("../meshes/two_bars.mesh");
const CRADLE: &str = include_str!("../decks/newtons_cradle.i");
const CRADLE_MESH: &str = include_str!("../meshes/newtons_cradle.mesh");

/// Two bars end to end, of so many elements and so long.
fn bars(cells: [usize; 2], lengths: [f64; 2]) -> Mesh {
    let bar = |x: f64, length: f64, cells: usize| format!("0., 0.,  {length:?}, 0.01, 0.01,  {cells}, 1, 1");
    let boxes = [bar(0.0, lengths[0], cells[0]), bar(lengths[0], lengths[1], cells[1])];
    let text = TWO_BARS_MESH
        .replace("0., 0., 0.,  1., 0.01, 0.01,  50, 1, 1", &format!("0., {}", boxes[0]))
        .replace("1., 0., 0.,  1., 0.01, 0.01,  50, 1, 1", &format!("{:?}, {}", lengths[0], boxes[1]));
    recipe(&text)
}

/// The deck with these lines before its title.
fn with(deck: &str, lines: &str) -> String {
    deck.replacen("TITLE", &format!("{lines}\nTITLE"), 1)
}

/// Mean velocities of the blocks at the end, over that of the first at the start.
fn velocities(mesh: &Mesh, run: &Run) -> Vec<f64> {
    let start = mean_velocity(&run.states[0], &nodes_of(mesh, 1))[0];
    mesh.blocks.iter().map(|block| mean_velocity(run.end(), &nodes_of(mesh, block.id))[0] / start).collect()
}

/// Largest change of linear momentum over its size at the start.
fn momentum_error(run: &Run) -> f64 {
    let start = run.lines[0].totals.momentum;
    let size = start.iter().fold(0.0f64, |m, p| m.max(p.abs()));
    let off = |line: &support::run::Line| (0..3).fold(0.0f64, |m, i| m.max((line.totals.momentum[i] - start[i]).abs()));
    run.lines.iter().fold(0.0f64, |m, line| m.max(off(line))) / size
}

#[test]
fn v21_probe() {
    for (n, m) in [(10, 10), (50, 50), (200, 200), (50, 20), (20, 50)] {
        let mesh = bars([n, m], [1.0, 1.0]);
        for b1 in ["0.", "0.06"] {
            for passes in ["1", "20"] {
                let deck = with(TWO_BARS, &format!("BULK VISCOSITY, {b1}, 1.2\nCONTACT PASSES, {passes}"));
                let run = run(&deck, &mesh);
                let loss = -run.last().totals.contact / run.initial_energy;
                println!(
                    "{n}/{m} b1={b1} passes {passes}: loss {loss:.6} x4N {:.5} v {:?} p {:.1e} bal {:.1e}",
                    loss * 4.0 * n as f64,
                    velocities(&mesh, &run),
                    momentum_error(&run),
                    run.worst_balance()
                );
            }
        }
    }
}
#[test]
fn blow() {
    let mesh = bars([50, 20], [1.0, 1.0]);
    let deck = with(TWO_BARS, "BULK VISCOSITY, 0., 1.2").replace("PLOT TIME, 1.E-6", "PLOT TIME, 1.E-9").replace("OUTPUT TIME, 1.E-6", "OUTPUT TIME, 1.E-9");
    let run = run(&deck, &mesh);
    for (k, state) in run.states.iter().enumerate().take(70) {
        let pairs = [(50, 204), (101, 225), (152, 246), (203, 267)];
        let d = |name: &str, a: usize, b: usize| (state.nodal(name)[a] - state.nodal(name)[b]) / 0.01;
        let text: Vec<String> = pairs.iter().map(|&(a, b)| format!("{:+.1e}/{:+.1e}/{:+.1e} {}{}", d("DISPLX", a, b), d("DISPLY", a, b), d("DISPLZ", a, b), state.nodal("CONTSTAT")[a], state.nodal("CONTSTAT")[b])).collect();
        println!("{k:3} {}", text.join("   "));
    }
}
