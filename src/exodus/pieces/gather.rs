//! Parts of a mesh become the whole again.

use super::Sizes;
use crate::mesh::{Block, Mesh, NodeSet, Part, SideSet};

/// Marks entries that no part has given yet.
const MISSING: u32 = u32::MAX;

/// A mesh to which parts are added.
pub struct Gathering {
    mesh: Mesh,
    node_seen: Vec<bool>,
    /// Block that each element belongs to, and its place there.
    sizes: Sizes,
}

impl Gathering {
    /// A mesh of these sizes, with the names and numbers that any part has.
    pub fn new(sizes: &Sizes, like: &Mesh) -> Gathering {
        let blocks = like.blocks.iter().map(|block| Block {
            id: block.id,
            name: block.name.clone(),
            // The shape is known from the first part that has elements of the block.
            ..Block::default()
        });
        let node_sets = like.node_sets.iter().zip(&sizes.node_sets).map(|(set, &size)| NodeSet {
            id: set.id,
            name: set.name.clone(),
            nodes: vec![MISSING; size],
        });
        let side_sets = like.side_sets.iter().zip(&sizes.side_sets).map(|(set, &size)| SideSet {
            id: set.id,
            name: set.name.clone(),
            sides: vec![(MISSING, 0); size],
        });
        let mesh = Mesh {
            title: like.title.clone(),
            dimension: like.dimension,
            coordinates: vec![[0.0; 3]; sizes.nodes].into(),
            blocks: blocks.collect(),
            node_sets: node_sets.collect(),
            side_sets: side_sets.collect(),
            node_ids: vec![0; sizes.nodes],
            element_ids: vec![0; sizes.elements()],
            qa: Vec::new(),
            weighted: Default::default(),
            node_factors: Default::default(),
        };
        Gathering { mesh, node_seen: vec![false; sizes.nodes], sizes: sizes.clone() }
    }

    /// Puts a part where it belongs. Its places are within the sizes of the whole.
    ///
    /// # Errors
    /// When an element stands in a block that is not its own, or was given before.
    pub fn add(&mut self, part: &Part) -> Result<(), String> {
        let (mesh, places) = (&part.mesh, &part.places);
        for (here, &place) in places.nodes.iter().enumerate() {
            self.mesh.coordinates[place as usize] = mesh.coordinates[here];
            self.mesh.node_ids[place as usize] = mesh.node_ids[here];
            self.node_seen[place as usize] = true;
        }
        for (here, &place) in places.elements.iter().enumerate() {
            self.mesh.element_ids[place as usize] = mesh.element_ids[here];
        }
        self.add_elements(part)?;
        for ((whole, set), places) in self.mesh.node_sets.iter_mut().zip(&mesh.node_sets).zip(&places.node_sets) {
            for (&node, &place) in set.nodes.iter().zip(places) {
                whole.nodes[place as usize] = part.places.nodes[node as usize];
            }
        }
        for ((set, places), &size) in mesh.node_sets.iter().zip(&places.node_sets).zip(&self.sizes.node_sets) {
            let Some(factors) = mesh.node_factors.get(&set.id) else { continue };
            let whole = self.mesh.node_factors.entry(set.id).or_insert_with(|| vec![1.0; size]);
            factors.iter().zip(places).for_each(|(&factor, &place)| whole[place as usize] = factor);
        }
        for ((whole, set), places) in self.mesh.side_sets.iter_mut().zip(&mesh.side_sets).zip(&places.side_sets) {
            for (&(element, side), &place) in set.sides.iter().zip(places) {
                whole.sides[place as usize] = (part.places.elements[element as usize], side);
            }
        }
        Ok(())
    }

    fn add_elements(&mut self, part: &Part) -> Result<(), String> {
        let mut places = part.places.elements.iter();
        let mut first = 0;
        for ((whole, block), &size) in self.mesh.blocks.iter_mut().zip(&part.mesh.blocks).zip(&self.sizes.blocks) {
            let corners = block.shape.corners();
            if whole.is_empty() && !block.is_empty() {
                whole.shape = block.shape;
                whole.nodes = vec![MISSING; size * corners];
                whole.attributes = vec![0.0; size * block.attributes_of(0).len()];
            }
            if whole.shape != block.shape && !block.is_empty() {
                return Err(format!("its block {} is not of {}", block.id, whole.shape.names()[1]));
            }
            for (here, (nodes, &place)) in block.elements().zip(&mut places).enumerate() {
                let place_there = (place as usize).checked_sub(first).filter(|&there| there < size);
                let there = place_there.filter(|there| whole.nodes[there * corners] == MISSING);
                let Some(there) = there else {
                    return Err(format!("its element at place {} of the whole is given twice or astray", place + 1));
                };
                let slots = whole.nodes[there * corners..].iter_mut().zip(nodes);
                slots.for_each(|(slot, &node)| *slot = part.places.nodes[node as usize]);
                let own = block.attributes_of(here);
                whole.attributes.iter_mut().skip(there * own.len()).zip(own).for_each(|(slot, own)| *slot = *own);
            }
            first += size;
        }
        Ok(())
    }

    /// The mesh, when nothing is missing in it.
    ///
    /// # Errors
    /// What is missing.
    pub fn finish(self) -> Result<Mesh, String> {
        let told =
            |kind: &str, place: usize| Err(format!("no piece has the {kind} at place {} of the whole", place + 1));
        if let Some(place) = self.node_seen.iter().position(|seen| !seen) {
            return told("node", place);
        }
        let mut first = 0;
        for (block, size) in self.mesh.blocks.iter().zip(&self.sizes.blocks) {
            let missing = if block.is_empty() { (*size > 0).then_some(0) } else { None };
            if let Some(place) = missing.or_else(|| block.elements().position(|nodes| nodes[0] == MISSING)) {
                return told("element", first + place);
            }
            first += size;
        }
        for set in &self.mesh.node_sets {
            if let Some(place) = set.nodes.iter().position(|&node| node == MISSING) {
                return told(&format!("entry of node set {}", set.id), place);
            }
        }
        for set in &self.mesh.side_sets {
            if let Some(place) = set.sides.iter().position(|&(element, _)| element == MISSING) {
                return told(&format!("entry of side set {}", set.id), place);
            }
        }
        Ok(self.mesh)
    }
}
