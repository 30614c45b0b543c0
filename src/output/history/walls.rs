//! Rigid surfaces: the force that they exert on the nodes of a side set.

use super::summed;
use crate::comm::{Communicator, ExactSum};
use crate::mesh::Mesh;
use crate::solver::Solver;

/// A side set that meets rigid surfaces.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    id: i64,
    /// Places of its nodes in the mesh, ascending, each once.
    nodes: Vec<u32>,
}

impl Wall {
    /// The nodes of a side set of the mesh.
    pub fn new(mesh: &Mesh, id: i64) -> Wall {
        Wall { id, nodes: mesh.side_set_nodes(id) }
    }

    /// Names of the variables.
    pub fn names(&self) -> [String; 3] {
        ["FX", "FY", "FZ"].map(|name| format!("{name}_WALL{}", self.id))
    }
}

/// Forces on all of them, on all ranks. All ranks call it.
pub fn forces(walls: &[Wall], solver: &mut Solver, comm: &mut dyn Communicator) -> Vec<Vec<f64>> {
    if walls.is_empty() {
        return Vec::new();
    }
    solver.complete_contact(comm);
    let nodes = &solver.domain.nodes;
    let mut sums: Vec<ExactSum> = (0..3 * walls.len()).map(|_| ExactSum::new()).collect();
    for (node, force) in solver.domain.contact.iter().flat_map(|contact| contact.plane_forces()) {
        let place = node as usize;
        if !nodes.owned[place] {
            continue;
        }
        for (wall, own) in walls.iter().zip(sums.chunks_exact_mut(3)) {
            if wall.nodes.binary_search(&nodes.file[place]).is_ok() {
                own.iter_mut().zip(force).for_each(|(sum, part)| sum.add(part));
            }
        }
    }
    summed(sums, comm).chunks_exact(3).map(<[f64]>::to_vec).collect()
}
