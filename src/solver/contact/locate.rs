//! Location: which points come near which faces in a step, of those that the last search has found.

use super::bounds::Bounds;
use super::detect::{NONE, Past, TOUCHES};
use super::faces::Faces;
use super::neighbourhood::Found;
use super::points::Points;

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

/// The candidates of the last search, and which of them are near in a step.
#[derive(Default)]
pub struct Locator {
    /// How far a face looks beyond its corners, see [`Reach`].
    depth: f64,
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
    /// Points that are watched or corners of candidates, and where each was at the last step, if there was one.
    moving: Vec<(u32, Option<[f64; 3]>)>,
    ways: Ways,
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
    /// Takes over what a search has found, in numbers of the arena.
    pub fn new(found: Found, depth: f64, points: &Points, faces: &Faces) -> Locator {
        let mut is_moving = vec![false; points.len()];
        found.watched.iter().for_each(|&point| is_moving[point as usize] = true);
        for near in &found.near {
            faces.corners[near.face as usize].iter().for_each(|&corner| is_moving[corner as usize] = true);
        }
        let moving = (0..points.len() as u32).filter(|&point| is_moving[point as usize]);
        Locator {
            depth,
            due: vec![0.0; found.watched.len()],
            moving: moving.map(|point| (point, None)).collect(),
            watched: found.watched,
            first: found.first,
            near: found.near,
            ..Default::default()
        }
    }

    /// Begins a step.
    pub fn step(&mut self, points: &Points, faces: &Faces) {
        self.ways.next_step(points.len(), faces.len());
        self.last_way = self.longest_way(points);
        self.gone += self.last_way;
    }

    /// The farthest that a point which matters has gone since the last step or will go in this one, along an axis.
    fn longest_way(&mut self, points: &Points) -> f64 {
        let mut farthest = [0.0; 3];
        let mut sound = true;
        for (point, before) in &mut self.moving {
            let (start, end) = (&points.start[*point as usize], &points.end[*point as usize]);
            let before = before.replace(*start).unwrap_or(*start);
            for i in 0..3 {
                let (last, next) = ((start[i] - before[i]).abs(), (end[i] - start[i]).abs());
                let way = if last > next { last } else { next };
                sound &= way <= f64::MAX;
                farthest[i] = if way > farthest[i] { way } else { farthest[i] };
            }
        }
        // A way that is not a number leaves nobody at rest.
        if sound { farthest[0].max(farthest[1]).max(farthest[2]) } else { f64::INFINITY }
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
            let way = self.ways.face(points, faces, candidate.face, self.depth);
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
