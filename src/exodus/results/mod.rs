//! A results file seen from outside: its states, variables and mesh.

pub(in crate::exodus) mod compare;
pub(in crate::exodus) mod restart;
pub(in crate::exodus) mod writer;

use std::path::{Path, PathBuf};

use netcdf::{Extent, Extents};

use crate::exodus::file::arrays::{Arrays, Reason};
use crate::exodus::file::error::{MeshError, ResultsError};
use crate::exodus::file::names;
use crate::exodus::mesh::read;
use crate::mesh::Mesh;

/// An EXODUS II file opened for reading its results. Files without states are fine: they have no times.
pub struct Results {
    path: PathBuf,
    arrays: Arrays,
    times: Vec<f64>,
    global_names: Vec<String>,
    nodal_names: Vec<String>,
    element_names: Vec<String>,
    nodes: usize,
    /// Elements of each block.
    block_sizes: Vec<usize>,
}

impl Results {
    /// Opens a results file of any container and any program.
    ///
    /// # Errors
    /// When it is not an EXODUS file, is cut short, or its times cannot be read.
    pub fn open(path: &Path) -> Result<Self, ResultsError> {
        let arrays = read::open(path)?;
        let times = arrays.reals(names::TIME).map_err(|what| unusable(path, what))?.unwrap_or_default();
        let blocks = arrays.dimension(names::NUM_BLOCKS).unwrap_or(0);
        let status = arrays.integers(names::BLOCKS.status).ok().flatten().unwrap_or_default();
        let size = |b: usize| match arrays.shape(&names::connectivity(b)).as_deref() {
            Some(&[elements, _]) if status.get(b) != Some(&0) => elements,
            _ => 0,
        };
        Ok(Results {
            path: path.to_owned(),
            times,
            global_names: arrays.texts(names::GLOBAL_NAMES),
            nodal_names: arrays.texts(names::NODAL_NAMES),
            element_names: arrays.texts(names::ELEMENT_NAMES),
            nodes: read::node_count(&arrays),
            block_sizes: (0..blocks).map(size).collect(),
            arrays,
        })
    }

    /// The file's name.
    pub(in crate::exodus) fn path(&self) -> &Path {
        &self.path
    }

    /// The file's arrays, for what EXODUS knows nothing of.
    pub(in crate::exodus) fn arrays(&self) -> &Arrays {
        &self.arrays
    }

    /// The file's title.
    pub fn title(&self) -> String {
        self.arrays.text(names::TITLE).unwrap_or_default()
    }

    /// The times of the states.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Names of the global variables, as the file spells them.
    pub fn global_names(&self) -> &[String] {
        &self.global_names
    }

    /// Names of the nodal variables, as the file spells them.
    pub fn nodal_names(&self) -> &[String] {
        &self.nodal_names
    }

    /// Names of the element variables, as the file spells them.
    pub fn element_names(&self) -> &[String] {
        &self.element_names
    }

    /// Quality-assurance records: program, version, date, time.
    pub fn qa(&self) -> Vec<[String; 4]> {
        read::qa_records(&self.arrays)
    }

    /// Info lines.
    pub fn info(&self) -> Vec<String> {
        self.arrays.texts(names::INFO)
    }

    /// The undeformed mesh. Its numbers are checked, its geometry is not.
    ///
    /// # Errors
    /// When the mesh is damaged or holds elements that are not supported.
    pub fn mesh(&self) -> Result<Mesh, MeshError> {
        read::assemble(&self.path, &self.arrays)
    }

    /// The same; nothing where the file holds variables of the whole body alone, as a history without points does.
    ///
    /// # Errors
    /// As [`Results::mesh`].
    pub fn mesh_if_any(&self) -> Result<Mesh, MeshError> {
        let only_values = self.nodes == 0 && !self.global_names.is_empty();
        if only_values { Ok(Mesh::default()) } else { self.mesh() }
    }

    /// All global values of a state, in the order of [`Results::global_names`].
    ///
    /// # Errors
    /// When there is no such state, or the values cannot be read.
    pub fn global(&self, state: usize) -> Result<Vec<f64>, ResultsError> {
        self.check(state)?;
        if self.global_names.is_empty() {
            return Ok(Vec::new());
        }
        self.read(names::GLOBAL_VALUES, &[at(state), ALL], self.global_names.len())
    }

    /// The values of a nodal variable in a state, one per node. Names compare without case.
    ///
    /// # Errors
    /// When there is no such variable or state, or the values cannot be read.
    pub fn nodal(&self, name: &str, state: usize) -> Result<Vec<f64>, ResultsError> {
        self.check(state)?;
        let variable = self.find("nodal", &self.nodal_names, name)?;
        if self.arrays.has(names::PACKED_NODAL_VALUES) {
            return self.read(names::PACKED_NODAL_VALUES, &[at(state), at(variable), ALL], self.nodes);
        }
        self.read(&names::nodal_values(variable), &[at(state), ALL], self.nodes)
    }

    /// The values of an element variable in a state, one per element in file order; NaN in blocks that do not have
    /// the variable. Names compare without case.
    ///
    /// # Errors
    /// When there is no such variable or state, or the values cannot be read.
    pub fn element(&self, name: &str, state: usize) -> Result<Vec<f64>, ResultsError> {
        self.check(state)?;
        let variable = self.find("element", &self.element_names, name)?;
        let mut values = Vec::with_capacity(self.block_sizes.iter().sum());
        for (block, &size) in self.block_sizes.iter().enumerate() {
            let array = names::element_values(variable, block);
            if size > 0 && self.arrays.has(&array) {
                values.extend(self.read(&array, &[at(state), ALL], size)?);
            } else {
                values.resize(values.len() + size, f64::NAN);
            }
        }
        Ok(values)
    }

    /// Distribution factors of the side set at a place among all; `None` where the file has none.
    pub(in crate::exodus) fn side_factors(&self, set: usize) -> Result<Option<Vec<f64>>, ResultsError> {
        let unusable = |what| ResultsError::Unusable { path: self.path.clone(), what };
        self.arrays.reals(&names::side_set_factors(set)).map_err(unusable)
    }

    /// A global variable in all states. Names compare without case.
    ///
    /// # Errors
    /// When there is no such variable, or the values cannot be read.
    pub fn global_history(&self, name: &str) -> Result<Vec<f64>, ResultsError> {
        let variable = self.find("global", &self.global_names, name)?;
        self.read(names::GLOBAL_VALUES, &[ALL, at(variable)], self.times.len())
    }

    /// A nodal variable at one node, by its zero-based place in the file, in all states. Names compare without case.
    ///
    /// # Errors
    /// When there is no such variable or node, or the values cannot be read.
    pub fn nodal_history(&self, name: &str, node: usize) -> Result<Vec<f64>, ResultsError> {
        let variable = self.find("nodal", &self.nodal_names, name)?;
        if self.arrays.has(names::PACKED_NODAL_VALUES) {
            return self.read(names::PACKED_NODAL_VALUES, &[ALL, at(variable), at(node)], self.times.len());
        }
        self.read(&names::nodal_values(variable), &[ALL, at(node)], self.times.len())
    }

    /// An element variable in one element, by its zero-based place in the file, in all states; NaN where the element's
    /// block does not have the variable. Names compare without case.
    ///
    /// # Errors
    /// When there is no such variable or element, or the values cannot be read.
    pub fn element_history(&self, name: &str, element: usize) -> Result<Vec<f64>, ResultsError> {
        let variable = self.find("element", &self.element_names, name)?;
        let mut place = element;
        for (block, &size) in self.block_sizes.iter().enumerate() {
            if place < size {
                let array = names::element_values(variable, block);
                if !self.arrays.has(&array) {
                    return Ok(vec![f64::NAN; self.times.len()]);
                }
                return self.read(&array, &[ALL, at(place)], self.times.len());
            }
            place -= size;
        }
        Err(unusable(&self.path, format!("there is no element at place {}", element + 1)))
    }

    /// The analyst's numbers of the nodes, in the file's order.
    ///
    /// # Errors
    /// When they cannot be read.
    pub fn node_ids(&self) -> Result<Vec<i64>, ResultsError> {
        self.ids(names::NODE_IDS, self.nodes)
    }

    /// The analyst's numbers of the elements, in the file's order.
    ///
    /// # Errors
    /// When they cannot be read.
    pub fn element_ids(&self) -> Result<Vec<i64>, ResultsError> {
        self.ids(names::ELEMENT_IDS, self.block_sizes.iter().sum())
    }

    /// A file without numbers counts from one.
    fn ids(&self, array: &str, count: usize) -> Result<Vec<i64>, ResultsError> {
        let ids = self.arrays.integers(array).map_err(|what| unusable(&self.path, what))?;
        Ok(ids.filter(|ids| ids.len() == count).unwrap_or_else(|| (1..=count as i64).collect()))
    }

    fn read(&self, array: &str, part: &[Extent], length: usize) -> Result<Vec<f64>, ResultsError> {
        let values =
            self.arrays.part_of_reals(array, &Extents::from(part)).map_err(|what| unusable(&self.path, what))?;
        if values.len() == length {
            return Ok(values);
        }
        Err(unusable(&self.path, format!("{array} has {} values where {length} belong", values.len())))
    }

    fn check(&self, state: usize) -> Result<(), ResultsError> {
        let count = self.times.len();
        if state < count { Ok(()) } else { Err(ResultsError::NoState { path: self.path.clone(), state, count }) }
    }

    fn find(&self, kind: &'static str, known: &[String], name: &str) -> Result<usize, ResultsError> {
        known.iter().position(|known| known.eq_ignore_ascii_case(name)).ok_or_else(|| ResultsError::NoVariable {
            path: self.path.clone(),
            kind,
            name: name.to_owned(),
            known: known.to_vec(),
        })
    }
}

const ALL: Extent = Extent::Slice { start: 0, stride: 1 };

fn at(index: usize) -> Extent {
    Extent::Index(index)
}

fn unusable(path: &Path, what: Reason) -> ResultsError {
    ResultsError::Unusable { path: path.to_owned(), what }
}
