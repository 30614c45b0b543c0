//! The discretised body: nodes, blocks of elements of one shape each, node sets and side sets, in the order of the file.
//!
//! A [`Mesh`] is plain data. It knows neither file formats (`exodus` fills it), nor mechanics (`solver` uses it).
//! All indices are zero-based positions in the file's order; the numbers an analyst knows are kept beside them
//! in `node_ids` and `element_ids`.

pub mod check;
mod connectivity;
mod coordinates;
pub mod corners;
pub mod exterior;
pub mod hexahedron;
pub mod locate;
mod part;
pub mod plane;
pub mod refine;
mod shape;

pub use connectivity::Connectivity;
pub use coordinates::Coordinates;
pub use hexahedron::{HEX_SIDES, UNIT_CUBE};
pub use part::{Part, Places};
pub use shape::Shape;
pub use shape::kind::Kind;

use std::collections::BTreeMap;

/// In how many dimensions the nodes of a mesh lie.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Dimension {
    /// In the x-y plane; z is zero.
    Two,
    /// In space.
    #[default]
    Three,
}

impl Dimension {
    /// Number of coordinates.
    pub fn count(self) -> usize {
        match self {
            Dimension::Two => 2,
            Dimension::Three => 3,
        }
    }
}

/// Whether numbers count from one, so that places in the file say all that they do.
pub fn counts_from_one(numbers: &[i64]) -> bool {
    numbers.iter().zip(1..).all(|(&number, place)| number == place)
}

/// A mesh as the analyst's file describes it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Title of the mesh file, at most 80 characters.
    pub title: String,
    /// Whether the mesh lies in the x-y plane or in space.
    pub dimension: Dimension,
    /// Node positions, one `[x, y, z]` per node, in the deck's unit of length.
    pub coordinates: Coordinates,
    /// Element blocks in file order; elements are numbered through the blocks in this order.
    pub blocks: Vec<Block>,
    /// Node sets in file order.
    pub node_sets: Vec<NodeSet>,
    /// Side sets in file order.
    pub side_sets: Vec<SideSet>,
    /// The analyst's node numbers, one per node.
    pub node_ids: Vec<i64>,
    /// The analyst's element numbers, one per element.
    pub element_ids: Vec<i64>,
    /// Quality-assurance records of the programs that made the mesh: name, version, date, time.
    pub qa: Vec<[String; 4]>,
    /// Numbers of the node sets and of the side sets that the file gives distribution factors other than 1. Those of side sets, and
    /// those of node sets in motions, nothing here uses: whoever drives or presses such a set is told.
    pub weighted: [Vec<i64>; 2],
    /// Distribution factors of node sets by their number, in the order of the set's nodes; sets without have 1. What is given per
    /// node is multiplied by them: see [`Mesh::shares_of`].
    pub node_factors: BTreeMap<i64, Vec<f64>>,
}

/// One element block: the elements of one material and one shape.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    /// The block's number, which a deck's MATERIAL command names.
    pub id: i64,
    /// The block's name, or an empty string.
    pub name: String,
    /// Shape of its elements.
    pub shape: Shape,
    /// Zero-based node indices, [`Shape::corners`] of them per element, in the order of EXODUS.
    pub nodes: Vec<u32>,
    /// Attributes of the elements as the mesh file gives them, equally many for each, element by element: the thickness
    /// of a shell, the area of a truss. Empty in a block that has none.
    pub attributes: Vec<f64>,
}

impl Block {
    /// A block of hexahedra, each given by its eight nodes: 1-2-3-4 around the bottom, 5-6-7-8 above them.
    pub fn hexahedra_of(id: i64, elements: impl IntoIterator<Item = [u32; 8]>) -> Block {
        Block { id, nodes: elements.into_iter().flatten().collect(), ..Block::default() }
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.nodes.len() / self.shape.corners()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Nodes of each element.
    pub fn elements(&self) -> impl ExactSizeIterator<Item = &[u32]> + Clone {
        self.nodes.chunks_exact(self.shape.corners())
    }

    /// Nodes of each element of a block of hexahedra; none in a block of another shape.
    pub fn hexahedra(&self) -> &[[u32; 8]] {
        if self.shape == Shape::Hexahedron { self.nodes.as_chunks().0 } else { &[] }
    }

    /// Attributes of the element at a place in the block; empty where it has none.
    pub fn attributes_of(&self, element: usize) -> &[f64] {
        let count = self.attributes.len().checked_div(self.len()).unwrap_or(0);
        self.attributes.get(element * count..(element + 1) * count).unwrap_or_default()
    }
}

/// A named set of nodes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct NodeSet {
    /// The set's number in the deck.
    pub id: i64,
    /// The set's name, or an empty string.
    pub name: String,
    /// Zero-based node indices.
    pub nodes: Vec<u32>,
}

/// A named set of element faces.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SideSet {
    /// The set's number in the deck.
    pub id: i64,
    /// The set's name, or an empty string.
    pub name: String,
    /// Faces as `(zero-based element index, zero-based local side)`; see [`Shape::sides`].
    pub sides: Vec<(u32, u8)>,
}

impl Mesh {
    /// Number of elements in all blocks.
    pub fn element_count(&self) -> usize {
        self.blocks.iter().map(Block::len).sum()
    }

    /// All elements in file order, each with the index of its block and its node indices.
    pub fn elements(&self) -> impl Iterator<Item = (usize, &[u32])> + Clone {
        self.blocks.iter().enumerate().flat_map(|(b, block)| block.elements().map(move |nodes| (b, nodes)))
    }

    /// The eight nodes of each hexahedron, in file order.
    pub fn hexahedra(&self) -> impl Iterator<Item = &[u32; 8]> + Clone {
        self.blocks.iter().flat_map(Block::hexahedra)
    }

    /// Shapes and nodes of all elements, in file order.
    pub fn shaped(&self) -> impl Iterator<Item = (Shape, &[u32])> + Clone {
        self.blocks.iter().flat_map(|block| block.elements().map(move |nodes| (block.shape, nodes)))
    }

    /// Shape of the element at a place, counted from 0 in file order, if there is one.
    pub fn shape_of(&self, element: u32) -> Option<Shape> {
        let mut end = 0;
        let is_in = |block: &&Block| {
            end += block.len();
            (element as usize) < end
        };
        self.blocks.iter().find(is_in).map(|block| block.shape)
    }

    /// All shapes and nodes as a list in which each element is found by its place.
    pub fn connectivity(&self) -> Connectivity {
        let mut all = Connectivity::with_room_for(self.blocks.iter().map(|block| block.nodes.len()).sum());
        self.shaped().for_each(|(shape, nodes)| all.push(shape, nodes.iter().copied()));
        all
    }

    /// The node set with this number, if there is one.
    pub fn node_set(&self, id: i64) -> Option<&NodeSet> {
        self.node_sets.iter().find(|s| s.id == id)
    }

    /// The side set with this number, if there is one.
    pub fn side_set(&self, id: i64) -> Option<&SideSet> {
        self.side_sets.iter().find(|s| s.id == id)
    }

    /// Nodes of the faces of a side set, each once, ascending; none when there is no such set.
    pub fn side_set_nodes(&self, id: i64) -> Vec<u32> {
        let Some(set) = self.side_set(id) else { return Vec::new() };
        let elements: Vec<(Shape, &[u32])> = self.shaped().collect();
        let of_side = |&(element, side): &(u32, u8)| {
            let (shape, nodes) = elements[element as usize];
            shape.sides()[side as usize].iter().map(move |&corner| nodes[corner])
        };
        let mut nodes: Vec<u32> = set.sides.iter().flat_map(of_side).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Nodes of a node set, each once, ascending: files may name one twice. None where there is no such set.
    pub fn distinct_nodes(&self, set: i64) -> Vec<u32> {
        let mut nodes = self.node_set(set).map_or(Vec::new(), |set| set.nodes.clone());
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Position of the block with this number, if there is one.
    pub fn block_index(&self, id: i64) -> Option<usize> {
        self.blocks.iter().position(|b| b.id == id)
    }
}
