//! `urto plot`: curves from results and histories.

use crate::cli::options;
use crate::cli::outputs::{ANOTHER_NAME, Inputs};
use crate::cli::terminal::{complain, say};
use crate::cli::{DONE, Failure};
use crate::output::print::scientific;
use crate::postprocess::plot::{self, Class, Curve, Drawn, Log, PlotError, PlotOptions, Range};
use std::path::{Path, PathBuf};

/// Draws, or writes numbers, and says what the curves reach.
///
/// # Errors
///
/// Results cannot be read or do not hold what is asked for, or the picture cannot be written.
pub fn plot(options: &options::Plot) -> Result<u8, Failure> {
    if options.list {
        say(plot::contents(&options.files).map_err(Failure::input_error)?.trim_end());
        return Ok(DONE);
    }
    let output = output(options)?;
    let wanted = wanted(options)?;
    let inputs = Inputs::default().with("a file to draw", &options.files).with("the reference", &options.reference);
    inputs.spare([&output], ANOTHER_NAME)?;
    let drawn = match options.csv {
        true => plot::tabulate(&output, &wanted),
        false => plot::draw(&output, &wanted),
    };
    let drawn = drawn.map_err(not_drawn)?;
    for warning in &drawn.warnings {
        complain(format_args!("warning: {warning}"));
    }
    say(told(&output, &drawn));
    Ok(DONE)
}

/// A picture or a table that cannot be written is no fault of the input.
fn not_drawn(error: PlotError) -> Failure {
    match error {
        PlotError::Write { .. } => Failure::run(format_args!("error: {error}")),
        _ => Failure::input_error(error),
    }
}

/// Where it goes: the suffix must fit what is asked for.
fn output(options: &options::Plot) -> Result<PathBuf, Failure> {
    let suffixes = if options.csv { &["csv", "txt", "dat"][..] } else { &["png", "svg"] };
    let stem = options.files.first().and_then(|file| file.file_stem()).unwrap_or_default().to_string_lossy();
    let output = options.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}_curves.{}", suffixes[0])));
    if suffixes.iter().any(|suffix| output.extension().is_some_and(|given| given.eq_ignore_ascii_case(suffix))) {
        return Ok(output);
    }
    let (what, help) = match options.csv {
        true => ("write numbers to", ""),
        false => ("draw into", "\nhelp: --csv writes numbers in place of a picture"),
    };
    let expected = suffixes.join(", .");
    Err(Failure::input(format_args!(
        "error: cannot {what} {}; expected a name with .{expected}{help}",
        output.display()
    )))
}

fn wanted(options: &options::Plot) -> Result<PlotOptions, Failure> {
    let wrong = |size: &str| Failure::input(format_args!("error: --size is {size}; expected WIDTHxHEIGHT in pixels"));
    let size = options.size.split_once('x').and_then(|(w, h)| Some((w.trim().parse().ok()?, h.trim().parse().ok()?)));
    let range = |text: &Option<String>| {
        text.as_deref().map(|text| text.parse::<Range>()).transpose().map_err(Failure::input_error)
    };
    Ok(PlotOptions {
        files: options.files.clone(),
        variables: options.variables.clone(),
        right: options.right.clone(),
        over: options.over.clone(),
        nodes: options.node.clone(),
        elements: options.element.clone(),
        minus: options.minus.clone(),
        derive: options.derive,
        integrate: options.integrate,
        filter: options.filter.as_deref().map(|t| t.parse::<Class>()).transpose().map_err(Failure::input_error)?,
        second: options.second,
        scale: options.scale,
        references: options.reference.clone(),
        log: options.log.parse::<Log>().map_err(Failure::input_error)?,
        ranges: [range(&options.x_range)?, range(&options.y_range)?, range(&options.right_range)?],
        title: options.title.clone(),
        labels: [options.x_label.clone(), options.y_label.clone(), options.right_label.clone()],
        size: size.ok_or_else(|| wrong(&options.size))?,
    })
}

/// A line on the file and a table of what the curves reach.
fn told(output: &Path, drawn: &Drawn) -> String {
    let width = drawn.curves.iter().map(|curve| curve.label.chars().count()).max().unwrap_or(0);
    let heads = ["least", "at", "greatest", "at", "last"].map(|head| format!("{head:>12}")).concat();
    let lines = drawn.curves.iter().map(|curve| format!("{:width$}{}\n", curve.label, cells(curve)));
    let count = match drawn.curves.len() {
        1 => "1 curve".to_owned(),
        count => format!("{count} curves"),
    };
    format!("{}: {count}\n{:width$}{heads}\n{}", output.display(), "", lines.collect::<String>()).trim_end().to_owned()
}

fn cells(curve: &Curve) -> String {
    match curve.extremes() {
        Some(e) => {
            let numbers = [e.least[1], e.least[0], e.greatest[1], e.greatest[0], e.last[1]];
            numbers.map(|value| format!("{:>12}", scientific(value, 4))).concat()
        }
        None => format!("{:>12}", "no numbers"),
    }
}
