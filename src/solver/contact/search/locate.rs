//! Location: which slave nodes come near which faces, and which edges each other, in a step, of the candidates that the last
//! search has found.

use super::neighbourhood::SearchResult;
use crate::common::vector::{dot, subtract};
use crate::solver::contact::check::node_face::{FaceContact, MAX_FACES, NONE};
use crate::solver::contact::geometry::edges::Edge;
use crate::solver::contact::geometry::faces::Faces;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::geometry::paths::{Paths, TWICE_ROOT_THREE};
use crate::solver::contact::geometry::projection::area_normal;
use crate::solver::contact::geometry::swept_box::SweptBox;
use crate::solver::contact::local_problem::Numbering;

/// Nodes and faces that may touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    /// Whether a point takes part, by points.
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

/// A face that a slave node may meet before the next search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Candidate {
    /// The face.
    pub face: u32,
    /// The interface to which the two belong.
    pub interface: u32,
}

/// How far points may go before the search is repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Multiple of the path that a point goes in the present step.
    pub steps: f64,
    /// Smallest reach, a length.
    pub least: f64,
    /// How far a face looks beyond its corners in a step, as a part of half its element: a little, for points that have
    /// just left it; all of it, to find points that are behind it at the start and where they stay there. Searches look as far as
    /// all of it.
    pub depth: f64,
}

/// The candidates of the last search, and which of them are near in a step.
#[derive(Default)]
pub struct Locator {
    /// How far a face looks beyond its corners, see [`Reach`].
    depth: f64,
    /// Slave nodes, which are those with candidates, ascending, and where their candidates begin.
    slave_nodes: Vec<u32>,
    first: Vec<u32>,
    candidates: Vec<Candidate>,
    /// Pairs of edges that may cross, ascending, and how far things must have gone in all until each may be near.
    edge_pairs: Vec<[u32; 2]>,
    pairs_due: Vec<f64>,
    /// Places in that list of the pairs whose edges both stand out, ascending.
    sharp_pairs: Vec<u32>,
    sleep: Vec<SleepState>,
    /// How far things must have gone in all until a slave node may have anything near at all.
    quiet_until: Vec<f64>,
    /// How far nodes have travelled in all, a length: in each step as far as those whose paths differ most, seen from halfway between
    /// them. What all of them go together brings none nearer to another.
    travelled: f64,
    /// How far they go in the present step.
    paths: Paths,
    /// Slave nodes, corners of candidates or ends of edges, ascending.
    moving: Vec<u32>,
    /// Whether no step has been made yet, and whether what sleeps has been taken over from the search before.
    fresh: bool,
    continues: bool,
    capture_boxes: CaptureBoxes,
}

/// Which candidates of a slave node sleep: they are not looked at until nodes have travelled so far that they may be near.
#[derive(Debug, Clone, Copy, Default)]
struct SleepState {
    /// How far things must have gone in all until a candidate that sleeps may be near.
    due: f64,
    /// Candidates that do not sleep, a bit each. Those beyond the last bit never do.
    awake: u64,
    /// Whether a face held the point.
    held: bool,
}

/// Steps at the present speed that candidates sleep at least: shorter sleep is not worth the looking.
const SLEEP: f64 = 6.0;

/// Least sleeps after which a point looks out for candidates that are awake but need not be.
const LOOK: f64 = 8.0;

/// Part of the distance between two things that either may go before they are looked at again: half, less what rounding takes.
const SAFE: f64 = 0.499;

/// What a reach is multiplied by, to be more than what single precision takes away.
const ROUNDED_UP: f64 = 1.0 + 1e-6;

/// A foot this part of a face's size outside may count as on its border.
const BORDER: f64 = 0.01;

/// Boxes around faces over the present step, made when they are first asked for.
#[derive(Default)]
struct CaptureBoxes {
    step: u32,
    faces: Vec<(u32, SweptBox)>,
}

impl CaptureBoxes {
    fn next_step(&mut self, faces: usize) {
        self.step = self.step.wrapping_add(1);
        if self.step == 1 || self.faces.len() != faces {
            self.step = 1;
            self.faces.clear();
            self.faces.resize(faces, (0, SweptBox::EVERYTHING));
        }
    }

    /// Capture box of a face: its corners at the beginning and at the end of the step, and a little around.
    #[inline(always)]
    fn of(&mut self, face: u32, faces: &Faces, motion: &mut NodeMotion, margin: f64) -> SweptBox {
        let (step, bounds) = &mut self.faces[face as usize];
        if *step != self.step {
            let [a, b, c, d] = faces.corners[face as usize];
            motion.place_all([a, b, c, d]);
            *bounds = SweptBox::joined(
                [motion.swept_box(a), motion.swept_box(b), motion.swept_box(c), motion.swept_box(d)],
                (margin * faces.depth[face as usize] + faces.reach[face as usize]) as f32,
            );
            *step = self.step;
        }
        *bounds
    }
}

impl Locator {
    /// Takes over what a search has found, in numbers of the local problem, which has so many `points`.
    pub fn new(found: SearchResult, depth: f64, points: usize, faces: &Faces, edges: &[Edge]) -> Locator {
        let mut is_moving = vec![false; points];
        for &edge in found.pairs.iter().flatten() {
            edges[edge as usize].points(faces).iter().for_each(|&point| is_moving[point as usize] = true);
        }
        found.slave_nodes.iter().for_each(|&point| is_moving[point as usize] = true);
        for near in &found.candidates {
            faces.corners[near.face as usize].iter().for_each(|&corner| is_moving[corner as usize] = true);
        }
        Locator {
            depth,
            sleep: vec![SleepState::default(); found.slave_nodes.len()],
            quiet_until: vec![0.0; found.slave_nodes.len()],
            moving: (0..points as u32).filter(|&point| is_moving[point as usize]).collect(),
            slave_nodes: found.slave_nodes,
            first: found.first,
            candidates: found.candidates,
            pairs_due: vec![0.0; found.pairs.len()],
            sharp_pairs: (0..)
                .zip(&found.pairs)
                .filter_map(|(place, [a, b])| {
                    // Surfaces have no depth to sink into: their edges look every step.
                    let [a, b] = [a, b].map(|edge| &edges[*edge as usize]);
                    (b.stands_out() || a.is_of_surface(faces)).then_some(place)
                })
                .collect(),
            edge_pairs: found.pairs,
            fresh: true,
            ..Default::default()
        }
    }

    /// Takes over from the search before how long things may wait that it has found as well: slave nodes whose candidates
    /// are the same, and pairs of edges. Both are nodes that have counted in what has been travelled, which is counted from
    /// here on. The numbers are those of `new` and of `old` local problems, in the same order.
    pub fn take_over(&mut self, before: &Locator, [new, old]: [&Numbering; 2]) {
        self.continues = true;
        let travelled = before.travelled;
        if !travelled.is_finite() {
            return;
        }
        let mut past = 0;
        for i in 0..self.slave_nodes.len() {
            let point = new.points[self.slave_nodes[i] as usize];
            let old_point = |past: usize| before.slave_nodes.get(past).map(|&node| old.points[node as usize]);
            while old_point(past).is_some_and(|old_point| old_point < point) {
                past += 1;
            }
            let number = |numbering: &Numbering, candidate: &Candidate| {
                (numbering.faces[candidate.face as usize], candidate.interface)
            };
            let same = |now: &[Candidate], past: &[Candidate]| {
                now.len() == past.len() && now.iter().zip(past).all(|(now, past)| number(new, now) == number(old, past))
            };
            if old_point(past) == Some(point) && same(self.of(i), before.of(past)) {
                let SleepState { due, awake, held } = before.sleep[past];
                self.sleep[i] = SleepState { due: due - travelled, awake, held };
                self.quiet_until[i] = before.quiet_until[past] - travelled;
            }
        }
        let number = |numbering: &Numbering, pair: &[u32; 2]| pair.map(|edge| numbering.edges[edge as usize]);
        let mut past = before.edge_pairs.iter().map(|pair| number(old, pair)).zip(&before.pairs_due).peekable();
        for (pair, due) in self.edge_pairs.iter().zip(&mut self.pairs_due) {
            let pair = number(new, pair);
            while past.next_if(|(past, _)| *past < pair).is_some() {}
            if let Some((_, past_due)) = past.next_if(|(past, _)| *past == pair) {
                *due = past_due - travelled;
            }
        }
    }

    /// Lets everything be looked at in the next step: faces have become deeper than what sleeps has reckoned with.
    pub fn wake_all(&mut self) {
        self.sleep.iter_mut().for_each(|sleep| sleep.due = 0.0);
        self.quiet_until.fill(0.0);
        self.pairs_due.fill(0.0);
    }

    /// The candidates of the `i`-th slave node.
    fn of(&self, i: usize) -> &[Candidate] {
        &self.candidates[self.first[i] as usize..self.first[i + 1] as usize]
    }

    /// Lets pairs be looked at in the next step of which an edge is one of these.
    pub fn wake_pairs(&mut self, edges: impl Fn(u32) -> bool) {
        for (pair, due) in self.edge_pairs.iter().zip(&mut self.pairs_due) {
            if pair.iter().any(|&edge| edges(edge)) {
                *due = 0.0;
            }
        }
    }

    /// Begins a step.
    pub fn step(&mut self, motion: &NodeMotion, faces: &Faces) {
        self.capture_boxes.next_step(faces.len());
        // What counts in the longest path is chosen after the first step's nodes have been looked at.
        let first = std::mem::replace(&mut self.fresh, false);
        let continues = std::mem::replace(&mut self.continues, false);
        let ahead = || motion.paths_ahead(self.moving.iter().copied());
        self.paths = match (first, continues) {
            (false, _) => motion.paths(),
            (true, false) => ahead(),
            // Those that counted before have also gone on since the last step.
            (true, true) => ahead().and(motion.paths()),
        };
        self.travelled += self.paths.half_range;
    }

    /// The farthest that one of them goes in this step along an axis, a length.
    pub fn longest_path(&self) -> f64 {
        self.paths.longest
    }

    /// How much nearer two of them come in this step at most, a length.
    pub fn farthest_approach(&self) -> f64 {
        TWICE_ROOT_THREE * self.paths.half_range
    }

    /// Slave nodes, corners of candidates or ends of edges, ascending: those that count in the longest path.
    pub fn moving(&self) -> &[u32] {
        &self.moving
    }

    /// Slave nodes: points with candidates, ascending.
    pub fn slave_nodes(&self) -> &[u32] {
        &self.slave_nodes
    }

    /// Slave nodes, each with its candidates.
    pub fn candidates(&self) -> impl Iterator<Item = (u32, &[Candidate])> {
        let bounds = self.first.windows(2).map(|bounds| bounds[0] as usize..bounds[1] as usize);
        self.slave_nodes.iter().copied().zip(bounds.map(|bounds| &self.candidates[bounds]))
    }

    /// Candidates of the `i`-th slave node that do not sleep.
    pub fn awake(&self, i: usize) -> impl Iterator<Item = &Candidate> {
        let bits = self.sleep[i].awake;
        let is_awake = move |place: usize| bits.checked_shr(place as u32).is_none_or(|bits| bits & 1 == 1);
        self.of(i).iter().enumerate().filter(move |(place, _)| is_awake(*place)).map(|(_, candidate)| candidate)
    }

    /// Finds the candidates of the `i`-th slave node whose boxes over this step meet that of the point, and those that
    /// have held it before; of a point that nothing holds, without those that it cannot touch for a while. Places the point and the
    /// corners of what it looks at.
    #[inline(always)]
    pub fn locate(
        &mut self,
        i: usize,
        motion: &mut NodeMotion,
        faces: &Faces,
        past: &[FaceContact; MAX_FACES],
        near: &mut Vec<Candidate>,
    ) {
        near.clear();
        // Written so that it does not rest where what has gone is not a number.
        let rests = self.travelled + self.paths.half_range < self.sleep[i].due;
        if !rests {
            self.plan_sleep(i, motion, faces, past);
        }
        let SleepState { mut awake, held, .. } = self.sleep[i];
        let candidates = &self.candidates[self.first[i] as usize..self.first[i + 1] as usize];
        if awake == 0 && candidates.len() <= 64 {
            return;
        }
        motion.place(self.slave_nodes[i]);
        let own = *motion.swept_box(self.slave_nodes[i]);
        let reach = faces.node_reach[self.slave_nodes[i] as usize] * ROUNDED_UP;
        // No closure: it would be compiled apart, without the vector instructions of the caller.
        let mut next = 64;
        loop {
            let place = if awake != 0 {
                let place = awake.trailing_zeros() as usize;
                awake &= awake - 1;
                place
            } else {
                next += 1;
                next - 1
            };
            let Some(candidate) = candidates.get(place) else { break };
            let swept = self.capture_boxes.of(candidate.face, faces, motion, self.depth);
            if f64::from(own.distance(&swept)) <= reach || held && past.iter().any(|past| past.face == candidate.face) {
                near.push(*candidate);
            }
        }
    }

    /// Whether nothing holds the `i`-th slave node, nor comes near it in this step.
    #[inline]
    pub fn is_quiet(&self, i: usize) -> bool {
        self.travelled + self.paths.half_range < self.quiet_until[i]
    }

    /// Whether a face holds the `i`-th slave node; in a step known from [`Locator::locate`] on.
    pub fn is_held(&self, i: usize) -> bool {
        self.sleep[i].held
    }

    /// Hears whether a face holds the `i`-th slave node from now on.
    pub fn set_held(&mut self, i: usize, held: bool) {
        let sleep = &mut self.sleep[i];
        if sleep.held != held {
            // Other candidates matter to it than before.
            *sleep = SleepState { held, ..SleepState::default() };
            self.quiet_until[i] = 0.0;
        }
    }

    /// Pairs of edges that may cross, ascending.
    pub fn edge_pairs(&self) -> &[[u32; 2]] {
        &self.edge_pairs
    }

    /// Places in the list of pairs that are to be looked at, ascending: all, or without `lines` those whose edges both stand out
    /// and those of `touching` pairs, which are ascending.
    pub fn pairs_to_check<'a>(&self, lines: bool, touching: impl Iterator<Item = &'a [u32; 2]>, places: &mut Vec<u32>) {
        places.clear();
        if lines {
            places.extend(0..self.edge_pairs.len() as u32);
            return;
        }
        let mut sharp = self.sharp_pairs.iter().copied().peekable();
        for place in touching.filter_map(|pair| self.edge_pairs.binary_search(pair).ok()) {
            while let Some(before) = sharp.next_if(|&sharp| sharp < place as u32) {
                places.push(before);
            }
            sharp.next_if_eq(&(place as u32));
            places.push(place as u32);
        }
        places.extend(sharp);
    }

    /// Whether the `i`-th pair of edges may be near in this step.
    pub fn is_pair_due(&self, i: usize) -> bool {
        self.travelled + self.paths.half_range >= self.pairs_due[i]
    }

    /// Lets a pair wait whose edges are so far apart along an axis in this step, beyond where they would be near.
    pub fn let_pair_wait(&mut self, i: usize, distance: f64) {
        self.pairs_due[i] = self.travelled + SAFE * distance;
    }

    /// Finds which candidates of the `i`-th slave node may sleep, and for how long.
    fn plan_sleep(&mut self, i: usize, motion: &mut NodeMotion, faces: &Faces, past: &[FaceContact; MAX_FACES]) {
        let point = self.slave_nodes[i];
        let held = past[0].face != NONE;
        motion.place(point);
        let own = *motion.swept_box(point);
        let reach = faces.node_reach[point as usize] * ROUNDED_UP;
        let (sleep, mut rest, mut awake) = (SLEEP * self.paths.half_range, f64::INFINITY, 0);
        let candidates = &self.candidates[self.first[i] as usize..self.first[i + 1] as usize];
        // Behind a thin face a point may be touching a thick one beside it, and then both normals count. Found where it is asked for:
        // most points are kept apart by boxes alone.
        let mut deepest = None;
        let depth_of_all = || {
            let depths = candidates.iter().map(|candidate| faces.depth[candidate.face as usize]);
            depths.fold(0.0, f64::max)
        };
        for (bit, candidate) in candidates.iter().enumerate().take(64) {
            let face = candidate.face;
            // Both sides may come nearer.
            let apart = f64::from(own.distance(&self.capture_boxes.of(face, faces, motion, self.depth)));
            let mut away = SAFE * (apart - reach);
            if !held && away <= sleep {
                let front = self.depth * faces.depth[face as usize] + faces.reach[face as usize] + reach;
                let deepest = deepest.get_or_insert_with(depth_of_all);
                let apart = separation([point, face], motion, faces, [front, *deepest]);
                away = away.max(apart / TWICE_ROOT_THREE);
            }
            if away > sleep && past.iter().all(|past| past.face != face) {
                rest = rest.min(away);
            } else {
                awake |= 1 << bit;
            }
        }
        if awake != 0 {
            // Those that are awake may sleep some day.
            rest = rest.min(LOOK * sleep);
        }
        let due = self.travelled + rest;
        self.sleep[i] = SleepState { due, awake, held };
        self.quiet_until[i] = if awake == 0 && !held && candidates.len() <= 64 { due } else { 0.0 };
    }

    /// Numbers of slave nodes and of candidate pairs.
    pub fn counts(&self) -> [usize; 2] {
        [self.slave_nodes.len(), self.candidates.len()]
    }
}

/// Distance along the normal of a face between a point and where it would matter to the face, over the whole step: in
/// front farther than the first reach, or behind by more than the second. Not a number for a face without area.
///
/// Points and corners move straight, so what is apart along one direction at both ends of the step is apart all the time;
/// later, as long as nobody has gone half this distance.
fn separation([point, face]: [u32; 2], motion: &NodeMotion, faces: &Faces, [front, behind]: [f64; 2]) -> f64 {
    let (start, end) = (faces.start(face, motion), faces.end(face, motion));
    let normal = area_normal(&start);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (corners, at) in [(start, motion.start(point)), (end, motion.end(point))] {
        for corner in corners {
            let height = dot(subtract(at, corner), normal);
            (low, high) = (low.min(height), high.max(height));
        }
    }
    let (length, border) = (dot(normal, normal).sqrt(), BORDER * faces.size[face as usize]);
    (low / length - front - border).max(-high / length - behind - border)
}

#[cfg(test)]
mod tests;
