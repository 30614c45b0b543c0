//! Nodes behind a seam, beyond the borders of both faces that meet there: whether the body goes on behind them, and whether they are level with the border.

use super::newcomer::{CLEARLY, SEAM};
use super::{HOLD, NodeFaceCheck, OPPOSED, faces_of};
use crate::common::vector::{dot, scaled, subtract};
use crate::solver::contact::geometry::projection::{self, Projection};
use crate::solver::contact::geometry::sides::HiddenSide;
use crate::solver::contact::search::locate::Candidate;

/// Two borders whose directions have a larger cosine go on as one seam, as where three or more faces of a ball socket meet.
const GOES_ON: f64 = 0.2;

/// The middle of a face beyond a corner is seen from there at a cosine of more than minus this with the way on which a point is beyond it.
const ASKEW: f64 = 0.3;

impl NodeFaceCheck<'_> {
    /// Whether a point is behind a seam of a solid at which its foot is beyond the border of a face: behind two faces that see each other, as those
    /// of a bore do, or where such faces end, as in a plane of symmetry, in the side of the body. So at the beginning of the step, and no farther
    /// beyond at its end than it is deep. The faces near the point are asked, which all ranks have that check it; sides that touch nothing, as those of side
    /// sets, are known with the face itself.
    pub(super) fn is_behind_seam(&self, (point, face): (u32, u32), near: &[Candidate], ends: [&Projection; 2]) -> bool {
        if ends.iter().any(|at| at.outside > -at.gap) {
            return false;
        }
        let start = ends[0];
        let is_across = |other: u32| self.is_across(face, &start.weights, other);
        let middle = |face| projection::centre(&self.faces.start(face, self.motion));
        // From the border to the foot of the perpendicular beyond it.
        let nearest = projection::foot(&self.faces.start(face, self.motion), &start.weights);
        let foot = subtract(self.motion.start(point), scaled(start.normal, start.gap));
        let beyond = subtract(foot, nearest);
        let is_over_border_with = |other: u32| self.is_level_with_border((point, face), near, other);
        // Where four faces of a hollow meet, those beside one are a little more than square to the way across the corner.
        let goes_to = |other: u32| {
            let way = subtract(middle(other), nearest);
            let lengths = dot(way, way).sqrt() * dot(beyond, beyond).sqrt();
            dot(way, beyond) > -ASKEW * lengths && is_over_border_with(other)
        };
        let sees = |other: u32| {
            let rise = dot(subtract(middle(other), middle(face)), start.normal);
            rise > CLEARLY * self.faces.size[face as usize] && (start.outside <= 0.0 || goes_to(other))
        };
        // What is over the other face at both ends of the step is held by that one. In the bottom of a valley a point begins over both faces and
        // goes beyond the borders of both.
        let leaves = |other: u32| self.projection_at_end(point, other).is_some_and(|at| at.outside > 0.0);
        let is_beyond = |other: u32| {
            sees(other)
                && self
                    .projection_at_start(point, other)
                    .is_some_and(|at| at.gap < 0.0 && (at.outside > 0.0 || leaves(other)))
        };
        let is_in_side = |other: u32| {
            let reach = SEAM * self.faces.size[other as usize];
            self.projection_at_start(point, other).is_some_and(|at| {
                // What looks at the side touches that, as what follows a chord does: by one of its faces, as thin elements have next to no side.
                at.gap.abs() <= reach
                    && dot(beyond, at.normal) > 0.5 * start.outside
                    && !self.has_face_opposed(point, &at.normal, -OPPOSED)
            })
        };
        let mut others = faces_of(near).filter(|&other| other != face && is_across(other));
        others.any(is_beyond)
            || self.beside(face).any(|other| is_across(other) && is_over_border_with(other) && is_in_side(other))
            || self.is_in_hidden_side((point, face), near, start, beyond)
    }

    /// Whether a point is level with the border between two faces at the beginning of the step. Faces beside each other at the rim of a flat side see
    /// each other by round-off, and those of a side that is hollow along its rim do: what is beyond that rim is outside the body, and not on the way
    /// from one to the other over the border between them.
    fn is_level_with_border(&self, (point, face): (u32, u32), near: &[Candidate], other: u32) -> bool {
        let corners = self.faces.corners[face as usize];
        let is_strip = corners[0] == corners[3] && corners[1] == corners[2];
        let mut borders = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]);
        borders.any(|ends| {
            // The border of a strip is one node. That of a triangle with itself is none.
            (ends[0] != ends[1] || is_strip) && self.has_border(other, &ends) && self.is_level_with(point, near, ends)
        })
    }

    /// Whether a point is level with a border: between its ends, or beyond one at which the seam goes on and before the next border of that. In a ball
    /// socket, what is deep behind a corner is beyond the ends of all borders there.
    fn is_level_with(&self, point: u32, near: &[Candidate], ends: [u32; 2]) -> bool {
        let part = self.along_border(point, ends);
        if (-HOLD..=1.0 + HOLD).contains(&part) {
            return true;
        }
        let [back, end] = if part > 0.5 { ends } else { [ends[1], ends[0]] };
        let path = |from: u32, to: u32| subtract(self.motion.start(to), self.motion.start(from));
        let goes_on_to = |next: u32| {
            let (along, onwards) = (path(back, end), path(end, next));
            let lengths = dot(along, along).sqrt() * dot(onwards, onwards).sqrt();
            dot(along, onwards) > GOES_ON * lengths && self.along_border(point, [end, next]) < HOLD
        };
        let is_next = |[a, b]: [u32; 2]| a != b && (a == end && goes_on_to(b) || b == end && goes_on_to(a));
        faces_of(near).any(|face| {
            let corners = self.faces.corners[face as usize];
            (0..4).any(|i| is_next([corners[i], corners[(i + 1) % 4]]))
        })
    }

    /// Where a point is along a border at the beginning of the step: 0 at its first end and 1 at its second, and 0 where it is one node.
    fn along_border(&self, point: u32, ends: [u32; 2]) -> f64 {
        let [from, to] = ends.map(|end| self.motion.start(end));
        let (along, arm) = (subtract(to, from), subtract(self.motion.start(point), from));
        let square = dot(along, along);
        if square > 0.0 { dot(arm, along) / square } else { 0.0 }
    }

    /// Whether a point whose foot is beyond the border of a face by `beyond` is there in a side of the body that touches nothing itself.
    fn is_in_hidden_side(
        &self,
        (point, face): (u32, u32),
        near: &[Candidate],
        start: &Projection,
        beyond: [f64; 3],
    ) -> bool {
        let corners = self.faces.corners[face as usize];
        let is_level = |HiddenSide { ends, at, area_normal }: HiddenSide| {
            let mut shares = corners.iter().zip(&start.weights).filter(|(_, weight)| **weight > projection::TIE);
            let square = dot(area_normal, area_normal);
            let (length, gap) = (square.sqrt(), dot(subtract(self.motion.start(point), at), area_normal));
            shares.all(|(corner, _)| ends.contains(corner))
                && self.is_level_with(point, near, ends)
                // As far from the side as a part of its size, which is the root of its area.
                && gap.abs() <= SEAM * length.sqrt() * length
                && dot(beyond, area_normal) > 0.5 * start.outside * length
                && self.looks_past(point, area_normal)
        };
        self.faces.hidden_sides(face, self.motion).any(is_level)
    }
}
