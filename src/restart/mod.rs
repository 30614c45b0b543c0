//! The state of a run between two steps, whole and independent of how many ranks computed it.
//!
//! Each part of the solver says what it carries from step to step by visiting an [`Archive`]. Writing and reading are
//! the same visit, so that the two cannot differ. Everything is keyed by the mesh file: nodes and elements by their
//! place in it, other things by lists whose rows begin with such places.

mod load;

pub use load::Loader;

use crate::comm::Communicator;
use std::cmp::Ordering;

/// Everything that a run carries from one step to the next, in the order in which it was visited.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Snapshot {
    /// Numbers of the whole run.
    pub numbers: Vec<(String, f64)>,
    /// One value per node of the mesh.
    pub nodal: Vec<(String, Vec<f64>)>,
    /// One value per element of the mesh.
    pub element: Vec<(String, Vec<f64>)>,
    /// Lists; empty ones may be left out.
    pub lists: Vec<List>,
}

/// A table of numbers, sorted by its rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct List {
    /// Its name.
    pub name: String,
    /// Numbers in a row.
    pub width: usize,
    /// All rows, one after the other.
    pub values: Vec<f64>,
}

impl Snapshot {
    /// Time of the state.
    pub fn time(&self) -> f64 {
        self.number(TIME).unwrap_or(f64::NAN)
    }

    /// A number by its name.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.numbers.iter().find(|(known, _)| known == name).map(|(_, value)| *value)
    }
}

/// Name of the time among the numbers.
pub const TIME: &str = "TIME";

/// Name of the interval at which states were to be written, among the numbers of a file.
pub const INTERVAL: &str = "WRITEINTERVAL";

/// What a part of the solver tells its state to, or gets it from. All ranks visit the same things in the same order.
///
/// When loading, every call replaces what it is given; when saving, it leaves it alone.
pub trait Archive {
    /// Whether a state is being put back.
    fn loading(&self) -> bool;
    /// A number that is the same on all ranks.
    fn number(&mut self, name: &str, value: &mut f64);
    /// A value per local node; of nodes that several ranks share the owner's is kept.
    fn nodal(&mut self, name: &str, values: &mut [f64]);
    /// A value per local element.
    fn element(&mut self, name: &str, values: &mut [f64]);
    /// Rows of `width` numbers. Saving takes those of all ranks together; loading gives all to every rank, sorted.
    fn list(&mut self, name: &str, width: usize, rows: &mut Vec<f64>);
    /// The other ranks, for parts that have to talk when their state has changed.
    fn comm(&mut self) -> &mut dyn Communicator;
}

impl dyn Archive + '_ {
    /// A count that is the same on all ranks.
    pub fn count(&mut self, name: &str, value: &mut u64) {
        let mut number = *value as f64;
        self.number(name, &mut number);
        *value = number as u64;
    }

    /// Numbers that belong to no node and no element, in no order: saved from all ranks, given back to the first.
    pub fn heap(&mut self, name: &str, values: &mut Vec<f64>) {
        self.list(name, 1, values);
        if self.loading() && self.comm().rank() > 0 {
            values.clear();
        }
    }
}

/// The order of two rows: that of their first numbers that differ, in the total order of doubles.
pub fn compare_rows(a: &[f64], b: &[f64]) -> Ordering {
    let differ = a.iter().zip(b).map(|(x, y)| x.total_cmp(y)).find(|order| order.is_ne());
    differ.unwrap_or(a.len().cmp(&b.len()))
}

/// Brings the rows of a list into ascending order.
pub fn sort_rows(width: usize, values: &mut Vec<f64>) {
    let mut rows: Vec<&[f64]> = values.chunks_exact(width).collect();
    rows.sort_by(|a, b| compare_rows(a, b));
    *values = rows.concat();
}
