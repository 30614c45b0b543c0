//! Boxes around the paths of nodes over a step, in single precision and rounded outwards: quick to compare, and never too
//! small.

use super::motion::{Four, four};

/// Part by which a coordinate is moved outwards: more than what rounding to single precision and one sum can take away.
const OUTWARDS: f32 = 4e-7;

/// A box along the axes: its low corner, then its high corner with the sign changed, so that joining is a minimum and
/// growing a difference in all places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweptBox([f32; 8]);

/// A box with its two halves exchanged, for [`SweptBox::is_apart`].
#[derive(Debug, Clone, Copy)]
pub struct Exchanged([f32; 8]);

/// The smaller of two numbers. NaN as the second is ignored: half the instructions of `f32::min`.
#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

impl SweptBox {
    /// The box that every other touches.
    pub const EVERYTHING: SweptBox = SweptBox([f32::NEG_INFINITY; 8]);

    /// The box that holds nothing.
    pub const NOTHING: SweptBox = SweptBox([f32::INFINITY; 8]);

    /// A box around the path from one place to another.
    #[inline]
    pub fn around(start: [f64; 3], end: [f64; 3]) -> SweptBox {
        SweptBox::of_path(four(start), four(end))
    }

    /// The same in whole vectors.
    #[inline(always)]
    pub fn of_path(start: Four, end: Four) -> SweptBox {
        let single = |x: Four| [x[0] as f32, x[1] as f32, x[2] as f32, x[2] as f32];
        let (start, end) = (single(start), single(end));
        let outwards = |x: f32| x - x.abs() * OUTWARDS - f32::MIN_POSITIVE;
        let mut bounds = [0.0; 8];
        let (low, high) = bounds.split_at_mut(4);
        for i in 0..4 {
            low[i] = outwards(smaller(start[i], end[i]));
            high[i] = outwards(smaller(-start[i], -end[i]));
        }
        SweptBox(bounds)
    }

    /// The box around four others, grown by a margin.
    #[inline(always)]
    pub fn joined([a, b, c, d]: [&SweptBox; 4], margin: f32) -> SweptBox {
        let margin = margin * (1.0 + OUTWARDS);
        SweptBox(std::array::from_fn(|i| smaller(smaller(a.0[i], b.0[i]), smaller(c.0[i], d.0[i])) - margin))
    }

    /// Its low and its high corner.
    pub fn corners(&self) -> [[f64; 3]; 2] {
        let b = self.0.map(f64::from);
        [[b[0], b[1], b[2]], [-b[4], -b[5], -b[6]]]
    }

    /// Itself, to be asked whether many others are apart from it.
    #[inline(always)]
    pub fn exchanged(&self) -> Exchanged {
        Exchanged(std::array::from_fn(|i| self.0[(i + 4) % 8]))
    }

    /// Whether the [`SweptBox::distance`] to another box is above zero.
    #[inline(always)]
    pub fn is_apart(&self, other: &Exchanged) -> bool {
        let mut apart = false;
        for i in 0..8 {
            apart |= self.0[i] + other.0[i] > 0.0;
        }
        apart
    }

    /// How far two boxes are apart along the axis where they are farthest; not above zero where they have a point in
    /// common. Boxes around what is not a number in single precision, coordinates beyond 1e38 among them, may be apart
    /// from nothing.
    #[inline(always)]
    pub fn distance(&self, other: &SweptBox) -> f32 {
        // Without short cuts, so that it is a few instructions on vectors.
        let apart: [f32; 8] = std::array::from_fn(|i| self.0[i] + other.0[(i + 4) % 8]);
        let larger = |a: f32, b: f32| if b > a { b } else { a };
        let four: [f32; 4] = std::array::from_fn(|i| larger(larger(f32::NEG_INFINITY, apart[i]), apart[i + 4]));
        larger(larger(four[0], four[1]), larger(four[2], four[3]))
    }
}

/// Whether boxes leave others, all of which have been carried along; what is not a number leaves nothing.
pub struct Outside {
    farthest: [f32; 8],
    /// What takes sides there.
    carried: [f32; 8],
}

impl Outside {
    /// Others that have been carried so far. What rounding of the way takes away is more than made up for here, and what rounding of a
    /// side takes away by what boxes have been moved outwards.
    pub fn of_boxes_carried(way: [f64; 3]) -> Outside {
        let [x, y, z] = way.map(|x| x as f32);
        let inwards = |x: f32| x + x.abs() * OUTWARDS;
        Outside { farthest: [0.0; 8], carried: [x, y, z, z, -x, -y, -z, -z].map(inwards) }
    }

    /// Looks at a box and at the search box in which it is to be.
    #[inline(always)]
    pub fn take(&mut self, own: &SweptBox, search_box: &SweptBox) {
        for i in 0..8 {
            // What is not a number is not larger than anything, and so never chosen.
            let beyond = (search_box.0[i] + self.carried[i]) - own.0[i];
            self.farthest[i] = if beyond > self.farthest[i] { beyond } else { self.farthest[i] };
        }
    }

    /// Whether any did.
    pub fn any(&self) -> bool {
        self.farthest.iter().any(|&beyond| beyond > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    impl SweptBox {
        fn meets(&self, other: &SweptBox) -> bool {
            self.distance(other) <= 0.0
        }
    }

    proptest! {
        #[test]
        fn what_touches_is_never_missed(
            a in prop::array::uniform3(-1e3..1e3), b in prop::array::uniform3(-1e3..1e3), margin in 0.0f32..10.0,
        ) {
            let place = SweptBox::around(a, a);
            prop_assert!(place.meets(&SweptBox::around(a, b)) && SweptBox::around(b, a).meets(&place));
            // A face with one corner exactly the margin away.
            let away = SweptBox::around([a[0] + f64::from(margin), a[1], a[2]], [a[0] + f64::from(margin), a[1], a[2]]);
            prop_assert!(SweptBox::joined([&away; 4], margin).meets(&place));
        }

        #[test]
        fn what_is_apart_does_not_meet(a in prop::array::uniform3(-1.0..1.0), axis in 0usize..3, gap in 1e-5..10.0) {
            let mut b = a;
            b[axis] += gap;
            let distance = f64::from(SweptBox::around(a, a).distance(&SweptBox::around(b, b)));
            prop_assert!(distance > 0.0 && distance <= gap && distance > gap - 2e-5);
        }

        #[test]
        fn what_is_apart_has_a_distance(
            a in prop::array::uniform3(-1.0..1.0), b in prop::array::uniform3(-1.0..1.0),
            c in prop::array::uniform3(-1.0..1.0), axis in 0usize..4,
        ) {
            let mut end = c;
            // An axis along which there is no number.
            if axis < 3 {
                end[axis] = f64::NAN;
            }
            let (one, other) = (SweptBox::around(a, b), SweptBox::around(c, end));
            prop_assert_eq!(one.is_apart(&other.exchanged()), one.distance(&other) > 0.0);
        }
    }

    proptest! {
        /// A box that has gone as far as those that it is to be in has not left, and one that is half a part in a million farther has:
        /// rounding of the way never lets a box out unseen.
        #[test]
        fn boxes_that_are_carried_along_hold_what_goes_with_them(
            low in prop::array::uniform3(-1.0..1.0), way in prop::array::uniform3(-1e3..1e3),
            axis in 0usize..3, side in prop_oneof![Just(-1.0), Just(1.0)],
        ) {
            let high = low.map(|x| x + 0.5);
            let search_box = SweptBox::around(low, high);
            let leaves = |place: [f64; 3]| {
                let mut outside = Outside::of_boxes_carried(way);
                outside.take(&SweptBox::around(place, place), &search_box);
                outside.any()
            };
            let gone = |from: [f64; 3], by: f64| [0, 1, 2].map(|i| from[i] + way[i] + if i == axis { by } else { 0.0 });
            let middle = low.map(|x| x + 0.25);
            prop_assert!(!leaves(gone(middle, 0.0)) && !leaves(gone(middle, 0.24 * side)));
            let (edge, far) = (if side > 0.0 { high } else { low }, 5e-7 * (1.0 + way[axis].abs() + 1.5));
            prop_assert!(leaves(gone(edge, far * side)));
            prop_assert!(leaves(gone(middle, 0.26 * side + far * side)));
        }
    }

    #[test]
    fn what_is_not_a_number_meets_everything() {
        let nowhere = SweptBox::around([f64::NAN; 3], [f64::NAN; 3]);
        assert!(nowhere.meets(&SweptBox::around([0.0; 3], [1.0; 3])) && nowhere.meets(&nowhere));
        assert!(SweptBox::around([1e300; 3], [0.0; 3]).meets(&SweptBox::around([1e40; 3], [1e50; 3])));
        assert!(SweptBox::around([1.0; 3], [1.0; 3]).meets(&SweptBox::EVERYTHING));
    }
}
