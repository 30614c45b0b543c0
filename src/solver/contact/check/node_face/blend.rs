//! The direction in which a face pushes a point whose foot is on its border, where other faces go on.

use super::{BESIDE, DetectedContact, EXACTLY, IN_SURFACE, MAX_FACES, NodeFaceCheck, SAME_WAY, faces_of};
use crate::common::vector::{add, dot, normalized, scaled};
use crate::solver::contact::geometry::projection;
use crate::solver::contact::search::locate::Candidate;

impl NodeFaceCheck<'_> {
    /// On a node or an edge that several faces share, which of them is met is nobody's choice: the normal is the mean of
    /// theirs, so that what is symmetric stays so. Faces of a `fitting` corner, that of this contact among them, push for
    /// themselves.
    pub(super) fn blend(
        &self,
        point: u32,
        near: &[Candidate],
        fitting: [u32; MAX_FACES],
        contact: &mut DetectedContact,
    ) {
        if contact.projection.rounded {
            return;
        }
        let Some(weights) = self.weights_on_border(point, contact) else { return };
        let own = self.faces.corners[contact.face as usize];
        // What the foot has of its weights at the corners of this face that another one shares, or at one of them.
        let shared = |corners: &[u32]| -> f64 {
            own.iter().zip(weights).filter(|(corner, _)| corners.contains(corner)).map(|(_, weight)| weight).sum()
        };
        let begins_in_overlap = self.begins_in_overlap(contact);
        let mut sum = [0.0; 3];
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
            if dot(normal, contact.projection.normal) > SAME_WAY {
                sum = add(sum, normal);
            }
        }
        let length = dot(sum, sum).sqrt();
        // The face itself is one of them.
        if length > 1.5 {
            contact.projection.normal = scaled(sum, 1.0 / length);
        }
    }

    /// Whether the mesh has a point in the face of a contact by more than round-off.
    pub(super) fn begins_in_overlap(&self, contact: &DetectedContact) -> bool {
        contact.tolerated < -IN_SURFACE * self.faces.size[contact.face as usize]
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
