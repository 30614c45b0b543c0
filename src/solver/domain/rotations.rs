//! Which nodes can turn.
//!
//! The rotation of a node is kept as a node of its own behind those of the mesh: its row holds the integral of the rotation
//! rate in place of the position, rotary inertia (mass·length²) in place of the mass and the rotation rate in place of the
//! velocity, and its force is a moment. Sums over ranks, integration, kinetic energy, constraints and their works then need no
//! second version; only what speaks of places, momentum or weight looks at the nodes of the mesh alone. A scene in which no
//! element turns has none.

use crate::mesh::Connectivity;
use std::sync::Arc;

/// Numbers of the rotations of nodes, above those of the nodes of the mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rotations {
    /// Nodes of the mesh.
    nodes: usize,
    /// Those of them that can turn, ascending.
    turning: Arc<Vec<u32>>,
}

impl Rotations {
    /// Of a mesh with so many nodes, of which these can turn: ascending, each once.
    pub fn new(nodes: usize, turning: Vec<u32>) -> Rotations {
        Rotations { nodes, turning: Arc::new(turning) }
    }

    /// Number of the rotation of a node of the mesh, if it can turn.
    pub fn of(&self, node: u32) -> Option<u32> {
        self.turning.binary_search(&node).ok().map(|place| (self.nodes + place) as u32)
    }

    /// The node of the mesh to which a number belongs, be it that of the node or that of its rotation.
    pub fn node(&self, number: u32) -> u32 {
        let behind = (number as usize).checked_sub(self.nodes);
        behind.and_then(|place| self.turning.get(place)).copied().unwrap_or(number)
    }

    /// The nodes that can turn, ascending.
    pub fn turning(&self) -> &[u32] {
        &self.turning
    }

    /// Whether no node can turn.
    pub fn is_empty(&self) -> bool {
        self.turning.is_empty()
    }

    /// Nodes of the mesh, and their rotations.
    pub fn unknowns(&self) -> usize {
        self.nodes + self.turning.len()
    }

    /// Elements with the rotations of those that turn behind their nodes; the same list where none turns.
    pub fn extended(&self, elements: &Arc<Connectivity>, turns: impl Fn(usize) -> bool) -> Arc<Connectivity> {
        if self.is_empty() {
            return elements.clone();
        }
        let mut all = Connectivity::default();
        for (place, (shape, nodes)) in elements.shaped().enumerate() {
            let rotations = nodes.iter().filter(|_| turns(place)).filter_map(|&node| self.of(node));
            all.push(shape, nodes.iter().copied().chain(rotations));
        }
        Arc::new(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Shape;

    #[test]
    fn rotations_are_numbered_behind_the_nodes() {
        let rotations = Rotations::new(6, vec![1, 2, 4]);
        assert_eq!([rotations.of(1), rotations.of(4), rotations.of(3)], [Some(6), Some(8), None]);
        assert_eq!([rotations.node(8), rotations.node(3), rotations.unknowns() as u32], [4, 3, 9]);
        let mut bars = Connectivity::default();
        [[0, 1], [1, 2], [2, 4]].iter().for_each(|bar| bars.push(Shape::Bar, *bar));
        let all = rotations.extended(&Arc::new(bars), |bar| bar > 0);
        assert_eq!([&all[0], &all[1], &all[2]], [&[0, 1][..], &[1, 2, 6, 7], &[2, 4, 7, 8]]);
    }
}
