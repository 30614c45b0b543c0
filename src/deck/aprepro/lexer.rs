//! What stands in one pair of braces → tokens, each with its place.

use super::Fault;
use crate::deck::text::source::Span;

/// A token and its place in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Token {
    pub what: What,
    pub span: Span,
}

/// What a token is.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum What {
    Number(f64),
    Text(String),
    Name(String),
    /// An operator, bracket or comma.
    Sign(&'static str),
    /// Nothing more.
    End,
}

/// Signs, the longer of those that begin alike first.
const SIGNS: [&str; 35] = [
    "**=", "**", "*=", "+=", "-=", "/=", "^=", "++", "--", "==", "!=", "<=", ">=", "&&", "||", "//", "=", "+", "-",
    "*", "/", "%", "^", "~", "<", ">", "!", "?", ":", "(", ")", ",", "[", "]", ";",
];

/// Tokens of an expression at most: what is longer was not written by hand, and would fill the memory.
const MOST_TOKENS: usize = 1_000_000;

/// The tokens of `text`, which starts at byte `offset` of its file; the last one is [`What::End`].
pub(super) fn tokens(text: &str, offset: usize) -> Result<Vec<Token>, Fault> {
    let mut tokens = Vec::new();
    let mut at = 0;
    // A colon belongs to a name, but `a ? b:c` is the choice of two names.
    let mut question = false;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let (what, length) = match first {
            _ if first.is_whitespace() => {
                at += first.len_utf8();
                continue;
            }
            '#' => break,
            '"' | '\'' => quoted(rest, first, offset + at)?,
            _ if first.is_ascii_digit() || (first == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit())) => {
                number(rest, offset + at)?
            }
            _ if first.is_ascii_alphabetic() || first == '_' => name(rest, !question),
            _ => sign(rest, offset + at)?,
        };
        question |= what == What::Sign("?");
        tokens.push(Token { what, span: Span { start: offset + at, end: offset + at + length } });
        if tokens.len() > MOST_TOKENS {
            let from = Span { start: offset, end: offset + text.chars().next().map_or(0, char::len_utf8) };
            return Err(Fault::at(from, "this expression is too long", "it starts here"));
        }
        at += length;
    }
    let end = offset + text.trim_end().len().min(text.len());
    tokens.push(Token { what: What::End, span: Span { start: end, end } });
    Ok(tokens)
}

fn quoted(rest: &str, quote: char, start: usize) -> Result<(What, usize), Fault> {
    match rest[1..].find(quote) {
        Some(length) => Ok((What::Text(rest[1..1 + length].to_string()), length + 2)),
        None => {
            let span = Span { start, end: start + rest.len() };
            Err(Fault::at(span, "this text in quotes is not closed", format!("no second {quote} in these braces")))
        }
    }
}

fn name(rest: &str, colons: bool) -> (What, usize) {
    let belongs = |(i, c): (usize, char)| {
        let inner_colon = c == ':' && colons && rest[i + 1..].starts_with(|c: char| c.is_ascii_alphanumeric());
        c.is_ascii_alphanumeric() || c == '_' || inner_colon
    };
    let length = rest.char_indices().find(|&place| !belongs(place)).map_or(rest.len(), |(i, _)| i);
    (What::Name(rest[..length].to_string()), length)
}

/// `5`, `5.`, `.5`, `1.2E-3`, and the D of FORTRAN for an exponent.
fn number(rest: &str, start: usize) -> Result<(What, usize), Fault> {
    let digits = |from: usize| rest[from..].bytes().take_while(u8::is_ascii_digit).count();
    let mut length = digits(0);
    if rest[length..].starts_with('.') {
        length += 1;
        length += digits(length);
    }
    if rest[length..].starts_with(['e', 'E', 'd', 'D']) {
        let sign = usize::from(rest[length + 1..].starts_with(['+', '-']));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    let tail = rest[length..].bytes().take_while(|b| b.is_ascii_alphanumeric() || *b == b'_' || *b == b'.').count();
    let span = Span { start, end: start + length + tail };
    if tail > 0 {
        let fault = Fault::at(span, format!("{} is neither a number nor a name", &rest[..length + tail]), "");
        return Err(fault.help(format!("a product needs a *: {}*{}", &rest[..length], &rest[length..length + tail])));
    }
    let value: f64 = rest[..length].replace(['d', 'D'], "e").parse().unwrap_or(f64::INFINITY);
    if value.is_infinite() {
        return Err(Fault::at(span, "this number is larger than 1.8E308, the largest there is", ""));
    }
    Ok((What::Number(value), length))
}

fn sign(rest: &str, start: usize) -> Result<(What, usize), Fault> {
    if let Some(sign) = SIGNS.iter().find(|sign| rest.starts_with(**sign)) {
        return Ok((What::Sign(sign), sign.len()));
    }
    let first = rest.chars().next().unwrap_or(' ');
    let span = Span { start, end: start + first.len_utf8() };
    let hint = match first {
        '&' => "and is written &&",
        '|' => "or is written ||",
        '\u{2212}' | '\u{2013}' | '\u{2014}' => "this minus sign is a typeset dash: write -",
        '$' => "a comment in an expression starts with #",
        _ => "",
    };
    Err(Fault::at(span, format!("{first} has no meaning in an expression"), "").help(hint))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whats(text: &str) -> Vec<What> {
        let tokens = tokens(text, 0).expect("tokens");
        tokens.into_iter().map(|t| t.what).filter(|w| *w != What::End).collect()
    }

    #[test]
    fn numbers_names_and_signs() {
        assert_eq!(whats("1.5D3"), [What::Number(1500.0)]);
        assert_eq!(whats(".5"), [What::Number(0.5)]);
        assert_eq!(whats("2**x"), [What::Number(2.0), What::Sign("**"), What::Name("x".into())]);
        assert_eq!(whats("a:b"), [What::Name("a:b".into())]);
        assert_eq!(whats("x?a:b")[2..], [What::Name("a".into()), What::Sign(":"), What::Name("b".into())]);
        assert_eq!(whats("'a\"' # b"), [What::Text("a\"".into())]);
        assert!(tokens("3x", 0).is_err() && tokens("1.2.3", 0).is_err() && tokens("1e999", 0).is_err());
    }
}
