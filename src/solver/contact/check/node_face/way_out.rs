//! Which way is out of an element for a point that begins in it.

use super::facing::FACING;
use super::{NodeFaceCheck, is_near};
use crate::solver::contact::search::locate::Candidate;

/// Ways out whose lengths differ by less than this part of a face are as short as each other, so that what is symmetric stays so.
const AS_SHORT: f64 = 1e-6;

impl NodeFaceCheck<'_> {
    /// Of the faces near a point at rest, leaves of each solid element only those behind which it is least deep, or none where it is in
    /// front of one of them or in it: then it is not in that element, however deep it is behind the planes of the others. Only faces
    /// count that the point faces: bodies with flush sides are out of each other by no way along these. `nothing` is the overlap with a
    /// face that is round-off. Whether some are gone.
    pub fn leave_nearest_ways_out(&self, point: u32, near: &mut Vec<Candidate>, nothing: impl Fn(u32) -> f64) -> bool {
        let way_out = |face: u32| {
            let projection = self.projection_at_start(point, face)?;
            // What is touched at a distance has no inside.
            let is_inside_out = self.faces.is_two_sided(face) || self.faces.distance(point, face) > 0.0;
            (!is_inside_out && self.opposition(point, &projection) < FACING).then_some(projection.gap)
        };
        let is_shortest = |&Candidate { face, .. }: &Candidate| {
            let Some(own) = way_out(face) else { return true };
            let longest = own + AS_SHORT * self.faces.size[face as usize];
            self.beside(face).all(|other| {
                let Some(gap) = way_out(other) else { return true };
                gap <= -nothing(other) && (gap <= longest || !is_near(near, other))
            })
        };
        let kept: Vec<Candidate> = near.iter().filter(|candidate| is_shortest(candidate)).copied().collect();
        let some_are_gone = kept.len() < near.len();
        *near = kept;
        some_are_gone
    }
}
