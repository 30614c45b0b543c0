//! DELETE MATERIAL: blocks that go at a time, with their nodes.

use super::{Erosion, drop_node};
use crate::mesh::Connectivity;
use crate::model::Deletion;
use crate::solver::domain::ABSENT;
use crate::solver::nodes::Nodes;
use std::sync::Arc;

/// Blocks that have gone or will go.
pub(super) struct Deletions {
    /// What is still to come.
    pub to_come: Vec<Deletion>,
    /// Numbers of the blocks that are gone, ascending.
    pub gone: Vec<i64>,
    /// Numbers of the mesh's blocks, and whether DEATH wants their nodes to go on.
    pub blocks: Vec<(i64, bool)>,
    /// Index of the block of each element, in canonical order.
    pub element_block: Arc<Vec<u32>>,
}

impl Deletions {
    /// Takes the blocks that go at the state at `time` off the list, if the next step is as long as the last one. All
    /// ranks find the same.
    pub fn due(&mut self, time: f64, time_step: f64) -> Vec<i64> {
        let reach = time + 0.5 * time_step;
        let due: Vec<i64> = self.to_come.iter().filter(|one| one.time <= reach).map(|one| one.block).collect();
        self.to_come.retain(|one| one.time > reach);
        self.gone.extend(&due);
        self.gone.sort_unstable();
        self.gone.dedup();
        due
    }

    /// Nodes that go on when they have lost their elements: those with an element of a block that wants it and is not
    /// deleted.
    pub fn keeps(&self, element_nodes: &Connectivity, nodes: usize) -> Vec<bool> {
        let wants = |(number, wants): &(i64, bool)| *wants && self.gone.binary_search(number).is_err();
        let wanting: Vec<bool> = self.blocks.iter().map(wants).collect();
        let mut keeps = vec![false; nodes];
        for (nodes, block) in element_nodes.iter().zip(&*self.element_block) {
            nodes.iter().for_each(|&node| keeps[node as usize] |= wanting[*block as usize]);
        }
        keeps
    }
}

impl Erosion {
    /// Drops the free masses that the elements of deleted blocks had left.
    pub(super) fn drop_free_nodes(&mut self, nodes: &mut Nodes) {
        self.keeps = self.deletions.keeps(&self.element_unknowns, self.local.len());
        for (&here, keeps) in self.local.iter().zip(&self.keeps).filter(|(here, _)| **here != ABSENT) {
            if self.left[here as usize] == 0 && !keeps {
                self.energy.extend(drop_node(nodes, here));
            }
        }
    }
}
