//! Nodes that a face has not seen before: whether and when they come through it, and which of those behind it belong there.

use super::super::FLUSH;
use super::facing::FACING;
use super::{DetectedContact, HOLD, IN_SURFACE, NodeFaceCheck, SAME_WAY, faces_of};
use crate::common::vector::{cross, dot, normalized, scaled, subtract};
use crate::solver::contact::geometry::paths::TWICE_ROOT_THREE;
use crate::solver::contact::geometry::projection::{self, Projection};
use crate::solver::contact::geometry::sides::HiddenSide;
use crate::solver::contact::search::locate::{Candidate, Rule};

/// A point is clearly in front of a face from this part of the face's size on; on flush sides round-off decides less.
pub(super) const CLEARLY: f64 = 1e-6;

/// A point this part of a face's size from its plane is in the plane. Not more: in folds, faces that merely come near
/// each other's planes must not be taken for a seam.
pub(super) const SEAM: f64 = 1e-4;

/// A point in the side of a body is nearer to the plane of that side than this part of how far it is beyond the border of a face there.
const LEVEL_WITH_SIDE: f64 = 0.1;

impl NodeFaceCheck<'_> {
    /// A point that this face, one of those `near` it, has not seen before. Edges have a say where blocks meet.
    #[inline(always)]
    pub(super) fn newcomer(
        &self,
        (point, face): (u32, u32),
        near: &[Candidate],
        rule: Rule,
    ) -> Option<DetectedContact> {
        if self.is_in_front(point, face) {
            return None;
        }
        let end = self.around_border(point, face, true).filter(|projection| projection.gap < 0.0)?;
        if self.is_beyond_rim((point, face), near, &end) {
            return None;
        }
        let distance = self.faces.distance(point, face);
        let may_have_come = || self.may_have_come_over(point, face, &end);
        if distance > 0.0 && !may_have_come() || self.is_on_other_side(point, face) {
            return None;
        }
        if self.is_around_corner(point, face, &end) {
            return None;
        }
        let start = self.around_border(point, face, false)?;
        let contact = |time, tolerated| DetectedContact { face, time, opposition: 0.0, projection: end, tolerated };
        let comes = |time| {
            self.faced(point, &end.normal, rule)
                && !self.slides_over((point, face), near, &end, || self.meeting(point, time))
        };
        if distance == 0.0 && start.gap >= 0.0 {
            if !may_have_come() {
                return None;
            }
            // In the plane but for round-off, which may have it behind already where it is to come through a triangle of the face.
            let begins_there = start.outside <= 0.0 && start.gap <= IN_SURFACE * self.faces.size[face as usize];
            let time = (self.first_touch(point, face))
                .or(begins_there.then_some(0.0))
                .or_else(|| self.comes_flush((point, face), near, [&start, &end]))?;
            if rule == Rule::Blocks && self.edges_hold && self.is_held_by_edges(point, face, time) {
                return None;
            }
            return comes(time).then(|| contact(time, 0.0));
        }
        if distance > 0.0 && self.begins_in_front(point, face) {
            // What comes over the border is not seen to come through the face pushed out. What is in front all the time and
            // over the face at the end has come, what is behind then must have come through.
            let stays_in_front = end.outside == 0.0 && end.gap > -distance;
            let unseen = if start.gap < 0.0 { 0.0 } else { 1.0 };
            let time = self.first_touch(point, face).or_else(|| stays_in_front.then_some(unseen))?;
            // Nearer than thicknesses allow, as the mesh has it or because it came from beside, it stays as near.
            return comes(time).then(|| contact(time, self.nearness(point, face, &start).min(0.0)));
        }
        if self.faces.is_two_sided(face) {
            // It is on the other side.
            return None;
        }
        // Behind the face from the start: pushed there by other contacts, laid bare by erosion, or never in front. What is as deep in the plane
        // of a face beside it lies flush against that, however far the face comes down in the step.
        let depth = self.faces.depth[face as usize];
        let shallow = start.gap > -depth && end.gap > -depth;
        let is_over =
            || start.outside == 0.0 && end.outside == 0.0 || self.is_behind_seam((point, face), near, [&start, &end]);
        let inside = shallow
            && is_over()
            && self.opposition(point, &end) < FACING
            && !self.in_front_of_another(point, face, start.gap)
            && !self.is_on_another((point, face), near, start.gap)
            && !self.slides_over((point, face), near, &start, || self.meeting(point, 0.0));
        inside.then(|| contact(0.0, start.gap))
    }

    /// Whether a point that ends the step behind the plane of a solid's face, but not where the solid is, has begun it behind that plane, too:
    /// most do that are near a face and not in front of it.
    #[inline(always)]
    fn is_around_corner(&self, point: u32, face: u32, end: &Projection) -> bool {
        // Behind a seam the foot is beyond by less than the point is deep.
        let is_elsewhere = end.outside > -end.gap || end.gap <= -self.faces.depth[face as usize];
        is_elsewhere
            && self.faces.distance(point, face) == 0.0
            && projection::is_behind(&self.faces.start(face, self.motion), self.motion.start(point))
    }

    /// Whether a point that a face has not held is beside its border and too far from that to be stopped by it, see
    /// [`Faces::rim`](crate::solver::contact::geometry::faces::Faces::rim).
    pub(super) fn is_beyond_rim(&self, (point, face): (u32, u32), near: &[Candidate], end: &Projection) -> bool {
        end.rounded
            && end.gap + self.faces.distance(point, face) > self.faces.rim(point, face)
            && !self.is_over_bend((point, face), near, end)
    }

    /// Whether a point beyond the border of a solid's face is over the surface all the same: where that hardly bends, as at the facets of a shaft, and
    /// beyond the border of the face that goes on, too; or where the facets end, as in a plane of symmetry, in the side of the body. The
    /// faces near the point are asked, which all ranks have that check it.
    pub(in crate::solver::contact::check) fn is_over_bend(
        &self,
        (point, face): (u32, u32),
        near: &[Candidate],
        end: &Projection,
    ) -> bool {
        let normal = |face: u32| normalized(projection::area_normal(&self.faces.end(face, self.motion)));
        let Some(own) = normal(face).filter(|own| dot(*own, end.normal) > SAME_WAY) else { return false };
        if self.faces.is_two_sided(face) {
            return false;
        }
        let corners = self.faces.corners[face as usize];
        let border = end.edge().map(|i| corners[i]);
        let [from, to] = border.map(|corner| self.motion.end(corner));
        let (along, arm) = (subtract(to, from), subtract(self.motion.end(point), from));
        let (square, part) = (dot(along, along), dot(arm, along) / dot(along, along));
        // How far the point is from the border to the outside of a face that runs along it, as a part of the size of the face.
        let beyond =
            |normal: [f64; 3]| dot(arm, cross(along, normal)) / (square.sqrt() * self.faces.size[face as usize]);
        if !(-CLEARLY..=1.0 + CLEARLY).contains(&part) || beyond(own) <= CLEARLY {
            return false;
        }
        // The face that goes on runs along the border the other way.
        let is_beyond = |other: u32| {
            normal(other).is_some_and(|normal| dot(own, normal) > SAME_WAY && beyond(scaled(normal, -1.0)) > CLEARLY)
        };
        // Upright sides, as those of a joint of flush blocks, are as far from the point as it is beyond the border.
        let is_in_side = |other: u32| {
            let least = LEVEL_WITH_SIDE * beyond(own) * self.faces.size[face as usize];
            let place = projection::project(&self.faces.end(other, self.motion), self.motion.end(point));
            place.is_some_and(|place| place.gap.abs() <= least.min(SEAM * self.faces.size[other as usize]))
        };
        let is_across = |other: u32| self.has_border(other, &border);
        let mut others = faces_of(near).filter(|&other| other != face && is_across(other));
        others.any(is_beyond) || self.beside(face).any(|other| is_across(other) && is_in_side(other))
    }

    /// How far a point is at the beginning of the step from touching a face: from the nearest point of its border where it is beyond.
    fn nearness(&self, point: u32, face: u32, start: &Projection) -> f64 {
        if start.outside <= 0.0 {
            return start.gap;
        }
        let (corners, at) = (self.faces.start(face, self.motion), self.motion.start(point));
        start.seen_from_border(&corners, at).gap - self.faces.distance(point, face)
    }

    /// Whether a point that ends the step beyond the border of a face may have touched it on its way: nobody goes farther in the step
    /// than the longest path along each axis, and the face pushed out lies beside the face by no more than its normals turn in the
    /// step and from triangle to triangle. Most points near a surface are in it, a face or more away.
    fn may_have_come_over(&self, point: u32, face: u32, end: &Projection) -> bool {
        if end.outside <= 0.0 {
            return true;
        }
        let [before, after] = [self.faces.start(face, self.motion), self.faces.end(face, self.motion)].map(|corners| {
            let normal = projection::area_normal(&corners);
            scaled(normal, 1.0 / dot(normal, normal).sqrt())
        });
        let apart = |a: [f64; 3], b: [f64; 3]| {
            let separation = subtract(a, b);
            dot(separation, separation).sqrt()
        };
        let beside = self.faces.distance(point, face) * (apart(before, after) + apart(after, end.normal));
        let within = 2.0 * (beside + TWICE_ROOT_THREE * self.longest_path) + HOLD * self.faces.size[face as usize];
        // What is no number rules nothing out.
        end.outside.partial_cmp(&within) != Some(std::cmp::Ordering::Greater)
    }

    /// Whether a point begins the step on the other side of a surface, to which it then belongs.
    fn is_on_other_side(&self, point: u32, face: u32) -> bool {
        self.faces.is_two_sided(face) && !self.begins_in_front(point, face) && self.faces.distance(point, face) > 0.0
    }

    /// Whether a point that begins the step beyond the border of a face of a surface is outside the fold there: behind the face that goes on across
    /// the border and rises in front of this one. It is in front of this plane, but not of this side of the surface, and taken for a point in the fold
    /// it would be pulled through the other flank into it. Only faces near the point are asked, which all ranks have that check it.
    pub(super) fn is_behind_flank(&self, point: u32, face: u32, near: &[Candidate]) -> bool {
        if !self.faces.is_two_sided(face) {
            return false;
        }
        let Some(start) = self.projection_at_start(point, face).filter(|start| start.outside > 0.0) else {
            return false;
        };
        let corners = self.faces.corners[face as usize];
        let border = start.edge().map(|i| corners[i]);
        let middle = |face| projection::centre(&self.faces.start(face, self.motion));
        let is_flank = |&other: &u32| {
            self.has_border(other, &border)
                && self.faces.go_on(face, other) == Some(true)
                && dot(subtract(middle(other), middle(face)), start.normal) > 0.0
        };
        let is_behind = |flank: u32| self.projection_at_start(point, flank).is_some_and(|start| start.gap < 0.0);
        faces_of(near).filter(is_flank).any(is_behind)
    }

    /// Part of the step after which a point comes as near to a face as they touch, or through it where it came by a gap between
    /// faces pushed outwards.
    fn first_touch(&self, point: u32, face: u32) -> Option<f64> {
        let (path, distance) = (self.motion.path(point), self.faces.distance(point, face));
        // Written out, as `map` would be a call for every corner.
        let [a, b, c, d] = self.faces.corners[face as usize];
        let corners = [self.motion.path(a), self.motion.path(b), self.motion.path(c), self.motion.path(d)];
        let outside = (distance > 0.0).then(|| projection::pushed_out(&corners, distance));
        let touched = outside.and_then(|outside| projection::first_crossing(&outside, path));
        touched.or_else(|| projection::first_crossing(&corners, path))
    }

    /// Whether a point surely is in front of a face at the end of the step, farther than they touch.
    #[inline(always)]
    pub(super) fn is_in_front(&self, point: u32, face: u32) -> bool {
        let distance = self.faces.distance(point, face);
        if distance > 0.0 {
            return projection::is_out_of_reach(&self.faces.end(face, self.motion), self.motion.end(point), distance);
        }
        let [a, b, c, d] = self.faces.corners[face as usize];
        let end = |point| self.motion.end_four(point);
        projection::is_in_front([end(a), end(b), end(c), end(d)], end(point))
    }

    /// Whether a point is in front of another outer face of a face's element: then it is around the corner and outside,
    /// however far behind the face's plane. So it is in front of a side that touches nothing itself. Where a
    /// point has no faces of its own to tell by which it came in, nearer to another face than the `gap` to this one is enough.
    fn in_front_of_another(&self, point: u32, face: u32, gap: f64) -> bool {
        let is_outside = |HiddenSide { at, area_normal, .. }: HiddenSide| {
            let length = dot(area_normal, area_normal).sqrt();
            dot(subtract(self.motion.start(point), at), area_normal) > CLEARLY * length.sqrt() * length
        };
        let mut others = self.beside(face);
        others.any(|other| {
            let start = self.projection_at_start(point, other);
            let least = if self.faces.around(point).is_empty() { gap } else { 0.0 };
            start.is_some_and(|start| start.gap > least + CLEARLY * self.faces.size[other as usize])
        }) || self.faces.hidden_sides(face, self.motion).any(is_outside)
    }

    /// Whether a point that is clearly behind a face of a solid, by a `gap`, is on another face of the same block, at which its own body looks: then
    /// that is where the body ends, however near the first one is. So it is at the slanted side of several layers, below which the nearest place
    /// of the side belongs to another layer.
    fn is_on_another(&self, (point, face): (u32, u32), near: &[Candidate], gap: f64) -> bool {
        if -gap <= HOLD * self.faces.size[face as usize] || self.faces.around(point).is_empty() {
            return false;
        }
        let block = self.faces.block[face as usize];
        faces_of(near).filter(|&other| other != face && self.faces.block[other as usize] == block).any(|other| {
            let reach = SEAM * self.faces.size[other as usize];
            let start = self.projection_at_start(point, other);
            let on = start.filter(|start| start.gap.abs() <= reach && start.outside <= reach);
            on.is_some_and(|on| self.has_face_opposed(point, &on.normal, -FLUSH))
        })
    }

    /// The other outer faces of a face's element.
    pub(super) fn beside(&self, face: u32) -> impl Iterator<Item = u32> + '_ {
        let element = |face: u32| self.faces.number[face as usize] / 6;
        let same = move |other: &u32| element(*other) == element(face);
        let below = (0..face).rev().take_while(same);
        let all = below.chain((face + 1..self.faces.len() as u32).take_while(same));
        // The other side of a surface lies at the same place.
        all.filter(move |_| !self.faces.is_two_sided(face))
    }
}

#[cfg(test)]
mod tests {
    use super::super::NO_CONTACT;
    use super::*;
    use crate::mesh::exterior::exterior;
    use crate::mesh::{Connectivity, Shape};
    use crate::solver::contact::geometry::faces::Faces;
    use crate::solver::contact::geometry::motion::NodeMotion;

    /// Directions in which the faces of two square elements push a free point that goes from one place to another in a step. The first element
    /// lies in the plane z = 0, from the y axis to x = 1; the second goes on from the y axis, raised by an angle. They touch at 0.1.
    fn pushes(degrees: f64, from: [f64; 3], to: [f64; 3]) -> Vec<[f64; 3]> {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let at = [0.0, 1.0].map(|y| [[0.0, y, 0.0], [1.0, y, 0.0], [cosine, y, sine]]).concat();
        let elements = Connectivity::of(Shape::Quadrilateral, vec![0, 1, 4, 3, 0, 3, 5, 2]);
        let numbers = exterior(elements.shaped(), at.len(), |_| true);
        let point = at.len() as u32;
        let faces = Faces::new(&numbers, (&elements, &[0, 0], &at), (|node| node, at.len() + 1), |_| 0.1);
        let mut motion = NodeMotion::new(at.len() + 1, [0.0; 3]);
        motion.begin([1.0, 1.0]);
        let path = subtract(to, from);
        let still = (0..point).zip(at).map(|(node, [x, y, z])| (node, [x, y, z, 0., 0., 0., 0., 0., 0.]));
        still.for_each(|(node, message)| motion.receive(node, message));
        motion.receive(point, [from[0], from[1], from[2], path[0], path[1], path[2], 0., 0., 0.]);
        let longest_path = path.iter().fold(0.0, |longest: f64, along| longest.max(along.abs()));
        let (motion, faces, rules) = (&motion, &faces, &[Rule::Blocks][..]);
        let check = NodeFaceCheck { motion, faces, rules, longest_path, edges_hold: true, have_friction: false };
        let near: Vec<Candidate> = (0..faces.len() as u32).map(|face| Candidate { face, interface: 0 }).collect();
        let mut contacts = Vec::new();
        check.point(point, &near, &NO_CONTACT, &mut contacts);
        contacts.iter().map(|contact| contact.projection.normal).collect()
    }

    #[test]
    fn what_comes_from_outside_a_fold_is_not_held_from_inside_it() {
        // It begins over the raised flank, and would go through it and over the flat one, to whose plane it is nearer than they touch all the time.
        let outside = pushes(80.0, [-0.12, 0.4, 0.03], [0.05, 0.4, 0.03]);
        let (sine, cosine) = 80_f64.to_radians().sin_cos();
        assert_eq!(outside.len(), 1, "{outside:?}");
        // The normal of that flank on its outer side, to round-off.
        assert!(dot(outside[0], [-sine, 0.0, cosine]) > 1.0 - 1e-12, "{outside:?}");
    }

    #[test]
    fn in_a_shallow_hollow_the_nearer_flank_holds() {
        // Both flanks push the same way. Over the flat one, which has the lower number, and over the raised one.
        for (x, normal) in [(0.02, [0.0, 0.0, 1.0]), (-0.02, [3_f64.to_radians().sin(), 0.0, 3_f64.to_radians().cos()])]
        {
            let pushes = pushes(177.0, [x, 0.4, 0.2], [x, 0.4, 0.09]);
            // To round-off.
            assert!(pushes.len() == 1 && dot(pushes[0], normal).abs() > 1.0 - 1e-12, "{x}: {pushes:?}");
        }
    }

    #[test]
    fn what_comes_along_a_flank_in_a_hollow_is_held_by_the_other() {
        // From before the raised flank of an obtuse hollow, and in front of both.
        let inside = pushes(120.0, [-0.05, 0.4, 0.3], [0.06, 0.4, 0.06]);
        assert!(inside.iter().any(|normal| normal[2] > 1.0 - 1e-12), "{inside:?}");
    }
}
