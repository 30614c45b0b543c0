//! Where evaluated text came from: every stretch of it with its file and its place there.
//!
//! A text that was evaluated has two kinds of places. Bytes `0..length` are the evaluated text itself, which spans of
//! cards and fields refer to. Above them lie the files that it was made from, one after the other, each as long as its
//! text and one byte: spans of messages about expressions refer to these.

use super::source::{Source, Span};

/// The files that a text was made from, and which stretch came from where.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(in crate::deck) struct Origin {
    /// The deck itself, then every file that was included, in the order in which that happened.
    pub files: Vec<File>,
    /// Stretches in the order of the evaluated text; each ends where the next one starts.
    pub pieces: Vec<Piece>,
}

/// A file of a deck.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::deck) struct File {
    /// Its name and text.
    pub source: Source,
    /// The file that includes it, and the place there.
    pub included_at: Option<(usize, Span)>,
}

/// A stretch of evaluated text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::deck) struct Piece {
    /// First byte in the evaluated text.
    pub start: usize,
    /// Which file it came from.
    pub file: usize,
    /// What made it: text that was copied, or an expression with its braces.
    pub from: Span,
    /// How.
    pub how: How,
}

/// How a stretch of evaluated text was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::deck) enum How {
    /// Byte by byte as it stands in the file.
    Copied,
    /// By evaluating an expression.
    Evaluated,
    /// As a stand-in for an expression with a mistake, which has been reported.
    Guessed,
}

impl Origin {
    /// The address of the first byte of a file, in a text of so many bytes.
    pub fn base(&self, length: usize, file: usize) -> usize {
        length + 1 + self.files[..file].iter().map(|f| f.source.text().len() + 1).sum::<usize>()
    }

    /// The file of a span, and the place there, for a text of so many bytes.
    pub fn resolve(&self, length: usize, span: Span) -> (usize, Span) {
        if span.start > length {
            return self.in_file(length, span);
        }
        let Some(first) = self.piece_at(span.start) else { return (0, Span::default()) };
        let last = self.piece_at(span.end.saturating_sub(1).max(span.start)).unwrap_or(first);
        let start = self.back(first, span.start).start;
        let end = match self.back(last, span.end) {
            place if last.file == first.file && place.end >= start => place.end,
            // A line that is joined with one of another file, or of another pass of a loop.
            _ => first.from.end,
        };
        (first.file, Span { start, end })
    }

    /// Whether a span touches the stand-in for an expression that could not be evaluated.
    pub fn is_guess(&self, length: usize, span: Span) -> bool {
        span.start <= length
            && self.first_piece(span.start).is_some_and(|first| {
                let touched = self.pieces[first..].iter().take_while(|p| p.start < span.end.max(span.start + 1));
                touched.into_iter().any(|piece| piece.how == How::Guessed)
            })
    }

    /// Whether any expression could not be evaluated.
    pub fn has_guesses(&self) -> bool {
        self.pieces.iter().any(|piece| piece.how == How::Guessed)
    }

    fn first_piece(&self, offset: usize) -> Option<usize> {
        self.pieces.partition_point(|piece| piece.start <= offset).checked_sub(1)
    }

    fn piece_at(&self, offset: usize) -> Option<&Piece> {
        self.first_piece(offset).map(|index| &self.pieces[index])
    }

    /// The place of a byte of a piece: itself if it was copied, else all that made the piece.
    fn back(&self, piece: &Piece, offset: usize) -> Span {
        match piece.how {
            How::Copied => {
                let place = (piece.from.start + (offset - piece.start)).min(piece.from.end);
                Span { start: place, end: place }
            }
            How::Evaluated | How::Guessed => piece.from,
        }
    }

    fn in_file(&self, length: usize, span: Span) -> (usize, Span) {
        let file = (0..self.files.len()).rev().find(|&file| self.base(length, file) <= span.start).unwrap_or(0);
        let base = self.base(length, file);
        let most = self.files[file].source.text().len();
        (file, Span { start: (span.start - base).min(most), end: (span.end.saturating_sub(base)).min(most) })
    }

    /// The places from the deck down to a byte of a file: that of the outermost include first.
    pub fn chain(&self, file: usize, at: usize) -> Vec<usize> {
        let mut chain = match self.files[file].included_at {
            Some((above, span)) => self.chain(above, span.start),
            None => Vec::new(),
        };
        chain.push(at);
        chain
    }
}
