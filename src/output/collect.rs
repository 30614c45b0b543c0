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
        let parts = comm.gather(pack(&values))?;
        Some(place(&parts, self.ranks.iter().map(|r| &r.nodes[..]), variables, self.nodes))
    }

    /// Element values of the whole mesh, one array per variable, on rank 0; `None` on the others.
    pub fn element(&self, values: Vec<f64>, variables: usize, comm: &mut dyn Communicator) -> Option<Vec<Vec<f64>>> {
        let parts = comm.gather(pack(&values))?;
        Some(place(&parts, self.ranks.iter().map(|r| &r.elements[..]), variables, self.elements))
    }
}

fn place<'a>(
    parts: &[Vec<u8>],
    places: impl Iterator<Item = &'a [u32]>,
    variables: usize,
    size: usize,
) -> Vec<Vec<f64>> {
    let mut whole = vec![vec![0.0; size]; variables];
    for (part, places) in parts.iter().zip(places) {
        if places.is_empty() {
            continue;
        }
        let arrays = part.chunks_exact(8 * places.len());
        for (array, whole) in arrays.zip(&mut whole) {
            for (bytes, &place) in array.chunks_exact(8).zip(places) {
                whole[place as usize] = number(bytes);
            }
        }
    }
    whole
}

fn number(bytes: &[u8]) -> f64 {
    let mut eight = [0; 8];
    eight.copy_from_slice(bytes);
    f64::from_ne_bytes(eight)
}

fn pack(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_ne_bytes()).collect()
}

fn pack_integers(values: impl Iterator<Item = u32>) -> Vec<u8> {
    values.flat_map(u32::to_ne_bytes).collect()
}

fn unpack_integers(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect()
}
