//! TIED CONTACT: surfaces that are joined though their meshes do not match.

use crate::deck::{Card, Diagnostic, Diagnostics, language};
use crate::mesh::{Block, Mesh, Shape};
use crate::model::Analysis;
use crate::model::problem::{Draft, Problem, Setter};

/// TIED CONTACT: the nodes of a surface follow the faces of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tie {
    /// Numbers of the side sets: of the surface that follows, and of the other.
    pub side_sets: [i64; 2],
    /// Largest distance between the two, as a part of the root of a face's area.
    pub tolerance: f64,
}

/// The tolerance of TIED CONTACT where nothing is said, as the grammar has it.
pub(in crate::model) fn default_tolerance() -> f64 {
    let defaults = language().entry("TIED CONTACT").map(|entry| entry.default_card()).unwrap_or_default();
    defaults.number("tolerance")
}

/// Whether a CONTACT SURFACE joins instead of letting touch.
pub(in crate::model) fn is_fixed(card: &Card) -> bool {
    card.text("friction") == "FIXED"
}

/// The fields of the side sets that follow and that are followed.
pub(in crate::model) fn sides(card: &Card) -> [&'static str; 2] {
    let other_way = is_fixed(card) && card.number("partition") > 0.5;
    if other_way { ["second", "first"] } else { ["first", "second"] }
}

pub(in crate::model) const COMMANDS: &[Setter] = &[("TIED CONTACT", |card, draft: &mut Draft| {
    let side_sets = [card.integer("first"), card.integer("second")];
    draft.model.ties.push(Tie { side_sets, tolerance: card.number("tolerance") });
})];

/// What the deck asks of tied surfaces that they cannot do.
pub(in crate::model) fn check(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let fixed = problem.deck.cards_of("CONTACT SURFACE").filter(|card| is_fixed(card));
    let cards: Vec<&Card> = problem.deck.cards_of("TIED CONTACT").chain(fixed).filter(|card| card.complete).collect();
    let Some(first) = cards.first() else { return };
    if problem.model.analysis != Analysis::Solid {
        found.push(
            Diagnostic::error(format!("{}: lines are not tied in two dimensions", first.name))
                .at(first.record, "this deck is for a plane")
                .help("let the parts share their nodes"),
        );
        return;
    }
    let mut block_of_element = Vec::with_capacity(mesh.element_count());
    mesh.blocks.iter().for_each(|block| block_of_element.extend(std::iter::repeat_n(block, block.len())));
    let mut rigid_nodes: Vec<u32> = Vec::new();
    mesh.blocks
        .iter()
        .filter(|block| problem.model.is_rigid(block.id))
        .for_each(|block| rigid_nodes.extend(&block.nodes));
    rigid_nodes.sort_unstable();
    for card in &cards {
        for field in ["first", "second"] {
            let sides = mesh.side_set(card.integer(field)).map_or(&[][..], |set| &set.sides);
            let blocks = sides.iter().filter_map(|(element, _)| block_of_element.get(*element as usize).copied());
            let mut of_set: Vec<&Block> = blocks.collect();
            of_set.sort_by_key(|block| block.id);
            of_set.dedup_by_key(|block| block.id);
            of_set.iter().for_each(|block| untieable(block, (card, field), problem, found));
            // Faces of the rigid blocks themselves have been told.
            if !of_set.iter().any(|block| problem.model.is_rigid(block.id)) {
                shared_with_rigid(&rigid_nodes, (card, field), mesh, found);
            }
        }
    }
    roles(&cards, mesh, found);
}

/// Only faces of solids are tied that neither are rigid nor may go.
fn untieable(block: &Block, (card, field): (&Card, &str), problem: &Problem, found: &mut Diagnostics) {
    let (model, id) = (&problem.model, block.id);
    let dies = model.deaths.iter().any(|death| death.block == id)
        || model.deletions.iter().any(|deletion| deletion.block == id);
    let (why, help) = if block.shape != Shape::Hexahedron {
        ("its elements are no solids", "shells and bars are joined by shared nodes")
    } else if model.is_rigid(id) {
        ("it is rigid", "what is to move with a RIGID BODY shares its nodes")
    } else if dies {
        ("its elements may be taken away", "let the parts share their nodes, or keep DEATH to other blocks")
    } else {
        return;
    };
    found.push(
        Diagnostic::error(format!("{}: faces of block {id} cannot be tied: {why}", card.name))
            .at(card.place(field), format!("this side set has faces of block {id}"))
            .help(help),
    );
}

/// Nodes that a deformable block shares with a rigid one move with that: they neither follow nor are followed.
fn shared_with_rigid(rigid: &[u32], (card, field): (&Card, &str), mesh: &Mesh, found: &mut Diagnostics) {
    let set = card.integer(field);
    let Some(shared) = mesh.side_set_nodes(set).into_iter().find(|node| rigid.binary_search(node).is_ok()) else {
        return;
    };
    let id = mesh.node_ids.get(shared as usize).copied().unwrap_or(0);
    found.push(
        Diagnostic::error(format!("{}: node {id} belongs to a RIGID BODY as well", card.name))
            .at(card.place(field), format!("side set {set} has the node"))
            .help("leave the faces beside the rigid block out of the side set"),
    );
}

/// A node follows or is followed.
fn roles(cards: &[&Card], mesh: &Mesh, found: &mut Diagnostics) {
    let own = |card: &Card, role: usize| mesh.side_set_nodes(card.integer(sides(card)[role]));
    let nodes = |role: usize| -> Vec<u32> {
        let mut all: Vec<u32> = cards.iter().flat_map(|card| own(card, role)).collect();
        all.sort_unstable();
        all
    };
    let (following, leading) = (nodes(0), nodes(1));
    let both = following.iter().find(|node| leading.binary_search(node).is_ok());
    let Some(&both) = both else { return };
    let id = mesh.node_ids.get(both as usize).copied().unwrap_or(0);
    let card = cards.iter().find(|card| own(card, 0).binary_search(&both).is_ok()).unwrap_or(&cards[0]);
    let message = format!(
        "{}: node {id} is of a side set that follows and of one that is followed: it cannot do both",
        card.name
    );
    found.push(
        Diagnostic::error(message)
            .at(card.record, "its side set that follows has the node")
            .help("surfaces that share nodes are joined there already; tie apart what lies beside them, or change the order of the side sets"),
    );
}
