//! Edges against edges: two edges that cross meet where no node meets a face, as when a corner hits an edge.
//!
//! Edges that stand out meet each other, and the lines of the mesh in faces that are flat or nearly so, into which they would
//! sink between the nodes; of these those that are bent meet each other. The check of the former is that of nodes and faces: by motion for a pair that comes anew, where it
//! would be at the end of the step for one that has touched before.

mod constraint;
mod ends;
pub(super) mod lines;
mod newcomer;
mod reach;
mod surfaces;

use super::FLUSH;
use crate::common::vector::{add, dot, scaled, subtract};
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::enforcement::constraint::Constraint;
use crate::solver::contact::geometry::edges::{Edge, Shape};
use crate::solver::contact::geometry::faces::Faces;
use crate::solver::contact::geometry::motion::{NodeMotion, larger, smaller, three};
use crate::solver::contact::geometry::projection::{area_normal, centre};
use crate::solver::contact::geometry::swept_box::SweptBox;
use crate::solver::contact::search::Box3;
use crate::solver::contact::surface::pairings::Pairing;
use ends::{BEYOND_END, IN_VALLEY};
use lines::{CROSSING, Crossing, Line, QuickCrossing, WHOLE};
pub use reach::{farthest_reach, largest_reach, reach};

/// The same as [`CROSSING`] of edges of surfaces, which have no inside: ends that lie on both sides of an edge are apart by this part of
/// it, and the side on which they stay must be known by then.
const CROSSING_OF_SURFACES: f64 = 0.01;

/// Least cosine between the way from one edge of a surface to another at the beginning of a step and the normal to both at its end.
const SAME_SIDE: f64 = 0.5;

/// A pair that has parted by less than this part of an edge is still watched.
pub(super) const KEEP: f64 = 0.01;

/// Pairs that are nearer than this part of an edge touch.
const TOUCHING: f64 = 1e-9;

/// Pairs that overlap by more than this part of an edge did not come through each other.
const DEEP: f64 = 0.25;

/// Part of a line's length scale by which an edge may sink in before the line answers. Where an edge lies on a face its nodes
/// and those of the face hold it; only what sinks in between them is left to the lines, so that what rests is held once.
const SLACK: f64 = 0.005;

/// Part of that scale by which an edge may come to a line between two looks for lines. Much less than the slack, so that how deep it is when
/// the line takes it hardly depends on when the looks are.
const UNSEEN: f64 = 0.001;

/// Part of that scale within which a line looks for edges. One that comes deeper than the slack from beside may stay so deep.
pub(super) const SUNK: f64 = 0.05;

/// Part of a ridge by which an edge may cross it beyond the middle of the face. Both fall towards the middle, so that an edge below it
/// crosses neither.
const BEYOND_MIDDLE: f64 = 0.05;

/// Smallest cosine between the normal at a line and the way in which an edge is pushed off it.
const STEEP: f64 = 0.8;

/// An edge this part of a face's size below its plane is in the plane. Not more: in folds, faces that merely come near each other's planes must
/// not be taken for a seam.
const SEAM: f64 = 2e-4;

/// Two edges in contact, remembered from step to step: their numbers, and in which direction the normal force pushes the first
/// along the product of their directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeContact {
    /// The edges: ascending where both stand out or both are bent, else the line second.
    pub pair: [u32; 2],
    /// +1 or −1.
    pub sense: f64,
    /// Overlap that is tolerated because it was not made by motion: a gap, a length of at most 0.
    pub tolerated: f64,
    /// What the contact carries: forces on the first edge.
    pub carried: Carried,
}

/// A pair in the order that its edges have now; `None` where they no longer meet.
pub fn in_order(past: EdgeContact, edges: &[Edge]) -> Option<EdgeContact> {
    let [a, b] = past.pair;
    let swaps = match [a, b].map(|edge| edges[edge as usize].shape) {
        [Shape::StandsOut, Shape::StandsOut] | [Shape::Bent, Shape::Bent] => a > b,
        [Shape::StandsOut, Shape::Bent | Shape::Line] => false,
        [Shape::Bent | Shape::Line, Shape::StandsOut] => true,
        _ => return None,
    };
    // The product of their directions changes sign, and so does the way from one to the other: the sense stays.
    Some(if swaps { EdgeContact { pair: [b, a], carried: past.carried.reversed(), ..past } } else { past })
}

/// What the check of a pair of edges finds.
pub enum EdgeVerdict {
    /// They touch.
    Touching(EdgeContact, Box<Constraint>),
    /// They do not; along an axis they are so far apart in this step, beyond where they would be near, or 0.
    Apart(f64),
}

/// How far an edge may come, a length, between two looks for lines, of the line's [`reach`].
pub fn unseen(reach: f64) -> f64 {
    UNSEEN / SUNK * reach
}

/// The check of edges against edges.
pub struct EdgeCheck<'a> {
    /// Points.
    pub motion: &'a NodeMotion,
    /// Faces.
    pub faces: &'a Faces,
    /// Edges.
    pub edges: &'a [Edge],
    /// How far around itself each edge looks for others, see [`reach`].
    pub reaches: &'a [f64],
}

impl EdgeCheck<'_> {
    /// How far an edge, or a half of ridges, reaches for what crosses it, from and to as parts of it: see [`BEYOND_MIDDLE`].
    #[inline(always)]
    fn parts(&self, edge: u32, half: usize) -> [f64; 2] {
        match (self.edges[edge as usize].is_ridge(), half) {
            (false, _) => WHOLE,
            (true, 0) => [0.0, 1.0 + BEYOND_MIDDLE],
            (true, _) => [-BEYOND_MIDDLE, 1.0],
        }
    }

    /// Two edges as lines; of ridges the one from their first end to the middle of the face, or on from there to the second.
    #[inline(always)]
    fn lines(&self, pair: [u32; 2], half: usize, at: impl Fn(u32) -> [f64; 3]) -> [Line; 2] {
        let [first, second] = pair.map(|edge| &self.edges[edge as usize]);
        let own = [at(first.ends[0]), at(first.ends[1])];
        if !second.is_ridge() {
            return [own, [at(second.ends[0]), at(second.ends[1])]];
        }
        let [a, b, c, d] = second.points(self.faces);
        let middle = centre(&[at(a), at(b), at(c), at(d)]);
        [own, if half == 0 { [at(second.ends[0]), middle] } else { [middle, at(second.ends[1])] }]
    }

    /// The same at the beginning of the step.
    #[inline(always)]
    fn starts(&self, pair: [u32; 2], half: usize) -> [Line; 2] {
        self.lines(pair, half, |point| self.motion.start(point))
    }

    /// The same at its end.
    #[inline(always)]
    fn ends(&self, pair: [u32; 2], half: usize) -> [Line; 2] {
        self.lines(pair, half, |point| self.motion.end(point))
    }

    /// Which half of ridges an edge crosses at the end of the step, or comes nearest to crossing; 0 of a single line.
    fn half(&self, pair: [u32; 2]) -> usize {
        if !self.edges[pair[1] as usize].is_ridge() {
            return 0;
        }
        let beyond = |half: usize| {
            let crossing = Crossing::with(self.ends(pair, half), 0.0);
            crossing.map_or(f64::INFINITY, |crossing| (-crossing.places[1]).max(crossing.places[1] - 1.0))
        };
        usize::from(beyond(1) < beyond(0))
    }

    /// Box around the path of an edge over the step.
    #[inline(always)]
    fn swept_box(&self, edge: u32) -> Box3 {
        let edge = &self.edges[edge as usize];
        let points = edge.points(self.faces);
        let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        // Loops over whole vectors: as closures they would be calls.
        for point in if edge.is_ridge() { &points[..] } else { &points[..2] } {
            for at in [self.motion.start_four(*point), self.motion.end_four(*point)] {
                for i in 0..4 {
                    low[i] = smaller(at[i], low[i]);
                    high[i] = larger(at[i], high[i]);
                }
            }
        }
        Box3 { low: three(low), high: three(high) }
    }

    /// Box around the path of an edge over the step, grown by a margin, in single precision.
    #[inline(always)]
    fn quick_box(&self, edge: u32, margin: f64) -> SweptBox {
        let [a, b, c, d] = self.edges[edge as usize].points(self.faces);
        let motion = self.motion;
        let boxes = [motion.swept_box(a), motion.swept_box(b), motion.swept_box(c), motion.swept_box(d)];
        SweptBox::joined(boxes, margin as f32)
    }

    /// How far apart the swept boxes of two edges are along an axis, beyond where they are near; not above 0 where they are near.
    #[inline(always)]
    fn apart(&self, [first, second]: [u32; 2]) -> f64 {
        let margin = self.reaches[first as usize].max(self.reaches[second as usize]) + self.distance([first, second]);
        f64::from(self.quick_box(first, margin).distance(&self.quick_box(second, 0.0)))
    }

    /// Whether two edges touch in the coming step: the pair to remember and its constraint. Lines are looked for again within
    /// so many steps like this one, 0 where they are in this one: a pair that may wait for that is taken to be near, and no more.
    #[inline(always)]
    pub fn pair(
        &self,
        pair: [u32; 2],
        past: Option<&EdgeContact>,
        until_lines: f64,
        pairing: impl FnOnce() -> Pairing,
    ) -> EdgeVerdict {
        // What lies in a surface has no outside of its own: motion says on which side the other is.
        let stand_out = self.edges[pair[1] as usize].stands_out() || self.is_of_surface(pair);
        if past.is_none() {
            let apart = self.apart(pair);
            if apart > 0.0 {
                return EdgeVerdict::Apart(apart);
            }
            if until_lines > 0.0 && self.may_wait(pair, until_lines) {
                return EdgeVerdict::Apart(0.0);
            }
            // Nearly all pairs on bodies that rest on each other go no further.
            let Some(crossing) = self.quick_crossing(pair) else { return EdgeVerdict::Apart(0.0) };
            if !stand_out && self.is_above(pair[1], &crossing) {
                return EdgeVerdict::Apart(0.0);
            }
        }
        let pairing = pairing();
        let found = if stand_out { self.standing_out(pair, past, pairing) } else { self.on_line(pair, past, pairing) };
        match found {
            Some((now, constraint)) => EdgeVerdict::Touching(now, Box::new(constraint)),
            // Newcomers that come so far are near.
            None => EdgeVerdict::Apart(past.map_or(0.0, |_| self.apart(pair).max(0.0))),
        }
    }

    /// Whether a pair that has not touched may wait until lines are looked for, so many steps like this one: edges of surfaces, which
    /// have no depth to sink into, look in every step.
    #[inline(always)]
    fn may_wait(&self, pair: [u32; 2], steps: f64) -> bool {
        let [first, second] = pair.map(|edge| &self.edges[edge as usize]);
        !second.stands_out() && !first.is_of_surface(self.faces) && !self.comes_fast(pair, steps)
    }

    /// Whether an edge may come to a line farther than it may unseen within so many steps like this one.
    #[inline(always)]
    fn comes_fast(&self, pair: [u32; 2], steps: f64) -> bool {
        let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        for edge in pair.map(|edge| &self.edges[edge as usize]) {
            let points = edge.points(self.faces);
            for &point in if edge.is_ridge() { &points[..] } else { &points[..2] } {
                let (start, end) = (self.motion.start_four(point), self.motion.end_four(point));
                for i in 0..4 {
                    (low[i], high[i]) = (smaller(end[i] - start[i], low[i]), larger(end[i] - start[i], high[i]));
                }
            }
        }
        let [x, y, z] = subtract(three(high), three(low));
        let nearer = steps * (x * x + y * y + z * z).sqrt();
        nearer > unseen(self.reaches[pair[1] as usize])
    }

    /// Whether one of two edges is one of a surface.
    fn is_of_surface(&self, pair: [u32; 2]) -> bool {
        pair.iter().any(|&edge| self.edges[edge as usize].is_of_surface(self.faces))
    }

    /// Two edges that stand out, or of which one is of a surface.
    fn standing_out(
        &self,
        pair: [u32; 2],
        past: Option<&EdgeContact>,
        pairing: Pairing,
    ) -> Option<(EdgeContact, Constraint)> {
        // Edges that are in each other already need no common place on their paths.
        let margin = self.reaches[pair[0] as usize];
        let distance = self.distance(pair);
        if !self.swept_box(pair[0]).grown(margin + distance).overlaps(&self.swept_box(pair[1])) {
            return None;
        }
        let of_surface = self.is_of_surface(pair);
        let least = if of_surface { CROSSING_OF_SURFACES } else { CROSSING };
        let half = self.half(pair);
        let end = Crossing::with(self.ends(pair, half), least)?;
        let now = match past {
            Some(past) => {
                let sense = past.sense * self.turned(pair, half, &end);
                // What has opened does not close again for nothing.
                EdgeContact { sense, tolerated: past.tolerated.max((sense * end.gap - distance).min(0.0)), ..*past }
            }
            None if of_surface => self.comes_near(pair, half, &end, distance)?,
            None => self.newcomer(pair, &end)?,
        };
        let gap = now.sense * end.gap - distance - now.tolerated;
        let reach = end.shorter();
        // Edges of a surface are known to have come from their side, however deep they are; nothing else holds the ends of those
        // that go over its border.
        let (depth, deepest) =
            if of_surface { (0.0, DEEP * reach + distance) } else { ((-gap).max(0.0), DEEP * reach) };
        let between = if of_surface {
            end.within(depth, [WHOLE, self.parts(pair[1], half)])
        } else {
            self.is_between_ends(pair, &end, depth, |point| self.motion.end(point))
        };
        let is_too_deep = gap < -deepest && !past.is_some_and(|past| self.begins_together(pair, past));
        if !between || gap > KEEP * reach || is_too_deep {
            return None;
        }
        Some((now, self.constraint((pair, half), &end, &now, gap, pairing)))
    }

    /// How two edges cross at the end of the step, and which half of ridges it is; `None` where they do not between their ends.
    #[inline(always)]
    fn quick_crossing(&self, pair: [u32; 2]) -> Option<QuickCrossing> {
        let second = &self.edges[pair[1] as usize];
        if second.stands_out() {
            let end = QuickCrossing::of(self.ends(pair, 0), [IN_VALLEY; 2])?;
            return (end.is_within([BEYOND_END; 2]) || self.comes_beyond_end(pair, &end)).then_some(end);
        }
        let of = |half: usize, parts: [f64; 2]| QuickCrossing::of(self.ends(pair, half), [WHOLE, parts]);
        let first = of(0, WHOLE);
        if first.is_some() || !second.is_ridge() {
            return first;
        }
        let beyond = |half: usize| of(half, self.parts(pair[1], half));
        of(1, WHOLE).or_else(|| beyond(0)).or_else(|| beyond(1))
    }

    /// Whether two edges that cross beyond an end have gone through each other in the step.
    fn comes_beyond_end(&self, pair: [u32; 2], end: &QuickCrossing) -> bool {
        let start = QuickCrossing::of(self.starts(pair, 0), [IN_VALLEY; 2]);
        start.is_some_and(|start| dot(start.product, end.product) > 0.0 && start.fall * end.fall <= 0.0)
    }

    /// Whether the edge that crosses a line does so on the outside, or hardly inside.
    fn is_above(&self, line: u32, &QuickCrossing { product, square, fall, .. }: &QuickCrossing) -> bool {
        let slack = SLACK * self.scale(line);
        let up = || dot(product, area_normal(&self.faces.start(self.edges[line as usize].faces[0], self.motion)));
        fall * fall <= slack * slack * square || (fall < 0.0) == (up() > 0.0)
    }

    /// Whether an edge has penetrated a face at one of the lines in it, by more than it may. Which side is outside is known
    /// there, so motion need not be asked.
    fn on_line(
        &self,
        pair: [u32; 2],
        past: Option<&EdgeContact>,
        pairing: Pairing,
    ) -> Option<(EdgeContact, Constraint)> {
        let scale = self.scale(pair[1]);
        if !self.swept_box(pair[0]).grown(SUNK * scale).overlaps(&self.swept_box(pair[1])) {
            return None;
        }
        let half = self.half(pair);
        let end = Crossing::of(self.ends(pair, half))?;
        // At a node both edges there hold: the node may be the master only.
        if !end.within(-TOUCHING * end.shorter(), [WHOLE, self.parts(pair[1], half)]) {
            return None;
        }
        let line = self.outwards(pair[1]);
        let up = dot(end.normal, line);
        let sense = up.signum();
        let (gap, tolerated) = (sense * end.gap, -SLACK * scale);
        // The line looks out along the normal; pushed along it, the edge goes back into its own body.
        if up * up <= STEEP * STEEP * dot(line, line) || sense * dot(end.normal, self.outwards(pair[0])) >= 0.0 {
            return None;
        }
        let now = match past {
            // To be pushed out would give it velocity: it is left where it is until it goes by itself.
            Some(past) => EdgeContact { sense, tolerated: past.tolerated.max(gap).min(tolerated), ..*past },
            None => {
                let before = self.gap_before((pair, half), &end, sense)?;
                let slides = || self.slides_over_rim((pair, half), &end, -gap);
                if gap >= tolerated || before <= -SUNK * scale || self.is_at_rim(pair[1], end.places[1]) || slides() {
                    return None;
                }
                EdgeContact { pair, sense, tolerated: before.min(tolerated), carried: Carried::NOTHING }
            }
        };
        let beyond = gap - now.tolerated;
        if beyond > SLACK * scale || beyond < -DEEP * scale {
            return None;
        }
        Some((now, self.constraint((pair, half), &end, &now, beyond, pairing)))
    }

    /// Whether an edge that is so deep behind the faces of a line slides flush on a face around an end of the line, beyond the rim there, and is
    /// less deep behind that. Then that face holds it: what slides from one body onto the next is in by what contact tolerates.
    fn slides_over_rim(&self, (pair, half): ([u32; 2], usize), end: &Crossing, depth: f64) -> bool {
        let ([first, _], outwards) = (self.ends(pair, half), self.outwards(pair[1]));
        let at = add(first[0], scaled(subtract(first[1], first[0]), end.places[0]));
        let of = |face: u32| {
            let corners = self.faces.end(face, self.motion);
            let normal = area_normal(&corners);
            (corners, normal, dot(normal, normal))
        };
        let sliding = &self.edges[pair[0] as usize];
        let looks_both_ways = sliding.is_of_surface(self.faces);
        let own = sliding.faces.map(of);
        self.edges[pair[1] as usize].ends.iter().any(|&point| {
            let end = self.motion.end(point);
            self.faces.around(point).iter().any(|&face| {
                let (corners, normal, square) = of(face);
                let cosine = dot(normal, outwards);
                let turns = cosine * cosine < STEEP * STEEP * square * dot(outwards, outwards);
                let is_flush = |&(_, own, of_own): &([[f64; 3]; 4], [f64; 3], f64)| {
                    let cosine = dot(own, normal);
                    (looks_both_ways || cosine < 0.0) && cosine * cosine > FLUSH * FLUSH * square * of_own
                };
                turns
                    && dot(subtract(centre(&corners), end), outwards) < 0.0
                    && own.iter().any(is_flush)
                    && dot(subtract(at, end), normal)
                        > -depth.min(SEAM * self.faces.size[face as usize]) * square.sqrt()
            })
        })
    }

    /// Gap of an edge over a line at the beginning of the step, in the sense of its end.
    fn gap_before(&self, (pair, half): ([u32; 2], usize), end: &Crossing, sense: f64) -> Option<f64> {
        let start = Crossing::of(self.starts(pair, half))?;
        Some(dot(start.normal, end.normal).signum() * sense * start.gap)
    }

    /// Length that what sinks in at a line is small against: the size of the faces, or what half the element beneath allows.
    fn scale(&self, line: u32) -> f64 {
        reach::scale(self.faces, &self.edges[line as usize])
    }

    /// Sum of the normals of the faces at an edge, at the beginning of the step.
    fn outwards(&self, edge: u32) -> [f64; 3] {
        let [a, b] = self.edges[edge as usize].faces.map(|face| area_normal(&self.faces.start(face, self.motion)));
        add(a, b)
    }

    /// Distance at which two edges touch, a length.
    fn distance(&self, pair: [u32; 2]) -> f64 {
        pair.iter().map(|&edge| self.edges[edge as usize].distance(self.faces)).sum()
    }
}
