//! The cuts of a bisection, and what they say about places in space.

use super::place::Place;

/// Space cut into one region per rank by recursive coordinate bisection, or into slices: the same on all ranks.
///
/// The ranks `first .. first + parts` of a subset are cut in `parts / 2` and the rest until one is left. A region is
/// a box that is open at its upper sides and reaches to infinity where nothing was cut; together they fill space.
#[derive(Debug, Clone, PartialEq)]
pub struct Bisection {
    size: usize,
    /// The cut between the ranks `i` and `i + 1` at `i`.
    pub(super) cuts: Vec<Cut>,
}

/// One cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cut {
    pub axis: usize,
    /// Places before this one are left of the cut.
    pub end: Place,
    /// Id of the point at the cut, the last one left of it or the first one right of it.
    pub point: u32,
}

/// Part of the tree of cuts: the ranks `first .. first + parts`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Ranks {
    pub first: usize,
    pub parts: usize,
}

impl Ranks {
    /// The ranks left and right of the cut.
    pub fn halves(self) -> [Ranks; 2] {
        let left = self.parts / 2;
        [Ranks { parts: left, ..self }, Ranks { first: self.first + left, parts: self.parts - left }]
    }

    /// Where the cut through these ranks, two or more, is kept.
    pub fn cut(self) -> usize {
        self.first + self.parts / 2 - 1
    }
}

impl Bisection {
    /// Room for the cuts between `size` ranks. As long as nothing is cut everything belongs to rank 0.
    pub(super) fn uncut(size: usize) -> Bisection {
        Bisection { size, cuts: vec![Cut { axis: 0, end: Place::END, point: 0 }; size.saturating_sub(1)] }
    }

    /// Number of ranks.
    pub fn size(&self) -> usize {
        self.size
    }

    /// All ranks.
    pub(super) fn all(&self) -> Ranks {
        Ranks { first: 0, parts: self.size }
    }

    /// The rank in whose region a point lies. Points in the face between two regions fall to either by `id`.
    /// Coordinates that are not finite count as the largest finite ones, NaN as the lowest.
    pub fn owner(&self, position: [f64; 3], id: u32) -> u32 {
        let mut ranks = self.all();
        while ranks.parts > 1 {
            let cut = &self.cuts[ranks.cut()];
            let [left, right] = ranks.halves();
            ranks = if Place::of(position[cut.axis], id) < cut.end { left } else { right };
        }
        ranks.first as u32
    }
}
