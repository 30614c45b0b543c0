//! `urto explain`: what a command or a model with properties does, from the same tables that the reader works from.

use std::fmt::Write;

use crate::common::vocabulary::{Description, Models};
use crate::deck::{
    commands::grammar::{Entry, Form, Grammar, Kind, Standing, Status},
    language,
    pages::glossary,
    pages::page::{self, Body, Page},
    text::lexer::{Field, Lexer},
    text::source::Source,
    text::spelling::{self, Spelled},
};

/// Nothing is known by these words.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no command or material model {words}{}", hint(.near))]
pub struct UnknownTopic {
    /// The words asked for.
    pub words: String,
    /// The name that was perhaps meant.
    pub near: Option<String>,
}

fn hint(near: &Option<String>) -> String {
    near.as_ref().map_or("; `urto explain` without words lists all".into(), |near| format!("; did you mean {near}?"))
}

/// What a page can be about.
#[derive(Clone, Copy, PartialEq)]
enum Topic {
    Entry(usize),
    /// A model, by the place of its kind and its own among these.
    Model(usize, usize),
}

/// The text about a command or one of the models that commands choose from, which may be abbreviated. A property, a state
/// variable or a plot variable leads to the page that it stands on. Words that begin several names give a list of these; no
/// words give the list of all commands.
///
/// # Errors
///
/// Nothing is known by these words.
pub fn explain(words: &str, models: &[Models]) -> Result<String, UnknownTopic> {
    let source = asked(words);
    let Some(record) = Lexer::new(&source).next_record() else { return Ok(overview(models)) };
    match spelling::recognise(&record.fields, topics(models)) {
        Spelled::As { what, .. } => Ok(text(&page_of(what, models)) + &elsewhere(&record.fields, what, models)),
        _ => several(language(), source.text()).or_else(|| parts_named(&record.fields, models)).ok_or_else(|| {
            let names = topics(models).map(|(name, _)| name).chain(parts(models).into_iter().map(|(name, _)| name));
            UnknownTopic::new(source.text(), names.collect())
        }),
    }
}

/// Pages on which what these words name stands too: DAMAGE is a model and another's state variable.
fn elsewhere(fields: &[Field], named: Topic, models: &[Models]) -> String {
    let mut pages: Vec<String> = Vec::new();
    for (name, topic) in parts(models) {
        let same = spelling::word_count(name) == fields.len() && spelling::agreement(fields, name).is_some();
        // What a command has of its own name is no news.
        let title = page_of(topic, models).title;
        if same && topic != named && !title.starts_with("PLOT ") && !pages.contains(&title) {
            pages.push(title);
        }
    }
    if pages.is_empty() { String::new() } else { format!("\n It also stands on the page of {}.\n", pages.join(", ")) }
}

/// What the glossaries say of a word or a variable, the page of what has this very name, and the other commands that begin with it.
pub fn explain_word(words: &str, other: &'static Grammar, models: &[Models]) -> Option<String> {
    let term = glossary::find(glossary::words(), words).or_else(|| glossary::find(glossary::variables(), words))?;
    let named = asked(words);
    let named = named.text();
    let of_recipes = || other.entries.iter().find(|entry| entry.spellings().any(|name| name == named));
    let page = topics(models)
        .find_map(|(name, topic)| (name == named).then(|| page_of(topic, models)))
        .or_else(|| of_recipes().map(|entry| page::of_entry(entry, &[])));
    let more = language().entries.iter().filter(|entry| entry.name.starts_with(named));
    let more: String =
        more.filter(|entry| page.as_ref().is_none_or(|page| page.title != entry.name)).map(line).collect();
    let page = page.map_or(String::new(), |page| format!("\n{}", text(&page)));
    let more = if more.is_empty() { more } else { format!("\n Commands\n{more}") };
    Some(text(&page::of_term(term)) + &page + &more)
}

/// The pages whose text has all of these words, a line each; `None` where there is none. Searched are the glossaries,
/// commands of decks and of another language, and models.
pub fn search(words: &str, other: &'static Grammar, models: &[Models]) -> Option<String> {
    let wanted: Vec<String> = words.split_whitespace().map(str::to_lowercase).collect();
    let entries = [language(), other].into_iter().flat_map(|grammar| &grammar.entries);
    let pages = (glossary::words().iter().chain(glossary::variables()).map(page::of_term))
        .chain(entries.map(|entry| page::of_entry(entry, models)))
        .chain(models.iter().flat_map(|kind| kind.models.iter().map(|model| page::of_model(kind, model))));
    let found = pages.filter_map(|page| {
        let text = text(&page);
        let lower = text.to_lowercase();
        let first = wanted.first().map_or("", String::as_str);
        let line = text.lines().skip(1).find(|line| line.to_lowercase().contains(first)).or(text.lines().nth(1));
        wanted
            .iter()
            .all(|word| lower.split(|letter: char| !letter.is_alphanumeric()).any(|one| is_word(one, word)))
            .then(|| format!("   {:<28}{}\n", page.title, line.unwrap_or("").trim()))
    });
    let found: String = found.collect();
    (!found.is_empty() && !wanted.is_empty()).then_some(found)
}

/// Whether a word of a text is the one that is looked for, or its plural.
fn is_word(one: &str, wanted: &str) -> bool {
    one == wanted || one.strip_suffix('s') == Some(wanted)
}

/// As [`explain`], for the commands of another language, such as that of mesh recipes.
///
/// # Errors
///
/// Nothing is known by these words.
pub fn explain_in(grammar: &'static Grammar, words: &str) -> Result<String, UnknownTopic> {
    let source = asked(words);
    let commands = || grammar.entries.iter().enumerate().flat_map(|(i, e)| e.spellings().map(move |name| (name, i)));
    let Some(record) = Lexer::new(&source).next_record() else {
        return Ok(grammar.entries.iter().map(line).collect());
    };
    match spelling::recognise(&record.fields, commands()) {
        Spelled::As { what, .. } => Ok(text(&page::of_entry(&grammar.entries[what], &[]))),
        _ => several(grammar, source.text())
            .ok_or_else(|| UnknownTopic::new(source.text(), commands().map(|(name, _)| name).collect())),
    }
}

fn asked(words: &str) -> Source {
    let words = words.replace(['\'', '"'], " ").to_uppercase();
    Source::new("", words.split_whitespace().collect::<Vec<_>>().join(" "))
}

impl UnknownTopic {
    /// The hint is the nearest name, or else the first name with a word that is near.
    fn new(words: &str, names: Vec<&str>) -> UnknownTopic {
        let by_word = || {
            let near = spelling::nearest(words, names.iter().flat_map(|name| name.split(' ')))?;
            names.iter().copied().find(|name| name.split(' ').any(|word| word == near))
        };
        let near = spelling::nearest(words, names.iter().copied()).or_else(by_word);
        UnknownTopic { near: near.map(str::to_string), words: words.to_string() }
    }
}

fn page_of(topic: Topic, models: &[Models]) -> Page {
    match topic {
        Topic::Entry(index) => page::of_entry(&language().entries[index], models),
        Topic::Model(kind, index) => page::of_model(&models[kind], &models[kind].models[index]),
    }
}

/// All models, each with its topic.
fn all(models: &[Models]) -> impl Iterator<Item = (Topic, &Description)> {
    models.iter().enumerate().flat_map(|(kind, of_kind)| {
        let models = of_kind.models.iter().enumerate();
        models.map(move |(index, model)| (Topic::Model(kind, index), model))
    })
}

/// What stands on a page under a name of its own: properties and state variables of models, and the variables that
/// a plot command chooses from, with the names of their components.
fn parts(models: &[Models]) -> Vec<(&'static str, Topic)> {
    let mut parts = Vec::new();
    for (topic, model) in all(models) {
        parts.extend(model.properties.iter().map(|p| (p.keyword, topic)));
        parts.extend(model.state.iter().map(|v| (v.name, topic)));
    }
    for (i, entry) in language().entries.iter().enumerate().filter(|(_, e)| e.name.starts_with("PLOT ")) {
        for rule in &entry.fields {
            let Kind::Choice(choices) = &rule.kind else { continue };
            for choice in choices.iter().filter(|c| c.standing == Standing::Built) {
                let components = choice.meaning.split(|c: char| !c.is_ascii_alphanumeric());
                let components = components.filter(|w| w.len() > 1 && w.chars().all(|c| c.is_ascii_uppercase()));
                parts.push((choice.name.as_str(), Topic::Entry(i)));
                parts.extend(components.map(|name| (name, Topic::Entry(i))));
            }
        }
    }
    parts
}

/// The page on which these words stand, or the list of such pages.
fn parts_named(fields: &[Field], models: &[Models]) -> Option<String> {
    let parts = parts(models);
    let mut found: Vec<Topic> = Vec::new();
    for (name, topic) in &parts {
        if spelling::word_count(name) == fields.len() && spelling::agreement(fields, name).is_some() {
            found.extend((!found.contains(topic)).then_some(*topic));
        }
    }
    match found[..] {
        [] => None,
        [one] => Some(text(&page_of(one, models))),
        _ => Some(
            found
                .into_iter()
                .map(|topic| page_of(topic, models))
                .map(|p| format!("   {:<28}{}\n", p.title, p.summary))
                .collect(),
        ),
    }
}

fn topics(models: &[Models]) -> impl Iterator<Item = (&'static str, Topic)> {
    let entries = language().entries.iter().enumerate();
    let entries = entries.flat_map(|(i, e)| e.spellings().map(move |name| (name, Topic::Entry(i))));
    entries.chain(all(models).flat_map(|(topic, model)| model.names().map(move |name| (name, topic))))
}

/// The entries whose names begin with these words.
fn several(grammar: &Grammar, words: &str) -> Option<String> {
    let lines: Vec<String> = grammar.entries.iter().filter(|e| e.name.starts_with(words)).map(line).collect();
    (!lines.is_empty()).then(|| lines.concat())
}

/// All commands by family, and the models.
fn overview(models: &[Models]) -> String {
    let mut text = String::new();
    let mut family = "";
    for entry in language().entries.iter().filter(|e| e.form != Form::Material) {
        if entry.family != family {
            family = &entry.family;
            let _ = writeln!(text, "{}{family}", if text.is_empty() { "" } else { "\n" });
        }
        text += &line(entry);
    }
    for kind in models {
        let _ = writeln!(text, "\n{}", kind.heading);
        for model in &kind.models {
            let _ = writeln!(text, "   {:<28}{}", model.name, model.summary);
        }
        // Laws that are known only by name.
        let planned = language().entries.iter().filter(|e| e.form == Form::Material && kind.command == "MATERIAL");
        planned.for_each(|entry| text += &line(entry));
    }
    text += "\n * known, but not built yet. `urto explain 'PLOT TIME'` tells more of a command.\n";
    text
}

fn line(entry: &Entry) -> String {
    let mark = if entry.status == Status::Built { ' ' } else { '*' };
    format!(" {mark} {:<28}{}\n", entry.name, entry.does)
}

/// A page for a terminal.
fn text(page: &Page) -> String {
    let summary = if page.summary.is_empty() { String::new() } else { wrap(&page.summary, 3) };
    let mut text = format!("{}\n{summary}", page.title);
    for (heading, body) in &page.sections {
        if !heading.is_empty() {
            let _ = write!(text, "\n {heading}\n");
        }
        match body {
            Body::Text(lines) => text.extend(lines.iter().map(|line| wrap(line, 3))),
            Body::Lines(lines) => text.extend(lines.iter().map(|line| format!("   {line}\n"))),
            Body::Terms(terms) => {
                let width = terms.iter().map(|(term, _)| term.len()).max().unwrap_or(0) + 2;
                text.extend(terms.iter().map(|(term, meaning)| {
                    let meaning: String = meaning.lines().map(|line| wrap(line, 3 + width)).collect();
                    format!("   {term:<width$}{}", meaning.trim_start())
                }));
            }
        }
    }
    text
}

/// Width of a terminal that everybody has.
const WIDTH: usize = 80;

/// Breaks a text into lines with an indent.
fn wrap(text: &str, indent: usize) -> String {
    let mut lines = String::new();
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() && indent + line.len() + 1 + word.len() > WIDTH {
            let _ = writeln!(lines, "{:indent$}{line}", "");
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line += word;
    }
    let _ = writeln!(lines, "{:indent$}{line}", "");
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn explain(words: &str) -> Result<String, UnknownTopic> {
        super::explain(words, &crate::material::models())
    }

    #[test]
    fn a_command_is_explained_with_its_fields() {
        let text = explain("'initial vel mat'").expect("an abbreviation");
        assert!(text.starts_with("INITIAL VELOCITY MATERIAL\n   Gives every node of an element block"), "{text}");
        assert!(text.contains("INITIAL VELOCITY MATERIAL, block, <vx [0.0]>, <vy [0.0]>, <vz [0.0]>"), "{text}");
        assert!(text.contains("vz     Velocity in z [length/time]. Default 0.0."), "{text}");
        assert!(text.lines().all(|line| line.len() <= 100));
    }

    #[test]
    fn a_material_is_explained_with_properties_and_state() {
        let text = explain("ELASTIC PLASTIC").expect("a material");
        assert!(text.contains("YIELD STRESS") && text.contains("EQPS"), "{text}");
        assert!(explain("CRUSHED SALT").expect("refused").contains("Refused: its equations"));
    }

    #[test]
    fn what_stands_on_a_page_leads_there() {
        assert!(explain("ALPHA11").is_ok_and(|page| page.starts_with("ELASTIC PLASTIC\n")));
        assert!(explain("EQPS").is_ok_and(|list| list.contains("   ELASTIC PLASTIC ")));
        assert!(explain("sigxx").is_ok_and(|page| page.starts_with("PLOT ELEMENT\n")));
        let pages = explain("POISSONS RATIO").expect("a property");
        assert!(pages.contains("   ELASTIC ") && pages.contains("   ELASTIC PLASTIC "), "{pages}");
    }

    #[test]
    fn beginnings_list_and_unknown_words_hint() {
        assert_eq!(explain("TIME STEP").map(|text| text.lines().count()), Ok(5));
        assert!(explain("").expect("the list").contains(" * SPH"));
        assert_eq!(explain("PLOT TIEM").map_err(|e| e.near), Err(Some("PLOT TIME".into())));
        assert_eq!(explain("VELOCTY").map_err(|e| e.near), Err(Some("VELOCITY".into())));
        let message = explain("FROBNICATE").map_err(|e| e.to_string());
        assert!(message.is_err_and(|m| m.starts_with("there is no command or material model FROBNICATE; `urto")));
    }
}
