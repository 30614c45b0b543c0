//! SHEET, SHEET TUBE and SHEET SPHERE: surfaces of quadrilaterals, for shells. Each is a face of a solid shape.

use crate::mesh::Shape::{Hexahedron, Quadrilateral};
use crate::mesher::body::{Body, Face, Shape};

/// One face of a solid shape, seen from outside of it.
pub struct Sheet<S> {
    /// The solid, one cell thick.
    pub solid: S,
    /// Which of its faces.
    pub face: Face,
    /// Whether the solid is made against the direction of each axis, so that what it calls its left face is the right one and so on.
    pub against: [bool; 3],
}

impl<S: Shape> Sheet<S> {
    /// What a face of the solid is to the sheet: where it meets the sheet, the other faces are edges of it.
    fn name(&self, face: Face) -> Face {
        let turned = face.axis().is_some_and(|axis| self.against[axis]);
        face.opposite().filter(|_| turned).unwrap_or(face)
    }
}

impl<S: Shape> Shape for Sheet<S> {
    /// The solid has one cell through its thickness, and `refine` of them when it is refined.
    fn elements(&self, refine: usize) -> f64 {
        self.solid.elements(refine) / refine.max(1) as f64
    }

    /// The two sides, which are called by the direction in which they look, and the edges.
    fn faces(&self) -> Vec<Face> {
        self.solid.faces()
    }

    fn body(&self, refine: usize) -> Body {
        let solid = self.solid.body(refine);
        let picked = |wanted: bool| solid.faces.iter().filter(move |(face, _)| (*face == self.face) == wanted);
        let sides = || picked(true).flat_map(|(_, sides)| sides);
        let nodes = |element: u32, side: u8| Hexahedron.face(&solid.hexes[element as usize], side);
        let mut quads: Vec<[u32; 4]> = sides().filter_map(|&(element, side)| nodes(element, side)).collect();

        let count = quads.len() as u32;
        let mut body = Body::default();
        body.add_to_face(self.name(self.face), (0..count).map(|quad| (quad, 0)));
        if let Some(back) = self.face.opposite() {
            body.add_to_face(self.name(back), (0..count).map(|quad| (quad, 1)));
        }
        // Which quadrilateral lies on each hexahedron.
        let mut on = vec![u32::MAX; solid.hexes.len()];
        sides().zip(0..).for_each(|(&(element, _), quad)| on[element as usize] = quad);
        for (face, others) in picked(false) {
            let edges = others.iter().filter_map(|&(element, side)| {
                let (quad, ends) = (on[element as usize], nodes(element, side)?);
                Some((quad, edge_among(quads.get(quad as usize)?, &ends)?))
            });
            body.add_to_face(self.name(*face), edges);
        }

        let mut number = vec![u32::MAX; solid.coordinates.len()];
        for node in quads.iter_mut().flatten() {
            let place = &mut number[*node as usize];
            if *place == u32::MAX {
                *place = body.coordinates.len() as u32;
                body.coordinates.push(solid.coordinates[*node as usize]);
            }
            *node = *place;
        }
        Body { quads, ..body }
    }
}

/// The side of a quadrilateral that is an edge between two of these nodes.
fn edge_among(quad: &[u32; 4], nodes: &[u32; 4]) -> Option<u8> {
    let edges = (0..).zip(Quadrilateral.sides()).filter(|(side, _)| !Quadrilateral.is_face(*side));
    let mut among = edges.filter(|(_, corners)| corners.iter().all(|&corner| nodes.contains(&quad[corner])));
    among.next().map(|(side, _)| side)
}

#[cfg(test)]
mod tests {
    use crate::common::vector::{cross, dot, subtract};
    use crate::mesh::Mesh;
    use crate::mesher::make;

    /// The mesh of a recipe with a node set 1 and a side set 2 of a face of its block 1.
    fn picked(recipe: &str, face: &str, refine: usize) -> Mesh {
        let text = format!("{recipe}\nNODE SET FACE, 1, 1, {face}\nSIDE SET FACE, 2, 1, {face}\n");
        make(&text, "t.mesh", refine).unwrap_or_else(|found| panic!("{}", found.render(false)))
    }

    /// Asks that an edge has all nodes of the mesh with this coordinate, and no others, in both sets.
    fn edge(recipe: &str, face: &str, [axis, refine]: [usize; 2], at: f64) {
        let mesh = picked(recipe, face, refine);
        let there: Vec<u32> = (0u32..)
            .zip(mesh.coordinates.iter())
            .filter(|(_, x)| (x[axis] - at).abs() < 1e-12)
            .map(|(node, _)| node)
            .collect();
        assert!(there.len() > 1, "{recipe}");
        assert_eq!(mesh.distinct_nodes(1), there, "{recipe}, {face}");
        assert_eq!(mesh.side_set_nodes(2), there, "{recipe}, {face}");
        let sides = &mesh.side_set(2).expect("a side set").sides;
        assert!(sides.iter().all(|&(element, side)| mesh.shape_of(element).is_some_and(|shape| !shape.is_face(side))));
    }

    /// Asks that a side has all faces that look along a direction, one of each element.
    fn side(recipe: &str, face: &str, along: impl Fn([f64; 3]) -> [f64; 3]) {
        let mesh = picked(recipe, face, 1);
        assert_eq!(mesh.distinct_nodes(1).len(), mesh.coordinates.len(), "{recipe}, {face}");
        let sides = &mesh.side_set(2).expect("a side set").sides;
        assert_eq!(sides.len(), mesh.element_count(), "{recipe}, {face}");
        let elements = mesh.connectivity();
        for &(element, side) in sides {
            let corners = elements.shape(element as usize).face(&elements[element as usize], side).expect("a face");
            let [a, b, c, _] = corners.map(|node| mesh.coordinates[node as usize]);
            assert!(dot(cross(subtract(b, a), subtract(c, a)), along(a)) > 0.0, "{recipe}, {face}");
        }
    }

    #[test]
    fn edges_and_sides_of_a_sheet_have_the_names_of_a_flat_box() {
        let pairs = [["LEFT", "RIGHT"], ["FRONT", "BACK"], ["BOTTOM", "TOP"]];
        for across in 0..3 {
            for signs in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
                let mut size = [0.0f64; 3];
                (0..3)
                    .filter(|&axis| axis != across)
                    .zip([3.0, 2.0].iter().zip(signs))
                    .for_each(|(axis, (n, s))| size[axis] = n * s);
                let recipe = format!("SHEET, 1, 0, 0, 0, {}, {}, {}, 3, 2", size[0], size[1], size[2]);
                for axis in (0..3).filter(|&axis| axis != across) {
                    for refine in [1, 2] {
                        edge(&recipe, pairs[axis][0], [axis, refine], size[axis].min(0.0));
                        edge(&recipe, pairs[axis][1], [axis, refine], size[axis].max(0.0));
                    }
                }
                let towards = |sign: f64| move |_| [0, 1, 2].map(|axis: usize| if axis == across { sign } else { 0.0 });
                side(&recipe, pairs[across][0], towards(-1.0));
                side(&recipe, pairs[across][1], towards(1.0));
            }
        }
    }

    #[test]
    fn edges_and_sides_of_round_sheets_have_names() {
        let tube = "SHEET TUBE, 1, 1, 2, 8, 3, QUARTER";
        for (face, axis, at) in [("BOTTOM", 2, 0.0), ("TOP", 2, 2.0), ("CUT X", 0, 0.0), ("CUT Y", 1, 0.0)] {
            edge(tube, face, [axis, 1], at);
            edge(tube, face, [axis, 2], at);
        }
        let ball = "SHEET SPHERE, 1, 1, 4, OCTANT";
        for (face, axis) in [("CUT X", 0), ("CUT Y", 1), ("CUT Z", 2)] {
            edge(ball, face, [axis, 2], 0.0);
        }
        side(ball, "OUTER", |x| x);
        side(ball, "INNER", |x| x.map(|x| -x));
        side("SHEET TUBE, 1, 1, 2, 8, 3", "INNER", |[x, y, _]| [-x, -y, 0.0]);
        assert!(make("SHEET TUBE, 1, 1, 2, 8, 3\nNODE SET FACE, 1, 1, CUT X\n", "t", 1).is_err());
    }

    /// Moved, mirrored, divided, among other blocks: a face is the image of what it was.
    #[test]
    fn named_faces_of_sheets_follow_what_is_done_to_them() {
        let sheet = "SHEET, 1, 0, 0, 0, 3, 2, 0, 3, 2";
        for triangles in ["", "\nTRIANGLES, 1", "\nTRIANGLES, 1, DIAGONAL", "\nTRIANGLES, 1, CROSS"] {
            let around =
                "SHEET, 9, 0, 0, 5, 3, 2, 0, 3, 2\nBOX, 5, 0, 0, 7, 3, 2, 1, 3, 2, 1\nLINE, 0, 0, 0, 9, 1, 0, 9, 4\n";
            for (moved, face, axis, at) in [
                ("", "RIGHT", 0, 3.0),
                ("\nTRANSLATE, 1, 1, 0, 0", "LEFT", 0, 1.0),
                ("\nMIRROR, 1, X", "RIGHT", 0, -3.0),
                ("\nMIRROR, 1, Y", "BACK", 1, -2.0),
                ("\nMIRROR, 1, Z", "BACK", 1, 2.0),
                ("\nMIRROR, 1, Z", "RIGHT", 0, 3.0),
            ] {
                edge(&format!("{sheet}{moved}{triangles}"), face, [axis, 1], at);
                // Numbers of elements before and behind change with the others.
                let mesh = picked(&format!("{around}{sheet}{moved}{triangles}"), face, 1);
                let nodes = mesh.side_set_nodes(2);
                assert!(mesh.distinct_nodes(1) == nodes && nodes.len() > 2, "{moved}{triangles}");
                let apart = |&node: &u32| {
                    (mesh.coordinates[node as usize][axis] - at).abs() + mesh.coordinates[node as usize][2].abs()
                };
                assert!(nodes.iter().all(|node| apart(node) < 1e-12), "{moved}{triangles}");
            }
            side(&format!("{sheet}{triangles}"), "TOP", |_| [0.0, 0.0, 1.0]);
            side(&format!("{sheet}\nMIRROR, 1, Z{triangles}"), "TOP", |_| [0.0, 0.0, -1.0]);
            side(&format!("{sheet}\nMIRROR, 1, X{triangles}"), "BOTTOM", |_| [0.0, 0.0, -1.0]);
        }
    }
}
