//! Bodies that pass each other by a hair, and flat ones that meet ridges and tips at their nodes.

use super::passing::{ROUND_OFF, Scene};
use crate::support::meshes::recipe;
use crate::support::run::{State, run};

/// A hexahedron by its corners, those of the lower side first.
fn hexahedron(block: u32, corners: [[f64; 3]; 8]) -> String {
    let lines: String = corners.map(|[x, y, z]| format!("{x:?}, {y:?}, {z:?}\n")).concat();
    format!("HEXAHEDRON, {block}, 1, 1, 1\n{lines}END\n")
}

/// A bar along x whose section is a quadrilateral, [y, z] counter-clockwise seen against x, with an end that leans by so much from corner to corner.
fn bar(block: u32, section: [[f64; 2]; 4], [from, to]: [f64; 2], lean: [f64; 4]) -> String {
    let at = |x: f64, lean: [f64; 4]| [0, 1, 2, 3].map(|i| [x + lean[i], section[i][0], section[i][1]]);
    let [[a, b, c, d], [e, f, g, h]] = [at(from, [0.0; 4]), at(to, lean)];
    hexahedron(block, [a, b, c, d, e, f, g, h])
}

/// A trough or a keel of two bars that meet in an edge along x, at a height; its flanks rise by so much over a width of 0.3 to both sides.
fn keel(block: u32, height: f64, rises: [f64; 2], ends: [f64; 2], lean: f64) -> String {
    let [right, left] = rises;
    let flank = |side: f64, rise: f64| {
        let (y, z) = (side * 0.3, height + rise);
        [[0.0, height], [y, z], [y, z + 0.2], [0.0, height + 0.2]]
    };
    let [a, b, c, d] = flank(-1.0, left);
    bar(block, flank(1.0, right), ends, [0.0, lean, lean, 0.0])
        + &bar(block, [a, d, c, b], ends, [0.0, 0.0, lean, lean])
        + &format!("MERGE, {block}\n")
}

/// Two bricks of which one flies by a tenth of a millimetre beside the other, its end slanted by a lean: edges that had gone past each other beside the box were taken
/// to have met along the normal of the slanted end, with 31 % of the energy.
#[test]
fn a_slanted_end_passes_beside_a_box() {
    for lean in [0.05, 0.3, 0.5, 1.0, -0.3] {
        let (near, far) = (0.0999, -0.0999);
        let section = [[far, 0.0], [near, 0.0], [near, near], [far, near]];
        let slanted = bar(1, section, [-0.25, -0.05], [lean * far, lean * near, lean * near, lean * far]);
        let scene = Scene {
            name: "a slanted end beside a box",
            recipe: &format!("{slanted}BOX, 2, 0., .1, -.1, .2, .2, .3, 1, 1, 1\nTRANSLATE, 1, -.05, 0., 0.\n"),
            blocks: 2,
            lines: "INITIAL VELOCITY MATERIAL, 1, 20., 0., 0.",
            duration: 1.5e-2,
        };
        scene.keeps_its_energy(ROUND_OFF);
    }
}

/// A keel passes a millimetre over the corner of a box, and troughs with arrow-shaped ends over each other. The corner was taken to come flush with the end of the keel
/// (12 % of the energy), and the ends of the troughs to have met (15 %).
#[test]
fn a_keel_passes_over_a_corner() {
    let slope = |degrees: f64| 0.3 * degrees.to_radians().tan();
    let over_corner = keel(1, 1e-3, [slope(45.0), slope(70.0)], [-0.5, -0.05], 0.0);
    let upper = keel(1, 1e-3, [slope(60.0); 2], [-0.5, -0.05], -0.1);
    let lower = keel(2, -0.2, [slope(60.0); 2], [0.0, 0.5], 0.0);
    for recipe in [format!("{over_corner}BOX, 2, 0., 0., -.2, .4, .4, .2, 1, 1, 1\n"), upper + &lower] {
        let scene = Scene {
            name: "a keel over a corner",
            recipe: &recipe,
            blocks: 2,
            lines: "INITIAL VELOCITY MATERIAL, 1, 20., 0., 0.",
            duration: 1.25e-2,
        };
        scene.keeps_its_energy(ROUND_OFF);
    }
}

/// Ridges come down on nodes of a flat plate, at its rim or in its middle. Such a node was pushed along the normal of one of the flanks, and the plate went aside by up to 1.2 of its
/// velocity downwards; the normal of the plate's own surface pushes both.
#[test]
fn a_ridge_pushes_the_node_of_a_plate_along_the_normal_of_the_plate() {
    let slope = |degrees: f64| 0.3 * degrees.to_radians().tan();
    for (degrees, height, beyond, layers) in [
        (60.1, 5e-4, 0.0, 1),
        (75.0, 5e-4, 0.0, 1),
        (30.0, 0.0, 0.0, 1),
        (45.0, 5e-4, 0.01, 2),
        (70.0, 0.0, 0.01, 2),
        (62.0, 1e-5, 0.0, 2),
        (80.0, 5e-4, 0.0, 2),
    ] {
        let ridge = keel(1, height, [slope(degrees); 2], [0.0, 0.2], 0.0);
        let plate = format!("BOX, 2, {:?}, -.5, -.1, {:?}, 1., .1, {layers}, 2, 1\n", -beyond, 0.2 + 2.0 * beyond);
        let scene = Scene {
            name: "a ridge on a node of a plate",
            recipe: &format!("{ridge}{plate}"),
            blocks: 2,
            lines: "PLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nINITIAL VELOCITY MATERIAL, 1, 0., -6., -7.",
            duration: 3e-4,
        };
        let [x, y, z] = scene.velocity_of_second();
        println!("ridge of {degrees} degrees: {:.1e} of its velocity to the side", y / z);
        // The plate bends while it is pushed, as in `a_ridge_with_flush_ends_pushes_a_plate_along_its_normal`.
        assert!(z < -1.0 && (y / z).abs() < 5e-3 && (x / z).abs() < 5e-3, "{degrees}: {x}, {y}, {z}");
    }
}

/// A ridge comes down on a rim from 5 mm in 2 mm, or passes over it by 1.5 mm: there is nothing to push yet. Along the normal of a flank the face below the rim goes on
/// upwards, and a force took 2 % of the energy of what never touched.
#[test]
fn a_ridge_over_a_rim_is_not_met_before_it_touches() {
    let slopes = [0.3 * 60_f64.to_radians().tan(); 2];
    let falls = keel(1, 5e-3, slopes, [0.0, 0.2], 0.0) + "BOX, 2, -.1, 0., -.2, .4, 1., .2, 1, 1, 1\n";
    let flies = keel(1, 3e-3, slopes, [-0.15, 0.15], 0.0)
        + "TRANSLATE, 1, 0., -.002, 0.\nBOX, 2, -.4, 0., -.2, 1., 1., .2, 2, 2, 1\n";
    for (recipe, velocity, duration) in [(falls, "0., 0., -10.", 2e-4), (flies, "0., 10., -5.", 3e-4)] {
        let scene = Scene {
            name: "a ridge over a rim",
            recipe: &recipe,
            blocks: 2,
            lines: &format!("INITIAL VELOCITY MATERIAL, 1, {velocity}"),
            duration,
        };
        scene.keeps_its_energy(ROUND_OFF);
    }
}

/// What lies askew on rims where their nodes are, of which no node is in the other: with a partition that leaves the nodes of the rims out it went through without any force.
#[test]
fn a_bend_that_crosses_rims_at_their_nodes_does_not_go_through() {
    let bent = bar(1, [[0.05, 0.0], [0.25, 0.05], [0.25, 0.2], [0.05, 0.2]], [-0.3, 0.3], [0.0; 4]);
    let body = format!("BOX, 1, -.3, -.25, 0., .6, .3, .2, 1, 1, 1\n{bent}MERGE, 1\nTRANSLATE, 1, 0., 0., 1.E-4\n");
    let scene = Scene {
        name: "a bend on rims",
        recipe: &format!("{body}BOX, 2, -.15, -.2, -.2, .3, .5, .2, 1, 2, 1\n"),
        blocks: 2,
        lines: "CONTACT DATA, 1, 2, 0., 0.\nPLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nINITIAL VELOCITY MATERIAL, 1, 0., 0., -10.",
        duration: 2e-3,
    };
    let [_, _, z] = scene.velocity_of_second();
    // Two free bodies of 447 and 236 kg: in a plastic impact both would go down at 6.5 m/s, in an elastic one this by twice as much.
    assert!(z < -4.0, "{z}");
}

/// A ridge of 60 degrees is pressed on a soft plate and slides along it; as the whole, and as one half with NO DISPLACEMENT in the plane of symmetry. There its flank looks at
/// the side of the plate, which lies in that plane, and its nodes were taken for tips that slide over that side: they sank in by half as much again.
#[test]
fn a_ridge_in_a_plane_of_symmetry_sinks_in_as_the_whole_one() {
    let rise = 0.1 * 60_f64.to_radians().tan();
    let flank = |ends: [f64; 2]| {
        let [from, to] = ends;
        let corners = |z: [f64; 2]| [[0.0, from, z[0]], [0.1, from, z[0]], [0.1, to, z[1]], [0.0, to, z[1]]];
        let low = if from < 0.0 { [1e-3 + rise, 1e-3] } else { [1e-3, 1e-3 + rise] };
        let [[a, b, c, d], [e, f, g, h]] = [corners(low), corners([0.2 + rise; 2])];
        hexahedron(1, [a, b, c, d, e, f, g, h]).replace("1, 1, 1, 1", "1, 1, 1, 2")
    };
    let lowest = |whole: bool| {
        let (others, plate, held) = match whole {
            true => (flank([-0.1, 0.0]) + "MERGE, 1\n", "BOX, 2, -.05, -.3, -.1, .6, .6, .1, 6, 6, 1\n", ""),
            false => (String::new(), "BOX, 2, -.05, 0., -.1, .6, .3, .1, 6, 3, 1\n", "NO DISPLACEMENT, Y, 1\n"),
        };
        let sets = "NODE SET PLANE, 1, Y, 0.\nNODE SET PLANE, 2, Z, -.1\n";
        let mesh = recipe(&format!("TITLE\n ridge\n{}{others}{plate}{sets}", flank([0.0, 0.1])));
        let law = |block: u32| {
            format!("MATERIAL, {block}, ELASTIC, 7850.\nYOUNGS MODULUS = 2.E9\nPOISSONS RATIO = 0.3\nEND\n")
        };
        let deck = format!(
            "TITLE\n ridge\nTERMINATION TIME, 3.E-3\nPLOT TIME, 1.E-4\nPLOT NODAL, DISPLACEMENT\nCONTACT MATERIAL\n\
             NO DISPLACEMENT, Z, 2\nNO DISPLACEMENT, X, 2\nINITIAL VELOCITY MATERIAL, 1, 40., 0., -3.\nGRAVITY, 0., 0., -3000.\n{held}{}{}",
            law(1),
            law(2)
        );
        let run = run(&deck, &mesh).whole();
        let ridge: Vec<usize> = (0..mesh.coordinates.len())
            .filter(|&node| mesh.coordinates[node][1] == 0.0 && (mesh.coordinates[node][2] - 1e-3).abs() < 1e-9)
            .collect();
        let of_state = |state: &State| {
            let places = state.positions(&mesh);
            ridge.iter().fold(f64::INFINITY, |least, &node| least.min(places[node][2]))
        };
        run.states.iter().map(of_state).fold(f64::INFINITY, f64::min)
    };
    let [half, whole] = [false, true].map(lowest);
    println!("lowest place of the ridge: {half:.5} as a half, {whole:.5} as a whole");
    // Of the half, feet are at the border of faces that lean to the plane, by which it is stiffer by a hundredth.
    assert!(whole < -1e-3 && (half / whole - 1.0).abs() < 0.03, "{half}, {whole}");
}
