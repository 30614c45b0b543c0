//! The whole body before it is cut: elements and nodes in canonical order, with their masses.
//!
//! The canonical order depends on mesh and model only, never on the decomposition. Every sum over elements at a
//! node runs in this order on any number of ranks, which is what makes their results equal to the bit.

use crate::mesh::check::hexahedron_volume;
use crate::mesh::{HEX_SIDES, Mesh, shape};
use crate::model::Model;
use crate::partition::{Contributors, rcb, space_filling_order};
use crate::solver::contact::{self, Overlap};
use std::sync::Arc;

/// A mesh with masses and its canonical order. What the surface needs when it changes is shared, not copied, by ranks.
pub struct Body {
    /// File position of each element, in canonical order: block by block, along a space-filling curve within each.
    pub element_order: Arc<Vec<u32>>,
    /// Index of the mesh block of each element, in canonical order.
    pub element_block: Arc<Vec<u32>>,
    /// Nodes of each element, in canonical order.
    pub element_nodes: Arc<Vec<[u32; 8]>>,
    /// Element masses, in canonical order.
    pub element_mass: Vec<f64>,
    /// For each mesh block the least share of a corner's eighth that a node has; see [`shape::least_share`].
    pub least_share: Vec<f64>,
    /// Lumped nodal masses, in file order.
    pub node_mass: Vec<f64>,
    /// Initial positions, in file order; those of the mesh unless contact surfaces overlapped there.
    pub positions: Arc<Vec<[f64; 3]>>,
    /// Faces under pressure, in canonical order after the elements.
    pub faces: Vec<LoadedFace>,
    /// Index into the model's materials of each mesh block.
    pub block_material: Vec<usize>,
    /// Overlaps between contact surfaces that were taken out of the mesh by moving nodes.
    pub overlap: Overlap,
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

/// Mean of an element's corners.
pub fn centroid(corners: &[[f64; 3]; 8]) -> [f64; 3] {
    let sum = corners.iter().fold([0.0; 3], |s, c| [s[0] + c[0], s[1] + c[1], s[2] + c[2]]);
    sum.map(|s| s / 8.0)
}

/// Which rank computes which element and which loaded face.
pub struct Cut {
    element_ranks: Vec<u32>,
    face_ranks: Vec<u32>,
    face_nodes: Vec<u32>,
}

impl Body {
    /// Cuts the body for so many ranks by recursive coordinate bisection of the elements' centroids.
    pub fn cut(&self, ranks: usize) -> Cut {
        let centroids: Vec<_> = self.element_nodes.iter().map(|nodes| centroid(&self.corners(nodes))).collect();
        let element_ranks = rcb(&centroids, &vec![1.0; centroids.len()], ranks);
        Cut {
            face_ranks: self.faces.iter().map(|face| element_ranks[face.element as usize]).collect(),
            face_nodes: self.faces.iter().flat_map(|face| face.nodes).collect(),
            element_ranks,
        }
    }

    /// Everything that contributes forces to nodes, in canonical order: elements, then loaded faces.
    pub fn contributors<'a>(&'a self, cut: &'a Cut) -> [Contributors<'a>; 2] {
        [
            Contributors { corners: 8, nodes: self.element_nodes.as_flattened(), ranks: &cut.element_ranks },
            Contributors { corners: 4, nodes: &cut.face_nodes, ranks: &cut.face_ranks },
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
            element_mass: Vec::with_capacity(mesh.element_count()),
            least_share: vec![1.0; mesh.blocks.len()],
            node_mass: vec![0.0; mesh.coordinates.len()],
            positions: Arc::new(mesh.coordinates.clone()),
            faces: Vec::new(),
            block_material,
            overlap: Overlap::default(),
        };
        body.take_elements(mesh, model);
        body.overlap = contact::remove_overlap(mesh, model, &mut body);
        if body.overlap.nodes > 0 {
            body.weigh(model);
        }
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

    /// Corner positions of an element given by its nodes.
    pub fn corners(&self, nodes: &[u32; 8]) -> [[f64; 3]; 8] {
        nodes.map(|n| self.positions[n as usize])
    }

    fn take_elements(&mut self, mesh: &Mesh, model: &Model) {
        let count = mesh.element_count();
        let (mut order, mut blocks) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut corners = Vec::with_capacity(count);
        let mut first = 0u32;
        for (index, block) in mesh.blocks.iter().enumerate() {
            let centroids: Vec<_> = block.connectivity.iter().map(|nodes| centroid(&self.corners(nodes))).collect();
            for place in space_filling_order(&centroids) {
                order.push(first + place);
                blocks.push(index as u32);
                corners.push(block.connectivity[place as usize]);
            }
            first += block.connectivity.len() as u32;
        }
        (self.element_order, self.element_block) = (Arc::new(order), Arc::new(blocks));
        self.element_nodes = Arc::new(corners);
        self.weigh(model);
    }

    /// Masses of elements and nodes from the positions as they are.
    fn weigh(&mut self, model: &Model) {
        self.node_mass.fill(0.0);
        self.least_share.fill(1.0);
        self.element_mass.clear();
        for element in 0..self.element_nodes.len() {
            let nodes = self.element_nodes[element];
            let block = self.element_block[element] as usize;
            let corners = self.corners(&nodes);
            let mass = model.materials[self.block_material[block]].density * hexahedron_volume(&corners);
            self.element_mass.push(mass);
            let shares = shape::mass_shares(&nodes, &corners);
            for (node, share) in nodes.into_iter().zip(shares) {
                self.node_mass[node as usize] += mass * share;
            }
            self.least_share[block] = self.least_share[block].min(shape::least_share(&nodes, &shares));
        }
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
                let corners = self.element_nodes[element as usize];
                let nodes = HEX_SIDES[side as usize].map(|corner| corners[corner]);
                self.faces.push(LoadedFace { element, nodes, pressure: pressure as u32 });
            }
        }
    }
}
