//! Nodes that faces have held before: whether they still do, and to which faces around them a node has gone on.

use super::super::FLUSH;
use super::{
    DetectedContact, FaceContact, HOLD, MAX_FACES, NONE, NodeFaceCheck, SAME_WAY, SAME_WAY_IN_HOLLOW, faces_of,
    is_near, push_back,
};
use crate::common::vector::{add, dot, subtract};
use crate::solver::contact::geometry::projection::{self, Projection};
use crate::solver::contact::search::locate::Candidate;

/// A point that begins a step over one face of a ridge is behind the plane of the other from this part of its size on.
const BEHIND: f64 = 1e-6;

/// A point that has left a face, and what it may have gone on to.
struct Departure<'a> {
    near: &'a [Candidate],
    past: &'a [FaceContact; MAX_FACES],
    /// The face that it has left, the overlap that is tolerated there, a length, and where it is beyond the border of that.
    old: u32,
    tolerated: f64,
    left: Projection,
}

/// Where it has gone.
struct NextFace {
    /// The face on which it is now.
    face: Option<(u32, Projection)>,
    /// Whether it is behind any of the faces around, or near that, and whether one of those rises in front of the old one.
    behind: bool,
    rises: bool,
}

impl NodeFaceCheck<'_> {
    /// Faces that held the point before, and those around them to which it may have moved on.
    pub(super) fn persistent(
        &self,
        point: u32,
        near: &[Candidate],
        past: &[FaceContact; MAX_FACES],
        contacts: &mut Vec<DetectedContact>,
    ) {
        let mut departures: [Option<Departure>; MAX_FACES] = [const { None }; MAX_FACES];
        let mut left = departures.iter_mut();
        for &FaceContact { face: old, tolerated, .. } in
            past.iter().filter(|past| past.face != NONE && is_near(near, past.face))
        {
            let Some(projection) = self.projection_at_end(point, old) else { continue };
            if projection.outside == 0.0 {
                if self.still_in_reach(point, old, &projection, tolerated) {
                    contacts.push(self.held(old, projection, tolerated));
                }
            } else if self.is_beside(point, old, &projection) {
                contacts.extend(self.held_around(point, old, tolerated));
            } else if let Some(departure) = left.next() {
                *departure = Some(Departure { near, past, old, tolerated, left: projection });
            }
        }
        let [first, others @ ..] = &departures;
        if let Some(departure) = first.as_ref().filter(|_| contacts.is_empty()) {
            self.in_hollow(point, near, past, false, contacts);
            if contacts.is_empty() {
                contacts.extend(self.moved_on(point, departure));
            }
            if contacts.is_empty() {
                self.in_hollow(point, near, past, true, contacts);
            }
            // Hardly beyond the border of another one, as in a plane of symmetry to which faces lean, a point is not on any other face yet.
            for departure in others.iter().flatten() {
                if contacts.is_empty() {
                    contacts.extend(self.moved_on(point, departure));
                }
            }
        }
        self.still_around(point, near, past, contacts);
        if self.faces.around(point).is_empty() {
            self.still_at_joint(point, near, past, contacts);
        }
        // Of the faces around those that hold the point only those that fold towards it can hold it as well.
        self.folds(point, near, past, contacts);
    }

    /// A point in a hollow that would go beyond the borders of all faces that held it is held by each of them over which it would be if the others
    /// held it: others that have no corner in common with it, or all.
    fn in_hollow(
        &self,
        point: u32,
        near: &[Candidate],
        past: &[FaceContact; MAX_FACES],
        all: bool,
        contacts: &mut Vec<DetectedContact>,
    ) {
        let free = self.motion.end(point);
        let held = || past.iter().filter(|past| past.face != NONE && is_near(near, past.face));
        let push = |past: &FaceContact| {
            let end = self.projection_at_end(point, past.face);
            end.map_or([0.0; 3], |end| push_back(&end, past.tolerated))
        };
        for own in held() {
            let counts = |other: &u32| *other != own.face && (all || !self.faces.adjacent(own.face, *other));
            let end = held().filter(|other| counts(&other.face)).fold(free, |end, other| add(end, push(other)));
            let over = projection::project(&self.faces.end(own.face, self.motion), end);
            let Some(mut over) = over.filter(|over| end != free && self.is_hardly_beyond(own.face, over)) else {
                continue;
            };
            over.gap += dot(subtract(free, end), over.normal) - self.faces.distance(point, own.face);
            if self.begins_over(point, own.face) && self.still_in_reach(point, own.face, &over, own.tolerated) {
                contacts.push(self.held(own.face, over, own.tolerated));
            }
        }
    }

    /// Whether a point stands beside the end of a surface, whose projection counts its gap from where they touch.
    fn is_beside(&self, point: u32, face: u32, projection: &Projection) -> bool {
        let distance = self.faces.distance(point, face);
        distance > 0.0 && projection.is_beside(projection.gap + distance, self.faces.borders_of(face))
    }

    /// A point that has left its faces: on to a face around the first of them, or held by that as it was, or by none.
    fn moved_on(&self, point: u32, departure: &Departure) -> Option<DetectedContact> {
        let &Departure { old, tolerated, left, .. } = departure;
        let NextFace { face, behind, rises } = self.next_face(point, departure);
        // The other side of a ridge has its turn in the next step: the point has not been behind its plane, but before the ridge, and
        // counted from that plane it would be kept as deep as it was before. Surfaces are round there.
        let waits = |(face, end): &(u32, Projection)| {
            !self.faces.is_two_sided(old) && self.begins_over(point, old) && self.begins_behind(point, *face, end)
        };
        if let Some((face, projection)) = face.filter(|next| !waits(next)) {
            return Some(self.held(face, projection, tolerated));
        }
        let as_it_was = self.still_in_reach(point, old, &left, tolerated).then(|| self.held(old, left, tolerated));
        if let Some(held) = as_it_was.filter(|_| face.is_some() || self.is_hardly_beyond(old, &left)) {
            return Some(held);
        }
        // Behind the edge of a hollow a point is behind both faces and its foot beyond both. Around a bend of a surface it
        // is as well, where it is nearer than they touch.
        let is_past_end = self.is_past_end(point, old, &left);
        let deep = behind && !is_past_end && left.gap < 0.0 && left.outside <= 2.0 * left.gap.abs();
        let flat = as_it_was.filter(|_| deep);
        let around = || self.held_around(point, old, tolerated);
        if rises { flat.or_else(around) } else { around().or(flat) }
    }

    /// Whether a point of a solid has gone around the end of a surface, no nearer to that than they touch: what is on the other side then has its turn,
    /// and from this one it would be pushed through. Nodes of surfaces are held as they were: in folds of triangles one would go through else.
    fn is_past_end(&self, point: u32, old: u32, left: &Projection) -> bool {
        let may_be = self.faces.is_two_sided(old) && !self.faces.is_on_surface(point);
        may_be && left.is_at_border(self.faces.borders_of(old)) && {
            let from_end = left.seen_from_border(&self.faces.end(old, self.motion), self.motion.end(point));
            from_end.gap >= self.faces.distance(point, old)
        }
    }

    /// The face around one that a point has left to which it has gone on, if any.
    fn next_face(&self, point: u32, &Departure { near, past, old, tolerated, left }: &Departure) -> NextFace {
        let slightly = self.is_hardly_beyond(old, &left);
        let mut next = NextFace { face: None, behind: false, rises: false };
        let mut best = (true, f64::INFINITY, f64::INFINITY);
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
                next.behind = true;
                next.rises |= self.rises(old, face, left.normal);
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
            if projection.outside <= beyond && self.in_reach(face, &projection, tolerated) && found < best {
                (next.face, best) = (Some((face, projection)), found);
            }
        }
        next
    }

    /// Whether a point begins the step over a face, or hardly beyond its border.
    fn begins_over(&self, point: u32, face: u32) -> bool {
        self.projection_at_start(point, face).is_some_and(|start| self.is_hardly_beyond(face, &start))
    }

    /// Whether a point begins the step behind the plane of that part of a face over which it ends.
    fn begins_behind(&self, point: u32, face: u32, end: &Projection) -> bool {
        let height = end.height(&self.faces.start(face, self.motion), self.motion.start(point));
        height - self.faces.distance(point, face) < -BEHIND * self.faces.size[face as usize]
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

    /// A point without faces that others hold in the corner of several bodies stays with a face beyond whose border it is no farther than it is in
    /// another body there.
    fn still_at_joint(
        &self,
        point: u32,
        near: &[Candidate],
        past: &[FaceContact; MAX_FACES],
        contacts: &mut Vec<DetectedContact>,
    ) {
        for past in past.iter().filter(|past| past.face != NONE && is_near(near, past.face)) {
            let another = contacts.iter().all(|other| !self.faces.adjacent(other.face, past.face));
            if another && self.comes_at_joint(past.face, near, self.meeting(point, 1.0)) {
                let end = self.projection_at_end(point, past.face);
                let end = end.filter(|end| self.still_in_reach(point, past.face, end, past.tolerated));
                contacts.extend(end.map(|end| self.held(past.face, end, past.tolerated)));
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

    /// Whether a face lies in front of another one, of this normal, and that in front of it: they make a hollow. The end of a bore has a part in front of
    /// a facet that it meets with a corner alone, but no facet is in front of the end.
    fn rises(&self, old: u32, face: u32, normal: [f64; 3]) -> bool {
        let corners = self.faces.end(face, self.motion);
        let from_old = subtract(projection::centre(&corners), projection::centre(&self.faces.end(old, self.motion)));
        dot(from_old, normal) > 0.0 && dot(from_old, projection::area_normal(&corners)) < 0.0
    }

    /// Adds faces next to those that hold the point, when they fold towards it and it would be behind them.
    fn folds(
        &self,
        point: u32,
        near: &[Candidate],
        past: &[FaceContact; MAX_FACES],
        contacts: &mut Vec<DetectedContact>,
    ) {
        let held = contacts.len();
        for i in 0..held {
            let old = contacts[i];
            let beside = |near: &&Candidate| near.face != old.face && self.faces.adjacent(old.face, near.face);
            for &Candidate { face, interface } in near.iter().filter(beside) {
                let is_known = || contacts.iter().any(|contact| contact.face == face);
                if !self.rises(old.face, face, old.projection.normal) || self.is_in_front(point, face) || is_known() {
                    continue;
                }
                if self.is_flush(point, old.projection.normal, face) {
                    continue;
                }
                if !self.stays_outside(point, old.face, face) {
                    continue;
                }
                let Some(projection) = self.around_border(point, face, true) else { continue };
                if self.is_beyond_rim((point, face), near, &projection) {
                    continue;
                }
                // In a corner of a solid, what is behind the one is as far beyond the border of the other.
                let cosine = dot(old.projection.normal, projection.normal);
                let is_corner = !self.faces.is_two_sided(face) && cosine < SAME_WAY_IN_HOLLOW;
                let behind = (-old.projection.gap).max(0.0);
                let beyond = if is_corner { HOLD * self.faces.size[face as usize] + behind } else { 0.0 };
                // What overlaps in the mesh does so as well behind faces beside that hardly fold; in a sheet around a shaft, as much as its mesh bends.
                let flush = if self.faces.is_two_sided(face) { SAME_WAY } else { FLUSH };
                let goes_on = cosine > flush;
                // The other flank of a hollow has held it as well, with an overlap of its own.
                let before = past.iter().find(|past| past.face == face).map(|past| past.tolerated);
                let tolerated = before.unwrap_or(if goes_on { old.tolerated } else { 0.0 });
                // At the end of a valley the side of the body there rises over the walls as well; what slides out along them is behind it, and does not look
                // at it.
                let looks = || {
                    self.faces.is_two_sided(face)
                        || self.faced(point, &projection.normal, self.rules[interface as usize])
                };
                if projection.outside <= beyond
                    && projection.gap < 0.0
                    && self.in_reach(face, &projection, 0.0)
                    && looks()
                {
                    contacts.push(self.held(face, projection, tolerated));
                }
            }
        }
    }

    /// Whether a face of a solid goes on nearly in the plane of one that holds the point, of this normal: one of the two is enough, and either does.
    fn is_flush(&self, point: u32, normal: [f64; 3], face: u32) -> bool {
        let other = projection::area_normal(&self.faces.end(face, self.motion));
        let cosine = dot(normal, other);
        self.faces.distance(point, face) == 0.0 && cosine > 0.0 && cosine * cosine > FLUSH * FLUSH * dot(other, other)
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
}
