//! RIGID BODY: blocks that move as one.

use crate::deck::{Card, Diagnostic, Diagnostics};
use crate::mesh::Mesh;
use crate::model::Analysis;
use crate::model::problem::{Draft, Problem, Setter};

pub(in crate::model) const COMMANDS: &[Setter] = &[("RIGID BODY", rigid_body)];

fn rigid_body(card: &Card, draft: &mut Draft) {
    let mut blocks: Vec<i64> = Vec::new();
    for item in card.items("block") {
        let (Some(block), Some(span)) = (item.value.integer(), item.span) else { continue };
        if blocks.contains(&block) || draft.model.is_rigid(block) {
            draft.report(
                Diagnostic::error(format!("RIGID BODY: block {block} is of a rigid body already"))
                    .at(span, "named for the second time")
                    .help("name all blocks of one body in one RIGID BODY command"),
            );
        }
        blocks.push(block);
    }
    draft.model.rigid_bodies.push(blocks);
}

/// Commands that name a block and make no sense for one that is rigid: with what to say of them, and what to do.
const SENSELESS: [(&str, &str, &str); 6] = [
    ("DEATH", "its elements have neither stress nor strain and never fail", "name a deformable block"),
    ("DELETE MATERIAL", "a part of a rigid body cannot be taken away", "let the block deform, or leave it where it is"),
    ("ACTIVE LIMITS", "a part of a rigid body cannot be taken away", "let the block deform, or leave it where it is"),
    ("MASS SCALING", "it sets no time step that mass could lengthen", "for a heavier body raise its density"),
    ("INITIAL VELOCITY RADIAL", "a rigid body does not grow", "give it INITIAL VELOCITY MATERIAL or ANGULAR"),
    ("ELEMENT", "its elements have no points of integration to choose", "take the line out"),
];

/// What the deck asks of rigid bodies that they cannot do.
pub(in crate::model) fn check(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let model = &problem.model;
    let Some(first) = problem.deck.cards_of("RIGID BODY").next() else { return };
    if model.analysis != Analysis::Solid {
        found.push(
            Diagnostic::error("RIGID BODY: there are no rigid bodies in two dimensions")
                .at(first.record, "this deck is for a plane")
                .help("hold or drive all nodes of the block with NO DISPLACEMENT or PRESCRIBED VELOCITY"),
        );
    }
    for card in problem.deck.cards.iter().filter(|card| card.complete) {
        let Some((_, why, help)) = SENSELESS.iter().find(|(name, ..)| *name == card.name) else { continue };
        for item in card.items("block") {
            if let (Some(block), Some(span)) = (item.value.integer().filter(|block| model.is_rigid(*block)), item.span)
            {
                let message = format!("{}: block {block} is of a RIGID BODY: {why}", card.name);
                found.push(Diagnostic::error(message).at(span, "this block is rigid").help(*help));
            }
        }
    }
    silent(problem, mesh, found);
    shared_nodes(problem, mesh, found);
    let all_rigid = mesh.blocks.iter().all(|block| model.is_rigid(block.id));
    if all_rigid && !model.time_step.longest.is_finite() {
        found.push(
            Diagnostic::error("RIGID BODY: all blocks are rigid, so that nothing bounds the time step")
                .at(first.record, "rigid blocks set no step")
                .help("add TIME STEP MAXIMUM with a time in which the bodies move little"),
        );
    }
}

/// Waves do not leave what is rigid.
fn silent(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let mut of_element: Vec<i64> = Vec::new();
    for card in problem.deck.cards_of("SILENT BC").filter(|card| card.complete) {
        let Some(set) = mesh.side_set(card.integer("side_set")) else { continue };
        if of_element.is_empty() {
            of_element = mesh.blocks.iter().flat_map(|block| std::iter::repeat_n(block.id, block.len())).collect();
        }
        let blocks = set.sides.iter().filter_map(|(element, _)| of_element.get(*element as usize));
        if let Some(block) = blocks.copied().find(|block| problem.model.is_rigid(*block)) {
            found.push(
                Diagnostic::error(format!("SILENT BC: block {block} is of a RIGID BODY: no wave runs in it"))
                    .at(card.record, "faces of a rigid block")
                    .help("take the faces of rigid blocks out of the side set"),
            );
        }
    }
}

/// Two bodies that share a node would be one.
fn shared_nodes(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let mut owner: Vec<Option<usize>> = vec![None; mesh.coordinates.len()];
    for (number, card) in problem.deck.cards_of("RIGID BODY").filter(|card| card.complete).enumerate() {
        let Some(blocks) = problem.model.rigid_bodies.get(number) else { continue };
        let own = mesh.blocks.iter().filter(|block| blocks.contains(&block.id)).flat_map(|block| &block.nodes);
        let mut clash = None;
        for &node in own {
            match owner[node as usize] {
                Some(other) if other != number => clash = clash.or(Some((node, other))),
                _ => owner[node as usize] = Some(number),
            }
        }
        if let Some((node, other)) = clash {
            let id = mesh.node_ids.get(node as usize).copied().unwrap_or(0);
            let message = format!("RIGID BODY: bodies {} and {} share nodes, such as node {id}", other + 1, number + 1);
            found.push(
                Diagnostic::error(message)
                    .at(card.record, "shares nodes with a body above")
                    .help("name the blocks of both in one command: they can only move as one"),
            );
        }
    }
}
