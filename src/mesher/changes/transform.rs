//! TRANSLATE, ROTATE and MIRROR: bodies put into place.

use crate::mesher::{body::Body, turn};

/// One change of place.
#[derive(Debug, Clone, PartialEq)]
pub enum Move {
    /// A displacement.
    Translate([f64; 3]),
    /// A right-handed rotation about a line parallel to an axis.
    Rotate {
        /// 0, 1 or 2 for x, y or z.
        axis: usize,
        /// Angle.
        degrees: f64,
        /// A point of the line.
        about: [f64; 3],
    },
    /// A reflection at a plane across an axis.
    Mirror {
        /// 0, 1 or 2 for x, y or z.
        axis: usize,
        /// Where the plane cuts the axis.
        at: f64,
    },
}

impl Move {
    /// Moves a body.
    pub fn apply(&self, body: &mut Body) {
        match *self {
            Move::Translate(by) => body.coordinates.iter_mut().for_each(|x| (0..3).for_each(|i| x[i] += by[i])),
            Move::Rotate { axis, degrees, about } => rotate(body, axis, degrees, about),
            Move::Mirror { axis, at } => mirror(body, axis, at),
        }
    }
}

fn rotate(body: &mut Body, axis: usize, degrees: f64, about: [f64; 3]) {
    let [c, s] = turn::direction(degrees / 90.0);
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    for x in &mut body.coordinates {
        let (a, b) = (x[u] - about[u], x[v] - about[v]);
        x[u] = about[u] + (c * a - s * b);
        x[v] = about[v] + (s * a + c * b);
    }
}

/// A mirror image turns elements inside out; numbering their corners the other way round turns them back.
fn mirror(body: &mut Body, axis: usize, at: f64) {
    body.coordinates.iter_mut().for_each(|x| x[axis] = at - (x[axis] - at));
    // The outer side of a shell stays the outer one, and its first edge the first, which its local axes follow.
    body.quads.iter_mut().for_each(|[a, b, c, d]| {
        std::mem::swap(a, b);
        std::mem::swap(c, d);
    });
    let renumbered: [u8; 6] = if body.hexes.is_empty() {
        [0, 1, 2, 5, 4, 3]
    } else if body.flat {
        // Of a plane only the lower sides of the hexahedra are elements: bottom and top may not change places.
        body.hexes.iter_mut().for_each(|nodes| {
            nodes.swap(1, 3);
            nodes.swap(5, 7);
        });
        [3, 2, 1, 0, 4, 5]
    } else {
        body.hexes.iter_mut().for_each(|nodes| nodes.rotate_left(4));
        [0, 1, 2, 3, 5, 4]
    };
    let sides = body.faces.iter_mut().flat_map(|(_, sides)| sides);
    sides.for_each(|(_, side)| *side = renumbered[usize::from(*side)]);
}

#[cfg(test)]
mod tests {
    use crate::common::vector::{cross, dot, subtract};
    use crate::mesh::{Mesh, check, plane};
    use crate::mesher::make;

    fn made(recipe: &str) -> Mesh {
        make(recipe, "t.mesh", 1).unwrap_or_else(|found| panic!("{}", found.render(false)))
    }

    /// Elements of the plane keep their positive area, and a named edge is the image of what it was.
    #[test]
    fn the_image_of_a_plane_is_not_inside_out() {
        for (axis, x) in [("X", -1.0), ("Y", 1.0)] {
            let mesh =
                made(&format!("RECTANGLE, 1, 0, 1, 1, 3, 2, 3\nMIRROR, 1, {axis}\nSIDE SET FACE, 9, 1, RIGHT\n"));
            let areas = mesh.elements().map(|(_, nodes)| {
                plane::area(&[0, 1, 2, 3].map(|corner: usize| mesh.coordinates[nodes[corner] as usize]))
            });
            assert!(areas.into_iter().all(|area| (area - 0.5).abs() < 1e-14), "{axis}");
            assert!(check::geometry(&mesh).is_empty());
            let nodes = mesh.side_set_nodes(9);
            assert!(nodes.len() == 4 && nodes.iter().all(|&n| mesh.coordinates[n as usize][0] == x), "{axis}");
        }
    }

    /// The top of a shell is where it was before: outside of a tube, whatever its image is divided into.
    #[test]
    fn the_outer_side_of_a_shell_stays_the_outer_one() {
        for triangles in ["", "TRIANGLES, 1\n", "TRIANGLES, 1, CROSS\n"] {
            for axis in ["X", "Y", "Z"] {
                let mesh = made(&format!("SHEET TUBE, 1, 1, 1, 16, 4, HALF\nMIRROR, 1, {axis}\n{triangles}"));
                for (_, nodes) in mesh.elements() {
                    let [a, b, c] = [0, 1, 2].map(|i: usize| mesh.coordinates[nodes[i] as usize]);
                    let outward = [a[0] + b[0] + c[0], a[1] + b[1] + c[1], 0.0];
                    assert!(dot(cross(subtract(b, a), subtract(c, a)), outward) > 0.0, "{axis} {triangles}");
                    // Around the tube, as it is without the image.
                    assert!(!triangles.is_empty() || (a[2] - b[2]).abs() < 1e-12, "{axis}");
                }
            }
        }
    }
}
