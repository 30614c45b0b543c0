//! The points of contact: nodes on the outside, where they are, where they would go, and how heavy they are.

use super::bounds::Bounds;
use crate::solver::nodes::{add, scaled};

/// Contact points, structure of arrays, in the order of the mesh's nodes.
#[derive(Debug, Clone, Default)]
pub struct Points {
    /// Position at the present state.
    pub start: Vec<[f64; 3]>,
    /// Velocity over the coming step as it would be without contact.
    pub velocity: Vec<[f64; 3]>,
    /// Box around the way over that step.
    pub ways: Vec<Bounds>,
    /// 1/m along each axis; 0 where a constraint says how the node moves.
    pub inverse_mass: Vec<[f64; 3]>,
    /// Length of the step, for ways.
    drift: f64,
    /// Whether a point counts in the longest way: all bits or none.
    counts: Vec<u64>,
    longest: Longest,
}

/// The longest way along each axis. Without branches, which nobody could foretell.
#[derive(Debug, Clone, Copy, Default)]
struct Longest {
    ways: [f64; 3],
    /// Not a number where a way is not one or has no end, else zero.
    poison: [f64; 3],
}

impl Longest {
    #[inline(always)]
    fn take(&mut self, [before, start, end]: [&[f64; 3]; 3], counts: u64) {
        for i in 0..3 {
            let way = larger((start[i] - before[i]).abs(), (end[i] - start[i]).abs());
            let way = f64::from_bits(way.to_bits() & counts);
            self.poison[i] += 0.0 * way;
            self.ways[i] = larger(way, self.ways[i]);
        }
    }
}

/// The larger of two numbers; what is none has no say where it comes first.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

impl Points {
    /// So many points at the origin.
    pub fn new(count: usize) -> Points {
        let zero = vec![[0.0; 3]; count];
        Points {
            start: zero.clone(),
            velocity: zero.clone(),
            ways: vec![Bounds::EVERYTHING; count],
            inverse_mass: zero,
            counts: vec![0; count],
            ..Default::default()
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.start.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.start.is_empty()
    }

    /// Begins a step of length `drift`, for which every point is to be put where it is.
    pub fn begin(&mut self, drift: f64) {
        (self.drift, self.longest) = (drift, Longest::default());
    }

    /// Puts a point where it is and lets it go its way.
    #[inline]
    pub fn set(&mut self, point: usize, start: [f64; 3], velocity: [f64; 3]) {
        let end = add(start, scaled(velocity, self.drift));
        self.longest.take([&self.start[point], &start, &end], self.counts[point]);
        (self.start[point], self.velocity[point]) = (start, velocity);
        self.ways[point] = Bounds::around(start, end);
    }

    /// Puts all points where they are, each with its velocity, and lets them go their ways. The largest of the third
    /// numbers.
    pub fn set_all(&mut self, motions: impl Iterator<Item = ([f64; 3], [f64; 3], f64)>) -> f64 {
        let (drift, mut longest, mut largest) = (self.drift, self.longest, f64::NEG_INFINITY);
        let places = self.start.iter_mut().zip(&mut self.velocity).zip(&mut self.ways).zip(&self.counts);
        for ((((place, way_velocity), way), &counts), (start, velocity, number)) in places.zip(motions) {
            let end = add(start, scaled(velocity, drift));
            longest.take([place, &start, &end], counts);
            largest = larger(number, largest);
            (*place, *way_velocity, *way) = (start, velocity, Bounds::around(start, end));
        }
        self.longest = longest;
        largest
    }

    /// Chooses the points that count in the longest way.
    pub fn count(&mut self, chosen: impl Iterator<Item = u32>) {
        self.counts.fill(0);
        chosen.for_each(|point| self.counts[point as usize] = u64::MAX);
    }

    /// The farthest that a point which counts has gone in the last step or will go in this one, along an axis.
    pub fn longest_way(&self) -> f64 {
        let Longest { ways: [x, y, z], poison } = self.longest;
        // A way that is not a number leaves nobody at rest.
        if poison == [0.0; 3] { x.max(y).max(z) } else { f64::INFINITY }
    }

    /// Position at the end of the step without contact.
    #[inline]
    pub fn end(&self, point: u32) -> [f64; 3] {
        add(self.start[point as usize], scaled(self.velocity[point as usize], self.drift))
    }

    /// How far a point goes.
    pub fn path(&self, point: u32) -> ([f64; 3], [f64; 3]) {
        let (start, end) = (self.start[point as usize], self.end(point));
        (start, [end[0] - start[0], end[1] - start[1], end[2] - start[2]])
    }
}
