//! Contact in two dimensions: nodes on the edges of others, in the plane and as rings.

use crate::support::close;
use crate::support::continued::{Case, assert_same};
use crate::support::meshes::recipe;
use crate::support::run::{Run, State, model, run, run_on};
use crate::support::{at_least, between};
use urto::mesh::Mesh;
use urto::solver::{Body, of_overlaps};

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

/// A bar along y in two dimensions: what it is, its analysis, its x from and to, and the area of its section. They are so
/// thin that the step, and the viscosity that goes with it, are about those of the hexahedra's bar of 10 mm.
const BARS: [(&str, &str, [f64; 2], f64); 3] = [
    ("rod", "AXISYMMETRIC", [0.0, 0.01], std::f64::consts::PI * 1e-4),
    ("ring", "AXISYMMETRIC", [0.1, 0.107], std::f64::consts::PI * (0.107 * 0.107 - 0.1 * 0.1)),
    ("strip", "PLANE STRAIN", [0.1, 0.107], 0.007),
];

/// Speed of a wave along a bar of the rods' steel.
fn bar_speed() -> f64 {
    (200e9f64 / 7850.0).sqrt()
}

/// V-20: a bar on a rigid line: pressure ρ c v for 2 L/c, then it flies back.
#[test]
fn v20_bars_rebound_from_a_rigid_line() {
    for (what, analysis, [from, to], area) in BARS {
        let mesh =
            recipe(&format!("RECTANGLE, 1, {from}, 0., {}, 1., 1, 50\nSIDE SET FACE, 100, 1, FRONT\n", to - from));
        let deck = format!(
            "TITLE\n bar\n{analysis}\nTERMINATION TIME, 5.E-4\nOUTPUT TIME, 1.E-6\nPLOT TIME, 1.E-8\nPLOT NODAL, REACTION\n\
             RIGID SURFACE, 100, 0., 0., 0., 1.\nINITIAL VELOCITY MATERIAL, 1, 0., -5.\nMATERIAL, 1, ELASTIC, 7850.\n{STEEL}"
        );
        let hit = run(&deck, &mesh);
        let (mass, speed) = (7850.0 * area, bar_speed());
        let force: Vec<(f64, f64)> = hit.states.iter().map(|s| (s.time, s.nodal("RY").iter().sum())).collect();
        let duration = force.iter().rev().find(|(_, f)| *f > 0.0).map_or(0.0, |(time, _)| *time);
        close("V-20", &format!("{what}: duration 2L/c [s]"), duration, 2.0 / speed, 0.01);
        let impulse: f64 = force.windows(2).map(|w| 0.5 * (w[1].0 - w[0].0) * (w[0].1 + w[1].1)).sum();
        close("V-20", &format!("{what}: mean force [N]"), impulse / duration, 7850.0 * speed * 5.0 * area, 0.02);
        let momentum = hit.last().totals.momentum[1];
        close(
            "V-20",
            &format!("{what}: impulse over the change of momentum"),
            impulse / (momentum + 5.0 * mass),
            1.0,
            1e-10,
        );
        between("V-20", &format!("{what}: restitution"), momentum / (5.0 * mass), 0.97, 1.0);
        let turn = hit.lines.iter().min_by(|a, b| a.totals.kinetic.total_cmp(&b.totals.kinetic)).expect("lines");
        close("V-20", &format!("{what}: time of rest L/c [s]"), turn.time, 1.0 / speed, 0.02);
        between("V-20", &format!("{what}: energy balance"), hit.worst_balance(), 0.0, 1e-3);
    }
}

/// What a bar of V-20 loses: 2 % since the nodes that strike are stopped dead, whatever the element, and what bulk
/// viscosity takes, whose length is that of the step. Elements of 20 by 10 mm take steps a third longer in the plane than
/// in space, and lose a third more; in bars 7 mm thick the plane's step is that of hexahedra 10 mm thick, and so is the
/// loss.
#[test]
fn v20_what_a_bar_loses() {
    let loss = |shape: &str, thickness: f64, viscosity: &str| {
        let (part, head, [wall, velocity]) = match shape {
            "space" => ("BOX, 1, 0., 0., 0.", "", ["0., 0., 0., 0., 1., 0.", "0., -5., 0."]),
            _ => ("RECTANGLE, 1, 0.1, 0.", "PLANE STRAIN\n", ["0., 0., 0., 1.", "0., -5."]),
        };
        let across = if head.is_empty() { format!("{thickness}, 1, 50, 1") } else { "1, 50".to_owned() };
        let sizes = format!("{thickness}, 1., {across}");
        let mesh = recipe(&format!("{part}, {sizes}\nSIDE SET FACE, 100, 1, FRONT\n"));
        let deck = format!(
            "TITLE\n bar\n{head}TERMINATION TIME, 5.E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-4\n{viscosity}RIGID SURFACE, 100, {wall}\n\
             INITIAL VELOCITY MATERIAL, 1, {velocity}\nMATERIAL, 1, ELASTIC, 7850.\n{STEEL}"
        );
        let hit = run(&deck, &mesh);
        let momentum = |line: &crate::support::run::Line| line.totals.momentum[1];
        (1.0 + momentum(hit.last()) / momentum(&hit.lines[0]), hit.last().step as f64)
    };
    let without = "BULK VISCOSITY, 0., 0.\n";
    let (hexahedra, plane) = (loss("space", 0.01, ""), loss("plane", 0.01, ""));
    let dead = [loss("space", 0.01, without).0, loss("plane", 0.01, without).0];
    close("V-20", "loss without viscosity, plane over space", dead[1] / dead[0], 1.0, 0.05);
    let viscous = (plane.0 - dead[1]) / (hexahedra.0 - dead[0]);
    close("V-20", "loss by viscosity, plane over space", viscous, hexahedra.1 / plane.1, 0.05);
    let thin = loss("plane", 0.007, "");
    close("V-20", "steps of thin plane over space", thin.1 / hexahedra.1, 1.0, 0.02);
    close("V-20", "loss of thin plane over space", thin.0 / hexahedra.0, 1.0, 0.01);
}

/// Two bars of these lengths and elements in a line, the first with a speed of `v`; the second of another metal if one is given.
fn two_bars(bar: usize, lengths: [f64; 2], n: [usize; 2], v: f64, end: &str, second: Option<&str>) -> (Run, Mesh) {
    let (_, analysis, [from, to], _) = BARS[bar];
    let width = to - from;
    let mesh = recipe(&format!(
        "RECTANGLE, 1, {from}, 0., {width}, {:?}, 1, {}\nRECTANGLE, 2, {from}, {0:?}, {width}, {:?}, 1, {}\n\
         SIDE SET FACE, 100, 1, BACK\nSIDE SET FACE, 200, 2, FRONT\n",
        lengths[0], n[0], lengths[1], n[1]
    ));
    let steel = format!("ELASTIC, 7850.\n{STEEL}");
    let deck = format!(
        "TITLE\n bars\n{analysis}\nTERMINATION TIME, {end}\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-5\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nPLOT ELEMENT, STRESS\nCONTACT SURFACE, 100, 200\n\
         INITIAL VELOCITY MATERIAL, 1, 0., {v:?}\nMATERIAL, 1, {steel}MATERIAL, 2, {}",
        second.unwrap_or(&steel)
    );
    (run(&deck, &mesh), mesh)
}

fn momentum_drift(run: &Run) -> f64 {
    let first = run.lines[0].totals.momentum[1];
    run.lines.iter().map(|line| (line.totals.momentum[1] / first - 1.0).abs()).fold(0.0, f64::max)
}

/// V-21 with the default viscosity: of equal bars the second goes on with the speed of the first. References are those of the same
/// bars of hexahedra, a third of h/c a step.
#[test]
fn v21_equal_bars() {
    for (bar, (what, ..)) in BARS.iter().enumerate() {
        let (hit, mesh) = two_bars(bar, [1.0, 1.0], [50, 50], 5.0, "6.E-4", None);
        close("V-21", &format!("{what}: second bar over v"), mean(hit.end(), &mesh, 1, "VELY") / 5.0, 0.98, 0.01);
        close(
            "V-21",
            &format!("{what}: contact loss"),
            -hit.last().totals.contact / hit.initial_energy,
            1.0 / 200.0,
            1e-6,
        );
        between("V-21", &format!("{what}: drift of momentum"), momentum_drift(&hit), 0.0, 1e-12);
        let (hit, _) = two_bars(bar, [1.0, 1.0], [50, 20], 5.0, "6.E-4", None);
        close(
            "V-21",
            &format!("{what}: contact loss, 50 on 20"),
            -hit.last().totals.contact / hit.initial_energy,
            1.0 / 140.0,
            1e-6,
        );
    }
}

/// V-22: a short bar stops when its wave is back, and the long one has L₁/L₂ of the speed.
#[test]
fn v22_bars_of_unequal_length() {
    for (bar, (what, ..)) in BARS.iter().enumerate() {
        for (ratio, n) in [(2.0, 50), (3.0, 50)] {
            let (hit, mesh) = two_bars(bar, [1.0, ratio], [n, (n as f64 * ratio) as usize], 5.0, "1.E-3", None);
            let [short, long] = [0, 1].map(|block| mean(hit.end(), &mesh, block, "VELY") / 5.0);
            between("V-22", &format!("{what} 1:{ratio}: short bar over v"), short, -0.2 / n as f64, 0.2 / n as f64);
            close("V-22", &format!("{what} 1:{ratio}: long bar over v"), long, 1.0 / ratio, 0.005);
            between("V-22", &format!("{what}: drift of momentum"), momentum_drift(&hit), 0.0, 1e-12);
        }
    }
}

/// V-23: steel on aluminium: 7.424 m/s and −102.06 MPa behind both waves.
#[test]
fn v23_bars_of_unequal_impedance() {
    let aluminium = "ELASTIC, 2700.\nYOUNGS MODULUS = 70.E9\nPOISSONS RATIO = 0.\nEND\n";
    for (bar, (what, ..)) in BARS.iter().enumerate() {
        let (hit, mesh) = two_bars(bar, [1.0, 1.0], [200, 200], 10.0, "1.5E-4", Some(aluminium));
        // Between the interface and the fronts, 0.76 m away.
        let inside = |y: f64| (y - 1.0).abs() > 0.1 && (y - 1.0).abs() < 0.5;
        let average = |values: Vec<f64>| values.iter().sum::<f64>() / values.len() as f64;
        let nodes = mesh.coordinates.iter().zip(hit.end().nodal("VELY")).filter(|(x, _)| inside(x[1]));
        close(
            "V-23",
            &format!("{what}: interface velocity [m/s]"),
            average(nodes.map(|(_, v)| *v).collect()),
            7.424,
            0.01,
        );
        let centre = |nodes: &[u32]| nodes.iter().map(|&n| mesh.coordinates[n as usize][1]).sum::<f64>() / 4.0;
        let elements = mesh.elements().zip(hit.end().element("SIGYY")).filter(|((_, nodes), _)| inside(centre(nodes)));
        close("V-23", &format!("{what}: stress [Pa]"), average(elements.map(|(_, s)| *s).collect()), -102.06e6, 0.01);
        between("V-23", &format!("{what}: drift of momentum"), momentum_drift(&hit), 0.0, 1e-12);
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

/// A square that begins in the middle of another: as in space, what is deeper than half an element is refused with place and depth,
/// and told where the deck keeps it. Its four corners are in elements of the other, 1.5 below the nearest edge.
#[test]
fn overlaps_too_deep_to_be_taken_out_are_refused() {
    let mesh = recipe("RECTANGLE, 1, 0., 0., 4., 4., 4, 4\nRECTANGLE, 2, 1.5, 1.5, 1., 1., 1, 1\n");
    for analysis in ["AXISYMMETRIC", "PLANE STRAIN"] {
        let deck = rods(analysis, "CONTACT MATERIAL\n");
        let overlap = Body::new(&mesh, &model(&deck, &mesh)).expect("materials").overlap;
        assert_eq!(overlap.deep.nodes, 4, "{analysis}");
        close("deep", "depth", overlap.deep.deepest, 1.5, 1e-12);
        let refusal = overlap.refusal(&mesh).expect("a refusal");
        assert!(refusal.contains("4 nodes") && refusal.contains("1.5000e0 below"), "{refusal}");
        let kept = deck.replace("CONTACT MATERIAL\n", "CONTACT MATERIAL\nCONTACT OVERLAP, KEEP\n");
        let body = Body::new(&mesh, &model(&kept, &mesh)).expect("materials");
        let told = of_overlaps(&mesh, &body).iter().map(|found| found.words()).collect::<String>();
        assert!(told.starts_with("4 nodes of contact surfaces begin deep"), "{told}");
    }
}
