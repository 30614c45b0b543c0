//! Where edges of solids that cross count as crossing between their ends.

use super::EdgeCheck;
use super::lines::{Crossing, WHOLE};
use crate::common::vector::{cross, dot, scaled, subtract};
use crate::solver::contact::geometry::edges::{self, CLEAR_CROSSING, Edge, Onward};
use crate::solver::contact::geometry::projection::area_normal;

/// Pairs that overlap by more than this part of an edge near an end are not held by a node there.
const CLEARLY: f64 = 1e-3;

/// Part of an edge, from and to, in which another may cross it where it goes on at that end: exactly at a node one of the edges there must be
/// crossed, however round-off has it.
pub const BEYOND_END: [f64; 2] = [-1e-6, 1.0 + 1e-6];

/// The same of edges that come into a valley, where what goes through both parts of an edge is beyond the end of either.
pub const IN_VALLEY: [f64; 2] = [-0.25, 1.25];

/// Edges look at each other if the cosine between their ways out is below minus this.
const LOOKING: f64 = 0.5;

/// An end nearer to another edge than this part of the edges is on it but for round-off.
const ROUND_OFF: f64 = 1e-9;

impl EdgeCheck<'_> {
    /// Whether edges of solids cross between their ends. Nearer to an end than they are deep a node or another edge is in the way before
    /// them, unless the edge goes on there, or that end is outside the other body: what has slid over its rim. The latter counts where they
    /// are clearly deep: else a face may hold the end as well.
    pub(super) fn is_between_ends(
        &self,
        pair: [u32; 2],
        crossing: &Crossing,
        depth: f64,
        at: impl Fn(u32) -> [f64; 3],
    ) -> bool {
        if crossing.within(depth, [WHOLE; 2]) {
            return true;
        }
        // On a sharp edge a node slides off to the side along a face and lets the edges through: it is not in the way before them. Where it gives
        // way, the other edge crosses those on both sides beyond their ends, by a part of the depth.
        let goes_on = |i: usize, end: usize| self.onward(pair[i], end) != Onward::Ends;
        let crosses = crossing.sine > CLEAR_CROSSING && crossing.within(-depth, [BEYOND_END; 2]);
        if crosses && self.all_ends_near(crossing, depth, goes_on) {
            return true;
        }
        let is_outside = |i: usize, end: usize| {
            let point = self.edges[pair[i] as usize].ends[end];
            let Edge { ends, faces, .. } = self.edges[pair[1 - i] as usize];
            let arm = subtract(at(point), at(ends[0]));
            faces.iter().any(|&face| {
                let corners = self.faces.corners[face as usize];
                dot(arm, area_normal(&corners.map(&at))) > 0.0
            })
        };
        let clearly = depth > CLEARLY * crossing.shorter();
        clearly && crossing.within(0.0, [WHOLE; 2]) && self.all_ends_near(crossing, depth, is_outside)
    }

    /// Whether a place of a line is its end but for round-off, at a rim: what passes there exactly does not meet the faces of the line.
    pub(super) fn is_at_rim(&self, line: u32, place: f64) -> bool {
        let is_end = |end: usize| (place - end as f64).abs() < ROUND_OFF && self.onward(line, end) == Onward::Ends;
        !self.edges[line as usize].is_ridge() && (is_end(0) || is_end(1))
    }

    /// Whether two edges cross in a valley, beyond ends by no more than a depth, a length: where an edge has been bent inwards at a node, what
    /// lies there is beyond the ends of both of its parts, seen along their normals.
    pub(super) fn is_in_valley(&self, pair: [u32; 2], crossing: &Crossing, depth: f64) -> bool {
        crossing.sine > CLEAR_CROSSING
            && crossing.within(-depth, [BEYOND_END; 2])
            && self.all_ends_near(crossing, 0.0, |i, end| self.onward(pair[i], end) == Onward::Upwards)
    }

    /// Whether two edges cross at an end of one of them, or a little beyond, where it goes on but not across the other: there they pass each other by, as the
    /// rims of a pin and of the hole into which it goes do, whose sides are a little apart or fit exactly.
    pub(super) fn pass_by(&self, pair: [u32; 2], crossing: &Crossing, at: impl Fn(u32) -> [f64; 3]) -> bool {
        // Beside each other are bodies that look at each other across the way on which they come, and not noses that meet tip on tip.
        let [first, second] = pair.map(|edge| {
            let outwards = self.outwards(edge);
            subtract(outwards, scaled(crossing.normal, dot(outwards, crossing.normal)))
        });
        let look_at_each_other = || dot(first, second) < -LOOKING * (dot(first, first) * dot(second, second)).sqrt();
        let passes = |i: usize| {
            let place = crossing.places[i];
            let ends = self.edges[pair[i] as usize].ends;
            let [from, end] = match place {
                _ if place < ROUND_OFF => [ends[1], ends[0]],
                _ if place > 1.0 - ROUND_OFF => ends,
                _ => return false,
            };
            let [first, last] = self.edges[pair[1 - i] as usize].ends.map(&at);
            // Upright on the other edge and on the normal of both.
            let aside = cross(subtract(last, first), crossing.normal);
            let length = crossing.lengths[i] * crossing.lengths[1 - i];
            let side = |point: u32| dot(subtract(at(point), first), aside) / length;
            let before = side(from);
            let mut onwards =
                edges::leading_on(self.faces, self.motion, [from, end], self.outwards(pair[i])).peekable();
            onwards.peek().is_some() && onwards.all(|next| side(next) * before.signum() > -ROUND_OFF)
        };
        (passes(0) || passes(1)) && look_at_each_other()
    }

    /// How an edge goes on at its first or second end.
    fn onward(&self, edge: u32, end: usize) -> Onward {
        let ends = self.edges[edge as usize].ends;
        edges::onward(self.faces, self.motion, [ends[1 - end], ends[end]], self.outwards(edge))
    }

    /// Whether something holds for all ends nearer to which two edges cross than they are deep: of the first or second edge, its first or second end.
    fn all_ends_near(&self, crossing: &Crossing, depth: f64, holds: impl Fn(usize, usize) -> bool) -> bool {
        [0, 1].iter().all(|&i| {
            let (place, length) = (crossing.places[i], crossing.lengths[i]);
            let is_far = [place * length > depth, (1.0 - place) * length > depth];
            [0, 1].iter().all(|&end| is_far[end] || holds(i, end))
        })
    }
}
