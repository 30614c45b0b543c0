//! Results of a run, appended state by state to an EXODUS II file that is readable at any instant.
//!
//! The netCDF library defines the file and writes the mesh; the finished header then tells where states belong, and
//! they are written there directly: first the state's data, then the number of states in the header. A run that is
//! killed between the two leaves a file that lists only whole states, and a file that is still growing may be opened.

use std::cell::Cell;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::common::files;
use crate::exodus::file::container::{Container, Layout, inspect};
use crate::exodus::file::error::ResultsError;
use crate::exodus::mesh::write::{Contents, LINE_WIDTH, cut, write_file};
use crate::exodus::pieces::Piece;
use crate::exodus::results::restart::Extra;
use crate::mesh::Mesh;

/// Offset of the number of records in every netCDF classic file.
const RECORD_COUNT: u64 = 4;

/// What a results file holds beside its states.
#[derive(Debug, Clone)]
pub struct ResultsHeader<'a> {
    /// The undeformed mesh, written whole.
    pub mesh: &'a Mesh,
    /// Title of the run, cut to 80 characters.
    pub title: String,
    /// Names of the global variables.
    pub global: Vec<String>,
    /// Names of the nodal variables. `DISPLX`, `DISPLY`, `DISPLZ` come first so that viewers find them.
    pub nodal: Vec<String>,
    /// Names of the element variables, each present in every block.
    pub element: Vec<String>,
    /// Quality-assurance record of this run: program, version, date, time. Those of the mesh are put before it.
    pub qa: [String; 4],
    /// Free lines, customarily the deck. Longer ones are continued on the next line after 80 characters.
    pub info: Vec<String>,
}

/// An EXODUS II file that states are appended to.
#[derive(Debug)]
pub struct ResultsWriter {
    path: PathBuf,
    file: File,
    layout: Layout,
    states: Cell<u64>,
    globals: usize,
    nodal: (usize, usize),
    element: (usize, usize),
}

impl ResultsWriter {
    /// Writes mesh, names and records, and returns a writer that appends states.
    ///
    /// The container is netCDF 64-bit offset, or CDF-5 when sizes or numbers demand it.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn create(path: &Path, header: &ResultsHeader) -> Result<Self, ResultsError> {
        Self::create_with(path, header, &Extra::default())
    }

    /// The same for a piece of the results, whose mesh is that of `piece`.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn create_piece(path: &Path, header: &ResultsHeader, piece: &Piece) -> Result<Self, ResultsError> {
        let header = ResultsHeader { mesh: &piece.part.mesh, ..header.clone() };
        Self::create_with(path, &header, &Extra { piece: Some(piece), ..Extra::default() })
    }

    /// The same, with what EXODUS knows nothing of.
    pub(in crate::exodus) fn create_with(
        path: &Path,
        header: &ResultsHeader,
        extra: &Extra,
    ) -> Result<Self, ResultsError> {
        let mesh = header.mesh;
        let mut qa = mesh.qa.clone();
        qa.push(header.qa.clone());
        let info: Vec<String> = header.info.iter().flat_map(|line| wrap(line)).collect();
        let contents = Contents {
            title: &header.title,
            qa: &qa,
            info: &info,
            global: &header.global,
            nodal: &header.nodal,
            element: &header.element,
            extra: Some(extra),
        };
        write_file(path, mesh, &contents)?;
        let layout = match inspect(path).map_err(ResultsError::io("read", path))? {
            Container::Classic(layout) => layout,
            _ => return Err(ResultsError::Unusable { path: path.to_owned(), what: "it changed while written".into() }),
        };
        Ok(ResultsWriter {
            file: OpenOptions::new().write(true).open(path).map_err(ResultsError::io("write", path))?,
            path: path.to_owned(),
            layout,
            states: Cell::new(0),
            globals: header.global.len(),
            nodal: (header.nodal.len(), mesh.coordinates.len()),
            element: (header.element.len(), mesh.element_count()),
        })
    }

    /// Number of states written so far.
    pub fn states(&self) -> usize {
        self.states.get() as usize
    }

    /// Makes sure that the file still has its name: a file that was removed, or moved away with its folder, can be written all
    /// the same, and nobody would find it.
    ///
    /// # Errors
    /// When there is none of this name any more, or another one.
    pub fn in_place(&self) -> Result<(), ResultsError> {
        files::in_place(&self.file, &self.path).map_err(ResultsError::io("keep", &self.path))
    }

    /// Waits until all that was written is on the disk, where it outlives a power failure.
    pub(in crate::exodus) fn sync(&self) -> Result<(), ResultsError> {
        self.file.sync_all().map_err(ResultsError::io("write", &self.path))
    }

    /// Appends one state: the time, the globals, one array over all nodes per nodal variable, one array over all
    /// elements in file order per element variable, in the order of the header.
    ///
    /// When it returns, the state is in the operating system's hands and outlives the process (not a power failure).
    ///
    /// # Errors
    /// When an array has the wrong length, or the file cannot be written; the states before stay readable and the
    /// same state may be tried again.
    pub fn write_state(
        &mut self,
        time: f64,
        globals: &[f64],
        nodal: &[Vec<f64>],
        element: &[Vec<f64>],
    ) -> Result<(), ResultsError> {
        self.expect("the list of nodal variables", nodal.len(), self.nodal.0)?;
        self.expect("the list of element variables", element.len(), self.element.0)?;
        let mut state = self.begin_state(time, globals)?;
        nodal.iter().chain(element).try_for_each(|values| state.put(values))?;
        state.finish()
    }

    /// Begins a state whose arrays come one after the other.
    ///
    /// # Errors
    /// As [`ResultsWriter::write_state`].
    pub fn begin_state(&mut self, time: f64, globals: &[f64]) -> Result<StateWriter<'_>, ResultsError> {
        self.expect("the list of globals", globals.len(), self.globals)?;
        let failed = ResultsError::io("write", &self.path);
        let first = self.layout.record_variables.first().map_or(self.layout.promised, |v| v.begin);
        let begun = (&self.file).seek(SeekFrom::Start(first + self.states.get() * self.layout.record_size));
        let mut record = BufWriter::with_capacity(1 << 20, &self.file);
        let begun = begun.and_then(|_| put(&mut record, &[time])).and_then(|()| put(&mut record, globals));
        begun.map_err(failed)?;
        Ok(StateWriter { record, writer: self, put: 0 })
    }

    /// Puts the number of states up by one, in the header of the file too.
    fn count_state(&self) -> io::Result<()> {
        let (count, mut file) = (self.states.get() + 1, &self.file);
        file.seek(SeekFrom::Start(RECORD_COUNT))?;
        match self.layout.version {
            5 => file.write_all(&count.to_be_bytes())?,
            _ => file.write_all(&(count as u32).to_be_bytes())?,
        }
        self.states.set(count);
        Ok(())
    }

    fn expect(&self, what: &str, got: usize, expected: usize) -> Result<(), ResultsError> {
        if got == expected {
            return Ok(());
        }
        Err(ResultsError::Shape { path: self.path.clone(), what: what.into(), got, expected })
    }
}

/// A state that is being written, array by array. One that is not finished does not count.
#[derive(Debug)]
pub struct StateWriter<'a> {
    record: BufWriter<&'a File>,
    writer: &'a ResultsWriter,
    /// Number of arrays so far.
    put: usize,
}

impl StateWriter<'_> {
    /// The values of the next variable: the nodal variables of the header come first, then those of the elements.
    ///
    /// # Errors
    /// When the array has the wrong length, or the file cannot be written.
    pub fn put(&mut self, values: &[f64]) -> Result<(), ResultsError> {
        let (nodal, element) = (self.writer.nodal, self.writer.element);
        let (kind, length) = if self.put < nodal.0 { ("nodal", nodal.1) } else { ("element", element.1) };
        self.writer.expect(&format!("an array of {kind} values"), values.len(), length)?;
        self.put += 1;
        put(&mut self.record, values).map_err(ResultsError::io("write", &self.writer.path))
    }

    /// Ends the state: from now on the file lists it.
    ///
    /// # Errors
    /// When variables are missing, or the file cannot be written.
    pub fn finish(mut self) -> Result<(), ResultsError> {
        let writer = self.writer;
        writer.expect("the list of variables", self.put, writer.nodal.0 + writer.element.0)?;
        let flushed = self.record.flush();
        flushed.and_then(|()| writer.count_state()).map_err(ResultsError::io("write", &writer.path))
    }
}

/// Values in the byte order of the netCDF classic formats, a piece at a time so that the compiler swaps whole vectors.
fn put(out: &mut impl Write, values: &[f64]) -> io::Result<()> {
    let mut swapped = [0; 8 << 10];
    for piece in values.chunks(swapped.len() / 8) {
        for (bytes, value) in swapped.chunks_exact_mut(8).zip(piece) {
            bytes.copy_from_slice(&value.to_be_bytes());
        }
        out.write_all(&swapped[..8 * piece.len()])?;
    }
    Ok(())
}

/// A line in pieces that fit an info record.
fn wrap(line: &str) -> Vec<String> {
    let mut rest = line;
    let mut pieces = Vec::new();
    loop {
        let piece = cut(rest, LINE_WIDTH - 1);
        pieces.push(piece.to_owned());
        rest = &rest[piece.len()..];
        if rest.is_empty() || piece.is_empty() {
            return pieces;
        }
    }
}
