//! Text → cards: the command language, which knows no physics.
//!
//! Expressions in braces are evaluated first. A [`Grammar`] lists the commands of a language as data. [`Deck::read`] turns
//! a [`Source`] into [`Card`]s with named, typed fields, and gathers every mistake in [`Diagnostics`]. The decks of `urto
//! run` and the recipes of `urto mesh` are two languages for the same engine.

mod aprepro;
mod card;
mod commands;
mod definitions;
mod pages;
mod reader;
mod text;
mod value;

pub use card::{Card, Item, Row, Value};
pub use commands::fields::FieldReader;
pub use commands::grammar::{Absent, Choice, Entry, FieldRule, Form, Grammar, Kind, Standing, Status};
pub use commands::language::{CARDS, language};
pub use definitions::{Definitions, Given};
pub use pages::explain::{UnknownTopic, explain, explain_in, explain_word, search};
pub use pages::manual::{chapters, manual};
pub use reader::Deck;
pub use text::diagnostic::{Diagnostic, Diagnostics, Label, Level};
pub use text::lexer::{Field, FieldKind, Lexer, Record};
pub use text::number::Number;
pub use text::source::{Source, Span};
pub use text::spelling::{self, Agreement, Spelled};
