//! Contact and rigid planes.

use std::collections::BTreeSet;

use super::interfaces::{
    ContactData, ContactDecomposition, ContactEdges, ContactMaterials, ContactOverlap, ContactSearch, ContactSurface,
    Friction, RigidSurface,
};
use super::tied::{self, Tie};
use crate::common::vector::unit;
use crate::deck::{Card, Diagnostic, Diagnostics, spelling};
use crate::mesh::{Block, Mesh, Shape};
use crate::model::problem::{Draft, Problem, Setter};

pub(in crate::model) const COMMANDS: &[Setter] = &[
    ("RIGID SURFACE", rigid_surface),
    ("CONTACT MATERIAL", contact_material),
    ("CONTACT SURFACE", contact_surface),
    ("CONTACT DATA", contact_data),
    ("CONTACT EXCLUSION", contact_exclusion),
    ("CONTACT THICKNESS", |card, draft| {
        draft.model.contact.thicknesses.push((card.integer("block"), card.number("factor")));
    }),
    ("CONTACT NODE SET", contact_node_set),
    ("CONTACT PASSES", contact_passes),
    ("CONTACT SEARCH", contact_search),
    ("CONTACT EDGES", contact_edges),
    ("CONTACT OVERLAP", contact_overlap),
    ("CONTACT ENERGY LIMIT", |card, draft| draft.model.contact.control.energy_limit = card.number("fraction")),
    ("CONTACT DECOMPOSITION", contact_decomposition),
];

fn contact_material(card: &Card, draft: &mut Draft) {
    let named: Vec<i64> = card.items("block").iter().filter_map(|item| item.value.integer()).collect();
    let materials = &mut draft.model.contact.materials;
    *materials = Some(match (materials.take(), names_all(card)) {
        (Some(ContactMaterials::All), _) | (_, true) => ContactMaterials::All,
        (Some(ContactMaterials::Blocks(mut blocks)), _) => {
            blocks.extend(named);
            ContactMaterials::Blocks(blocks)
        }
        (None, _) => ContactMaterials::Blocks(named),
    });
}

/// Warns of blocks of bars that may meet others: nodes touch faces, and bars have none. Those that share nodes are built together.
pub(in crate::model) fn check(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let contact = &problem.model.contact;
    let Some(card) = problem.deck.cards_of("CONTACT MATERIAL").next() else { return };
    let is_bar = |block: &&Block| block.shape == Shape::Bar && contact.names(block.id);
    let bars: Vec<(&Block, BTreeSet<u32>)> =
        mesh.blocks.iter().filter(is_bar).map(|block| (block, block.nodes.iter().copied().collect())).collect();
    let pairs = (0..bars.len()).flat_map(|i| (0..i).map(move |j| [j, i]));
    let mut meeting = pairs
        .map(|pair| pair.map(|i| &bars[i]))
        .filter(|[(one, own), (other, of_other)]| !contact.keeps_apart(one.id, other.id) && own.is_disjoint(of_other));
    let Some([(one, _), (other, _)]) = meeting.next() else { return };
    let more = match meeting.count() {
        0 => String::new(),
        more => format!(", and {more} more pairs of blocks"),
    };
    let message = format!(
        "CONTACT MATERIAL: bars go through bars, those of block {} through those of block {}{more}",
        other.id, one.id
    );
    found.push(
        Diagnostic::warning(message)
            .at(card.record, "bars touch with their nodes, and nodes touch the faces of solids and shells only")
            .help(format!(
                "make one of the two of solids or shells; where they do not meet, CONTACT EXCLUSION, {}, {} says so",
                one.id, other.id
            )),
    );
}

/// Friction from the fields `friction`, `high_speed` and `decay`.
fn friction(card: &Card) -> Friction {
    Friction { at_rest: card.number("friction"), high_speed: card.number("high_speed"), decay: card.number("decay") }
}

fn contact_surface(card: &Card, draft: &mut Draft) {
    if tied::is_fixed(card) {
        let side_sets = tied::sides(card).map(|side| card.integer(side));
        return draft.model.ties.push(Tie { side_sets, tolerance: tied::default_tolerance() });
    }
    let surface = ContactSurface {
        side_sets: [card.integer("first"), card.integer("second")],
        friction: friction(card),
        partition: card.number("partition"),
    };
    let [first, second] = surface.side_sets;
    let pairs = |other: &&ContactSurface| other.side_sets == [first, second] || other.side_sets == [second, first];
    if draft.model.contact.surfaces.iter().find(pairs).is_some_and(|before| *before != surface) {
        let message = format!("CONTACT SURFACE: side sets {first} and {second} have been paired before in another way");
        draft.report(Diagnostic::warning(message).at(card.record, "the first one holds"));
    }
    draft.model.contact.surfaces.push(surface);
}

/// Whether CONTACT MATERIAL lets all blocks touch.
fn names_all(card: &Card) -> bool {
    card.items("block").iter().all(|item| item.value.integer().is_none())
        || card.items("block").iter().any(|item| item.value.text().is_some())
}

fn contact_data(card: &Card, draft: &mut Draft) {
    let (first, second) = (card.maybe_integer("first"), card.maybe_integer("second"));
    match (first, second) {
        (Some(a), Some(b)) => {
            if draft.model.contact.data.iter().any(|data| pairs(data, a, b)) {
                let message = format!("CONTACT DATA: materials {a} and {b} have been paired before");
                draft.report(Diagnostic::warning(message).at(card.record, "the last one holds"));
            }
            draft.model.contact.data.push(pair([a, b], card));
        }
        _ => data_of_all(card, [first, second], draft),
    }
    if draft.deck.cards_of("CONTACT MATERIAL").next().is_none() {
        draft.report(
            Diagnostic::warning("CONTACT DATA: there is no CONTACT MATERIAL, so that nothing follows from this")
                .at(card.record, "friction and partition of contact that was not asked for")
                .help("CONTACT MATERIAL, 1, 2 lets the blocks touch; CONTACT SURFACE has friction of its own"),
        );
    }
    beside_contact(card, draft);
}

fn contact_exclusion(card: &Card, draft: &mut Draft) {
    let pair = ["first", "second"].map(|field| card.maybe_integer(field));
    draft.model.contact.exclusions.push(pair);
    if draft.deck.cards_of("CONTACT MATERIAL").next().is_none() {
        draft.report(
            Diagnostic::warning("CONTACT EXCLUSION: there is no CONTACT MATERIAL, so that nothing follows from this")
                .at(card.record, "blocks that do not touch anyway")
                .help("side sets of CONTACT SURFACE touch each other and nothing else"),
        );
    }
    beside_contact(card, draft);
}

fn contact_node_set(card: &Card, draft: &mut Draft) {
    draft.model.contact.node_sets.push((card.integer("node_set"), card.number("radius")));
    if draft.deck.cards_of("CONTACT MATERIAL").next().is_none() {
        draft.report(
            Diagnostic::warning("CONTACT NODE SET: there is no CONTACT MATERIAL, so that nothing follows from this")
                .at(card.record, "nodes that meet no surface")
                .help("CONTACT MATERIAL, 1, 2 lets blocks touch, and what these nodes are of"),
        );
    }
}

fn pair(materials: [i64; 2], card: &Card) -> ContactData {
    ContactData { materials, friction: friction(card), partition: card.maybe_number("partition") }
}

fn pairs(data: &ContactData, a: i64, b: i64) -> bool {
    data.materials == [a, b] || data.materials == [b, a]
}

/// CONTACT DATA with ALL in one place or both: every pair that no other CONTACT DATA names by its numbers, wherever in the
/// deck that stands.
fn data_of_all(card: &Card, [first, second]: [Option<i64>; 2], draft: &mut Draft) {
    if first.is_none() && second.is_none() && card.maybe_number("partition").is_some_and(|share| share != 0.5) {
        return draft.report(
            Diagnostic::error("CONTACT DATA, ALL, ALL: a partition does not say whose share it is")
                .at(card.place("partition"), "the share of the first block of every pair, but which is the first?")
                .help("leave it out, give 0.5, or name pairs"),
        );
    }
    let all: Vec<i64> = draft.deck.cards_of("MATERIAL").filter_map(|card| card.maybe_integer("block")).collect();
    let named: Vec<[i64; 2]> = draft
        .deck
        .cards_of("CONTACT DATA")
        .filter_map(|other| Some([other.maybe_integer("first")?, other.maybe_integer("second")?]))
        .collect();
    for &a in first.as_ref().map_or(&all[..], std::slice::from_ref) {
        for &b in second.as_ref().map_or(&all[..], std::slice::from_ref) {
            let by_number = named.iter().any(|&[c, d]| [c, d] == [a, b] || [d, c] == [a, b]);
            // Of what ALL says twice of a pair, the last holds, and a pair is named in one order.
            let of_this_card = |data: &ContactData| pairs(data, a, b);
            if !by_number {
                draft.model.contact.data.retain(|data| !of_this_card(data));
                draft.model.contact.data.push(pair([a, b], card));
            }
        }
    }
}

/// Warns of CONTACT DATA and CONTACT EXCLUSION about a block that no CONTACT MATERIAL names, wherever in the deck that stands.
fn beside_contact(card: &Card, draft: &mut Draft) {
    let blocks =
        |card: &Card| -> Vec<i64> { card.items("block").iter().filter_map(|item| item.value.integer()).collect() };
    let named: Vec<Vec<i64>> = draft.deck.cards_of("CONTACT MATERIAL").map(blocks).collect();
    // Whose nodes are in sets that touch, the mesh tells.
    let any_sets = draft.deck.cards_of("CONTACT NODE SET").next().is_some();
    if named.is_empty() || any_sets || draft.deck.cards_of("CONTACT MATERIAL").any(names_all) {
        return;
    }
    let named = named.concat();
    for field in ["first", "second"] {
        let Some(block) = card.maybe_integer(field) else { continue };
        if named.contains(&block) || field == "second" && Some(block) == card.maybe_integer("first") {
            continue;
        }
        let all = spelling::all(&named.iter().map(i64::to_string).collect::<Vec<_>>());
        draft.report(
            Diagnostic::warning(format!(
                "{}: block {block} touches nothing, so that nothing follows from this",
                card.name
            ))
            .at(card.place(field), format!("CONTACT MATERIAL names {all} only"))
            .help(format!("CONTACT MATERIAL, {block} lets it touch; CONTACT SURFACE has friction of its own")),
        );
    }
}

fn contact_passes(card: &Card, draft: &mut Draft) {
    let control = &mut draft.model.contact.control;
    (control.passes, control.tolerance) = (card.integer("passes") as u32, card.number("tolerance"));
    control.unsettled_passes = control.passes.max(card.integer("unsettled") as u32);
}

fn contact_search(card: &Card, draft: &mut Draft) {
    let control = &mut draft.model.contact.control;
    control.search = match card.text("method") {
        "POINT IN BOX" => ContactSearch::PointInBox,
        "TREE" => ContactSearch::Tree,
        _ => ContactSearch::Grid,
    };
    (control.reach, control.margin) = (card.number("steps"), card.number("margin"));
}

fn contact_edges(card: &Card, draft: &mut Draft) {
    draft.model.contact.control.edges = match card.text("switch") {
        "OFF" => ContactEdges::None,
        "ALL" => ContactEdges::All,
        _ => ContactEdges::Sharp,
    };
}

fn contact_overlap(card: &Card, draft: &mut Draft) {
    draft.model.contact.control.overlap = match card.text("treatment") {
        "KEEP" => ContactOverlap::Keep,
        "STRESS" => ContactOverlap::Stress(card.maybe_number("time")),
        _ => ContactOverlap::Remove,
    };
    if card.given("time") && card.text("treatment") != "STRESS" {
        draft.report(
            Diagnostic::error("CONTACT OVERLAP: the time belongs to STRESS only")
                .at(card.place("time"), "nothing is done slowly here")
                .help("STRESS pushes the bodies apart slowly and leaves the stress of a press fit; REMOVE moves nodes before the run begins"),
        );
    }
}

fn contact_decomposition(card: &Card, draft: &mut Draft) {
    draft.model.contact.control.decomposition = match card.text("method") {
        "SLICES" => ContactDecomposition::Slices,
        "STATIC" => ContactDecomposition::Static,
        _ => ContactDecomposition::Bisection,
    };
}

fn rigid_surface(card: &Card, draft: &mut Draft) {
    let Some(normal) = unit(card.vector(["nx", "ny", "nz"])) else {
        return draft.report(
            Diagnostic::error("RIGID SURFACE: the normal has length zero")
                .at(card.place("nx").join(card.place("nz")), "a direction is expected here")
                .help("the normal points away from the plane to the side where the body is: 0., 0., 1. for a floor"),
        );
    };
    draft.model.rigid_surfaces.push(RigidSurface {
        side_set: card.integer("side_set"),
        point: card.vector(["x0", "y0", "z0"]),
        normal,
        friction: card.number("friction"),
    });
}
