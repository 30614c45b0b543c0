//! Nodes of sharp edges that cross the sharp border of a face: the edges hold each other there.

use super::NodeFaceCheck;
use crate::common::vector::{add, cross, dot, scaled, subtract};
use crate::solver::contact::geometry::edges::{self, CLEAR_CROSSING, Onward, STRAIGHT, Shape};
use crate::solver::contact::geometry::projection;

/// A node that comes through a face nearer to its border than this part of the face's size is level with the border but for round-off, and
/// for the overlap that edges in contact have.
const LEVEL: f64 = 1e-3;

/// Nearer to its end than this part of it an edge holds another only where it goes on.
const NEAR_END: f64 = 0.01;

/// A face whose normal makes a larger cosine than this with what is upright on both edges pushes as they do.
const SAME_PUSH: f64 = 0.98;

impl NodeFaceCheck<'_> {
    /// Whether a node that comes through a face of a solid after a part of the step is held there by edges: it comes at a sharp border of the face,
    /// and is in the middle of a sharp edge of its own body that clearly crosses that border. What slides along a ridge has its nodes
    /// level with the other ridge but for round-off; the flank would stop them, and throw them off to the side.
    pub(super) fn is_held_by_edges(&self, point: u32, face: u32, time: f64) -> bool {
        let at = |point: u32| {
            let (start, path) = self.motion.path(point);
            add(start, scaled(path, time))
        };
        let corners = self.faces.corners[face as usize];
        let Some(place) = projection::project(&corners.map(at), at(point)) else { return false };
        let [a, b] = place.edge().map(|i| corners[i]);
        let along = subtract(at(b), at(a));
        let arm = cross(subtract(at(point), at(a)), along);
        let level = LEVEL * self.faces.size[face as usize];
        if dot(arm, arm) > level * level * dot(along, along) {
            return false;
        }
        let is_ridge = |first: u32, second: u32| {
            let side = |face: u32| edges::side(&self.faces.start(face, self.motion));
            Shape::of(side(first), side(second), false) == Shape::StandsOut
        };
        let has = |face: u32, point: u32| self.faces.corners[face as usize].contains(&point);
        let part = dot(subtract(at(point), at(a)), along) / dot(along, along);
        let normal = |face: u32| projection::area_normal(&self.faces.start(face, self.motion));
        let goes_on = |part: f64, ends: [u32; 2], outwards: [f64; 3]| {
            part > NEAR_END || edges::onward(self.faces, self.motion, ends, outwards) != Onward::Ends
        };
        let is_border = |other: u32| {
            let outwards = add(normal(face), normal(other));
            has(other, a)
                && has(other, b)
                && is_ridge(face, other)
                && goes_on(part, [b, a], outwards)
                && goes_on(1.0 - part, [a, b], outwards)
        };
        if a == b || !self.beside(face).any(is_border) {
            return false;
        }
        let crosses = |onwards: [f64; 3]| {
            let upright = cross(onwards, along);
            let square = dot(upright, upright);
            let push = dot(place.normal, upright);
            square > CLEAR_CROSSING * CLEAR_CROSSING * dot(onwards, onwards) * dot(along, along)
                && push * push < SAME_PUSH * SAME_PUSH * square
        };
        // The ridges that leave the node: each lies between two of the faces around it.
        let around = self.faces.around(point);
        let mut ridges: Vec<[f64; 3]> = Vec::new();
        for (i, &first) in around.iter().enumerate() {
            for &second in &around[i + 1..] {
                let shared =
                    self.faces.corners[first as usize].into_iter().find(|&end| end != point && has(second, end));
                if let Some(end) = shared.filter(|_| is_ridge(first, second)) {
                    ridges.push(subtract(at(end), at(point)));
                }
            }
        }
        // As in `edges::onward`: in a valley both parts are met before the node.
        let outwards = self.faces.point_normal(point, self.motion);
        let goes_on = |a: &[f64; 3], b: &[f64; 3]| {
            let (cosine, lengths) = (dot(*a, *b), [dot(*a, *a).sqrt(), dot(*b, *b).sqrt()]);
            let is_valley = dot(*a, outwards) * lengths[1] + dot(*b, outwards) * lengths[0] > 0.0;
            cosine < 0.0 && (is_valley || cosine < -STRAIGHT * lengths[0] * lengths[1])
        };
        let middle =
            |(i, a): (usize, &[f64; 3])| ridges[i + 1..].iter().any(|b| goes_on(a, b) && crosses(*a) && crosses(*b));
        ridges.iter().enumerate().any(middle)
    }
}
