//! Puts a state back: every rank takes its share of the whole.

use super::{Archive, Snapshot};
use crate::comm::Communicator;

/// An archive that is read.
pub struct Loader<'a> {
    snapshot: &'a Snapshot,
    nodes: Vec<u32>,
    elements: Vec<u32>,
    comm: &'a mut dyn Communicator,
    missing: Vec<String>,
}

impl<'a> Loader<'a> {
    /// A loader for a rank whose local nodes and elements have these places in the mesh file. Nodes that the file does
    /// not have keep their values.
    pub fn new(snapshot: &'a Snapshot, nodes: &[u32], elements: &[u32], comm: &'a mut dyn Communicator) -> Loader<'a> {
        Loader { snapshot, nodes: nodes.to_vec(), elements: elements.to_vec(), comm, missing: Vec::new() }
    }

    /// Names of what was asked for and is not there.
    pub fn missing(self) -> Vec<String> {
        self.missing
    }
}

/// Gives each place its value of the whole.
fn take(whole: &[f64], places: &[u32], values: &mut [f64]) {
    for (value, &place) in values.iter_mut().zip(places) {
        if let Some(new) = whole.get(place as usize) {
            *value = *new;
        }
    }
}

impl Archive for Loader<'_> {
    fn loading(&self) -> bool {
        true
    }

    fn number(&mut self, name: &str, value: &mut f64) {
        match self.snapshot.number(name) {
            Some(number) => *value = number,
            None => self.missing.push(name.to_string()),
        }
    }

    fn nodal(&mut self, name: &str, values: &mut [f64]) {
        match self.snapshot.nodal.iter().find(|(known, _)| known == name) {
            Some((_, whole)) => take(whole, &self.nodes, values),
            None => self.missing.push(name.to_string()),
        }
    }

    fn element(&mut self, name: &str, values: &mut [f64]) {
        match self.snapshot.element.iter().find(|(known, _)| known == name) {
            Some((_, whole)) => take(whole, &self.elements, values),
            None => self.missing.push(name.to_string()),
        }
    }

    fn list(&mut self, name: &str, width: usize, rows: &mut Vec<f64>) {
        rows.clear();
        match self.snapshot.lists.iter().find(|list| list.name == name) {
            Some(list) if list.width == width => rows.extend_from_slice(&list.values),
            Some(_) => self.missing.push(name.to_string()),
            None => {}
        }
    }

    fn comm(&mut self) -> &mut dyn Communicator {
        self.comm
    }
}
