//! What a picture shows, free of files and mechanics: faces in space and what colours them.

use crate::common::vector::{cross, dot, subtract};

/// Coordinates beyond this are the wreck of a calculation; faces that reach there are not drawn.
const FARTHEST: f64 = 1e100;
/// Nodes this near a mirror plane, relative to the size of the body, lie in it.
const IN_PLANE: f64 = 1e-6;
/// Cosine of the angle between the normals of two faces above which their edge is a crease of the body (35 degrees).
const CREASE: f64 = 0.82;

/// Faces in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Node positions.
    pub positions: Vec<[f64; 3]>,
    /// Four nodes per face, counter-clockwise seen from outside; a triangle has a node twice.
    pub quads: Vec<[u32; 4]>,
    /// What colours the faces.
    pub values: Values,
    /// Edges between faces that are parts of one polygon, lower node first, ascending: they are not drawn.
    pub seams: Vec<[u32; 2]>,
    /// A vector per node, if any are drawn.
    pub vectors: Vec<[f64; 3]>,
}

/// What colours the faces of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// A value per node.
    Nodes(Vec<f64>),
    /// A value per face.
    Faces(Vec<f64>),
    /// A block per face: no value, but a colour of its own.
    Blocks(Vec<usize>),
}

/// How an edge of a face is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Edge {
    /// Between elements that continue each other.
    Mesh,
    /// Where the surface turns away from the eye.
    Silhouette,
    /// Where the surface ends or bends.
    Outline,
    /// The two corners are one.
    None,
}

impl Scene {
    /// Takes out the faces that have no place in space and says how many they were.
    pub fn drop_unusable_faces(&mut self) -> usize {
        let usable = |node: &u32| self.positions[*node as usize].iter().all(|x| x.abs() < FARTHEST);
        let keep: Vec<bool> = self.quads.iter().map(|quad| quad.iter().all(usable)).collect();
        self.retain(&keep)
    }

    /// Keeps the faces marked and says how many the others were.
    fn retain(&mut self, keep: &[bool]) -> usize {
        fn pick<T: Copy>(list: &mut Vec<T>, keep: &[bool]) {
            *list = list.iter().zip(keep).filter(|(_, keep)| **keep).map(|(item, _)| *item).collect();
        }
        pick(&mut self.quads, keep);
        match &mut self.values {
            Values::Faces(values) => pick(values, keep),
            Values::Blocks(blocks) => pick(blocks, keep),
            Values::Nodes(_) => {}
        }
        keep.iter().filter(|keep| !**keep).count()
    }

    /// Adds the scene's reflection in the plane across `axis` at `place`.
    ///
    /// Nodes in the plane are shared, so that no seam is seen, and faces in it vanish: they are inside now. The
    /// reflected values are negated if a reflection changes their sign (`odd`).
    pub fn mirror(&mut self, axis: usize, place: f64, odd: bool) {
        let size = self.drawn_nodes().map(|node| (self.positions[node][axis] - place).abs()).fold(0.0, f64::max);
        let in_plane = |position: &[f64; 3]| (position[axis] - place).abs() <= IN_PLANE * size;
        let inside = |quad: &[u32; 4]| quad.iter().all(|&node| in_plane(&self.positions[node as usize]));
        let keep: Vec<bool> = self.quads.iter().map(|quad| !inside(quad)).collect();
        let mut twin = Vec::with_capacity(self.positions.len());
        let mut reflected = self.positions.clone();
        let mut sources = Vec::new();
        for (node, position) in self.positions.iter().enumerate() {
            twin.push(if in_plane(position) { node } else { reflected.len() } as u32);
            if !in_plane(position) {
                let mut image = *position;
                image[axis] = 2.0 * place - image[axis];
                reflected.push(image);
                sources.push(node);
            }
        }
        self.retain(&keep);
        self.positions = reflected;
        self.append_images(&twin, &sources, if odd { -1.0 } else { 1.0 });
        let twins = |ends: &[u32; 2]| ends.map(|node| twin[node as usize]);
        let seams: Vec<[u32; 2]> = self.seams.iter().map(twins).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        self.seams.extend(seams);
        self.seams.sort_unstable();
        if !self.vectors.is_empty() {
            let images = sources.iter().map(|&node| self.vectors[node]);
            let turned = images
                .map(|mut v: [f64; 3]| {
                    v[axis] = -v[axis];
                    v
                })
                .collect::<Vec<_>>();
            self.vectors.extend(turned);
        }
    }

    /// Turns the scene into its reflection.
    pub fn reflect(&mut self, axis: usize, place: f64, odd: bool) {
        self.positions.iter_mut().for_each(|x| x[axis] = 2.0 * place - x[axis]);
        self.vectors.iter_mut().for_each(|v| v[axis] = -v[axis]);
        self.quads.iter_mut().for_each(|quad| quad.reverse());
        let sign = if odd { -1.0 } else { 1.0 };
        match &mut self.values {
            Values::Nodes(values) | Values::Faces(values) => values.iter_mut().for_each(|value| *value *= sign),
            Values::Blocks(_) => {}
        }
    }

    /// Takes in another scene that meets this one in the plane across `axis` at `place`. Where both have nodes there, they
    /// become one, and faces of either in the plane vanish, unless one of the scenes is empty.
    pub fn join(&mut self, mut other: Scene, axis: usize, place: f64) {
        if self.quads.is_empty() {
            *self = other;
            return;
        }
        if other.quads.is_empty() {
            return;
        }
        let size = self.drawn_nodes().map(|node| (self.positions[node][axis] - place).abs()).fold(0.0, f64::max);
        for scene in [&mut *self, &mut other] {
            let in_plane = |node: u32| (scene.positions[node as usize][axis] - place).abs() <= IN_PLANE * size;
            let keep: Vec<bool> = scene.quads.iter().map(|quad| !quad.iter().all(|&node| in_plane(node))).collect();
            scene.retain(&keep);
        }
        let near = |position: &[f64; 3]| (position[axis] - place).abs() <= IN_PLANE * size;
        // Both come from the same body, so that what meets has the same bits across the other axes.
        let key = |position: &[f64; 3]| [(axis + 1) % 3, (axis + 2) % 3].map(|other| position[other].to_bits());
        let drawn: std::collections::BTreeSet<usize> = self.drawn_nodes().collect();
        let known: std::collections::HashMap<[u64; 2], u32> = drawn
            .into_iter()
            .filter(|&node| near(&self.positions[node]))
            .map(|node| (key(&self.positions[node]), node as u32))
            .collect();
        let first = self.positions.len() as u32;
        let place_of: Vec<u32> = other
            .positions
            .iter()
            .zip(first..)
            .map(|(position, new)| known.get(&key(position)).copied().filter(|_| near(position)).unwrap_or(new))
            .collect();
        let moved = |node: u32| place_of[node as usize];
        self.positions.append(&mut other.positions);
        self.vectors.append(&mut other.vectors);
        self.quads.extend(other.quads.into_iter().map(|quad| quad.map(moved)));
        let seams = other.seams.into_iter().map(|ends| ends.map(moved)).map(|[a, b]| [a.min(b), a.max(b)]);
        self.seams.extend(seams);
        self.seams.sort_unstable();
        match (&mut self.values, other.values) {
            (Values::Nodes(own), Values::Nodes(values)) | (Values::Faces(own), Values::Faces(values)) => {
                own.extend(values)
            }
            (Values::Blocks(own), Values::Blocks(blocks)) => own.extend(blocks),
            _ => {}
        }
    }

    /// Appends every face's image: nodes replaced by their twins, turned round so that outside stays outside.
    fn append_images(&mut self, twin: &[u32], sources: &[usize], sign: f64) {
        let images: Vec<[u32; 4]> =
            self.quads.iter().map(|&[a, b, c, d]| [d, c, b, a].map(|n| twin[n as usize])).collect();
        self.quads.extend(images);
        match &mut self.values {
            Values::Nodes(values) => {
                let images: Vec<f64> = sources.iter().map(|&node| sign * values[node]).collect();
                values.extend(images);
            }
            Values::Faces(values) => {
                let images: Vec<f64> = values.iter().map(|value| sign * value).collect();
                values.extend(images);
            }
            Values::Blocks(blocks) => blocks.extend_from_within(..),
        }
    }

    /// Every corner of every face; nodes come as often as faces meet there.
    pub fn drawn_nodes(&self) -> impl Iterator<Item = usize> {
        self.quads.iter().flatten().map(|&node| node as usize)
    }

    /// The smallest and the largest finite value on the surface; `None` if there is none, or blocks are shown.
    pub fn extremes(&self) -> Option<(f64, f64)> {
        let spread = |values: &mut dyn Iterator<Item = f64>| {
            let finite = values.filter(|value| value.is_finite());
            finite.fold(None, |range: Option<(f64, f64)>, v| {
                range.map_or(Some((v, v)), |(a, b)| Some((a.min(v), b.max(v))))
            })
        };
        match &self.values {
            Values::Nodes(values) => spread(&mut self.drawn_nodes().map(|node| values[node])),
            Values::Faces(values) => spread(&mut values.iter().copied()),
            Values::Blocks(_) => None,
        }
    }

    /// The unit normal of a face, from its diagonals; zero if it has no area.
    pub fn normal(&self, quad: &[u32; 4]) -> [f64; 3] {
        let [a, b, c, d] = quad.map(|node| self.positions[node as usize]);
        let n = cross(subtract(c, a), subtract(d, b));
        let length = dot(n, n).sqrt();
        if length > 0.0 { n.map(|x| x / length) } else { n }
    }

    /// How the four edges of each face are drawn; edge `i` goes from corner `i` to the next.
    pub fn edges(&self, toward_eye: [f64; 3]) -> Vec<[Edge; 4]> {
        let normals: Vec<[f64; 3]> = self.quads.iter().map(|quad| self.normal(quad)).collect();
        let mut edges = vec![[Edge::None; 4]; self.quads.len()];
        let mut places: Vec<(u32, u32, usize, usize)> = Vec::with_capacity(4 * self.quads.len());
        for (face, quad) in self.quads.iter().enumerate() {
            let sides = (0..4).map(|side| (side, quad[side], quad[(side + 1) % 4])).filter(|(_, a, b)| a != b);
            places.extend(sides.map(|(side, a, b)| (a.min(b), a.max(b), face, side)));
        }
        places.sort_unstable();
        let mut sheets = Vec::new();
        for shared in places.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            self.sheets(shared, &normals, &mut sheets);
            let seam = self.seams.binary_search(&[shared[0].0, shared[0].1]).is_ok();
            let kind = match sheets.as_slice() {
                // Only where a round body turns away from the eye.
                [one, other] if seam => match joint(*one, *other, toward_eye) {
                    Edge::Silhouette => Edge::Silhouette,
                    _ => Edge::None,
                },
                _ if seam => Edge::None,
                [one, other] => joint(*one, *other, toward_eye),
                _ => Edge::Outline,
            };
            for &(_, _, face, side) in shared {
                edges[face][side] = kind;
            }
        }
        edges
    }
}

impl Scene {
    /// Normals of the faces at an edge. The two sides of a sheet are one: where a sheet goes on, the sides that go on count.
    fn sheets(&self, shared: &[(u32, u32, usize, usize)], normals: &[[f64; 3]], found: &mut Vec<[f64; 3]>) {
        found.clear();
        found.extend(shared.iter().map(|place| normals[place.2]));
        let corners = |place: usize| {
            let mut corners = self.quads[shared[place].2];
            corners.sort_unstable();
            corners
        };
        match shared.len() {
            2 if corners(0) == corners(1) => found.truncate(1),
            4 => {
                let Some(twin) = (1..4).find(|&place| corners(place) == corners(0)) else { return };
                let others: Vec<usize> = (1..4).filter(|&place| place != twin).collect();
                if corners(others[0]) != corners(others[1]) {
                    return;
                }
                let first = found[0];
                let best = others.into_iter().map(|place| found[place]);
                let best = best.max_by(|a, b| dot(*a, first).total_cmp(&dot(*b, first)));
                found.truncate(1);
                found.extend(best);
            }
            _ => (),
        }
    }
}

/// What the edge is between two faces with these normals.
fn joint(one: [f64; 3], other: [f64; 3], toward_eye: [f64; 3]) -> Edge {
    if dot(one, other) <= CREASE {
        Edge::Outline
    } else if dot(one, toward_eye) * dot(other, toward_eye) <= 0.0 {
        Edge::Silhouette
    } else {
        Edge::Mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The three faces of a unit cube that lie in x = 0 (node values 0, 1, 2, 3), y = 0 and z = 0.
    fn corner() -> Scene {
        let positions = (0..8).map(|i| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)]).collect();
        let quads = vec![[0, 4, 6, 2], [0, 1, 5, 4], [0, 2, 3, 1]];
        let values = Values::Nodes((0..8).map(f64::from).collect());
        Scene { positions, quads, values, seams: Vec::new(), vectors: Vec::new() }
    }

    #[test]
    fn a_reflection_shares_the_nodes_of_its_plane_and_drops_the_faces_there() {
        let mut scene = corner();
        scene.mirror(0, 0.0, true);
        assert_eq!(scene.quads.len(), 4);
        assert_eq!(scene.positions.len(), 8 + 4);
        // Face y = 0 turned round: nodes 4, 5', 1', 0, of which 1 and 5 are the first and third of the new ones.
        assert_eq!(scene.quads[2], [4, 10, 8, 0]);
        assert_eq!(scene.positions[8], [-1.0, 0.0, 0.0]);
        assert_eq!(scene.extremes(), Some((-5.0, 5.0)));
        let normal = scene.normal(&scene.quads[2]);
        assert_eq!(normal, scene.normal(&scene.quads[0]));
    }

    #[test]
    fn faces_at_right_angles_meet_in_an_outline_and_flat_ones_do_not() {
        let mut scene = corner();
        assert!(scene.edges([-0.6, -0.6, -0.5]).iter().flatten().all(|&edge| edge == Edge::Outline));
        scene.mirror(0, 0.0, false);
        let edges = scene.edges([-0.1, -0.9, -0.5]);
        assert_eq!(edges[0], [Edge::Outline, Edge::Outline, Edge::Outline, Edge::Mesh]);
    }

    /// Two squares of a sheet, each with both of its sides.
    #[test]
    fn sheets_have_lines_between_elements_and_outlines_at_their_ends() {
        let positions = (0..6).map(|i| [f64::from(i % 3), f64::from(i / 3), 0.0]).collect();
        let quads = vec![[0, 1, 4, 3], [3, 4, 1, 0], [1, 2, 5, 4], [4, 5, 2, 1]];
        let values = Values::Blocks(vec![0; 4]);
        let scene = Scene { positions, quads, values, seams: Vec::new(), vectors: Vec::new() };
        let edges = scene.edges([0.0, 0.0, 1.0]);
        assert_eq!(edges[0], [Edge::Outline, Edge::Mesh, Edge::Outline, Edge::Outline]);
        assert_eq!(edges[3], [Edge::Outline, Edge::Outline, Edge::Outline, Edge::Mesh]);
    }

    #[test]
    fn faces_that_are_not_in_space_are_dropped() {
        let mut scene = corner();
        scene.positions[5][1] = f64::NAN;
        assert_eq!(scene.drop_unusable_faces(), 1);
        assert_eq!(scene.quads, [[0, 4, 6, 2], [0, 2, 3, 1]]);
    }
}
