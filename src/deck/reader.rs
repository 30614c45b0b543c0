//! Records → cards: finds the entry of each record, reads its fields, and closes groups.

use std::sync::Arc;

use super::{
    aprepro::{self, Evaluated},
    card::{Card, Item, Row, Value},
    commands::fields::FieldReader,
    commands::grammar::{Entry, Form, Grammar, Kind, Status},
    commands::plane,
    text::diagnostic::{Diagnostic, Diagnostics},
    text::identify::Found,
    text::lexer::{Field, FieldKind, Lexer, Record},
    text::source::{Source, Span},
    text::spelling::{self, Agreement, Spelled},
};

/// A deck as written: its text and its cards in order.
#[derive(Debug, Clone)]
pub struct Deck {
    /// The text.
    pub source: Arc<Source>,
    /// The commands that can be used, in the order of the text.
    pub cards: Vec<Card>,
}

impl Deck {
    /// Evaluates the expressions of a text and reads it in the language of a grammar. Cards with a mistake are kept,
    /// marked as not complete. Where the evaluation comes to nothing, there are no cards.
    pub fn read(source: Source, grammar: &Grammar) -> (Deck, Diagnostics) {
        let Evaluated { source, found, readable } = aprepro::evaluate(source);
        let source = Arc::new(source);
        let flat = plane::is_plane(grammar, &source).then(|| grammar.in_plane());
        let grammar = flat.as_ref().unwrap_or(grammar);
        let mut diagnostics = Diagnostics::new(source.clone());
        found.into_iter().for_each(|diagnostic| diagnostics.push(diagnostic));
        if !readable {
            return (Deck { source, cards: Vec::new() }, diagnostics);
        }
        let mut reader = Reader {
            grammar,
            source: &source,
            lexer: Lexer::new(&source),
            pending: None,
            cards: Vec::new(),
            unbuilt: Vec::new(),
            diagnostics,
        };
        if reader.is_text() {
            reader.read_all();
            if reader.diagnostics.is_full() {
                // What is there would only lead to messages about what is not.
                reader.cards.clear();
            } else {
                reader.report_unbuilt();
                reader.report_missing();
            }
        }
        let Reader { cards, diagnostics, .. } = reader;
        (Deck { source, cards }, diagnostics)
    }

    /// Complete cards of one command.
    pub fn cards_of<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Card> {
        self.cards.iter().filter(move |card| card.complete && card.name == name)
    }
}

pub(super) struct Reader<'a> {
    pub grammar: &'a Grammar,
    pub source: &'a Source,
    lexer: Lexer<'a>,
    /// A record that turned out to belong to the next command.
    pending: Option<Record>,
    cards: Vec<Card>,
    /// Entries that cannot be used, each with the places where it stands.
    unbuilt: Vec<(&'a Entry, Vec<Span>)>,
    pub diagnostics: Diagnostics,
}

impl<'a> Reader<'a> {
    /// Refuses a mesh or another file that is no text.
    fn is_text(&mut self) -> bool {
        let Some(zero) = self.source.text().find('\0') else { return true };
        self.diagnostics.push(
            Diagnostic::error(format!("{} is not a deck: it holds bytes that no text has", self.source.name()))
                .at(Span { start: zero, end: zero + 1 }, "a byte of value zero")
                .help("a deck is a text file, by custom with the ending .i"),
        );
        false
    }

    fn read_all(&mut self) {
        while let Some(record) = self.next_record() {
            if self.diagnostics.is_full() {
                return self.diagnostics.leave_unread(record.span());
            }
            let Some(found) = self.identify(&record) else { continue };
            if found.sure && found.entry.name == EXIT {
                self.after_exit(&record);
                return;
            }
            self.command(found, &record);
        }
        if let Some(star) = self.lexer.dangling_continuation {
            self.diagnostics.push(
                Diagnostic::warning("the last line ends in *, but there is no line to continue it")
                    .at(star, "nothing follows"),
            );
        }
    }

    fn next_record(&mut self) -> Option<Record> {
        if let Some(record) = self.pending.take() {
            return Some(record);
        }
        let record = self.lexer.next_record()?;
        for field in record.fields.iter().filter(|f| f.kind == FieldKind::Quoted { closed: false }) {
            self.diagnostics.push(
                Diagnostic::warning("this quote is not closed: the rest of the line belongs to it")
                    .at(field.span, "no second ' on this line"),
            );
        }
        Some(record)
    }

    /// Reads one command with all its lines.
    fn command(&mut self, found: Found<'a>, record: &Record) {
        let Found { entry, words, sure } = found;
        // A guess must not swallow lines that mean something of their own.
        if !sure && entry.form == Form::Group && !self.has_lines_of(entry) {
            return;
        }
        let span = record.fields[..words].iter().map(|f| f.span).reduce(Span::join).unwrap_or_default();
        let mut card =
            Card { name: entry.name.clone(), span, record: record.span(), complete: sure, ..Card::default() };
        if matches!(entry.status, Status::Built | Status::Idle(_)) {
            let owner = self.owner(entry, &record.fields[words..]);
            let syntax = entry.syntax();
            let end = Span { start: card.record.end, end: card.record.end };
            // What a guess gets wrong is not worth a message, but its numbers help to understand the rest.
            let mut unheard = Diagnostics::new(self.diagnostics.source().clone());
            let diagnostics = if sure { &mut self.diagnostics } else { &mut unheard };
            let mut reader = FieldReader { owner: &owner, form: &syntax, end, diagnostics };
            let complete;
            (card.values, complete) = reader.read(&entry.fields, &record.fields[words..]);
            card.complete &= complete;
            card.values.extend(reader.read(&entry.filled, &[]).0);
        }
        self.next_line(entry, record, words, &mut card);
        if entry.form == Form::Group {
            self.group(entry, &mut card);
        }
        if entry.status != Status::Built {
            return self.note_unbuilt(entry, card.record);
        }
        self.check_once(entry, &card);
        self.cards.push(card);
    }

    /// What messages call a command: its name, with its number if that is its first field.
    fn owner(&self, entry: &Entry, fields: &[Field]) -> String {
        let numbered =
            entry.form == Form::Group && matches!(entry.fields.first(), Some(f) if matches!(f.kind, Kind::Id(_)));
        match fields.first().and_then(Field::number).and_then(|n| n.integer) {
            Some(id) if numbered => format!("{} {id}", entry.name),
            _ => entry.name.clone(),
        }
    }

    /// Whether the lines that follow can be those of a group: its END comes before the next command does.
    fn has_lines_of(&self, group: &Entry) -> bool {
        let mut ahead = self.lexer.clone();
        while let Some(record) = ahead.next_record() {
            let fields = &record.fields;
            if fields[0].is_word() && fields[0].text == END {
                return true;
            }
            if self.is_next_command(group, fields) {
                return false;
            }
        }
        false
    }

    /// Whether the next line of the deck is a command.
    fn command_follows(&self) -> bool {
        let record = self.lexer.clone().next_record();
        record.is_some_and(|record| self.exact_command(&record.fields).is_some())
    }

    /// Takes the next line of the deck for an entry, such as TITLE, whose value stands there.
    fn next_line(&mut self, entry: &Entry, record: &Record, words: usize, card: &mut Card) {
        let Some(rule) = entry.fields.iter().find(|f| f.kind == Kind::NextLine) else { return };
        // Text on the command's own line has been reported; the next line is then most likely a command.
        if record.fields.len() > words || (!card.complete && self.command_follows()) {
            return;
        }
        let Some(line) = self.lexer.next_line() else {
            card.complete = false;
            self.diagnostics.push(
                Diagnostic::error(format!("{}: the file ends before its {}", entry.name, rule.label()))
                    .at(card.span, format!("the {} belongs on the line after this one", rule.label())),
            );
            return;
        };
        let text = self.source.slice(line).to_string();
        self.warn_about_swallowed_command(entry, line, &text);
        card.values.push((rule.name.clone(), vec![Item { value: Value::Text(text), span: Some(line) }]));
    }

    fn warn_about_swallowed_command(&mut self, entry: &Entry, line: Span, text: &str) {
        let source = Source::new("", text);
        let Some(record) = Lexer::new(&source).next_record() else { return };
        if let Some((command, words)) = self.exact_command(&record.fields) {
            // Words alone that go on after a command's are a sentence: TUBE IN TUBE.
            let rest = record.fields.get(words..).unwrap_or_default();
            let says_more = text.contains([',', '=']) || rest.iter().any(|field| !field.is_word());
            if !rest.is_empty() && !says_more {
                return;
            }
            self.diagnostics.push(
                Diagnostic::warning(format!("the line after {} is taken as its text", entry.name))
                    .at(line, format!("this looks like the command {}, but it is not read as one", command.name))
                    .help(format!("put the text on the line directly after {}", entry.name)),
            );
        }
    }

    /// Reads the lines of a group up to END.
    fn group(&mut self, entry: &'a Entry, card: &mut Card) {
        let owner = card.maybe_integer(entry.fields.first().map_or("", |f| &f.name));
        let owner = owner.map_or(entry.name.clone(), |id| format!("{} {id}", entry.name));
        while let Some(record) = self.next_record() {
            if self.diagnostics.is_full() {
                self.pending = Some(record);
                return;
            }
            if record.fields[0].is_word() && record.fields[0].text == END {
                return self.end_of_group(&record);
            }
            if self.is_next_command(entry, &record.fields) {
                self.diagnostics.push(
                    Diagnostic::error(format!("{owner} is not closed: there is no END before the next command"))
                        .at(record.span(), "this is a command of its own; END belongs above this line")
                        .at(card.span, format!("{} starts here", entry.name)),
                );
                self.pending = Some(record);
                card.complete = false;
                return;
            }
            let row = self.row(entry, &owner, record, card);
            card.rows.push(row);
        }
        card.complete = false;
        self.diagnostics.push(
            Diagnostic::error(format!("{owner} is not closed: the file ends without its END"))
                .at(card.record, format!("{} starts here", entry.name)),
        );
    }

    fn end_of_group(&mut self, record: &Record) {
        if let [_, first, .., last] | [_, first @ last] = &record.fields[..] {
            self.diagnostics.push(
                Diagnostic::error("END stands alone on its line").at(first.span.join(last.span), "this is not read"),
            );
        }
    }

    fn row(&mut self, entry: &Entry, owner: &str, record: Record, card: &mut Card) -> Row {
        let mut numbers = Vec::new();
        if entry.status == Status::Built && !entry.columns.is_empty() {
            let form = entry.columns.iter().map(|c| c.syntax()).collect::<Vec<_>>().join(", ");
            let form = format!("{form} on each line, then END");
            let end = Span { start: record.span().end, end: record.span().end };
            let mut reader = FieldReader { owner, form: &form, end, diagnostics: &mut self.diagnostics };
            let (values, complete) = reader.read(&entry.columns, &record.fields);
            card.complete &= complete;
            numbers = values.iter().filter_map(|(_, items)| items.first()?.value.number()).collect();
        }
        Row { fields: record.fields, numbers }
    }

    /// Whether a line inside a group can only be the next command: the END has been forgotten.
    fn is_next_command(&self, group: &Entry, fields: &[Field]) -> bool {
        if group.columns.is_empty() {
            self.exact_command(fields).is_some_and(|(entry, words)| begins_well(entry, &fields[words..]))
        } else {
            fields[0].is_word() && matches!(self.recognise(fields), Spelled::As { .. })
        }
    }

    /// The command that a record spells in full, and in how many words.
    fn exact_command(&self, fields: &[Field]) -> Option<(&'a Entry, usize)> {
        match self.recognise(fields) {
            Spelled::As { what, words, agreement: Agreement::Exact, .. } => Some((&self.grammar.entries[what], words)),
            _ => None,
        }
    }

    fn check_once(&mut self, entry: &Entry, card: &Card) {
        let Some(first) = self.cards.iter().find(|c| entry.once && c.complete && c.name == card.name) else { return };
        if !card.complete {
            return;
        }
        let diagnostic = if first.says_the_same(card) {
            Diagnostic::warning(format!("{} is given twice; both say the same", entry.name))
        } else {
            Diagnostic::error(format!("{} is given twice, and differently", entry.name))
        };
        self.diagnostics.push(diagnostic.at(card.record, "the second one").at(first.record, "the first one"));
    }

    fn after_exit(&mut self, exit: &Record) {
        let at = exit.fields[0].span;
        if let Some(extra) = exit.fields.get(1) {
            self.diagnostics
                .push(Diagnostic::error("EXIT stands alone on its line").at(extra.span, "this is not read"));
        }
        if let Some(record) = self.lexer.next_record() {
            self.diagnostics.push(
                Diagnostic::warning("nothing after EXIT is read")
                    .at(record.span(), "this and what follows is left out")
                    .at(at, "the file ends here"),
            );
        }
    }

    fn note_unbuilt(&mut self, entry: &'a Entry, place: Span) {
        match self.unbuilt.iter_mut().find(|(e, _)| e.name == entry.name) {
            Some((_, places)) => places.push(place),
            None => self.unbuilt.push((entry, vec![place])),
        }
    }

    /// One message per entry that every deck needs and this one lacks.
    fn report_missing(&mut self) {
        for entry in self.grammar.entries.iter().filter(|e| e.required) {
            if self.cards.iter().all(|card| card.name != entry.name) {
                self.diagnostics.push(
                    Diagnostic::error(format!("the deck has no {}", entry.name))
                        .help(entry.does.clone())
                        .help(format!("for example: {}", entry.example.first().map_or("", String::as_str))),
                );
            }
        }
    }

    /// One message per entry that cannot be used, however often it stands in the deck.
    fn report_unbuilt(&mut self) {
        for (entry, places) in std::mem::take(&mut self.unbuilt) {
            let lines: Vec<String> = places.iter().map(|p| self.source.line_name(p.start)).collect();
            let mut diagnostic = unbuilt(entry).at(places[0], entry.does.trim_end_matches('.'));
            if places.len() > 1 {
                diagnostic = diagnostic.help(format!("it stands on lines {}", spelling::all(&lines)));
            }
            self.diagnostics.push(diagnostic);
        }
    }
}

/// The word that closes a group.
pub(super) const END: &str = "END";
/// The command that ends a deck.
const EXIT: &str = "EXIT";

/// Whether the first field after a command's words is of the kind that the command expects there.
fn begins_well(entry: &Entry, fields: &[Field]) -> bool {
    match (entry.fields.first().map(|rule| &rule.kind), fields.first()) {
        (None, _) => entry.status != Status::Built || fields.is_empty(),
        (Some(Kind::Number | Kind::Integer | Kind::Id(_)), Some(field)) => field.number().is_some(),
        (Some(Kind::IdOrAll(_)), Some(field)) => field.number().is_some() || field.text == "ALL",
        (Some(Kind::NumberOr(word)), Some(field)) => field.number().is_some() || field.text == *word,
        (Some(Kind::Choice(choices)), Some(_)) => {
            choices.iter().any(|choice| spelling::agreement(fields, &choice.name).is_some())
        }
        (Some(_), Some(_)) => true,
        (Some(kind), None) => *kind == Kind::NextLine,
    }
}

/// The message for a command that is known but cannot be used.
fn unbuilt(entry: &Entry) -> Diagnostic {
    let name = &entry.name;
    match &entry.status {
        Status::Refused(why) => {
            let advice = entry.notes.iter();
            advice.fold(Diagnostic::error(format!("{name}: {why}")), |d, note| d.help(note.trim_end_matches('.')))
        }
        Status::Idle(why) => Diagnostic::warning(format!("{name} changes nothing: {why}")),
        Status::Planned { physics: false } => {
            Diagnostic::warning(format!("{name} is known, but not built yet: the run goes on without it"))
                .help("the results do not change, only what is written")
        }
        _ => Diagnostic::error(format!("{name} is known, but not built yet"))
            .help("without it this would be another problem than the one you describe, so it does not run")
            .help("take the line out, or put a $ before it, to run without it"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CARDS: &str = "
command   TITLE
does      Names it.
field     title       next-line   required   any   -   title

command   PLOT TIME
does      Sets the interval.
field     dt          number   required   > 0    time   interval
field     start       number   0.0        >= 0   time   first
field     stop        number   2 x end    > 0    time   last

command   HOLD
does      Holds things.
field     direction   direction   required   any   -   direction held
field     sets...     node-set    required   any   -   sets held

group     FUNCTION
does      A function.
field     id          integer  required   > 0   -   its number
column    t           number   required   any   time   time
column    f           number   required   any   -      value

command   CONTACT SURFACE
does      Couples two sides.
status    planned physics
";

    fn read(text: &str) -> (Deck, Diagnostics) {
        let grammar = Grammar::from_cards(&[("test", CARDS)]).expect("the cards are right");
        Deck::read(Source::new("t.i", text), &grammar)
    }

    #[test]
    fn typed_fields_with_defaults() {
        let (deck, diagnostics) =
            read("title\n Any, $ line\nplo time = 1.D-3,,\nhold y, 1, 2\nFUNCTION 7\n0 1\n2., 3\nEND\n");
        assert_eq!(diagnostics.render(false), "");
        assert_eq!(diagnostics.notes().count(), 1);
        assert_eq!(deck.cards[0].text("title"), " Any, $ line");
        assert_eq!((deck.cards[1].number("dt"), deck.cards[1].number("start")), (1e-3, 0.0));
        assert_eq!((deck.cards[1].maybe_number("stop"), deck.cards[1].given("start")), (None, false));
        assert_eq!(deck.cards[2].text("direction"), "Y");
        let sets: Vec<_> = deck.cards[2].items("sets").iter().filter_map(|item| item.value.integer()).collect();
        assert_eq!(sets, [1, 2]);
        assert_eq!(deck.cards[3].rows.iter().map(|r| r.numbers.clone()).collect::<Vec<_>>(), [[0.0, 1.0], [2.0, 3.0]]);
    }

    #[test]
    fn every_mistake_is_reported_with_its_place() {
        let text =
            "PLOT TIMES, FAST\nHOLD W 1\nHOLD X 1.5\nPLOT TIME\nCONTACT SURFACE 1 2\nFUNCTION 1\n0 1\nHOLD X 1\n";
        let (deck, diagnostics) = read(text);
        let messages: Vec<&str> = diagnostics.errors().map(|d| d.message.as_str()).collect();
        assert_eq!(
            messages,
            [
                "unknown command PLOT TIMES",
                "HOLD: direction is W; it must be X, Y or Z",
                "HOLD: sets is 1.5; it must be a whole number",
                "PLOT TIME: dt is missing",
                "FUNCTION 1 is not closed: there is no END before the next command",
                "CONTACT SURFACE is known, but not built yet",
            ]
        );
        assert_eq!(deck.cards.iter().filter(|card| card.complete).count(), 1);
    }
}
