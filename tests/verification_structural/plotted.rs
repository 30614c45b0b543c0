//! What the plot file says of elements: how they have turned, transverse shear of shells, the stress of beams.

use crate::support::meshes::recipe;
use crate::support::run::{Run, State, run};
use crate::support::{between, close};

const NAMES: [[&str; 3]; 3] = [["R11", "R12", "R13"], ["R21", "R22", "R23"], ["R31", "R32", "R33"]];

/// The rotation of an element.
fn rotation(state: &State, element: usize) -> [[f64; 3]; 3] {
    NAMES.map(|row| row.map(|name| state.element(name)[element]))
}

/// Largest difference of two matrices.
fn apart(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

/// The rotation by an angle about an axis of unit length.
fn about([x, y, z]: [f64; 3], angle: f64) -> [[f64; 3]; 3] {
    let (s, c) = (angle.sin(), angle.cos());
    let t = 1.0 - c;
    [
        [c + t * x * x, t * x * y - s * z, t * x * z + s * y],
        [t * x * y + s * z, c + t * y * y, t * y * z - s * x],
        [t * x * z - s * y, t * y * z + s * x, c + t * z * z],
    ]
}

/// A body that lies askew and turns by half a radian about the axis that was its z: R is the identity at the start and that rotation at the end, whichever
/// way the elements lie in the mesh. A step of a thousandth of a radian and the stretch of the spin are a ten-thousandth.
#[test]
fn rotations_are_those_since_the_start() {
    let [tilt, lean, turn] = [30f64, 50.0, 110.0].map(f64::to_radians);
    let side = tilt.cos() * lean.sin();
    let axis = [
        side * turn.cos() + tilt.sin() * turn.sin(),
        side * turn.sin() - tilt.sin() * turn.cos(),
        tilt.cos() * lean.cos(),
    ];
    let [x, y, z] = axis;
    let askew = "ROTATE, 1, X, 30.\nROTATE, 1, Y, 50.\nROTATE, 1, Z, 110.\n";
    let sheet = "SHEET, 1, -0.5, -0.5, 0., 1., 1., 0., 2, 2\n";
    let hexahedra = "BOX, 1, -0.5, -0.5, -0.5, 1., 1., 1., 2, 2, 2\n";
    for (case, body, lines) in [
        ("hexahedra", hexahedra, ""),
        ("eight points", hexahedra, "ELEMENT, 1, EIGHT POINTS\n"),
        ("shells", sheet, "SHELL THICKNESS, 1, 0.1\n"),
        ("triangles", &format!("{sheet}TRIANGLES, 1\n"), "SHELL THICKNESS, 1, 0.1\n"),
        ("beams", "LINE, 1, -0.5, 0., 0., 0.5, 0., 0., 2\n", "BEAM SECTION, 1, RECTANGLE, 0.1, 0.2\n"),
    ] {
        let deck = format!(
            "TERMINATION TIME, 0.5\nTIME STEP MAXIMUM, 1.E-3\nPLOT TIME, 0.1\nPLOT ELEMENT, ROTATION\n{lines}\
             INITIAL VELOCITY ANGULAR, 1, 1., 0., 0., 0., {x:?}, {y:?}, {z:?}\nMATERIAL, 1, ELASTIC, 1.E-2\nYOUNGS MODULUS = 1.E3\n\
             POISSONS RATIO = 0.\nEND\n"
        );
        let turned = run(&deck, &recipe(&format!("{body}{askew}")));
        let (first, last) = (&turned.states[0], turned.end());
        for element in 0..first.element("R11").len() {
            let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            between(case, "R at the start from 1", apart(rotation(first, element), identity), 0.0, 1e-12);
            let turned = about(axis, last.time);
            between(case, "R at the end from the rotation", apart(rotation(last, element), turned), 0.0, 1e-3);
        }
    }
}

/// A load that rises slowly to 1.
const RAMP: &str = "FUNCTION, 1\n0., 0.\n0.02, 0.1\n0.04, 0.35\n0.06, 0.65\n0.08, 0.9\n0.1, 1.\nEND\n";

/// Mean of an element variable over the states after a time.
fn mean(run: &Run, name: &str, element: usize, after: f64) -> f64 {
    let values: Vec<f64> =
        run.states.iter().filter(|state| state.time > after).map(|s| s.element(name)[element]).collect();
    values.iter().sum::<f64>() / values.len() as f64
}

/// A cantilevered strip, 0.1 wide and 0.02 thick, with a force of 100 at its end: the mean shear stress over the thickness is
/// 100/(0.1 · 0.02) = 5e4, and in the middle plane, where nothing else is, √3 of it is the equivalent stress.
#[test]
fn shear_stress_of_shells_is_the_shear_force_over_the_thickness() {
    for (case, kind) in [("quadrilaterals", ""), ("triangles", "TRIANGLES, 1, CROSS\n")] {
        let mesh = recipe(&format!(
            "SHEET, 1, 0., 0., 0., 0.2, 0.1, 0., 6, 3\n{kind}NODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 0.2\n"
        ));
        let ends = mesh.node_set(2).map_or(0, |set| set.nodes.len());
        let held: String = ["X", "Y", "Z"].map(|c| format!("NO DISPLACEMENT, {c}, 1\nNO ROTATION, {c}, 1\n")).concat();
        let deck = format!(
            "TERMINATION TIME, 0.12\nPLOT TIME, 1.E-4\nPLOT ELEMENT, STRESS, VONMISES, RESULTANTS, THICKNESS\n{RAMP}{held}\
             SHELL THICKNESS, 1, 0.02\nPRESCRIBED FORCE, Z, 2, 1, {}\nMATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 70.E9\n\
             POISSONS RATIO = 0.\nEND\n",
            100.0 / ends as f64
        );
        let bent = run(&deck, &mesh);
        let end = bent.end();
        for element in 0..mesh.element_count() {
            let [zx, yz, t, qx, qy] =
                ["TAUZX", "TAUYZ", "THICKNESS", "QX", "QY"].map(|name| end.element(name)[element]);
            close(case, "shear force over thickness", zx.hypot(yz), qx.hypot(qy) / t, 1e-6);
        }
        let middle: Vec<usize> = (0..mesh.element_count()).filter(|&e| is_in_the_middle(&mesh, e)).collect();
        let over = |name: &str| middle.iter().map(|&e| mean(&bent, name, e, 0.1)).sum::<f64>() / middle.len() as f64;
        close(case, "mean shear stress", over("TAUZX"), 5e4, 0.01);
        close(case, "shear stress in the middle plane", over("TAUZX_M"), 5e4, 0.01);
        if kind.is_empty() {
            close(case, "equivalent stress in the middle plane", over("VONMISES_M"), 3f64.sqrt() * 5e4, 0.02);
        }
    }
}

/// Whether an element lies in the middle third of the strip.
fn is_in_the_middle(mesh: &urto::mesh::Mesh, element: usize) -> bool {
    let nodes = mesh.elements().nth(element).map(|(_, nodes)| nodes).expect("an element");
    nodes.iter().all(|&node| (0.06..0.14).contains(&mesh.coordinates[node as usize][0]))
}

/// A beam bent by a moment M: the outermost fibre of a rectangle stands at ½ (½ + ½/√3) of the height b from its middle, and has
/// M z/I; the mean stress is nothing.
#[test]
fn equivalent_stress_of_beams_is_that_of_their_worst_fibre() {
    let mesh = recipe("LINE, 1, 0., 0., 0., 0.2, 0., 0., 4\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 0.2\n");
    let held: String = ["X", "Y", "Z"].map(|c| format!("NO DISPLACEMENT, {c}, 1\nNO ROTATION, {c}, 1\n")).concat();
    let deck = format!(
        "TERMINATION TIME, 0.12\nPLOT TIME, 1.E-4\nPLOT ELEMENT, STRESS, VONMISES, RESULTANTS\n{RAMP}{held}\
         BEAM SECTION, 1, RECTANGLE, 0.01, 0.02, , , 0., 1., 0.\nPRESCRIBED MOMENT, Y, 2, 1, 50.\nMATERIAL, 1, ELASTIC, 7850.\n\
         YOUNGS MODULUS = 210.E9\nPOISSONS RATIO = 0.3\nEND\n"
    );
    let bent = run(&deck, &mesh);
    let place = 0.25 * (1.0 + 1.0 / 3f64.sqrt()) * 0.02;
    let expected = 50.0 * place / (0.01 * 0.02f64.powi(3) / 12.0);
    for element in 0..4 {
        close("beam", "moment about y", mean(&bent, "MXX", element, 0.1), 50.0, 0.005);
        close("beam", "largest stress of a fibre", mean(&bent, "VONMISES", element, 0.1), expected, 0.005);
        between("beam", "mean stress", mean(&bent, "SIGXX", element, 0.1).abs(), 0.0, 1e-3 * expected);
    }
}
