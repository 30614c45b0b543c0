//! MATERIAL groups: which law an element block follows, and with which parameters.

use super::{
    BlockMaterial,
    problem::{Draft, Setter},
};
use crate::{
    deck::{
        Absent, Agreement, Card, Diagnostic, Field, FieldReader, FieldRule, Form, Kind, Row, Span, Spelled, language,
        spelling,
    },
    material::{Entry, MATERIALS, Property},
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
    let Some(values) = values(card, entry, draft) else { return };
    match (entry.build)(&values) {
        Ok(law) => draft.model.materials.push(BlockMaterial { block, density: card.number("density"), law }),
        Err(refusal) => {
            let message = format!("MATERIAL {block}: {} {}", refusal.keyword, refusal.reason);
            let row = card.rows.iter().find(|row| spelling::agreement(&row.fields, refusal.keyword).is_some());
            draft.report(Diagnostic::error(message).at(row.map_or(card.record, Row::span), ""));
        }
    }
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
        for row in &card.rows {
            property(card, entry, row, draft);
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

/// The values of a law's properties in its own order; `None` if a line is wrong or a property is missing.
fn values(card: &Card, entry: &'static Entry, draft: &mut Draft) -> Option<Vec<f64>> {
    let mut given: Vec<Option<(f64, Span)>> = vec![None; entry.properties.len()];
    let mut sound = true;
    for row in &card.rows {
        match property(card, entry, row, draft) {
            Some((index, value)) if given[index].is_none() => given[index] = Some((value, row.span())),
            Some((index, _)) => {
                sound = false;
                report_twice(card, entry, &entry.properties[index], row, given[index], draft);
            }
            None => sound = false,
        }
    }
    let missing: Vec<&Property> = entry
        .properties
        .iter()
        .zip(&given)
        .filter(|(property, value)| property.default.is_none() && value.is_none())
        .map(|(property, _)| property)
        .filter(|property| !mentioned(card, property))
        .collect();
    if !missing.is_empty() {
        draft.report(report_missing(card, &missing));
        return None;
    }
    let values = entry.properties.iter().zip(&given).map(|(p, v)| v.map(|v| v.0).or(p.default));
    if sound { values.collect() } else { None }
}

/// Whether a line names this property, rightly or wrongly; then its mistake has been reported.
fn mentioned(card: &Card, property: &Property) -> bool {
    card.rows.iter().any(|row| {
        spelling::agreement(&row.fields, property.keyword).is_some()
            || resembling(row, std::iter::once(property.keyword)).is_some()
    })
}

/// The keyword that a line may mean: a near one, or the one whose first word it starts with.
fn resembling(row: &Row, mut keywords: impl Iterator<Item = &'static str> + Clone) -> Option<&'static str> {
    let near = spelling::nearest_start(&row.fields, keywords.clone()).map(|(keyword, _)| keyword);
    near.or_else(|| {
        let first = row.fields.first().filter(|f| f.is_word())?;
        let first_words = || keywords.clone().filter_map(|keyword| keyword.split(' ').next());
        let near = spelling::nearest(&first.text, first_words())?;
        keywords.find(|keyword| keyword.split(' ').next() == Some(near))
    })
}

/// Reads a line `KEYWORD value`: which property it is, and the value.
fn property(card: &Card, entry: &'static Entry, row: &Row, draft: &mut Draft) -> Option<(usize, f64)> {
    let keywords = entry.properties.iter().enumerate().map(|(i, p)| (p.keyword, i));
    let owner = card.maybe_integer("block").map_or("MATERIAL".to_string(), |block| format!("MATERIAL {block}"));
    match spelling::recognise(&row.fields, keywords) {
        Spelled::As { what, words, agreement, .. } => {
            let property = &entry.properties[what];
            if agreement == Agreement::Abbreviated {
                let written = draft.deck.source.slice(row.fields[0].span.join(row.fields[words - 1].span)).to_string();
                draft.report(
                    Diagnostic::note(format!("assumed {} for `{written}`", property.keyword)).at(row.span(), ""),
                );
            }
            let rule = rule(property);
            let form = format!("{} = value", property.keyword);
            let end = Span { start: row.span().end, end: row.span().end };
            let mut reader = FieldReader { owner: &owner, form: &form, end, diagnostics: &mut draft.found };
            let (values, complete) = reader.read(&[rule], &row.fields[words..]);
            let value = values.first()?.1.first()?.value.number()?;
            complete.then_some((what, value))
        }
        Spelled::Several(names) => {
            draft.report(
                Diagnostic::error(format!(
                    "{owner}: {} may stand for {}",
                    row.fields[0].text,
                    spelling::either(&names)
                ))
                .at(row.fields[0].span, "this abbreviation is not clear; write more of it"),
            );
            None
        }
        Spelled::Nothing => {
            draft.report(unknown_property(&owner, entry, row));
            None
        }
    }
}

/// A property as the rule of a field.
fn rule(property: &Property) -> FieldRule {
    FieldRule {
        name: property.keyword.to_string(),
        repeats: false,
        kind: Kind::Number,
        default: property.default.map_or(Absent::Required, |value| Absent::Value(value.to_string())),
        range: property.range,
        unit: property.dimension.to_string(),
        meaning: property.meaning.to_string(),
    }
}

fn unknown_property(owner: &str, entry: &'static Entry, row: &Row) -> Diagnostic {
    let words = row.fields.iter().take_while(|f| f.is_word()).count();
    let Some(last) = row.fields[..words].last() else {
        return Diagnostic::error(format!("{owner}: a line starts with the keyword of a property"))
            .at(row.fields[0].span, "expected a keyword")
            .help(properties_of(entry));
    };
    let shown = spelling::shown(&row.fields[..words]);
    let place = row.fields[0].span.join(last.span);
    let near = resembling(row, entry.properties.iter().map(|p| p.keyword));
    let others: Vec<&str> = MATERIALS
        .iter()
        .filter(|m| m.properties.iter().any(|p| spelling::agreement(&row.fields, p.keyword).is_some()))
        .map(|m| m.name)
        .collect();
    let elsewhere = format!("{} is a property of {}", shown, spelling::all(&others));
    Diagnostic::error(format!("{owner}: {} has no property {shown}", entry.name))
        .at(place, "unknown keyword")
        .help(near.map_or(String::new(), |keyword| format!("did you mean {keyword}?")))
        .help(if others.is_empty() { String::new() } else { elsewhere })
        .help(properties_of(entry))
}

fn properties_of(entry: &Entry) -> String {
    let keywords: Vec<&str> = entry.properties.iter().map(|p| p.keyword).collect();
    format!("the properties of {} are {}", entry.name, spelling::all(&keywords))
}

fn report_twice(
    card: &Card,
    entry: &Entry,
    property: &Property,
    row: &Row,
    first: Option<(f64, Span)>,
    draft: &mut Draft,
) {
    let message = format!("MATERIAL {}: {} is given twice", card.integer("block"), property.keyword);
    let mut diagnostic = Diagnostic::error(message).at(row.span(), "the second one");
    if let Some((_, span)) = first {
        diagnostic = diagnostic.at(span, "the first one");
    }
    draft.report(diagnostic.help(properties_of(entry)));
}

fn report_missing(card: &Card, missing: &[&Property]) -> Diagnostic {
    let keywords: Vec<&str> = missing.iter().map(|p| p.keyword).collect();
    let verb = if missing.len() == 1 { "is" } else { "are" };
    let block = card.integer("block");
    let mut diagnostic = Diagnostic::error(format!("MATERIAL {block}: {} {verb} missing", spelling::all(&keywords)))
        .at(card.record, format!("expected between this line and END: {}", spelling::all(&keywords)));
    for property in missing {
        let (meaning, unit) = (property.meaning.trim_end_matches('.'), property.dimension);
        let unit = if unit == "-" { String::new() } else { format!(" [{unit}]") };
        let expected = rule(property).expected();
        diagnostic = diagnostic.help(format!("{}: {meaning}{unit}, {expected}", property.keyword));
    }
    diagnostic
}
