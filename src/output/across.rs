//! Faces of this rank's elements across which an element of another rank stands.

use crate::comm::Communicator;
use crate::mesh::Shape;
use crate::mesh::exterior::{faces, key_of};

/// A face that may have a neighbour: the [`key_of`] its nodes in the whole mesh, with the element and its side.
type Face = ([u32; 4], u32, u8);

/// What one rank brings to the matching of faces.
pub struct Candidates {
    faces: Vec<Face>,
}

impl Candidates {
    /// The faces of solid `elements`, each given with its number, its shape and its nodes in the whole mesh, all of whose
    /// nodes are `shared` with other ranks. A side that has collapsed to a line or a point is no face.
    pub fn new<'a>(
        elements: impl Iterator<Item = (u32, Shape, &'a [u32])>,
        shared: impl Fn(u32) -> bool,
    ) -> Candidates {
        let solids = elements.filter(|(_, shape, _)| shape.is_solid());
        let all =
            solids.flat_map(|(element, shape, nodes)| faces(shape, nodes).map(move |face| (element, shape, face)));
        let mut faces: Vec<Face> = all
            .filter(|(_, _, (_, nodes))| nodes.iter().all(|&node| shared(node)))
            .filter_map(|(element, shape, (side, nodes))| Some((key_of(shape, nodes)?, element, side)))
            .collect();
        faces.sort_unstable();
        Candidates { faces }
    }

    /// For each rank with an element across one of the faces, ascending: the elements here and their sides. Both ranks
    /// list the same faces in the same order, that of their nodes. All ranks call it.
    pub fn across(&self, neighbours: &[usize], comm: &mut dyn Communicator) -> Vec<(usize, Vec<(u32, u8)>)> {
        let own: Vec<u8> = self.faces.iter().flat_map(|(nodes, ..)| nodes.map(u32::to_le_bytes)).flatten().collect();
        let told = comm.sparse_exchange(neighbours.iter().map(|&rank| (rank, own.clone())).collect());
        let mut across = Vec::new();
        for (rank, bytes) in told {
            let (words, _) = bytes.as_chunks::<4>();
            let numbers: Vec<u32> = words.iter().map(|word| u32::from_le_bytes(*word)).collect();
            let (theirs, _) = numbers.as_chunks::<4>(); // Ascending, as ours are.
            let common = self.faces.iter().filter(|(nodes, ..)| theirs.binary_search(nodes).is_ok());
            let sides: Vec<(u32, u8)> = common.map(|&(_, element, side)| (element, side)).collect();
            if !sides.is_empty() {
                across.push((rank, sides));
            }
        }
        across
    }
}
