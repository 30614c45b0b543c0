//! Planes of symmetry, as NO DISPLACEMENT makes them: the sides of bodies that lie in one are no sides, since the bodies go on behind it.

use super::super::FLUSH;
use super::NodeFaceCheck;
use crate::common::vector::{dot, normalized, subtract};
use crate::solver::contact::geometry::projection;
use crate::solver::contact::search::locate::Candidate;

/// A point that is nearer to a face in a plane of symmetry than this part of the face's size is in that plane.
const IN_PLANE: f64 = 1e-6;

impl NodeFaceCheck<'_> {
    /// Leaves faces out of those near a point that lie in the same plane of symmetry: nothing can move either along their normal, and a point that they
    /// hold would go on behind the faces that meet them at that plane.
    pub fn leave_out_symmetry_planes(&self, point: u32, near: &mut Vec<Candidate>) {
        if (0..3).any(|axis| self.is_held(point, axis)) {
            near.retain(|candidate| !self.are_in_symmetry_plane(point, candidate.face));
        }
    }

    /// Whether a point lies in a face, and both are held along an axis on which the face stands upright.
    pub(super) fn are_in_symmetry_plane(&self, point: u32, face: u32) -> bool {
        let corners = self.faces.start(face, self.motion);
        let normal = normalized(projection::area_normal(&corners)).unwrap_or_default();
        let is_held = |axis: usize| {
            let all = self.faces.corners[face as usize];
            self.is_held(point, axis) && all.iter().all(|&corner| self.is_held(corner, axis))
        };
        let height = dot(subtract(self.motion.start(point), corners[0]), normal);
        (0..3).any(|axis| normal[axis].abs() > FLUSH && is_held(axis))
            && height.abs() <= IN_PLANE * self.faces.size[face as usize]
    }

    /// Whether a constraint says how a point moves along an axis.
    fn is_held(&self, point: u32, axis: usize) -> bool {
        let inverse_mass = self.motion.inverse_mass.get(point as usize);
        !self.is_carried(point) && inverse_mass.is_some_and(|inverse| inverse[axis] <= 0.0)
    }
}
