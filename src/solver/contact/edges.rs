//! Edges against edges: two edges that cross meet where no node meets a face, as when a corner hits an edge.
//!
//! Only edges that stand out take part, those between faces that turn away from each other by more than a third of a
//! right angle at the start or when erosion lays them bare. The check is that of nodes and faces: by motion for a pair that
//! comes anew, where it would be at the end of the step for one that has touched before.

use super::cubic;
use super::detect::FADE;
use super::enforce::{Constraint, MEMBERS, Origin};
use super::face::{area_normal, centre};
use super::faces::Faces;
use super::points::Points;
use super::search::Box3;
use super::setup::Pairing;
use crate::solver::nodes::{add, cross, dot, scaled, subtract};

/// Largest cosine between the normals at an edge that stands out: 30 degrees.
const SHARP: f64 = 0.866;

/// Smallest sine of the angle between edges that meet: nearly parallel edges are for nodes and faces.
const CROSSING: f64 = 0.05;

/// A pair that has parted by less than this part of an edge is still watched.
const KEEP: f64 = 0.01;

/// Pairs that overlap by more than this part of an edge did not come through each other.
const DEEP: f64 = 0.25;

/// An edge of the outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Its ends, the lower number first.
    pub ends: [u32; 2],
    /// The faces on both sides.
    pub faces: [u32; 2],
}

/// Two edges that touch: their numbers, and which way the first is pushed along the product of their directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PastPair {
    /// The edges, ascending.
    pub pair: [u32; 2],
    /// +1 or −1.
    pub sense: f64,
    /// Overlap that is tolerated because it was not made by motion; at most 0.
    pub allowed: f64,
    /// Normal force on the first edge in the last step.
    pub push: f64,
    /// Friction force on it.
    pub drag: [f64; 3],
}

/// Edges of some faces that stand out, in ascending order of their ends.
pub fn standing_out(chosen: &[u32], faces: &Faces, positions: &[[f64; 3]]) -> Vec<Edge> {
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
    let corners = |face: u32| faces.corners[face as usize].map(|p| positions[p as usize]);
    let sharp = |first: u32, second: u32| {
        let (a, b) = (corners(first), corners(second));
        let (n, m) = (area_normal(&a), area_normal(&b));
        let lengths = (dot(n, n) * dot(m, m)).sqrt();
        dot(n, m) < SHARP * lengths && dot(subtract(centre(&b), centre(&a)), n) < 0.0
    };
    (sides.chunk_by(|a, b| a.0 == b.0))
        .filter_map(|same| match same {
            &[(ends, first), (_, second)] if sharp(first, second) => Some(Edge { ends, faces: [first, second] }),
            _ => None,
        })
        .collect()
}

/// Where two edges are nearest to each other.
struct Crossing {
    /// Unit normal to both, in the sense of the product of their directions.
    normal: [f64; 3],
    /// Places along the edges, 0 to 1 between the ends.
    places: [f64; 2],
    /// Way from the second to the first, along the normal.
    gap: f64,
    /// Lengths of the edges.
    lengths: [f64; 2],
}

impl Crossing {
    /// `None` for edges that are nearly parallel or have no length.
    fn of(a: [[f64; 3]; 2], b: [[f64; 3]; 2]) -> Option<Crossing> {
        let (u, v, r) = (subtract(a[1], a[0]), subtract(b[1], b[0]), subtract(b[0], a[0]));
        let product = cross(u, v);
        let (uu, vv, square) = (dot(u, u), dot(v, v), dot(product, product));
        if square.is_nan() || square <= CROSSING * CROSSING * uu * vv {
            return None;
        }
        let places = [dot(cross(r, v), product) / square, dot(cross(r, u), product) / square];
        let length = square.sqrt();
        let normal = scaled(product, 1.0 / length);
        Some(Crossing { normal, places, gap: -dot(r, normal), lengths: [uu.sqrt(), vv.sqrt()] })
    }

    /// Whether they cross between their ends, by more than `depth` from every end: nearer to an end, a node or another
    /// edge is in the way before these two.
    fn between_ends(&self, depth: f64) -> bool {
        (0..2).all(|i| self.places[i].min(1.0 - self.places[i]) * self.lengths[i] > depth)
    }

    fn shorter(&self) -> f64 {
        self.lengths[0].min(self.lengths[1])
    }
}

/// The check of edges against edges.
pub struct EdgeCheck<'a> {
    /// Points.
    pub points: &'a Points,
    /// Faces.
    pub faces: &'a Faces,
    /// Edges.
    pub edges: &'a [Edge],
}

impl EdgeCheck<'_> {
    fn start(&self, edge: u32) -> [[f64; 3]; 2] {
        let [a, b] = self.edges[edge as usize].ends;
        [self.points.start[a as usize], self.points.start[b as usize]]
    }

    fn end(&self, edge: u32) -> [[f64; 3]; 2] {
        let [a, b] = self.edges[edge as usize].ends;
        [self.points.end(a), self.points.end(b)]
    }

    /// Box around the way of an edge over the step.
    fn way(&self, edge: u32) -> Box3 {
        let ([a, b], [c, d]) = (self.start(edge), self.end(edge));
        Box3::around(&[a, b, c, d])
    }

    /// Whether two edges touch in the coming step: the pair to remember and its constraint.
    pub fn pair(&self, pair: [u32; 2], past: Option<&PastPair>, pairing: Pairing) -> Option<(PastPair, Constraint)> {
        let margin = past.map_or(0.0, |_| keep(self.faces, &self.edges[pair[0] as usize]));
        if !self.way(pair[0]).grown(margin).overlaps(&self.way(pair[1])) {
            return None;
        }
        let end = Crossing::of(self.end(pair[0]), self.end(pair[1]))?;
        let now = match past {
            // What has opened does not close again for nothing.
            Some(past) => PastPair { allowed: (FADE * past.allowed).max((past.sense * end.gap).min(0.0)), ..*past },
            None => self.newcomer(pair, &end)?,
        };
        let gap = now.sense * end.gap - now.allowed;
        let reach = end.shorter();
        if !end.between_ends((-gap).max(0.0)) || gap > KEEP * reach || gap < -DEEP * reach {
            return None;
        }
        Some((now, self.constraint(pair, &end, &now, gap, pairing)))
    }

    /// A pair that has not touched before: it must come together within the step, both edges from outside.
    fn newcomer(&self, pair: [u32; 2], end: &Crossing) -> Option<PastPair> {
        let start = Crossing::of(self.start(pair[0]), self.start(pair[1]))?;
        // Turning through parallel within a step leaves no sense to compare.
        if dot(start.normal, end.normal) <= 0.0 || start.gap == 0.0 {
            return None;
        }
        let outwards = |sense: f64, normal: [f64; 3]| {
            let out = |edge: u32| {
                let [a, b] = self.edges[edge as usize].faces;
                add(area_normal(&self.faces.start(a, self.points)), area_normal(&self.faces.start(b, self.points)))
            };
            // Pushed along the normal, the first edge goes back into its own body.
            sense * dot(normal, out(pair[0])) < 0.0 && sense * dot(normal, out(pair[1])) > 0.0
        };
        let sense = start.gap.signum();
        let touch = |sense, allowed| PastPair { pair, sense, allowed, push: 0.0, drag: [0.0; 3] };
        if outwards(sense, start.normal) && sense * end.gap < 0.0 {
            return self.meets(pair).then_some(touch(sense, 0.0));
        }
        // Overlapping from the start, made by other contacts: seen as soon as it is shallow and between the ends.
        let depth = start.gap.abs();
        let sense = -sense;
        (outwards(sense, start.normal) && depth < KEEP * start.shorter() && start.between_ends(depth))
            .then_some(touch(sense, -depth))
    }

    /// Whether the edges come into one plane within the step, and there between their ends.
    fn meets(&self, pair: [u32; 2]) -> bool {
        let path = |edge: u32, end: usize| self.points.path(self.edges[edge as usize].ends[end]);
        let (a, b) = ([path(pair[0], 0), path(pair[0], 1)], [path(pair[1], 0), path(pair[1], 1)]);
        let volume =
            cubic::coplanarity(cubic::relative(b[0], a[0]), cubic::relative(a[1], a[0]), cubic::relative(b[1], b[0]));
        cubic::roots(&volume).any(|t| {
            let at = |path: &cubic::Path| add(path.0, scaled(path.1, t));
            Crossing::of([at(&a[0]), at(&a[1])], [at(&b[0]), at(&b[1])]).is_some_and(|c| c.between_ends(0.0))
        })
    }

    /// Places where the edges see each other at the beginning of the step, along the normal of its end: forces there have
    /// no moment.
    fn places_along(&self, pair: [u32; 2], end: &Crossing) -> [f64; 2] {
        let [a, b] = pair.map(|edge| self.start(edge));
        let (u, v, r) = (subtract(a[1], a[0]), subtract(b[1], b[0]), subtract(b[0], a[0]));
        let volume = dot(end.normal, cross(u, v));
        let places = [dot(end.normal, cross(r, v)) / volume, dot(end.normal, cross(r, u)) / volume];
        if places.iter().all(|place| (-0.5..=1.5).contains(place)) { places } else { end.places }
    }

    fn constraint(&self, pair: [u32; 2], end: &Crossing, now: &PastPair, gap: f64, pairing: Pairing) -> Constraint {
        let [a, b] = [self.edges[pair[0] as usize].ends, self.edges[pair[1] as usize].ends];
        let [s, t] = self.places_along(pair, end);
        Constraint {
            members: [a[0], a[1], b[0], b[1], a[0]],
            weights: [1.0 - s, s, t - 1.0, -t, 0.0],
            count: MEMBERS - 1,
            normal: scaled(end.normal, now.sense),
            gap,
            size: end.shorter(),
            share: pairing.share,
            friction: pairing.friction,
            push: now.push,
            drag: now.drag,
            origin: Origin::Edges(pair[0], pair[1]),
        }
    }
}

/// How far around itself an edge looks for others.
pub fn keep(faces: &Faces, edge: &Edge) -> f64 {
    KEEP * faces.size[edge.faces[0] as usize]
}

/// Whether two edges may ever touch: they have no end in common and belong to different elements.
pub fn strangers(a: &Edge, b: &Edge, faces: &Faces) -> bool {
    let apart = |edge: &Edge, faces_of: &Edge| {
        faces_of.faces.iter().all(|&face| !edge.ends.iter().all(|&end| faces.same_element(face, end)))
    };
    !a.ends.iter().any(|end| b.ends.contains(end)) && apart(a, b) && apart(b, a)
}
