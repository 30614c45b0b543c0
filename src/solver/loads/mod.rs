//! External forces: pressure on deformed faces, forces on node sets, gravity, silent boundaries.
//!
//! Every loaded entity keeps its own work, ½ Δt̄ F·v⁻ before and ½ Δt̄ F·v⁺ after the kick of a step, so that the
//! energy balance is that of the discrete scheme and its sum does not depend on the decomposition.
//!
//! A load is a file here and a line in [`LOADS`]. It cannot be made without saying what it adds to the forces, how its work is
//! booked and kept over a restart, and what the log prints of it: the balance and the restart ask for the same accounts.

mod force;
mod gravity;
mod pressure;
mod silent;

use super::body::Body;
use super::constraints::StepTimes;
use super::nodes::Nodes;
use crate::mesh::Mesh;
use crate::model::{Function, Model};

pub use gravity::gravity_now;
pub use pressure::{PressureFace, PressureFaces, area_vectors};

/// Every load there is, in the order in which the log prints them.
pub static LOADS: &[&LoadEntry] = &[&force::ENTRY, &pressure::ENTRY, &gravity::ENTRY, &silent::ENTRY];

/// What the log, restart files and the solver need to know of a kind of load.
pub struct LoadEntry {
    /// Its command in the deck.
    pub command: &'static str,
    /// Name of its works in restart files.
    pub works: &'static str,
    /// What its works are kept by.
    pub key: Key,
    /// When it acts among the loads of a step.
    pub turn: Turn,
    /// The table that the log prints of it: title, columns, and a line for each.
    pub echo: fn(&Model) -> (&'static str, &'static str, Vec<String>),
    /// The loads of this kind on a rank; `None` where there are none, or where elements' faces carry them.
    pub make: fn(&Setting) -> Option<Box<dyn Load>>,
}

/// What a work is kept by in a restart: places in the mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Key {
    /// A node, and so many numbers more.
    Node(usize),
    /// An element, and so many numbers more.
    Element(usize),
}

impl Key {
    /// Numbers in the key.
    pub fn width(self) -> usize {
        let (Key::Node(more) | Key::Element(more)) = self;
        1 + more
    }
}

/// The order in which loads act: sums at nodes depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Turn {
    /// With the elements whose faces carry it.
    Elements,
    /// On the bulk of the body.
    Body,
    /// On single nodes.
    Nodes,
    /// After all others, whose forces it must know.
    Last,
}

/// A rank's share of the problem, of which loads are made.
pub struct Setting<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// The model.
    pub model: &'a Model,
    /// The whole body.
    pub body: &'a Body,
    /// Local number of each node of the mesh, `ABSENT` where it is not here.
    pub local: &'a [u32],
    /// Number of local nodes.
    pub nodes: usize,
}

/// Loads of one kind on one rank.
pub trait Load: Send {
    /// The table entry of this kind.
    fn entry(&self) -> &'static LoadEntry;

    /// Adds its forces at the present state to those of the nodes.
    fn apply(&mut self, nodes: &mut Nodes, functions: &[Function], step: &StepTimes);

    /// Books half the step's work with the velocities as they stand.
    fn book(&mut self, nodes: &Nodes, half_step: f64);

    /// Hands out all works with what they belong to.
    fn accounts(&mut self, places: &Places, visit: &mut dyn FnMut(Account));

    /// Elements are gone, by their canonical numbers, ascending: what acts on them does so no more. `all` are those that are
    /// gone in all, not only now.
    fn lose(&mut self, _dead: &[u32], _all: bool) {}
}

/// Work that something has done so far.
pub struct Account<'a> {
    /// What it belongs to, in places of the mesh file: as many numbers as [`Key::width`] says, and zeros.
    pub key: [f64; 4],
    /// Whether this rank answers for it.
    pub own: bool,
    /// The work, energy.
    pub work: &'a mut f64,
}

/// Where nodes and elements of a rank are in the mesh file.
pub struct Places<'a> {
    /// The nodes.
    pub nodes: &'a Nodes,
    /// File place and canonical number of each local element; the latter ascending.
    pub elements: [&'a [u32]; 2],
}

impl Places<'_> {
    /// File place of a local node.
    pub fn node(&self, node: u32) -> f64 {
        f64::from(self.nodes.file[node as usize])
    }

    /// Whether this rank answers for a local node.
    pub fn owns(&self, node: u32) -> bool {
        self.nodes.owned[node as usize]
    }

    /// File place of an element of this rank, by its canonical number.
    pub fn element(&self, canonical: u32) -> f64 {
        let [file, numbers] = self.elements;
        numbers.binary_search(&canonical).map_or(f64::NAN, |place| f64::from(file[place]))
    }
}

/// All loads of a rank.
pub fn all<'a>(
    faces: &'a mut PressureFaces,
    loads: &'a mut [Box<dyn Load>],
) -> impl Iterator<Item = &'a mut (dyn Load + 'a)> {
    let others = loads.iter_mut().map(|load| &mut **load as &mut dyn Load);
    std::iter::once(faces as &mut dyn Load).chain(others)
}

/// All loads of a rank but those of faces, in the order in which they act.
pub fn make(setting: &Setting) -> Vec<Box<dyn Load>> {
    let mut loads: Vec<Box<dyn Load>> = LOADS.iter().filter_map(|entry| (entry.make)(setting)).collect();
    loads.sort_by_key(|load| load.entry().turn);
    loads
}

/// Number of a function in the deck, by its place in the model.
fn function_number(model: &Model, function: usize) -> i64 {
    model.functions.get(function).map_or(0, |function| function.id)
}
