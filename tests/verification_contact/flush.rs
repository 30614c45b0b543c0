//! What begins flush on a surface, or nearer to it than thicknesses allow, is held by what is below it and by nothing beside that: without
//! friction it goes on along the surface, at whatever angle the model stands.

use crate::support::close;
use crate::support::meshes::recipe;
use crate::support::run::run;
use urto::mesh::Mesh;

/// Angles of the model about x and y, degrees.
const TURNED: [f64; 2] = [37.0, 51.0];

type Vector = [f64; 3];

/// A vector of the upright model in the turned one.
fn turned(v: Vector, [a, b]: [f64; 2]) -> Vector {
    let ([sin_a, cos_a], [sin_b, cos_b]) = (sine_and_cosine(a), sine_and_cosine(b));
    let [x, y, z] = [v[0], cos_a * v[1] - sin_a * v[2], sin_a * v[1] + cos_a * v[2]];
    [cos_b * x + sin_b * z, y, cos_b * z - sin_b * x]
}

/// A vector of the turned model in the upright one.
fn turned_back(v: Vector, [a, b]: [f64; 2]) -> Vector {
    let ([sin_a, cos_a], [sin_b, cos_b]) = (sine_and_cosine(a), sine_and_cosine(b));
    let [x, y, z] = [cos_b * v[0] - sin_b * v[2], v[1], sin_b * v[0] + cos_b * v[2]];
    [x, cos_a * y + sin_a * z, cos_a * z - sin_a * y]
}

fn sine_and_cosine(degrees: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [sin, cos]
}

/// Mean velocity of the nodes of block 2 after some time, as the upright model sees it, of parts that begin at a velocity on a plate whose
/// bottom is held.
fn velocity_after(time: f64, parts: &str, (angles, velocity): ([f64; 2], Vector), more: &str) -> Vector {
    let mesh = plate_and(parts, angles);
    let [x, y, z] = turned(velocity, angles);
    let law = "ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nEND";
    let deck = format!(
        "TITLE\n flush\nTERMINATION TIME, {time}\nPLOT TIME, {time}\nPLOT NODAL, VELOCITY\nCONTACT MATERIAL\nNO DISPLACEMENT, X, 1\n\
         NO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nINITIAL VELOCITY MATERIAL, 2, {x:?}, {y:?}, {z:?}\nMATERIAL, 1, {law}\n\
         MATERIAL, 2, {law}\n{more}"
    );
    let run = run(&deck, &mesh);
    let nodes = &mesh.node_set(2).expect("the nodes of block 2").nodes;
    let mean = |name: &str| {
        let all = run.end().nodal(name);
        nodes.iter().map(|&node| all[node as usize]).sum::<f64>() / nodes.len() as f64
    };
    turned_back([mean("VELX"), mean("VELY"), mean("VELZ")], angles)
}

/// A plate of 1 × 1 × 0.2 and parts of block 2 on it, turned.
fn plate_and(parts: &str, [a, b]: [f64; 2]) -> Mesh {
    let turn = |block: u32| format!("ROTATE, {block}, X, {a}\nROTATE, {block}, Y, {b}\n");
    recipe(&format!(
        "TITLE\n plate\nBOX, 1, 0., 0., 0., 1., 1., 0.2, 13, 11, 2\n{parts}NODE SET FACE, 1, 1, BOTTOM\nNODE SET BLOCK, 2, 2\n{}{}",
        turn(1),
        turn(2)
    ))
}

/// A block that lies on the plate strikes it and rises; along the plate it goes on. Its side walls, below whose lower border nodes of the
/// plate lie as round-off wants, took hold of these: (7, 13) became (1.6, -2.3), at a gap of 1e-6 not.
#[test]
fn side_walls_take_hold_of_nothing_below_a_flush_block() {
    let block = "BOX, 2, 0.1, 0.15, 0.2, 0.7, 0.6, 0.5, 4, 3, 3\n";
    let after = |angles: [f64; 2]| velocity_after(5e-4, block, (angles, [7.0, 13.0, -20.0]), "");
    let upright = after([0.0; 2]);
    // What vibrates is left of Poisson's ratio.
    close("upright", "along x over that before", upright[0], 7.0, 0.02);
    close("upright", "along y over that before", upright[1], 13.0, 0.02);
    for angles in [TURNED, [-23.0, 61.0]] {
        let found = after(angles);
        // Whether a node on the border of a face is on it, too, is up to round-off.
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            close("turned", &format!("along {name} over that upright"), found[axis], upright[axis], 1e-3);
        }
    }
}

/// A sheet that begins with an eighth of the room that it needs stays as near; a part of its nodes was held by borders of faces beside those
/// which they were over, and (3, 8) became (1.7, 5.7).
#[test]
fn a_sheet_without_room_slides_on() {
    let sheet = "SHEET, 2, 0.3, 0.15, 0.20025, 0.4, 0.5, 0., 20, 20\n";
    for angles in [[0.0; 2], TURNED] {
        let [x, y, z] = turned([0.0, 0.0, -1000.0], angles);
        let more = format!("SHELL THICKNESS, 2, 0.004\nGRAVITY, {x:?}, {y:?}, {z:?}\n");
        let [x, y, z] = velocity_after(1e-3, sheet, (angles, [3.0, 8.0, 0.0]), &more);
        close("sheet", "along x", x, 3.0, 1e-4);
        close("sheet", "along y", y, 8.0, 1e-4);
        assert!(z.abs() < 0.02, "{z}");
    }
}
