//! Waves that leave through a SILENT BC, and the histories of material points that watch them.
//!
//! `cargo test --test verification_solids silent:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::program::Desk;
use crate::support::meshes::brick;
use crate::support::run::{Run, run};
use crate::support::{between, close, steel};

/// Elements of the column, which is 0.1 m long.
const ELEMENTS: usize = 200;
const LENGTH: f64 = 0.1;
/// Amplitude of the pulse.
const SPEED: f64 = 1.0;

/// A smooth hump of velocity in `direction` at x = 0, over a length of 40 elements, in a column that can move in that direction
/// only; until the end of the column would have sent it back to x = 0. `boundary` is the command for x = L.
fn pulse(direction: char, wave_speed: f64, boundary: &str) -> Run {
    pulse_in(
        "MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n",
        direction,
        wave_speed,
        boundary,
    )
}

/// The same in a material that the deck describes.
fn pulse_in(material: &str, direction: char, wave_speed: f64, boundary: &str) -> Run {
    let transit = LENGTH / wave_speed;
    let held: String = ['X', 'Y', 'Z'].iter().filter(|d| **d != direction).map(|d| hold(*d)).collect();
    let deck = format!(
        "TITLE\n pulse\n$ {{transit = {transit:e}}} {{length = 0.2 * transit}}\nTERMINATION TIME, {{1.95 * transit}}\n\
         OUTPUT TIME, {{transit / 50}}\nPLOT TIME, {{transit / 100}}\nPLOT NODAL, VELOCITY\n\
         PLOT ELEMENT, STRESS\nBULK VISCOSITY, 0., 0.\n\
         FUNCTION, 1\n{{loop(41, i)}}\n{{i / 40 * length}}, {{(1 - cosd(i * 9)) / 2}}\n{{endloop}}\nEND\n{held}\
         PRESCRIBED VELOCITY, {direction}, 1, 1, {SPEED}\n{boundary}\n\
         {material}EXIT\n"
    );
    let width = LENGTH / ELEMENTS as f64;
    run(&deck, &brick([ELEMENTS, 1, 1], [LENGTH, width, width])).whole()
}

/// One element across, so that both planes of y together are all nodes.
fn hold(direction: char) -> String {
    format!("NO DISPLACEMENT, {direction}, 3\n")
}

/// Largest velocity in the middle of the column while the pulse goes there, and while it would come back.
fn there_and_back(run: &Run, direction: char, wave_speed: f64) -> [f64; 2] {
    let transit = LENGTH / wave_speed;
    let name = format!("VEL{direction}");
    let largest = |from: f64, to: f64| {
        let states = run.states.iter().filter(|s| (from..to).contains(&(s.time / transit)));
        states.map(|s| s.nodal(&name)[ELEMENTS / 2].abs()).fold(0.0, f64::max)
    };
    [largest(0.0, 1.2), largest(1.3, 2.0)]
}

fn leaves(case: &str, direction: char, wave_speed: f64) {
    let run = pulse(direction, wave_speed, "SILENT BC, 200");
    let [there, back] = there_and_back(&run, direction, wave_speed);
    close(case, "pulse [m/s]", there, SPEED, 0.02);
    between(case, "reflected, as a fraction", back / there, 0.0, 0.02);
    // What is left of the energy that was put in: the dashpots have done the same work backwards.
    let put_in = run.lines.iter().map(|line| line.totals.external).fold(0.0, f64::max);
    let left = run.last().totals.kinetic + run.last().totals.internal;
    between(case, "energy left behind, as a fraction", left / put_in, 0.0, 1e-3);
    // Held against the energy that was put in: at the end there is nothing else to hold it against.
    let astray = run.lines.iter().map(|line| line.totals.imbalance(0.0).abs()).fold(0.0, f64::max);
    between(case, "energy gone astray, as a fraction", astray / put_in, 0.0, 1e-4);
}

/// Pressure waves run at c_L, and meet ρ c_L.
#[test]
fn v40_a_pressure_wave_leaves() {
    leaves("V-40 P", 'X', steel::wave_speed());
}

fn shear_speed() -> f64 {
    (steel::E / (2.0 * 1.3) / steel::RHO).sqrt()
}

/// Shear waves run at c_S, and meet ρ c_S.
#[test]
fn v40_a_shear_wave_leaves() {
    leaves("V-40 S", 'Y', shear_speed());
}

/// Waves in a material that MASS SCALING has made four times as heavy run at c/2, and meet 2 ρ c.
#[test]
fn v40_a_wave_in_heavier_elements_leaves() {
    let speed = 0.5 * steel::wave_speed();
    let run = pulse('X', speed, "MASS SCALING, 1, FACTOR, 4., 10.\nSILENT BC, 200");
    let [there, back] = there_and_back(&run, 'X', speed);
    between("V-40, mass scaling", "reflected, as a fraction", back / there, 0.0, 0.02);
}

/// Honeycomb far from crushed, of a metal much stiffer than itself: waves run, and leave, by the moduli that it has at the start, a
/// pressure wave along x by EX alone, and a shear wave by GXY.
#[test]
fn v40_waves_in_honeycomb_leave() {
    let material = "FUNCTION, 2\n0., 1.E9\nEND\nMATERIAL, 1, ORTHOTROPIC CRUSH, 100.\nYOUNGS MODULUS = 20.E9\n\
         POISSONS RATIO = 0.33\nYIELD STRESS = 1.E9\nEX = 4.E9\nEY = 2.E9\nEZ = 8.E9\nGXY = 1.E9\nGYZ = 3.E9\n\
         GZX = 6.E9\nCRUSH XX = 2\nCRUSH YY = 2\nCRUSH ZZ = 2\nCRUSH XY = 2\nCRUSH YZ = 2\nCRUSH ZX = 2\n\
         VMIN = 0.3\nEND\n";
    for (case, direction, modulus) in [("V-40 EX", 'X', 4e9_f64), ("V-40 GXY", 'Y', 1e9)] {
        let speed = (modulus / 100.0).sqrt();
        let [there, back] = there_and_back(&pulse_in(material, direction, speed, "SILENT BC, 200"), direction, speed);
        close(case, "pulse [m/s]", there, SPEED, 0.02);
        between(case, "reflected, as a fraction", back / there, 0.0, 0.02);
    }
}

/// The same pulse comes back whole from a free end: the test can see a reflection.
#[test]
fn v40_a_free_end_sends_the_wave_back() {
    let run = pulse('X', steel::wave_speed(), "");
    let [there, back] = there_and_back(&run, 'X', steel::wave_speed());
    close("V-40 free end", "reflected, as a fraction", back / there, 1.0, 0.02);
}

/// A watched element says the same in BASE.h as in BASE.e, on any number of ranks, and the pulse passes it at the speed
/// of its wave.
#[test]
fn v41_histories_of_material_points() {
    let transit = LENGTH / steel::wave_speed();
    let deck = format!(
        "TITLE\n watched\n$ {{t = {transit:e}}}\nTERMINATION TIME, {{t}}\nOUTPUT TIME, {{t / 50}}\nPLOT TIME, {{t / 50}}\n\
         PLOT NODAL, VELOCITY\nPLOT ELEMENT, STRESS, STRAIN, PRESSURE, VONMISES, ENERGY, DENSITY\nPLOT STATE, EQPS\n\
         FUNCTION, 1\n0., 1.\nEND\nPRESCRIBED VELOCITY, X, 1, 1, 100.\nNO DISPLACEMENT, Y, 3\nNO DISPLACEMENT, Z, 4\n\
         SILENT BC, 200\nMATERIAL POINT, 0.03, 0.001, 0.001\nMATERIAL POINT, 0.0701, 0.002, 0.003\n\
         MATERIAL, 1, ELASTIC PLASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 400.E6\n\
         HARDENING MODULUS = 2.E9\nBETA = 1.\nEND\nEXIT\n"
    );
    let desk = Desk::new();
    desk.put("watched.i", &deck);
    desk.put_mesh("watched.g", &brick([100, 1, 1], [LENGTH, 0.004, 0.004]));
    desk.urto(&["watched.i", "-q", "--ranks", "1"]).with(0);
    let (plots, histories) = (desk.results("watched.e"), desk.results("watched.h"));
    assert_eq!(plots.times(), histories.times());
    let names = histories.global_names().to_vec();
    // x = 0.03 is a face between elements 30 and 31; the first of them is watched.
    for (point, element) in [(1, 29), (2, 70)] {
        for name in plots.element_names() {
            let place = names.iter().position(|n| *n == format!("{name}_{point}")).expect(name);
            for state in 0..plots.times().len() {
                let plotted = plots.element(name, state).expect("an element variable")[element];
                assert_eq!(
                    histories.global(state).expect("globals")[place],
                    plotted,
                    "{name}_{point} at state {state}"
                );
            }
        }
    }
    let arrival = |point: usize| {
        let place = names.iter().position(|n| *n == format!("VELX_{point}")).expect("a velocity");
        let fast = |state: &usize| histories.global(*state).expect("globals")[place] > 10.0;
        let state = (0..histories.times().len()).find(fast).expect("the wave comes");
        histories.times()[state]
    };
    // The precursor; states are 1/50 of the transit apart, and the front is some elements wide.
    close("V-41", "time from point to point [transits]", (arrival(2) - arrival(1)) / transit, 0.41, 0.05);
    desk.urto(&["watched.i", "-q", "--ranks", "3", "-o", "three"]).with(0);
    let bits = |name: &str| {
        let results = desk.results(name);
        (0..results.times().len()).map(|s| results.global(s).expect("globals")).collect::<Vec<_>>()
    };
    assert_eq!(bits("watched.h"), bits("three.h"));
    assert_eq!(exodus_blocks(&desk, "watched.h"), (1, 2, 16));
}

/// Blocks, elements and nodes of a file's mesh.
fn exodus_blocks(desk: &Desk, name: &str) -> (usize, usize, usize) {
    let mesh = urto::exodus::read_mesh(&desk.path(name)).expect("a mesh");
    (mesh.blocks.len(), mesh.element_count(), mesh.coordinates.len())
}
