//! The direction in which a face pushes a point whose foot is on its border, where other faces go on.

use super::super::FLUSH;
use super::flush::ON_PLANE;
use super::{BESIDE, DetectedContact, EXACTLY, IN_SURFACE, MAX_FACES, NodeFaceCheck, SAME_WAY, faces_of};
use crate::common::vector::{add, dot, normalized, scaled, subtract};
use crate::solver::contact::geometry::projection;
use crate::solver::contact::search::locate::Candidate;

/// Faces whose normals have a larger cosine between them are parallel but for what a ridge that hardly turns changes.
const PARALLEL: f64 = 0.999;

/// A face that makes a smaller sine than this with the direction across a ridge is at the end of what the ridge lies on.
const ACROSS: f64 = 0.1;

impl NodeFaceCheck<'_> {
    /// On a node or an edge that several faces share, which of them is met is nobody's choice: the normal is the mean of
    /// theirs, so that what is symmetric stays so; or on a sharp ridge that of the point's own surface, on which it lies. Faces of a `fitting`
    /// corner, that of this contact among them, push for themselves. The shares of the corners in a place on such a ridge, `None` elsewhere.
    pub(super) fn blend(
        &self,
        point: u32,
        near: &[Candidate],
        fitting: [u32; MAX_FACES],
        contact: &mut DetectedContact,
    ) -> Option<[f64; 4]> {
        if contact.projection.rounded {
            return None;
        }
        let weights = self.weights_on_border(point, contact)?;
        let own = self.faces.corners[contact.face as usize];
        // What the foot has of its weights at the corners of this face that another one shares, or at one of them.
        let shared = |corners: &[u32]| -> f64 {
            own.iter().zip(weights).filter(|(corner, _)| corners.contains(corner)).map(|(_, weight)| weight).sum()
        };
        let begins_in_overlap = self.begins_in_overlap(contact);
        let (mut sum, mut is_sharp) = ([0.0; 3], false);
        let goes_on = |face: &u32| {
            let fits = begins_in_overlap && *face != contact.face && fitting.contains(face);
            !fits && shared(&self.faces.corners[*face as usize]) > 1.0 - projection::TIE
        };
        for face in faces_of(near).filter(goes_on) {
            let weights = self.faces.corners[face as usize].map(|corner| shared(&[corner]));
            let end = self.faces.end(face, self.motion);
            // Folds of surfaces are pinched sooner along upright normals (docs/decisions.md, "What slides on a solid").
            let normal = if self.faces.is_two_sided(face) {
                normalized(projection::area_normal(&end)).unwrap_or_default()
            } else {
                projection::normal_on_border(&end, &weights)
            };
            match dot(normal, contact.projection.normal) > SAME_WAY {
                true => sum = add(sum, normal),
                false => is_sharp = true,
            }
        }
        let around = || faces_of(near).filter(goes_on);
        if is_sharp && let Some(normal) = self.normal_on_ridge(point, contact, &weights, around) {
            contact.projection.normal = normal;
            return Some(weights);
        }
        let length = dot(sum, sum).sqrt();
        // The face itself is one of them.
        if length > 1.5 {
            contact.projection.normal = scaled(sum, 1.0 / length);
        }
        None
    }

    /// Whether the mesh has a point in the face of a contact by more than round-off.
    pub(super) fn begins_in_overlap(&self, contact: &DetectedContact) -> bool {
        contact.tolerated < -IN_SURFACE * self.faces.size[contact.face as usize]
    }

    /// Against the normals of those faces of a point on which a ridge or a tip of the other body rests: all that goes on `around` the foot, which has these weights
    /// on the face of the contact, is behind the plane of such a face. `None` where the place is not flat across the ridge but has faces that turn away from each other, as at
    /// a rim along it, where all lie flat on the face of the contact, and where the point is a tip itself that the face of the contact pushes straight.
    fn normal_on_ridge<I: Iterator<Item = u32>>(
        &self,
        point: u32,
        contact: &DetectedContact,
        weights: &[f64; 4],
        around: impl Fn() -> I,
    ) -> Option<[f64; 3]> {
        // Noses of a fold keep to the flanks on which they are.
        let is_fold = self.are_of_one_block(point, contact.face);
        if self.faces.is_two_sided(contact.face) || is_fold || self.is_tip_over(point, contact.projection.normal) {
            return None;
        }
        let corners = self.faces.end(contact.face, self.motion);
        let foot = projection::foot(&corners, weights);
        let along = along_border(&corners, weights);
        let least = ON_PLANE * self.faces.size[contact.face as usize];
        let rests_on = |direction: &[f64; 3]| {
            let is_behind = |corner: [f64; 3]| dot(subtract(corner, foot), *direction) <= least;
            around().all(|face| self.faces.end(face, self.motion).into_iter().all(is_behind))
        };
        let (mut first, mut sum) = (None, [0.0; 3]);
        for &own in self.faces.around(point) {
            let Some(direction) = self.support(own, along, around()) else { continue };
            if !rests_on(&direction) {
                return None;
            }
            let middle = projection::centre(&self.faces.end(own, self.motion));
            let (one, middle_of_one) = *first.get_or_insert((direction, middle));
            // In a hollow all of them rest on what fits into it; where the mesh has it in overlap each flank lifts its own.
            let turns_away = || dot(subtract(middle, middle_of_one), one) >= 0.0;
            if dot(direction, one) <= SAME_WAY && (turns_away() || self.begins_in_overlap(contact)) {
                return None;
            }
            sum = add(sum, direction);
        }
        let normal = normalized(sum).filter(|sum| dot(*sum, contact.projection.normal) <= PARALLEL)?;
        // Along a normal from which the face is hardly seen no shares of its corners meet the point, and forces would turn both.
        let mut along_it = contact.projection;
        along_it.normal = normal;
        projection::shares_along(&self.faces.start(contact.face, self.motion), self.motion.start(point), &along_it)?;
        Some(normal)
    }

    /// Against the normal of a face of a point, across a ridge that runs along a direction and lies on it. `None` of a face at the end of what the ridge lies on, and of
    /// one that is flush with a face `around` the foot: what ends where the ridge does.
    fn support(&self, own: u32, along: [f64; 3], mut around: impl Iterator<Item = u32>) -> Option<[f64; 3]> {
        let normal_of = |face: u32| normalized(projection::area_normal(&self.faces.end(face, self.motion)));
        let normal = normal_of(own)?;
        let upright = subtract(normal, scaled(along, dot(normal, along)));
        let is_flush = |face: u32| normal_of(face).is_some_and(|other| dot(other, normal) > FLUSH);
        if dot(upright, upright) <= ACROSS * ACROSS || around.any(is_flush) {
            return None;
        }
        normalized(scaled(upright, -1.0))
    }

    /// Shares of the corners of a face in the foot of a point on its border, which other faces have as well: they lack at least one corner, which then has
    /// no weight to speak of. `None` where the foot is in the face. What comes through a node deeply in one step has its foot exactly there when they meet,
    /// and at the end of the step beside it, by less than it is deep.
    fn weights_on_border(&self, point: u32, contact: &DetectedContact) -> Option<[f64; 4]> {
        let end = contact.projection;
        let within = |least: f64| end.weights.iter().any(|&weight| weight <= least);
        let beside = -end.gap / self.faces.size[contact.face as usize];
        if beside > BESIDE && contact.time <= 1.0 && within(beside.max(2.0 * projection::TIE)) {
            let meeting = self.meeting(point, contact.time.max(0.0));
            let at = projection::project(&self.corners_at(contact.face, meeting.time), meeting.place)?;
            if at.weights.iter().any(|&weight| weight <= EXACTLY) {
                return Some(at.weights);
            }
        }
        within(2.0 * projection::TIE).then_some(end.weights)
    }
}

/// The direction of the border on which a foot is, a unit vector; zero where it is on a node.
fn along_border(corners: &[[f64; 3]; 4], weights: &[f64; 4]) -> [f64; 3] {
    let mut ends =
        corners.iter().zip(weights).filter(|(_, weight)| **weight > projection::TIE).map(|(corner, _)| *corner);
    match (ends.next(), ends.next()) {
        (Some(from), Some(to)) => normalized(subtract(to, from)).unwrap_or_default(),
        _ => [0.0; 3],
    }
}
