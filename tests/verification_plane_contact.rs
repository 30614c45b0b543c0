//! Contact in two dimensions: nodes on the edges of others, in the plane and as rings.

mod support;

use support::close;
use support::continued::{Case, assert_same};
use support::meshes::recipe;
use support::run::{Run, State, run, run_on};
use support::{at_least, between};
use urto::mesh::Mesh;

/// Mean velocity of a block along an axis, by mass.
fn mean(state: &State, mesh: &Mesh, block: usize, name: &str) -> f64 {
    let (v, m) = (state.nodal(name), state.nodal("NODMASS"));
    let mut nodes = mesh.blocks[block].nodes.clone();
    nodes.sort_unstable();
    nodes.dedup();
    let sum = |f: &dyn Fn(usize) -> f64| nodes.iter().map(|&n| f(n as usize)).sum::<f64>();
    sum(&|n| m[n] * v[n]) / sum(&|n| m[n])
}

const STEEL: &str = "YOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\n";

fn rods(analysis: &str, more: &str) -> String {
    format!(
        "TITLE\n rods\n{analysis}\nTERMINATION TIME, 4.5E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-5\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nBULK VISCOSITY, 0., 0.\n{more}\
         MATERIAL, 1, ELASTIC, 7850.\n{STEEL}MATERIAL, 2, ELASTIC, 7850.\n{STEEL}"
    )
}

/// equal rods in a line swap their velocities; stopping nodes dead takes 1/(4N) of the energy. The rods are so thick that
/// the step is near h/c, as in V-21, whose references these are.
#[test]
fn q6_rods_swap_their_velocities() {
    let mesh = recipe(
        "RECTANGLE, 1, 0., 0., 0.1, 1., 1, 50\nRECTANGLE, 2, 0., 1., 0.1, 1., 1, 50\n\
         SIDE SET FACE, 100, 1, BACK\nSIDE SET FACE, 200, 2, FRONT\n",
    );
    for analysis in ["AXISYMMETRIC", "PLANE STRAIN"] {
        let deck = rods(analysis, "CONTACT SURFACE, 100, 200\nINITIAL VELOCITY MATERIAL, 1, 0., 10.\n");
        let hit = run(&deck, &mesh);
        let end = hit.end();
        between("Q-6", "first rod, part of the speed", mean(end, &mesh, 0, "VELY") / 10.0, 0.0033, 0.0101);
        close("Q-6", "second rod, part of the speed", mean(end, &mesh, 1, "VELY") / 10.0, 0.9933, 3e-3);
        close("Q-6", "energy taken by contact", -hit.last().totals.contact / hit.initial_energy, 1.0 / 200.0, 0.03);
        let momentum = hit.lines.iter().map(|line| line.totals.momentum[1]);
        let first = hit.lines[0].totals.momentum[1];
        let drift = momentum.fold(0.0, |most: f64, p| most.max((p / first - 1.0).abs()));
        between("Q-6", "drift of momentum", drift, 0.0, 1e-12);
        // As of hexahedra in V-21.
        between("Q-6", "energy balance", hit.worst_balance(), 0.0, 1e-5);
        assert!(end.nodal("VELX").iter().all(|v| v.abs() < 1e-9), "nothing moves across");
    }
}

/// Found by itself, on other meshes and turned in its plane: the same collision.
#[test]
fn rods_that_contact_material_finds() {
    let mesh = recipe(
        "RECTANGLE, 1, 0., 0., 0.02, 1., 2, 50\nRECTANGLE, 2, 0., 1., 0.02, 1., 3, 40\nROTATE, 1, 30.\nROTATE, 2, 30.\n",
    );
    let (c, s) = (libm::cos(30f64.to_radians()), libm::sin(30f64.to_radians()));
    let velocity = format!("INITIAL VELOCITY MATERIAL, 1, {}, {}\n", -10.0 * s, 10.0 * c);
    let hit = run(&rods("PLANE STRAIN", &format!("CONTACT MATERIAL\n{velocity}")), &mesh);
    let along = |block: usize| -s * mean(hit.end(), &mesh, block, "VELX") + c * mean(hit.end(), &mesh, block, "VELY");
    between("Q-6", "turned: first rod", along(0) / 10.0, -0.01, 0.03);
    close("Q-6", "turned: second rod", along(1) / 10.0, 0.99, 0.015);
    between("Q-6", "turned: energy balance", hit.worst_balance(), 0.0, 1e-6);
    between("Q-6", "turned: energy made by contact", hit.last().totals.contact_gain, 0.0, 1e-9 * hit.initial_energy);
}

/// A block that slides on another stops after v²/(2 μ g), and friction takes its energy.
#[test]
fn a_block_slides_and_stops() {
    let mesh = recipe(
        "RECTANGLE, 1, 0., 0., 0.1, 0.02, 50, 10\nRECTANGLE, 2, 0.01, 0.02, 0.02, 0.01, 9, 5\nNODE SET PLANE, 1, Y, 0.\n",
    );
    let deck = "TITLE\n block\nPLANE STRAIN\nTERMINATION TIME, 1.5E-3\nOUTPUT TIME, 1.E-5\nPLOT TIME, 5.E-5\n\
                PLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n\
                CONTACT MATERIAL\nCONTACT DATA, 1, 2, 0.3\nGRAVITY, 0., -1.E4\nINITIAL VELOCITY MATERIAL, 2, 3.\n\
                MATERIAL, 1, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nEND\n\
                MATERIAL, 2, ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nEND\n";
    let slide = run(deck, &mesh);
    let way = mean(slide.end(), &mesh, 1, "DISPLX");
    close("V-25", "way in the plane [m]", way, 9.0 / (2.0 * 0.3 * 1e4), 0.05);
    let friction = slide.last().totals.friction;
    close("V-25", "work of friction over the energy", friction / slide.initial_energy, 1.0, 0.05);
    between("V-25", "energy balance", slide.worst_balance(), 0.0, 2e-3);
}

const RINGS: &str = "TITLE\n rings\nTERMINATION TIME, 1.2E-3\nOUTPUT TIME, 5.E-5\nPLOT TIME, 2.E-4\n\
                     PLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nPLOT ELEMENT, STRESS\nPLOT STATE, EQPS\n\
                     CONTACT MATERIAL\nCONTACT DATA, ALL, ALL, 0.2\nDEATH, 1, EQPS, MAX, 0.25\n\
                     INITIAL VELOCITY MATERIAL, 1, 0., -120.\nRIGID SURFACE, 300, 0., 0., 0., 1.\n\
                     MATERIAL, 1, ELASTIC PLASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 1.E8\n\
                     HARDENING MODULUS = 2.E8\nBETA = 1.\nEND\n\
                     MATERIAL, 2, ELASTIC PLASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 1.E8\n\
                     HARDENING MODULUS = 2.E8\nBETA = 0.5\nEND\n";

/// A ring that falls on a block and folds on itself; about the axis it is a torus on a disc.
fn rings() -> Mesh {
    recipe(
        "RING, 1, 0.04, 0.05, 3, 60\nTRANSLATE, 1, 0.12, 0.0905\nRECTANGLE, 2, 0., 0., 0.24, 0.04, 30, 5\n\
         SIDE SET FACE, 300, 2, FRONT\n",
    )
}

/// Self-contact, friction, erosion, a rigid line: the same bits on any ranks, and momentum but for what the line takes.
#[test]
fn the_same_bits_on_any_ranks() {
    let mesh = rings();
    for analysis in ["PLANE STRAIN\n", "AXISYMMETRIC\n"] {
        let deck = format!("{RINGS}{analysis}");
        let one = run_on(1, &deck, &mesh).whole();
        at_least("rings", "plastic strain", one.end().element("EQPS").iter().fold(0.0, |m, e| f64::max(m, *e)), 0.05);
        between("rings", "energy balance", one.worst_balance(), 0.0, 5e-3);
        for ranks in [2, 5] {
            let many: Run = run_on(ranks, &deck, &mesh).whole();
            for (a, b) in one.lines.iter().zip(&many.lines) {
                assert_eq!((a.step, a.time.to_bits(), a.totals), (b.step, b.time.to_bits(), b.totals), "{ranks} ranks");
            }
            assert_eq!(one.end().nodal("DISPLY"), many.end().nodal("DISPLY"), "{ranks} ranks");
        }
    }
}

#[test]
fn restarts_have_the_same_bits() {
    let case = Case::new(&format!("{RINGS}AXISYMMETRIC\n"), rings());
    let whole = case.part(1, None, 260);
    let first = case.part(2, None, 200);
    let continued = case.part(1, Some(&first.end), 60);
    assert_same("rings", &whole, &continued);
}
