//! How deep nodes lie inside elements that are not theirs: a measure of its own, which knows nothing of the solver's
//! contact, neither its search nor its history.
//!
//! A node is inside an element when it is inside one of the 24 tetrahedra that join the element's centre with the
//! triangles of its faces, each face cut into four at its centre. Its depth is the distance to the nearest outer face
//! of the body it is in, its own faces left out, and is given as a part of that face's size, the root of its area
//! in the mesh.

use super::run::Run;
use urto::mesh::corners::all_corners_are_sound;
use urto::mesh::{HEX_SIDES, Mesh};

type Point = [f64; 3];

/// What rounding makes of volumes that are zero, as a part of the whole.
const ROUNDING: f64 = 1e-9;

/// The outside of a mesh.
pub struct Skin {
    /// Nodes of each element.
    elements: Vec<[u32; 8]>,
    /// Body of each element: elements that share nodes are one body.
    body: Vec<u32>,
    faces: Vec<Face>,
    /// Nodes of outer faces, ascending.
    nodes: Vec<u32>,
    /// Edges of outer faces, ascending.
    edges: Vec<[u32; 2]>,
}

/// A point of the outside: a node, or a point of the edge between two.
struct Sample {
    x: Point,
    own: [u32; 2],
}

struct Face {
    nodes: [u32; 4],
    body: u32,
    size: f64,
}

/// A point of the outside inside an element that is not its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inside {
    /// The node, from 0, twice; or those of the edge.
    pub own: [u32; 2],
    /// The element, from 0.
    pub element: u32,
    /// Distance to the outside of the element's body.
    pub depth: f64,
    /// The same as a part of the size of the nearest face.
    pub part: f64,
}

impl Skin {
    /// Finds bodies and outer faces.
    pub fn new(mesh: &Mesh) -> Skin {
        let elements: Vec<[u32; 8]> = mesh.hexahedra().copied().collect();
        let body = bodies(&elements, mesh.coordinates.len());
        let mut sides: Vec<([u32; 4], u32, [u32; 4])> = Vec::new();
        for (element, corners) in elements.iter().enumerate() {
            for side in HEX_SIDES {
                let face = side.map(|c| corners[c]);
                let mut key = face;
                key.sort_unstable();
                sides.push((key, element as u32, face));
            }
        }
        sides.sort_unstable();
        let alone = sides.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1).map(|same| same[0]);
        let faces: Vec<Face> = alone
            .map(|(_, element, nodes)| {
                let x = nodes.map(|n| mesh.coordinates[n as usize]);
                let area = cross(minus(x[2], x[0]), minus(x[3], x[1]));
                Face { nodes, body: body[element as usize], size: (0.5 * dot(area, area).sqrt()).sqrt() }
            })
            .collect();
        let mut nodes: Vec<u32> = faces.iter().flat_map(|face| face.nodes).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let around = |face: &Face| [0, 1, 2, 3].map(|i| (face.nodes[i], face.nodes[(i + 1) % 4]));
        let mut edges: Vec<[u32; 2]> = faces.iter().flat_map(around).map(|(a, b)| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        edges.dedup();
        Skin { elements, body, faces, nodes, edges }
    }

    /// The same where a node set lies in a plane of symmetry: what lies there is no outside.
    pub fn with_symmetry(mesh: &Mesh, node_set: i64) -> Skin {
        let mut skin = Skin::new(mesh);
        let in_plane = &mesh.node_set(node_set).expect("a node set").nodes;
        skin.faces.retain(|face| !face.nodes.iter().all(|node| in_plane.contains(node)));
        skin
    }

    /// Number of bodies.
    pub fn bodies(&self) -> usize {
        self.body.iter().max().map_or(0, |last| *last as usize + 1)
    }

    /// Mean of the corners of every body's elements.
    pub fn centres(&self, positions: &[Point]) -> Vec<Point> {
        let of_body = |body: u32| -> Vec<Point> {
            let own = self.elements.iter().zip(&self.body).filter(|(_, b)| **b == body);
            own.flat_map(|(nodes, _)| nodes.map(|n| positions[n as usize])).collect()
        };
        (0..self.bodies() as u32).map(|body| mean(&of_body(body))).collect()
    }

    /// Every node of the outside that lies inside an element of which it is no corner; the deepest for each node.
    pub fn inside(&self, positions: &[Point]) -> Vec<Inside> {
        self.find(self.nodes.iter().map(|&n| Sample { x: positions[n as usize], own: [n, n] }), positions)
    }

    /// Depth, as a part of a face, of the deepest node and of the deepest point of an edge that have come to be inside an element since
    /// the start: of elements that are no neighbours of its own, where no corner of any of them has turned inside out.
    pub fn sunk(&self, start: &[Point], now: &[Point]) -> [f64; 2] {
        let of = |inside: fn(&Skin, &[Point]) -> Vec<Inside>| {
            let before: Vec<[u32; 2]> = inside(self, start).iter().map(|inside| inside.own).collect();
            let is_sound = |nodes: &[u32; 8]| all_corners_are_sound(&nodes.map(|n| now[n as usize]));
            let is_foreign = |found: &Inside| {
                let element = &self.elements[found.element as usize];
                let mut own = self.elements.iter().filter(|nodes| found.own.iter().any(|own| nodes.contains(own)));
                is_sound(element) && own.all(|own| is_sound(own) && !own.iter().any(|node| element.contains(node)))
            };
            let found = inside(self, now).into_iter().filter(|one| !before.contains(&one.own) && is_foreign(one));
            found.map(|inside| inside.part).fold(0.0, f64::max)
        };
        [of(Skin::inside), of(Skin::edges_inside)]
    }

    /// The same for three points of every edge of an outer face.
    pub fn edges_inside(&self, positions: &[Point]) -> Vec<Inside> {
        let between = |a: Point, b: Point, t: f64| [0, 1, 2].map(|i| a[i] + t * (b[i] - a[i]));
        let sample = |&own: &[u32; 2]| {
            let [a, b] = own.map(|n| positions[n as usize]);
            [0.25, 0.5, 0.75].map(|t| Sample { x: between(a, b, t), own })
        };
        self.find(self.edges.iter().flat_map(sample), positions)
    }

    fn find(&self, samples: impl Iterator<Item = Sample>, positions: &[Point]) -> Vec<Inside> {
        let boxes: Vec<[Point; 2]> = self.elements.iter().map(|nodes| bounds(nodes, positions)).collect();
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        order.sort_by(|&a, &b| boxes[a as usize][0][0].total_cmp(&boxes[b as usize][0][0]));
        let widest = boxes.iter().fold(0.0, |w: f64, [low, high]| w.max(high[0] - low[0]));
        let low = |place: &u32| boxes[*place as usize][0][0];
        let mut found = Vec::new();
        for Sample { x, own } in samples {
            let begin = order.partition_point(|e| low(e) < x[0] - widest);
            let near = order[begin..].iter().take_while(|e| low(e) <= x[0]);
            let holds = |e: &&u32| {
                let ([low, high], corners) = (boxes[**e as usize], &self.elements[**e as usize]);
                (0..3).all(|i| low[i] <= x[i] && x[i] <= high[i])
                    && !own.iter().any(|n| corners.contains(n))
                    && is_inside(&corners.map(|c| positions[c as usize]), x)
            };
            let deepest = near.filter(holds).map(|&element| self.depth(x, own, element, positions));
            found.extend(deepest.max_by(|a, b| a.part.total_cmp(&b.part)));
        }
        found
    }

    /// How deep a point inside an element is below the outside of that element's body.
    fn depth(&self, point: Point, own: [u32; 2], element: u32, positions: &[Point]) -> Inside {
        let body = self.body[element as usize];
        let others = self.faces.iter().filter(|face| face.body == body && !own.iter().any(|n| face.nodes.contains(n)));
        let distance = |face: &Face| {
            let x = face.nodes.map(|n| positions[n as usize]);
            let middle = mean(&x);
            (0..4).map(|i| to_triangle(point, [middle, x[i], x[(i + 1) % 4]])).fold(f64::MAX, f64::min)
        };
        let nearest = others.map(|face| (distance(face), face.size)).min_by(|a, b| a.0.total_cmp(&b.0));
        let (depth, size) = nearest.expect("a body has an outside");
        Inside { own, element, depth, part: depth / size }
    }
}

/// The deepest of some; `None` when there is none.
pub fn deepest(found: Vec<Inside>) -> Option<Inside> {
    found.into_iter().max_by(|a, b| a.part.total_cmp(&b.part))
}

/// Asserts that in no plot state a node, or a point of an edge, is deeper inside an element than `most` face sizes, and prints the
/// deepest of both.
#[track_caller]
pub fn nothing_deeper(case: &str, run: &Run, (mesh, skin): (&Mesh, &Skin), most: [f64; 2]) {
    let mut worst: [Option<(f64, Inside)>; 2] = [None; 2];
    for state in &run.states {
        let positions = state.positions(mesh);
        for (worst, found) in worst.iter_mut().zip([skin.inside(&positions), skin.edges_inside(&positions)]) {
            if let Some(found) = deepest(found).filter(|found| worst.is_none_or(|(_, w)| w.part < found.part)) {
                *worst = Some((state.time, found));
            }
        }
    }
    for ((what, worst), most) in ["node", "point of an edge"].iter().zip(worst).zip(most) {
        let (time, part) = worst.map_or((0.0, 0.0), |(time, found)| (time, found.part));
        println!("{case} deepest {what}: {:.4} % of a face, at time {time:.4e}", 100.0 * part);
        assert!(part <= most, "{case}: a {what} is inside: {worst:?}");
    }
}

/// Bodies of elements: numbers from 0 in the order of their first elements.
fn bodies(elements: &[[u32; 8]], nodes: usize) -> Vec<u32> {
    fn root(parent: &mut [u32], mut node: u32) -> u32 {
        while parent[node as usize] != node {
            parent[node as usize] = parent[parent[node as usize] as usize];
            node = parent[node as usize];
        }
        node
    }
    let mut parent: Vec<u32> = (0..nodes as u32).collect();
    for corners in elements {
        let first = root(&mut parent, corners[0]);
        for &corner in &corners[1..] {
            let other = root(&mut parent, corner);
            parent[other as usize] = first;
        }
    }
    let mut roots = Vec::new();
    let mut number = |corners: &[u32; 8]| {
        let root = root(&mut parent, corners[0]);
        roots.iter().position(|known| *known == root).unwrap_or_else(|| {
            roots.push(root);
            roots.len() - 1
        }) as u32
    };
    elements.iter().map(&mut number).collect()
}

fn bounds(nodes: &[u32; 8], positions: &[Point]) -> [Point; 2] {
    let x = nodes.map(|n| positions[n as usize]);
    let over = |pick: fn(f64, f64) -> f64| [0, 1, 2].map(|i| x.iter().map(|p| p[i]).reduce(pick).unwrap_or(0.0));
    [over(f64::min), over(f64::max)]
}

fn is_inside(corners: &[Point; 8], x: Point) -> bool {
    let centre = mean(corners);
    HEX_SIDES.iter().any(|side| {
        let face = side.map(|c| corners[c]);
        let middle = mean(&face);
        // Sides turn outwards, so that the volume over centre, middle, a, b is positive.
        (0..4).any(|i| in_tetrahedron(x, [centre, middle, face[i], face[(i + 1) % 4]]))
    })
}

/// Whether the four volumes that a point makes with the faces of a tetrahedron have the sign of the whole.
fn in_tetrahedron(x: Point, t: [Point; 4]) -> bool {
    let volume = |a, b, c, d| dot(minus(b, a), cross(minus(c, a), minus(d, a)));
    let parts = [
        volume(x, t[1], t[2], t[3]),
        volume(t[0], x, t[2], t[3]),
        volume(t[0], t[1], x, t[3]),
        volume(t[0], t[1], t[2], x),
    ];
    // What lies in a side of it is inside, as nodes in a plane of symmetry do.
    let whole = volume(t[0], t[1], t[2], t[3]);
    whole > 0.0 && parts.iter().all(|part| *part >= -ROUNDING * whole)
}

/// Distance of a point from a triangle: to its plane where the foot is in it, else to the nearest of its edges.
fn to_triangle(x: Point, t: [Point; 3]) -> f64 {
    let normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    let inner = |i: usize| dot(cross(minus(t[(i + 1) % 3], t[i]), minus(x, t[i])), normal) >= 0.0;
    if dot(normal, normal) > 0.0 && (0..3).all(inner) {
        return dot(minus(x, t[0]), normal).abs() / dot(normal, normal).sqrt();
    }
    (0..3).map(|i| to_segment(x, t[i], t[(i + 1) % 3])).fold(f64::MAX, f64::min)
}

fn to_segment(x: Point, a: Point, b: Point) -> f64 {
    let (along, r) = (minus(b, a), minus(x, a));
    let length = dot(along, along);
    let t = if length > 0.0 { (dot(r, along) / length).clamp(0.0, 1.0) } else { 0.0 };
    let rest = minus(r, along.map(|c| c * t));
    dot(rest, rest).sqrt()
}

fn mean(points: &[Point]) -> Point {
    [0, 1, 2].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / points.len() as f64)
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
