//! Edges of surfaces, which have no inside and touch at a distance: on which side of each other they are.

use super::lines::{Crossing, between};
use super::{EdgeCheck, EdgeContact, SAME_SIDE};
use crate::common::vector::{add, dot, normalized, scaled, subtract};
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::geometry::edges::Edge;
use crate::solver::contact::geometry::projection::{area_normal, centre};

/// Edges of surfaces nearer to each other than this part of the distance at which they touch are on neither side of each other but for round-off.
const LEVEL: f64 = 1e-3;

impl EdgeCheck<'_> {
    /// −1 where the normal of two edges of surfaces has turned over within the step, as they went through parallel; else 1.
    pub(super) fn turned(&self, pair: [u32; 2], half: usize, end: &Crossing) -> f64 {
        if !self.is_of_surface(pair) {
            return 1.0;
        }
        let start = Crossing::with(self.starts(pair, half), 0.0);
        start.map_or(1.0, |start| if dot(start.normal, end.normal) < 0.0 { -1.0 } else { 1.0 })
    }

    /// Where the body of an edge is, seen from the edge at the beginning of the step, a vector of at most about a unit: nothing for an edge in the middle of a
    /// flat surface, which is on both sides.
    fn inwards(&self, edge: u32) -> [f64; 3] {
        let Edge { ends, faces, .. } = self.edges[edge as usize];
        let [a, b] = ends.map(|point| self.motion.start(point));
        let middle = scaled(add(a, b), 0.5);
        let of = |face: u32| {
            let corners = self.faces.start(face, self.motion);
            let inwards = if self.faces.is_two_sided(face) {
                // Across the edge: along it the middle of the face may lie anywhere.
                let (arm, along) = (subtract(centre(&corners), middle), subtract(b, a));
                subtract(arm, scaled(along, dot(arm, along) / dot(along, along)))
            } else {
                scaled(area_normal(&corners), -1.0)
            };
            normalized(inwards).unwrap_or_default()
        };
        scaled(add(of(faces[0]), of(faces[1])), 0.5)
    }

    /// A pair that has not touched before and touches at a distance: the side on which the step begins is the side on which it
    /// stays. Where the mesh or a path from beside has brought them nearer, they stay as near.
    pub(super) fn comes_near(&self, pair: [u32; 2], half: usize, end: &Crossing, distance: f64) -> Option<EdgeContact> {
        // What has too little room is as thin to what comes from beside, see `Faces::rim`.
        let rim = distance * self.faces.least_room(pair.iter().flat_map(|&edge| self.edges[edge as usize].ends));
        let separation = between(self.starts(pair, half));
        let (length, along) = (dot(separation, separation).sqrt(), dot(separation, end.normal));
        let is_level = length <= LEVEL * distance;
        let (sense, before, away) = if is_level {
            // Where they touch exactly, as a mesh may have it, their bodies say on which side each is.
            let [first, second] = pair.map(|edge| self.inwards(edge));
            let apart = subtract(first, second);
            let (sense, square) = (dot(apart, end.normal), dot(apart, apart));
            // In the middle of flat surfaces nothing says it but round-off.
            if square < SAME_SIDE * SAME_SIDE || sense * sense <= SAME_SIDE * SAME_SIDE * square {
                return None;
            }
            (sense.signum(), sense.signum() * along - distance, scaled(end.normal, sense.signum()))
        } else if along.abs() <= SAME_SIDE * length {
            return None;
        } else {
            (along.signum(), length - distance, separation)
        };
        // Into its own body no edge of a solid is pushed.
        let outwards = [-1.0, 1.0].iter().zip(pair).all(|(sign, edge)| {
            self.edges[edge as usize].is_of_surface(self.faces) || sign * dot(away, self.outwards(edge)) > 0.0
        });
        // Over a line in a wall that ends at a rim an edge may slide, not over the rim itself.
        let is_in_the_way = || {
            let other = &self.edges[pair[1] as usize];
            other.stands_out()
                || other.is_of_surface(self.faces)
                || !self.slides_over_rim((pair, half), end, f64::INFINITY)
        };
        (outwards && sense * end.gap < rim && is_in_the_way()).then_some(EdgeContact {
            pair,
            sense,
            tolerated: before.min(0.0),
            carried: Carried::NOTHING,
        })
    }
}
