//! Edges that stand out against the lines of flat faces, edges that come to stand out, and overlaps that stay.
//!
//! Depths are measured by `crate::support::penetration`, which knows nothing of the solver's contact.

use crate::support::bodies::{mean_velocity, nodes_of};
use crate::support::meshes::{add_node_set, recipe};
use crate::support::penetration::{Inside, Skin, deepest, nothing_deeper};
use crate::support::run::{Run, model, run, run_on};
use crate::support::{at_least, between, close};
use urto::mesh::Mesh;
use urto::solver::Body;

/// Deepest point of an edge in any plot state, as a part of a face.
fn deepest_edge(run: &Run, mesh: &Mesh) -> f64 {
    let skin = Skin::new(mesh);
    deepest_of(run, mesh, |at| skin.edges_inside(at))
}

/// The deepest of what is inside in any plot state, as a part of a face.
fn deepest_of(run: &Run, mesh: &Mesh, inside: impl Fn(&[[f64; 3]]) -> Vec<Inside>) -> f64 {
    let of_states = run.states.iter().filter_map(|state| deepest(inside(&state.positions(mesh))));
    of_states.map(|one| one.part).fold(0.0, f64::max)
}

/// Every bit of the positions at the end.
fn bits(run: &Run, mesh: &Mesh) -> Vec<u64> {
    run.end().positions(mesh).as_flattened().iter().map(|x| x.to_bits()).collect()
}

fn elastic(block: usize, density: f64, modulus: f64, poisson: f64) -> String {
    format!("MATERIAL, {block}, ELASTIC, {density}\nYOUNGS MODULUS = {modulus}\nPOISSONS RATIO = {poisson}\nEND\n")
}

/// A stiff brick of coarse elements stands on its long edge over a soft plate, across the lines of its mesh.
const BRICK_ON_EDGE: &str = "TITLE\n brick on edge\nBOX, 1, -0.03, -0.03, -0.01, 0.06, 0.06, 0.01, 10, 10, 2\n\
     BOX, 2, -0.02, -0.005, -0.005, 0.04, 0.01, 0.01, 2, 2, 2\nROTATE, 2, X, 45.\nROTATE, 2, Z, 20.\n\
     TRANSLATE, 2, 0.001, 0.0013, 0.00708\n";

fn brick_on_edge() -> Mesh {
    recipe(BRICK_ON_EDGE)
}

fn falling(edges: &str) -> String {
    format!(
        "TITLE\n brick on edge\nTERMINATION TIME, 1.E-4\nOUTPUT TIME, 1.E-6\nPLOT TIME, 5.E-6\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT\nINITIAL VELOCITY MATERIAL, 2, 0., 0., -20.\n\
         CONTACT MATERIAL\nCONTACT EDGES, {edges}\n{}{}",
        elastic(1, 2000., 5e9, 0.3),
        elastic(2, 7850., 200e9, 0.3)
    )
}

#[test]
fn a_long_edge_does_not_sink_in_between_the_nodes() {
    let mesh = brick_on_edge();
    let [with, without] = ["ALL", "ON"].map(|edges| run(&falling(edges), &mesh));
    let case = "brick on edge";
    // Half a hundredth of the smaller of face and ten elements is left alone, and passes leave a little.
    between(case, "deepest point of an edge, of a face", deepest_edge(&with, &mesh), 0.0, 0.01);
    at_least(case, "the same where edges meet only edges that stand out", deepest_edge(&without, &mesh), 0.03);
    between(case, "worst energy balance", with.worst_balance(), 0.0, 1e-4);
    let taken = -with.last().totals.contact / with.initial_energy;
    // Nodes that meet something still lose what a plastic impact of their masses would: at most that of the edge's nodes,
    // a sixteenth of the brick's mass.
    between(case, "work of contact over initial energy", taken, -1e-6, 0.0625);
    let first = with.lines[0].totals.momentum[2];
    let drift = |line: &crate::support::run::Line| ((line.totals.momentum[2] - first) / first).abs();
    between(case, "drift of momentum", with.lines.iter().map(drift).fold(0.0, f64::max), 0.0, 1e-12);
}

/// How deep an edge goes between the nodes of a face does not depend on the step in which it comes. Lines were looked for in every fourth step
/// only: the energy that the plate takes was 3 % apart between four such starts, and that of a plate of one layer 10 %.
#[test]
fn when_an_edge_comes_does_not_matter() {
    // A third of the plate's stable step, 0.003 m at 1,830 m/s across its bevelled corner of one half, so that all runs take the same steps.
    let step = 2e-7;
    let taken = [0, 1, 2, 3].map(|later: u32| {
        let flight = f64::from(later) * step;
        let mesh = recipe(&format!("{BRICK_ON_EDGE}TRANSLATE, 2, 0., 0., {:?}\n", 20.0 * flight));
        let deck = falling("ALL").replace("TERMINATION TIME, 1.E-4", &format!("TERMINATION TIME, {:?}", 1e-4 + flight));
        let run = run(&format!("{}TIME STEP MAXIMUM, {step:?}\n", deck), &mesh);
        run.last().totals.internal
    });
    for (later, taken_later) in taken.iter().enumerate() {
        // Passes leave a hundred-thousandth of a face of a motion of some hundredths.
        close("brick on edge", &format!("internal energy, {later} steps later"), taken_later / taken[0], 1.0, 1e-3);
    }
}

/// A flat strip of four elements in x under a block of so many; its nodes are driven up like a tent, the ridge along y in the middle, where an even block has
/// nodes.
fn tent(cells: usize) -> Mesh {
    let mut mesh = recipe(&format!(
        "TITLE\n tent\nBOX, 1, -0.01, 0., 0., 0.02, 0.02, 0.001, 4, 2, 1\n\
         BOX, 2, -0.01, -0.002, 0.0055, 0.02, 0.024, 0.008, {cells}, 8, 3\n"
    ));
    add_node_set(&mut mesh, 1, |p| p[2] < 0.002 && p[0].abs() < 1e-9);
    add_node_set(&mut mesh, 2, |p| p[2] < 0.002 && (p[0].abs() - 0.005).abs() < 1e-9);
    add_node_set(&mut mesh, 3, |p| p[2] < 0.002 && p[0].abs() > 0.009);
    add_node_set(&mut mesh, 4, |p| p[2] < 0.002);
    add_node_set(&mut mesh, 5, |p| p[2] > 0.013);
    mesh
}

fn folding(edges: &str) -> String {
    let held = [("X", 4), ("Y", 4), ("Z", 3), ("X", 5), ("Y", 5), ("Z", 5)];
    let held: String = held.map(|(axis, set)| format!("NO DISPLACEMENT, {axis}, {set}\n")).concat();
    format!(
        "TITLE\n tent\nTERMINATION TIME, 5.5E-4\nOUTPUT TIME, 1.E-5\nPLOT TIME, 1.E-5\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT\nCONTACT MATERIAL\nCONTACT EDGES, {edges}\nFUNCTION, 1\n0., 1.\nEND\n\
         PRESCRIBED VELOCITY, Z, 1, 1, 10.\nPRESCRIBED VELOCITY, Z, 2, 1, 5.\n{held}{}{}",
        elastic(1, 2000., 1e9, 0.),
        elastic(2, 1000., 1e8, 0.3)
    )
}

#[test]
fn a_fold_meets_the_lines_of_a_face() {
    let deepest = |cells: usize, edges: &str| {
        let mesh = tent(cells);
        deepest_edge(&run(&folding(edges), &mesh), &mesh)
    };
    // Faces beside the ridge turn by 2 atan(5.5/10) = 58 degrees: an edge that stands out, of nodes a centimetre apart.
    for cells in [4, 5] {
        between("tent", "deepest point of an edge, of a face", deepest(cells, "ALL"), 0.0, 0.02);
    }
    // Nodes on the ridge hold it by themselves.
    at_least("tent", "the same where lines take no part", deepest(5, "ON"), 0.05);
}

/// The same strip under a bar that stands on its edge along x, which crosses the ridge between the nodes of both.
fn tent_under_a_bar() -> Mesh {
    let mut mesh = recipe(
        "TITLE\n tent\nBOX, 1, -0.01, 0., 0., 0.02, 0.02, 0.001, 4, 2, 1\n\
         BOX, 2, -0.01, -0.003, -0.003, 0.02, 0.006, 0.006, 3, 2, 2\nROTATE, 2, X, 45.\nTRANSLATE, 2, 0., 0.005, 0.00975\n",
    );
    add_node_set(&mut mesh, 1, |p| p[2] < 0.002 && p[0].abs() < 1e-9);
    add_node_set(&mut mesh, 2, |p| p[2] < 0.002 && (p[0].abs() - 0.005).abs() < 1e-9);
    add_node_set(&mut mesh, 3, |p| p[2] < 0.002 && p[0].abs() > 0.009);
    add_node_set(&mut mesh, 4, |p| p[2] < 0.002);
    add_node_set(&mut mesh, 5, |p| p[2] > 0.0105);
    mesh
}

#[test]
fn a_fold_meets_an_edge() {
    let mesh = tent_under_a_bar();
    let [with, without] = ["ON", "OFF"].map(|edges| run(&folding(edges), &mesh));
    // The ridge is flat in the mesh, and at 48 degrees when it meets the bar.
    between("tent under a bar", "deepest point of an edge, of a face", deepest_edge(&with, &mesh), 0.0, 0.01);
    at_least("tent under a bar", "the same without edges", deepest_edge(&without, &mesh), 0.05);
}

/// A cube whose top is warped by a tenth, two corners across from each other up, and over its middle a bar on its edge, along the
/// line between the two corners that are down, or so far `beside` it. Nothing of both meshes but the bulge is in the way between them.
fn bar_over_a_bulge(beside: f64) -> Mesh {
    let mut mesh = recipe(&format!(
        "TITLE\n bulge\nBOX, 1, -0.5, -0.5, -1., 1., 1., 1., 1, 1, 1\n\
         BOX, 2, -0.9, -0.1, -0.1, 1.8, 0.2, 0.2, 1, 1, 1\nROTATE, 2, X, 45.\nROTATE, 2, Z, 135.\n\
         TRANSLATE, 2, {beside}, {beside}, 0.16\n",
    ));
    add_node_set(&mut mesh, 1, |p| p[2] < -0.9);
    let is_top = |at: &[f64; 3]| at[2].abs() < 1e-9 && (at[0].abs() - 0.5).abs() < 1e-9;
    for at in mesh.coordinates.iter_mut().filter(|at| is_top(at)) {
        at[2] = if at[0] * at[1] > 0.0 { 0.1 } else { -0.1 };
    }
    mesh
}

fn falling_on_a_bulge(edges: &str, along: f64) -> String {
    format!(
        "TITLE\n bulge\nTERMINATION TIME, 0.02\nOUTPUT TIME, 1.E-3\nPLOT TIME, 5.E-4\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT\nINITIAL VELOCITY MATERIAL, 2, {along}, {along}, -5.\nNO DISPLACEMENT, X, 1\n\
         NO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, Z, 1\nCONTACT MATERIAL\nCONTACT EDGES, {edges}\n{}{}",
        elastic(1, 2000., 1e9, 0.3),
        elastic(2, 500., 1e8, 0.3)
    )
}

#[test]
fn an_edge_does_not_dip_into_a_bulge() {
    let mesh = bar_over_a_bulge(0.02);
    let deck = falling_on_a_bulge("ALL", 0.0);
    let [with, without] = [deck.clone(), falling_on_a_bulge("ON", 0.0)].map(|deck| run(&deck, &mesh));
    // Half a hundredth of a face is left to the nodes, and is where a ridge begins to answer.
    between("bulge", "deepest point of an edge, of a face", deepest_edge(&with, &mesh), 0.0, 0.01);
    at_least("bulge", "the same without ridges", deepest_edge(&without, &mesh), 0.05);
    // Over the middle itself, to which both ridges fall, and from one ridge to the other.
    for (beside, along) in [(0.0, 0.0), (-0.06, 6.0)] {
        let mesh = bar_over_a_bulge(beside);
        let run = run(&falling_on_a_bulge("ALL", along), &mesh);
        between("bulge, middle", "deepest point of an edge, of a face", deepest_edge(&run, &mesh), 0.0, 0.01);
    }
    between("bulge", "worst energy balance", with.worst_balance(), 0.0, 1e-3);
    let on_two = run_on(2, &deck, &mesh).whole();
    assert!(bits(&on_two, &mesh) == bits(&with, &mesh), "positions differ on two ranks");
}

/// Half of a rail and half of a slider on it, cut by a plane of symmetry; both slope there, so that what presses on the rail has its
/// foot beside it.
fn slider_in_a_plane_of_symmetry() -> Mesh {
    let mut mesh = recipe(
        "TITLE\n slider\nBOX, 1, 0., 0., -0.1, 0.8, 0.1, 0.1, 8, 1, 1\nBOX, 2, 0.02, 0., 0., 0.16, 0.08, 0.08, 2, 1, 1\n\
         SIDE SET PLANE, 10, Z, 0.08\n",
    );
    add_node_set(&mut mesh, 1, |p| p[1] == 0.0);
    add_node_set(&mut mesh, 2, |p| p[2] < -0.09);
    mesh.coordinates.iter_mut().for_each(|at| at[2] += 0.1 * at[1]);
    mesh
}

#[test]
fn what_slides_along_a_plane_of_symmetry_stays_outside() {
    let mesh = slider_in_a_plane_of_symmetry();
    let deck = format!(
        "TITLE\n slider\nTERMINATION TIME, 0.025\nOUTPUT TIME, 1.E-3\nPLOT TIME, 1.E-3\n\
         PLOT NODAL, DISPLACEMENT, VELOCITY, CONTACT\nINITIAL VELOCITY MATERIAL, 2, 20., 0., 0.\nCONTACT MATERIAL\n\
         NO DISPLACEMENT, Y, 1\nNO DISPLACEMENT, X, 2\nNO DISPLACEMENT, Y, 2\nNO DISPLACEMENT, Z, 2\n\
         FUNCTION, 1\n0., 1.\n1., 1.\nEND\nPRESSURE, 10, 1, 1.E6\n{}{}",
        elastic(1, 2000., 1e9, 0.3),
        elastic(2, 2000., 1e9, 0.3)
    );
    let run = run(&deck, &mesh);
    let skin = Skin::with_symmetry(&mesh, 1);
    // Passes leave a hundred-thousandth of a face; a node that is lost sinks in by as much as the slider is pressed flat.
    between("slider", "deepest node, of a face", deepest_of(&run, &mesh, |at| skin.inside(at)), 0.0, 1e-3);
    let node = node_of_slider(&mesh);
    let way = run.end().positions(&mesh)[node][0] - mesh.coordinates[node][0];
    at_least("slider", "way, in faces", way / 0.1, 4.0);
}

/// A node of the slider in the plane of symmetry.
fn node_of_slider(mesh: &Mesh) -> usize {
    let of_slider = |at: &[f64; 3]| at[1] == 0.0 && at[2] > 0.07;
    mesh.coordinates.iter().position(of_slider).expect("the slider's upper side")
}

#[test]
fn folds_are_the_same_on_any_number_of_ranks() {
    let mesh = tent(4);
    let deck = folding("ALL");
    let one = bits(&run(&deck, &mesh), &mesh);
    for ranks in [2, 3, 5] {
        assert!(bits(&run_on(ranks, &deck, &mesh).whole(), &mesh) == one, "positions differ on {ranks} ranks");
    }
}

#[test]
fn overlaps_too_deep_to_be_taken_out_are_told() {
    let mesh = recipe(
        "TITLE\n deep\nBOX, 1, 0., 0., 0., 0.01, 0.01, 0.01, 4, 4, 4\n\
         BOX, 2, 0.003, 0.003, 0.004, 0.004, 0.004, 0.012, 2, 2, 3\n",
    );
    let deck = format!(
        "TITLE\n deep\nTERMINATION TIME, 1.E-7\nCONTACT MATERIAL\n{}{}",
        elastic(1, 7850., 200e9, 0.3),
        elastic(2, 7850., 200e9, 0.3)
    );
    let overlap = Body::new(&mesh, &model(&deck, &mesh)).expect("materials").overlap;
    // The lower nine nodes and the eight around the middle of the column, and the node of the cube's top in the column.
    assert_eq!((overlap.nodes, overlap.deep.nodes), (0, 18));
    assert!((overlap.deep.deepest - 0.004).abs() < 1e-12, "{:?}", overlap.deep);
    assert_eq!(mesh.coordinates[overlap.deep.node as usize].map(|x| (1e3 * x).round()), [5.0, 5.0, 4.0]);
    let told = overlap.refusal(&mesh).unwrap_or_default();
    assert!(told.contains("18 nodes") && told.contains("4.0000e-3"), "{told}");
}

/// Height at which the ridge of the second knife lies on that of the first.
const LEVEL: f64 = 2.0 * std::f64::consts::FRAC_1_SQRT_2;

/// Two knives whose ridges cross: the upper one, of so many elements, is turned about the vertical by an angle in degrees and moved.
fn knives(elements: &str, turn: f64, [x, y, z]: [f64; 3]) -> Mesh {
    recipe(&format!(
        "TITLE\n knives\nBOX, 1, -1., -0.5, -0.5, 2., 1., 1., 4, 2, 2\nROTATE, 1, X, 45.\nBOX, 2, -0.5, -1., -0.5, 1., 2., 1., {elements}\n\
         ROTATE, 2, Y, 45.\nROTATE, 2, Z, {turn:?}\nTRANSLATE, 2, {x:?}, {y:?}, {z:?}\n"
    ))
}

/// A deck in which the upper knife begins at a velocity; the speed of sound is 116.
fn knives_deck([x, y, z]: [f64; 3], [end, plots]: [f64; 2], more: &str) -> String {
    format!(
        "TITLE\n knives\nTERMINATION TIME, {end:?}\nPLOT TIME, {plots:?}\nPLOT NODAL, DISPLACEMENT, VELOCITY, MASS\nCONTACT MATERIAL\n\
         {more}INITIAL VELOCITY MATERIAL, 2, {x:?}, {y:?}, {z:?}\n{}{}",
        elastic(1, 1000., 1e7, 0.3),
        elastic(2, 1000., 1e7, 0.3)
    )
}

/// Asserts that two and three ranks have the bits of a run on one.
#[track_caller]
fn same_on_ranks(case: &str, run: &Run, (deck, mesh): (&str, &Mesh)) {
    for ranks in [2, 3] {
        assert!(bits(&run_on(ranks, deck, mesh), mesh) == bits(run, mesh), "{case} are others on {ranks} ranks");
    }
}

/// Two knives that cross where their meshes have nodes, or near them. Those of the first struck the flank of the other, slid off to the side, and
/// the edges went through: by 0.35 of a face.
#[test]
fn knives_that_cross_near_nodes_hold_each_other() {
    let deck = knives_deck([0., 0., -3.], [0.13, 0.01], "");
    for [x, y] in [[0.0, 0.0], [0.0, 0.12], [5e-4, 0.12], [0.12, 0.003], [0.01, -0.01], [0.03, 0.12], [0.12, 0.12]] {
        let mesh = knives("2, 4, 2", 0.0, [x, y, LEVEL + 0.01]);
        let run = run(&deck, &mesh);
        let case = format!("knives at {x}, {y}");
        nothing_deeper(&case, &run, (&mesh, &Skin::new(&mesh)), [0.005, 0.005]);
        // Equal bodies that meet centrally exchange their momentum, less what goes on as vibration; what went through kept half of it.
        let falls = mean_velocity(run.end(), &nodes_of(&mesh, 2))[2];
        between(&case, "velocity after, of -3", falls, -0.3, 0.0);
        same_on_ranks(&case, &run, (&deck, &mesh));
    }
}

/// A knife that slides along another, which it just touches, without friction or load: nothing pushes it. Where it came to a node of the other, level
/// with its own edge but for round-off, its flank stopped that node: a hundredth of the speed was lost at each, and it rose.
#[test]
fn a_knife_slides_along_a_knife_past_its_nodes() {
    let rigid = "RIGID BODY, 2\n";
    // In each other by less than anything, too: nothing is moved, and what is inside slides on inside.
    for (y, turn, overlap, rigid) in [
        (0.0, 0.0, 0.0, ""),
        (0.0, 0.0, 1e-10, ""),
        (0.1, 30.0, 0.0, ""),
        (0.1, 0.0, 0.0, rigid),
        (0.0, 30.0, 1e-12, rigid),
    ] {
        let deck = knives_deck([1., 0., 0.], [0.5, 0.1], rigid);
        let mesh = knives("2, 4, 2", turn, [0.1, y, LEVEL - overlap]);
        let run = run(&deck, &mesh);
        // From x = 0.1 to 0.6, past the node at 0.5; round-off of the mesh is what is left.
        let [x, y, z] = mean_velocity(run.end(), &nodes_of(&mesh, 2));
        let off = (x - 1.0).abs().max(y.abs()).max(z.abs());
        assert!(off < 1e-9, "turned by {turn}, {overlap}, {rigid}: {x} {y} {z}");
        same_on_ranks(&format!("knives turned by {turn}, {rigid}"), &run, (&deck, &mesh));
    }
}

/// Knives that strike each other at a tenth of their speed of sound bend each other into valleys, where the touch goes from one edge to the next:
/// both hold, and neither knife goes in. At bends of more than 37 degrees, and where what slid came to a valley, edges let go: of 200 such pairs 187 went in,
/// by up to half an element.
#[test]
fn knives_that_bend_each_other_hand_the_touch_on() {
    let deck = knives_deck([0., 0., -10.], [0.08, 0.004], "");
    for ([x, y], turn, elements) in
        [([0.1, 1e-4], 0.0, "2, 5, 2"), ([0.25, 0.01], 30.0, "3, 6, 3"), ([-0.5, 0.25], 10.0, "2, 4, 2")]
    {
        let mesh = knives(elements, turn, [x, y, LEVEL + 0.01]);
        let run = run(&deck, &mesh);
        let case = format!("knives at {x}, {y}");
        // Five hundredths are what edges may sink in by; where flanks are bent like this, lines of theirs do by 3.5.
        nothing_deeper(&case, &run, (&mesh, &Skin::new(&mesh)), [0.01, 0.05]);
        same_on_ranks(&case, &run, (&deck, &mesh));
    }
}

/// Two roofs whose ridges, bent by angles in degrees, cross between the nodes of both, 0.4 from the nearest: three cells of unit length along each ridge.
fn roofs(bends: [f64; 2]) -> Mesh {
    let mut mesh = recipe(
        "TITLE\n roofs\nBOX, 1, -1., -1.5, -1., 2., 3., 1., 2, 3, 1\nBOX, 2, -1.5, -1., 0.02, 3., 2., 1., 3, 2, 1\nTRANSLATE, 2, 0.1, 0., 0.\n",
    );
    let [lower, upper] = bends.map(|bend| (0.5 * bend.to_radians()).tan());
    for [x, y, z] in &mut mesh.coordinates {
        *z += if *z < 0.01 { -lower * x.abs() } else { upper * y.abs() };
    }
    mesh
}

/// Ridges of which neither is sharp passed each other between their nodes, by up to ½ tan β/2 of a face: 13 % where both are bent by 30 degrees. Those that
/// are bent by ten degrees and more hold each other now as sharp edges hold lines; flatter ones still pass, by as much as that says.
#[test]
fn ridges_that_are_not_sharp_hold_each_other_between_their_nodes() {
    let deck = knives_deck([0., 0., -3.], [0.03, 1e-3], "");
    let deepest = |bends| {
        let mesh = roofs(bends);
        let run = run(&deck, &mesh);
        same_on_ranks("roofs", &run, (&deck, &mesh));
        deepest_edge(&run, &mesh)
    };
    for bends in [[11.0, 11.0], [20.0, 20.0], [29.0, 29.0], [11.0, 29.0], [29.0, 40.0]] {
        // Half a hundredth is what lines leave.
        between(&format!("roofs bent by {bends:?}"), "deepest point of an edge, of a face", deepest(bends), 0.0, 0.006);
    }
    let bound = 0.4 * (4.5f64).to_radians().tan();
    between("roofs bent by 9", "deepest point of an edge, of a face", deepest([9.0, 9.0]), 0.5 * bound, bound + 0.005);
}
