//! Edges of solids that have not touched before: whether they come together within the step, between their ends.

use super::lines::Crossing;
use super::{EdgeCheck, EdgeContact, KEEP, TOUCHING};
use crate::common::vector::{add, dot, scaled};
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::geometry::crossing;
use crate::solver::contact::geometry::projection::area_normal;

/// Largest sine by which the normal of two edges may lean out of what their faces span.
const ASIDE: f64 = 1e-3;

impl EdgeCheck<'_> {
    /// A pair that has not touched before: it must come together within the step, both edges from outside.
    pub(super) fn newcomer(&self, pair: [u32; 2], end: &Crossing) -> Option<EdgeContact> {
        let start = Crossing::of(self.starts(pair, 0))?;
        // Turning through parallel within a step leaves no sense to compare.
        if dot(start.normal, end.normal) <= 0.0 {
            return None;
        }
        // Pushed along the normal, the first edge goes back into its own body.
        let [first, second] = pair.map(|edge| dot(start.normal, self.outwards(edge)));
        let outwards = |sense: f64| sense * first < 0.0 && sense * second > 0.0;
        let at = |point| self.motion.start(point);
        let touch = |sense, tolerated| EdgeContact { pair, sense, tolerated, carried: Carried::NOTHING };
        // Where they touch already, as a mesh may have it, the faces say on which side the other one is, and round-off nothing.
        if start.gap.abs() <= TOUCHING * start.shorter() {
            let comes = |sense: &f64| outwards(*sense) && sense * end.gap < 0.0;
            let sense = [1.0, -1.0].into_iter().find(comes)?;
            if !self.is_between_ends(pair, &start, 0.0, at) || self.pass_by(pair, &start, at) {
                return None;
            }
            return Some(touch(sense, (sense * start.gap).min(0.0)));
        }
        let sense = start.gap.signum();
        if outwards(sense) && sense * end.gap < 0.0 {
            return self.meets(pair, -sense * end.gap).then_some(touch(sense, 0.0));
        }
        // Overlapping from the start, made by other contacts: seen as soon as it is shallow and between the ends.
        let depth = start.gap.abs();
        let sense = -sense;
        (outwards(sense)
            && depth < KEEP * start.shorter()
            && self.are_in_each_other(pair, scaled(start.normal, sense))
            && self.is_between_ends(pair, &start, depth, at)
            && !self.pass_by(pair, &start, at))
        .then_some(touch(sense, -depth))
    }

    /// Whether edges that overlap along a normal, which pushes the first off the second, are each behind both faces of the other: what has passed by beside a face
    /// is in front of that. Noses of a fold stop each other all the same.
    fn are_in_each_other(&self, pair: [u32; 2], normal: [f64; 3]) -> bool {
        let [one, other] = pair.map(|edge| self.faces.block[self.edges[edge as usize].faces[0] as usize]);
        if one == other {
            return true;
        }
        [-1.0, 1.0].iter().zip(pair).all(|(side, edge)| {
            self.edges[edge as usize].faces.iter().all(|&face| {
                let of_face = area_normal(&self.faces.start(face, self.motion));
                side * dot(normal, of_face) >= -ASIDE * dot(of_face, of_face).sqrt()
            })
        })
    }

    /// Whether the edges come into one plane within the step, and there between their ends, or in a valley beyond these by the depth to
    /// which they would go, a length.
    fn meets(&self, pair: [u32; 2], depth: f64) -> bool {
        let path = |edge: u32, end: usize| self.motion.path(self.edges[edge as usize].ends[end]);
        let (a, b) = ([path(pair[0], 0), path(pair[0], 1)], [path(pair[1], 0), path(pair[1], 1)]);
        let volume = crossing::coplanarity(
            crossing::relative(b[0], a[0]),
            crossing::relative(a[1], a[0]),
            crossing::relative(b[1], b[0]),
        );
        crossing::roots(&volume).any(|t| {
            let at = |path: &crossing::Path| add(path.0, scaled(path.1, t));
            let place = |point| at(&self.motion.path(point));
            Crossing::of([[at(&a[0]), at(&a[1])], [at(&b[0]), at(&b[1])]]).is_some_and(|crossing| {
                let is_between = || self.is_between_ends(pair, &crossing, 0.0, |point| self.motion.start(point));
                (is_between() || self.is_in_valley(pair, &crossing, depth)) && !self.pass_by(pair, &crossing, place)
            })
        })
    }

    /// Whether a pair that has touched begins the step no deeper in each other than they may be. It comes from there, however far it would go in the step:
    /// what is pressed hardest would go farthest.
    pub(super) fn begins_together(&self, pair: [u32; 2], past: &EdgeContact) -> bool {
        Crossing::of(self.starts(pair, 0))
            .is_some_and(|start| past.sense * start.gap - past.tolerated > -KEEP * start.shorter())
    }
}
