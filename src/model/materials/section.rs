//! Commands that elements bring with them: what a deck says of the elements of a block.

use crate::deck::{Card, Diagnostic, Kind, language};
use crate::model::problem::Draft;

/// A command that an element brings with it, for the block that it names.
#[derive(Debug, Clone, PartialEq)]
pub struct Section {
    /// Name of the command.
    pub command: String,
    /// Number of the element block.
    pub block: i64,
    /// Its other fields that are numbers, by their names.
    pub numbers: Vec<(String, f64)>,
    /// Its fields that are words, by their names.
    pub words: Vec<(String, String)>,
}

impl Section {
    /// A number by the name of its field; NaN for a field that the command does not have.
    pub fn number(&self, field: &str) -> f64 {
        self.numbers.iter().find(|(name, _)| name == field).map_or(f64::NAN, |(_, value)| *value)
    }

    /// A word by the name of its field.
    pub fn word(&self, field: &str) -> Option<&str> {
        self.words.iter().find(|(name, _)| name == field).map(|(_, word)| &word[..])
    }
}

/// The family of such commands in the grammar.
pub(in crate::model) const FAMILY: &str = "element";

/// Takes a card of the family in as it is; the element itself knows what it means.
pub(in crate::model) fn take(card: &Card, draft: &mut Draft) {
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
    let block = card.integer("block");
    if draft.model.section(&card.name, block).is_some() {
        let message = format!("{}: block {block} has one already", card.name);
        draft.report(Diagnostic::warning(message).at(card.record, "this one holds"));
    }
    draft.model.sections.push(Section { command: card.name.clone(), block, numbers, words });
}
