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
    /// Whether a node counts in the longest path: all bits or none.
    counts: Vec<u64>,
    longest: Longest,
    instructions: InstructionSet,
}

/// The longest path along each axis, a length. Without branches, which nobody could foretell.
#[derive(Debug, Clone, Copy, Default)]
struct Longest {
    lengths: Four,
    /// Not a number where a path's length is not one or has no end, else zero.
    poison: Four,
}

impl Longest {
    #[inline(always)]
    fn take(&mut self, [before, start, end]: [Four; 3], counts: u64) {
        for i in 0..4 {
            let length = larger((start[i] - before[i]).abs(), (end[i] - start[i]).abs());
            let length = f64::from_bits(length.to_bits() & counts);
            self.poison[i] += 0.0 * length;
            self.lengths[i] = larger(length, self.lengths[i]);
        }
    }
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
        (self.drift, self.longest) = (drift, Longest::default());
    }

    /// Sets a node's position and its velocities over the coming step and over the step `before`, and finds its path.
    #[inline]
    pub fn set(&mut self, point: usize, start: [f64; 3], velocity: [f64; 3], before: [f64; 3]) {
        self.before[point] = before;
        let motion = PointMotion { start: four(start), velocity: four(velocity) };
        let end = motion.end(self.drift);
        self.longest.take([self.motion[point].start, motion.start, end], self.counts[point]);
        (self.motion[point], self.swept_boxes[point]) = (motion, motion.box_to(end, four(self.origin)));
    }

    /// Gives a node the motion of another in the same step, but for the velocity before it.
    #[inline]
    pub fn copy(&mut self, point: usize, others: &NodeMotion, other: usize) {
        let motion = others.motion[other];
        self.longest.take([self.motion[point].start, motion.start, motion.end(self.drift)], self.counts[point]);
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
        let (mut longest, mut outside) = (self.longest, Outside::default());
        let places = self.motion.iter_mut().zip(&mut self.swept_boxes).zip(&self.counts).zip(search_boxes);
        for ((((before, swept), &counts), search_box), (start, velocity)) in places.zip(motions) {
            let motion = PointMotion { start, velocity };
            let end = motion.end(drift);
            longest.take([before.start, start, end], counts);
            *swept = motion.box_to(end, origin);
            outside.take(swept, search_box);
            *before = motion;
        }
        self.longest = longest;
        outside.any()
    }

    /// Chooses the nodes that count in the longest path.
    pub fn count(&mut self, chosen: impl Iterator<Item = u32>) {
        self.counts.fill(0);
        chosen.for_each(|point| self.counts[point as usize] = u64::MAX);
    }

    /// The farthest that a node which counts has gone in the last step or will go in this one, along an axis: a length.
    pub fn longest_path(&self) -> f64 {
        let Longest { lengths: [x, y, z, _], poison } = self.longest;
        // A path that is not a number leaves nobody at rest.
        if poison[..3] == [0.0; 3] { x.max(y).max(z) } else { f64::INFINITY }
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
