//! SHEET, SHEET TUBE and SHEET SPHERE: surfaces of quadrilaterals, for shells. Each is a face of a solid shape.

use crate::mesher::body::{Body, Face, Shape};

/// One face of a solid shape, seen from outside of it.
pub struct Sheet<S> {
    /// The solid, one cell thick.
    pub solid: S,
    /// Which of its faces.
    pub face: Face,
}

impl<S: Shape> Shape for Sheet<S> {
    /// The solid has one cell through its thickness, and `refine` of them when it is refined.
    fn elements(&self, refine: usize) -> f64 {
        self.solid.elements(refine) / refine.max(1) as f64
    }

    fn faces(&self) -> Vec<Face> {
        Vec::new()
    }

    fn body(&self, refine: usize) -> Body {
        let solid = self.solid.body(refine);
        let sides = solid.faces.iter().filter(|(face, _)| *face == self.face).flat_map(|(_, sides)| sides);
        let quads = sides
            .filter_map(|&(element, side)| crate::mesh::Shape::Hexahedron.face(&solid.hexes[element as usize], side));
        let mut quads: Vec<[u32; 4]> = quads.collect();
        let mut number = vec![u32::MAX; solid.coordinates.len()];
        let mut coordinates = Vec::new();
        for node in quads.iter_mut().flatten() {
            let place = &mut number[*node as usize];
            if *place == u32::MAX {
                *place = coordinates.len() as u32;
                coordinates.push(solid.coordinates[*node as usize]);
            }
            *node = *place;
        }
        Body { coordinates, quads, ..Body::default() }
    }
}
