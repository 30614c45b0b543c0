//! Location: which points come near which faces. The search is repeated only when a point has used up its reach.

use super::bounds::Bounds;
use super::detect::{NONE, Past, TOUCHES};
use super::edges::{self, Edge};
use super::faces::Faces;
use super::points::Points;
use super::search::{Box3, Candidates, Search, SearchKind};

/// Points and faces that may touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    /// Whether a point takes part.
    pub points: Vec<bool>,
    /// Faces that take part, ascending.
    pub faces: Vec<u32>,
    /// What holds where they touch.
    pub rule: Rule,
}

/// Where friction and partition of an interface come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// From the blocks of point and face.
    Blocks,
    /// From a table, by number.
    Pair(u32),
}

/// A face near a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Near {
    /// The face.
    pub face: u32,
    /// The interface to which the two belong.
    pub interface: u32,
}

/// How far points may go before the search is repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Multiple of the way that a point goes in the present step.
    pub steps: f64,
    /// Smallest reach, a length.
    pub least: f64,
    /// How far a face looks beyond its corners in a step, as a part of half its element: a little, for points that have
    /// just left it; all of it, to find points that are behind it at the start. Searches look as far as all of it.
    pub depth: f64,
}

/// Candidates and how long they hold.
pub struct Locator {
    search: Box<dyn Search>,
    reach: Reach,
    /// Where every point was at the last search.
    reference: Vec<[f64; 3]>,
    /// How far it may go from there along each axis.
    allowance: Vec<f64>,
    /// Points with candidates, ascending, and where their candidates begin.
    watched: Vec<u32>,
    first: Vec<u32>,
    near: Vec<Near>,
    /// For each watched point, how far things must have gone in all until one of its candidates may be near.
    due: Vec<f64>,
    /// How far things have gone in all, counted as if the fastest point of each step were always the same.
    gone: f64,
    /// How much of that in the present step.
    last_way: f64,
    /// Points that are watched or corners of candidates, and where each was at the last step.
    moving: Vec<(u32, [f64; 3])>,
    ways: Ways,
    found: Vec<Candidates>,
    edge_pairs: Vec<[u32; 2]>,
    /// Number of searches so far.
    pub searches: u64,
}

/// Boxes around the ways of the present step, made when they are first asked for.
#[derive(Default)]
struct Ways {
    step: u32,
    points: Vec<(u32, Bounds)>,
    faces: Vec<(u32, Bounds)>,
}

impl Ways {
    fn next_step(&mut self, points: usize, faces: usize) {
        self.step = self.step.wrapping_add(1);
        if self.step == 1 || self.points.len() != points || self.faces.len() != faces {
            self.step = 1;
            self.points.clear();
            self.points.resize(points, (0, Bounds::EVERYTHING));
            self.faces.clear();
            self.faces.resize(faces, (0, Bounds::EVERYTHING));
        }
    }

    fn point(&mut self, points: &Points, point: u32) -> Bounds {
        let (step, bounds) = &mut self.points[point as usize];
        if std::mem::replace(step, self.step) != self.step {
            *bounds = Bounds::around(points.start[point as usize], points.end[point as usize]);
        }
        *bounds
    }

    /// Capture box of a face: its corners at the beginning and at the end of the step, and a little around.
    fn face(&mut self, points: &Points, faces: &Faces, face: u32, margin: f64) -> Bounds {
        if self.faces[face as usize].0 != self.step {
            let corners = faces.corners[face as usize].map(|corner| self.point(points, corner));
            let bounds = Bounds::joined(&corners, (margin * faces.depth[face as usize]) as f32);
            self.faces[face as usize] = (self.step, bounds);
        }
        self.faces[face as usize].1
    }
}

impl Locator {
    /// A locator that has not searched yet.
    pub fn new(kind: SearchKind, reach: Reach) -> Locator {
        Locator {
            search: kind.make(),
            reach,
            reference: Vec::new(),
            allowance: Vec::new(),
            watched: Vec::new(),
            first: Vec::new(),
            near: Vec::new(),
            due: Vec::new(),
            gone: 0.0,
            last_way: 0.0,
            moving: Vec::new(),
            ways: Ways::default(),
            found: Vec::new(),
            edge_pairs: Vec::new(),
            searches: 0,
        }
    }

    /// Forgets the candidates, because the surface has changed.
    pub fn forget(&mut self) {
        self.reference.clear();
    }

    /// Makes sure that the candidates hold for the coming step, and finds the boxes of their faces.
    /// True after a new search.
    pub fn locate(&mut self, points: &Points, faces: &Faces, interfaces: &[Interface], edges: &[Edge]) -> bool {
        let expired = self.expired(points);
        if expired {
            self.search(points, faces, interfaces);
            self.search_edges(points, faces, edges);
        }
        self.ways.next_step(points.len(), faces.len());
        self.last_way = self.longest_way(points);
        self.gone += self.last_way;
        expired
    }

    /// The farthest that a point which matters has gone since the last step or will go in this one, along an axis.
    fn longest_way(&mut self, points: &Points) -> f64 {
        let mut farthest = [0.0; 3];
        let mut sound = true;
        for (point, before) in &mut self.moving {
            let (start, end) = (&points.start[*point as usize], &points.end[*point as usize]);
            for i in 0..3 {
                let (last, next) = ((start[i] - before[i]).abs(), (end[i] - start[i]).abs());
                let way = if last > next { last } else { next };
                sound &= way <= f64::MAX;
                farthest[i] = if way > farthest[i] { way } else { farthest[i] };
            }
            *before = *start;
        }
        // A way that is not a number leaves nobody at rest.
        if sound { farthest[0].max(farthest[1]).max(farthest[2]) } else { f64::INFINITY }
    }

    /// Whether a point has left the box that the last search gave it.
    fn expired(&self, points: &Points) -> bool {
        if self.reference.len() != points.len() {
            return true;
        }
        let positions = points.start.iter().zip(&points.end);
        self.reference.iter().zip(&self.allowance).zip(positions).any(|((reference, allowance), (start, end))| {
            // A position that is not a number is not away.
            let away = |i: usize| {
                ((start[i] - reference[i]).abs() > *allowance) | ((end[i] - reference[i]).abs() > *allowance)
            };
            away(0) | away(1) | away(2)
        })
    }

    fn search(&mut self, points: &Points, faces: &Faces, interfaces: &[Interface]) {
        self.searches += 1;
        self.reference.clone_from(&points.start);
        let step = |p: usize| (0..3).map(|i| (points.end[p][i] - points.start[p][i]).abs()).fold(0.0, f64::max);
        self.allowance.clear();
        self.allowance.extend((0..points.len()).map(|p| (self.reach.steps * step(p)).max(self.reach.least)));
        self.found.resize_with(interfaces.len(), Candidates::default);
        let around = |p: usize| Box3::around(&[points.start[p]]).grown(self.allowance[p]);
        for (interface, found) in interfaces.iter().zip(&mut self.found) {
            let nodes: Vec<Box3> =
                (0..points.len()).map(|p| if interface.points[p] { around(p) } else { Box3::empty() }).collect();
            let boxes: Vec<Box3> = (interface.faces.iter())
                .map(|&face| {
                    let [a, b, c, d] = faces.corners[face as usize].map(|corner| around(corner as usize));
                    a.joined(&b).joined(&c).joined(&d).grown(faces.depth[face as usize])
                })
                .collect();
            let corners: Vec<[u32; 4]> = interface.faces.iter().map(|&f| faces.corners[f as usize]).collect();
            self.search.find(&nodes, &boxes, &corners, found);
        }
        self.collect(points, faces, interfaces);
    }

    /// Puts the candidates of all interfaces together, point by point, faces ascending.
    fn collect(&mut self, points: &Points, faces: &Faces, interfaces: &[Interface]) {
        self.watched.clear();
        self.first.clear();
        self.near.clear();
        let mut is_moving = vec![false; points.len()];
        for point in 0..points.len() as u32 {
            let begin = self.near.len();
            for (number, (interface, found)) in interfaces.iter().zip(&self.found).enumerate() {
                for &place in found.of(point as usize) {
                    let face = interface.faces[place as usize];
                    if !faces.same_element(face, point) {
                        self.near.push(Near { face, interface: number as u32 });
                    }
                }
            }
            if self.near.len() > begin {
                // Of interfaces that name the same pair, the first holds.
                self.near[begin..].sort_by_key(|near| (near.face, near.interface));
                let mut kept = begin + 1;
                for i in begin + 1..self.near.len() {
                    if self.near[i].face != self.near[kept - 1].face {
                        self.near[kept] = self.near[i];
                        kept += 1;
                    }
                }
                self.near.truncate(kept);
                self.watched.push(point);
                self.first.push(begin as u32);
                is_moving[point as usize] = true;
                let corners = self.near[begin..].iter().flat_map(|near| faces.corners[near.face as usize]);
                corners.for_each(|corner| is_moving[corner as usize] = true);
            }
        }
        self.first.push(self.near.len() as u32);
        let moving = (0..points.len() as u32).filter(|&point| is_moving[point as usize]);
        self.moving.clear();
        self.moving.extend(moving.map(|point| (point, points.start[point as usize])));
        self.gone = 0.0;
        self.due.clear();
        self.due.resize(self.watched.len(), 0.0);
    }

    /// Pairs of edges that may cross, ascending.
    fn search_edges(&mut self, points: &Points, faces: &Faces, edges: &[Edge]) {
        self.edge_pairs.clear();
        if edges.is_empty() {
            return;
        }
        let around = |p: u32| Box3::around(&[points.start[p as usize]]).grown(self.allowance[p as usize]);
        let boxes: Vec<Box3> = (edges.iter())
            .map(|edge| {
                let margin = edges::keep(faces, edge);
                around(edge.ends[0]).joined(&around(edge.ends[1])).grown(margin)
            })
            .collect();
        let selves: Vec<[u32; 4]> = (0..edges.len() as u32).map(|edge| [edge; 4]).collect();
        let mut found = Candidates::default();
        self.search.find(&boxes, &boxes, &selves, &mut found);
        for first in 0..edges.len() as u32 {
            for &second in found.of(first as usize).iter().filter(|&&second| second > first) {
                if edges::strangers(&edges[first as usize], &edges[second as usize], faces) {
                    self.edge_pairs.push([first, second]);
                }
            }
        }
    }

    /// Pairs of edges that may cross, ascending.
    pub fn edge_pairs(&self) -> &[[u32; 2]] {
        &self.edge_pairs
    }

    /// Points with candidates, ascending.
    pub fn watched(&self) -> &[u32] {
        &self.watched
    }

    /// Finds the candidates of the `i`-th watched point whose boxes over this step meet that of the point, and those that
    /// have held it before.
    pub fn near(&mut self, i: usize, points: &Points, faces: &Faces, past: &[Past; TOUCHES], near: &mut Vec<Near>) {
        near.clear();
        let held = past[0].face != NONE;
        if !held && self.gone < self.due[i] {
            return;
        }
        let own = self.ways.point(points, self.watched[i]);
        let mut nearest = f32::INFINITY;
        for candidate in &self.near[self.first[i] as usize..self.first[i + 1] as usize] {
            let way = self.ways.face(points, faces, candidate.face, self.reach.depth);
            let distance = own.distance(&way);
            if distance <= 0.0 || held && past.iter().any(|past| past.face == candidate.face) {
                near.push(*candidate);
            }
            nearest = nearest.min(distance);
        }
        // Each side may come nearer by the way of this step, which boxes of the next do not begin with, and of all the others.
        let rest = 0.5 * f64::from(nearest.max(0.0));
        self.due[i] = self.gone - self.last_way + rest;
    }

    /// Numbers of watched points and of candidate pairs.
    pub fn counts(&self) -> [usize; 2] {
        [self.watched.len(), self.near.len()]
    }
}
