//! The fields of a record held against the rules of its entry, and what to say when they do not agree.

use crate::common::vocabulary::Range;
use crate::deck::{
    card::{Item, Value},
    commands::grammar::{Absent, Choice, FieldRule, Kind, Standing},
    text::diagnostic::{Diagnostic, Diagnostics},
    text::lexer::{Field, FieldKind, Lexer},
    text::source::{Source, Span},
    text::spelling,
    value::{self, Wrong},
};

/// Reads fields by rules and gathers what is wrong.
pub struct FieldReader<'a> {
    /// What the fields belong to, as messages call it.
    pub owner: &'a str,
    /// The form shown as help.
    pub form: &'a str,
    /// Where the record ends.
    pub end: Span,
    /// Where mistakes are gathered.
    pub diagnostics: &'a mut Diagnostics,
}

/// A value that was read, nothing for a field that may be absent, or what is wrong.
type Outcome = Result<Option<Item>, Diagnostic>;

impl FieldReader<'_> {
    /// The values of each rule in order, and whether all could be read.
    pub fn read(&mut self, rules: &[FieldRule], fields: &[Field]) -> (Vec<(String, Vec<Item>)>, bool) {
        let mut values = Vec::new();
        let mut complete = true;
        let mut at = 0;
        for rule in rules.iter().filter(|rule| rule.kind != Kind::NextLine) {
            let mut items = Vec::new();
            loop {
                let (used, outcome) = self.one(rule, &fields[at..]);
                at += used;
                match outcome {
                    Ok(item) => items.extend(item),
                    Err(diagnostic) => {
                        complete = false;
                        self.diagnostics.push(diagnostic.help(format!("form: {}", self.form)));
                    }
                }
                if !rule.repeats || at >= fields.len() {
                    break;
                }
            }
            values.push((rule.name.clone(), items));
        }
        if complete && at < fields.len() {
            self.too_many(rules, fields, at);
            complete = false;
        }
        (values, complete)
    }

    /// How many fields one value took, and the value.
    fn one(&mut self, rule: &FieldRule, fields: &[Field]) -> (usize, Outcome) {
        let Some(field) = fields.first() else { return (0, self.absent(rule, self.end)) };
        if field.kind == FieldKind::Null {
            return (1, self.absent(rule, field.span));
        }
        // A number cannot be words: these have been left out, and the number belongs to the next rule.
        if rule.kind == Kind::Words && field.number().is_some() {
            return (0, self.absent(rule, field.span));
        }
        match value::read(rule, fields) {
            Ok((used, value)) => {
                let span = field.span.join(fields[used - 1].span);
                let unbuilt = self.warn_if_planned(rule, &value, span);
                self.note_abbreviation(rule, &value, &fields[..used], span);
                (used, Ok((!unbuilt).then_some(Item { value, span: Some(span) })))
            }
            Err(wrong) => (wrong.used, Err(self.wrong(rule, fields, wrong))),
        }
    }

    /// Whether a choice is one that is known but not built yet; warns of it.
    fn warn_if_planned(&mut self, rule: &FieldRule, value: &Value, span: Span) -> bool {
        let Kind::Choice(choices) = &rule.kind else { return false };
        let chosen = choices.iter().find(|c| c.standing == Standing::Planned && Some(c.name.as_str()) == value.text());
        if let Some(Choice { name, meaning, .. }) = chosen {
            let message = format!("{}: {name} is known, but not built yet: the run goes on without it", self.owner);
            self.diagnostics.push(Diagnostic::warning(message).at(span, meaning.as_str()));
        }
        chosen.is_some()
    }

    fn note_abbreviation(&mut self, rule: &FieldRule, value: &Value, fields: &[Field], span: Span) {
        let written = fields.iter().map(|f| f.text.as_str()).collect::<Vec<_>>().join(" ");
        if let (Kind::Choice(_), Some(name)) = (&rule.kind, value.text())
            && name != written
        {
            self.diagnostics.push(Diagnostic::note(format!("assumed {name} for `{written}`")).at(span, ""));
        }
    }

    fn absent(&self, rule: &FieldRule, place: Span) -> Outcome {
        match &rule.default {
            Absent::Required => Err(Diagnostic::error(format!("{}: {} is missing", self.owner, rule.label()))
                .at(place, format!("expected {}: {}", rule.expected(), rule.gloss()))),
            Absent::Optional | Absent::Follows(_) => Ok(None),
            Absent::Value(text) => Ok(default_value(rule, text).map(|value| Item { value, span: None })),
        }
    }

    fn wrong(&self, rule: &FieldRule, fields: &[Field], wrong: Wrong) -> Diagnostic {
        let place = fields[0].span.join(fields[wrong.used - 1].span);
        let text = spelling::cut(self.diagnostics.source().slice(place));
        let must = wrong.must.unwrap_or_else(|| rule.expected());
        let hint = if wrong.hint.is_empty() { decimal_comma(rule, fields) } else { wrong.hint };
        Diagnostic::error(format!("{}: {} is {text}; it must be {must}", self.owner, rule.label()))
            .at(place, rule.gloss())
            .help(hint)
    }

    fn too_many(&mut self, rules: &[FieldRule], fields: &[Field], at: usize) {
        let extra = &fields[at..];
        let count = if extra.len() == 1 { "one field".to_string() } else { format!("{} fields", extra.len()) };
        let place = extra[0].span.join(extra[extra.len() - 1].span);
        let hint = if rules.iter().any(|rule| rule.kind == Kind::NextLine) {
            "the text belongs on the next line"
        } else if extra[0].is_word() {
            "a remark needs a $ before it"
        } else if at > 0 && has_only_digits(&fields[at - 1]) && has_only_digits(&fields[at]) {
            "a comma separates fields: a decimal fraction is written 0.5, not 0,5"
        } else {
            ""
        };
        self.diagnostics.push(
            Diagnostic::error(format!("{}: {count} too many", self.owner))
                .at(place, "nothing more is expected here")
                .help(hint)
                .help(format!("form: {}", self.form)),
        );
    }
}

impl FieldRule {
    /// The name as messages show it.
    pub fn label(&self) -> String {
        self.name.replace('_', " ")
    }

    /// What may stand here: "a number greater than 0".
    pub fn expected(&self) -> String {
        let number = |what: &str| match range_in_words(self.range) {
            Some(range) if range.starts_with(|c: char| c.is_ascii_digit()) => format!("{what}, {range}"),
            Some(range) => format!("{what} {range}"),
            None => what.to_string(),
        };
        match &self.kind {
            Kind::Number => number("a number"),
            Kind::NumberOr(word) => number("a number") + ", or " + word,
            Kind::Integer => number("a whole number"),
            Kind::Id(what) => format!("the number of a {what}"),
            Kind::IdOrAll(what) => format!("the number of a {what}, or ALL"),
            Kind::Choice(choices) => spelling::either(&built(choices)),
            Kind::Words => "a name in words".into(),
            Kind::Name => "a name".into(),
            Kind::NextLine => "text on the next line".into(),
        }
    }

    /// The meaning with its unit.
    fn gloss(&self) -> String {
        let meaning = self.meaning.trim_end_matches('.');
        match self.unit.as_str() {
            "" | "-" => meaning.to_string(),
            unit => format!("{meaning} [{unit}]"),
        }
    }
}

/// "greater than 0 and at most 1"; `None` when any number will do.
pub(crate) fn range_in_words(range: Range) -> Option<String> {
    match range {
        Range::Any => None,
        Range::Positive => Some("greater than 0".into()),
        Range::NotNegative => Some("0 or more".into()),
        Range::Function => Some("the number of a function".into()),
        Range::Between { low: (low, true), high: (high, true) } => Some(format!("from {low} to {high}")),
        Range::Between { low, high } => {
            let low = format!("{} {}", if low.1 { "at least" } else { "greater than" }, low.0);
            let high = format!("{} {}", if high.1 { "at most" } else { "less than" }, high.0);
            Some(format!("{low} and {high}"))
        }
    }
}

/// Names of the choices that can be used.
fn built(choices: &[Choice]) -> Vec<&str> {
    choices.iter().filter(|c| c.standing == Standing::Built).map(|c| c.name.as_str()).collect()
}

/// The default's text, read as if it stood in the deck.
fn default_value(rule: &FieldRule, text: &str) -> Option<Value> {
    let source = Source::new("default", text);
    let fields = Lexer::new(&source).next_record()?.fields;
    value::read(rule, &fields).ok().map(|(_, value)| value)
}

/// Advice when a number out of range and the next field look like one number with a decimal comma, `0,9`.
fn decimal_comma(rule: &FieldRule, fields: &[Field]) -> String {
    let [first, second, ..] = fields else { return String::new() };
    let glued = second.span.start == first.span.end + 1 && has_only_digits(first) && has_only_digits(second);
    let joined = format!("{}.{}", first.text, second.text);
    match crate::deck::text::number::parse(&joined) {
        Some(number) if glued && rule.kind == Kind::Number && rule.range.contains(number.value) => {
            format!("a comma separates fields: did you mean {joined}?")
        }
        _ => String::new(),
    }
}

/// Whether a field is a number without point and exponent.
fn has_only_digits(field: &Field) -> bool {
    let digits = field.text.trim_start_matches('-');
    !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit())
}
