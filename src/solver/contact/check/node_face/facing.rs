//! How the body of a node looks at the faces that the node meets.

use super::NodeFaceCheck;
use crate::common::vector::{add, dot};
use crate::solver::contact::geometry::projection;
use crate::solver::contact::search::locate::Rule;

/// Cosine between the normals of two faces that look at each other, at most.
pub(in crate::solver::contact::check) const FACING: f64 = -0.02;

impl NodeFaceCheck<'_> {
    /// Whether one of the faces around a point looks at the face that it meets. At a convex corner this is necessary: a
    /// plane that touches nothing but the corner has its normal in the cone of the corner's own, turned round. Corners
    /// of bodies with flush sides cross the other's sides by round-off; those sides look the same way. Where side sets
    /// say what holds, sides of its body that are in none count as well, and where it goes on in a way that is not known nothing is ruled out; the
    /// nodes of a node set bring no faces at all.
    pub(super) fn faced(&self, point: u32, normal: &[f64; 3], rule: Rule) -> bool {
        let looks = |side: [f64; 3]| dot(side, *normal) < FACING * dot(side, side).sqrt();
        self.faces.around(point).is_empty()
            || self.has_face_opposed(point, normal, FACING)
            || self.faces.is_on_surface(point)
            || rule != Rule::Blocks && (self.hidden_sides_around(point).any(looks) || !self.is_surrounded(point))
    }

    /// Normals, with the lengths of their areas, of the sides of its body at a point that touch nothing.
    fn hidden_sides_around(&self, point: u32) -> impl Iterator<Item = [f64; 3]> + '_ {
        let sides = self.faces.around(point).iter().flat_map(|&face| self.faces.hidden_sides(face, self.motion));
        sides.filter(move |side| side.ends.contains(&point)).map(|side| side.area_normal)
    }

    /// Whether one of the faces around a point makes a smaller cosine with a normal than this negative one.
    pub(super) fn has_face_opposed(&self, point: u32, normal: &[f64; 3], cosine: f64) -> bool {
        self.faces.around(point).iter().any(|&face| {
            let own = projection::area_normal(&self.faces.start(face, self.motion));
            dot(own, *normal) < cosine * dot(own, own).sqrt()
        })
    }

    /// Whether another face of contact, or a side that touches nothing, is known at every edge with which the faces around a point end there. It
    /// is not where a side set ends at the border of an element whose neighbour goes on, as in a mitred corner, or where erosion has laid a side bare.
    fn is_surrounded(&self, point: u32) -> bool {
        let around = self.faces.around(point);
        around.iter().all(|&face| {
            let corners = self.faces.corners[face as usize];
            let is_shared = |end: u32| {
                let is_beside = |other: &u32| *other != face && self.faces.corners[*other as usize].contains(&end);
                let is_at_edge = |ends: [u32; 2]| ends == [point, end] || ends == [end, point];
                around.iter().any(is_beside)
                    || self.faces.hidden_sides(face, self.motion).any(|side| is_at_edge(side.ends))
            };
            // A face of the plane is a strip, which ends with its ends.
            let is_strip = corners[0] == corners[3] && corners[1] == corners[2];
            let ends =
                (0..4).filter(|&i| corners[i] == point).flat_map(|i| [corners[(i + 3) % 4], corners[(i + 1) % 4]]);
            ends.filter(|&end| (end == point) == is_strip).all(is_shared)
        })
    }

    /// Whether the body of a point, with its own sides that touch nothing, does not look at such a side of another.
    pub(super) fn looks_past(&self, point: u32, side: [f64; 3]) -> bool {
        let normal = self.hidden_sides_around(point).fold(self.faces.point_normal(point, self.motion), add);
        let square = dot(normal, normal) * dot(side, side);
        dot(normal, side) > FACING * square.sqrt()
    }
}
