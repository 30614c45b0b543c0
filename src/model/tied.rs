//! TIED CONTACT: surfaces that are joined though their meshes do not match.

use super::problem::{Draft, Problem, Setter};
use super::{Analysis, Tie};
use crate::deck::{Card, Diagnostic, Diagnostics};
use crate::mesh::{Mesh, Shape};

pub(super) const COMMANDS: &[Setter] = &[("TIED CONTACT", |card, draft: &mut Draft| {
    let side_sets = [card.integer("first"), card.integer("second")];
    draft.model.ties.push(Tie { side_sets, tolerance: card.number("tolerance") });
})];

/// What the deck asks of tied surfaces that they cannot do.
pub(super) fn check(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let cards: Vec<&Card> = problem.deck.cards_of("TIED CONTACT").filter(|card| card.complete).collect();
    let Some(first) = cards.first() else { return };
    if problem.model.analysis != Analysis::Solid {
        found.push(
            Diagnostic::error("TIED CONTACT: lines are not tied in two dimensions")
                .at(first.record, "this deck is for a plane")
                .help("let the parts share their nodes"),
        );
        return;
    }
    cards.iter().for_each(|card| blocks(card, problem, mesh, found));
    cards.iter().for_each(|card| rigid_nodes(card, problem, mesh, found));
    roles(&cards, mesh, found);
}

/// Faces of solids that neither are rigid nor may go.
fn blocks(card: &Card, problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let model = &problem.model;
    let of_element: Vec<usize> =
        mesh.blocks.iter().enumerate().flat_map(|(i, block)| std::iter::repeat_n(i, block.len())).collect();
    for field in ["first", "second"] {
        let sides = mesh.side_set(card.integer(field)).map_or(&[][..], |set| &set.sides);
        let mut blocks: Vec<usize> = sides.iter().filter_map(|(e, _)| of_element.get(*e as usize)).copied().collect();
        blocks.sort_unstable();
        blocks.dedup();
        for block in blocks.into_iter().map(|block| &mesh.blocks[block]) {
            let id = block.id;
            let dies = model.deaths.iter().any(|death| death.block == id)
                || model.deletions.iter().any(|deletion| deletion.block == id);
            let (why, help) = if block.shape != Shape::Hexahedron {
                ("its elements are no solids", "shells and bars are joined by shared nodes")
            } else if model.rigid_bodies.iter().any(|blocks| blocks.contains(&id)) {
                ("it is rigid", "what is to move with a RIGID BODY shares its nodes")
            } else if dies {
                ("its elements may be taken away", "let the parts share their nodes, or keep DEATH to other blocks")
            } else {
                continue;
            };
            found.push(
                Diagnostic::error(format!("TIED CONTACT: faces of block {id} cannot be tied: {why}"))
                    .at(card.place(field), format!("this side set has faces of block {id}"))
                    .help(help),
            );
        }
    }
}

/// Nodes that a deformable block shares with a rigid one move with that: they neither follow nor are followed.
fn rigid_nodes(card: &Card, problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let is_rigid = |id: &i64| problem.model.rigid_bodies.iter().any(|blocks| blocks.contains(id));
    let mut rigid: Vec<u32> = Vec::new();
    mesh.blocks.iter().filter(|block| is_rigid(&block.id)).for_each(|block| rigid.extend(&block.nodes));
    rigid.sort_unstable();
    for field in ["first", "second"] {
        let set = card.integer(field);
        // Faces of the rigid blocks themselves have been told.
        let shared = mesh.side_set_nodes(set).into_iter().find(|node| rigid.binary_search(node).is_ok());
        let Some(shared) = shared.filter(|_| !has_faces_of(mesh, set, is_rigid)) else { continue };
        let id = mesh.node_ids.get(shared as usize).copied().unwrap_or(0);
        found.push(
            Diagnostic::error(format!("TIED CONTACT: node {id} belongs to a RIGID BODY as well"))
                .at(card.place(field), format!("side set {set} has the node"))
                .help("leave the faces beside the rigid block out of the side set"),
        );
    }
}

/// Whether a side set has faces of blocks that are chosen by their numbers.
fn has_faces_of(mesh: &Mesh, set: i64, chosen: impl Fn(&i64) -> bool) -> bool {
    let blocks = mesh.blocks.iter().flat_map(|block| std::iter::repeat_n(chosen(&block.id), block.len()));
    let chosen: Vec<bool> = blocks.collect();
    let sides = mesh.side_set(set).map_or(&[][..], |set| &set.sides);
    sides.iter().any(|(element, _)| chosen.get(*element as usize) == Some(&true))
}

/// A node follows or is followed.
fn roles(cards: &[&Card], mesh: &Mesh, found: &mut Diagnostics) {
    let nodes = |field: &str| -> Vec<u32> {
        let mut all: Vec<u32> = cards.iter().flat_map(|card| mesh.side_set_nodes(card.integer(field))).collect();
        all.sort_unstable();
        all
    };
    let (first, second) = (nodes("first"), nodes("second"));
    let both = first.iter().find(|node| second.binary_search(node).is_ok());
    let Some(&both) = both else { return };
    let id = mesh.node_ids.get(both as usize).copied().unwrap_or(0);
    let message =
        format!("TIED CONTACT: node {id} is of a first side set and of a second one: it cannot follow and be followed");
    let place = cards.iter().find(|card| mesh.side_set_nodes(card.integer("first")).binary_search(&both).is_ok());
    found.push(
        Diagnostic::error(message)
            .at(place.unwrap_or(&cards[0]).record, "its first side set has the node")
            .help("surfaces that share nodes are joined there already; tie apart what lies beside them, or change the order of the side sets"),
    );
}
