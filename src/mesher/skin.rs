//! Faces on the outside of a mesh, as sides of its elements.

use super::body::Sides;
use crate::mesh::exterior::{self, SIDES};
use crate::mesh::{Connectivity, Mesh};

/// The exterior faces all of whose nodes `keep` accepts, in the order of the elements.
pub fn exterior(mesh: &Mesh, keep: impl Fn(u32) -> bool) -> Sides {
    let faces = exterior::exterior(mesh.shaped(), mesh.coordinates.len(), keep);
    faces.into_iter().map(|face| (face / SIDES as u32, (face as usize % SIDES) as u8)).collect()
}

/// The four nodes of a face, counter-clockwise seen from outside.
pub fn nodes(elements: &Connectivity, element: u32, side: u8) -> [u32; 4] {
    let element = element as usize;
    elements.shape(element).face(&elements[element], side).unwrap_or_default()
}
