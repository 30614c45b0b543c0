//! A mesh becomes an EXODUS II file; the same definitions begin every results file.

use std::path::{Path, PathBuf};

use netcdf::types::NcTypeDescriptor;
use netcdf::{FileMut, Options};

use crate::common::files;
use crate::exodus::file::arrays::Character;
use crate::exodus::file::error::ResultsError;
use crate::exodus::file::names::{self, Family};
use crate::exodus::pieces::Piece;
use crate::exodus::results::restart::{self, Extra};
use crate::mesh::Mesh;

/// The version of the EXODUS conventions that these files keep.
const EXODUS_VERSION: f32 = 8.03;
/// Width of a QA text and of an info line, with the final NUL.
const STRING_WIDTH: usize = 33;
pub(in crate::exodus) const LINE_WIDTH: usize = 81;
/// From this many bytes on a variable needs the 64-bit data format; older libraries fail at 2 GiB.
const LARGE_VARIABLE: usize = 1 << 31;

/// What a file holds beside the mesh. Empty lists are left out of the file.
#[derive(Default)]
pub(in crate::exodus) struct Contents<'a> {
    pub title: &'a str,
    pub qa: &'a [[String; 4]],
    pub info: &'a [String],
    pub global: &'a [String],
    pub nodal: &'a [String],
    pub element: &'a [String],
    pub extra: Option<&'a Extra<'a>>,
}

/// Writes a mesh as an EXODUS II (GENESIS) file.
///
/// The container is netCDF 64-bit offset, or CDF-5 when sizes or numbers demand it. The file appears under its name
/// only when it is complete.
///
/// # Errors
/// When the file cannot be written.
pub fn write_mesh(path: &Path, mesh: &Mesh) -> Result<(), ResultsError> {
    write_file(path, mesh, &Contents { title: &mesh.title, qa: &mesh.qa, ..Contents::default() })
}

/// Writes a complete file without states, first under another name.
pub(in crate::exodus) fn write_file(path: &Path, mesh: &Mesh, contents: &Contents) -> Result<(), ResultsError> {
    files::replaceable(path).map_err(ResultsError::io("write", path))?;
    let unfinished = files::unfinished(path);
    let written = Writer::create(&unfinished, mesh, contents).and_then(|mut writer| {
        writer.define()?;
        writer.put()?;
        writer.file.close()
    });
    if let Err(error) = written {
        let _ = std::fs::remove_file(&unfinished); // It may not even exist; the first error is the one to tell.
        return Err(ResultsError::netcdf("write", path)(error));
    }
    std::fs::rename(&unfinished, path).map_err(ResultsError::io("write", path))
}

/// The names that a file has while it is written and after: both are lost to whatever had them before.
pub fn names_in_writing(path: &Path) -> [PathBuf; 2] {
    [path.to_owned(), files::unfinished(path)]
}

/// A file being defined and filled.
pub(in crate::exodus) struct Writer<'a> {
    pub(in crate::exodus) file: FileMut,
    mesh: &'a Mesh,
    contents: &'a Contents<'a>,
    /// Numbers need 64 bits.
    wide: bool,
    name_width: usize,
}

impl<'a> Writer<'a> {
    fn create(path: &Path, mesh: &'a Mesh, contents: &'a Contents) -> netcdf::Result<Self> {
        let wide = needs_64_bit_numbers(mesh);
        let large = mesh.blocks.iter().any(|b| b.nodes.len() * 4 >= LARGE_VARIABLE)
            || mesh.coordinates.len() * 8 >= LARGE_VARIABLE;
        let format = if wide || large { Options::_64BIT_DATA } else { Options::_64BIT_OFFSET };
        let file = netcdf::create_with(path, format)?;
        let longest = all_names(mesh, contents).map(str::len).max().unwrap_or(0);
        Ok(Writer { file, mesh, contents, wide, name_width: (longest + 1).clamp(STRING_WIDTH, 256) })
    }

    fn define(&mut self) -> netcdf::Result<()> {
        self.define_attributes()?;
        self.define_dimensions()?;
        self.variable::<f64>(names::TIME, &[names::TIME_STEP])?;
        self.define_texts()?;
        self.define_mesh()?;
        if let Some(piece) = self.piece() {
            self.define_piece(piece)?;
        }
        self.define_results()?;
        self.define_extra()?;
        self.file.enddef()
    }

    fn define_attributes(&mut self) -> netcdf::Result<()> {
        let file = &mut self.file;
        file.add_attribute(names::API_VERSION, EXODUS_VERSION)?;
        file.add_attribute(names::VERSION, EXODUS_VERSION)?;
        file.add_attribute(names::WORD_SIZE, 8i32)?;
        file.add_attribute(names::FILE_SIZE, 1i32)?;
        file.add_attribute(names::MAXIMUM_NAME_LENGTH, self.name_width as i32 - 1)?;
        // Bits 0x0400 and 0x0800: maps and numbers in 64 bits.
        file.add_attribute(names::INT64_STATUS, if self.wide { 0x0C00i32 } else { 0 })?;
        file.add_attribute(names::TITLE, cut(self.contents.title.trim_end(), LINE_WIDTH - 1))?;
        Ok(())
    }

    fn define_dimensions(&mut self) -> netcdf::Result<()> {
        let (mesh, contents) = (self.mesh, self.contents);
        self.file.add_unlimited_dimension(names::TIME_STEP)?;
        self.dimensions(&[
            (names::LEN_STRING, STRING_WIDTH),
            (names::LEN_LINE, LINE_WIDTH),
            (names::LEN_NAME, self.name_width),
            (names::FOUR, 4),
            (names::NUM_DIM, mesh.dimension.count()),
            (names::NUM_NODES, mesh.coordinates.len()),
            (names::NUM_ELEM, mesh.element_count()),
            (names::NUM_BLOCKS, mesh.blocks.len()),
            (names::NUM_NODE_SETS, mesh.node_sets.len()),
            (names::NUM_SIDE_SETS, mesh.side_sets.len()),
            (names::NUM_QA, contents.qa.len()),
            (names::NUM_INFO, contents.info.len()),
            (names::NUM_GLOBAL_VARIABLES, contents.global.len()),
            (names::NUM_NODAL_VARIABLES, contents.nodal.len()),
            (names::NUM_ELEMENT_VARIABLES, contents.element.len()),
        ])
    }

    /// Adds dimensions; one of length zero is left out, as netCDF would make it unlimited.
    pub(in crate::exodus) fn dimensions(&mut self, list: &[(&str, usize)]) -> netcdf::Result<()> {
        for &(name, length) in list.iter().filter(|(_, length)| *length > 0) {
            self.file.add_dimension(name, length)?;
        }
        Ok(())
    }

    pub(in crate::exodus) fn variable<T: NcTypeDescriptor>(
        &mut self,
        name: &str,
        dimensions: &[&str],
    ) -> netcdf::Result<()> {
        self.file.add_variable::<T>(name, dimensions).map(drop)
    }

    pub(in crate::exodus) fn numbers(&mut self, name: &str, dimension: &str) -> netcdf::Result<()> {
        if self.wide { self.variable::<i64>(name, &[dimension]) } else { self.variable::<i32>(name, &[dimension]) }
    }

    fn define_texts(&mut self) -> netcdf::Result<()> {
        self.variable::<Character>(names::COORDINATE_NAMES, &[names::NUM_DIM, names::LEN_NAME])?;
        if !self.contents.qa.is_empty() {
            self.variable::<Character>(names::QA, &[names::NUM_QA, names::FOUR, names::LEN_STRING])?;
        }
        if !self.contents.info.is_empty() {
            self.variable::<Character>(names::INFO, &[names::NUM_INFO, names::LEN_LINE])?;
        }
        Ok(())
    }

    fn define_mesh(&mut self) -> netcdf::Result<()> {
        let mesh = self.mesh;
        // A piece may be without elements.
        if !mesh.node_ids.is_empty() {
            self.numbers(names::NODE_IDS, names::NUM_NODES)?;
        }
        if !mesh.element_ids.is_empty() {
            self.numbers(names::ELEMENT_IDS, names::NUM_ELEM)?;
        }
        for name in names::COORDINATES.into_iter().take(mesh.dimension.count()).filter(|_| !mesh.coordinates.is_empty())
        {
            self.variable::<f64>(name, &[names::NUM_NODES])?;
        }
        self.define_family(&names::BLOCKS, mesh.blocks.len())?;
        for (n, block) in mesh.blocks.iter().enumerate().filter(|(_, block)| !block.is_empty()) {
            let dimensions = [names::block_elements(n), names::block_nodes_per_element(n)];
            self.dimensions(&[(&dimensions[0], block.len()), (&dimensions[1], block.shape.corners())])?;
            let mut variable =
                self.file.add_variable::<i32>(&names::connectivity(n), &[&dimensions[0], &dimensions[1]])?;
            variable.put_attribute(names::ELEMENT_TYPE, block.shape.exodus_name())?;
            if !block.attributes.is_empty() {
                let count = names::block_attributes(n);
                self.dimensions(&[(&count, block.attributes_of(0).len())])?;
                self.variable::<f64>(&names::attributes(n), &[&dimensions[0], &count])?;
            }
        }
        self.define_family(&names::NODE_SETS, mesh.node_sets.len())?;
        for (n, set) in mesh.node_sets.iter().enumerate().filter(|(_, set)| !set.nodes.is_empty()) {
            let size = names::node_set_size(n);
            self.dimensions(&[(&size, set.nodes.len())])?;
            self.variable::<i32>(&names::node_set_nodes(n), &[&size])?;
            if mesh.node_factors.contains_key(&set.id) {
                self.variable::<f64>(&names::node_set_factors(n), &[&size])?;
            }
        }
        self.define_family(&names::SIDE_SETS, mesh.side_sets.len())?;
        for (n, set) in mesh.side_sets.iter().enumerate().filter(|(_, set)| !set.sides.is_empty()) {
            let size = names::side_set_size(n);
            self.dimensions(&[(&size, set.sides.len())])?;
            self.variable::<i32>(&names::side_set_elements(n), &[&size])?;
            self.variable::<i32>(&names::side_set_sides(n), &[&size])?;
        }
        Ok(())
    }

    fn define_family(&mut self, family: &Family, count: usize) -> netcdf::Result<()> {
        if count == 0 {
            return Ok(());
        }
        self.variable::<i32>(family.status, &[family.count])?;
        self.numbers(family.ids, family.count)?;
        let (name, value) = names::PROPERTY_NAME;
        self.file.variable_mut(family.ids).ok_or("no such variable")?.put_attribute(name, value)?;
        self.variable::<Character>(family.names, &[family.count, names::LEN_NAME])
    }

    /// Result variables in the order in which a state is written: globals, nodal, element.
    fn define_results(&mut self) -> netcdf::Result<()> {
        let contents = self.contents;
        if !contents.global.is_empty() {
            self.variable::<Character>(names::GLOBAL_NAMES, &[names::NUM_GLOBAL_VARIABLES, names::LEN_NAME])?;
            self.variable::<f64>(names::GLOBAL_VALUES, &[names::TIME_STEP, names::NUM_GLOBAL_VARIABLES])?;
        }
        if !contents.nodal.is_empty() {
            self.variable::<Character>(names::NODAL_NAMES, &[names::NUM_NODAL_VARIABLES, names::LEN_NAME])?;
            let arrays = if self.mesh.coordinates.is_empty() { 0 } else { contents.nodal.len() };
            for v in 0..arrays {
                self.variable::<f64>(&names::nodal_values(v), &[names::TIME_STEP, names::NUM_NODES])?;
            }
        }
        if !contents.element.is_empty() {
            self.variable::<Character>(names::ELEMENT_NAMES, &[names::NUM_ELEMENT_VARIABLES, names::LEN_NAME])?;
            self.variable::<i32>(names::TRUTH_TABLE, &[names::NUM_BLOCKS, names::NUM_ELEMENT_VARIABLES])?;
            for v in 0..contents.element.len() {
                for (b, _) in self.mesh.blocks.iter().enumerate().filter(|(_, b)| !b.is_empty()) {
                    let size = names::block_elements(b);
                    self.variable::<f64>(&names::element_values(v, b), &[names::TIME_STEP, &size])?;
                }
            }
        }
        Ok(())
    }

    /// What EXODUS knows nothing of; its readers pass over it.
    fn piece(&self) -> Option<&'a Piece> {
        self.contents.extra.and_then(|extra| extra.piece)
    }

    fn define_extra(&mut self) -> netcdf::Result<()> {
        let Some(extra) = self.contents.extra else { return Ok(()) };
        if let Some(identity) = extra.identity {
            self.file.add_attribute(restart::IDENTITY, identity)?;
            let names: Vec<&str> = extra.lists.iter().map(|list| list.name.as_str()).collect();
            self.file.add_attribute(restart::LISTS, names.join(" "))?;
        }
        for list in extra.lists {
            let variable = restart::list_variable(&list.name);
            let dimensions = [format!("{variable}_rows"), format!("{variable}_columns")];
            let rows = list.values.len() / list.width;
            self.dimensions(&[(&dimensions[0], rows), (&dimensions[1], list.width)])?;
            self.variable::<f64>(&variable, &[&dimensions[0], &dimensions[1]])?;
        }
        Ok(())
    }

    fn put_extra(&mut self) -> netcdf::Result<()> {
        self.piece().map_or(Ok(()), |piece| self.put_piece(piece))?;
        let lists = self.contents.extra.map_or(&[][..], |extra| extra.lists);
        lists.iter().try_for_each(|list| self.values(&restart::list_variable(&list.name), &list.values))
    }

    fn put(&mut self) -> netcdf::Result<()> {
        self.put_texts()?;
        self.put_nodes()?;
        self.put_blocks()?;
        self.put_sets()?;
        self.put_extra()
    }

    pub(in crate::exodus) fn values<T: NcTypeDescriptor>(&mut self, name: &str, values: &[T]) -> netcdf::Result<()> {
        self.file.variable_mut(name).ok_or("no such variable")?.put_values(values, ..)
    }

    pub(in crate::exodus) fn put_numbers(&mut self, name: &str, values: &[i64]) -> netcdf::Result<()> {
        if values.is_empty() { Ok(()) } else { self.values(name, values) }
    }

    fn put_names<'n>(&mut self, name: &str, texts: impl Iterator<Item = &'n str>) -> netcdf::Result<()> {
        let width = self.name_width;
        self.put_text(name, texts, width)
    }

    fn put_text<'n>(&mut self, name: &str, texts: impl Iterator<Item = &'n str>, width: usize) -> netcdf::Result<()> {
        let padded: Vec<Character> = texts.flat_map(|text| pad(text, width)).collect();
        if padded.is_empty() { Ok(()) } else { self.values(name, &padded) }
    }

    fn put_texts(&mut self) -> netcdf::Result<()> {
        let contents = self.contents;
        self.put_names(names::COORDINATE_NAMES, ["x", "y", "z"].into_iter().take(self.mesh.dimension.count()))?;
        self.put_text(names::QA, contents.qa.iter().flatten().map(String::as_str), STRING_WIDTH)?;
        self.put_text(names::INFO, contents.info.iter().map(String::as_str), LINE_WIDTH)?;
        self.put_names(names::GLOBAL_NAMES, contents.global.iter().map(String::as_str))?;
        self.put_names(names::NODAL_NAMES, contents.nodal.iter().map(String::as_str))?;
        self.put_names(names::ELEMENT_NAMES, contents.element.iter().map(String::as_str))?;
        let present = |b: &crate::mesh::Block| vec![i32::from(!b.is_empty()); contents.element.len()];
        let truth: Vec<i32> = self.mesh.blocks.iter().flat_map(present).collect();
        if truth.is_empty() { Ok(()) } else { self.values(names::TRUTH_TABLE, &truth) }
    }

    fn put_nodes(&mut self) -> netcdf::Result<()> {
        let mesh = self.mesh;
        self.put_numbers(names::NODE_IDS, &mesh.node_ids)?;
        let axes = names::COORDINATES.into_iter().enumerate().take(mesh.dimension.count());
        for (axis, name) in axes.filter(|_| !mesh.coordinates.is_empty()) {
            let values: Vec<f64> = mesh.coordinates.iter().map(|position| position[axis]).collect();
            self.values(name, &values)?;
        }
        Ok(())
    }

    fn put_blocks(&mut self) -> netcdf::Result<()> {
        let mesh = self.mesh;
        self.put_numbers(names::ELEMENT_IDS, &mesh.element_ids)?;
        let list = mesh.blocks.iter().map(|b| (b.id, b.name.as_str(), !b.is_empty()));
        self.put_family(&names::BLOCKS, list)?;
        for (n, block) in mesh.blocks.iter().enumerate().filter(|(_, block)| !block.is_empty()) {
            self.values(&names::connectivity(n), &one_based(&block.nodes))?;
            if !block.attributes.is_empty() {
                self.values(&names::attributes(n), &block.attributes)?;
            }
        }
        Ok(())
    }

    fn put_sets(&mut self) -> netcdf::Result<()> {
        let mesh = self.mesh;
        let list = mesh.node_sets.iter().map(|s| (s.id, s.name.as_str(), !s.nodes.is_empty()));
        self.put_family(&names::NODE_SETS, list)?;
        for (n, set) in mesh.node_sets.iter().enumerate().filter(|(_, set)| !set.nodes.is_empty()) {
            self.values(&names::node_set_nodes(n), &one_based(&set.nodes))?;
            if let Some(factors) = mesh.node_factors.get(&set.id) {
                self.values(&names::node_set_factors(n), factors)?;
            }
        }
        let list = mesh.side_sets.iter().map(|s| (s.id, s.name.as_str(), !s.sides.is_empty()));
        self.put_family(&names::SIDE_SETS, list)?;
        for (n, set) in mesh.side_sets.iter().enumerate().filter(|(_, set)| !set.sides.is_empty()) {
            let (elements, sides): (Vec<i32>, Vec<i32>) =
                set.sides.iter().map(|&(element, side)| (element as i32 + 1, i32::from(side) + 1)).unzip();
            self.values(&names::side_set_elements(n), &elements)?;
            self.values(&names::side_set_sides(n), &sides)?;
        }
        Ok(())
    }

    fn put_family<'n>(
        &mut self,
        family: &Family,
        list: impl Iterator<Item = (i64, &'n str, bool)> + Clone,
    ) -> netcdf::Result<()> {
        let (ids, status): (Vec<i64>, Vec<i32>) = list.clone().map(|(id, _, real)| (id, i32::from(real))).unzip();
        if ids.is_empty() {
            return Ok(());
        }
        self.values(family.status, &status)?;
        self.values(family.ids, &ids)?;
        self.put_names(family.names, list.map(|(_, name, _)| name))
    }
}

fn needs_64_bit_numbers(mesh: &Mesh) -> bool {
    let blocks = mesh.blocks.iter().map(|b| &b.id);
    let sets = mesh.node_sets.iter().map(|s| &s.id).chain(mesh.side_sets.iter().map(|s| &s.id));
    mesh.node_ids.iter().chain(&mesh.element_ids).chain(blocks).chain(sets).any(|&id| i32::try_from(id).is_err())
}

fn all_names<'a>(mesh: &'a Mesh, contents: &'a Contents) -> impl Iterator<Item = &'a str> {
    let blocks = mesh.blocks.iter().map(|b| b.name.as_str());
    let sets = mesh.node_sets.iter().map(|s| s.name.as_str()).chain(mesh.side_sets.iter().map(|s| s.name.as_str()));
    let variables = contents.global.iter().chain(contents.nodal).chain(contents.element).map(String::as_str);
    blocks.chain(sets).chain(variables)
}

pub(in crate::exodus) fn one_based(indices: &[u32]) -> Vec<i32> {
    indices.iter().map(|&i| i as i32 + 1).collect()
}

/// The text in a field of `width` characters that ends with at least one NUL.
fn pad(text: &str, width: usize) -> impl Iterator<Item = Character> {
    cut(text, width - 1).bytes().chain(std::iter::repeat(0)).take(width).map(Character)
}

/// At most `length` bytes of a text, cut between characters and before a NUL.
pub(in crate::exodus) fn cut(text: &str, length: usize) -> &str {
    let text = text.split('\0').next().unwrap_or_default();
    let end = (0..=length.min(text.len())).rev().find(|&end| text.is_char_boundary(end));
    &text[..end.unwrap_or(0)]
}
