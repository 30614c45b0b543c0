//! Nodes and their sets: the mean of their motion, and the sum of the forces that hold or drive them.

use super::{NODE, SET, summed};
use crate::comm::{Communicator, ExactSum};
use crate::mesh::Mesh;
use crate::solver::Solver;

/// Displacement, velocity and reaction.
const SUMS: usize = 9;

/// Nodes whose motion is watched as one.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeGroup {
    kind: u8,
    id: i64,
    /// Places in the mesh, ascending, each once.
    nodes: Vec<u32>,
}

impl NodeGroup {
    /// A node set of the mesh; one that names a node twice counts it once.
    pub fn of_set(mesh: &Mesh, id: i64) -> Option<NodeGroup> {
        let mut nodes = mesh.node_set(id)?.nodes.clone();
        nodes.sort_unstable();
        nodes.dedup();
        Some(NodeGroup { kind: SET, id, nodes })
    }

    /// The node with a number.
    pub fn of_node(mesh: &Mesh, id: i64) -> Option<NodeGroup> {
        let place = mesh.node_ids.iter().position(|&other| other == id)?;
        Some(NodeGroup { kind: NODE, id, nodes: vec![place as u32] })
    }

    /// Whose motion is remembered.
    pub fn key(&self) -> (u8, i64) {
        (self.kind, self.id)
    }

    /// Names of the variables.
    pub fn names(&self) -> [String; 12] {
        let of = if self.kind == SET { "SET" } else { "NODE" };
        let names = ["DISPLX", "DISPLY", "DISPLZ", "VELX", "VELY", "VELZ", "ACCLX", "ACCLY", "ACCLZ", "RX", "RY", "RZ"];
        names.map(|name| format!("{name}_{of}{}", self.id))
    }
}

/// Values of all groups, with room for the acceleration, on all ranks. All ranks call it.
pub fn values(groups: &[NodeGroup], solver: &mut Solver, comm: &mut dyn Communicator) -> Vec<Vec<f64>> {
    if groups.is_empty() {
        return Vec::new();
    }
    solver.complete_contact(comm);
    let reactions = solver.reactions();
    let nodes = &solver.domain.nodes;
    let mut sums: Vec<ExactSum> = (0..SUMS * groups.len()).map(|_| ExactSum::new()).collect();
    for node in (0..nodes.places as u32).filter(|&node| nodes.owned[node as usize]) {
        let file = nodes.file[node as usize];
        for (group, own) in groups.iter().zip(sums.chunks_exact_mut(SUMS)) {
            if group.nodes.binary_search(&file).is_err() {
                continue;
            }
            let (x, initial) = (nodes.position(node), nodes.initial(node));
            let moved = [0, 1, 2].map(|i| x[i] - initial[i]);
            let parts = [moved, solver.velocity_now(node), reactions[node as usize]].concat();
            own.iter_mut().zip(parts).for_each(|(sum, part)| sum.add(part));
        }
    }
    let totals = summed(sums, comm);
    let of_group = |(group, totals): (&NodeGroup, &[f64])| {
        let count = group.nodes.len().max(1) as f64;
        let means = totals[..6].iter().map(|sum| sum / count);
        means.chain([0.0; 3]).chain(totals[6..].iter().copied()).collect()
    };
    groups.iter().zip(totals.chunks_exact(SUMS)).map(of_group).collect()
}
