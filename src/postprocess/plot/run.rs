//! The files of a run read as one: what restarts wrote one after the other, and the pieces of each.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::PlotError;
use crate::exodus::Results;
use crate::exodus::pieces::{any_pieces_of, pieces_of};
use crate::postprocess::means::Means;
use crate::run::part_of;

/// Results of a run, all its parts and pieces.
pub struct Run {
    path: PathBuf,
    parts: Vec<Part>,
    times: Vec<f64>,
    /// Names of variables of the whole body, at nodes and in elements: those of all parts, as a run that goes on may have others.
    names: [Vec<String>; 3],
}

/// What one start of the program wrote: a file, or its pieces.
struct Part {
    pieces: Vec<Results>,
    /// States that count: those before the next part begins, of those that all pieces have.
    states: usize,
    /// Which variables are means over intervals.
    means: Means,
    /// In which element each MATERIAL POINT lies, by its number in the deck.
    points: BTreeMap<usize, String>,
}

/// Where a variable's values are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Site {
    /// Of the whole body.
    Global,
    /// At the node with this number.
    Node(i64),
    /// In the element with this number.
    Element(i64),
}

impl Run {
    /// Opens `x.e` and what continued runs left beside it, `x.e-s0002` and so on, each whole or in pieces. The name of one
    /// later part stands for that part alone.
    ///
    /// # Errors
    /// When a file cannot be read, pieces are missing, or there is no state.
    pub fn open(path: &Path) -> Result<Run, PlotError> {
        // The name of one piece stands for them all.
        let piece = pieces_of(path).ok().filter(|(_, pieces)| pieces.iter().any(|piece| piece == path));
        let whole = piece.map_or_else(|| path.to_owned(), |(whole, _)| whole);
        let is_there = |path: &Path| path.exists() || any_pieces_of(path);
        let mut parts: Vec<Part> = Vec::new();
        for number in 1..=9999 {
            let next = part_of(&whole, number);
            if !is_there(&next) {
                // Histories that only a later part has been asked for: the plot files tell that the run went on.
                let is_history = whole.extension().is_some_and(|suffix| suffix == "h");
                if is_history && is_there(&part_of(&whole.with_extension("e"), number)) {
                    continue;
                }
                break;
            }
            let part = Part::open(&next)?;
            // What an earlier run of this name was continued into lies there still, and is no part of this one.
            let stale = parts.first().and_then(Part::begun).zip(part.begun()).is_some_and(|(first, own)| own < first);
            parts.extend((!stale).then_some(part));
        }
        if parts.is_empty() {
            // Says what is wrong with it.
            parts.push(Part::open(&whole)?);
        }
        // A run that goes on from before the end of the one before replaces what that one went on to.
        for i in (1..parts.len()).rev() {
            let Some(&begin) = parts[i].times().first() else { continue };
            // A state that only the end of a run was a reason for lies inside an interval over which the next run has means.
            let since = parts[i].means.since.unwrap_or(f64::INFINITY);
            for part in &mut parts[..i] {
                part.states = part.times().iter().take_while(|&&time| time < begin && time <= since).count();
            }
        }
        let times: Vec<f64> = parts.iter().flat_map(|part| part.times().iter().copied()).collect();
        if times.is_empty() {
            return Err(PlotError::NoStates(path.to_owned()));
        }
        let names = [Site::Global, Site::Node(0), Site::Element(0)].map(|site| names_of_all(&parts, site));
        Ok(Run { path: path.to_owned(), parts, times, names })
    }

    /// The file, as it was named.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of files that are read as one.
    pub fn files(&self) -> usize {
        self.parts.iter().map(|part| part.pieces.len()).sum()
    }

    /// The times of the states.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The title.
    pub fn title(&self) -> String {
        self.first().map(|file| file.title().trim().to_owned()).unwrap_or_default()
    }

    /// Whether each value of a variable of the whole body is the mean since the state before.
    pub fn is_mean(&self, name: &str) -> bool {
        let mut own = self.parts.iter().filter(|part| is_among(part.names(Site::Global), name)).peekable();
        own.peek().is_some() && own.all(|part| part.means.is_mean(name))
    }

    /// Whether its first state is in the middle of an event: what was written before is not among its parts.
    pub fn begins_in_the_middle(&self) -> bool {
        self.parts.iter().find(|part| part.states > 0).is_some_and(|part| part.means.since.is_some())
    }

    /// Names of variables at a site, in any part.
    pub fn names(&self, site: Site) -> &[String] {
        let [global, nodal, element] = &self.names;
        match site {
            Site::Global => global,
            Site::Node(_) => nodal,
            Site::Element(_) => element,
        }
    }

    /// A variable's values in all states; NaN in parts that do not have it, or not this node or element.
    ///
    /// # Errors
    /// When no part has such a node or element, or values cannot be read.
    pub fn values(&self, name: &str, site: Site) -> Result<Vec<f64>, PlotError> {
        let mut all = Vec::with_capacity(self.times.len());
        let mut is_there = false;
        for part in self.parts.iter().filter(|part| part.states > 0) {
            let values = part.values(name, site)?;
            is_there |= values.is_some();
            all.extend(values.unwrap_or_else(|| vec![f64::NAN; part.states]).into_iter().take(part.states));
        }
        let (kind, id) = match site {
            Site::Global => ("global variable", 0),
            Site::Node(id) => ("node", id),
            Site::Element(id) => ("element", id),
        };
        if is_there { Ok(all) } else { Err(PlotError::NoPlace { path: self.path.clone(), kind, id }) }
    }

    /// Which element's a variable of a MATERIAL POINT is in each state, where that changes from part to part: what goes on may
    /// watch other points, which are numbered from one again. Nothing for other variables, and where all states are of one element.
    pub fn elements_of(&self, name: &str) -> Option<Vec<&str>> {
        let number: usize = name.rsplit_once('_').filter(|(stem, _)| !stem.contains('_'))?.1.parse().ok()?;
        let mut owners = Vec::with_capacity(self.times.len());
        for part in self.parts.iter().filter(|part| part.states > 0) {
            let owner = part.points.get(&number).map_or("", String::as_str);
            owners.resize(owners.len() + part.states, owner);
        }
        let mut known = owners.iter().filter(|owner| !owner.is_empty());
        let first = known.next()?;
        known.any(|other| other != first).then_some(owners)
    }

    /// What there is to plot, in lines of text.
    pub fn contents(&self) -> String {
        let files = if self.files() == 1 { String::new() } else { format!(", {} files read as one", self.files()) };
        let ends = [self.times.first(), self.times.last()].map(|time| time.copied().unwrap_or_default());
        let mut text = format!(
            "{}: {} states from time {:e} to {:e}{files}\n",
            self.path.display(),
            self.times.len(),
            ends[0],
            ends[1]
        );
        for (what, site) in [
            ("of the whole body", Site::Global),
            ("at nodes, with --node", Site::Node(0)),
            ("in elements, with --element", Site::Element(0)),
        ] {
            let names = self.names(site);
            if !names.is_empty() {
                text += &format!("  {what}: {}\n", names.join(", "));
            }
        }
        text
    }

    fn first(&self) -> Option<&Results> {
        self.parts.first().and_then(|part| part.pieces.first())
    }
}

/// The elements of material points by the records of a history: `MATERIAL POINT 1 AT 0 0 1: ELEMENT 7 OF BLOCK 2`.
fn points_of(info: &[String]) -> BTreeMap<usize, String> {
    let mut found = BTreeMap::new();
    for (line, next) in info.iter().zip(info.iter().skip(1).map(String::as_str).chain([""])) {
        let Some((number, rest)) = line.strip_prefix("MATERIAL POINT ").and_then(|rest| rest.split_once(" AT ")) else {
            continue;
        };
        // A long record goes on in the next line.
        let wrapped = if line.len() >= 80 { next } else { "" };
        let whole = format!("{rest}{wrapped}");
        let element =
            whole.split_once(": ELEMENT ").map(|(_, element)| element.trim().replace(" OF BLOCK ", " of block "));
        if let (Ok(number), Some(element)) = (number.parse(), element) {
            found.insert(number, element);
        }
    }
    found
}

/// Names of variables at a site in the parts whose states count, in the order in which they come up.
fn names_of_all(parts: &[Part], site: Site) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for part in parts.iter().filter(|part| part.states > 0) {
        let new: Vec<String> = part.names(site).iter().filter(|name| !is_among(&all, name)).cloned().collect();
        all.extend(new);
    }
    all
}

/// Whether a variable is among these; case does not count.
fn is_among(names: &[String], name: &str) -> bool {
    names.iter().any(|known| known.eq_ignore_ascii_case(name))
}

impl Part {
    fn open(path: &Path) -> Result<Part, PlotError> {
        let whole = path.exists() || !any_pieces_of(path);
        let files = if whole { vec![path.to_owned()] } else { pieces_of(path)?.1 };
        let pieces = files.iter().map(|file| Results::open(file)).collect::<Result<Vec<_>, _>>()?;
        let states = pieces.iter().map(|piece| piece.times().len()).min().unwrap_or(0);
        let info = pieces.first().map(Results::info).unwrap_or_default();
        Ok(Part { pieces, states, means: Means::read(&info), points: points_of(&info) })
    }

    /// When the program was started that wrote it, as year, month, day and time; `None` where its records do not tell.
    fn begun(&self) -> Option<[String; 4]> {
        let [_, _, date, time] = self.pieces.first()?.qa().pop()?;
        let [month, day, year]: [&str; 3] = date.split('/').collect::<Vec<_>>().try_into().ok()?;
        Some([year, month, day, &time].map(|text| text.trim().to_owned()))
    }

    /// The times of the states that count.
    fn times(&self) -> &[f64] {
        self.pieces.first().and_then(|piece| piece.times().get(..self.states)).unwrap_or_default()
    }

    /// Names of its variables at a site.
    fn names(&self, site: Site) -> &[String] {
        let Some(file) = self.pieces.first() else { return &[] };
        match site {
            Site::Global => file.global_names(),
            Site::Node(_) => file.nodal_names(),
            Site::Element(_) => file.element_names(),
        }
    }

    /// A variable's values; `None` where no piece has the node or element.
    fn values(&self, name: &str, site: Site) -> Result<Option<Vec<f64>>, PlotError> {
        let has = |names: &[String]| is_among(names, name);
        for piece in &self.pieces {
            let nothing = || Ok(Some(vec![f64::NAN; piece.times().len()]));
            match site {
                Site::Global if !has(piece.global_names()) => return nothing(),
                Site::Global => return Ok(Some(piece.global_history(name)?)),
                Site::Node(id) => {
                    if let Some(place) = piece.node_ids()?.iter().position(|&other| other == id) {
                        return if has(piece.nodal_names()) {
                            Ok(Some(piece.nodal_history(name, place)?))
                        } else {
                            nothing()
                        };
                    }
                }
                Site::Element(id) => {
                    if let Some(place) = piece.element_ids()?.iter().position(|&other| other == id) {
                        let has = has(piece.element_names());
                        return if has { Ok(Some(piece.element_history(name, place)?)) } else { nothing() };
                    }
                }
            }
        }
        Ok(None)
    }
}
