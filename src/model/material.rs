//! MATERIAL groups: which law an element block follows, and with which parameters.

use super::{
    BlockMaterial,
    problem::{Draft, Setter},
    properties::Properties,
};
use crate::{
    deck::{Agreement, Card, Diagnostic, Field, Form, Row, Span, Spelled, language, spelling},
    material::{Entry, Given, MATERIALS, Refusal},
};

pub(super) const COMMANDS: &[Setter] = &[("MATERIAL", material)];

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
    let functions = &draft.model.functions;
    let function = |id| functions.iter().find(|f| f.id == id).map(|f| f.points.clone());
    match (entry.build)(&Given { values: &values, density, function: &function }) {
        Ok(law) => draft.model.materials.push(BlockMaterial { block, density, law }),
        Err(refusal) => refused(card, &refusal, draft),
    }
}

/// Reports values that do not make a law together.
fn refused(card: &Card, refusal: &Refusal, draft: &mut Draft) {
    let message = format!("{} {}: {} {}", card.name, card.integer("block"), refusal.keyword, refusal.reason);
    let row = card.rows.iter().find(|row| spelling::agreement(&row.fields, refusal.keyword).is_some());
    draft.report(Diagnostic::error(message).at(row.map_or(card.record, Row::span), ""));
}

/// Looks at the properties of a material whose first line has a mistake, if its model is clear all the same, so that
/// one reading of the deck shows all that is wrong. What is missing is not told: the group may have lost its END.
pub(super) fn check_unfinished(draft: &mut Draft) {
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
    match spelling::recognise_all(&words, built.clone().chain(planned)) {
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
        _ => {
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

fn spellings(entry: &'static Entry) -> impl Iterator<Item = &'static str> + Clone {
    std::iter::once(entry.name).chain(entry.aliases.iter().copied())
}

fn not_built(card: &Card, name: &str, place: Span) -> Diagnostic {
    let does = language().entries.iter().find(|e| e.spellings().any(|s| s == name)).map_or("", |e| e.does.as_str());
    let names: Vec<&str> = MATERIALS.iter().map(|entry| entry.name).collect();
    Diagnostic::error(format!("MATERIAL {}: the model {name} is known, but not built yet", card.integer("block")))
        .at(place, does.trim_end_matches('.'))
        .help(format!("the models that are built are {}", spelling::all(&names)))
}
