//! Decks and expressions that nobody would write: a hundred thousand mutilated decks, and expressions without measure, are answered.

use crate::decks::{EXPRESSIONS, LEAST, OLD_MANNER};
use crate::fixtures::{problem, two_blocks};
use proptest::prelude::*;
use std::fs;
use urto::{deck::Source, model::examine};

/// Pieces that a mutation puts into a deck.
const PIECES: &[&str] = &[
    "\n",
    ",",
    "=",
    " ",
    "*",
    "$",
    "'",
    "''",
    "END",
    "\nEND\n",
    "MATERIAL",
    "FUNCTION",
    "TITLE",
    "\nTITLE",
    "PLOT",
    "1E999",
    "-1",
    "0",
    "1.5+3",
    "99999999999999999999",
    "\u{2212}1",
    "\u{fffd}",
    "\0",
    "\r\n",
    "\t",
    "\u{feff}",
    "\u{df}",
    "{x}",
    "XYZ",
    "{",
    "}",
    "{{",
    "}}",
    "\\{",
    "{x = 2}",
    "{x++}",
    "{1/0}",
    "{\"a\"//'b'}",
    "(",
    ")",
    "?",
    ":",
    "++",
    "\n{if(x > 1)}\n",
    "\n{else}\n",
    "\n{endif}\n",
    "\n{loop(3)}\n",
    "\n{endloop}\n",
    "{include(\"tests/language/wrong_decks/include/times.inc\")}",
    "{ECHO(OFF)}",
    "\n{VERBATIM(ON)}\n",
];

/// Applies one mutation: deletes, repeats or cuts a stretch, or puts a piece in. Positions are taken modulo the length.
fn mutate(text: &mut Vec<char>, (kind, at, length, piece): (u8, usize, usize, usize)) {
    let at = at % (text.len() + 1);
    let end = (at + length).min(text.len());
    match kind % 4 {
        0 => drop(text.drain(at..end)),
        1 => text.extend_from_within(at..end),
        2 => text.truncate(text.len() - length.min(text.len()) / 8),
        _ => drop(text.splice(at..at, PIECES[piece % PIECES.len()].chars())),
    }
}

/// What an expression or a block can hold another of, before it and after it.
const SHELLS: &[(&str, &str)] = &[
    ("(", ")"),
    ("-", ""),
    ("!", ""),
    ("1+", ""),
    ("", "-1"),
    ("1*1+", ""),
    ("2^", ""),
    ("", "^1"),
    ("1<", ""),
    ("1&&", ""),
    ("", "||0"),
    ("'a'//", ""),
    ("", "//''"),
    ("x=", ""),
    ("x+=", ""),
    ("++", ""),
    ("1?", ":1"),
    ("0?1:", ""),
    ("sqrt(", ")"),
    ("max(1,", ",2)"),
    ("1,", ""),
    ("}{", ""),
    ("\\{", "\\}"),
    ("\n{if(1)}\n", "\n{endif}\n"),
    ("\n{else}\n", ""),
    ("\n{loop(1)}\n", "\n{endloop}\n"),
];

/// Expressions as long and as deep as nobody writes them, on a stack of two megabytes, as every test has: in decks and in
/// recipes they have a value or are refused.
#[test]
fn long_and_deep_expressions_are_answered() {
    let shells = prop::collection::vec((0..SHELLS.len(), prop_oneof![1usize..5, 90usize..110, 1usize..15_000]), 1..4);
    let cores = prop::sample::select(vec!["1", "'a'", "x", "", "1 2", "(", "f(1)"]);
    let mut cases = proptest::test_runner::TestRunner::new(ProptestConfig::with_cases(500));
    let outcome = cases.run(&(shells, cores, any::<bool>()), |(shells, core, closed)| {
        let mut expression = core.to_string();
        for (shell, count) in shells {
            let (before, after) = SHELLS[shell];
            expression = [&before.repeat(count), expression.as_str(), &after.repeat(count)].concat();
        }
        let brace = if closed { "}" } else { "" };
        let deck = format!("{LEAST}$ {{{{x = 1}}}}{{{expression}{brace}\n");
        if let Err(messages) = examine(Source::new("t.i", deck), None) {
            prop_assert!(!messages.render(false).is_empty());
        }
        // A box that lacks most of its fields, so that no number makes it a large mesh.
        let recipe = format!("BOX, {{{expression}{brace}\n");
        prop_assert!(urto::mesher::make(&recipe, "t.mesh", 1).is_err());
        Ok(())
    });
    outcome.unwrap_or_else(|why| panic!("{why}"));
    let sum = format!("{{1{}}}", "+1".repeat(11_999));
    assert_eq!(problem(&LEAST.replace("TIME 1", &format!("TIME {sum}"))).model.termination_time, 12_000.0);
}

#[test]
fn a_hundred_thousand_mutilated_decks_are_answered() {
    let seeds = [OLD_MANNER, &fs::read_to_string("decks/commands.i").expect("a deck of ours"), EXPRESSIONS];
    let mesh = two_blocks();
    let mutations = prop::collection::vec((any::<u8>(), any::<usize>(), 0usize..60, any::<usize>()), 1..8);
    let mut cases = proptest::test_runner::TestRunner::new(ProptestConfig::with_cases(100_000));
    let outcome = cases.run(&(0usize..3, mutations), |(seed, mutations)| {
        let mut text: Vec<char> = seeds[seed].chars().collect();
        mutations.into_iter().for_each(|mutation| mutate(&mut text, mutation));
        let text: String = text.into_iter().collect();
        let messages = match examine(Source::new("t.i", text), Some(&mesh)) {
            Ok(problem) => {
                for block in &mesh.blocks {
                    let materials = &problem.model.materials;
                    prop_assert!(materials.iter().any(|m| m.block == block.id), "block {} has no law", block.id);
                }
                problem.diagnostics
            }
            Err(messages) => messages,
        };
        for label in messages.errors().flat_map(|diagnostic| &diagnostic.labels) {
            let (file, span) = messages.source().origin_of(label.span);
            prop_assert!(file.text().get(span.start..span.end).is_some(), "a span cuts a character");
        }
        messages.render(false);
        Ok(())
    });
    outcome.unwrap_or_else(|why| panic!("{why}"));
}
