//! Shells: plates, spheres and strips with known answers; the same bits wherever they are computed; what DEATH takes of them.

use crate::support::continued::Case;
use crate::support::meshes::recipe;
use crate::support::run::{Run, run, run_on};
use crate::support::{between, close};
use urto::mesh::{Mesh, SideSet};

fn text(path: &str) -> String {
    std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a file")
}

/// Side set 1: the tops of all shells, side set 2: their bottoms.
fn with_sides(mut mesh: Mesh) -> Mesh {
    let count = mesh.element_count() as u32;
    for side in 0..2u8 {
        let sides = (0..count).map(|element| (element, side)).collect();
        mesh.side_sets.push(SideSet { id: i64::from(side) + 1, name: String::new(), sides });
    }
    mesh
}

/// First peak of a nodal variable over time, with its time, by a parabola through the three states about it.
fn peak(run: &Run, name: &str, node: usize) -> (f64, f64) {
    let values: Vec<(f64, f64)> = run.states.iter().map(|state| (state.time, state.nodal(name)[node])).collect();
    let i = (1..values.len() - 1)
        .find(|&i| values[i].1 > values[i - 1].1 && values[i].1 >= values[i + 1].1)
        .expect("a peak between the states");
    let [(t0, a), (t1, b), (_, c)] = [values[i - 1], values[i], values[i + 1]];
    let (rise, bend) = (0.5 * (c - a), a - 2.0 * b + c);
    (b - 0.5 * rise * rise / bend, t1 - (t1 - t0) * rise / bend)
}

fn node_at(mesh: &Mesh, at: [f64; 3]) -> usize {
    let near = |x: &[f64; 3]| (0..3).all(|i| (x[i] - at[i]).abs() < 1e-9);
    mesh.coordinates.iter().position(near).expect("a node there")
}

/// A quarter of the plate of V-16: n × n shells of 5 in.
fn plate(n: usize, clamped: bool, law: &str) -> (String, Mesh) {
    plate_of(n, clamped, law, "")
}

/// The same with more lines of its recipe.
fn plate_of(n: usize, clamped: bool, law: &str, more: &str) -> (String, Mesh) {
    let mesh = with_sides(recipe(&format!(
        "TITLE\n plate\nSHEET, 1, 0., 0., 0., 5., 5., 0., {n}, {n}\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, Y, 0.\n\
         NODE SET PLANE, 3, X, 5.\nNODE SET PLANE, 4, Y, 5.\n{more}"
    )));
    let mut deck = format!(
        "TITLE\n plate\nTERMINATION TIME, 1.2E-3\nPLOT TIME, 1.E-5\nOUTPUT TIME, 1.E-5\nPLOT NODAL, DISPLACEMENT\n\
         PLOT ELEMENT, STRESS\nBULK VISCOSITY, 0., 0.\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESSURE, 2, 1, 300.\nSHELL THICKNESS, 1, 0.5\n\
         NO DISPLACEMENT, X, 1\nNO ROTATION, Y, 1\nNO ROTATION, Z, 1\nNO DISPLACEMENT, Y, 2\nNO ROTATION, X, 2\nNO ROTATION, Z, 2\n\
         NO DISPLACEMENT, Z, 3\nNO DISPLACEMENT, Z, 4\nNO ROTATION, X, 3\nNO ROTATION, Y, 4\n\
         MATERIAL, 1, {law}\nEND\n"
    );
    if clamped {
        deck += "NO ROTATION, Y, 3\nNO ROTATION, X, 4\n";
    }
    (deck, mesh)
}

const ELASTIC: &str = "ELASTIC, 2.588E-4\nYOUNGS MODULUS = 1.E7\nPOISSONS RATIO = 0.3";

/// V-16: a square plate, simply supported, under a pressure that begins at once. Mindlin's plate swings to 0.2163 in at 0.514 ms.
#[test]
fn v16_simply_supported_plate() {
    let (deck, mesh) = plate(8, false, ELASTIC);
    let swing = run(&deck, &mesh);
    let (most, time) = peak(&swing, "DISPLZ", node_at(&mesh, [0.0; 3]));
    close("V-16", "first peak of the deflection [in]", most, 0.2163, 0.03);
    close("V-16", "its time [s]", time, 0.514e-3, 0.03);
    between("V-16", "worst energy balance", swing.worst_balance(), 0.0, 2e-3);
}

/// S4: the same plate, clamped: 0.0718 in at 0.321 ms.
#[test]
fn s4_clamped_plate() {
    let (deck, mesh) = plate(8, true, ELASTIC);
    let (most, time) = peak(&run(&deck, &mesh), "DISPLZ", node_at(&mesh, [0.0; 3]));
    close("S4", "first peak of the deflection [in]", most, 0.0718, 0.03);
    close("S4", "its time [s]", time, 0.321e-3, 0.04);
}

/// V-16 and S4 of triangles, each two for a shell of those: stiffer while the mesh is coarse.
#[test]
fn plates_of_triangles_swing() {
    for (name, clamped, most, time) in [("V-16", false, 0.2163, 0.514e-3), ("S4", true, 0.0718, 0.321e-3)] {
        for (n, tolerance) in [(8, 0.05), (16, 0.03)] {
            let (deck, mesh) = plate_of(n, clamped, ELASTIC, "TRIANGLES, 1\n");
            let swing = run(&deck, &mesh);
            let found = peak(&swing, "DISPLZ", node_at(&mesh, [0.0; 3]));
            println!("{name}, {n}: {:.4} of the peak, {:.4} of its time", found.0 / most, found.1 / time);
            close(name, "first peak of the deflection [in]", found.0, most, tolerance);
            close(name, "its time [s]", found.1, time, tolerance);
            between(name, "worst energy balance", swing.worst_balance(), 0.0, 2e-3);
        }
    }
}

/// V-17: a sphere under a pressure from inside that begins at once breathes between 0 and 35 µm with a period of 73.64 µs.
#[test]
fn v17_breathing_sphere() {
    let mesh = with_sides(recipe(
        "TITLE\n sphere\nSHEET SPHERE, 1, 0.1, 6, OCTANT\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, Y, 0.\nNODE SET PLANE, 3, Z, 0.\n",
    ));
    let deck = "TITLE\n sphere\nTERMINATION TIME, 9.E-5\nPLOT TIME, 1.E-6\nPLOT NODAL, DISPLACEMENT\nBULK VISCOSITY, 0., 0.\n\
                FUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESSURE, 2, 1, 1.E6\nSHELL THICKNESS, 1, 1.E-3\n\
                NO DISPLACEMENT, X, 1\nNO ROTATION, Y, 1\nNO ROTATION, Z, 1\nNO DISPLACEMENT, Y, 2\nNO ROTATION, Z, 2\nNO ROTATION, X, 2\n\
                NO DISPLACEMENT, Z, 3\nNO ROTATION, X, 3\nNO ROTATION, Y, 3\n\
                MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";
    let swing = run(deck, &mesh);
    // Mean radial motion of all nodes, as single ones swing a little beside it.
    let radial = |state: &crate::support::run::State| {
        let x = state.positions(&mesh);
        let radius = |x: &[f64; 3]| (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt();
        x.iter().map(|x| radius(x) - 0.1).sum::<f64>() / x.len() as f64
    };
    let values: Vec<(f64, f64)> = swing.states.iter().map(|state| (state.time, radial(state))).collect();
    let top = values.iter().fold((0.0, 0.0), |top: (f64, f64), value| if value.1 > top.1 { *value } else { top });
    close("V-17", "largest radial motion [m]", top.1, 35.0e-6, 0.02);
    close("V-17", "half a period [s]", top.0, 0.5 * 73.64e-6, 0.03);
}

/// S1: the deck's strip that is bent by a moment becomes half a circle; all three keep their energy balance.
#[test]
fn s1_strips_are_bent() {
    let mesh = recipe(&text("meshes/shell_strips.mesh"));
    let bent = run(&text("decks/shell_strips.i"), &mesh);
    between("S1", "worst energy balance", bent.worst_balance(), 0.0, 1e-2);
    let end = bent.end().positions(&mesh);
    let tip = node_at(&mesh, [1.0, 0.0, 0.0]);
    // Half a circle of length 1: its end is 2/π above its beginning. The strip still swings a little.
    close("S1", "height of the end over the beginning", end[tip][2], 2.0 / std::f64::consts::PI, 0.02);
    between("S1", "end beside the beginning", end[tip][0], -0.05, 0.05);
    let given = node_at(&mesh, [1.0, 0.2, 0.0]);
    close("S1", "given rotation", bent.end().nodal("ROTY")[given], -1.5, 1e-3);
    let rate = node_at(&mesh, [1.0, 0.4, 0.0]);
    close("S1", "integral of the given rate", bent.end().nodal("ROTY")[rate], -1.5, 2e-3);
}

/// S1, triangles: the middle of the deck's plate comes down by what all terms of Navier's series swing together, at half a
/// period of the first.
#[test]
fn s1_plate_of_triangles_swings() {
    let mesh = recipe(&text("meshes/plate_triangles.mesh"));
    let deck = text("decks/plate_triangles.i").replace("PLOT TIME, 0.5E-3", "PLOT TIME, 2.E-5");
    let swing = run(&deck, &mesh);
    let middle = node_at(&mesh, [0.5, 0.5, 0.0]);
    let values: Vec<(f64, f64)> = swing.states.iter().map(|s| (s.time, -s.nodal("DISPLZ")[middle])).collect();
    let top = values.iter().fold((0.0, 0.0), |top: (f64, f64), value| if value.1 > top.1 { *value } else { top });
    // Series of 30 x 30 terms; 24 triangles along a side and the shear of the plate make a per cent or two.
    close("S1", "farthest of the middle of the plate of triangles [m]", top.1, 1.0562e-4, 0.02);
    close("S1", "time of it [s]", top.0, 5.08e-3, 0.02);
    between("S1", "worst energy balance", swing.worst_balance(), 0.0, 1e-2);
}

/// A clamped plate that flows, bursts and loses points and shells.
fn bursting_plate(more: &str) -> (String, Mesh) {
    let law = "PIECEWISE PLASTIC, 2.588E-4\nYOUNGS MODULUS = 1.E7\nPOISSONS RATIO = 0.3\nHARDENING FUNCTION = 2";
    let (deck, mesh) = plate_of(6, true, law, more);
    let deck = deck.replace("PRESSURE, 2, 1, 300.", "PRESSURE, 2, 1, 3000.").replace("1.2E-3", "4.E-4");
    let more = "FUNCTION, 2\n0., 30.E3\n0.1, 40.E3\nEND\nPLOT STATE, EQPS\nDEATH, 1, EQPS, MAX, 0.02, FREE, 0.6\n";
    (deck + more, mesh)
}

/// One rank, three ranks.
#[test]
fn shells_have_the_same_bits_on_any_ranks() {
    for (more, count) in [("", 36.0), ("TRIANGLES, 1\n", 72.0)] {
        same_bits(&bursting_plate(more), count);
    }
}

fn same_bits((deck, mesh): &(String, Mesh), count: f64) {
    let runs = [1, 3].map(|ranks| run_on(ranks, deck, mesh).whole());
    let [one, three] = &runs;
    let most = one.states.iter().flat_map(|state| state.element("EQPS_T")).fold(0.0f64, |most, eqps| eqps.max(most));
    between("shells", "largest plastic strain at the top", most, 0.005, 0.1);
    let left: f64 = one.end().element("STATUS").iter().sum();
    between("shells", "share that is left", left / count, 0.2, 0.99);
    between("shells", "worst energy balance", one.worst_balance(), 0.0, 2e-2);
    for (a, b) in one.states.iter().zip(&three.states) {
        for name in ["DISPLX", "DISPLY", "DISPLZ"] {
            assert!(a.nodal(name).iter().zip(b.nodal(name)).all(|(x, y)| x.to_bits() == y.to_bits()), "{name}");
        }
        for name in ["SIGXX", "SIGXX_B", "TAUXY_T", "EQPS", "EQPS_T", "EQPS_M"] {
            assert!(a.element(name).iter().zip(b.element(name)).all(|(x, y)| x.to_bits() == y.to_bits()), "{name}");
        }
    }
}

/// Continued from a state on other numbers of ranks, shells that lose points and a frame of beams with a roof go on with the same
/// bits.
#[test]
fn continued_runs_have_the_same_bits() {
    let [plate, triangles] = ["", "TRIANGLES, 1\n"].map(bursting_plate).map(|(deck, mesh)| Case::new(&deck, mesh));
    let frame = Case::new(&text("decks/frame.i"), recipe(&text("meshes/frame.mesh")));
    for case in [plate, triangles, frame] {
        let whole = case.part(1, None, 120);
        let first = case.part(2, None, 60);
        let rest = case.part(3, Some(&first.end), 60);
        assert!(whole.way[60..] == rest.way[..], "numbers on the way");
        assert!(whole.shown == rest.shown, "fields at the end");
    }
}
