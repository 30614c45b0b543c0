//! Nodes of sharp edges that cross the sharp border of a face: the edges hold each other there.

use super::NodeFaceCheck;
use crate::common::vector::{add, cross, dot, scaled, subtract};
use crate::solver::contact::geometry::edges::{self, CLEAR_CROSSING, Onward};
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
        let at = |point: u32| self.place(point, time);
        let corners = self.faces.corners[face as usize];
        let Some(place) = projection::project(&corners.map(at), at(point)) else { return false };
        let level = LEVEL * self.faces.size[face as usize];
        // At a corner two sides are as near.
        (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).any(|border| {
            let [from, to] = border.map(at);
            let (along, arm) = (subtract(to, from), subtract(at(point), from));
            let (off, square) = (cross(arm, along), dot(along, along));
            let (part, near) = (dot(arm, along) / square, level / square.sqrt());
            let is_level = dot(off, off) <= level * level * square;
            // How high the border is above the node at the beginning of the step: in it, what slides may come down on the edges that it meets.
            let [first, last] = border.map(|corner| self.motion.start(corner));
            let rise = subtract(add(first, scaled(subtract(last, first), part)), self.motion.start(point));
            let crosses = |ridge: [f64; 3]| {
                let upright = cross(ridge, along);
                let (of_upright, push) = (dot(upright, upright), dot(place.normal, upright));
                let begins_level = || dot(rise, upright).abs() <= level * of_upright.sqrt();
                of_upright > CLEAR_CROSSING * CLEAR_CROSSING * dot(ridge, ridge) * square
                    && push * push < SAME_PUSH * SAME_PUSH * of_upright
                    && (is_level || begins_level())
            };
            (-near..=1.0 + near).contains(&part)
                && self.is_sharp_border(face, border, part)
                && self.is_on_ridge(point, at, crosses)
        })
    }

    /// Whether one of the sides of a face is a sharp edge of its element, and goes on at an end if this part of it is near that.
    fn is_sharp_border(&self, face: u32, [a, b]: [u32; 2], part: f64) -> bool {
        let normal = |face: u32| projection::area_normal(&self.faces.start(face, self.motion));
        let goes_on = |part: f64, ends: [u32; 2], outwards: [f64; 3]| {
            part > NEAR_END || edges::onward(self.faces, self.motion, ends, outwards) != Onward::Ends
        };
        let is_border = |other: u32| {
            let outwards = add(normal(face), normal(other));
            self.has_border(other, &[a, b])
                && edges::is_sharp_between(self.faces, self.motion, [face, other])
                && goes_on(part, [b, a], outwards)
                && goes_on(1.0 - part, [a, b], outwards)
        };
        a != b && self.beside(face).any(is_border)
    }

    /// Whether a point is in the middle of a sharp edge of its body, for both parts of which something holds.
    fn is_on_ridge(&self, point: u32, at: impl Fn(u32) -> [f64; 3], holds: impl Fn([f64; 3]) -> bool) -> bool {
        let around = self.faces.around(point);
        // Each part lies between two of the faces around the point.
        let mut ridges: Vec<[f64; 3]> = Vec::new();
        for (i, &first) in around.iter().enumerate() {
            for &second in &around[i + 1..] {
                let corners = self.faces.corners[first as usize];
                let shared = corners.into_iter().find(|&end| end != point && self.has(second, end));
                ridges.extend(
                    shared
                        .filter(|_| edges::is_sharp_between(self.faces, self.motion, [first, second]))
                        .map(|end| subtract(at(end), at(point))),
                );
            }
        }
        let outwards = self.faces.point_normal(point, self.motion);
        let goes_on = |a: [f64; 3], b: [f64; 3]| edges::bend(scaled(a, -1.0), b, outwards) != Onward::Ends;
        let is_middle =
            |(i, &a): (usize, &[f64; 3])| ridges[i + 1..].iter().any(|&b| goes_on(a, b) && holds(a) && holds(b));
        ridges.iter().enumerate().any(is_middle)
    }

    fn has(&self, face: u32, point: u32) -> bool {
        self.faces.corners[face as usize].contains(&point)
    }
}
