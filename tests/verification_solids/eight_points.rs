//! Hexahedra with eight points: bending, patches, rigid motion, plastic moments, the stable step.
//!
//! `cargo test --test verification_solids eight_points:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::continued::{Case, assert_same};
use crate::support::meshes::{add_node_set, box_of_cells, brick, nodes_where, recipe};
use crate::support::run::{model, run, run_on};
use crate::support::stiffness::{end_shear, held_at_root, solve, stiffness};
use crate::support::{at_least, between, close};
use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3};
use urto::comm::Serial;
use urto::mesh::Mesh;
use urto::model::Model;
use urto::partition::Decomposition;
use urto::solver::{Body, Request, Solver, unfit_blocks};

const YOUNG: f64 = 1000.0;

fn elastic(poisson: f64, formulation: &str) -> String {
    format!(
        "TERMINATION TIME, 1.\nBULK VISCOSITY, 0., 0.\n{formulation}\n\
         MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = {YOUNG}\nPOISSONS RATIO = {poisson}\nEND\n"
    )
}

const EIGHT: &str = "ELEMENT, 1, EIGHT POINTS";

/// In boxes the stress of the points integrates to the stiffness that assumed strain gives one point, to round-off.
#[test]
fn boxes_are_as_stiff_as_with_assumed_strain() {
    for (cells, size) in [([1, 1, 1], [1.0, 1.0, 1.0]), ([2, 1, 1], [3.0, 0.5, 0.1]), ([2, 2, 1], [1.0, 0.2, 2.0])] {
        for poisson in [0.0, 0.3, 0.49] {
            let mesh = box_of_cells(cells, size);
            let one = stiffness(&elastic(poisson, ""), &mesh);
            let eight = stiffness(&elastic(poisson, EIGHT), &mesh);
            let apart = (&one - &eight).amax() / one.amax();
            assert!(apart < 1e-11, "{cells:?} {size:?}, nu {poisson}: {apart:e}");
        }
    }
}

fn cantilever(cells: [usize; 3], poisson: f64, plane_strain: bool) -> f64 {
    let length = 10.0;
    let mesh = box_of_cells(cells, [length, 1.0, 1.0]);
    let matrix = stiffness(&elastic(poisson, EIGHT), &mesh);
    let asymmetry = (&matrix - matrix.transpose()).amax() / matrix.amax();
    assert!(asymmetry < 1e-12, "K has no potential: {asymmetry:e}");
    let force = end_shear(&mesh, length, cells);
    let u = solve(&matrix, &force, |node, axis| held_at_root(&mesh, node, axis) || (plane_strain && axis == 2));
    let bending = if plane_strain { YOUNG / (1.0 - poisson * poisson) } else { YOUNG };
    let timoshenko = length.powi(3) / (3.0 * bending / 12.0) + length / (5.0 / 6.0 * YOUNG / (2.0 * (1.0 + poisson)));
    force.dot(&u) / timoshenko
}

#[test]
fn v12_cantilever_with_eight_points() {
    for (cells, ratio) in [[10, 1, 1], [10, 2, 2], [20, 4, 4]].into_iter().zip([0.996, 0.994, 0.997]) {
        close(
            "V-12 eight points",
            &format!("{cells:?}, tip over Timoshenko"),
            cantilever(cells, 0.3, false),
            ratio,
            0.005,
        );
    }
    for poisson in [0.499, 0.4999] {
        let case = format!("plane strain, nu {poisson}, tip over Timoshenko");
        close("V-12 eight points", &case, cantilever([10, 1, 1], poisson, true), 0.996, 0.005);
    }
}

#[test]
fn v11_vibrating_beam_with_eight_points() {
    let deck = include_str!("../../decks/bending_beam_4.i").replace("TITLE", &format!("{EIGHT}\nTITLE"));
    let mesh = recipe(include_str!("../../meshes/bending_beam_2.mesh"));
    let run = run(&deck, &mesh);
    between("V-11 eight points", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    let middle = nodes_where(&mesh, |p| p[0] == 0.0 && (p[2] - 0.5).abs() < 1e-9)[0] as usize;
    let history = run.states.iter().map(|s| (s.time, -s.nodal("DISPLZ")[middle]));
    let peak = history.max_by(|a, b| a.1.total_cmp(&b.1)).expect("states");
    close("V-11 eight points, 2 elements", "peak [in]", peak.1, 4.722e-3, 0.01);
    close("V-11 eight points, 2 elements", "time of peak [s]", peak.0, 4.254e-3, 0.01);
}

#[test]
fn v15_taylor_bar_with_eight_points() {
    let mesh = recipe(&include_str!("../../meshes/taylor_bar.mesh").replace("8, 160, QUARTER", "3, 30, QUARTER"));
    let deck = include_str!("../../decks/taylor_bar.i").replace("TITLE", &format!("{EIGHT}\nTITLE"));
    let run = run_on(2, &deck, &mesh).whole();
    between("V-15 eight points, n=3", "worst energy balance", run.worst_balance(), 0.0, 1e-3);
    let positions = run.end().positions(&mesh);
    let top = positions.iter().fold(0.0f64, |most, p| most.max(p[2]));
    let foot = positions.iter().zip(&mesh.coordinates).filter(|(_, x)| x[2] == 0.0);
    let radius = foot.fold(0.0f64, |most, (p, _)| most.max(p[0].hypot(p[1])));
    close("V-15 eight points, n=3", "length [mm]", 1e3 * top, 21.42, 0.01);
    close("V-15 eight points, n=3", "foot radius [mm]", 1e3 * radius, 7.22, 0.05);
}

/// A solver whose nodes are moved by hand.
struct Hand {
    solver: Solver,
    order: Vec<usize>,
}

impl Hand {
    fn new(mesh: &Mesh, model: &Model) -> Hand {
        let body = Body::new(mesh, model).expect("materials");
        let cut = body.cut(1);
        let contributors = body.contributors(&cut);
        let decomposition = Decomposition::new(&contributors, mesh.coordinates.len(), 1);
        let mut solver = Solver::new(mesh, model, &body, &decomposition.share(0), &mut Serial);
        solver.prepare(Request::Continue, &mut Serial).expect("the body at rest is sound");
        let file = &solver.domain.nodes.file;
        let order = (0..mesh.coordinates.len())
            .map(|node| file.iter().position(|&f| f as usize == node).expect("every node is used"))
            .collect();
        Hand { solver, order }
    }

    /// Takes a step to these positions.
    fn step_to(&mut self, to: impl Fn(usize) -> [f64; 3]) {
        let nodes = &mut self.solver.domain.nodes;
        nodes.forces.fill(Default::default());
        for (file, &node) in self.order.iter().enumerate() {
            let (row, there) = (&mut nodes.rows[node].0, to(file));
            (0..3).for_each(|i| row[4 + i] = (there[i] - row[i]) / self.solver.time_step);
        }
        self.solver.advance();
        // A body that is moved by hand gains energy out of nothing, which ends runs; forces and stresses are there all the same.
        let _ = self.solver.prepare(Request::Continue, &mut Serial);
    }

    /// Stress of all points in space.
    fn stresses(&self) -> Vec<Matrix3<f64>> {
        let nodes = &self.solver.domain.nodes;
        let block = &self.solver.domain.blocks[0];
        let mut found = Vec::new();
        for i in 0..block.interior.len() {
            let frame = block.element.frame(&block.interior, i, nodes);
            for point in 0..block.element.points() {
                let m = block.element.point_stress(&block.interior, i, point).rotate(&frame).matrix();
                found.push(Matrix3::from_fn(|i, j| m[i][j]));
            }
        }
        found
    }

    fn force(&self, file: usize) -> Vector3<f64> {
        Vector3::from(self.solver.domain.nodes.force(self.order[file] as u32))
    }
}

/// A cube of 3 x 3 x 3 elements whose inner nodes are moved about.
fn irregular() -> Mesh {
    let mut mesh = box_of_cells([3, 3, 3], [3.0, 3.0, 3.0]);
    for (n, x) in mesh.coordinates.iter_mut().enumerate() {
        let shift = |k: usize| 0.25 * ((7.3 * n as f64 + 2.1 * k as f64).sin());
        if x.iter().all(|x| (0.5..2.5).contains(x)) {
            (0..3).for_each(|i| x[i] += shift(i));
        }
    }
    mesh
}

#[test]
fn a_patch_strains_uniformly() {
    let mesh = irregular();
    for poisson in [0.3, 0.499] {
        let mut hand = Hand::new(&mesh, &model(&elastic(poisson, EIGHT), &mesh));
        let small = 1e-7;
        let gradient = Matrix3::new(1.0, 0.4, -0.3, 0.2, -0.5, 0.7, 0.1, -0.6, 0.3) * small;
        hand.step_to(|n| (Vector3::from(mesh.coordinates[n]) + gradient * Vector3::from(mesh.coordinates[n])).into());
        let strain = 0.5 * (gradient + gradient.transpose());
        let mu = YOUNG / (2.0 * (1.0 + poisson));
        let lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);
        let exact = strain * (2.0 * mu) + Matrix3::identity() * (lambda * strain.trace());
        let worst = hand.stresses().iter().fold(0.0f64, |most, s| most.max((s - exact).amax()));
        between("patch of 27, eight points", "stress astray, relative", worst / exact.amax(), 0.0, 3e-7);
        let inner = nodes_where(&mesh, |x| x.iter().all(|x| (0.3..2.7).contains(x)));
        let worst = inner.iter().fold(0.0f64, |most, &n| most.max(hand.force(n as usize).amax()));
        between("patch of 27, eight points", "force on inner nodes, relative", worst / exact.amax(), 0.0, 1e-8);
    }
}

#[test]
fn rigid_rotation_strains_nothing() {
    let mesh = irregular();
    let mut hand = Hand::new(&mesh, &model(&elastic(0.3, EIGHT), &mesh));
    let axis = Vector3::new(0.3, -0.5, 0.8).normalize();
    for step in 1..=200 {
        let turn = Rotation3::from_scaled_axis(axis * (0.3 * step as f64));
        hand.step_to(|n| (turn * Vector3::from(mesh.coordinates[n])).into());
    }
    let worst = hand.stresses().iter().fold(0.0f64, |most, s| most.max(s.amax()));
    between("60 radians of rigid rotation, eight points", "stress over Young's modulus", worst / YOUNG, 0.0, 1e-12);
}

/// Simple shear in axes that turn with it: the spin is that of the middle of the step, and errors fall with its square.
#[test]
fn simple_shear_with_a_spin_converges_at_second_order() {
    let mesh = box_of_cells([1, 1, 1], [1.0, 1.0, 1.0]);
    let model = model(&elastic(0.25, EIGHT), &mesh);
    let mu = YOUNG / 2.5;
    let (gamma, angle) = (5.0f64, 3.0);
    let beta = (0.5 * gamma).atan();
    let exact = 2.0 * ((2.0 * beta).cos() * (2.0 * beta - beta.tan()) - 2.0 * (2.0 * beta).sin() * beta.cos().ln());
    let error = |steps: usize| {
        let mut hand = Hand::new(&mesh, &model);
        let mut turn = Rotation3::identity();
        for step in 1..=steps {
            let part = step as f64 / steps as f64;
            turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle * part);
            hand.step_to(|n| {
                let [x, y, z] = mesh.coordinates[n];
                (turn * Vector3::new(x + gamma * part * y, y, z)).into()
            });
        }
        let turn = turn.into_inner();
        let stress = turn.transpose() * hand.stresses()[0] * turn;
        (stress[(0, 1)] / mu / exact - 1.0).abs()
    };
    let [coarse, middle, fine] = [200, 400, 800].map(error);
    println!("simple shear with a spin, eight points: errors {coarse:.2e}, {middle:.2e}, {fine:.2e}");
    close("simple shear with a spin, eight points", "order", (middle / fine).log2(), 2.0, 0.1);
    between("simple shear with a spin, eight points", "error in 400 steps", middle, 0.0, 1e-3);
}

/// A strip one element thick, bent far into flow: the moment of two points through the thickness is 2/√3 of Y b t²/4.
#[test]
fn one_element_carries_the_plastic_moment() {
    let mut mesh = box_of_cells([6, 1, 1], [6.0, 1.0, 1.0]);
    for (id, x, z) in [(1, 0.0, 0.0), (2, 0.0, 1.0), (3, 6.0, 0.0), (4, 6.0, 1.0)] {
        add_node_set(&mut mesh, id, |p| p[0] == x && p[2] == z);
    }
    add_node_set(&mut mesh, 5, |p| p[0] == 0.0);
    let deck = format!(
        "TITLE\n a strip\nTERMINATION TIME, 4.\nOUTPUT TIME, 0.1\nPLOT TIME, 0.02\nPLOT NODAL, DISPLACEMENT, REACTION\n{EIGHT}\n\
             FUNCTION, 1\n0., 0.\n{{loop(20, i)}}\n{{4. * (i + 1) / 20}}, {{(1. - cosd(9. * (i + 1))) / 2.}}\n{{endloop}}\nEND\n\
             PRESCRIBED DISPLACEMENT, X, 1, 1, 0.06\nPRESCRIBED DISPLACEMENT, X, 2, 1, -0.06\n\
             PRESCRIBED DISPLACEMENT, X, 3, 1, -0.06\nPRESCRIBED DISPLACEMENT, X, 4, 1, 0.06\n\
             MATERIAL, 1, ELASTIC PLASTIC, 1.E-2\nYOUNGS MODULUS = 1000.\nPOISSONS RATIO = 0.3\nYIELD STRESS = 2.\n\
             HARDENING MODULUS = 0.\nBETA = 1.\nEND\nEXIT\n"
    );
    let run = run(&deck, &mesh);
    between("plastic bending", "energy balance at the end", run.last().balance.abs(), 0.0, 1e-3);
    let moment = |state: &crate::support::run::State| {
        let ends = nodes_where(&mesh, |p| p[0] == 0.0);
        let forces = state.nodal("RX");
        ends.iter().map(|&n| forces[n as usize] * (mesh.coordinates[n as usize][2] - 0.5)).sum::<f64>().abs()
    };
    // Waves run through what remains elastic: the mean over the second half of the time.
    let late: Vec<f64> = run.states.iter().filter(|state| (2.0..3.4).contains(&state.time)).map(moment).collect();
    let mean = late.iter().sum::<f64>() / late.len() as f64;
    close("plastic bending, eight points", "moment over Y b t^2/4", mean / 0.5, 2.0 / 3.0f64.sqrt(), 0.02);
}

/// The exact step of warped, flat and needle-shaped elements alone against the one that they ask for.
#[test]
fn the_stable_step_of_warped_elements() {
    let mut worst = f64::INFINITY;
    for shape in 0..24u32 {
        let mut mesh = box_of_cells([1, 1, 1], [1.0, 1.0, 1.0]);
        let form = [[1.0, 1.0, 1.0], [1.0, 1.0, 0.1], [1.0, 0.05, 0.05]][shape as usize % 3];
        for (n, x) in mesh.coordinates.iter_mut().enumerate() {
            let by = |k: usize| 0.2 * ((13.7 * f64::from(shape) + 5.1 * n as f64 + 1.9 * k as f64).sin());
            *x = [0, 1, 2].map(|i| form[i] * (x[i] + by(i)));
        }
        let poisson = [0.0, 0.3, 0.49][shape as usize / 3 % 3];
        let deck = elastic(poisson, EIGHT);
        let matrix = stiffness(&deck, &mesh);
        let hand = Hand::new(&mesh, &model(&deck, &mesh));
        let mass = hand.solver.domain.nodes.mass(0);
        let symmetric: DMatrix<f64> = (&matrix + matrix.transpose()) * (0.5 / mass);
        let exact = 2.0 / symmetric.symmetric_eigenvalues().max().sqrt();
        worst = worst.min(exact / hand.solver.stable_step);
    }
    at_least("eight points, 24 warped elements", "exact step over the bound", worst, 0.98);
}

/// Plastic points, points that DEATH takes, elements that go: the same bits on any ranks and after a restart.
#[test]
fn the_same_bits_on_any_ranks_and_after_restarts() {
    let deck = format!(
        "TITLE\n a bar against a wall\nTERMINATION TIME, 2.E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-4\n{EIGHT}\n\
         PLOT NODAL, DISPLACEMENT\nPLOT ELEMENT, STRESS\nPLOT STATE, EQPS\nNO DISPLACEMENT, X, 1\n\
         INITIAL VELOCITY MATERIAL, 1, -200., 30., 0.\nDEATH, 1, EQPS, MAX, 0.15, FREE, 0.5\n\
         MATERIAL, 1, ELASTIC PLASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nYIELD STRESS = 300.E6\n\
         HARDENING MODULUS = 1.E9\nBETA = 0.5\nEND\nEXIT\n"
    );
    let mesh = brick([6, 2, 2], [0.06, 0.02, 0.02]);
    let lines = |ranks| {
        let run = run_on(ranks, &deck, &mesh).whole();
        assert!(run.last().totals.eroded > 0.0, "nothing died");
        run.lines.iter().map(|line| (line.step, line.totals)).collect::<Vec<_>>()
    };
    assert_eq!(lines(1), lines(3));
    let case = Case::new(&deck, mesh.clone());
    let first = case.part(1, None, 60);
    assert_same("eight points", &case.part(2, None, 120), &case.part(3, Some(&first.end), 60));
}

#[test]
fn blocks_that_cannot_have_eight_points_are_refused() {
    let mesh = box_of_cells([1, 1, 1], [1.0, 1.0, 1.0]);
    let text = |deck: &str, mesh: &Mesh| {
        unfit_blocks(mesh, &model(deck, mesh)).iter().map(|(_, u)| u.reason.clone()).collect::<String>()
    };
    assert!(text(&elastic(0.3, EIGHT), &mesh).is_empty());
    let foam = "TERMINATION TIME, 1.\nELEMENT, 1, EIGHT POINTS\nMATERIAL, 1, MOONEY RIVLIN, 1.\nC10 = 1.\nC01 = 0.5\nBULK MODULUS = 100.\nEND\n";
    assert!(text(foam, &mesh).contains("looks at the volume"), "{}", text(foam, &mesh));
    let sheet = recipe("TITLE\n a sheet\nSHEET, 1, 0., 0., 0., 0.1, 0.05, 0., 4, 2\n");
    let deck = elastic(0.3, "SHELL THICKNESS, 1, 0.01\nELEMENT, 1, EIGHT POINTS");
    assert!(text(&deck, &sheet).contains("EIGHT POINTS"), "{}", text(&deck, &sheet));
}

/// A cantilever one element deep that creeps by 1E-8 is elastic: points that flow however little counted as flowing in full, with ν = 1/2 across,
/// and the tip came down by 12 % less.
#[test]
fn what_hardly_flows_bends_as_what_is_elastic() {
    let mesh = recipe(
        "TITLE\n cantilever\nBOX, 1, 0., 0., 0., 0.2, 0.02, 0.02, 10, 1, 1\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, X, 0.2\n",
    );
    let deflection = |law: &str| {
        let deck = format!(
            "TERMINATION TIME, 6.E-3\nPLOT TIME, 5.E-5\nPLOT NODAL, DISPLACEMENT\n{EIGHT}\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n\
             NO DISPLACEMENT, Z, 1\nFUNCTION, 1\n0., 0.\n3.E-3, 1.\n6.E-3, 1.\nEND\nPRESCRIBED FORCE, Z, 2, 1, 500.\n{law}END\n"
        );
        let run = run(&deck, &mesh).whole();
        let tip = |z: &[f64]| z.iter().fold(0.0f64, |most, z| most.max(z.abs()));
        run.states.iter().map(|state| tip(state.nodal("DISPLZ"))).fold(0.0, f64::max)
    };
    let moduli = "7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\n";
    let elastic = deflection(&format!("MATERIAL, 1, ELASTIC, {moduli}"));
    let viscoplastic =
        format!("MATERIAL, 1, VISCOPLASTIC, {moduli}YIELD STRESS = 1.E6\nHARDENING MODULUS = 0.\nP = 1.\n");
    for gamma in ["1.E-20", "1.E-6"] {
        let ratio = deflection(&format!("{viscoplastic}GAMMA = {gamma}\n")) / elastic;
        close(&format!("creep {gamma}"), "deflection over elastic", ratio, 1.0, 1e-3);
    }
    // Hardening 10⁴ times as stiff as elasticity leaves a ten-thousandth to flow.
    let hardening = deflection(&format!(
        "MATERIAL, 1, ELASTIC PLASTIC, {moduli}YIELD STRESS = 1.E6\nHARDENING MODULUS = 2.E15\nBETA = 1.\n"
    ));
    close("stiff hardening", "deflection over elastic", hardening / elastic, 1.0, 2e-3);
}
