//! The input language as data: `grammar/*.cards` read into a table of entries.
//!
//! A card file is a list of entries. Every line is a directive and its text; columns of a line are set apart by two
//! or more blanks; `#` starts a comment line.
//!
//! ```text
//! command   PRESSURE                        or `group`, closed by END, or `material`, a name MATERIAL knows
//! alias     PRESSURE LOAD                   another spelling
//! does      One sentence.
//! field     name   kind   default   range   unit   meaning
//! value     WORDS   meaning                 one value of the choice field above
//! planned   WORDS   meaning                 one that is not built yet and changes output only
//! elsewhere WORDS   advice                  one that is looked for here but belongs to another command
//! column    name   kind   default   range   unit   meaning        of the number lines in a group
//! body      properties                      the lines of a group are `KEYWORD value`
//! required                                  every deck needs one
//! once                                      a second one must not differ
//! plane                                     makes a deck two-dimensional
//! space     z0, nz                          fields that two-dimensional decks do not have; alone, all of the entry
//! shapes    surfaces, bars   shells, trusses and beams        shapes of the elements of `block` that it says something of
//! always                                    takes effect with its defaults when it is not given
//! note      A sentence for the manual.
//! example   PRESSURE, 100, 1                one line of an example
//! see       GRAVITY, RIGID SURFACE
//! from      verified | recalled | ours
//! status    planned physics | planned output | refused <why> | idle <why>
//! ```
//!
//! A field's name may end in `...`: it takes all fields that are left. Its default is `required`, `optional`, a value,
//! or words that say what the default follows from. Ranges are `any`, `> 0`, `>= 0`, or an interval `(0, 1]`.

use std::sync::Arc;

use crate::common::vocabulary::{Origin, Range};
use crate::deck::{
    card::Card,
    commands::fields::FieldReader,
    text::diagnostic::Diagnostics,
    text::source::{Source, Span},
};

/// All entries of a language, in the order of the files.
#[derive(Debug, Clone, Default)]
pub struct Grammar {
    /// The entries.
    pub entries: Vec<Entry>,
}

/// A command, a group or a material name.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Its words in upper case, one blank between them.
    pub name: String,
    /// What kind of entry it is.
    pub form: Form,
    /// The file it stands in, without `.cards`.
    pub family: String,
    /// Other spellings.
    pub aliases: Vec<String>,
    /// What it does, one or two sentences.
    pub does: String,
    /// Its fields in order.
    pub fields: Vec<FieldRule>,
    /// The columns of the number lines of a group.
    pub columns: Vec<FieldRule>,
    /// Whether every deck needs one.
    pub required: bool,
    /// Whether a second one must not differ from the first.
    pub once: bool,
    /// Whether its defaults hold when it is not given.
    pub always: bool,
    /// Whether it makes a deck two-dimensional.
    pub plane: bool,
    /// Names of the fields that two-dimensional decks do not have.
    pub space: Vec<String>,
    /// Whether two-dimensional decks do not have the entry at all.
    pub of_space: bool,
    /// Shapes of the elements of its block that it says something of, and what these are called; none where it is of all.
    pub shapes: Option<(Vec<String>, String)>,
    /// Fields that the deck cannot give: they have their defaults.
    pub filled: Vec<FieldRule>,
    /// More for the manual.
    pub notes: Vec<String>,
    /// Lines of an example.
    pub example: Vec<String>,
    /// Names of related entries.
    pub see: Vec<String>,
    /// Where the spelling comes from.
    pub from: Origin,
    /// Whether it can be used.
    pub status: Status,
}

/// The shape of an entry in a deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// One record.
    Command,
    /// A record, lines, and END.
    Group,
    /// A name in the second field of MATERIAL.
    Material,
}

/// Whether an entry can be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Status {
    /// It can.
    Built,
    /// Not yet; `physics` tells whether leaving it out changes the problem, or only what is written.
    Planned {
        /// Whether it changes the problem.
        physics: bool,
    },
    /// It never will, and why.
    Refused(String),
    /// It is read and checked, but changes nothing, and why.
    Idle(String),
}

/// What a field may hold.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRule {
    /// Its name in the manual and in the code, one word.
    pub name: String,
    /// Whether it takes all fields that are left.
    pub repeats: bool,
    /// What kind of value it takes.
    pub kind: Kind,
    /// What holds when it is null or absent.
    pub default: Absent,
    /// Numbers that make sense.
    pub range: Range,
    /// Dimension in words, `-` for a pure number, empty for what has none.
    pub unit: String,
    /// What it means, one sentence.
    pub meaning: String,
}

/// What kind of value a field takes.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// A real number.
    Number,
    /// A real number, or this word.
    NumberOr(&'static str),
    /// A whole number.
    Integer,
    /// The number of something: "block", "node set", "side set", "function"; at least 0, of functions 1.
    Id(&'static str),
    /// The same, or the word ALL.
    IdOrAll(&'static str),
    /// One of some words.
    Choice(Vec<Choice>),
    /// All words up to the first field that is none.
    Words,
    /// One word or quoted text, taken as it is.
    Name,
    /// The next line of the deck as it stands.
    NextLine,
}

/// One value of a choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Its words.
    pub name: String,
    /// What it means.
    pub meaning: String,
    /// Whether it can be used.
    pub standing: Standing,
    /// Whether PRONTO does not have it: then abbreviations that could mean it mean what PRONTO has.
    pub ours: bool,
}

/// Whether a value of a choice can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// It can.
    Built,
    /// Known but not built yet; leaving it out only changes what is written.
    Planned,
    /// It belongs to another command, which its meaning names.
    Elsewhere,
}

/// What holds when a field is null or absent.
#[derive(Debug, Clone, PartialEq)]
pub enum Absent {
    /// An error.
    Required,
    /// Nothing: the field has no value.
    Optional,
    /// This text, read as if it stood in the deck.
    Value(String),
    /// No value of its own; the words say what it follows from.
    Follows(String),
}

impl Grammar {
    /// Reads card files given as `(family, text)`. An error names the file, the line and what is wrong.
    ///
    /// # Errors
    ///
    /// A card that is not written as cards are.
    pub fn from_cards(files: &[(&str, &str)]) -> Result<Grammar, String> {
        let mut grammar = Grammar::default();
        for (family, text) in files {
            for (number, line) in text.lines().enumerate() {
                let line = line.trim();
                if !line.is_empty() && !line.starts_with('#') {
                    grammar.directive(family, line).map_err(|why| format!("{family}.cards:{}: {why}", number + 1))?;
                }
            }
        }
        Ok(grammar)
    }

    /// The entry with this name.
    pub fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|e| e.name == name)
    }

    /// Entries that can stand at the start of a record.
    pub fn commands(&self) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(|e| e.form != Form::Material)
    }

    fn directive(&mut self, family: &str, line: &str) -> Result<(), String> {
        let (word, text) = line.split_once(' ').unwrap_or((line, ""));
        let text = text.trim();
        let form = match word {
            "command" => Some(Form::Command),
            "group" => Some(Form::Group),
            "material" => Some(Form::Material),
            _ => None,
        };
        if let Some(form) = form {
            if self.entry(text).is_some() {
                return Err(format!("a second entry {text}"));
            }
            self.entries.push(Entry::new(family, text, form));
            return Ok(());
        }
        self.entries.last_mut().ok_or("no entry yet")?.directive(word, text)
    }
}

impl Entry {
    fn new(family: &str, name: &str, form: Form) -> Entry {
        Entry {
            name: name.to_string(),
            form,
            family: family.to_string(),
            aliases: Vec::new(),
            does: String::new(),
            fields: Vec::new(),
            columns: Vec::new(),
            required: false,
            once: false,
            always: false,
            plane: false,
            space: Vec::new(),
            of_space: false,
            shapes: None,
            filled: Vec::new(),
            notes: Vec::new(),
            example: Vec::new(),
            see: Vec::new(),
            from: Origin::Ours,
            status: Status::Built,
        }
    }

    /// The field with this name.
    pub fn field(&self, name: &str) -> Option<&FieldRule> {
        self.fields.iter().find(|f| f.name == name)
    }

    /// Its name and aliases.
    pub fn spellings(&self) -> impl Iterator<Item = &str> {
        std::iter::once(&self.name).chain(&self.aliases).map(String::as_str)
    }

    /// The card of this entry with nothing but its defaults.
    pub fn default_card(&self) -> Card {
        let source = Arc::new(Source::new("", ""));
        let mut nobody = Diagnostics::new(source);
        let mut reader = FieldReader { owner: "", form: "", end: Span::default(), diagnostics: &mut nobody };
        let (values, complete) = reader.read(&self.fields, &[]);
        Card { name: self.name.clone(), complete, values, ..Card::default() }
    }

    /// The form of its record: `PLOT TIME, dt, <start [0.0]>, <stop [2 x termination time]>`.
    pub fn syntax(&self) -> String {
        self.fields.iter().fold(self.name.clone(), |text, field| match field.kind {
            Kind::NextLine => format!("{text}   and on the next line: {}", field.label()),
            _ => format!("{text}, {}", field.syntax()),
        })
    }

    fn directive(&mut self, word: &str, text: &str) -> Result<(), String> {
        match word {
            "alias" => self.aliases.push(text.to_string()),
            "does" if self.does.is_empty() => self.does = text.to_string(),
            "does" => self.does = format!("{} {text}", self.does),
            "field" => self.fields.push(FieldRule::read(text)?),
            "column" => self.columns.push(FieldRule::read(text)?),
            "value" => self.add_choice(text, Standing::Built, false)?,
            "added" => self.add_choice(text, Standing::Built, true)?,
            "planned" => self.add_choice(text, Standing::Planned, false)?,
            "elsewhere" => self.add_choice(text, Standing::Elsewhere, false)?,
            "body" if text == "properties" => (),
            "required" => self.required = true,
            "once" => self.once = true,
            "always" => self.always = true,
            "plane" => self.plane = true,
            "space" if text.is_empty() => self.of_space = true,
            "space" => self.space = listed(text),
            "shapes" => self.shapes = Some(shapes(text)?),
            "note" => self.notes.push(text.to_string()),
            "example" => self.example.push(text.to_string()),
            "see" => self.see = listed(text),
            "from" => self.from = origin(text)?,
            "status" => self.status = status(text)?,
            _ => return Err(format!("unknown directive `{word}`")),
        }
        Ok(())
    }

    fn add_choice(&mut self, text: &str, standing: Standing, ours: bool) -> Result<(), String> {
        let [words, meaning] = columns(text)[..] else { return Err("value: two columns expected".into()) };
        let Some(FieldRule { kind: Kind::Choice(choices), .. }) = self.fields.last_mut() else {
            return Err("value: the field above is no choice".into());
        };
        choices.push(Choice { name: words.to_string(), meaning: meaning.to_string(), standing, ours });
        Ok(())
    }
}

/// Names that commas set apart.
fn listed(text: &str) -> Vec<String> {
    text.split(',').map(|name| name.trim().to_string()).collect()
}

/// Shapes of elements, and what elements of these shapes are called.
fn shapes(text: &str) -> Result<(Vec<String>, String), String> {
    let [shapes, called] = columns(text)[..] else { return Err("shapes: two columns expected".into()) };
    Ok((listed(shapes), called.to_string()))
}

impl FieldRule {
    /// `name` if it must be given, `<name [default]>` if not.
    pub fn syntax(&self) -> String {
        let name = self.name.replace('_', " ") + if self.repeats { ", ..." } else { "" };
        match &self.default {
            Absent::Required => name,
            Absent::Optional => format!("<{name}>"),
            Absent::Value(value) | Absent::Follows(value) => format!("<{name} [{value}]>"),
        }
    }

    fn read(text: &str) -> Result<FieldRule, String> {
        let [name, kind, default, range, unit, meaning] = columns(text)[..] else {
            return Err("six columns expected: name, kind, default, range, unit, meaning".into());
        };
        let kind = read_kind(kind)?;
        Ok(FieldRule {
            name: name.trim_end_matches("...").to_string(),
            repeats: name.ends_with("..."),
            default: read_default(default, &kind),
            kind,
            range: read_range(range)?,
            unit: unit.to_string(),
            meaning: meaning.to_string(),
        })
    }
}

impl Choice {
    fn plain(name: &str) -> Choice {
        Choice { name: name.to_string(), meaning: String::new(), standing: Standing::Built, ours: false }
    }
}

/// Splits a line where two or more blanks stand.
fn columns(text: &str) -> Vec<&str> {
    text.split("  ").map(str::trim).filter(|column| !column.is_empty()).collect()
}

fn read_kind(text: &str) -> Result<Kind, String> {
    Ok(match text {
        "number" => Kind::Number,
        "number-or-fixed" => Kind::NumberOr("FIXED"),
        "integer" => Kind::Integer,
        "block" => Kind::Id("block"),
        "block-or-all" => Kind::IdOrAll("block"),
        "node-set" => Kind::Id("node set"),
        "side-set" => Kind::Id("side set"),
        "function" => Kind::Id("function"),
        "choice" => Kind::Choice(Vec::new()),
        "direction" => Kind::Choice(["X", "Y", "Z"].map(Choice::plain).to_vec()),
        "words" => Kind::Words,
        "name" => Kind::Name,
        "next-line" => Kind::NextLine,
        _ => return Err(format!("unknown kind `{text}`")),
    })
}

fn read_default(text: &str, kind: &Kind) -> Absent {
    let is_value = match kind {
        Kind::Number | Kind::NumberOr(_) | Kind::Integer | Kind::Id(_) | Kind::IdOrAll(_) => {
            crate::deck::text::number::parse(text).is_some()
        }
        _ => text.chars().all(|c| c.is_ascii_uppercase() || c == ' '),
    };
    match text {
        "required" => Absent::Required,
        "optional" => Absent::Optional,
        _ if is_value => Absent::Value(text.to_string()),
        _ => Absent::Follows(text.to_string()),
    }
}

fn read_range(text: &str) -> Result<Range, String> {
    let interval = || {
        let low_included = text.starts_with('[');
        let high_included = text.ends_with(']');
        let (low, high) = text.strip_prefix(['[', '('])?.strip_suffix([']', ')'])?.split_once(',')?;
        let (low, high) = (low.trim().parse().ok()?, high.trim().parse().ok()?);
        Some(Range::Between { low: (low, low_included), high: (high, high_included) })
    };
    match text {
        "any" => Ok(Range::Any),
        "> 0" => Ok(Range::Positive),
        ">= 0" => Ok(Range::NotNegative),
        _ => interval().ok_or_else(|| format!("unknown range `{text}`")),
    }
}

fn origin(text: &str) -> Result<Origin, String> {
    match text {
        "verified" => Ok(Origin::Verified),
        "recalled" => Ok(Origin::Recalled),
        "ours" => Ok(Origin::Ours),
        _ => Err(format!("unknown origin `{text}`")),
    }
}

fn status(text: &str) -> Result<Status, String> {
    match text.split_once(' ') {
        Some(("planned", "physics")) => Ok(Status::Planned { physics: true }),
        Some(("planned", "output")) => Ok(Status::Planned { physics: false }),
        Some(("refused", why)) => Ok(Status::Refused(why.to_string())),
        Some(("idle", why)) => Ok(Status::Idle(why.to_string())),
        _ => Err(format!("unknown status `{text}`")),
    }
}
