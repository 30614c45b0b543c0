//! The whole body before it is cut: elements and nodes in canonical order, with their masses.
//!
//! The canonical order depends on mesh and model only, never on the decomposition. Every sum over elements at a
//! node runs in this order on any number of ranks, which is what makes their results equal to the bit.

use super::rotations::Rotations;
use crate::common::vector::add;
use crate::mesh::{Block, Connectivity, Coordinates, Mesh, Shape};
use crate::model::Model;
use crate::partition::{Contributors, Decomposition, rcb, space_filling_order};
use crate::solver::AddedMass;
use crate::solver::contact::{self, Overlap, Surfaces};
use crate::solver::elements::{Element, Sample};
use crate::solver::rigid::{self, BodyShape};
use crate::solver::tied::Tied;
use std::sync::{Arc, OnceLock};

/// A mesh with masses and its canonical order. What the surface needs when it changes is shared, not copied, by ranks.
pub struct Body {
    /// File position of each element, in canonical order: block by block, along a space-filling curve within each.
    pub element_order: Arc<Vec<u32>>,
    /// Index of the mesh block of each element, in canonical order.
    pub element_block: Arc<Vec<u32>>,
    /// Nodes of each element, in canonical order.
    pub element_nodes: Arc<Connectivity>,
    /// The same with the rotations of those that have them behind their nodes: all that elements give forces to.
    pub element_unknowns: Arc<Connectivity>,
    /// Rotations of the nodes that can turn.
    pub rotations: Rotations,
    /// Masses of the elements' material, in canonical order.
    pub element_mass: Vec<f64>,
    /// What MASS SCALING has added to elements and nodes.
    pub added_mass: AddedMass,
    /// What computes the elements of each mesh block.
    pub elements: Vec<Element>,
    /// File position of the first element of each mesh block.
    first: Vec<u32>,
    /// Lumped nodal masses, in file order, and rotary inertias of the rotations behind them.
    pub node_mass: Vec<f64>,
    /// Initial positions, lengths, in file order; those of the mesh unless contact surfaces overlapped there.
    pub positions: Coordinates,
    /// Faces under pressure, in canonical order after the elements.
    pub faces: Vec<LoadedFace>,
    /// Index into the model's materials of each mesh block.
    pub block_material: Vec<usize>,
    /// Overlaps between contact surfaces that were taken out of the mesh by moving nodes.
    pub overlap: Overlap,
    /// Nodes of surfaces and bars that begin nearer to faces than they touch, ascending, each with the part of that distance for which there
    /// is room.
    pub rooms: Vec<(u32, f64)>,
    /// Nodes of surfaces that are tied to others.
    pub tied: Tied,
    /// Rigid bodies, in the order of the deck.
    pub rigid: Vec<BodyShape>,
    /// Of each block of the mesh, which of them it belongs to.
    pub block_body: Vec<Option<usize>>,
    /// The surfaces that may touch, once a rank has asked for them.
    pub(in crate::solver) surfaces: OnceLock<Option<Surfaces>>,
}

/// A face under pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedFace {
    /// Canonical number of its element.
    pub element: u32,
    /// Nodes, counter-clockwise seen from outside.
    pub nodes: [u32; 4],
    /// Index into the model's pressures.
    pub pressure: u32,
}

/// A block of the mesh that the model gives no material: it cannot be computed, and least of all with another's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("element block {block} has no MATERIAL")]
pub struct NoMaterial {
    /// The element block's number.
    pub block: i64,
}

/// The element that computes a block.
fn element(block: &Block, model: &Model) -> Element {
    Element::of_block(block, model).expect("`model::check` has seen to it")
}

/// Mean of an element's corners.
pub fn centroid(corners: &[[f64; 3]]) -> [f64; 3] {
    let sum = corners.iter().fold([0.0; 3], |sum, corner| add(sum, *corner));
    sum.map(|s| s / corners.len() as f64)
}

/// Which rank computes which element and which loaded face.
pub struct Cut {
    element_ranks: Vec<u32>,
    face_ranks: Vec<u32>,
    face_nodes: Connectivity,
}

impl Body {
    /// Cuts the body for so many ranks by recursive coordinate bisection of the elements' centroids.
    pub fn cut(&self, ranks: usize) -> Cut {
        let centroids: Vec<_> = self.element_nodes.iter().map(|nodes| self.centroid(nodes)).collect();
        let element_ranks = rcb(&centroids, &vec![1.0; centroids.len()], ranks);
        Cut {
            face_ranks: self.faces.iter().map(|face| element_ranks[face.element as usize]).collect(),
            face_nodes: Connectivity::of(Shape::Quadrilateral, self.faces.iter().flat_map(|face| face.nodes).collect()),
            element_ranks,
        }
    }

    /// The body cut into shares.
    pub fn decomposition<'a>(&'a self, contributors: &'a [Contributors<'a>], ranks: usize) -> Decomposition<'a> {
        Decomposition::with_rotations(contributors, self.positions.len(), self.rotations.turning(), ranks)
    }

    /// Position of a node; of a rotation, which has none, that of a node that has not turned.
    pub fn start_of(&self, unknown: u32) -> [f64; 3] {
        self.positions.get(unknown as usize).copied().unwrap_or_default()
    }

    /// Everything that contributes forces to nodes, in canonical order: elements, then loaded faces.
    pub fn contributors<'a>(&'a self, cut: &'a Cut) -> [Contributors<'a>; 2] {
        [
            Contributors { nodes: &self.element_unknowns, ranks: &cut.element_ranks },
            Contributors { nodes: &cut.face_nodes, ranks: &cut.face_ranks },
        ]
    }

    /// Orders and weighs a mesh.
    ///
    /// # Errors
    /// When a block of the mesh has no material; a model that was checked against the mesh has one for each.
    pub fn new(mesh: &Mesh, model: &Model) -> Result<Body, NoMaterial> {
        let material = |block: i64| model.materials.iter().position(|m| m.block == block).ok_or(NoMaterial { block });
        let block_material = mesh.blocks.iter().map(|block| material(block.id)).collect::<Result<Vec<usize>, _>>()?;
        let mut body = Body {
            element_order: Arc::default(),
            element_block: Arc::default(),
            element_nodes: Arc::default(),
            element_unknowns: Arc::default(),
            rotations: Rotations::default(),
            element_mass: Vec::with_capacity(mesh.element_count()),
            added_mass: AddedMass::default(),
            elements: Vec::new(),
            first: Vec::new(),
            node_mass: vec![0.0; mesh.coordinates.len()],
            positions: mesh.coordinates.clone(),
            faces: Vec::new(),
            block_material,
            overlap: Overlap::default(),
            rooms: Vec::new(),
            tied: Tied::default(),
            rigid: Vec::new(),
            block_body: rigid::bodies_of_blocks(mesh, model),
            surfaces: OnceLock::new(),
        };
        body.take_elements(mesh, model);
        if !model.ties.is_empty() {
            body.tied = Tied::new(mesh, model, &mut body.positions);
        }
        body.overlap = contact::remove_overlap(mesh, model, &mut body);
        if body.overlap.nodes > 0 || !model.ties.is_empty() {
            body.tied.place(&mut body.positions);
            body.weigh(mesh, model);
            body.tied.hand_over(&mut body.node_mass);
        }
        body.rigid = rigid::shapes(mesh, model, &body);
        body.take_faces(mesh, model);
        Ok(body)
    }

    /// Mass of each mesh block.
    pub fn block_masses(&self, blocks: usize) -> Vec<f64> {
        let mut masses = vec![0.0; blocks];
        for (mass, &block) in self.element_mass.iter().zip(&*self.element_block) {
            masses[block as usize] += mass;
        }
        masses
    }

    /// Mean of the corners of an element given by its nodes.
    pub fn centroid(&self, nodes: &[u32]) -> [f64; 3] {
        let sum = nodes.iter().fold([0.0; 3], |sum, &node| add(sum, self.positions[node as usize]));
        sum.map(|s| s / nodes.len() as f64)
    }

    /// Positions of nodes.
    pub fn corners<const N: usize>(&self, nodes: &[u32; N]) -> [[f64; 3]; N] {
        nodes.map(|n| self.positions[n as usize])
    }

    fn take_elements(&mut self, mesh: &Mesh, model: &Model) {
        let count = mesh.element_count();
        let (mut order, mut blocks) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut elements = Connectivity::with_room_for(mesh.blocks.iter().map(|block| block.nodes.len()).sum());
        let mut first = 0u32;
        for (index, block) in mesh.blocks.iter().enumerate() {
            self.first.push(first);
            let nodes: Vec<&[u32]> = block.elements().collect();
            let centroids: Vec<_> = nodes.iter().map(|nodes| self.centroid(nodes)).collect();
            for place in space_filling_order(&centroids) {
                order.push(first + place);
                blocks.push(index as u32);
                elements.push(block.shape, nodes[place as usize].iter().copied());
            }
            first += block.len() as u32;
        }
        (self.element_order, self.element_block) = (Arc::new(order), Arc::new(blocks));
        self.element_nodes = Arc::new(elements);
        self.take_rotations(mesh, model);
        self.weigh(mesh, model);
    }

    /// Finds the nodes that can turn, and numbers their rotations.
    fn take_rotations(&mut self, mesh: &Mesh, model: &Model) {
        let turns: Vec<bool> = mesh.blocks.iter().map(|block| element(block, model).entry().rotations).collect();
        let blocks = mesh.blocks.iter().zip(&turns).filter(|(_, turns)| **turns);
        let mut turning: Vec<u32> = blocks.flat_map(|(block, _)| &block.nodes).copied().collect();
        turning.sort_unstable();
        turning.dedup();
        self.rotations = Rotations::new(mesh.coordinates.len(), turning);
        let of_block = |element: usize| turns[self.element_block[element] as usize];
        self.element_unknowns = self.rotations.extended(&self.element_nodes, of_block);
        self.node_mass.resize(self.rotations.unknowns(), 0.0);
    }

    /// Masses of elements and nodes from the positions as they are.
    fn weigh(&mut self, mesh: &Mesh, model: &Model) {
        self.node_mass.fill(0.0);
        self.element_mass.clear();
        self.elements = mesh.blocks.iter().map(|block| element(block, model)).collect();
        let (mut corners, mut shares) = (Vec::new(), Vec::new());
        for element in 0..self.element_nodes.len() {
            let nodes = &self.element_nodes[element];
            let block = self.element_block[element] as usize;
            corners.clear();
            corners.extend(nodes.iter().map(|&node| self.positions[node as usize]));
            let unknowns = &self.element_unknowns[element];
            shares.resize(unknowns.len(), 0.0);
            let attributes = mesh.blocks[block].attributes_of(self.place_in_block(element));
            let sample = Sample { nodes, corners: &corners, attributes };
            let density = model.materials[self.block_material[block]].density;
            let mass = self.elements[block].weigh(&sample, density, &mut shares);
            self.element_mass.push(mass);
            for (&node, share) in unknowns.iter().zip(&shares) {
                self.node_mass[node as usize] += mass * share;
            }
        }
        self.scale_masses(mesh, model);
        self.add_point_masses(mesh, model);
    }

    /// Adds what MASS SCALING asks for, to each corner by its share.
    fn scale_masses(&mut self, mesh: &Mesh, model: &Model) {
        let mut added = AddedMass::of(mesh, model, self);
        let mut shares = Vec::new();
        for element in 0..added.elements() {
            let mass = added.of_element(element);
            if mass == 0.0 {
                continue;
            }
            let unknowns = &self.element_unknowns[element];
            shares.resize(unknowns.len(), 0.0);
            let block = self.element_block[element] as usize;
            let corners: Vec<_> =
                self.element_nodes[element].iter().map(|&node| self.positions[node as usize]).collect();
            let attributes = mesh.blocks[block].attributes_of(self.place_in_block(element));
            let sample = Sample { nodes: &self.element_nodes[element], corners: &corners, attributes };
            self.elements[block].weigh(&sample, 1.0, &mut shares);
            for (&node, share) in unknowns.iter().zip(&shares) {
                self.node_mass[node as usize] += mass * share;
                added.add_to_node(node, mass * share, self.rotations.unknowns());
            }
        }
        self.added_mass = added;
    }

    /// Adds the masses that the deck gives nodes. One that belongs to no element has no part in the motion, with or without.
    fn add_point_masses(&mut self, mesh: &Mesh, model: &Model) {
        for point in &model.point_masses {
            // A node that its set names twice has the mass once.
            for (node, factor) in mesh.shares_of(point.node_set) {
                if self.node_mass[node as usize] > 0.0 {
                    self.node_mass[node as usize] += factor * point.mass;
                }
                if let Some(rotation) = self.rotations.of(node) {
                    self.node_mass[rotation as usize] += factor * point.inertia;
                }
            }
        }
    }

    /// Place of an element in its block of the mesh, by its canonical number.
    pub fn place_in_block(&self, element: usize) -> usize {
        (self.element_order[element] - self.first[self.element_block[element] as usize]) as usize
    }

    fn take_faces(&mut self, mesh: &Mesh, model: &Model) {
        if model.pressures.is_empty() {
            return;
        }
        let mut canonical = vec![0u32; self.element_order.len()];
        for (place, &file) in self.element_order.iter().enumerate() {
            canonical[file as usize] = place as u32;
        }
        for (pressure, load) in model.pressures.iter().enumerate() {
            // A face that its set names twice is pressed once.
            let mut sides = mesh.side_set(load.side_set).map_or(Vec::new(), |set| set.sides.clone());
            sides.sort_unstable();
            sides.dedup();
            for (element, side) in sides {
                let element = canonical[element as usize];
                let shape = self.element_nodes.shape(element as usize);
                let Some(nodes) = shape.face(&self.element_nodes[element as usize], side) else { continue };
                self.faces.push(LoadedFace { element, nodes, pressure: pressure as u32 });
            }
        }
    }
}
