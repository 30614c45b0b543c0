//! The netCDF library seen as named arrays: what the EXODUS readers ask of a file, with errors that name the array.

use netcdf::types::{FloatType, IntType, NcTypeDescriptor, NcVariableType};
use netcdf::{AttributeValue, Extent, Extents, Variable};
use std::ops::Range;
use std::path::Path;

/// A netCDF file opened for reading.
pub struct Arrays {
    file: netcdf::File,
    /// Bytes that the largest variable of a sound file may have.
    limit: u64,
}

/// A character as netCDF stores it; the library keeps text apart from bytes.
#[repr(transparent)]
#[derive(Copy, Clone)]
pub struct Character(pub u8);

// SAFETY: Character is a transparent u8, which is the memory layout of netCDF's NC_CHAR.
unsafe impl NcTypeDescriptor for Character {
    fn type_descriptor() -> NcVariableType {
        NcVariableType::Char
    }
}

/// Why an array cannot be had: a sentence that names it.
pub type Reason = String;

impl Arrays {
    /// Opens the file. `length` is its size in bytes: damaged headers that ask for more memory than the file
    /// can fill are refused by it.
    ///
    /// # Errors
    ///
    /// What the netCDF library cannot read as one of its files.
    pub fn open(path: &Path, length: u64) -> Result<Self, netcdf::Error> {
        silence_hdf5();
        // Deflate compresses at most about a thousandfold, and only netCDF-4 files are compressed.
        Ok(Arrays { file: netcdf::open(path)?, limit: length.saturating_mul(2000).saturating_add(1 << 20) })
    }

    /// The length of a dimension, if it is there.
    pub fn dimension(&self, name: &str) -> Option<usize> {
        self.file.dimension_len(name)
    }

    /// True if there is such a variable.
    pub fn has(&self, name: &str) -> bool {
        self.file.variable(name).is_some()
    }

    /// The lengths of a variable's dimensions, slowest first.
    pub fn shape(&self, name: &str) -> Option<Vec<usize>> {
        self.file.variable(name).map(|v| shape(&v))
    }

    /// A global text attribute.
    pub fn text(&self, name: &str) -> Option<String> {
        self.file.attribute(name).and_then(|a| as_text(a.value().ok()?))
    }

    /// True if there is such a global attribute.
    pub fn has_attribute(&self, name: &str) -> bool {
        self.file.attribute(name).is_some()
    }

    /// A text attribute of a variable.
    pub fn variable_text(&self, variable: &str, name: &str) -> Option<String> {
        self.file.variable(variable).and_then(|v| as_text(v.attribute_value(name)?.ok()?))
    }

    /// A whole variable of integers of any width; `None` if it does not exist.
    ///
    /// # Errors
    ///
    /// The variable holds something else than integers, or more than the file can.
    pub fn integers(&self, name: &str) -> Result<Option<Vec<i64>>, Reason> {
        let Some(variable) = self.file.variable(name) else { return Ok(None) };
        match variable.vartype() {
            // 64-bit unsigned values beyond the signed range are refused by the library.
            NcVariableType::Int(_) => self.get(&variable, name, &(..).into()).map(Some),
            other => Err(format!("{name} holds {}, integers belong there", kind(&other))),
        }
    }

    /// The rows of a variable of integers from one to another.
    ///
    /// # Errors
    ///
    /// The variable is missing, holds something else than integers, or lacks these rows.
    pub fn rows_of_integers(&self, name: &str, rows: Range<usize>) -> Result<Vec<i64>, Reason> {
        let variable = self.file.variable(name).ok_or_else(|| format!("{name} is missing"))?;
        match variable.vartype() {
            NcVariableType::Int(_) => self.get(&variable, name, &part(&variable, rows)),
            other => Err(format!("{name} holds {}, integers belong there", kind(&other))),
        }
    }

    /// The rows of a variable of numbers from one to another.
    ///
    /// # Errors
    ///
    /// The variable is missing, holds no numbers, or lacks these rows.
    pub fn rows_of_reals(&self, name: &str, rows: Range<usize>) -> Result<Vec<f64>, Reason> {
        let variable = self.file.variable(name).ok_or_else(|| format!("{name} is missing"))?;
        self.part_of_reals(name, &part(&variable, rows))
    }

    /// A whole variable of numbers of any precision; `None` if it does not exist.
    ///
    /// # Errors
    ///
    /// The variable holds no numbers, or more than the file can.
    pub fn reals(&self, name: &str) -> Result<Option<Vec<f64>>, Reason> {
        if !self.has(name) {
            return Ok(None);
        }
        self.part_of_reals(name, &(..).into()).map(Some)
    }

    /// A part of a variable of numbers.
    ///
    /// # Errors
    ///
    /// The variable is missing, holds no numbers, or lacks this part.
    pub fn part_of_reals(&self, name: &str, part: &Extents) -> Result<Vec<f64>, Reason> {
        let variable = self.file.variable(name).ok_or_else(|| format!("{name} is missing"))?;
        match variable.vartype() {
            NcVariableType::Int(_) | NcVariableType::Float(_) => self.get(&variable, name, part),
            other => Err(format!("{name} holds {}, numbers belong there", kind(&other))),
        }
    }

    /// A variable of characters as trimmed texts, one per row of its last dimension.
    /// Missing or strange ones give nothing: texts are never needed to compute.
    pub fn texts(&self, name: &str) -> Vec<String> {
        self.whole_texts(name).iter().map(|text| text.trim().to_owned()).collect()
    }

    /// The same with the blanks around them.
    pub fn whole_texts(&self, name: &str) -> Vec<String> {
        let Some(variable) = self.file.variable(name) else { return Vec::new() };
        let width = shape(&variable).last().copied().unwrap_or(0);
        if variable.vartype() != NcVariableType::Char || width == 0 {
            return Vec::new();
        }
        let characters: Vec<Character> = self.get(&variable, name, &(..).into()).unwrap_or_default();
        characters.chunks(width).map(text).collect()
    }

    /// Asks for all attributes, variables and, if asked to, their values, of whatever names.
    pub fn touch(&self, values: bool) {
        for attribute in self.file.attributes() {
            let _ = attribute.value();
        }
        for variable in self.file.variables() {
            for attribute in variable.attributes() {
                let _ = attribute.value();
            }
            let all = (..).into();
            let _ = match variable.vartype() {
                _ if !values => Ok(()),
                NcVariableType::Int(_) => self.get::<i64>(&variable, "", &all).map(drop),
                NcVariableType::Float(_) => self.get::<f64>(&variable, "", &all).map(drop),
                NcVariableType::Char => self.get::<Character>(&variable, "", &all).map(drop),
                _ => Ok(()),
            };
        }
    }

    fn get<T: NcTypeDescriptor + Copy>(
        &self,
        variable: &Variable,
        name: &str,
        part: &Extents,
    ) -> Result<Vec<T>, Reason> {
        if (variable.len() as u64).saturating_mul(variable.vartype().size() as u64) > self.limit {
            return Err(format!("{name} claims to be larger than the file; the file is damaged"));
        }
        variable.get_values(part.clone()).map_err(|error| format!("{name} cannot be read: {error}"))
    }
}

/// Keeps HDF5 from printing its error stack on the terminal: netCDF probes for attributes that need not be there, and
/// asks HDF5 for silence only on the thread that happens to be first.
fn silence_hdf5() {
    let _lock = hdf5_metno_sys::LOCK.lock();
    // SAFETY: sets a property of this thread's default error stack under the lock that guards all calls to HDF5;
    // without a callback no pointer is kept.
    unsafe { hdf5_metno_sys::h5e::H5Eset_auto2(hdf5_metno_sys::h5e::H5E_DEFAULT, None, std::ptr::null_mut()) };
}

/// Some rows of a variable.
fn part(variable: &Variable, rows: Range<usize>) -> Extents {
    let first = Extent::SliceCount { start: rows.start, count: rows.len(), stride: 1 };
    let all = Extent::Slice { start: 0, stride: 1 };
    let rest = variable.dimensions().len().saturating_sub(1);
    Extents::from([first].into_iter().chain(std::iter::repeat_n(all, rest)).collect::<Vec<_>>())
}

fn shape(variable: &Variable) -> Vec<usize> {
    variable.dimensions().iter().map(|d| d.len()).collect()
}

fn as_text(value: AttributeValue) -> Option<String> {
    match value {
        AttributeValue::Str(text) => Some(text.trim_end().to_owned()),
        AttributeValue::Strs(texts) => texts.first().map(|text| text.trim_end().to_owned()),
        _ => None,
    }
}

/// Names are padded with NULs or with blanks.
fn text(characters: &[Character]) -> String {
    let bytes: Vec<u8> = characters.iter().map(|c| c.0).take_while(|&b| b != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

fn kind(variable_type: &NcVariableType) -> &'static str {
    match variable_type {
        NcVariableType::Int(IntType::U8 | IntType::I8) => "bytes",
        NcVariableType::Int(_) => "integers",
        NcVariableType::Float(FloatType::F32 | FloatType::F64) => "real numbers",
        NcVariableType::Char | NcVariableType::String => "text",
        _ => "data of another kind",
    }
}
