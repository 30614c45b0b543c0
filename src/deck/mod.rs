//! Text → cards: the command language, which knows no physics.
//!
//! Expressions in braces are evaluated first. A [`Grammar`] lists the commands of a language as data. [`Deck::read`] turns a [`Source`] into [`Card`]s with
//! named, typed fields, and gathers every mistake in [`Diagnostics`]. The decks of `urto run` and the recipes of
//! `urto mesh` are two languages for the same engine.

mod aprepro;
mod card;
mod definitions;
mod diagnostic;
mod explain;
mod fields;
mod glossary;
mod grammar;
mod identify;
mod language;
mod lexer;
mod manual;
mod number;
mod origin;
mod page;
mod plane;
mod reader;
mod source;
pub mod spelling;
mod value;

pub use card::{Card, Item, Row, Value};
pub use definitions::{Definitions, Given};
pub use diagnostic::{Diagnostic, Diagnostics, Label, Level};
pub use explain::{UnknownTopic, explain, explain_in, explain_word, search};
pub use fields::FieldReader;
pub use grammar::{Absent, Choice, Entry, FieldRule, Form, Grammar, Kind, Standing, Status};
pub use language::{CARDS, language};
pub use lexer::{Field, FieldKind, Lexer, Record};
pub use manual::{chapters, manual};
pub use number::Number;
pub use reader::Deck;
pub use source::{Source, Span};
pub use spelling::{Agreement, Spelled};
