//! Messages about a deck: where, what was read, what was expected, what to do. All of them are gathered first.

use std::{fmt, sync::Arc};

use annotate_snippets::{
    Annotation, AnnotationKind, Group, Level as Rank, Message, Origin, Renderer, Snippet, renderer::DecorStyle,
};

use super::source::{Source, Span};
use super::spelling;

/// How much a message matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// The run cannot start.
    Error,
    /// The run can start, but look at this.
    Warning,
    /// Something was assumed; kept for the print log.
    Note,
}

/// A remark at a place of the deck.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label {
    /// The text to underline.
    pub span: Span,
    /// What stands beside the underline.
    pub text: String,
}

/// One message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// How much it matters.
    pub level: Level,
    /// The message in one line: what is wrong, with what was read.
    pub message: String,
    /// Places in the deck; the first is where the message points to.
    pub labels: Vec<Label>,
    /// What to do, one line each.
    pub help: Vec<String>,
}

impl Diagnostic {
    fn new(level: Level, message: impl Into<String>) -> Diagnostic {
        Diagnostic { level, message: message.into(), labels: Vec::new(), help: Vec::new() }
    }

    /// A message that stops the run.
    pub fn error(message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(Level::Error, message)
    }

    /// A message about words that may stand for several names.
    pub fn unclear(words: impl fmt::Display, names: &[String], at: Span) -> Diagnostic {
        let message = format!("{words} may stand for {}", spelling::either(names));
        Diagnostic::error(message).at(at, "this abbreviation is not clear; write more of it")
    }

    /// A message that does not stop the run.
    pub fn warning(message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(Level::Warning, message)
    }

    /// An assumption.
    pub fn note(message: impl Into<String>) -> Diagnostic {
        Diagnostic::new(Level::Note, message)
    }

    /// Adds a place with a remark, which may be empty; the first one added is the main one.
    pub fn at(mut self, span: Span, text: impl Into<String>) -> Diagnostic {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    /// Adds a line of advice; an empty one is left out.
    pub fn help(mut self, text: impl Into<String>) -> Diagnostic {
        let text = text.into();
        if !text.is_empty() {
            self.help.push(text);
        }
        self
    }
}

/// All messages about one source.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostics {
    source: Arc<Source>,
    list: Vec<Diagnostic>,
    /// Errors in the list.
    errors: usize,
    /// Where reading was given up.
    unread: Option<Span>,
}

/// Errors gathered at most: whatever the rest of a text is, it is no deck, and reading on would only fill the memory.
const ERRORS_AT_MOST: usize = 100;
/// Warnings and notes kept at most.
const OTHERS_AT_MOST: usize = 10_000;

/// Messages printed at most; a deck with more mistakes has one cause for most of them.
const PRINTED_AT_MOST: usize = 50;

impl Diagnostics {
    /// No messages yet.
    pub fn new(source: Arc<Source>) -> Diagnostics {
        Diagnostics { source, list: Vec::new(), errors: 0, unread: None }
    }

    /// The text the messages are about.
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// Adds a message, unless it follows from an expression that could not be evaluated, which has been reported.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let doubtful = match &diagnostic.labels[..] {
            [] => self.source.is_doubtful(None),
            labels => labels.iter().any(|label| self.source.is_doubtful(Some(label.span))),
        };
        let kept = diagnostic.level == Level::Error || self.list.len() < OTHERS_AT_MOST;
        if !doubtful && kept {
            self.errors += usize::from(diagnostic.level == Level::Error);
            self.list.push(diagnostic);
        }
    }

    /// Whether there are so many errors that reading on is of no use.
    pub fn is_full(&self) -> bool {
        self.errors >= ERRORS_AT_MOST
    }

    /// Notes that the text is not read from a place on, because there are so many errors.
    pub fn leave_unread(&mut self, rest: Span) {
        self.unread = Some(rest);
    }

    /// Adds all messages of another collection about the same source.
    pub fn append(&mut self, other: Diagnostics) {
        self.errors += other.errors;
        self.list.extend(other.list);
    }

    /// Messages that stop the run.
    pub fn errors(&self) -> impl Iterator<Item = &Diagnostic> {
        self.of(Level::Error)
    }

    /// Messages that do not stop the run.
    pub fn warnings(&self) -> impl Iterator<Item = &Diagnostic> {
        self.of(Level::Warning)
    }

    /// Assumptions, for the print log.
    pub fn notes(&self) -> impl Iterator<Item = &Diagnostic> {
        self.of(Level::Note)
    }

    /// Whether anything stops the run.
    pub fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// Whether there is nothing to say, assumptions aside.
    pub fn is_empty(&self) -> bool {
        self.list.iter().all(|d| d.level == Level::Note)
    }

    fn of(&self, level: Level) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter().filter(move |d| d.level == level)
    }

    /// Errors and warnings in the order of the deck, those without a place last, as text for a terminal; plain
    /// ASCII without `color`. Ends with a line that counts them; empty when there are none.
    pub fn render(&self, color: bool) -> String {
        let shown = self.shown();
        if shown.is_empty() {
            return String::new();
        }
        let renderer = if color { Renderer::styled() } else { Renderer::plain() }.decor_style(DecorStyle::Ascii);
        let mut text = String::new();
        for diagnostic in shown.iter().take(PRINTED_AT_MOST) {
            text += &renderer.render(&[self.group(diagnostic)]);
            text += "\n\n";
        }
        if shown.len() > PRINTED_AT_MOST {
            text += &format!("... and {} more\n\n", shown.len() - PRINTED_AT_MOST);
        }
        if let Some(rest) = self.unread {
            let line = self.source.line_name(rest.start);
            text += &format!(
                "help: line {line} and those after it are not read: one cause may stand behind all of this\n\n"
            );
        }
        text += &format!("{}: {}\n", self.source.name(), count(&shown));
        text
    }

    /// Errors and warnings in the order of their places; what a loop repeats, once.
    fn shown(&self) -> Vec<&Diagnostic> {
        let order = |d: &Diagnostic| d.labels.first().map_or(vec![usize::MAX], |l| self.source.order_of(l.span));
        let mut keyed: Vec<_> = self.list.iter().filter(|d| d.level != Level::Note).map(|d| (order(d), d)).collect();
        keyed.sort_by(|a, b| a.0.cmp(&b.0));
        keyed.dedup_by(|a, b| a.0 == b.0 && a.1.message == b.1.message && a.1.level == b.1.level);
        keyed.into_iter().map(|(_, diagnostic)| diagnostic).collect()
    }

    fn group<'a>(&'a self, diagnostic: &'a Diagnostic) -> Group<'a> {
        let rank = match diagnostic.level {
            Level::Error => Rank::ERROR,
            Level::Warning => Rank::WARNING,
            Level::Note => Rank::NOTE,
        };
        let mut group = Group::with_title(rank.primary_title(diagnostic.message.as_str()));
        let Some(main) = diagnostic.labels.first() else {
            let group = group.element(Origin::path(self.source.name()));
            return group.elements(helps(diagnostic));
        };
        for (file, annotations) in self.by_file(diagnostic) {
            group = group.element(Snippet::source(file.text()).path(file.name()).annotations(annotations));
        }
        let included = self.source.included_at(main.span).into_iter();
        group = group.elements(included.map(|place| Rank::NOTE.message(format!("included at {place}"))));
        group.elements(helps(diagnostic))
    }

    /// The labels of a message by the file that they came from, that of the first one first.
    fn by_file<'a>(&'a self, diagnostic: &'a Diagnostic) -> Vec<(&'a Source, Vec<Annotation<'a>>)> {
        let mut files: Vec<(&Source, Vec<Annotation>)> = Vec::new();
        for (i, label) in diagnostic.labels.iter().enumerate() {
            let kind = if i == 0 { AnnotationKind::Primary } else { AnnotationKind::Context };
            let (file, span) = self.source.origin_of(label.span);
            let annotation = kind.span(span.start..span.end).label(label.text.as_str());
            match files.iter_mut().find(|(known, _)| std::ptr::eq(*known, file)) {
                Some((_, annotations)) => annotations.push(annotation),
                None => files.push((file, vec![annotation])),
            }
        }
        files
    }
}

fn helps(diagnostic: &Diagnostic) -> impl Iterator<Item = Message<'_>> {
    diagnostic.help.iter().map(|help| Rank::HELP.message(help.as_str()))
}

/// "2 errors, 1 warning".
fn count(shown: &[&Diagnostic]) -> String {
    let of = |level: Level| shown.iter().filter(|d| d.level == level).count();
    let plural = |n: usize, word: &str| format!("{n} {word}{}", if n == 1 { "" } else { "s" });
    match (of(Level::Error), of(Level::Warning)) {
        (errors, 0) => plural(errors, "error"),
        (0, warnings) => plural(warnings, "warning"),
        (errors, warnings) => format!("{}, {}", plural(errors, "error"), plural(warnings, "warning")),
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Diagnostics {}
