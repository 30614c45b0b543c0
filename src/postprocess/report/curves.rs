//! Curves: energies, what contact did, the time step, and every history.

use super::ReportOptions;
use crate::postprocess::plot::{self, Curve, PlotError, PlotOptions, Texts};
use crate::run::Files;
use std::path::{Path, PathBuf};

/// Plots that belong together.
pub struct Group {
    /// Heading.
    pub title: String,
    /// The plots.
    pub plots: Vec<Plot>,
}

/// A plot.
pub struct Plot {
    /// What is said below it.
    pub caption: String,
    /// The plot, an SVG element.
    pub svg: String,
}

/// Size of a plot, in pixels.
const SIZE: (u32, u32) = (760, 480);
/// Plots of histories at most.
const MOST: usize = 60;

/// Global variables of results, plot by plot: the caption, the names, and whether the plot is left out where all is zero.
const GLOBALS: [(&str, &[&str]); 4] = [
    ("Energies", &["KE", "IE", "HGE", "BVE", "FRICE", "DEADE", "EXTW"]),
    ("Error of the energy balance, a share of the largest account", &["EBAL"]),
    ("Work of normal contact forces, and what contact has made", &["CONTE", "CONTGAIN"]),
    ("Time step", &["TMSTEP"]),
];

/// Kinds of histories, by the beginnings of their names.
const KINDS: [(&str, &[&str]); 10] = [
    ("displacement", &["DISPLX", "DISPLY", "DISPLZ"]),
    ("velocity", &["VELX", "VELY", "VELZ"]),
    ("acceleration", &["ACCLX", "ACCLY", "ACCLZ"]),
    ("angular velocity", &["ROTX", "ROTY", "ROTZ"]),
    ("momentum", &["XMOM", "YMOM", "ZMOM"]),
    ("energies", &["KE", "IE", "HGE", "BVE"]),
    ("reaction", &["RX", "RY", "RZ"]),
    ("force", &["FX", "FY", "FZ"]),
    ("work", &["WORK", "WORK1", "WORK2", "FRICE"]),
    ("stress", &["SIGXX", "SIGYY", "SIGZZ", "TAUXY", "TAUYZ", "TAUZX"]),
];

/// Draws them all; what cannot be drawn is told.
pub fn draw(files: &Files, options: &ReportOptions, missing: &mut Vec<String>) -> Vec<Group> {
    let mut groups = Vec::new();
    let mut add = |title: &str, drawn: Result<Vec<Plot>, PlotError>| match drawn {
        Ok(plots) if plots.is_empty() => {}
        Ok(plots) => groups.push(Group { title: title.to_owned(), plots }),
        Err(error) => missing.push(format!("{title}: {error}")),
    };
    add("Energies and time step", globals(&files.plot));
    if files.has_histories() {
        add("Histories", histories(&files.history, options));
    }
    groups
}

fn globals(path: &Path) -> Result<Vec<Plot>, PlotError> {
    let all = plot::whole_body(path)?;
    let blocks: Vec<&Curve> = all.iter().filter(|curve| curve.label.contains("_BLOCK")).collect();
    let named = |names: &[&str]| {
        let of = |name: &&str| all.iter().find(|curve| curve.label.eq_ignore_ascii_case(name));
        names.iter().filter_map(of).collect::<Vec<_>>()
    };
    let mut plots = Vec::new();
    for (caption, names) in GLOBALS {
        plots.extend(plot(caption, &named(names))?);
    }
    for stem in ["KE_", "IE_"] {
        let own: Vec<&Curve> = blocks.iter().copied().filter(|curve| curve.label.starts_with(stem)).collect();
        let what = if stem == "KE_" { "Kinetic energy of each block" } else { "Internal energy of each block" };
        plots.extend(plot(what, &own)?);
    }
    Ok(plots)
}

/// Each place's variables, kind by kind; what is of no kind has a plot of its own.
fn histories(path: &Path, options: &ReportOptions) -> Result<Vec<Plot>, PlotError> {
    let all = plot::whole_body(path)?;
    let mut plots = Vec::new();
    for place in places(&all) {
        let of_place = |curve: &&Curve| split(&curve.label).1 == place;
        let mut rest: Vec<&Curve> = all.iter().filter(of_place).collect();
        for (kind, stems) in KINDS {
            let (own, others): (Vec<&Curve>, Vec<&Curve>) =
                rest.iter().copied().partition(|curve| stems.contains(&split(&curve.label).0));
            rest = others;
            let what = format!("{}: {kind}", in_words(&place));
            plots.extend(plot(&what, &own)?);
            if kind == "acceleration"
                && let Some(class) = options.filter
            {
                let caption = format!("{what}, filtered by CFC{}", class.hertz);
                plots.extend(plot(&caption, &filtered(path, &own, options)?.iter().collect::<Vec<_>>())?);
            }
        }
        for curve in rest.into_iter().filter(|curve| split(&curve.label).0 != "MASS") {
            plots.extend(plot(&format!("{}: {}", in_words(&place), split(&curve.label).0), &[curve])?);
        }
        if plots.len() >= MOST {
            plots.truncate(MOST);
            break;
        }
    }
    Ok(plots)
}

/// The same curves through the filter; none where all are zero.
fn filtered(path: &Path, curves: &[&Curve], options: &ReportOptions) -> Result<Vec<Curve>, PlotError> {
    let moving = curves.iter().filter(|curve| curve.y.iter().any(|value| *value != 0.0));
    let variables: Vec<String> = moving.map(|curve| curve.label.clone()).collect();
    if variables.is_empty() {
        return Ok(Vec::new());
    }
    let files = vec![PathBuf::from(path)];
    let (filter, second) = (options.filter, options.second);
    let wanted = PlotOptions { files, variables, filter, second, ..PlotOptions::default() };
    plot::curves(&wanted).map(|drawn| drawn.curves)
}

/// A name without its place, and the place: `ACCLX_BLOCK3` is `ACCLX` at `BLOCK3`, `FX_CONTACT1_2` is `FX` at `CONTACT1_2`.
fn split(name: &str) -> (&str, String) {
    if let Some(start) = name.find("_CONTACT") {
        return (&name[..start], name[start + 1..].to_owned());
    }
    name.rsplit_once('_').map_or((name, String::new()), |(stem, place)| (stem, place.to_owned()))
}

/// The places in their order.
fn places(curves: &[Curve]) -> Vec<String> {
    let mut places: Vec<String> = Vec::new();
    for curve in curves {
        let place = split(&curve.label).1;
        if !places.contains(&place) {
            places.push(place);
        }
    }
    places
}

/// What a place is called: `Block 3`, `Material point 1`.
fn in_words(place: &str) -> String {
    let digits = place.find(|c: char| c.is_ascii_digit()).unwrap_or(place.len());
    let (kind, number) = place.split_at(digits);
    match kind {
        "" if number.is_empty() => "The body".to_owned(),
        "" => format!("Material point {number}"),
        "SET" => format!("Node set {number}"),
        "WALL" => format!("Rigid surface on side set {number}"),
        "CONTACT" => match number.split_once('_') {
            Some((first, second)) => format!("Contact of block {first} with block {second}"),
            None => format!("Contact of block {number} with others"),
        },
        _ => {
            let lower = kind[1..].to_lowercase();
            format!("{}{lower} {number}", &kind[..1]).trim_end().to_owned()
        }
    }
}

/// A plot of those curves that are not zero all the time; none where that is none of them.
fn plot(caption: &str, curves: &[&Curve]) -> Result<Option<Plot>, PlotError> {
    let moving = |curve: &&Curve| curve.y.iter().any(|value| value.is_finite() && *value != 0.0);
    let curves: Vec<Curve> = curves.iter().copied().filter(moving).cloned().collect();
    if curves.is_empty() {
        return Ok(None);
    }
    let options = PlotOptions { size: SIZE, ..PlotOptions::default() };
    let texts = Texts { title: caption.to_owned(), below: "time".to_owned(), ..Texts::default() };
    let bytes = plot::picture(Path::new("plot.svg"), &curves, &texts, &options)?;
    Ok(Some(Plot { caption: caption.to_owned(), svg: String::from_utf8_lossy(&bytes).into_owned() }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_told_in_words() {
        assert_eq!(split("ACCLX_BLOCK3"), ("ACCLX", "BLOCK3".to_owned()));
        assert_eq!(split("WORK1_CONTACT1_2"), ("WORK1", "CONTACT1_2".to_owned()));
        let words = ["BLOCK3", "SET12", "NODE7", "4", "", "CONTACT1_20", "CONTACT7"].map(in_words);
        let contact = ["Contact of block 1 with block 20", "Contact of block 7 with others"];
        let others = ["Block 3", "Node set 12", "Node 7", "Material point 4", "The body"];
        assert_eq!(words.to_vec(), [&others[..], &contact[..]].concat());
    }
}
