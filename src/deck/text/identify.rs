//! Which entry a record belongs to, and what to say when there is none.

use crate::deck::{
    commands::grammar::{Entry, Form, Status},
    reader::{END, Reader},
    text::diagnostic::Diagnostic,
    text::lexer::{Field, FieldKind, Record},
    text::spelling::{self, Agreement, Spelled},
};

/// The entry a record belongs to.
pub(in crate::deck) struct Found<'a> {
    pub entry: &'a Entry,
    /// Number of fields that name it.
    pub words: usize,
    /// False when the entry is only a guess, made to keep in step; the mistake has been reported.
    pub sure: bool,
}

impl<'a> Reader<'a> {
    pub(in crate::deck) fn recognise(&self, fields: &[Field]) -> Spelled<usize> {
        let entries = self.grammar.entries.iter().enumerate().filter(|(_, e)| e.form != Form::Material);
        spelling::recognise(fields, entries.flat_map(|(i, e)| e.spellings().map(move |s| (s, i))))
    }

    /// Finds the entry of a record, or reports why there is none.
    pub(in crate::deck) fn identify(&mut self, record: &Record) -> Option<Found<'a>> {
        let fields = &record.fields;
        if !fields[0].is_word() {
            self.not_a_word(record);
            return None;
        }
        match self.recognise(fields) {
            Spelled::As { what, name, words, agreement } => {
                let entry = &self.grammar.entries[what];
                if agreement == Agreement::Abbreviated || name != entry.name {
                    let span = fields[0].span.join(fields[words - 1].span);
                    let read = format!("assumed {} for `{}`", entry.name, self.source.slice(span));
                    self.diagnostics.push(Diagnostic::note(read).at(span, ""));
                }
                Some(Found { entry, words, sure: true })
            }
            Spelled::Several(names) => {
                let words = spelling::shown(&fields[..1]);
                self.diagnostics.push(Diagnostic::unclear(words, &names, fields[0].span));
                None
            }
            Spelled::Nothing => self.unknown(fields),
        }
    }

    fn not_a_word(&mut self, record: &Record) {
        let field = &record.fields[0];
        let what = match field.kind {
            FieldKind::Null => "a separator".to_string(),
            FieldKind::Quoted { .. } => "quoted text".to_string(),
            _ => spelling::shown(&record.fields[..1]),
        };
        self.diagnostics.push(
            Diagnostic::error(format!("a command starts with a word; this line starts with {what}"))
                .at(record.span(), "expected a command")
                .help("if this continues the line above, end that line with *")
                .help("if it belongs to a group, check that END does not stand too early"),
        );
    }

    /// Reports an unknown command; returns the entry it may be, if its further lines must be skipped with it.
    fn unknown(&mut self, fields: &[Field]) -> Option<Found<'a>> {
        if fields[0].text == END {
            self.diagnostics.push(
                Diagnostic::error("END closes nothing: no group is open here")
                    .at(fields[0].span, "the group above is closed already")
                    .help(format!("groups are {}", spelling::all(&self.group_names()))),
            );
            return None;
        }
        let followers = self.followers(fields);
        let commands = self.grammar.commands().flat_map(|e| e.spellings());
        let near = spelling::nearest_start(fields, commands);
        let all_words_known = followers.0 > 0 && !fields.get(followers.0).is_some_and(Field::is_word);
        if followers.0 > 0 && (all_words_known || near.is_none()) {
            self.unfinished(fields, followers);
            return None;
        }
        let owners = self.commands_with_field(&fields[0].text);
        if !owners.is_empty() && foreign(&fields[0].text).is_none() {
            let word = spelling::shown(&fields[..1]);
            self.diagnostics.push(
                Diagnostic::error(format!("unknown command {word}"))
                    .at(fields[0].span, "no command has this name")
                    .help(format!("{} is a field of {}", word.to_lowercase(), spelling::all(&owners))),
            );
            return None;
        }
        let (_, words) = near.unwrap_or(("", 1));
        let span = fields[0].span.join(fields[words - 1].span);
        let help = match (near, self.cut_too_short(fields)) {
            (Some((name, _)), _) => format!("did you mean {name}?"),
            (None, Some(name)) => {
                format!("did you mean {name}? an abbreviation needs at least three letters of each word")
            }
            (None, None) => foreign(&fields[0].text).unwrap_or("`urto explain` lists all commands").into(),
        };
        let shown = spelling::shown(&fields[..words]);
        self.diagnostics.push(
            Diagnostic::error(format!("unknown command {shown}")).at(span, "no command has this name").help(help),
        );
        let entry = self.grammar.commands().find(|e| e.spellings().any(|s| Some(s) == near.map(|n| n.0)))?;
        Some(Found { entry, words, sure: false })
    }

    /// Commands that have a field of this name.
    fn commands_with_field(&self, word: &str) -> Vec<&'a str> {
        let has = |entry: &&Entry| entry.fields.iter().any(|field| field.name.eq_ignore_ascii_case(word));
        self.grammar.commands().filter(|e| e.status == Status::Built).filter(has).map(|e| e.name.as_str()).collect()
    }

    /// The command whose words begin with these fields, when they are shorter than an abbreviation may be.
    fn cut_too_short(&self, fields: &[Field]) -> Option<&'a str> {
        let cut = |name: &&str| {
            let mut words = name.split(' ').zip(fields);
            name.split(' ').count() <= fields.len() && words.all(|(word, field)| word.starts_with(&field.text))
        };
        self.grammar.commands().map(|e| e.name.as_str()).find(cut)
    }

    /// How many leading fields agree with the first words of commands, and the words that can come next.
    fn followers(&self, fields: &[Field]) -> (usize, Vec<&'a str>) {
        let mut best = (0, Vec::new());
        for name in self.grammar.commands().map(|e| e.name.as_str()) {
            let words: Vec<&str> = name.split(' ').collect();
            let agreeing =
                (1..words.len()).rev().find(|&n| spelling::agreement(fields, &words[..n].join(" ")).is_some());
            let Some(n) = agreeing else { continue };
            if n > best.0 {
                best = (n, Vec::new());
            }
            if n == best.0 && !best.1.contains(&words[n]) {
                best.1.push(words[n]);
            }
        }
        best
    }

    fn unfinished(&mut self, fields: &[Field], (words, next): (usize, Vec<&str>)) {
        let span = fields[0].span.join(fields[words - 1].span);
        let shown = spelling::shown(&fields[..words]);
        let mut diagnostic = Diagnostic::error(format!("{shown} is only the beginning of a command"))
            .at(span, format!("expected {} after this", spelling::either(&next)));
        if let Some(field) = fields.get(words).filter(|f| f.is_word())
            && let Some(near) = spelling::nearest(&field.text, next)
        {
            diagnostic = diagnostic.help(format!("did you mean {near}?"));
        }
        self.diagnostics.push(diagnostic);
    }

    fn group_names(&self) -> Vec<&'a str> {
        let groups = self.grammar.entries.iter().filter(|e| e.form == Form::Group && e.status == Status::Built);
        groups.map(|e| e.name.as_str()).collect()
    }
}

/// Advice for words that other codes start a comment or a block with.
fn foreign(word: &str) -> Option<&'static str> {
    if word.starts_with(['#', '!', '%']) || word.starts_with("//") || word.starts_with("--") {
        Some("comments start with $")
    } else if word == "BEGIN" {
        Some("this looks like a Sierra deck; here a command is one line, and `urto explain` lists them")
    } else {
        None
    }
}
