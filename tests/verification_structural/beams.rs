//! Beams: frequencies, shear along both axes of an I, joints with solids, a strip rolled up, a plastic hinge, a beam that spins; masses at nodes; a frame with a roof.

use crate::support::meshes::recipe;
use crate::support::run::{Run, run, run_on};
use crate::support::{between, close};

fn text(path: &str) -> String {
    std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a file")
}

/// A beam of n elements along x, 1 m long: node set 1 is its beginning, 2 its end, 3 its middle, 4 all of it.
fn beam(n: usize) -> urto::mesh::Mesh {
    recipe(&format!(
        "TITLE\n beam\nLINE, 1, 0., 0., 0., 1., 0., 0., {n}\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 1.\n\
         NODE SET PLANE, 3, X, 0.5\nNODE SET PLANE, 4, Y, 0.\n"
    ))
}

const CLAMPED: &str = "NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nNO ROTATION, X, 1\nNO ROTATION, Y, 1\nNO ROTATION, Z, 1\n";
const PLANE: &str = "NO DISPLACEMENT, Y, 4\nNO ROTATION, X, 4\nNO ROTATION, Z, 4\n";
const STEEL: &str = "MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 210.E9\nPOISSONS RATIO = 0.3\nEND\n";

/// Mean frequency of a nodal variable from its zeros, by straight lines between states.
fn frequency(run: &Run, name: &str, node: usize) -> f64 {
    let values: Vec<(f64, f64)> = run.states.iter().map(|state| (state.time, state.nodal(name)[node])).collect();
    let zeros: Vec<f64> = values
        .windows(2)
        .filter(|pair| pair[0].1 < 0.0 && pair[1].1 >= 0.0)
        .map(|pair| pair[0].0 - pair[0].1 * (pair[1].0 - pair[0].0) / (pair[1].1 - pair[0].1))
        .collect();
    (zeros.len() - 1) as f64 / (zeros[zeros.len() - 1] - zeros[0])
}

/// B1: a cantilever of 20 × 20 mm of steel, let go from a small tip velocity field: 16.71 Hz by Bernoulli; 4, 8 and 16 beams give
/// 0.972, 0.992 and 0.998 of it.
#[test]
fn b1_cantilever() {
    for (n, part) in [(4, 0.972), (8, 0.992), (16, 0.998)] {
        let deck = format!(
            "TITLE\n cantilever\nTERMINATION TIME, 0.26\nPLOT TIME, 1.E-3\nPLOT NODAL, DISPLACEMENT\nBEAM SECTION, 1, RECTANGLE, 0.02, 0.02\n\
             {CLAMPED}{STEEL}FUNCTION, 1\n0., 0.\n0.015, 1.\n0.03, 0.\nEND\nPRESCRIBED FORCE, Z, 2, 1, 10.\n"
        );
        let mesh = beam(n);
        let swing = run(&deck, &mesh);
        close(
            "B1",
            &format!("first frequency with {n} beams [Hz]"),
            frequency(&swing, "DISPLZ", n),
            16.71 * part,
            0.006,
        );
        between("B1", "worst energy balance", swing.worst_balance(), 0.0, 1e-6);
    }
}

/// B1: rolled up by an end moment 2πEI/L, in its plane, the end meets the beginning.
#[test]
fn b1_rolled_up() {
    let moment = -2.0 * std::f64::consts::PI * 1e10 * 0.02f64.powi(4) / 12.0;
    let ramp: String =
        (0..=28).map(|i| f64::from(i) / 28.0).map(|g| format!("{}, {}\n", 0.7 * g, g * g * (3.0 - 2.0 * g))).collect();
    let deck = format!(
        "TITLE\n roll\nTERMINATION TIME, 0.8\nPLOT TIME, 0.05\nPLOT NODAL, DISPLACEMENT, ROTATION\nBEAM SECTION, 1, RECTANGLE, 0.02, 0.02, , , 0., 1., 0.\n\
         {CLAMPED}{PLANE}MATERIAL, 1, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E10\nPOISSONS RATIO = 0.\nEND\nFUNCTION, 1\n{ramp}END\n\
         PRESCRIBED MOMENT, Y, 2, 1, {moment}\n"
    );
    let mesh = beam(10);
    let rolled = run(&deck, &mesh);
    let end = rolled.end().positions(&mesh)[10];
    between("B1", "end of the rolled beam from its beginning [m]", (end[0].powi(2) + end[2].powi(2)).sqrt(), 0.0, 0.02);
    close("B1", "rotation of its end", rolled.end().nodal("ROTY")[10], -2.0 * std::f64::consts::PI, 0.01);
    between("B1", "worst energy balance", rolled.worst_balance(), 0.0, 1e-4);
}

/// B3: a beam on two supports, pushed down in its middle: 4 M_p/L = 3200 N, and more by the part that half an element is of half
/// the beam, since moments stand in the middle of elements.
#[test]
fn b3_plastic_hinge() {
    let deck = format!(
        "TITLE\n hinge\nTERMINATION TIME, 0.12\nPLOT TIME, 5.E-4\nPLOT NODAL, DISPLACEMENT, REACTION\nBEAM SECTION, 1, RECTANGLE, 0.02, 0.02\n{PLANE}\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Z, 1\nNO DISPLACEMENT, Z, 2\nFUNCTION, 1\n0., 0.\n0.02, 1.\n1., 1.\nEND\nPRESCRIBED VELOCITY, Z, 3, 1, -0.5\n\
         MATERIAL, 1, ELASTIC PLASTIC, 7850.\nYOUNGS MODULUS = 210.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 400.E6\nHARDENING MODULUS = 0.\nBETA = 1.\nEND\n"
    );
    let mesh = beam(60);
    let bent = run(&deck, &mesh);
    let late: Vec<f64> = bent.states.iter().filter(|s| s.time > 0.08).map(|s| -s.nodal("RZ")[30]).collect();
    let mean = late.iter().sum::<f64>() / late.len() as f64;
    close("B3", "collapse load [N]", mean, 3200.0 * (1.0 + 1.0 / 60.0), 0.01);
}

/// One rod of 10 mm radius, 1 m long, whose one end is held and whose other end moves along it by a velocity over time, and
/// then turns by rates about x and y.
fn pulled(law: &str, velocity: &str, [twist, bend]: [f64; 2], end: f64) -> Run {
    let deck = format!(
        "TITLE\n pulled\nTERMINATION TIME, {end}\nPLOT TIME, {end}\nPLOT ELEMENT, DENSITY, STRETCH, STRESS, STRAIN, RESULTANTS\n\
         PLOT NODAL, REACTION\nTIME STEP MAXIMUM, 2.E-6\nBEAM SECTION, 1, ROD, 0.01, , , , 0., 1., 0.\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 4\nNO DISPLACEMENT, Z, 4\nNO ROTATION, X, 1\nNO ROTATION, Y, 1\n\
         NO ROTATION, Z, 4\nFUNCTION, 1\n{velocity}END\nFUNCTION, 2\n0., 0.\n0.01, 0.\n0.011, 1.\nEND\n\
         PRESCRIBED VELOCITY, X, 2, 1, 1.\nPRESCRIBED ANGULAR VELOCITY, X, 2, 2, {twist}\n\
         PRESCRIBED ANGULAR VELOCITY, Y, 2, 2, {bend}\nMATERIAL, 1, {law}END\n"
    );
    let mesh = recipe(
        "TITLE\n rod\nLINE, 1, 0., 0., 0., 1., 0., 0., 1\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 1.\nNODE SET PLANE, 4, Y, 0.\n",
    );
    run(&deck, &mesh)
}

/// B5: pulled to one and a half times its length, a rod that flows at 400 MPa bears that on the section that it has then: of the strain
/// its elastic part σ/E contracts by ν, the rest by a half.
#[test]
fn b5_a_stretched_beam_gets_thinner() {
    let law = "ELASTIC PLASTIC, 7850.\nYOUNGS MODULUS = 210.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 400.E6\nHARDENING MODULUS = 0.\nBETA = 1.\n";
    let rod = pulled(law, "0., 50.\n1., 50.\n", [0.0, 0.0], 0.01);
    let (strain, elastic) = (f64::ln(1.5), 400e6 / 210e9);
    let across = -0.5 * (strain - elastic) - 0.3 * elastic;
    let area = std::f64::consts::PI * 1e-4 * f64::exp(2.0 * across);
    let end = rod.end();
    close("B5", "stress [Pa]", end.element("SIGXX")[0], 400e6, 1e-4);
    close("B5", "force [N]", end.element("NXX")[0], 400e6 * area, 1e-3);
    close("B5", "reaction [N]", -end.nodal("RX")[0], 400e6 * area, 1e-3);
    close("B5", "density", end.element("DENSITY")[0], 7850.0 * f64::exp(-strain - 2.0 * across), 1e-4);
    close("B5", "stretch across", end.element("STRETYY")[0], f64::exp(across), 1e-4);
    close("B5", "strain across", end.element("EPSZZ")[0], across, 1e-3);
    between("B5", "worst energy balance", rod.worst_balance(), 0.0, 1e-6);
}

/// B5: an elastic rod that has been stretched by a tenth is bent and twisted with the second moments of what it is then, smaller by the
/// fourth power of its contraction.
#[test]
fn b5_a_stretched_beam_bends_with_its_present_section() {
    let law = "ELASTIC, 7850.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.4\n";
    let rod = pulled(law, "0., 0.\n0.001, 11.1111111111\n0.009, 11.1111111111\n0.01, 0.\n1., 0.\n", [1.0, 0.5], 0.0205);
    let wide = f64::exp(-0.4 * f64::ln(1.1));
    let second_moment = 0.25 * std::f64::consts::PI * 1e-8 * wide.powi(4);
    // 0.01 about x and 0.005 about y.
    let end = rod.end();
    close("B5", "length", end.element("STRETXX")[0], 1.1, 1e-3);
    close("B5", "torsion [Nm]", end.element("MXY")[0], 1e9 / 2.8 * 2.0 * second_moment * 0.01 / 1.1, 3e-3);
    close("B5", "bending [Nm]", end.element("MXX")[0], 1e9 * second_moment * 0.005 / 1.1, 3e-3);
    between("B5", "worst energy balance", rod.worst_balance(), 0.0, 1e-6);
}

/// B2: the elastica (Bisshopp and Drucker 1945): deflection and shortening of a cantilever whose end is loaded across, by PL²/EI.
#[test]
fn b2_elastica() {
    let ramp: String =
        (0..=28).map(|i| f64::from(i) / 28.0).map(|g| format!("{}, {}\n", 0.9 * g, g * g * (3.0 - 2.0 * g))).collect();
    for (load, deflection, shortening) in
        [(1.0, 0.30172, 0.05643), (2.0, 0.49346, 0.16064), (5.0, 0.71379, 0.38763), (10.0, 0.81061, 0.55500)]
    {
        let force = load * 1e10 * 0.03f64.powi(4) / 12.0;
        let deck = format!(
            "TITLE\n elastica\nTERMINATION TIME, 1.1\nPLOT TIME, 0.005\nPLOT NODAL, DISPLACEMENT\nBEAM SECTION, 1, RECTANGLE, 0.03, 0.03\n\
             {CLAMPED}{PLANE}MATERIAL, 1, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E10\nPOISSONS RATIO = 0.\nEND\nFUNCTION, 1\n{ramp}2., 1.\nEND\n\
             PRESCRIBED FORCE, Z, 2, 1, {force}\n"
        );
        let mesh = beam(20);
        let bent = run(&deck, &mesh);
        // It still swings a little about where it is at rest.
        let late: Vec<_> = bent.states.iter().filter(|state| state.time > 0.9).collect();
        let mean = |name: &str| late.iter().map(|state| state.nodal(name)[20]).sum::<f64>() / late.len() as f64;
        close("B2", &format!("deflection for PL²/EI = {load}"), mean("DISPLZ"), deflection, 0.01);
        close("B2", &format!("shortening for PL²/EI = {load}"), -mean("DISPLX"), shortening, 0.01);
    }
}

/// Dimensions and axis that the mesh gives make the same beam as those of the deck.
#[test]
fn sections_come_from_the_mesh() {
    let deck = |section: &str| {
        format!(
            "TITLE\n section\nTERMINATION TIME, 0.02\nPLOT TIME, 1.E-3\nPLOT NODAL, DISPLACEMENT\nBEAM SECTION, 1, RECTANGLE{section}\n{CLAMPED}{STEEL}\
             FUNCTION, 1\n0., 0.\n0.01, 1.\nEND\nPRESCRIBED FORCE, Z, 2, 1, 10.\n"
        )
    };
    let mut mesh = beam(4);
    let given = run(&deck(", 0.02, 0.04, , , 0., 1., 1."), &mesh);
    mesh.blocks[0].attributes = [0.02, 0.04, 0.0, 1.0, 1.0].repeat(4);
    let of_mesh = run(&deck(""), &mesh);
    for name in ["DISPLX", "DISPLY", "DISPLZ"] {
        assert!(given.end().nodal(name) == of_mesh.end().nodal(name), "{name}");
    }
    assert!(given.end().nodal("DISPLY")[4] != 0.0, "it bends about an axis that is askew");
    mesh.blocks[0].attributes[5] = 0.03;
    let model = crate::support::run::model(&deck(""), &mesh);
    let refused = urto::solver::elements::Element::of_block(&mesh.blocks[0], &model);
    let why = refused.expect_err("sections that differ").reason;
    assert!(why.contains("not all the same"), "{why}");
}

/// A beam that is clamped and twisted at its end for a moment: √(GJ/ρ(Iy + Iz))/4L with the lumped masses' sin(x)/x, x = π/4n, and slower
/// by the root of the inertia that long elements have, L²S/4(EA − S) over the area's, with S = 1/(1/κGA + L²/12EI).
#[test]
fn torsion_of_long_beams_is_as_slow_as_the_manual_says() {
    let (young, shear) = (210e9, 210e9 / 2.6);
    let radius = 0.03f64;
    let of_rod = std::f64::consts::PI * radius.powi(4) / 4.0;
    let rod = ("ROD, 0.03", std::f64::consts::PI * radius * radius, [of_rod; 2], 2.0 * of_rod, 0.9);
    let (b, h) = (0.04f64, 0.08f64);
    let torsion = h * b.powi(3) * (1.0 / 3.0 - 0.21 * 0.5 * (1.0 - 0.5f64.powi(4) / 12.0));
    let moments = [b * h.powi(3) / 12.0, h * b.powi(3) / 12.0];
    let flat = ("RECTANGLE, 0.04, 0.08, , , 0., 1., 0.", b * h, moments, torsion, 5.0 / 6.0);
    for ((form, area, [iy, iz], torsion, correction), parts) in [(rod, [0.85, 0.94, 1.0]), (flat, [0.71, 0.88, 1.0])] {
        let exact = (shear * torsion / 7850.0 / (iy + iz)).sqrt() / 4.0;
        for (n, part) in [4usize, 8, 16].into_iter().zip(parts) {
            let deck = format!(
                "TITLE\n torsion\nTERMINATION TIME, {}\nPLOT TIME, 2.E-5\nPLOT NODAL, ROTATION\nBEAM SECTION, 1, {form}\n{CLAMPED}{STEEL}\
                 FUNCTION, 1\n0., 0.\n{}, 1.\n{}, 0.\nEND\nPRESCRIBED MOMENT, X, 2, 1, 10.\n",
                20.0 / exact,
                0.5 / exact,
                1.0 / exact
            );
            let found = frequency(&run(&deck, &beam(n)), "ROTX", n);
            let length = 1.0 / n as f64;
            let stiffness = 1.0 / (1.0 / (correction * shear * area) + length * length / (12.0 * young * iy));
            let own = 0.25 * length * length * stiffness / (young * area - stiffness);
            let turned = f64::max(1.0, own * area / (iy + iz));
            let x = std::f64::consts::PI / 4.0 / n as f64;
            let what = format!("first torsional frequency of {n} beams, {form} [Hz]");
            close("torsion", &what, found, exact * x.sin() / x / turned.sqrt(), 0.003);
            close("torsion", &format!("{what} by the manual"), found, part * exact, 0.008);
        }
    }
}

/// B6: a short cantilever of an I, loaded along either axis of its section: PL³/3EI + PL/κGA by Timoshenko, where the web carries the
/// shear along z and the flanges, 5/6 of them, along y. The load rises over some
/// fifteen periods of the beam, and the mean over eight counts.
#[test]
fn b6_an_i_shears_along_both_axes() {
    let ([h, b, f, w], length, force) = ([0.2f64, 0.2f64, 0.02f64, 0.01f64], 0.4f64, 1000.0);
    let web = h - 2.0 * f;
    let along_y = ("Y", (2.0 * f * b.powi(3) + web * w.powi(3)) / 12.0, 5.0 / 6.0 * 2.0 * b * f);
    let along_z = ("Z", (b * h.powi(3) - (b - w) * web.powi(3)) / 12.0, web * w);
    let mesh = recipe(
        "TITLE\n beam\nLINE, 1, 0., 0., 0., 0.4, 0., 0., 8\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 0.4\n",
    );
    for (axis, moment, area) in [along_y, along_z] {
        let deck = format!(
            "TITLE\n shear\nTERMINATION TIME, 0.03\nPLOT TIME, 1.E-4\nPLOT NODAL, DISPLACEMENT\n\
             BEAM SECTION, 1, I, {h}, {b}, {f}, {w}, 0., 1., 0.\n{CLAMPED}{STEEL}\
             FUNCTION, 1\n0., 0.\n0.02, 1.\n0.03, 1.\nEND\nPRESCRIBED FORCE, {axis}, 2, 1, {force}\n"
        );
        let bent = run(&deck, &mesh);
        let late: Vec<_> = bent.states.iter().filter(|state| state.time > 0.02).collect();
        let mean = late.iter().map(|state| state.nodal(&format!("DISPL{axis}"))[8]).sum::<f64>() / late.len() as f64;
        let expected = force * (length.powi(3) / 3.0 / 210e9 / moment + length / (area * 210e9 / 2.6));
        close("B6", &format!("tip of an I along {axis} [m]"), mean, expected, 0.01);
        between("B6", "worst energy balance", bent.worst_balance(), 0.0, 1e-6);
    }
}

/// B7: a beam on one node of a solid block has nothing against turning there, as the warning says: with a force at its tip it turns as
/// a rod does about its end. Where the block is a RIGID BODY it is clamped: PL³/3EI. The load rises for three periods of the clamped beam,
/// which leaves no swinging, and the mean over two counts.
#[test]
fn b7_a_rigid_block_clamps_a_beam_that_a_solid_leaves_hinged() {
    let mesh = recipe(
        "TITLE\n beam\nBOX, 1, -0.4, -0.2, -0.2, 0.4, 0.4, 0.4, 2, 2, 2\nLINE, 2, 0., 0., 0., 1., 0., 0., 10\nMERGE\n\
         NODE SET PLANE, 1, X, -0.4\nNODE SET POINT, 2, 1., 0., 0.\n",
    );
    let law = STEEL.trim_start_matches("MATERIAL, 1,");
    let clamped = 100.0 / 3.0 / 210e9 / (0.04f64.powi(4) / 12.0);
    let deflection = |rigid: &str| {
        let deck = format!(
            "TITLE\n joint\nTERMINATION TIME, 0.15\nPLOT TIME, 5.E-4\nPLOT NODAL, DISPLACEMENT\nBEAM SECTION, 2, RECTANGLE, 0.04, 0.04\n\
             NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n{rigid}{STEEL}MATERIAL, 2,{law}\
             FUNCTION, 1\n0., 0.\n0.09, 1.\n0.15, 1.\nEND\nPRESCRIBED FORCE, Z, 2, 1, -100.\n"
        );
        let bent = run(&deck, &mesh);
        let tip = mesh.distinct_nodes(2)[0] as usize;
        let late: Vec<_> = bent.states.iter().filter(|state| state.time > 0.09).collect();
        -late.iter().map(|state| state.nodal("DISPLZ")[tip]).sum::<f64>() / late.len() as f64
    };
    close("B7", "tip of a beam on a rigid block [m]", deflection("RIGID BODY, 1\n"), clamped, 0.01);
    // Free to turn with ρA/3 under a moment that rises for 0.09 s and stays for the 0.06 s over which the mean is taken.
    let turned = 100.0 / (7850.0 * 0.0016 / 3.0) * (0.0081 / 6.0 + 0.09 * 0.06 / 4.0 + 0.0036 / 6.0);
    close("B7", "tip of a beam on one node of a solid [m]", deflection(""), turned, 0.02);
}

/// A mass at the end of a light beam: it swings as on a spring 3EI/L³.
#[test]
fn a_point_mass_at_the_end_of_a_beam() {
    let (length, inertia) = (1.0f64, 0.02f64.powi(4) / 12.0);
    let deck = format!(
        "TITLE\n mass\nTERMINATION TIME, 1.\nPLOT TIME, 5.E-3\nPLOT NODAL, DISPLACEMENT\nBEAM SECTION, 1, RECTANGLE, 0.02, 0.02\n{CLAMPED}{STEEL}\
         POINT MASS, 2, 4.\nFUNCTION, 1\n0., 0.\n0.02, 1.\n0.04, 0.\nEND\nPRESCRIBED FORCE, Y, 2, 1, 50.\n"
    );
    let swing = run(&deck, &beam(8));
    // 33/140 of the beam's own mass swings with it.
    let mass = 4.0 + 33.0 / 140.0 * 7850.0 * 4e-4;
    let expected = (3.0 * 210e9 * inertia / length.powi(3) / mass).sqrt() / (2.0 * std::f64::consts::PI);
    close("point mass", "frequency [Hz]", frequency(&swing, "DISPLY", 8), expected, 0.01);
}

/// The deck of the frame: posts flow, the roof swings, energy balances; one rank and three give the same bits.
#[test]
fn a_frame_with_a_roof_has_the_same_bits_on_any_ranks() {
    let mesh = recipe(&text("meshes/frame.mesh"));
    let deck = text("decks/frame.i").replace("TERMINATION TIME, 0.6", "TERMINATION TIME, 0.15");
    let runs = [1, 3].map(|ranks| run_on(ranks, &deck, &mesh).whole());
    let [one, three] = &runs;
    between("frame", "worst energy balance", one.worst_balance(), 0.0, 5e-3);
    for (a, b) in one.states.iter().zip(&three.states) {
        for name in ["DISPLX", "DISPLZ", "ROTY"] {
            assert!(a.nodal(name).iter().zip(b.nodal(name)).all(|(x, y)| x.to_bits() == y.to_bits()), "{name}");
        }
        for name in ["SIGXX", "SIGXX_T", "EQPS", "MXX"] {
            assert!(a.element(name).iter().zip(b.element(name)).all(|(x, y)| x.to_bits() == y.to_bits()), "{name}");
        }
    }
}
