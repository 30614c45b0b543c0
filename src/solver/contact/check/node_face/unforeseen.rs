//! Faces that a node meets only because of what other contacts do in the step: the motion without contact does not tell of them.
//!
//! What a face stops or pushes aside may come to another face, and what is struck may be pushed through what it lies on; a step later it is so far
//! that nobody could tell from which side it came. So such faces become constraints as well. They bear nothing unless the forces of the
//! others close their gaps. What a node meets that another face has stopped is remembered where it has borne a force; what lies on something else
//! has its turn in the next step.

use super::flush::Meeting;
use super::{DetectedContact, HOLD, NodeFaceCheck, OPPOSED, SAME_WAY_AT_DISTANCE, keep, push_back};
use crate::common::vector::{add, dot, subtract};
use crate::solver::contact::geometry::projection::{self, Projection};
use crate::solver::contact::search::locate::Candidate;

/// Time of a contact that is not foreseen, of a point that others stop: after all that are. That of a point which nothing else holds is still later.
pub const STOPPED: f64 = 2.0;
/// See [`STOPPED`].
pub const STRUCK: f64 = 3.0;
/// Cosine between the normals of two faces that are upright on each other, at most.
const UPRIGHT: f64 = 0.1;

impl NodeFaceCheck<'_> {
    /// Adds the faces that `point` would meet if the `contacts` found so far held it, or be as near to as what has left a face is still held. Where there
    /// are none, those of other blocks to which it is as near, if others may push it there. Of faces that push the same way the first is enough.
    pub(super) fn unforeseen(&self, point: u32, near: &[Candidate], contacts: &mut Vec<DetectedContact>) {
        let (free, held) = (self.motion.end(point), contacts.len());
        let push = |at, contact: &DetectedContact| add(at, push_back(&contact.projection, contact.tolerated));
        let end = contacts.iter().fold(free, push);
        // In folds that close, what is not yet met would be held too early.
        let own_block = if held == 0 { self.block_of(point) } else { None };
        for &Candidate { face, interface } in near {
            let is_known = contacts[..held].iter().any(|contact| contact.face == face);
            let is_own = own_block == Some(self.faces.block[face as usize]);
            if is_known || is_own || held == 0 && !self.may_be_pushed_to(point, face) {
                continue;
            }
            let corners = self.faces.end(face, self.motion);
            // Most of those around a point go on beside one that is known, which is enough.
            let normal = projection::area_normal(&corners);
            let length = dot(normal, normal).sqrt();
            let pushes_the_same_way =
                |known: &DetectedContact| dot(known.projection.normal, normal) > SAME_WAY_AT_DISTANCE * length;
            if contacts.iter().any(pushes_the_same_way) {
                continue;
            }
            if contacts[..held].iter().any(|contact| self.lies_below((face, &corners), end, contact)) {
                continue;
            }
            let (distance, least) = (self.faces.distance(point, face), keep(self.faces, face));
            if projection::is_out_of_reach(&corners, end, distance + least) {
                continue;
            }
            let Some(mut projection) = projection::project(&corners, end) else { continue };
            projection.gap -= distance;
            // What the motion without contact tells of a point that nothing holds has had its turn.
            let is_told = held == 0 && projection.gap < 0.0;
            if is_told || projection.gap >= least || !self.is_hardly_beyond(face, &projection) {
                continue;
            }
            projection.gap += dot(subtract(free, end), projection.normal);
            let Some(tolerated) = self.overlap_at_start(point, face, &projection) else { continue };
            if !self.faced(point, &projection.normal, self.rules[interface as usize])
                || self.slides_over((point, face), near, &projection, || Meeting { place: end, time: 1.0 })
            {
                continue;
            }
            let time = if held > 0 { STOPPED } else { STRUCK };
            contacts.push(DetectedContact { face, time, opposition: 0.0, projection, tolerated });
        }
    }

    /// The block of the faces around a point, `None` where it has none.
    fn block_of(&self, point: u32) -> Option<u32> {
        self.faces.around(point).first().map(|&own| self.faces.block[own as usize])
    }

    /// Whether the faces around a point are of the block of a face: they may be leaves of one fold.
    pub(super) fn are_of_one_block(&self, point: u32, face: u32) -> bool {
        self.block_of(point) == Some(self.faces.block[face as usize])
    }

    /// Whether nothing of a face, whose corners are given, rises over a point in its place as a contact pushes it: the side of the next body where
    /// what slides over a flush joint rests on both. Where a face looks at the one that pushes the point, it is not for it to rise.
    #[inline(always)]
    fn lies_below(&self, (face, corners): (u32, &[[f64; 3]; 4]), end: [f64; 3], holding: &DetectedContact) -> bool {
        let up = holding.projection.normal;
        let rises = |corner: &[f64; 3]| dot(subtract(*corner, end), up) > HOLD * self.faces.size[face as usize];
        let looks_at = || {
            let normal = projection::area_normal(corners);
            dot(normal, up) < -OPPOSED * dot(normal, normal).sqrt()
        };
        let pushes = holding.projection.gap < holding.tolerated;
        !(corners.iter().any(rises) || pushes && looks_at())
    }

    /// Whether what strikes another face around a point that nothing holds may push it to a face: not in the middle of the side of a solid, as what meets
    /// that side pushes its nodes into it, nor where all faces around the point look at that face or stand upright on it. Upright sides take
    /// their nodes along with what rubs them. Nodes of surfaces, rigid bodies and joints go with what is struck elsewhere.
    fn may_be_pushed_to(&self, point: u32, face: u32) -> bool {
        let are_all_harmless = || {
            let normal = projection::area_normal(&self.faces.end(face, self.motion));
            let cosine = if self.have_friction { -OPPOSED } else { UPRIGHT };
            let most = cosine * dot(normal, normal).sqrt();
            self.faces.around(point).iter().all(|&own| {
                let own = projection::area_normal(&self.faces.start(own, self.motion));
                dot(own, normal) < most * dot(own, own).sqrt()
            })
        };
        self.faces.around(point).is_empty()
            || self.is_carried_along(face)
            || self.is_carried(point)
            || !self.faces.is_amid_side(point) && !are_all_harmless()
    }

    /// Whether a point goes with others of a rigid body or a joint.
    pub(super) fn is_carried(&self, point: u32) -> bool {
        let (point, mobility) = (point as usize, &self.motion.mobility);
        mobility.of(point).is_some() || mobility.joint(point).is_some()
    }

    /// Whether what strikes a body elsewhere may push a face outwards at once.
    fn is_carried_along(&self, face: u32) -> bool {
        self.faces.is_two_sided(face)
            || self.faces.corners[face as usize].into_iter().any(|corner| self.is_carried(corner))
    }

    /// The overlap, a length of at most 0, with which a point begins the step in front of a face; `None` where it is not in front of it, or deeper than
    /// what others may have left in the step before. `met` has the foot and the normal of the place to which others push the point, and the gap of the end of
    /// the step without them; what foot and point go in the step is taken along that normal, which is exact but for what the face turns in the step.
    fn overlap_at_start(&self, point: u32, face: u32, met: &Projection) -> Option<f64> {
        let gap = met.gap - self.leaving(point, face, met);
        let begins = |start: Projection| self.is_hardly_beyond(face, &start) && self.begins_in_front(point, face);
        let is_in_front = gap > -HOLD * self.faces.size[face as usize]
            && (!self.faces.is_two_sided(face) || self.projection_at_start(point, face).is_some_and(begins));
        is_in_front.then_some(gap.min(0.0))
    }
}
