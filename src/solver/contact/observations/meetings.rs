//! Which blocks have met which: any contact that was found counts, whether or not it pushed, so that what is missing here has had
//! no say in anything.

use crate::comm::Communicator;
use crate::common::shared::Shared;
use crate::solver::contact::surface::layout::Layout;

/// Blocks that are followed, each a bit: of meshes with more nothing is known but whether anything met anything.
pub const FOLLOWED: usize = 128;

/// A set of blocks by their places in the mesh.
pub type Blocks = u128;

/// The set of one block; of none beyond those that are followed.
pub fn set_of(block: u32) -> Blocks {
    if (block as usize) < FOLLOWED { 1 << block } else { 0 }
}

/// Which blocks have met which so far.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Meetings {
    /// For each block those whose faces a node of it has met, by itself or at a node that it shares.
    met: Vec<Blocks>,
    /// For each pair of blocks, nodes of the first and faces of the second, how many candidates searches have found so far.
    candidates: Vec<u64>,
    /// Whether anything has met anything.
    pub any: bool,
    /// Whether edges have.
    pub edges: bool,
}

impl Meetings {
    /// Of a mesh with so many blocks.
    pub fn new(blocks: usize) -> Meetings {
        let followed = if blocks <= FOLLOWED { blocks } else { 0 };
        Meetings { met: vec![0; followed], candidates: vec![0; followed * followed], any: false, edges: false }
    }

    /// Whether single blocks are followed.
    pub fn follows(&self) -> bool {
        !self.met.is_empty()
    }

    /// A node of some blocks that has met faces of others.
    pub fn meet(&mut self, nodes: Blocks, faces: Blocks) {
        self.any = true;
        let mut rest = nodes;
        while rest != 0 {
            if let Some(met) = self.met.get_mut(rest.trailing_zeros() as usize) {
                *met |= faces;
            }
            rest &= rest - 1;
        }
    }

    /// A candidate that a search has found, by the blocks of node and face.
    pub fn count(&mut self, node: u32, face: u32) {
        let blocks = self.met.len();
        if let Some(count) = self.candidates.get_mut(node as usize * blocks + face as usize) {
            *count += 1;
        }
    }

    /// Whether two blocks have met.
    pub fn have_met(&self, a: usize, b: usize) -> bool {
        let has = |a: usize, b: usize| self.met.get(a).is_some_and(|met| met & set_of(b as u32) != 0);
        has(a, b) || has(b, a)
    }

    /// Whether a block has met any, itself included.
    pub fn has_met(&self, block: usize) -> bool {
        (0..self.met.len()).any(|other| self.have_met(block, other))
    }

    /// Part of all candidates that were of two blocks.
    pub fn share(&self, a: usize, b: usize) -> f64 {
        let blocks = self.met.len();
        let of = |a: usize, b: usize| self.candidates.get(a * blocks + b).copied().unwrap_or(0);
        let pairs = if a == b { of(a, a) } else { of(a, b) + of(b, a) };
        pairs as f64 / self.candidates.iter().sum::<u64>().max(1) as f64
    }

    /// What all ranks have met. All ranks call it.
    pub fn merged(&self, comm: &mut dyn Communicator) -> Meetings {
        let blocks = self.met.len();
        let mut votes: Vec<u64> =
            self.met.iter().flat_map(|met| (0..blocks).map(move |other| (met >> other & 1) as u64)).collect();
        votes.extend(&self.candidates);
        votes.extend([u64::from(self.any), u64::from(self.edges)]);
        comm.all_sum(&mut votes);
        let (met, rest) = votes.split_at(blocks * blocks);
        let (candidates, rest) = rest.split_at(blocks * blocks);
        let set = |row: &[u64]| row.iter().enumerate().fold(0, |set, (i, &vote)| set | Blocks::from(vote > 0) << i);
        Meetings {
            met: met.chunks_exact(blocks.max(1)).map(set).collect(),
            candidates: candidates.to_vec(),
            any: rest.first() > Some(&0),
            edges: rest.get(1) > Some(&0),
        }
    }
}

/// The blocks that have a say at a point, and at a face: of nodes that blocks share all of them.
pub fn blocks_around(layout: &Layout) -> [Shared<Blocks>; 2] {
    let faces = &layout.faces;
    let of_point = |(point, block): (u32, &u32)| {
        faces.around(point).iter().fold(set_of(*block), |set, &face| set | set_of(faces.block[face as usize]))
    };
    let points: Shared<Blocks> = (0..).zip(&layout.point_block).map(of_point).collect();
    let of_face = |corners: &[u32; 4]| corners.iter().fold(0, |set, &corner| set | points[corner as usize]);
    let of_faces = faces.corners.iter().map(of_face).collect();
    [points, of_faces]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::Serial;

    #[test]
    fn who_has_met_whom_is_known_both_ways_and_shares_add_up() {
        let mut met = Meetings::new(3);
        met.meet(set_of(0) | set_of(2), set_of(1));
        (0..3).for_each(|_| met.count(0, 1));
        met.count(1, 0);
        met.count(2, 2);
        let met = met.merged(&mut Serial);
        assert!(met.any && !met.edges && met.have_met(0, 1) && met.have_met(1, 2) && !met.have_met(0, 2));
        assert!((0..3).all(|block| met.has_met(block)) && !met.have_met(1, 1));
        assert_eq!((met.share(0, 1), met.share(1, 0), met.share(2, 2), met.share(0, 2)), (0.8, 0.8, 0.2, 0.0));
        let many = Meetings::new(FOLLOWED + 1);
        assert!(!many.follows() && !many.has_met(FOLLOWED) && many.share(0, 1) == 0.0);
    }
}
