//! Two-dimensional decks: the same language without what only space has.
//!
//! A command with the directive `plane` makes a deck two-dimensional, wherever it stands. Fields and commands that the
//! directive `space` names are then not part of the language, nor is the direction Z.

use crate::deck::{
    Lexer, Source,
    commands::grammar::{Absent, Entry, FieldRule, Grammar, Kind, Status},
    text::spelling::{self, Spelled},
};

/// Whether a deck has a command that makes it two-dimensional.
pub(in crate::deck) fn is_plane(grammar: &Grammar, source: &Source) -> bool {
    let mut lexer = Lexer::new(source);
    while let Some(record) = lexer.next_record() {
        let entries = grammar.entries.iter().enumerate();
        let spellings = entries.flat_map(|(i, e)| e.spellings().map(move |s| (s, i)));
        let Spelled::As { what, .. } = spelling::recognise(&record.fields, spellings) else { continue };
        let entry = &grammar.entries[what];
        if entry.plane {
            return true;
        }
        if entry.fields.iter().any(|field| field.kind == Kind::NextLine) {
            lexer.next_line();
        }
    }
    false
}

impl Grammar {
    /// The language of two-dimensional decks.
    pub fn in_plane(&self) -> Grammar {
        Grammar { entries: self.entries.iter().map(Entry::in_plane).collect() }
    }
}

impl Entry {
    /// The entry as it is in two dimensions. Its fields of space move to `filled`.
    pub fn in_plane(&self) -> Entry {
        let mut entry = self.clone();
        if entry.of_space && entry.status == Status::Built {
            entry.status = Status::Refused("it belongs to three dimensions, and this deck has two".into());
        }
        let (filled, mut fields): (Vec<FieldRule>, Vec<FieldRule>) =
            entry.fields.into_iter().partition(|field| self.space.contains(&field.name));
        for field in &mut fields {
            if let Kind::Choice(choices) = &mut field.kind
                && choices.iter().map(|choice| choice.name.as_str()).eq(["X", "Y", "Z"])
            {
                choices.truncate(2);
            }
        }
        // What the deck cannot say is what its default is, or nothing.
        let zero = |field: FieldRule| match field.default {
            Absent::Required => FieldRule { default: Absent::Value(nothing(&field.kind)), ..field },
            _ => field,
        };
        (entry.fields, entry.filled) = (fields, filled.into_iter().map(zero).collect());
        entry
    }
}

/// What stands for a field of space that every command must have: zero, or the direction across the plane.
fn nothing(kind: &Kind) -> String {
    match kind {
        Kind::Choice(choices) => choices.last().map_or(String::new(), |choice| choice.name.clone()),
        _ => "0.0".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deck::{Deck, language};

    fn read(text: &str) -> (Deck, Vec<String>) {
        let (deck, found) = Deck::read(Source::new("deck.i", text), language());
        let errors = found.errors().map(|error| error.message.clone());
        (deck, errors.filter(|error| error != "the deck has no MATERIAL").collect())
    }

    #[test]
    fn fields_of_space_are_not_asked_for_in_the_plane() {
        let text = "TITLE\n t\nRIGID SURFACE, 3, 1., 2., 0., 1., 0.3\nGRAVITY, 0., -9.81\nTERMINATION TIME, 1.\nAXISYMMETRIC\n";
        let (deck, errors) = read(text);
        assert_eq!(errors, Vec::<String>::new());
        let plane = &deck.cards[1];
        assert_eq!(plane.vector(["x0", "y0", "z0"]), [1.0, 2.0, 0.0]);
        assert_eq!(plane.vector(["nx", "ny", "nz"]), [0.0, 1.0, 0.0]);
        assert_eq!(plane.number("friction"), 0.3);
        assert_eq!(deck.cards[2].vector(["gx", "gy", "gz"]), [0.0, -9.81, 0.0]);
    }

    #[test]
    fn what_belongs_to_space_is_answered() {
        let (_, errors) =
            read("PLANE STRAIN\nTERMINATION TIME, 1.\nNO DISPLACEMENT, Z, 1\nTRUSS AREA, 1, 2.\nGRAVITY, 0., 0., 1.\n");
        let expected = [
            "NO DISPLACEMENT: direction is Z; it must be X or Y",
            "GRAVITY: function is 1.; it must be the number of a function",
            "TRUSS AREA: it belongs to three dimensions, and this deck has two",
        ];
        assert!(errors.iter().any(|error| error == expected[0]), "{errors:?}");
        assert!(errors.iter().any(|error| error == expected[2]), "{errors:?}");
    }

    /// What only shells, bars, edges or rotations have, each by its own line.
    #[test]
    fn commands_of_space_are_answered_one_by_one() {
        for command in [
            "NO ROTATION, X, 1",
            "PRESCRIBED ROTATION, X, 1, 1",
            "PRESCRIBED ANGULAR VELOCITY, X, 1, 1",
            "PRESCRIBED MOMENT, X, 1, 1",
            "SHELL THICKNESS, 1, 2.",
            "THICKNESS SCALE, 1, 2.",
            "INTEGRATION POINTS, 1, 5",
            "BEAM SECTION, 1, ROD, 2.",
            "ELEMENT, 1, EIGHT POINTS",
            "SPIN, SECOND ORDER",
            "CONTACT EDGES, ALL",
            "CONTACT THICKNESS, 1, 0.5",
        ] {
            let (_, errors) =
                read(&format!("PLANE STRAIN\nTERMINATION TIME, 1.\nFUNCTION, 1\n0., 1.\nEND\n{command}\n"));
            let told =
                errors.iter().any(|error| error.ends_with("it belongs to three dimensions, and this deck has two"));
            assert!(told, "{command}: {errors:?}");
        }
    }

    #[test]
    fn a_title_makes_nothing_flat() {
        let (deck, errors) = read("TITLE\nAXISYMMETRIC\nGRAVITY, 0., 0., 1.\nTERMINATION TIME, 1.\n");
        assert!(errors.is_empty(), "{errors:?}");
        assert_eq!(deck.cards[1].vector(["gx", "gy", "gz"]), [0.0, 0.0, 1.0]);
    }
}
