//! Works through the lines and blocks of a deck and of what it includes, and writes the evaluated text.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{
    Evaluated, Fault, Value,
    blocks::{self, Arm, Condition, Node, Part},
    eval::Names,
    expr::{self, Kind},
    include, lexer,
};
use crate::deck::{
    text::diagnostic::Diagnostic,
    text::origin::{File, How, Origin, Piece},
    text::source::{Source, Span},
    text::spelling,
};

/// Lines that all passes of all loops work through at most: the loops of a slip of the finger end too.
const MOST_LINES: usize = 2_000_000;
/// Bytes of evaluated text at most.
const MOST_BYTES: usize = 256 << 20;
/// Files within each other at most.
const DEEPEST_FILES: usize = 20;
/// Files included at most.
const MOST_FILES: usize = 10_000;
/// Mistakes reported at most; a loop repeats them.
const MOST_MISTAKES: usize = 200;
/// What stands in the place of a value that could not be found.
const STAND_IN: &str = "1";

/// Evaluates a deck.
pub(super) fn run(deck: Source) -> Evaluated {
    let name = deck.name().to_string();
    let identity = Path::new(&name).canonicalize().unwrap_or_else(|_| PathBuf::from(&name));
    let mut names = Names::new();
    deck.names().iter().for_each(|(name, value)| names.set(name, Value::Number(f64::from(*value))));
    if let Some(given) = deck.definitions() {
        names.give(given);
    }
    let mut run = Run {
        names,
        text: String::new(),
        origin: Origin { files: vec![File { source: deck, included_at: None }], pieces: Vec::new() },
        open: vec![identity],
        found: Vec::new(),
        echo: true,
        lines: 0,
        told_of_e: false,
        over: false,
    };
    run.file(0);
    let Run { text, origin, found, over, .. } = run;
    let length = text.len();
    let moved = |(file, diagnostic): (usize, Diagnostic)| move_labels(diagnostic, origin.base(length, file));
    let found = found.into_iter().map(moved).collect();
    Evaluated { source: Source::evaluated(&name, text, origin), found, readable: !over }
}

fn move_labels(mut diagnostic: Diagnostic, by: usize) -> Diagnostic {
    for label in &mut diagnostic.labels {
        label.span = Span { start: label.span.start + by, end: label.span.end + by };
    }
    diagnostic
}

struct Run {
    names: Names,
    /// The evaluated text, and where it came from.
    text: String,
    origin: Origin,
    /// Files that are being worked through, the deck first.
    open: Vec<PathBuf>,
    /// Messages, each with the file that its places are in.
    found: Vec<(usize, Diagnostic)>,
    /// Whether text is written at all.
    echo: bool,
    lines: usize,
    told_of_e: bool,
    /// Whether the rest cannot be made sense of.
    over: bool,
}

impl Run {
    fn file(&mut self, file: usize) {
        let source = Arc::new(self.origin.files[file].source.clone());
        let (nodes, wrong, unread) = blocks::parse(&source);
        unread.into_iter().for_each(|warning| self.report(file, warning));
        if !wrong.is_empty() {
            self.over = true;
            return wrong.into_iter().for_each(|diagnostic| self.report(file, diagnostic));
        }
        self.nodes(&Place { file, source }, &nodes);
    }

    fn nodes(&mut self, place: &Place, nodes: &[Node]) {
        for node in nodes {
            if self.over {
                return;
            }
            match node {
                Node::Line(parts) => self.line(place, parts),
                Node::If(arms) => self.conditional(place, arms),
                Node::Loop { head, place: braces, body } => self.repeat(place, *head, *braces, body),
            }
        }
    }

    fn line(&mut self, place: &Place, parts: &[Part]) {
        let span = parts.first().map_or(Span::default(), Part::span);
        let line = place.source.slice(span).trim_end().len();
        self.spend(place, Span { end: span.start + line, ..span });
        if self.over {
            return;
        }
        for part in parts {
            match part {
                Part::Text(span) => self.copy(place, *span),
                Part::Echo(on) => self.echo = *on,
                Part::Value { inner, place: braces, silent } => self.value(place, *inner, *braces, *silent),
                Part::Include { name, place: braces, optional } => self.include(place, *name, *braces, *optional),
            }
        }
    }

    /// Counts a line, or a pass of a loop; gives up when there have been too many.
    fn spend(&mut self, place: &Place, span: Span) {
        self.lines += 1;
        if self.lines > MOST_LINES || self.text.len() > MOST_BYTES {
            let million = MOST_LINES / 1_000_000;
            let message = format!("the loops of this deck do not end within {million} million lines");
            self.give_up(place.file, Diagnostic::error(message).at(span, "given up here"));
        }
    }

    /// Puts the value of an expression into the text.
    fn value(&mut self, place: &Place, inner: Span, braces: Span, silent: bool) {
        let outcome = place.evaluate(&mut self.names, inner, |names, node| {
            Ok(match names.value(node)? {
                Value::Number(number) => names.printed(number, node.span)?,
                Value::Text(text) => text,
                Value::Unknown => return Err(Fault::Consequence),
            })
        });
        self.warn_of_e(place.file);
        let (text, how) = match outcome {
            Ok(text) => (text.unwrap_or_default(), How::Evaluated),
            Err(fault) => {
                self.fault(place.file, fault);
                (STAND_IN.to_string(), How::Guessed)
            }
        };
        if !silent {
            self.put(place.file, braces, &text, how);
        }
    }

    fn conditional(&mut self, place: &Place, arms: &[Arm]) {
        for arm in arms {
            match self.holds(place, &arm.condition) {
                Ok(true) => return self.nodes(place, &arm.body),
                Ok(false) => {}
                Err(fault) => {
                    // Neither taking these lines nor leaving them out would be what is meant.
                    self.over = true;
                    return self.fault(place.file, fault);
                }
            }
        }
    }

    fn holds(&mut self, place: &Place, condition: &Condition) -> Result<bool, Fault> {
        let head = match condition {
            Condition::Else => return Ok(true),
            Condition::If(head) => *head,
            Condition::Defined { name, .. } => *name,
        };
        let wanted = !matches!(condition, Condition::Defined { wanted: false, .. });
        let by_name = matches!(condition, Condition::Defined { .. });
        let held = place.evaluate(&mut self.names, head, |names, node| match &node.kind {
            Kind::Name(name) if by_name && names.get(name).is_none() => Ok(false),
            _ => names.holds(node),
        })?;
        let held =
            held.ok_or_else(|| Fault::at(head, "a condition is missing", "expected an expression in these ( )"))?;
        Ok(held == wanted)
    }

    /// `{loop(n, name, start, step)}`: all but the first may be left out.
    fn repeat(&mut self, place: &Place, head: Span, braces: Span, body: &[Node]) {
        let heads = arguments(&place.source, head);
        let mut number = |i: usize, otherwise: f64| -> Result<f64, Fault> {
            let Some(&span) = heads.get(i) else { return Ok(otherwise) };
            Ok(place.evaluate(&mut self.names, span, |names, node| names.number(node))?.unwrap_or(otherwise))
        };
        let limits = number(0, f64::NAN).and_then(|n| Ok((n, number(2, 0.0)?, number(3, 1.0)?)));
        let (passes, start, step) = match limits {
            Ok((n, start, step)) if n >= 0.0 && n.fract() == 0.0 && heads.len() <= 4 => (n, start, step),
            Ok((n, ..)) => {
                let message = if n.is_nan() || heads.len() > 4 {
                    "a loop is {loop(passes, name, start, step)}".to_string()
                } else {
                    format!("a loop makes {n} passes; that must be a whole number, 0 or more")
                };
                return self.give_up(place.file, Diagnostic::error(message).at(head, ""));
            }
            Err(fault) => {
                self.over = true;
                return self.fault(place.file, fault);
            }
        };
        if passes > MOST_LINES as f64 {
            let message = format!("this loop makes {passes} passes; at most {MOST_LINES} are made");
            return self.give_up(place.file, Diagnostic::error(message).at(braces, ""));
        }
        let index = heads.get(1).map(|&span| place.source.slice(span).trim().trim_matches(['"', '\'']).to_string());
        for pass in 0..passes as usize {
            if self.over {
                return;
            }
            // A loop without lines goes on as long as one with.
            self.spend(place, braces);
            if let Some(name) = index.as_ref().filter(|name| !name.is_empty()) {
                self.names.set(name, Value::Number(start + step * pass as f64));
            }
            self.nodes(place, body);
        }
    }

    fn include(&mut self, place: &Place, name: Span, braces: Span, optional: bool) {
        let outcome = place.evaluate(&mut self.names, name, |names, node| names.value(node));
        let wanted = match outcome {
            Ok(Some(Value::Text(text))) if !text.trim().is_empty() => text.trim().to_string(),
            Ok(_) => {
                let message = "include needs the name of a file in quotes";
                let help = format!("for example: {{include(\"{}\")}}", "common.inc");
                return self.give_up(place.file, Diagnostic::error(message).at(braces, "").help(help));
            }
            Err(fault) => {
                self.over = true;
                return self.fault(place.file, fault);
            }
        };
        let wrong = |message: String| Diagnostic::error(message).at(name, "");
        let shown = spelling::cut(&wanted);
        let found = match include::open(&wanted, &place.source) {
            Ok(Some(found)) => found,
            Ok(None) if optional => return,
            Ok(None) => {
                let diagnostic = wrong(format!("there is no file {shown} to include"));
                let help = "it is looked for beside the file that includes it, then where the program runs";
                return self.give_up(place.file, diagnostic.help(help));
            }
            Err(why) => return self.give_up(place.file, wrong(format!("cannot include {shown}: {why}"))),
        };
        if self.open.contains(&found.identity) {
            return self.give_up(place.file, wrong(format!("{shown} includes itself")));
        }
        if self.open.len() >= DEEPEST_FILES || self.origin.files.len() >= MOST_FILES {
            return self.give_up(place.file, wrong(format!("too many files are included: {shown} is one more")));
        }
        self.warn_of_comment(place, braces, &found.source);
        self.open.push(found.identity);
        self.origin.files.push(File { source: found.source, included_at: Some((place.file, braces)) });
        self.file(self.origin.files.len() - 1);
        self.open.pop();
    }

    /// In `$ {include("f")}`, the first line of the file stands in the comment, as in aprepro; a command there is lost.
    fn warn_of_comment(&mut self, place: &Place, braces: Span, included: &Source) {
        let line = self.text.rsplit('\n').next().unwrap_or("");
        let first = included.slice(included.line_span(0)).trim();
        if line.contains('$') && !first.is_empty() && !first.starts_with(['$', '{']) {
            let warning = Diagnostic::warning("the first line of the included file belongs to a comment")
                .at(braces, "this stands in a comment")
                .help(format!("that line is: {}", spelling::cut(first)))
                .help("take the $ before the braces away");
            self.report(place.file, warning);
        }
    }

    /// Young's modulus is often called E: an E that nobody set is most likely a mistake.
    fn warn_of_e(&mut self, file: usize) {
        let Some(span) = self.names.used_e.filter(|_| !self.told_of_e) else { return };
        self.told_of_e = true;
        let message = "E is 2.718..., the base of natural logarithms: the deck gives it no other value";
        self.report(file, Diagnostic::warning(message).at(span, "no {E = ...} stands above this"));
    }

    fn copy(&mut self, place: &Place, span: Span) {
        if !self.echo || span.start == span.end {
            return;
        }
        let start = self.text.len();
        self.text.push_str(place.source.slice(span));
        let joined = self
            .origin
            .pieces
            .last_mut()
            .filter(|last| last.how == How::Copied && last.file == place.file && last.from.end == span.start);
        match joined {
            Some(last) => last.from.end = span.end,
            None => self.origin.pieces.push(Piece { start, file: place.file, from: span, how: How::Copied }),
        }
    }

    fn put(&mut self, file: usize, from: Span, text: &str, how: How) {
        if self.echo && !text.is_empty() {
            self.origin.pieces.push(Piece { start: self.text.len(), file, from, how });
            self.text.push_str(text);
        }
    }

    fn fault(&mut self, file: usize, fault: Fault) {
        if let Fault::Mistake(diagnostic) = fault {
            self.report(file, *diagnostic);
        }
    }

    fn give_up(&mut self, file: usize, diagnostic: Diagnostic) {
        self.over = true;
        self.report(file, diagnostic);
    }

    fn report(&mut self, file: usize, diagnostic: Diagnostic) {
        if self.found.len() < MOST_MISTAKES || self.over {
            self.found.push((file, diagnostic));
        }
    }
}

/// A file that is being worked through.
struct Place {
    file: usize,
    source: Arc<Source>,
}

impl Place {
    /// Evaluates what stands at a place; `None` where there is nothing.
    fn evaluate<T>(
        &self,
        names: &mut Names,
        span: Span,
        of: impl FnOnce(&mut Names, &expr::Node) -> Result<T, Fault>,
    ) -> Result<Option<T>, Fault> {
        let text = self.source.slice(span);
        let tree = lexer::tokens(text, span.start).and_then(|tokens| expr::parse(&tokens));
        match tree {
            Ok(Some(node)) => of(names, &node).map(Some),
            Ok(None) => Ok(None),
            Err(fault) => {
                // The name that would have got the value is not undefined.
                if let Some((name, rest)) = text.split_once('=')
                    && !rest.starts_with('=')
                    && name.trim().chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
                {
                    names.set(name.trim(), Value::Unknown);
                }
                Err(fault)
            }
        }
    }
}

impl Part {
    fn span(&self) -> Span {
        match self {
            Part::Text(span) | Part::Value { place: span, .. } | Part::Include { place: span, .. } => *span,
            Part::Echo(_) => Span::default(),
        }
    }
}

/// The places of arguments that commas separate, outside of brackets and quotes.
fn arguments(source: &Source, span: Span) -> Vec<Span> {
    let text = source.slice(span);
    let (mut depth, mut quote, mut from) = (0, None, 0);
    let mut places = Vec::new();
    let place = |from: usize, to: usize| Span { start: span.start + from, end: span.start + to };
    for (i, c) in text.char_indices() {
        match (quote, c) {
            (Some(open), c) if open == c => quote = None,
            (None, '"' | '\'') => quote = Some(c),
            (None, '(') => depth += 1,
            (None, ')') => depth -= 1,
            (None, ',') if depth == 0 => {
                places.push(place(from, i));
                from = i + 1;
            }
            _ => {}
        }
    }
    places.push(place(from, text.len()));
    places
}
