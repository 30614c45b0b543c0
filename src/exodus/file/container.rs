//! What kind of file is this, and is all of it there? Answered from the first bytes, before any library opens it.
//!
//! The netCDF library reads zeros where a classic file is cut short, and allocates what a damaged header demands.
//! The header grammar of the classic formats is small (netCDF file format specification: classic, 64-bit offset and
//! 64-bit data), so it is read here: it tells how long the file must be, and where each state begins, which lets
//! [`ResultsWriter`](crate::exodus::ResultsWriter) append states in an order that survives a kill at any instant.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::path::Path;

use crate::common::files;

/// The kinds of file that a mesh may come in.
#[derive(Debug, Clone, PartialEq)]
pub enum Container {
    /// netCDF classic, 64-bit offset or 64-bit data.
    Classic(Layout),
    /// netCDF-4, stored as HDF5.
    Hdf5,
    /// EXODUS I: Fortran unformatted records.
    FortranRecords,
    /// Nothing known; or a classic file whose header makes no sense, with the reason.
    Unknown(String),
}

/// Where things are in a netCDF classic file.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Version byte: 1 classic, 2 64-bit offset, 5 64-bit data.
    pub version: u8,
    /// Number of records (states) the header admits to.
    pub records: u64,
    /// Bytes from one record to the next.
    pub record_size: u64,
    /// Bytes that the header promises.
    pub promised: u64,
    /// Bytes that the file has.
    pub length: u64,
    /// The variables with an unlimited dimension, in the order of their data inside a record.
    pub record_variables: Vec<RecordVariable>,
}

/// One variable's share of every record.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordVariable {
    /// Its name.
    pub name: String,
    /// Offset of its part of record 0 from the beginning of the file.
    pub begin: u64,
    /// Bytes in each record.
    pub size: u64,
}

/// Looks at a file's first bytes, and at its header if it is a netCDF classic file.
///
/// # Errors
///
/// The file is not a regular one, or cannot be read.
pub fn inspect(path: &Path) -> io::Result<Container> {
    files::regular(path)?;
    let file = File::open(path)?;
    let length = file.metadata()?.len();
    let mut magic = Vec::new();
    let mut reader = BufReader::new(file);
    reader.by_ref().take(4).read_to_end(&mut magic)?;
    Ok(match magic.as_slice() {
        [b'C', b'D', b'F', version @ (1 | 2 | 5)] => match Header::new(reader, *version, length).layout() {
            Ok(layout) => Container::Classic(layout),
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                Container::Unknown("its netCDF header is cut short".into())
            }
            Err(error) if error.kind() == io::ErrorKind::InvalidData => {
                Container::Unknown(format!("its netCDF header is damaged: {error}"))
            }
            Err(error) => return Err(error),
        },
        [0x89, b'H', b'D', b'F'] => Container::Hdf5,
        [0, 0, 0, 80] | [80, 0, 0, 0] => Container::FortranRecords,
        [0, 0, 0, 0] => {
            // The upper half of a mark of eight bytes.
            let mut rest = Vec::new();
            reader.take(4).read_to_end(&mut rest)?;
            match rest.as_slice() {
                [0, 0, 0, 80] => Container::FortranRecords,
                _ => Container::Unknown("it is not a netCDF file".into()),
            }
        }
        [] => Container::Unknown("it is empty".into()),
        _ => Container::Unknown("it is not a netCDF file".into()),
    })
}

/// Reads the header of a netCDF classic file from front to back.
struct Header {
    reader: BufReader<File>,
    version: u8,
    length: u64,
}

/// One variable as the header describes it.
struct Variable {
    name: String,
    dimensions: Vec<u64>,
    type_size: u64,
    begin: u64,
}

// Tags of the header's lists.
const DIMENSIONS: u32 = 0x0A;
const VARIABLES: u32 = 0x0B;
const ATTRIBUTES: u32 = 0x0C;

impl Header {
    fn new(reader: BufReader<File>, version: u8, length: u64) -> Self {
        Header { reader, version, length }
    }

    fn layout(mut self) -> io::Result<Layout> {
        let records = self.size()?;
        // A file that is still being streamed holds all ones here; such files promise nothing.
        let streaming = records == if self.version == 5 { u64::MAX } else { u64::from(u32::MAX) };
        let records = if streaming { 0 } else { records };
        let mut dimensions = Vec::new();
        for _ in 0..self.list(DIMENSIONS)? {
            self.name()?;
            dimensions.push(self.size()?);
        }
        self.attributes()?;
        let mut variables = Vec::new();
        for _ in 0..self.list(VARIABLES)? {
            variables.push(self.variable()?);
        }
        // Asked for after the number of records was read: the file may be growing.
        let length = self.reader.get_ref().metadata()?.len();
        Layout::new(self.version, records, length, &dimensions, variables)
    }

    fn bytes<const N: usize>(&mut self) -> io::Result<[u8; N]> {
        let mut bytes = [0; N];
        self.reader.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    fn u32(&mut self) -> io::Result<u32> {
        Ok(u32::from_be_bytes(self.bytes()?))
    }

    /// A count, length or dimension number: four bytes, or eight in 64-bit data files.
    fn size(&mut self) -> io::Result<u64> {
        if self.version == 5 { Ok(u64::from_be_bytes(self.bytes()?)) } else { Ok(self.u32()?.into()) }
    }

    /// The number of entries of a list that begins with `tag`, zero if it is absent.
    fn list(&mut self, tag: u32) -> io::Result<u64> {
        let (found, count) = (self.u32()?, self.size()?);
        match (found, count) {
            (0, 0) => Ok(0),
            _ if found == tag => Ok(count),
            _ => Err(invalid("a list has the wrong tag")),
        }
    }

    fn name(&mut self) -> io::Result<String> {
        let length = self.size()?;
        if length > 1024 {
            return Err(invalid("a name has more than 1024 characters"));
        }
        let mut name = vec![0; padded(length) as usize];
        self.reader.read_exact(&mut name)?;
        name.truncate(length as usize);
        Ok(String::from_utf8_lossy(&name).into_owned())
    }

    /// Skips a list of attributes.
    fn attributes(&mut self) -> io::Result<()> {
        for _ in 0..self.list(ATTRIBUTES)? {
            self.name()?;
            let type_size = type_size(self.u32()?)?;
            let bytes = self.size()?.checked_mul(type_size).filter(|&b| b <= self.length);
            let bytes = bytes.ok_or_else(|| invalid("an attribute is longer than the file"))?;
            io::copy(&mut self.reader.by_ref().take(padded(bytes)), &mut io::sink())?;
        }
        Ok(())
    }

    fn variable(&mut self) -> io::Result<Variable> {
        let name = self.name()?;
        let rank = self.size()?;
        if rank > 1024 {
            return Err(invalid(format!("{name} has more than 1024 dimensions")));
        }
        let dimensions = (0..rank).map(|_| self.size()).collect::<io::Result<_>>()?;
        self.attributes()?;
        let type_size = type_size(self.u32()?)?;
        self.size()?; // The variable's size, which is wrong by design for large ones.
        let begin = if self.version == 1 { self.u32()?.into() } else { u64::from_be_bytes(self.bytes()?) };
        Ok(Variable { name, dimensions, type_size, begin })
    }
}

impl Layout {
    fn new(version: u8, records: u64, length: u64, lengths: &[u64], variables: Vec<Variable>) -> io::Result<Self> {
        let too_large = |name: &str| invalid(format!("{name} is larger than any file"));
        let mut layout = Layout { version, records, record_size: 0, promised: 0, length, record_variables: Vec::new() };
        for Variable { name, dimensions, type_size, begin } in variables {
            let mut size = type_size;
            let mut record = false;
            for (position, &dimension) in dimensions.iter().enumerate() {
                match usize::try_from(dimension).ok().and_then(|d| lengths.get(d)) {
                    None => return Err(invalid(format!("{name} has a dimension that does not exist"))),
                    Some(0) if position == 0 => record = true,
                    Some(&n) => size = size.checked_mul(n).ok_or_else(|| too_large(&name))?,
                }
            }
            if record {
                let step = size.checked_next_multiple_of(4).and_then(|s| layout.record_size.checked_add(s));
                layout.record_size = step.ok_or_else(|| too_large(&name))?;
                layout.record_variables.push(RecordVariable { name, begin, size });
            } else {
                let end = begin.checked_add(size).ok_or_else(|| too_large(&name))?;
                layout.promised = layout.promised.max(end);
            }
        }
        layout.promise_records()?;
        Ok(layout)
    }

    /// Adds the records to the promised length.
    fn promise_records(&mut self) -> io::Result<()> {
        if let [only] = self.record_variables.as_slice() {
            self.record_size = only.size; // A single record variable is not padded.
        }
        let Some(before_last) = self.records.checked_sub(1) else { return Ok(()) };
        for variable in &self.record_variables {
            let end = before_last.checked_mul(self.record_size).and_then(|n| n.checked_add(variable.begin));
            let end = end.and_then(|n| n.checked_add(variable.size));
            self.promised = self.promised.max(end.ok_or_else(|| invalid("its records are larger than any file"))?);
        }
        Ok(())
    }
}

fn padded(length: u64) -> u64 {
    length.next_multiple_of(4)
}

/// Bytes of one value of a netCDF external type.
fn type_size(external_type: u32) -> io::Result<u64> {
    match external_type {
        1 | 2 | 7 => Ok(1),   // byte, char, unsigned byte
        3 | 8 => Ok(2),       // short, unsigned short
        4 | 5 | 9 => Ok(4),   // int, float, unsigned int
        6 | 10 | 11 => Ok(8), // double, 64-bit int, unsigned 64-bit int
        other => Err(invalid(format!("there is no data type {other}"))),
    }
}

fn invalid(reason: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, reason.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use netcdf::Options;

    /// Writes records of the given numbers of bytes each with the netCDF library and returns the layout read here.
    fn layout(options: Options, widths: &[usize], records: usize) -> Layout {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.nc");
        let mut file = netcdf::create_with(&path, options).unwrap();
        file.add_attribute("title", "abc").unwrap();
        file.add_unlimited_dimension("time").unwrap();
        file.add_dimension("five", 5).unwrap();
        file.add_variable::<i16>("fixed", &["five"]).unwrap();
        for &width in widths {
            let name = format!("width{width}");
            file.add_dimension(&name, width).unwrap();
            file.add_variable::<i8>(&name, &["time", &name]).unwrap();
        }
        file.enddef().unwrap();
        for &width in widths {
            let mut variable = file.variable_mut(&format!("width{width}")).unwrap();
            variable.put_values(&vec![1i8; width * records], (..records, ..)).unwrap();
        }
        file.close().unwrap();
        match inspect(&path).unwrap() {
            Container::Classic(layout) => layout,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn layouts_agree_with_files_of_the_library() {
        let formats: [(fn() -> Options, u8); 3] =
            [(Options::empty, 1), (|| Options::_64BIT_OFFSET, 2), (|| Options::_64BIT_DATA, 5)];
        for (options, version) in formats {
            let several = layout(options(), &[3, 6], 4);
            assert_eq!((several.version, several.records, several.record_size), (version, 4, 4 + 8));
            assert_eq!(several.promised.next_multiple_of(4), several.length);
            assert_eq!(several.record_variables[1].begin, several.record_variables[0].begin + 4);
            let single = layout(options(), &[3], 5);
            assert_eq!((single.records, single.record_size), (5, 3));
            assert_eq!(single.promised.next_multiple_of(4), single.length.next_multiple_of(4));
            let none = layout(options(), &[], 0);
            assert_eq!(none.promised.next_multiple_of(4), none.length);
        }
    }
}
