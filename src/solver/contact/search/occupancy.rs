//! Which parts of space some boxes occupy, roughly: what is nowhere near them need not be searched for.

use super::Box3;
use std::ops::Range;

/// Cells that some boxes occupy, of a grid over the box around all of them: a bit for each, rows of cells along x.
#[derive(Debug, Clone, PartialEq)]
pub struct Occupancy {
    around: Box3,
    /// Number of cells along each axis, at most 64.
    cells: usize,
    /// Cells per length along each axis.
    inverse: [f64; 3],
    /// The cells along x that are occupied, by z and y.
    rows: Vec<u64>,
}

/// Most cells along an axis: the bits of a row.
const MOST: usize = 64;

/// Cells that a box reaches: the first along each axis, then the last. What is beyond the grid counts to its outermost cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellRange([u8; 6]);

impl CellRange {
    /// The cells that the smallest box around two others reaches.
    #[inline(always)]
    pub fn joined(self, CellRange(other): CellRange) -> CellRange {
        let CellRange(own) = self;
        CellRange([0, 1, 2, 3, 4, 5].map(|i| if i < 3 { own[i].min(other[i]) } else { own[i].max(other[i]) }))
    }
}

impl Occupancy {
    /// What sound boxes occupy of a grid of so many cells along each axis, 1 to 64. All else is left out.
    pub fn of(boxes: &[Box3], cells: usize) -> Occupancy {
        let sound = || boxes.iter().filter(|of| of.is_sound());
        Occupancy::within(sound().fold(Box3::empty(), |all, of| all.joined(of)), sound(), cells)
    }

    /// What sound boxes occupy of a grid over a box around all of them, which may be larger than they need.
    pub fn within<'a>(around: Box3, boxes: impl Iterator<Item = &'a Box3>, cells: usize) -> Occupancy {
        let mut occupancy = Occupancy::empty(around, cells);
        boxes.for_each(|of| occupancy.occupy(of));
        occupancy
    }

    fn empty(around: Box3, cells: usize) -> Occupancy {
        let cells = cells.clamp(1, MOST);
        let inverse = [0, 1, 2].map(|axis| {
            let inverse = cells as f64 / (around.high[axis] - around.low[axis]);
            // Where all is in one place, or farther apart than can be told, there is one cell.
            if inverse.is_finite() { inverse } else { 0.0 }
        });
        Occupancy { around, cells, inverse, rows: vec![0; cells * cells] }
    }

    fn occupy(&mut self, of: &Box3) {
        let (rows, bits) = self.rows_of(self.cells_of(of));
        rows.for_each(|row| self.rows[row].iter_mut().for_each(|row| *row |= bits));
    }

    /// The cells that a box reaches.
    #[inline(always)]
    pub fn cells_of(&self, of: &Box3) -> CellRange {
        // Never falls when a coordinate grows: what overlaps has a cell in common.
        let cell = |axis: usize, at: f64| {
            ((at - self.around.low[axis]) * self.inverse[axis]).clamp(0.0, (self.cells - 1) as f64) as u8
        };
        let ([a, b, c], [d, e, f]) = (of.low, of.high);
        CellRange([cell(0, a), cell(1, b), cell(2, c), cell(0, d), cell(1, e), cell(2, f)])
    }

    /// Runs of rows in which cells are, and the bits that they have there.
    #[inline(always)]
    fn rows_of(&self, CellRange(at): CellRange) -> (impl Iterator<Item = Range<usize>> + use<>, u64) {
        let ([x, y, z, last_x, last_y, last_z], cells) = (at.map(usize::from), self.cells);
        let rows = (z..=last_z).map(move |z| z * cells + y..z * cells + last_y + 1);
        (rows, (u64::MAX << x) & (u64::MAX >> (MOST - 1 - last_x)))
    }

    /// Whether any of some cells is occupied.
    #[inline(always)]
    pub fn any(&self, cells: CellRange) -> bool {
        let (mut rows, bits) = self.rows_of(cells);
        rows.any(|rows| self.rows[rows].iter().fold(0, |all, row| all | row) & bits != 0)
    }

    /// Whether a box may overlap one of those that occupy space; never `false` where it does.
    #[inline]
    pub fn may_meet(&self, of: &Box3) -> bool {
        of.overlaps(&self.around) && self.any(self.cells_of(of))
    }

    /// Boxes of the cells that are occupied, which hold all that occupies them.
    pub fn boxes(&self) -> impl Iterator<Item = Box3> + '_ {
        let Box3 { low, high } = self.around;
        let sides = [0, 1, 2].map(|axis| (high[axis] - low[axis]) / self.cells as f64);
        // A little larger than rounding makes a cell smaller, in how it is told and in where its corners come to be.
        let rounding = |axis: usize| 1e-9 * sides[axis] + 8.0 * f64::EPSILON * (low[axis].abs() + high[axis].abs());
        let margin = [0, 1, 2].map(rounding).into_iter().fold(0.0, f64::max).min(f64::MAX);
        let all = (0..self.cells * MOST * self.cells).filter(|&cell| self.rows[cell / MOST] >> (cell % MOST) & 1 == 1);
        all.map(move |cell| {
            let at = [cell % MOST, cell / MOST % self.cells, cell / MOST / self.cells];
            let corner = |axis: usize, ahead: usize| low[axis] + (at[axis] + ahead) as f64 * sides[axis];
            // Along an axis that is not divided, what there is lies anywhere.
            let divided = |axis: usize| self.inverse[axis] > 0.0;
            let first = |axis: usize| if divided(axis) { corner(axis, 0) } else { low[axis] };
            let last = |axis: usize| if divided(axis) { corner(axis, 1) } else { high[axis] };
            let Box3 { low, high } = Box3 { low: [0, 1, 2].map(first), high: [0, 1, 2].map(last) }.grown(margin);
            // What has grown beyond all numbers would be no sound box.
            let finite = |side: f64| side.clamp(f64::MIN, f64::MAX);
            Box3 { low: low.map(finite), high: high.map(finite) }
        })
    }

    /// As bytes, of which there are as many for any boxes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let sides = self.around.low.iter().chain(&self.around.high).flat_map(|side| side.to_le_bytes());
        let length = self.cells.div_ceil(8);
        sides.chain(self.rows.iter().flat_map(|row| row.to_le_bytes().into_iter().take(length))).collect()
    }

    /// From these bytes, with as many cells along each axis.
    pub fn from_bytes(bytes: &[u8], cells: usize) -> Occupancy {
        let (sides, rows) = bytes.split_at(6 * size_of::<f64>());
        let [a, b, c, d, e, f] =
            [0, 1, 2, 3, 4, 5].map(|i| f64::from_le_bytes(std::array::from_fn(|j| sides[8 * i + j])));
        let mut occupancy = Occupancy::empty(Box3 { low: [a, b, c], high: [d, e, f] }, cells);
        for (row, bytes) in occupancy.rows.iter_mut().zip(rows.chunks_exact(cells.div_ceil(8))) {
            *row = u64::from_le_bytes(std::array::from_fn(|i| bytes.get(i).copied().unwrap_or(0)));
        }
        occupancy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Boxes within a few lengths of a place, the origin or far from it.
    fn boxes(place: f64) -> impl Strategy<Value = Vec<Box3>> {
        let size = prop_oneof![8 => 0.0..0.2f64, 1 => 0.0..10.0f64, 1 => Just(0.0)];
        let one = (prop::array::uniform3(-3.0..3.0f64), prop::array::uniform3(size));
        let one = one.prop_map(move |(low, size)| {
            let low = low.map(|x| place + x);
            Box3 { low, high: [0, 1, 2].map(|axis| low[axis] + size[axis]) }
        });
        prop::collection::vec(one, 0..12)
    }

    /// Boxes that may overlap, at the same place; at the farthest a coordinate is told to within a quarter of a length.
    fn two() -> impl Strategy<Value = (Vec<Box3>, Vec<Box3>)> {
        let place = prop_oneof![3 => Just(0.0), 1 => Just(1e9), 1 => Just(-1e12), 1 => Just(1e15)];
        place.prop_flat_map(|place| (boxes(place), boxes(place)))
    }

    proptest! {
        /// What overlaps is never missed, before and after it has been sent.
        #[test]
        fn what_overlaps_may_meet((occupied, others) in two(), cells in 1usize..=64) {
            let occupancy = Occupancy::of(&occupied, cells);
            let sent = Occupancy::from_bytes(&occupancy.to_bytes(), cells);
            prop_assert_eq!(&sent, &occupancy);
            for other in &others {
                let meets = occupied.iter().any(|of| of.overlaps(other));
                prop_assert!(!meets || occupancy.may_meet(other));
                let by_boxes = occupancy.boxes().any(|cell| cell.overlaps(other));
                prop_assert!(!meets || by_boxes);
                for another in &others {
                    let joined = occupancy.cells_of(other).joined(occupancy.cells_of(another));
                    prop_assert_eq!(joined, occupancy.cells_of(&other.joined(another)));
                }
            }
        }
    }

    /// Edges of a box are few of its cells: most of what is between them is told apart.
    #[test]
    fn what_is_far_from_all_is_told_apart() {
        let at = |x: f64, y: f64, z: f64| Box3::around(&[[x, y, z]]).grown(0.004);
        let corners: Vec<Box3> =
            (0..8).map(|i| at(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2))).collect();
        let occupancy = Occupancy::of(&corners, 8);
        assert!(corners.iter().all(|corner| occupancy.may_meet(corner)));
        assert!(!occupancy.may_meet(&at(0.5, 0.5, 0.5)) && !occupancy.may_meet(&at(0.5, 0.0, 0.0)));
        assert!(!occupancy.may_meet(&at(2.0, 0.0, 0.0)));
        let unsound = Box3 { low: [f64::NAN; 3], high: [1.0; 3] };
        assert!(
            !Occupancy::of(&[], 8).may_meet(&at(0.0, 0.0, 0.0)) && !Occupancy::of(&[unsound], 8).may_meet(&corners[0])
        );
    }
}
