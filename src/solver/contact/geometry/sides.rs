//! How a body goes on at the borders of its side sets.
//!
//! CONTACT SURFACE names the faces that touch. Where these end, as those of a bore do in a plane of symmetry, the other outer faces of their elements bound
//! the body, but touch nothing; some of their corners are no points of contact, and their motion is not known. So each is kept as it leans at the
//! start against the face at whose edge it is, and turns with that.

use super::projection::area_normal;
use super::strip;
use super::surface::face_nodes;
use crate::common::shared::Shared;
use crate::common::vector::{add, cross, dot, normalized, scaled, subtract};
use crate::mesh::Connectivity;
use crate::mesh::exterior::SIDES;

/// For each edge of a face the area normal of the side there: what it has in the direction across the edge, away from the face, and along the normal of the
/// face. Zeros where there is none.
type Leans = [[f64; 2]; 4];

/// A side of a body that is no face of contact, where it meets one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HiddenSide {
    /// Ends of the edge at which they meet.
    pub ends: [u32; 2],
    /// The position of the first of them.
    pub at: [f64; 3],
    /// Normal of the side with the length of its area, outwards.
    pub area_normal: [f64; 3],
}

/// The sides at the edges of faces; empty where no face has any.
#[derive(Debug, Clone, Default)]
pub struct HiddenSides {
    of_faces: Shared<Leans>,
}

impl HiddenSides {
    /// Those of some faces among the `exterior` faces of the body; both are numbers of faces, ascending.
    pub fn of(faces: &[u32], exterior: &[u32], (elements, positions): (&Connectivity, &[[f64; 3]])) -> HiddenSides {
        let element = |face: u32| face / SIDES as u32;
        let at = |nodes: [u32; 4]| nodes.map(|node| positions[node as usize]);
        let hidden = |face: u32| {
            let first = exterior.partition_point(|&other| element(other) < element(face));
            let beside = exterior[first..].iter().take_while(move |&&other| element(other) == element(face));
            beside.copied().filter(|other| faces.binary_search(other).is_err())
        };
        let leans = |&face: &u32| {
            let nodes = face_nodes(elements, face);
            let mut leans = Leans::default();
            for side in hidden(face).map(|side| face_nodes(elements, side)) {
                let normal = area_normal(&at(side));
                let edges = (0..4).filter(|&i| [nodes[i], nodes[(i + 1) % 4]].iter().all(|end| side.contains(end)));
                for edge in edges {
                    let frame = frame(&at(nodes), edge);
                    leans[edge] = frame.map_or([0.0; 2], |axes| axes.map(|axis| dot(normal, axis)));
                }
            }
            leans
        };
        let is_any = faces.iter().any(|&face| hidden(face).next().is_some());
        HiddenSides { of_faces: if is_any { faces.iter().map(leans).collect() } else { Shared::default() } }
    }

    /// The same of some of the faces, by their places.
    pub fn subset(&self, chosen: &[u32]) -> HiddenSides {
        if self.of_faces.is_empty() {
            return HiddenSides::default();
        }
        HiddenSides { of_faces: chosen.iter().map(|&face| self.of_faces[face as usize]).collect() }
    }

    /// The sides of a face, whose points and their positions are asked for only where it may have some.
    pub fn at(
        &self,
        face: u32,
        corners: impl FnOnce() -> ([u32; 4], [[f64; 3]; 4]),
    ) -> impl Iterator<Item = HiddenSide> + '_ {
        let known = self.of_faces.get(face as usize).map(|leans| (leans, corners()));
        known.into_iter().flat_map(|(leans, (points, corners))| {
            let leans = leans.iter().enumerate().filter(|(_, lean)| **lean != [0.0; 2]);
            leans.filter_map(move |(edge, [away, up])| {
                let [across, normal] = frame(&corners, edge)?;
                let area_normal = add(scaled(across, *away), scaled(normal, *up));
                Some(HiddenSide { ends: [edge, (edge + 1) % 4].map(|end| points[end]), at: corners[edge], area_normal })
            })
        })
    }
}

/// Unit vectors across an edge of a face, away from it, and along its normal. `None` for what is no edge: between a corner and itself in space, from end to
/// end of a strip.
pub fn frame(corners: &[[f64; 3]; 4], edge: usize) -> Option<[[f64; 3]; 2]> {
    let normal = normalized(area_normal(corners))?;
    let [from, to] = [corners[edge], corners[(edge + 1) % 4]];
    if let Some([a, b]) = strip::of(corners) {
        let across = if from == b { subtract(b, a) } else { subtract(a, b) };
        return if from == to { Some([normalized(across)?, normal]) } else { None };
    }
    let along = normalized(subtract(to, from))?;
    // Of a warped face neither is quite square to the other.
    let across = normalized(cross(along, normal))?;
    Some([across, cross(across, along)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Shape;

    fn sides(elements: &Connectivity, positions: &[[f64; 3]], faces: &[u32]) -> Vec<(u32, [u32; 2], [f64; 3])> {
        let exterior: Vec<u32> = crate::mesh::exterior::exterior(elements.shaped(), positions.len(), |_| true);
        let hidden = HiddenSides::of(faces, &exterior, (elements, positions));
        let corners = |face: u32| face_nodes(elements, face).map(|node| positions[node as usize]);
        let of = |place: u32| {
            let of_face = move || (face_nodes(elements, faces[place as usize]), corners(faces[place as usize]));
            hidden.at(place, of_face).map(move |side| (place, side.ends, side.area_normal))
        };
        (0..faces.len() as u32).flat_map(of).collect()
    }

    /// Two cubes side by side, of which the first leans by its end at x = 0. The tops are faces of contact, and so is the end of the second.
    #[test]
    fn sides_are_those_of_the_body_that_are_no_faces() {
        let at = |x: f64, y: f64, z: f64| [if x == 0.0 { -0.25 * z } else { x }, y, z];
        let positions: Vec<[f64; 3]> = [0.0, 1.0]
            .iter()
            .flat_map(|&z| [0.0, 1.0].map(|y| [0.0, 1.0, 2.0].map(|x| at(x, y, z))))
            .flatten()
            .collect();
        let elements = Connectivity::of(Shape::Hexahedron, vec![0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10]);
        let numbers: Vec<u32> = (0..12).collect();
        let normal = |face: &u32| area_normal(&face_nodes(&elements, *face).map(|node| positions[node as usize]));
        let is_top = |face: &&u32| normal(face)[2] > 0.9;
        let is_end = |face: &&u32| normal(face)[0] > 0.9 && **face >= 6;
        let faces: Vec<u32> = numbers.iter().filter(|face| is_top(face) || is_end(face)).copied().collect();
        let found = sides(&elements, &positions, &faces);
        // Three of the first top, two of the second, and of the end all but that at the top.
        let of = |place: u32| found.iter().filter(|side| side.0 == place).map(|side| side.2).collect::<Vec<_>>();
        let counts: Vec<usize> = (0..3).map(|place| of(place).len()).collect();
        assert_eq!(counts.iter().sum::<usize>(), 8, "{found:?}");
        assert_eq!(of(0).len(), 3, "{found:?}");
        // Area normals of unit squares; the end that leans has edges of length 1 and sqrt(1.0625), and the normal (-1, 0, -0.25).
        let is_there =
            |expected: [f64; 3]| of(0).iter().any(|normal| (0..3).all(|i| (normal[i] - expected[i]).abs() < 1e-14));
        assert!(is_there([-1.0, 0.0, -0.25]), "{found:?}");
    }

    #[test]
    fn sides_of_edges_in_the_plane_are_at_their_ends() {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let elements = Connectivity::of(Shape::Plane, vec![0, 1, 2, 3]);
        let top = (0..4).find(|&face| {
            let corners = face_nodes(&elements, face).map(|node| positions[node as usize]);
            area_normal(&corners)[1] > 0.9
        });
        let found = sides(&elements, &positions, &[top.expect("a face that looks upwards")]);
        let mut normals: Vec<[f64; 3]> = found.iter().map(|side| side.2).collect();
        normals.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert_eq!(normals, [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    }
}
