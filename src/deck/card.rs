//! A command of a deck as written: named, typed fields, each with its place in the text.

use super::{text::lexer::Field, text::source::Span};

/// One command with its fields. Fields are looked up by the names of the grammar; see [`super::commands::grammar::FieldRule`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Card {
    /// Name of the grammar's entry.
    pub name: String,
    /// The words that name the command.
    pub span: Span,
    /// The whole record.
    pub record: Span,
    /// Whether every field could be read. The mistakes of a card that is not complete have been reported.
    pub complete: bool,
    /// Lines of a group.
    pub rows: Vec<Row>,
    pub(super) values: Vec<(String, Vec<Item>)>,
}

/// One value of a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// The value.
    pub value: Value,
    /// Where it stands; `None` for a default.
    pub span: Option<Span>,
}

/// A typed value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A finite number within the field's range.
    Number(f64),
    /// A whole number within the field's range.
    Integer(i64),
    /// A choice in its full spelling, a name, words, or a line.
    Text(String),
}

/// One line of a group.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Its fields as written.
    pub fields: Vec<Field>,
    /// Its numbers, one per column of the group; empty where the group has properties instead.
    pub numbers: Vec<f64>,
}

impl Row {
    /// From the first field to the last.
    pub fn span(&self) -> Span {
        self.fields.iter().map(|f| f.span).reduce(Span::join).unwrap_or_default()
    }
}

impl Card {
    /// All values of a field; empty where none is given and none is the default.
    pub fn items(&self, field: &str) -> &[Item] {
        self.values.iter().find(|(name, _)| name == field).map_or(&[], |(_, items)| items)
    }

    /// The number in an optional field.
    pub fn maybe_number(&self, field: &str) -> Option<f64> {
        self.items(field).first().and_then(|item| item.value.number())
    }

    /// The number in a field that is required or has a default. NaN where the grammar promises no number.
    pub fn number(&self, field: &str) -> f64 {
        self.maybe_number(field).unwrap_or(f64::NAN)
    }

    /// Three numbers.
    pub fn vector(&self, fields: [&str; 3]) -> [f64; 3] {
        fields.map(|field| self.number(field))
    }

    /// The whole number in an optional field.
    pub fn maybe_integer(&self, field: &str) -> Option<i64> {
        self.items(field).first().and_then(|item| item.value.integer())
    }

    /// The whole number in a field that is required or has a default. Zero where the grammar promises none.
    pub fn integer(&self, field: &str) -> i64 {
        self.maybe_integer(field).unwrap_or(0)
    }

    /// The text of a field: a choice in its full spelling, a name, words or a line; empty without one.
    pub fn text(&self, field: &str) -> &str {
        self.items(field).first().and_then(|item| item.value.text()).unwrap_or("")
    }

    /// Whether the deck gives this field.
    pub fn given(&self, field: &str) -> bool {
        self.items(field).iter().any(|item| item.span.is_some())
    }

    /// Where a field stands; the command's words if it is not given.
    pub fn place(&self, field: &str) -> Span {
        self.items(field).iter().filter_map(|item| item.span).reduce(Span::join).unwrap_or(self.span)
    }

    /// Whether two cards say the same, wherever they stand.
    pub fn says_the_same(&self, other: &Card) -> bool {
        let values = |card: &Card| -> Vec<Value> {
            card.values.iter().flat_map(|(_, items)| items.iter().map(|item| item.value.clone())).collect()
        };
        values(self) == values(other)
    }
}

impl Value {
    /// The number, be it whole or not.
    pub fn number(&self) -> Option<f64> {
        match *self {
            Value::Number(number) => Some(number),
            Value::Integer(integer) => Some(integer as f64),
            Value::Text(_) => None,
        }
    }

    /// The whole number.
    pub fn integer(&self) -> Option<i64> {
        if let Value::Integer(integer) = *self { Some(integer) } else { None }
    }

    /// The text.
    pub fn text(&self) -> Option<&str> {
        if let Value::Text(text) = self { Some(text) } else { None }
    }
}
