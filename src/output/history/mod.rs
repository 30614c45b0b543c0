//! Histories: what happens to what the analyst watches, as global variables of an EXODUS file.
//!
//! Points of the material, nodes, node sets, blocks, and the forces of contact. Each rank contributes what it computes;
//! sums go through [`ExactSum`], so that the file has the same bits on any number of ranks. Accelerations are the change of
//! velocity since the state before.

mod blocks;
mod points;
mod resultants;
mod sets;

use blocks::{Motion, block_motions};
pub use blocks::{block_energies, block_energy_names};

use super::plane;
use crate::comm::{Communicator, ExactSum};
use crate::mesh::{Dimension, Mesh};
use crate::model::{Model, Watched};
use crate::postprocess::means::Means;
use crate::solver::{Remembered, Solver};
use points::Points;
use sets::NodeGroup;

/// Kinds of what is watched, as [`Remembered`] tells them apart.
const POINT: u8 = 1;
const BLOCK: u8 = 2;
const SET: u8 = 3;
const NODE: u8 = 4;

/// What is watched; the same on all ranks.
#[derive(Debug, Clone)]
pub struct HistoryPlan {
    points: Points,
    /// Positions and numbers of blocks in the mesh.
    blocks: Vec<(usize, i64)>,
    groups: Vec<NodeGroup>,
    /// Commands that watch contact.
    contacts: Vec<Watched>,
    dimension: Dimension,
}

impl HistoryPlan {
    /// Finds what the model names in the mesh.
    pub fn new(mesh: &Mesh, model: &Model, solver: &Solver) -> HistoryPlan {
        let mut plan = HistoryPlan {
            points: Points::new(mesh, model, solver),
            blocks: Vec::new(),
            groups: Vec::new(),
            contacts: Vec::new(),
            dimension: mesh.dimension,
        };
        for watched in &model.histories {
            match *watched {
                Watched::Blocks => plan.blocks.extend(mesh.blocks.iter().map(|block| block.id).enumerate()),
                Watched::Block(id) => plan.blocks.extend(mesh.block_index(id).map(|index| (index, id))),
                Watched::NodeSet(id) => plan.groups.extend(NodeGroup::of_set(mesh, id)),
                Watched::Node(id) => plan.groups.extend(NodeGroup::of_node(mesh, id)),
                Watched::RigidSurface(_) | Watched::Contact(..) => plan.contacts.push(*watched),
            }
        }
        plan.blocks.sort_unstable();
        plan.blocks.dedup();
        plan
    }

    /// Whether nothing is watched.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty() && self.blocks.is_empty() && self.groups.is_empty() && self.contacts.is_empty()
    }

    /// Names of the variables: points, then blocks, then nodes and their sets, then contact.
    pub fn names(&self) -> Vec<String> {
        self.all_names().into_iter().filter(|name| plane::is_in(self.dimension, name)).collect()
    }

    /// The same with those that only space has.
    fn all_names(&self) -> Vec<String> {
        let blocks = self.blocks.iter().flat_map(|(_, id)| Motion::NAMES.map(|name| format!("{name}_BLOCK{id}")));
        let groups = self.groups.iter().flat_map(NodeGroup::names);
        let contacts = self.contacts.iter().flat_map(resultants::names);
        self.points.names().into_iter().chain(blocks).chain(groups).chain(contacts).collect()
    }

    /// Lines for the records: where points are, and which variables are means, after the last state that was due at the time `since`.
    pub fn records(&self, since: Option<f64>) -> Vec<String> {
        let beginnings = ["ACCL"].into_iter().chain(resultants::MEANS).map(String::from).collect();
        [self.points.records(), Means { beginnings, since }.lines()].concat()
    }

    /// A mesh of nothing but the watched elements, to show where they are.
    pub fn mesh(&self, whole: &Mesh) -> Mesh {
        self.points.mesh(whole)
    }

    /// Values in the order of [`HistoryPlan::names`] on rank 0, `None` on the others. The motion of a state that is `due` is
    /// kept, to be compared with the next one. All ranks call it.
    pub fn values(&self, solver: &mut Solver, comm: &mut dyn Communicator, due: bool) -> Option<Vec<f64>> {
        solver.refresh();
        let points = self.points.values(solver, comm);
        let blocks = block_motions(&self.blocks.iter().map(|(index, _)| *index).collect::<Vec<_>>(), solver, comm);
        let groups = sets::values(&self.groups, solver, comm);
        let contacts = if self.contacts.is_empty() { Vec::new() } else { solver.contact_resultants(due, comm) };
        let mut points = points?;
        let time = solver.time;
        let kept = &mut solver.remembered;
        if due {
            kept.mark(time);
        }
        let mut values = Vec::new();
        for (number, point) in points.iter_mut().enumerate() {
            accelerate(kept, (POINT, number as i64 + 1), time, due, point, self.points.acceleration(number));
            values.append(point);
        }
        for ((_, id), motion) in self.blocks.iter().zip(blocks) {
            let mut of_block = motion.values().to_vec();
            accelerate(kept, (BLOCK, *id), time, due, &mut of_block, 6);
            values.append(&mut of_block);
        }
        for (group, mut of_group) in self.groups.iter().zip(groups) {
            accelerate(kept, group.key(), time, due, &mut of_group, 6);
            values.append(&mut of_group);
        }
        let mut found = contacts.into_iter();
        let of_contact = self.contacts.iter();
        values.extend(of_contact.flat_map(|watched| resultants::values(watched, found.next().unwrap_or_default())));
        if self.dimension == Dimension::Two {
            let mut names = self.all_names().into_iter();
            values.retain(|_| names.next().is_some_and(|name| plane::is_in(self.dimension, &name)));
        }
        Some(values)
    }
}

/// Puts the acceleration to its place among values whose velocity stands from the fourth on.
fn accelerate(kept: &mut Remembered, key: (u8, i64), time: f64, due: bool, values: &mut [f64], place: usize) {
    let velocity = [3, 4, 5].map(|i| values.get(i).copied().unwrap_or(0.0));
    let acceleration = kept.acceleration(key, time, velocity, due);
    values.iter_mut().skip(place).zip(acceleration).for_each(|(value, part)| *value = part);
}

/// The sums of all ranks.
fn summed(mut sums: Vec<ExactSum>, comm: &mut dyn Communicator) -> Vec<f64> {
    if !sums.is_empty() {
        ExactSum::merge_ranks(&mut sums, comm);
    }
    sums.iter().map(ExactSum::value).collect()
}
