//! Scenes in which contact once made energy, each for its own reason: light foam between stiff walls, plates held along the
//! normal of their contact, faces that erosion has squashed, overlaps that the deck holds. Whatever the passes and the
//! step, contact gives nothing.

use crate::support::meshes::recipe;
use crate::support::run::{Run, model, run};
use urto::mesh::Mesh;
use urto::solver::Body;

const LINED_BOX: &str = include_str!("../fixtures/contact/lined_box.i");
const PINCHED: &str = include_str!("../fixtures/contact/pinch.mesh");
const LINED: &str = include_str!("../fixtures/contact/liner.mesh");
const CLAMPED_STACK: &str = include_str!("../fixtures/contact/clamped_stack.i");
const CLAMPED_STACK_MESH: &str = include_str!("../fixtures/contact/clamped_stack.mesh");
const ROUND_NOSE: &str = include_str!("../fixtures/contact/round_nose.i");
const ROUND_NOSE_MESH: &str = include_str!("../fixtures/contact/round_nose.mesh");
const OVERLAP_HELD: &str = include_str!("../fixtures/contact/overlap_held.i");
const OVERLAP_HELD_MESH: &str = include_str!("../fixtures/contact/overlap_held.mesh");

/// Runs a deck to its end, and holds every line against what contact may give: at a state half of the step's work is booked, which for
/// a node that chatters between stiff faces is not yet taken back.
fn gives_nothing(name: &str, deck: &str, mesh: &Mesh) -> Run {
    let run = run(deck, mesh);
    let scale = run.lines.iter().fold(run.initial_energy, |most, line| most.max(line.totals.external));
    for line in &run.lines {
        let work = line.totals.contact - line.totals.friction;
        assert!(work <= 1e-4 * scale, "{name}: contact has given {work:e} of {scale:e} at step {}", line.step);
        assert!(line.totals.contact_gain <= 1e-9 * scale, "{name}: CONTGAIN {:e}", line.totals.contact_gain);
    }
    println!("{name}: contact {:.3e}, largest supplied {scale:.3e}", run.last().totals.contact);
    run
}

/// The same deck with these passes and this part of the step.
fn varied(deck: &str, passes: u32, scale: f64) -> String {
    deck.replacen("TERMINATION", &format!("CONTACT PASSES, {passes}\nTIME STEP SCALE, {scale}\nTERMINATION"), 1)
}

fn cases() -> [(&'static str, &'static str, Mesh); 4] {
    [
        ("pinched lining", LINED_BOX, recipe(PINCHED)),
        ("lining", LINED_BOX, recipe(LINED)),
        ("clamped stack", CLAMPED_STACK, recipe(CLAMPED_STACK_MESH)),
        ("round nose", ROUND_NOSE, recipe(ROUND_NOSE_MESH)),
    ]
}

#[test]
fn scenes_that_once_made_energy_give_nothing() {
    for (name, deck, mesh) in cases() {
        gives_nothing(name, deck, &mesh);
    }
}

#[test]
#[ignore = "minutes in the release build: make verify"]
fn they_give_nothing_with_any_passes_and_step() {
    for (name, deck, mesh) in cases() {
        for passes in [1, 3, 20, 200] {
            for scale in [0.9, 0.45] {
                gives_nothing(&format!("{name}, {passes} passes, step {scale}"), &varied(deck, passes, scale), &mesh);
            }
        }
    }
}

/// Plates that are held at one end share the load: the upper one bends about half as far as alone (the fixture's pressure, 3 ms).
#[test]
fn clamped_plates_share_the_load() {
    let mesh = recipe(CLAMPED_STACK_MESH);
    let end = |deck: &str| {
        let run = run(deck, &mesh);
        let top = run.end().nodal("DISPLZ");
        mesh.coordinates
            .iter()
            .zip(top)
            .filter(|(x, _)| x[0] > 0.999 && x[2] > 0.199)
            .map(|(_, u)| *u)
            .fold(0.0, f64::min)
    };
    let (both, alone) =
        (end(CLAMPED_STACK), end(&CLAMPED_STACK.replace("CONTACT MATERIAL, 1, 2\n", "").replace(", CONTACT", "")));
    let part = both / alone;
    println!("tip with contact {both:.4e}, without {alone:.4e}, part {part:.3}");
    assert!((0.4..0.6).contains(&part), "{part}");
}

/// What is moved goes no farther than its overlap of a millimetre, however the deck holds nodes, and nothing moves in the run.
#[test]
fn overlaps_that_are_held_move_no_farther_than_they_are_deep() {
    let mesh = recipe(OVERLAP_HELD_MESH);
    let body = Body::new(&mesh, &model(OVERLAP_HELD, &mesh)).expect("materials");
    assert!(body.overlap.nodes > 0 && body.overlap.farthest <= 1.001e-3, "moved by {}", body.overlap.farthest);
    let run = run(OVERLAP_HELD, &mesh);
    let speed =
        ["VELX", "VELY", "VELZ"].map(|name| run.end().nodal(name).iter().fold(0.0, |most, v| v.abs().max(most)));
    assert!(speed.iter().all(|v| *v < 1e-9), "{speed:?}");
}

/// Two plates that touch, one held as a whole, one at its bottom, and nothing that drives them: of the members of their contacts those
/// that move have weights of round-off, 1e-17, over which forces of 1e16 N went to nodes that are held. A sheet lies on both.
#[test]
fn contact_forces_at_held_nodes_are_those_that_something_exerts() {
    let mesh = recipe(
        "TITLE\n plates\nBOX, 1, 0., 0., 0., 1., 1., 0.2, 13, 11, 2\nBOX, 2, 1., 0., 0., 0.8, 1., 0.2, 5, 9, 2\n\
         SHEET, 3, 0.85, 0.39, 0.205, 0.25, 0.16, 0., 7, 5\nNODE SET FACE, 1, 1, BOTTOM\nNODE SET BLOCK, 2, 2\n",
    );
    let law =
        |block: u32| format!("MATERIAL, {block}, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nEND\n");
    let held = |set: u32| ["X", "Y", "Z"].map(|axis| format!("NO DISPLACEMENT, {axis}, {set}\n")).concat();
    let deck = format!(
        "TITLE\n plates\nTERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-4\nPLOT NODAL, CONTACT, REACTION\nCONTACT MATERIAL\n\
         SHELL THICKNESS, 3, 0.01\nGRAVITY, 0., 0., -500.\n{}{}{}",
        held(1),
        held(2),
        [1, 2, 3].map(law).concat()
    );
    let run = run(&deck, &mesh);
    // Ten times the weights of the sheet, 540 N, and of the plate that gives way, 270 kN, which settles on its bottom: its top and walls
    // swing by no more than twice what they would be pressed by.
    let most = 10.0 * 500.0 * 2700.0 * (0.25 * 0.16 * 0.01 + 0.2);
    for state in &run.states {
        for name in ["CONTX", "CONTY", "CONTZ", "RX", "RY", "RZ"] {
            let worst = state.nodal(name).iter().fold(0.0, |most: f64, force| most.max(force.abs()));
            assert!(worst < most, "{name} of {worst:e} N at {:e} s", state.time);
        }
    }
}

/// Deeper than half an element nothing says which way is out.
#[test]
fn deep_overlaps_are_refused_with_place_and_depth() {
    let mesh = recipe(
        "TITLE\n DEEP\nBOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\nBOX, 2, 0.3, 0.3, 0.25, 0.4, 0.4, 1., 2, 2, 2\n",
    );
    let body = Body::new(&mesh, &model(OVERLAP_HELD.replace("NO DISPLACEMENT, Z, 1\n", "").as_str(), &mesh))
        .expect("materials");
    let refusal = body.overlap.refusal(&mesh).expect("a refusal");
    assert!(refusal.contains("deeper than half an element") && refusal.contains("2.5000e-1 below"), "{refusal}");
}
