//! Explosives: where a deck lights them, and whether that happens within the run.

use super::material::{BlockMaterial, equation_cards};
use crate::{
    deck::{Card, Diagnostic, Diagnostics},
    material::{DetonationPoint, EquationOfState, Jwl, Law},
    mesh::{Block, Mesh},
    model::problem::{Draft, Problem, Setter},
};

/// What comes when all materials are there.
pub(in crate::model) const LATER_COMMANDS: &[Setter] = &[("DETONATION POINT", detonation_point)];

pub(super) fn point(card: &Card) -> DetonationPoint {
    DetonationPoint { position: ["x", "y", "z"].map(|axis| card.number(axis)), time: card.number("time") }
}

fn jwl(law: &Law) -> Option<&Jwl> {
    match law.equation_of_state() {
        Some(EquationOfState::Jwl(jwl)) => Some(jwl),
        _ => None,
    }
}

/// Detonation points act in the making of explosives; here it is seen that there is one.
fn detonation_point(card: &Card, draft: &mut Draft) {
    if !draft.model.materials.iter().any(|material| jwl(&material.law).is_some()) {
        draft.report(
            Diagnostic::warning("DETONATION POINT: no material is an explosive")
                .at(card.record, "there is nothing to light")
                .help("an explosive is a HYDRODYNAMIC material with the EQUATION OF STATE JWL"),
        );
    }
}

/// Warns of explosives that nothing lights.
pub(in crate::model) fn report_unlit(draft: &mut Draft) {
    if draft.deck.cards_of("DETONATION POINT").next().is_some() {
        return;
    }
    let unlit = |material: &&BlockMaterial| jwl(&material.law).is_some();
    let blocks: Vec<i64> = draft.model.materials.iter().filter(unlit).map(|material| material.block).collect();
    for block in blocks {
        let Some(card) = equation_cards(draft.deck, block).next() else { continue };
        draft.report(
            Diagnostic::warning(format!("EQUATION OF STATE {block}: there is no DETONATION POINT"))
                .at(card.record, "all of the explosive has burnt when the run begins"),
        );
    }
}

/// Warns of explosives that no front reaches before the run ends.
pub(in crate::model) fn report_lit_too_late(problem: &Problem, mesh: &Mesh, found: &mut Diagnostics) {
    let end = problem.model.termination_time;
    // What goes on from a state has been lit before, or will be as its first run asked for.
    if problem.model.restarts.read.is_some() {
        return;
    }
    for material in &problem.model.materials {
        let Some(jwl) = jwl(&material.law) else { continue };
        let Some(block) = mesh.blocks.iter().find(|block| block.id == material.block) else { continue };
        let cards = problem
            .deck
            .cards_of("DETONATION POINT")
            .filter(|card| card.complete)
            .map(|card| (card, first_lighting(&point(card), jwl, block, mesh)));
        let Some((card, time)) = cards.min_by(|one, other| one.1.total_cmp(&other.1)) else { continue };
        // A block without elements has been reported, as has a run without an end.
        if time <= end || !time.is_finite() || end.is_nan() {
            continue;
        }
        let message = format!(
            "DETONATION POINT: the explosive of block {} is not lit before the run ends: its first element at {time:.4e}, the end at {end:.4e}",
            material.block
        );
        found.push(
            Diagnostic::warning(message)
                .at(card.record, format!("this one would be the first, with a front at {:.4e}", jwl.velocity))
                .help("look at the place, which is that of the undeformed mesh in its unit of length, at time and TERMINATION TIME"),
        );
    }
}

/// When the front of a point reaches the first element of a block.
fn first_lighting(point: &DetonationPoint, jwl: &Jwl, block: &Block, mesh: &Mesh) -> f64 {
    let lit = |nodes: &[u32]| {
        let share = 1.0 / nodes.len() as f64;
        let centre = nodes
            .iter()
            .filter_map(|&node| mesh.coordinates.get(node as usize))
            .fold([0.0; 3], |sum, x| [0, 1, 2].map(|i| sum[i] + share * x[i]));
        point.reaches(centre, jwl.velocity)
    };
    block.elements().map(lit).fold(f64::INFINITY, f64::min)
}
