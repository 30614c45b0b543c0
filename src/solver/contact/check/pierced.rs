//! Edges that begin going through faces of other bodies, where no node is inside: contact, which holds nodes and what comes together,
//! sees nothing of such an overlap.

use super::body_pairs::{BodyPairs, Known, box_of};
use super::edge_edge::lines::Crossing;
use super::edge_edge::{self, SUNK};
use super::initial_overlap::depth;
use super::unheld::{Place, Unheld};
use crate::common::vector::{add, cross, dot, normalized, scaled, subtract};
use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::Body;
use crate::solver::contact::geometry::projection::{self, area_normal, centre};
use crate::solver::contact::geometry::strip;
use crate::solver::contact::search::locate::Interface;
use crate::solver::contact::search::{Box3, Candidates, SearchKind};
use crate::solver::contact::surface::layout::Layout;
use std::collections::BTreeMap;

/// Both ends of an edge must be farther from a face than this part of it, and than the round-off of coordinates in single precision, in which
/// meshes may be written: what merely touches is nearer.
const CLEARLY: f64 = 1e-6;
const OF_COORDINATES: f64 = f32::EPSILON as f64;

/// Beyond the border of a triangle by this part of it is still on it: nothing goes through between two.
const BORDER: f64 = 1e-9;

/// Cosine between the normals of two faces of a rounded surface, where edges are chords.
const ROUNDED: f64 = 0.5;

/// Where an edge goes through a face.
#[derive(Debug, Clone, Copy)]
struct Piercing {
    face: u32,
    /// Part of the edge up to there.
    part: f64,
    /// Whether it comes out of the body of the face there.
    leaves: bool,
}

/// What the search needs.
struct Scene<'a> {
    mesh: &'a Mesh,
    model: &'a Model,
    body: &'a Body,
    layout: &'a Layout,
    pairs: &'a BodyPairs,
}

/// An edge that goes through a body and that nothing holds.
#[derive(Debug, Clone, Copy)]
struct Found {
    ends: [u32; 2],
    face: u32,
    at: [f64; 3],
    /// Depth below the surface, a length, that it does not exceed; 0 of surfaces, which have none.
    bound: f64,
}

/// Edges of faces of an interface that go through faces of other bodies between their ends, with both ends outside.
pub fn pierced(
    (mesh, model): (&Mesh, &Model),
    (body, layout, interface): (&Body, &Layout, &Interface),
    pairs: &BodyPairs,
) -> Unheld {
    let scene = Scene { mesh, model, body, layout, pairs };
    let box_and_body = |points: &[u32]| (box_of(body, layout, points), scene.body_of(points[0]));
    let may_overlap = |points: &[u32]| {
        let (around, of) = box_and_body(points);
        pairs.may_overlap(of, &around)
    };
    let faces: Vec<u32> =
        interface.faces.iter().copied().filter(|&face| may_overlap(&layout.faces.corners[face as usize])).collect();
    let mut edges: Vec<[u32; 2]> = faces.iter().flat_map(|&face| sides(layout.faces.corners[face as usize])).collect();
    edges.sort_unstable();
    edges.dedup();
    edges.retain(|ends| may_overlap(ends));
    let edge_boxes: Vec<Box3> = edges.iter().map(|ends| box_of(body, layout, ends)).collect();
    let boxes: Vec<Box3> =
        faces.iter().map(|&face| box_of(body, layout, &layout.faces.corners[face as usize])).collect();
    let mut near = Candidates::default();
    SearchKind::Grid.make().find(&edge_boxes, &boxes, &vec![[u32::MAX; 4]; boxes.len()], &mut near);
    let mut found = Vec::new();
    for (place, &ends) in edges.iter().enumerate() {
        scene.through_bodies(ends, near.of(place).iter().map(|&face| faces[face as usize]), &mut found);
    }
    scene.without_held(&mut found);
    scene.told(interface, found)
}

/// Pairs of neighbouring corners of a face, the lower number first.
fn sides(corners: [u32; 4]) -> impl Iterator<Item = [u32; 2]> {
    let sides = (0..4).map(move |i| [corners[i], corners[(i + 1) % 4]]);
    sides.filter(|[a, b]| a != b).map(|[a, b]| [a.min(b), a.max(b)])
}

/// Distance of a point from a straight line without ends; infinite where it has no length.
fn distance(at: [f64; 3], [a, b]: [[f64; 3]; 2]) -> f64 {
    let along = subtract(b, a);
    let product = cross(subtract(at, a), along);
    let square = dot(product, product) / dot(along, along);
    if square.is_finite() { square.sqrt() } else { f64::INFINITY }
}

impl Scene<'_> {
    fn at(&self, point: u32) -> [f64; 3] {
        self.body.positions[self.layout.nodes[point as usize] as usize]
    }

    fn body_of(&self, point: u32) -> u32 {
        self.pairs.body(self.layout.nodes[point as usize])
    }

    fn corners(&self, face: u32) -> [[f64; 3]; 4] {
        self.layout.faces.corners[face as usize].map(|corner| self.at(corner))
    }

    /// Adds the bodies of some faces that an edge goes through.
    fn through_bodies(&self, ends: [u32; 2], near: impl Iterator<Item = u32>, found: &mut Vec<Found>) {
        let own = self.body_of(ends[0]);
        let mut by_body: BTreeMap<u32, (Vec<Piercing>, Vec<u32>)> = BTreeMap::new();
        let line = ends.map(|end| self.at(end));
        for face in near {
            let other = self.body_of(self.layout.faces.corners[face as usize][0]);
            // Of the two faces of a surface at one place the upper one stands for both.
            let is_twin =
                self.layout.faces.is_two_sided(face) && !self.layout.faces.number[face as usize].is_multiple_of(6);
            if other != own && !is_twin && !self.are_apart(ends, face) {
                let (piercings, faces) = by_body.entry(other).or_default();
                self.piercings(line, face, piercings);
                faces.push(face);
            }
        }
        found.extend(by_body.into_values().filter_map(|(piercings, near)| self.through_body(ends, piercings, &near)));
    }

    /// Adds where a line clearly goes through a face.
    fn piercings(&self, [p, q]: [[f64; 3]; 2], face: u32, found: &mut Vec<Piercing>) {
        let corners = self.corners(face);
        let least = self.least(face, p, q);
        let borders = self.borders(face);
        let mut add_where = |normal: [f64; 3], on: [f64; 3], is_within: &dyn Fn([f64; 3]) -> bool| {
            let [from, to] = [p, q].map(|end| dot(subtract(end, on), normal));
            let crosses = from.min(to) < -least && from.max(to) > least;
            let part = from / (from - to);
            let at = add(p, scaled(subtract(q, p), part));
            // What touches the rim of a surface does not go through it.
            let is_on_rim = || borders.iter().flatten().any(|&border| distance(at, border) <= least);
            if crosses && is_within(at) && !is_on_rim() {
                found.push(Piercing { face, part, leaves: to > from });
            }
        };
        if let Some([a, b]) = strip::of(&corners) {
            let along = subtract(b, a);
            let is_within = |at| (-BORDER..=1.0 + BORDER).contains(&(dot(subtract(at, a), along) / dot(along, along)));
            let Some(normal) = normalized(area_normal(&corners)) else { return };
            return add_where(normal, a, &is_within);
        }
        let middle = centre(&corners);
        for i in 0..4 {
            let triangle = [middle, corners[i], corners[(i + 1) % 4]];
            let product = cross(subtract(triangle[1], middle), subtract(triangle[2], middle));
            let square = dot(product, product);
            let Some(normal) = normalized(product) else { continue };
            let is_within = |at: [f64; 3]| {
                (0..3).all(|k| {
                    let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                    dot(cross(subtract(b, a), subtract(at, a)), product) >= -BORDER * square
                })
            };
            add_where(normal, middle, &is_within);
        }
    }

    /// What is no more than round-off at a face, a length.
    fn least(&self, face: u32, p: [f64; 3], q: [f64; 3]) -> f64 {
        let farthest = [p, q].as_flattened().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        CLEARLY * self.layout.faces.size[face as usize] + OF_COORDINATES * farthest
    }

    /// Edges of a face at which a surface ends; those of a solid go on.
    fn borders(&self, face: u32) -> [Option<[[f64; 3]; 2]>; 4] {
        if !self.layout.faces.is_two_sided(face) {
            return [None; 4];
        }
        let (corners, bits) = (self.corners(face), self.layout.faces.borders_of(face));
        [0, 1, 2, 3].map(|i| (bits >> i & 1 == 1).then(|| [corners[i], corners[(i + 1) % 4]]))
    }

    /// Whether the deck lets an edge and a face not touch, or nothing could part them: both are of one rigid body.
    fn are_apart(&self, ends: [u32; 2], face: u32) -> bool {
        let layout = self.layout;
        let joined = |point: &u32| layout.joined.get(*point as usize).is_some_and(|others| !others.is_empty());
        let block = |point: u32| layout.point_block[point as usize];
        let kept = |&end: &u32| layout.exclusions.keep_apart(end, block(end), face, &layout.faces);
        let rigid = |block: u32| self.body.block_body[block as usize];
        let of_face = rigid(layout.faces.block[face as usize]);
        ends.iter().all(kept)
            || ends.iter().chain(&layout.faces.corners[face as usize]).any(joined)
            || of_face.is_some() && of_face == rigid(block(ends[0]))
    }

    /// An edge that goes through a body with both ends outside and by more than contact holds or than matters.
    fn through_body(&self, ends: [u32; 2], mut piercings: Vec<Piercing>, near: &[u32]) -> Option<Found> {
        piercings.sort_by(|a, b| a.part.total_cmp(&b.part).then(a.face.cmp(&b.face)));
        let [from, to] = ends.map(|end| self.at(end));
        let at = |part: f64| add(from, scaled(subtract(to, from), part));
        let is_surface = |piercing: &&Piercing| self.layout.faces.is_two_sided(piercing.face);
        if let Some(&Piercing { face, part, .. }) = piercings.iter().find(is_surface) {
            return Some(Found { ends, face, at: at(part), bound: 0.0 });
        }
        // An end inside is a node inside, which is known, moved out or told.
        if piercings.first()?.leaves || !piercings.last()?.leaves {
            return None;
        }
        let chords = piercings.windows(2).filter(|pair| !pair[0].leaves && pair[1].leaves);
        let deepest = chords.filter_map(|pair| {
            let (part, bound) = self.deepest_of_chord([from, to], [pair[0], pair[1]])?;
            let bound = self.depth_below(near, at(part)).min(bound);
            let found = Found { ends, face: pair[0].face, at: at(part), bound };
            (!self.is_shallow(&found, pair[1].face)).then_some(found)
        });
        deepest.max_by(|a, b| a.bound.total_cmp(&b.bound))
    }

    /// The part of a line up to where it is deepest below two faces through which it goes in and out, and how deep below both.
    fn deepest_of_chord(&self, [from, to]: [[f64; 3]; 2], [first, last]: [Piercing; 2]) -> Option<(f64, f64)> {
        let along = subtract(to, from);
        let fall = |face: u32| Some(dot(along, normalized(area_normal(&self.corners(face)))?).abs());
        let (into, out) = (fall(first.face)?, fall(last.face)?);
        let length = last.part - first.part;
        let sum = into + out;
        (sum > 0.0).then(|| (first.part + length * out / sum, length * into * out / sum))
    }

    /// How deep a point is at most below some faces of a body whose planes it is behind, or in.
    fn depth_below(&self, faces: &[u32], at: [f64; 3]) -> f64 {
        let of = |&face: &u32| {
            let projection = projection::project(&self.corners(face), at)?;
            let least = self.least(face, at, at);
            let is_below = projection.gap <= least && projection.outside <= (-projection.gap).max(least);
            is_below.then(|| (-projection.gap).max(0.0).hypot(projection.outside))
        };
        faces.iter().filter_map(of).fold(f64::INFINITY, f64::min)
    }

    /// Whether what goes in through the face of a chord and out through another is no deeper than contact holds, or than matters.
    fn is_shallow(&self, found: &Found, out: u32) -> bool {
        let faces = &self.layout.faces;
        let size = faces.size[found.face as usize].min(faces.size[out as usize]);
        let normal = |face: u32| normalized(area_normal(&self.corners(face))).unwrap_or_default();
        let is_rounded = dot(normal(found.face), normal(out)) > ROUNDED;
        let [from, to] = found.ends.map(|end| self.at(end));
        let least = self.least(found.face, from, to).max(self.least(out, from, to));
        if found.bound <= least || is_rounded && found.bound <= SUNK * size {
            return true;
        }
        let common: Vec<u32> = (faces.corners[found.face as usize].into_iter())
            .filter(|corner| faces.corners[out as usize].contains(corner))
            .collect();
        let &[a, b] = &common[..] else { return false };
        let edge = |[a, b]: [u32; 2]| self.layout.edge([a.min(b), a.max(b)].map(|p| self.layout.nodes[p as usize]));
        let (Some(own), Some(other)) = (edge(found.ends), edge([a, b])) else { return false };
        let lines = [found.ends, [a, b]].map(|ends| ends.map(|end| self.at(end)));
        let Some(crossing) = Crossing::of(lines) else { return false };
        let lines = [own, other].map(|edge| self.layout.edges[edge as usize]).into_iter();
        let of_line = lines.filter(|edge| !edge.stands_out()).map(|line| edge_edge::reach(faces, &line));
        let held = of_line.reduce(f64::min).unwrap_or(edge_edge::KEEP * crossing.shorter());
        crossing.gap.abs() < held
    }

    /// Leaves out what lies beside nodes that are behind faces of the other body: contact knows that overlap, and holds it there.
    fn without_held(&self, found: &mut Vec<Found>) {
        if found.is_empty() {
            return;
        }
        let of_face = |face: u32| self.body_of(self.layout.faces.corners[face as usize][0]);
        let sorted = |a: u32, b: u32| [a.min(b), a.max(b)];
        let mut places: BTreeMap<[u32; 2], Vec<[f64; 3]>> = BTreeMap::new();
        for Known { point, other, .. } in self.pairs.known((self.mesh, self.model), self.body, self.layout) {
            places.entry(sorted(self.body_of(point), other)).or_default().push(self.at(point));
        }
        let length = |a: [f64; 3], b: [f64; 3]| {
            let way = subtract(a, b);
            dot(way, way).sqrt()
        };
        found.retain(|one| {
            let [from, to] = one.ends.map(|end| self.at(end));
            let near = length(from, to) + self.layout.faces.size[one.face as usize];
            let known = places.get(&sorted(self.body_of(one.ends[0]), of_face(one.face)));
            !known.is_some_and(|known| known.iter().any(|&at| length(at, one.at) <= near))
        });
    }

    /// In numbers: how many edges, of which blocks, and the deepest.
    fn told(&self, interface: &Interface, mut found: Vec<Found>) -> Unheld {
        found.sort_by(|a, b| b.bound.total_cmp(&a.bound).then(a.ends.cmp(&b.ends)));
        let layout = self.layout;
        let blocks_of = |one: &Found| {
            [layout.point_block[one.ends[0] as usize], layout.faces.block[one.face as usize]]
                .map(|block| self.mesh.blocks[block as usize].id)
        };
        let place = |one: &Found, deepest: f64| Place {
            blocks: blocks_of(one),
            at: one.at,
            nodes: one.ends.map(|end| layout.nodes[end as usize]),
            element: self.body.element_order[layout.faces.number[one.face as usize] as usize / 6],
            deepest,
        };
        let mut worst = found.first().map(|one| place(one, 0.0));
        for one in &found {
            // What comes later is no deeper than its bound.
            if one.bound <= worst.map_or(0.0, |worst| worst.deepest) {
                break;
            }
            let of = self.body_of(layout.faces.corners[one.face as usize][0]);
            let of_body = |face: &u32| self.body_of(layout.faces.corners[*face as usize][0]) == of;
            let faces = interface.faces.iter().copied().filter(of_body);
            let exact = depth(self.body, layout, faces, one.at).min(one.bound);
            if worst.is_none_or(|worst| exact > worst.deepest) {
                worst = Some(place(one, exact));
            }
        }
        let pairs = found.iter().map(blocks_of);
        let mut edges: Vec<[u32; 2]> = found.iter().map(|one| one.ends).collect();
        edges.sort_unstable();
        edges.dedup();
        Unheld::new(edges.len(), pairs, worst)
    }
}
