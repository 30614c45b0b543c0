//! Plane sections of quadrilaterals, and the bodies they sweep along z.

use crate::mesher::{
    body::{Body, Face},
    shapes::hex_box::between,
    shapes::spacing::Spacing,
};

/// A mesh of quadrilaterals in the x-y plane.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    /// Node positions.
    pub points: Vec<[f64; 2]>,
    /// Four nodes each, turning counter-clockwise.
    pub quads: Vec<[u32; 4]>,
    /// Edges on the rim by name: the quadrilateral, and which of its edges, from node e to the next.
    pub edges: Vec<(Face, u32, u8)>,
}

impl Section {
    /// The section itself. It is handed out as the lower side of one layer of hexahedra about as thick as the section is wide,
    /// so that all that is done with solids is done with it; sides 0 to 3 are its edges.
    pub fn flat(&self) -> Body {
        let size = crate::mesher::bounds(&self.points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>());
        let thickness = size[..2].iter().map(|[low, high]| high - low).fold(0.0, f64::max);
        let mut body = self.sweep(thickness, Spacing { cells: 1, grading: 1.0 }, 1);
        body.flat = true;
        body.faces.retain(|(face, _)| !matches!(face, Face::Bottom | Face::Top));
        body
    }

    /// The body between z = 0 and z = `length`.
    pub fn sweep(&self, length: f64, along: Spacing, refine: usize) -> Body {
        let heights = along.positions(refine);
        let layers = heights.len() - 1;
        let mut body = Body::default();
        for &s in &heights {
            let z = between(0.0, length, s);
            body.coordinates.extend(self.points.iter().map(|&[x, y]| [x, y, z]));
        }
        let (points, quads) = (self.points.len() as u32, self.quads.len() as u32);
        for layer in 0..layers as u32 {
            let [below, above] = [layer * points, (layer + 1) * points];
            body.hexes.extend(self.quads.iter().map(|&[a, b, c, d]| {
                [a + below, b + below, c + below, d + below, a + above, b + above, c + above, d + above]
            }));
        }
        body.add_to_face(Face::Bottom, (0..quads).map(|quad| (quad, 4)));
        body.add_to_face(Face::Top, (0..quads).map(|quad| ((layers as u32 - 1) * quads + quad, 5)));
        // Edge e of a quadrilateral sweeps side e of the hexahedra.
        for layer in 0..layers as u32 {
            for &(face, quad, edge) in &self.edges {
                body.add_to_face(face, [(layer * quads + quad, edge)]);
            }
        }
        body
    }
}
