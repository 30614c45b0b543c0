//! Nodes against faces: which faces a slave node touches, where, how deep, and in which direction it must be moved.
//!
//! A point that comes anew is checked by motion: when does it come through the moving face from the front? A point
//! that has touched before is checked where it would be at the end of the step. Of several faces those count that
//! come first, or as good as first; of these the face that the point's body faces most, of surfaces the nearer one, then the lower number
//! (Heinstein et al. 1993; Attaway et al. 1996, figures 3 and 4).

mod blend;
mod facing;
mod flush;
mod newcomer;
mod persistent;
mod ridge;
mod seam;
mod symmetry;
pub mod unforeseen;
mod way_out;

pub(super) use facing::FACING;

use crate::common::vector::{dot, scaled, subtract};
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

/// Part of a step within which faces are touched at the same time: a corner that meets a corner comes through all faces there at once,
/// and round-off would choose one that goes by.
const AT_ONCE: f64 = 1e-3;

/// What comes through a node by less than this part of a face's size has its foot at that node to well within [`projection::TIE`].
const BESIDE: f64 = 0.1 * projection::TIE;

/// A corner with less than this share in a foot has none but for round-off.
const EXACTLY: f64 = 1e-9;

/// Two faces whose normals have a larger cosine between them push the same way; one of them is enough.
const SAME_WAY: f64 = 0.8;

/// The same of faces that are touched at a distance: in a hollow each of them reaches over the other, and a point held by one alone
/// would be nearer to the other by as much.
const SAME_WAY_AT_DISTANCE: f64 = 0.995;

/// The same of faces of a solid that make a hollow, as the facets of a bore: either pushes what is in the corner into the other.
const SAME_WAY_IN_HOLLOW: f64 = 0.98;

/// Two faces whose normals have a cosine below minus this between them look at each other.
const OPPOSED: f64 = 0.5;

/// A point that is nearer to the middle of a surface than this part of a face's size is on neither side; a cosine below it is round-off.
const IN_SURFACE: f64 = 1e-9;

/// A sum of the area normals around a node that is shorter than this part of a face's area is round-off.
const NO_NORMAL: f64 = 1e-9;

/// Contact of a node with a face, remembered from step to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceContact {
    /// The face, or [`NONE`].
    pub face: u32,
    /// Overlap that is tolerated because it was not made by motion: a gap, a length of at most 0.
    pub tolerated: f64,
    /// Whether it leaves the two nodes that it joins to the contact the other way; see `enforcement::node_pairs`.
    pub yields: bool,
    /// What the contact carries.
    pub carried: Carried,
}

/// Of a node that touches nothing.
pub const NO_CONTACT: [FaceContact; MAX_FACES] =
    [FaceContact { face: NONE, tolerated: 0.0, yields: false, carried: Carried::NOTHING }; MAX_FACES];

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
    /// Whether edges that stand out hold each other.
    pub edges_hold: bool,
    /// Whether any two bodies rub.
    pub have_friction: bool,
}

/// Whether a face is one of those near a point.
fn is_near(near: &[Candidate], face: u32) -> bool {
    near.iter().any(|near| near.face == face)
}

/// The way, a vector, along which a face pushes back a point that is deeper than it tolerates, an overlap of at most 0.
fn push_back(projection: &Projection, tolerated: f64) -> [f64; 3] {
    scaled(projection.normal, (tolerated - projection.gap).max(0.0))
}

/// The faces near a point.
fn faces_of(near: &[Candidate]) -> impl Iterator<Item = u32> + '_ {
    near.iter().map(|near| near.face)
}

impl NodeFaceCheck<'_> {
    /// Fills `contacts` with the faces that `point` touches, chosen and in order. `near` are the faces whose boxes over
    /// this step meet the point's; `past` the faces touched before.
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
                let found = self.newcomer((point, face), near, self.rules[interface as usize]);
                contacts.extend(found.filter(|_| !self.is_behind_flank(point, face, near)));
            }
        }
        self.unforeseen(point, near, contacts);
        if contacts.len() > 1 {
            self.choose(point, contacts);
        }
        // Where meshes overlap, each flank of a corner lifts what overlaps with itself.
        let mut fitting = [NONE; MAX_FACES];
        let overlapping = contacts.iter().filter(|contact| self.begins_in_overlap(contact));
        fitting.iter_mut().zip(overlapping).for_each(|(face, contact)| *face = contact.face);
        for contact in contacts.iter_mut() {
            let on_ridge = self.blend(point, near, fitting, contact);
            let (corners, start) = (self.faces.start(contact.face, self.motion), self.motion.start(point));
            if let Some(shares) = projection::shares_along(&corners, start, &contact.projection) {
                contact.projection.weights = shares;
                let normal = contact.projection.normal;
                let gap_to = |shares: &[f64; 4]| {
                    let foot = projection::foot(&self.faces.end(contact.face, self.motion), shares);
                    dot(subtract(self.motion.end(point), foot), normal) - self.faces.distance(point, contact.face)
                };
                // Around a border only the nearest point of it is so far away: another one would let the point sink in a little
                // in every step in which it goes around.
                if !contact.projection.rounded {
                    contact.projection.gap = gap_to(&shares);
                }
                // The face goes no farther than its ridge, which is what the point meets.
                if let Some(on_ridge) = on_ridge {
                    contact.projection.gap = contact.projection.gap.max(gap_to(&on_ridge));
                }
            }
        }
    }

    /// Whether a face has both ends of a border.
    fn has_border(&self, face: u32, border: &[u32; 2]) -> bool {
        border.iter().all(|end| self.faces.corners[face as usize].contains(end))
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

    /// Where it stands at its beginning, its gap that to the face itself.
    fn projection_at_start(&self, point: u32, face: u32) -> Option<Projection> {
        projection::project(&self.faces.start(face, self.motion), self.motion.start(point))
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

    /// Whether a point begins the step on the side of a surface to which a face belongs. Where it is in the surface itself, as a mesh may have
    /// it, it belongs to the side at which its own body looks, or else to that from which it comes, or else to the top.
    fn begins_in_front(&self, point: u32, face: u32) -> bool {
        let Some(start) = self.projection_at_start(point, face) else { return false };
        if start.gap.abs() > IN_SURFACE * self.faces.size[face as usize] || !self.faces.is_two_sided(face) {
            return start.gap > 0.0;
        }
        let cosine = if self.faces.is_on_surface(point) { 0.0 } else { self.opposition(point, &start) };
        if cosine.abs() > IN_SURFACE && !self.faces.around(point).is_empty() {
            return cosine < 0.0;
        }
        let leaves = self.leaving(point, face, &start);
        leaves < 0.0 || leaves == 0.0 && self.faces.number[face as usize].is_multiple_of(6)
    }

    /// How far a point would go in the step away from the foot that it has on a face, along its normal: a length.
    fn leaving(&self, point: u32, face: u32, start: &Projection) -> f64 {
        let ([before, after], at) =
            ([self.faces.start(face, self.motion), self.faces.end(face, self.motion)], &start.weights);
        let of_foot = subtract(projection::foot(&after, at), projection::foot(&before, at));
        dot(subtract(subtract(self.motion.end(point), self.motion.start(point)), of_foot), start.normal)
    }

    /// Whether a point that a face has held before still is in its reach. What begins the step at a face comes from there, however far it
    /// would go in the step: what is pressed hardest would go farthest, by more than the thickness of a squashed or a rigid body.
    fn still_in_reach(&self, point: u32, face: u32, projection: &Projection, tolerated: f64) -> bool {
        if self.in_reach(face, projection, tolerated) {
            return true;
        }
        let begins = |mut start: Projection| {
            start.gap -= self.faces.distance(point, face);
            self.is_hardly_beyond(face, &start) && self.in_reach(face, &start, tolerated)
        };
        projection.gap < 0.0 && self.projection_at_start(point, face).is_some_and(begins)
    }

    /// Whether a foot is on a face or hardly beyond its border.
    fn is_hardly_beyond(&self, face: u32, projection: &Projection) -> bool {
        projection.outside <= HOLD * self.faces.size[face as usize]
    }

    /// Neither away from the face nor so deep that it must have come from elsewhere.
    fn in_reach(&self, face: u32, projection: &Projection, tolerated: f64) -> bool {
        projection.gap < keep(self.faces, face) + tolerated && projection.gap > -self.faces.depth[face as usize]
    }

    /// See [`opposition`].
    fn opposition(&self, point: u32, projection: &Projection) -> f64 {
        opposition(self.faces, self.motion, point, projection)
    }

    /// Puts contacts in order and keeps those that push in directions of their own.
    fn choose(&self, point: u32, contacts: &mut Vec<DetectedContact>) {
        for contact in contacts.iter_mut() {
            contact.opposition = self.opposition(point, &contact.projection);
        }
        let number = |contact: &DetectedContact| self.faces.number[contact.face as usize];
        let times = contacts.iter().map(|contact| contact.time);
        let first = times.filter(|&time| time >= 0.0).fold(f64::INFINITY, f64::min);
        let too_near = contacts.iter().any(|contact| contact.tolerated < 0.0);
        // In a hollow of a surface the flank that is nearer holds, and the number decides only where round-off would.
        let deepest = contacts.iter().fold(f64::INFINITY, |deepest, contact| contact.projection.gap.min(deepest));
        let depth = |contact: &DetectedContact| {
            let as_deep = deepest + IN_SURFACE * self.faces.size[contact.face as usize];
            let counts = self.faces.is_two_sided(contact.face) && contact.projection.gap > as_deep;
            if counts { contact.projection.gap } else { deepest }
        };
        contacts.sort_by(|a, b| {
            // What a point is over holds it rather than the border of the face beside that: of solids always, of surfaces where it is too near
            // from the beginning.
            let from_border = |contact: &DetectedContact| {
                contact.projection.rounded && (too_near || !self.faces.is_two_sided(contact.face))
            };
            let by_way = from_border(a).cmp(&from_border(b)).then(a.opposition.total_cmp(&b.opposition));
            let at_once = |contact: &DetectedContact| (first..=first + AT_ONCE).contains(&contact.time);
            let time = |contact: &DetectedContact| if at_once(contact) { first } else { contact.time };
            let by_depth = depth(a).total_cmp(&depth(b));
            time(a).total_cmp(&time(b)).then(by_way).then(by_depth).then(number(a).cmp(&number(b)))
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
        let cosine = dot(first.projection.normal, second.projection.normal);
        if !self.faces.adjacent(first.face, second.face) {
            return cosine <= same_way;
        }
        let middle = |face| projection::centre(&self.faces.end(face, self.motion));
        let rise = || dot(subtract(middle(second.face), middle(first.face)), first.projection.normal);
        // What is flat on both sides of an edge is not round there.
        let round = first.projection.rounded || second.projection.rounded;
        let least = if round { HOLLOW * self.faces.size[second.face as usize] } else { 0.0 };
        cosine <= same_way.max(SAME_WAY_IN_HOLLOW) && rise() > least
    }
}

/// Cosine between the normal of a point and that of a face that it meets. A free node faces everything, and so does one of a surface,
/// whose two sides leave nothing but round-off.
pub fn opposition(faces: &Faces, motion: &NodeMotion, point: u32, projection: &Projection) -> f64 {
    let normal = faces.point_normal(point, motion);
    let length = dot(normal, normal).sqrt();
    let size = faces.around(point).first().map_or(0.0, |&face| faces.size[face as usize]);
    if length > NO_NORMAL * size * size { dot(normal, projection.normal) / length } else { -1.0 }
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
        yields: false,
        is_thick: faces.distance(point, contact.face) > 0.0,
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
