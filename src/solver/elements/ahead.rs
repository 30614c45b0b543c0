//! What a pass asks of the memory before it is needed.
//!
//! Hardware foretells the state of the next chunks where pages allow it, and can do nothing for nodes. Elements follow each other along
//! a curve through space: most corners of a chunk belong to elements a few chunks before it; others come for the first time, or
//! belong to elements that were neighbours long ago. Gathering and adding waited for these. To ask for all corners of the next chunk
//! costs more than it gains in bodies that fit a cache, so those few are written down once.

use crate::lanes::{CHUNK, Force, Lanes, Numbers, Row, prefetch, prefetch_named};

/// Nodes that a chunk needs and that may be far from the processor by then. Those that are too many are missing, and in place of those
/// that are too few stand others.
pub type FarNodes = [u32; MOST];

/// How many there is room for: a chunk of a large cube has eleven on average. One line of a cache.
const MOST: usize = 16;

/// Chunks in a row whose nodes and state stay in a second cache, or nearly so.
const NEAR: usize = 64;

/// Groups of so few chunks are in a cache as a whole, and need no list.
const SMALL: usize = 4096;

/// Far nodes of each chunk, given the local nodes of its elements, `unknowns` rows a chunk; none for small groups.
pub fn far_nodes(connectivity: &[[u32; CHUNK]], unknowns: usize) -> Vec<FarNodes> {
    let chunks = connectivity.len() / unknowns.max(1);
    if chunks < SMALL {
        return Vec::new();
    }
    let nodes = connectivity.as_flattened().iter().max().map_or(0, |&last| last as usize + 1);
    // One more than the number of the chunk that a node was in last, zero before the first.
    let mut last = vec![0u32; nodes];
    let mut all = Vec::with_capacity(chunks);
    for (chunk, rows) in connectivity.chunks_exact(unknowns).enumerate() {
        let mut far = [rows[0][0]; MOST];
        let mut places = far.iter_mut();
        for &node in rows.as_flattened() {
            let before = std::mem::replace(&mut last[node as usize], chunk as u32 + 1) as usize;
            if (before == 0 || before + NEAR <= chunk)
                && let Some(place) = places.next()
            {
                *place = node;
            }
        }
        all.push(far);
    }
    all
}

/// Bytes of the lists of so many elements.
pub fn bytes(elements: usize) -> usize {
    if elements < SMALL * CHUNK { 0 } else { elements * size_of::<FarNodes>() / CHUNK }
}

/// What is asked for while a row of chunks is computed: state and nodes of the next row, and the force sums from which the forces of
/// this one will be subtracted. In shares: all of it at once would fill the queue of what the first cache waits for, and hold up
/// the loads of this row.
pub struct Ahead<'a, R> {
    /// Rows of state.
    pub state: &'a [R],
    /// All nodes, and which of them.
    pub nodes: (&'a [Row], &'a [FarNodes]),
    /// All force sums, and which of them.
    pub forces: (&'a [Force], &'a [FarNodes]),
    /// In how many shares.
    pub shares: usize,
    /// How many have been asked for.
    pub taken: usize,
}

impl<R: Numbers> Ahead<'_, R> {
    /// Asks for the next share between parts of a kernel whose vectors are as long as rows. Shorter ones work rows off in several
    /// passes, between which there is occasion enough.
    #[inline(always)]
    pub fn pause<V: Lanes<Row = R>>(&mut self) {
        if Self::pauses::<V>() {
            self.go_on();
        }
    }

    /// Whether a kernel with these vectors pauses.
    pub const fn pauses<V: Lanes<Row = R>>() -> bool {
        V::COUNT == R::LANES
    }

    /// Asks for the next share.
    #[inline(always)]
    pub fn go_on(&mut self) {
        let (place, shares) = (self.taken, self.shares);
        self.taken += 1;
        prefetch(share(self.state, place, shares));
        // Asked once: kernels of bodies in a cache lose by two loops of no length.
        if self.forces.1.is_empty() {
            return;
        }
        prefetch_named(self.nodes.0, share(self.nodes.1.as_flattened(), place, shares));
        prefetch_named(self.forces.0, share(self.forces.1.as_flattened(), place, shares));
    }
}

/// One of some nearly equal shares.
#[inline(always)]
fn share<T>(all: &[T], place: usize, shares: usize) -> &[T] {
    all.get(all.len() * place / shares..all.len() * (place + 1) / shares).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of elements in which every node is in two chunks that follow each other, and one node in the first and the last.
    #[test]
    fn nodes_are_far_that_come_for_the_first_time_or_again_after_long() {
        let chunk = |chunk: u32| [chunk, chunk + 1].map(|node| [node; CHUNK]);
        let mut connectivity: Vec<[u32; CHUNK]> = (0..SMALL as u32).flat_map(chunk).collect();
        connectivity[2 * SMALL - 2] = [0; CHUNK];
        let far = far_nodes(&connectivity, 2);
        let of = |chunk: usize| {
            let mut nodes = far[chunk].to_vec();
            nodes.sort_unstable();
            nodes.dedup();
            nodes
        };
        assert_eq!(far.len(), SMALL);
        assert_eq!([of(0), of(1), of(7)], [vec![0, 1], vec![1, 2], vec![7, 8]]);
        assert_eq!(of(SMALL - 1), [0, SMALL as u32]);
        assert_eq!(far[7][0], 8);
        assert!(far_nodes(&connectivity[2..], 2).is_empty() && far_nodes(&[], 0).is_empty());
    }

    #[test]
    fn shares_are_all_of_it() {
        let all: Vec<usize> = (0..49).collect();
        for shares in 1..60 {
            let taken: Vec<usize> = (0..shares).flat_map(|place| share(&all, place, shares)).copied().collect();
            assert_eq!(taken, all);
        }
    }
}
