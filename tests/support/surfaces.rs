//! Whether surfaces go through each other: a measure of its own, which knows nothing of the solver's contact.
//!
//! Where surfaces have gone through anything in part, an edge pierces a face. Faces are cut into four triangles at their
//! middle. A warped face has a bulge, into which an edge may dip that has passed nothing: one of its two divisions into two
//! triangles stands out on each side. Whether an edge is through both is told apart.

use urto::mesh::exterior::exterior;
use urto::mesh::{Mesh, Shape};

type Point = [f64; 3];

/// Outer faces of solids and surfaces of a mesh, and their edges.
pub struct Surfaces {
    faces: Vec<[u32; 4]>,
    /// Whether a face is one of shells.
    of_shells: Vec<bool>,
    edges: Vec<[u32; 2]>,
    /// Faces around each node.
    around: Vec<Vec<u32>>,
}

impl Surfaces {
    /// Finds them.
    pub fn new(mesh: &Mesh) -> Surfaces {
        let elements: Vec<(Shape, &[u32])> = mesh.shaped().collect();
        let (mut faces, mut of_shells) = (Vec::new(), Vec::new());
        for face in exterior(mesh.shaped(), mesh.coordinates.len(), |_| true) {
            let (shape, nodes) = elements[face as usize / 6];
            // Of both sides of a shell one is enough.
            if shape == Shape::Hexahedron || face % 6 == 0 {
                faces.extend(shape.face(nodes, (face % 6) as u8));
                of_shells.push(shape != Shape::Hexahedron);
            }
        }
        let sides = |face: &[u32; 4]| [0, 1, 2, 3].map(|i| [face[i], face[(i + 1) % 4]]);
        let mut edges: Vec<[u32; 2]> = faces.iter().flat_map(sides).map(|[a, b]| [a.min(b), a.max(b)]).collect();
        let bars = elements.iter().filter(|(shape, _)| *shape == Shape::Bar);
        edges.extend(bars.map(|(_, nodes)| [nodes[0].min(nodes[1]), nodes[0].max(nodes[1])]));
        edges.sort_unstable();
        edges.dedup();
        let mut around = vec![Vec::new(); mesh.coordinates.len()];
        for (face, nodes) in (0..).zip(&faces) {
            nodes.iter().for_each(|&node| around[node as usize].push(face));
        }
        Surfaces { faces, of_shells, edges, around }
    }

    /// Pairs of an edge and a face that it goes through, of shells on one side at least, which have no node in common and no
    /// face between them.
    pub fn pierced(&self, at: &[Point]) -> Vec<([u32; 2], [u32; 4])> {
        let (order, widest) = self.by_x(at);
        let mut found = Vec::new();
        for edge in &self.edges {
            let [a, b] = edge.map(|n| at[n as usize]);
            let begin = order.partition_point(|&f| self.low(f, at) < a[0].min(b[0]) - widest);
            for &f in order[begin..].iter().take_while(|&&f| self.low(f, at) <= a[0].max(b[0])) {
                let face = self.faces[f as usize];
                let near = |n: &u32| self.around[*n as usize].iter().any(|&g| self.meet(g, f));
                let solids = !self.of_shells[f as usize]
                    && edge.iter().any(|&n| self.around[n as usize].iter().any(|&g| !self.of_shells[g as usize]));
                if !solids && through(a, b, &face.map(|n| at[n as usize])) && !edge.iter().any(near) {
                    found.push((*edge, face));
                }
            }
        }
        found
    }

    /// Whether a pair that is pierced is so however the face is divided into two triangles: the edge does not merely dip into the
    /// bulge of a warped face.
    pub fn is_through(&self, at: &[Point], (edge, face): &([u32; 2], [u32; 4])) -> bool {
        let [a, b] = edge.map(|n| at[n as usize]);
        through_all(a, b, &face.map(|n| at[n as usize]))
    }

    /// The least distance between a node of shells and a face of shells that has no node in common with the faces around it,
    /// with the node and the corners of the face.
    pub fn nearest(&self, at: &[Point]) -> (f64, u32, [u32; 4]) {
        let (order, widest) = self.by_x(at);
        let (mut least, mut pair) = (f64::INFINITY, (0, [0; 4]));
        for (node, own) in (0u32..).zip(&self.around).filter(|(_, own)| own.iter().any(|&f| self.of_shells[f as usize]))
        {
            let x = at[node as usize];
            let begin = order.partition_point(|&f| self.low(f, at) < x[0] - widest - least.min(widest));
            for &f in &order[begin..] {
                if self.low(f, at) > x[0] + least {
                    break;
                }
                if self.of_shells[f as usize] && !own.iter().any(|&g| self.meet(g, f)) {
                    let corners = self.faces[f as usize].map(|n| at[n as usize]);
                    let distance = triangles(&corners).map(|t| to_triangle(x, t)).fold(f64::INFINITY, f64::min);
                    if distance < least {
                        (least, pair) = (distance, (node, self.faces[f as usize]));
                    }
                }
            }
        }
        (least, pair.0, pair.1)
    }

    fn meet(&self, a: u32, b: u32) -> bool {
        self.faces[a as usize].iter().any(|n| self.faces[b as usize].contains(n))
    }

    fn low(&self, face: u32, at: &[Point]) -> f64 {
        self.faces[face as usize].iter().map(|&n| at[n as usize][0]).fold(f64::INFINITY, f64::min)
    }

    /// Faces by their least x, and the widest of them.
    fn by_x(&self, at: &[Point]) -> (Vec<u32>, f64) {
        let mut order: Vec<u32> = (0..self.faces.len() as u32).collect();
        order.sort_by(|&a, &b| self.low(a, at).total_cmp(&self.low(b, at)));
        let high = |f: u32| self.faces[f as usize].iter().map(|&n| at[n as usize][0]).fold(f64::NEG_INFINITY, f64::max);
        let widest = order.iter().map(|&f| high(f) - self.low(f, at)).fold(0.0, f64::max);
        (order, widest)
    }
}

fn triangles(x: &[Point; 4]) -> impl Iterator<Item = [Point; 3]> + '_ {
    let middle = [0, 1, 2].map(|i| 0.25 * (x[0][i] + x[1][i] + x[2][i] + x[3][i]));
    (0..4).map(move |k| [middle, x[k], x[(k + 1) % 4]])
}

fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Whether a segment goes through a face.
fn through(a: Point, b: Point, face: &[Point; 4]) -> bool {
    triangles(face).any(|triangle| pierces(a, b, triangle))
}

/// The same of both divisions of the face into two triangles. Through both triangles of one it has gone in and out again.
fn through_all(a: Point, b: Point, &[p, q, r, s]: &[Point; 4]) -> bool {
    let divisions = [[[p, q, r], [p, r, s]], [[p, q, s], [q, r, s]]];
    divisions.iter().all(|[one, other]| pierces(a, b, *one) != pierces(a, b, *other))
}

/// Whether a segment goes through a triangle.
fn pierces(a: Point, b: Point, [p, q, r]: [Point; 3]) -> bool {
    let volume = |p: Point, q: Point, r: Point, s: Point| dot(minus(p, s), cross(minus(q, s), minus(r, s)));
    let sides = volume(a, p, q, r) * volume(b, p, q, r);
    let turns = [volume(a, b, p, q), volume(a, b, q, r), volume(a, b, r, p)];
    sides < 0.0 && (turns.iter().all(|t| *t > 0.0) || turns.iter().all(|t| *t < 0.0))
}

/// Distance of a point from a triangle (Ericson 2005).
fn to_triangle(p: Point, [a, b, c]: [Point; 3]) -> f64 {
    let (ab, ac, ap) = (minus(b, a), minus(c, a), minus(p, a));
    let normal = cross(ab, ac);
    let square = dot(normal, normal);
    let (v, w) = (dot(cross(ap, ac), normal) / square, dot(cross(ab, ap), normal) / square);
    if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
        return dot(ap, normal).abs() / square.sqrt();
    }
    let to_edge = |a: Point, b: Point| {
        let (ab, ap) = (minus(b, a), minus(p, a));
        let t = (dot(ap, ab) / dot(ab, ab)).clamp(0.0, 1.0);
        let r = [0, 1, 2].map(|i| ap[i] - t * ab[i]);
        dot(r, r).sqrt()
    };
    to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
}

#[test]
fn an_edge_in_the_bulge_of_a_warped_face_is_not_through_all_of_it() {
    // Two opposite corners stand up: the divisions lie at 0.1 and 0 in the middle.
    let face = [[0.0, 0.0, 0.1], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]];
    let edge = |low: f64, high: f64| [through, through_all].map(|f| f([0.4, 0.45, low], [0.7, 0.45, high], &face));
    assert_eq!([edge(-0.1, 0.2), edge(0.2, -0.1)], [[true, true]; 2]);
    // It ends between both divisions, beyond the middle surface or not.
    assert_eq!([edge(0.02, 0.2), edge(-0.1, 0.02)], [[true, false], [false, false]]);
    let triangle = [face[0], face[1], face[2], face[2]];
    assert!(through_all([0.6, 0.3, -0.1], [0.6, 0.3, 0.2], &triangle));
    assert!(!through_all([0.3, 0.6, -0.1], [0.3, 0.6, 0.2], &triangle));
}
