//! Commands that elements bring with them: what a deck says of the elements of a block.

use super::{Section, problem::Draft};
use crate::deck::{Card, Kind, language};

/// The family of such commands in the grammar.
pub(super) const FAMILY: &str = "element";

/// Takes a card of the family in as it is; the element itself knows what it means.
pub(super) fn take(card: &Card, draft: &mut Draft) {
    let Some(entry) = language().entry(&card.name) else { return };
    let (mut numbers, mut words) = (Vec::new(), Vec::new());
    for field in entry.fields.iter().filter(|field| field.name != "block") {
        match field.kind {
            Kind::Number | Kind::Integer | Kind::Id(_) if card.given(&field.name) => {
                numbers.push((field.name.clone(), card.number(&field.name)));
            }
            Kind::Choice(_) | Kind::Name | Kind::Words if card.given(&field.name) => {
                words.push((field.name.clone(), card.text(&field.name).to_string()));
            }
            _ => (),
        }
    }
    draft.model.sections.push(Section { command: card.name.clone(), block: card.integer("block"), numbers, words });
}
