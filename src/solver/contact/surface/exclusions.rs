//! Blocks that CONTACT EXCLUSION keeps from touching each other, or themselves.

use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::contact::geometry::faces::Faces;

/// Which blocks do not touch which, by their places in the mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Exclusions {
    /// For each pair of blocks whether it is left out; empty where none is.
    pairs: Vec<bool>,
    blocks: usize,
}

impl Exclusions {
    /// What the deck leaves out.
    pub fn new(mesh: &Mesh, model: &Model) -> Exclusions {
        let blocks = mesh.blocks.len();
        let mut pairs = vec![false; if model.contact.exclusions.is_empty() { 0 } else { blocks * blocks }];
        let named = |id: Option<i64>| -> Vec<usize> {
            id.map_or_else(|| (0..blocks).collect(), |id| mesh.block_index(id).into_iter().collect())
        };
        for &[first, second] in &model.contact.exclusions {
            for a in named(first) {
                for b in if second.is_none() { vec![a] } else { named(second) } {
                    (pairs[a * blocks + b], pairs[b * blocks + a]) = (true, true);
                }
            }
        }
        Exclusions { pairs, blocks }
    }

    /// Whether nothing is left out.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    fn pair(&self, a: u32, b: u32) -> bool {
        self.pairs[a as usize * self.blocks + b as usize]
    }

    /// Whether a point, which belongs to the blocks of its faces, or without any to `block`, is kept from touching a face: where all
    /// its blocks are kept from that of the face.
    pub fn keep_apart(&self, point: u32, block: u32, face: u32, faces: &Faces) -> bool {
        if self.is_empty() {
            return false;
        }
        let (around, of) = (faces.around(point), faces.block[face as usize]);
        if around.is_empty() {
            return self.pair(block, of);
        }
        around.iter().all(|&own| self.pair(faces.block[own as usize], of))
    }

    /// Whether two blocks are kept from touching each other.
    pub fn keep_blocks_apart(&self, a: u32, b: u32) -> bool {
        !self.is_empty() && self.pair(a, b)
    }

    /// The same of two edges by the faces on their sides.
    pub fn keep_edges_apart(&self, first: [u32; 2], second: [u32; 2], faces: &Faces) -> bool {
        let block = |face: u32| faces.block[face as usize];
        !self.is_empty() && first.iter().all(|&a| second.iter().all(|&b| self.pair(block(a), block(b))))
    }
}
