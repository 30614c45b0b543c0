//! Bodies cut open: what is in front of a plane is taken off, and the elements in the plane show their sections.

use std::collections::HashMap;

use super::subject::Face;
use crate::mesh::HEX_SIDES;

/// Distances below this share of the body's size are none.
const HAIR: f64 = 1e-9;

/// A plane across an axis and the side of it that is kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Axis that the plane is across.
    pub axis: usize,
    /// Where it crosses the axis, in the body as it is drawn.
    pub at: f64,
    /// Keeps what is below, else what is above.
    pub below: bool,
}

impl Plane {
    /// The plane's reflection in the plane across `axis` at `place`.
    pub fn reflected(&self, axis: usize, place: f64) -> Plane {
        match self.axis == axis {
            true => Plane { at: 2.0 * place - self.at, below: !self.below, ..*self },
            false => *self,
        }
    }
}

/// A point made between two others: the part of the way from the first to the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Between {
    /// The two points.
    pub ends: [u32; 2],
    /// 0 at the first, 1 at the second.
    pub part: f64,
}

/// A body's surface while it is cut.
pub struct Cutting {
    /// Positions of nodes, then of the points made.
    pub positions: Vec<[f64; 3]>,
    /// How the points made came about, in their order.
    pub made: Vec<Between>,
    /// Edges between faces that are parts of one polygon, lower point first.
    pub seams: Vec<[u32; 2]>,
    polygons: Vec<Polygon>,
}

/// A flat piece of surface of an element.
#[derive(Debug, Clone, PartialEq)]
struct Polygon {
    element: usize,
    corners: Vec<u32>,
}

impl Cutting {
    /// A whole body.
    pub fn new(positions: Vec<[f64; 3]>, skin: &[Face]) -> Cutting {
        let polygon = |face: &Face| {
            let mut corners = face.nodes.to_vec();
            corners.dedup();
            if corners.first() == corners.last() {
                corners.pop();
            }
            Polygon { element: face.element, corners }
        };
        Cutting { polygons: skin.iter().map(polygon).collect(), positions, made: Vec::new(), seams: Vec::new() }
    }

    /// Takes off what is in front of some planes. `elements` are those that the body is made of, by their position in the
    /// mesh, with their nodes.
    pub fn cut(&mut self, planes: &[Plane], elements: &[(usize, &[u32; 8])]) {
        for (place, plane) in planes.iter().enumerate() {
            let depths = self.depths(plane);
            let mut points = HashMap::new();
            let mut sections = Vec::new();
            for &(element, nodes) in elements {
                let [in_front, behind] =
                    [true, false].map(|front| nodes.iter().any(|&n| (depths[n as usize] <= 0.0) == front));
                if in_front && behind {
                    sections.extend(self.section(element, nodes, &depths, &mut points));
                }
            }
            let polygons = std::mem::take(&mut self.polygons);
            let mut kept = self.clip(polygons, &depths, &mut points);
            // A section is itself cut by the planes before.
            for earlier in &planes[..place] {
                let depths = self.depths(earlier);
                sections = self.clip(sections, &depths, &mut HashMap::new());
            }
            kept.append(&mut sections);
            self.polygons = kept;
        }
    }

    /// How far behind a plane each point is; in it and in front of it are zero and less.
    fn depths(&self, plane: &Plane) -> Vec<f64> {
        let size =
            self.positions.iter().map(|x| x[plane.axis].abs()).filter(|x| x.is_finite()).fold(plane.at.abs(), f64::max);
        let sign = if plane.below { 1.0 } else { -1.0 };
        let depth = |position: &[f64; 3]| {
            let depth = sign * (plane.at - position[plane.axis]);
            if depth.abs() <= HAIR * size { 0.0 } else { depth }
        };
        self.positions.iter().map(depth).collect()
    }

    /// The point where an edge meets the plane; the same for all who share the edge.
    fn crossing(&mut self, [a, b]: [u32; 2], depths: &[f64], points: &mut HashMap<[u32; 2], u32>) -> u32 {
        let ends = [a.min(b), a.max(b)];
        if let Some(&known) = points.get(&ends) {
            return known;
        }
        let [from, to] = ends.map(|end| depths[end as usize]);
        let part = from / (from - to);
        let [p, q] = ends.map(|end| self.positions[end as usize]);
        let new = self.positions.len() as u32;
        self.positions.push([0, 1, 2].map(|i| p[i] + part * (q[i] - p[i])));
        self.made.push(Between { ends, part });
        points.insert(ends, new);
        new
    }

    /// What is behind the plane of each polygon.
    fn clip(&mut self, polygons: Vec<Polygon>, depths: &[f64], points: &mut HashMap<[u32; 2], u32>) -> Vec<Polygon> {
        // Points that were made since the depths were found lie in a plane of their own and are asked for anew.
        let mut kept = Vec::with_capacity(polygons.len());
        for Polygon { element, corners } in polygons {
            let depth = |corner: u32| depths.get(corner as usize).copied().unwrap_or(0.0);
            if corners.iter().all(|&corner| depth(corner) > 0.0) {
                kept.push(Polygon { element, corners });
                continue;
            }
            let mut rest = Vec::with_capacity(corners.len() + 1);
            for (i, &a) in corners.iter().enumerate() {
                let b = corners[(i + 1) % corners.len()];
                if depth(a) > 0.0 {
                    rest.push(a);
                }
                if (depth(a) > 0.0) != (depth(b) > 0.0) {
                    rest.push(self.crossing([a, b], depths, points));
                }
            }
            if rest.len() > 2 {
                kept.push(Polygon { element, corners: rest });
            }
        }
        kept
    }

    /// The section of an element: where its sides meet the plane, strung together.
    fn section(
        &mut self,
        element: usize,
        nodes: &[u32; 8],
        depths: &[f64],
        points: &mut HashMap<[u32; 2], u32>,
    ) -> Vec<Polygon> {
        // Going round a side, the plane is left at one edge and entered at the next: a piece of the section from the one to
        // the other, turned so that the section faces the part taken off.
        let mut next: Vec<(u32, u32)> = Vec::new();
        for side in HEX_SIDES {
            let corners = side.map(|corner| nodes[corner]);
            let behind = corners.map(|node| depths[node as usize] > 0.0);
            let crossed = |from: bool| (0..4).filter(move |&i| behind[i] == from && behind[(i + 1) % 4] != from);
            for leaves in crossed(true) {
                let Some(enters) = (1..4).map(|k| (leaves + k) % 4).find(|&i| crossed(false).any(|e| e == i)) else {
                    continue;
                };
                let edge = |i: usize| [corners[i], corners[(i + 1) % 4]];
                let (from, to) =
                    (self.crossing(edge(leaves), depths, points), self.crossing(edge(enters), depths, points));
                if from != to {
                    next.push((to, from));
                }
            }
        }
        let mut sections = Vec::new();
        while let Some((start, mut end)) = next.pop() {
            let mut corners = vec![start];
            while end != start {
                corners.push(end);
                let Some(place) = next.iter().position(|(from, _)| *from == end) else { break };
                end = next.swap_remove(place).1;
            }
            if corners.len() > 2 {
                sections.push(Polygon { element, corners });
            }
        }
        sections
    }

    /// The surface as faces of four corners, of which two may be one; larger polygons are several with seams between.
    pub fn faces(&mut self) -> Vec<Face> {
        let mut faces = Vec::with_capacity(self.polygons.len());
        for Polygon { element, corners } in &self.polygons {
            let first = corners[0];
            for i in (1..corners.len() - 1).step_by(2) {
                let last = corners[(i + 2).min(corners.len() - 1)];
                faces.push(Face { element: *element, nodes: [first, corners[i], corners[i + 1], last] });
                if i > 1 {
                    self.seams.push([first.min(corners[i]), first.max(corners[i])]);
                }
            }
        }
        self.seams.sort_unstable();
        faces
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Shape;
    use crate::mesh::exterior::{SIDES, exterior};

    /// `n` cubes along x, cut: area of the surface that is left, and its faces.
    fn cut(n: u32, planes: &[Plane]) -> (f64, Vec<Face>) {
        let corner = |i: u32, j: u32, k: u32| 4 * i + 2 * k + j;
        let cube = |i: u32| {
            [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
                .map(|(a, b, c)| corner(i + a, b, c))
        };
        let elements: Vec<[u32; 8]> = (0..n).map(cube).collect();
        let positions = (0..=n).flat_map(|i| (0..4).map(move |c| [i, c % 2, c / 2].map(f64::from))).collect();
        let shaped = elements.iter().map(|nodes| (Shape::Hexahedron, &nodes[..]));
        let numbers = exterior(shaped, 4 * (n as usize + 1), |_| true);
        let face = |number: u32| {
            let element = number as usize / SIDES;
            let nodes = Shape::Hexahedron.face(&elements[element], (number as usize % SIDES) as u8)?;
            Some(Face { element, nodes })
        };
        let skin: Vec<Face> = numbers.into_iter().filter_map(face).collect();
        let mut cutting = Cutting::new(positions, &skin);
        cutting.cut(planes, &elements.iter().enumerate().collect::<Vec<_>>());
        let faces = cutting.faces();
        let area = |face: &Face| {
            let [a, b, c, d] = face.nodes.map(|node| cutting.positions[node as usize]);
            let side = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|i| q[i] - p[i]);
            let (u, v) = (side(a, c), side(b, d));
            let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            0.5 * n.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        (faces.iter().map(area).sum(), faces)
    }

    #[test]
    fn what_is_left_is_closed_by_its_section() {
        let across = |axis: usize, at: f64, below: bool| Plane { axis, at, below };
        // A bar of 3 x 1 x 1 cut to 1.25 x 1 x 1, 3 x 0.5 x 1, 3 x 1 x 1 whole and nothing.
        for (plane, expected) in [
            (across(0, 1.25, true), 2.0 + 4.0 * 1.25),
            (across(0, 1.25, false), 2.0 + 4.0 * 1.75),
            (across(1, 0.5, true), 2.0 * 1.5 + 2.0 * 0.5 + 2.0 * 3.0),
            (across(0, 1.0, true), 6.0),
            (across(0, 2.0, false), 6.0),
            (across(0, 9.0, true), 14.0),
            (across(0, -1.0, true), 0.0),
        ] {
            let (area, _) = cut(3, &[plane]);
            assert!((area - expected).abs() < 1e-12, "{plane:?}: {area} where {expected} belong");
        }
        // Two planes leave 1.25 x 0.5 x 1.
        let (area, _) = cut(3, &[across(0, 1.25, true), across(1, 0.5, false)]);
        assert!((area - 2.0 * (1.25 * 0.5 + 0.5 + 1.25)).abs() < 1e-12, "{area}");
    }

    #[test]
    fn a_plane_between_elements_shows_those_that_are_kept() {
        let (_, faces) = cut(3, &[Plane { axis: 0, at: 1.0, below: true }]);
        assert!(faces.iter().all(|face| face.element == 0) && faces.len() == 6);
        let (_, faces) = cut(3, &[Plane { axis: 0, at: 1.0, below: false }]);
        assert!(faces.iter().all(|face| face.element > 0));
    }
}
