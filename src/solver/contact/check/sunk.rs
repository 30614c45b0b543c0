//! What lies below a surface that contact knows to be in another body, and no deeper below it than that surface is in the other: the overlap is
//! known where it begins. Nodes of the other body that are there may be more than an element deep in a fine mesh, and elements may have
//! none of their nodes known; contact need not know of either to press the bodies apart.

use super::body_pairs::{BodyPairs, Known, box_of};
use super::initial_overlap::corners_of;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::Body;
use crate::solver::contact::geometry::projection;
use crate::solver::contact::search::{Box3, Candidates, SearchKind};
use crate::solver::contact::surface::layout::Layout;
use std::collections::BTreeMap;

/// What is below a face by less than this multiple of how deep the corners of the face are in the other body is no deeper than they are:
/// where surfaces bend and meshes differ, the overlap between the corners is another than at them.
const AS_DEEP: f64 = 1.5;

/// A place in an overlap: where it is, the body whose surface may be above it, and the other body there, see [`BodyPairs::body`].
#[derive(Debug, Clone, Copy)]
pub struct Inner {
    pub at: [f64; 3],
    pub body: u32,
    pub other: u32,
}

/// A face with a corner that contact knows to be behind a face of another body.
#[derive(Debug, Clone, Copy)]
struct SunkFace {
    face: u32,
    body: u32,
    other: u32,
    /// How deep the deepest of its corners is, a length.
    depth: f64,
}

/// Faces of solids that begin in other bodies, as far as contact knows.
pub struct SunkFaces<'a> {
    body: &'a Body,
    layout: &'a Layout,
    faces: Vec<SunkFace>,
}

impl<'a> SunkFaces<'a> {
    pub fn of(given: (&Mesh, &Model), body: &'a Body, layout: &'a Layout, pairs: &BodyPairs) -> SunkFaces<'a> {
        let mut depths: BTreeMap<(u32, u32), f64> = BTreeMap::new();
        for Known { point, other, depth } in pairs.known(given, body, layout) {
            // Surfaces have no inside.
            for &face in layout.faces.around(point).iter().filter(|&&face| !layout.faces.is_two_sided(face)) {
                let deepest = depths.entry((face, other)).or_insert(0.0);
                *deepest = depth.max(*deepest);
            }
        }
        let body_of = |face: u32| pairs.body(layout.nodes[layout.faces.corners[face as usize][0] as usize]);
        let sunk = |((face, other), depth)| SunkFace { face, body: body_of(face), other, depth };
        SunkFaces { body, layout, faces: depths.into_iter().map(sunk).collect() }
    }

    /// Leaves out what is below such faces.
    pub fn leave_out_below<T>(&self, found: &mut Vec<T>, place: impl Fn(&T) -> Inner) {
        let places: Vec<Inner> = found.iter().map(place).collect();
        let points: Vec<Box3> = places.iter().map(|place| Box3::around(&[place.at])).collect();
        let around = |of: &SunkFace| {
            box_of(self.body, self.layout, &self.layout.faces.corners[of.face as usize]).grown(AS_DEEP * of.depth)
        };
        let boxes: Vec<Box3> = self.faces.iter().map(around).collect();
        let mut near = Candidates::default();
        SearchKind::Grid.make().find(&points, &boxes, &vec![[u32::MAX; 4]; boxes.len()], &mut near);
        let is_below = |(i, place): (usize, &Inner)| {
            near.of(i).iter().any(|&number| self.is_below(place, &self.faces[number as usize]))
        };
        let mut is_below = places.iter().enumerate().map(is_below);
        found.retain(|_| !is_below.next().unwrap_or_default());
    }

    fn is_below(&self, place: &Inner, sunk: &SunkFace) -> bool {
        if (place.body, place.other) != (sunk.body, sunk.other) {
            return false;
        }
        let projection = projection::project(&corners_of(self.body, self.layout, sunk.face), place.at);
        projection.is_some_and(|found| {
            let below = -found.gap;
            // Behind a seam the foot is beyond by less than the place is deep.
            below > 0.0 && below <= AS_DEEP * sunk.depth && found.outside <= below
        })
    }
}
