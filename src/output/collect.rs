//! Brings the values of all ranks together on rank 0, in file order.

use crate::comm::Communicator;
use crate::solver::Solver;

/// Where each rank's values belong in the file; filled on rank 0 only.
pub struct Collector {
    ranks: Vec<Places>,
    nodes: usize,
    elements: usize,
}

struct Places {
    nodes: Vec<u32>,
    elements: Vec<u32>,
}

impl Collector {
    /// Learns where every rank's values go.
    pub fn new(solver: &Solver, nodes: usize, elements: usize, comm: &mut dyn Communicator) -> Collector {
        let own = &solver.domain.nodes;
        let owned = own.file[..own.places].iter().zip(&own.owned).filter(|(_, owned)| **owned).map(|(file, _)| *file);
        let node_places = comm.gather(pack_integers(owned));
        let element_places = comm.gather(pack_integers(solver.domain.element_file.iter().copied()));
        let ranks = node_places.unwrap_or_default().into_iter().zip(element_places.unwrap_or_default());
        let ranks = ranks.map(|(n, e)| Places { nodes: unpack_integers(&n), elements: unpack_integers(&e) }).collect();
        Collector { ranks, nodes, elements }
    }

    /// Nodal values of the whole mesh, one array per variable, on rank 0; `None` on the others.
    pub fn nodal(&self, values: Vec<f64>, variables: usize, comm: &mut dyn Communicator) -> Option<Vec<Vec<f64>>> {
        self.whole(values, |places| &places.nodes, [variables, self.nodes], comm)
    }

    /// Element values of the whole mesh, one array per variable, on rank 0; `None` on the others.
    pub fn element(&self, values: Vec<f64>, variables: usize, comm: &mut dyn Communicator) -> Option<Vec<Vec<f64>>> {
        self.whole(values, |places| &places.elements, [variables, self.elements], comm)
    }

    /// Rank 0's own values go to their places without a message.
    fn whole(
        &self,
        values: Vec<f64>,
        places: impl Fn(&Places) -> &[u32],
        [variables, size]: [usize; 2],
        comm: &mut dyn Communicator,
    ) -> Option<Vec<Vec<f64>>> {
        let own = comm.rank() == 0;
        let parts = comm.gather(if own { Vec::new() } else { pack(&values) })?;
        let mut whole = vec![vec![0.0; size]; variables];
        for (part, places) in parts.iter().zip(self.ranks.iter().map(&places)).skip(1) {
            let values = part.chunks_exact(8).map(number);
            place(values, places, &mut whole);
        }
        place(values.into_iter(), self.ranks.first().map_or(&[][..], places), &mut whole);
        Some(whole)
    }
}

/// Puts the values of one rank, variable by variable, into the arrays of all.
fn place(mut values: impl Iterator<Item = f64>, places: &[u32], whole: &mut [Vec<f64>]) {
    for array in whole {
        for (&place, value) in places.iter().zip(&mut values) {
            array[place as usize] = value;
        }
    }
}

fn number(bytes: &[u8]) -> f64 {
    let mut eight = [0; 8];
    eight.copy_from_slice(bytes);
    f64::from_ne_bytes(eight)
}

fn pack(values: &[f64]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(8 * values.len());
    values.iter().for_each(|value| bytes.extend(value.to_ne_bytes()));
    bytes
}

fn pack_integers(values: impl Iterator<Item = u32>) -> Vec<u8> {
    values.flat_map(u32::to_ne_bytes).collect()
}

fn unpack_integers(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect()
}
