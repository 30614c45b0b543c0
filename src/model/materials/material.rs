//! MATERIAL groups: which law an element block follows, and with which parameters.

use super::{explosive, properties::Properties};
use crate::model::problem::{Draft, Setter};
use crate::{
    deck::{Agreement, Card, Deck, Diagnostic, Field, Form, Row, Span, Spelled, Status, language, spelling},
    material::{Caution, DetonationPoint, EQUATIONS_OF_STATE, Entry, EquationOfState, Given, Law, MATERIALS, Refusal},
};

/// MATERIAL: the law of one element block.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockMaterial {
    /// The element block's number.
    pub block: i64,
    /// Mass density ρ₀, mass/length³.
    pub density: f64,
    /// The constitutive law with its parameters.
    pub law: Law,
}

pub(in crate::model) const COMMANDS: &[Setter] = &[("MATERIAL", material), ("EQUATION OF STATE", lonely_equation)];

fn material(card: &Card, draft: &mut Draft) {
    let block = card.integer("block");
    if let Some(first) = draft.deck.cards_of("MATERIAL").find(|c| c.integer("block") == block).filter(|c| *c != card) {
        let diagnostic = Diagnostic::error(format!("element block {block} is given two materials"))
            .at(card.record, "the second one")
            .at(first.record, "the first one");
        return draft.report(diagnostic);
    }
    let Some(entry) = model(card, draft) else { return };
    let Some(values) = Properties::new(card, entry, MATERIALS).values(card, draft) else { return };
    let density = card.number("density");
    let equation_card = equation_cards(draft.deck, block).next();
    let equation = equation_card.and_then(|card| equation_of_state(card, density, draft));
    if equation_card.is_some() && equation.is_none() {
        return; // Its mistake has been reported.
    }
    let functions = &draft.model.functions;
    let function = |id| functions.iter().find(|f| f.id == id).map(|f| f.points.clone());
    let detonation: Vec<DetonationPoint> = draft.deck.cards_of("DETONATION POINT").map(explosive::point).collect();
    let given = Given { function: &function, equation, detonation: &detonation, ..Given::new(&values, density) };
    let law = (entry.build)(&given);
    let cautions = given.cautions.take();
    if let (Some(equation_card), false, Ok(_)) = (equation_card, given.equation_wanted.get(), &law) {
        let message = format!("EQUATION OF STATE {block}: {} does not use one", entry.name);
        let wanted = "HYDRODYNAMIC and EP HYDRODYNAMIC do";
        let diagnostic = Diagnostic::error(message).at(equation_card.record, "").at(card.record, "the material");
        draft.report(diagnostic.help(wanted));
    }
    match law {
        Ok(law) => {
            draft.model.materials.push(BlockMaterial { block, density, law });
            warned(card, &cautions, draft);
        }
        Err(refusal) => refused(card, &refusal, draft),
    }
}

/// The equations of state that a deck gives a block.
pub(super) fn equation_cards(deck: &Deck, block: i64) -> impl Iterator<Item = &Card> {
    deck.cards_of("EQUATION OF STATE").filter(move |card| card.complete && card.maybe_integer("block") == Some(block))
}

fn equation_of_state(card: &Card, density: f64, draft: &mut Draft) -> Option<EquationOfState> {
    let entry = equation_entry(card, draft)?;
    let values = Properties::new(card, entry, EQUATIONS_OF_STATE).values(card, draft)?;
    let given = Given::new(&values, density);
    match (entry.build)(&given) {
        Ok(equation) => {
            warned(card, &given.cautions.take(), draft);
            Some(equation)
        }
        Err(refusal) => {
            refused(card, &refusal, draft);
            None
        }
    }
}

/// The equation that a card names, or a message why there is none.
fn equation_entry(card: &Card, draft: &mut Draft) -> Option<&'static Entry<EquationOfState>> {
    let (name, place) = (card.text("equation"), card.place("equation"));
    let words: Vec<Field> = name.split(' ').map(|word| Field::word(word, place)).collect();
    let all = EQUATIONS_OF_STATE.iter().flat_map(|&entry| spellings(entry).map(move |s| (s, entry.name)));
    let names: Vec<&str> = EQUATIONS_OF_STATE.iter().map(|entry| entry.name).collect();
    if let Spelled::As { what, agreement, .. } = spelling::recognise_all(&words, all) {
        if agreement == Agreement::Abbreviated || what != name {
            draft.report(Diagnostic::note(format!("assumed equation of state {what} for `{name}`")).at(place, ""));
        }
        return EQUATIONS_OF_STATE.iter().find(|entry| entry.name == what).copied();
    }
    let owner = format!("EQUATION OF STATE {}", card.integer("block"));
    let near = spelling::nearest(name, names.iter().copied());
    draft.report(
        Diagnostic::error(format!("{owner}: there is no equation of state {}", spelling::cut(name)))
            .at(place, "expected the name of an equation of state")
            .help(near.map_or(String::new(), |near| format!("did you mean {near}?")))
            .help(format!("the equations of state are {}", spelling::all(&names))),
    );
    None
}

/// An equation of state acts with the material of its block; here it is seen that there is one, and one equation only.
fn lonely_equation(card: &Card, draft: &mut Draft) {
    let block = card.integer("block");
    if let Some(first) = equation_cards(draft.deck, block).next().filter(|first| *first != card) {
        let message = format!("element block {block} is given two equations of state");
        let diagnostic = Diagnostic::error(message).at(card.record, "the second one");
        return draft.report(diagnostic.at(first.record, "the first one"));
    }
    if !draft.deck.cards_of("MATERIAL").any(|material| material.maybe_integer("block") == Some(block)) {
        let message = format!("EQUATION OF STATE {block}: there is no MATERIAL {block}");
        draft.report(Diagnostic::error(message).at(card.place("block"), "the block that it is for"));
    }
}

/// Refuses a deck in which a MATERIAL made no law although nothing was found wrong with it: its block must not be computed
/// with anything else.
pub(in crate::model) fn refuse_lawless(draft: &mut Draft) {
    if draft.found.has_errors() {
        return;
    }
    let made = |block: i64| draft.model.materials.iter().any(|material| material.block == block);
    let lawless: Vec<&Card> = draft
        .deck
        .cards
        .iter()
        .filter(|c| c.name == "MATERIAL" && c.maybe_integer("block").is_none_or(|b| !made(b)))
        .collect();
    for card in lawless {
        draft.report(
            Diagnostic::error("this MATERIAL makes no law").at(card.record, "its block would be left without one"),
        );
    }
}

/// Reports values that do not make a law together.
fn refused(card: &Card, refusal: &Refusal, draft: &mut Draft) {
    let message = format!("{} {}: {} {}", card.name, card.integer("block"), refusal.keyword, refusal.reason);
    draft.report(Diagnostic::error(message).at(line_of(card, refusal.keyword), ""));
}

/// Reports values that make a law which may not be the one that is meant.
fn warned(card: &Card, cautions: &[Caution], draft: &mut Draft) {
    for Caution { keyword, reason, help } in cautions {
        let message = format!("{} {}: {keyword} {reason}", card.name, card.integer("block"));
        draft.report(Diagnostic::warning(message).at(line_of(card, keyword), "").help(help));
    }
}

/// The line of a group that gives a property, or its first one where there is none.
fn line_of(card: &Card, keyword: &str) -> Span {
    let row = card.rows.iter().find(|row| spelling::agreement(&row.fields, keyword).is_some());
    row.map_or(card.record, Row::span)
}

/// Looks at the properties of a material whose first line has a mistake, if its model is clear all the same, so that
/// one reading of the deck shows all that is wrong. What is missing is not told: the group may have lost its END.
pub(in crate::model) fn check_unfinished(draft: &mut Draft) {
    let deck = draft.deck;
    for card in deck.cards.iter().filter(|card| card.name == "MATERIAL" && !card.complete) {
        let built = MATERIALS.iter().flat_map(|&entry| spellings(entry).map(move |s| (s, entry.name)));
        let words: Vec<Field> = card.text("model").split(' ').map(|word| Field::word(word, card.span)).collect();
        let Spelled::As { what, .. } = spelling::recognise_all(&words, built) else { continue };
        let Some(entry) = MATERIALS.iter().find(|entry| entry.name == what) else { continue };
        let properties = Properties::new(card, entry, MATERIALS);
        for row in &card.rows {
            properties.value(row, draft);
        }
    }
}

/// The law that a card names, or a message why there is none.
fn model(card: &Card, draft: &mut Draft) -> Option<&'static Entry> {
    let name = card.text("model");
    let built = MATERIALS.iter().flat_map(|&entry| spellings(entry).map(move |s| (s, Some(entry.name))));
    let planned = language().entries.iter().filter(|e| e.form == Form::Material);
    let planned = planned.flat_map(|e| e.spellings().map(|s| (s, None)));
    let words: Vec<Field> = name.split(' ').map(|word| Field::word(word, card.place("model"))).collect();
    let place = card.place("model");
    // What can be computed is meant before what cannot, and by its own name before another's.
    let own = MATERIALS.iter().map(|entry| (entry.name, Some(entry.name)));
    let by_name = spelling::recognise_all(&words, own);
    let found = match by_name {
        Spelled::Nothing => spelling::recognise_all(&words, built.clone().chain(planned)),
        found => found,
    };
    match found {
        Spelled::As { what: Some(law), agreement, .. } => {
            if agreement == Agreement::Abbreviated || law != name {
                draft.report(Diagnostic::note(format!("assumed material {law} for `{name}`")).at(place, ""));
            }
            MATERIALS.iter().find(|entry| entry.name == law).copied()
        }
        Spelled::As { what: None, name, .. } => {
            draft.report(not_built(card, &name, place));
            None
        }
        Spelled::Several(names) => {
            let words = format!("MATERIAL {}: {}", card.integer("block"), spelling::cut(name));
            draft.report(Diagnostic::unclear(words, &names, place));
            None
        }
        Spelled::Nothing => {
            let near = spelling::nearest(name, built.map(|(name, _)| name));
            let names: Vec<&str> = MATERIALS.iter().map(|entry| entry.name).collect();
            draft.report(
                Diagnostic::error(format!(
                    "MATERIAL {}: there is no material model {}",
                    card.integer("block"),
                    spelling::cut(name)
                ))
                .at(place, "expected the name of a material model")
                .help(near.map_or(String::new(), |near| format!("did you mean {near}?")))
                .help(format!("the models are {}", spelling::all(&names))),
            );
            None
        }
    }
}

fn spellings<T>(entry: &'static Entry<T>) -> impl Iterator<Item = &'static str> + Clone {
    std::iter::once(entry.name).chain(entry.aliases.iter().copied())
}

fn not_built(card: &Card, name: &str, place: Span) -> Diagnostic {
    let entry = language().entries.iter().find(|e| e.spellings().any(|s| s == name));
    let block = card.integer("block");
    let names: Vec<&str> = MATERIALS.iter().map(|entry| entry.name).collect();
    let message = match entry.map(|entry| &entry.status) {
        Some(Status::Refused(why)) => format!("MATERIAL {block}: {name}: {why}"),
        _ => format!("MATERIAL {block}: the model {name} is known, but not built yet"),
    };
    let advice = entry.map_or(&[][..], |entry| &entry.notes);
    let diagnostic = Diagnostic::error(message).at(place, entry.map_or("", |e| e.does.trim_end_matches('.')));
    let diagnostic = advice.iter().fold(diagnostic, |d, note| d.help(note.trim_end_matches('.')));
    diagnostic.help(format!("the models that are built are {}", spelling::all(&names)))
}
