//! How far nodes go in a step: what tells how long things that are apart need not be looked at.

use super::motion::{Four, larger, smaller, three};

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

    /// How far they go at most.
    pub fn paths(&self) -> Paths {
        if self.poison[..3] == [0.0; 3] {
            Paths::between([three(self.low), three(self.high)])
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
