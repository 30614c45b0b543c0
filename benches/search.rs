//! The neighbourhood searches of contact compared: scenes, then sizes. `cargo bench --bench search`; a word as argument
//! picks sections.

use std::time::Instant;
use urto::solver::contact::search::{Box3, Candidates, Search, SearchKind};

/// Reach of a node in edges of faces: what it moves within a step, and the tolerance.
const REACH: f64 = 0.05;

/// Nodes and faces in which to search.
#[derive(Default)]
struct Scene {
    nodes: Vec<Box3>,
    faces: Vec<Box3>,
    connectivity: Vec<[u32; 4]>,
}

impl Scene {
    /// Adds a sheet of `across` × `along` faces, whose nodes are where `place` says for parameters in [0, 1].
    fn add_sheet(&mut self, across: usize, along: usize, reach: f64, place: impl Fn(f64, f64) -> [f64; 3]) {
        let first = self.nodes.len();
        let mut points = Vec::new();
        for j in 0..=along {
            points.extend((0..=across).map(|i| place(i as f64 / across as f64, j as f64 / along as f64)));
        }
        self.nodes.extend(points.iter().map(|point| Box3::around(&[*point]).grown(reach)));
        for (j, i) in (0..along).flat_map(|j| (0..across).map(move |i| (j, i))) {
            let corner = j * (across + 1) + i;
            let corners = [corner, corner + 1, corner + across + 2, corner + across + 1];
            self.faces.push(Box3::around(&corners.map(|node| points[node])).grown(reach));
            self.connectivity.push(corners.map(|node| (first + node) as u32));
        }
    }

    /// Adds the six sides of a block with `n` faces along each edge.
    fn add_block(&mut self, low: [f64; 3], edges: [f64; 3], n: usize, reach: f64) {
        for axis in 0..3 {
            for side in [0.0, 1.0] {
                self.add_sheet(n, n, reach, |u, v| {
                    let mut at = [u, v, side];
                    at.rotate_right((axis + 1) % 3);
                    [0, 1, 2].map(|axis| low[axis] + edges[axis] * at[axis])
                });
            }
        }
    }
}

/// Equally distributed numbers in [-1, 1).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn point(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.number())
    }
}

fn squares(faces: usize) -> usize {
    (faces as f64).sqrt().round().max(1.0) as usize
}

/// A cube blown up to a sphere.
fn sphere(faces: usize) -> Scene {
    let n = squares(faces / 6);
    let mut cube = Scene::default();
    cube.add_block([-1.0; 3], [2.0; 3], n, 0.0);
    let outwards = |point: [f64; 3]| {
        let length = point.iter().map(|x| x * x).sum::<f64>().sqrt();
        point.map(|x| x / length)
    };
    let points: Vec<[f64; 3]> = cube.nodes.iter().map(|node| outwards(node.low)).collect();
    let reach = REACH * 1.5 / n as f64;
    Scene {
        nodes: points.iter().map(|point| Box3::around(&[*point]).grown(reach)).collect(),
        faces: cube
            .connectivity
            .iter()
            .map(|corners| Box3::around(&corners.map(|node| points[node as usize])).grown(reach))
            .collect(),
        connectivity: cube.connectivity,
    }
}

/// A can in the middle of its collapse: three layers, half an edge apart, in folds that touch.
fn can(faces: usize) -> Scene {
    let n = squares(faces / 3);
    let edge = 2.0 * std::f64::consts::PI / n as f64;
    let mut scene = Scene::default();
    for layer in 0..3 {
        scene.add_sheet(n, n, REACH * edge, |u, v| {
            let radius = 1.0 + 0.15 * (40.0 * v).sin() - 0.5 * edge * f64::from(layer);
            let angle = 2.0 * std::f64::consts::PI * u;
            [radius * angle.cos(), radius * angle.sin(), 0.5 * v]
        });
    }
    scene
}

/// A wall of bricks with six faces along an edge and gaps of a fiftieth of a face.
fn wall(faces: usize) -> Scene {
    let mut scene = Scene::default();
    let across = squares(faces / 216 / 2).max(1);
    for brick in 0..(faces / 216).max(1) {
        let place = [brick % 2, brick / 2 % across, brick / 2 / across].map(|i| i as f64 * 6.02);
        scene.add_block(place, [6.0; 3], 6, REACH);
    }
    scene
}

/// A fine sheet on a block whose side is one face, and ten more such blocks.
fn huge(faces: usize) -> Scene {
    let n = squares(faces);
    let mut scene = Scene::default();
    scene.add_sheet(n, n, REACH, |u, v| [u * n as f64, v * n as f64, 0.0]);
    for depth in 0..11 {
        scene.add_block([0.0, 0.0, -0.02 - f64::from(depth + 1) * n as f64], [n as f64; 3], 1, REACH);
    }
    scene
}

/// A block of separate cubes, of which one in a hundred flies fast and one in a thousand is very far.
fn explosion(faces: usize) -> Scene {
    let mut random = Random(1);
    let mut scene = Scene::default();
    let cubes = (faces / 6).max(1);
    let edge = (cubes as f64).cbrt() * 0.75;
    for cube in 0..cubes {
        let flight = if cube % 1000 == 7 {
            1e4
        } else if cube % 100 == 8 {
            3.0
        } else {
            1.0
        };
        let reach = if flight > 1.0 { 2.0 } else { REACH };
        scene.add_block(random.point().map(|x| edge * flight * x), [1.0; 3], 1, reach);
    }
    scene
}

type Build = fn(usize) -> Scene;
const SCENES: [(&str, Build); 5] =
    [("sphere", sphere), ("can", can), ("brick wall", wall), ("huge beside small", huge), ("explosion", explosion)];

/// Seconds of the first call and of the best of some more, and the number of candidates.
fn time(search: &mut dyn Search, scene: &Scene) -> (f64, f64, usize) {
    let mut found = Candidates::default();
    let (mut first, mut best) = (None, f64::INFINITY);
    let begun = Instant::now();
    while first.is_none() || best == f64::INFINITY || begun.elapsed().as_secs_f64() < 0.4 {
        let call = Instant::now();
        search.find(&scene.nodes, &scene.faces, &scene.connectivity, &mut found);
        let taken = call.elapsed().as_secs_f64();
        if first.is_some() {
            best = best.min(taken);
        }
        first.get_or_insert(taken);
    }
    (first.unwrap_or_default(), best, found.len())
}

/// One line: a scene, and for each search the time of the first and of later calls.
fn compare(name: &str, scene: &Scene, kinds: &[SearchKind]) {
    print!("  {name:<18}{:>9}{:>9}", scene.faces.len(), scene.nodes.len());
    let mut counts = Vec::new();
    for kind in SearchKind::ALL {
        if !kinds.contains(&kind) {
            print!("{:>11}{:>9}", "-", "-");
            continue;
        }
        let (first, again, count) = time(&mut *kind.make(), scene);
        let per_face = 1e9 / scene.faces.len() as f64;
        print!("{:>11.0}{:>9.0}", first * per_face, again * per_face);
        counts.push(count);
    }
    let agree = counts.iter().all(|count| *count == counts[0]);
    println!("{:>12}{}", counts[0], if agree { "" } else { "  THEY DIFFER" });
}

fn heading() {
    println!("time per face of a first and of later calls, ns");
    print!("  {:<18}{:>9}{:>9}", "", "faces", "nodes");
    SearchKind::ALL.iter().for_each(|kind| print!("{:>20}", kind.make().name()));
    println!("{:>12}", "candidates");
}

fn scenes() {
    heading();
    for (name, build) in SCENES {
        compare(name, &build(200_000), &SearchKind::ALL);
    }
}

fn sizes() {
    heading();
    for (name, build) in SCENES {
        for power in 3..=6 {
            let all = if power < 6 { &SearchKind::ALL[..] } else { &[SearchKind::Grid, SearchKind::Bvh] };
            compare(name, &build(10usize.pow(power)), all);
        }
    }
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    for (name, section) in [("scenes", scenes as fn()), ("sizes", sizes)] {
        if wanted.is_empty() || wanted.iter().any(|w| w == name) {
            section();
        }
    }
}
