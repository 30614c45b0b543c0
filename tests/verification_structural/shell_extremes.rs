//! Shells at their limits, free in space: what they may never do is gain energy or momentum.
//!
//! A plate of 3 x 3 shells whose corners get velocities of a few thousandths of the wave speed in directions without order,
//! so that every mode that a shell has takes part: membrane, bending, transverse shear, drilling and hourglass fields.

use crate::support::between;
use crate::support::meshes::recipe;
use crate::support::run::{Run, run};
use urto::mesh::{Mesh, NodeSet, Shape};

/// Young's modulus and density of steel; the speed of waves is 5,000 m/s.
const STEEL: &str = "ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3";

/// A part of the speed of waves: strains are of this size, rotations of a tenth of a turn and more.
const SPEED: f64 = 20.0;

/// What a plate is like.
struct Plate {
    /// Edges of a shell along x and y, m.
    edges: [f64; 2],
    thickness: f64,
    law: &'static str,
    /// Where a point of the flat plate lies.
    place: fn([f64; 3]) -> [f64; 3],
}

/// 1 % thick, square, flat.
const FLAT: Plate = Plate { edges: [1.0, 1.0], thickness: 0.01, law: STEEL, place: |x| x };

/// A number in −1 to 1, from a multiplicative generator (Park and Miller 1988).
fn random(seed: &mut u64) -> f64 {
    *seed = *seed * 16807 % 2_147_483_647;
    2.0 * (*seed as f64) / 2_147_483_647.0 - 1.0
}

/// Mesh and deck of a plate over so many crossings of a wave through a shell.
fn scene(plate: &Plate, crossings: f64) -> (Mesh, String) {
    let [a, b] = plate.edges;
    let mut mesh: Mesh =
        recipe(&format!("TITLE\n plate\nSHEET, 1, 0., 0., 0., {:?}, {:?}, 0., 3, 3\n", 3.0 * a, 3.0 * b));
    mesh.coordinates.iter_mut().for_each(|x| *x = (plate.place)(*x));
    let end = crossings * a.min(b) / 5000.0;
    let deck = format!(
        "TITLE\n plate\nTERMINATION TIME, {end:?}\nOUTPUT TIME, {:?}\nPLOT TIME, {end:?}\nPLOT NODAL, DISPLACEMENT\nSHELL THICKNESS, 1, {:?}\n\
         MATERIAL, 1, {}\nEND\n",
        end / 200.0,
        plate.thickness,
        plate.law
    );
    (mesh, deck)
}

/// Every quadrilateral divided in two.
fn triangles(mesh: &Mesh) -> Mesh {
    let mut mesh = mesh.clone();
    for block in &mut mesh.blocks {
        let halves = |n: &[u32]| [n[0], n[1], n[2], n[0], n[2], n[3]];
        block.nodes = block.nodes.chunks_exact(4).flat_map(halves).collect();
        block.shape = Shape::Triangle;
    }
    mesh.element_ids = (1..=mesh.element_count() as i64).collect();
    mesh
}

/// The run of a plate whose corners are thrown in all directions.
fn shaken(plate: &Plate, more: &str) -> Run {
    let (mesh, deck) = scene(plate, 2000.0);
    thrown(mesh, deck + more)
}

fn thrown(mut mesh: Mesh, mut deck: String) -> Run {
    let mut seed = 20_261;
    for node in 0..mesh.coordinates.len() as u32 {
        let id = i64::from(node) + 1;
        mesh.node_sets.push(NodeSet { id, name: String::new(), nodes: vec![node] });
        let v: [f64; 3] = std::array::from_fn(|_| SPEED * random(&mut seed));
        deck += &format!("INITIAL VELOCITY NODESET, {id}, {:?}, {:?}, {:?}\n", v[0], v[1], v[2]);
    }
    run(&deck, &mesh).whole()
}

/// No energy and no momentum comes from nowhere. Where shells turn by a tenth of a turn and more while all modes swing, the
/// energy is kept to second order in the step, a hundredth at the largest step; see [`half_the_step`]. Momentum is kept to
/// round-off.
fn holds(name: &str, run: &Run) {
    let [first, last] = [&run.lines[0].totals, &run.last().totals];
    let energy =
        |totals: &urto::solver::Totals| totals.kinetic + totals.internal + totals.hourglass + totals.bulk_viscosity;
    between(name, "steps", run.last().step as f64, 1e3, 1e6);
    between(name, "worst energy balance", run.worst_balance(), 0.0, 0.02);
    between(name, "energy at the end over that at the start", energy(last) / energy(first), 0.98, 1.02);
    between(name, "kinetic energy at the end over that at the start", last.kinetic / first.kinetic, 0.0, 1.0);
    let size = first.kinetic / SPEED;
    for axis in 0..3 {
        let drift = (last.momentum[axis] - first.momentum[axis]).abs() / size;
        between(name, "drift of momentum", drift, 0.0, 1e-12);
    }
}

#[test]
fn a_flat_plate() {
    holds("flat", &shaken(&FLAT, ""));
}

/// A plate in which every second shell is two triangles.
fn mixed() -> (Mesh, String) {
    let (_, deck) = scene(&FLAT, 2000.0);
    let strip = |block, x: f64| format!("SHEET, {block}, {x}., 0., 0., 1., 3., 0., 1, 3\n");
    let recipe_text =
        format!("TITLE\n plate\n{}{}{}TRIANGLES, 2\nMERGE\n", strip(1, 0.0), strip(2, 1.0), strip(1, 2.0));
    let second = deck.replace("SHELL THICKNESS, 1", "SHELL THICKNESS, 2").replace("MATERIAL, 1", "MATERIAL, 2");
    let own = second.split_once("SHELL THICKNESS").map_or(String::new(), |(_, own)| format!("SHELL THICKNESS{own}"));
    (recipe(&recipe_text), deck + &own)
}

/// Of triangles, flat and thin, alone and beside quadrilaterals.
#[test]
fn plates_of_triangles() {
    let divided = |thickness: f64| {
        let (mesh, deck) = scene(&Plate { thickness, ..FLAT }, 2000.0);
        (triangles(&mesh), deck)
    };
    for (name, (mesh, deck)) in [("triangles", divided(0.01)), ("thin triangles", divided(1e-6)), ("mixed", mixed())] {
        holds(name, &thrown(mesh, deck));
    }
}

/// Twisted by 45 degrees a shell, along x.
#[test]
fn a_plate_warped_by_45_degrees() {
    let place = |[x, y, _]: [f64; 3]| {
        let (sine, cosine) = (std::f64::consts::FRAC_PI_4 * x).sin_cos();
        [x, (y - 1.5) * cosine, (y - 1.5) * sine]
    };
    holds("warped", &shaken(&Plate { place, ..FLAT }, ""));
}

#[test]
fn edges_of_one_to_a_hundred() {
    holds("edges 1:100", &shaken(&Plate { edges: [1.0, 0.01], thickness: 1e-3, ..FLAT }, ""));
}

#[test]
fn a_thickness_of_a_millionth_of_the_edge() {
    holds("thin", &shaken(&Plate { thickness: 1e-6, ..FLAT }, ""));
}

#[test]
fn nearly_no_change_of_volume() {
    let law = "ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.499";
    holds("nearly incompressible", &shaken(&Plate { law, ..FLAT }, ""));
}

/// Two thirds of it lie upon the rest and beyond.
#[test]
fn folded_flat_upon_itself() {
    holds("folded", &shaken(&Plate { place: |[x, y, z]| [x.min(2.0 - x), y, z], ..FLAT }, ""));
}

/// What is missing in the balance at the full step is an error of the step: at half of it, it is less than a quarter.
#[test]
fn half_the_step() {
    let [whole, half] = ["", "TIME STEP SCALE, 0.5\n"].map(|more| shaken(&FLAT, more).worst_balance());
    between("half the step", "energy balance over that of the whole step", half / whole, 0.0, 0.25);
}

/// About an axis in its plane, forty times. It is thick, since a thin one, whose bending is slower than the spin, buckles: what
/// bends away from the axis is thrown out farther.
#[test]
fn a_spinning_plate() {
    let (mesh, deck) = scene(&Plate { thickness: 0.1, ..FLAT }, 25_000.0);
    let spun = run(&(deck + "INITIAL VELOCITY ANGULAR, 1, 50., 0., 1.5, 0., 1., 0., 0.\n"), &mesh).whole();
    let [first, last] = [&spun.lines[0], spun.last()];
    between("spinning", "turns", 50.0 * last.time / std::f64::consts::TAU, 30.0, 50.0);
    // The plate is thrown into its strained shape at the start, and swings in it.
    between(
        "spinning",
        "kinetic energy over that at the start",
        last.totals.kinetic / first.totals.kinetic,
        0.998,
        1.0,
    );
    between("spinning", "worst energy balance", spun.worst_balance(), 0.0, 1e-4);
}

/// Of commands for the same nodes the later one holds, for what turns as well: a plate that is told to spin and then to
/// rest, or to fly without spin, has no energy of rotation; one that is told to spin once more spins once.
#[test]
fn a_later_initial_velocity_holds_for_rotations() {
    let (mesh, deck) = scene(&Plate { thickness: 0.1, ..FLAT }, 100.0);
    let spin = "INITIAL VELOCITY ANGULAR, 1, 50., 0., 1.5, 0., 1., 0., 0.\n";
    let at_start = |commands: &str| run(&format!("{deck}{commands}"), &mesh).whole().lines[0].totals.kinetic;
    let (once, rest) = (at_start(spin), "INITIAL VELOCITY MATERIAL, 1, 0., 0., 0.\n");
    assert!(once > 0.0);
    assert_eq!(at_start(&format!("{spin}{rest}")), 0.0);
    assert_eq!(at_start(&format!("{spin}{rest}{spin}")), once);
    let fly = "INITIAL VELOCITY MATERIAL, 1, 3., 0., 0.\n";
    assert_eq!(at_start(&format!("{spin}{fly}")), at_start(fly));
    let outwards = "INITIAL VELOCITY RADIAL, 1, 3., 0., 1.5, 0.\n";
    assert_eq!(at_start(&format!("{spin}{outwards}")), at_start(outwards));
}
