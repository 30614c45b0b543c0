//! Do two EXODUS files hold the same results? The rules are those of exodiff, with an exact default.
//!
//! Titles, QA and info records are never compared, so that golden files outlive program versions.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::exodus::file::error::ResultsError;
use crate::exodus::results::Results;
use crate::mesh::{Block, Mesh};

/// How far two values may lie apart and still count as equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Largest allowed |a − b| / max(|a|, |b|). Zero asks for the same bits; any NaN equals any NaN.
    pub relative: f64,
    /// Values with |a| and |b| both at most this are equal whatever their ratio.
    pub floor: f64,
}

impl Tolerance {
    /// The same bits in both files.
    pub const EXACT: Tolerance = Tolerance { relative: 0.0, floor: 0.0 };

    /// A relative tolerance without a floor.
    pub fn relative(relative: f64) -> Self {
        Tolerance { relative, floor: 0.0 }
    }

    fn accepts(&self, a: f64, b: f64) -> bool {
        if a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()) {
            return true;
        }
        // What is no number, or infinite, equals nothing else, however large the floor.
        if !(a.is_finite() && b.is_finite()) {
            return false;
        }
        let largest = a.abs().max(b.abs());
        *self != Tolerance::EXACT && (largest <= self.floor || (a - b).abs() <= self.relative * largest)
    }
}

impl Default for Tolerance {
    fn default() -> Self {
        Tolerance::EXACT
    }
}

/// What a comparison found.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The two files.
    pub files: [PathBuf; 2],
    /// Number of states in each file; the states that both have were compared.
    pub states: [usize; 2],
    /// Variables that only the first and only the second file has, with their kind: `nodal variable DISPLX`.
    pub missing: [Vec<String>; 2],
    /// One entry per array that differs.
    pub differences: Vec<Difference>,
}

/// How one variable differs.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// The variable: `nodal variable DISPLX`, `time`, `coordinate x`, …
    pub variable: String,
    /// Where the largest difference is.
    pub largest: Place,
    /// How many values were compared, over all states.
    pub compared: usize,
    /// How many of them are not equal within the tolerance.
    pub differing: usize,
}

/// A value that differs.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Zero-based state and its time in the first file; `None` for what does not change with time.
    pub state: Option<(usize, f64)>,
    /// The entity in the analyst's numbers: `node 1042`, `element 7 of block 3`, or an empty string.
    pub entity: String,
    /// The values in both files.
    pub values: [f64; 2],
}

impl Place {
    /// |a − b|.
    pub fn absolute(&self) -> f64 {
        (self.values[0] - self.values[1]).abs()
    }

    /// |a − b| / max(|a|, |b|), zero if both are zero and infinite where one is no finite number.
    pub fn relative(&self) -> f64 {
        let [a, b] = self.values;
        let largest = a.abs().max(b.abs());
        if !(a.is_finite() && b.is_finite()) {
            f64::INFINITY
        } else if largest == 0.0 {
            0.0
        } else {
            self.absolute() / largest
        }
    }
}

impl Comparison {
    /// True when nothing differs.
    pub fn is_same(&self) -> bool {
        self.states[0] == self.states[1] && self.missing.iter().all(Vec::is_empty) && self.differences.is_empty()
    }
}

/// Compares coordinates, attributes, distribution factors, times and all variables of two files; works for meshes and histories as well.
///
/// Variables are matched by name without case, states, nodes and elements by their place in the file.
///
/// # Errors
/// When a file cannot be read, or their meshes differ in counts, numbers or connectivity, so that there is nothing
/// to set against each other.
pub fn compare(a: &Path, b: &Path, tolerance: &Tolerance) -> Result<Comparison, ResultsError> {
    let files = [Results::open(a)?, Results::open(b)?];
    let meshes = [files[0].mesh_if_any()?, files[1].mesh_if_any()?];
    if let Some(reason) = mesh_difference(&meshes[0], &meshes[1]) {
        return Err(ResultsError::DifferentMeshes { a: a.to_owned(), b: b.to_owned(), reason });
    }
    let mut comparer = Comparer { files: &files, mesh: &meshes[0], tolerance, differences: Vec::new() };
    comparer.coordinates(&meshes);
    let mut missing = [Vec::new(), Vec::new()];
    comparer.attributes(&meshes, &mut missing);
    comparer.node_factors(&meshes, &mut missing);
    comparer.side_factors(&mut missing)?;
    comparer.times();
    comparer.globals(&mut missing)?;
    comparer.nodal(&mut missing)?;
    comparer.element(&mut missing)?;
    Ok(Comparison {
        files: [a.to_owned(), b.to_owned()],
        states: files.each_ref().map(|f| f.times().len()),
        missing,
        differences: comparer.differences,
    })
}

/// What makes two meshes incomparable; coordinates do not.
fn mesh_difference(a: &Mesh, b: &Mesh) -> Option<String> {
    let count = |what: &str, a: usize, b: usize| (a != b).then(|| format!("{a} and {b} {what}"));
    count("nodes", a.coordinates.len(), b.coordinates.len())
        .or_else(|| count("elements", a.element_count(), b.element_count()))
        .or_else(|| count("blocks", a.blocks.len(), b.blocks.len()))
        .or_else(|| count("node sets", a.node_sets.len(), b.node_sets.len()))
        .or_else(|| count("side sets", a.side_sets.len(), b.side_sets.len()))
        .or_else(|| (a.node_ids != b.node_ids).then(|| "the nodes are numbered differently".into()))
        .or_else(|| (a.element_ids != b.element_ids).then(|| "the elements are numbered differently".into()))
        .or_else(|| {
            a.blocks.iter().zip(&b.blocks).find_map(|(a, b)| {
                (a.id != b.id || a.shape != b.shape || a.nodes != b.nodes)
                    .then(|| format!("block {} is not the same", a.id))
            })
        })
        .or_else(|| {
            a.node_sets.iter().zip(&b.node_sets).find_map(|(a, b)| {
                (a.id != b.id || a.nodes != b.nodes).then(|| format!("node set {} is not the same", a.id))
            })
        })
        .or_else(|| {
            a.side_sets.iter().zip(&b.side_sets).find_map(|(a, b)| {
                (a.id != b.id || a.sides != b.sides).then(|| format!("side set {} is not the same", a.id))
            })
        })
}

/// Goes through the arrays of two files and collects what differs.
struct Comparer<'a> {
    files: &'a [Results; 2],
    mesh: &'a Mesh,
    tolerance: &'a Tolerance,
    differences: Vec<Difference>,
}

/// The differences of one variable, gathered over its arrays.
#[derive(Default)]
struct Tally {
    compared: usize,
    differing: usize,
    largest: Option<(usize, usize, [f64; 2])>,
}

impl Tally {
    /// Sets two arrays against each other.
    fn add(&mut self, state: usize, a: &[f64], b: &[f64], tolerance: &Tolerance) {
        self.compared += a.len().max(b.len());
        for (index, (&a, &b)) in a.iter().zip(b).enumerate() {
            if tolerance.accepts(a, b) {
                continue;
            }
            self.differing += 1;
            // A NaN against a number outweighs every distance.
            let distance = |[a, b]: [f64; 2]| if (a - b).is_nan() { f64::INFINITY } else { (a - b).abs() };
            if self.largest.is_none_or(|(_, _, values)| distance([a, b]) > distance(values)) {
                self.largest = Some((state, index, [a, b]));
            }
        }
    }
}

impl Comparer<'_> {
    fn states(&self) -> std::ops::Range<usize> {
        0..self.files[0].times().len().min(self.files[1].times().len())
    }

    /// Notes a tally that found something.
    fn note(&mut self, variable: String, tally: Tally, in_time: bool, entity: impl Fn(usize) -> String) {
        let Some((state, index, values)) = tally.largest else { return };
        let time = self.files[0].times().get(state).copied().unwrap_or(f64::NAN);
        let largest = Place { state: in_time.then_some((state, time)), entity: entity(index), values };
        let (compared, differing) = (tally.compared, tally.differing);
        self.differences.push(Difference { variable, largest, compared, differing });
    }

    fn coordinates(&mut self, meshes: &[Mesh; 2]) {
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let values = meshes.each_ref().map(|mesh| mesh.coordinates.iter().map(|p| p[axis]).collect::<Vec<_>>());
            let mut tally = Tally::default();
            tally.add(0, &values[0], &values[1], self.tolerance);
            let mesh = self.mesh;
            self.note(format!("coordinate {name}"), tally, false, |node| format!("node {}", mesh.node_ids[node]));
        }
    }

    /// Attributes of elements, one of a block after the other.
    fn attributes(&mut self, meshes: &[Mesh; 2], missing: &mut [Vec<String>; 2]) {
        let mut first = 0;
        for (a, b) in meshes[0].blocks.iter().zip(&meshes[1].blocks) {
            let counts = [a, b].map(|block| block.attributes_of(0).len());
            for attribute in 0..counts[0].max(counts[1]) {
                let variable = format!("attribute {} of block {}", attribute + 1, a.id);
                if let Some(file) = counts.iter().position(|&count| attribute >= count) {
                    missing[1 - file].push(variable);
                    continue;
                }
                let of = |block: &Block| -> Vec<f64> {
                    (0..block.len()).map(|element| block.attributes_of(element)[attribute]).collect()
                };
                let mut tally = Tally::default();
                tally.add(0, &of(a), &of(b), self.tolerance);
                let mesh = self.mesh;
                self.note(variable, tally, false, |n| format!("element {}", mesh.element_ids[first + n]));
            }
            first += a.len();
        }
    }

    /// Distribution factors of node sets.
    fn node_factors(&mut self, meshes: &[Mesh; 2], missing: &mut [Vec<String>; 2]) {
        for set in &self.mesh.node_sets {
            let factors = meshes.each_ref().map(|mesh| mesh.node_factors.get(&set.id));
            let mesh = self.mesh;
            let place =
                |n: usize| set.nodes.get(n).map_or(String::new(), |&n| format!("node {}", mesh.node_ids[n as usize]));
            self.factors(format!("distribution factors of node set {}", set.id), factors, missing, place);
        }
    }

    /// Distribution factors of side sets, which meshes do not hold: side by side, a factor for each node of it.
    fn side_factors(&mut self, missing: &mut [Vec<String>; 2]) -> Result<(), ResultsError> {
        for (n, set) in self.mesh.side_sets.iter().enumerate().filter(|(_, set)| !set.sides.is_empty()) {
            let [a, b] = [self.files[0].side_factors(n)?, self.files[1].side_factors(n)?];
            let variable = format!("distribution factors of side set {}", set.id);
            self.factors(variable, [a.as_ref(), b.as_ref()], missing, |n| format!("factor {}", n + 1));
        }
        Ok(())
    }

    /// The factors of a set in both files.
    fn factors(
        &mut self,
        variable: String,
        factors: [Option<&Vec<f64>>; 2],
        missing: &mut [Vec<String>; 2],
        place: impl Fn(usize) -> String,
    ) {
        match factors {
            [Some(a), Some(b)] if a.len() == b.len() => {
                let mut tally = Tally::default();
                tally.add(0, a, b, self.tolerance);
                self.note(variable, tally, false, place);
            }
            [Some(a), Some(b)] => {
                let counts = [a, b].map(Vec::len);
                (0..2).for_each(|file| missing[file].push(format!("{} {variable}", counts[file])));
            }
            [None, None] => (),
            [a, _] => missing[usize::from(a.is_none())].push(variable),
        }
    }

    fn times(&mut self) {
        let mut tally = Tally::default();
        for state in self.states() {
            let [a, b] = self.files.each_ref().map(|f| f.times()[state]);
            tally.add(state, &[a], &[b], self.tolerance);
        }
        self.note("time".into(), tally, true, |_| String::new());
    }

    fn globals(&mut self, missing: &mut [Vec<String>; 2]) -> Result<(), ResultsError> {
        let names = self.files.each_ref().map(Results::global_names);
        let common = common_names("global", names, missing);
        let mut tallies: Vec<Tally> = common.iter().map(|_| Tally::default()).collect();
        for state in self.states() {
            let [a, b] = [self.files[0].global(state)?, self.files[1].global(state)?];
            for (&(_, i, j), tally) in common.iter().zip(&mut tallies) {
                let value = |values: &[f64], n: usize| values.get(n).copied().unwrap_or(f64::NAN);
                tally.add(state, &[value(&a, i)], &[value(&b, j)], self.tolerance);
            }
        }
        for ((name, ..), tally) in common.iter().zip(tallies) {
            self.note(format!("global variable {name}"), tally, true, |_| String::new());
        }
        Ok(())
    }

    fn nodal(&mut self, missing: &mut [Vec<String>; 2]) -> Result<(), ResultsError> {
        let names = self.files.each_ref().map(Results::nodal_names);
        for (name, ..) in common_names("nodal", names, missing) {
            let mut tally = Tally::default();
            for state in self.states() {
                let [a, b] = [self.files[0].nodal(name, state)?, self.files[1].nodal(name, state)?];
                tally.add(state, &a, &b, self.tolerance);
            }
            let mesh = self.mesh;
            self.note(format!("nodal variable {name}"), tally, true, |n| format!("node {}", mesh.node_ids[n]));
        }
        Ok(())
    }

    fn element(&mut self, missing: &mut [Vec<String>; 2]) -> Result<(), ResultsError> {
        let names = self.files.each_ref().map(Results::element_names);
        for (name, ..) in common_names("element", names, missing) {
            let mut tally = Tally::default();
            for state in self.states() {
                let [a, b] = [self.files[0].element(name, state)?, self.files[1].element(name, state)?];
                tally.add(state, &a, &b, self.tolerance);
            }
            let mesh = self.mesh;
            self.note(format!("element variable {name}"), tally, true, |n| element_place(mesh, n));
        }
        Ok(())
    }
}

fn element_place(mesh: &Mesh, element: usize) -> String {
    let block = mesh.elements().nth(element).map_or(0, |(block, _)| block);
    format!("element {} of block {}", mesh.element_ids[element], mesh.blocks[block].id)
}

/// Names that both files have, with their places; the others are noted as missing.
fn common_names<'a>(
    kind: &str,
    names: [&'a [String]; 2],
    missing: &mut [Vec<String>; 2],
) -> Vec<(&'a str, usize, usize)> {
    let place = |list: &[String], name: &str| list.iter().position(|other| other.eq_ignore_ascii_case(name));
    for (file, (own, other)) in [(names[0], names[1]), (names[1], names[0])].into_iter().enumerate() {
        let only = own.iter().filter(|name| place(other, name).is_none());
        missing[file].extend(only.map(|name| format!("{kind} variable {name}")));
    }
    let own = names[0].iter().enumerate();
    own.filter_map(|(i, name)| Some((name.as_str(), i, place(names[1], name)?))).collect()
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = self.files.each_ref().map(|file| file.display());
        if self.is_same() {
            return write!(f, "{a} and {b} are the same ({} states)", self.states[0]);
        }
        write!(f, "{a} and {b} differ")?;
        if self.states[0] != self.states[1] {
            write!(
                f,
                "\n  {} and {} states; the first {} are compared",
                self.states[0],
                self.states[1],
                self.states[0].min(self.states[1])
            )?;
        }
        for (file, names) in [&a, &b].into_iter().zip(&self.missing) {
            for name in names {
                write!(f, "\n  only in {file}: {name}")?;
            }
        }
        self.differences.iter().try_for_each(|difference| write!(f, "\n  {difference}"))
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Difference { variable, largest, compared, differing } = self;
        write!(f, "{variable}: {differing} of {compared} values differ, most")?;
        if let Some((state, time)) = largest.state {
            write!(f, " in state {} (time {time:e})", state + 1)?;
        }
        if !largest.entity.is_empty() {
            write!(f, " at {}", largest.entity)?;
        }
        let [a, b] = largest.values;
        let (absolute, relative) = (largest.absolute(), largest.relative());
        write!(f, ": {a:e} and {b:e}, difference {absolute:.3e}, relative {relative:.3e}")
    }
}
