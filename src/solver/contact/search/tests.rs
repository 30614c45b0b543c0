//! All searches against the comparison of every node with every face.

use super::{Box3, Candidates, Search, SearchKind, lowest_start};
use proptest::prelude::*;

/// Nodes and faces in which to search.
#[derive(Debug, Clone, Default)]
struct Scene {
    nodes: Vec<Box3>,
    faces: Vec<Box3>,
    connectivity: Vec<[u32; 4]>,
}

impl Scene {
    /// Points with one reach, and faces with corners among them.
    fn of(points: &[[f64; 3]], reach: f64, connectivity: Vec<[u32; 4]>) -> Scene {
        let face = |corners: &[u32; 4]| Box3::around(&corners.map(|node| points[node as usize])).grown(reach);
        Scene {
            nodes: points.iter().map(|point| Box3::around(&[*point]).grown(reach)).collect(),
            faces: connectivity.iter().map(face).collect(),
            connectivity,
        }
    }

    /// The same and another, further on in the numbering.
    fn and(mut self, other: Scene) -> Scene {
        let shift = self.nodes.len() as u32;
        self.nodes.extend(other.nodes);
        self.faces.extend(other.faces);
        self.connectivity.extend(other.connectivity.iter().map(|corners| corners.map(|node| node + shift)));
        self
    }

    fn by_brute_force(&self) -> Vec<Vec<u32>> {
        let near = |node: usize, face: usize| {
            let (one, other) = (&self.nodes[node], &self.faces[face]);
            let corner = self.connectivity[face].contains(&(node as u32));
            one.is_sound() && other.is_sound() && one.overlaps(other) && !corner
        };
        let faces = |node| (0..self.faces.len()).filter(|face| near(node, *face)).map(|face| face as u32).collect();
        (0..self.nodes.len()).map(faces).collect()
    }

    fn found_by(&self, search: &mut dyn Search, found: &mut Candidates) -> Vec<Vec<u32>> {
        search.find(&self.nodes, &self.faces, &self.connectivity, found);
        assert_eq!(found.nodes(), self.nodes.len());
        let lists: Vec<Vec<u32>> = (0..self.nodes.len()).map(|node| found.of(node).to_vec()).collect();
        assert_eq!(found.len(), lists.iter().map(Vec::len).sum::<usize>());
        assert_eq!(found.is_empty(), lists.iter().all(Vec::is_empty));
        lists
    }
}

/// All searches find what brute force finds, in each scene, with memory kept from scene to scene. Returns the numbers of
/// candidates.
fn check(scenes: &[Scene]) -> Vec<usize> {
    let expected: Vec<_> = scenes.iter().map(Scene::by_brute_force).collect();
    for kind in SearchKind::ALL {
        let (mut search, mut found) = (kind.make(), Candidates::default());
        for (scene, expected) in scenes.iter().zip(&expected) {
            assert!(scene.found_by(&mut *search, &mut found) == *expected, "{} differs", search.name());
        }
    }
    expected.iter().map(|lists| lists.iter().map(Vec::len).sum()).collect()
}

/// Equally distributed numbers in [0, 1).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn point(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.number())
    }
}

/// A sheet of n² squares of edge `h` at height `z`.
fn sheet(n: u32, h: f64, z: f64, reach: f64) -> Scene {
    let m = n + 1;
    let points: Vec<_> = (0..m * m).map(|i| [f64::from(i % m) * h, f64::from(i / m) * h, z]).collect();
    let corner = |i: u32| i / n * m + i % n;
    let square = |i: u32| [corner(i), corner(i) + 1, corner(i) + m + 1, corner(i) + m];
    Scene::of(&points, reach, (0..n * n).map(square).collect())
}

/// Separate triangles of about the given size, in a cube of edge `space`.
fn cloud(count: u32, space: f64, size: f64, reach: f64, random: &mut Random) -> Scene {
    let mut points = Vec::new();
    for _ in 0..count {
        let middle = random.point();
        points.extend([0; 3].map(|_| {
            let offset = random.point();
            [0, 1, 2].map(|axis| space * middle[axis] + size * (offset[axis] - 0.5))
        }));
    }
    Scene::of(&points, reach, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2, 3 * i + 2]).collect())
}

#[test]
fn boxes() {
    let unit = Box3::around(&[[0.0, 1.0, 0.0], [1.0, 0.0, 1.0]]);
    assert_eq!(unit, Box3 { low: [0.0; 3], high: [1.0; 3] });
    assert_eq!(unit.grown(0.5), Box3 { low: [-0.5; 3], high: [1.5; 3] });
    assert!(unit.overlaps(&Box3::around(&[[1.0; 3]])), "touching counts");
    assert!(!unit.overlaps(&Box3::around(&[[1.0, 1.0, 1.0f64.next_up()]])));
    assert!(!unit.overlaps(&Box3::empty()) && !Box3::empty().is_sound() && unit.is_sound());
    assert_eq!(unit.including([3.0, 0.0, 0.5]).extent(), 3.0);
}

#[test]
fn a_sheet_on_a_sheet() {
    // Each node meets the four squares around the node of the other sheet; at edges two, at corners one: (2·20)² from
    // either side. The squares around itself, four as well, have it as a corner. The third pair is out of reach.
    let near = sheet(20, 1.0, 0.0, 0.01).and(sheet(20, 1.0, 0.02, 0.01));
    let far = sheet(20, 1.0, 0.0, 0.01).and(sheet(20, 1.0, 0.03, 0.01));
    let fine = sheet(20, 1.0, 0.0, 0.01).and(sheet(20, 0.1, 0.01, 0.001));
    assert_eq!(check(&[near, far, fine])[..2], [3200, 0]);
}

#[test]
fn sparse_and_dense_clouds() {
    let mut random = Random(1);
    let scenes = [(300, 1.0, 0.1, 0.01), (300, 1.0, 1.0, 0.001), (300, 100.0, 1.0, 0.5), (300, 1.0, 0.01, 0.4)];
    let counts = check(&scenes.map(|(count, space, size, reach)| cloud(count, space, size, reach, &mut random)));
    assert!(counts.iter().all(|count| *count > 0), "{counts:?}");
}

#[test]
fn one_huge_face_beside_small_ones() {
    for width in [10.0, 1e3, 1e9, 1e40, 1e300] {
        let huge = [[-1.0; 3], [width, -1.0, -1.0], [width, width, 1.0], [-1.0, width, 1.0]];
        check(&[sheet(20, 0.1, 0.0, 0.01).and(Scene::of(&huge, 0.01, vec![[0, 1, 2, 3]]))]);
    }
}

#[test]
fn many_sizes_at_once() {
    let mut random = Random(2);
    let sizes = (-12..12).map(|power| (10.0, 4f64.powi(power)));
    let scene =
        sizes.fold(Scene::default(), |all, (space, size)| all.and(cloud(15, space, size, 0.1 * size, &mut random)));
    assert!(check(&[scene])[0] > 1000);
}

#[test]
fn an_exploding_cloud_with_fast_nodes() {
    let mut random = Random(3);
    let mut scene = cloud(400, 1.0, 0.05, 0.002, &mut random);
    let fast = (0..scene.nodes.len()).step_by(7);
    for (node, flight) in fast.zip((-3..20).cycle()) {
        let there = random.point().map(|x| 10f64.powi(flight) * (x - 0.5));
        scene.nodes[node] = scene.nodes[node].including(there);
        if node % 2 == 0 {
            let face = node / 3;
            scene.faces[face] = Box3::around(&[there]).grown(0.03);
        }
    }
    check(&[scene]);
}

#[test]
fn degenerate_places() {
    let along = |direction: [f64; 3], reach: f64| {
        let points: Vec<_> = (0..200).map(|i| direction.map(|x| f64::from(i / 2) * x)).collect();
        Scene::of(&points, reach, (0..190).map(|i| [i, i + 2, i + 3, i + 1]).collect())
    };
    let point = along([0.0; 3], 0.0);
    // 200 nodes meet 190 faces each, but for the four corners of each face.
    assert_eq!(check(&[point])[0], 190 * 196);
    let lines =
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1e-300, 0.0, 0.0], [1e306, 0.0, 1.0]];
    check(&lines.map(|direction| along(direction, 0.0)));
    check(&lines.map(|direction| along(direction, 0.1)));
}

#[test]
fn nothing_or_little() {
    let one = Scene::of(&[[1.0; 3], [2.0; 3]], 0.1, vec![[0, 0, 0, 0]]);
    let two = Scene::of(&[[1.0; 3], [1.0; 3]], 0.0, vec![[0, 0, 0, 0]]);
    let nodes = Scene { faces: vec![], connectivity: vec![], ..one.clone() };
    let faces = Scene { nodes: vec![], ..one.clone() };
    assert_eq!(check(&[two.clone(), Scene::default(), nodes, one, faces, two]), [1, 0, 0, 0, 0, 1]);
}

#[test]
fn places_that_are_no_numbers() {
    let mut scenes = Vec::new();
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, -1e308] {
        let mut scene = sheet(12, 1.0, 0.0, 0.1).and(sheet(12, 1.0, 0.15, 0.1));
        for which in (0..scene.faces.len()).step_by(5) {
            scene.faces[which].high[which % 3] = wrong;
            scene.nodes[which + 1].low[which % 3] = wrong;
            scene.nodes[which + 2] = Box3 { low: [wrong; 3], high: [wrong; 3] };
        }
        scenes.push(scene);
    }
    scenes.push(Scene { nodes: vec![Box3::empty(); 9], faces: vec![Box3::empty(); 9], connectivity: vec![[0; 4]; 9] });
    check(&scenes);
}

#[test]
fn motion_from_call_to_call() {
    // Faces that swap places wear out whatever was kept.
    let mut random = Random(4);
    let mut scene = cloud(500, 1.0, 0.05, 0.01, &mut random);
    let mut scenes = Vec::new();
    for _ in 0..4 {
        scene.faces.rotate_left(171);
        scene.connectivity.rotate_left(33);
        scene.nodes.swap(3, 400);
        scenes.push(scene.clone());
    }
    check(&scenes);
}

fn coarse_box() -> impl Strategy<Value = Box3> {
    let edge = || prop_oneof![8 => 0i32..3, 1 => 0i32..40];
    ([0i32..12, 0i32..12, 0i32..4], [edge(), edge(), edge()]).prop_map(|(low, edges)| Box3 {
        low: low.map(f64::from),
        high: [0, 1, 2].map(|i| f64::from(low[i] + edges[i])),
    })
}

proptest! {
    /// A box that ends where another begins starts within the bound, however the difference is rounded.
    #[test]
    fn rounding_loses_no_touching_box(low in -1e-3..1e-3, high in 1e-3..1.0, other in -1.0..-1e-3) {
        for (low, high) in [(low, high), (other, low)] {
            prop_assert!(low >= lowest_start(high, high - low));
        }
    }

    /// Whole coordinates touch and tie often; sevenths make the same ties with rounding.
    #[test]
    fn equal_candidates(
        nodes in prop::collection::vec(coarse_box(), 0..60),
        faces in prop::collection::vec((coarse_box(), [0u32..60, 0u32..60, 0u32..60, 0u32..60]), 0..60),
        scale in prop_oneof![Just(1.0), Just(1.0 / 7.0), Just(1e-3)],
        shift in prop_oneof![Just(0.0), Just(-6.0), Just(1e7)],
    ) {
        let moved = |one: Box3| {
            Box3 { low: one.low.map(|x| x * scale + shift), high: one.high.map(|x| x * scale + shift) }
        };
        let (faces, connectivity): (Vec<Box3>, Vec<[u32; 4]>) = faces.into_iter().unzip();
        let scene = Scene {
            nodes: nodes.into_iter().map(moved).collect(), faces: faces.into_iter().map(moved).collect(), connectivity,
        };
        check(&[scene]);
    }
}
