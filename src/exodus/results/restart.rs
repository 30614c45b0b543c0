//! Restart files: the whole state of a run as an EXODUS II file of one state, with the mesh that it belongs to.
//!
//! Numbers are global variables, the rest nodal and element variables, so that any reader of EXODUS shows them; what is
//! keyed otherwise stands in further netCDF variables `urto_NAME`. A file appears under its name only when all of it is on
//! the disk, and ends in a checksum of all its bytes ([`checksum`]).

use std::fs::File;
use std::path::{Path, PathBuf};

use crate::exodus::file::checksum::{self, Seal};
use crate::exodus::file::error::ResultsError;
use crate::exodus::pieces::Piece;
use crate::exodus::results::Results;
use crate::exodus::results::writer::{ResultsHeader, ResultsWriter};
use crate::mesh::Mesh;
use crate::restart::{List, Snapshot};

/// Global attribute that makes an EXODUS file a restart file; it says of what problem.
pub(in crate::exodus) const IDENTITY: &str = "urto_restart";
/// Global attribute that lists the further variables.
pub(in crate::exodus) const LISTS: &str = "urto_lists";

const BROKEN: &str = "the restart file is damaged: its bytes are not those that were written, as the checksum at its end \
     shows\nhelp: a run from it could go wrong unseen; copy the file again from where it was written";
const UNSEALED: &str = "the restart file does not end in its checksum: it has been cut short, or written anew by another \
     program\nhelp: copy the file again from where it was written";

/// A state and what it is a state of.
#[derive(Debug, Clone)]
pub struct Restart {
    /// The undeformed mesh.
    pub mesh: Mesh,
    /// What the state is a state of, in the words of the writer.
    pub identity: String,
    /// The state.
    pub snapshot: Snapshot,
}

/// What goes into a restart file beside the state.
#[derive(Debug, Clone)]
pub struct RestartHeader<'a> {
    /// The undeformed mesh.
    pub mesh: &'a Mesh,
    /// Title of the run.
    pub title: &'a str,
    /// Quality-assurance record: program, version, date, time.
    pub qa: [String; 4],
    /// Free lines, customarily the deck.
    pub info: Vec<String>,
    /// What the state is a state of.
    pub identity: String,
}

/// What a file holds that EXODUS knows nothing of.
#[derive(Default)]
pub(in crate::exodus) struct Extra<'a> {
    /// What makes the file a piece of a larger one, if it is one.
    pub piece: Option<&'a Piece>,
    /// What the state is a state of, in a restart file.
    pub identity: Option<&'a str>,
    /// Its lists.
    pub lists: &'a [List],
}

/// Writes a state to `unfinished`, sees it onto the disk, and hands it to `finish`, which gives it its name.
///
/// # Errors
/// When it cannot be written; nothing is left of it then.
pub fn write_restart(
    unfinished: &Path,
    header: &RestartHeader,
    snapshot: Snapshot,
    finish: impl FnOnce() -> std::io::Result<()>,
) -> Result<(), ResultsError> {
    let written = write(unfinished, header, snapshot).and_then(|()| {
        finish().map_err(ResultsError::io("put in place", unfinished))?;
        see_onto_disk(unfinished.parent());
        Ok(())
    });
    if written.is_err() {
        let _ = std::fs::remove_file(unfinished); // It may not even exist; the first error is the one to tell.
    }
    written
}

fn write(path: &Path, header: &RestartHeader, snapshot: Snapshot) -> Result<(), ResultsError> {
    let time = snapshot.time();
    let shown = displacements(header.mesh, &snapshot);
    let (global, numbers): (Vec<String>, Vec<f64>) = snapshot.numbers.into_iter().unzip();
    let (nodal, nodal_values): (Vec<String>, Vec<Vec<f64>>) = shown.into_iter().chain(snapshot.nodal).unzip();
    let (element, element_values): (Vec<String>, Vec<Vec<f64>>) = snapshot.element.into_iter().unzip();
    let of_results = ResultsHeader {
        mesh: header.mesh,
        title: header.title.to_string(),
        global,
        nodal,
        element,
        qa: header.qa.clone(),
        info: header.info.clone(),
    };
    let extra = Extra { piece: None, identity: Some(&header.identity), lists: &snapshot.lists };
    let mut writer = ResultsWriter::create_with(path, &of_results, &extra)?;
    writer.write_state(time, &numbers, &nodal_values, &element_values)?;
    checksum::seal(path).map_err(ResultsError::io("write", path))?;
    writer.sync()
}

/// Names of the displacements, which only show the state: positions are what is read.
const DISPLACEMENTS: [(&str, &str); 3] = [("DISPLX", "POSX"), ("DISPLY", "POSY"), ("DISPLZ", "POSZ")];

fn displacements(mesh: &Mesh, snapshot: &Snapshot) -> Vec<(String, Vec<f64>)> {
    let of_axis = |(axis, (name, position)): (usize, (&str, &str))| {
        let (_, now) = snapshot.nodal.iter().find(|(known, _)| known == position)?;
        let moved = now.iter().zip(&mesh.coordinates).map(|(now, initial)| now - initial[axis]).collect();
        Some((name.to_string(), moved))
    };
    DISPLACEMENTS.into_iter().enumerate().filter_map(of_axis).collect()
}

/// Asks the system to see a folder's entries onto the disk. Where it will not, the file is whole all the same.
fn see_onto_disk(folder: Option<&Path>) {
    let folder = folder.filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
}

/// Reads a restart file.
///
/// # Errors
/// When it is no restart file, cut short or damaged.
pub fn read_restart(path: &Path) -> Result<Restart, ResultsError> {
    let (results, identity) = open(path)?;
    let numbers = results.global_names().iter().cloned().zip(results.global(0)?).collect();
    let displacement = |name: &&String| DISPLACEMENTS.iter().all(|(known, _)| known != name);
    let nodal = results.nodal_names().iter().filter(displacement);
    let nodal = nodal.map(|name| Ok((name.clone(), results.nodal(name, 0)?))).collect::<Result<_, ResultsError>>()?;
    let element = results.element_names().iter();
    let element =
        element.map(|name| Ok((name.clone(), results.element(name, 0)?))).collect::<Result<_, ResultsError>>()?;
    let lists = lists(path, &results)?;
    Ok(Restart { mesh: results.mesh()?, identity, snapshot: Snapshot { numbers, nodal, element, lists } })
}

/// One of the numbers in a restart file.
///
/// # Errors
/// As [`read_restart`], and when there is no such number.
pub fn restart_number(path: &Path, name: &str) -> Result<f64, ResultsError> {
    let (results, _) = open(path)?;
    let place = results.global_names().iter().position(|known| known == name);
    let number = place.and_then(|place| results.global(0).ok()?.get(place).copied());
    number.ok_or_else(|| unusable(path, format!("it has no {name}")))
}

fn unusable(path: &Path, what: impl Into<String>) -> ResultsError {
    ResultsError::Unusable { path: PathBuf::from(path), what: what.into() }
}

/// Opens a restart file of which every byte is as it was written.
fn open(path: &Path) -> Result<(Results, String), ResultsError> {
    // What keeps a file from being read at all is told by who reads all of it.
    let seal = checksum::check(path).unwrap_or(Seal::Missing);
    if seal == Seal::Broken {
        return Err(unusable(path, BROKEN));
    }
    let results = Results::open(path)?;
    let identity = results.arrays().text(IDENTITY);
    let identity = identity.ok_or_else(|| unusable(path, "this is an EXODUS file, but no restart file of urto"))?;
    if seal == Seal::Missing {
        return Err(unusable(path, UNSEALED));
    }
    if results.times().len() != 1 {
        return Err(unusable(path, "this restart file holds no whole state"));
    }
    Ok((results, identity))
}

fn lists(path: &Path, results: &Results) -> Result<Vec<List>, ResultsError> {
    let names = results.arrays().text(LISTS).unwrap_or_default();
    let read = |name: &str| {
        let variable = list_variable(name);
        let shape = results.arrays().shape(&variable).unwrap_or_default();
        match (shape.as_slice(), results.arrays().reals(&variable)) {
            (&[rows, width], Ok(Some(values))) if values.len() == rows * width => {
                Ok(List { name: name.to_string(), width, values })
            }
            (_, Err(what)) => Err(unusable(path, what)),
            _ => Err(unusable(path, format!("{variable} is missing or has the wrong shape"))),
        }
    };
    names.split_whitespace().map(read).collect()
}

/// Name of the netCDF variable of a list.
pub(in crate::exodus) fn list_variable(name: &str) -> String {
    format!("urto_{name}")
}
