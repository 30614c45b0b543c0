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
use crate::solver::contact::geometry::motion::{four, larger};
use crate::solver::contact::geometry::paths::PathRange;
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

/// The space in which fast things are, for each kind of speed.
pub struct Surroundings {
    kinds: Vec<(PathRange, Occupancy)>,
}

impl Surroundings {
    /// Where faces are whose corners leave the room of nodes at rest before their search boxes end, all seen from the frame of these
    /// boxes: what flies along with it is at rest. `faces` are those of elements
    /// that are here; the boxes of the contact nodes are those of the coming search. All ranks call it and learn the same.
    pub fn of(
        faces: &[u32],
        (layout, contact_nodes): (&Layout, &ContactNodes),
        reach: Reach,
        comm: &mut dyn Communicator,
    ) -> Surroundings {
        let most = MOST * reach.least / reach.steps;
        let limited = |path: f64| if path.is_nan() { 0.0 } else { path.clamp(-most, most) };
        let path = |node: usize| contact_nodes.path_in_frame(node).map(limited);
        let mut kinds: [(PathRange, Vec<Box3>); KINDS] = Default::default();
        for &face in faces {
            let corners = layout.faces.corners[face as usize];
            let mut own_paths = PathRange::default();
            for corner in corners.iter().filter_map(|&corner| contact_nodes.of(corner)) {
                own_paths.take([[0.0; 4], four(path(corner))], u64::MAX);
            }
            let Some(kind) = kind(own_paths.paths().longest * reach.steps / reach.least) else { continue };
            let own = face_box(face, layout, contact_nodes);
            if own.is_sound() {
                let (paths, boxes) = &mut kinds[kind];
                *paths = paths.joined(own_paths);
                boxes.push(own);
            }
        }
        Surroundings::together(&kinds, comm)
    }

    /// What all ranks know together. A grid for each kind, the same on all, whose cells are occupied where they are on any.
    fn together(kinds: &[(PathRange, Vec<Box3>); KINDS], comm: &mut dyn Communicator) -> Surroundings {
        let mut boxes = [[[0.0; 3]; 2]; KINDS];
        let mut paths = kinds.each_ref().map(|(paths, _)| paths.to_array());
        for (around, (_, boxes)) in boxes.iter_mut().zip(kinds) {
            let Box3 { low, high } = boxes.iter().fold(Box3::empty(), |all, of| all.joined(of));
            *around = [low, high.map(|x| -x)];
        }
        comm.all_min(boxes.as_flattened_mut().as_flattened_mut());
        comm.all_min(paths.as_flattened_mut());
        let (mut present, mut cells) = (Vec::new(), Vec::new());
        for ((paths, [low, high]), (_, boxes)) in paths.into_iter().zip(boxes).zip(kinds) {
            let paths = PathRange::from_array(paths);
            if paths.paths().longest > 0.0 {
                let around = Box3 { low, high: high.map(|x| -x) };
                present.push(paths);
                cells.push(Occupancy::within(around, boxes.iter(), CELLS));
            }
        }
        Surroundings { kinds: present.into_iter().zip(joined_over_ranks(cells, comm)).collect() }
    }

    /// How far the fastest things near a box go in a step; `None` where nothing is much faster than what goes along such a path
    /// itself, for which it has its own room.
    pub fn near(&self, of: &Box3, path: [f64; 3]) -> Option<&PathRange> {
        let least = APART * path.iter().fold(0.0, |longest, path| larger(path.abs(), longest));
        let is_near = |(paths, cells): &&(PathRange, Occupancy)| paths.paths().longest > least && cells.may_meet(of);
        self.kinds.iter().rev().find(is_near).map(|(paths, _)| paths)
    }
}

/// Grids that are the same on all ranks, occupied where they are on any. By way of rank 0, so that each rank gets them once. All ranks
/// call it.
fn joined_over_ranks(grids: Vec<Occupancy>, comm: &mut dyn Communicator) -> Vec<Occupancy> {
    if grids.is_empty() || comm.size() == 1 {
        return grids;
    }
    let own: Vec<u8> = grids.iter().flat_map(Occupancy::to_bytes).collect();
    let length = own.len() / grids.len();
    // What is not a cell is the same in all.
    let both = |one: Vec<u8>, other: Vec<u8>| one.iter().zip(&other).map(|(a, b)| a | b).collect();
    let mut all = comm.gather(own).and_then(|parts| parts.into_iter().reduce(both)).unwrap_or_default();
    comm.broadcast(&mut all);
    all.chunks_exact(length).map(|bytes| Occupancy::from_bytes(bytes, CELLS)).collect()
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
                let mut kinds: [(PathRange, Vec<Box3>); KINDS] = Default::default();
                for (number, (kind, path, own)) in things.iter().enumerate() {
                    if number % ranks == comm.rank() {
                        kinds[*kind].0.take([[0.0; 4], four(*path)], u64::MAX);
                        kinds[*kind].1.push(*own);
                    }
                }
                Ok::<_, ()>(Surroundings::together(&kinds, comm).near(&of, path).map(PathRange::bounds))
            });
            results.unwrap_or_else(|_| panic!("a rank failed"))
        };
        let slow = [[0.0, 0.0, -1.0], [2.0, 0.0, 1.0]];
        let fast = [[0.0; 3], [0.0, 20.0, 0.0]];
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
