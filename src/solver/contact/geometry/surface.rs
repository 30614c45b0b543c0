//! The outside of the body: faces that belong to one element only, and how it grows inwards as elements go.
//!
//! A face's number is 6 × its element + its side and never changes; see [`crate::mesh::exterior`].

use crate::mesh::Connectivity;
use crate::mesh::exterior::{self, EXTERIOR, NONE as GONE};
use std::collections::BTreeMap;

/// All faces of a body of solids and who is across.
#[derive(Debug, Clone, Default)]
pub struct Surface {
    /// Per face number: the face across, [`EXTERIOR`], or [`GONE`] with the element or if the face is of no interest.
    opposite: Vec<u32>,
    /// Of surface elements that share all nodes with others: their number, and faces of solids or of earlier surface elements
    /// there. While one of those is left, the surface element is part of it and has no outside of its own.
    covers: BTreeMap<u32, Vec<u32>>,
}

/// What is on a face.
pub fn face_nodes(elements: &Connectivity, face: u32) -> [u32; 4] {
    let element = face as usize / 6;
    elements.shape(element).face(&elements[element], (face % 6) as u8).unwrap_or_default()
}

/// Nodes of the side across the element from a face.
pub fn back_nodes(elements: &Connectivity, face: u32) -> [u32; 4] {
    const BACK: [u32; 6] = [2, 3, 0, 1, 5, 4];
    face_nodes(elements, face - face % 6 + BACK[face as usize % 6])
}

impl Surface {
    /// Pairs up the faces of elements given by their nodes. Only faces all of whose nodes are `wanted` are looked
    /// at; the others count as gone. Both elements at a face name the same nodes, so a face is wanted on both sides
    /// or on neither.
    pub fn new(elements: &Connectivity, node_count: usize, wanted: impl Fn(u32) -> bool) -> Surface {
        let mut opposite = exterior::across(elements.shaped(), node_count, &wanted);
        let covers = covers(elements, &wanted);
        // Surfaces are not across from each other.
        for element in surface_elements(elements) {
            for face in [6 * element, 6 * element + 1] {
                if opposite[face as usize] != GONE {
                    opposite[face as usize] = EXTERIOR;
                }
            }
        }
        Surface { opposite, covers }
    }

    /// Faces on the outside, ascending.
    pub fn exterior(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.opposite.len() as u32).filter(|&face| self.is_exterior(face))
    }

    /// Whether a face is on the outside.
    pub fn is_exterior(&self, face: u32) -> bool {
        let is_left = |&face: &u32| self.opposite[face as usize] != GONE;
        self.opposite[face as usize] == EXTERIOR
            && (self.covers.is_empty()
                || !self.covers.get(&(face / 6)).is_some_and(|others| others.iter().any(is_left)))
    }

    /// Takes an element away: its faces are gone and those across from them are outside now (Attaway et al. 1996).
    /// The order in which elements go does not matter.
    pub fn delete(&mut self, element: u32) {
        for face in 6 * element..6 * element + 6 {
            let across = std::mem::replace(&mut self.opposite[face as usize], GONE);
            if across != EXTERIOR && across != GONE {
                self.opposite[across as usize] = EXTERIOR;
            }
        }
    }
}

/// Numbers of the surface elements, ascending.
fn surface_elements(elements: &Connectivity) -> impl Iterator<Item = u32> + '_ {
    (0..elements.len() as u32).filter(|&element| elements.shape(element as usize).is_surface())
}

/// See [`Surface::covers`].
fn covers(elements: &Connectivity, wanted: impl Fn(u32) -> bool) -> BTreeMap<u32, Vec<u32>> {
    let mut at: BTreeMap<[u32; 4], Vec<u32>> = BTreeMap::new();
    for element in surface_elements(elements) {
        at.extend(exterior::key(face_nodes(elements, 6 * element)).map(|key| (key, Vec::new())));
    }
    if at.is_empty() {
        return BTreeMap::new();
    }
    for (element, (shape, nodes)) in (0u32..).zip(elements.shaped()) {
        let sides = if shape.is_surface() { 1 } else { 6 };
        for (side, nodes) in
            exterior::faces(shape, nodes).take(sides).filter(|(_, nodes)| nodes.iter().all(|&n| wanted(n)))
        {
            if let Some(there) = exterior::key(nodes).and_then(|key| at.get_mut(&key)) {
                there.push(6 * element + u32::from(side));
            }
        }
    }
    let is_solid = |face: &u32| !elements.shape(*face as usize / 6).is_surface();
    let of_element = |element: u32| {
        let there = at.get(&exterior::key(face_nodes(elements, 6 * element))?)?;
        let others: Vec<u32> = there.iter().copied().filter(|face| is_solid(face) || face / 6 < element).collect();
        (!others.is_empty()).then_some((element, others))
    };
    surface_elements(elements).filter_map(of_element).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Shape;

    /// n³ unit cubes; element (i, j, k) is number i + n (j + n k).
    fn cubes(n: u32) -> Connectivity {
        let m = n + 1;
        let at = |i, j, k| i + m * (j + m * k);
        let corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)];
        let cube = |e| corners.map(|(a, b, c)| at(e % n + a, e / n % n + b, e / (n * n) + c));
        Connectivity::of(Shape::Hexahedron, (0..n * n * n).flat_map(cube).collect())
    }

    /// Numbers of exterior faces and of the nodes on them.
    fn counts(surface: &Surface, elements: &Connectivity) -> [usize; 2] {
        let mut nodes: Vec<u32> = surface.exterior().flat_map(|face| face_nodes(elements, face)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        [surface.exterior().count(), nodes.len()]
    }

    /// Case V-31 of the verification table.
    #[test]
    fn erosion_of_a_block_exposes_the_known_numbers_of_faces_and_nodes() {
        let elements = cubes(4);
        let mut surface = Surface::new(&elements, 125, |_| true);
        assert_eq!(counts(&surface, &elements), [96, 98]);
        let deleted = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [2, 1, 1], [2, 2, 2]];
        let expected = [[96, 98], [96, 98], [98, 100], [102, 104], [106, 108], [112, 114]];
        for ([i, j, k], expected) in deleted.into_iter().zip(expected) {
            surface.delete(i + 4 * (j + 4 * k));
            assert_eq!(counts(&surface, &elements), expected);
        }
    }

    /// Extreme 19: half of all elements at once, against a surface built from what is left.
    #[test]
    fn deleting_half_of_a_block_equals_building_the_rest() {
        let elements = cubes(6);
        let dead = |e: u32| (e.wrapping_mul(2654435761) >> 16) & 1 == 0;
        let mut surface = Surface::new(&elements, 343, |_| true);
        (0..216).rev().filter(|&e| dead(e)).for_each(|e| surface.delete(e));
        let left: Vec<u32> = (0..216).filter(|&e| !dead(e)).collect();
        let rest = left.iter().flat_map(|&e| &elements[e as usize]).copied().collect();
        let rest = Connectivity::of(Shape::Hexahedron, rest);
        let built: Vec<u32> =
            Surface::new(&rest, 343, |_| true).exterior().map(|face| 6 * left[face as usize / 6] + face % 6).collect();
        assert_eq!(surface.exterior().collect::<Vec<_>>(), built);
    }

    #[test]
    fn a_wedge_on_a_wedge_shares_its_triangle() {
        // Two triangular prisms, one above the other, as hexahedra with repeated nodes.
        let wedges = vec![0, 1, 2, 2, 3, 4, 5, 5, 3, 4, 5, 5, 6, 7, 8, 8];
        let wedges = Connectivity::of(Shape::Hexahedron, wedges);
        let surface = Surface::new(&wedges, 9, |_| true);
        // Each has two triangles and three quadrilaterals; the shared triangle is inside.
        assert_eq!(surface.exterior().count(), 8);
    }

    #[test]
    fn shells_on_faces_of_solids_count_when_these_are_gone() {
        // A cube, a shell on its top face, another at the same place, and one beside it.
        let mut elements = cubes(1);
        let top = [4, 5, 7, 6];
        elements.push(Shape::Quadrilateral, top);
        elements.push(Shape::Quadrilateral, [5, 4, 6, 7]);
        elements.push(Shape::Quadrilateral, [4, 5, 8, 9]);
        let mut surface = Surface::new(&elements, 10, |_| true);
        assert_eq!(surface.exterior().collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5, 18, 19]);
        surface.delete(0);
        assert_eq!(surface.exterior().collect::<Vec<_>>(), [6, 7, 18, 19]);
        surface.delete(1);
        assert_eq!(surface.exterior().collect::<Vec<_>>(), [12, 13, 18, 19]);
    }

    #[test]
    fn the_back_of_a_face_has_none_of_its_nodes() {
        let elements = cubes(1);
        for face in 0..6 {
            let (front, back) = (face_nodes(&elements, face), back_nodes(&elements, face));
            assert!(front.iter().all(|node| !back.contains(node)));
        }
    }
}
