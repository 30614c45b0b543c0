//! What contact carries from step to step: which faces hold which points, which edges touch, works, and the surface.
//!
//! Points are told by their node in the mesh file, faces by element and side there, edges by their two nodes, so that
//! neither erosion nor the decomposition has a say. Every rank may hold more than it answers for; what it saves is what
//! belongs to nodes that it owns, and every rank loads all.

use super::detect::{NONE, Past, UNTOUCHED};
use super::edges::PastPair;
use super::enforce::Enforcer;
use super::planes::PlanePoint;
use super::points::Points;
use super::setup::{ABSENT, Layout};
use super::{Contact, Tally};
use crate::restart::{Archive, compare_rows};
use crate::solver::erosion::Erosion;
use crate::solver::nodes::Nodes;

/// Columns of a touch: node, place among the touches of the node, element and side of the face, tolerated overlap, force.
const TOUCH: usize = 9;
/// Columns of a pair of edges: the nodes of both, sense, tolerated overlap, force.
const PAIR: usize = 10;
/// Columns of a point that a plane pushes: node, number of the plane, force.
const PLANE: usize = 6;
/// Columns of a point's work: node, work of normal forces, work of friction.
const WORK: usize = 3;

impl Contact {
    /// Visits the state between two steps. `dead` are the elements that are gone, when loading: canonical numbers,
    /// ascending; the nodes have been loaded before.
    pub fn visit_state(&mut self, archive: &mut dyn Archive, dead: &[u32], erosion: Option<&Erosion>, nodes: &Nodes) {
        let Contact {
            // Visited below.
            history: _,
            edge_history: _,
            plane_points: _,
            normal_work: _,
            friction_work: _,
            lost_work: _,
            tally: Tally { steps, passes, capped, left },
            locator,
            skin,
            // Made anew by `take_up`, from the surface as it is.
            layout,
            here: _,
            holder: _,
            gather: _,
            edges: _,
            points: _,
            enforcer: _,
            // Of the step.
            constraints: _,
            pushed: _,
            near: _,
            near_faces: _,
            strict: _,
            touches: _,
            // Of the problem.
            pairings: _,
            held: _,
            edges_wanted: _,
            planes: _,
            mean_size: _,
            limits: _,
        } = self;
        // Of planes alone each rank knows its own, and the log tells nothing.
        if !layout.interfaces.is_empty() {
            archive.count("CONTSTEPS", steps);
            archive.count("CONTPASSES", passes);
            archive.count("CONTCAPPED", capped);
            archive.number("CONTLEFT", left);
            archive.count("CONTSEARCHES", &mut locator.searches);
        }
        // Every rank knows all free nodes.
        let first = archive.comm().rank() == 0;
        let mut free: Vec<f64> = Vec::new();
        if first {
            free.extend(skin.free.iter().flat_map(|&(node, block)| [f64::from(node), f64::from(block)]));
        }
        archive.list("CONTFREE", 2, &mut free);
        if let Some(erosion) = erosion.filter(|_| archive.loading() && !dead.is_empty()) {
            self.skin.free = free.chunks_exact(2).map(|row| (row[0] as u32, row[1] as u32)).collect();
            self.take_up(dead, erosion, nodes, archive);
        }
        self.visit_touches(archive, nodes);
        self.visit_pairs(archive, nodes);
        self.visit_planes(archive, nodes);
        self.visit_works(archive, nodes);
    }

    /// Makes the surface that is left when elements have gone before.
    fn take_up(&mut self, dead: &[u32], erosion: &Erosion, nodes: &Nodes, archive: &mut dyn Archive) {
        // Free nodes are known: no surface of before has to tell them.
        let free = std::mem::take(&mut self.skin.free);
        self.skin.delete(dead, &Layout::default(), |_| false);
        self.skin.free = free;
        let old = std::mem::replace(&mut self.layout, self.skin.layout());
        let new = &self.layout;
        let count = new.nodes.len();
        self.plane_points.iter_mut().for_each(|watch| watch.point = new.point(old.nodes[watch.point as usize]));
        self.here = new.nodes.iter().map(|&node| erosion.local()[node as usize]).collect();
        self.holder =
            self.here.iter().map(|&n| if n == ABSENT { [ABSENT; 3] } else { self.held[n as usize] }).collect();
        self.history = vec![UNTOUCHED; count];
        (self.normal_work, self.friction_work) = (vec![0.0; count], vec![0.0; count]);
        (self.points, self.enforcer) = (Points::new(count), Enforcer::new(count));
        self.forget();
        self.locator.forget();
        self.meet(nodes, archive.comm());
    }

    /// Whether this rank answers for a point.
    fn answers_for(&self, point: usize, nodes: &Nodes) -> bool {
        let node = self.here[point];
        node != ABSENT && nodes.owned[node as usize]
    }

    fn visit_touches(&mut self, archive: &mut dyn Archive, nodes: &Nodes) {
        let mut rows = Vec::new();
        for (point, pasts) in self.history.iter().enumerate().filter(|(point, _)| self.answers_for(*point, nodes)) {
            for (slot, Past { face, allowed, push, drag }) in
                pasts.iter().enumerate().filter(|(_, past)| past.face != NONE)
            {
                let node = f64::from(self.layout.nodes[point]);
                rows.extend([[node, slot as f64].as_slice(), &self.face_key(*face), &[*allowed, *push], drag].concat());
            }
        }
        archive.list("CONTTOUCH", TOUCH, &mut rows);
        if !archive.loading() {
            return;
        }
        let mut faces: Vec<([f64; 2], u32)> =
            (0..self.layout.faces.len() as u32).map(|face| (self.face_key(face), face)).collect();
        faces.sort_by(|a, b| compare_rows(&a.0, &b.0));
        self.history.fill(UNTOUCHED);
        for row in rows.chunks_exact(TOUCH) {
            let face = faces.binary_search_by(|(key, _)| compare_rows(key, &row[2..4]));
            let point = self.layout.point(row[0] as u32) as usize;
            if let (Ok(face), Some(pasts)) = (face, self.history.get_mut(point))
                && let Some(past) = pasts.get_mut(row[1] as usize)
            {
                *past = Past { face: faces[face].1, allowed: row[4], push: row[5], drag: [row[6], row[7], row[8]] };
            }
        }
    }

    /// A face by the place of its element in the mesh file and its side.
    fn face_key(&self, face: u32) -> [f64; 2] {
        let number = self.layout.faces.number[face as usize];
        [self.skin.file_number(number), f64::from(number % 6)]
    }

    fn visit_pairs(&mut self, archive: &mut dyn Archive, nodes: &Nodes) {
        let mut rows = Vec::new();
        for PastPair { pair, sense, allowed, push, drag } in &self.edge_history {
            let [[a, b], [c, d]] = pair.map(|edge| self.edges[edge as usize].ends);
            if self.answers_for(a as usize, nodes) {
                rows.extend([a, b, c, d].map(|point| f64::from(self.layout.nodes[point as usize])));
                rows.extend([*sense, *allowed, *push]);
                rows.extend(drag);
            }
        }
        archive.list("CONTEDGES", PAIR, &mut rows);
        if !archive.loading() {
            return;
        }
        let edge = |ends: [f64; 2]| {
            let ends = ends.map(|node| self.layout.point(node as u32));
            self.edges.binary_search_by(|edge| edge.ends.cmp(&ends)).ok().map(|edge| edge as u32)
        };
        let pairs = rows.chunks_exact(PAIR).filter_map(|row| {
            let pair = [edge([row[0], row[1]])?, edge([row[2], row[3]])?];
            Some(PastPair { pair, sense: row[4], allowed: row[5], push: row[6], drag: [row[7], row[8], row[9]] })
        });
        let mut pairs: Vec<PastPair> = pairs.collect();
        pairs.sort_by_key(|past| past.pair);
        self.edge_history = pairs;
    }

    fn visit_planes(&mut self, archive: &mut dyn Archive, nodes: &Nodes) {
        let mut rows = Vec::new();
        for PlanePoint { point, plane, allowed: _, push, drag } in &self.plane_points {
            let idle = *push == 0.0 && *drag == [0.0; 3];
            if !idle && self.answers_for(*point as usize, nodes) {
                rows.extend([f64::from(self.layout.nodes[*point as usize]), f64::from(*plane), *push]);
                rows.extend(drag);
            }
        }
        archive.list("CONTPLANE", PLANE, &mut rows);
        if !archive.loading() {
            return;
        }
        let rows: Vec<&[f64]> = rows.chunks_exact(PLANE).collect();
        for watch in &mut self.plane_points {
            let key = [f64::from(self.layout.nodes[watch.point as usize]), f64::from(watch.plane)];
            match rows.binary_search_by(|row| compare_rows(&row[..2], &key)) {
                Ok(i) => watch.remember(rows[i][2], [rows[i][3], rows[i][4], rows[i][5]]),
                Err(_) => watch.remember(0.0, [0.0; 3]),
            }
        }
    }

    fn visit_works(&mut self, archive: &mut dyn Archive, nodes: &Nodes) {
        let mut rows = Vec::new();
        for point in (0..self.here.len()).filter(|&point| self.answers_for(point, nodes)) {
            let works = [self.normal_work[point], self.friction_work[point]];
            if works != [0.0; 2] {
                rows.extend([f64::from(self.layout.nodes[point]), works[0], works[1]]);
            }
        }
        archive.list("CONTWORK", WORK, &mut rows);
        let mut lost: Vec<f64> = self.lost_work.concat();
        archive.list("CONTLOST", 2, &mut lost);
        if !archive.loading() {
            return;
        }
        self.normal_work.fill(0.0);
        self.friction_work.fill(0.0);
        for row in rows.chunks_exact(WORK) {
            let point = self.layout.point(row[0] as u32) as usize;
            if let (Some(normal), Some(friction)) = (self.normal_work.get_mut(point), self.friction_work.get_mut(point))
            {
                (*normal, *friction) = (row[1], row[2]);
            }
        }
        // Sums do not depend on which rank keeps these.
        let first = archive.comm().rank() == 0;
        self.lost_work = if first { lost.chunks_exact(2).map(|row| [row[0], row[1]]).collect() } else { Vec::new() };
    }
}
