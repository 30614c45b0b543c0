//! At what distance elements touch: what they say of themselves, times what the deck makes of it.

use crate::common::shared::Shared;
use crate::mesh::Mesh;
use crate::model::Model;
use crate::solver::body::Body;
use crate::solver::elements::Touch;
use std::collections::BTreeMap;

/// What elements that are no solids say of how they touch, by their canonical numbers.
#[derive(Debug, Clone, Default)]
pub struct Touching {
    /// Distance at which each element is touched, a length; empty where all are solids.
    distances: Shared<f64>,
    /// Elements whose nodes touch, ascending.
    pub of_nodes: Vec<u32>,
    /// Nodes that CONTACT NODE SET names, in its order.
    pub single: Vec<SingleNode>,
}

/// A node that touches as a ball whatever its elements are.
#[derive(Debug, Clone)]
pub struct SingleNode {
    /// The node in the mesh.
    pub node: u32,
    /// Its radius, a length.
    pub radius: f64,
    /// Index of the block of its first element.
    pub block: u32,
    /// Its elements that are there, by their canonical numbers, ascending.
    elements: Vec<u32>,
}

impl Touching {
    /// Asks all elements of a body.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body) -> Touching {
        let factor = |block: i64| {
            let given = model.contact.thicknesses.iter().rev().find(|(id, _)| *id == block);
            given.map_or(1.0, |(_, factor)| *factor)
        };
        let mut touching = Touching { single: single_nodes(mesh, model, body), ..Touching::default() };
        if body.elements.iter().all(|element| element.touch(&[]) == Touch::Outside) {
            return touching;
        }
        let mut distances = Vec::with_capacity(body.element_block.len());
        for (element, &block) in (0u32..).zip(&*body.element_block) {
            let block = block as usize;
            let of_mesh = &mesh.blocks[block];
            let attributes = of_mesh.attributes_of(body.place_in_block(element as usize));
            distances.push(match body.elements[block].touch(attributes) {
                Touch::Outside => 0.0,
                Touch::BothSides(distance) => factor(of_mesh.id) * distance,
                Touch::Nodes(radius) => {
                    touching.of_nodes.push(element);
                    factor(of_mesh.id) * radius
                }
            });
        }
        touching.distances = distances.into();
        touching
    }

    /// Without the elements of blocks that do not touch.
    pub fn of_chosen(mut self, chosen: impl Fn(u32) -> bool) -> Touching {
        self.of_nodes.retain(|&element| chosen(element));
        self
    }

    /// All elements where they are.
    pub fn without_distances(self) -> Touching {
        let single = self.single.into_iter().map(|single| SingleNode { radius: 0.0, ..single });
        Touching { distances: Shared::default(), single: single.collect(), ..self }
    }

    /// Takes elements away, given by their canonical numbers, ascending; nodes touch as long as they have one.
    pub fn delete(&mut self, elements: &[u32]) {
        let is_left = |element: &u32| elements.binary_search(element).is_err();
        self.of_nodes.retain(is_left);
        self.single.iter_mut().for_each(|single| single.elements.retain(is_left));
        self.single.retain(|single| !single.elements.is_empty());
    }

    /// Distance at which an element is touched, a length.
    pub fn distance(&self, element: u32) -> f64 {
        self.distances.get(element as usize).copied().unwrap_or(0.0)
    }
}

/// The nodes of CONTACT NODE SET that belong to elements.
fn single_nodes(mesh: &Mesh, model: &Model, body: &Body) -> Vec<SingleNode> {
    let mut single = Vec::new();
    for &(id, radius) in &model.contact.node_sets {
        let nodes = mesh.node_set(id).map_or(&[][..], |set| &set.nodes);
        single.extend(nodes.iter().map(|&node| SingleNode { node, radius, block: 0, elements: Vec::new() }));
    }
    if single.is_empty() {
        return single;
    }
    let mut elements: BTreeMap<u32, Vec<u32>> = single.iter().map(|single| (single.node, Vec::new())).collect();
    for (element, nodes) in (0u32..).zip(body.element_nodes.iter()) {
        for node in nodes {
            if let Some(of_node) = elements.get_mut(node).filter(|of_node| of_node.last() != Some(&element)) {
                of_node.push(element);
            }
        }
    }
    for one in &mut single {
        one.elements = elements.get(&one.node).cloned().unwrap_or_default();
        one.block = one.elements.first().map_or(0, |&element| body.element_block[element as usize]);
    }
    single.retain(|one| !one.elements.is_empty());
    single
}
