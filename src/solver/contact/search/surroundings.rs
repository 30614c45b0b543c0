//! How fast things go where a node is: what rests beside something fast may soon be as fast.
//!
//! A node that is struck leaves a search box that was made for its rest, and one node that leaves is enough for a new search: a plate
//! that closes a gap from one end to the other asked for one every few dozen steps. What is slow beside fast faces therefore gets a box
//! in which it can go along with them for a while.

use super::Box3;
use super::locate::Reach;
use super::neighbourhood::face_box;
use super::occupancy::Occupancy;
use crate::comm::Communicator;
use crate::solver::contact::geometry::motion::{larger, smaller};
use crate::solver::contact::nodes::ContactNodes;
use crate::solver::contact::surface::layout::Layout;

/// Cells along each axis of the space in which things are fast.
const CELLS: usize = 32;

/// Kinds of speed that are told apart, each so many times as fast as the one before.
const KINDS: usize = 4;
const APART: f64 = 4.0;

/// The fastest path that counts, in rooms of nodes at rest over the steps of a search: what is faster counts as this fast. A fragment
/// must not give everything near some ordinary fast face a box as large as its own way.
const MOST: f64 = APART * APART * APART * APART;

/// How far some things go in a step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Motion {
    /// Between which lengths along each axis, zero among them.
    pub low: [f64; 3],
    /// The largest.
    pub high: [f64; 3],
}

impl Motion {
    /// Of these and of another thing, which goes along a path.
    fn and(self, path: [f64; 3]) -> Motion {
        let of = |choose: fn(f64, f64) -> f64, own: [f64; 3]| [0, 1, 2].map(|axis| choose(path[axis], own[axis]));
        Motion { low: of(smaller, self.low), high: of(larger, self.high) }
    }

    /// The farthest along an axis, a length.
    pub fn longest(&self) -> f64 {
        [0, 1, 2].into_iter().fold(0.0, |longest, axis| larger(larger(-self.low[axis], self.high[axis]), longest))
    }
}

/// The space in which fast things are, for each kind of speed.
pub struct Surroundings {
    kinds: Vec<(Motion, Occupancy)>,
}

impl Surroundings {
    /// Where faces are whose corners leave the room of nodes at rest before their search boxes end. `faces` are those of elements
    /// that are here; the boxes of the contact nodes are those of the coming search. All ranks call it and learn the same.
    pub fn of(
        faces: &[u32],
        (layout, contact_nodes): (&Layout, &ContactNodes),
        reach: Reach,
        comm: &mut dyn Communicator,
    ) -> Surroundings {
        let most = MOST * reach.least / reach.steps;
        let path = |node: usize| contact_nodes.path(node).map(|path| path.clamp(-most, most));
        let length = |node: usize| Motion::default().and(path(node)).longest();
        let longest: Vec<f64> = (0..contact_nodes.list.len()).map(length).collect();
        let mut kinds: [(Motion, Vec<Box3>); KINDS] = Default::default();
        for &face in faces {
            let corners = layout.faces.corners[face as usize];
            let corners = corners.iter().filter_map(|&corner| contact_nodes.of(corner));
            let fastest = corners.clone().fold(0.0, |fastest, node| larger(longest[node], fastest));
            let Some(kind) = kind(fastest * reach.steps / reach.least) else { continue };
            let own = face_box(face, layout, contact_nodes);
            if own.is_sound() {
                let (motion, boxes) = &mut kinds[kind];
                *motion = corners.fold(*motion, |motion, node| motion.and(path(node)));
                boxes.push(own);
            }
        }
        Surroundings::together(&kinds, comm)
    }

    /// What all ranks know together. A grid for each kind, the same on all, whose cells are occupied where they are on any.
    fn together(kinds: &[(Motion, Vec<Box3>); KINDS], comm: &mut dyn Communicator) -> Surroundings {
        let mut least = [[[0.0; 3]; 4]; KINDS];
        for (least, (motion, boxes)) in least.iter_mut().zip(kinds) {
            let Box3 { low, high } = boxes.iter().fold(Box3::empty(), |all, of| all.joined(of));
            *least = [low, high.map(|x| -x), motion.low, motion.high.map(|x| -x)];
        }
        comm.all_min(least.as_flattened_mut().as_flattened_mut());
        let mut all = Vec::new();
        for ([low, high, lowest, highest], (_, boxes)) in least.into_iter().zip(kinds) {
            let motion = Motion { low: lowest, high: highest.map(|x| -x) };
            if motion.longest() > 0.0 {
                let around = Box3 { low, high: high.map(|x| -x) };
                all.push((motion, Occupancy::within(around, boxes.iter(), CELLS)));
            }
        }
        join_over_ranks(all.iter_mut().map(|(_, cells)| cells).collect(), comm);
        Surroundings { kinds: all }
    }

    /// How far the fastest things near a box go in a step; `None` where nothing is much faster than what goes along such a path
    /// itself, for which it has its own room.
    pub fn near(&self, of: &Box3, path: [f64; 3]) -> Option<&Motion> {
        let least = APART * Motion::default().and(path).longest();
        let faster = self.kinds.iter().rev().filter(|(motion, _)| motion.longest() > least);
        let mut near = faster.filter(|(_, cells)| cells.may_meet(of)).map(|(motion, _)| motion);
        near.next()
    }
}

/// Grids that are the same on all ranks become occupied where they are on any. By way of rank 0, so that each rank gets them once.
fn join_over_ranks(mut grids: Vec<&mut Occupancy>, comm: &mut dyn Communicator) {
    if grids.is_empty() || comm.size() == 1 {
        return;
    }
    let mut take = |bytes: &[u8]| {
        let parts = bytes.chunks_exact((bytes.len() / grids.len()).max(1));
        grids.iter_mut().zip(parts).for_each(|(grid, bytes)| grid.join(&Occupancy::from_bytes(bytes, CELLS)));
        grids.iter().flat_map(|grid| grid.to_bytes()).collect::<Vec<u8>>()
    };
    let own = take(&[]);
    let mut all = own.clone();
    for bytes in comm.gather(own).into_iter().flatten() {
        all = take(&bytes);
    }
    comm.broadcast(&mut all);
    take(&all);
}

/// The kind of a speed at which so many times the room of a node at rest is gone; `None` for what stays within it.
fn kind(rooms: f64) -> Option<usize> {
    if rooms.is_nan() || rooms <= 1.0 {
        return None;
    }
    let (mut kind, mut next) = (0, APART);
    while kind + 1 < KINDS && rooms > next {
        (kind, next) = (kind + 1, APART * next);
    }
    Some(kind)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::run_threads;

    fn cube(at: f64, size: f64) -> Box3 {
        Box3 { low: [at; 3], high: [at + size; 3] }
    }

    /// Something slow near the origin, something ten times as fast far away, on whichever ranks they are: beside each a node
    /// learns how it moves, between them of none, and where both are of the faster one.
    #[test]
    fn all_ranks_learn_how_fast_what_is_near_goes() {
        let things = [
            (0, [2.0, 0.0, -1.0], cube(0.0, 1.0)),
            (1, [0.0, 20.0, 0.0], cube(9.0, 1.0)),
            (0, [2.0, 0.0, 1.0], cube(9.0, 0.5)),
            (0, [1.5, 0.0, 0.0], cube(0.5, 1.0)),
        ];
        let learnt = |ranks: usize, of: Box3, path: [f64; 3]| {
            let results = run_threads(ranks, |comm| {
                let mut kinds: [(Motion, Vec<Box3>); KINDS] = Default::default();
                for (number, (kind, path, own)) in things.iter().enumerate() {
                    if number % ranks == comm.rank() {
                        kinds[*kind].0 = kinds[*kind].0.and(*path);
                        kinds[*kind].1.push(*own);
                    }
                }
                Ok::<_, ()>(Surroundings::together(&kinds, comm).near(&of, path).copied())
            });
            results.unwrap_or_else(|_| panic!("a rank failed"))
        };
        let slow = Motion { low: [0.0, 0.0, -1.0], high: [2.0, 0.0, 1.0] };
        let fast = Motion { low: [0.0; 3], high: [0.0, 20.0, 0.0] };
        for (at, expected) in [(0.9, Some(slow)), (5.0, None), (9.2, Some(fast)), (-5.0, None)] {
            for ranks in [1, 2, 3] {
                let found = learnt(ranks, cube(at, 0.1), [0.1; 3]);
                assert_eq!(found, vec![expected; ranks], "at {at} on {ranks} ranks");
            }
        }
        // What goes half as fast itself is not concerned.
        assert_eq!(learnt(2, cube(0.9, 0.1), [0.0, 1.0, 0.0]), vec![None; 2]);
        assert_eq!(learnt(2, cube(9.2, 0.1), [0.0, 1.0, 0.0]), vec![Some(fast); 2]);
    }

    #[test]
    fn kinds_are_four_times_as_fast_as_those_before() {
        let kinds = [0.5, 1.0, 1.1, 4.0, 4.1, 17.0, 65.0, 1e9, f64::INFINITY, f64::NAN].map(kind);
        let [a, b, c, d] = [0, 1, 2, 3].map(Some);
        assert_eq!(kinds, [None, None, a, a, b, c, d, d, d, None]);
    }
}
