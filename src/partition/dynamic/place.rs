//! The order of points along an axis.

use crate::comm::reduce::{key, number};

/// Where a point stands in the order along an axis: by coordinate, and by id where coordinates are equal. Points of
/// different ids have different places, so that cuts between places can share out any points evenly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place(u128);

/// An integer that sorts as the coordinate does. Both zeros are one, infinities are the largest finite numbers, and
/// what is not a number is the lowest of all: any input has a finite place.
pub(super) fn coordinate_key(x: f64) -> u64 {
    // The sum turns -0 into +0.
    if x.is_nan() { key(f64::MIN) } else { key(x.clamp(f64::MIN, f64::MAX) + 0.0) }
}

impl Place {
    /// Behind all points.
    pub const END: Place = Place::at(f64::INFINITY.to_bits() | 1 << 63, 0);

    pub const fn at(key: u64, id: u32) -> Place {
        Place((key as u128) << 32 | id as u128)
    }

    pub fn of(x: f64, id: u32) -> Place {
        Place::at(coordinate_key(x), id)
    }

    pub fn key(self) -> u64 {
        (self.0 >> 32) as u64
    }

    pub fn id(self) -> u32 {
        self.0 as u32
    }

    /// The coordinate; +∞ at the end.
    pub fn coordinate(self) -> f64 {
        number(self.key())
    }

    /// The first place behind this one.
    pub fn next(self) -> Place {
        Place(self.0 + 1)
    }

    /// The last place before this one, which is not the first.
    pub fn last_before(self) -> Place {
        Place(self.0 - 1)
    }

    /// How many places there are from `low` to before this one.
    pub fn since(self, low: Place) -> u128 {
        self.0 - low.0
    }

    /// The place so many places on.
    pub fn plus(self, places: u128) -> Place {
        Place(self.0 + places)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_sort_by_coordinate_and_then_by_id() {
        let sorted = [f64::NEG_INFINITY, -2.0, -1e-300, 0.0, 1e-300, 3.0, f64::INFINITY];
        for pair in sorted.windows(2) {
            assert!(Place::of(pair[0], u32::MAX) < Place::of(pair[1], 0));
            assert!(Place::of(pair[0], 1) < Place::of(pair[0], 2));
        }
        assert_eq!(Place::of(-0.0, 5), Place::of(0.0, 5));
        assert_eq!(Place::of(f64::NAN, 5), Place::of(f64::MIN, 5));
        assert!(Place::of(f64::INFINITY, u32::MAX).next() <= Place::END);
        assert_eq!(Place::END.coordinate(), f64::INFINITY);
        assert_eq!(Place::of(1.5, 7).coordinate(), 1.5);
        assert_eq!((Place::of(1.5, u32::MAX).next().id(), Place::of(1.5, 7).id()), (0, 7));
    }
}
