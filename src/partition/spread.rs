//! Along which axis points are spread most: a cut across it leaves the least between the halves.
//!
//! The variance says it, not the side of the box: a plate with a long thin rod in front of it is to be cut across, not between
//! its front and its back.

/// Steps that the longest side is divided into: the squares of places add up exactly for 2³² points.
const STEPS: f64 = 65535.0;

/// The box of some points, as a scale for their places.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    low: [f64; 3],
    sides: [f64; 3],
    longest: f64,
}

impl Frame {
    /// Of this box.
    pub fn new(low: [f64; 3], high: [f64; 3]) -> Frame {
        let sides = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        Frame { low, sides, longest: sides.into_iter().fold(0.0, f64::max) }
    }

    /// A coordinate in whole steps from the low side; 0 where there is no side or it has no end.
    fn steps(&self, x: f64, axis: usize) -> u64 {
        ((x - self.low[axis]) / self.longest * STEPS) as u64
    }
}

/// Sums of the steps of places along each axis, and then of their squares. Whole numbers: they do not depend on the order
/// of points, nor on how these are shared out.
#[derive(Debug, Clone, Copy, Default)]
pub struct Moments(pub [u64; 6]);

impl Moments {
    /// Takes a point in.
    pub fn add(&mut self, frame: &Frame, at: [f64; 3]) {
        for (axis, x) in at.into_iter().enumerate() {
            let steps = frame.steps(x, axis);
            self.0[axis] += steps;
            self.0[3 + axis] += steps * steps;
        }
    }

    /// The axis along which `count` points have the greatest variance; of equals the longest side of their box, then the
    /// first. The axis `before` stays while its variance is at least half of that.
    pub fn widest(&self, count: u64, frame: &Frame, before: Option<usize>) -> usize {
        let spread = |axis: usize| {
            let [first, second] = [self.0[axis], self.0[3 + axis]].map(u128::from);
            u128::from(count) * second - first * first
        };
        let better = |a: usize, b: usize| (spread(a), frame.sides[a]) > (spread(b), frame.sides[b]);
        let widest = (1..3).fold(0, |best, axis| if better(axis, best) { axis } else { best });
        before.filter(|&axis| spread(axis) >= spread(widest) / 2).unwrap_or(widest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plate_with_a_rod_is_cut_across_the_plate() {
        // A plate of 20 x 3 x 21 points and a rod of 30 behind each other in front of its middle.
        let plate = (0..20 * 3 * 21).map(|i| [i % 20, i / 20 % 3, i / 60].map(f64::from));
        let rod = (0..30).map(|i| [10.0, -f64::from(i), 10.0]);
        let frame = Frame::new([0.0, -29.0, 0.0], [19.0, 2.0, 20.0]);
        let mut moments = Moments::default();
        plate.chain(rod).for_each(|at| moments.add(&frame, at));
        let count = 20 * 3 * 21 + 30;
        // The other side of the plate is nearly as good, its thickness is not.
        let widest = [None, Some(0), Some(1)].map(|before| moments.widest(count, &frame, before));
        assert_eq!(widest, [2, 0, 2]);
    }

    #[test]
    fn without_end_or_side_the_box_decides() {
        let frame = Frame::new([f64::MIN, 0.0, 0.0], [f64::MAX, 1.0, 0.0]);
        let mut moments = Moments::default();
        moments.add(&frame, [f64::MIN, 0.0, 0.0]);
        moments.add(&frame, [f64::MAX, 1.0, 0.0]);
        assert_eq!(moments.widest(2, &frame, None), 0);
        assert_eq!(Moments::default().widest(0, &Frame::new([0.0; 3], [0.0; 3]), None), 0);
    }
}
