//! The text of a deck with the places in it: byte spans, lines and columns.

use std::sync::Arc;

use super::origin::Origin;
use crate::common::files;
use crate::deck::definitions::Definitions;

/// A file's name and text. Spans are byte offsets into the text. Where the text was made by evaluating expressions, it
/// knows the files that it was made from, and [`Source::origin_of`] leads back to them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    name: String,
    text: String,
    line_starts: Vec<usize>,
    origin: Option<Arc<Origin>>,
    /// Names that have a value in its expressions from the start.
    names: Vec<(String, u32)>,
    /// Values from the command line, which stand for those of assignments.
    given: Option<Arc<Definitions>>,
}

/// A stretch of the text, from byte `start` up to but not including byte `end`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// The shortest span that covers both.
    pub fn join(self, other: Span) -> Span {
        Span { start: self.start.min(other.start), end: self.end.max(other.end) }
    }
}

impl Source {
    /// A source from text in memory; `name` is what messages call it.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Source {
        let text = lines_end_in_line_feeds(text.into());
        let line_starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Source { name: name.into(), text, line_starts, origin: None, names: Vec::new(), given: None }
    }

    /// Evaluated text.
    pub(in crate::deck) fn evaluated(name: &str, text: String, origin: Origin) -> Source {
        Source { origin: Some(Arc::new(origin)), ..Source::new(name, text) }
    }

    /// A source from the bytes of a file. Bytes that are not UTF-8 (an umlaut in an old comment) become U+FFFD.
    pub fn from_bytes(name: impl Into<String>, bytes: &[u8]) -> Source {
        Source::new(name, String::from_utf8_lossy(bytes).into_owned())
    }

    /// Reads a file.
    ///
    /// # Errors
    /// When it cannot be read, or is a folder, a pipe or a device.
    pub fn open(path: &std::path::Path) -> std::io::Result<Source> {
        files::regular(path)?;
        Ok(Source::from_bytes(path.display().to_string(), &std::fs::read(path)?))
    }

    /// The same text, in whose expressions a name has this value from the start.
    pub fn with_value(mut self, name: &str, value: u32) -> Source {
        self.names.push((name.to_string(), value));
        self
    }

    /// The same text, in whose expressions these names have these values, whatever it assigns to them.
    pub fn with_definitions(mut self, given: &Arc<Definitions>) -> Source {
        self.given = Some(given.clone());
        self
    }

    /// Values from the command line.
    pub(in crate::deck) fn definitions(&self) -> Option<&Arc<Definitions>> {
        self.given.as_ref()
    }

    /// The names of all files that the text was made from: itself, and what it includes.
    pub fn files(&self) -> Vec<&str> {
        match &self.origin {
            Some(origin) => origin.files.iter().map(|file| file.source.name.as_str()).collect(),
            None => vec![&self.name],
        }
    }

    /// Names that have a value in its expressions from the start.
    pub(in crate::deck) fn names(&self) -> &[(String, u32)] {
        &self.names
    }

    /// The name that messages use.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Number of lines; a line feed at the very end starts no further line.
    pub fn line_count(&self) -> usize {
        let last_is_empty = self.line_starts.last().is_some_and(|&start| start == self.text.len());
        self.line_starts.len() - usize::from(last_is_empty)
    }

    /// Span of a zero-based line without its end of line.
    pub fn line_span(&self, line: usize) -> Span {
        let start = self.line_starts.get(line).copied().unwrap_or(self.text.len());
        let end = self.line_starts.get(line + 1).map_or(self.text.len(), |next| next - 1);
        let end = if self.text[start..end].ends_with('\r') { end - 1 } else { end };
        Span { start, end }
    }

    /// The text of a span; empty when the span does not fit this source.
    pub fn slice(&self, span: Span) -> &str {
        self.text.get(span.start..span.end).unwrap_or("")
    }

    /// The file that a span came from, and its place there: this source itself, unless it was evaluated.
    pub fn origin_of(&self, span: Span) -> (&Source, Span) {
        let Some(origin) = &self.origin else { return (self, span) };
        let (file, span) = origin.resolve(self.text.len(), span);
        (&origin.files[file].source, span)
    }

    /// The places where the file of a span was included, as `file:line`, the nearest first; none in the deck itself.
    pub fn included_at(&self, span: Span) -> Vec<String> {
        let Some(origin) = &self.origin else { return Vec::new() };
        let (mut file, _) = origin.resolve(self.text.len(), span);
        let mut places = Vec::new();
        while let Some((above, at)) = origin.files[file].included_at {
            let source = &origin.files[above].source;
            places.push(format!("{}:{}", source.name(), source.position(at.start).0));
            file = above;
        }
        places
    }

    /// What orders places: as they are met from the deck downwards, those of an included file at its include.
    pub fn order_of(&self, span: Span) -> Vec<usize> {
        let Some(origin) = &self.origin else { return vec![span.start] };
        let (file, place) = origin.resolve(self.text.len(), span);
        origin.chain(file, place.start)
    }

    /// Whether a message about this place, or about none, can be the consequence of an expression with a mistake.
    pub fn is_doubtful(&self, span: Option<Span>) -> bool {
        self.origin.as_ref().is_some_and(|origin| match span {
            Some(span) => origin.is_guess(self.text.len(), span),
            None => origin.has_guesses(),
        })
    }

    /// The line of a byte in the file it came from, counted from one; with the file's name if that is not the deck.
    pub fn line_name(&self, offset: usize) -> String {
        let (file, place) = self.origin_of(Span { start: offset, end: offset });
        let line = file.position(place.start).0;
        if file.name == self.name { line.to_string() } else { format!("{line} of {}", file.name) }
    }

    /// Line and column of a byte, both counted from one; columns count characters.
    pub fn position(&self, offset: usize) -> (usize, usize) {
        let line = self.line_starts.partition_point(|&start| start <= offset).max(1);
        let start = self.line_starts[line - 1];
        let column = self.text.get(start..offset).map_or(1, |before| before.chars().count() + 1);
        (line, column)
    }
}

/// A carriage return that no line feed follows ends a line too, as in files of old Macintosh programs: it becomes a
/// line feed, which keeps all places.
fn lines_end_in_line_feeds(text: String) -> String {
    if !text.contains('\r') {
        return text;
    }
    let mut letters = text.chars().peekable();
    let mut lines = String::with_capacity(text.len());
    while let Some(letter) = letters.next() {
        let alone = letter == '\r' && letters.peek() != Some(&'\n');
        lines.push(if alone { '\n' } else { letter });
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_lines_and_characters_from_one() {
        let source = Source::new("x.i", "ab\r\nµcd\n");
        assert_eq!(source.position(0), (1, 1));
        assert_eq!(source.position(4), (2, 1));
        assert_eq!(source.position(6), (2, 2)); // µ takes two bytes
        assert_eq!(source.line_count(), 2);
        assert_eq!(source.slice(source.line_span(0)), "ab");
        assert_eq!(source.slice(source.line_span(1)), "µcd");
        let old = Source::new("x.i", "a\rb\r\nc\r\rd\r");
        assert_eq!((old.text(), old.line_count()), ("a\nb\r\nc\n\nd\n", 5));
    }
}
