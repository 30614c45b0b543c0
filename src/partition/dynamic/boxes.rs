//! Regions that need no decomposition of their own: the boxes of what ranks hold already.

use crate::comm::Communicator;

/// One box per rank, around what it holds; the same on all ranks. Boxes may overlap and need not fill space.
#[derive(Debug, Clone, PartialEq)]
pub struct Boxes {
    low: Vec<[f64; 3]>,
    high: Vec<[f64; 3]>,
}

impl Boxes {
    /// Tells all ranks the box of this one, with a `low` above its `high` when it holds nothing; every rank calls
    /// it. Sides that are not numbers count as infinitely far. One collective call.
    pub fn gather(low: [f64; 3], high: [f64; 3], comm: &mut dyn Communicator) -> Boxes {
        let mut minima = vec![f64::INFINITY; 6 * comm.size()];
        let own = &mut minima[6 * comm.rank()..][..6];
        for axis in 0..3 {
            own[axis] = if low[axis].is_nan() { f64::NEG_INFINITY } else { low[axis] };
            own[3 + axis] = if high[axis].is_nan() { f64::NEG_INFINITY } else { -high[axis] };
        }
        comm.all_min(&mut minima);
        let of_ranks = || minima.chunks_exact(6);
        Boxes {
            low: of_ranks().map(|box_| [0, 1, 2].map(|axis| box_[axis])).collect(),
            high: of_ranks().map(|box_| [3, 4, 5].map(|axis| -box_[axis])).collect(),
        }
    }

    /// Number of ranks.
    pub fn size(&self) -> usize {
        self.low.len()
    }

    /// Puts into `out` the ranks, ascending, whose boxes have a point in common with the box from `low` to `high`;
    /// touching counts. A side that is not a number reaches everywhere, and a box with a `low` above its `high`
    /// nothing.
    pub fn ranks_meeting(&self, low: [f64; 3], high: [f64; 3], out: &mut Vec<u32>) {
        out.clear();
        // Written as the gap, which no comparison with NaN finds.
        let gap = |a: &[f64; 3], b: &[f64; 3]| (0..3).any(|axis| a[axis] > b[axis]);
        if gap(&low, &high) {
            return;
        }
        let meets = |rank: &usize| {
            let (own_low, own_high) = (&self.low[*rank], &self.high[*rank]);
            !gap(own_low, own_high) && !gap(own_low, &high) && !gap(&low, own_high)
        };
        out.extend((0..self.size()).filter(meets).map(|rank| rank as u32));
    }

    /// The lower and upper sides of a rank's box.
    pub fn region(&self, rank: usize) -> ([f64; 3], [f64; 3]) {
        (self.low[rank], self.high[rank])
    }
}
