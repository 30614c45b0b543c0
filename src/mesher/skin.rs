//! Faces on the outside of a mesh, as sides of its elements.

use super::body::Sides;
use crate::mesh::exterior::{self, SIDES};
use crate::mesh::{Connectivity, Mesh};

/// The exterior faces all of whose nodes `keep` accepts, in the order of the elements.
pub fn exterior(mesh: &Mesh, keep: impl Fn(u32) -> bool) -> Sides {
    let faces = exterior::exterior(mesh.shaped(), mesh.coordinates.len(), keep);
    faces.into_iter().map(|face| (face / SIDES as u32, (face as usize % SIDES) as u8)).collect()
}

/// The nodes of a side, which may be an edge of a shell.
pub fn nodes_of_side(elements: &Connectivity, (element, side): (u32, u8)) -> impl Iterator<Item = u32> {
    let element = element as usize;
    let corners = elements.shape(element).sides().get(usize::from(side)).copied().unwrap_or_default();
    corners.iter().map(move |&corner| elements[element][corner])
}

/// The four nodes of a face, counter-clockwise seen from outside.
pub fn nodes(elements: &Connectivity, element: u32, side: u8) -> [u32; 4] {
    let element = element as usize;
    elements.shape(element).face(&elements[element], side).unwrap_or_default()
}
