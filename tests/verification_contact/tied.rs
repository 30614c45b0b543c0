//! TIED CONTACT: the patch test across meshes that do not match, waves through a joint, free flight, the same bits on any ranks.
//!
//! `cargo test --test verification_contact tied:: -- --nocapture` prints the numbers of docs/verification.md.

use crate::support::continued::{Case, assert_same};
use crate::support::meshes::{add_node_set, add_side_set, recipe};
use crate::support::run::{model, run, run_on};
use crate::support::{between, close};
use urto::comm::Serial;
use urto::mesh::Mesh;
use urto::solver::{Body, Request, Solver};

pub const LAWS: &str = "MATERIAL, 1, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.3\nEND\n\
    MATERIAL, 2, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.3\nEND\n";

/// Two blocks, one on the other, with so many elements along their sides.
pub fn stack(first: usize, second: usize) -> Mesh {
    recipe(&format!(
        "TITLE\n STACK\nBOX, 1, 0., 0., 0., 1., 1., 0.6, {first}, {first}, 3\nBOX, 2, 0., 0., 0.6, 1., 1., 0.5, {second}, {second}, 2\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n"
    ))
}

/// Nodes are led along a linear field, but those that follow go by themselves: they follow it, stress is the same
/// everywhere, and no node inside feels a force, at the joint as little as elsewhere.
#[test]
fn patch_test_across_meshes_that_do_not_match() {
    let any = [[0.2, -0.3, 0.1], [0.4, 0.1, -0.2], [-0.1, 0.3, -0.5]];
    // Forces of the free sides go on with those of the joint: where coarse nodes follow fine ones they reach inside. Without
    // them no force may be left.
    let along = [[0.0; 3], [0.0; 3], [0.0, 0.0, -0.5]];
    for (first, second, perturbed) in [(4, 3, false), (3, 4, false), (5, 2, false), (2, 5, false), (4, 3, true)] {
        patch(first, second, perturbed, any, LAWS, false);
        patch(first, second, perturbed, along, &LAWS.replace("RATIO = 0.3", "RATIO = 0."), true);
    }
}

fn patch(first: usize, second: usize, perturbed: bool, gradient: [[f64; 3]; 3], laws: &str, alone: bool) {
    let mut mesh = stack(first, second);
    if perturbed {
        // Faces of the joint that are no parallelograms.
        for x in mesh.coordinates.iter_mut().filter(|x| x[2] == 0.6) {
            let bump = x[0] * (1.0 - x[0]) * x[1] * (1.0 - x[1]);
            (x[0], x[1]) = (x[0] + 0.3 * bump, x[1] - 0.4 * bump);
        }
    }
    let case = format!("patch test, {first} on {second}{}", if perturbed { ", bent" } else { "" });
    let cell = 1.0 / (first.max(second) as f64).powi(2);
    let tolerance = if perturbed { 1e-8 } else { 1e-10 };
    let ties = format!("TIED CONTACT, 100, 200\n{laws}");
    let all = |_: [f64; 3]| true;
    let alone = alone.then_some((&all as &dyn Fn([f64; 3]) -> bool, [cell, tolerance]));
    led_by_the_hand(&case, &mesh, &ties, ([1.0, 1.0, 1.1], (first + 1) * (first + 1)), gradient, alone);
}

/// A cube in a corner of two walls of another mesh, tied to both: a node of the common edge follows both surfaces.
#[test]
fn patch_test_at_a_corner() {
    for (first, second) in [(3, 4), (4, 3), (2, 5)] {
        let mesh = corner(first, second);
        for (order, ties, n) in [
            ("follows", "TIED CONTACT, 100, 200\nTIED CONTACT, 101, 201\n", first),
            ("leads", "TIED CONTACT, 200, 100\nTIED CONTACT, 201, 101\n", second),
        ] {
            let case = format!("corner, cube of {first} {order} {second}");
            let size = ([2.0, 2.0, 1.0], (2 * n + 1) * (n + 1));
            let any = [[0.2, -0.3, 0.1], [0.4, 0.1, -0.2], [-0.1, 0.3, -0.5]];
            led_by_the_hand(&case, &mesh, &format!("{ties}{LAWS}"), size, any, None);
            // Forces of free sides go on with those of the joint, as above: without them, but for the ends of the joint along which is pulled.
            let bare = format!("{ties}{}", LAWS.replace("RATIO = 0.3", "RATIO = 0."));
            let cell = [1.0 / (first.max(second) as f64).powi(2), 1e-10];
            led_by_the_hand(
                &case,
                &mesh,
                &bare,
                size,
                [[-0.5, 0.0, 0.0], [0.0; 3], [0.0; 3]],
                Some((&|x| x[1] != 1.0 || x[0] == 1.0, cell)),
            );
            led_by_the_hand(
                &case,
                &mesh,
                &bare,
                size,
                [[0.0; 3], [0.0, 0.4, 0.0], [0.0; 3]],
                Some((&|x| x[0] != 1.0 || x[1] == 1.0, cell)),
            );
        }
    }
}

/// A cube and three around two of its sides.
fn corner(first: usize, second: usize) -> Mesh {
    let wall = |x: u8, y: u8| format!("BOX, 2, {x}., {y}., 0., 1., 1., 1., {second}, {second}, {second}\n");
    recipe(&format!(
        "TITLE\n CORNER\nBOX, 1, 0., 0., 0., 1., 1., 1., {first}, {first}, {first}\n{}{}{}MERGE, 2\n\
         SIDE SET FACE, 100, 1, RIGHT\nSIDE SET FACE, 101, 1, BACK\nSIDE SET BOX, 200, 1., 1., 0., 1., 0., 1., 2\n\
         SIDE SET BOX, 201, 0., 1., 1., 1., 0., 1., 2\n",
        wall(1, 0),
        wall(1, 1),
        wall(0, 1)
    ))
}

/// Which nodes' forces are looked at, the area of a face, and a tolerance.
type Forces<'a> = (&'a dyn Fn([f64; 3]) -> bool, [f64; 2]);

/// Leads all nodes of a body of this size, so many of which follow, and looks at places and stresses; and, with a choice of nodes, the area of a
/// face and a tolerance, at forces inside.
fn led_by_the_hand(
    case: &str,
    mesh: &Mesh,
    ties: &str,
    (size, followers): ([f64; 3], usize),
    gradient: [[f64; 3]; 3],
    alone: Option<Forces>,
) {
    {
        let model = model(&format!("TERMINATION TIME, 1.\nOUTPUT TIME, 1.\nBULK VISCOSITY, 0., 0.\n{ties}"), mesh);
        let body = Body::new(mesh, &model).expect("materials");
        assert_eq!(body.tied.followers.len(), followers);
        let cut = body.cut(1);
        let contributors = body.contributors(&cut);
        let share = body.decomposition(&contributors, 1).share(0);
        let comm = &mut Serial;
        let mut solver = Solver::new(mesh, &model, &body, &share, comm);
        for _ in 0..40 {
            // The balance of what is led by the hand is none.
            let _ = solver.prepare(Request::Continue, comm);
            let nodes = &mut solver.domain.nodes;
            for node in 0..nodes.len() {
                let x = nodes.initial(node as u32);
                let v = gradient.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2]);
                nodes.rows[node].0[4..7].copy_from_slice(&v);
                nodes.forces[node] = Default::default();
            }
            let ties = solver.domain.ties.as_ref().expect("ties");
            ties.set_off(&mut solver.domain.nodes, comm);
            solver.advance();
        }
        let _ = solver.prepare(Request::Continue, comm);
        let nodes = &solver.domain.nodes;
        let mut astray = 0.0f64;
        let mut force = 0.0f64;
        for node in 0..nodes.len() as u32 {
            let x = nodes.initial(node);
            let expected: [f64; 3] =
                std::array::from_fn(|i| x[i] + solver.time * (0..3).map(|j| gradient[i][j] * x[j]).sum::<f64>());
            astray = (0..3).fold(astray, |worst, i| worst.max((nodes.position(node)[i] - expected[i]).abs()));
            let inside = (0..3).all(|i| x[i] > 1e-9 && x[i] < size[i] - 1e-9);
            let looked_at = alone.is_none_or(|(counts, _)| counts(x));
            if inside && looked_at && !body.tied.follows(nodes.file[node as usize]) {
                force = nodes.force(node).iter().fold(force, |worst, f| worst.max(f.abs()));
            }
        }
        let stress: Vec<_> = solver
            .domain
            .blocks
            .iter()
            .flat_map(|block| block.groups().map(|group| (block, group)))
            .flat_map(|(block, group)| (0..group.len()).map(move |i| block.element.stress(group, i)))
            // Each in its own frame: of it what no frame changes.
            .map(|s| {
                let sides = 2.0 * (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx);
                [s.xx + s.yy + s.zz, (s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + sides).sqrt()]
            })
            .collect();
        let most = stress.iter().flatten().fold(0.0f64, |most, s| most.max(s.abs()));
        let apart = stress.iter().flat_map(|s| (0..2).map(|i| (s[i] - stress[0][i]).abs())).fold(0.0f64, f64::max);
        between(case, "positions, largest error", astray, 0.0, 1e-13);
        between(case, "stress, largest difference", apart / most, 0.0, 1e-10);
        if let Some((_, [cell, tolerance])) = alone {
            between(case, "force on a node inside over that of a face", force / (most * cell), 0.0, tolerance);
        }
    }
}

/// A step of velocity runs through a bar whose halves do not match: what goes on is what came, and what comes back is next to nothing.
#[test]
fn a_wave_goes_through_a_joint() {
    let mut mesh = recipe(
        "TITLE\n BAR\nBOX, 1, 0., 0., 0., 0.5, 0.04, 0.04, 50, 4, 4\nBOX, 2, 0.5, 0., 0., 0.5, 0.04, 0.04, 50, 3, 3\n\
         SIDE SET FACE, 100, 1, RIGHT\nSIDE SET FACE, 200, 2, LEFT\n",
    );
    add_node_set(&mut mesh, 1, |x| x[0] == 0.0);
    let deck = "TERMINATION TIME, 1.5E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-5\nPLOT ELEMENT, STRESS\nTIED CONTACT, 100, 200\n\
        FUNCTION, 1\n 0., 1.\n 1., 1.\nEND\nPRESCRIBED VELOCITY, X, 1, 1, 1.\n\
        MATERIAL, 1, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\n\
        MATERIAL, 2, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.\nEND\n";
    let run = run(deck, &mesh);
    let c = (200e9f64 / 7850.0).sqrt();
    let stress = run.end().element("SIGXX");
    let mean = |low: f64, high: f64| {
        let of: Vec<f64> = mesh
            .elements()
            .zip(stress)
            .filter(|((_, nodes), _)| {
                let x = nodes.iter().map(|&n| mesh.coordinates[n as usize][0]).sum::<f64>() / 8.0;
                x > low && x < high
            })
            .map(|(_, s)| *s)
            .collect();
        of.iter().sum::<f64>() / of.len() as f64
    };
    close("wave through a joint", "plateau before it, Pa", mean(0.1, 0.45), -7850.0 * c, 5e-3);
    close("wave through a joint", "plateau behind it, Pa", mean(0.55, 0.68), -7850.0 * c, 5e-3);
    between("wave through a joint", "worst balance", run.worst_balance(), 0.0, 1e-3);
}

/// Two blocks fall flat on a wall with the rim of their joint, where several followers push the same leaders: on a rigid plane, and on a
/// held rigid block, which is the same wall. What lies on it stops at once, which takes the kinetic energy of half an element's layer of each
/// block, and a little more, as followers beside the wall hand a part of their masses to leaders on it.
#[test]
fn the_rim_of_a_joint_strikes_a_wall() {
    for [fine, coarse] in [[2, 1], [8, 2], [4, 1], [5, 3]] {
        let blocks = format!(
            "TITLE\n JOINT\nBOX, 1, 0., 0., 0., 0.03, 0.03, 0.03, {fine}, {fine}, {fine}\n\
             BOX, 2, 0., 0., -0.03, 0.03, 0.03, 0.03, {coarse}, {coarse}, {coarse}\n\
             SIDE SET FACE, 100, 1, BOTTOM\nSIDE SET FACE, 200, 2, TOP\n"
        );
        let mesh_of_plane = recipe(&format!("{blocks}SIDE SET PLANE, 400, X, 0.\n"));
        let block = recipe(&format!(
            "{blocks}BOX, 3, -0.02, -0.015, -0.045, 0.02, 0.06, 0.09, 3, 9, 13\nNODE SET BLOCK, 9, 3\n"
        ));
        let deck = format!(
            "TERMINATION TIME, 4.E-5\nOUTPUT TIME, 1.E-7\nPLOT TIME, 4.E-5\nTIED CONTACT, 100, 200\n\
             INITIAL VELOCITY MATERIAL, 1, -5.\nINITIAL VELOCITY MATERIAL, 2, -5.\n{LAWS}"
        );
        let third = "MATERIAL, 3, ELASTIC, 7850.\nYOUNGS MODULUS = 200.E9\nPOISSONS RATIO = 0.3\nEND\nRIGID BODY, 3\n\
            NO DISPLACEMENT, X, 9\nNO DISPLACEMENT, Y, 9\nNO DISPLACEMENT, Z, 9\nCONTACT MATERIAL\n";
        let on_the_plane = format!("RIGID SURFACE, 400, 0., 0., 0., 1., 0., 0.\n{deck}");
        let on_plane = run(&on_the_plane, &mesh_of_plane);
        let on_block = run(&format!("{third}{deck}"), &block);
        let case = format!("joint of {fine} on {coarse} on a wall");
        let layer = |cells: i32| 0.5 * 1000.0 * 0.03f64.powi(3) / (2.0 * f64::from(cells)) * 25.0;
        let expected = layer(fine) + layer(coarse);
        for (wall, run) in [("plane", &on_plane), ("block", &on_block)] {
            let most = run.lines.iter().map(|line| line.totals.contact).fold(0.0, f64::max);
            between(&case, &format!("work of contact on the {wall}, largest"), most / expected, 0.0, 1e-12);
            let made = run.last().totals.contact_gain / expected;
            between(&case, &format!("made on the {wall}"), made, 0.0, 1e-12);
            let loss = -run.last().totals.contact / expected;
            between(&case, &format!("taken by the {wall} over that of the layers"), loss, 1.0, 1.3);
        }
        let [plane, block] = [&on_plane, &on_block].map(|run| run.last().totals.contact);
        close(&case, "work on the block, J", block, plane, 2e-4);
        // Joints make planes of different ranks one problem, also of ranks without any node on the wall.
        let shared = run_on(4, &on_the_plane, &mesh_of_plane);
        assert_eq!(shared.last().totals, on_plane.last().totals, "{case}: other bits on four ranks");
    }
}

/// Two tied blocks fly, spin and vibrate.
#[test]
fn tied_blocks_fly_freely() {
    let mesh = stack(4, 3);
    let deck = format!(
        "TERMINATION TIME, 0.05\nOUTPUT TIME, 1.E-3\nPLOT TIME, 1.E-3\nPLOT NODAL, DISPLACEMENT, VELOCITY\nTIED CONTACT, 100, 200\n\
         BULK VISCOSITY, 0., 0.\nINITIAL VELOCITY MATERIAL, 2, 3., 0., 5.\nINITIAL VELOCITY ANGULAR, 1, 20., 0.5, 0.5, 0.5, 0., 1., 0.3\n{LAWS}"
    );
    let run = run(&deck, &mesh);
    let first = run.lines[1].totals.momentum;
    let worst = run.lines[1..]
        .iter()
        .flat_map(|line| (0..3).map(move |i| (line.totals.momentum[i] - first[i]).abs()))
        .fold(0.0f64, f64::max);
    between("tied blocks", "momentum, largest change over 2,000", worst / 2000.0, 0.0, 1e-12);
    // Energies of central differences are of second order in the step, tied or not.
    let half = crate::support::run::run(&format!("TIME STEP SCALE, 0.5\n{deck}"), &mesh);
    between("tied blocks", "worst balance", run.worst_balance(), 0.0, 5e-4);
    between(
        "tied blocks",
        "worst balance with half the step over it",
        half.worst_balance() / run.worst_balance(),
        0.0,
        0.3,
    );
    let case = Case::new(&deck, mesh);
    let spin = |snapshot: &urto::restart::Snapshot| {
        let of = |name: &str| &snapshot.nodal.iter().find(|(known, _)| known == name).expect("a nodal value").1;
        let (m, x, v) = (of("NODMASS"), ["POSX", "POSY", "POSZ"].map(of), ["VELX", "VELY", "VELZ"].map(of));
        let mut sum = [0.0; 3];
        for n in 0..m.len() {
            let ([x, y, z], [a, b, c]) = (x.map(|x| x[n]), v.map(|v| v[n]));
            let one = [y * c - z * b, z * a - x * c, x * b - y * a];
            (0..3).for_each(|i| sum[i] += m[n] * one[i]);
        }
        sum
    };
    let ends = [10, 800].map(|steps| spin(&case.part(1, None, steps).end));
    let size = ends[0].iter().map(|l| l * l).sum::<f64>().sqrt();
    let change = (0..3).map(|i| (ends[1][i] - ends[0][i]).abs()).fold(0.0, f64::max);
    between("tied blocks", "angular momentum, largest change", change / size, 0.0, 1e-11);
}

#[test]
fn the_same_bits_on_any_ranks_and_after_a_restart() {
    let mut mesh = recipe(
        "TITLE\n BUSY\nBOX, 1, 0., 0., 0., 1., 1., 0.6, 4, 4, 3\nBOX, 2, 0., 0., 0.6, 1., 1., 0.5, 3, 3, 2\n\
         BOX, 3, 0.8, 0.3, 1.15, 0.5, 0.5, 0.4, 3, 3, 3\nSIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n",
    );
    add_node_set(&mut mesh, 1, |x| x[2] == 0.0);
    let deck = format!(
        "TERMINATION TIME, 0.02\nOUTPUT TIME, 1.E-3\nPLOT TIME, 1.E-3\nPLOT NODAL, DISPLACEMENT, VELOCITY, ACCELERATION, REACTION, CONTACT\n\
         PLOT ELEMENT, STRESS\nTIED CONTACT, 100, 200\nCONTACT MATERIAL, ALL\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\n\
         NO DISPLACEMENT, Z, 1\nINITIAL VELOCITY MATERIAL, 3, -10., 0., -30.\n{LAWS}MATERIAL, 3, ELASTIC, 1000.\nYOUNGS MODULUS = 1.E9\nPOISSONS RATIO = 0.3\nEND\n"
    );
    let case = Case::new(&deck, mesh.clone());
    let whole = case.part(1, None, 200);
    for ranks in [2, 3] {
        assert_same("ranks", &whole, &case.part(ranks, None, 200));
    }
    let first = case.part(2, None, 90);
    assert_same("restart", &whole, &case.part(3, Some(&first.end), 110));
    let run = run_on(2, &deck, &mesh).whole();
    between("tied and struck", "worst balance", run.worst_balance(), 0.0, 5e-3);
    between("tied and struck", "energy that contact makes", run.last().totals.contact_gain, 0.0, 1e-9);
}

/// Nodes of a tied side set that face nothing touch the other block like any others: a block that hangs over the edge of the one it is
/// tied to comes down on what lies beside it.
#[test]
fn what_is_not_tied_touches() {
    let mesh = recipe(
        "TITLE\n OVER\nBOX, 1, 0., 0., 0., 1., 1., 0.5, 5, 5, 2\nBOX, 2, 0., 0., 0.5, 2., 1., 0.2, 8, 4, 1\n\
         BOX, 3, 1.2, 0., 0., 0.8, 1., 0.49, 3, 3, 2\nNODE SET FACE, 1, 1, BOTTOM\nNODE SET FACE, 1, 3, BOTTOM\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 100, 3, TOP\nSIDE SET FACE, 200, 2, BOTTOM\nSIDE SET FACE, 300, 2, TOP\n",
    );
    let run = run(
        &format!(
            "TERMINATION TIME, 0.02\nOUTPUT TIME, 1.E-4\nPLOT TIME, 1.E-3\nTIED CONTACT, 200, 100, 0.01\nCONTACT MATERIAL, ALL\n\
             NO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nFUNCTION, 1\n 0., 1.\n 1., 1.\nEND\n\
             PRESSURE, 300, 1, 1.E6\n{LAWS}{}",
            LAWS.split_once("END\n")
                .map(|(first, _)| format!("{first}END\n").replace("MATERIAL, 1", "MATERIAL, 3"))
                .unwrap_or_default()
        ),
        &mesh,
    );
    // The lowest hanging node against the lowest of what lies 10 mm below; both surfaces bend between their nodes.
    let least = |state: &crate::support::run::State, on: &dyn Fn([f64; 3]) -> bool| {
        let nodes = (0..mesh.coordinates.len()).filter(|node| on(mesh.coordinates[*node]));
        nodes.map(|node| state.nodal("DISPLZ")[node]).fold(0.0, f64::min)
    };
    let gap = |state: &crate::support::run::State| {
        0.01 + least(state, &|x| x[2] == 0.5 && x[0] > 1.3) - least(state, &|x| x[2] == 0.49)
    };
    let least_gap = run.states.iter().map(gap).fold(f64::INFINITY, f64::min);
    between("what is not tied", "least gap", least_gap, -5e-4, 1e-4);
    assert!(run.lines.iter().all(|line| line.totals.contact_gain == 0.0));
    between("what is not tied", "worst balance", run.worst_balance(), 0.0, 2e-3);
}

/// Coarse nodes follow finer ones that they cover in part, with weights of both signs: stable at the whole step.
#[test]
fn coarse_nodes_that_follow_finer_ones_are_stable() {
    let mesh = recipe(
        "TITLE\n COARSE\nBOX, 1, 0., 0., 0., 1., 1., 0.4, 6, 6, 2\nBOX, 2, 0.13, 0.21, 0.4, 1.1, 1., 0.5, 4, 4, 2\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n",
    );
    let deck = format!(
        "TERMINATION TIME, 0.1\nOUTPUT TIME, 1.E-3\nPLOT TIME, 0.1\nTIME STEP SCALE, 1.\nTIED CONTACT, 200, 100\nBULK VISCOSITY, 0., 0.\n\
         INITIAL VELOCITY MATERIAL, 2, 0.3, 0., -1.\n{LAWS}"
    );
    let parts = model(&deck, &mesh);
    let body = Body::new(&mesh, &parts).expect("materials");
    // At the step of the elements alone the energy grows a thousandfold in eight steps.
    between("coarse on fine", "step over that of the elements", body.tied.step_part(), 0.2, 0.3);
    let run = run(&deck, &mesh);
    between("coarse on fine", "worst balance", run.worst_balance(), 0.0, 5e-3);
    let last = &run.last().totals;
    between(
        "coarse on fine",
        "kinetic energy at the end over the first",
        last.kinetic / run.lines[0].totals.kinetic,
        0.0,
        1.0,
    );
}

/// A block that is at rest and one that moves, tied: together they have the momentum that the deck gives, whichever follows.
#[test]
fn tied_nodes_share_the_momentum_that_they_are_given() {
    let mesh = stack(3, 4);
    for (follows, moves) in [("100, 200", 1), ("200, 100", 1), ("100, 200", 2)] {
        let run = run(
            &format!(
                "TERMINATION TIME, 1.E-3\nOUTPUT TIME, 1.E-4\nPLOT TIME, 1.E-3\nTIED CONTACT, {follows}\n\
                 INITIAL VELOCITY MATERIAL, {moves}, 0.5, 0., 2.\n{LAWS}"
            ),
            &mesh,
        );
        let mass = 1000.0 * if moves == 1 { 0.6 } else { 0.5 };
        for line in &run.lines {
            let [x, _, z] = line.totals.momentum;
            close("tied and given a velocity", "momentum along x", x, 0.5 * mass, 1e-12);
            close("tied and given a velocity", "momentum along z", z, 2.0 * mass, 1e-12);
        }
    }
}

/// A joint in two commands that meet in a line is the joint in one: nodes on the line follow what both sides ask for.
#[test]
fn joints_that_share_an_edge_are_one() {
    let mut mesh = recipe(
        "TITLE\n HALVES\nBOX, 1, 0., 0., 0., 1., 1., 0.6, 4, 4, 3\nBOX, 2, 0., 0., 0.601, 1., 1., 0.5, 3, 3, 2\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n",
    );
    add_side_set(&mut mesh, 101, |x| x[2] == 0.6 && x[0] <= 0.5);
    add_side_set(&mut mesh, 102, |x| x[2] == 0.6 && x[0] >= 0.5);
    let followers = |ties: &str| {
        let model = model(&format!("TERMINATION TIME, 1.\nOUTPUT TIME, 1.\n{ties}{LAWS}"), &mesh);
        Body::new(&mesh, &model).expect("materials").tied.followers
    };
    let whole = followers("TIED CONTACT, 100, 200\n");
    let halves = followers("TIED CONTACT, 101, 200\nTIED CONTACT, 102, 200\n");
    assert_eq!(whole.len(), halves.len());
    for (one, other) in whole.iter().zip(&halves) {
        assert_eq!((one.node, one.leaders.len()), (other.node, other.leaders.len()));
        for ((leader, weight), (same, found)) in one.leaders.iter().zip(&other.leaders) {
            assert!(leader == same && (weight - found).abs() < 1e-14, "{weight} is not {found}");
        }
    }
}

/// CONTACT SURFACE with FIXED in the place of friction is TIED CONTACT, with the order of the sets by the partition.
#[test]
fn fixed_contact_is_tied() {
    let mesh = stack(4, 3);
    let ties = |line: &str| model(&format!("TERMINATION TIME, 1.\nOUTPUT TIME, 1.\n{line}\n{LAWS}"), &mesh).ties;
    let expected = ties("TIED CONTACT, 100, 200");
    assert_eq!(ties("CONTACT SURFACE, 100, 200, FIXED"), expected);
    assert_eq!(ties("CONTACT SURFACE, 200, 100, FIXED, 1."), expected);
    assert_ne!(ties("CONTACT SURFACE, 200, 100, FIXED, 0.5"), expected);
}
