//! Honeycomb: what it takes to crush a bar of it at a speed.
//!
//! `cargo test --test verification_materials crush:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::meshes::brick;
use crate::support::run::{Run, run};
use crate::support::{between, close};

/// Length of the bar, its area, and the speed of the end that crushes it.
const LENGTH: f64 = 0.2;
const AREA: f64 = 1e-4;
const SPEED: f64 = 30.0;
/// Force by which the honeycomb crushes along x.
const FORCE: f64 = 0.5e6 * AREA;

/// A bar of aluminium honeycomb whose one end stands and whose other end moves at 30 m/s until the bar is half as long. It crushes in a
/// front before that end; what runs ahead as an elastic wave has 1.7 m/s.
fn crushed(elements: usize) -> Run {
    let deck = format!(
        "TITLE\n crush\nTERMINATION TIME, {}\nPLOT TIME, 2.E-5\nPLOT NODAL, REACTION\nNO DISPLACEMENT, Y, 3\nNO DISPLACEMENT, Z, 3\n\
         NO DISPLACEMENT, X, 1\nPRESCRIBED VELOCITY, X, 2, 1, {}\nFUNCTION, 1\n0., 1.\nEND\nFUNCTION, 2\n0., 0.5E6\nEND\n\
         MATERIAL, 1, ORTHOTROPIC CRUSH, 83.\nYOUNGS MODULUS = 69.E9\nPOISSONS RATIO = 0.33\nYIELD STRESS = 160.E6\n\
         EX = 1.E9\nEY = 20.E6\nEZ = 1.E9\nGXY = 10.E6\nGYZ = 400.E6\nGZX = 200.E6\nCRUSH XX = 2\nCRUSH YY = 2\n\
         CRUSH ZZ = 2\nCRUSH XY = 2\nCRUSH YZ = 2\nCRUSH ZX = 2\nVMIN = 0.3\nEND\n",
        0.5 * LENGTH / SPEED,
        -SPEED
    );
    run(&deck, &brick([elements, 1, 1], [LENGTH, AREA.sqrt(), AREA.sqrt()])).whole()
}

/// The end that stands feels what the honeycomb crushes by, however coarse the mesh is; the one that moves feels more by what it takes to
/// bring the material along: ρ v²/ε, v what it is faster than the elastic wave before the front, ε the strain of what is compact.
#[test]
fn honeycomb_crushes_by_its_curve_at_speed() {
    let jump = SPEED - FORCE / AREA / (83.0 * 1e9f64).sqrt();
    let moving = FORCE + 83.0 * jump * jump / 0.7 * AREA;
    for elements in [10, 40] {
        let bar = crushed(elements);
        let late: Vec<_> = bar.states.iter().filter(|state| state.time > 0.2 * bar.end().time).collect();
        // Four nodes at each plane across, in rows along the bar.
        let mean = |plane: usize| {
            let nodes = (0..4).map(|row| row * (elements + 1) + plane);
            let forces = nodes.flat_map(|node| late.iter().map(move |state| state.nodal("RX")[node]));
            (forces.sum::<f64>() / late.len() as f64).abs()
        };
        close("Honeycomb", &format!("{elements} elements, end that stands [N]"), mean(0), FORCE, 0.01);
        close("Honeycomb", &format!("{elements} elements, end that moves [N]"), mean(elements), moving, 0.03);
        between("Honeycomb", "worst energy balance", bar.worst_balance(), 0.0, 1e-3);
    }
}
