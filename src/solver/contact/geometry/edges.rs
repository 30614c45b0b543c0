//! Edges of the surface: which stand out, and which are lines of the mesh in faces that are bent a little, flat or nearly so.
//!
//! Edges stand out between faces that turn away from each other by more than a third of a right angle, and where faces are much longer
//! along the edge than across by less: a chord of length L between two nodes of another body sinks in by ½ L tan β/2 at a bend of β, where
//! no node needs to come near a face. Between bent lines the smaller of their bends says so, and from ten degrees on they meet each other, too. The bulge of a warped face has lines as well, its ridges: from two corners across from each other
//! to the middle of the face, which is the mean of all four.

use super::faces::Faces;
use super::motion::NodeMotion;
use super::projection::{area_normal, centre};
use crate::common::vector::{dot, scaled, subtract};

/// Largest cosine between the normals at an edge that stands out: 30 degrees.
const SHARP: f64 = 0.866;

/// The same at an edge that has stood out before: 20 degrees.
const BLUNT: f64 = 0.94;

/// Largest cosine between the normals at a line that is bent: 10 degrees. What flatter lines let through in between their nodes is less than 4.4 % of a face.
const BENT: f64 = 0.9848;

/// The same at a line that has been bent before: 7 degrees.
const FLAT: f64 = 0.9925;

/// So many times longer along an edge than across faces are to count as long.
const LONG: f64 = 4.0;

/// So many times longer than wide they count at most: the edges of needles do not stand out at any bend.
const LONGEST: f64 = 64.0;

/// A face has ridges from this height of its corners above the plane of its middle on, as a part of its size: what is less lets nothing
/// sink in by more.
const BULGE: f64 = 0.05;

/// The part of that height down to which it keeps them.
const FLATTENED: f64 = 0.7;

/// Edges that cross at a larger sine than this, at more than 18 degrees, hold each other at nodes as well. Flatter ones lie along each other in
/// folds, where their normal says little and nodes hold them.
pub const CLEAR_CROSSING: f64 = 0.31;

/// Least cosine between two edges of which one goes on where the other ends, unless it bends out of the body.
const STRAIGHT: f64 = 0.8;

/// How the faces at an edge lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// They turn away from each other: the edge stands out.
    StandsOut,
    /// They turn away from each other, but little: a line of the mesh, which meets other bent lines and edges that stand out.
    Bent,
    /// They go on with little or no bend: a line of the mesh, which meets only edges that stand out.
    Line,
    /// They fold towards each other, and are met before their edge, which takes no part.
    Hollow,
}

/// How an edge goes on at one of its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Onward {
    /// It ends there, or bends away from what meets it.
    Ends,
    /// Another edge of the mesh leads on nearly straight.
    Straight,
    /// One leads on that bends out of the body, by less than a right angle: what lies in the valley is held by both.
    Upwards,
}

/// A face as its edges see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side {
    /// Normal with the length of the area.
    pub normal: [f64; 3],
    /// Mean of the corners.
    pub middle: [f64; 3],
    /// Height of the first corner and of that across from it above the plane of the middle; the others are as far below it. A length.
    pub warp: f64,
}

impl Shape {
    /// A number for each.
    pub fn code(self) -> u32 {
        match self {
            Shape::StandsOut => 0,
            Shape::Line => 1,
            Shape::Hollow => 2,
            Shape::Bent => 3,
        }
    }

    /// The shape of a number.
    pub fn from_code(code: u32) -> Shape {
        match code {
            0 => Shape::StandsOut,
            1 => Shape::Line,
            3 => Shape::Bent,
            _ => Shape::Hollow,
        }
    }

    /// The shape of an edge between two faces. One that stood out `before`, or was bent, does so a little longer, lest it come and go.
    pub fn of(first: Side, second: Side, before: Shape) -> Shape {
        let (n, m) = (first.normal, second.normal);
        let areas = (dot(n, n) * dot(m, m)).sqrt();
        // Over the distance between their middles the area is the length of the edge: tan² β/2 grows with the square of the ratio.
        let across = subtract(second.middle, first.middle);
        let longer = (areas.sqrt() / dot(across, across)).min(LONGEST);
        let longer = if longer < LONG { 1.0 } else { longer };
        let is_flatter =
            |cosine: f64| (areas - dot(n, m)) * (1.0 + cosine) * longer <= (areas + dot(n, m)) * (1.0 - cosine);
        let is_sharp = !is_flatter(if before == Shape::StandsOut { BLUNT } else { SHARP });
        let was_bent = matches!(before, Shape::StandsOut | Shape::Bent);
        match dot(across, n) < 0.0 {
            true if is_sharp => Shape::StandsOut,
            false if is_sharp => Shape::Hollow,
            true if !is_flatter(if was_bent { FLAT } else { BENT }) => Shape::Bent,
            _ => Shape::Line,
        }
    }
}

/// An edge of the outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Its ends, the lower number first; of ridges the corners from which they go to the middle of the face.
    pub ends: [u32; 2],
    /// The faces on both sides; of ridges their face twice.
    pub faces: [u32; 2],
    /// How the faces lie.
    pub shape: Shape,
    /// How they lie in the mesh.
    pub in_mesh: Shape,
}

impl Edge {
    /// Whether it stands for two ridges of a face.
    pub fn is_ridge(&self) -> bool {
        self.faces[0] == self.faces[1]
    }

    /// The points on which it hangs: its ends, twice, or the corners of the face of ridges.
    #[inline(always)]
    pub fn points(&self, faces: &Faces) -> [u32; 4] {
        let [a, b] = self.ends;
        if self.is_ridge() { faces.corners[self.faces[0] as usize] } else { [a, b, a, b] }
    }

    /// Whether it stands out.
    pub fn stands_out(&self) -> bool {
        self.shape == Shape::StandsOut
    }

    /// How it lies when its faces lie so. An edge of a surface, which has no inside, always stands out: it meets all others, that
    /// no line of a sheet sinks in between the nodes of another, however it comes to be bent. Ridges are there while the face bulges.
    pub fn shape_between(&self, first: Side, second: Side, faces: &Faces) -> Shape {
        if self.is_ridge() {
            return if self.bulges(first.warp, faces) { Shape::Line } else { Shape::Hollow };
        }
        if self.is_of_surface(faces) { Shape::StandsOut } else { Shape::of(first, second, self.shape) }
    }

    /// Whether the face of ridges bulges outwards along them.
    fn bulges(&self, warp: f64, faces: &Faces) -> bool {
        let face = self.faces[0] as usize;
        let [a, _, c, _] = faces.corners[face];
        let along = if self.ends.contains(&a) && self.ends.contains(&c) { warp } else { -warp };
        let least = BULGE * faces.size[face];
        along > if self.shape == Shape::Line { FLATTENED * least } else { least }
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

/// The two faces that stand for an edge: of a solid those that meet there, whatever surfaces end there as well; of several surface elements two
/// that look the same way, or any two of different ones; of one surface element both. `None` where more faces of solids meet.
fn pair_at(same: &[([u32; 2], u32)], faces: &Faces) -> Option<[u32; 2]> {
    let (surfaces, solids): (Vec<u32>, Vec<u32>) =
        same.iter().map(|(_, face)| *face).partition(|&face| faces.is_two_sided(face));
    match (&solids[..], &surfaces[..]) {
        (&[a, b], _) => Some([a, b]),
        (&[], &[a, b]) => Some([a, b]),
        (&[], &[a, ref others @ ..]) => {
            let element = |face: u32| faces.number[face as usize] / 6;
            let of_others = || others.iter().copied().filter(|&other| element(other) != element(a));
            let other =
                of_others().find(|&other| faces.go_on(a, other) == Some(true)).or_else(|| of_others().next())?;
            Some([a, other])
        }
        _ => None,
    }
}

/// Edges between two of some faces, and with `ridges` those of each, in ascending order of their ends.
pub fn between(chosen: &[u32], faces: &Faces, positions: &[[f64; 3]], ridges: bool) -> Vec<Edge> {
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
    let of_chosen = |face: u32| side(&faces.corners[face as usize].map(|p| positions[p as usize]));
    let shaped = |edge: Edge| {
        let [first, second] = edge.faces.map(of_chosen);
        let shape = edge.shape_between(first, second, faces);
        Edge { shape, in_mesh: shape, ..edge }
    };
    let unshaped = |ends, faces| Edge { ends, faces, shape: Shape::Hollow, in_mesh: Shape::Hollow };
    let mut edges: Vec<Edge> = (sides.chunk_by(|a, b| a.0 == b.0))
        .filter_map(|same| Some(shaped(unshaped(same[0].0, pair_at(same, faces)?))))
        .collect();
    // Ends say which edge is meant: of two with the same ends there is one, a side before ridges.
    let with_ridges = chosen.iter().copied().filter(|_| ridges);
    let of_faces =
        with_ridges.flat_map(|face| diagonals(face, faces).into_iter().flatten().map(move |ends| (ends, face)));
    let mut of_faces: Vec<([u32; 2], u32)> = of_faces.collect();
    of_faces.sort_unstable();
    of_faces.dedup_by_key(|(ends, _)| *ends);
    of_faces.retain(|(ends, _)| sides.binary_search_by(|(own, _)| own.cmp(ends)).is_err());
    edges.extend(of_faces.into_iter().map(|(ends, face)| shaped(unshaped(ends, [face; 2]))));
    edges.sort_unstable_by_key(|edge| edge.ends);
    edges.shrink_to_fit();
    edges
}

/// Ends of the ridges that a face of a solid may have: none of a triangle. In folds of surfaces ridges let more through than they hold
/// (docs/decisions.md, "A bulge has ridges").
fn diagonals(face: u32, faces: &Faces) -> Option<[[u32; 2]; 2]> {
    let [a, b, c, d] = faces.corners[face as usize];
    let has_four_sides = a != b && b != c && c != d && d != a;
    (has_four_sides && !faces.is_two_sided(face)).then(|| [[a.min(c), a.max(c)], [b.min(d), b.max(d)]])
}

/// How an edge along one vector is continued by one along another. `outwards` is a vector out of its body, of any length.
pub fn bend(along: [f64; 3], onwards: [f64; 3], outwards: [f64; 3]) -> Onward {
    let [length, next] = [along, onwards].map(|arm| dot(arm, arm).sqrt());
    if dot(along, onwards) <= 0.0 {
        Onward::Ends
    } else if dot(onwards, outwards) * length > dot(along, outwards) * next {
        Onward::Upwards
    } else {
        straight(along, onwards)
    }
}

/// The same, whether or not it is nearly straight.
fn straight(along: [f64; 3], onwards: [f64; 3]) -> Onward {
    let lengths = dot(along, along).sqrt() * dot(onwards, onwards).sqrt();
    if dot(along, onwards) > STRAIGHT * lengths { Onward::Straight } else { Onward::Ends }
}

/// How an edge, from a point to its end, goes on there at the beginning of the step: by that edge of the mesh which counts most. Upwards leads
/// only a sharp one, if it is the only one there beside this: where more meet is a corner, and held by all of them it could not get away.
pub fn onward(faces: &Faces, motion: &NodeMotion, [from, end]: [u32; 2], outwards: [f64; 3]) -> Onward {
    let to = |other: u32| subtract(motion.start(other), motion.start(end));
    let along = scaled(to(from), -1.0);
    let around = faces.around(end);
    let others = others_around(faces, [from, end]);
    let is_sharp = |other: &&u32| {
        let has = |face: &&u32| faces.corners[**face as usize].contains(*other);
        let mut both = around.iter().filter(has);
        let (first, second) = (both.next(), both.next());
        first.zip(second).is_some_and(|(&first, &second)| is_sharp_between(faces, motion, [first, second]))
    };
    let best = others.iter().map(|&other| bend(along, to(other), outwards)).max().unwrap_or(Onward::Ends);
    if best != Onward::Upwards {
        return best;
    }
    let mut sharp = others.iter().filter(is_sharp);
    match (sharp.next(), sharp.next()) {
        (Some(&only), None) => bend(along, to(only), outwards),
        _ => others.iter().map(|&other| straight(along, to(other))).max().unwrap_or(Onward::Ends),
    }
}

/// Points to which an edge, from a point to its end, goes on there at the beginning of the step, see [`onward`].
pub fn leading_on(
    faces: &Faces,
    motion: &NodeMotion,
    [from, end]: [u32; 2],
    outwards: [f64; 3],
) -> impl Iterator<Item = u32> {
    let to = move |other: u32| subtract(motion.start(other), motion.start(end));
    let along = scaled(to(from), -1.0);
    let leads_on = move |&other: &u32| bend(along, to(other), outwards) != Onward::Ends;
    others_around(faces, [from, end]).into_iter().filter(leads_on)
}

/// Points to which edges of the mesh lead from the end of one, but for the point from which that comes, ascending.
fn others_around(faces: &Faces, [from, end]: [u32; 2]) -> Vec<u32> {
    let around = faces.around(end).iter();
    let mut others: Vec<u32> = around.flat_map(|&face| beside(faces.corners[face as usize], end)).collect();
    others.sort_unstable();
    others.dedup();
    others.retain(|&other| other != from);
    others
}

/// Corners of a face beside one of them.
fn beside(corners: [u32; 4], point: u32) -> impl Iterator<Item = u32> {
    let sides = (0..4).map(move |i| [corners[i], corners[(i + 1) % 4]]);
    let of_point = sides.filter(move |[a, b]| a != b && (*a == point || *b == point));
    of_point.map(move |[a, b]| if a == point { b } else { a })
}

/// Whether two faces turn away from each other at the edge that they share, at the beginning of the step.
pub fn is_sharp_between(faces: &Faces, motion: &NodeMotion, both: [u32; 2]) -> bool {
    let [first, second] = both.map(|face| side(&faces.start(face, motion)));
    Shape::of(first, second, Shape::Line) == Shape::StandsOut
}

/// A face by its corners.
pub fn side(corners: &[[f64; 3]; 4]) -> Side {
    let (normal, middle) = (area_normal(corners), centre(corners));
    let length = dot(normal, normal).sqrt();
    let warp = if length > 0.0 { dot(subtract(corners[0], middle), normal) / length } else { 0.0 };
    Side { normal, middle, warp }
}

/// Whether two edges may ever touch: they have no end in common and belong to different elements.
pub fn unrelated(a: &Edge, b: &Edge, faces: &Faces) -> bool {
    let apart = |edge: &Edge, faces_of: &Edge| {
        faces_of.faces.iter().all(|&face| !edge.ends.iter().all(|&end| faces.same_element(face, end)))
    };
    let points = b.points(faces);
    !a.points(faces).iter().any(|point| points.contains(point)) && apart(a, b) && apart(b, a)
}
