//! Commands that move, copy and join shapes.

use super::{Draft, Merge, Perturb, Place, Setter, Split, Triangles};
use crate::{
    deck::{Card, Diagnostic},
    mesher::changes::{transform::Move, triangles::Pattern},
};

/// Shapes in a recipe at most, so that copies of copies do not fill the memory.
const MOST_SHAPES: usize = 100_000;

pub(super) const COMMANDS: &[Setter] = &[
    ("TRANSLATE", translate),
    ("ROTATE", rotate),
    ("MIRROR", mirror),
    ("COPY", copy),
    ("MERGE", merge),
    ("SPLIT BLOCK", split),
    ("TRIANGLES", triangles),
    ("PERTURB", perturb),
];

/// Adds a move to all shapes that have made a block so far.
fn add(card: &Card, draft: &mut Draft, step: Move) {
    let block = card.integer("block");
    if draft.knows(card, "block", block) {
        let parts = draft.recipe.parts.iter_mut().filter(|part| part.block == block);
        parts.for_each(|part| part.moves.push(step.clone()));
    }
}

fn translate(card: &Card, draft: &mut Draft) {
    add(card, draft, Move::Translate(card.vector(["dx", "dy", "dz"])));
}

fn rotate(card: &Card, draft: &mut Draft) {
    let axis = super::axis(card, "axis");
    add(card, draft, Move::Rotate { axis, degrees: card.number("degrees"), about: card.vector(["x", "y", "z"]) });
}

fn mirror(card: &Card, draft: &mut Draft) {
    add(card, draft, Move::Mirror { axis: super::axis(card, "axis"), at: card.number("at") });
}

fn copy(card: &Card, draft: &mut Draft) {
    let block = card.integer("block");
    if !draft.knows(card, "block", block) {
        return;
    }
    let step = card.vector(["dx", "dy", "dz"]);
    let originals: Vec<_> = draft.recipe.parts.iter().filter(|part| part.block == block).cloned().collect();
    let copies = card.integer("copies");
    // Copies of copies multiply.
    if draft.recipe.parts.len() + originals.len() * copies as usize > MOST_SHAPES {
        let message = format!("COPY: {copies} copies of {} shapes are too many", originals.len());
        let diagnostic = Diagnostic::error(message).at(card.record, "");
        return draft.report(diagnostic.help(format!("a recipe makes {MOST_SHAPES} shapes at most")));
    }
    for times in 1..=copies {
        for mut part in originals.iter().cloned() {
            part.block = card.integer("new");
            part.moves.push(Move::Translate(step.map(|d| times as f64 * d)));
            part.place = Place::of(card);
            draft.recipe.parts.push(part);
        }
    }
}

fn merge(card: &Card, draft: &mut Draft) {
    let blocks: Vec<i64> = card.items("blocks").iter().filter_map(|item| item.value.integer()).collect();
    if blocks.iter().all(|&block| draft.knows(card, "blocks", block)) {
        draft.recipe.merges.push(Merge { blocks, place: Place::of(card) });
    }
}

fn split(card: &Card, draft: &mut Draft) {
    let (block, new) = (card.integer("block"), card.integer("new"));
    let Some([low, high]) = super::bounds(card, draft) else { return };
    // What has been split off can be split again.
    if draft.recipe.splits.iter().any(|split| split.new == block) || draft.knows(card, "block", block) {
        draft.recipe.splits.push(Split { block, new, low, high, place: Place::of(card) });
    }
}

fn triangles(card: &Card, draft: &mut Draft) {
    let block = card.integer("block");
    if draft.knows(card, "block", block) {
        let pattern = Pattern::from_word(card.text("pattern"));
        draft.recipe.triangles.push(Triangles { block, pattern, place: Place::of(card) });
    }
}

fn perturb(card: &Card, draft: &mut Draft) {
    let perturb =
        Perturb { block: card.maybe_integer("block"), amplitude: card.number("amplitude"), place: Place::of(card) };
    draft.recipe.perturbs.push(perturb);
}
