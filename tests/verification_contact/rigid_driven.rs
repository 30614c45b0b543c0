//! Rigid bodies that are held, hinged or driven, against closed forms.

use super::rigid::STEEL;
use crate::support::continued::{Case, assert_same};
use crate::support::meshes::{add_node_set, brick, recipe};
use crate::support::run::{run, run_on};
use crate::support::{between, close};
use std::f64::consts::PI;

/// A body of which all six unknowns are driven answers to no contact: what is left of its compliance is round-off, and must not be
/// divided by.
#[test]
fn what_is_driven_altogether_answers_to_no_contact() {
    let mesh = recipe(
        "TITLE\n FALLS\nBOX, 1, 0., 0., 0.1, 1., 1., 1., 2, 2, 2\nNODE SET BLOCK, 1, 1\nSIDE SET BLOCK, 100, 1\n\
         NODE SET POINT, 4, 0., 0., 0.1\nNODE SET POINT, 5, 1., 0., 0.1\n",
    );
    let head = "TERMINATION TIME, 0.1\nOUTPUT TIME, 0.01\nPLOT TIME, 0.1\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-3\n\
        FUNCTION, 1\n 0., 1.\n 1., 1.\nEND\n";
    let through = run(
        &format!(
            "{head}RIGID SURFACE, 100, 0., 0., 0., 0., 0., 1., 0.2\nPRESCRIBED VELOCITY, Z, 1, 1, -4.\n\
             NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n{STEEL}"
        ),
        &mesh,
    );
    assert!(through.stop.is_none());
    // ½ m v²: it goes where it is driven.
    close("driven through a plane", "kinetic energy", through.last().totals.kinetic, 0.5 * 7850.0 * 16.0, 1e-12);
}

/// What is prescribed for nodes moves the body: a block that is turned about a hinge, and one that is pushed along.
#[test]
fn a_driven_body() {
    let mut mesh = brick([2, 2, 2], [1.0, 1.0, 1.0]);
    add_node_set(&mut mesh, 50, |_| true);
    add_node_set(&mut mesh, 51, |x| x[0] == 0.0 && x[1] == 0.0);
    let head = "TERMINATION TIME, 1.\nOUTPUT TIME, 0.1\nPLOT TIME, 0.1\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-3\n\
        FUNCTION, 1\n 0., 0.\n 2., 2.\nEND\n";
    let pushed = run(
        &format!(
            "{head}PRESCRIBED DISPLACEMENT, X, 50, 1, 0.3\nNO DISPLACEMENT, Y, 50\nNO DISPLACEMENT, Z, 50\n{STEEL}"
        ),
        &mesh,
    );
    let worst =
        pushed.end().nodal("DISPLX").iter().fold(0.0f64, |w, u| w.max((u / (0.3 * pushed.end().time) - 1.0).abs()));
    between("driven body", "displacement, error", worst, 0.0, 1e-12);
    between("driven body", "worst balance", pushed.worst_balance(), 0.0, 1e-12);
    let turned = run(
        &format!(
            "{head}PRESCRIBED ANGULAR VELOCITY, Z, 51, 1, 2.\nNO DISPLACEMENT, X, 51\nNO DISPLACEMENT, Y, 51\n\
             NO DISPLACEMENT, Z, 51\n{STEEL}"
        ),
        &mesh,
    );
    let corner = mesh.coordinates.iter().position(|x| *x == [1.0, 0.0, 0.0]).expect("a corner");
    let t = turned.end().time;
    close(
        "body turned",
        "angle",
        turned.end().nodal("DISPLY")[corner].atan2(1.0 + turned.end().nodal("DISPLX")[corner]),
        t * t,
        1e-5,
    );
    // The work is the energy of the spin about the hinge.
    between("body turned", "worst balance", turned.worst_balance(), 0.0, 1e-5);
}

/// Nodes of a plane that contains the direction in which they are held: to first order a body could turn about the line in
/// which the plane meets the others, as all single equations allow; in truth it cannot.
#[test]
fn a_face_that_is_held_along_itself_does_not_turn() {
    let mesh = recipe(
        "TITLE\n HELD\nBOX, 1, 0., 0., 0., 1., 0.5, 0.4, 4, 2, 2\nBOX, 2, 0.1, 0., 0.4, 0.9, 0.5, 0.2, 5, 3, 1\n\
         NODE SET FACE, 1, 1, LEFT\nSIDE SET FACE, 100, 2, TOP\n",
    );
    let deck = |rigid: &str| {
        format!(
            "TERMINATION TIME, 1.E-3\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-4\n{rigid}TIME STEP MAXIMUM, 1.E-6\nNO DISPLACEMENT, Z, 1\n\
             FUNCTION, 1\n 0., 1.\n 1., 1.\nEND\nPRESSURE, 100, 1, 1.E7\nCONTACT MATERIAL, ALL\n{STEEL}{}",
            STEEL.replace("MATERIAL, 1", "MATERIAL, 2")
        )
    };
    let run = run(&deck("RIGID BODY, 1\n"), &mesh);
    let moved = (0..mesh.coordinates.len()).filter(|&node| mesh.coordinates[node][2] <= 0.39);
    let farthest = moved.map(|node| run.end().nodal("DISPLZ")[node].abs()).fold(0.0, f64::max);
    between("held along itself", "farthest that the body goes", farthest, 0.0, 1e-12);
    between("held along itself", "worst balance", run.worst_balance(), 0.0, 1e-3);
    // A pressure that sets in at once gives ½ p²/E of a column and half of it again as motion; the pillar moves no more than that.
    let stored = 1e7f64.powi(2) / 200e9 * 0.9 * 0.5 * 0.2;
    between("held along itself", "energy of the pillar", run.last().totals.external / stored, 0.0, 4.0);
}

/// Motions that no rigid body can do end the run and are named; without them it would go astray or be no number.
#[test]
fn motions_that_contradict_each_other_are_told() {
    let mut mesh = brick([2, 2, 2], [1.0, 1.0, 1.0]);
    add_node_set(&mut mesh, 50, |x| x == [0.0, 0.0, 0.0]);
    add_node_set(&mut mesh, 51, |x| x == [1.0, 0.0, 0.0]);
    add_node_set(&mut mesh, 52, |x| x[0] == 0.0);
    add_node_set(&mut mesh, 53, |x| x[0] == 1.0);
    let head = "TERMINATION TIME, 1.\nOUTPUT TIME, 0.1\nPLOT TIME, 0.1\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-3\n\
        FUNCTION, 1\n 0., 0.\n 2., 2.\nEND\n";
    for (motions, told) in [
        // Two nodes that are pulled apart.
        ("PRESCRIBED DISPLACEMENT, X, 50, 1, 0.1\nNO DISPLACEMENT, X, 51\n", "wants it"),
        // A bar pressed together, and bent across.
        ("PRESCRIBED VELOCITY, X, 52, 1, 1.\nPRESCRIBED VELOCITY, X, 53, 1, -1.\n", "PRESCRIBED VELOCITY, X"),
        ("PRESCRIBED VELOCITY, Z, 52, 1, 1.\nPRESCRIBED VELOCITY, Z, 53, 1, -1.\n", "PRESCRIBED VELOCITY, Z"),
        // Two rates of one body.
        (
            "PRESCRIBED ANGULAR VELOCITY, Z, 50, 1, 1.\nPRESCRIBED ANGULAR VELOCITY, Z, 51, 1, 2.\n",
            "PRESCRIBED ANGULAR VELOCITY, Z",
        ),
    ] {
        let run = run_on(1, &format!("{head}{motions}{STEEL}"), &mesh);
        let stop = run.stop.expect("the run ends").to_string();
        assert!(
            stop.contains("the rigid body of block 1 cannot do all that it is told") && stop.contains(told),
            "{stop}"
        );
    }
}

/// A hinge takes what it does not allow of the velocity that a body is given, before the first step: a plate that is pushed along its
/// hinge and across sets off with the angular momentum about the hinge alone.
#[test]
fn a_hinged_body_sets_off_as_its_hinge_allows() {
    let (long, wide) = (0.5, 0.1);
    let mut mesh = brick([10, 2, 2], [long, wide, wide]);
    add_node_set(&mut mesh, 50, |x| x[0] == 0.0 && x[2] == 0.05);
    let run = run(
        &format!(
            "TERMINATION TIME, 0.1\nOUTPUT TIME, 0.01\nPLOT TIME, 0.1\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-3\n\
             INITIAL VELOCITY MATERIAL, 1, 0.7, 0.3, 2.\nNO DISPLACEMENT, X, 50\nNO DISPLACEMENT, Y, 50\nNO DISPLACEMENT, Z, 50\n{STEEL}"
        ),
        &mesh,
    );
    let mass = 7850.0 * long * wide * wide;
    let arm = 0.5 * long;
    let inertia = mass * ((long * long + wide * wide) / 12.0 + arm * arm);
    let spin = mass * arm * 2.0 / inertia;
    for line in &run.lines {
        // ½ θ² of the angle θ of a step, 6e-3, is what a hinge is told of too late.
        close("hinged body", "kinetic energy", line.totals.kinetic, 0.5 * inertia * spin * spin, 2e-5);
    }
    between("hinged body", "worst balance", run.worst_balance(), 0.0, 2e-5);
}

/// One turn about the middle in a hundred steps comes back to where it began.
#[test]
fn a_prescribed_turn_is_the_angle_that_is_prescribed() {
    let mut mesh = brick([2, 2, 2], [1.0, 1.0, 1.0]);
    add_node_set(&mut mesh, 51, |x| x[0] == 0.5 && x[1] == 0.5);
    let run = run(
        &format!(
            "TERMINATION TIME, 1.\nOUTPUT TIME, 0.1\nPLOT TIME, 0.25\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-2\nTIME STEP SCALE, 1.\n\
             FUNCTION, 1\n 0., 0.\n 2., 2.\nEND\nPRESCRIBED ROTATION, Z, 51, 1, {}\nNO DISPLACEMENT, X, 51\nNO DISPLACEMENT, Y, 51\n\
             NO DISPLACEMENT, Z, 51\n{STEEL}",
            2.0 * PI
        ),
        &mesh,
    );
    let end = run.end();
    let left = end.time - 1.0;
    for name in ["DISPLX", "DISPLY"] {
        let worst = end.nodal(name).iter().fold(0.0f64, |worst, u| worst.max(u.abs()));
        // Round-off of a hundred steps, and of the time at which they end.
        between("a whole turn", name, worst, 0.0, 1e-12 + 2.0 * PI * left.abs());
    }
}

/// A body that is driven along x and stopped again: nothing is left but the round-off of the work that was done, and that is no error.
#[test]
fn at_rest_again() {
    let mesh = brick([2, 2, 2], [1.0; 3]);
    let stopped = run(
        &format!(
            "TERMINATION TIME, 0.3\nOUTPUT TIME, 0.01\nRIGID BODY, 1\nTIME STEP MAXIMUM, 1.E-4\nPRESCRIBED VELOCITY, X, 1, 1\n\
             FUNCTION, 1\n0., 0.\n0.05, 3.\n0.1, 7.1\n0.2, 0.\n1., 0.\nEND\n{STEEL}"
        ),
        &mesh,
    );
    let most = stopped.lines.iter().map(|line| line.totals.kinetic).fold(0.0, f64::max);
    // Half a step before and after the peak of the function the body is slower by 0.06 and 0.05 %.
    close("driven", "largest kinetic energy [J]", most, 0.5 * 7850.0 * 7.1 * 7.1, 1.5e-3);
    let last = stopped.last();
    between("driven", "kinetic energy left", last.totals.kinetic, 0.0, 1e-20 * most);
    // Some thousand sums have lost 1e-14 of the work, over the millionth of it that is the least measure of an error; it
    // was 1 without.
    between("driven", "worst energy balance", stopped.worst_balance(), 0.0, 1e-7);
}

/// What begins to be held when a run goes on is held where it is then, and what stops it is work: of a rigid body as of one that deforms.
#[test]
fn what_a_run_holds_anew_stays_where_it_is() {
    let mesh = || {
        recipe(
            "TITLE\n TWO\nBOX, 1, 0., 0., 0., 0.1, 0.1, 0.1, 2, 2, 2\nBOX, 2, 0., 0., 0.3, 0.1, 0.1, 0.1, 2, 2, 2\n\
             NODE SET BLOCK, 1, 1\nNODE SET BLOCK, 2, 2\n",
        )
    };
    let deck = "TERMINATION TIME, 1.\nTIME STEP MAXIMUM, 5.E-6\nRIGID BODY, 1\nINITIAL VELOCITY MATERIAL, 1, 10.\nINITIAL VELOCITY MATERIAL, 2, 10.\n\
        MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n\
        MATERIAL, 2, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\n";
    let whole = Case::new(deck, mesh()).part(1, None, 100);
    let flown = whole.end.number("RIGID1.X").expect("a rigid body");
    for set in [1, 2] {
        let held = Case::new(&format!("NO DISPLACEMENT, X, {set}\n{deck}"), mesh());
        let after = held.part(1, Some(&whole.end), 50);
        let again = held.part(1, Some(&held.part(1, Some(&whole.end), 20).end), 30);
        assert_same("held anew, and continued", &after, &again);
        let x = after.end.number("RIGID1.X").expect("a rigid body");
        let further = if set == 1 { 0.0 } else { 10.0 * (after.end.time() - whole.end.time()) };
        between("held anew", &format!("set {set}: place of the rigid body, m"), x - flown - further, -1e-12, 1e-12);
        // Half of the kinetic energy is gone, and the work that took it stands among that of the loads.
        let [kinetic, external] = [0, 6].map(|place| f64::from_bits(after.way[49][2 + place]));
        let half = 0.5 * 7.85 * 100.0;
        close("held anew", &format!("set {set}: kinetic energy, J"), kinetic, half, 1e-9);
        close("held anew", &format!("set {set}: external work, J"), external, -half, 1e-9);
    }
}
