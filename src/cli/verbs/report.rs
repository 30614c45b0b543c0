//! `urto report`: a run as a page.

use crate::cli::outputs::{ANOTHER_NAME, Inputs};
use crate::cli::terminal::{complain, say};
use crate::cli::{DONE, Failure, WRONG_INPUT, options, verbs::view};
use crate::postprocess::plot::Class;
use crate::postprocess::report::{self, ReportError, ReportOptions};
use crate::postprocess::view::ViewOptions;
use std::path::PathBuf;

/// Writes the page.
pub fn report(options: &options::Report) -> Result<u8, Failure> {
    let files = report::files_of(&options.run);
    if !files.plot.exists() && crate::exodus::pieces::any_pieces_of(&files.plot) {
        let plot = files.plot.display();
        return Err(Failure::input(format_args!("error: {plot} is in pieces\nhelp: `urto join {plot}` joins them")));
    }
    let name = files.plot.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let output = options.output.clone().unwrap_or_else(|| PathBuf::from(name + ".html"));
    let html = ["html", "htm"].iter().any(|kind| output.extension().is_some_and(|e| e.eq_ignore_ascii_case(kind)));
    if !html {
        return Err(Failure::input(format_args!("error: {} is no name with .html", output.display())));
    }
    if !(options.second > 0.0 && options.second.is_finite()) {
        return Err(Failure::input(format_args!("error: --second is {}; expected a positive number", options.second)));
    }
    let filter = options.filter.as_deref().map(|t| t.parse::<Class>()).transpose().map_err(Failure::input_error)?;
    let wanted = ReportOptions {
        view: ViewOptions {
            variable: options.variable.clone(),
            from: options.from.parse().map_err(Failure::input_error)?,
            magnify: options.magnify,
            mirror: view::mirrors(&options.mirror)?,
            cuts: view::planes("cut", &options.cut)?,
            hide: options.hide.clone(),
            ..ViewOptions::default()
        },
        states: options.states.as_deref().map(view::state_list).transpose()?.unwrap_or_default(),
        filter,
        second: options.second,
    };
    let inputs = [&files.plot, &files.history, &files.print];
    Inputs::default().with("a file of the run", inputs).spare([&output], ANOTHER_NAME)?;
    let done = report::report(&files, &output, &wanted).map_err(|error| match error {
        ReportError::Write { .. } => Failure::run(format_args!("error: {error}")),
        _ => Failure::input_error(error),
    })?;
    for reason in &done.missing {
        complain(format_args!("warning: not shown: {reason}"));
    }
    say(format_args!("{}: {} pictures, {} plots", output.display(), done.pictures, done.plots));
    // A page without the pictures that were asked for is not what was wanted.
    let asked = options.variable.is_some() || options.states.is_some() || !options.hide.is_empty();
    Ok(if asked && done.pictures == 0 && !done.missing.is_empty() { WRONG_INPUT } else { DONE })
}
