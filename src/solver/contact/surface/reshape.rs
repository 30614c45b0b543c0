//! Edges that come to stand out as the surface folds, those that fold back, and elements that become thinner.
//!
//! Looked at every so many steps of the run, whenever searches are made: results do not depend on the search. All ranks keep
//! the same tables; each looks at the edges whose first face it has and at the faces of its elements, and tells the others what
//! has changed.

use super::layout::{ABSENT, Layout};
use crate::comm::{Communicator, numbers_of_others};
use crate::partition::dynamic::Parcels;
use crate::solver::contact::Contact;
use crate::solver::contact::check::edge_edge;
use crate::solver::contact::geometry::edges::{self, Shape, Side};
use crate::solver::contact::geometry::faces::{THINNEST, half_thickness};
use crate::solver::nodes::Nodes;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Steps after which edges are looked at again. A fold takes hundreds.
const EVERY: u64 = 100;

/// Number of shapes.
const SHAPES: u32 = 4;

/// Number of thinnings.
const THINNINGS: u32 = THINNEST as u32 + 1;

impl Contact {
    /// Counts the step, and when it is time looks which edges stand out now and how thick elements are. Whether edges have
    /// changed, so that all ranks must search; on many ranks history is on its way then. All ranks call it.
    pub(in crate::solver::contact) fn reshape(&mut self, nodes: &Nodes, comm: &mut dyn Communicator) -> bool {
        self.age += 1;
        if self.layout.interfaces.is_empty() || !self.age.is_multiple_of(EVERY) {
            return false;
        }
        let folded = !self.layout.edges.is_empty() && self.update_edge_shapes(nodes, comm);
        self.update_depths(nodes, comm);
        folded
    }

    /// Gives the faces of all elements the depths that they have now. Searches look as far as the depths of the start, so that
    /// candidates stay what they are. All ranks call it.
    pub(in crate::solver::contact) fn update_depths(&mut self, nodes: &Nodes, comm: &mut dyn Communicator) {
        let faces = &self.layout.faces;
        let mut changed = Vec::new();
        for (face, sides) in &self.thicknesses {
            let [front, back] = sides.map(|side| side.map(|node| nodes.position(node)));
            let thinning = faces.thinning_at(*face, half_thickness(front, back));
            if thinning != faces.thinning(*face) {
                changed.push(THINNINGS * face + u32::from(thinning));
            }
        }
        self.with_others(&mut changed, comm);
        if changed.is_empty() {
            return;
        }
        let changed = changed.iter().map(|change| (change / THINNINGS, (change % THINNINGS) as u8));
        // A local problem that has been given up, its history on the way, gets its faces from the next search.
        let told = self.carried.is_none();
        if told && self.remote.is_some() {
            self.problem.update_depths(changed.clone());
        } else if told {
            self.problem.release_faces();
        }
        let faces = Arc::make_mut(&mut self.layout.faces);
        let mut grown = false;
        for (face, thinning) in changed {
            grown |= faces.set_thinning(face, thinning);
        }
        if told && self.remote.is_none() {
            self.problem.share_faces(&self.layout.faces, grown);
        }
    }

    /// Appends what other ranks tell.
    fn with_others(&self, changed: &mut Vec<u32>, comm: &mut dyn Communicator) {
        if self.remote.is_some() {
            let others = numbers_of_others(changed, comm);
            changed.extend(others.into_iter().flat_map(|(_, numbers)| numbers));
        }
    }

    /// Gives edges the shapes that they have now. Whether any has changed.
    fn update_edge_shapes(&mut self, nodes: &Nodes, comm: &mut dyn Communicator) -> bool {
        let mut changed = self.changes(nodes, comm);
        self.with_others(&mut changed, comm);
        if changed.is_empty() {
            return false;
        }
        for change in changed {
            self.layout.edges[(change / SHAPES) as usize].shape = Shape::from_code(change % SHAPES);
        }
        if self.remote.is_none() && self.carried.is_none() {
            self.problem.update_edge_shapes(&self.layout.edges);
            return true;
        }
        let mut history = self.carried.take().unwrap_or_else(|| self.problem.history());
        history.edges =
            history.edges.into_iter().filter_map(|past| edge_edge::in_order(past, &self.layout.edges)).collect();
        self.carried = Some(history);
        true
    }

    /// Edges whose first face is here and that have another shape now, with the code of it: edge x [`SHAPES`] + code.
    fn changes(&self, nodes: &Nodes, comm: &mut dyn Communicator) -> Vec<u32> {
        let sides: Vec<Option<Side>> = (0..self.layout.faces.len() as u32).map(|face| self.side(face, nodes)).collect();
        let elsewhere = self.sides_elsewhere(&sides, comm);
        let mut changed = Vec::new();
        for (edge, number) in self.layout.edges.iter().zip(0u32..) {
            let [first, second] = edge.faces.map(|face| sides[face as usize]);
            let Some(first) = first else { continue };
            let Some(second) = second.or_else(|| elsewhere.get(&number).copied()) else { continue };
            let shape = edge.shape_between(first, second, &self.layout.faces);
            if shape != edge.shape {
                changed.push(SHAPES * number + shape.code());
            }
        }
        changed
    }

    /// A face of an element that is here, as it is now.
    fn side(&self, face: u32, nodes: &Nodes) -> Option<Side> {
        let element = self.layout.faces.number[face as usize] / 6;
        // On one rank every element is here.
        if self.remote.is_some() {
            self.elements.binary_search(&element).ok()?;
        }
        let mut corners = [[0.0; 3]; 4];
        for (corner, &point) in corners.iter_mut().zip(&self.layout.faces.corners[face as usize]) {
            *corner = self.contact_nodes.position(self.contact_nodes.of(point)?, nodes);
        }
        Some(edges::side(&corners))
    }

    /// Second faces of edges whose first face is here and that are themselves on another rank; `sides` are all faces that are here.
    fn sides_elsewhere(&self, sides: &[Option<Side>], comm: &mut dyn Communicator) -> BTreeMap<u32, Side> {
        let Some(remote) = &self.remote else { return BTreeMap::new() };
        let rank = comm.rank() as u32;
        let mut parcels = Parcels::new(&*comm, 6);
        for (edge, number) in self.layout.edges.iter().zip(0u32..) {
            let holders = remote.node_ranks.holders(edge.ends[0]);
            let [first, second] = edge.faces.map(|face| sides[face as usize]);
            if holders.len() < 2 || first.is_some() {
                continue;
            }
            if let Some(Side { normal: [a, b, c], middle: [d, e, f], .. }) = second {
                let others = holders.iter().filter(|&&holder| holder != rank);
                others.for_each(|&holder| parcels.add(holder, number, &[a, b, c, d, e, f]));
            }
        }
        let records = parcels.exchange(comm);
        // Ridges have one face, so that nobody asks for the warp of another rank's.
        let side = |v: &[f64]| Side { normal: [v[0], v[1], v[2]], middle: [v[3], v[4], v[5]], warp: 0.0 };
        (0..records.len()).map(|i| (records.ids[i], side(records.values(i)))).collect()
    }
}

/// Gives faces that have been there before the depth that they had, and edges between the same faces the shape.
pub fn take_over(new: &mut Layout, old: &Layout) {
    let faces = Arc::make_mut(&mut new.faces);
    for face in 0..faces.len() as u32 {
        let before = old.face(faces.number[face as usize]);
        if before != ABSENT && old.faces.thinning(before) > 0 {
            faces.set_thinning(face, old.faces.thinning(before));
        }
    }
    let shapes: Vec<Option<Shape>> = new
        .edges
        .iter()
        .map(|edge| {
            let before = &old.edges[old.edge(edge.ends.map(|point| new.nodes[point as usize]))? as usize];
            let numbers = |layout: &Layout, faces: [u32; 2]| faces.map(|face| layout.faces.number[face as usize]);
            (numbers(old, before.faces) == numbers(new, edge.faces)).then_some(before.shape)
        })
        .collect();
    for (edge, shape) in new.edges.iter_mut().zip(shapes) {
        edge.shape = shape.unwrap_or(edge.shape);
    }
}
