//! Edges of a surface that follows: where it turns, as at the corner of two joints or where one joint goes round a corner.

use super::mortar::{Covered, Face, Joint, Plane, Point, natural, shapes};
use crate::common::vector::{dot, subtract};
use std::collections::BTreeMap;

/// The nodes of edges, each with the nodes that it follows and their weights.
pub(super) type Edges = BTreeMap<u32, Vec<(u32, f64)>>;

/// Cosine of the angle between normals from which a surface has an edge: about 53 degrees, more than between faces of coarse round bodies.
const SHARP: f64 = 0.6;

/// Weights below this are round-off.
const LEAST_WEIGHT: f64 = 1e-12;

/// The nodes of edges: each follows the point of the other side where it lies, of several joints the mean of these points.
pub(super) fn of(covered: &[Covered], joints: &[Joint], position: impl Fn(u32) -> [f64; 3]) -> Edges {
    let mut around: BTreeMap<u32, Vec<(usize, [f64; 3])>> = BTreeMap::new();
    for Covered { joint, face, normal, .. } in covered {
        face.iter().for_each(|&node| around.entry(node).or_default().push((*joint, *normal)));
    }
    around.retain(|_, normals| normals.iter().any(|(_, n)| dot(*n, normals[0].1) < SHARP));
    let followed = |(node, normals): (u32, Vec<(usize, [f64; 3])>)| {
        let mut own: Vec<usize> = normals.iter().map(|(joint, _)| *joint).collect();
        own.sort_unstable();
        own.dedup();
        let mut weights: BTreeMap<u32, f64> = BTreeMap::new();
        for joint in own {
            let faced = |normal: [f64; 3]| normals.iter().any(|(j, n)| *j == joint && dot(*n, normal) < -0.5);
            let found = where_it_lies(position(node), &joints[joint].leading, faced, &position);
            found.into_iter().for_each(|(leader, weight)| *weights.entry(leader).or_default() += weight);
        }
        let sum: f64 = weights.values().sum();
        (node, weights.into_iter().map(|(leader, weight)| (leader, weight / sum)).collect())
    };
    around.into_iter().map(followed).collect()
}

/// The corners of the nearest of these faces, with the values of their shape functions at a point: those of the face's plane where the point
/// hangs over its rim, so that linear fields are followed there too.
fn where_it_lies(
    at: [f64; 3],
    faces: &[Face],
    faced: impl Fn([f64; 3]) -> bool,
    position: impl Fn(u32) -> [f64; 3],
) -> Vec<(u32, f64)> {
    let (mut nearest, mut best) = (f64::INFINITY, Vec::new());
    for face in faces {
        let corners = face.map(&position);
        if square_to_box(at, &corners) > nearest {
            continue;
        }
        let Some(plane) = Plane::of(&corners).filter(|plane| faced(plane.normal)) else { continue };
        let place: Point = natural(&corners.map(|corner| plane.seen(corner)), plane.seen(at));
        let n = shapes(place.map(|xi| xi.clamp(-1.0, 1.0)));
        let there = [0, 1, 2].map(|i| (0..4).map(|k| n[k] * corners[k][i]).sum());
        let path = subtract(there, at);
        if dot(path, path) < nearest {
            nearest = dot(path, path);
            best = face.iter().copied().zip(shapes(place)).filter(|(_, weight)| weight.abs() > LEAST_WEIGHT).collect();
        }
    }
    best
}

/// Square of the distance to the box around some corners.
fn square_to_box(at: [f64; 3], corners: &[[f64; 3]; 4]) -> f64 {
    let beyond = |axis: usize| {
        let along = corners.map(|corner| corner[axis]);
        let low = along.iter().copied().fold(f64::INFINITY, f64::min);
        let high = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (low - at[axis]).max(at[axis] - high).max(0.0)
    };
    (0..3).map(|axis| beyond(axis).powi(2)).sum()
}
