//! The outer surface of a body of hexahedra.

use crate::mesh::HEX_SIDES;

/// A face of the outer surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Face {
    /// Position of the element in the list that the surface was made of.
    pub element: usize,
    /// Its four nodes, counter-clockwise seen from outside; a triangle has a node twice.
    pub nodes: [u32; 4],
}

/// The faces that belong to one element only, in the order of the elements and their sides.
///
/// `elements` are eight node indices each, below `node_count`. Faces that have collapsed to a line or a point are
/// left out.
pub fn outer_faces(elements: &[&[u32; 8]], node_count: usize) -> Vec<Face> {
    let side = |face: usize| HEX_SIDES[face % 6].map(|corner| elements[face / 6][corner]);
    let (starts, by_lowest_node) = sort_by_lowest_node(6 * elements.len(), node_count, side);
    let mut outer: Vec<usize> = Vec::new();
    let mut faces: Vec<([u32; 4], usize)> = Vec::new();
    for ends in starts.windows(2) {
        faces.clear();
        faces.extend(by_lowest_node[ends[0]..ends[1]].iter().map(|&face| (key(side(face)), face)));
        faces.sort_unstable();
        let once = faces.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
        outer.extend(once.map(|same| same[0].1));
    }
    outer.sort_unstable();
    outer.into_iter().map(|face| Face { element: face / 6, nodes: side(face) }).filter(|f| has_area(f.nodes)).collect()
}

/// Face numbers sorted by their lowest node, and where each node's begin. Equal faces then meet among a handful, so
/// that neither a hash table nor a sort of all faces is needed.
fn sort_by_lowest_node(faces: usize, nodes: usize, side: impl Fn(usize) -> [u32; 4]) -> (Vec<usize>, Vec<usize>) {
    let lowest = |face: usize| side(face).into_iter().min().unwrap_or(0) as usize;
    let mut starts = vec![0; nodes + 1];
    for face in 0..faces {
        starts[lowest(face) + 1] += 1;
    }
    for node in 0..nodes {
        starts[node + 1] += starts[node];
    }
    let mut next = starts.clone();
    let mut sorted = vec![0; faces];
    for face in 0..faces {
        let place = &mut next[lowest(face)];
        sorted[*place] = face;
        *place += 1;
    }
    (starts, sorted)
}

/// Two elements share a face when its nodes are the same in any order, each counted once: a quadrilateral collapsed
/// to a triangle then matches whichever corner it repeats.
fn key(mut nodes: [u32; 4]) -> [u32; 4] {
    nodes.sort_unstable();
    for i in (1..4).rev() {
        if nodes[i] == nodes[i - 1] {
            nodes[i..].rotate_left(1);
            nodes[3] = u32::MAX;
        }
    }
    nodes
}

fn has_area(nodes: [u32; 4]) -> bool {
    key(nodes)[2] != u32::MAX
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of `n` unit hexahedra along x: nodes of plane i are 4 i to 4 i + 3.
    fn row(n: u32) -> Vec<[u32; 8]> {
        (0..n).map(|i| [0, 1, 2, 3, 4, 5, 6, 7].map(|c| 4 * i + c)).collect()
    }

    #[test]
    fn a_row_of_elements_shows_four_faces_each_and_its_two_ends() {
        let elements = row(5);
        let faces = outer_faces(&elements.iter().collect::<Vec<_>>(), 24);
        assert_eq!(faces.len(), 5 * 4 + 2);
        assert_eq!(faces.iter().filter(|f| f.element == 0).count(), 5);
        assert_eq!(faces.iter().filter(|f| f.element == 2).count(), 4);
    }

    #[test]
    fn a_wedge_shows_two_triangles_and_three_quadrilaterals() {
        // Nodes 2 and 3, and 6 and 7, have become one: side 2-3-7-6 has collapsed to the line 2-6.
        let faces = outer_faces(&[&[0, 1, 2, 2, 4, 5, 6, 6]], 8);
        let triangles = faces.iter().filter(|f| key(f.nodes)[3] == u32::MAX).count();
        assert_eq!((faces.len(), triangles), (5, 2));
    }

    #[test]
    fn triangles_match_whichever_corner_they_repeat() {
        assert_eq!(key([5, 9, 9, 2]), key([2, 2, 5, 9]));
        assert_eq!(key([5, 9, 9, 2]), [2, 5, 9, u32::MAX]);
        assert!(!has_area([3, 3, 8, 8]) && !has_area([4, 4, 4, 4]) && has_area([1, 2, 3, 3]));
    }
}
