//! Expressions in braces, evaluated before a deck is read: the part of aprepro's language that decks use.
//!
//! `{expression}` is replaced by its value, `{{expression}}` by nothing. Names are set by `{name = expression}`. Lines
//! between `{if(e)}`, `{elseif(e)}`, `{else}` and `{endif}`, or `{loop(n)}` and `{endloop}`, are taken or left or
//! repeated; `{include("file")}` is replaced by a file. Comments of the deck are evaluated like everything else. Other
//! than aprepro, this refuses what it cannot evaluate: a name without a value is not zero.
//!
//! [`blocks`] divides a file into lines and blocks, [`run`] works through them, [`lexer`] and [`expr`] understand what
//! stands in one pair of braces, [`functions`] is the list of functions, [`format`] writes numbers.

mod blocks;
mod eval;
mod expr;
mod format;
mod functions;
mod include;
mod lexer;
mod run;

use super::{
    definitions::Given,
    text::diagnostic::Diagnostic,
    text::source::{Source, Span},
};

/// What became of a text.
pub(super) struct Evaluated {
    /// The evaluated text, which leads back to the places that it came from.
    pub source: Source,
    /// What there is to say about the expressions.
    pub found: Vec<Diagnostic>,
    /// Whether the text can be read on. Where an expression is wrong it can, with a stand-in for the value; where blocks
    /// do not fit together it cannot.
    pub readable: bool,
}

/// Evaluates the expressions of a text. A text without braces is handed back as it is.
pub(super) fn evaluate(source: Source) -> Evaluated {
    if !source.text().contains('{') || source.text().contains('\0') {
        return Evaluated { source, found: Vec::new(), readable: true };
    }
    run::run(source)
}

/// Names of all functions, for the manual.
pub(super) fn functions() -> Vec<&'static str> {
    functions::FUNCTIONS.iter().map(|(name, _)| *name).collect()
}

/// Names that have a value before a deck gives them one, for the manual.
pub(super) fn constants() -> Vec<&'static str> {
    functions::CONSTANTS.iter().map(|(name, _)| *name).collect()
}

/// A value of an expression.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    /// A number; finite.
    Number(f64),
    /// A text.
    Text(String),
    /// The value of something with a mistake, which has been reported.
    Unknown,
}

impl From<&Given> for Value {
    fn from(given: &Given) -> Value {
        match given {
            Given::Number(number) => Value::Number(*number),
            Given::Text(text) => Value::Text(text.clone()),
        }
    }
}

/// Why an expression has no value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fault {
    /// A mistake, with its place in the file.
    Mistake(Box<Diagnostic>),
    /// It needs the value of something with a mistake, which has been reported.
    Consequence,
}

impl Fault {
    /// A mistake at a place.
    fn at(span: Span, message: impl Into<String>, label: impl Into<String>) -> Fault {
        Fault::Mistake(Box::new(Diagnostic::error(message).at(span, label)))
    }

    /// Adds advice; none where the text is empty.
    fn help(self, text: impl Into<String>) -> Fault {
        match self {
            Fault::Mistake(diagnostic) => Fault::Mistake(Box::new(diagnostic.help(text))),
            Fault::Consequence => Fault::Consequence,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The evaluated text, or the messages.
    fn text(deck: &str) -> String {
        let evaluated = evaluate(Source::new("t.i", deck));
        match evaluated.found.iter().map(|d| d.message.as_str()).collect::<Vec<_>>() {
            messages if messages.is_empty() => evaluated.source.text().to_string(),
            messages => messages.join("; "),
        }
    }

    #[test]
    fn values_stand_in_the_place_of_expressions() {
        assert_eq!(text("A {x = 2} B {x*3}\n"), "A 2 B 6\n");
        assert_eq!(text("{{x = 2}}A {x}{# note}\n"), "A 2\n");
        assert_eq!(text("$ {E = 30.e6}\nY = {E}"), "$ 30000000\nY = 30000000");
        assert_eq!(text("a \\{x\\} {1}\r\nb"), "a {x} 1\r\nb");
        assert_eq!(text("{'}'}{\"{\"}"), "}{");
        assert_eq!(text("{}|{ }|{#}"), "||");
        assert_eq!(text("no braces } at all"), "no braces } at all");
    }

    #[test]
    fn names_may_have_a_value_from_the_start() {
        let deck = "{ifndef(ranks)}\n{ranks = 1}\n{endif}\n{18 * ranks}";
        assert_eq!(text(deck), "1\n18");
        let given = evaluate(Source::new("t.i", deck).with_value("ranks", 4));
        assert_eq!(given.source.text(), "72");
    }

    #[test]
    fn values_from_outside_stand_for_those_of_assignments() {
        let evaluated = |deck: &str| {
            let texts = ["n=7", "name=b"].map(str::to_string);
            let given = std::sync::Arc::new(crate::deck::Definitions::parse(&texts).expect("definitions"));
            let found = evaluate(Source::new("t.i", deck).with_definitions(&given));
            (found.source.text().to_string(), given.unused())
        };
        let used = |deck: &str| {
            let (text, unused) = evaluated(deck);
            assert!(unused.is_empty(), "{unused:?}");
            text
        };
        assert_eq!(used("{n = 4} {2 * n} {name = 'a'}"), "7 14 b");
        assert_eq!(used("{{n = 4}}{n++} {n} {name}"), "7 8 b");
        assert_eq!(used("{ifndef(n)}\n{n = 4}\n{endif}\n{n}{name}"), "7b");
        assert_eq!(evaluated("{n = 4} {m = 2}"), ("7 2".into(), vec!["name".into()]));
        assert_eq!(evaluated("no braces").1.len(), 2);
    }

    #[test]
    fn blocks_take_leave_and_repeat_lines() {
        let deck = |n: &str| {
            format!("{{n={n}}}\n{{if(n > 2)}}\nlarge\n{{elseif(n > 1)}}\nmiddle\n$ {{else}}\nsmall\n{{endif}}\nend\n")
        };
        assert_eq!(text(&deck("3")), "3\nlarge\nend\n");
        assert_eq!(text(&deck("2")), "2\nmiddle\nend\n");
        assert_eq!(text(&deck("1")), "1\nsmall\nend\n");
        assert_eq!(text("{loop(3)}\n{i++} {i}\n{endloop}\n"), "i has no value");
        assert_eq!(text("{{i = 5}}\n{Loop(3)}\n{i++}\n{EndLoop}\n{i}"), "\n5\n6\n7\n8");
        assert_eq!(
            text("{loop(2, i, 10, 5)}\n{loop(2, j)}\n{i},{j}\n{endloop}\n{endloop}"),
            "10,0\n10,1\n15,0\n15,1\n"
        );
        assert_eq!(text("{ifdef(x)}\nyes\n{else}\nno\n{endif}\n"), "no\n");
        assert_eq!(text("{{x=0}}\n{ifndef(x)}\nyes\n{endif}\n"), "\nyes\n");
        assert_eq!(text("{if(0)}\n{undefined}\n{endif}\nx"), "x");
    }

    #[test]
    fn echo_and_verbatim_switch() {
        assert_eq!(text("a{ECHO(OFF)}\n{x=1}\n{ECHO(ON)}b{x}"), "ab1");
        assert_eq!(text("{VERBATIM(ON)}\n{x} {\n$ {VERBATIM(OFF)}\n{1}"), "{x} {\n1");
    }

    #[test]
    fn files_are_put_in() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
        write("top.i", "{include(\"a.inc\")}\n{x} {cinclude('none')}{include(name)}end");
        write("a.inc", "$ {x = 7}\n$ {name = 'b.inc'}");
        write("b.inc", "B{x}\n");
        let evaluated = evaluate(Source::open(&folder.path().join("top.i")).expect("the deck"));
        assert_eq!(evaluated.source.text(), "$ 7\n$ b.inc\n7 B7\nend");
        // The byte after `B` came from the braces of b.inc.
        let (file, place) = evaluated.source.origin_of(Span { start: 15, end: 16 });
        assert!(file.name().ends_with("b.inc") && file.slice(place) == "{x}", "{place:?}");
        assert_eq!(evaluated.source.included_at(Span { start: 15, end: 16 }).len(), 1);
        write("a.inc", "\n{include('top.i')}");
        let evaluated = evaluate(Source::open(&folder.path().join("top.i")).expect("the deck"));
        assert_eq!(evaluated.found[0].message, "top.i includes itself");
        assert!(!evaluated.readable);
    }

    #[test]
    fn nothing_runs_for_ever() {
        assert_eq!(
            text("{loop(1e18)}\n{endloop}\n"),
            "this loop makes 1000000000000000000 passes; at most 2000000 are made"
        );
        let begun = std::time::Instant::now();
        let nested = "{loop(1e6)}\n".repeat(5) + &"{endloop}\n".repeat(5);
        assert_eq!(text(&nested), "the loops of this deck do not end within 2 million lines");
        assert_eq!(
            text(&("{loop(1e6)}\n".repeat(3) + "x\n" + &"{endloop}\n".repeat(3))),
            "the loops of this deck do not end within 2 million lines"
        );
        assert!(begun.elapsed().as_secs() < 20);
        assert_eq!(text(&"{if(1)}\n".repeat(500)), "blocks are nested too deep");
        assert_eq!(text("{s = 'aaaaaaaaaa'}\n{loop(30)}\n{{s = s // s}}\n{endloop}\n"), "this text is too long");
    }
}
