//! A file → lines and blocks: which lines belong to a condition or a loop, and where braces stand in a line.

use crate::deck::{
    text::diagnostic::Diagnostic,
    text::source::{Source, Span},
};

/// A line, or a block of lines.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Node {
    /// What a line is made of, with its end of line.
    Line(Vec<Part>),
    /// `{if(e)}` to `{endif}`: the first arm that holds is taken.
    If(Vec<Arm>),
    /// `{loop(n, name, start, step)}` to `{endloop}`.
    Loop {
        /// What stands between the brackets.
        head: Span,
        /// The braces.
        place: Span,
        body: Vec<Node>,
    },
}

/// Lines under a condition.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Arm {
    pub condition: Condition,
    pub body: Vec<Node>,
}

/// When an arm is taken.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Condition {
    /// The expression holds.
    If(Span),
    /// The name has a value that is not zero; or has none, or zero.
    Defined { name: Span, wanted: bool },
    /// No arm before it was taken.
    Else,
}

/// A part of a line.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Part {
    /// Text as it stands.
    Text(Span),
    /// `{expression}`; a silent one, in two pairs of braces, prints nothing.
    Value { inner: Span, place: Span, silent: bool },
    /// `{include("file")}`; cinclude does not mind when the file is missing.
    Include { name: Span, place: Span, optional: bool },
    /// `{ECHO(ON)}`, `{ECHO(OFF)}`
    Echo(bool),
}

/// Mistakes of one file at most; then the rest of it is left alone.
const MOST_MISTAKES: usize = 100;
/// Blocks within each other at most.
const DEEPEST: usize = 50;

/// Divides a file. What does not fit together is reported; then the nodes are not all there.
/// The last list are warnings.
pub(super) fn parse(source: &Source) -> (Vec<Node>, Vec<Diagnostic>, Vec<Diagnostic>) {
    let mut parser = Parser { source, line: 0, wrong: Vec::new(), unread: Vec::new(), depth: 0, given_up: false };
    let mut nodes = Vec::new();
    loop {
        nodes.extend(parser.body());
        // A word that closes or divides a block which is not open.
        let Some(stray) = parser.next_word() else { break };
        let opener = if stray.word == "ENDLOOP" { "{loop(n)}" } else { "{if(condition)}" };
        let message = format!("{} has no {opener} before it", parser.source.slice(stray.place));
        parser.wrong.push(Diagnostic::error(message).at(stray.place, "no block is open here"));
        parser.line += 1;
        if parser.wrong.len() >= MOST_MISTAKES {
            break;
        }
    }
    (nodes, parser.wrong, unread_texts(source, parser.unread))
}

/// Warnings of texts behind governing words, each once.
fn unread_texts(source: &Source, mut places: Vec<(Span, Span)>) -> Vec<Diagnostic> {
    places.sort_unstable();
    places.dedup();
    let warning = |(word, text): (Span, Span)| {
        let word = source.slice(word);
        Diagnostic::warning(format!("what stands on one line with {word} is not read"))
            .at(text, "this is left out, and nothing in it is evaluated")
            .help(format!("{word} governs the lines below it; put this on a line of its own"))
    };
    places.into_iter().map(warning).collect()
}

struct Parser<'s> {
    source: &'s Source,
    line: usize,
    wrong: Vec<Diagnostic>,
    /// Governing words in comments, and what stands behind them on their lines.
    unread: Vec<(Span, Span)>,
    depth: usize,
    /// Whether the rest is left alone: one message is enough, as what is left would only be misunderstood.
    given_up: bool,
}

/// A word in braces that governs lines.
struct Word {
    /// In capital letters.
    word: String,
    /// The braces.
    place: Span,
    /// What stands between the brackets after it.
    head: Option<Span>,
}

/// Words that govern lines and stand alone on theirs.
const OF_LINES: [&str; 8] = ["IF", "IFDEF", "IFNDEF", "ELSEIF", "ELSE", "ENDIF", "LOOP", "ENDLOOP"];

impl Parser<'_> {
    /// Lines and blocks up to a word that closes or divides the block they are in, or to the end.
    fn body(&mut self) -> Vec<Node> {
        let mut nodes = Vec::new();
        while self.line < self.source.line_count() {
            let parts = self.parts();
            if self.wrong.len() >= MOST_MISTAKES {
                self.give_up::<()>();
                break;
            }
            let Some(word) = self.governing(&parts) else {
                if self.given_up {
                    break;
                }
                self.line += 1;
                nodes.extend(self.line_of(parts));
                continue;
            };
            match word.word.as_str() {
                "IF" | "IFDEF" | "IFNDEF" => nodes.extend(self.conditional(word)),
                "LOOP" => nodes.extend(self.repeated(word)),
                _ => break,
            }
        }
        nodes
    }

    /// A line without a governing word; lines between VERBATIM(ON) and VERBATIM(OFF) are taken as they stand.
    fn line_of(&mut self, parts: Vec<Part>) -> Vec<Node> {
        let verbatim = parts.iter().find_map(|part| match part {
            Part::Value { inner, place, .. } if switch(self.source.slice(*inner), "VERBATIM") == Some(true) => {
                Some(*place)
            }
            _ => None,
        });
        let Some(place) = verbatim else { return vec![Node::Line(parts)] };
        let mut nodes = Vec::new();
        while self.line < self.source.line_count() {
            let line = self.whole_line();
            self.line += 1;
            let text = self.source.slice(line);
            let inner = text.find('{').and_then(|open| Some((open, text[open..].find('}')? + open)));
            if inner.is_some_and(|(open, close)| switch(&text[open + 1..close], "VERBATIM") == Some(false)) {
                return nodes;
            }
            nodes.push(Node::Line(vec![Part::Text(line)]));
        }
        self.wrong
            .push(Diagnostic::error("VERBATIM(ON) is not ended").at(place, "no {VERBATIM(OFF)} follows in this file"));
        nodes
    }

    fn conditional(&mut self, first: Word) -> Option<Node> {
        let (opened, mut word) = (first.place, first);
        let mut arms: Vec<Arm> = Vec::new();
        self.enter(opened)?;
        loop {
            let condition = self.condition(&word);
            if matches!(arms.last(), Some(Arm { condition: Condition::Else, .. })) {
                self.wrong.push(
                    Diagnostic::error(format!("{} after {{else}}", self.source.slice(word.place)))
                        .at(word.place, "{else} is the last part of a block")
                        .at(opened, "the block starts here"),
                );
            }
            self.line += 1;
            let body = self.body();
            arms.push(Arm { condition, body });
            match self.next_word() {
                Some(next) if ["ELSEIF", "ELSE"].contains(&next.word.as_str()) => word = next,
                Some(next) if next.word == "ENDIF" => {
                    self.line += 1;
                    self.depth -= 1;
                    return Some(Node::If(arms));
                }
                _ => return self.unclosed(opened, "{endif}"),
            }
        }
    }

    fn condition(&mut self, word: &Word) -> Condition {
        let wants_head = word.word != "ELSE";
        match word.head {
            Some(head) if wants_head => match word.word.as_str() {
                "IFDEF" => Condition::Defined { name: head, wanted: true },
                "IFNDEF" => Condition::Defined { name: head, wanted: false },
                _ => Condition::If(head),
            },
            Some(head) => {
                self.wrong.push(
                    Diagnostic::error("{else} takes no condition")
                        .at(head, "")
                        .help("a further condition is an {elseif(...)}"),
                );
                Condition::Else
            }
            None if wants_head => {
                let message = format!("{} lacks its condition", self.source.slice(word.place));
                let form = format!("for example: {{{}(n > 2)}}", word.word.to_lowercase());
                self.wrong.push(Diagnostic::error(message).at(word.place, "").help(form));
                Condition::Else
            }
            None => Condition::Else,
        }
    }

    fn repeated(&mut self, word: Word) -> Option<Node> {
        self.enter(word.place)?;
        let Some(head) = word.head else {
            self.wrong.push(
                Diagnostic::error("a loop needs the number of its passes")
                    .at(word.place, "")
                    .help("for example: {loop(10)}"),
            );
            self.line += 1;
            return None;
        };
        self.line += 1;
        let body = self.body();
        match self.next_word() {
            Some(next) if next.word == "ENDLOOP" => {
                self.line += 1;
                self.depth -= 1;
                Some(Node::Loop { head, place: word.place, body })
            }
            _ => self.unclosed(word.place, "{endloop}"),
        }
    }

    /// Goes one block deeper; too deep, the rest of the file is given up.
    fn enter(&mut self, place: Span) -> Option<()> {
        self.depth += 1;
        if self.depth <= DEEPEST {
            return Some(());
        }
        self.wrong.push(Diagnostic::error("blocks are nested too deep").at(place, ""));
        self.give_up()
    }

    fn give_up<T>(&mut self) -> Option<T> {
        self.given_up = true;
        self.line = self.source.line_count();
        None
    }

    fn unclosed(&mut self, opened: Span, closer: &str) -> Option<Node> {
        if self.given_up {
            return None;
        }
        let shown = self.source.slice(opened).to_string();
        let mut diagnostic =
            Diagnostic::error(format!("{shown} is not closed")).at(opened, format!("expected {closer} further down"));
        if let Some(other) = self.next_word() {
            diagnostic = diagnostic.at(other.place, "this belongs to another block");
        }
        self.wrong.push(diagnostic);
        self.give_up()
    }

    /// The governing word of the present line, reported already where it was wrong.
    fn next_word(&mut self) -> Option<Word> {
        if self.line >= self.source.line_count() {
            return None;
        }
        let before = self.wrong.len();
        let parts = self.parts();
        let word = self.governing(&parts);
        self.wrong.truncate(before);
        word
    }

    /// The word in braces that governs this line and those below, if there is one.
    fn governing(&mut self, parts: &[Part]) -> Option<Word> {
        let word = parts.iter().find_map(|part| match part {
            Part::Value { inner, place, silent: false } => word(self.source, *inner, *place),
            _ => None,
        })?;
        let line = self.source.slice(self.whole_line()).to_string();
        let (start, end) = (word.place.start - self.whole_line().start, word.place.end - self.whole_line().start);
        let (before, after) = (line[..start].trim(), line[end..].trim());
        let alone = (before.is_empty() || before.starts_with('$')) && (after.is_empty() || after.starts_with('$'));
        if !alone && !before.starts_with('$') {
            self.wrong.push(
                Diagnostic::error(format!("{} stands alone on its line", self.source.slice(word.place)))
                    .at(word.place, "it governs whole lines")
                    .help("a value within a line is chosen by {condition ? value : value}"),
            );
            return self.give_up();
        }
        // A remark is meant for nobody, but braces want to be evaluated.
        if !alone && after.contains('{') {
            let end = self.whole_line().start + line.trim_end().len();
            self.unread.push((word.place, Span { start: end - after.len(), end }));
        }
        Some(word)
    }

    /// The present line with its end of line.
    fn whole_line(&self) -> Span {
        let start = self.source.line_span(self.line).start;
        Span { start, end: self.source.line_span(self.line + 1).start }
    }

    /// The parts of the present line.
    fn parts(&mut self) -> Vec<Part> {
        let line = self.whole_line();
        let text = self.source.slice(line);
        let mut parts = Vec::new();
        let (mut from, mut at) = (0, 0);
        let place = |start: usize, end: usize| Span { start: line.start + start, end: line.start + end };
        while let Some(found) = text[at..].find(['{', '\\']) {
            let open = at + found;
            if text[open..].starts_with('\\') {
                // \{ and \} stand for the braces themselves.
                let escape = text[open + 1..].starts_with(['{', '}']);
                if escape {
                    parts.push(Part::Text(place(from, open)));
                    from = open + 1;
                }
                at = open + 1 + usize::from(escape);
                continue;
            }
            parts.push(Part::Text(place(from, open)));
            let Some((inner, end, silent)) = braces(text, open) else {
                let rest = place(open, text.trim_end().len().max(open + 1));
                self.wrong.push(
                    Diagnostic::error("this brace is not closed on its line")
                        .at(rest, "expected }")
                        .help("a brace that is meant as it stands is written \\{"),
                );
                return parts;
            };
            parts.push(self.part(place(inner.0, inner.1), place(open, end), silent));
            (from, at) = (end, end);
        }
        parts.push(Part::Text(place(from, text.len())));
        parts.retain(|part| !matches!(part, Part::Text(span) if span.start == span.end));
        parts
    }

    fn part(&self, inner: Span, place: Span, silent: bool) -> Part {
        let text = self.source.slice(inner);
        if let Some(on) = switch(text, "ECHO") {
            return Part::Echo(on);
        }
        for (word, optional) in [("INCLUDE", false), ("CINCLUDE", true)] {
            if let Some(name) = head(text, word) {
                let name = Span { start: inner.start + name.start, end: inner.start + name.end };
                return Part::Include { name, place, optional };
            }
        }
        Part::Value { inner, place, silent }
    }
}

/// What stands in the braces that open at a byte, where they end, and whether there are two pairs; quotes may hold braces.
fn braces(text: &str, open: usize) -> Option<((usize, usize), usize, bool)> {
    let double = text[open + 1..].starts_with('{');
    let inner = open + 1 + usize::from(double);
    let mut quote = None;
    for (i, c) in text[inner..].char_indices() {
        match (quote, c) {
            (Some(open), c) if open == c => quote = None,
            (None, '"' | '\'') => quote = Some(c),
            (None, '}') => {
                let at = inner + i;
                return if !double {
                    Some(((inner, at), at + 1, false))
                } else if text[at + 1..].starts_with('}') {
                    Some(((inner, at), at + 2, true))
                } else {
                    None
                };
            }
            (None, '{') => return None,
            _ => {}
        }
    }
    // A quote that is not closed hides the brace: the expression says so better.
    let close = text[inner..].find('}').map(|i| inner + i).filter(|_| quote.is_some() && !double)?;
    Some(((inner, close), close + 1, false))
}

/// The place between the brackets of `WORD(...)`, in any letters.
fn head(text: &str, word: &str) -> Option<Span> {
    let start = text.len() - text.trim_start().len();
    let found = text.get(start..start + word.len()).filter(|found| found.eq_ignore_ascii_case(word))?;
    let rest = &text[start + found.len()..];
    let open = rest.len() - rest.trim_start().len();
    let body = rest.trim_end().strip_suffix(')')?;
    let from = start + found.len() + open + 1;
    (body.get(open..)?.starts_with('('))
        .then(|| Span { start: from, end: (start + found.len() + body.len()).max(from) })
}

/// What `WORD(ON)` or `WORD(OFF)` says; `WORD` alone is ON.
fn switch(text: &str, word: &str) -> Option<bool> {
    if text.trim().eq_ignore_ascii_case(word) {
        return Some(true);
    }
    let state = &text[head(text, word).map(|span| span.start..span.end)?];
    match state.trim().to_uppercase().as_str() {
        "ON" => Some(true),
        "OFF" => Some(false),
        _ => None,
    }
}

fn word(source: &Source, inner: Span, place: Span) -> Option<Word> {
    let text = source.slice(inner);
    let letters: String = text.trim_start().chars().take_while(char::is_ascii_alphabetic).collect();
    let upper = letters.to_uppercase();
    if !OF_LINES.contains(&upper.as_str()) {
        return None;
    }
    let head = head(text, &upper).map(|s| Span { start: inner.start + s.start, end: inner.start + s.end });
    let alone = text.trim().len() == letters.len();
    (head.is_some() || alone).then_some(Word { word: upper, place, head })
}
