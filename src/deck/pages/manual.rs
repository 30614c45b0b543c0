//! The manual page urto-deck(5), made from the tables that the reader works from.

use std::fmt::Write;

use crate::common::vocabulary::Models;
use crate::deck::{
    aprepro,
    commands::grammar::{Form, Grammar, Status},
    language,
    pages::page::{self, Body, Page},
};

/// What stands before the commands: the rules of writing.
const RULES: &str = r#".TH URTO-DECK 5 "" "urto" "File formats"
.SH NAME
urto-deck \- the command language of urto
.SH DESCRIPTION
A deck is a text file that describes a problem in commands, one on each line, in the manner of PRONTO.
The order of commands does not matter, but the lines of a group stand between its first line and END, and of several
INITIAL VELOCITY commands for a node the later one holds, or adds to those before it if it is ANGULAR.
.SS Lines
A line that ends in
.B *
goes on in the next one; what stands between the
.B *
and the end of the line is dropped.
A
.B $
starts a remark, which runs to the end of the line.
Empty lines mean nothing. Lines may have any length.
.SS Fields
Fields are separated by a comma, an equal sign or blanks:
.BR A=5 ", " "A = 5" ", " "A, 5" " and " "A 5"
are the same.
Two separators in a row hold an empty field between them, and an empty field takes its default, as does one that is left
out at the end of a line.
Small and capital letters are the same, except in a field that starts with a quote
.RB ( ' )
and runs to the next one; there, two quotes stand for one.
.SS Numbers
Numbers are written as in FORTRAN:
.BR 5 ", " 5. ", " .5 ", " \-1.2E\-3 ", " 1.D\-3 ", " 1.5+3 .
A number with the value of a whole number counts as one.
.SS Words
Each word of a command, a material model or a keyword may be shortened to its first letters, three at least, if it stays
clear what is meant. What was assumed is noted in the print log.
.SS Expressions
What stands in braces is evaluated before the deck is read, in comments too, in the manner of aprepro:
.PP
.RS
.nf
$ Young's modulus {E = 30.e6}, time of one transit {t = length / sqrt(E / rho)}
TERMINATION TIME, {4 * t}
.fi
.RE
.PP
A value is printed in the place of its braces, numbers in the format
.BR %.10g ,
or the one given by
.BR "{_FORMAT = \(dq%.6e\(dq}" .
Two pairs of braces,
.BR {{x=1}} ,
print nothing, and
.B \e{
is a brace as it stands.
A name that has no value is an error.
Small and capital letters differ in names.
.TP
.B Operators
.BR "+ \- * / %" ", " "^ **" " for powers, " "< > <= >= == !=" ", " "&& || !" ", " "condition ? a : b" ,
.BR "= += \-= *= /= ^= ++ \-\-" ,
and
.B //
to join texts, which stand in quotes.
.TP
.B Functions
@FUNCTIONS@.
.TP
.B Constants
@CONSTANTS@.
They can be given other values.
.TP
.B Blocks
.BR {if(e)} ,
.BR {ifdef(name)} " or " {ifndef(name)} ", " {elseif(e)} ", " {else} ", " {endif} ;
.BR "{loop(passes, name, start, step)}" ", " {endloop} .
Each stands alone on its line, or after a
.BR $ .
.TP
.B Files
.B {include(\(dqfile\(dq)}
puts a file in, which is looked for beside the file that includes it, then where the program runs.
.B {cinclude(\(dqfile\(dq)}
does not mind when there is none.
.TP
.B Switches
.BR {ECHO(OFF)} " to " {ECHO(ON)}
leave out what stands between, but evaluate it;
.BR {VERBATIM(ON)} " to " {VERBATIM(OFF)}
take it as it stands.
.PP
Messages point into the text as it was written. The print log and the results hold the deck as it was evaluated.
.SS Units
Any consistent set of units will do. Square brackets below give dimensions.
.SS Numbers of things
Blocks, node sets and side sets are called by the numbers they have in the mesh; functions by the number in FUNCTION.
"#;

/// Headings of the families, in the order of the card files.
const HEADINGS: &[(&str, &str)] = &[
    ("control", "CONTROL OF THE RUN"),
    ("material", "MATERIALS"),
    ("function", "FUNCTIONS"),
    ("boundary", "MOTIONS AND LOADS"),
    ("initial", "INITIAL STATE"),
    ("contact", "CONTACT AND RIGID SURFACES"),
    ("element", "ELEMENTS"),
    ("output", "OUTPUT"),
];

/// The manual page in roff, with the pages of these models behind those of the commands that choose from them.
pub fn manual(models: &[Models]) -> String {
    let grammar = language();
    let mut text = rules();
    for (family, heading) in HEADINGS {
        let mut pages = pages_of(grammar, family, models);
        let of_family = |kind: &&Models| grammar.entry(kind.command).is_some_and(|entry| entry.family == *family);
        for kind in models.iter().filter(of_family) {
            pages.extend(kind.models.iter().map(|model| page::of_model(kind, model)));
        }
        text += &chapter(heading, &pages);
    }
    text + &not_built(grammar) + ".SH SEE ALSO\n.BR urto (1),\n.BR urto\\-mesh (5)\n"
}

/// The rules of writing, with the names that expressions can use.
fn rules() -> String {
    RULES
        .replace("@FUNCTIONS@", &aprepro::functions().join(", "))
        .replace("@CONSTANTS@", &aprepro::constants().join(", "))
}

/// Chapters in roff for the families of a language that is all our own, given with their headings.
pub fn chapters(grammar: &Grammar, headings: &[(&str, &str)]) -> String {
    let chapter_of = |&(family, heading): &(&str, &str)| {
        let mut pages = pages_of(grammar, family, &[]);
        // Where nothing is PRONTO's, it need not be said of every command.
        pages.iter_mut().for_each(|page| page.sections.retain(|(title, _)| title != page::SPELLING));
        chapter(heading, &pages)
    };
    headings.iter().map(chapter_of).collect()
}

fn pages_of(grammar: &Grammar, family: &str, models: &[Models]) -> Vec<Page> {
    let built = grammar.commands().filter(|e| e.family == family && e.status == Status::Built);
    built.map(|entry| page::of_entry(entry, models)).collect()
}

fn chapter(heading: &str, pages: &[Page]) -> String {
    let heading = if pages.is_empty() { String::new() } else { format!(".SH {heading}\n") };
    heading + &pages.iter().map(roff).collect::<String>()
}

/// The list of what is known but cannot be used.
fn not_built(grammar: &Grammar) -> String {
    let mut text = String::from(
        ".SH KNOWN, BUT NOT BUILT\nA deck that has one of these does not run, unless it only changes what is written.\n",
    );
    for entry in grammar.entries.iter().filter(|e| e.status != Status::Built) {
        let what = if entry.form == Form::Material { " (material model)" } else { "" };
        let why = match &entry.status {
            Status::Planned { physics: false } => " Changes only what is written.".to_string(),
            Status::Refused(why) => format!(" Refused: {why}."),
            Status::Idle(why) => format!(" Read, but changes nothing: {why}."),
            _ => String::new(),
        };
        let _ = write!(text, ".TP\n.B {}{what}\n{}{}\n", escape(&entry.name), escape(&entry.does), escape(&why));
    }
    text
}

fn roff(page: &Page) -> String {
    let mut text = format!(".SS {}\n{}\n", escape(&page.title), escape(&page.summary));
    for (heading, body) in &page.sections {
        let _ = match body {
            Body::Lines(lines) => {
                let lines: Vec<String> = lines.iter().map(|line| escape(line)).collect();
                write!(text, ".PP\n{heading}:\n.PP\n.RS\n.nf\n{}\n.fi\n.RE\n", lines.join("\n"))
            }
            Body::Text(lines) => {
                let lines: Vec<String> = lines.iter().map(|line| escape(line)).collect();
                write!(text, ".PP\n{heading}: {}\n", lines.join("\n"))
            }
            Body::Terms(terms) => write!(text, ".PP\n{heading}:\n{}", terms.iter().map(term).collect::<String>()),
        };
    }
    text
}

fn term((term, meaning): &(String, String)) -> String {
    let lines: Vec<String> = meaning.lines().map(escape).collect();
    format!(".TP\n.B {}\n{}\n", escape(term), lines.join("\n.br\n"))
}

/// Protects what roff would take as its own: backslashes, hyphens, and points and quotes at the start of a line.
fn escape(text: &str) -> String {
    let text = text.replace('\\', "\\e").replace('-', "\\-");
    if text.starts_with(['.', '\'']) { format!("\\&{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_family_has_a_heading() {
        let families: Vec<&str> = HEADINGS.iter().map(|(family, _)| *family).collect();
        let mut files: Vec<&str> = crate::deck::CARDS.iter().map(|(family, _)| *family).collect();
        files.dedup();
        assert_eq!(families, files);
    }

    #[test]
    fn roff_keeps_what_is_written() {
        assert_eq!(escape(".5 -1 a\\b"), "\\&.5 \\-1 a\\eb");
    }
}
