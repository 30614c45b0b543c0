//! Bodies whose meshes match: nodes lie on nodes, so that two contacts join the same two nodes.

use crate::support::between;
use crate::support::bodies::nodes_of;
use crate::support::meshes::recipe;
use crate::support::run::{run, run_on};
use urto::mesh::Mesh;

const SPEED: f64 = 50.0;

/// A block of 8 × 8 elements that falls flat on one of 12 × 12, node on node. `aside` of the way from a node to the next.
fn blocks(aside: f64) -> Mesh {
    let x = 0.02 + 0.01 * aside;
    recipe(&format!(
        "TITLE\n BLOCK ON BLOCK\nBOX, 1, 0., 0., 0., 0.12, 0.12, 0.04, 12, 12, 4\nBOX, 2, {x:?}, {x:?}, 0.0405, 0.08, 0.08, 0.04, 8, 8, 4\n"
    ))
}

/// To the time at which the wave has come back to the contact, 2 · 0.04 m at 5,900 m/s after the impact at 10 µs.
fn deck(lines: &str) -> String {
    let steel = "ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND";
    format!(
        "TITLE\n BLOCK ON BLOCK\nTERMINATION TIME, 24.E-6\nOUTPUT TIME, 1.E-6\nPLOT TIME, 4.E-6\nPLOT NODAL, VELOCITY, CONTACT\nCONTACT MATERIAL\n\
         INITIAL VELOCITY MATERIAL, 2, 0., 0., -{SPEED:?}\nMATERIAL, 1, {steel}\nMATERIAL, 2, {steel}\n{lines}\nEXIT\n"
    )
}

/// At the rim of the upper block the two contacts of a pair of nodes disagree by a hundredth of a step's motion: passes that share the force among
/// them by the masses handed it over in hundreds, and ran out in 33 of 49 steps.
#[test]
fn nodes_on_nodes_settle_in_a_few_passes() {
    for aside in [0.0, 0.01] {
        let mesh = blocks(aside);
        let fallen = run(&deck(""), &mesh);
        let tally = fallen.tally;
        println!("aside {aside}: {} passes in {} steps, {} ran out", tally.iterations, tally.steps, tally.capped);
        // The first step of the impact has no step before it that would say which of two contacts yields.
        assert!(tally.steps > 10 && tally.capped <= 1, "{tally:?}");
        assert!(tally.iterations < 7 * tally.steps, "{tally:?}");
        // What yields is on its face all the same.
        let (pressed, lower) = (fallen.at(20e-6), |node: &usize| mesh.coordinates[*node][2] == 0.0405);
        let on_face = nodes_of(&mesh, 2).into_iter().filter(lower).map(|node| pressed.nodal("CONTSTAT")[node]);
        assert!(
            on_face.clone().count() == 81 && on_face.clone().all(|status| status == 2.0),
            "{:?}",
            on_face.collect::<Vec<_>>()
        );
        // A settled pass moves nothing by more than a five-hundredth of a step's motion, in each of some 17 steps.
        let settled = run(&deck("CONTACT PASSES, 1000, 1.E-9"), &mesh);
        let axes = ["VELX", "VELY", "VELZ"];
        let apart = axes.into_iter().flat_map(|axis| fallen.end().nodal(axis).iter().zip(settled.end().nodal(axis)));
        let farthest = apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        between(
            "nodes on nodes",
            &format!("aside {aside}: velocities off settled ones, over the speed"),
            farthest / SPEED,
            0.0,
            0.02,
        );
        between(
            "nodes on nodes",
            "energy that contact has made",
            fallen.last().totals.contact_gain,
            0.0,
            1e-9 * fallen.initial_energy,
        );
    }
}

/// Which contacts yield is the same on any ranks.
#[test]
fn nodes_on_nodes_are_the_same_on_three_ranks() {
    let mesh = blocks(0.01);
    let [one, three] = [1, 3].map(|ranks| run_on(ranks, &deck(""), &mesh).whole());
    for axis in ["VELX", "VELY", "VELZ"] {
        let same = one.end().nodal(axis).iter().zip(three.end().nodal(axis)).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same, "{axis}");
    }
}

/// A block that is pressed slides over a plate in the plane, at a fiftieth of its speed of sound. Where a node at its rim passes one of the plate, the one of two contacts that holds goes in the same step in
/// which the other yields: what yields sees to it that nothing is open once the rest has settled. Nothing held the two for a step, and the rim went in by 9e-3 of a face.
#[test]
fn what_yields_holds_when_the_other_is_gone() {
    let mesh = recipe(
        "TITLE\n RIM\nRECTANGLE, 1, -2., 0.01, 4., 1., 8, 2\nRECTANGLE, 2, -5., -2., 14., 2., 28, 4\nNODE SET FACE, 1, 2, FRONT\nSIDE SET FACE, 300, 1, BACK\n",
    );
    let law = |young: &str| format!("ELASTIC, 0.001\nYOUNGS MODULUS = {young}\nPOISSONS RATIO = 0.3\nEND");
    let deck = format!(
        "TITLE\n RIM\nPLANE STRAIN\nTERMINATION TIME, 0.03\nOUTPUT TIME, 0.01\nPLOT TIME, 0.03\nPLOT NODAL, VELOCITY\nCONTACT MATERIAL\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nFUNCTION, 1\n0., 0.\n0.02, 1.\n1., 1.\nEND\nPRESSURE, 300, 1, 10.\n\
         INITIAL VELOCITY MATERIAL, 1, 25., 0.\nMATERIAL, 1, {}\nMATERIAL, 2, {}\nEXIT\n",
        law("2000."),
        law("200.")
    );
    let slid = run(&deck, &mesh);
    // Passes leave 1e-4 of a face, as they did before anything yielded.
    between("rim that passes a node", "deepest penetration, over the face", slid.tally.deepest, 0.0, 5e-4);
}
