//! What the plot file says of elements: how they have turned.

use crate::support::meshes::recipe;
use crate::support::run::{State, run};
use crate::support::between;

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
