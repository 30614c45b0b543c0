//! Nodes and faces of one thick surface that lie nearer to each other along it than they touch.
//!
//! A shell that is thicker than its elements are long has neighbours within its thickness. Flat, they are in each other's way from the
//! beginning, and pressed along itself the sheet would be held by contact as well as by its elements.

use super::faces::{Faces, THICK};
use super::projection::area_normal;
use crate::common::shared::Shared;
use crate::common::vector::{dot, normalized, scaled, subtract};
use std::collections::BTreeSet;

/// Cosine between the normals of two faces of a surface beyond which it is folded between them, by more than 120 degrees: what lies
/// across a fold may touch.
const FOLDED: f64 = -0.5;

/// Pairs of a node and a face that never touch, ascending.
#[derive(Debug, Clone, Default)]
pub struct GrownTogether(Shared<(u32, u32)>);

impl GrownTogether {
    /// Finds the pairs in which the distance at which they touch is more than [`THICK`] of the distance between them along the surface, at the
    /// start. Half a turn around nothing takes π/2 of a thickness of the surface: what is nearer cannot be brought together by folding.
    /// `positions` are those of the points, a length.
    pub fn of(faces: &Faces, positions: &[[f64; 3]]) -> GrownTogether {
        let surface = Surface { faces, positions };
        let mut all = Vec::new();
        for point in (0..positions.len() as u32).filter(|&point| faces.is_on_surface(point)) {
            if surface.reaches_beyond_its_faces(point) {
                all.extend(surface.near(point).into_iter().map(|face| (point, face)));
            }
        }
        GrownTogether(all.into())
    }

    /// Whether a point and a face are one of the pairs.
    #[inline]
    pub fn contains(&self, point: u32, face: u32) -> bool {
        !self.0.is_empty() && self.0.binary_search(&(point, face)).is_ok()
    }
}

/// Faces with the positions of the points at the start.
struct Surface<'a> {
    faces: &'a Faces,
    positions: &'a [[f64; 3]],
}

impl Surface<'_> {
    fn corners(&self, face: u32) -> [[f64; 3]; 4] {
        self.faces.corners[face as usize].map(|corner| self.positions[corner as usize])
    }

    fn normal(&self, face: u32) -> [f64; 3] {
        normalized(area_normal(&self.corners(face))).unwrap_or_default()
    }

    /// Edges of a face, by its corners.
    fn edges(&self, face: u32) -> [[u32; 2]; 4] {
        let [a, b, c, d] = self.faces.corners[face as usize];
        [[a, b], [b, c], [c, d], [d, a]]
    }

    /// Whether a point and an edge of a face are so near that the face beyond is in the way.
    fn is_near(&self, point: u32, [a, b]: [u32; 2], face: u32) -> bool {
        let at = |point: u32| self.positions[point as usize];
        let (along, offset) = (subtract(at(b), at(a)), subtract(at(point), at(a)));
        let square = dot(along, along);
        let place = if square > 0.0 { (dot(offset, along) / square).clamp(0.0, 1.0) } else { 0.0 };
        let apart = subtract(offset, scaled(along, place));
        let touching = self.faces.distance(point, face);
        touching * touching > THICK * THICK * dot(apart, apart)
    }

    /// Whether a point touches what begins behind its own faces. Most shells are thinner, and nothing is looked for.
    fn reaches_beyond_its_faces(&self, point: u32) -> bool {
        self.faces
            .around(point)
            .iter()
            .any(|&face| self.edges(face).iter().any(|edge| !edge.contains(&point) && self.is_near(point, *edge, face)))
    }

    /// Faces of the surface near a point that are not its own, ascending: from its own over common edges, as far as nothing folds.
    fn near(&self, point: u32) -> BTreeSet<u32> {
        let mut found: BTreeSet<u32> = BTreeSet::new();
        for &own in self.faces.around(point).iter().filter(|&&own| self.faces.is_two_sided(own)) {
            let normal = self.normal(own);
            found.insert(own);
            let mut open = vec![own];
            while let Some(face) = open.pop() {
                for next in self.beside(face) {
                    let is_near = || self.edges(next).iter().any(|edge| self.is_near(point, *edge, next));
                    if !found.contains(&next) && dot(normal, self.normal(next)) > FOLDED && is_near() {
                        found.insert(next);
                        open.push(next);
                    }
                }
            }
        }
        found.retain(|face| !self.faces.corners[*face as usize].contains(&point));
        found
    }

    /// Faces that go on across the edges of one, on its side of the surface.
    fn beside(&self, face: u32) -> impl Iterator<Item = u32> + '_ {
        let corners = self.faces.corners[face as usize];
        let around = corners.into_iter().flat_map(|corner| self.faces.around(corner));
        around.copied().filter(move |&next| self.faces.is_two_sided(next) && self.faces.go_on(face, next) == Some(true))
    }
}
