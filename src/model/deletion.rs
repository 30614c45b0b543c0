//! Blocks that are taken away at a time.

use super::problem::{Draft, Setter};
use crate::deck::{Card, Diagnostic};

pub(super) const COMMANDS: &[Setter] = &[("DELETE MATERIAL", delete_material), ("ACTIVE LIMITS", active_limits)];

/// DELETE MATERIAL: an element block is taken away at the state nearest to a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deletion {
    /// Element block number.
    pub block: i64,
    /// The time.
    pub time: f64,
}

fn delete_material(card: &Card, draft: &mut Draft) {
    draft.model.deletions.push(Deletion { block: card.integer("block"), time: card.number("t") });
}

/// The end of a block's time is a deletion; its beginning must be that of the run.
fn active_limits(card: &Card, draft: &mut Draft) {
    let (block, begin) = (card.integer("block"), card.number("begin"));
    if begin > 0.0 {
        let message = format!("ACTIVE LIMITS: block {block} is to begin at {begin}, but blocks begin with the run");
        return draft.report(
            Diagnostic::error(message)
                .at(card.place("begin"), "must be 0")
                .help("a block born later would bring mass and momentum from nowhere, into nodes that have moved"),
        );
    }
    if let Some(time) = card.maybe_number("end") {
        draft.model.deletions.push(Deletion { block, time });
    }
}
