//! A problem against its mesh: everything that the deck names exists, and every block has a material.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    Analysis, Contact, Direction, Problem, RigidSurface,
    conditions::{boundary::direction, doubts},
    interactions::{contact, rigid, tied},
    materials::explosive,
    problem::those_there_are,
    without_effect,
};
use crate::{
    deck::{Card, Diagnostic, Diagnostics, Item, Kind, language},
    mesh::{
        Mesh, Shape,
        check::{Doubled, doubled},
        locate::locate,
    },
};

/// Holds a problem against a mesh. Reports node sets, side sets and blocks that the mesh does not have, empty ones,
/// blocks without a material, and nodes that two commands move differently in the same direction.
pub fn check(problem: &Problem, mesh: &Mesh) -> Diagnostics {
    let mut found = Diagnostics::new(problem.deck.source.clone());
    if !dimensions(problem, mesh, &mut found) {
        return found;
    }
    for card in problem.deck.cards.iter().filter(|card| card.complete) {
        references(card, mesh, &mut found);
        if found.is_full() {
            return found;
        }
    }
    for card in problem.deck.cards.iter().filter(|card| card.complete) {
        unused_factors(card, mesh, &mut found);
        sides_without_faces(card, mesh, &mut found);
        both_faces_of_shells(card, mesh, &mut found);
        elements_of_others(card, mesh, &mut found);
    }
    blocks_without_material(problem, mesh, &mut found);
    explosive::report_lit_too_late(problem, mesh, &mut found);
    for axis in [Direction::X, Direction::Y, Direction::Z] {
        conflicts(problem, mesh, axis, &mut found);
    }
    for (plane, card) in problem.model.rigid_surfaces.iter().zip(problem.deck.cards_of("RIGID SURFACE")) {
        behind_the_plane(plane, card, mesh, &mut found);
    }
    for (&point, card) in problem.model.material_points.iter().zip(problem.deck.cards_of("MATERIAL POINT")) {
        outside_the_mesh(point, card, mesh, &mut found);
    }
    for card in problem.deck.cards_of("HISTORY NODE").filter(|card| card.complete) {
        nodes_there(card, mesh, &mut found);
    }
    for card in problem.deck.cards_of("HISTORY RIGID SURFACE").filter(|card| card.complete) {
        walls_there(card, problem, &mut found);
    }
    for card in problem.deck.cards_of("HISTORY CONTACT").filter(|card| card.complete) {
        contact_there(card, problem, mesh, &mut found);
    }
    without_effect::check(problem, mesh, &mut found);
    elements_twice(mesh, &mut found);
    doubts::check(problem, mesh, &mut found);
    contact::check(problem, mesh, &mut found);
    rigid::check(problem, mesh, &mut found);
    tied::check(problem, mesh, &mut found);
    found
}

/// Warns of a command about the elements of a block whose shape it says nothing of.
fn elements_of_others(card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    let Some((shapes, called)) = language().entry(&card.name).and_then(|entry| entry.shapes.as_ref()) else { return };
    let block = card.maybe_integer("block").and_then(|id| mesh.block_index(id)).map(|place| &mesh.blocks[place]);
    if let Some(block) = block.filter(|block| !shapes.iter().any(|shape| shape == block.shape.kind())) {
        let [_, elements] = block.shape.names();
        let message = format!("{}: block {} is of {elements}, so that nothing follows from this", card.name, block.id);
        found.push(Diagnostic::warning(message).at(card.record, format!("this is for {called}")));
    }
}

/// Warns of solids and shells that are in the mesh twice, as a part is that was exported or copied twice and then joined.
fn elements_twice(mesh: &Mesh, found: &mut Diagnostics) {
    let Some(Doubled { count, first }) = doubled(mesh) else { return };
    let [one, other] = first.map(|place| {
        let block = mesh.elements().nth(place as usize).map_or(0, |(block, _)| mesh.blocks[block].id);
        format!("element {} of block {block}", mesh.element_ids[place as usize])
    });
    let which = if count == 1 { "1 element has".to_owned() } else { format!("{count} elements have") };
    found.push(
        Diagnostic::warning(format!("{which} the same nodes as another one: {other} those of {one}"))
            .help("mass and stiffness are there twice; take one of the two out of the mesh, unless both are meant"),
    );
}

/// Whether deck and mesh have the same number of dimensions, and no body of revolution crosses its axis; reports it.
fn dimensions(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) -> bool {
    let analysis = problem.model.analysis;
    let card = ["AXISYMMETRIC", "PLANE STRAIN"].into_iter().find_map(|name| problem.deck.cards_of(name).next());
    if analysis.dimension() != mesh.dimension {
        found.push(match card {
            Some(card) => Diagnostic::error(format!("{}: the mesh is three-dimensional", card.name))
                .at(card.record, "a mesh of quadrilaterals in the x-y plane is wanted")
                .help("take this line out, or name a two-dimensional mesh"),
            None => {
                Diagnostic::error("the mesh is two-dimensional, and the deck has neither AXISYMMETRIC nor PLANE STRAIN")
                    .help("add the line AXISYMMETRIC for bodies of revolution about the y axis, or PLANE STRAIN")
            }
        });
        return false;
    }
    if analysis.about_axis() {
        let positions = crate::mesh::plane::on_axis(mesh);
        let beyond = positions.iter().zip(&mesh.node_ids).filter(|(x, _)| x[0] < 0.0);
        if let Some((x, id)) = beyond.clone().min_by(|a, b| a.0[0].total_cmp(&b.0[0])) {
            let place = card.map(|card| card.record).unwrap_or_default();
            found.push(
                Diagnostic::error(format!(
                    "AXISYMMETRIC: {} of the mesh have a negative x, the farthest is node {id} at {:.4e}",
                    crate::mesh::check::counted(beyond.count(), "node"),
                    x[0]
                ))
                .at(place, "x is the distance from the axis")
                .help("model one half of the section, at positive x"),
            );
        }
        if analysis == Analysis::AxisymmetricCompatible {
            for name in ["CONTACT MATERIAL", "CONTACT SURFACE", "CONTACT NODE SET", "PRESCRIBED FORCE"] {
                for card in problem.deck.cards_of(name) {
                    found.push(
                        Diagnostic::error(format!(
                            "{name}: nodes on the axis have no mass in AXISYMMETRIC, COMPATIBLE"
                        ))
                        .at(card.record, "this asks for the masses of nodes")
                        .help("AXISYMMETRIC alone has contact and forces on nodes"),
                    );
                }
            }
        }
        for card in problem.deck.cards_of("INITIAL VELOCITY ANGULAR") {
            found.push(
                Diagnostic::error("INITIAL VELOCITY ANGULAR: bodies of revolution do not turn in their section")
                    .at(card.record, "this turns about z"),
            );
        }
    }
    true
}

/// Reports nodes to watch that the mesh does not have.
fn nodes_there(card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    for item in card.items("node") {
        let (Some(id), Some(span)) = (item.value.integer(), item.span) else { continue };
        if !mesh.node_ids.contains(&id) {
            let ends = [mesh.node_ids.iter().min(), mesh.node_ids.iter().max()].map(|id| id.copied().unwrap_or(0));
            found.push(
                Diagnostic::error(format!("{}: the mesh has no node {id}", card.name))
                    .at(span, "no node of the mesh has this number")
                    .help(format!("its nodes are numbered from {} to {}", ends[0], ends[1])),
            );
        }
    }
}

/// Reports side sets to watch that meet no rigid surface.
fn walls_there(card: &Card, problem: &Problem, found: &mut Diagnostics) {
    for item in card.items("side_set") {
        let (Some(id), Some(span)) = (item.value.integer(), item.span) else { continue };
        if !problem.model.rigid_surfaces.iter().any(|plane| plane.side_set == id) {
            found.push(
                Diagnostic::error(format!("{}: side set {id} meets no rigid surface", card.name))
                    .at(span, "there is no RIGID SURFACE for this side set")
                    .help("the force on a node set is written by HISTORY NODE SET"),
            );
        }
    }
}

/// Reports blocks whose contact is to be watched and that touch nothing.
fn contact_there(card: &Card, problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let contact = &problem.model.contact;
    if !contact.is_some() {
        found.push(
            Diagnostic::error("HISTORY CONTACT: the deck has no contact between blocks")
                .at(card.record, "nothing touches")
                .help("CONTACT MATERIAL, 1, 2 lets blocks 1 and 2 touch; HISTORY RIGID SURFACE watches rigid surfaces"),
        );
        return;
    }
    for item in ["first", "second"].into_iter().flat_map(|field| card.items(field)) {
        let (Some(id), Some(span)) = (item.value.integer(), item.span) else { continue };
        let Some(block) = mesh.block_index(id) else { continue };
        if !takes_part(contact, id, block, mesh) {
            found.push(
                Diagnostic::error(format!("HISTORY CONTACT: block {id} takes part in no contact"))
                    .at(span, "no CONTACT MATERIAL or CONTACT SURFACE lets this block touch anything"),
            );
        }
    }
}

/// Whether faces or nodes of a block may touch something.
pub(super) fn takes_part(contact: &Contact, id: i64, block: usize, mesh: &Mesh) -> bool {
    let named = contact.names(id);
    let blocks: Vec<usize> = mesh.elements().map(|(block, _)| block).collect();
    let of_block = |&(element, _): &(u32, u8)| blocks.get(element as usize) == Some(&block);
    let mut sets = contact.surfaces.iter().flat_map(|pair| pair.side_sets).filter_map(|id| mesh.side_set(id));
    let mut of_sets: Vec<u32> =
        contact.node_sets.iter().flat_map(|(id, _)| mesh.node_set(*id)).fold(Vec::new(), |mut all, set| {
            all.extend(&set.nodes);
            all
        });
    of_sets.sort_unstable();
    let nodes = &mesh.blocks[block].nodes;
    named
        || sets.any(|set| set.sides.iter().any(of_block))
        || nodes.iter().any(|node| of_sets.binary_search(node).is_ok())
}

/// Warns of a point to watch where there is no material.
fn outside_the_mesh(point: [f64; 3], card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    let Some(nearest) = locate(mesh, point).filter(|located| located.outside > 0.0) else { return };
    let number = mesh.element_ids[nearest.element as usize];
    found.push(
        Diagnostic::warning("MATERIAL POINT: the point lies in no element of the mesh")
            .at(card.place("x").join(card.place("z")), format!("element {number}, the nearest, is watched instead"))
            .help("points are those of the undeformed mesh, in its unit of length"),
    );
}

/// Warns of a pressure or a motion on a set whose distribution factors would change it in other programs.
fn unused_factors(card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    /// Commands whose values other programs multiply by the factors.
    const SCALED: [&str; 4] = ["PRESSURE", "PRESCRIBED DISPLACEMENT", "PRESCRIBED VELOCITY", "PRESCRIBED ACCELERATION"];
    if !SCALED.contains(&card.name.as_str()) {
        return;
    }
    for (field, kind, weighted) in
        [("node_set", "node set", &mesh.weighted[0]), ("side_set", "side set", &mesh.weighted[1])]
    {
        if let Some(set) = card.maybe_integer(field).filter(|set| weighted.contains(set)) {
            found.push(
                Diagnostic::warning(format!("{}: the distribution factors of {kind} {set} are not used", card.name))
                    .at(card.place(field), "the mesh gives it factors other than 1, and all of it is loaded alike")
                    .help("for a load that varies over the set, make several sets"),
            );
        }
    }
}

/// Reports side sets of which sides are edges or ends of elements, where only faces have something to do: an error where none is a face.
fn sides_without_faces(card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    let field = match card.name.as_str() {
        "PRESSURE" | "SILENT BC" => "side_set",
        "TIED CONTACT" => "second",
        _ => return,
    };
    let Some(set) = card.maybe_integer(field).and_then(|id| mesh.side_set(id)) else { return };
    let is_face = |&&(element, side): &&(u32, u8)| mesh.shape_of(element).is_some_and(|shape| shape.is_face(side));
    let (id, count, faces) = (set.id, set.sides.len(), set.sides.iter().filter(is_face).count());
    if faces == count {
        return;
    }
    let which = if faces == 0 { format!("all {count}") } else { format!("{} of the {count}", count - faces) };
    let message = format!("{}: {which} sides of side set {id} are edges or ends of elements", card.name);
    let report = if faces == 0 { Diagnostic::error(message) } else { Diagnostic::warning(message) };
    found.push(
        report
            .at(card.place(field), "this acts on faces, and not on these")
            .help("sides 1 and 2 of a shell are its faces; PRESCRIBED FORCE loads the nodes of an edge"),
    );
}

/// Warns of side sets that hold both faces of shells, as those have that are picked by where their nodes are.
fn both_faces_of_shells(card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    let outcome = match card.name.as_str() {
        "PRESSURE" => "it pushes on both faces, which cancels",
        "SILENT BC" => "its dashpots act on both faces, and count twice",
        _ => return,
    };
    let Some(set) = card.maybe_integer("side_set").and_then(|id| mesh.side_set(id)) else { return };
    let is_shell = |element: u32| mesh.shape_of(element).is_some_and(Shape::is_surface);
    let of = |wanted: u8| {
        let elements = set.sides.iter().filter(move |&&(element, side)| side == wanted && is_shell(element));
        elements.map(|(element, _)| *element).collect::<BTreeSet<u32>>()
    };
    let (top, bottom) = (of(0), of(1));
    let mut twice = top.intersection(&bottom).peekable();
    let Some(&&first) = twice.peek() else { return };
    let (count, number) = (twice.count(), mesh.element_ids[first as usize]);
    let which = if count == 1 { "a shell".to_owned() } else { format!("{count} shells") };
    let message = format!("{}: side set {} holds both faces of {which}, element {number} first", card.name, set.id);
    found.push(
        Diagnostic::warning(message)
            .at(card.place("side_set"), outcome)
            .help("sides 1 and 2 of a shell are its faces: name one of them; in a recipe SIDE SET NORMAL does"),
    );
}

/// Warns of a rigid surface that does not have its body in front of it.
fn behind_the_plane(plane: &RigidSurface, card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    let nodes = mesh.side_set_nodes(plane.side_set);
    let gap = |node: u32| -> f64 {
        let x = mesh.coordinates[node as usize];
        (0..3).map(|i| (x[i] - plane.point[i]) * plane.normal[i]).sum()
    };
    // Round-off goes with the size of the coordinates, not of the gaps: they may all be next to nothing.
    let positions = nodes.iter().map(|&node| mesh.coordinates[node as usize]).chain([plane.point]);
    let extent = positions.flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let depths: Vec<f64> = nodes.iter().map(|&node| -gap(node)).filter(|&depth| depth > 1e-9 * extent).collect();
    let deepest = depths.iter().copied().fold(0.0, f64::max);
    let turned = "the normal must point from the plane to the body; check its sign, and the point";
    if !depths.is_empty() {
        let message = format!(
            "RIGID SURFACE: {} of the {} nodes of side set {} begin behind the plane, the farthest by {deepest:.4e}",
            depths.len(),
            nodes.len(),
            plane.side_set
        );
        found.push(
            Diagnostic::warning(message)
                .at(card.record, "each is stopped where it begins, not at the plane")
                .help(turned),
        );
    } else if body_is_behind(plane, mesh, gap) {
        found.push(
            Diagnostic::warning(format!(
                "RIGID SURFACE: the body with side set {} lies behind the plane",
                plane.side_set
            ))
            .at(card.record, "nothing will stop its nodes")
            .help(turned),
        );
    }
}

/// Whether the elements of a plane's side set are, on the mean, behind it.
fn body_is_behind(plane: &RigidSurface, mesh: &Mesh, gap: impl Fn(u32) -> f64) -> bool {
    let Some(set) = mesh.side_set(plane.side_set) else { return false };
    let elements: Vec<&[u32]> = mesh.elements().map(|(_, nodes)| nodes).collect();
    let corners = set.sides.iter().flat_map(|&(element, _)| elements[element as usize]);
    corners.map(|&node| gap(node)).sum::<f64>() < 0.0
}

/// Follows every number in a card that names a part of the mesh; the grammar says which fields do.
fn references(card: &Card, mesh: &Mesh, found: &mut Diagnostics) {
    let Some(entry) = language().entry(&card.name) else { return };
    for field in &entry.fields {
        if let Kind::Id(what @ ("block" | "node set" | "side set")) | Kind::IdOrAll(what) = field.kind {
            for item in card.items(&field.name) {
                reference(card, what, item, mesh, found);
            }
        }
    }
}

fn reference(card: &Card, what: &str, item: &Item, mesh: &Mesh, found: &mut Diagnostics) {
    let (Some(id), Some(span)) = (item.value.integer(), item.span) else { return };
    // Numbers there are, each with how many members it has.
    let there: Vec<(i64, usize)> = match what {
        "block" => mesh.blocks.iter().map(|b| (b.id, b.len())).collect(),
        "node set" => mesh.node_sets.iter().map(|s| (s.id, s.nodes.len())).collect(),
        _ => mesh.side_sets.iter().map(|s| (s.id, s.sides.len())).collect(),
    };
    match there.iter().find(|(there, _)| *there == id) {
        Some((_, 1..)) => (),
        // An empty block needs a material as any other does.
        Some(_) if card.name == "MATERIAL" => (),
        Some(_) => found.push(
            Diagnostic::warning(format!("{}: {what} {id} of the mesh is empty", card.name))
                .at(span, "this command does nothing"),
        ),
        None => {
            let ids: Vec<i64> = there.iter().map(|(id, _)| *id).collect();
            found.push(
                Diagnostic::error(format!("{}: the mesh has no {what} {id}", card.name))
                    .at(span, format!("no {what} of the mesh has this number"))
                    .help(those_there_are(what, &ids)),
            );
        }
    }
}

fn blocks_without_material(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let named: Vec<i64> =
        problem.deck.cards.iter().filter(|c| c.name == "MATERIAL").filter_map(|c| c.maybe_integer("block")).collect();
    if named.is_empty() {
        return; // A deck without any MATERIAL has been reported as such.
    }
    // A material that is named but was not understood has been reported; else it must be there, not only named.
    let understood = !problem.diagnostics.has_errors();
    let made = |id: i64| problem.model.materials.iter().any(|material| material.block == id);
    for block in mesh.blocks.iter().filter(|b| !named.contains(&b.id) || (understood && !made(b.id))) {
        let name = if block.name.is_empty() { String::new() } else { format!(" ({})", block.name) };
        let message = format!("element block {}{name} of the mesh has no MATERIAL", block.id);
        found.push(
            Diagnostic::error(message)
                .help(format!("add a group that starts with: MATERIAL, {}, <model>, <density>", block.id))
                .help(those_there_are("block", &mesh.blocks.iter().map(|b| b.id).collect::<Vec<_>>())),
        );
    }
}

/// Reports pairs of cards that give a node two different motions in one direction.
fn conflicts(problem: &Problem, mesh: &Mesh, axis: Direction, found: &mut Diagnostics) {
    let moving: Vec<&Card> = problem.deck.cards.iter().filter(|card| moves(card, axis)).collect();
    let mut first_at_node: Vec<Option<usize>> = vec![None; mesh.coordinates.len()];
    let mut clashes: BTreeMap<(usize, usize), (u32, usize)> = BTreeMap::new();
    for (second, card) in moving.iter().enumerate() {
        let Some(set) = mesh.node_set(card.integer("node_set")) else { continue };
        for &node in &set.nodes {
            match first_at_node.get_mut(node as usize) {
                Some(Some(first)) if !same_motion(moving[*first], card) => {
                    clashes.entry((*first, second)).or_insert((node, 0)).1 += 1;
                }
                Some(slot @ None) => *slot = Some(second),
                _ => (),
            }
        }
    }
    for ((first, second), (node, count)) in clashes {
        let id = mesh.node_ids.get(node as usize).copied().unwrap_or(i64::from(node) + 1);
        let (one, other) = (moving[first], moving[second]);
        let where_ = if count == 1 { format!("at node {id}") } else { format!("at {count} nodes, such as {id}") };
        found.push(
            Diagnostic::error(format!("{} contradicts {} in {axis:?} {where_}", other.name, one.name))
                .at(other.record, format!("says how node {id} moves in {axis:?}"))
                .at(one.record, "says it in another way")
                .help("take one of the two out, or make node sets that do not share nodes"),
        );
    }
}

/// Whether a card holds or drives nodes in a direction.
pub(super) fn moves(card: &Card, axis: Direction) -> bool {
    const MOVING: [&str; 4] =
        ["NO DISPLACEMENT", "PRESCRIBED DISPLACEMENT", "PRESCRIBED VELOCITY", "PRESCRIBED ACCELERATION"];
    card.complete && MOVING.contains(&card.name.as_str()) && direction(card) == axis
}

/// Whether two moving cards of one direction ask for the same motion.
fn same_motion(one: &Card, other: &Card) -> bool {
    one.name == other.name
        && one.maybe_integer("function") == other.maybe_integer("function")
        && one.maybe_number("scale") == other.maybe_number("scale")
}
