//! One value at the start of some fields, by the rule that it follows.

use super::{
    card::Value,
    commands::grammar::{Choice, FieldRule, Kind, Standing},
    text::lexer::Field,
    text::number,
    text::spelling::{self, Agreement, Spelled},
};

/// Stands for everything where a number could stand.
const ALL: &str = "ALL";

/// Why a value cannot be read.
pub(super) struct Wrong {
    /// How many fields it covers, at least one.
    pub used: usize,
    /// What it must be, where that is not what the rule says in general.
    pub must: Option<String>,
    /// What may have happened, for help; may be empty.
    pub hint: String,
}

impl Wrong {
    fn hint(hint: impl Into<String>) -> Wrong {
        Wrong { used: 1, must: None, hint: hint.into() }
    }

    fn must(must: impl Into<String>) -> Wrong {
        Wrong { used: 1, must: Some(must.into()), hint: String::new() }
    }
}

/// The value at the start of `fields`, and how many of them it takes.
pub(super) fn read(rule: &FieldRule, fields: &[Field]) -> Result<(usize, Value), Wrong> {
    let Some(field) = fields.first() else { return Err(Wrong::hint("")) };
    match &rule.kind {
        Kind::NumberOr(word) if spelling::agreement(fields, word) == Some(Agreement::Exact) => {
            Ok((1, Value::Text((*word).into())))
        }
        Kind::Number | Kind::NumberOr(_) => real(rule, field).map(|value| (1, Value::Number(value))),
        Kind::Integer => integer(rule, field).map(|value| (1, Value::Integer(value))),
        Kind::Id(what) => id(what, field).map(|value| (1, Value::Integer(value))),
        Kind::IdOrAll(_) if spelling::agreement(fields, ALL) == Some(Agreement::Exact) => {
            Ok((1, Value::Text(ALL.into())))
        }
        Kind::IdOrAll(what) => id(what, field).map(|value| (1, Value::Integer(value))),
        Kind::Choice(choices) => choice(choices, fields),
        Kind::Words => words(fields),
        Kind::Name | Kind::NextLine => Ok((1, Value::Text(field.text.clone()))),
    }
}

fn real(rule: &FieldRule, field: &Field) -> Result<f64, Wrong> {
    let Some(number) = field.number() else { return Err(Wrong::hint(number_hint(&field.text))) };
    if number.value.is_infinite() {
        return Err(Wrong::must("smaller than 1.8E308, the largest number there is"));
    }
    in_range(rule, number.value).map(|()| number.value)
}

fn in_range(rule: &FieldRule, value: f64) -> Result<(), Wrong> {
    match super::commands::fields::range_in_words(rule.range) {
        Some(range) if !rule.range.contains(value) => Err(Wrong::must(range)),
        _ => Ok(()),
    }
}

fn integer(rule: &FieldRule, field: &Field) -> Result<i64, Wrong> {
    let value = whole(field)?;
    in_range(rule, value as f64).map(|()| value)
}

fn id(what: &str, field: &Field) -> Result<i64, Wrong> {
    // Some programs number what a mesh has from 0 on.
    let least = i64::from(what == "function");
    let value = whole(field)?;
    if value >= least {
        Ok(value)
    } else {
        Err(Wrong::must(format!("{least} or more, as the number of every {what} is")))
    }
}

fn whole(field: &Field) -> Result<i64, Wrong> {
    let Some(number) = field.number() else { return Err(Wrong::hint(number_hint(&field.text))) };
    let reason = || match (number.value.fract() == 0.0, field.text.contains(['.', 'E', 'e', 'D', 'd'])) {
        (true, true) => "written out in digits alone: with a point or an exponent it counts as whole up to 1E9",
        (true, false) => "below 1E18",
        (false, _) => "a whole number",
    };
    number.integer.ok_or_else(|| Wrong::must(reason()))
}

fn choice(choices: &[Choice], fields: &[Field]) -> Result<(usize, Value), Wrong> {
    let known = choices.iter().filter(|c| c.standing != Standing::Elsewhere).map(|c| c.name.as_str());
    match spelling::recognise(fields, known.clone().map(|name| (name, name))) {
        Spelled::As { what, words, .. } => Ok((words, Value::Text(what.to_string()))),
        Spelled::Several(names) => {
            let ours = |name: &str| choices.iter().any(|choice| choice.ours && choice.name == name);
            match names.iter().filter(|name| !ours(name)).collect::<Vec<_>>()[..] {
                [pronto] => Ok((spelling::word_count(pronto), Value::Text(pronto.clone()))),
                _ => Err(Wrong::hint(format!("this may stand for {}", spelling::either(&names)))),
            }
        }
        Spelled::Nothing => {
            let elsewhere = choices.iter().find(|c| spelling::agreement(fields, &c.name).is_some());
            if let Some(elsewhere) = elsewhere {
                return Err(Wrong::hint(elsewhere.meaning.as_str()));
            }
            let (hint, used) = spelling::nearest_start(fields, known)
                .map_or((String::new(), 1), |(name, words)| (format!("did you mean {name}?"), words));
            Err(Wrong { used, ..Wrong::hint(hint) })
        }
    }
}

fn words(fields: &[Field]) -> Result<(usize, Value), Wrong> {
    let words: Vec<&str> = fields.iter().take_while(|f| f.is_word()).map(|f| f.text.as_str()).collect();
    if words.is_empty() { Err(Wrong::hint("")) } else { Ok((words.len(), Value::Text(words.join(" ")))) }
}

/// What the writer of a word may have meant where a number was expected.
fn number_hint(text: &str) -> String {
    let parses = |text: &str| number::parse(text).is_some();
    let ascii = text.replace(['\u{2212}', '\u{2013}', '\u{2014}'], "-");
    let digits = text.replace('O', "0").replace(['I', 'L'], "1");
    let without_unit = text.trim_end_matches(|c: char| !c.is_ascii_digit() && c != '.');
    if text.ends_with('}') {
        "this brace has no { before it".into()
    } else if ascii != text && parses(&ascii) {
        format!("this minus sign is a typeset dash: write {ascii}")
    } else if digits != text && parses(&digits) {
        format!("the letter O is not a zero, nor I or L a one: did you mean {digits}?")
    } else if ["INF", "+INF", "-INF", "INFINITY", "NAN"].contains(&text) {
        "every number must be finite".into()
    } else if without_unit != text && parses(without_unit) {
        format!("numbers carry no units: did you mean {without_unit}?")
    } else {
        String::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hints_name_what_was_meant() {
        assert!(number_hint("1.OE-5").ends_with("did you mean 1.0E-5?"));
        assert!(number_hint("300.MPA").ends_with("did you mean 300.?"));
        assert!(number_hint("\u{2212}9.81").ends_with("write -9.81"));
        assert_eq!(number_hint("FAST"), "");
    }
}
