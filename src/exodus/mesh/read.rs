//! An EXODUS II or GENESIS file becomes a mesh.
//!
//! The file is read to the format's conventions, whichever program wrote it: any netCDF container, packed or separate
//! coordinates, integers and reals of any width, missing maps and names, null blocks and sets. Files of old, in FORTRAN
//! records, are the business of [`genesis`].

use std::path::Path;

use crate::exodus::file::arrays::{Arrays, Reason};
use crate::exodus::file::container::{Container, inspect};
use crate::exodus::file::error::MeshError;
use crate::exodus::file::names::{self, Family};
use crate::exodus::file::probe;
use crate::exodus::file::slabs::{self, Together};
use crate::exodus::mesh::genesis;
use crate::exodus::mesh::tables::{BlockTable, NodeSetTable, SideSetTable, Tables};
use crate::exodus::pieces;
use crate::mesh::Mesh;
use crate::mesh::check::{self, Problem, Problems, counted};

/// Reads a mesh and checks that it can be computed with.
///
/// # Errors
/// [`MeshError`] holds every problem found, in the analyst's numbers: of the file (missing, cut short, not EXODUS,
/// arrays missing or of the wrong shape), of its numbers (out of range, given twice), of its elements (of a kind
/// that is not supported, without positive volume).
pub fn read_mesh(path: &Path) -> Result<Mesh, MeshError> {
    if matches!(inspect(path), Ok(Container::FortranRecords)) {
        let mesh = genesis::read(path)?.assemble();
        return checked(path, mesh.map_err(|problems| MeshError { path: path.to_owned(), problems })?);
    }
    let arrays = open(path)?;
    whole(path, &arrays)?;
    checked(path, assemble(path, &arrays)?)
}

/// Refuses a piece of a mesh that was cut for several ranks: by itself it is another body.
fn whole(path: &Path, arrays: &Arrays) -> Result<(), MeshError> {
    let Some(pieces) = arrays.dimension(names::NUM_PROCESSORS).filter(|&pieces| pieces > 1) else { return Ok(()) };
    let (of, join) = match pieces::parts_of_name(path) {
        Some((whole, ..)) => (format!(", {}", whole.display()), whole.display().to_string()),
        None => (String::new(), "x.g".into()),
    };
    Err(MeshError::single(
        path,
        format!("this is one of the {pieces} pieces of a mesh that was cut for so many ranks{of}, not the whole"),
        format!(
            "name the whole; epu -auto makes it of pieces that decomp or nem_spread has cut, and urto join {join} of \
             urto's own; urto cuts it itself, for any number of ranks"
        ),
    ))
}

/// Reads the same mesh on several processes, of which each reads a slab of every large array. All processes call it.
///
/// Where they do not see the same file, each reads its own.
///
/// # Errors
/// Those of [`read_mesh`].
pub fn read_mesh_together(path: &Path, together: &mut dyn Together) -> Result<Mesh, MeshError> {
    if together.place().1 == 1 {
        return read_mesh(path);
    }
    let length = std::fs::metadata(path).ok().map(|file| file.len());
    let container = inspect(path);
    // One process has the file tried for all, and none opens it before it has been.
    let tries = together.place().0 == 0 && matches!(container, Ok(Container::Hdf5));
    let tried = if tries { probe::vouch(path) } else { Ok(()) };
    if !together.same(tried.is_ok().then_some(0)) {
        return read_mesh(path);
    }
    let netcdf = matches!(container, Ok(Container::Classic(_) | Container::Hdf5));
    let opened = length.filter(|_| netcdf).and_then(|length| Some((open_with(path, |_| Ok(())).ok()?, length)));
    if !together.same(opened.as_ref().map(|(_, length)| *length)) {
        return read_mesh(path);
    }
    match opened {
        Some((arrays, _)) => {
            whole(path, &arrays)?;
            checked(path, assemble_with(path, &arrays, false, Some(together))?)
        }
        None => read_mesh(path),
    }
}

fn checked(path: &Path, mesh: Mesh) -> Result<Mesh, MeshError> {
    let problems = check::geometry(&mesh);
    if problems.is_empty() { Ok(mesh) } else { Err(MeshError { path: path.to_owned(), problems }) }
}

/// The mesh of a file that is open already.
pub(in crate::exodus) fn assemble(path: &Path, arrays: &Arrays) -> Result<Mesh, MeshError> {
    assemble_with(path, arrays, false, None)
}

/// The part of a mesh that a piece holds; it may be without nodes and elements.
pub(in crate::exodus) fn assemble_part(path: &Path, arrays: &Arrays) -> Result<Mesh, MeshError> {
    assemble_with(path, arrays, true, None)
}

fn assemble_with(
    path: &Path,
    arrays: &Arrays,
    is_part: bool,
    together: Option<&mut dyn Together>,
) -> Result<Mesh, MeshError> {
    let mut problems = Problems::default();
    let tables = Reader { arrays, problems: &mut problems, is_part, together }.tables();
    // Arrays that are missing would be missed again by all that refers to them, so they are told alone.
    let assembled = if problems.is_empty() { tables.assemble() } else { Err(problems) };
    assembled.map_err(|problems| MeshError { path: path.to_owned(), problems })
}

/// Opens a file after a look at its first bytes, and after another process has tried it where that is needed.
pub(in crate::exodus) fn open(path: &Path) -> Result<Arrays, MeshError> {
    open_with(path, probe::vouch)
}

/// The same with somebody who vouches for HDF5 files.
fn open_with(path: &Path, vouch: impl FnOnce(&Path) -> Result<(), String>) -> Result<Arrays, MeshError> {
    let refuse = |what: &str, help: &str| MeshError::single(path, what, help);
    let container = inspect(path).map_err(|e| refuse(&format!("cannot be read: {e}"), ""))?;
    match &container {
        Container::FortranRecords => {
            return Err(refuse(
                "this is an EXODUS I file (Fortran records), of which urto reads the mesh, but no results",
                "convert it to EXODUS II, for example with ex1ex2v2",
            ));
        }
        Container::Unknown(reason) => {
            return Err(refuse(
                &format!("this is no EXODUS file: {reason}"),
                "meshes and results are EXODUS II files (GENESIS): netCDF classic, 64-bit offset, CDF-5 or netCDF-4",
            ));
        }
        Container::Classic(layout) if layout.length < layout.promised => {
            return Err(refuse(
                &format!("the file is cut short: it has {} of {} bytes", layout.length, layout.promised),
                "copy or write it again",
            ));
        }
        Container::Hdf5 => {
            let damaged = "the file is damaged; copy or write it again";
            vouch(path).map_err(|reason| refuse(&format!("cannot be read: {reason}"), damaged))?;
        }
        Container::Classic(_) => {}
    }
    let length = std::fs::metadata(path).map_err(|e| refuse(&format!("cannot be read: {e}"), ""))?.len();
    let arrays = Arrays::open(path, length).map_err(|e| {
        refuse(&format!("cannot be opened: {e}"), "the file is damaged or not complete; write it again")
    })?;
    if !names::SIGNS_OF_EXODUS.iter().any(|name| arrays.has_attribute(name)) && !arrays.has(names::BLOCKS.ids) {
        return Err(refuse(
            "this is a netCDF file but no EXODUS file: it has neither version nor title nor element blocks",
            "export the mesh as EXODUS II (GENESIS)",
        ));
    }
    Ok(arrays)
}

/// Quality-assurance records: four texts each.
pub(in crate::exodus) fn qa_records(arrays: &Arrays) -> Vec<[String; 4]> {
    let mut texts = arrays.texts(names::QA).into_iter();
    std::iter::from_fn(|| Some([texts.next()?, texts.next()?, texts.next()?, texts.next()?])).collect()
}

/// Number of nodes, from whatever speaks of it.
pub(in crate::exodus) fn node_count(arrays: &Arrays) -> usize {
    let last = |name| arrays.shape(name).and_then(|shape| shape.last().copied());
    let said = arrays.dimension(names::NUM_NODES);
    said.or_else(|| last(names::COORDINATES[0])).or_else(|| last(names::PACKED_COORDINATES)).unwrap_or(0)
}

/// Reads the arrays and notes what is missing.
struct Reader<'a, 't> {
    arrays: &'a Arrays,
    problems: &'a mut Problems,
    is_part: bool,
    together: Option<&'a mut (dyn Together + 't)>,
}

impl Reader<'_, '_> {
    fn tables(&mut self) -> Tables {
        let dimensions = self.arrays.dimension(names::NUM_DIM).unwrap_or(3);
        Tables {
            title: self.arrays.text(names::TITLE).unwrap_or_default(),
            dimensions,
            is_part: self.is_part,
            // What is neither flat nor of space is refused for that, not for its missing coordinates.
            coordinates: if matches!(dimensions, 2 | 3) { self.coordinates(dimensions) } else { Default::default() },
            node_count: self.arrays.dimension(names::NUM_NODES),
            element_count: self.arrays.dimension(names::NUM_ELEM),
            blocks: self.family(&names::BLOCKS, "block", Self::block),
            node_sets: self.family(&names::NODE_SETS, "node set", Self::node_set),
            side_sets: self.family(&names::SIDE_SETS, "side set", Self::side_set),
            node_ids: self.integers(names::NODE_IDS),
            element_ids: self.integers(names::ELEMENT_IDS),
            qa: qa_records(self.arrays),
        }
    }

    fn problem(&mut self, what: impl Into<String>) {
        self.problems.add(|| Problem::new(what, "write the mesh again; a program or a copy left it incomplete"));
    }

    /// A whole array of integers, read in slabs where several processes read.
    fn whole_integers(&mut self, name: &str) -> Result<Option<Vec<i64>>, Reason> {
        match (&mut self.together, slabs::rows(self.arrays.shape(name))) {
            (Some(together), Some(rows)) => {
                slabs::read(*together, rows, |rows| self.arrays.rows_of_integers(name, rows)).map(Some)
            }
            _ => self.arrays.integers(name),
        }
    }

    /// The same for reals.
    fn whole_reals(&mut self, name: &str) -> Result<Option<Vec<f64>>, Reason> {
        match (&mut self.together, slabs::rows(self.arrays.shape(name))) {
            (Some(together), Some(rows)) => {
                slabs::read(*together, rows, |rows| self.arrays.rows_of_reals(name, rows)).map(Some)
            }
            _ => self.arrays.reals(name),
        }
    }

    /// An optional array of integers; what cannot be read counts as missing and is noted.
    fn integers(&mut self, name: &str) -> Option<Vec<i64>> {
        self.whole_integers(name).unwrap_or_else(|reason| {
            self.problem(reason);
            None
        })
    }

    /// An array of integers that must be there.
    fn required(&mut self, name: &str, place: &str) -> Vec<i64> {
        match self.whole_integers(name) {
            Ok(Some(values)) => return values,
            Ok(None) => self.problem(format!("{place}: {name} is missing")),
            Err(reason) => self.problem(format!("{place}: {reason}")),
        }
        Vec::new()
    }

    /// The coordinates of so many axes; those of others are empty.
    fn coordinates(&mut self, dimensions: usize) -> [Vec<f64>; 3] {
        if self.is_part && self.arrays.dimension(names::NUM_NODES).is_none() {
            return Default::default();
        }
        if let Some(shape) = self.arrays.shape(names::PACKED_COORDINATES) {
            return self.packed_coordinates(dimensions, &shape);
        }
        [0, 1, 2].map(|axis| (names::COORDINATES[axis], axis < dimensions)).map(|(name, there)| {
            match self.whole_reals(name) {
                _ if !there => Vec::new(),
                Ok(Some(values)) => values,
                Ok(None) => {
                    self.problem(format!("{name} is missing"));
                    Vec::new()
                }
                Err(reason) => {
                    self.problem(reason);
                    Vec::new()
                }
            }
        })
    }

    fn packed_coordinates(&mut self, dimensions: usize, shape: &[usize]) -> [Vec<f64>; 3] {
        match (shape, self.whole_reals(names::PACKED_COORDINATES)) {
            (&[count, nodes], Ok(Some(mut x))) if count == dimensions && x.len() == count * nodes => {
                let z = x.split_off(2 * nodes);
                let y = x.split_off(nodes);
                [x, y, z]
            }
            (_, Err(reason)) => {
                self.problem(reason);
                Default::default()
            }
            _ => {
                self.problem(format!("coord has the shape {shape:?}, it must be {dimensions} by the number of nodes"));
                Default::default()
            }
        }
    }

    /// All members of a family, each read by `read` from its position, number and name.
    fn family<T>(
        &mut self,
        family: &Family,
        kind: &str,
        read: impl Fn(&mut Self, usize, bool, i64, String) -> T,
    ) -> Vec<T> {
        let status = self.integers(family.status);
        let ids = self.integers(family.ids);
        let lengths = [self.arrays.dimension(family.count), ids.as_ref().map(Vec::len)];
        let count = lengths.into_iter().flatten().next().unwrap_or(0);
        for (name, array) in [(family.status, &status), (family.ids, &ids)] {
            if let Some(length) = array.as_ref().map(Vec::len).filter(|&length| length != count) {
                self.problem(format!(
                    "the mesh has {}, but {name} has {}",
                    counted(count, kind),
                    counted(length, "value")
                ));
                return Vec::new();
            }
        }
        let mut texts = self.arrays.texts(family.names).into_iter();
        (0..count)
            .map(|n| {
                let id = ids.as_ref().map_or(n as i64 + 1, |ids| ids[n]);
                let null = status.as_ref().is_some_and(|status| status[n] == 0);
                read(self, n, null, id, texts.next().unwrap_or_default())
            })
            .collect()
    }

    fn block(&mut self, n: usize, null: bool, id: i64, name: String) -> BlockTable {
        let mut block = BlockTable { id, name, ..BlockTable::default() };
        let variable = names::connectivity(n);
        let absent = self.arrays.dimension(&names::block_elements(n)).is_none() && !self.arrays.has(&variable);
        if null || absent {
            return block;
        }
        block.element_type = self.arrays.variable_text(&variable, names::ELEMENT_TYPE).unwrap_or_default();
        match self.arrays.shape(&variable).as_deref() {
            Some(&[_, nodes_per_element]) => {
                block.nodes_per_element = nodes_per_element;
                block.connectivity = self.required(&variable, &format!("block {id}"));
                match self.arrays.reals(&names::attributes(n)) {
                    Ok(attributes) => block.attributes = attributes.unwrap_or_default(),
                    Err(reason) => self.problem(format!("block {id}: {reason}")),
                }
            }
            Some(shape) => {
                self.problem(format!("block {id}: {variable} has the shape {shape:?}, it must be elements by nodes"))
            }
            None => self.problem(format!("block {id}: {variable} is missing")),
        }
        block
    }

    fn node_set(&mut self, n: usize, null: bool, id: i64, name: String) -> NodeSetTable {
        let variable = names::node_set_nodes(n);
        let absent = self.arrays.dimension(&names::node_set_size(n)).is_none() && !self.arrays.has(&variable);
        let nodes = if null || absent { Vec::new() } else { self.required(&variable, &format!("node set {id}")) };
        let factors = if nodes.is_empty() { Vec::new() } else { self.factors(&names::node_set_factors(n)) };
        NodeSetTable { id, name, nodes, factors }
    }

    fn side_set(&mut self, n: usize, null: bool, id: i64, name: String) -> SideSetTable {
        let (elements, sides) = (names::side_set_elements(n), names::side_set_sides(n));
        let absent = self.arrays.dimension(&names::side_set_size(n)).is_none() && !self.arrays.has(&elements);
        if null || absent {
            return SideSetTable { id, name, ..SideSetTable::default() };
        }
        let place = format!("side set {id}");
        SideSetTable {
            id,
            name,
            elements: self.required(&elements, &place),
            sides: self.required(&sides, &place),
            weighted: !self.factors(&names::side_set_factors(n)).is_empty(),
        }
    }

    /// Distribution factors that say anything: programs that have none to give write ones, or zeros.
    fn factors(&mut self, name: &str) -> Vec<f64> {
        let factors = self.whole_reals(name).ok().flatten().unwrap_or_default();
        let says_nothing = [0.0, 1.0].iter().any(|nothing| factors.iter().all(|factor| factor == nothing));
        if says_nothing { Vec::new() } else { factors }
    }
}
