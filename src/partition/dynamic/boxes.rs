//! Regions that need no decomposition of their own: the boxes of what ranks hold already.

use crate::comm::{Communicator, gather_for_all};

/// One box per rank, around what it holds; the same on all ranks. Boxes may overlap and need not fill space.
#[derive(Debug, Clone, PartialEq)]
pub struct Boxes {
    low: Vec<[f64; 3]>,
    high: Vec<[f64; 3]>,
}

impl Boxes {
    /// Tells all ranks the box of this one, with a `low` above its `high` when it holds nothing; every rank calls
    /// it. Sides that are not numbers count as infinitely far. Two collective calls: by way of rank 0 each box goes
    /// once to each rank, where a minimum over all would pass all boxes on in every round.
    pub fn gather(low: [f64; 3], high: [f64; 3], comm: &mut dyn Communicator) -> Boxes {
        let far = |sides: [f64; 3], far: f64| sides.map(|side| if side.is_nan() { far } else { side });
        let own = [far(low, f64::NEG_INFINITY), far(high, f64::INFINITY)];
        let bytes = own.as_flattened().iter().flat_map(|side| side.to_le_bytes()).collect();
        let all = gather_for_all(bytes, comm);
        let side = |b: &[u8]| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]);
        let sides: Vec<f64> = all.chunks_exact(8).map(side).collect();
        let of_ranks = || sides.chunks_exact(6);
        Boxes {
            low: of_ranks().map(|box_| [box_[0], box_[1], box_[2]]).collect(),
            high: of_ranks().map(|box_| [box_[3], box_[4], box_[5]]).collect(),
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
