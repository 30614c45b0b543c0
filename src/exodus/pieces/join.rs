//! Pieces become the file that an unsplit run writes, byte for byte.

use super::gather::Gathering;
use super::read::{Told, told};
use super::{Sizes, parts_of_name, piece_path};
use crate::common::files;
use crate::exodus::file::error::ResultsError;
use crate::exodus::file::names;
use crate::exodus::mesh::write::names_in_writing;
use crate::exodus::results::Results;
use crate::exodus::results::writer::{ResultsHeader, ResultsWriter};
use crate::mesh::{Mesh, Places};
use std::path::{Path, PathBuf};

/// Files that are kept open; with more pieces than that, each is opened anew for every state.
const OPEN_FILES: usize = 200;

/// What was joined.
#[derive(Debug, Clone, PartialEq)]
pub struct Joined {
    /// Number of pieces.
    pub pieces: usize,
    /// States of the whole: those that all pieces have.
    pub states: usize,
    /// Most states of a piece. More than `states` when the run was killed while it wrote one.
    pub most: usize,
}

/// Why pieces cannot be joined.
#[derive(Debug, thiserror::Error)]
pub enum JoinError {
    /// Nothing of that name.
    #[error(
        "there are no pieces of {whole}\n\
         help: name a piece, such as {whole}.4.0, or what they are pieces of; `urto run --split` writes them",
        whole = .0.display()
    )]
    None(PathBuf),
    /// Pieces of runs on several numbers of ranks.
    #[error(
        "{} is there in {} pieces\nhelp: name one of those that you mean, such as {}",
        .whole.display(), either(.ranks), piece_path(.whole, .ranks[0], 0).display()
    )]
    Several {
        /// What they are pieces of.
        whole: PathBuf,
        /// Numbers of ranks, ascending.
        ranks: Vec<usize>,
    },
    /// Some pieces are not there.
    #[error(
        "of the {ranks} pieces of {} {} missing: {}\n\
         help: every rank writes one; bring them all into one folder",
        .whole.display(), if .missing.len() == 1 { "one is" } else { "some are" }, listed(.missing)
    )]
    Missing {
        /// What they are pieces of.
        whole: PathBuf,
        /// Number of ranks.
        ranks: usize,
        /// The names of those missing.
        missing: Vec<PathBuf>,
    },
    /// Two pieces do not belong together.
    #[error(
        "{} and {} are not pieces of one run: {what}\n\
         help: an older run may have left some of them; run again, or bring the pieces of one run together",
        .first.display(), .other.display()
    )]
    Strangers {
        /// The first piece.
        first: PathBuf,
        /// One that does not fit it.
        other: PathBuf,
        /// What is different.
        what: String,
    },
    /// The pieces do not make a whole.
    #[error("{}: {what}\nhelp: the piece is damaged; copy it again", .path.display())]
    Damaged {
        /// A piece.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
    /// A piece that cannot be read, or a whole that cannot be written.
    #[error(transparent)]
    File(#[from] ResultsError),
}

fn either(ranks: &[usize]) -> String {
    ranks.iter().map(usize::to_string).collect::<Vec<_>>().join(" and in ")
}

fn listed(paths: &[PathBuf]) -> String {
    let first: Vec<String> = paths.iter().take(4).map(|path| path.display().to_string()).collect();
    let more =
        if paths.len() > first.len() { format!(" and {} more", paths.len() - first.len()) } else { String::new() };
    first.join(", ") + &more
}

/// The whole's name and all its pieces in the order of ranks, from the name of one of them or of the whole.
///
/// # Errors
/// When there are none, some are missing, or there are several sets of them.
pub fn pieces_of(named: &Path) -> Result<(PathBuf, Vec<PathBuf>), JoinError> {
    let (whole, ranks) = match parts_of_name(named) {
        Some((whole, ranks, _)) => (whole, ranks),
        None => (named.to_owned(), ranks_beside(named)?),
    };
    let pieces: Vec<PathBuf> = (0..ranks).map(|rank| piece_path(&whole, ranks, rank)).collect();
    let missing: Vec<PathBuf> = pieces.iter().filter(|path| !path.is_file()).cloned().collect();
    match missing.len() {
        0 => Ok((whole, pieces)),
        n if n == ranks => Err(JoinError::None(whole)),
        _ => Err(JoinError::Missing { whole, ranks, missing }),
    }
}

/// Whether there is any piece of `whole`, on whatever number of ranks.
pub fn any_pieces_of(whole: &Path) -> bool {
    !numbers_of_ranks(whole).is_empty()
}

/// All pieces of `whole` that are there, on whatever numbers of ranks.
pub fn all_pieces_of(whole: &Path) -> Vec<PathBuf> {
    let of_ranks = |ranks: usize| (0..ranks).map(move |rank| piece_path(whole, ranks, rank));
    numbers_of_ranks(whole).into_iter().flat_map(of_ranks).filter(|path| path.is_file()).collect()
}

/// The number of ranks whose pieces stand beside the whole.
fn ranks_beside(whole: &Path) -> Result<usize, JoinError> {
    let ranks = numbers_of_ranks(whole);
    match ranks[..] {
        [] => Err(JoinError::None(whole.to_owned())),
        [one] => Ok(one),
        _ => Err(JoinError::Several { whole: whole.to_owned(), ranks }),
    }
}

/// The numbers of ranks whose pieces stand beside the whole, ascending.
fn numbers_of_ranks(whole: &Path) -> Vec<usize> {
    let folder = whole.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| parts_of_name(Path::new(&entry.file_name())));
    let own = whole.file_name().map(Path::new);
    let mut ranks: Vec<usize> = names.filter(|(base, ..)| own == Some(base)).map(|(_, ranks, _)| ranks).collect();
    ranks.sort_unstable();
    ranks.dedup();
    ranks
}

/// One piece while it is joined.
struct Source {
    path: PathBuf,
    places: Places,
    open: Option<Results>,
}

impl Source {
    fn results(&mut self) -> Result<&Results, ResultsError> {
        match &mut self.open {
            Some(results) => Ok(results),
            closed => Ok(closed.insert(Results::open(&self.path)?)),
        }
    }
}

/// What all pieces of a run have in common.
#[derive(PartialEq)]
struct Common {
    title: String,
    qa: Vec<[String; 4]>,
    info: Vec<String>,
    names: [Vec<String>; 3],
}

impl Common {
    fn of(results: &Results) -> Common {
        let mut texts = results.arrays().whole_texts(names::QA).into_iter();
        let qa = std::iter::from_fn(|| Some([texts.next()?, texts.next()?, texts.next()?, texts.next()?]));
        Common {
            title: results.title(),
            qa: qa.collect(),
            info: results.arrays().whole_texts(names::INFO),
            names: [results.global_names(), results.nodal_names(), results.element_names()].map(<[String]>::to_vec),
        }
    }

    /// What tells two runs apart, in words.
    fn difference(&self, other: &Common) -> Option<String> {
        let when = |qa: &[[String; 4]]| qa.last().map_or("never".into(), |[.., date, time]| format!("{date} {time}"));
        if self.qa != other.qa {
            return Some(format!("one was begun at {}, the other at {}", when(&self.qa), when(&other.qa)));
        }
        let what = [
            (self.title != other.title, "their titles differ"),
            (self.names != other.names, "their variables differ"),
            (self.info != other.info, "their decks differ"),
        ];
        what.into_iter().find(|(differs, _)| *differs).map(|(_, what)| what.to_string())
    }
}

/// Joins pieces, in the order of ranks, to one file.
///
/// States that not all pieces have are left out.
///
/// # Errors
/// When a piece cannot be read or does not fit the others, or the whole cannot be written; then a file of that name is as it was.
pub fn join(pieces: &[PathBuf], output: &Path) -> Result<Joined, JoinError> {
    files::replaceable(output).map_err(ResultsError::io("write", output))?; // What is no file must not be removed, either.
    let mut opened = Opened::default();
    for path in pieces {
        opened.add(path, pieces)?;
    }
    let Opened { sources, first: Some(first), gathering: Some(gathering), least, most } = opened else {
        return Err(JoinError::None(output.to_owned()));
    };
    let whole = gathering.finish().map_err(|what| JoinError::Damaged { path: pieces[0].clone(), what })?;
    let (nodes, elements) = (first.whole.nodes, first.whole.elements());
    let mut joining = Joining { sources, common: first.common, nodes, elements };
    // Half of a whole would pass for one, so it has its name only when all states are in it.
    let [_, unfinished] = names_in_writing(output);
    let written = joining.write(&unfinished, whole, &first.times[..least]);
    let written =
        written.and_then(|()| std::fs::rename(&unfinished, output).map_err(ResultsError::io("write", output)));
    if let Err(error) = written {
        let _ = std::fs::remove_file(&unfinished); // It may not even exist; the first error is the one to tell.
        return Err(error.into());
    }
    Ok(Joined { pieces: pieces.len(), states: least, most })
}

/// What the first piece says, against which the others are held.
struct First {
    common: Common,
    whole: Sizes,
    times: Vec<f64>,
}

impl First {
    /// Why another piece is not of the same run.
    fn difference(&self, other: &First) -> Option<String> {
        let times_differ = self.times.iter().zip(&other.times).any(|(a, b)| a.to_bits() != b.to_bits());
        self.common.difference(&other.common).or_else(|| {
            let what = [
                (self.whole != other.whole, "their meshes differ"),
                (times_differ, "the times of their states differ"),
            ];
            what.into_iter().find(|(differs, _)| *differs).map(|(_, what)| what.to_string())
        })
    }
}

/// Pieces opened so far.
#[derive(Default)]
struct Opened {
    sources: Vec<Source>,
    first: Option<First>,
    gathering: Option<Gathering>,
    /// Least and most states of a piece.
    least: usize,
    most: usize,
}

impl Opened {
    fn add(&mut self, path: &Path, pieces: &[PathBuf]) -> Result<(), JoinError> {
        let results = Results::open(path)?;
        let Told { part, whole, ranks } = told(&results)?;
        let damaged = |what| JoinError::Damaged { path: path.to_owned(), what };
        if ranks != pieces.len() {
            return Err(damaged(format!("it says that it is one of {ranks} pieces, not of {}", pieces.len())));
        }
        let gathering = self.gathering.get_or_insert_with(|| Gathering::new(&whole, &part.mesh));
        let own = First { common: Common::of(&results), whole, times: results.times().to_vec() };
        let states = own.times.len();
        if let Some(what) = self.first.as_ref().and_then(|first| first.difference(&own)) {
            return Err(JoinError::Strangers { first: pieces[0].clone(), other: path.to_owned(), what });
        }
        gathering.add(&part).map_err(damaged)?;
        self.least = if self.first.is_none() { states } else { self.least.min(states) };
        self.most = self.most.max(states);
        self.first.get_or_insert(own);
        let open = (pieces.len() <= OPEN_FILES).then_some(results);
        self.sources.push(Source { path: path.to_owned(), places: part.places, open });
        Ok(())
    }
}

/// All pieces, and what they make.
struct Joining {
    sources: Vec<Source>,
    common: Common,
    nodes: usize,
    elements: usize,
}

impl Joining {
    fn write(&mut self, output: &Path, mut whole: Mesh, times: &[f64]) -> Result<(), ResultsError> {
        let own = self.common.qa.pop().unwrap_or_default();
        whole.qa = std::mem::take(&mut self.common.qa);
        let [global, nodal, element] = self.common.names.clone();
        let header = ResultsHeader {
            mesh: &whole,
            title: self.common.title.clone(),
            global,
            nodal,
            element,
            qa: own,
            info: std::mem::take(&mut self.common.info),
        };
        let mut file = ResultsWriter::create(output, &header)?;
        for (state, &time) in times.iter().enumerate() {
            let (globals, nodal, element) = self.state(state)?;
            file.write_state(time, &globals, &nodal, &element)?;
        }
        Ok(())
    }

    /// Globals, nodal and element values of the whole in a state.
    fn state(&mut self, state: usize) -> Result<State, ResultsError> {
        let [_, nodal_names, element_names] = &self.common.names;
        let mut nodal = vec![vec![0.0; self.nodes]; nodal_names.len()];
        let mut element = vec![vec![0.0; self.elements]; element_names.len()];
        let mut globals = Vec::new();
        let close = self.sources.len() > OPEN_FILES;
        // The lowest rank that has a node answers for it, so it comes last.
        for source in self.sources.iter_mut().rev() {
            let places = std::mem::take(&mut source.places);
            let results = source.results()?;
            globals = results.global(state)?;
            for (name, whole) in nodal_names.iter().zip(&mut nodal).filter(|_| !places.nodes.is_empty()) {
                place(&results.nodal(name, state)?, &places.nodes, whole);
            }
            for (name, whole) in element_names.iter().zip(&mut element).filter(|_| !places.elements.is_empty()) {
                place(&results.element(name, state)?, &places.elements, whole);
            }
            source.places = places;
            if close {
                source.open = None;
            }
        }
        Ok((globals, nodal, element))
    }
}

/// Globals, nodal and element values.
type State = (Vec<f64>, Vec<Vec<f64>>, Vec<Vec<f64>>);

fn place(values: &[f64], places: &[u32], whole: &mut [f64]) {
    for (&value, &place) in values.iter().zip(places) {
        whole[place as usize] = value;
    }
}
