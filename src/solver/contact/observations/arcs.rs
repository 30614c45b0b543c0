//! Whether surfaces that are curved have touched with two elements side by side: with fewer an arc is a row of corners, and what
//! contact does there depends on where the nodes happen to be.
//!
//! Looked at every few steps, and only at nodes that are slaves: those that faces of others push. Of each node the first and the
//! last time are kept; two faces count as touched together where all their nodes have touched within the same stretch of time.

use crate::comm::Communicator;
use crate::common::vector::dot;
use crate::solver::contact::Contact;
use crate::solver::contact::geometry::edges;
use crate::solver::contact::geometry::faces::Faces;
use crate::solver::contact::geometry::projection::area_normal;

/// Steps from look to look.
pub const EVERY: u64 = 8;

/// Cosines between the normals of two faces of one arc: from 2 to 40 degrees. What turns by more is an edge.
const ARC: [f64; 2] = [0.766, 0.9994];

/// A face looks at what pushes it where the cosine between its normal and the push is below this.
pub const OPPOSED: f64 = -0.766;

const NEVER: u32 = u32::MAX;

/// What of the surface has touched when, by the numbers of the layout.
#[derive(Debug, Clone, Default)]
pub struct Arcs {
    /// First and last look at which each point was pushed.
    first: Vec<u32>,
    last: Vec<u32>,
    /// Faces that look at what has pushed one of their nodes.
    met: Vec<bool>,
}

impl Arcs {
    /// Of so many points and faces.
    pub fn new(points: usize, faces: usize) -> Arcs {
        Arcs { first: vec![NEVER; points], last: vec![0; points], met: vec![false; faces] }
    }

    /// A point that is pushed.
    pub fn touch(&mut self, point: u32, look: u32) {
        if let (Some(first), Some(last)) = (self.first.get_mut(point as usize), self.last.get_mut(point as usize)) {
            *first = (*first).min(look);
            *last = look;
        }
    }

    /// Whether a face may still learn that it has been met.
    pub fn waits(&self, face: u32) -> bool {
        self.met.get(face as usize) == Some(&false)
    }

    /// A face that looks at what pushes one of its nodes.
    pub fn meet(&mut self, face: u32) {
        if let Some(met) = self.met.get_mut(face as usize) {
            *met = true;
        }
    }

    /// What all ranks have seen. All ranks call it.
    fn merged(&self, comm: &mut dyn Communicator) -> Arcs {
        let mut votes: Vec<f64> = self.first.iter().map(|&look| f64::from(look)).collect();
        votes.extend(self.last.iter().map(|&look| -f64::from(look)));
        votes.extend(self.met.iter().map(|&met| -f64::from(u8::from(met))));
        comm.all_min(&mut votes);
        let (first, rest) = votes.split_at(self.first.len());
        let (last, met) = rest.split_at(self.last.len());
        Arcs {
            first: first.iter().map(|&look| look as u32).collect(),
            last: last.iter().map(|&look| -look as u32).collect(),
            met: met.iter().map(|&met| met < 0.0).collect(),
        }
    }

    /// Faces around the points that were pushed and those of faces that were met, ascending: with these come all pairs of
    /// neighbours of which something has touched. Of most surfaces they are a small part.
    fn concerned(&self, faces: &Faces) -> Vec<u32> {
        let mut asked: Vec<bool> = self.first.iter().map(|&first| first != NEVER).collect();
        for (corners, _) in faces.corners.iter().zip(&self.met).filter(|(_, met)| **met) {
            corners.iter().for_each(|&point| asked[point as usize] = true);
        }
        let around = |corners: &[u32; 4]| corners.iter().any(|&point| asked[point as usize]);
        (0..).zip(&faces.corners).filter(|(_, corners)| around(corners)).map(|(face, _)| face).collect()
    }

    /// Whether all nodes of two faces have touched at a time.
    fn together(&self, faces: &Faces, pair: [u32; 2]) -> bool {
        let points = || pair.iter().flat_map(|&face| faces.corners[face as usize]);
        let last = points().map(|point| self.last[point as usize]).min();
        points().map(|point| self.first[point as usize]).max() <= last
    }
}

impl Contact {
    /// Places of the blocks that have touched where they are curved, but never with two elements side by side; none where elements
    /// have gone. All ranks call it.
    pub fn short_arcs(&self, comm: &mut dyn Communicator) -> Vec<u32> {
        let (layout, faces) = (&self.layout, &self.layout.faces);
        if self.arcs.met.len() != faces.len() || faces.is_empty() {
            return Vec::new();
        }
        let arcs = self.arcs.merged(comm);
        let positions = self.skin.of_points(layout);
        let normal = |face: u32| area_normal(&faces.corners[face as usize].map(|point| positions[point as usize]));
        let mut blocks: Vec<[bool; 2]> = vec![[false; 2]; self.block_ids.len()];
        for pair in neighbours(faces, &arcs.concerned(faces), &positions) {
            let [n, m] = pair.map(normal);
            let cosine = dot(n, m) / (dot(n, n) * dot(m, m)).sqrt();
            let block = faces.block[pair[0] as usize];
            if cosine < ARC[0] || cosine.is_nan() || block != faces.block[pair[1] as usize] {
                continue;
            }
            let [curved, enough] = &mut blocks[block as usize];
            *curved |= cosine < ARC[1] && pair.iter().any(|&face| arcs.met[face as usize]);
            *enough |= arcs.together(faces, pair);
        }
        (0..).zip(blocks).filter(|(_, [curved, enough])| *curved && !enough).map(|(block, _)| block).collect()
    }
}

/// Pairs among some faces that share an edge, or in the plane all that share a node.
fn neighbours(faces: &Faces, chosen: &[u32], positions: &[[f64; 3]]) -> Vec<[u32; 2]> {
    let is_strip = |&[a, b, c, d]: &[u32; 4]| a == d && b == c;
    if !faces.corners.iter().all(is_strip) {
        return edges::between(chosen, faces, positions, false).iter().map(|edge| edge.faces).collect();
    }
    let beside = |point: u32| -> Option<[u32; 2]> {
        let mut around = faces.around(point).to_vec();
        around.dedup();
        around.try_into().ok()
    };
    (0..positions.len() as u32).filter_map(beside).collect()
}
