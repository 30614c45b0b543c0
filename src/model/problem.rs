//! Cards → model: every command has one setter, listed by family.

use super::{
    Model, check,
    conditions::{boundary, function, initial},
    control::{analysis, deletion, output, restart},
    interactions::{contact, rigid, tied},
    materials::{explosive, material, section},
};
use crate::{
    deck::{Card, Deck, Diagnostic, Diagnostics, Source, Span, language, spelling},
    mesh::Mesh,
};

/// A model together with the deck it came from, so that later messages can point into the deck.
#[derive(Debug, Clone)]
pub struct Problem {
    /// What to simulate.
    pub model: Model,
    /// The deck as read.
    pub deck: Deck,
    /// Warnings and notes from reading it.
    pub diagnostics: Diagnostics,
}

impl Problem {
    /// Where the deck speaks of a block: the commands of an accepted name that are for this block or for all blocks, else where the
    /// block gets its material.
    pub fn places_of_block(&self, block: i64, accepted: impl Fn(&str) -> bool) -> Vec<Span> {
        let cards = |accepted: &dyn Fn(&str) -> bool| -> Vec<Span> {
            let of_block = |card: &&Card| card.complete && card.maybe_integer("block").is_none_or(|own| own == block);
            let cards = self.deck.cards.iter().filter(|card| accepted(&card.name));
            cards.filter(of_block).map(|card| card.record).collect()
        };
        let places = cards(&accepted);
        if places.is_empty() { cards(&|name| name == "MATERIAL") } else { places }
    }
}

/// A command of the deck and what it does to the model.
pub(super) type Setter = (&'static str, fn(&Card, &mut Draft));

/// Every setter there is. Functions come first because loads refer to them; within a family, cards act in the order
/// of the deck.
const FAMILIES: &[&[Setter]] = &[
    analysis::COMMANDS,
    function::COMMANDS,
    material::COMMANDS,
    explosive::LATER_COMMANDS,
    boundary::COMMANDS,
    initial::COMMANDS,
    contact::COMMANDS,
    deletion::COMMANDS,
    rigid::COMMANDS,
    tied::COMMANDS,
    output::COMMANDS,
    restart::COMMANDS,
];

/// A model in the making.
pub(super) struct Draft<'d> {
    pub model: Model,
    pub deck: &'d Deck,
    pub found: Diagnostics,
    /// Numbers of the functions that materials refer to.
    pub functions_of_materials: Vec<i64>,
}

/// Makes the model of a deck that has been read. `found` are the messages from reading it; if these or the meaning of
/// the deck hold an error, all messages together are returned instead.
///
/// # Errors
///
/// All messages, where one of them is an error.
pub fn from_deck(deck: Deck, found: Diagnostics) -> Result<Problem, Diagnostics> {
    accept(assemble(deck, found))
}

/// Reads a deck, makes its model and, with a mesh, holds the two against each other: every mistake of all of these at
/// once, or the problem.
///
/// # Errors
///
/// All messages, where one of them is an error.
pub fn examine(source: Source, mesh: Option<&Mesh>) -> Result<Problem, Diagnostics> {
    let (deck, found) = Deck::read(source, language());
    let mut problem = assemble(deck, found);
    if let Some(mesh) = mesh {
        let against_mesh = check(&problem, mesh);
        problem.diagnostics.append(against_mesh);
    }
    accept(problem)
}

fn accept(problem: Problem) -> Result<Problem, Diagnostics> {
    if problem.diagnostics.has_errors() { Err(problem.diagnostics) } else { Ok(problem) }
}

/// The model as far as it can be made.
fn assemble(deck: Deck, found: Diagnostics) -> Problem {
    let mut draft = Draft { model: Model::default(), deck: &deck, found, functions_of_materials: Vec::new() };
    for family in FAMILIES {
        defaults(family, &mut draft);
        for card in deck.cards.iter().filter(|card| card.complete) {
            if draft.found.is_full() {
                break;
            }
            if let Some((_, set)) = family.iter().find(|(name, _)| *name == card.name) {
                set(card, &mut draft);
            }
        }
    }
    let of_elements = |card: &&Card| language().entry(&card.name).is_some_and(|entry| entry.family == section::FAMILY);
    deck.cards.iter().filter(|card| card.complete).filter(of_elements).for_each(|card| section::take(card, &mut draft));
    material::check_unfinished(&mut draft);
    explosive::report_unlit(&mut draft);
    material::refuse_lawless(&mut draft);
    output::finish(&mut draft);
    restart::finish(&mut draft);
    function::report_unused(&mut draft);
    let Draft { model, found, .. } = draft;
    Problem { model, deck, diagnostics: found }
}

/// Lets commands that hold without being given act with their defaults.
fn defaults(family: &[Setter], draft: &mut Draft) {
    for (name, set) in family {
        if let Some(entry) = language().entry(name).filter(|e| e.always) {
            set(&entry.default_card(), draft);
        }
    }
}

impl Draft<'_> {
    /// Adds a message.
    pub fn report(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    /// Position of the function that a card names in its field `function`; reports one that does not exist.
    pub fn function(&mut self, card: &Card) -> Option<usize> {
        let id = card.maybe_integer("function")?;
        self.function_exists(id, card.place("function"), &card.name);
        self.model.functions.iter().position(|f| f.id == id)
    }

    /// Notes that a material refers to a function, and whether that exists; reports one that does not.
    pub fn names_function(&mut self, id: i64, place: Span, owner: &str) -> bool {
        self.functions_of_materials.push(id);
        self.function_exists(id, place, owner)
    }

    fn function_exists(&mut self, id: i64, place: Span, owner: &str) -> bool {
        let functions = || self.deck.cards.iter().filter(|card| card.name == "FUNCTION");
        let exists = functions().any(|card| card.maybe_integer("id") == Some(id));
        // One whose number could not be read, which has been reported, may be it.
        if !exists && functions().all(|card| card.maybe_integer("id").is_some()) {
            let ids: Vec<i64> = self.model.functions.iter().map(|f| f.id).collect();
            self.report(
                Diagnostic::error(format!("{owner}: there is no FUNCTION {id}"))
                    .at(place, "the deck defines no function with this number")
                    .help(those_there_are("function", &ids)),
            );
        }
        exists
    }
}

/// "the functions are 1, 2 and 5": what could have been meant.
pub(super) fn those_there_are(what: &str, ids: &[i64]) -> String {
    /// Numbers listed at most.
    const LISTED: usize = 20;
    let mut names: Vec<String> = ids.iter().take(LISTED).map(i64::to_string).collect();
    if ids.len() > LISTED {
        names.push(format!("{} more", ids.len() - LISTED));
    }
    match names.len() {
        0 => format!("there is no {what} at all"),
        1 => format!("the only {what} is {}", names[0]),
        _ => format!("the {what}s are {}", spelling::all(&names)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::{Form, Status};

    #[test]
    fn every_command_has_one_setter_and_every_setter_a_command() {
        // EXIT means something to the reader only.
        // Those of elements are taken in as they are.
        let built =
            |e: &&crate::deck::Entry| e.status == Status::Built && e.name != "EXIT" && e.family != section::FAMILY;
        let mut commands: Vec<&str> = language().commands().filter(built).map(|e| e.name.as_str()).collect();
        let mut setters: Vec<&str> = FAMILIES.iter().flat_map(|family| family.iter().map(|(name, _)| *name)).collect();
        commands.sort_unstable();
        setters.sort_unstable();
        assert_eq!(commands, setters);
    }

    #[test]
    fn planned_materials_are_not_built_ones() {
        for entry in language().entries.iter().filter(|e| e.form == Form::Material) {
            assert!(crate::material::MATERIALS.iter().all(|m| m.name != entry.name), "{}", entry.name);
        }
    }
}
