//! Fixed rigid planes: constraints on single points.

use crate::common::vector::{dot, subtract};
use crate::model::{Friction, RigidSurface};
use crate::solver::contact::enforcement::carried::Carried;
use crate::solver::contact::enforcement::constraint::{Constraint, MEMBERS, Origin};
use crate::solver::contact::geometry::motion::NodeMotion;

/// A contact node that may meet a rigid plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneNode {
    /// Number among the nodes of all planes.
    pub number: u32,
    /// The point.
    pub point: u32,
    /// Index into the model's rigid surfaces.
    pub plane: u32,
    /// Distance from the plane at which the point touches it, a length.
    pub(in crate::solver::contact) reach: f64,
    /// Gap, a length, that the mesh had at the start where it was negative: a point that begins behind the plane is held where
    /// it is, not thrown out.
    pub(in crate::solver::contact) tolerated: f64,
    pub(in crate::solver::contact) carried: Carried,
}

fn gap(plane: &RigidSurface, position: [f64; 3]) -> f64 {
    dot(subtract(position, plane.point), plane.normal)
}

impl PlaneNode {
    /// A point at its initial position that touches planes at a distance `reach`.
    pub fn new(point: u32, number: usize, plane: &RigidSurface, position: [f64; 3], reach: f64) -> PlaneNode {
        PlaneNode {
            number: 0,
            point,
            plane: number as u32,
            reach,
            tolerated: (gap(plane, position) - reach).min(0.0),
            carried: Carried::NOTHING,
        }
    }

    /// The constraint that keeps the point from crossing, when it would or when it comes nearer than `near`; overlaps are
    /// measured in units of `size`.
    pub fn constraint(
        &mut self,
        planes: &[RigidSurface],
        motion: &NodeMotion,
        size: f64,
        near: f64,
    ) -> Option<Constraint> {
        let plane = &planes[self.plane as usize];
        let end = motion.end(self.point);
        let gap = gap(plane, end) - self.reach - self.tolerated;
        if gap >= near {
            self.carried = Carried::NOTHING;
            return None;
        }
        let mut constraint = Constraint {
            members: [0; MEMBERS],
            weights: [0.0; MEMBERS],
            count: 1,
            normal: plane.normal,
            gap,
            growth: 0.0,
            persists: self.carried != Carried::NOTHING,
            yields: false,
            is_thick: self.reach > 0.0,
            size,
            share: 1.0,
            friction: Friction::constant(plane.friction),
            carried: self.carried,
            origin: Origin::Plane(self.number),
        };
        (constraint.members[0], constraint.weights[0]) = (self.point, 1.0);
        Some(constraint)
    }
}
