//! TIED CONTACT: what is refused, and what is told of it.

use super::tied::{LAWS, stack};
use crate::support::between;
use crate::support::meshes::{add_node_set, nodes_where, recipe};
use crate::support::run::{model, run};
use urto::mesh::{Mesh, NodeSet};
use urto::solver::Body;

/// Block 1 stands on block 2; how the ties of side sets 100 and 200, these in the order given, are refused.
fn refusal(mesh: &Mesh, ties: &str) -> String {
    let model = model(&format!("TERMINATION TIME, 1.\nOUTPUT TIME, 1.\n{ties}{LAWS}"), mesh);
    let body = Body::new(mesh, &model).expect("materials");
    body.tied.refusal(mesh, &model, &body.node_mass).expect("a refusal")
}

#[test]
fn what_cannot_be_tied_is_told() {
    let apart = recipe(
        "TITLE\n APART\nBOX, 1, 0., 0., 0., 1., 1., 0.6, 3, 3, 3\nBOX, 2, 0., 0., 0.9, 1., 1., 0.5, 2, 2, 2\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n",
    );
    assert!(refusal(&apart, "TIED CONTACT, 100, 200\n").contains("ties nothing"));
    // A heavy coarse face of which a corner covers some nodes of a fine and light one.
    let partly = recipe(
        "TITLE\n PARTLY\nBOX, 1, 0., 0., 0., 1., 1., 0.05, 20, 20, 1\nBOX, 2, 0.55, 0.55, 0.05, 1., 1., 1., 1, 1, 1\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n",
    );
    let told = refusal(&partly, "TIED CONTACT, 200, 100\n");
    assert!(told.contains("would have a mass of -") && told.contains("covers only in part"), "{told}");
}

/// A node of a coarse surface follows some of a finer one with negative weights, and takes that part of its POINT MASS off them.
#[test]
fn a_heavy_point_mass_that_follows_is_told() {
    let mut mesh = recipe(
        "TITLE\n HEAVY\nBOX, 1, 0., 0., 0., 2., 2., 1., 9, 9, 3\nBOX, 2, 0., 0., 1., 2., 2., 1., 2, 2, 1\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\n",
    );
    let of_second = |node: &u32| mesh.blocks[1].nodes.contains(node);
    let middle = nodes_where(&mesh, |x| x == [1.0, 1.0, 1.0]).into_iter().find(of_second).expect("the middle");
    mesh.node_sets.push(NodeSet { id: 7, name: String::new(), nodes: vec![middle] });
    let tied = |ties: &str| {
        let model = model(&format!("TERMINATION TIME, 1.\nOUTPUT TIME, 1.\n{ties}{LAWS}"), &mesh);
        let body = Body::new(&mesh, &model).expect("materials");
        let refusal = body.tied.refusal(&mesh, &model, &body.node_mass);
        (body, refusal)
    };
    let (light, refusal) = tied("TIED CONTACT, 200, 100\n");
    assert_eq!(refusal, None);
    // The mass of the node that can just be is that which takes all of the lightest of those that it follows.
    let follower = light.tied.followers.iter().find(|one| one.node == middle).expect("a follower");
    let bearable = |(node, weight): &(u32, f64)| (*weight < 0.0).then(|| -light.node_mass[*node as usize] / weight);
    let most = follower.leaders.iter().filter_map(bearable).fold(f64::INFINITY, f64::min);
    let (_, refusal) = tied(&format!("TIED CONTACT, 200, 100\nPOINT MASS, 7, {}\n", 0.999 * most));
    assert_eq!(refusal, None);
    let heavy = format!("POINT MASS, 7, {}\n", 1.001 * most);
    let (_, refusal) = tied(&format!("TIED CONTACT, 200, 100\n{heavy}"));
    let told = refusal.expect("a refusal");
    let names = format!("node {} follows it with a weight of -", mesh.node_ids[middle as usize]);
    assert!(told.contains(&names) && told.contains("POINT MASS is too heavy"), "{told}");
    // What the help says.
    assert_eq!(tied(&format!("TIED CONTACT, 100, 200\n{heavy}")).1, None);
}

/// The deck drives followers: nothing is said where it drives what they follow alike, by whatever function, and else how many they are.
#[test]
fn followers_that_are_driven_otherwise_are_told() {
    let mut mesh = stack(3, 2);
    add_node_set(&mut mesh, 3, |x| x[2] == 0.6);
    let of_second = |node: &u32| mesh.blocks[1].nodes.contains(node);
    let (leading, following): (Vec<u32>, Vec<u32>) =
        nodes_where(&mesh, |x| x[2] == 0.6).into_iter().partition(of_second);
    mesh.node_sets.extend([(4, following), (5, leading)].map(|(id, nodes)| NodeSet { id, name: String::new(), nodes }));
    let told = |drives: &str| {
        let functions = "FUNCTION, 1\n 0., 0.\n 1., 1.\nEND\nFUNCTION, 2\n 0., 0.\n 1., 1.\nEND\nFUNCTION, 3\n 0., 1.\n 1., 1.\nEND\n";
        let text = format!("TERMINATION TIME, 1.\nOUTPUT TIME, 1.\nTIED CONTACT, 100, 200\n{functions}{drives}{LAWS}");
        Body::new(&mesh, &model(&text, &mesh)).expect("materials").tied.held.0
    };
    for (drives, count) in [
        ("NO DISPLACEMENT, X, 4\nNO DISPLACEMENT, X, 5\n", 0),
        ("NO DISPLACEMENT, X, 4\nNO DISPLACEMENT, Y, 5\n", 16),
        ("PRESCRIBED VELOCITY, X, 4, 1, 5.\nNO DISPLACEMENT, X, 5\n", 16),
        ("PRESCRIBED VELOCITY, X, 4, 1, 5.\nPRESCRIBED VELOCITY, X, 5, 1, 4.\n", 16),
        ("PRESCRIBED VELOCITY, X, 4, 1, 5.\nPRESCRIBED VELOCITY, X, 5, 3, 5.\n", 16),
        ("PRESCRIBED VELOCITY, X, 4, 1, 5.\nPRESCRIBED DISPLACEMENT, X, 5, 1, 5.\n", 16),
        ("PRESCRIBED VELOCITY, X, 4, 1, 5.\nPRESCRIBED VELOCITY, X, 5, 2, 5.\n", 0),
        ("PRESCRIBED VELOCITY, X, 3, 1, 5.\n", 0),
        ("NO DISPLACEMENT, X, 5\n", 0),
    ] {
        assert_eq!(told(drives), count, "{drives}");
    }
}

/// A strip of ten faces follows one of three that covers it from 0.3 to 0.602: a solver for dense matrices finds 3.37 for the largest
/// ratio of masses, next to which power iteration found 0.997 and was content.
#[test]
fn the_step_of_a_joint_is_not_missed() {
    let mesh = recipe(
        "TITLE\n STRIPS\nBOX, 1, 0., 0., 0., 1., .1, .05, 10, 1, 1\nBOX, 2, .3, 0., .05, .302, .1, .05, 3, 1, 1\n\
         SIDE SET FACE, 100, 1, TOP\nSIDE SET FACE, 200, 2, BOTTOM\nNODE SET FACE, 1, 1, LEFT\nNODE SET FACE, 2, 1, RIGHT\n",
    );
    let deck = format!(
        "TERMINATION TIME, 0.01\nOUTPUT TIME, 1.E-4\nPLOT TIME, 1.E-2\nTIED CONTACT, 100, 200\nELEMENT, 1, EIGHT POINTS\n\
         ELEMENT, 2, EIGHT POINTS\nNO DISPLACEMENT, X, 1\nNO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\n\
         INITIAL VELOCITY NODESET, 2, 0., 0., 1.\n{LAWS}"
    );
    let body = Body::new(&mesh, &model(&deck, &mesh)).expect("materials");
    between("strips", "largest ratio of masses", body.tied.step_part().powi(-2), 3.37, 3.37 * 1.022);
    let run = run(&deck, &mesh);
    let balance = run.lines.iter().map(|line| line.balance.abs()).fold(0.0, f64::max);
    between("strips", "energy balance", balance, 0.0, 5e-3);
}
