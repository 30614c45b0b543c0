//! How words are recognised: exactly, by an abbreviation, or nearly.

use super::lexer::Field;

/// Shortest abbreviation of a word.
const SHORTEST: usize = 3;

/// How words of a deck agree with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Agreement {
    /// Each word is a beginning of the name's word, of at least three letters.
    Abbreviated,
    /// Letter by letter.
    Exact,
}

/// Whether the first fields spell `name`, whose words are separated by single blanks.
pub fn agreement(fields: &[Field], name: &str) -> Option<Agreement> {
    let mut agreement = Agreement::Exact;
    let mut fields = fields.iter();
    for word in name.split(' ') {
        let field = fields.next().filter(|f| f.is_word())?;
        if field.text != word {
            if field.text.len() < SHORTEST || !word.starts_with(&field.text) {
                return None;
            }
            agreement = Agreement::Abbreviated;
        }
    }
    Some(agreement)
}

/// Number of words in a name.
pub fn word_count(name: &str) -> usize {
    name.split(' ').count()
}

/// What the fields at the start of a list spell among several names.
pub enum Spelled<T> {
    /// One of them, in so many fields.
    As {
        /// Which one.
        what: T,
        /// The spelling it agrees with.
        name: String,
        /// How many fields that took.
        words: usize,
        /// How well.
        agreement: Agreement,
    },
    /// Abbreviations of more than one.
    Several(Vec<String>),
    /// None.
    Nothing,
}

/// Recognises one of the `(spelling, meaning)` pairs: more words win over fewer, then exact over abbreviated.
pub fn recognise<'n, T: PartialEq + Copy>(fields: &[Field], names: impl Iterator<Item = (&'n str, T)>) -> Spelled<T> {
    let mut best: Vec<(usize, Agreement, &str, T)> = Vec::new();
    for (name, what) in names {
        let Some(agreement) = agreement(fields, name) else { continue };
        let rank = (word_count(name), agreement);
        match best.first().map(|b| rank.cmp(&(b.0, b.1))) {
            Some(std::cmp::Ordering::Less) => continue,
            Some(std::cmp::Ordering::Greater) => best.clear(),
            _ => (),
        }
        if best.iter().all(|b| b.3 != what) {
            best.push((rank.0, agreement, name, what));
        }
    }
    match best[..] {
        [] => Spelled::Nothing,
        [(words, agreement, name, what)] => Spelled::As { what, name: name.to_string(), words, agreement },
        _ => Spelled::Several(best.iter().map(|b| b.2.to_string()).collect()),
    }
}

/// As [`recognise`], for names that all the fields must spell together.
pub fn recognise_all<'n, T: PartialEq + Copy>(
    fields: &[Field],
    names: impl Iterator<Item = (&'n str, T)>,
) -> Spelled<T> {
    recognise(fields, names.filter(|(name, _)| word_count(name) == fields.len()))
}

/// The name nearest to a misspelt text, if one is near: at most one letter in three wrong. Blanks count for nothing.
pub fn nearest<'n>(text: &str, names: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    let misfits = names.into_iter().filter_map(|name| Some((misfit(text, name)?, name)));
    misfits.min_by_key(|&(misfit, _)| misfit).map(|(_, name)| name)
}

/// The name nearest to the words that a record starts with, and how many fields those are.
pub fn nearest_start<'n>(fields: &[Field], names: impl Iterator<Item = &'n str>) -> Option<(&'n str, usize)> {
    let words: Vec<&str> = fields.iter().take_while(|f| f.is_word()).map(|f| f.text.as_str()).collect();
    let nearest_in = |name: &'n str| {
        let counts = [word_count(name), 1].into_iter().filter(|&count| count <= words.len());
        counts.filter_map(|count| Some((misfit(&words[..count].join(" "), name)?, name, count))).min()
    };
    names.filter_map(nearest_in).min_by_key(|&(misfit, _, count)| (misfit, count)).map(|(_, name, count)| (name, count))
}

/// How far a text is from a name, in letters per thousand; `None` if it is too far to be meant.
fn misfit(text: &str, name: &str) -> Option<usize> {
    let squeeze = |text: &str| text.chars().filter(|c| !" -_.".contains(*c)).collect::<String>();
    let (text, name) = (squeeze(&text.to_uppercase()), squeeze(name));
    // Comparing is quadratic in the lengths, and a long line of rubbish is near to nothing.
    if text.len() > 2 * name.len() + SHORTEST {
        return None;
    }
    let distance = strsim::damerau_levenshtein(&text, &name);
    (distance < name.len() && 3 * distance <= name.len().max(SHORTEST)).then_some(1000 * distance / name.len().max(1))
}

/// The words of some fields as a message shows them.
pub fn shown(fields: &[Field]) -> String {
    cut(&fields.iter().map(|f| f.text.as_str()).collect::<Vec<_>>().join(" "))
}

/// A text as a message shows it, cut where it becomes too long to read.
pub fn cut(text: &str) -> String {
    /// Letters shown at most.
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_string(),
    }
}

/// `A`, `A or B`, `A, B or C`.
pub fn either<S: AsRef<str>>(names: &[S]) -> String {
    enumerate(names, "or")
}

/// `A`, `A and B`, `A, B and C`.
pub fn all<S: AsRef<str>>(names: &[S]) -> String {
    enumerate(names, "and")
}

fn enumerate<S: AsRef<str>>(names: &[S], conjunction: &str) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    match names[..] {
        [] => String::new(),
        [one] => one.to_string(),
        [ref most @ .., last] => format!("{} {conjunction} {last}", most.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::{text::lexer::Lexer, text::source::Source};

    const NAMES: [&str; 6] = ["PLOT TIME", "PLOT NODAL", "PRESSURE", "PRESCRIBED FORCE", "MATERIAL", "MATERIAL POINT"];

    fn spell(text: &str) -> Option<(String, Agreement)> {
        let source = Source::new("t", text);
        let record = Lexer::new(&source).next_record()?;
        match recognise(&record.fields, NAMES.iter().map(|&n| (n, n))) {
            Spelled::As { name, agreement, .. } => Some((name, agreement)),
            _ => None,
        }
    }

    #[test]
    fn abbreviations_need_three_letters_of_every_word() {
        assert_eq!(spell("PLOT TIME 1"), Some(("PLOT TIME".into(), Agreement::Exact)));
        assert_eq!(spell("plo tim 1"), Some(("PLOT TIME".into(), Agreement::Abbreviated)));
        assert_eq!(spell("PL TIME 1"), None);
        assert_eq!(spell("PLOT 1"), None);
        assert_eq!(spell("PRES FOR X"), Some(("PRESCRIBED FORCE".into(), Agreement::Abbreviated)));
        assert_eq!(spell("MATERIAL 1"), Some(("MATERIAL".into(), Agreement::Exact)));
        assert_eq!(spell("MAT POI 1"), Some(("MATERIAL POINT".into(), Agreement::Abbreviated)));
    }

    #[test]
    fn the_nearest_name() {
        assert_eq!(nearest("PRESURE", NAMES), Some("PRESSURE"));
        assert_eq!(nearest("PLOTTIME", NAMES), Some("PLOT TIME"));
        assert_eq!(nearest("ZZZ", NAMES), None);
    }
}
