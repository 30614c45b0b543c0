//! How far nodes go in a step: what tells how long things that are apart need not be looked at.

use super::motion::{Four, four, larger, smaller, three};

/// Twice √3, rounded up: two points that go as far along each axis as a path at most come nearer by this many such paths at most.
pub const TWICE_ROOT_THREE: f64 = 3.4642;

/// Between which paths along each axis all paths are, no path among them: lengths. Without branches, which nobody could foretell.
#[derive(Debug, Clone, Copy, Default)]
pub struct PathRange {
    low: Four,
    high: Four,
    /// Not a number where a path's length is not one or has no end, else zero.
    poison: Four,
}

impl PathRange {
    /// Takes the path that a node has gone in the last step and that which is ahead of it; `counts` is all bits or none.
    #[inline(always)]
    pub fn take(&mut self, [gone, ahead]: [Four; 2], counts: u64) {
        for i in 0..4 {
            let [gone, ahead] = [gone, ahead].map(|path| f64::from_bits(path[i].to_bits() & counts));
            self.poison[i] += 0.0 * ahead;
            self.low[i] = smaller(smaller(gone, ahead), self.low[i]);
            self.high[i] = larger(larger(gone, ahead), self.high[i]);
        }
    }

    /// Widens it by a length on all sides.
    pub fn widen(&mut self, room: f64) {
        self.low.iter_mut().for_each(|low| *low -= room);
        self.high.iter_mut().for_each(|high| *high += room);
    }

    /// Of the paths of both.
    pub fn joined(self, other: PathRange) -> PathRange {
        let of = |choose: fn(f64, f64) -> f64, own: Four, other: Four| [0, 1, 2, 3].map(|i| choose(other[i], own[i]));
        let poison = of(|a, b| a + b, self.poison, other.poison);
        PathRange { low: of(smaller, self.low, other.low), high: of(larger, self.high, other.high), poison }
    }

    /// The least and the greatest along each axis, lengths.
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        [three(self.low), three(self.high)]
    }

    /// As numbers of which the least of all ranks are those of all paths.
    pub fn to_array(self) -> [f64; 7] {
        let (low, high) = (self.low, self.high);
        let sound = self.poison[..3] == [0.0; 3];
        [low[0], low[1], low[2], -high[0], -high[1], -high[2], if sound { 0.0 } else { -1.0 }]
    }

    /// From these.
    pub fn from_array([a, b, c, d, e, f, sound]: [f64; 7]) -> PathRange {
        let poison = if sound < 0.0 { f64::NAN } else { 0.0 };
        PathRange { low: four([a, b, c]), high: four([-d, -e, -f]), poison: [poison; 4] }
    }

    /// How far they go at most.
    pub fn paths(&self) -> Paths {
        if self.poison[..3] == [0.0; 3] {
            Paths::between(self.bounds())
        } else {
            Paths { longest: f64::INFINITY, half_range: f64::INFINITY }
        }
    }
}

/// How far nodes go in a step, along an axis.
#[derive(Debug, Clone, Copy, Default)]
pub struct Paths {
    /// The longest path, a length.
    pub longest: f64,
    /// Half of the most by which two paths differ, one of which may be none: how far either of two nodes goes at most, seen from
    /// halfway between them. No less than half of the longest: boxes around two equal paths are that much nearer than the nodes.
    pub half_range: f64,
}

impl Paths {
    /// Of paths between these. A path that is not a number leaves nobody at rest.
    fn between([low, high]: [[f64; 3]; 2]) -> Paths {
        let all = low
            .iter()
            .zip(&high)
            .fold([0.0f64; 2], |[longest, range], (low, high)| [longest.max(-low).max(*high), range.max(high - low)]);
        Paths { longest: all[0], half_range: 0.5 * all[1] }
    }

    /// Of both.
    pub fn and(self, other: Paths) -> Paths {
        Paths { longest: self.longest.max(other.longest), half_range: self.half_range.max(other.half_range) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body that runs into another at rest nears it by its path; two that run into each other by the sum; what flies
    /// together counts as if something were at rest. What does not count is not there.
    #[test]
    fn half_of_the_range_is_how_far_either_goes() {
        let paths = |[one, other]: [[f64; 3]; 2]| {
            let mut range = PathRange::default();
            range.take([[0.0; 4], four(one)], u64::MAX);
            range.take([four(other), [0.0; 4]], u64::MAX);
            range.take([[100.0; 4], [f64::NAN; 4]], 0);
            let through = PathRange::from_array(range.to_array()).paths();
            assert_eq!([through.longest, through.half_range], [range.paths().longest, range.paths().half_range]);
            [through.longest, through.half_range]
        };
        assert_eq!(paths([[6.0, 0.0, 2.0], [0.0; 3]]), [6.0, 3.0]);
        assert_eq!(paths([[6.0, 0.0, 2.0], [-2.0, 0.0, 1.0]]), [6.0, 4.0]);
        assert_eq!(paths([[0.0, -6.0, 0.0], [0.0, -6.0, 0.0]]), [6.0, 3.0]);
        assert_eq!(paths([[0.0, f64::NAN, 0.0], [0.0; 3]]), [f64::INFINITY; 2]);
    }
}
