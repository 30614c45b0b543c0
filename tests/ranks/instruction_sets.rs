//! Every instruction set gives the same bits: every element with every law that it takes.
//!
//! The library's own tests compile the portable vectors only, so the wider ones are held against them here.

use crate::support::flow::alone;
use crate::support::meshes::recipe;
use std::collections::BTreeSet;
use urto::comm::Serial;
use urto::deck::Source;
use urto::lanes::InstructionSet;
use urto::mesh::Mesh;
use urto::model::{Model, examine};
use urto::solver::{Request, unfit_blocks};

/// Edge of the elements, metres.
const EDGE: f64 = 0.01;

/// Elements: one row of single precision, and a part of another.
const COUNT: usize = 19;

/// Steps that are compared.
const STEPS: usize = 20;

/// A number from -1 to 1 that belongs to an index.
fn noise(index: usize) -> f64 {
    let mixed =
        (index as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (mixed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// A row of elements whose nodes are off their places by a tenth of an edge; those of a plane stay in it, and on its axis.
fn crooked(shape: &str) -> Mesh {
    let mut mesh = recipe(&format!("TITLE\n elements\n{shape}\n"));
    let free = mesh.dimension.count();
    for (node, x) in mesh.coordinates.iter_mut().enumerate() {
        for axis in 0..free {
            if free == 3 || x[axis] > 0.0 {
                x[axis] += 0.1 * EDGE * noise(3 * node + axis);
            }
        }
    }
    mesh
}

/// The cards of each law, as block 1, with the functions that they name.
fn laws() -> Vec<String> {
    let deck = include_str!("../../decks/materials.i");
    let functions = &deck[deck.find("FUNCTION, 1").expect("functions")..deck.find("MATERIAL, 1,").expect("laws")];
    let cards = &deck[deck.find("MATERIAL, 1,").expect("laws")..deck.rfind("EXIT").expect("an end")];
    let of_law = |text: &str| {
        let number = text.split(',').next().expect("a block").trim().to_string();
        let cards = format!("\nMATERIAL,{text}").replace(&format!(", {number},"), ", 1,");
        format!("{functions}{cards}")
    };
    cards.split("\nMATERIAL,").map(|text| of_law(text.trim_start_matches("MATERIAL,"))).collect()
}

/// All that twenty steps of random motion leave behind, as bits.
fn history(mesh: &Mesh, model: &Model, instructions: InstructionSet) -> Vec<u64> {
    let mut solver = alone(mesh, model);
    solver.use_instructions(instructions);
    let mut bits = Vec::new();
    for step in 0..STEPS {
        solver.prepare(Request::Continue, &mut Serial).unwrap_or_else(|stop| panic!("{stop}"));
        bits.push(solver.time_step.to_bits());
        if step == 0 {
            let speed = 5e-3 * EDGE / solver.time_step;
            let flat = mesh.dimension.count();
            let mut kinetic = 0.0;
            for (node, row) in solver.domain.nodes.rows.iter_mut().enumerate() {
                for axis in 0..flat {
                    let still = flat == 2 && row.0[axis] == 0.0;
                    row.0[4 + axis] = if still { 0.0 } else { speed * noise(7000 + 3 * node + axis) };
                    kinetic += 0.5 * row.0[3] * row.0[4 + axis].powi(2);
                }
            }
            // The run watches its energy.
            solver.initial_energy += kinetic;
        }
        solver.advance();
        bits.extend(solver.domain.nodes.rows.iter().flat_map(|row| row.0).map(f64::to_bits));
    }
    for block in &solver.domain.blocks {
        for group in [&block.border, &block.interior] {
            bits.extend(group.state.iter().flat_map(|row| row.0).map(f64::to_bits));
            bits.extend(group.single.iter().flat_map(|row| row.0).map(|number| u64::from(number.to_bits())));
        }
    }
    bits
}

/// Holds all sets against each other, for every law that the elements take; says how many laws that were.
fn agree(shape: &str, cards: &str) -> usize {
    let mesh = crooked(shape);
    let mut taken = 0;
    for law in laws() {
        let deck = format!(
            "TITLE\n bits\nTERMINATION TIME, 1.\nTIME STEP SCALE, 0.5\nBULK VISCOSITY, 0.06, 1.2\n{cards}\n{law}\nEXIT\n"
        );
        let problem = match examine(Source::new("bits.i", deck), Some(&mesh)) {
            Ok(problem) => problem,
            // Every element takes the first law, ELASTIC.
            Err(found) if taken == 0 => panic!("{}", found.render(false)),
            Err(_) => continue,
        };
        if !unfit_blocks(&mesh, &problem.model).is_empty() {
            continue;
        }
        taken += 1;
        let mut different: BTreeSet<&str> = BTreeSet::new();
        let portable = history(&mesh, &problem.model, InstructionSet::default());
        for set in InstructionSet::available() {
            if history(&mesh, &problem.model, set) != portable {
                different.insert(set.name());
            }
        }
        assert!(different.is_empty(), "{shape}, {cards}: {different:?}\n{law}");
    }
    println!("{shape}, {cards}: {taken} laws");
    taken
}

fn boxes() -> String {
    format!("BOX, 1, 0., 0., 0., {}, {EDGE}, {EDGE}, {COUNT}, 1, 1", COUNT as f64 * EDGE)
}

#[test]
fn hexahedra() {
    let all = laws().len();
    for control in ["", "HOURGLASS STIFFENING, 0.05, 0.0", "HOURGLASS STIFFENING, 0.05, 0.02"] {
        for precision in ["DOUBLE", "SINGLE"] {
            assert_eq!(agree(&boxes(), &format!("{control}\nPRECISION, {precision}")), all);
        }
    }
    for precision in ["DOUBLE", "SINGLE"] {
        assert_eq!(agree(&boxes(), &format!("SPIN, SECOND ORDER\nPRECISION, {precision}")), all);
    }
}

#[test]
fn eight_points() {
    assert!(agree(&boxes(), "ELEMENT, 1, EIGHT POINTS") >= 6);
}

#[test]
fn quadrilaterals() {
    let shape = format!("RECTANGLE, 1, 0., 0., {}, {EDGE}, {COUNT}, 1", COUNT as f64 * EDGE);
    let all = laws().len();
    for kind in ["PLANE STRAIN", "AXISYMMETRIC"] {
        assert!(agree(&shape, kind) >= all - 1, "{kind}");
    }
    assert!(agree(&shape, "AXISYMMETRIC, COMPATIBLE") >= 3);
}

#[test]
fn shells() {
    let shape = format!("SHEET, 1, 0., 0., 0., {}, {EDGE}, 0., {COUNT}, 1", COUNT as f64 * EDGE);
    for shape in [shape.clone(), shape + "\nTRIANGLES, 1"] {
        for points in ["1", "3", "5"] {
            assert!(agree(&shape, &format!("SHELL THICKNESS, 1, 1.E-3\nINTEGRATION POINTS, 1, {points}")) >= 6);
        }
    }
}

#[test]
fn bars() {
    let shape = format!("LINE, 1, 0., 0., 0., {}, 0., 0., {COUNT}", COUNT as f64 * EDGE);
    assert!(agree(&shape, "TRUSS AREA, 1, 1.E-4") >= 10);
    assert!(agree(&shape, "BEAM SECTION, 1, TUBE, 4.E-3, 4.E-4") >= 6);
}

/// An element that turns inside out, or whose nodes are nowhere, is found by all, and by the same words.
#[test]
fn what_fails() {
    let mesh = crooked(&boxes());
    let deck = format!("TITLE\n fails\nTERMINATION TIME, 1.\n{}\nEXIT\n", laws()[0]);
    for precision in ["DOUBLE", "SINGLE"] {
        let model =
            crate::support::run::model(&deck.replace("\nEXIT", &format!("\nPRECISION, {precision}\nEXIT")), &mesh);
        for speed in [-1.5 * EDGE, f64::NAN, f64::INFINITY] {
            let words = |set: InstructionSet| {
                let mut solver = alone(&mesh, &model);
                solver.use_instructions(set);
                solver.prepare(Request::Continue, &mut Serial).expect("a body at rest");
                let over = speed / solver.time_step;
                // A corner of the seventh element, on the far side.
                let far = (0..mesh.coordinates.len()).filter(|&node| mesh.coordinates[node][2] > 0.5 * EDGE).nth(13);
                solver.domain.nodes.rows[far.expect("a node")].0[6] = over;
                // Nothing is said of the energy.
                solver.initial_energy = f64::MAX;
                solver.advance();
                solver.prepare(Request::Continue, &mut Serial).expect_err("an element fails").to_string()
            };
            let portable = words(InstructionSet::default());
            InstructionSet::available().for_each(|set| assert_eq!(words(set), portable, "{}", set.name()));
            println!("{speed}: {portable}");
        }
    }
}
