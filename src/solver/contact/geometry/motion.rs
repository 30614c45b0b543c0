//! The motion of the points of contact: where they are, where they would go without contact, and how heavy they are.
//!
//! Nodes are told by their numbers, which are those of a local problem or of the contact nodes of a rank; such a number is
//! called a point everywhere in contact, because nodes of the mesh have other numbers.
//!
//! Points that are nodes of this rank stay where the elements have them: [`NodeMotion`] borrows the nodes for the time of a step
//! and finds a velocity when it is asked for. Most points sleep, and so cost nothing here. Only what comes from other ranks, or
//! is not at a node at all, has a place of its own.

use super::paths::{PathRange, Paths};
use super::swept_box::SweptBox;
use crate::lanes::{Force, InstructionSet, Row};
use crate::solver::contact::enforcement::mobility::Mobility;
use crate::solver::nodes::Nodes;

/// Three coordinates, and a number without meaning that makes whole vectors of them.
pub type Four = [f64; 4];

/// Bit of a place that is none among the nodes of this rank.
const APART: u32 = 1 << 31;

/// Part of the longest path by which the path of a point of a rigid body may differ from its velocity times the step, along any
/// axis: half of the largest turn in a step, a tenth, of a velocity that is at most √3 of what it is along an axis.
const TURNED: f64 = 0.1;

/// Motion of a point that is no node of this rank.
#[derive(Debug, Clone, Copy, Default)]
struct PointMotion {
    /// Position at the present state.
    start: Four,
    /// Velocity over the coming step as it would be without contact.
    velocity: Four,
    /// Velocity over the step before, length per time.
    before: [f64; 3],
    /// Whether it counts among the paths: all bits or none.
    counts: u64,
}

/// Motion of points, by their numbers.
#[derive(Debug, Clone, Default)]
pub struct NodeMotion {
    /// Rows and forces of the nodes of this rank, lent for a step.
    rows: Vec<Row>,
    forces: Vec<Force>,
    /// For each point its node on this rank, or its place among those apart, with the bit [`APART`].
    places: Vec<u32>,
    apart: Vec<PointMotion>,
    /// 1/m along each axis, m the mass of the point; 0 where a constraint says how it moves.
    pub inverse_mass: Vec<[f64; 3]>,
    /// Points of rigid bodies, of which the inverse mass says nothing.
    pub mobility: Mobility,
    /// Near which the points are: boxes are as fine as single precision is there.
    origin: [f64; 3],
    /// Length of the step, a time: how long paths take.
    drift: f64,
    /// Time for which forces act until velocities are those of the step.
    kick: f64,
    range: PathRange,
    instructions: InstructionSet,
}

/// The smaller of two numbers; what is none has no say where it comes first.
#[inline(always)]
pub fn smaller(a: f64, b: f64) -> f64 {
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

/// The coordinates of a whole vector.
pub fn three([x, y, z, _]: Four) -> [f64; 3] {
    [x, y, z]
}

/// a + t b.
#[inline(always)]
pub fn along(a: Four, b: Four, t: f64) -> Four {
    std::array::from_fn(|i| a[i] + b[i] * t)
}

/// Position of a node at the present state.
#[inline(always)]
pub fn position_of(Row([x, y, z, m, ..]): &Row) -> Four {
    [*x, *y, *z, *m]
}

/// Velocity of a node over the coming step without contact, `kick` being the time for which forces act until then.
#[inline(always)]
pub fn velocity_of(row: &Row, force: &Force, kick: f64) -> Four {
    std::array::from_fn(|i| row.0[4 + i] + kick * (force.0[i] * row.0[7]))
}

impl NodeMotion {
    /// So many points apart from any nodes, all at zero. Their boxes are seen from `origin`, near which they should be.
    pub fn new(count: usize, origin: [f64; 3]) -> NodeMotion {
        NodeMotion {
            places: (0..count as u32).map(|place| APART | place).collect(),
            apart: vec![PointMotion::default(); count],
            ..NodeMotion::of_nodes(std::iter::repeat_n(0, count), origin)
        }
    }

    /// Points that are these nodes of this rank.
    pub fn of_nodes(nodes: impl Iterator<Item = u32>, origin: [f64; 3]) -> NodeMotion {
        let places: Vec<u32> = nodes.collect();
        NodeMotion {
            origin,
            inverse_mass: vec![[0.0; 3]; places.len()],
            places,
            instructions: InstructionSet::detect(),
            ..Default::default()
        }
    }

    /// Points that are nodes of this rank where `node` gives one, and else apart.
    pub fn of_some(nodes: impl Iterator<Item = Option<u32>>, origin: [f64; 3]) -> NodeMotion {
        let mut apart = 0;
        let place = |node: Option<u32>| {
            node.unwrap_or_else(|| {
                apart += 1;
                APART | (apart - 1)
            })
        };
        let motion = NodeMotion::of_nodes(nodes.map(place), origin);
        NodeMotion { apart: vec![PointMotion::default(); apart as usize], ..motion }
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
        self.places.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Begins a step of length `drift`, a time, for points whose velocities are known.
    pub fn begin(&mut self, drift: f64) {
        (self.drift, self.range) = (drift, PathRange::default());
    }

    /// Begins a step in which forces act for `kick` until velocities are those of the step; nodes of this rank go so far as `range` says.
    pub fn begin_step(&mut self, [drift, kick]: [f64; 2], range: PathRange) {
        (self.drift, self.kick, self.range) = (drift, kick, range);
    }

    /// Length of the step that was begun last, a time.
    pub fn drift(&self) -> f64 {
        self.drift
    }

    /// Borrows the nodes of this rank until [`NodeMotion::give_back`]: their forces are those without contact.
    pub fn borrow(&mut self, nodes: &mut Nodes) {
        (self.rows, self.forces) = (std::mem::take(&mut nodes.rows), std::mem::take(&mut nodes.forces));
    }

    /// Takes over nodes that another has borrowed, and the step that it has begun.
    pub fn borrow_from(&mut self, other: &mut NodeMotion) {
        (self.rows, self.forces) = (std::mem::take(&mut other.rows), std::mem::take(&mut other.forces));
        self.begin_step([other.drift, other.kick], other.range);
    }

    /// Gives the nodes back.
    pub fn give_back(&mut self, nodes: &mut Nodes) {
        (nodes.rows, nodes.forces) = (std::mem::take(&mut self.rows), std::mem::take(&mut self.forces));
    }

    /// Sets the position of a point that is apart, and its velocities over the coming step and over the step `before`.
    #[inline]
    pub fn set(&mut self, point: usize, start: [f64; 3], velocity: [f64; 3], before: [f64; 3]) {
        let Some(own) = self.apart.get_mut((self.places[point] & !APART) as usize) else { return };
        let (start, velocity) = (four(start), four(velocity));
        let gone = std::array::from_fn(|i| start[i] - own.start[i]);
        self.range.take([gone, velocity.map(|velocity| velocity * self.drift)], own.counts);
        *own = PointMotion { start, velocity, before, ..*own };
    }

    /// Chooses the points, of those apart, that count among the paths.
    pub fn count(&mut self, chosen: impl Iterator<Item = u32>) {
        self.apart.iter_mut().for_each(|own| own.counts = 0);
        for place in chosen.map(|point| self.places[point as usize]).filter(|place| place & APART != 0) {
            self.apart[(place & !APART) as usize].counts = u64::MAX;
        }
    }

    /// How far points that count have gone in the last step or will go in this one.
    pub fn paths(&self) -> Paths {
        self.room_to_turn(self.range.paths())
    }

    /// How far some points will go in this step.
    pub fn paths_ahead(&self, points: impl Iterator<Item = u32>) -> Paths {
        let mut range = PathRange::default();
        for point in points {
            let (start, end) = (self.start_four(point), self.end_four(point));
            range.take([Four::default(), std::array::from_fn(|i| end[i] - start[i])], u64::MAX);
        }
        self.room_to_turn(range.paths())
    }

    /// Velocities of rigid bodies are those at the present state, and not quite their paths over time.
    fn room_to_turn(&self, paths: Paths) -> Paths {
        let room = if self.mobility.bodies.is_empty() { 0.0 } else { TURNED * paths.longest };
        Paths { longest: paths.longest + room, half_range: paths.half_range + room }
    }

    /// The point's node here with its force, or what is known of it apart.
    #[inline(always)]
    fn source(&self, point: u32) -> Result<(&Row, &Force), &PointMotion> {
        let place = self.places[point as usize];
        match (self.rows.get(place as usize), self.forces.get(place as usize)) {
            (Some(row), Some(force)) => Ok((row, force)),
            _ => Err(&self.apart[(place & !APART) as usize]),
        }
    }

    /// Position at the present state, as a whole vector.
    #[inline(always)]
    pub fn start_four(&self, point: u32) -> Four {
        match self.source(point) {
            Ok((row, _)) => position_of(row),
            Err(own) => own.start,
        }
    }

    #[inline(always)]
    fn velocity_four(&self, point: u32) -> Four {
        match self.source(point) {
            Ok((row, force)) => velocity_of(row, force, self.kick),
            Err(own) => own.velocity,
        }
    }

    /// Position at the present state and at the end of the step without contact.
    #[inline(always)]
    pub fn both_four(&self, point: u32) -> [Four; 2] {
        let [start, velocity] = match self.source(point) {
            Ok((row, force)) => [position_of(row), velocity_of(row, force, self.kick)],
            Err(own) => [own.start, own.velocity],
        };
        [start, along(start, velocity, self.drift)]
    }

    /// Position at the present state.
    #[inline]
    pub fn start(&self, point: u32) -> [f64; 3] {
        three(self.start_four(point))
    }

    /// Position at the end of the step without contact.
    #[inline]
    pub fn end(&self, point: u32) -> [f64; 3] {
        three(self.end_four(point))
    }

    /// The same as a whole vector.
    #[inline(always)]
    pub fn end_four(&self, point: u32) -> Four {
        self.both_four(point)[1]
    }

    /// Velocity over the coming step as it would be without contact.
    #[inline]
    pub fn velocity(&self, point: u32) -> [f64; 3] {
        three(self.velocity_four(point))
    }

    /// Velocity over the step before.
    #[inline]
    pub fn velocity_before(&self, point: u32) -> [f64; 3] {
        match self.source(point) {
            Ok((Row([.., u, v, w, _]), _)) => [*u, *v, *w],
            Err(own) => own.before,
        }
    }

    /// Where a point is, and how far it goes in the step.
    pub fn path(&self, point: u32) -> ([f64; 3], [f64; 3]) {
        let [start, end] = self.both_four(point).map(three);
        (start, [end[0] - start[0], end[1] - start[1], end[2] - start[2]])
    }

    /// Box around the path of a point, seen from the origin.
    #[inline(always)]
    pub fn swept_box(&self, point: u32) -> SweptBox {
        let origin = four(self.origin);
        let [start, end] = self.both_four(point).map(|at| along(at, origin, -1.0));
        SweptBox::of_path(start, end)
    }

    /// Box around the paths of some points, seen from the origin and grown by a margin.
    #[inline(always)]
    pub fn joined_box<const N: usize>(&self, points: [u32; N], margin: f32) -> SweptBox {
        let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        for at in points.map(|point| self.both_four(point)).as_flattened() {
            for i in 0..4 {
                (low[i], high[i]) = (smaller(low[i], at[i]), larger(high[i], at[i]));
            }
        }
        let origin = four(self.origin);
        SweptBox::of_path(along(low, origin, -1.0), along(high, origin, -1.0)).grown(margin)
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
