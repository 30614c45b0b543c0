//! Faces that a node meets only because of what other contacts do in the step: the motion without contact does not tell of them.
//!
//! What a face stops or pushes aside may come to another face, and what is struck may be pushed through what it lies on; a step later it is so far
//! that nobody could tell from which side it came. So such faces become constraints as well. They bear nothing unless the forces of the
//! others close their gaps. What a node meets that another face has stopped is remembered where it has borne a force; what lies on something else
//! has its turn in the next step.

use super::flush::Meeting;
use super::{DetectedContact, HOLD, NodeFaceCheck, keep, push_back};
use crate::common::vector::{add, dot, subtract};
use crate::solver::contact::geometry::projection;
use crate::solver::contact::search::locate::Candidate;

/// Time of a contact that is not foreseen, of a point that others stop: after all that are. That of a point which nothing else holds is still later.
pub const STOPPED: f64 = 2.0;
/// See [`STOPPED`].
pub const STRUCK: f64 = 3.0;
/// Cosine of the angle within which the normals of two faces are opposed.
const OPPOSED: f64 = 0.5;

impl NodeFaceCheck<'_> {
    /// Adds the faces that `point` would meet if the `contacts` found so far held it, or be as near to as what has left a face is still held. Where there
    /// are none, those of other blocks to which it is as near.
    pub(super) fn unforeseen(&self, point: u32, near: &[Candidate], contacts: &mut Vec<DetectedContact>) {
        let (free, held) = (self.motion.end(point), contacts.len());
        let push = |at, contact: &DetectedContact| add(at, push_back(&contact.projection, contact.tolerated));
        let end = contacts.iter().fold(free, push);
        for &Candidate { face, interface } in near {
            let is_known = contacts[..held].iter().any(|contact| contact.face == face);
            if is_known || held == 0 && self.is_of_same_block(point, face) {
                continue;
            }
            let corners = self.faces.end(face, self.motion);
            let (distance, least) = (self.faces.distance(point, face), keep(self.faces, face));
            if projection::is_out_of_reach(&corners, end, distance + least) {
                continue;
            }
            let Some(mut projection) = projection::project(&corners, end) else { continue };
            let gap = projection.gap - distance;
            // What the motion without contact tells of a point that nothing holds has had its turn.
            let is_told = held == 0 && gap < 0.0;
            if is_told || gap >= least || !self.is_hardly_beyond(face, &projection) {
                continue;
            }
            let Some(tolerated) = self.overlap_at_start(point, face) else { continue };
            if contacts[..held].iter().any(|contact| self.lies_below(face, (end, &projection.normal), contact))
                || self.slides_over((point, face), near, &projection.weights, || Meeting { place: end, time: 1.0 })
                || !self.faced(point, &projection.normal, self.rules[interface as usize])
            {
                continue;
            }
            projection.gap = gap + dot(subtract(free, end), projection.normal);
            let time = if held > 0 { STOPPED } else { STRUCK };
            contacts.push(DetectedContact { face, time, opposition: 0.0, projection, tolerated });
        }
    }

    /// Whether a face is of the block of a point: in folds that close, what is not yet met would be held too early.
    fn is_of_same_block(&self, point: u32, face: u32) -> bool {
        let block = |face: u32| self.faces.block[face as usize];
        self.faces.around(point).first().is_some_and(|&own| block(own) == block(face))
    }

    /// Whether nothing of a face, whose normal is given, rises over a point in its place as a contact pushes it: the side of the next body where what
    /// slides over a flush joint rests on both. Where a face looks at the one that pushes the point, it is not for it to rise.
    fn lies_below(&self, face: u32, (end, normal): ([f64; 3], &[f64; 3]), holding: &DetectedContact) -> bool {
        let up = holding.projection.normal;
        let rises = |corner: [f64; 3]| dot(subtract(corner, end), up) > HOLD * self.faces.size[face as usize];
        let looks_at = holding.projection.gap < holding.tolerated && dot(*normal, up) < -OPPOSED;
        !looks_at && !self.faces.end(face, self.motion).into_iter().any(rises)
    }

    /// The overlap, a length of at most 0, with which a point begins the step over the front of a face; `None` where it is not over it, or deeper than
    /// what others may have left in the step before.
    fn overlap_at_start(&self, point: u32, face: u32) -> Option<f64> {
        let start = self.projection_at_start(point, face).filter(|start| self.is_hardly_beyond(face, start))?;
        let gap = start.gap - self.faces.distance(point, face);
        let is_in_front = gap > -HOLD * self.faces.size[face as usize]
            && (!self.faces.is_two_sided(face) || self.begins_in_front(point, face));
        is_in_front.then_some(gap.min(0.0))
    }
}
