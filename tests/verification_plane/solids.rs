//! Two dimensions: plane strain and bodies of revolution against known answers, and the same bits wherever they are computed.

use crate::support::continued::{Case, assert_same};
use crate::support::meshes::recipe;
use crate::support::run::{Run, run, run_on};
use crate::support::{between, close};
use urto::solver::Body;

fn text(path: &str) -> String {
    std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a file")
}

/// The worst error of the balance over the largest work of the load: at the start there is hardly any energy to compare with.
fn imbalance(run: &Run) -> f64 {
    let most = run.lines.iter().map(|line| line.totals.external.abs()).fold(0.0, f64::max);
    run.lines.iter().map(|line| line.totals.imbalance(0.0).abs() / most).fold(0.0, f64::max)
}

/// Largest value of a nodal variable at a node over the plot states, and its time.
fn peak(run: &Run, name: &str, node: usize) -> (f64, f64) {
    let values = run.states.iter().map(|state| (state.nodal(name)[node], state.time));
    values.fold((0.0, 0.0), |most, one| if one.0 > most.0 { one } else { most })
}

const HOLLOW: &str = "TERMINATION TIME, 5.\nOUTPUT TIME, 0.05\nPLOT TIME, 0.01\nPLOT NODAL, DISPLACEMENT\n\
                      FUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESSURE, 100, 1, 1.E-3\n\
                      MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.3\nEND\n";

/// a thick cylinder under a pressure that is suddenly there, as a ring in plane strain and as a slice of a tube: inner and
/// outer wall swing to 3.6903e-3 at 4.208 and 2.4966e-3 at 4.69 (the wave equation in one dimension, solved separately).
#[test]
fn q2_thick_cylinder() {
    let tube = recipe(
        "RECTANGLE, 1, 1., 0., 1., 0.03, 100, 3\nNODE SET PLANE, 1, Y, 0.\nNODE SET PLANE, 1, Y, 0.03\nSIDE SET FACE, 100, 1, LEFT\n",
    );
    let deck = format!("TITLE\n tube\nAXISYMMETRIC\nNO DISPLACEMENT, Y, 1\n{HOLLOW}");
    let swing = run(&deck, &tube);
    let ((inner, when), (outer, later)) = (peak(&swing, "DISPLX", 0), peak(&swing, "DISPLX", 100));
    close("Q-2", "tube, inner wall", inner, 3.6903e-3, 5e-3);
    close("Q-2", "tube, its time", when, 4.208, 1e-2);
    close("Q-2", "tube, outer wall", outer, 2.4966e-3, 5e-3);
    close("Q-2", "tube, its time", later, 4.69, 1e-2);
    between("Q-2", "tube, energy balance", imbalance(&swing), 0.0, 1e-6);
    // The references are of the linear wave equation. A wall that moves by 0.4 % of its radius is off by about as much; a thousandth
    // of the pressure leaves what the mesh makes.
    let small = run(&deck.replace("1.E-3", "1.E-6"), &tube);
    close("Q-2", "tube, little pressure, inner wall", peak(&small, "DISPLX", 0).0, 3.6903e-6, 1e-3);
    close("Q-2", "tube, little pressure, outer wall", peak(&small, "DISPLX", 100).0, 2.4966e-6, 1e-3);
    let ring = recipe(
        "RING, 1, 1., 2., 30, 48, 0., 90.\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, Y, 0.\nSIDE SET FACE, 100, 1, INNER\n",
    );
    let deck = format!("TITLE\n ring\nPLANE STRAIN\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 2\n{HOLLOW}");
    let swing = run(&deck, &ring);
    let at =
        |x: f64| ring.coordinates.iter().position(|c| (c[0] - x).abs() < 1e-9 && c[1].abs() < 1e-9).expect("a node");
    close("Q-2", "ring, inner wall", peak(&swing, "DISPLX", at(1.0)).0, 3.6903e-3, 5e-3);
    close("Q-2", "ring, outer wall", peak(&swing, "DISPLX", at(2.0)).0, 2.4966e-3, 5e-3);
    between("Q-2", "ring, energy balance", imbalance(&swing), 0.0, 1e-6);
}

/// A pressure that comes so slowly, over many periods, that the walls move as in equilibrium: u_a = 1.90667e-3 of the cylinder (Lamé
/// in plane strain) and 8.0e-4 of the sphere.
#[test]
fn q2_and_q3_walls_in_equilibrium() {
    let ramp: String = (0..=40)
        .map(|i| {
            let s = f64::from(i) / 40.0;
            format!("{:e}, {:e}\n", 80.0 * s, s * s * s * (10.0 - s * (15.0 - 6.0 * s)))
        })
        .collect();
    // So small that the linear answer is the exact one.
    let slow = HOLLOW
        .replace("1.E-3", "1.E-6")
        .replace("0., 1.\n1., 1.\n", &ramp)
        .replace("TIME, 5.", "TIME, 80.")
        .replace("0.01\n", "1.\n");
    let held = "NO DISPLACEMENT, Y, 1\n";
    for (n, near) in [(10, 2e-3), (20, 5e-4)] {
        let tube = recipe(&format!(
            "RECTANGLE, 1, 1., 0., 1., 0.1, {n}, 1\nNODE SET PLANE, 1, Y, 0.\nNODE SET PLANE, 1, Y, 0.1\nSIDE SET FACE, 100, 1, LEFT\n"
        ));
        let moved = run(&format!("TITLE\n tube\nAXISYMMETRIC\n{held}{slow}"), &tube);
        close("Q-2", &format!("{n} elements, inner wall at rest"), moved.end().nodal("DISPLX")[0], 1.906_67e-6, near);
    }
    for (n, near) in [(10, 2.5e-2), (20, 8e-3)] {
        let sphere = recipe(&format!(
            "RING, 1, 1., 2., {n}, {n}, 0., 90.\nNODE SET PLANE, 1, Y, 0.\nSIDE SET FACE, 100, 1, INNER\n"
        ));
        let moved = run(&format!("TITLE\n sphere\nAXISYMMETRIC\n{held}{slow}"), &sphere);
        let (u, v) = (moved.end().nodal("DISPLX"), moved.end().nodal("DISPLY"));
        let inner = (0..u.len()).filter(|&n| {
            let [x, y, _] = sphere.coordinates[n];
            (libm::hypot(x, y) - 1.0).abs() < 1e-9
        });
        for node in inner {
            close("Q-3", &format!("{n} elements, inner wall at rest"), libm::hypot(u[node], v[node]), 8e-7, near);
        }
    }
}

/// V-06, Blake's spherical cavity of radius 1 m under a step of 1 MPa, as a body of revolution. Its wall moves most, 12.590 µm,
/// at 0.3310 ms, a point at 2 m 4.284 µm at 0.4050 ms. Nothing comes back from outside before the end.
#[test]
fn q7_spherical_cavity() {
    let mesh =
        recipe("RING, 1, 1., 3.4, 60, 24, 0., 90., 2.\nNODE SET PLANE, 1, Y, 0.\nSIDE SET FACE, 100, 1, INNER\n");
    let deck = "TITLE\n cavity\nAXISYMMETRIC\nTERMINATION TIME, 4.6E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-6\n\
                PLOT NODAL, DISPLACEMENT\nNO DISPLACEMENT, Y, 1\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESSURE, 100, 1, 1.E6\n\
                MATERIAL, 1, ELASTIC, 2000.\nYOUNGS MODULUS = 62.5E9\nPOISSONS RATIO = 0.25\nEND\n";
    let cavity = run(deck, &mesh);
    let nearest = |x: f64, y: f64| {
        let far = |n: &usize| libm::hypot(mesh.coordinates[*n][0] - x, mesh.coordinates[*n][1] - y);
        (0..mesh.coordinates.len()).min_by(|a, b| far(a).total_cmp(&far(b))).expect("nodes")
    };
    // On the plane of symmetry, on the axis, and half way.
    let s = 0.5f64.sqrt();
    for [x, y] in [[1.0, 0.0], [0.0, 1.0], [s, s]] {
        let (nodes, radii) = ([nearest(x, y), nearest(2.0 * x, 2.0 * y)], [12.590e-6, 4.284e-6]);
        let times = [3.310e-4, 4.050e-4];
        for (k, node) in nodes.into_iter().enumerate() {
            let [at_x, at_y, _] = mesh.coordinates[node];
            let radius = libm::hypot(at_x, at_y);
            let outwards = |state: &crate::support::run::State| {
                (state.nodal("DISPLX")[node] * at_x + state.nodal("DISPLY")[node] * at_y) / radius
            };
            let moved = cavity.states.iter().map(|state| (outwards(state), state.time));
            let (most, when) = moved.fold((0.0, 0.0), |most, one| if one.0 > most.0 { one } else { most });
            // Of nodes beside 2 m, by u ~ 1/r there.
            let to = if k == 0 { 1.0 } else { radius / 2.0 };
            close("Q-7", &format!("largest displacement at {radius:.3} m [m]"), most * to, radii[k], 1.5e-2);
            close("Q-7", "its time [s]", when, times[k], 2e-2);
        }
    }
    between("Q-7", "energy balance", imbalance(&cavity), 0.0, 1e-5);
}

/// a body of distorted elements falls along the axis and feels nothing but its weight.
#[test]
fn q9_a_body_falls_along_the_axis() {
    let mesh = recipe("RECTANGLE, 1, 0., 0., 0.1, 0.1, 6, 6\nPERTURB, 0.2\n");
    let deck = "TITLE\n fall\nAXISYMMETRIC\nTERMINATION TIME, 1.E-3\nPLOT TIME, 1.E-4\nPLOT NODAL, VELOCITY\n\
                PLOT ELEMENT, STRESS\nGRAVITY, 0., -9.81\nINITIAL VELOCITY MATERIAL, 1, 0., -100.\n\
                MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";
    let fall = run(deck, &mesh);
    let end = fall.end();
    for (u, v) in end.nodal("VELX").iter().zip(end.nodal("VELY")) {
        assert!(u.abs() < 1e-9 && (v + 100.0 + 9.81 * end.time).abs() < 1e-9, "{u:e} {v}");
    }
    // 1e-12 of the modulus.
    assert!(end.element("SIGXX").iter().chain(end.element("SIGYY")).all(|s| s.abs() < 0.2), "no stress");
    let weight = fall.last().totals;
    close(
        "Q-9",
        "work of gravity over the change of energy",
        weight.external / (weight.kinetic - fall.initial_energy),
        1.0,
        1e-9,
    );
}

/// the same of a hollow sphere: 1.4618e-3 at 2.488 and 6.802e-4 at 2.98.
#[test]
fn q3_hollow_sphere() {
    let sphere = recipe("RING, 1, 1., 2., 40, 40, 0., 90.\nNODE SET PLANE, 2, Y, 0.\nSIDE SET FACE, 100, 1, INNER\n");
    let deck =
        format!("TITLE\n sphere\nAXISYMMETRIC\nNO DISPLACEMENT, Y, 2\n{HOLLOW}").replace("TIME, 5.", "TIME, 3.2");
    let swing = run(&deck, &sphere);
    let nodes: Vec<usize> = (0..sphere.coordinates.len())
        .filter(|&n| (libm::hypot(sphere.coordinates[n][0], sphere.coordinates[n][1]) - 1.0).abs() < 1e-9)
        .collect();
    let state = swing.at(2.488);
    let (x, y) = (state.nodal("DISPLX"), state.nodal("DISPLY"));
    let moved: Vec<f64> = nodes.iter().map(|&n| libm::hypot(x[n], y[n])).collect();
    let mean = moved.iter().sum::<f64>() / moved.len() as f64;
    let spread = moved.iter().fold(0.0, |most: f64, u| most.max((u - mean).abs())) / mean;
    close("Q-3", "inner wall, mean", mean, 1.4618e-3, 1e-2);
    between("Q-3", "spread over angles", spread, 0.0, 0.02);
    // The pressure is there at once: the front rings, and steps follow the elements that it squeezes.
    between("Q-3", "energy balance", imbalance(&swing), 0.0, 5e-6);
}

/// the copper bar as a body of revolution; V-15 gives its length and its foot.
#[test]
fn q5_taylor_bar() {
    let mesh = recipe(&text("meshes/taylor_bar_axisymmetric.mesh").replace("16, 160", "10, 100"));
    let bar = run(&text("decks/taylor_bar_axisymmetric.i"), &mesh);
    let end = bar.end();
    let (u, v) = (end.nodal("DISPLX"), end.nodal("DISPLY"));
    let at = |x: f64, y: f64| {
        let near = |c: &[f64; 3]| (c[0] - x).abs() < 1e-9 && (c[1] - y).abs() < 1e-9;
        mesh.coordinates.iter().position(near).expect("a node")
    };
    let mass = Body::new(&mesh, &bar.model).expect("materials").block_masses(1)[0];
    close("Q-5", "mass of the whole turn, π R² L ρ", mass, 9.307784e-3, 1e-6);
    close("Q-5", "length [m]", 32.4e-3 + v[at(0.0, 32.4e-3)], 21.42e-3, 5e-3);
    between("Q-5", "radius of the foot [m]", 3.2e-3 + u[at(3.2e-3, 0.0)], 7.1e-3, 7.25e-3);
    between("Q-5", "energy balance", bar.worst_balance(), 0.0, 1e-4);
}

/// V-11 in the plane: Timoshenko's beam.
#[test]
fn v11_bending_beam_in_the_plane() {
    let mesh = recipe(&text("meshes/bending_beam_plane.mesh"));
    let beam = run(&text("decks/bending_beam_plane.i").replace("PLOT TIME, 2.5E-4", "PLOT TIME, 2.E-5"), &mesh);
    let middle = mesh.coordinates.iter().position(|c| c[0] == 0.0 && (c[1] - 0.5).abs() < 1e-9).expect("a node");
    let down = beam.states.iter().map(|state| (-state.nodal("DISPLY")[middle], state.time));
    let (deflection, when) = down.fold((0.0, 0.0), |most, one| if one.0 > most.0 { one } else { most });
    close("V-11", "deflection in the plane [in]", deflection, 4.722e-3, 1e-2);
    close("V-11", "its time [s]", when, 4.254e-3, 1e-2);
    between("V-11", "energy balance", beam.worst_balance(), 0.0, 1e-9);
}

/// fundamental periods of a solid sphere and of a long cylinder of steel, radius 50 mm, that were at rest and thrown outwards:
/// 20.090 and 25.235 µs.
#[test]
fn q8_solid_sphere_and_cylinder() {
    for (what, analysis, period) in [("sphere", "AXISYMMETRIC", 20.090e-6), ("cylinder", "PLANE STRAIN", 25.235e-6)] {
        q8(what, analysis, period);
    }
}

fn q8(what: &str, analysis: &str, reference: f64) {
    let sphere = recipe("DISC, 1, 0.05, 12, QUARTER\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, Y, 0.\n");
    let deck = format!(
        "TITLE\n swings\n{analysis}\nTERMINATION TIME, 60.E-6\nPLOT TIME, 1.E-7\nPLOT NODAL, VELOCITY, MASS\n\
         BULK VISCOSITY, 0., 0.\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 2\nINITIAL VELOCITY RADIAL, 1, 1.E-3\n\
         MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n"
    );
    let ring = run(&deck, &sphere);
    // Work of the radial mode: the sum of radial velocities over all nodes; its turns are half periods.
    let mean = |state: &crate::support::run::State| -> f64 {
        let (u, v) = (state.nodal("VELX"), state.nodal("VELY"));
        sphere.coordinates.iter().enumerate().map(|(n, c)| u[n] * c[0] + v[n] * c[1]).sum()
    };
    let signs: Vec<(f64, f64)> = ring.states.iter().map(|state| (state.time, mean(state))).collect();
    let turns: Vec<f64> = signs
        .windows(2)
        .filter(|pair| pair[0].1 * pair[1].1 < 0.0)
        .map(|pair| pair[0].0 + (pair[1].0 - pair[0].0) * pair[0].1 / (pair[0].1 - pair[1].1))
        .collect();
    let period = 2.0 * (turns[turns.len() - 1] - turns[0]) / (turns.len() - 1) as f64;
    close("Q-8", &format!("{what}, period [s]"), period, reference, 5e-3);
    between("Q-8", "energy balance", ring.worst_balance(), 0.0, 1e-6);
}

const BLOCKS: &str = "TITLE\n blocks\nTERMINATION TIME, 3.E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 5.E-5\n\
                      PLOT NODAL, DISPLACEMENT, VELOCITY, REACTION\nPLOT ELEMENT, STRESS, STRAIN, ENERGY\nPLOT STATE, EQPS\n\
                      RIGID SURFACE, 300, 0., 0., 0., 1., 0.1\nGRAVITY, 0., -9.81\nINITIAL VELOCITY MATERIAL, 1, 0., -60.\n\
                      INITIAL VELOCITY MATERIAL, 2, 0., -60.\nSILENT BC, 400\nDEATH, 2, EQPS, MAX, 0.05\n\
                      FUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESSURE, 200, 1, 1.E6\n\
                      MATERIAL, 1, ELASTIC PLASTIC, 7850.\nYOUNGS MODULUS = 2.E11\nPOISSONS RATIO = 0.3\nYIELD STRESS = 4.E8\n\
                      HARDENING MODULUS = 1.E9\nBETA = 1.\nEND\n\
                      MATERIAL, 2, ELASTIC PLASTIC, 2700.\nYOUNGS MODULUS = 7.E10\nPOISSONS RATIO = 0.33\nYIELD STRESS = 2.E8\n\
                      HARDENING MODULUS = 5.E8\nBETA = 0.\nEND\n";

const BLOCKS_MESH: &str = "RECTANGLE, 1, 0., 0.05, 0.1, 0.1, 8, 8\nRECTANGLE, 2, 0., 0., 0.1, 0.05, 8, 4\nMERGE\n\
                           SIDE SET FACE, 300, 2, FRONT\nSIDE SET FACE, 200, 1, RIGHT\nSIDE SET FACE, 400, 1, BACK\n";

/// Files, logs and energies do not know how many ranks there are: every load, DEATH, a rigid line.
#[test]
fn the_same_bits_on_any_ranks() {
    let mesh = recipe(BLOCKS_MESH);
    for analysis in ["AXISYMMETRIC\n", "PLANE STRAIN\n"] {
        let deck = format!("{BLOCKS}{analysis}");
        let one = run(&deck, &mesh);
        assert!(one.end().element("EQPS").iter().any(|eqps| *eqps > 0.0));
        for ranks in [2, 3, 7] {
            let many = run_on(ranks, &deck, &mesh).whole();
            assert_eq!(many.lines.len(), one.lines.len());
            for (a, b) in one.lines.iter().zip(&many.lines) {
                assert_eq!((a.step, a.time.to_bits(), a.totals), (b.step, b.time.to_bits(), b.totals), "{ranks} ranks");
            }
            for name in ["DISPLX", "DISPLY", "RX", "RY"] {
                assert_eq!(one.end().nodal(name), many.end().nodal(name), "{ranks} ranks: {name}");
            }
            assert_eq!(one.end().element("SIGZZ"), many.end().element("SIGZZ"), "{ranks} ranks");
        }
    }
}

/// A continued run has the bits of one that was never stopped.
#[test]
fn restarts_have_the_same_bits() {
    let case = Case::new(&format!("{BLOCKS}AXISYMMETRIC\n"), recipe(BLOCKS_MESH));
    let whole = case.part(1, None, 160);
    let first = case.part(2, None, 100);
    let continued = case.part(3, Some(&first.end), 60);
    assert_same("blocks", &whole, &continued);
}
