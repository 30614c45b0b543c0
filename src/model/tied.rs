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
