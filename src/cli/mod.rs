//! What the user types at the shell, and what becomes of it. Every verb ends in an exit code.

mod date;
mod display;
mod input;
mod manual;
mod options;
mod outputs;
mod restart;
mod signals;
mod summary;
mod terminal;
mod verbs;

pub use manual::manual;
pub use options::{Options, command};

use crate::{deck, exodus};
use clap::FromArgMatches;
use options::Verb;
use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

/// Exit code when everything was done.
pub const DONE: u8 = 0;
/// Exit code of a run that failed, and of a difference found.
pub const FAILED: u8 = 1;
/// Exit code when the input or the command line is wrong.
pub const WRONG_INPUT: u8 = 2;

/// Exit code of what a signal has stopped in good order, as shells give it to what a signal kills.
fn stopped_by(signal: u8) -> u8 {
    signal.saturating_add(128)
}

/// A reason to leave, with the exit code to leave with.
#[derive(Debug)]
pub struct Failure {
    /// Exit code.
    pub code: u8,
    /// What is printed to the standard error; ends without a line break.
    pub message: String,
}

impl Failure {
    /// The input is wrong.
    pub fn input(message: impl std::fmt::Display) -> Failure {
        Failure { code: WRONG_INPUT, message: message.to_string() }
    }

    /// The same, from an error that may or may not call itself one.
    pub fn input_error(error: impl std::fmt::Display) -> Failure {
        let text = error.to_string();
        Failure::input(if text.starts_with("error:") { text } else { format!("error: {text}") })
    }

    /// Something that should have worked did not.
    pub fn run(message: impl std::fmt::Display) -> Failure {
        Failure { code: FAILED, message: message.to_string() }
    }
}

/// The whole program: arguments in, exit code out.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    signals::survive_full_files();
    let matches = match command().try_get_matches_from(with_verb(arguments)) {
        Ok(matches) => matches,
        Err(error) => {
            if let Some(failure) = unknown_word(&error) {
                terminal::complain(&failure.message);
                return ExitCode::from(failure.code);
            }
            terminal::note(error.print());
            return leave(if error.use_stderr() { WRONG_INPUT } else { DONE });
        }
    };
    let outcome = match Options::from_arg_matches(&matches) {
        Ok(options) => carry_out(options),
        Err(error) => Err(Failure::input(error)),
    };
    match outcome {
        Ok(code) => leave(code),
        Err(failure) => {
            terminal::complain(&failure.message);
            ExitCode::from(failure.code)
        }
    }
}

/// Leaves with an exit code; where what was said did not arrive, nothing was done.
fn leave(code: u8) -> ExitCode {
    match terminal::lost() {
        Some(reason) if code == DONE => {
            terminal::complain(format_args!("error: cannot write to the standard output: {reason}"));
            ExitCode::from(FAILED)
        }
        _ => ExitCode::from(code),
    }
}

/// `urto deck.i` means `urto run deck.i`, also with options before the deck and with the suffix left out.
fn with_verb(arguments: impl IntoIterator<Item = OsString>) -> Vec<OsString> {
    let mut arguments: Vec<OsString> = arguments.into_iter().collect();
    let Some(first) = arguments.get(1).and_then(|argument| argument.to_str()) else { return arguments };
    let own = ["help", "-h", "--help", "-V", "--version"];
    if own.contains(&first) || command().get_subcommands().any(|verb| verb.get_name() == first) {
        return arguments;
    }
    if first.starts_with('-') || first.contains(['.', '/']) || input::deck_path(Path::new(first)).is_ok() {
        arguments.insert(1, "run".into());
    }
    arguments
}

/// A first word that is neither a verb nor a deck.
fn unknown_word(error: &clap::Error) -> Option<Failure> {
    use clap::error::{ContextKind, ContextValue, ErrorKind};
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    if error.kind() != ErrorKind::InvalidSubcommand {
        return None;
    }
    let mut message = format!("error: there is no verb and no deck {word}(.i)");
    if let Some(ContextValue::Strings(near)) = error.get(ContextKind::SuggestedSubcommand) {
        message += &format!("\nhelp: did you mean {}?", deck::spelling::either(near));
    }
    Some(Failure::input(message + "\nhelp: `urto --help` lists the verbs"))
}

fn carry_out(options: Options) -> Result<u8, Failure> {
    if let (false, Ok(program)) = (matches!(options.verb, Verb::Probe(_)), std::env::current_exe()) {
        exodus::probe_with(program, [OsString::from("probe")]);
    }
    match options.verb {
        Verb::Run(options) => verbs::run::run(&options),
        Verb::Check(options) => verbs::check::check(&options),
        Verb::Explain(options) => verbs::small::explain(&options),
        Verb::Mesh(options) => verbs::small::mesh(&options),
        Verb::Sweep(options) => verbs::sweep::sweep(&options),
        Verb::Trade(options) => verbs::trade::trade(&options),
        Verb::Refine(options) => verbs::small::refine(&options),
        Verb::View(options) => verbs::view::view(&options),
        Verb::Plot(options) => verbs::plot::plot(&options),
        Verb::Report(options) => verbs::report::report(&options),
        Verb::Diff(options) => verbs::small::diff(&options),
        Verb::Scale(options) => verbs::scale::scale(&options),
        Verb::Join(options) => verbs::small::join(&options),
        Verb::Generate(options) => verbs::small::generate(&options),
        Verb::Probe(options) => {
            exodus::try_out(&options.file);
            Ok(DONE)
        }
    }
}
