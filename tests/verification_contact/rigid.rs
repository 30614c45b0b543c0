//! RIGID BODY: six unknowns against closed forms, in contact, joined with what deforms, and bit for bit on any ranks.
//!
//! `cargo test --test verification_contact rigid:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::continued::{Case, assert_same};
use crate::support::flow::alone;
use crate::support::meshes::{add_node_set, add_side_set, brick, recipe};
use crate::support::run::{Run, model, run, run_on};
use crate::support::{between, close};
use std::f64::consts::{FRAC_PI_2, PI};
use urto::comm::Serial;
use urto::mesh::Mesh;
use urto::output::HistoryPlan;
use urto::solver::{Request, idle_rotations};

pub const STEEL: &str = "MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";

/// Complete elliptic integral of the first kind of the modulus k, by the arithmetic-geometric mean.
fn elliptic(k: f64) -> f64 {
    let (mut a, mut g) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..30 {
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
    }
    FRAC_PI_2 / a
}

/// Times at which a value that is sampled passes zero.
fn zeros(samples: &[(f64, f64)]) -> Vec<f64> {
    let pairs = samples.windows(2).filter(|pair| pair[0].1 * pair[1].1 < 0.0);
    pairs.map(|pair| pair[0].0 - pair[0].1 * (pair[1].0 - pair[0].0) / (pair[1].1 - pair[0].1)).collect()
}

fn displacement(run: &Run, node: usize, axis: usize) -> Vec<(f64, f64)> {
    let name = ["DISPLX", "DISPLY", "DISPLZ"][axis];
    run.states.iter().map(|state| (state.time, state.nodal(name)[node])).collect()
}

/// A box that turns about its middle axis turns over again and again (Dzhanibekov 1985). Between two flips passes half a period of
/// Euler's equations, 2 K(k)/Ω: Landau and Lifshitz, Mechanics, §37.
#[test]
fn dzhanibekovs_flip() {
    let sides = [1.0, 2.0, 3.0];
    let mesh = brick([2, 2, 2], sides);
    let (omega, part) = (10.0, 1e-3);
    let run_of = |dt: f64| {
        run(
            &format!(
                "TERMINATION TIME, 80.\nOUTPUT TIME, 0.05\nPLOT TIME, 0.01\nRIGID BODY, 1\nTIME STEP MAXIMUM, {dt}\n\
                 INITIAL VELOCITY ANGULAR, 1, {omega}, 0.5, 1., 1.5, 0., 1., 0.\n\
                 INITIAL VELOCITY ANGULAR, 1, {}, 0.5, 1., 1.5, 0., 0., 1.\n{STEEL}",
                part * omega
            ),
            &mesh,
        )
    };
    // I over m/12, ascending: about z, y, x.
    let [a, b, c] = sides.map(|s| s * s);
    let [i1, i2, i3] = [a + b, a + c, b + c];
    let spin = [part * omega, omega, 0.0];
    let energy2 = i1 * spin[0] * spin[0] + i2 * spin[1] * spin[1] + i3 * spin[2] * spin[2];
    let momentum2 = (i1 * spin[0]).powi(2) + (i2 * spin[1]).powi(2) + (i3 * spin[2]).powi(2);
    // Which of the outer axes the momentum circles decides the form.
    let (low, high) = if momentum2 > energy2 * i2 { (i1, i3) } else { (i3, i1) };
    let rate2 = (high - i2) * (momentum2 - energy2 * low) / (i1 * i2 * i3);
    let modulus2 = (i2 - low) * (energy2 * high - momentum2) / ((high - i2) * (momentum2 - energy2 * low));
    let half_period = 2.0 * elliptic(modulus2.sqrt()) / rate2.sqrt();
    let flips = |run: &Run| {
        // The body's middle axis, seen along that in space, changes its sign.
        let y = |axis: usize, node: usize| displacement(run, node, axis);
        let ends = [[0.5, 0.0, 1.5], [0.5, 2.0, 1.5]]
            .map(|at| mesh.coordinates.iter().position(|x| *x == at).expect("a node in the middle of a side"));
        let along: Vec<(f64, f64)> =
            y(1, ends[0]).iter().zip(&y(1, ends[1])).map(|(a, b)| (a.0, 2.0 + b.1 - a.1)).collect();
        zeros(&along)
    };
    let mut errors = Vec::new();
    // The first is made in four parts each, the others are one.
    for dt in [4e-3, 1.2e-3, 6e-4] {
        let run = run_of(dt);
        let times = flips(&run);
        assert!(times.len() >= 20, "{} flips", times.len());
        let mean = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
        let kinetic: Vec<f64> = run.lines.iter().map(|line| line.totals.kinetic).collect();
        let worst = kinetic.iter().fold(0.0f64, |worst, k| worst.max((k / kinetic[0] - 1.0).abs()));
        println!("flip with steps of {dt}: {} flips, mean {mean:.6} s of {half_period:.6} s", times.len());
        between("Dzhanibekov's flip", "energy, largest error", worst, 0.0, 1e-12);
        between("Dzhanibekov's flip", "worst balance", run.worst_balance(), 0.0, 1e-12);
        errors.push((mean / half_period - 1.0).abs());
    }
    between("Dzhanibekov's flip", "period, error with the longest step", errors[0], 0.0, 5e-5);
    between("Dzhanibekov's flip", "ratio of errors with a step and half of it", errors[1] / errors[2], 3.0, 5.0);
}

/// A plate on a hinge, let go at 60 degrees: T = 4 √(I/(m g l)) K(sin 30°).
#[test]
fn a_rigid_pendulum() {
    let (long, wide) = (0.5, 0.1);
    let mut mesh = brick([10, 2, 2], [long, wide, wide]);
    // The hinge runs along y through the end.
    add_node_set(&mut mesh, 50, |x| x[0] == 0.0 && x[2] == 0.05);
    let angle: f64 = 60f64.to_radians();
    // It begins along x; gravity points 60 degrees aside of it.
    let g = [9.81 * angle.cos(), 0.0, -9.81 * angle.sin()];
    let arm = 0.5 * long;
    let inertia = (long * long + wide * wide) / 12.0 + arm * arm;
    let expected = 4.0 * (inertia / (9.81 * arm)).sqrt() * elliptic((0.5 * angle).sin());
    let run = run(
        &format!(
            "TERMINATION TIME, 12.\nOUTPUT TIME, 0.1\nPLOT TIME, 0.005\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-3\n\
             GRAVITY, {}, 0., {}\nNO DISPLACEMENT, X, 50\nNO DISPLACEMENT, Y, 50\nNO DISPLACEMENT, Z, 50\n{STEEL}",
            g[0], g[2]
        ),
        &mesh,
    );
    let node = mesh.coordinates.iter().position(|x| *x == [long, 0.0, 0.05]).expect("the end of the plate");
    let pivot = mesh.coordinates.iter().position(|x| *x == [0.0, 0.0, 0.05]).expect("the hinge");
    // The angle off the vertical, from the displacement of the end.
    let swing: Vec<(f64, f64)> = displacement(&run, node, 0)
        .iter()
        .zip(&displacement(&run, node, 2))
        .map(|(x, z)| (x.0, (z.1 * angle.cos() + (long + x.1) * angle.sin())))
        .collect();
    let times = zeros(&swing);
    let period = 2.0 * (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    close("rigid pendulum", "period, s", period, expected, 1e-5);
    let held = displacement(&run, pivot, 0).iter().fold(0.0f64, |worst, (_, x)| worst.max(x.abs()));
    between("rigid pendulum", "motion of the hinge, m", held, 0.0, 1e-14);
    between("rigid pendulum", "worst balance", run.worst_balance(), 0.0, 2e-5);
}

fn ball(n: usize) -> Mesh {
    recipe(&format!("TITLE\n BALL\nSPHERE, 1, 0.1, {n}, FULL, 2\nSIDE SET FACE, 100, 1, OUTER\n"))
}

/// A ball on an incline with friction that holds: 5/7 g sin α, and no more than its friction with too little of it.
#[test]
fn a_ball_rolls_down() {
    let angle: f64 = 20f64.to_radians();
    let (gx, gz) = (9.81 * angle.sin(), 9.81 * angle.cos());
    let far = |mesh: &Mesh, friction: f64| {
        let run = run(
            &format!(
                "TERMINATION TIME, 0.2\nOUTPUT TIME, 0.01\nPLOT TIME, 0.01\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-4\n\
                 GRAVITY, {gx}, 0., {}\nRIGID SURFACE, 100, 0., 0., -0.1, 0., 0., 1., {friction}\n{STEEL}",
                -gz
            ),
            mesh,
        );
        let last = run.last();
        // Where facets land, friction may give what the normal force takes more of.
        let gap = run.lines.iter().map(|line| line.totals.relative_gap(0.0).abs()).fold(0.0, f64::max);
        between("ball", "worst gap of the balance", gap, 0.0, 1e-9);
        between("ball", "energy that contact makes", last.totals.contact_gain, 0.0, 1e-12);
        let end = run.end();
        // The mean of the nodes' displacements is that of the centre by symmetry.
        let u = end.nodal("DISPLX");
        (u.iter().sum::<f64>() / u.len() as f64, end.time)
    };
    let mut errors = Vec::new();
    for n in [4, 8] {
        let (x, t) = far(&ball(n), 1.0);
        let expected = 0.5 * (5.0 / 7.0) * gx * t * t;
        println!("ball of {} facets around: {x:.6} m of {expected:.6} m", 8 * n);
        errors.push((x / expected - 1.0).abs());
    }
    between("ball, 64 facets around", "distance rolled, error", errors[1], 0.0, 0.03);
    let (x, t) = far(&ball(8), 0.05);
    close("ball that slips", "distance, m", x, 0.5 * (gx - 0.05 * gz) * t * t, 0.03);
}

/// An elastic bar hits a free rigid block: momentum is shared, and what the bar keeps is its vibration.
#[test]
fn a_bar_hits_a_rigid_block() {
    let mesh = recipe(
        "TITLE\n BAR AND BLOCK\nBOX, 1, 0., 0., 0., 1., 0.1, 0.1, 50, 2, 2\n\
         BOX, 2, 1.0001, -0.05, -0.05, 0.2, 0.2, 0.2, 3, 3, 3\n",
    );
    let deck = "TERMINATION TIME, 6.E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-5\nPLOT NODAL, VELOCITY\nRIGID BODY, 2\nCONTACT MATERIAL, 1, 2\n\
         INITIAL VELOCITY MATERIAL, 1, 5., 0., 0.\n\
         MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\n\
         MATERIAL, 2, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\n";
    let run = run(deck, &mesh);
    let node = mesh.coordinates.len() - 1;
    let [bar, block] = [7850.0 * 0.01, 7850.0 * 0.2 * 0.04];
    // The front stays in contact for one transit there and back: the block is pushed by Z A (v − V), V' = 2 Z A ... of an exponential.
    let c = (200e9f64 / 7850.0).sqrt();
    let rate = 7850.0 * c * 0.01 / block;
    let expected = 5.0 * (1.0 - (-rate * 2.0 / c).exp());
    close("bar on a rigid block", "velocity of the block, m/s", run.end().nodal("VELX")[node], expected, 0.02);
    let last = run.last();
    close("bar on a rigid block", "momentum", last.totals.momentum[0], bar * 5.0, 1e-12);
    between("bar on a rigid block", "worst balance", run.worst_balance(), 0.0, 1e-3);
    between("bar on a rigid block", "energy that contact makes", last.totals.contact_gain, 0.0, 1e-9);
    let spin = last.totals.momentum[1].abs() + last.totals.momentum[2].abs();
    between("bar on a rigid block", "momentum aside", spin, 0.0, 1e-9 * bar * 5.0);
}

/// A bar with a rigid mass at its free end: the first period of ξ tan ξ = m/M.
#[test]
fn a_mass_on_a_bar() {
    let mut mesh = recipe(
        "TITLE\n BAR WITH MASS\nBOX, 1, 0., 0., 0., 1., 0.1, 0.1, 40, 2, 2\n\
         BOX, 2, 1., 0., 0., 0.1, 0.1, 0.1, 4, 2, 2\nMERGE, 1, 2\n",
    );
    add_node_set(&mut mesh, 1, |x| x[0] == 0.0);
    let deck = "TERMINATION TIME, 6.E-3\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-5\nRIGID BODY, 2\nBULK VISCOSITY, 0., 0.\n\
         NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nINITIAL VELOCITY MATERIAL, 2, 0.1, 0., 0.\n\
         MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\n\
         MATERIAL, 2, ELASTIC, 78500.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\n";
    let run = run(deck, &mesh);
    let node = mesh.coordinates.iter().position(|x| x[0] > 1.09).expect("an end");
    let times = zeros(&displacement(&run, node, 0));
    let period = 2.0 * (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    // m = M.
    let mut xi = 0.8f64;
    for _ in 0..50 {
        xi -= (xi * xi.tan() - 1.0) / (xi.tan() + xi / xi.cos().powi(2));
    }
    let c = (200e9f64 / 7850.0).sqrt();
    close("mass on a bar", "period, s", period, 2.0 * PI / (xi * c), 0.01);
    between("mass on a bar", "worst balance", run.worst_balance(), 0.0, 2e-4);
}

/// Blocks of rigid bodies as histories see them: together they have the energy of the log, and a body its closed form,
/// since what turns has the inertia of volumes.
#[test]
fn energies_of_rigid_blocks() {
    let mesh = recipe(
        "TITLE\n TWO\nBOX, 1, 0., 0., 0., 1., 2., 1., 1, 1, 1\nBOX, 2, 0., 0., 1., 1., 2., 2., 1, 1, 1\nMERGE, 1, 2\n\
         BOX, 3, 5., 0., 0., 1., 1., 1., 1, 1, 1\n",
    );
    let law = |block: i32| STEEL.replace("MATERIAL, 1", &format!("MATERIAL, {block}"));
    let (spin, speed) = (10.0, 3.0);
    let deck = format!(
        "TERMINATION TIME, 0.1\nOUTPUT TIME, 0.01\nPLOT TIME, 0.01\nRIGID BODY, 1, 2\nRIGID BODY, 3\nTIME STEP MAXIMUM, 1.E-3\n\
         INITIAL VELOCITY MATERIAL, 1, {speed}, 0., 0.\nINITIAL VELOCITY MATERIAL, 2, {speed}, 0., 0.\n\
         INITIAL VELOCITY ANGULAR, 1, {spin}, 0.5, 1., 1.5, 0., 1., 0.\n\
         INITIAL VELOCITY ANGULAR, 2, {spin}, 0.5, 1., 1.5, 0., 1., 0.\n\
         INITIAL VELOCITY ANGULAR, 3, {spin}, 5.5, 0.5, 0.5, 1., 1., 0.\n{}{}{}",
        law(1),
        law(2),
        law(3)
    );
    let run = run(&deck, &mesh);
    let (mass, cube) = (7850.0 * 6.0, 7850.0);
    // m (a² + c²)/12 of the long box about y, m/6 of a cube about any axis.
    let long = 0.5 * mass * (speed * speed + spin * spin * (1.0 + 9.0) / 12.0);
    let expected = [long, 0.5 * cube * spin * spin / 6.0];
    for line in &run.lines {
        let found = &line.block_kinetic;
        for (body, (found, expected)) in [found[0] + found[1], found[2]].into_iter().zip(expected).enumerate() {
            between("rigid blocks", &format!("body {}, error", body + 1), (found / expected - 1.0).abs(), 0.0, 1e-12);
        }
        let all: f64 = found.iter().sum();
        between("rigid blocks", "log, error", (all / line.totals.kinetic - 1.0).abs(), 0.0, 1e-13);
    }
}

/// Two rigid blocks, one on springs of what deforms, that hit each other on a plane with friction.
fn busy() -> (String, Mesh) {
    let mut mesh = recipe(
        "TITLE\n BUSY\nBOX, 1, 0., 0., 0., 1., 1., 1., 4, 4, 4\nBOX, 2, 0., 0., 1., 1., 1., 0.4, 4, 4, 2\nMERGE, 1, 2\n\
         BOX, 3, 0.2, 0.3, 1.45, 0.6, 0.6, 0.45, 3, 3, 3\n",
    );
    add_side_set(&mut mesh, 100, |x| x[2] == 0.0);
    let law =
        |block: i32| format!("MATERIAL, {block}, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E7\nPOISSONS RATIO = 0.3\nEND\n");
    let deck = format!(
        "TERMINATION TIME, 0.2\nOUTPUT TIME, 0.01\nPLOT TIME, 0.05\nPLOT NODAL, DISPLACEMENT, VELOCITY, ACCELERATION, REACTION, CONTACT\n\
         PLOT ELEMENT, STRESS, DENSITY\nRIGID BODY, 2\nRIGID BODY, 3\nGRAVITY, 0., 0., -10.\nCONTACT MATERIAL, ALL\n\
         CONTACT DATA, 2, 3, 0.3\nRIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.5\n\
         INITIAL VELOCITY MATERIAL, 3, 0.5, 0., -3.\nINITIAL VELOCITY ANGULAR, 3, 2., 0.5, 0.6, 1.6, 1., 0.3, 0.2\n{}{}{}",
        law(1),
        law(2),
        law(3)
    );
    (deck, mesh)
}

#[test]
fn the_same_bits_on_any_ranks_and_after_a_restart() {
    let (deck, mesh) = busy();
    let case = Case::new(&deck, mesh.clone());
    let whole = case.part(1, None, 300);
    for ranks in [2, 3] {
        assert_same("ranks", &whole, &case.part(ranks, None, 300));
    }
    let first = case.part(2, None, 120);
    assert_same("restart", &whole, &case.part(3, Some(&first.end), 180));
    let run = run_on(2, &deck, &mesh).whole();
    between("two rigid blocks", "worst balance", run.worst_balance(), 0.0, 2e-3);
    between("two rigid blocks", "energy that contact makes", run.last().totals.contact_gain, 0.0, 1e-9);
}

/// Planes alone: all ranks must see all nodes of a body.
#[test]
fn a_ball_has_the_same_bits_on_any_ranks() {
    let mesh = ball(4);
    let deck = format!(
        "TERMINATION TIME, 0.2\nOUTPUT TIME, 0.01\nPLOT TIME, 0.01\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-4\n\
         GRAVITY, 3., 0., -9.\nRIGID SURFACE, 100, 0., 0., -0.1, 0., 0., 1., 0.4\n{STEEL}"
    );
    let case = Case::new(&deck, mesh);
    let whole = case.part(1, None, 400);
    assert_same("ranks", &whole, &case.part(3, None, 400));
    let first = case.part(3, None, 200);
    assert_same("restart", &whole, &case.part(2, Some(&first.end), 200));
}

/// A sheet, half of it rigid and half elastic, that spins: nodes in common turn with the body.
#[test]
fn a_rigid_sheet() {
    let sheet = |more: &str| recipe(&format!("TITLE\n SHEET\nSHEET, 1, 0., 0., 0., 1., 2., 0., 4, 8\n{more}"));
    let law = |block: i32| {
        format!(
            "SHELL THICKNESS, {block}, 0.1\nMATERIAL, {block}, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E7\nPOISSONS RATIO = 0.3\nEND\n"
        )
    };
    let head = "TERMINATION TIME, 0.5\nOUTPUT TIME, 0.05\nPLOT TIME, 0.05\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-3\n";
    let spin = "INITIAL VELOCITY ANGULAR, 1, 3., 0.5, 1., 0., 1., 0., 0.\n";
    let run_of = run(&format!("{head}{spin}{}", law(1)), &sheet(""));
    // m (b² + t²)/12 about its short axis.
    let expected = 0.5 * 200.0 * (4.0 + 0.01) / 12.0 * 9.0;
    close("rigid sheet", "kinetic energy", run_of.last().totals.kinetic, expected, 1e-12);
    let mesh = sheet("SHEET, 2, 1., 0., 0., 1., 2., 0., 4, 8\nMERGE, 1, 2\n");
    let turned = "INITIAL VELOCITY ANGULAR, 2, 3., 0.5, 1., 0., 1., 0., 0.\n";
    let both = run(&format!("{head}{spin}{turned}{}{}", law(1), law(2)), &mesh);
    between("half a rigid sheet", "worst balance", both.worst_balance(), 0.0, 1e-3);
    let case = Case::new(&format!("{head}{spin}{turned}{}{}", law(1), law(2)), mesh);
    let whole = case.part(1, None, 60);
    assert_same("ranks", &whole, &case.part(3, None, 60));
    assert_same("restart", &whole, &case.part(2, Some(&case.part(3, None, 25).end), 35));
}

/// Beams on a line that begin to turn about it, or about an axis askew: ½ ω·I ω of the rod, m r²/2 about its line and
/// m (L²/12 + r²/4) across it, and of the inertia at one node. A rod thinner than its stiffened inertia turns as it is told to as well.
#[test]
fn a_rigid_rod_begins_to_turn_about_its_line() {
    let along = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    let mesh = recipe(
        "TITLE\n ROD\nLINE, 1, 0., 0., 0., 1., 2., 2., 6\nNODE SET POINT, 1, 1., 2., 2.\nNODE SET BLOCK, 2, 1\n",
    );
    let (length, inertia, rate) = (3.0, 0.5, 10.0);
    for (radius, axis) in [(0.2, along), (0.2, [0.0, 0.6, 0.8]), (5e-4, along)] {
        let [x, y, z] = axis;
        let run = run(
            &format!(
                "TERMINATION TIME, 0.01\nOUTPUT TIME, 0.001\nPLOT TIME, 0.001\nPLOT NODAL, ROTATION RATE\nRIGID BODY, 1\n\
                 TIME STEP MAXIMUM, 1.E-4\nBEAM SECTION, 1, ROD, {radius}\nPOINT MASS, 1, 0., {}\n\
                 INITIAL VELOCITY ANGULAR, 1, {rate}, 0.5, 1., 1., {x}, {y}, {z}\nMATERIAL, 1, ELASTIC, 1.\n\
                 YOUNGS MODULUS = 1.E4\nPOISSONS RATIO = 0.3\nEND\n",
                if radius < 0.1 { 0.0 } else { inertia }
            ),
            &mesh,
        );
        let first = &run.states[0];
        for (name, along) in ["ROTVELX", "ROTVELY", "ROTVELZ"].into_iter().zip(axis) {
            let worst = first.nodal(name).iter().fold(0.0f64, |worst, found| worst.max((found - rate * along).abs()));
            between("rigid rod", &format!("{name}, error"), worst / rate, 0.0, 1e-9);
        }
        if radius < 0.1 {
            continue;
        }
        let mass = PI * radius * radius * length;
        let cosine: f64 = along.iter().zip(axis).map(|(a, b)| a * b).sum();
        let (own, across) = (0.5 * mass * radius * radius, mass * (length * length / 12.0 + 0.25 * radius * radius));
        let turning = own * cosine * cosine + across * (1.0 - cosine * cosine) + inertia;
        for line in &run.lines {
            let expected = 0.5 * turning * rate * rate;
            between("rigid rod", "energy, error", (line.totals.kinetic / expected - 1.0).abs(), 0.0, 1e-12);
        }
    }
}

/// A cube of hexahedra, whose nodes have no rotation: a rotary inertia at a node is one of the body, I = m/6 + J, and moments on nodes
/// turn it, ω = M t/I, wherever they act.
#[test]
fn inertia_and_moments_at_nodes_of_a_rigid_cube() {
    let mut mesh = brick([2, 2, 2], [1.0, 1.0, 1.0]);
    add_node_set(&mut mesh, 50, |x| x == [1.0, 1.0, 1.0]);
    add_node_set(&mut mesh, 51, |x| x[0] == 0.0 && x[1] == 0.0 && x[2] < 0.9);
    let head = "TERMINATION TIME, 0.1\nOUTPUT TIME, 0.01\nPLOT TIME, 0.01\nTIME STEP MAXIMUM, 1.E-4\n\
        POINT MASS, 50, 0., 8.\nMATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n";
    let inertia = 1.0 / 6.0 + 8.0;
    let spins =
        run(&format!("{head}RIGID BODY, 1\nINITIAL VELOCITY ANGULAR, 1, 1., 0.5, 0.5, 0.5, 1., 2., 2.\n"), &mesh);
    for line in &spins.lines {
        let expected = 0.5 * inertia;
        between("inertia at a node", "energy, error", (line.totals.kinetic / expected - 1.0).abs(), 0.0, 1e-12);
    }
    let moment = "FUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESCRIBED MOMENT, Z, 51, 1, 10.\n";
    let turned = run(&format!("{head}RIGID BODY, 1\n{moment}"), &mesh);
    let last = turned.last();
    // Two of the three nodes on the edge.
    let spin = 2.0 * 10.0 * last.time / inertia;
    close("moment on nodes", "kinetic energy", last.totals.kinetic, 0.5 * inertia * spin * spin, 1e-6);
    between("moment on nodes", "worst balance", turned.worst_balance(), 0.0, 1e-12);
    let case = Case::new(&format!("{head}RIGID BODY, 1\n{moment}"), mesh.clone());
    let whole = case.part(1, None, 200);
    assert_same("moment on nodes, after a restart", &whole, &case.part(2, Some(&case.part(3, None, 120).end), 80));
    // What deforms has nodes that cannot turn.
    let idle = |deck: &str| idle_rotations(&mesh, &model(deck, &mesh));
    assert_eq!(idle(&format!("{head}RIGID BODY, 1\n{moment}")), Vec::<i64>::new());
    assert_eq!(idle(&format!("{head}{moment}")), [50, 51]);
    assert_eq!(idle(&head.replace("0., 8.", "8.")), Vec::<i64>::new());
}

/// The first state is the initial condition: a cube that is driven, or loaded, begins at rest, or with the spin that it is given.
#[test]
fn histories_begin_with_the_initial_spin() {
    let mut mesh = brick([1, 1, 1], [1.0, 1.0, 1.0]);
    add_node_set(&mut mesh, 50, |x| x == [1.0, 1.0, 1.0]);
    let (rate, spin, moment) = (0.7, 2.0, 10.0);
    let head = "TERMINATION TIME, 0.1\nTIME STEP MAXIMUM, 1.E-3\nHISTORY BLOCK, 1\nRIGID BODY, 1\nFUNCTION, 1\n0., 1.\n1., 1.\nEND\n\
        MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n";
    let driven = format!("PRESCRIBED ANGULAR VELOCITY, Z, 50, 1, {rate}\n");
    let loaded = format!("INITIAL VELOCITY ANGULAR, 1, {spin}, 0.5, 0.5, 0.5\nPRESCRIBED MOMENT, Z, 50, 1, {moment}\n");
    // M/I of a cube with a mass of 1, over a step and half of the first kick.
    let later = spin + 6.0 * moment * 1e-3;
    for (more, first, second) in [(driven, 0.0, rate), (loaded, spin, later)] {
        let model = model(&format!("{head}{more}"), &mesh);
        let mut solver = alone(&mesh, &model);
        for expected in [first, second] {
            solver.prepare(Request::Continue, &mut Serial).expect("a state");
            let plan = HistoryPlan::new(&mesh, &model, &solver);
            let values = plan.values(&mut solver, &mut Serial, false).expect("values");
            let names = plan.names();
            let of = |name: &str| values[names.iter().position(|other| other == name).expect("a name")];
            // The angle of a step is prescribed, and its sine is in the momentum.
            let most = if solver.step == 0 { 1e-14 } else { 1e-6 };
            between("first state", "spin, error", (of("ROTZ_BLOCK1") - expected).abs(), 0.0, most);
            // Between the velocities half a step before and after, of which the mean is the spin.
            let half = if expected == later { 6.0 * moment * 0.5e-3 } else { 0.0 };
            let energy = (expected * expected - half * half) / 12.0;
            between("first state", "energy of the block, error", (of("KE_BLOCK1") - energy).abs(), 0.0, most);
            let whole = solver.totals(&mut Serial).kinetic;
            between("first state", "energy, error", (whole - energy).abs(), 0.0, most);
            solver.advance();
        }
    }
}
