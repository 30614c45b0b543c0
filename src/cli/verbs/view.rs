//! `urto view`: pictures of results.

use crate::cli::options::{self, MapName};
use crate::cli::outputs::{ANOTHER_NAME, Inputs};
use crate::cli::terminal::{complain, say};
use crate::cli::{DONE, Failure};
use crate::postprocess::view::{self, Direction, MapChoice, StateChoice, ViewError, ViewOptions};
use crate::run::last_part_of;
use std::path::PathBuf;

/// `urto view`
///
/// # Errors
///
/// Results cannot be read or do not hold what is asked for, or the picture cannot be written.
pub fn view(options: &options::View) -> Result<u8, Failure> {
    let suffix = if options.animate { "gif" } else { "png" };
    let output = options
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(options.results.file_name().unwrap_or_default()).with_extension(suffix));
    let kinds = if options.animate { &["gif", "png"][..] } else { &["png"] };
    if !kinds.iter().any(|kind| output.extension().is_some_and(|given| given.eq_ignore_ascii_case(kind))) {
        let wrong =
            format_args!("error: cannot draw into {}; expected a name with .{suffix}", output.display()).to_string();
        let help = if options.animate { "" } else { "\nhelp: --animate makes a moving .gif of all states" };
        return Err(Failure::input(wrong + help));
    }
    let wanted = view_options(options)?;
    Inputs::default().with("the file to draw", [&options.results]).spare([&output], ANOTHER_NAME)?;
    let last = last_part_of(&options.results);
    if last != options.results {
        complain(format_args!(
            "note: {} goes on in {}, which is a file of its own to draw",
            options.results.display(),
            last.display()
        ));
    }
    if options.animate {
        let frames =
            view::draw_many(&options.results, &output, std::num::NonZeroUsize::MIN, &wanted).map_err(not_drawn)?;
        say(format_args!("{}: {} states", output.display(), frames.len()));
        return Ok(DONE);
    }
    let states = states(options)?;
    if states.len() > 1 {
        let shown = view::draw_row(&options.results, &output, &states, &wanted).map_err(not_drawn)?;
        let variable = shown.first().and_then(|summary| summary.variable.clone()).unwrap_or("blocks".into());
        say(format_args!("{}: {variable} in {} states", output.display(), shown.len()));
        return Ok(DONE);
    }
    let summary = view::draw(&options.results, &output, &wanted).map_err(not_drawn)?;
    let variable = summary.variable.unwrap_or("blocks".into());
    let time = summary.time.map_or(String::new(), |t| format!(" at time {t:.6e}"));
    say(format_args!("{}: {variable}{time}", summary.path.display()));
    Ok(DONE)
}

/// A picture that cannot be written is no fault of the input.
fn not_drawn(error: ViewError) -> Failure {
    match error {
        ViewError::Write { .. } => Failure::run(format_args!("error: {error}")),
        _ => Failure::input_error(error),
    }
}

fn view_options(options: &options::View) -> Result<ViewOptions, Failure> {
    let pair = |name: &str, text: &str, separator: char| {
        let numbers = text
            .split_once(separator)
            .and_then(|(a, b)| Some((a.trim().parse::<f64>().ok()?, b.trim().parse::<f64>().ok()?)));
        numbers.ok_or_else(|| {
            Failure::input(format_args!("error: --{name} is {text}; expected two numbers with {separator:?} between"))
        })
    };
    let (width, height) = pair("size", &options.size, 'x')?;
    Ok(ViewOptions {
        variable: options.variable.clone(),
        state: states(options)?.first().copied().unwrap_or(StateChoice::Last),
        from: options.from.parse::<Direction>().map_err(Failure::input_error)?,
        size: (width as u32, height as u32),
        magnify: options.magnify,
        mirror: mirrors(&options.mirror)?,
        blocks: options.block.clone(),
        hide: options.hide.clone(),
        cuts: planes("cut", &options.cut)?,
        region: region(&options.region)?,
        criteria: ranges("where", &options.criteria, "EQPS=0.2:")?,
        arrows: options.arrows.clone(),
        revolve: options.revolve,
        thickness: options.thickness,
        planes: !options.no_planes,
        map: match options.map {
            None => MapChoice::Suited,
            Some(MapName::Sequential) => MapChoice::Sequential,
            Some(MapName::Diverging) => MapChoice::Diverging,
        },
        range: options.range.as_deref().map(|text| pair("range", text, ',')).transpose()?,
        edges: !options.no_edges,
    })
}

/// The states asked for; none stands for the last.
fn states(options: &options::View) -> Result<Vec<StateChoice>, Failure> {
    match (&options.state, options.time) {
        (Some(list), _) => state_list(list),
        (None, Some(time)) => Ok(vec![StateChoice::Nearest(time)]),
        (None, None) => Ok(vec![StateChoice::Last]),
    }
}

/// States with commas between.
pub(in crate::cli) fn state_list(list: &str) -> Result<Vec<StateChoice>, Failure> {
    list.split(',').map(|text| text.trim().parse::<StateChoice>().map_err(Failure::input_error)).collect()
}

/// Planes such as `x=5,z=0`: axis and place.
pub(in crate::cli) fn planes(option: &str, text: &str) -> Result<Vec<(usize, f64)>, Failure> {
    let plane = |text: &str| {
        let (axis, place) = text.split_once('=')?;
        let axis = ["x", "y", "z"].iter().position(|name| name.eq_ignore_ascii_case(axis.trim()))?;
        Some((axis, place.trim().parse::<f64>().ok().filter(|place| place.is_finite())?))
    };
    let wrong = |text: &str| {
        Failure::input(format_args!("error: --{option} has {text:?}; expected planes such as x=5 with commas between"))
    };
    let texts = text.split(',').filter(|text| !text.trim().is_empty());
    texts.map(|text| plane(text).ok_or_else(|| wrong(text))).collect()
}

/// A box such as `x=0:5,z=:3`: what it is along each axis.
fn region(text: &str) -> Result<[Option<(f64, f64)>; 3], Failure> {
    let mut region = [None; 3];
    for (name, ends) in ranges("region", text, "x=0:5")? {
        let axis = ["x", "y", "z"].iter().position(|axis| axis.eq_ignore_ascii_case(&name));
        let wrong = || Failure::input(format_args!("error: --region has {name:?}; expected x, y or z before the ="));
        region[axis.ok_or_else(wrong)?] = Some(ends);
    }
    Ok(region)
}

/// A name, and the ends of its range.
type NamedRange = (String, (f64, f64));

/// Names with a range each, `x=0:5`, with commas between; an end that is left out is infinite.
fn ranges(option: &str, text: &str, example: &str) -> Result<Vec<NamedRange>, Failure> {
    let end = |text: &str, missing: f64| match text.trim() {
        "" => Some(missing),
        number => number.parse::<f64>().ok().filter(|number| number.is_finite()),
    };
    let range = |text: &str| {
        let (name, ends) = text.split_once('=')?;
        let (low, high) = ends.split_once(':')?;
        let ends = (end(low, f64::NEG_INFINITY)?, end(high, f64::INFINITY)?);
        (!name.trim().is_empty() && ends.0 <= ends.1).then(|| (name.trim().to_owned(), ends))
    };
    let wrong = |text: &str| {
        let expected = format!("ranges such as {example}, the smaller end first, with commas between");
        Failure::input(format_args!("error: --{option} has {text:?}; expected {expected}"))
    };
    let texts = text.split(',').filter(|text| !text.trim().is_empty());
    texts.map(|text| range(text).ok_or_else(|| wrong(text))).collect()
}

/// Mirror planes: `xy` for those through the origin, or each with its place.
pub(in crate::cli) fn mirrors(text: &str) -> Result<[Option<f64>; 3], Failure> {
    let mut mirror = [None; 3];
    let letters = |part: &str| part.chars().map(|c| "xyz".find(c.to_ascii_lowercase())).collect::<Option<Vec<_>>>();
    for part in text.split(',').map(str::trim).filter(|part| !part.is_empty()) {
        match letters(part) {
            Some(axes) => axes.into_iter().for_each(|axis| mirror[axis] = Some(0.0)),
            None => {
                let found = planes("mirror", part)?;
                found.into_iter().for_each(|(axis, place)| mirror[axis] = Some(place));
            }
        }
    }
    Ok(mirror)
}
