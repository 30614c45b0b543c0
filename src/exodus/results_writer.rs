//! Results of a run, appended state by state to an EXODUS II file that is readable at any instant.
//!
//! The netCDF library defines the file and writes the mesh; the finished header then tells where states belong, and
//! they are written there directly: first the state's data, then the number of states in the header. A run that is
//! killed between the two leaves a file that lists only whole states, and a file that is still growing may be opened.

use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::container::{Container, Layout, inspect};
use super::error::ResultsError;
use super::pieces::Piece;
use super::restart::Extra;
use super::write::{Contents, LINE_WIDTH, cut, write_file};
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
    states: u64,
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
    pub(super) fn create_with(path: &Path, header: &ResultsHeader, extra: &Extra) -> Result<Self, ResultsError> {
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
            states: 0,
            globals: header.global.len(),
            nodal: (header.nodal.len(), mesh.coordinates.len()),
            element: (header.element.len(), mesh.element_count()),
        })
    }

    /// Number of states written so far.
    pub fn states(&self) -> usize {
        self.states as usize
    }

    /// Waits until all that was written is on the disk, where it outlives a power failure.
    pub(super) fn sync(&self) -> Result<(), ResultsError> {
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
        self.expect("the list of globals", globals.len(), self.globals)?;
        self.expect_arrays("nodal", nodal, self.nodal)?;
        self.expect_arrays("element", element, self.element)?;
        self.append(time, globals, nodal, element).map_err(ResultsError::io("write", &self.path))?;
        self.states += 1;
        Ok(())
    }

    /// The record's data in the order in which the variables were defined, then the number of records.
    fn append(&mut self, time: f64, globals: &[f64], nodal: &[Vec<f64>], element: &[Vec<f64>]) -> io::Result<()> {
        let first = self.layout.record_variables.first().map_or(self.layout.promised, |v| v.begin);
        self.file.seek(SeekFrom::Start(first + self.states * self.layout.record_size))?;
        let mut record = BufWriter::with_capacity(1 << 20, &self.file);
        put(&mut record, &[time])?;
        put(&mut record, globals)?;
        for values in nodal.iter().chain(element) {
            put(&mut record, values)?;
        }
        record.flush()?;
        drop(record);
        let count = self.states + 1;
        self.file.seek(SeekFrom::Start(RECORD_COUNT))?;
        match self.layout.version {
            5 => self.file.write_all(&count.to_be_bytes()),
            _ => self.file.write_all(&(count as u32).to_be_bytes()),
        }
    }

    fn expect(&self, what: &str, got: usize, expected: usize) -> Result<(), ResultsError> {
        if got == expected {
            return Ok(());
        }
        Err(ResultsError::Shape { path: self.path.clone(), what: what.into(), got, expected })
    }

    fn expect_arrays(&self, kind: &str, arrays: &[Vec<f64>], shape: (usize, usize)) -> Result<(), ResultsError> {
        self.expect(&format!("the list of {kind} variables"), arrays.len(), shape.0)?;
        arrays.iter().try_for_each(|array| self.expect(&format!("an array of {kind} values"), array.len(), shape.1))
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
