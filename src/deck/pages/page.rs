//! What there is to say about a command or a model with properties, ready to be printed as text or as a manual page.

use crate::common::vocabulary::{Description, Models, Origin, Property};
use crate::deck::{
    commands::fields::range_in_words,
    commands::grammar::{Absent, Entry, FieldRule, Form, Kind, Standing, Status},
    pages::glossary::{self, Term},
};

/// A page about one entry.
pub(in crate::deck) struct Page {
    /// The name of the entry.
    pub title: String,
    /// What it does, with what it is not able to do yet.
    pub summary: String,
    /// The parts that have something to say, in order.
    pub sections: Vec<(String, Body)>,
}

/// What stands under a heading.
pub(in crate::deck) enum Body {
    /// Sentences.
    Text(Vec<String>),
    /// Lines of a deck.
    Lines(Vec<String>),
    /// Terms, each with what it may be and what it means.
    Terms(Vec<(String, String)>),
}

/// Heading of the section that says whose words these are.
pub(in crate::deck) const SPELLING: &str = "Spelling";

impl Body {
    fn is_empty(&self) -> bool {
        match self {
            Body::Text(lines) | Body::Lines(lines) => lines.is_empty(),
            Body::Terms(terms) => terms.is_empty(),
        }
    }
}

impl Page {
    fn new(title: &str, summary: String, sections: Vec<(&str, Body)>) -> Page {
        let sections = sections.into_iter().filter(|(_, body)| !body.is_empty());
        let sections = sections.map(|(heading, body)| (heading.to_string(), body)).collect();
        Page { title: title.to_string(), summary, sections }
    }
}

/// The page of a command, a group or a name that is planned; a command that chooses from `models` lists them.
pub(in crate::deck) fn of_entry(entry: &Entry, models: &[Models]) -> Page {
    let built = entry.status == Status::Built;
    let mut form = vec![entry.syntax()];
    if !entry.space.is_empty() {
        form.push(format!("{}   in two dimensions", entry.in_plane().syntax()));
    }
    match (entry.form, entry.columns.is_empty()) {
        (Form::Group, true) => form.extend(["KEYWORD = value".to_string(), "END".to_string()]),
        (Form::Group, false) => {
            let columns: Vec<String> = entry.columns.iter().map(FieldRule::syntax).collect();
            form.extend([columns.join(", "), "END".to_string()]);
        }
        _ => (),
    }
    let chosen = models.iter().filter(|kind| kind.command == entry.name).flat_map(|kind| &kind.models);
    let models = chosen.map(|model| (model.name.to_string(), model.summary.to_string())).collect();
    let summary = match &entry.status {
        Status::Built => entry.does.clone(),
        Status::Planned { physics: true } => {
            format!("{} Known, but not built yet: a deck with it does not run.", entry.does)
        }
        Status::Planned { physics: false } => {
            format!("{} Known, but not built yet: a deck with it runs without it.", entry.does)
        }
        Status::Refused(why) => format!("{} Refused: {why}.", entry.does),
        Status::Idle(why) => format!("{} Changes nothing: {why}.", entry.does),
    };
    Page::new(
        &entry.name,
        summary,
        vec![
            ("Form", Body::Lines(if built { form } else { Vec::new() })),
            ("Fields", Body::Terms(entry.fields.iter().map(field).collect())),
            ("On each line until END", Body::Terms(entry.columns.iter().map(field).collect())),
            ("Models", Body::Terms(models)),
            ("Notes", Body::Text(entry.notes.clone())),
            ("Example", Body::Lines(entry.example.clone())),
            ("Other spellings", Body::Text(entry.aliases.clone())),
            ("See also", Body::Text(if entry.see.is_empty() { Vec::new() } else { vec![entry.see.join(", ")] })),
            (SPELLING, Body::Text(vec![origin(entry.from).to_string()])),
        ],
    )
}

/// The page of a model of a kind.
pub(in crate::deck) fn of_model(kind: &Models, entry: &Description) -> Page {
    let [before, after] = kind.form;
    let mut form = vec![format!("{before}{}{after}", entry.name)];
    form.extend(entry.properties.iter().map(|p| match p.default {
        None => format!("{} = {}", p.keyword, p.symbol),
        Some(default) => format!("{} = <{} [{default:?}]>", p.keyword, p.symbol),
    }));
    form.push("END".into());
    let state = entry.state.iter().map(|v| (v.name.to_string(), v.meaning.to_string())).collect();
    let law = glossary::law(entry.name).cloned().unwrap_or_default();
    let mut sections = vec![
        ("Form", Body::Lines(form)),
        ("Properties", Body::Terms(entry.properties.iter().map(property).collect())),
        ("State variables, for PLOT STATE", Body::Terms(state)),
    ];
    sections.extend(said("Formula", law.text));
    sections.push(("Numbers", Body::Text(law.worked)));
    sections.extend([
        ("Other spellings", Body::Text(entry.aliases.iter().map(|alias| alias.to_string()).collect())),
        ("See also", Body::Text(vec![kind.see.into()])),
        (SPELLING, Body::Text(vec![origin(entry.origin).to_string()])),
    ]);
    Page::new(entry.name, entry.summary.to_string(), sections)
}

/// The page of a word or a variable of the glossary.
pub(in crate::deck) fn of_term(term: &Term) -> Page {
    let title = term.names.first().cloned().unwrap_or_default();
    let mut sections = said("", term.text.clone());
    let others = term.names.iter().skip(1).cloned().collect::<Vec<_>>();
    sections.push(("Other words", Body::Text(if others.is_empty() { others } else { vec![others.join(", ")] })));
    sections.push(("See also", Body::Text(if term.see.is_empty() { Vec::new() } else { vec![term.see.join(", ")] })));
    Page::new(&title, String::new(), sections)
}

/// Paragraphs and lines that stay as they are, each kind in sections of its own; only the first has the heading.
fn said(heading: &'static str, text: Vec<String>) -> Vec<(&'static str, Body)> {
    let mut sections: Vec<(&'static str, Body)> = Vec::new();
    for line in text {
        let heading = if sections.is_empty() { heading } else { "" };
        match (line.strip_prefix("  "), sections.last_mut()) {
            (Some(kept), Some((_, Body::Lines(lines)))) => lines.push(kept.to_owned()),
            (Some(kept), _) => sections.push((heading, Body::Lines(vec![kept.to_owned()]))),
            (None, Some((_, Body::Text(lines)))) => lines.push(line),
            (None, _) => sections.push((heading, Body::Text(vec![line]))),
        }
    }
    sections
}

fn field(rule: &FieldRule) -> (String, String) {
    let name = rule.label() + if rule.repeats { ", ..." } else { "" };
    let mut text = sentence(&rule.meaning, &rule.unit);
    match &rule.kind {
        Kind::Choice(choices) => {
            let built = choices.iter().filter(|c| c.standing == Standing::Built);
            for choice in built {
                let meaning = if choice.meaning.is_empty() { String::new() } else { format!(": {}", choice.meaning) };
                text += &format!("\n{}{meaning}", choice.name);
            }
        }
        Kind::NextLine => text += " Stands on the next line.",
        Kind::Integer => text += &format!(" {}.", capital(&rule.expected())),
        Kind::Number => text += &range_in_words(rule.range).map_or(String::new(), |r| format!(" {}.", capital(&r))),
        Kind::NumberOr(word) => {
            text += &range_in_words(rule.range).map_or(String::new(), |r| format!(" {}.", capital(&r)));
            text += &format!(" Or {word}.");
        }
        Kind::IdOrAll(_) => text += " Or ALL.",
        Kind::Id(_) | Kind::Words | Kind::Name => (),
    }
    let default = match &rule.default {
        Absent::Required => String::new(),
        Absent::Optional => " May be left out.".into(),
        Absent::Value(value) | Absent::Follows(value) => format!(" Default {value}."),
    };
    // Defaults belong to the first line, before the list of choices.
    let text = match text.split_once('\n') {
        Some((first, choices)) => format!("{first}{default}\n{choices}"),
        None => text + &default,
    };
    (name, text)
}

fn property(property: &Property) -> (String, String) {
    let range = range_in_words(property.range).map_or(String::new(), |range| format!(" {}.", capital(&range)));
    let default = property.default.map_or(String::new(), |default| format!(" Default {default:?}."));
    (property.keyword.to_string(), sentence(property.meaning, property.dimension) + &range + &default)
}

/// A meaning with its unit, as a sentence.
fn sentence(meaning: &str, unit: &str) -> String {
    let meaning = capital(meaning.trim_end_matches('.'));
    if unit.is_empty() || unit == "-" { format!("{meaning}.") } else { format!("{meaning} [{unit}].") }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn origin(origin: Origin) -> &'static str {
    match origin {
        Origin::Verified => "As in decks and print files of PRONTO2D 3.4.",
        Origin::Recalled => "As remembered from PRONTO's manuals; not seen in a genuine deck.",
        Origin::Ours => "An addition of urto, not in PRONTO.",
    }
}
