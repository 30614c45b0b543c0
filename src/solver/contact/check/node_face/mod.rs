//! Nodes against faces: which faces a slave node touches, where, how deep, and in which direction it must be moved.
//!
//! A point that comes anew is checked by motion: when does it come through the moving face from the front? A point
//! that has touched before is checked where it would be at the end of the step. Of several faces those count that
//! come first; ties go to the face that the point's body faces most, then to the lower number (Heinstein et al. 1993;
//! Attaway et al. 1996, figures 3 and 4).

mod newcomer;

use crate::common::vector::{add, dot, scaled, subtract};
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::enforcement::constraint::{Constraint, MEMBERS, Origin};
use crate::solver::contact::geometry::faces::Faces;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::geometry::projection::{self, Projection};
use crate::solver::contact::search::locate::{Candidate, Rule};
use crate::solver::contact::surface::pairings::Pairing;

/// No face.
pub const NONE: u32 = u32::MAX;

/// Faces that one point can touch at a time: three planes hold a point.
pub const MAX_FACES: usize = 3;

/// A point that has left its face by less than this part of half an element is still held by it, without force.
pub const KEEP: f64 = 0.05;

/// A point that has slid beyond its face by less than this part of its size is still held by it, unless another face
/// that goes on in the same way takes over.
const HOLD: f64 = 0.01;

/// A face whose middle is higher than this part of its size above the face beside it folds towards what is in front of that.
const HOLLOW: f64 = 0.05;

/// Two faces whose normals have a larger cosine between them push the same way; one of them is enough.
const SAME_WAY: f64 = 0.8;

/// The same of faces that are touched at a distance: in a hollow each of them reaches over the other, and a point held by one alone
/// would be nearer to the other by as much.
const SAME_WAY_AT_DISTANCE: f64 = 0.995;

/// Contact of a node with a face, remembered from step to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceContact {
    /// The face, or [`NONE`].
    pub face: u32,
    /// Overlap that is tolerated because it was not made by motion: a gap, a length of at most 0.
    pub tolerated: f64,
    /// What the contact carries.
    pub carried: Carried,
}

/// Of a node that touches nothing.
pub const NO_CONTACT: [FaceContact; MAX_FACES] =
    [FaceContact { face: NONE, tolerated: 0.0, carried: Carried::NOTHING }; MAX_FACES];

/// A node on a face, as the check has found it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DetectedContact {
    /// The face.
    pub face: u32,
    /// Part of the step after which it is touched; −1 where it has been touched before.
    pub time: f64,
    /// Cosine between the normals of point and face, −1 where they are opposed.
    pub opposition: f64,
    /// Where the point would be at the end of the step; the weights are those of the forces, see `projection::shares_along`.
    pub projection: Projection,
    /// Overlap that stays, a length of at most 0, see [`FaceContact`].
    pub tolerated: f64,
}

/// How far in front of a face a node that has left it is still held by it, a length.
fn keep(faces: &Faces, face: u32) -> f64 {
    KEEP * faces.depth[face as usize]
}

/// The detailed check of points against faces.
pub struct NodeFaceCheck<'a> {
    /// Motion of the nodes.
    pub motion: &'a NodeMotion,
    /// Faces.
    pub faces: &'a Faces,
    /// Rules of the interfaces, by number.
    pub rules: &'a [Rule],
    /// The farthest that a point or a corner goes in this step along an axis, a length.
    pub longest_path: f64,
}

/// Whether a face is one of those near a point.
fn is_near(near: &[Candidate], face: u32) -> bool {
    near.iter().any(|near| near.face == face)
}

/// The faces near a point.
fn faces_of(near: &[Candidate]) -> impl Iterator<Item = u32> + '_ {
    near.iter().map(|near| near.face)
}

impl NodeFaceCheck<'_> {
    /// Fills `contacts` with the faces that `point` touches, chosen and in order. `near` are the faces whose boxes over
    /// this step meet the point's; `past` the faces touched before. Where blocks say what holds, a face is met only by points one of
    /// whose own faces looks at it; the nodes of a side set do not bring all the faces of their body.
    #[inline(always)]
    pub fn point(
        &self,
        point: u32,
        near: &[Candidate],
        past: &[FaceContact; MAX_FACES],
        contacts: &mut Vec<DetectedContact>,
    ) {
        contacts.clear();
        if past[0].face != NONE {
            self.persistent(point, near, past, contacts);
        }
        let held = contacts.len();
        for &Candidate { face, interface } in near {
            // Faces around those that hold the point have had their turn.
            if contacts[..held].iter().all(|contact| contact.face != face && !self.faces.adjacent(contact.face, face)) {
                contacts.extend(self.newcomer(point, face, self.rules[interface as usize] == Rule::Blocks));
            }
        }
        if contacts.len() > 1 {
            self.choose(point, contacts);
        }
        for contact in contacts.iter_mut() {
            self.blend(near, contact);
            let (corners, start) = (self.faces.start(contact.face, self.motion), self.motion.start(point));
            if let Some(shares) = projection::shares_along(&corners, start, &contact.projection) {
                contact.projection.weights = shares;
                // Around a border only the nearest point of it is so far away: another one would let the point sink in a little
                // in every step in which it goes around.
                if !contact.projection.rounded {
                    let foot = projection::foot(&self.faces.end(contact.face, self.motion), &shares);
                    let apart = dot(subtract(self.motion.end(point), foot), contact.projection.normal);
                    contact.projection.gap = apart - self.faces.distance(point, contact.face);
                }
            }
        }
    }

    /// On a node or an edge that several faces share, which of them is met is nobody's choice: the normal is the mean of
    /// theirs, so that what is symmetric stays so.
    fn blend(&self, near: &[Candidate], contact: &mut DetectedContact) {
        if contact.projection.rounded {
            return;
        }
        // Another face that has the foot lacks at least one corner, which then has no weight to speak of.
        if contact.projection.weights.iter().all(|&weight| weight > 2.0 * projection::TIE) {
            return;
        }
        let corners = self.faces.corners[contact.face as usize];
        let unit = |face: u32| {
            let normal = projection::area_normal(&self.faces.end(face, self.motion));
            scaled(normal, 1.0 / dot(normal, normal).sqrt())
        };
        let shared = |face: u32| -> f64 {
            let other = self.faces.corners[face as usize];
            corners
                .iter()
                .zip(contact.projection.weights)
                .filter(|(corner, _)| other.contains(corner))
                .map(|(_, w)| w)
                .sum()
        };
        let mut sum = [0.0; 3];
        for face in faces_of(near).filter(|&face| shared(face) > 1.0 - projection::TIE) {
            let normal = unit(face);
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

    fn related(&self, past: u32, face: u32) -> bool {
        past != NONE && self.faces.adjacent(past, face)
    }

    /// Where a point stands against a face at the end of the step; its gap is what is left beyond the distance at which they
    /// touch.
    fn projection_at_end(&self, point: u32, face: u32) -> Option<Projection> {
        let mut projection = projection::project(&self.faces.end(face, self.motion), self.motion.end(point))?;
        projection.gap -= self.faces.distance(point, face);
        Some(projection)
    }

    /// The same at the end of the step, or at its beginning, round about the border where they touch at a distance.
    fn around_border(&self, point: u32, face: u32, at_end: bool) -> Option<Projection> {
        let distance = self.faces.distance(point, face);
        let (corners, at) = if at_end {
            (self.faces.end(face, self.motion), self.motion.end(point))
        } else {
            (self.faces.start(face, self.motion), self.motion.start(point))
        };
        let mut projection = projection::project(&corners, at)?;
        if distance > 0.0 {
            projection = projection.around_border(&corners, at, self.faces.borders_of(face));
            if projection.outside > 0.0 && projection.gap >= 0.0 {
                let from_border = projection.seen_from_border(&corners, at);
                let near = from_border.gap < distance + keep(self.faces, face);
                if near && self.is_ahead_of_ridge(face, &projection, at, at_end) {
                    projection = from_border;
                }
            }
        }
        projection.gap -= distance;
        Some(projection)
    }

    /// Whether a point beyond the border of a face is ahead of a ridge there: also beyond the border of the face that goes on. Where
    /// a surface is folded by more than twice 71 degrees, a wedge is left that neither face would see around its border.
    fn is_ahead_of_ridge(&self, face: u32, projection: &Projection, at: [f64; 3], at_end: bool) -> bool {
        let corners = self.faces.corners[face as usize];
        let [a, b] = projection.edge().map(|i| corners[i]);
        let is_beyond = |other: u32| {
            let corners =
                if at_end { self.faces.end(other, self.motion) } else { self.faces.start(other, self.motion) };
            projection::project(&corners, at).is_some_and(|projection| projection.outside > 0.0)
        };
        let goes_on = |other: &u32| {
            self.faces.corners[*other as usize].contains(&b) && self.faces.go_on(face, *other) == Some(true)
        };
        let mut beyond =
            self.faces.around(a).iter().filter(|other| goes_on(other)).map(|&other| is_beyond(other)).peekable();
        beyond.peek().is_some() && beyond.all(|beyond| beyond)
    }

    /// Whether a point that one face has held stays on the same side of a surface if another one holds it: across an edge the
    /// surface goes on, across a corner the point says where it is.
    fn stays_outside(&self, point: u32, old: u32, face: u32) -> bool {
        !self.faces.is_two_sided(face)
            || self.faces.go_on(old, face).unwrap_or_else(|| self.begins_in_front(point, face))
    }

    /// Whether a point begins the step on the side of a surface to which a face belongs. Where it is in the surface itself, it
    /// belongs to the top.
    fn begins_in_front(&self, point: u32, face: u32) -> bool {
        let start = projection::project(&self.faces.start(face, self.motion), self.motion.start(point));
        let top = self.faces.number[face as usize].is_multiple_of(6);
        start.is_some_and(|start| start.gap > 0.0 || start.gap == 0.0 && top)
    }

    /// Faces that held the point before, and those around them to which it may have moved on.
    fn persistent(
        &self,
        point: u32,
        near: &[Candidate],
        past: &[FaceContact; MAX_FACES],
        contacts: &mut Vec<DetectedContact>,
    ) {
        let mut left: Option<(u32, f64, Projection)> = None;
        for past in past.iter().filter(|past| past.face != NONE && is_near(near, past.face)) {
            let Some(projection) = self.projection_at_end(point, past.face) else { continue };
            if projection.outside == 0.0 {
                if self.in_reach(past.face, &projection, past.tolerated) {
                    contacts.push(self.held(past.face, projection, past.tolerated));
                }
            } else if self.is_beside(point, past.face, &projection) {
                contacts.extend(self.held_around(point, past.face, past.tolerated));
            } else if left.is_none() {
                left = Some((past.face, past.tolerated, projection));
            }
        }
        if let Some(left) = left.filter(|_| contacts.is_empty()) {
            self.moved_on(point, near, past, left, contacts);
        }
        self.still_around(point, near, past, contacts);
        // Of the faces around those that hold the point only those that fold towards it can hold it as well.
        self.folds(point, near, contacts);
    }

    /// Whether a point stands beside the end of a surface, whose projection counts its gap from where they touch.
    fn is_beside(&self, point: u32, face: u32, projection: &Projection) -> bool {
        let distance = self.faces.distance(point, face);
        distance > 0.0 && projection.is_beside(projection.gap + distance, self.faces.borders_of(face))
    }

    /// A point that has left its faces: on to a face around the first of them, or held by that as it was.
    fn moved_on(
        &self,
        point: u32,
        near: &[Candidate],
        past: &[FaceContact; MAX_FACES],
        (old, tolerated, left): (u32, f64, Projection),
        contacts: &mut Vec<DetectedContact>,
    ) {
        let (slightly, normal) = (left.outside <= HOLD * self.faces.size[old as usize], left.normal);
        let (mut behind, mut rises) = (false, false);
        let mut next: Option<(u32, Projection, (bool, f64, f64))> = None;
        let to = |&face: &u32| {
            self.related(old, face) && past.iter().all(|p| p.face != face) && self.stays_outside(point, old, face)
        };
        for face in faces_of(near).filter(to) {
            // Around a sharp corner the normal must not change before the point has really slid off: it would be a kick.
            let Some(projection) = self.projection_at_end(point, face) else { continue };
            let goes_on = self.goes_on(old, face, &left, &projection);
            if slightly && !goes_on {
                continue;
            }
            if projection.gap < 0.0 && projection.outside <= 2.0 * projection.gap.abs() {
                behind = true;
                rises |= self.rises(old, face, normal);
            }
            // What slides along a sharp edge of a solid stays as far beyond as on the face that it leaves, before it goes around
            // the corner. In a plane of symmetry, where faces need not stand upright, feet fall beside them, and the face in the
            // plane has its gap closed for ever. Surfaces are round at their borders.
            let is_solid = !self.faces.is_two_sided(old) && !self.faces.is_two_sided(face);
            let goes_around = is_solid && !goes_on;
            let beyond = if is_solid && !slightly && goes_on && self.faces.distance(point, face) == 0.0 {
                HOLD * self.faces.size[face as usize]
            } else {
                0.0
            };
            let found = (goes_around, projection.outside, projection.gap.abs());
            if projection.outside <= beyond
                && self.in_reach(face, &projection, tolerated)
                && next.is_none_or(|(_, _, best)| found < best)
            {
                next = Some((face, projection, found));
            }
        }
        match next {
            Some((face, projection, _)) => contacts.push(self.held(face, projection, tolerated)),
            None if slightly && self.in_reach(old, &left, tolerated) => {
                contacts.push(self.held(old, left, tolerated));
            }
            None => {
                // Behind the edge of a hollow a point is behind both faces and its foot beyond both. Around a bend of a surface it
                // is as well, where it is nearer than they touch.
                let deep = behind && left.gap < 0.0 && left.outside <= 2.0 * left.gap.abs();
                let flat = (deep && self.in_reach(old, &left, tolerated)).then(|| self.held(old, left, tolerated));
                let around = || self.held_around(point, old, tolerated);
                contacts.extend(if rises { flat.or_else(around) } else { around().or(flat) });
            }
        }
    }

    /// A point that a surface has held around its border is so as long as it is near the border, whatever else holds it.
    fn still_around(
        &self,
        point: u32,
        near: &[Candidate],
        past: &[FaceContact; MAX_FACES],
        contacts: &mut Vec<DetectedContact>,
    ) {
        for past in past.iter().filter(|past| past.face != NONE && self.faces.is_two_sided(past.face)) {
            let another = contacts.iter().all(|contact| contact.face != past.face);
            if another && is_near(near, past.face) {
                contacts.extend(self.held_around(point, past.face, past.tolerated));
            }
        }
    }

    /// A point that is held around the border of the face that it leaves, or of none.
    fn held_around(&self, point: u32, old: u32, tolerated: f64) -> Option<DetectedContact> {
        let end = self.around_border(point, old, true)?;
        (end.rounded && self.in_reach(old, &end, tolerated)).then(|| self.held(old, end, tolerated))
    }

    /// Whether a point that leaves one face goes on to another without turning around a sharp corner.
    fn goes_on(&self, old: u32, face: u32, projection: &Projection, next: &Projection) -> bool {
        dot(projection.normal, next.normal) > SAME_WAY || self.rises(old, face, projection.normal)
    }

    /// Whether a face lies in front of another one, of this normal: they make a hollow.
    fn rises(&self, old: u32, face: u32, normal: [f64; 3]) -> bool {
        let middle = |face| projection::centre(&self.faces.end(face, self.motion));
        dot(subtract(middle(face), middle(old)), normal) > 0.0
    }

    /// Adds faces next to those that hold the point, when they fold towards it and it would be behind them.
    fn folds(&self, point: u32, near: &[Candidate], contacts: &mut Vec<DetectedContact>) {
        let held = contacts.len();
        for i in 0..held {
            let old = contacts[i];
            let middle = projection::centre(&self.faces.end(old.face, self.motion));
            for face in faces_of(near).filter(|&face| face != old.face && self.faces.adjacent(old.face, face)) {
                let corners = self.faces.end(face, self.motion);
                let hollow = dot(subtract(projection::centre(&corners), middle), old.projection.normal) > 0.0;
                if !hollow || self.is_in_front(point, face) || contacts.iter().any(|contact| contact.face == face) {
                    continue;
                }
                if !self.stays_outside(point, old.face, face) {
                    continue;
                }
                let Some(projection) = self.around_border(point, face, true) else { continue };
                // In a corner of a solid, what is a little behind the one is a little beyond the border of the other.
                let is_corner =
                    !self.faces.is_two_sided(face) && dot(old.projection.normal, projection.normal) < SAME_WAY;
                let beyond = if is_corner { HOLD * self.faces.size[face as usize] } else { 0.0 };
                if projection.outside <= beyond && projection.gap < 0.0 && self.in_reach(face, &projection, 0.0) {
                    contacts.push(self.held(face, projection, 0.0));
                }
            }
        }
    }

    fn held(&self, face: u32, projection: Projection, tolerated: f64) -> DetectedContact {
        // What has opened does not close again for nothing.
        DetectedContact {
            face,
            time: -1.0,
            opposition: 0.0,
            tolerated: tolerated.max(projection.gap.min(0.0)),
            projection,
        }
    }

    /// Neither away from the face nor so deep that it must have come from elsewhere.
    fn in_reach(&self, face: u32, projection: &Projection, tolerated: f64) -> bool {
        projection.gap < keep(self.faces, face) + tolerated && projection.gap > -self.faces.depth[face as usize]
    }

    fn opposition(&self, point: u32, projection: &Projection) -> f64 {
        let normal = self.faces.point_normal(point, self.motion);
        let length = dot(normal, normal).sqrt();
        // A free node faces everything.
        if length > 0.0 { dot(normal, projection.normal) / length } else { -1.0 }
    }

    /// Puts contacts in order and keeps those that push in directions of their own.
    fn choose(&self, point: u32, contacts: &mut Vec<DetectedContact>) {
        for contact in contacts.iter_mut() {
            contact.opposition = self.opposition(point, &contact.projection);
        }
        let number = |contact: &DetectedContact| self.faces.number[contact.face as usize];
        contacts.sort_by(|a, b| {
            a.time.total_cmp(&b.time).then(a.opposition.total_cmp(&b.opposition)).then(number(a).cmp(&number(b)))
        });
        let mut kept = 0;
        for i in 0..contacts.len() {
            let contact = contacts[i];
            let same_way = if self.faces.distance(point, contact.face) > 0.0 { SAME_WAY_AT_DISTANCE } else { SAME_WAY };
            if kept < MAX_FACES && contacts[..kept].iter().all(|other| self.apart(other, &contact, same_way)) {
                contacts[kept] = contact;
                kept += 1;
            }
        }
        contacts.truncate(kept);
    }

    /// Whether a face holds a point in a way that the one chosen before does not: it pushes another way, and does not
    /// merely lie around the corner of the same body.
    fn apart(&self, first: &DetectedContact, second: &DetectedContact, same_way: f64) -> bool {
        if dot(first.projection.normal, second.projection.normal) > same_way {
            return false;
        }
        if !self.faces.adjacent(first.face, second.face) {
            return true;
        }
        let middle = |face| projection::centre(&self.faces.end(face, self.motion));
        let rise = dot(subtract(middle(second.face), middle(first.face)), first.projection.normal);
        // What is flat on both sides of an edge is not round there.
        let round = first.projection.rounded || second.projection.rounded;
        rise > if round { HOLLOW * self.faces.size[second.face as usize] } else { 0.0 }
    }
}

/// The constraint of a point on a face. `None` where the point is to be the master only.
pub fn constraint(faces: &Faces, pairing: Pairing, point: u32, contact: &DetectedContact) -> Option<Constraint> {
    let face = contact.face as usize;
    // A point without faces of its own cannot be the master of anything.
    let share = if faces.around(point).is_empty() { 1.0 } else { pairing.share };
    if share <= 0.0 {
        return None;
    }
    let mut constraint = Constraint {
        members: [point; MEMBERS],
        weights: [1.0; MEMBERS],
        count: MEMBERS,
        normal: contact.projection.normal,
        gap: contact.projection.gap - contact.tolerated,
        growth: 0.0,
        persists: contact.time < 0.0,
        size: faces.size[face],
        share,
        friction: pairing.friction,
        carried: Carried::NOTHING,
        origin: Origin::Face(point, 0),
    };
    constraint.members[1..].copy_from_slice(&faces.corners[face]);
    for (weight, n) in constraint.weights[1..].iter_mut().zip(contact.projection.weights) {
        *weight = -n;
    }
    Some(constraint)
}
