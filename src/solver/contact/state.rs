//! What contact carries from step to step: which faces hold which points, which edges touch, works, and the surface.
//!
//! Points are told by their node in the mesh file, faces by element and side there, edges by their two nodes, so that
//! neither erosion nor the decomposition has a say. What touches is saved by the rank that computes it, works by the rank
//! that answers for the node; every rank loads all and keeps what it answers for, until the next search shares it out.

use super::check::edge_edge::EdgeContact;
use super::check::node_face::{FaceContact, NO_CONTACT, NONE};
use super::enforcement::accounts::certificate::Bank;
use super::enforcement::carried::{Carried, WIDTH};
use super::geometry::edges::Shape;
use super::local_problem::{History, PlaneHistory};
use super::surface::layout::Layout;
use super::{Contact, Tally};
use crate::restart::{Archive, compare_rows};
use crate::solver::erosion::Erosion;
use crate::solver::nodes::Nodes;
use std::sync::Arc;

/// Columns of a touch: node, place among the touches of the node, element and side of the face, tolerated overlap, whether
/// it yields, and what it carries.
const TOUCH: usize = 6 + WIDTH;
/// Columns of a pair of edges: the nodes of both, sense, tolerated overlap, and what it carries.
const PAIR: usize = 6 + WIDTH;
/// Columns of a thinner face: element and side of the face, factors of √2.
const THINNING: usize = 3;
/// Columns of an edge: its nodes, its shape.
const SHAPE: usize = 3;
/// Columns of a point that a plane pushes: node, number of the plane, and what it carries.
const PLANE: usize = 2 + WIDTH;
/// Columns of a point's work: node, work of normal forces, work of friction.
const WORK: usize = 3;

impl Contact {
    /// Visits the state between two steps. `dead` are the elements that are gone, when loading: canonical numbers,
    /// ascending; the nodes have been loaded before.
    pub fn visit_state(&mut self, archive: &mut dyn Archive, dead: &[u32], erosion: Option<&Erosion>, nodes: &Nodes) {
        let has_bank = self.has_bank();
        let Contact {
            // Of this part of the run.
            seen: _,
            arcs: _,
            // Visited below.
            problem: _,
            carried: _,
            contact_nodes: _,
            plane_nodes: _,
            lost_work: _,
            tally: Tally { steps, iterations, capped, unsettled, left, deepest, motions, farthest, held: penetration },
            bank: Bank { balance, asked, work, gain: excess, growth },
            gain,
            resultants,
            searches,
            age,
            skin,
            // Made anew by `take_up`, from the surface as it is.
            layout: _,
            remote: _,
            // Of the last search.
            counts: _,
            search: _,
            // Of the problem.
            block_ids: _,
            held_deepest: _,
            pairings: _,
            held: _,
            elements: _,
            thicknesses: _,
            reach: _,
            planes: _,
            joints: _,
            mean_size: _,
            limits: _,
            press_fit: _,
            decomposition: _,
        } = self;
        gain.visit_state(archive);
        resultants.visit_state(archive);
        // Of planes alone each rank knows its own, and the log tells nothing.
        if has_bank {
            archive.count("CONTSTEPS", steps);
            archive.count("CONTPASSES", iterations);
            archive.count("CONTCAPPED", capped);
            archive.count("CONTUNSETTLED", unsettled);
            archive.number("CONTLEFT", left);
            archive.number("CONTDEEPEST", deepest);
            archive.number("CONTMOTIONS", motions);
            archive.number("CONTFARTHEST", farthest);
            archive.number("CONTHELD", penetration);
            archive.number("CONTBANK", balance);
            archive.number("CONTASKED1", &mut asked[0]);
            archive.number("CONTASKED2", &mut asked[1]);
            archive.number("CONTSUM", work);
            archive.number("CONTEXCESS", excess);
            archive.number("CONTGROWTH", growth);
            archive.count("CONTSEARCHES", searches);
            archive.count("CONTAGE", age);
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
        self.visit_shapes(archive);
        self.visit_thinnings(archive);
        self.visit_history(archive);
        self.visit_works(archive);
    }

    /// Makes the surface that is left when elements have gone before.
    fn take_up(&mut self, dead: &[u32], erosion: &Erosion, nodes: &Nodes, archive: &mut dyn Archive) {
        // Free nodes are known: no surface of before has to tell them.
        let free = std::mem::take(&mut self.skin.free);
        self.skin.delete(dead, &Layout::default(), |_| false);
        self.skin.free = free;
        self.lay_out_anew();
        self.attach_to_nodes(|node| erosion.local()[node as usize], nodes, archive.comm());
    }

    /// Edges that do not have the shape of the mesh any more.
    fn visit_shapes(&mut self, archive: &mut dyn Archive) {
        let mut rows: Vec<f64> = Vec::new();
        // Every rank knows all of them.
        if archive.comm().rank() == 0 {
            for edge in self.layout.edges.iter().filter(|edge| edge.shape != edge.in_mesh) {
                rows.extend(edge.ends.map(|point| f64::from(self.layout.nodes[point as usize])));
                rows.push(f64::from(edge.shape.code()));
            }
        }
        archive.list("CONTSHAPES", SHAPE, &mut rows);
        if !archive.loading() {
            return;
        }
        for row in rows.chunks_exact(SHAPE) {
            if let Some(edge) = self.layout.edge([row[0] as u32, row[1] as u32]) {
                self.layout.edges[edge as usize].shape = Shape::from_code(row[2] as u32);
            }
        }
    }

    /// Faces whose elements are thinner than in the mesh.
    fn visit_thinnings(&mut self, archive: &mut dyn Archive) {
        let mut rows: Vec<f64> = Vec::new();
        // Every rank knows all of them.
        if archive.comm().rank() == 0 {
            let faces = &self.layout.faces;
            for face in (0..faces.len() as u32).filter(|&face| faces.thinning(face) > 0) {
                rows.extend(self.face_key(face));
                rows.push(f64::from(faces.thinning(face)));
            }
        }
        archive.list("CONTTHIN", THINNING, &mut rows);
        if !archive.loading() || rows.is_empty() {
            return;
        }
        let places = self.faces_by_key();
        let faces = Arc::make_mut(&mut self.layout.faces);
        for row in rows.chunks_exact(THINNING) {
            if let Ok(place) = places.binary_search_by(|(key, _)| compare_rows(key, &row[..2])) {
                faces.set_thinning(places[place].1, row[2] as u8);
            }
        }
    }

    /// Faces of the layout by element and side in the mesh file, ascending.
    fn faces_by_key(&self) -> Vec<([f64; 2], u32)> {
        let all = 0..self.layout.faces.len() as u32;
        let mut faces: Vec<([f64; 2], u32)> = all.map(|face| (self.face_key(face), face)).collect();
        faces.sort_by(|a, b| compare_rows(&a.0, &b.0));
        faces
    }

    /// What touches, in the local problem or on its way to the next.
    fn visit_history(&mut self, archive: &mut dyn Archive) {
        let now = self.carried.clone().unwrap_or_else(|| self.problem.history());
        let mut come = History {
            points: self.visit_touches(archive, &now),
            edges: self.visit_pairs(archive, &now),
            planes: self.visit_planes(archive, &now),
            // How points are shared out is nobody's state.
            costs: Vec::new(),
        };
        if !archive.loading() {
            return;
        }
        if self.layout.interfaces.is_empty() {
            return self.problem.restore(come);
        }
        let mine = |point: u32| {
            self.contact_nodes.of(point).is_some_and(|contact_node| self.contact_nodes.list[contact_node].owned)
        };
        come.points.retain(|(point, _)| mine(*point));
        come.edges.retain(|past| mine(self.layout.edges[past.pair[0] as usize].ends[0]));
        come.planes.retain(|(number, ..)| mine(self.plane_nodes[*number as usize].point));
        self.carried = Some(come);
    }

    fn visit_touches(&self, archive: &mut dyn Archive, now: &History) -> Vec<(u32, [FaceContact; 3])> {
        let mut rows = Vec::new();
        for (point, pasts) in &now.points {
            for (slot, FaceContact { face, tolerated, yields, carried }) in
                pasts.iter().enumerate().filter(|(_, past)| past.face != NONE)
            {
                let node = f64::from(self.layout.nodes[*point as usize]);
                rows.extend([node, slot as f64]);
                rows.extend(self.face_key(*face));
                rows.extend([*tolerated, f64::from(u8::from(*yields))]);
                rows.extend(carried.to_array());
            }
        }
        archive.list("CONTTOUCH", TOUCH, &mut rows);
        if !archive.loading() {
            return Vec::new();
        }
        let faces = self.faces_by_key();
        let mut points: Vec<(u32, [FaceContact; 3])> = Vec::new();
        // Rows are sorted by their nodes.
        for &[node, slot, element, side, tolerated, yields, ref carried @ ..] in rows.as_chunks::<TOUCH>().0 {
            let point = self.layout.point(node as u32);
            if points.last().is_none_or(|(last, _)| *last != point) {
                points.push((point, NO_CONTACT));
            }
            let face = faces.binary_search_by(|(key, _)| compare_rows(key, &[element, side]));
            let pasts = points.last_mut().and_then(|(_, pasts)| pasts.get_mut(slot as usize));
            if let (Ok(face), Some(past)) = (face, pasts) {
                *past = FaceContact {
                    face: faces[face].1,
                    tolerated,
                    yields: yields != 0.0,
                    carried: Carried::from_array(*carried),
                };
            }
        }
        points
    }

    /// A face by the place of its element in the mesh file and its side.
    fn face_key(&self, face: u32) -> [f64; 2] {
        let number = self.layout.faces.number[face as usize];
        [self.skin.file_number(number), f64::from(number % 6)]
    }

    fn visit_pairs(&self, archive: &mut dyn Archive, now: &History) -> Vec<EdgeContact> {
        let mut rows = Vec::new();
        for EdgeContact { pair, sense, tolerated, carried } in &now.edges {
            let [[a, b], [c, d]] = pair.map(|edge| self.layout.edges[edge as usize].ends);
            rows.extend([a, b, c, d].map(|point| f64::from(self.layout.nodes[point as usize])));
            rows.extend([*sense, *tolerated]);
            rows.extend(carried.to_array());
        }
        archive.list("CONTEDGES", PAIR, &mut rows);
        if !archive.loading() {
            return Vec::new();
        }
        let edge = |ends: [f64; 2]| self.layout.edge(ends.map(|node| node as u32));
        let pairs =
            rows.as_chunks::<PAIR>().0.iter().filter_map(|&[a, b, c, d, sense, tolerated, ref carried @ ..]| {
                let pair = [edge([a, b])?, edge([c, d])?];
                Some(EdgeContact { pair, sense, tolerated, carried: Carried::from_array(*carried) })
            });
        pairs.collect()
    }

    fn visit_planes(&self, archive: &mut dyn Archive, now: &History) -> Vec<PlaneHistory> {
        // Planes alone are with every rank that has the node.
        let alone = self.layout.interfaces.is_empty();
        let answers = |point: u32| {
            self.contact_nodes.of(point).is_some_and(|contact_node| self.contact_nodes.list[contact_node].owned)
        };
        let mut rows = Vec::new();
        for (number, carried) in &now.planes {
            let plane_node = &self.plane_nodes[*number as usize];
            if !alone || answers(plane_node.point) {
                rows.extend([f64::from(self.layout.nodes[plane_node.point as usize]), f64::from(plane_node.plane)]);
                rows.extend(carried.to_array());
            }
        }
        archive.list("CONTPLANE", PLANE, &mut rows);
        if !archive.loading() {
            return Vec::new();
        }
        let rows = rows.as_chunks::<PLANE>().0;
        let force = |plane_node: &super::PlaneNode| {
            let key = [f64::from(self.layout.nodes[plane_node.point as usize]), f64::from(plane_node.plane)];
            let [_, _, carried @ ..] = rows[rows.binary_search_by(|row| compare_rows(&row[..2], &key)).ok()?];
            Some((plane_node.number, Carried::from_array(carried)))
        };
        self.plane_nodes.iter().filter_map(force).collect()
    }

    fn visit_works(&mut self, archive: &mut dyn Archive) {
        let mut rows = Vec::new();
        for (contact_node, work) in self.contact_nodes.list.iter().zip(&self.contact_nodes.works) {
            if contact_node.owned && *work != [0.0; 2] {
                rows.extend([f64::from(self.layout.nodes[contact_node.point as usize]), work[0], work[1]]);
            }
        }
        archive.list("CONTWORK", WORK, &mut rows);
        let mut lost: Vec<f64> = self.lost_work.concat();
        archive.list("CONTLOST", 2, &mut lost);
        if !archive.loading() {
            return;
        }
        self.contact_nodes.works.fill([0.0; 2]);
        for row in rows.chunks_exact(WORK) {
            if let Some(contact_node) = self.contact_nodes.of(self.layout.point(row[0] as u32)) {
                self.contact_nodes.works[contact_node] = [row[1], row[2]];
            }
        }
        // Sums do not depend on which rank keeps these.
        let first = archive.comm().rank() == 0;
        self.lost_work = if first { lost.chunks_exact(2).map(|row| [row[0], row[1]]).collect() } else { Vec::new() };
    }
}
