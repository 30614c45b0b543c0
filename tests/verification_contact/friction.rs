//! Coulomb friction between deformable bodies.
//!
//! `cargo test --test verification_contact friction:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::bodies::{mean_velocity, nodes_of};
use crate::support::meshes::recipe;
use crate::support::run::{Line, Run, State, run, run_on};
use crate::support::{between, close};
use urto::mesh::Mesh;

const SLIDING: &str = include_str!("../../decks/sliding_on_block.i");
const SLIDING_MESH: &str = include_str!("../../meshes/sliding_on_block.mesh");

/// Velocity of the block along x in a plot state.
fn speed(state: &State, block: &[usize]) -> f64 {
    mean_velocity(state, block)[0]
}

/// Smallest friction work of any interval between step lines: friction only takes.
fn smallest_gain(run: &Run) -> f64 {
    let gain = |pair: &[Line]| pair[1].totals.friction - pair[0].totals.friction;
    run.lines.windows(2).map(gain).fold(f64::INFINITY, f64::min)
}

fn slide(lines: &str, mesh: &Mesh, end: &str) -> Run {
    let deck = SLIDING.replace("CONTACT DATA, 1, 2, 0.3\n", &format!("{lines}\n"));
    run_on(1, &deck.replace("TERMINATION TIME, 12.E-3", &format!("TERMINATION TIME, {end}")), mesh).whole()
}

/// Coulomb friction under gravity that grows over T = 1 ms: v(t) = v₀ − μ ∫ g dt, rest at v₀/(μ g) + T/2. The block's
/// nodes slide over faces of another size.
#[test]
fn v25_block_slides_to_rest_on_an_elastic_plate() {
    let mesh = recipe(SLIDING_MESH);
    let (run, block) = (run(SLIDING, &mesh), nodes_of(&mesh, 1));
    let (mu, g, v0, ramp) = (0.3, 981.0, 3.0, 1e-3);
    let mass = 7850.0 * 0.1 * 0.1 * 0.05;
    let sliding: Vec<&State> = run.states.iter().filter(|s| s.time > 2e-3 && s.time < 10e-3).collect();
    let (first, last) = (sliding[0], sliding[sliding.len() - 1]);
    let deceleration = (speed(first, &block) - speed(last, &block)) / (last.time - first.time);
    close("V-25 on a plate", "deceleration mu g [m/s2]", deceleration, mu * g, 0.01);
    let nearly = run.states.iter().find(|s| speed(s, &block) < 0.02 * v0).expect("it comes to rest");
    close(
        "V-25 on a plate",
        "time of rest [s]",
        nearly.time + speed(nearly, &block) / (mu * g),
        v0 / (mu * g) + 0.5 * ramp,
        0.01,
    );
    // Gravity does no work on a block that does not sink; what friction took is the energy at the start.
    let end = run.last();
    close("V-25 on a plate", "friction work [J]", end.totals.friction, 0.5 * mass * v0 * v0, 0.01);
    println!(
        "V-25 on a plate: least friction work in 10 microseconds {:.1e} J, contact work {:.2e} J",
        smallest_gain(&run),
        end.totals.contact
    );
    assert!(smallest_gain(&run) >= -1e-9 * end.totals.friction, "friction gives energy back");
    between("V-25 on a plate", "creep at rest over v0", speed(run.end(), &block).abs() / v0, 0.0, 1e-3);
    let load: Vec<f64> =
        run.states.iter().filter(|s| s.time > 2e-3).map(|s| block.iter().map(|&n| s.nodal("CONTZ")[n]).sum()).collect();
    close("V-25 on a plate", "mean normal force m g [N]", load.iter().sum::<f64>() / load.len() as f64, mass * g, 0.02);
    let lowest = load.iter().copied().fold(f64::INFINITY, f64::min);
    println!("V-25 on a plate: least normal force {:.3} m g", lowest / (mass * g));
    between("V-25 on a plate", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
}

/// Without friction the block keeps its velocity.
#[test]
fn extreme_15_no_friction() {
    let mesh = recipe(SLIDING_MESH);
    let (run, block) = (slide("", &mesh, "5.E-3"), nodes_of(&mesh, 1));
    close("extreme 15, mu = 0", "velocity [m/s]", speed(run.end(), &block), 3.0, 1e-3);
    assert_eq!(run.last().totals.friction, 0.0);
}

/// Friction of 10 holds nodes wherever they touch: the block trips and tumbles, and its edge hops. Work is the force times
/// the mean of the velocities before and after a step. Where a node has just landed, or where the passes have not held it
/// altogether, the force that stops it need not be opposed to that mean, and a step may give a little back.
#[test]
fn extreme_15_friction_of_ten() {
    let mesh = recipe(SLIDING_MESH);
    let block = nodes_of(&mesh, 1);
    for (passes, most_back) in [("20, 1.E-6", 1e-4), ("500, 1.E-12", 1e-7)] {
        // Without hourglass viscosity, whose energy is booked with the force of one end of the step only: here, where blows
        // follow each other, that is off by one per cent.
        let deck = SLIDING
            .replace("HOURGLASS STIFFENING, 0.05, 0.03\n", "")
            .replace("1, 2, 0.3", &format!("1, 2, 10.\nCONTACT PASSES, {passes}"))
            .replace("OUTPUT TIME, 10.E-6", "OUTPUT TIME, 1.E-9")
            .replace("12.E-3", "4.E-3");
        let run = run(&deck, &mesh);
        let back = run.lines.windows(2).map(|w| (w[1].totals.friction - w[0].totals.friction).min(0.0)).sum::<f64>();
        let taken = run.last().totals.friction;
        println!(
            "extreme 15, mu = 10, passes {passes}: velocity {:.3} m/s, friction took {:.3} of the energy, least in a step {:.1e}, given back {:.1e} of it",
            speed(run.end(), &block),
            taken / run.initial_energy,
            smallest_gain(&run) / run.initial_energy,
            -back / run.initial_energy
        );
        assert!(
            smallest_gain(&run) >= -most_back * run.initial_energy && -back < 1e-3 * taken,
            "friction gives energy back"
        );
        assert!(run.last().totals.kinetic < run.initial_energy);
        between("extreme 15, mu = 10", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    }
}

/// The plate is shaken under the block: friction reverses with the sliding and takes energy in every step.
#[test]
fn extreme_15_reversal() {
    let mesh = recipe(SLIDING_MESH);
    let mut function = String::from("FUNCTION, 2\n");
    for i in 0..=40 {
        let t = i as f64 * 0.1e-3;
        function += &format!("{t:.5}, {:.6}\n", (t / 2e-3 * std::f64::consts::TAU).sin());
    }
    function += "END\n";
    let deck = SLIDING
        .replace("NO DISPLACEMENT, X, 1", &format!("{function}PRESCRIBED VELOCITY, X, 1, 2, 2."))
        .replace("1, 3., 0., 0.", "1, 0., 0., 0.")
        .replace("OUTPUT TIME, 10.E-6", "OUTPUT TIME, 1.E-9")
        .replace("12.E-3", "4.E-3");
    let run = run(&deck, &mesh);
    let block = nodes_of(&mesh, 1);
    let slip: Vec<f64> =
        run.states.iter().map(|s| 2.0 * (s.time / 2e-3 * std::f64::consts::TAU).sin() - speed(s, &block)).collect();
    let turns = slip.windows(2).filter(|w| w[0] * w[1] < 0.0).count();
    println!(
        "extreme 15, reversal: {turns} reversals, friction work {:.3e} J, least in a step {:.1e} J",
        run.last().totals.friction,
        smallest_gain(&run)
    );
    assert!(turns >= 2, "sliding reverses");
    assert!(
        smallest_gain(&run) >= -1e-9 * run.last().totals.friction,
        "friction gives energy back: {:e}",
        smallest_gain(&run)
    );
    // μ m g moves the block at most.
    let accelerations =
        run.states.windows(2).map(|w| (speed(&w[1], &block) - speed(&w[0], &block)) / (w[1].time - w[0].time));
    between(
        "extreme 15, reversal",
        "largest acceleration over mu g",
        accelerations.fold(0.0f64, |m, a| m.max(a.abs())) / 294.3,
        0.8,
        1.3,
    );
    between("extreme 15, reversal", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
}
