//! Edges of the surface: which stand out, and which are lines of the mesh in faces that are flat or nearly so.
//!
//! Edges stand out between faces that turn away from each other by more than a third of a right angle.

use super::faces::Faces;
use super::projection::{area_normal, centre};
use crate::common::vector::{dot, subtract};

/// Largest cosine between the normals at an edge that stands out: 30 degrees.
const SHARP: f64 = 0.866;

/// The same at an edge that has stood out before: 20 degrees.
const BLUNT: f64 = 0.94;

/// How the faces at an edge lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// They turn away from each other: the edge stands out.
    StandsOut,
    /// They go on with little or no bend: a line of the mesh, which meets only edges that stand out.
    Line,
    /// They fold towards each other, and are met before their edge, which takes no part.
    Hollow,
}

/// Area normal and middle of a face.
pub type Side = ([f64; 3], [f64; 3]);

impl Shape {
    /// A number for each.
    pub fn code(self) -> u32 {
        match self {
            Shape::StandsOut => 0,
            Shape::Line => 1,
            Shape::Hollow => 2,
        }
    }

    /// The shape of a number.
    pub fn from_code(code: u32) -> Shape {
        match code {
            0 => Shape::StandsOut,
            1 => Shape::Line,
            _ => Shape::Hollow,
        }
    }

    /// The shape of an edge between two faces. One that `stood_out` before does so a little longer, lest it come and go.
    pub fn of((n, a): Side, (m, b): Side, stood_out: bool) -> Shape {
        let least = if stood_out { BLUNT } else { SHARP };
        if dot(n, m) >= least * (dot(n, n) * dot(m, m)).sqrt() {
            Shape::Line
        } else if dot(subtract(b, a), n) < 0.0 {
            Shape::StandsOut
        } else {
            Shape::Hollow
        }
    }
}

/// An edge of the outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Its ends, the lower number first.
    pub ends: [u32; 2],
    /// The faces on both sides.
    pub faces: [u32; 2],
    /// How the faces lie.
    pub shape: Shape,
    /// How they lie in the mesh.
    pub in_mesh: Shape,
}

impl Edge {
    /// Whether it stands out.
    pub fn stands_out(&self) -> bool {
        self.shape == Shape::StandsOut
    }

    /// How it lies when its faces lie so. An edge of a surface, which has no inside, always stands out: it meets all others, that
    /// no line of a sheet sinks in between the nodes of another, however it comes to be bent.
    pub fn shape_between(&self, first: Side, second: Side, faces: &Faces) -> Shape {
        if self.is_of_surface(faces) { Shape::StandsOut } else { Shape::of(first, second, self.stands_out()) }
    }

    /// Whether it is an edge of a surface, which can be met from all around.
    pub fn is_of_surface(&self, faces: &Faces) -> bool {
        self.faces.iter().all(|&face| faces.is_two_sided(face))
    }

    /// Distance at which it touches, a length.
    pub fn distance(&self, faces: &Faces) -> f64 {
        self.faces.iter().map(|&face| faces.reach[face as usize]).fold(0.0, f64::max)
    }
}

/// The two faces that stand for an edge: those that meet there; of the four of two surface elements two that look the same way, of
/// one surface element both. `None` where others meet.
fn pair_at(same: &[([u32; 2], u32)], faces: &Faces) -> Option<[u32; 2]> {
    match *same {
        [(_, a), (_, b)] if faces.is_two_sided(a) == faces.is_two_sided(b) => Some([a, b]),
        [(_, a), (_, b), (_, c), (_, d)] if [a, b, c, d].iter().all(|&face| faces.is_two_sided(face)) => {
            let other = [b, c, d].into_iter().find(|&other| {
                faces.number[other as usize] / 6 != faces.number[a as usize] / 6 && faces.go_on(a, other) == Some(true)
            })?;
            Some([a, other])
        }
        _ => None,
    }
}

/// Edges between two of some faces, in ascending order of their ends.
pub fn between(chosen: &[u32], faces: &Faces, positions: &[[f64; 3]]) -> Vec<Edge> {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(4 * chosen.len());
    for &face in chosen {
        let corners = faces.corners[face as usize];
        for i in 0..4 {
            let (a, b) = (corners[i], corners[(i + 1) % 4]);
            if a != b {
                sides.push(([a.min(b), a.max(b)], face));
            }
        }
    }
    sides.sort_unstable();
    let side = |face: u32| side(&faces.corners[face as usize].map(|p| positions[p as usize]));
    let mut edges: Vec<Edge> = (sides.chunk_by(|a, b| a.0 == b.0))
        .filter_map(|same| {
            let [first, second] = pair_at(same, faces)?;
            let edge = Edge { ends: same[0].0, faces: [first, second], shape: Shape::Hollow, in_mesh: Shape::Hollow };
            let shape = edge.shape_between(side(first), side(second), faces);
            Some(Edge { shape, in_mesh: shape, ..edge })
        })
        .collect();
    edges.shrink_to_fit();
    edges
}

/// Area normal and middle of a face.
pub fn side(corners: &[[f64; 3]; 4]) -> Side {
    (area_normal(corners), centre(corners))
}

/// Whether two edges may ever touch: they have no end in common and belong to different elements.
pub fn unrelated(a: &Edge, b: &Edge, faces: &Faces) -> bool {
    let apart = |edge: &Edge, faces_of: &Edge| {
        faces_of.faces.iter().all(|&face| !edge.ends.iter().all(|&end| faces.same_element(face, end)))
    };
    !a.ends.iter().any(|end| b.ends.contains(end)) && apart(a, b) && apart(b, a)
}
