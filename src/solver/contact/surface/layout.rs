//! What the deck lets touch as it is now: points, faces, edges, and interfaces.

use super::exclusions::Exclusions;
use crate::common::shared::Shared;
use crate::solver::contact::geometry::edges::{Edge, Shape};
use crate::solver::contact::geometry::faces::Faces;
use crate::solver::contact::observations::meetings::Blocks;
use crate::solver::contact::search::locate::{Interface, Rule};
use std::sync::Arc;

/// No point.
pub const ABSENT: u32 = u32::MAX;

/// Where each of `count` numbers is among some of them, [`ABSENT`] for those that are not.
pub fn inverse(numbers: impl Iterator<Item = u32>, count: usize) -> Vec<u32> {
    let mut places = vec![ABSENT; count];
    (0..).zip(numbers).for_each(|(place, number)| places[number as usize] = place);
    places
}

/// Points and faces as they are now. Copies share what does not change: ranks of one process have one surface.
#[derive(Debug, Clone, Default)]
pub struct Layout {
    /// Middle of the points at the start, lengths: boxes in single precision are seen from there.
    pub origin: [f64; 3],
    /// Node of the mesh of each point, ascending.
    pub nodes: Shared<u32>,
    /// Block of each point: that of the first of its faces.
    pub point_block: Shared<u32>,
    /// Faces.
    pub faces: Arc<Faces>,
    /// Interfaces; explicit pairs first.
    pub interfaces: Shared<Interface>,
    /// Edges of the faces that CONTACT MATERIAL lets touch, ascending; none where edges touch nothing.
    pub edges: Shared<Edge>,
    /// Whether lines of the mesh meet edges that stand out.
    pub lines: bool,
    /// For each point those that TIED CONTACT joins with it, ascending: they do not touch. Empty without any.
    pub joined: Shared<Vec<u32>>,
    /// Whether there are surfaces; their edges meet all lines.
    pub surfaces: bool,
    /// Blocks that CONTACT MATERIAL leaves apart.
    pub exclusions: Arc<Exclusions>,
    /// Blocks that have a say at each point, and at each face.
    pub blocks_around: [Shared<Blocks>; 2],
}

impl Layout {
    /// The interface of CONTACT MATERIAL.
    pub fn automatic(&self) -> Option<&Interface> {
        self.interfaces.iter().find(|interface| interface.rule == Rule::Blocks)
    }

    /// Whether an edge may touch others.
    pub fn takes_part(&self, edge: u32) -> bool {
        match self.edges[edge as usize].shape {
            Shape::StandsOut => true,
            Shape::Bent | Shape::Line => self.lines || self.surfaces,
            Shape::Hollow => false,
        }
    }

    /// Whether an edge looks for others: what it does not find finds it, or does not meet it.
    pub fn looks_around(&self, edge: u32) -> bool {
        match self.edges[edge as usize].shape {
            Shape::StandsOut => true,
            Shape::Bent => self.lines,
            Shape::Line | Shape::Hollow => false,
        }
    }

    /// Whether an edge that looks around is the first of it and another: of two that stand out, or two bent ones, that with the lower number.
    pub fn meets(&self, edge: u32, other: u32) -> bool {
        let [first, second] = [edge, other].map(|edge| &self.edges[edge as usize]);
        match (first.shape, second.shape) {
            (Shape::StandsOut, Shape::StandsOut) => other > edge,
            (Shape::StandsOut, _) => self.lines || first.is_of_surface(&self.faces),
            (Shape::Bent, Shape::Bent) => self.lines && other > edge,
            _ => false,
        }
    }

    /// Whether TIED CONTACT joins a point with any of some others.
    pub fn are_joined(&self, point: u32, others: &[u32]) -> bool {
        let own = self.joined.get(point as usize);
        own.is_some_and(|own| others.iter().any(|other| own.binary_search(other).is_ok()))
    }

    /// The edge between two nodes of the mesh.
    pub fn edge(&self, nodes: [u32; 2]) -> Option<u32> {
        let ends = nodes.map(|node| self.point(node));
        self.edges.binary_search_by(|edge| edge.ends.cmp(&ends)).ok().map(|edge| edge as u32)
    }

    /// The point of a node of the mesh, or [`ABSENT`].
    pub fn point(&self, node: u32) -> u32 {
        self.nodes.binary_search(&node).map_or(ABSENT, |point| point as u32)
    }

    /// The place of a face by its number, or [`ABSENT`].
    pub fn face(&self, number: u32) -> u32 {
        self.faces.number.binary_search(&number).map_or(ABSENT, |face| face as u32)
    }
}
