//! Random small scenes of gases, products of explosives and metals: on skewed and jittered meshes, with jumps of density
//! and energy, and elements that DEATH takes. All energy is accounted for, and the bits are those of one rank on two and
//! three, and after a restart.
//!
//! `URTO_SCENES=0..500 cargo test --test verification_materials gas_scenes:: -- --nocapture` runs others.

use crate::support::continued::{Case, assert_same};
use crate::support::flow::alone;
use crate::support::meshes::{add_node_set, box_of_cells};
use crate::support::run::{Line, model, run_on};
use crate::support::scenes::Dice;
use std::fmt::Write;
use urto::comm::Serial;
use urto::mesh::{Block, Mesh};
use urto::output::block_energies;
use urto::solver::{Request, Stop};

/// Round-off of the accounts: the work of corner forces is booked exactly.
const BALANCE: f64 = 1e-9;
/// What resistances of fluids give back beyond what they took: in one step at most, before they know (one of 700 scenes, 2.5e-4).
const GIVEN_BACK: f64 = 1e-3;
/// Where metals with strength take part, the midpoint rule of hourglass resistance is in it.
const BALANCE_OF_METALS: f64 = 1e-3;
/// Steps that are compared.
const STEPS: usize = 40;

struct Scene {
    mesh: Mesh,
    deck: String,
    /// Whether all of it is fluid.
    fluid: bool,
    death: bool,
}

/// What is known of a material before its cards are written.
struct Matter {
    cards: String,
    fluid: bool,
    /// Speed of sound.
    sound: f64,
}

fn gas(dice: &mut Dice, block: usize) -> Matter {
    let (density, gamma) = (dice.magnitude(1.0, 1e3), dice.between(1.2, 2.0));
    // Now and then so cold that nothing holds it but viscosity.
    let energy = if dice.chance(0.2) { 1e-3 } else { dice.magnitude(1e6, 1e10) };
    let cards = format!(
        "MATERIAL, {block}, HYDRODYNAMIC, {density:?}\nPRESSURE CUTOFF = 0.\nEND\n\
         EQUATION OF STATE, {block}, IDEAL GAS\nGAMMA = {gamma:?}\nINITIAL ENERGY = {energy:e}\nEND\n"
    );
    Matter { cards, fluid: true, sound: (gamma * (gamma - 1.0) * energy / density).sqrt() }
}

/// Products of TNT that have burnt before the start.
fn products(block: usize) -> Matter {
    let cards = format!(
        "MATERIAL, {block}, HYDRODYNAMIC, 1630.\nPRESSURE CUTOFF = 0.\nEND\n\
         EQUATION OF STATE, {block}, JWL\nA = 371.2E9\nB = 3.231E9\nR1 = 4.15\nR2 = 0.95\nOMEGA = 0.30\n\
         INITIAL ENERGY = 7.0E9\nDETONATION VELOCITY = 6930.\nEND\n"
    );
    Matter { cards, fluid: true, sound: 5000.0 }
}

fn copper(block: usize) -> Matter {
    let cards = format!(
        "MATERIAL, {block}, EP HYDRODYNAMIC, 8930.\nYOUNGS MODULUS = 117.E9\nPOISSONS RATIO = 0.35\nYIELD STRESS = 100.E6\n\
         HARDENING MODULUS = 200.E6\nPRESSURE CUTOFF = -1.2E9\nEND\n\
         EQUATION OF STATE, {block}, MG US-UP\nC0 = 3940.\nS = 1.489\nGAMMA = 2.0\nEND\n"
    );
    Matter { cards, fluid: false, sound: 4600.0 }
}

/// Cuts a mesh of one block into so many, by layers across an axis or at random.
fn divide(dice: &mut Dice, mesh: &mut Mesh, blocks: usize, cells: [usize; 3]) {
    let axis = dice.count(0, 3);
    let mut parts: Vec<Vec<[u32; 8]>> = vec![Vec::new(); blocks];
    for (e, nodes) in mesh.blocks[0].hexahedra().iter().enumerate() {
        let place = [e % cells[0], e / cells[0] % cells[1], e / (cells[0] * cells[1])];
        let of = if axis < 3 { place[axis] * blocks / cells[axis] } else { dice.count(0, blocks - 1) };
        parts[of].push(*nodes);
    }
    let filled = parts.into_iter().enumerate().filter(|(_, part)| !part.is_empty());
    mesh.blocks = filled.map(|(i, part)| Block::hexahedra_of(i as i64 + 1, part)).collect();
}

/// A box sheared by up to half where its plane x = 0 is free, with nodes moved by up to a fifth of an element, but for those of
/// the planes that may be held.
fn skew(dice: &mut Dice, mesh: &mut Mesh, element: [f64; 3], free: bool) {
    let (shear, jitter) = (dice.between(-0.5, 0.5), dice.one_of(&[0.0, 0.1, 0.2]));
    for x in &mut mesh.coordinates {
        for i in 0..3 {
            if x[i] != 0.0 {
                x[i] += jitter * element[i] * dice.between(-1.0, 1.0);
            }
        }
        if free {
            x[0] += shear * x[1];
        }
    }
}

fn death(dice: &mut Dice, block: i64) -> String {
    let rule = dice.one_of(&[
        "VOLUME, MAX, 1.3",
        "VOLUME, MIN, 0.7",
        "CORNER, MIN, 0.3",
        "EINT, MAX, 2.E6",
        "DENSITY, MAX, 300.",
    ]);
    format!("DEATH, {block}, {rule}, {}\n", dice.one_of(&["FREE", "DROP"]))
}

fn scene(seed: u64) -> Scene {
    let mut dice = Dice::of(seed);
    let cells = [0; 3].map(|_| dice.count(2, 6));
    let element = [0; 3].map(|_| dice.magnitude(0.5, 2.0) * 1e-3);
    let mut mesh = box_of_cells(cells, std::array::from_fn(|i| cells[i] as f64 * element[i]));
    let blocks = dice.count(1, 4);
    divide(&mut dice, &mut mesh, blocks, cells);
    let mut deck = String::new();
    for (axis, id) in [(0, 11), (1, 12), (2, 13)] {
        if dice.chance(0.6) {
            add_node_set(&mut mesh, id, |x| x[axis] == 0.0);
            let _ = writeln!(deck, "NO DISPLACEMENT, {}, {id}", ["X", "Y", "Z"][axis]);
        }
    }
    let free = !deck.contains("DISPLACEMENT, X");
    skew(&mut dice, &mut mesh, element, free);
    let (mut fluid, mut fastest, mut dies) = (true, 500.0_f64, false);
    for id in mesh.blocks.iter().map(|block| block.id).collect::<Vec<_>>() {
        let matter = match dice.count(0, 9) {
            0 => products(id as usize),
            1 | 2 => copper(id as usize),
            _ => gas(&mut dice, id as usize),
        };
        fluid &= matter.fluid;
        deck += &matter.cards;
        let speed = [0; 3].map(|_| dice.between(-1.0, 1.0) * dice.one_of(&[0.0, 300.0, 2000.0]));
        let _ = writeln!(deck, "INITIAL VELOCITY MATERIAL, {id}, {:?}, {:?}, {:?}", speed[0], speed[1], speed[2]);
        fastest = speed.iter().fold(fastest.max(matter.sound), |most, v| most.max(v.abs()));
        if dice.chance(0.5) {
            deck += &death(&mut dice, id);
            dies = true;
        }
    }
    // Long enough for a wave to cross half of the box, and a few steps of the elements that are compressed.
    let end = 4.0 * (0..3).map(|i| cells[i] as f64 * element[i]).fold(f64::INFINITY, f64::min) / fastest;
    let deck = format!(
        "TITLE\n gases\nTERMINATION TIME, {end:e}\nOUTPUT TIME, {:e}\nPLOT TIME, {end:e}\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, ACCELERATION\n\
         PLOT ELEMENT, EINT, DENSITY, PRESSURE, BULKQ, CORNER\n{deck}",
        end / 200.0
    );
    Scene { mesh, deck, fluid, death: dies }
}

/// Seeds of the scenes.
fn seeds() -> std::ops::Range<u64> {
    let Ok(text) = std::env::var("URTO_SCENES") else { return 0..60 };
    let ends = text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
    let (first, end) = ends.expect("URTO_SCENES=first..end");
    first..end
}

/// A run accounts for its energy as far as it comes; returns whether it comes to its end.
fn accounts_for_its_energy(seed: u64, scene: &Scene) -> bool {
    let run = run_on(1, &scene.deck, &scene.mesh);
    let bound = if scene.fluid { BALANCE } else { BALANCE_OF_METALS };
    let gap = |line: &Line| line.totals.relative_gap(run.initial_energy).abs();
    let made = |line: &Line| line.totals.relative_error(run.initial_energy).abs();
    // A run that stops shows its last state without forces.
    let whole = &run.lines[..run.lines.len() - usize::from(run.stop.is_some())];
    let worst = whole.iter().map(gap).fold(0.0, f64::max);
    let most_made = whole.iter().map(made).fold(0.0, f64::max);
    let kind =
        [["metals", "metals, DEATH"], ["fluids", "fluids, DEATH"]][usize::from(scene.fluid)][usize::from(scene.death)];
    let stop = run.stop.as_ref().map(Stop::to_string);
    println!(
        "scene {seed}: {kind}, gap {worst:.1e}, with what was given back {most_made:.1e}, steps {}, stop {stop:?}",
        run.last().step
    );
    assert!(worst < bound, "scene {seed}: the accounts leave {worst:e}\n{}", scene.deck);
    assert!(!scene.fluid || most_made < GIVEN_BACK, "scene {seed}: given back {most_made:e}\n{}", scene.deck);
    run.stop.is_none()
}

#[test]
fn energy_is_accounted_for() {
    let whole = seeds().filter(|&seed| accounts_for_its_energy(seed, &scene(seed))).count();
    println!("{whole} of {} scenes came to their end", seeds().count());
}

/// A hot gas that throws a steel plate, on elements small enough that the steps change.
fn gas_behind_a_plate() -> Scene {
    let mut mesh = box_of_cells([6, 2, 2], [6e-3, 2e-3, 2e-3]);
    let cells = mesh.blocks[0].hexahedra().to_vec();
    let (gas, steel) = cells.iter().enumerate().partition::<Vec<_>, _>(|(e, _)| e % 6 < 4);
    let block = |id, of: Vec<(usize, &[u32; 8])>| Block::hexahedra_of(id, of.into_iter().map(|(_, nodes)| *nodes));
    mesh.blocks = vec![block(1, gas), block(2, steel)];
    let deck = "TITLE\n plate\nTERMINATION TIME, 4.E-6\nMATERIAL, 1, HYDRODYNAMIC, 1000.\nPRESSURE CUTOFF = 0.\nEND\n\
                EQUATION OF STATE, 1, IDEAL GAS\nGAMMA = 1.4\nINITIAL ENERGY = 5.E9\nEND\n\
                MATERIAL, 2, ELASTIC, 7850.\nYOUNGS MODULUS = 210.E9\nPOISSONS RATIO = 0.3\nEND\n\
                INITIAL VELOCITY MATERIAL, 2, 50., 20., -100.\n";
    Scene { mesh, deck: deck.to_string(), fluid: false, death: false }
}

/// What the body's energies are, the blocks' are together, at every state that a user may look at. Each is a sum of exactly the same
/// numbers, rounded once: they differ by the last digits of the largest block.
#[test]
fn energies_of_blocks_add_up_to_those_of_the_body() {
    let (mut compared, mut changes) = (0, 0);
    for scene in std::iter::once(gas_behind_a_plate()).chain((0..12).map(scene)) {
        let model = model(&scene.deck, &scene.mesh);
        let mut solver = alone(&scene.mesh, &model);
        while solver.step < 120 && solver.time < model.termination_time {
            if solver.prepare(Request::Continue, &mut Serial).is_err() {
                break;
            }
            let totals = solver.totals(&mut Serial);
            let whole = [totals.internal, totals.hourglass, totals.bulk_viscosity];
            let blocks = block_energies(scene.mesh.blocks.len(), &solver, &mut Serial);
            for (account, whole) in (1..).zip(whole) {
                let own: Vec<f64> = blocks.chunks_exact(4).map(|block| block[account]).collect();
                let largest = own.iter().fold(whole.abs(), |most, energy| energy.abs().max(most));
                let off = (own.iter().sum::<f64>() - whole).abs();
                assert!(off <= 1e-12 * largest, "account {account} at step {}: {own:?}, {whole}", solver.step);
            }
            compared += 1;
            changes += usize::from(solver.step > 0 && solver.longer().abs() > 1e-3 * solver.time_step);
            solver.advance();
        }
    }
    println!("{compared} states compared, at {changes} of which the steps change");
    // Where the step is always the same there is nothing to make good.
    assert!(10 * changes > compared);
}

#[test]
fn bits_do_not_depend_on_ranks_and_restarts() {
    let mut compared = 0;
    for seed in seeds() {
        let scene = scene(seed);
        // Not beyond the end of the run.
        let steps = STEPS.min(run_on(1, &scene.deck, &scene.mesh).last().step as usize);
        if steps < 4 {
            continue;
        }
        let case = Case::new(&scene.deck, scene.mesh);
        let whole = case.part(1, None, steps);
        for ranks in [2, 3] {
            assert_same(&format!("scene {seed}, {ranks} ranks"), &whole, &case.part(ranks, None, steps));
        }
        let [first, rest] = [1 + seed as usize % 3, 1 + (seed as usize + 1) % 3];
        let begun = case.part(first, None, steps / 2);
        let continued = case.part(rest, Some(&begun.end), steps - steps / 2);
        assert_same(&format!("scene {seed}, restart"), &whole, &continued);
        compared += 1;
    }
    println!("{compared} scenes compared");
    assert!(2 * compared > seeds().count());
}
