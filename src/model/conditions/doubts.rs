//! Conditions that are allowed, and most likely not meant: what acts twice, is undone, or goes into a support.

use super::boundary::direction;
use crate::common::vector::{cross, dot, subtract};
use crate::deck::{Card, Diagnostic, Diagnostics};
use crate::mesh::{Block, Mesh, Shape, SideSet, check::counted, exterior};
use crate::model::check::moves;
use crate::model::{Direction, Model, Problem};

/// A thickness over the longest edge of a shell from which on it is told: no theory of shells holds there, and most likely a unit is wrong.
const THICK: f64 = 2.0;

/// Cosine between a face's normal and an axis from which on what is held along the axis is held along the normal.
const SQUARE: f64 = 0.99;

/// Warns of all of them.
pub fn check(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    given_twice(problem, found);
    radial_gravity(problem, found);
    undone_rotations(problem, mesh, found);
    thick_shells(problem, mesh, found);
    let held = [Direction::X, Direction::Y, Direction::Z].map(|axis| held_nodes(problem, mesh, axis));
    for card in problem.deck.cards.iter().filter(|card| card.complete) {
        match card.name.as_str() {
            "PRESSURE" => {
                inner_faces(card, mesh, "it pushes on elements on both sides of these faces, or from within", found);
                faces_twice(card, mesh, found);
            }
            "SILENT BC" => {
                inner_faces(card, mesh, "dashpots there hold the inside of a body back", found);
                held_silent_faces(card, mesh, &held, found);
            }
            "PRESCRIBED FORCE" => held_loads(card, mesh, &held, found),
            _ => (),
        }
    }
}

/// Loads and rotations that are given a second time in the same words: they act twice.
fn given_twice(problem: &Problem, found: &mut Diagnostics) {
    for name in ["PRESSURE", "GRAVITY", "INITIAL VELOCITY ANGULAR"] {
        let cards: Vec<&Card> = problem.deck.cards_of(name).filter(|card| card.complete).collect();
        for (place, card) in cards.iter().enumerate() {
            let Some(first) = cards[..place].iter().find(|first| first.says_the_same(card)) else { continue };
            found.push(
                Diagnostic::warning(format!("{name}: the same line stands in the deck twice, and acts twice"))
                    .at(card.record, "adds to the first")
                    .at(first.record, "says the same")
                    .help("take one of the two out, or write the sum once"),
            );
        }
    }
}

/// Says of how many faces of a command's side set something holds, and of which side of which element first.
fn some_faces(card: &Card, mesh: &Mesh, set: &SideSet, what: &str, (count, first, side): (usize, u32, u8)) -> String {
    let (all, element) = (set.sides.len(), mesh.element_ids[first as usize]);
    let set = set.id;
    format!(
        "{}: {count} of the {all} faces of side set {set} are {what}, side {} of element {element} first",
        card.name,
        side + 1
    )
}

/// Faces that a side set names more than once, as it does where parts of a mesh are joined: a pressure acts on each once.
fn faces_twice(card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    let Some(set) = card.maybe_integer("side_set").and_then(|id| mesh.side_set(id)) else { return };
    let mut sides = set.sides.clone();
    sides.sort_unstable();
    let Some(&[(first, side), _]) = sides.windows(2).find(|pair| pair[0] == pair[1]) else { return };
    sides.dedup();
    let message = some_faces(card, mesh, set, "named before in it", (set.sides.len() - sides.len(), first, side));
    found.push(
        Diagnostic::warning(message)
            .at(card.place("side_set"), "each face is pressed once, however often it is named")
            .help("if the load is meant to act twice there, write a second line with a side set of these faces"),
    );
}

/// Gravity along the radius of bodies of revolution: it pushes every point of a ring away from the axis, as no gravity does.
fn radial_gravity(problem: &Problem, found: &mut Diagnostics) {
    if !problem.model.analysis.about_axis() {
        return;
    }
    for card in problem.deck.cards_of("GRAVITY").filter(|card| card.complete && card.number("gx") != 0.0) {
        found.push(
            Diagnostic::warning(
                "GRAVITY: x is the radius in AXISYMMETRIC, so that gx pushes away from the axis all around",
            )
            .at(card.place("gx"), "a radial field, and no gravity of a body")
            .help("gravity along the axis is gy; across it a body of revolution does not stay one"),
        );
    }
}

/// Rotations at the start that a later command on the same nodes undoes: it sets velocities, and only ANGULAR adds to them.
fn undone_rotations(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let initial = |card: &&Card| card.complete && card.name.starts_with("INITIAL VELOCITY");
    let cards: Vec<&Card> = problem.deck.cards.iter().filter(initial).collect();
    let (angular, mut turns) = ("INITIAL VELOCITY ANGULAR", vec![false; mesh.coordinates.len()]);
    for (place, card) in cards.iter().enumerate().filter(|(_, card)| card.name == angular) {
        turns.fill(false);
        nodes_of(card, mesh).iter().for_each(|&node| turns[node as usize] = true);
        let all = turns.iter().filter(|turns| **turns).count();
        for later in cards[place..].iter().filter(|later| later.name != angular) {
            let mut undone: Vec<u32> = nodes_of(later, mesh).to_vec();
            undone.retain(|&node| turns[node as usize]);
            undone.sort_unstable();
            undone.dedup();
            let Some(first) = undone.first() else { continue };
            let message = format!(
                "{}: undoes the rotation that {angular} has given to {} of the {all} nodes of block {}, node {} first",
                later.name,
                undone.len(),
                card.integer("block"),
                mesh.node_ids[*first as usize]
            );
            found.push(
                Diagnostic::warning(message)
                    .at(later.record, "sets the velocity of these nodes anew")
                    .at(card.record, "has added a rotation to it before")
                    .help("write ANGULAR behind it: it adds to the velocity that nodes have by then"),
            );
        }
    }
}

/// The nodes that a command names by block or node set.
fn nodes_of<'a>(card: &Card, mesh: &'a Mesh) -> &'a [u32] {
    let of_block =
        card.maybe_integer("block").and_then(|id| mesh.block_index(id)).map(|index| &mesh.blocks[index].nodes);
    let of_set = || card.maybe_integer("node_set").and_then(|id| mesh.node_set(id)).map(|set| &set.nodes);
    of_block.or_else(of_set).map_or(&[], |nodes| nodes)
}

/// Shells that are thicker than they are wide.
fn thick_shells(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let model = &problem.model;
    let mut numbers = &mesh.element_ids[..];
    for block in &mesh.blocks {
        let Some((own, others)) = numbers.split_at_checked(block.len()) else { return };
        numbers = others;
        if !block.shape.is_surface() || model.is_rigid(block.id) {
            continue;
        }
        let ratios = thickness_over_edge(block, mesh, model);
        let Some((worst, ratio)) = ratios.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else {
            continue;
        };
        let (id, count) = (block.id, ratios.iter().filter(|ratio| **ratio > THICK).count());
        if count == 0 {
            continue;
        }
        let message = format!(
            "SHELL THICKNESS: {count} of the {} shells of block {id} are more than {THICK} times as thick as their longest edge, element {} \
             {ratio:.3e} times",
            block.len(),
            own[worst]
        );
        let warning = Diagnostic::warning(message).help(
            "see whether the thickness is in the mesh's unit of length; what is really so thick is for hexahedra",
        );
        let places = problem.places_of_block(id, |name| name == "SHELL THICKNESS" || name == "THICKNESS SCALE");
        found.push(places.into_iter().fold(warning, |warning, place| warning.at(place, format!("for block {id}"))));
    }
}

/// Thickness of each shell of a block over its longest edge; 0 where there is no thickness, which is another mistake.
fn thickness_over_edge(block: &Block, mesh: &Mesh, model: &Model) -> Vec<f64> {
    let given = model.section("SHELL THICKNESS", block.id).map(|section| section.number("thickness"));
    let scale = model.section("THICKNESS SCALE", block.id).map_or(1.0, |section| section.number("factor"));
    let ratio = |(element, nodes): (usize, &[u32])| {
        let thickness = scale * given.or(block.attributes_of(element).first().copied()).unwrap_or(0.0);
        let edges = block.shape.edges().iter().map(|ends| {
            let [a, b] = ends.map(|corner| mesh.coordinates[nodes[corner] as usize]);
            dot(subtract(b, a), subtract(b, a))
        });
        Some(thickness / edges.fold(0.0, f64::max).sqrt()).filter(|ratio| ratio.is_finite()).unwrap_or(0.0)
    };
    block.elements().enumerate().map(ratio).collect()
}

/// Faces of a load that two solids share.
fn inner_faces(card: &Card, mesh: &Mesh, outcome: &str, found: &mut Diagnostics) {
    let Some(set) = card.maybe_integer("side_set").and_then(|id| mesh.side_set(id)) else { return };
    let mut wanted = vec![false; mesh.coordinates.len()];
    mesh.side_set_nodes(set.id).iter().for_each(|&node| wanted[node as usize] = true);
    let outside = exterior::exterior(mesh.shaped(), wanted.len(), |node| wanted[node as usize]);
    let elements = mesh.connectivity();
    let is_inside = |&&(element, side): &&(u32, u8)| {
        let shape = elements.shape(element as usize);
        let face = shape.face(&elements[element as usize], side).filter(|_| shape.is_solid());
        let number = element * exterior::SIDES as u32 + u32::from(side);
        face.is_some_and(|face| exterior::key_of(shape, face).is_some()) && outside.binary_search(&number).is_err()
    };
    let mut inside = set.sides.iter().filter(is_inside);
    let Some(&(first, side)) = inside.next() else { return };
    let message = some_faces(card, mesh, set, "inside a body", (1 + inside.count(), first, side));
    found.push(
        Diagnostic::warning(message)
            .at(card.place("side_set"), outcome)
            .help("name faces of the outside only: two elements share these, whose blocks are one body"),
    );
}

/// Which nodes are held or driven in a direction.
fn held_nodes(problem: &Problem, mesh: &Mesh, axis: Direction) -> Vec<bool> {
    let mut held = vec![false; mesh.coordinates.len()];
    for card in problem.deck.cards.iter().filter(|card| moves(card, axis)) {
        nodes_of(card, mesh).iter().for_each(|&node| held[node as usize] = true);
    }
    held
}

/// Forces on nodes that are held in their direction.
fn held_loads(card: &Card, mesh: &Mesh, held: &[Vec<bool>; 3], found: &mut Diagnostics) {
    let Some(id) = card.maybe_integer("node_set") else { return };
    let (nodes, direction) = (mesh.distinct_nodes(id), direction(card));
    let mut idle = nodes.iter().filter(|node| held[direction.axis()][**node as usize]);
    let Some(&first) = idle.next() else { return };
    let message = format!(
        "PRESCRIBED FORCE: {} of the {} of node set {id} are held or driven in {direction:?}, node {} first",
        1 + idle.count(),
        counted(nodes.len(), "node"),
        mesh.node_ids[first as usize]
    );
    found.push(
        Diagnostic::warning(message)
            .at(card.place("node_set"), "the force on them goes into what holds them, and moves nothing")
            .help("take them out of one of the two sets"),
    );
}

/// Dashpots on faces that do not move along their normal.
fn held_silent_faces(card: &Card, mesh: &Mesh, held: &[Vec<bool>; 3], found: &mut Diagnostics) {
    let Some(set) = card.maybe_integer("side_set").and_then(|id| mesh.side_set(id)) else { return };
    let elements = mesh.connectivity();
    let is_held = |&(element, side): &(u32, u8)| {
        let shape = elements.shape(element as usize);
        let Some(face) = shape.face(&elements[element as usize], side) else { return false };
        let along = normal_axis(shape, face.map(|node| mesh.coordinates[node as usize]));
        along.is_some_and(|axis| face.iter().all(|&node| held[axis][node as usize]))
    };
    let mut idle = set.sides.iter().filter(|side| is_held(side));
    let Some(&(first, _)) = idle.next() else { return };
    let message = format!(
        "SILENT BC: {} of the {} faces of side set {} are held along their normal, that of element {} first",
        1 + idle.count(),
        set.sides.len(),
        set.id,
        mesh.element_ids[first as usize]
    );
    found.push(
        Diagnostic::warning(message)
            .at(card.place("side_set"), "a boundary that does not move sends every wave back")
            .help("let these nodes free in that direction, or take SILENT BC out"),
    );
}

/// The axis of space along which the normal of a face is, if there is one.
fn normal_axis(shape: Shape, [a, b, c, d]: [[f64; 3]; 4]) -> Option<usize> {
    let edge = subtract(b, a);
    let normal = match shape {
        Shape::Plane => [edge[1], -edge[0], 0.0],
        _ => cross(subtract(c, a), subtract(d, b)),
    };
    let size = dot(normal, normal).sqrt();
    normal.iter().position(|component| component.abs() > SQUARE * size)
}

#[cfg(test)]
mod tests {
    use crate::deck::Source;
    use crate::mesh::exterior::faces;
    use crate::mesh::{Shape, SideSet};
    use crate::mesher::make;
    use crate::model::examine;

    /// What is said of a deck of two boxes of 2 x 2 x 2 elements that share a face at x = 1, with these lines.
    fn told(lines: &str) -> String {
        let recipe = "BOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\nBOX, 2, 1., 0., 0., 1., 1., 1., 2, 2, 2\nMERGE\n\
                      SHEET, 3, 5., 0., 0., 1., 1., 0., 2, 2\nNODE SET PLANE, 1, X, 0.\nNODE SET PLANE, 2, Y, 0.\n\
                      SIDE SET PLANE, 1, X, 0.\n";
        let mut mesh = make(recipe, "recipe", 1).unwrap_or_else(|found| panic!("{}", found.render(false)));
        let at_one = |face: &(u8, [u32; 4])| face.1.iter().all(|&node| mesh.coordinates[node as usize][0] == 1.0);
        let of_first = (0..).zip(mesh.blocks[0].elements()).flat_map(|(element, nodes)| {
            faces(Shape::Hexahedron, nodes).filter(at_one).map(move |(side, _)| (element, side))
        });
        let sides: Vec<(u32, u8)> = of_first.collect();
        let outside = mesh.side_sets[0].sides.clone();
        let twice = outside.iter().chain(&outside[1..3]).copied().collect();
        mesh.side_sets.push(SideSet { id: 2, name: String::new(), sides });
        mesh.side_sets.push(SideSet { id: 3, name: String::new(), sides: twice });
        let law = |block| format!("MATERIAL, {block}, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n");
        let deck = format!(
            "TERMINATION TIME, 1.\n{}FUNCTION, 1\n0., 1.\n1., 1.\nEND\n{}{lines}EXIT\n",
            [1, 2, 3].map(law).concat(),
            if lines.contains("SHELL THICKNESS") { "" } else { "SHELL THICKNESS, 3, 0.1\n" }
        );
        match examine(Source::new("t.i", &deck), Some(&mesh)) {
            Ok(problem) => problem.diagnostics.render(false),
            Err(found) => panic!("{}", found.render(false)),
        }
    }

    #[track_caller]
    fn says(lines: &str, wanted: &str) {
        let said = told(lines);
        assert!(said.contains(wanted), "{lines}: {said}");
    }

    #[track_caller]
    fn is_silent(lines: &str) {
        let said = told(lines);
        assert!(!said.contains("warning"), "{lines}: {said}");
    }

    #[test]
    fn loads_that_are_given_twice_are_told() {
        says("PRESSURE, 1, 1, 2.\nPRESSURE, 1, 1, 2.\n", "PRESSURE: the same line stands in the deck twice");
        says("GRAVITY, 0., 0., -9.81\nGRAVITY, 0., 0., -9.81\n", "GRAVITY: the same line stands in the deck twice");
        let angular = "INITIAL VELOCITY ANGULAR, 1, 5.\n";
        let twice = format!("{angular}{angular}PRESSURE, 1, 1, 2.\n");
        says(&twice, "INITIAL VELOCITY ANGULAR: the same line stands in the deck twice, and acts twice");
        is_silent("PRESSURE, 1, 1, 2.\nPRESSURE, 1, 1, 3.\nGRAVITY, 0., 0., -9.81, 1\n");
    }

    #[test]
    fn faces_that_a_set_names_twice_are_told() {
        says("PRESSURE, 3, 1, 1.\n", "PRESSURE: 2 of the 6 faces of side set 3 are named before in it");
    }

    /// The face between the boxes has 2 x 2 elements on either side, and the plane at x = 0 has 9 nodes, 3 of them
    /// among the 15 and those 3 of the sheet at y = 0.
    #[test]
    fn loads_inside_a_body_and_on_what_is_held_are_told() {
        says("PRESSURE, 2, 1, 1.\n", "PRESSURE: 4 of the 4 faces of side set 2 are inside a body");
        says("SILENT BC, 2\nPRESSURE, 1, 1, 1.\n", "SILENT BC: 4 of the 4 faces of side set 2 are inside a body");
        says(
            "PRESCRIBED FORCE, X, 2, 1\nNO DISPLACEMENT, X, 1\n",
            "3 of the 18 nodes of node set 2 are held or driven in X",
        );
        is_silent("PRESCRIBED FORCE, Y, 1, 1\nNO DISPLACEMENT, X, 1\n");
        let silent = "PRESSURE, 1, 1, 1.\nSILENT BC, 1\nNO DISPLACEMENT";
        says(&format!("{silent}, X, 1\n"), "SILENT BC: 4 of the 4 faces of side set 1 are held along their normal");
        is_silent(&format!("{silent}, Y, 1\n"));
    }

    #[test]
    fn gravity_along_a_radius_is_told() {
        let mesh = make("RECTANGLE, 1, 0., 0., 1., 1., 1, 1", "recipe", 1)
            .unwrap_or_else(|found| panic!("{}", found.render(false)));
        let told = |lines: &str| {
            let law = "MATERIAL, 1, ELASTIC, 1.\nYOUNGS MODULUS = 1.\nPOISSONS RATIO = 0.\nEND\n";
            let deck = format!("TERMINATION TIME, 1.\n{law}{lines}\nEXIT\n");
            match examine(Source::new("t.i", &deck), Some(&mesh)) {
                Ok(problem) => problem.diagnostics.render(false),
                Err(found) => panic!("{}", found.render(false)),
            }
        };
        assert!(told("AXISYMMETRIC\nGRAVITY, 1., 0.").contains("GRAVITY: x is the radius"));
        for lines in ["AXISYMMETRIC\nGRAVITY, 0., 1.", "PLANE STRAIN\nGRAVITY, 1., 0."] {
            assert!(!told(lines).contains("GRAVITY"), "{}", told(lines));
        }
    }

    #[test]
    fn rotations_that_are_undone_are_told() {
        let (angular, nodes) = ("INITIAL VELOCITY ANGULAR, 1, 5.\n", "INITIAL VELOCITY NODESET, 1, 1.\n");
        says(&format!("{angular}{nodes}GRAVITY, 0., 0., 1., 1\n"), "to 9 of the 27 nodes of block 1");
        is_silent(&format!("{nodes}{angular}GRAVITY, 0., 0., 1., 1\n"));
    }

    /// Edges are half as long as the sheet.
    #[test]
    fn shells_that_are_blocks_are_told() {
        let load = "GRAVITY, 0., 0., 1., 1\n";
        says(
            &format!("SHELL THICKNESS, 3, 1.5\n{load}"),
            "4 of the 4 shells of block 3 are more than 2 times as thick",
        );
        says(&format!("SHELL THICKNESS, 3, 1.5\n{load}"), "3.000e0 times");
        is_silent(&format!("SHELL THICKNESS, 3, 0.9\n{load}"));
    }
}
