//! The command language of recipes: the card files in `grammar/mesh/`, built into the program.

use std::sync::OnceLock;

use crate::deck::Grammar;

/// The card files in the order of the manual.
pub const CARDS: &[(&str, &str)] = &[
    ("recipe", include_str!("../../../grammar/mesh/recipe.cards")),
    ("shapes", include_str!("../../../grammar/mesh/shapes.cards")),
    ("moves", include_str!("../../../grammar/mesh/moves.cards")),
    ("sets", include_str!("../../../grammar/mesh/sets.cards")),
];

/// The language of recipes.
pub fn language() -> &'static Grammar {
    static LANGUAGE: OnceLock<Grammar> = OnceLock::new();
    LANGUAGE.get_or_init(|| Grammar::from_cards(CARDS).expect("a test reads the cards that are built in"))
}
