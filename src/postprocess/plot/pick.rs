//! Which variables of which runs become curves, and what they are called.

use super::PlotError;
use super::curve::Curve;
use super::filter::Before;
use super::options::PlotOptions;
use super::run::{Run, Site};

/// Variables that are plotted when none is asked for: energies of the body.
const CUSTOMARY: [&str; 8] = ["KE", "IE", "HGE", "BVE", "FRICE", "DEADE", "EXTW", "CONTE"];
/// Distances beyond which a name is not a misspelt one, in letters per letter.
const NEAR: usize = 3;

/// A variable somewhere: the file's names, one or the three of a vector, and the place.
#[derive(Debug, Clone, PartialEq)]
struct Chosen {
    label: String,
    names: Vec<String>,
    site: Site,
}

/// The curves that are asked for, of each run in turn.
///
/// # Errors
/// When a run lacks a variable, a node or an element; where none is asked for, when no run has energies.
pub fn curves(runs: &[Run], options: &PlotOptions) -> Result<(Vec<Curve>, Vec<String>), PlotError> {
    let (mut curves, mut notes) = (Vec::new(), Vec::new());
    let (mut without, asks) = (None, !options.variables.is_empty() || !options.right.is_empty());
    for (number, run) in runs.iter().enumerate() {
        let mut wanted: Vec<(Chosen, bool)> = Vec::new();
        if !asks {
            let energies = customary(run)?;
            if energies.is_empty() {
                // The history beside a plot file has none.
                without = without.or(Some(run));
            }
            wanted.extend(energies.into_iter().map(|chosen| (chosen, false)));
        }
        for (names, right) in [(&options.variables, false), (&options.right, true)] {
            for name in names.iter() {
                wanted.extend(choose(run, name, options)?.into_iter().map(|chosen| (chosen, right)));
            }
        }
        for (variable, (chosen, right)) in wanted.into_iter().enumerate() {
            let y = values(run, &chosen)?;
            let (site, means) = (chosen.site, is_mean(run, &chosen));
            let before = before(run, &chosen, means);
            let of_elements = by_elements(run, &chosen, &y);
            if !of_elements.is_empty() {
                notes.push(format!(
                    "{}: {} is of another element since a run went on: a curve for each element",
                    run.path().display(),
                    chosen.label
                ));
            }
            let all = if of_elements.is_empty() { vec![(chosen.label, y)] } else { of_elements };
            curves.extend(all.into_iter().map(|(label, y)| {
                let curve = Curve::of(label, run.times().to_vec(), y);
                Curve { right, run: number, variable, site, means, before, ..curve }
            }));
        }
    }
    if let Some(run) = without.filter(|_| curves.is_empty()) {
        let known = known(run).into_iter().map(str::to_owned).collect();
        return Err(PlotError::Unsaid { path: run.path().to_owned(), known });
    }
    name_runs(&mut curves, runs);
    Ok((curves, notes))
}

/// A variable of a MATERIAL POINT that lies in another element since a run went on: names and values for each of the elements,
/// NaN in the states of the others. Empty where there is nothing to take apart.
fn by_elements(run: &Run, chosen: &Chosen, y: &[f64]) -> Vec<(String, Vec<f64>)> {
    let name = chosen.names.first().filter(|_| chosen.site == Site::Global);
    let Some(owners) = name.and_then(|name| run.elements_of(name)) else { return Vec::new() };
    let mut elements: Vec<&str> = Vec::new();
    for &owner in owners.iter().filter(|owner| !owner.is_empty()) {
        if !elements.contains(&owner) {
            elements.push(owner);
        }
    }
    let of = |element: &&str| -> Vec<f64> {
        let own = y.iter().zip(&owners);
        own.map(|(&value, owner)| if owner == element { value } else { f64::NAN }).collect()
    };
    elements.iter().map(|element| (format!("{} in element {element}", chosen.label), of(element))).collect()
}

/// The values of the variable with this name, and whether they are means over intervals; of several places at which it is there, those
/// at `site`.
///
/// # Errors
/// When there is no such variable.
pub fn one(run: &Run, name: &str, options: &PlotOptions, site: Site) -> Result<(Vec<f64>, bool), PlotError> {
    let found = choose(run, name, options)?;
    match found.iter().find(|chosen| chosen.site == site).or(found.first()) {
        Some(chosen) => Ok((values(run, chosen)?, is_mean(run, chosen))),
        None => Err(missing(run, name, options)),
    }
}

fn is_mean(run: &Run, chosen: &Chosen) -> bool {
    chosen.site == Site::Global && chosen.names.iter().all(|name| run.is_mean(name))
}

/// What a variable did before its first value.
fn before(run: &Run, chosen: &Chosen, means: bool) -> Before {
    let acceleration = || chosen.names.iter().all(|name| name.to_uppercase().starts_with("ACCL"));
    match () {
        () if run.begins_in_the_middle() => Before::Unknown,
        () if means || acceleration() => Before::Steady,
        () => Before::First,
    }
}

fn values(run: &Run, chosen: &Chosen) -> Result<Vec<f64>, PlotError> {
    let parts = chosen.names.iter().map(|name| run.values(name, chosen.site)).collect::<Result<Vec<_>, _>>()?;
    Ok(match parts.as_slice() {
        [one] => one.clone(),
        parts => (0..run.times().len()).map(|i| parts.iter().map(|p| p[i] * p[i]).sum::<f64>().sqrt()).collect(),
    })
}

/// The energies that are not zero all the time; none in a file that has none.
fn customary(run: &Run) -> Result<Vec<Chosen>, PlotError> {
    let mut chosen = Vec::new();
    for name in CUSTOMARY {
        if run.names(Site::Global).iter().any(|known| known == name)
            && run.values(name, Site::Global)?.iter().any(|&value| value != 0.0 && !value.is_nan())
        {
            chosen.push(Chosen { label: name.to_owned(), names: vec![name.to_owned()], site: Site::Global });
        }
    }
    Ok(chosen)
}

/// All that a name means: a variable of the whole body, else one at each node or in each element asked for.
fn choose(run: &Run, name: &str, options: &PlotOptions) -> Result<Vec<Chosen>, PlotError> {
    let mut sites = vec![vec![Site::Global]];
    sites.push(options.nodes.iter().map(|&id| Site::Node(id)).collect());
    sites.push(options.elements.iter().map(|&id| Site::Element(id)).collect());
    for sites in sites {
        let Some(&first) = sites.first() else { continue };
        let known = run.names(first);
        let mut groups: Vec<(String, Vec<String>)> = known
            .iter()
            .filter(|known| matches(name, known))
            .map(|known| (known.clone(), vec![known.clone()]))
            .collect();
        if groups.is_empty() {
            groups.extend(vector(name, known).map(|names| (format!("|{}|", name.to_uppercase()), names)));
        }
        let named = sites.iter().flat_map(|&site| {
            groups.iter().map(move |(label, names)| Chosen {
                label: format!("{label}{}", place_of(site)),
                names: names.clone(),
                site,
            })
        });
        let chosen: Vec<Chosen> = named.collect();
        if !chosen.is_empty() {
            return Ok(chosen);
        }
    }
    Err(missing(run, name, options))
}

fn place_of(site: Site) -> String {
    match site {
        Site::Global => String::new(),
        Site::Node(id) => format!(" at node {id}"),
        Site::Element(id) => format!(" in element {id}"),
    }
}

/// Whether a name, in which `*` stands for any letters, means a variable. Case does not count.
fn matches(pattern: &str, name: &str) -> bool {
    let (pattern, name) = (pattern.to_uppercase(), name.to_uppercase());
    let mut pieces = pattern.split('*');
    let Some(mut rest) = pieces.next().and_then(|first| name.strip_prefix(first)) else { return false };
    let mut pieces: Vec<&str> = pieces.collect();
    let Some(last) = pieces.pop() else { return rest.is_empty() };
    for piece in pieces {
        let Some((_, behind)) = rest.split_once(piece) else { return false };
        rest = behind;
    }
    rest.ends_with(last)
}

/// The components of a vector with this stem: VEL for VELX, VELY, VELZ, and ACCL_BLOCK3 for ACCLX_BLOCK3 and so on.
fn vector(stem: &str, names: &[String]) -> Option<Vec<String>> {
    let (stem, place) = stem.split_once('_').map_or((stem, String::new()), |(stem, rest)| (stem, format!("_{rest}")));
    let component = |axis: char| {
        let spelled = format!("{stem}{axis}{place}");
        names.iter().find(|known| known.eq_ignore_ascii_case(&spelled)).cloned()
    };
    ['X', 'Y', 'Z'].into_iter().map(component).collect()
}

fn known(run: &Run) -> Vec<&str> {
    let sites = [Site::Global, Site::Node(0), Site::Element(0)];
    sites.into_iter().flat_map(|site| run.names(site)).map(String::as_str).collect()
}

fn missing(run: &Run, name: &str, options: &PlotOptions) -> PlotError {
    let has =
        |site| run.names(site).iter().any(|known| matches(name, known)) || vector(name, run.names(site)).is_some();
    let hint = if options.nodes.is_empty() && has(Site::Node(0)) {
        " of the whole body; it is there at nodes: say which with --node".to_owned()
    } else if options.elements.is_empty() && has(Site::Element(0)) {
        " of the whole body; it is there in elements: say which with --element".to_owned()
    } else {
        let distance = |known: &&str| strsim::damerau_levenshtein(&known.to_uppercase(), &name.to_uppercase());
        let all = known(run);
        match all.iter().map(|known| (distance(known), known)).min() {
            Some((d, near)) if d <= 1 + name.chars().count() / NEAR => format!(" (did you mean {near}?)"),
            _ if all.len() <= 40 => format!("; the file has: {}", all.join(", ")),
            _ => format!("; the file has {} others, which --list shows", all.len()),
        }
    };
    PlotError::NoVariable { path: run.path().to_owned(), name: name.to_owned(), hint }
}

/// Curves of several runs say whose they are: by file name, by path where that is not enough.
fn name_runs(curves: &mut [Curve], runs: &[Run]) {
    if runs.len() < 2 {
        return;
    }
    let short = |run: &Run| run.path().file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let full = |run: &Run| run.path().display().to_string();
    let twice = runs.iter().enumerate().any(|(i, a)| runs[..i].iter().any(|b| short(a) == short(b)));
    let same = curves.windows(2).all(|pair| pair[0].label == pair[1].label);
    for curve in curves {
        let run = if twice { full(&runs[curve.run]) } else { short(&runs[curve.run]) };
        curve.label = if same { format!("{run}: {}", curve.label) } else { format!("{} · {run}", curve.label) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_any_letters() {
        for (pattern, name) in [("ke", "KE"), ("SIG*", "SIGXX_1"), ("*_2", "VELX_2"), ("S*Z_*", "SIGZZ_12"), ("*", "A")]
        {
            assert!(matches(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [("KE", "KEX"), ("*_2", "VELX_22"), ("S*Y_*", "SIGZZ_1"), ("", "A")] {
            assert!(!matches(pattern, name), "{pattern} {name}");
        }
    }

    #[test]
    fn stems_are_vectors_also_with_a_place() {
        let names = ["VELX_3", "VELY_3", "VELZ_3", "KE"].map(str::to_owned);
        assert_eq!(vector("vel_3", &names).unwrap(), names[..3]);
        assert!(vector("VEL", &names).is_none());
    }
}
