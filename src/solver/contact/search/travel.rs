//! How far points have gone since the last search, group by group: what is apart need not be looked at until those that could come near have gone far enough.
//!
//! One account for all would wake everything for the fastest fragment anywhere. A slave node, its candidates and all that they hang on belong to a few
//! groups of points ([`PathGroups`]), and only these count for it.

use crate::solver::contact::geometry::paths::{GROUPS, PathGroups, PathRange, Paths};

/// What the points of the groups have gone, lengths: in each step as far as those whose paths differ most, seen from halfway between them. What all of
/// them go together brings none nearer to another.
#[derive(Debug, Clone)]
pub struct Travel {
    /// For each group the groups whose points count for it, a bit each.
    among: [u64; GROUPS],
    /// For each group, how far these have gone with the present step, and how far they go in it.
    travelled: [f64; GROUPS],
    half_ranges: [f64; GROUPS],
    /// How far all go in the present step.
    paths: Paths,
}

impl Default for Travel {
    fn default() -> Travel {
        Travel { among: [0; GROUPS], travelled: [0.0; GROUPS], half_ranges: [0.0; GROUPS], paths: Paths::default() }
    }
}

impl Travel {
    /// Lets these points, by their numbers in the layout, count for the group of the first of them; which that is.
    pub fn let_count(&mut self, groups: PathGroups, [first, others @ ..]: [u32; 5]) -> u8 {
        let group = groups.of(first);
        self.among[group] |= others.iter().fold(1 << group, |all, &other| all | 1 << groups.of(other));
        group as u8
    }

    /// Begins a step in which the points of each group go along paths within a range.
    pub fn step(&mut self, ranges: &[PathRange; GROUPS]) {
        self.paths = ranges.iter().fold(PathRange::default(), |all, range| all.joined(*range)).paths();
        for group in 0..GROUPS {
            let (mut among, mut range) = (self.among[group], PathRange::default());
            while among != 0 {
                range = range.joined(ranges[among.trailing_zeros() as usize]);
                among &= among - 1;
            }
            self.half_ranges[group] = range.paths().half_range;
            self.travelled[group] += self.half_ranges[group];
        }
    }

    /// How far what counts for a group has gone in all, a length.
    #[inline(always)]
    pub fn travelled(&self, group: u8) -> f64 {
        self.travelled[group as usize]
    }

    /// How far it goes in the present step.
    #[inline(always)]
    pub fn half_range(&self, group: u8) -> f64 {
        self.half_ranges[group as usize]
    }

    /// How far it will have gone if it goes as far again: what is due later may rest in this step. Not a number, or without end, where a path is.
    #[inline(always)]
    pub fn reached(&self, group: u8) -> f64 {
        self.travelled(group) + self.half_range(group)
    }

    /// How far all go in the present step.
    pub fn paths(&self) -> Paths {
        self.paths
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::contact::geometry::motion::four;

    /// Of three groups the first counts for the second as well; what the third goes wakes neither.
    #[test]
    fn a_group_hears_of_those_that_count_for_it_alone() {
        let groups = PathGroups::over(3 * GROUPS);
        let mut travel = Travel::default();
        let own = [[0; 5], [3, 0, 4, 5, 3], [6; 5]].map(|points| travel.let_count(groups, points));
        assert_eq!(own, [0, 1, 2]);
        let mut ranges = [PathRange::default(); GROUPS];
        for (range, path) in ranges.iter_mut().zip([2.0, -1.0, 100.0]) {
            range.take([[0.0; 4], four([path, 0.0, 0.0])], u64::MAX);
        }
        travel.step(&ranges);
        travel.step(&ranges);
        assert_eq!([0, 1, 2, 3].map(|group| travel.travelled(group)), [2.0, 3.0, 100.0, 0.0]);
        assert_eq!([0, 1, 2].map(|group| travel.reached(group)), [3.0, 4.5, 150.0]);
        assert_eq!([travel.paths().longest, travel.paths().half_range], [100.0, 50.5]);
    }
}
