//! Sheets between what is driven together to less than their thickness.

use crate::support::between;
use crate::support::meshes::recipe;
use crate::support::run::{State, run_on};
use crate::support::surfaces::Surfaces;
use urto::mesh::Mesh;

/// Thickness of the sheets.
const T: f64 = 2e-3;

/// Distances between the mean heights of four sheets, in thicknesses.
fn distances(state: &State, mesh: &Mesh) -> [f64; 3] {
    let at = state.positions(mesh);
    let height = |block: usize| {
        let nodes = &mesh.blocks[block].nodes;
        nodes.iter().map(|&n| at[n as usize][2]).sum::<f64>() / nodes.len() as f64
    };
    [0, 1, 2].map(|i| (height(i + 1) - height(i)) / T)
}

/// Four sheets lie on each other, and the outer two are driven together until half of the room between them is left. No forces keep the thickness
/// then, and what the deck drives does not give way. In equal parts there would be half a thickness between any two at the end; they are to keep half of
/// their part all the time, and nothing goes through anything. Forces that grow against each other threw the inner two through the lower one.
#[test]
fn sheets_without_room_share_what_there_is() {
    let sheets: String =
        (0..4).map(|i| format!("SHEET, {}, 0., 0., {:?}, 0.1, 0.1, 0., 5, 5\n", i + 1, T * f64::from(i))).collect();
    let sets = format!("NODE SET PLANE, 1, Z, 0.\nNODE SET PLANE, 2, Z, {:?}\n", 3.0 * T);
    let mesh = recipe(&format!("TITLE\n sheets\n{sheets}{sets}"));
    let end = 8e-5;
    let speed = 0.75 * T / end;
    let law = "ELASTIC, 8000.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";
    let laws: String = (1..=4).map(|b| format!("SHELL THICKNESS, {b}, {T}\nMATERIAL, {b}, {law}")).collect();
    let deck = format!(
        "TITLE\n sheets\nTERMINATION TIME, {end}\nPLOT TIME, {:?}\nPLOT NODAL, DISPLACEMENT\nCONTACT MATERIAL\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\n\
         PRESCRIBED VELOCITY, Z, 1, 1, {speed:?}\nPRESCRIBED VELOCITY, Z, 2, 1, {:?}\n{laws}EXIT\n",
        end / 20.0,
        -speed
    );
    let run = run_on(1, &deck, &mesh);
    let surfaces = Surfaces::new(&mesh);
    let mut least = f64::INFINITY;
    for state in &run.states {
        assert_eq!(surfaces.pierced(&state.positions(&mesh)), [], "time {}", state.time);
        let part = 1.0 - 0.5 * state.time / end;
        least = distances(state, &mesh).into_iter().fold(least, |least, distance| least.min(distance / part));
    }
    let [low, middle, high] = distances(run.end(), &mesh);
    println!("distances at the end over the thickness: {low:.3}, {middle:.3}, {high:.3}");
    between("sheets without room", "least distance over an equal part", least, 0.5, 1.0);
    between("sheets without room", "work of contact", run.last().totals.contact, f64::NEG_INFINITY, 0.0);
    let three = run_on(3, &deck, &mesh).whole();
    let one = run.whole();
    for name in ["DISPLX", "DISPLY", "DISPLZ"] {
        assert!(one.end().nodal(name) == three.end().nodal(name), "{name} has not the same bits on three ranks");
    }
}
