//! The motion of the contact nodes: where they are, where they would go without contact, and how heavy they are.
//!
//! Nodes are told by their numbers, which are those of a local problem or of the contact nodes of a rank; such a number is
//! called a point everywhere in contact, because nodes of the mesh have other numbers.

use super::swept_box::{Outside, SweptBox};
use crate::lanes::{InstructionSet, Vectors};
use crate::solver::contact::enforcement::mobility::Mobility;

/// Three coordinates, and a number without meaning that makes whole vectors of them.
pub type Four = [f64; 4];

/// Where a point is and how fast it goes, in one line of the cache: faces ask for both, of four corners at a time.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
struct PointMotion {
    /// Position at the present state.
    start: Four,
    /// Velocity over the coming step as it would be without contact.
    velocity: Four,
}

impl PointMotion {
    /// Position at the end of a step of length `drift`.
    #[inline(always)]
    fn end(&self, drift: f64) -> Four {
        std::array::from_fn(|i| self.start[i] + self.velocity[i] * drift)
    }

    /// Box around the path to that end, seen from an origin.
    #[inline(always)]
    fn box_to(&self, end: Four, origin: Four) -> SweptBox {
        let seen = |at: Four| std::array::from_fn(|i| at[i] - origin[i]);
        SweptBox::of_path(seen(self.start), seen(end))
    }
}

/// Motion of contact nodes, in the order of the mesh's nodes.
#[derive(Debug, Clone, Default)]
pub struct NodeMotion {
    motion: Vec<PointMotion>,
    /// Box around the path over that step, seen from the origin.
    pub swept_boxes: Vec<SweptBox>,
    /// Velocity over the step before, length per time.
    before: Vec<[f64; 3]>,
    /// 1/m along each axis, m the mass of the node; 0 where a constraint says how the node moves.
    pub inverse_mass: Vec<[f64; 3]>,
    /// Points of rigid bodies, of which the inverse mass says nothing.
    pub mobility: Mobility,
    /// Near which the points are: boxes are as fine as single precision is there.
    origin: [f64; 3],
    /// Length of the step, a time: how long paths take.
    drift: f64,
    /// Whether a node counts among the paths: all bits or none.
    counts: Vec<u64>,
    range: PathRange,
    instructions: InstructionSet,
}

/// Between which paths along each axis all paths are, no path among them: lengths. Without branches, which nobody could foretell.
#[derive(Debug, Clone, Copy, Default)]
struct PathRange {
    low: Four,
    high: Four,
    /// Not a number where a path's length is not one or has no end, else zero.
    poison: Four,
}

impl PathRange {
    #[inline(always)]
    fn take(&mut self, [before, start, end]: [Four; 3], counts: u64) {
        for i in 0..4 {
            let gone = f64::from_bits((start[i] - before[i]).to_bits() & counts);
            let ahead = f64::from_bits((end[i] - start[i]).to_bits() & counts);
            self.poison[i] += 0.0 * ahead;
            self.low[i] = smaller(smaller(gone, ahead), self.low[i]);
            self.high[i] = larger(larger(gone, ahead), self.high[i]);
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

    /// Of some nodes, in the coming step.
    pub fn ahead(points: impl Iterator<Item = u32>, motion: &NodeMotion) -> Paths {
        let mut range = PathRange::default();
        for point in points {
            let start = motion.motion[point as usize].start;
            range.take([start, start, motion.end_four(point)], u64::MAX);
        }
        range.paths()
    }

    /// Of both.
    pub fn and(self, other: Paths) -> Paths {
        Paths { longest: self.longest.max(other.longest), half_range: self.half_range.max(other.half_range) }
    }
}

impl PathRange {
    fn paths(&self) -> Paths {
        if self.poison[..3] == [0.0; 3] {
            Paths::between([three(self.low), three(self.high)])
        } else {
            Paths { longest: f64::INFINITY, half_range: f64::INFINITY }
        }
    }
}

/// The smaller of two numbers; what is none has no say where it comes first.
#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers; what is none has no say where it comes first.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Makes whole vectors of three coordinates.
pub fn four([x, y, z]: [f64; 3]) -> Four {
    [x, y, z, 0.0]
}

fn three([x, y, z, _]: Four) -> [f64; 3] {
    [x, y, z]
}

impl NodeMotion {
    /// So many nodes, all at zero. Their boxes are seen from `origin`, near which they should be.
    pub fn new(count: usize, origin: [f64; 3]) -> NodeMotion {
        NodeMotion {
            origin,
            motion: vec![PointMotion::default(); count],
            swept_boxes: vec![SweptBox::EVERYTHING; count],
            before: vec![[0.0; 3]; count],
            inverse_mass: vec![[0.0; 3]; count],
            counts: vec![0; count],
            instructions: InstructionSet::detect(),
            ..Default::default()
        }
    }

    /// Near which they are; see [`NodeMotion::new`].
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// For which vector instructions what asks for motion may be compiled.
    pub(crate) fn instructions(&self) -> InstructionSet {
        self.instructions
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.motion.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.motion.is_empty()
    }

    /// Begins a step of length `drift`, a time; then the motion of every node is to be set.
    pub fn begin(&mut self, drift: f64) {
        (self.drift, self.range) = (drift, PathRange::default());
    }

    /// Sets a node's position and its velocities over the coming step and over the step `before`, and finds its path.
    #[inline]
    pub fn set(&mut self, point: usize, start: [f64; 3], velocity: [f64; 3], before: [f64; 3]) {
        self.before[point] = before;
        let motion = PointMotion { start: four(start), velocity: four(velocity) };
        let end = motion.end(self.drift);
        self.range.take([self.motion[point].start, motion.start, end], self.counts[point]);
        (self.motion[point], self.swept_boxes[point]) = (motion, motion.box_to(end, four(self.origin)));
    }

    /// Gives a node the motion of another in the same step, but for the velocity before it.
    #[inline]
    pub fn copy(&mut self, point: usize, others: &NodeMotion, other: usize) {
        let motion = others.motion[other];
        self.range.take([self.motion[point].start, motion.start, motion.end(self.drift)], self.counts[point]);
        (self.motion[point], self.swept_boxes[point]) = (motion, others.swept_boxes[other]);
    }

    /// Sets the motion of all nodes: position, velocity over the coming step; that over the step before is for
    /// [`NodeMotion::set_velocity_before`], where it is asked for. Whether one of them leaves its search box on its path.
    pub fn set_all(&mut self, motions: impl Iterator<Item = (Four, Four)>, search_boxes: &[SweptBox]) -> bool {
        match self.instructions.vectors() {
            // SAFETY: an instruction set is one that this processor has, and AVX-512 includes AVX2.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 | Vectors::Avx512 => unsafe { self.set_all_avx2(motions, search_boxes) },
            _ => self.set_each(motions, search_boxes),
        }
    }

    /// The same with four numbers to a register. `unsafe` for a twelfth of contact on a crushed can (docs/performance.md).
    ///
    /// # Safety
    ///
    /// The processor must have AVX2.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn set_all_avx2(&mut self, motions: impl Iterator<Item = (Four, Four)>, search_boxes: &[SweptBox]) -> bool {
        self.set_each(motions, search_boxes)
    }

    // Inlined, so that it is compiled for the instructions of its caller.
    #[inline(always)]
    fn set_each(&mut self, motions: impl Iterator<Item = (Four, Four)>, search_boxes: &[SweptBox]) -> bool {
        let (drift, origin) = (self.drift, four(self.origin));
        let (mut range, mut outside) = (self.range, Outside::default());
        let places = self.motion.iter_mut().zip(&mut self.swept_boxes).zip(&self.counts).zip(search_boxes);
        for ((((before, swept), &counts), search_box), (start, velocity)) in places.zip(motions) {
            let motion = PointMotion { start, velocity };
            let end = motion.end(drift);
            range.take([before.start, start, end], counts);
            *swept = motion.box_to(end, origin);
            outside.take(swept, search_box);
            *before = motion;
        }
        self.range = range;
        outside.any()
    }

    /// Chooses the nodes that count among the paths.
    pub fn count(&mut self, chosen: impl Iterator<Item = u32>) {
        self.counts.fill(0);
        chosen.for_each(|point| self.counts[point as usize] = u64::MAX);
    }

    /// How far nodes that count have gone in the last step or will go in this one.
    pub fn paths(&self) -> Paths {
        self.range.paths()
    }

    /// Position at the present state.
    #[inline]
    pub fn start(&self, point: u32) -> [f64; 3] {
        three(self.motion[point as usize].start)
    }

    /// Position at the end of the step without contact.
    #[inline]
    pub fn end(&self, point: u32) -> [f64; 3] {
        three(self.end_four(point))
    }

    /// The same as a whole vector.
    #[inline(always)]
    pub fn end_four(&self, point: u32) -> Four {
        self.motion[point as usize].end(self.drift)
    }

    /// Velocity over the coming step as it would be without contact.
    #[inline]
    pub fn velocity(&self, point: u32) -> [f64; 3] {
        three(self.motion[point as usize].velocity)
    }

    /// Sets the velocity of a node over the step before.
    pub fn set_velocity_before(&mut self, point: u32, velocity: [f64; 3]) {
        self.before[point as usize] = velocity;
    }

    /// Velocity over the step before.
    #[inline]
    pub fn velocity_before(&self, point: u32) -> [f64; 3] {
        self.before[point as usize]
    }

    /// Where a node is, and how far it goes in the step.
    pub fn path(&self, point: u32) -> ([f64; 3], [f64; 3]) {
        let (start, end) = (self.start(point), self.end(point));
        (start, [end[0] - start[0], end[1] - start[1], end[2] - start[2]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paths(velocities: &[[f64; 3]]) -> Paths {
        let mut motion = NodeMotion::new(velocities.len(), [0.0; 3]);
        motion.count(0..velocities.len() as u32);
        motion.begin(2.0);
        (velocities.iter().enumerate()).for_each(|(point, velocity)| motion.set(point, [0.0; 3], *velocity, [0.0; 3]));
        motion.paths()
    }

    /// A body that runs into another at rest nears it by its path; two that run into each other by the sum; what flies
    /// together counts as if something were at rest.
    #[test]
    fn half_of_the_range_is_how_far_either_goes() {
        for (velocities, longest, half_range) in [
            ([[3.0, 0.0, 1.0], [0.0; 3]], 6.0, 3.0),
            ([[3.0, 0.0, 1.0], [-1.0, 0.0, 0.5]], 6.0, 4.0),
            ([[0.0, -3.0, 0.0], [0.0, -3.0, 0.0]], 6.0, 3.0),
        ] {
            let found = paths(&velocities);
            assert_eq!([found.longest, found.half_range], [longest, half_range]);
        }
        let nowhere = paths(&[[0.0, f64::NAN, 0.0], [0.0; 3]]);
        assert_eq!([nowhere.longest, nowhere.half_range], [f64::INFINITY; 2]);
    }
}
