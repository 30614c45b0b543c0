//! Joints of flush bodies: sides that another body covers, over which what is on both of them slides, and into which nothing goes.

use super::super::FLUSH;
use super::newcomer::{CLEARLY, SEAM};
use super::{HOLD, IN_SURFACE, NodeFaceCheck, OPPOSED, SAME_WAY, faces_of};
use crate::common::vector::{add, dot, normalized, scaled, subtract};
use crate::solver::contact::geometry::projection::{self, Projection};
use crate::solver::contact::geometry::sides::frame;
use crate::solver::contact::search::locate::Candidate;

/// Corners that are behind a plane, or before one, by less than this part of a face's size are not behind it, or before it.
pub(super) const ON_PLANE: f64 = 1e-3;

/// Where a point meets a face: its place, and the part of the step after which the face is looked at.
#[derive(Clone, Copy)]
pub(super) struct Meeting {
    pub place: [f64; 3],
    pub time: f64,
}

impl NodeFaceCheck<'_> {
    /// Where a point would be without contact at a part of the step.
    pub(super) fn meeting(&self, point: u32, time: f64) -> Meeting {
        Meeting { place: self.place(point, time), time }
    }

    /// The place alone.
    pub(super) fn place(&self, point: u32, time: f64) -> [f64; 3] {
        let (start, path) = self.motion.path(point);
        add(start, scaled(path, time))
    }

    /// Part of the step after which a point comes through the plane of a face of a solid hardly beyond its border, where the face around
    /// that border looks the same way as one of the point's own: what is as wide as the other body must not slip by for a little that
    /// it bulges. A pin in a hole that is a little wider finds no such side there. A point without faces goes into no joint.
    pub(super) fn comes_flush(
        &self,
        (point, face): (u32, u32),
        near: &[Candidate],
        [start, end]: [&Projection; 2],
    ) -> Option<f64> {
        let time = start.gap / (start.gap - end.gap);
        if self.faces.around(point).is_empty() {
            return self.comes_at_joint(face, near, self.meeting(point, time)).then_some(time);
        }
        let at_end = start.outside <= end.outside;
        let farther = if at_end { end } else { start };
        if farther.outside <= 0.0 || !self.is_hardly_beyond(face, farther) {
            return None;
        }
        let at_farther = f64::from(u8::from(at_end));
        let normal = |face: u32| normalized(projection::area_normal(&self.faces.start(face, self.motion)));
        let own: Vec<[f64; 3]> = self.faces.around(point).iter().filter_map(|&own| normal(own)).collect();
        let looks_the_same_way =
            |other: u32| normal(other).is_some_and(|normal| own.iter().any(|own| dot(*own, normal) > SAME_WAY));
        let is_flush = |other: u32| self.is_across(face, &farther.weights, other) && looks_the_same_way(other);
        let comes = self.beside(face).any(is_flush)
            && self.comes_over((point, face), at_farther)
            && !self.passes_beside((point, face), near, at_farther);
        comes.then_some(time)
    }

    /// Whether the body of a point that is beyond the border of a face is over that face at a part of the step: one of its faces that look at the face leads from the
    /// point onto it. What passes beside a body, or beyond its tip, goes on beside it.
    fn comes_over(&self, (point, face): (u32, u32), time: f64) -> bool {
        let (corners, place) = (self.corners_at(face, time), self.place(point, time));
        let Some(normal) = normalized(projection::area_normal(&corners)) else { return false };
        let reach = 2.0 * HOLD * self.faces.size[face as usize];
        self.faces.around(point).iter().map(|&own| self.corners_at(own, time)).any(|own| {
            let looks = normalized(projection::area_normal(&own)).is_some_and(|own| dot(own, normal) < -OPPOSED);
            let along = subtract(projection::centre(&own), place);
            let part = (reach / dot(along, along).sqrt()).min(1.0);
            let inwards = || projection::project(&corners, add(place, scaled(along, part)));
            looks && inwards().is_some_and(|there| there.outside <= 0.0)
        })
    }

    /// Whether a point is beside a solid at a part of the step: beyond a border of a face, and the face across that border is looked at by one of the
    /// point's own. So is what a ridge of another block comes down on, which the other side of that will meet; noses of a fold stop each other.
    fn passes_beside(&self, (point, face): (u32, u32), near: &[Candidate], time: f64) -> bool {
        let near = if self.are_of_one_block(point, face) { &[] } else { near };
        self.borders_beyond((point, face), time, CLEARLY * self.faces.size[face as usize]).any(|border| {
            let normal = |other: u32| normalized(projection::area_normal(&self.faces.start(other, self.motion)));
            let others = self.beside(face).chain(faces_of(near)).filter(|&other| other != face);
            let mut sides = others.filter(|&other| self.has_border(other, &border)).filter_map(normal);
            sides.any(|normal| self.has_face_opposed(point, &normal, -OPPOSED))
        })
    }

    /// Borders of a face, by their ends, beyond which a point is at a part of the step by more than a length.
    fn borders_beyond(&self, (point, face): (u32, u32), time: f64, least: f64) -> impl Iterator<Item = [u32; 2]> {
        let (corners, place) = (self.corners_at(face, time), self.place(point, time));
        let ends = self.faces.corners[face as usize];
        let is_beyond = move |border: &usize| {
            let across = frame(&corners, *border).map(|[across, _]| across);
            across.is_some_and(|across| dot(subtract(place, corners[*border]), across) > least)
        };
        (0..4).filter(is_beyond).map(move |border| [ends[border], ends[(border + 1) % 4]])
    }

    /// Whether a point is at the border of a face, or hardly beyond, where a face of another body meets that border: the slit between them is narrow.
    /// Not so where that body covers the face, which then is a wall of the slit. The faces near the point are asked, which all ranks have that check it.
    pub(super) fn comes_at_joint(&self, face: u32, near: &[Candidate], meeting: Meeting) -> bool {
        let corners = self.corners_at(face, meeting.time);
        let Some(at) = projection::project(&corners, meeting.place) else { return false };
        if !self.is_hardly_beyond(face, &at) {
            return false;
        }
        let border = projection::foot(&corners, &at.weights);
        let meets = |other: u32| {
            let place = projection::project(&self.corners_at(other, meeting.time), border);
            let is_there = |place: Projection| {
                place.gap.abs() <= HOLD * self.faces.size[other as usize] && self.is_hardly_beyond(other, &place)
            };
            !self.faces.adjacent(face, other) && place.is_some_and(is_there)
        };
        faces_of(near).any(|other| other != face && meets(other)) && !self.is_covered(&corners, &at, near, meeting.time)
    }

    /// Whether another face has all the corners of a face that have a share in a foot on its border: it goes on there.
    pub(super) fn is_across(&self, face: u32, weights: &[f64; 4], other: u32) -> bool {
        let around = self.faces.corners[other as usize];
        let mut shares =
            self.faces.corners[face as usize].iter().zip(weights).filter(|(_, weight)| **weight > projection::TIE);
        shares.all(|(corner, _)| around.contains(corner))
    }

    /// Whether a point that comes through a face at its border slides in the plane of the face beside it: over the seam
    /// between two bodies whose surfaces are flush, where the sides are buried and nothing is in the way. A tip that slides does so, too, and in
    /// the inner corner of a body the face beside is that of another element. `through` is where the point is behind the face. Where they
    /// meet is asked of points without faces only.
    pub(super) fn slides_over(
        &self,
        (point, face): (u32, u32),
        near: &[Candidate],
        through: &Projection,
        meeting: impl FnOnce() -> Meeting,
    ) -> bool {
        if self.faces.around(point).is_empty() {
            return self.is_at_joint(face, near, meeting());
        }
        // Only sides are beside: what goes on in the plane of the face, or nearly so, is met as well, but for what turns away from the plane in which
        // the point stays.
        let corners = self.faces.start(face, self.motion);
        let (normal, foot) = (projection::area_normal(&corners), projection::foot(&corners, &through.weights));
        let is_side = |other: u32| {
            let of_other = projection::area_normal(&self.faces.start(other, self.motion));
            let square = dot(normal, normal) * dot(of_other, of_other);
            dot(normal, of_other) < OPPOSED * square.sqrt()
                || self.turns_away(face, other) && self.stays_above(point, other)
        };
        let is_across =
            |other: &u32| !self.faces.is_two_sided(*other) && self.is_across(face, &through.weights, *other);
        let sides = faces_of(near).filter(is_across).filter(|&other| is_side(other));
        self.beside(face).chain(sides).any(|other| self.slides_along((point, face), (through, foot), other))
    }

    /// Whether the middle of a face is behind the plane of another one.
    fn turns_away(&self, face: u32, other: u32) -> bool {
        let [own, other] = [face, other].map(|face| self.faces.start(face, self.motion));
        let normal = projection::area_normal(&other);
        let rise = dot(subtract(projection::centre(&own), projection::centre(&other)), normal);
        rise < -HOLD * self.faces.size[face as usize] * dot(normal, normal).sqrt()
    }

    /// Whether a point that may be in the plane of a face is not behind that at the end of the step, but for round-off: what is pressed on is not let by.
    fn stays_above(&self, point: u32, face: u32) -> bool {
        let reach = IN_SURFACE * self.faces.size[face as usize];
        self.projection_at_end(point, face).is_some_and(|end| end.gap >= -reach)
    }

    /// Whether a point that comes through one face slides in the plane of another, in which its foot is on the first: at their border. Where the first
    /// leans inwards, its foot is below that border by a part of how deep the point is behind it.
    fn slides_along(&self, (point, face): (u32, u32), (through, foot): (&Projection, [f64; 3]), other: u32) -> bool {
        if self.are_in_symmetry_plane(point, other) {
            return false;
        }
        let at = self.motion.start(point);
        let (corners, reach) = (self.faces.start(other, self.motion), SEAM * self.faces.size[other as usize]);
        let normal = projection::area_normal(&corners);
        let lean = -dot(through.normal, normal) / dot(normal, normal).sqrt();
        let below = lean.max(0.0) * (-through.gap).max(0.0);
        // The inside of a side is far from the faces beside it, which is cheap to see.
        let is_off = |place, reach| projection::is_off_plane(&corners, place, reach);
        if is_off(foot, reach + below) || is_off(at, reach) {
            return false;
        }
        let near = |place, reach| {
            projection::project(&corners, place).filter(|projection: &Projection| projection.gap.abs() <= reach)
        };
        // A tip slides only where it stays in the plane: the corner of what comes on is in several at once. What comes down on a rim is in the plane
        // beside it, too, but its body leads onto the face; so does what slides over a bend, into which it does not go.
        let is_over_face = || lean > -OPPOSED && self.comes_over((point, face), 0.0);
        let stays = || {
            let end = self.projection_at_end(point, other);
            end.is_some_and(|end| {
                end.gap >= -reach
                    && (self.has_face_opposed(point, &end.normal, -OPPOSED) && !is_over_face()
                        || self.is_tip_over(point, end.normal))
            })
        };
        near(foot, reach + below).is_some()
            && near(at, reach).is_some_and(|at| self.has_face_opposed(point, &at.normal, -FLUSH) || stays())
    }

    /// Whether all faces of a point are before a plane through it, whose normal is given.
    pub(super) fn is_tip_over(&self, point: u32, normal: [f64; 3]) -> bool {
        let at = self.motion.end(point);
        self.faces.around(point).iter().all(|&own| {
            let least = -ON_PLANE * self.faces.size[own as usize];
            self.faces.end(own, self.motion).into_iter().all(|corner| dot(subtract(corner, at), normal) >= least)
        })
    }

    /// Whether what has no faces of its own meets a side in a flush joint: on the surface beside it, where another body covers the side and has a surface
    /// beside that which looks the same way. The faces near the point are asked, which all ranks have that check it, and those of their elements.
    fn is_at_joint(&self, side: u32, near: &[Candidate], meeting: Meeting) -> bool {
        let corners = self.corners_at(side, meeting.time);
        let Some(own) = projection::project(&corners, meeting.place) else { return false };
        // Normals of the surfaces beside a side on which the point is.
        let surfaces = |side: u32| {
            self.beside(side).filter_map(move |surface| {
                let reach = HOLD * self.faces.size[surface as usize];
                let place = projection::project(&self.corners_at(surface, meeting.time), meeting.place)?;
                (place.gap.abs() <= reach && self.is_hardly_beyond(surface, &place)).then_some(place.normal)
            })
        };
        surfaces(side).any(|surface| {
            let goes_on = |other: u32| surfaces(other).any(|beyond| dot(beyond, surface) > FLUSH);
            let covers = |other: u32| {
                around(&corners, &own).iter().any(|&at| self.lies_against(other, at, own.normal, meeting.time))
            };
            faces_of(near).any(|other| covers(other) && goes_on(other))
                && self.is_covered(&corners, &own, near, meeting.time)
        })
    }

    /// Whether faces lie against a side, whose corners are given, on all sides of the foot of a point on that: bodies that touch with their edges
    /// alone, and the corner in which a body ends at another one, cover nothing.
    fn is_covered(&self, side: &[[f64; 3]; 4], on_side: &Projection, near: &[Candidate], time: f64) -> bool {
        around(side, on_side)
            .iter()
            .all(|&at| faces_of(near).any(|other| self.lies_against(other, at, on_side.normal, time)))
    }

    /// Whether a face lies against a place of a side, whose normal is given.
    fn lies_against(&self, other: u32, at: [f64; 3], normal: [f64; 3], time: f64) -> bool {
        let reach = SEAM * self.faces.size[other as usize];
        projection::project(&self.corners_at(other, time), at).is_some_and(|place| {
            dot(place.normal, normal) < -FLUSH && place.gap.abs() <= reach && place.outside <= reach
        })
    }

    /// Corners of a face at a part of the step, without contact.
    pub(super) fn corners_at(&self, face: u32, time: f64) -> [[f64; 3]; 4] {
        self.faces.corners[face as usize].map(|corner| self.place(corner, time))
    }
}

/// Places around the foot of a point on a side, whose corners are given: some way towards each of them.
fn around(side: &[[f64; 3]; 4], on_side: &Projection) -> [[f64; 3]; 4] {
    let foot = projection::foot(side, &on_side.weights);
    side.map(|corner| add(foot, scaled(subtract(corner, foot), 2.0 * HOLD)))
}
