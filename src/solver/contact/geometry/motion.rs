//! The motion of the points of contact: where they are, where they would go without contact, and how heavy they are.
//!
//! Nodes are told by their numbers, which are those of a local problem or of the contact nodes of a rank; such a number is
//! called a point everywhere in contact, because nodes of the mesh have other numbers.
//!
//! Points that are nodes of this rank stay where the elements have them: [`NodeMotion`] borrows the nodes for the time of a step.
//! Most of them sleep, and so cost nothing here. What is awake is asked for many times: its motion is found once in the step
//! ([`NodeMotion::place`]) and kept; where that has not been done, it is found when it is asked for.

use super::paths::{PathRange, Paths};
use super::swept_box::{Outside, SweptBox};
use crate::lanes::{Force, InstructionSet, Row, prefetch_later, prefetch_named};
use crate::solver::contact::enforcement::mobility::Mobility;
use crate::solver::nodes::Nodes;

/// Three coordinates, and a number without meaning that makes whole vectors of them.
pub type Four = [f64; 4];

/// Bit of a place that is none among the nodes of this rank.
const APART: u32 = 1 << 31;

/// Points ahead whose lines are asked of the memory: their nodes are scattered among all, which no hardware foresees. With
/// 8 and 64 a large can cost 87 and 70 ns a contact node and step.
const SOON: usize = 64;

/// Where a point is and how fast it goes, in one line of the cache: faces ask for both, of four corners at a time.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
struct PointMotion {
    /// Position at the present state; the last number is the mark of the step for which this holds.
    start: Four,
    /// Velocity over the coming step as it would be without contact.
    velocity: Four,
}

impl PointMotion {
    /// Of a node of this rank.
    #[inline(always)]
    fn of_node(Row([x, y, z, _, velocity @ ..]): &Row, Force(force): &Force, kick: f64, mark: f64) -> PointMotion {
        let velocity = std::array::from_fn(|i| velocity[i] + kick * (force[i] * velocity[3]));
        PointMotion { start: [*x, *y, *z, mark], velocity }
    }

    /// Position at the end of a step of length `drift`.
    #[inline(always)]
    fn end(&self, drift: f64) -> Four {
        std::array::from_fn(|i| self.start[i] + self.velocity[i] * drift)
    }

    /// Box around the path to that end, seen from an origin.
    #[inline(always)]
    fn box_to(&self, drift: f64, origin: Four) -> SweptBox {
        let end = self.end(drift);
        SweptBox::of_path(seen_from(origin, self.start), seen_from(origin, end))
    }
}

/// What a message says of a point: its position at the present state, and its velocities over the coming step as it would be without
/// contact and over the step before.
pub type MotionMessage = [f64; 9];

/// Motion of points, by their numbers.
#[derive(Debug, Clone, Default)]
pub struct NodeMotion {
    /// Rows and forces of the nodes of this rank, lent for a step.
    rows: Vec<Row>,
    forces: Vec<Force>,
    /// For each point its node on this rank, or its place among those apart, with the bit [`APART`].
    places: Vec<u32>,
    /// What was said of those apart.
    apart: Vec<MotionMessage>,
    /// Motions that have been found in the step, and boxes around their paths, seen from the origin.
    motions: Vec<PointMotion>,
    swept_boxes: Vec<SweptBox>,
    /// Mark of the step, which grows from step to step, and how many motions have been found one by one in it.
    mark: f64,
    found: usize,
    /// Whether all have been found together.
    all_found: bool,
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

/// The smaller of two numbers. NaN as the first is ignored.
#[inline(always)]
pub fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers. NaN as the first is ignored.
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

/// The difference of two whole vectors.
#[inline(always)]
fn seen_from(origin: Four, at: Four) -> Four {
    std::array::from_fn(|i| at[i] - origin[i])
}

impl NodeMotion {
    /// So many points apart from any nodes, all at zero. Their boxes are seen from `origin`, near which they should be.
    pub fn new(count: usize, origin: [f64; 3]) -> NodeMotion {
        NodeMotion {
            places: (0..count as u32).map(|place| APART | place).collect(),
            apart: vec![MotionMessage::default(); count],
            ..NodeMotion::of_nodes(std::iter::repeat_n(0, count), origin)
        }
    }

    /// Points that are these nodes of this rank.
    pub fn of_nodes(nodes: impl Iterator<Item = u32>, origin: [f64; 3]) -> NodeMotion {
        let places: Vec<u32> = nodes.collect();
        NodeMotion {
            origin,
            inverse_mass: vec![[0.0; 3]; places.len()],
            motions: vec![PointMotion::default(); places.len()],
            swept_boxes: vec![SweptBox::EVERYTHING; places.len()],
            places,
            // No motion has been found yet.
            mark: 1.0,
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
        NodeMotion { apart: vec![MotionMessage::default(); apart as usize], ..motion }
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

    /// Begins a step of length `drift`, a time, in which forces act for `kick` until velocities are those of the step. Points that
    /// are apart stay as they were until something else is heard.
    pub fn begin(&mut self, [drift, kick]: [f64; 2]) {
        (self.drift, self.kick, self.range) = (drift, kick, PathRange::default());
        (self.mark, self.found, self.all_found) = (self.mark + 1.0, 0, false);
    }

    /// Length of the step that was begun last, a time.
    pub fn drift(&self) -> f64 {
        self.drift
    }

    /// Borrows the nodes of this rank until [`NodeMotion::give_back`]: their forces are those without contact.
    pub fn borrow(&mut self, nodes: &mut Nodes) {
        (self.rows, self.forces) = (std::mem::take(&mut nodes.rows), std::mem::take(&mut nodes.forces));
    }

    /// Begins the step that another has begun, with the nodes that it has borrowed.
    pub fn borrow_from(&mut self, other: &mut NodeMotion) {
        (self.rows, self.forces) = (std::mem::take(&mut other.rows), std::mem::take(&mut other.forces));
        self.begin([other.drift, other.kick]);
        self.range = other.range;
    }

    /// Gives the nodes back.
    pub fn give_back(&mut self, nodes: &mut Nodes) {
        (nodes.rows, nodes.forces) = (std::mem::take(&mut self.rows), std::mem::take(&mut self.forces));
    }

    /// Takes in a message about a point that is apart.
    #[inline]
    pub fn receive(&mut self, point: u32, message: MotionMessage) {
        if let Some(own) = self.apart.get_mut((self.places[point as usize] & !APART) as usize) {
            *own = message;
        }
    }

    /// The message to other ranks about a point that is a node of this one.
    #[inline]
    pub fn message(&self, point: u32) -> MotionMessage {
        let PointMotion { start: [x, y, z, _], velocity: [u, v, w, _] } = self.of(point, |motion| *motion);
        let [p, q, r] = self.velocity_before(point);
        [x, y, z, u, v, w, p, q, r]
    }

    #[inline(always)]
    fn keep(&mut self, point: usize, motion: PointMotion) {
        (self.motions[point], self.swept_boxes[point]) = (motion, motion.box_to(self.drift, four(self.origin)));
    }

    /// Finds the motion of a point for the rest of the step.
    #[inline(always)]
    pub fn place(&mut self, point: u32) {
        self.place_all([point]);
    }

    /// Finds the motions of some points for the rest of the step.
    #[inline(always)]
    pub fn place_all<const N: usize>(&mut self, points: [u32; N]) {
        if self.all_found {
            return;
        }
        // No iterator: it would be compiled apart, without the vector instructions of the caller.
        let mut i = 0;
        while i < N {
            if self.motions[points[i] as usize].start[3] != self.mark {
                self.found += 1;
                self.keep(points[i] as usize, self.find(points[i]));
            }
            i += 1;
        }
    }

    /// Whether so many motions were found one by one in the last step that it costs less to find those of so many points together; then they
    /// are until [`NodeMotion::count_anew`].
    pub fn is_crowded(&self, points: usize) -> bool {
        2 * self.found > points
    }

    /// Lets motions be found one by one in the next step, and counts them.
    pub fn count_anew(&mut self) {
        self.found = 0;
    }

    /// Hears that the motions of so many points have been found together.
    pub fn count_found(&mut self, points: usize) {
        self.found += points;
    }

    /// Finds the motions of all points for the rest of the step: a search asks for each of them several times, in an order of its own.
    pub fn find_all(&mut self) {
        if self.all_found {
            return;
        }
        for point in 0..self.len() {
            if let Some(&soon) = self.places.get(point + SOON)
                && let (Some(row), Some(force)) = (self.rows.get(soon as usize), self.forces.get(soon as usize))
            {
                prefetch_later(row, force);
            }
            self.keep(point, self.find(point as u32));
        }
        self.all_found = true;
    }

    /// Looks at all points, nodes of this rank, at the beginning of a step: how far those go that count, and whether one of them
    /// leaves its search box. Of each it is told whether it counts, all bits or none, and its search box, and how far these have all
    /// been carried along. With `ALL` it finds all motions, with `COUNTED` those of points that count.
    #[inline(always)]
    pub fn survey<const ALL: bool, const COUNTED: bool>(
        &mut self,
        nodes: &Nodes,
        last_drift: f64,
        of_each: (&[u64], &[SweptBox], [f64; 3]),
    ) -> bool {
        let (mut range, mut outside) = (PathRange::default(), Outside::of_boxes_carried(of_each.2));
        let soon = self.places.iter().skip(SOON).chain(self.places.last().into_iter().cycle());
        let places = self.places.iter().zip(soon).zip(self.motions.iter_mut().zip(&mut self.swept_boxes));
        for (((&node, &soon), (own, own_box)), (&counts, search_box)) in places.zip(of_each.0.iter().zip(of_each.1)) {
            prefetch_later(&nodes.rows[soon as usize], &nodes.forces[soon as usize]);
            let row = &nodes.rows[node as usize];
            let motion = PointMotion::of_node(row, &nodes.forces[node as usize], self.kick, self.mark);
            let gone = [4, 5, 6, 3].map(|i| row.0[i] * last_drift);
            range.take([gone, motion.velocity.map(|velocity| velocity * self.drift)], counts);
            let swept_box = motion.box_to(self.drift, four(self.origin));
            outside.take(&swept_box, search_box);
            if ALL || COUNTED && counts != 0 {
                (*own, *own_box) = (motion, swept_box);
            }
        }
        self.range = range;
        self.all_found = ALL;
        outside.any()
    }

    /// Between which paths those are that points which count have gone in the last step or will go in this one.
    pub fn range(&mut self) -> &mut PathRange {
        &mut self.range
    }

    /// How far points that count have gone in the last step or will go in this one, on any rank.
    pub fn paths(&self) -> Paths {
        self.range.paths()
    }

    /// How far some points will go in this step.
    pub fn paths_ahead(&self, points: impl Iterator<Item = u32>) -> Paths {
        let mut range = PathRange::default();
        for point in points {
            let ahead = self.of(point, |motion| motion.velocity.map(|velocity| velocity * self.drift));
            range.take([Four::default(), ahead], u64::MAX);
        }
        range.paths()
    }

    /// The same out of line: what is asked for that has not been placed is seldom.
    #[inline(never)]
    fn find_out_of_line(&self, point: u32) -> PointMotion {
        self.find(point)
    }

    /// The motion of a point that has not been placed.
    #[inline(always)]
    fn find(&self, point: u32) -> PointMotion {
        let place = self.places[point as usize];
        match (self.rows.get(place as usize), self.forces.get(place as usize)) {
            (Some(row), Some(force)) => PointMotion::of_node(row, force, self.kick, self.mark),
            _ => {
                let [x, y, z, u, v, w, ..] = self.apart[(place & !APART) as usize];
                PointMotion { start: [x, y, z, self.mark], velocity: four([u, v, w]) }
            }
        }
    }

    /// What `of` says of the motion of a point. Nearly always that has been found.
    #[inline(always)]
    fn of<T>(&self, point: u32, of: impl Fn(&PointMotion) -> T) -> T {
        let own = &self.motions[point as usize];
        let found;
        let motion = if own.start[3] == self.mark {
            own
        } else {
            found = self.find_out_of_line(point);
            &found
        };
        of(motion)
    }

    /// Position at the present state.
    #[inline(always)]
    pub fn start(&self, point: u32) -> [f64; 3] {
        self.of(point, |motion| three(motion.start))
    }

    /// The same as a whole vector, whose last number says nothing.
    #[inline(always)]
    pub fn start_four(&self, point: u32) -> Four {
        self.of(point, |motion| motion.start)
    }

    /// Position at the end of the step without contact.
    #[inline(always)]
    pub fn end(&self, point: u32) -> [f64; 3] {
        three(self.end_four(point))
    }

    /// The same as a whole vector.
    #[inline(always)]
    pub fn end_four(&self, point: u32) -> Four {
        self.of(point, |motion| motion.end(self.drift))
    }

    /// Velocity over the coming step as it would be without contact.
    #[inline(always)]
    pub fn velocity(&self, point: u32) -> [f64; 3] {
        self.of(point, |motion| three(motion.velocity))
    }

    /// Asks the memory for what [`NodeMotion::velocity_before`] will say of points.
    #[inline(always)]
    pub fn ask_for_rows(&self, points: &[u32]) {
        for &point in points {
            prefetch_named(&self.rows, &self.places[point as usize..=point as usize]);
        }
    }

    /// Velocity over the step before.
    #[inline(always)]
    pub fn velocity_before(&self, point: u32) -> [f64; 3] {
        let place = self.places[point as usize];
        match self.rows.get(place as usize) {
            Some(Row([.., u, v, w, _])) => [*u, *v, *w],
            None => {
                let [.., u, v, w] = self.apart[(place & !APART) as usize];
                [u, v, w]
            }
        }
    }

    /// Where a point is, and how far it goes in the step.
    #[inline(always)]
    pub fn path(&self, point: u32) -> ([f64; 3], [f64; 3]) {
        let [start, end] = self.of(point, |motion| [three(motion.start), three(motion.end(self.drift))]);
        (start, [end[0] - start[0], end[1] - start[1], end[2] - start[2]])
    }

    /// Box around the path of a point that has been placed, seen from the origin.
    #[inline(always)]
    pub fn swept_box(&self, point: u32) -> &SweptBox {
        &self.swept_boxes[point as usize]
    }
}
