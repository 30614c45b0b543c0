//! Parts put together: one list of nodes, one of elements, and which block each element belongs to.

use std::ops::Range;

use super::{
    body::{Body, Face, Sides},
    changes::merge,
};
use crate::mesh::{Block, Dimension, Mesh, Shape, check};

/// All parts of a recipe, in its order.
#[derive(Debug, Clone, Default)]
pub struct Assembly {
    coordinates: Vec<[f64; 3]>,
    hexes: Vec<[u32; 8]>,
    /// Block number of each hexahedron.
    blocks: Vec<i64>,
    /// Two-node elements, each with the number of its block.
    bars: Vec<([u32; 2], i64)>,
    /// Whether the mesh is two-dimensional: the lower sides of the hexahedra are its elements.
    flat: bool,
    /// Quadrilaterals of surfaces, in the same way.
    quads: Vec<([u32; 4], i64)>,
    parts: Vec<Part>,
}

#[derive(Debug, Clone)]
struct Part {
    block: i64,
    nodes: Range<usize>,
    elements: Range<usize>,
    /// Whether the faces are sides of quadrilaterals of a surface instead of hexahedra.
    of_surface: bool,
    faces: Vec<(Face, Sides)>,
}

/// What MERGE has joined.
pub struct Joined {
    /// How many nodes became others.
    pub nodes: usize,
    /// How many of those that they became have no edge of an element in common with another part.
    pub single: usize,
    /// Place of the first of these.
    pub first: Option<[f64; 3]>,
}

/// A mesh without sets, with the named faces of the shapes it was made of.
#[derive(Debug, Clone)]
pub struct Assembled {
    /// The mesh.
    pub mesh: Mesh,
    /// The faces of each part, with the block it was made as.
    pub faces: Vec<(i64, Vec<(Face, Sides)>)>,
}

impl Assembly {
    /// Adds a body as a part of its own.
    pub fn add(&mut self, block: i64, body: Body) {
        let (nodes, elements, quads) = (self.coordinates.len(), self.hexes.len(), self.quads.len());
        self.flat |= body.flat;
        self.coordinates.extend(body.coordinates);
        self.hexes.extend(body.hexes.iter().map(|hex| hex.map(|node| node + nodes as u32)));
        self.blocks.resize(self.hexes.len(), block);
        self.bars.extend(body.bars.iter().map(|bar| (bar.map(|node| node + nodes as u32), block)));
        self.quads.extend(body.quads.iter().map(|quad| (quad.map(|node| node + nodes as u32), block)));
        let of_surface = body.hexes.is_empty();
        let first = if of_surface { quads } else { elements };
        let mut faces = body.faces;
        faces.iter_mut().flat_map(|(_, sides)| sides).for_each(|(element, _)| *element += first as u32);
        self.parts.push(Part {
            block,
            nodes: nodes..self.coordinates.len(),
            elements: elements..self.hexes.len(),
            of_surface,
            faces,
        });
    }

    /// Lengths of the diagonal of the model's bounding box and of its shortest element edge.
    pub fn lengths(&self) -> (f64, f64) {
        let diagonal = super::bounds(&self.coordinates).map(|[low, high]| high - low);
        let mut shortest = f64::INFINITY;
        for hex in &self.hexes {
            let x = hex.map(|node| self.coordinates[node as usize]);
            for &[a, b] in Shape::Hexahedron.edges() {
                shortest = shortest.min(super::distance(x[a], x[b]));
            }
        }
        for [a, b] in self.bars.iter().map(|(bar, _)| bar.map(|node| self.coordinates[node as usize])) {
            shortest = shortest.min(super::distance(a, b));
        }
        for (quad, _) in &self.quads {
            let x = quad.map(|node| self.coordinates[node as usize]);
            for i in 0..4 {
                shortest = shortest.min(super::distance(x[i], x[(i + 1) % 4]));
            }
        }
        (super::distance(diagonal, [0.0; 3]), shortest)
    }

    /// Joins coincident nodes of the parts made as these blocks, of all parts if there are none.
    pub fn merge(&mut self, blocks: &[i64], tolerance: f64) -> Joined {
        let chosen = self.parts.iter().filter(|part| blocks.is_empty() || blocks.contains(&part.block));
        let ranges: Vec<_> = chosen.map(|part| part.nodes.clone()).collect();
        let becomes = merge::representatives(&self.coordinates, &ranges, tolerance);
        let of_parts: Vec<_> = self.parts.iter().map(|part| part.nodes.clone()).collect();
        let mut single = merge::single(&becomes, self.edges(), &of_parts);
        // A bar hangs on its ends.
        self.bars.iter().flat_map(|(bar, _)| bar).for_each(|&node| {
            single.remove(&becomes[node as usize]);
        });
        self.nodes_mut().for_each(|node| *node = becomes[*node as usize]);
        // In the plane nodes have others above them.
        let layers = if self.flat { 2 } else { 1 };
        Joined {
            nodes: becomes.iter().zip(0..).filter(|&(&becomes, node)| becomes != node).count() / layers,
            single: single.len() / layers,
            first: single.first().map(|&node| self.coordinates[node as usize]),
        }
    }

    /// Edges of all solids and surfaces; of elements in the plane not those across it.
    fn edges(&self) -> impl Iterator<Item = [u32; 2]> {
        let of_hex = Shape::Hexahedron.edges().iter().filter(|[a, b]| !self.flat || (*a < 4) == (*b < 4));
        let hexes = self.hexes.iter().flat_map(move |hex| of_hex.clone().map(move |edge| edge.map(|i| hex[i])));
        let quads = self.quads.iter().flat_map(|(quad, _)| (0..4).map(move |i| [quad[i], quad[(i + 1) % 4]]));
        hexes.chain(quads)
    }

    /// Puts the elements of a block whose centre lies in a box into another block. Returns how many these are.
    pub fn split(&mut self, block: i64, new: i64, low: [f64; 3], high: [f64; 3]) -> usize {
        let mut moved = 0;
        for (hex, here) in self.hexes.iter().zip(&mut self.blocks).filter(|(_, here)| **here == block) {
            let centre = [0, 1, 2].map(|i| hex.iter().map(|&n| self.coordinates[n as usize][i]).sum::<f64>() / 8.0);
            if (0..3).all(|i| low[i] <= centre[i] && centre[i] <= high[i]) {
                *here = new;
                moved += 1;
            }
        }
        moved
    }

    /// Nodes of all elements.
    fn nodes_mut(&mut self) -> impl Iterator<Item = &mut u32> {
        let bars = self.bars.iter_mut().flat_map(|(bar, _)| bar);
        let quads = self.quads.iter_mut().flat_map(|(quad, _)| quad);
        self.hexes.iter_mut().flatten().chain(bars).chain(quads)
    }

    /// The first part of bars or surfaces in a block that has elements of another shape, if there is one.
    pub fn mixed_part(&self) -> Option<usize> {
        let solid = |block: &i64| self.blocks.contains(block);
        let lined = |block: &i64| self.bars.iter().any(|(_, bar)| bar == block);
        let mut bars = self.bars.iter().map(|(_, block)| *block).filter(|block| solid(block));
        let mut quads = self.quads.iter().map(|(_, block)| *block).filter(|block| solid(block) || lined(block));
        let block = bars.next().or(quads.next())?;
        self.parts.iter().position(|part| part.block == block && part.elements.is_empty())
    }

    /// The first part with an element that has no positive volume, if there is one.
    pub fn flat_part(&self) -> Option<usize> {
        let flat = self.hexes.iter().position(|hex| {
            let volume = check::hexahedron_volume(&hex.map(|node| self.coordinates[node as usize]));
            !(volume > 0.0 && volume.is_finite())
        })?;
        self.parts.iter().position(|part| part.elements.contains(&flat))
    }

    /// The mesh: blocks in the order of their numbers, without the nodes that merging left over.
    pub fn finish(mut self, title: &str) -> Assembled {
        if self.flat {
            // What the upper sides had is not used any more.
            self.hexes.iter_mut().for_each(|[a, b, c, d, above @ ..]| *above = [*a, *b, *c, *d]);
        }
        self.drop_unused_nodes();
        let dimension = if self.flat { Dimension::Two } else { Dimension::Three };
        let corners = if self.flat { 4 } else { 8 };
        let shape = if self.flat { Shape::Plane } else { Shape::Hexahedron };
        let mut mesh = Mesh { title: title.to_string(), dimension, ..Mesh::default() };
        let quads = self.quads.iter().map(|(_, block)| *block);
        let bars = self.bars.iter().map(|(_, block)| *block);
        let mut ids: Vec<i64> = self.blocks.iter().copied().chain(bars).chain(quads).collect();
        ids.sort_unstable();
        ids.dedup();
        let (mut place, mut place_of_quad) = (vec![0u32; self.hexes.len()], vec![0u32; self.quads.len()]);
        let mut placed = 0;
        for id in ids {
            let count = self.blocks.iter().filter(|block| **block == id).count();
            let mut block = Block { id, shape, nodes: Vec::with_capacity(corners * count), ..Block::default() };
            for element in (0..self.hexes.len()).filter(|&element| self.blocks[element] == id) {
                place[element] = placed;
                placed += 1;
                block.nodes.extend(&self.hexes[element][..corners]);
            }
            let bars = self.bars.iter().filter(|(_, block)| *block == id);
            let bars: Vec<u32> = bars.flat_map(|(bar, _)| *bar).collect();
            if !bars.is_empty() {
                block = Block { shape: Shape::Bar, nodes: bars, ..block };
                placed += block.len() as u32;
            }
            let quads = self.quads.iter().zip(&mut place_of_quad).filter(|((_, block), _)| *block == id);
            let mut nodes: Vec<u32> = Vec::new();
            for ((quad, _), place) in quads {
                nodes.extend(quad);
                *place = placed;
                placed += 1;
            }
            if !nodes.is_empty() {
                block = Block { shape: Shape::Quadrilateral, nodes, ..block };
            }
            mesh.blocks.push(block);
        }
        for part in &mut self.parts {
            let place = if part.of_surface { &place_of_quad } else { &place };
            let sides = part.faces.iter_mut().flat_map(|(_, sides)| sides);
            sides.for_each(|side| side.0 = place[side.0 as usize]);
        }
        mesh.node_ids = (1..=self.coordinates.len() as i64).collect();
        mesh.element_ids = (1..=mesh.element_count() as i64).collect();
        // Nodes that shapes had in common are gone: what they took is given back.
        self.coordinates.shrink_to_fit();
        mesh.coordinates = self.coordinates.into();
        Assembled { mesh, faces: self.parts.into_iter().map(|part| (part.block, part.faces)).collect() }
    }

    fn drop_unused_nodes(&mut self) {
        let mut used = vec![false; self.coordinates.len()];
        self.nodes_mut().for_each(|node| used[*node as usize] = true);
        let mut count = 0;
        let numbers: Vec<u32> = used.iter().map(|&used| (count, count += u32::from(used)).0).collect();
        let mut used = used.into_iter();
        self.coordinates.retain(|_| used.next().unwrap_or(false));
        self.nodes_mut().for_each(|node| *node = numbers[*node as usize]);
    }
}
