//! The command language of decks: the card files in `grammar/`, built into the program.

use std::sync::OnceLock;

use crate::deck::Grammar;

/// The card files in the order of the manual.
pub const CARDS: &[(&str, &str)] = &[
    ("control", include_str!("../../../grammar/control.cards")),
    ("material", include_str!("../../../grammar/material.cards")),
    ("function", include_str!("../../../grammar/function.cards")),
    ("boundary", include_str!("../../../grammar/boundary.cards")),
    ("initial", include_str!("../../../grammar/initial.cards")),
    ("contact", include_str!("../../../grammar/contact.cards")),
    ("element", include_str!("../../../grammar/element.cards")),
    // What elements bring with them, gathered by the build script.
    ("element", include_str!(concat!(env!("OUT_DIR"), "/elements.cards"))),
    ("output", include_str!("../../../grammar/output.cards")),
];

/// The language of decks.
pub fn language() -> &'static Grammar {
    static LANGUAGE: OnceLock<Grammar> = OnceLock::new();
    LANGUAGE.get_or_init(|| Grammar::from_cards(CARDS).expect("a test reads the cards that are built in"))
}
