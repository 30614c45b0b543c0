//! How far around itself an edge looks for others.

use super::{KEEP, SUNK};
use crate::solver::contact::geometry::edges::Edge;
use crate::solver::contact::geometry::faces::Faces;

/// How far around itself an edge looks for others, a length.
pub fn reach(faces: &Faces, edge: &Edge) -> f64 {
    if edge.stands_out() { KEEP * faces.size[edge.faces[0] as usize] } else { SUNK * scale(faces, edge) }
}

/// The same with elements as thick as they were at the start, farther than it ever looks.
pub fn farthest_reach(faces: &Faces, edge: &Edge) -> f64 {
    let line = SUNK * scale_at(edge, faces, |face| faces.start_depth(face));
    if edge.stands_out() { KEEP * faces.size[edge.faces[0] as usize] } else { line }
}

/// A bound of how far around themselves edges are searched for, with the distance at which they touch; a length.
pub fn largest_reach(faces: &Faces) -> f64 {
    let largest = |of: &[f64]| of.iter().copied().fold(0.0, f64::max);
    SUNK.max(KEEP) * largest(&faces.size) + largest(&faces.reach)
}

/// Length that what sinks in at a line is small against: the smaller of the faces' sizes, or half the element beneath.
pub(super) fn scale(faces: &Faces, line: &Edge) -> f64 {
    scale_at(line, faces, |face| faces.depth[face as usize])
}

fn scale_at(line: &Edge, faces: &Faces, depth: impl Fn(u32) -> f64) -> f64 {
    let of = |face: u32| faces.size[face as usize].min(depth(face) / SUNK);
    of(line.faces[0]).min(of(line.faces[1]))
}
