//! Which of the pairs of edges that a search has found are looked at in a step.
//!
//! Most of them are far apart for most steps. Each waits until things have gone half of the way between its edges, counted as
//! if the fastest end of any edge were always one of them.

use super::edges::Edge;
use super::points::Points;

/// Part of the way between two edges that either may go before they are looked at again: half, less what rounding takes.
const SAFE: f64 = 0.499;

/// Pairs of edges and how long each can wait.
#[derive(Default)]
pub struct Pairs {
    /// The pairs, ascending.
    pub list: Vec<[u32; 2]>,
    /// How far things must have gone in all until a pair may be near.
    due: Vec<f64>,
    /// Ends of the edges, and where they were in the last step.
    moving: Vec<(u32, Option<[f64; 3]>)>,
    /// The way that things have gone at most since the search, to the beginning of this step, and that through it.
    gone: f64,
    last_way: f64,
}

impl Pairs {
    /// Takes over what a search has found.
    pub fn new(list: Vec<[u32; 2]>, edges: &[Edge]) -> Pairs {
        let mut ends: Vec<u32> = list.iter().flatten().flat_map(|&edge| edges[edge as usize].ends).collect();
        ends.sort_unstable();
        ends.dedup();
        Pairs {
            due: vec![0.0; list.len()],
            moving: ends.into_iter().map(|end| (end, None)).collect(),
            list,
            ..Default::default()
        }
    }

    /// Begins a step.
    pub fn step(&mut self, points: &Points) {
        let mut farthest: f64 = 0.0;
        let mut sound = true;
        for (point, before) in &mut self.moving {
            let (start, end) = (points.start[*point as usize], points.end(*point));
            let before = before.replace(start).unwrap_or(start);
            for i in 0..3 {
                let way = (start[i] - before[i]).abs().max((end[i] - start[i]).abs());
                sound &= (end[i] - before[i]).is_finite();
                farthest = if way > farthest { way } else { farthest };
            }
        }
        // A way that is not a number lets nobody wait.
        self.last_way = if sound { farthest } else { f64::INFINITY };
        self.gone += self.last_way;
    }

    /// Whether a pair, by its place, may be near in this step.
    pub fn is_due(&self, place: usize) -> bool {
        self.gone + self.last_way >= self.due[place]
    }

    /// Lets a pair wait whose edges are so far apart along an axis in this step, beyond where they would be near.
    pub fn wait(&mut self, place: usize, distance: f64) {
        self.due[place] = self.gone + SAFE * distance;
    }
}
