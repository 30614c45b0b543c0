//! The discretised body: nodes, blocks of hexahedra, node sets and side sets, in the order of the file.
//!
//! A [`Mesh`] is plain data. It knows neither file formats (`exodus` fills it), nor mechanics (`solver` uses it).
//! All indices are zero-based positions in the file's order; the numbers an analyst knows are kept beside them
//! in `node_ids` and `element_ids`.

pub mod check;
pub mod corners;
pub mod locate;
mod part;
pub mod shape;

pub use part::{Part, Places};

/// A mesh of eight-node hexahedra as the analyst's file describes it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Title of the mesh file, at most 80 characters.
    pub title: String,
    /// Node positions, one `[x, y, z]` per node, in the deck's unit of length.
    pub coordinates: Vec<[f64; 3]>,
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
    /// Numbers of the node sets and of the side sets that the file gives distribution factors other than 1, which nothing
    /// here uses: whoever loads such a set is told.
    pub weighted: [Vec<i64>; 2],
}

/// One element block: the elements of one material.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    /// The block's number, which a deck's MATERIAL command names.
    pub id: i64,
    /// The block's name, or an empty string.
    pub name: String,
    /// Eight zero-based node indices per element: 1-2-3-4 around the bottom, 5-6-7-8 above them.
    pub connectivity: Vec<[u32; 8]>,
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
    /// Faces as `(zero-based element index, zero-based local side)`; see [`HEX_SIDES`].
    pub sides: Vec<(u32, u8)>,
}

/// Corners of a unit cube in the order of a hexahedron's nodes.
pub const UNIT_CUBE: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

/// Local nodes of the six faces of a hexahedron in EXODUS order, each turning counter-clockwise seen from outside.
pub const HEX_SIDES: [[usize; 4]; 6] =
    [[0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [0, 4, 7, 3], [0, 3, 2, 1], [4, 5, 6, 7]];

impl Mesh {
    /// Number of elements in all blocks.
    pub fn element_count(&self) -> usize {
        self.blocks.iter().map(|b| b.connectivity.len()).sum()
    }

    /// All elements in file order, each with the index of its block and its eight node indices.
    pub fn elements(&self) -> impl Iterator<Item = (usize, &[u32; 8])> {
        self.blocks.iter().enumerate().flat_map(|(b, block)| block.connectivity.iter().map(move |nodes| (b, nodes)))
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
        let elements: Vec<&[u32; 8]> = self.elements().map(|(_, nodes)| nodes).collect();
        let mut nodes: Vec<u32> = (set.sides.iter())
            .flat_map(|&(element, side)| HEX_SIDES[side as usize].map(|corner| elements[element as usize][corner]))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Position of the block with this number, if there is one.
    pub fn block_index(&self, id: i64) -> Option<usize> {
        self.blocks.iter().position(|b| b.id == id)
    }
}
