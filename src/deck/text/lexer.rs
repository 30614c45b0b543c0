//! The SUPES free-field reader: text → records of fields, each field with its place in the text.
//!
//! A record is a line, joined with the next one where it ends in `*`. Fields are separated by a comma, an equal
//! sign or blanks; two separators in a row hold a null field between them. `$` starts a comment. A field that
//! starts with `'` runs to the closing quote. Letters outside quotes are folded to upper case.

use nom::{
    IResult, Parser,
    branch::alt,
    bytes::complete::{take_till, take_till1, take_while},
    character::complete::{char, one_of},
    combinator::{map, rest, value},
    multi::many0,
    sequence::preceded,
};

use crate::deck::{
    text::number::{self, Number},
    text::source::{Source, Span},
};

/// One field of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// The text, upper case unless quoted; empty for a null field.
    pub text: String,
    /// What the text is.
    pub kind: FieldKind,
    /// Where it stands; for a null field, the separator that ends it.
    pub span: Span,
}

/// What a field's text is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FieldKind {
    /// Nothing between two separators: "take the default".
    Null,
    /// Characters.
    Word,
    /// Characters in quotes, taken as they are; `closed` tells whether the second quote was found.
    Quoted {
        /// Whether the second quote was found on the line.
        closed: bool,
    },
    /// A number.
    Number(Number),
}

impl Field {
    /// A word that stands somewhere.
    pub fn word(text: &str, span: Span) -> Field {
        Field { text: text.to_string(), kind: FieldKind::Word, span }
    }

    /// Whether the field is an unquoted word.
    pub fn is_word(&self) -> bool {
        self.kind == FieldKind::Word
    }

    /// The number, if the field is one.
    pub fn number(&self) -> Option<Number> {
        if let FieldKind::Number(number) = self.kind { Some(number) } else { None }
    }
}

/// One logical line: at least one field.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The fields in order.
    pub fields: Vec<Field>,
}

impl Record {
    /// From the first field to the last.
    pub fn span(&self) -> Span {
        let spans = self.fields.iter().map(|f| f.span);
        spans.reduce(Span::join).unwrap_or_default()
    }
}

/// Reads a source record by record.
#[derive(Clone)]
pub struct Lexer<'s> {
    source: &'s Source,
    line: usize,
    /// A `*` on the last line, which continues into nothing.
    pub dangling_continuation: Option<Span>,
}

impl<'s> Lexer<'s> {
    /// Starts at the first line.
    pub fn new(source: &'s Source) -> Lexer<'s> {
        Lexer { source, line: 0, dangling_continuation: None }
    }

    /// The next record that has a field; `None` at the end of the text.
    pub fn next_record(&mut self) -> Option<Record> {
        while self.line < self.source.line_count() {
            let fields = self.logical_line();
            if !fields.is_empty() {
                return Some(Record { fields });
            }
        }
        None
    }

    /// The next physical line as it stands, as after TITLE.
    pub fn next_line(&mut self) -> Option<Span> {
        (self.line < self.source.line_count()).then(|| {
            self.line += 1;
            self.source.line_span(self.line - 1)
        })
    }

    /// Fields of this line and of those it continues into.
    fn logical_line(&mut self) -> Vec<Field> {
        let mut fields = Vec::new();
        while let Some(span) = self.next_line() {
            let Some(star) = line_fields(self.source.slice(span), span.start, &mut fields) else { break };
            if self.line >= self.source.line_count() {
                self.dangling_continuation = Some(star);
            }
        }
        fields
    }
}

#[derive(Debug, Clone, Copy)]
enum Token<'a> {
    Separator,
    Quoted { inner: &'a str, closed: bool },
    Bare(&'a str),
    Comment,
    Continuation,
}

/// Appends the fields of one physical line that starts at byte `offset`; returns the place of a `*` if it continues.
fn line_fields(line: &str, offset: usize, fields: &mut Vec<Field>) -> Option<Span> {
    let (_, tokens) = many0(preceded(blanks, spanned_token)).parse_complete(line).unwrap_or((line, Vec::new()));
    let mut awaiting_field = true;
    for (token, text) in tokens {
        let start = offset + (text.as_ptr() as usize - line.as_ptr() as usize);
        let span = Span { start, end: start + text.len() };
        match token {
            Token::Comment => return None,
            Token::Continuation => return Some(Span { start, end: start + 1 }),
            Token::Separator => {
                if awaiting_field {
                    fields.push(Field { text: String::new(), kind: FieldKind::Null, span });
                }
                awaiting_field = true;
            }
            Token::Quoted { inner, closed } => {
                fields.push(Field { text: inner.replace("''", "'"), kind: FieldKind::Quoted { closed }, span });
                awaiting_field = false;
            }
            Token::Bare(text) => {
                fields.push(bare_field(text, span));
                awaiting_field = false;
            }
        }
    }
    None
}

fn bare_field(text: &str, span: Span) -> Field {
    let kind = number::parse(text).map_or(FieldKind::Word, FieldKind::Number);
    Field { text: without_apostrophes(text.to_uppercase()), kind, span }
}

/// YOUNG'S is YOUNGS, with whichever apostrophe.
fn without_apostrophes(word: String) -> String {
    let is_apostrophe = |c: char| matches!(c, '\'' | '\u{2019}');
    if !word.starts_with(char::is_alphabetic) || !word.contains(is_apostrophe) {
        return word;
    }
    word.replace(is_apostrophe, "")
}

/// Blank space, control characters, and the byte order mark that some editors leave at the start of a file.
fn is_blank(c: char) -> bool {
    c.is_whitespace() || c.is_control() || c == '\u{feff}'
}

fn blanks(input: &str) -> IResult<&str, &str> {
    take_while(is_blank).parse_complete(input)
}

/// A token together with the text it was read from.
fn spanned_token(input: &str) -> IResult<&str, (Token<'_>, &str)> {
    let (left, token) = token(input)?;
    Ok((left, (token, &input[..input.len() - left.len()])))
}

fn token(input: &str) -> IResult<&str, Token<'_>> {
    alt((
        value(Token::Comment, preceded(char('$'), rest)),
        value(Token::Continuation, preceded(char('*'), rest)),
        value(Token::Separator, one_of(",=")),
        quoted,
        map(take_till1(|c| is_blank(c) || ",=$*".contains(c)), Token::Bare),
    ))
    .parse_complete(input)
}

/// `'…'` with `''` for a quote inside; without a closing quote, all the rest of the line.
fn quoted(input: &str) -> IResult<&str, Token<'_>> {
    let (body, _) = char('\'').parse_complete(input)?;
    let mut end = 0;
    loop {
        let (left, _) = take_till(|c| c == '\'').parse_complete(&body[end..])?;
        end = body.len() - left.len();
        if left.is_empty() {
            return Ok((left, Token::Quoted { inner: body, closed: false }));
        }
        if !left[1..].starts_with('\'') {
            return Ok((&left[1..], Token::Quoted { inner: &body[..end], closed: true }));
        }
        end += 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Records of a text: fields as text, `~` for a null field, quotes kept around quoted ones.
    fn records(text: &str) -> Vec<Vec<String>> {
        let source = Source::new("t.i", text);
        let mut lexer = Lexer::new(&source);
        let show = |f: &Field| match f.kind {
            FieldKind::Null => "~".into(),
            FieldKind::Quoted { .. } => format!("'{}'", f.text),
            _ => f.text.clone(),
        };
        std::iter::from_fn(|| lexer.next_record()).map(|r| r.fields.iter().map(show).collect()).collect()
    }

    fn one(text: &str) -> Vec<String> {
        records(text).into_iter().next().unwrap_or_default()
    }

    #[test]
    fn comma_equal_sign_and_blanks_separate() {
        for text in ["A=5", "A = 5", "A, 5", "A 5", "A\t5", "  a ,5  "] {
            assert_eq!(one(text), ["A", "5"], "{text}");
        }
    }

    #[test]
    fn null_fields_need_explicit_separators() {
        assert_eq!(one("10,,"), ["10", "~"]);
        assert_eq!(one("10,"), ["10"]);
        assert_eq!(one(",10"), ["~", "10"]);
        assert_eq!(one("A,,,B"), ["A", "~", "~", "B"]);
        assert_eq!(one("A = , B"), ["A", "~", "B"]);
    }

    #[test]
    fn comments_and_continuation_the_first_of_them_wins() {
        assert_eq!(records("$ all\n\n  \nA 1 $ B * 2\nC"), [vec!["A", "1"], vec!["C"]]);
        assert_eq!(records("A 5* $ rest is dropped\n6 B\nC"), [vec!["A", "5", "6", "B"], vec!["C"]]);
        assert_eq!(records("A, *\n, B"), [vec!["A", "~", "B"]]);
        assert_eq!(records("A *"), [vec!["A"]]);
    }

    #[test]
    fn quotes_keep_everything() {
        assert_eq!(one("'a,$*b' c"), ["'a,$*b'", "C"]);
        assert_eq!(one("'it''s'"), ["'it's'"]);
        assert_eq!(one("x 'open to the end $"), ["X", "'open to the end $'"]);
        // As in YOUNG'S MODULUS.
        assert_eq!(one("MOM'S"), ["MOMS"]);
        assert_eq!(one("''"), ["''"]);
    }

    #[test]
    fn ordinary_characters_and_foreign_blanks() {
        assert_eq!(one("(a/b):c;d"), ["(A/B):C;D"]);
        assert_eq!(one("\u{feff}title\u{a0}x\u{1}y"), ["TITLE", "X", "Y"]);
    }

    #[test]
    fn spans_are_the_bytes_of_the_field() {
        let source = Source::new("t.i", "$ µ\n NO displ,, 'x y' 1.D-3 *\r\n 7\n");
        let record = Lexer::new(&source).next_record().expect("one record");
        let texts: Vec<_> = record.fields.iter().map(|f| source.slice(f.span)).collect();
        assert_eq!(texts, ["NO", "displ", ",", "'x y'", "1.D-3", "7"]);
        assert_eq!(source.position(record.fields[5].span.start), (3, 2));
    }
}
