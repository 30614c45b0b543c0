//! A part of a mesh, cut out so that it can be put back where it was.

use super::{Block, Mesh, NodeSet, SideSet};

/// A part of a mesh: all of its blocks and sets, with what is here of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Part {
    /// The nodes and elements that are here, as a mesh; blocks and sets may be empty.
    pub mesh: Mesh,
    /// Where they are in the whole.
    pub places: Places,
}

/// Zero-based places in the whole of all that a part holds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Places {
    /// Of the nodes.
    pub nodes: Vec<u32>,
    /// Of the elements.
    pub elements: Vec<u32>,
    /// Of the entries of each node set in the whole set.
    pub node_sets: Vec<Vec<u32>>,
    /// Of the entries of each side set in the whole set.
    pub side_sets: Vec<Vec<u32>>,
}

/// Marks what is not here.
const ABSENT: u32 = u32::MAX;

impl Mesh {
    /// The part with these nodes and elements, given by their places in ascending order. The elements' nodes must be
    /// among the nodes. QA records are those of the whole.
    pub fn part(&self, nodes: Vec<u32>, elements: Vec<u32>) -> Part {
        let node_here = numbered(self.coordinates.len(), &nodes);
        let element_here = numbered(self.element_count(), &elements);
        let mut part = Part { places: Places { nodes, elements, ..Places::default() }, ..Part::default() };
        part.mesh = Mesh {
            title: self.title.clone(),
            dimension: self.dimension,
            coordinates: part.places.nodes.iter().map(|&n| self.coordinates[n as usize]).collect(),
            blocks: self.parts_of_blocks(&part.places.elements, &node_here),
            node_ids: part.places.nodes.iter().map(|&n| self.node_ids[n as usize]).collect(),
            element_ids: part.places.elements.iter().map(|&e| self.element_ids[e as usize]).collect(),
            qa: self.qa.clone(),
            ..Mesh::default()
        };
        for set in &self.node_sets {
            let (places, here) = entries(set.nodes.iter().map(|&n| (node_here[n as usize], ())));
            let nodes = here.into_iter().map(|(node, ())| node).collect();
            if let Some(factors) = self.node_factors.get(&set.id) {
                // Of a set without nodes here, too: it shows that the whole set has factors.
                let here = places.iter().filter_map(|&place| factors.get(place as usize).copied());
                part.mesh.node_factors.insert(set.id, here.collect());
            }
            part.mesh.node_sets.push(NodeSet { id: set.id, name: set.name.clone(), nodes });
            part.places.node_sets.push(places);
        }
        for set in &self.side_sets {
            let (places, sides) = entries(set.sides.iter().map(|&(e, side)| (element_here[e as usize], side)));
            part.mesh.side_sets.push(SideSet { id: set.id, name: set.name.clone(), sides });
            part.places.side_sets.push(places);
        }
        part
    }

    fn parts_of_blocks(&self, mut elements: &[u32], node_here: &[u32]) -> Vec<Block> {
        let mut first = 0;
        let mut blocks = Vec::with_capacity(self.blocks.len());
        for block in &self.blocks {
            let end = first + block.len();
            let (here, rest) = elements.split_at(elements.partition_point(|&e| (e as usize) < end));
            let corners = block.shape.corners();
            let nodes = here.iter().flat_map(|&e| &block.nodes[(e as usize - first) * corners..][..corners]);
            blocks.push(Block {
                id: block.id,
                name: block.name.clone(),
                shape: block.shape,
                nodes: nodes.map(|&n| node_here[n as usize]).collect(),
                attributes: here.iter().flat_map(|&e| block.attributes_of(e as usize - first)).copied().collect(),
            });
            (elements, first) = (rest, end);
        }
        blocks
    }
}

/// The number of each thing of the whole in a part, [`ABSENT`] where it is not in it.
fn numbered(whole: usize, places: &[u32]) -> Vec<u32> {
    let mut here = vec![ABSENT; whole];
    (0..).zip(places).for_each(|(number, &place)| here[place as usize] = number);
    here
}

/// The entries that are here, and their places among all.
fn entries<T>(all: impl Iterator<Item = (u32, T)>) -> (Vec<u32>, Vec<(u32, T)>) {
    (0..).zip(all).filter(|(_, (here, _))| *here != ABSENT).unzip()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three cubes in a row, the last one in a block of its own.
    fn row() -> Mesh {
        let hex = |i: u32| [4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4, 4 * i + 5, 4 * i + 6, 4 * i + 7];
        Mesh {
            coordinates: (0..16).map(|n| [f64::from(n), 0.0, 0.0]).collect(),
            node_ids: (101..117).collect(),
            element_ids: vec![30, 10, 20],
            blocks: vec![
                Block { attributes: vec![0.5, 0.25], ..Block::hexahedra_of(1, [hex(0), hex(1)]) },
                Block::hexahedra_of(2, [hex(2)]),
            ],
            node_sets: vec![NodeSet { id: 5, nodes: vec![15, 4, 0, 8], ..NodeSet::default() }],
            node_factors: [(5, vec![0.5, 1.0, 1.5, 2.0])].into(),
            side_sets: vec![SideSet { id: 6, sides: vec![(2, 1), (0, 4), (1, 3)], ..SideSet::default() }],
            ..Mesh::default()
        }
    }

    #[test]
    fn the_middle_of_three_cubes() {
        let part = row().part((4..12).collect(), vec![1]);
        assert_eq!(part.mesh.blocks[0].hexahedra(), [[0, 1, 2, 3, 4, 5, 6, 7]]);
        assert_eq!(part.mesh.blocks[0].attributes, [0.25]);
        assert!(part.mesh.blocks[1].is_empty());
        assert_eq!((part.mesh.node_ids[0], part.mesh.element_ids[0]), (105, 10));
        assert_eq!((&part.mesh.node_sets[0].nodes[..], &part.places.node_sets[0][..]), (&[0, 4][..], &[1, 3][..]));
        assert_eq!(part.mesh.node_factors[&5], [1.0, 2.0]);
        assert_eq!((&part.mesh.side_sets[0].sides[..], &part.places.side_sets[0][..]), (&[(0, 3)][..], &[2][..]));
    }

    #[test]
    fn the_whole_and_nothing_are_parts_too() {
        let whole = row();
        assert_eq!(whole.part((0..16).collect(), vec![0, 1, 2]).mesh, whole);
        let nothing = whole.part(Vec::new(), Vec::new());
        assert_eq!((nothing.mesh.coordinates.len(), nothing.mesh.element_count()), (0, 0));
        assert_eq!((nothing.mesh.blocks.len(), nothing.mesh.node_sets.len()), (2, 1));
    }
}
