//! Recipes from outside: counts, volumes, sets and watertight surfaces of the meshes they make, and wrong recipes with
//! their whole messages.

use std::{fs, path::Path};

use proptest::prelude::*;
use urto::{
    deck::Source,
    exodus,
    mesh::{HEX_SIDES, Mesh, check},
    mesher::{self, recipe::Recipe},
};

fn make_refined(recipe: &str, refine: usize) -> Mesh {
    mesher::make(recipe, "t.mesh", refine).unwrap_or_else(|messages| panic!("{messages}"))
}

fn make(recipe: &str) -> Mesh {
    make_refined(recipe, 1)
}

/// The mesh of a recipe in `meshes/`, which must be right without any remark.
fn provided(name: &str, refine: usize) -> Mesh {
    let path = format!("meshes/{name}.mesh");
    let source = Source::open(Path::new(&path)).unwrap_or_else(|why| panic!("{path}: {why}"));
    let (mesh, remarks) = mesher::make_with_warnings(source, refine).unwrap_or_else(|messages| panic!("{messages}"));
    assert!(remarks.is_empty(), "{remarks}");
    mesh
}

fn files(folder: &str, extension: &str) -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut files: Vec<_> = entries.filter(|path| path.extension().is_some_and(|e| e == extension)).collect();
    files.sort();
    files
}

fn corners(mesh: &Mesh, hex: &[u32; 8]) -> [[f64; 3]; 8] {
    hex.map(|node| mesh.coordinates[node as usize])
}

/// Sum of the element volumes, all of which must be positive.
fn volume(mesh: &Mesh) -> f64 {
    let volumes: Vec<f64> = mesh.hexahedra().map(|hex| check::hexahedron_volume(&corners(mesh, hex))).collect();
    assert!(volumes.iter().all(|&v| v > 0.0), "{} elements are flat", volumes.iter().filter(|&&v| v <= 0.0).count());
    volumes.iter().sum()
}

fn assert_close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a:e} is not {b:e}");
}

/// The exterior faces by brute force, after checking that they close: every edge of the surface is walked once in
/// each direction.
fn exterior_faces(mesh: &Mesh) -> usize {
    let mut faces: Vec<([u32; 4], [u32; 4])> = mesh
        .hexahedra()
        .flat_map(|hex| HEX_SIDES.map(|side| side.map(|corner| hex[corner])))
        .map(|face| {
            let mut sorted = face;
            sorted.sort_unstable();
            (sorted, face)
        })
        .collect();
    faces.sort_unstable();
    let same: Vec<_> = faces.chunk_by(|a, b| a.0 == b.0).collect();
    assert!(same.iter().all(|same| same.len() <= 2), "three elements share a face");
    let outside: Vec<[u32; 4]> = same.iter().filter(|same| same.len() == 1).map(|same| same[0].1).collect();
    let mut edges: Vec<(u32, u32)> =
        outside.iter().flat_map(|f| [(f[0], f[1]), (f[1], f[2]), (f[2], f[3]), (f[3], f[0])]).collect();
    let mut back: Vec<(u32, u32)> = edges.iter().map(|&(a, b)| (b, a)).collect();
    edges.sort_unstable();
    back.sort_unstable();
    assert_eq!(edges, back, "the surface is not closed");
    outside.len()
}

fn node_counts(mesh: &Mesh) -> Vec<(i64, usize)> {
    mesh.node_sets.iter().map(|set| (set.id, set.nodes.len())).collect()
}

fn side_counts(mesh: &Mesh) -> Vec<(i64, usize)> {
    mesh.side_sets.iter().map(|set| (set.id, set.sides.len())).collect()
}

/// Largest distance of the nodes of a set from where they should be.
fn farthest(mesh: &Mesh, set: i64, distance: impl Fn([f64; 3]) -> f64) -> f64 {
    let nodes = &mesh.node_set(set).expect("the recipe asks for it").nodes;
    nodes.iter().map(|&node| distance(mesh.coordinates[node as usize])).fold(0.0, f64::max)
}

/// Area vector of a side set.
fn area(mesh: &Mesh, set: i64) -> [f64; 3] {
    let hexes: Vec<&[u32; 8]> = mesh.hexahedra().collect();
    let mut sum = [0.0; 3];
    for &(element, side) in &mesh.side_set(set).expect("the recipe asks for it").sides {
        let x = HEX_SIDES[side as usize].map(|corner| mesh.coordinates[hexes[element as usize][corner] as usize]);
        let [a, b] = [[0, 2], [1, 3]].map(|[i, j]: [usize; 2]| [0, 1, 2].map(|axis| x[j][axis] - x[i][axis]));
        for (axis, sum) in sum.iter_mut().enumerate() {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            *sum += 0.5 * (a[u] * b[v] - a[v] * b[u]);
        }
    }
    sum
}

#[test]
fn a_graded_box() {
    let mesh = make("BOX, 7, 1., 2., 3., 4., 5., 6., 2, 3, 4, 3., 0.5\nNODE SET PLANE, 1, X, 2.\n");
    assert_eq!((mesh.coordinates.len(), mesh.element_count()), (3 * 4 * 5, 24));
    assert_eq!(node_counts(&mesh), [(1, 20)]); // the first element in x is a quarter of the length
    assert_close(volume(&mesh), 120.0, 1e-14);
    assert_eq!(exterior_faces(&mesh), 2 * (2 * 3 + 3 * 4 + 4 * 2));
    assert_eq!(mesh.blocks[0].id, 7);
    assert_eq!(mesh.node_ids, (1..=60).collect::<Vec<i64>>());
}

#[test]
fn round_shapes_are_closed_and_their_sets_complete() {
    let n = 3;
    for (model, quadrants) in [("FULL", 4), ("HALF", 2), ("QUARTER", 1)] {
        let mesh = make(&format!("CYLINDER, 1, 1., 2., {n}, 5, {model}\nSIDE SET FACE, 1, 1, OUTER"));
        assert_eq!(mesh.element_count(), quadrants * 3 * n * n * 5);
        // Across the plane at which a half is cut there are 4 n elements, and as many across the two of a quarter.
        let cut = [0, 4 * n, 4 * n, 0, 0][quadrants];
        assert_eq!(exterior_faces(&mesh), 2 * quadrants * 3 * n * n + (2 * n * quadrants + cut) * 5, "{model}");
        assert_eq!(side_counts(&mesh), [(1, 2 * n * quadrants * 5)]);

        let mesh = make(&format!("TUBE, 1, 1., 2., 3., 2, 9, 4, {model}"));
        assert_eq!(mesh.element_count(), 72);
        let cut = if quadrants == 4 { 0 } else { 2 * 2 * 4 };
        assert_eq!(exterior_faces(&mesh), 2 * 18 + 2 * 36 + cut, "{model}");
    }
    for (model, octants) in [("FULL", 8), ("HALF", 4), ("QUARTER", 2), ("OCTANT", 1)] {
        let mesh = make(&format!("SPHERE, 1, 1., {n}, {model}\nSIDE SET SPHERE, 1, 1.\nSIDE SET FACE, 2, 1, OUTER"));
        assert_eq!(mesh.element_count(), octants * 4 * n * n * n);
        assert_eq!(side_counts(&mesh), [(1, octants * 3 * n * n), (2, octants * 3 * n * n)]);
        // Quarter discs of 3 n² faces on the planes at which the ball is cut.
        let quarters = [0, 3, 4, 0, 4, 0, 0, 0, 0][octants];
        assert_eq!(exterior_faces(&mesh), octants * 3 * n * n + quarters * 3 * n * n, "{model}");
        assert!(volume(&mesh) > 0.0);

        let mesh = make(&format!("SPHERE SHELL, 1, 1., 2., {n}, 2, {model}\nSIDE SET FACE, 1, 1, INNER"));
        assert_eq!(mesh.element_count(), octants * 3 * n * n * 2);
        assert_eq!(side_counts(&mesh), [(1, octants * 3 * n * n)]);
        assert_eq!(exterior_faces(&mesh), 2 * octants * 3 * n * n + quarters * 2 * n * 2, "{model}");
        assert!(volume(&mesh) > 0.0);
    }
}

#[test]
fn curved_volumes_converge_at_second_order() {
    use std::f64::consts::PI;
    let cases = [
        ("CYLINDER, 1, 2., 3., 3, 4, QUARTER", 3.0 * PI),
        ("CYLINDER, 1, 2., 3., 3, 4", 12.0 * PI),
        ("TUBE, 1, 1., 2., 3., 2, 12, 4, HALF", 4.5 * PI),
        ("SPHERE, 1, 2., 3, OCTANT", 4.0 / 3.0 * PI),
        ("SPHERE, 1, 2., 4, QUARTER, 4, 0.5, 0.3", 8.0 / 3.0 * PI),
        ("SPHERE, 1, 2., 4, OCTANT, 4, 0.5, 0.3", 4.0 / 3.0 * PI),
        ("SPHERE SHELL, 1, 1., 2., 4, 2", 28.0 / 3.0 * PI),
    ];
    for (recipe, exact) in cases {
        let errors = [1, 2, 4].map(|refine| 1.0 - volume(&make_refined(recipe, refine)) / exact);
        let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
        assert!(orders.iter().all(|order| (1.9..2.1).contains(order)), "{recipe}: {errors:?} {orders:?}");
        assert!(errors[2] < 0.01, "{recipe}: {errors:?}");
    }
}

#[test]
fn curved_surfaces_lie_where_they_should_at_any_refinement() {
    let round = |x: [f64; 3]| (x[0].hypot(x[1]) - 2.0).abs();
    for refine in [1, 3] {
        let recipe = "CYLINDER, 1, 2., 3., 2, 3, HALF\nNODE SET FACE, 1, 1, OUTER\nNODE SET FACE, 2, 1, CUT Y";
        let mesh = make_refined(recipe, refine);
        assert!(farthest(&mesh, 1, round) < 1e-15);
        assert_eq!(farthest(&mesh, 2, |x| x[1].abs()), 0.0);
        // Around half the circle there are 8 elements, across the cut 2 in the core and 2 rings on either side.
        assert_eq!(
            node_counts(&mesh),
            [(1, (8 * refine + 1) * (3 * refine + 1)), (2, (8 * refine + 1) * (3 * refine + 1))]
        );
    }
}

#[test]
fn refined_meshes_contain_the_coarser_ones() {
    for recipe in [
        "BOX, 1, 0., 0., 0., 1., 2., 3., 2, 3, 4, 5., 0.3",
        "CYLINDER, 1, 1., 2., 2, 3, HALF",
        "TUBE, 1, 1., 2., 2., 2, 5, 2, HALF, 3.",
        "SPHERE, 1, 1., 2, OCTANT",
        "SPHERE, 1, 1., 2, OCTANT, 2, 0.5, 0.2",
        "SPHERE, 1, 1., 2, HALF, 2, 0.5, 0.2",
        "SPHERE SHELL, 1, 1., 2., 2, 3, QUARTER, 4.",
    ] {
        let (coarse, fine) = (make(recipe), make_refined(recipe, 2));
        assert_eq!(fine.element_count(), 8 * coarse.element_count());
        for x in &coarse.coordinates {
            let near = fine.coordinates.iter().any(|y| (0..3).all(|i| (x[i] - y[i]).abs() < 1e-14));
            assert!(near, "{recipe}: {x:?} is no node of the refined mesh");
        }
    }
}

#[test]
fn elements_of_round_shapes_are_well_shaped() {
    // Shortest edge against the longest, and volume against that of the edges at right angles.
    for (recipe, least) in [
        ("CYLINDER, 1, 1., 0.5, 8, 8", 0.5),
        ("SPHERE, 1, 1., 6, OCTANT", 0.35),
        // Angles stay where nothing is cut across the way to the pole.
        ("SPHERE, 1, 1., 6, QUARTER, 6, 0.5, 0.2", 0.35),
        ("SPHERE, 1, 1., 6, OCTANT, 6, 0.5, 0.2", 0.3),
    ] {
        let mesh = make(recipe);
        for hex in mesh.hexahedra() {
            let x = corners(&mesh, hex);
            let length = |a: usize, b: usize| (0..3).map(|i| (x[a][i] - x[b][i]).powi(2)).sum::<f64>().sqrt();
            let edges =
                [[(0, 1), (3, 2), (4, 5), (7, 6)], [(0, 3), (1, 2), (4, 7), (5, 6)], [(0, 4), (1, 5), (2, 6), (3, 7)]];
            let means = edges.map(|four| four.iter().map(|&(a, b)| length(a, b)).sum::<f64>() / 4.0);
            let skew = check::hexahedron_volume(&x) / means.iter().product::<f64>();
            assert!(skew > least, "{recipe}: {skew}");
        }
    }
}

#[test]
fn moves_keep_shape_and_faces() {
    let recipe = "
        CYLINDER, 1, 1., 2., 2, 3, QUARTER
        TRANSLATE, 1, 5., 0., 0.
        ROTATE, 1, Z, 90.                       $ to (0, 5, 0), the old x along y
        MIRROR, 1, Z, 1.                        $ the bottom is now at z = 2
        NODE SET FACE, 1, 1, BOTTOM
        NODE SET FACE, 2, 1, OUTER
        NODE SET CYLINDER, 3, Z, 1., 0., 5.
        SIDE SET FACE, 100, 1, BOTTOM
        SIDE SET PLANE, 101, Z, 2.
        SIDE SET NORMAL, 102, 0., 0., 5.
        SIDE SET FACE, 103, 1, TOP";
    let mesh = make(recipe);
    let still = make("CYLINDER, 1, 1., 2., 2, 3, QUARTER");
    assert_close(volume(&mesh), volume(&still), 1e-13);
    assert_eq!(farthest(&mesh, 1, |x| (x[2] - 2.0).abs()), 0.0);
    assert_eq!(mesh.node_set(2).map(|set| &set.nodes), mesh.node_set(3).map(|set| &set.nodes));
    for other in [101, 102] {
        assert_eq!(mesh.side_set(100).map(|set| &set.sides), mesh.side_set(other).map(|set| &set.sides));
    }
    let (bottom, top) = (area(&mesh, 100), area(&mesh, 103));
    assert!(bottom[2] > 0.7 && (bottom[2] + top[2]).abs() < 1e-14, "{bottom:?} {top:?}");
    exterior_faces(&mesh);
}

#[test]
fn shapes_stay_apart_unless_they_are_merged() {
    let boxes = "BOX, 1, 0., 0., 0., 1., 1., 1., 2, 2, 2\nBOX, 2, 0., 0., 1., 1., 1., 1., 2, 2, 2\n";
    let apart = make(boxes);
    assert_eq!((apart.coordinates.len(), exterior_faces(&apart)), (54, 48));
    let joined = make(&format!("{boxes}MERGE\nSIDE SET BLOCK, 1, 2\nSIDE SET FACE, 2, 2, BOTTOM"));
    assert_eq!((joined.coordinates.len(), exterior_faces(&joined)), (45, 40));
    assert_eq!(side_counts(&joined), [(1, 20), (2, 4)]);
    assert_eq!(joined.blocks.len(), 2);
    let copies = make("BOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 1\nCOPY, 1, 3, 1., 0., 0., 4\nMERGE, 3\n");
    assert_eq!(copies.blocks.iter().map(|b| (b.id, b.len())).collect::<Vec<_>>(), [(1, 1), (3, 4)]);
    assert_eq!(copies.coordinates.len(), 8 + 20);
    assert_close(volume(&copies), 5.0, 1e-14);
}

#[test]
fn split_blocks_stay_joined() {
    let recipe = "BOX, 5, 0., 0., 0., 1., 1., 4., 1, 1, 4\nSPLIT BLOCK, 5, 2, , , , , , 2.\nSIDE SET FACE, 1, 5, BOTTOM\n\
                  NODE SET BLOCK, 7, 2\nSIDE SET BLOCK, 8, 2\n";
    let mesh = make(recipe);
    assert_eq!(mesh.blocks.iter().map(|b| (b.id, b.len())).collect::<Vec<_>>(), [(2, 2), (5, 2)]);
    assert_eq!(mesh.coordinates.len(), 20);
    assert_eq!(mesh.side_sets[0].sides, [(0, 4)]); // the lower half is block 2 now, and comes first
    assert_eq!((node_counts(&mesh), side_counts(&mesh)[1]), (vec![(7, 12)], (8, 9)));
    let thirds =
        make("BOX, 1, 0., 0., 0., 1., 1., 3., 1, 1, 3\nSPLIT BLOCK, 1, 2, , , , , 1.\nSPLIT BLOCK, 2, 3, , , , , 2.\n");
    assert_eq!(thirds.blocks.iter().map(|b| (b.id, b.len())).collect::<Vec<_>>(), [(1, 1), (2, 1), (3, 1)]);
}

#[test]
fn perturbed_nodes_are_inside_and_the_same_in_every_run() {
    let cube = "BOX, 1, 0., 0., 0., 1., 1., 1., 4, 4, 4\n";
    let (still, moved) = (make(cube), make(&format!("{cube}PERTURB, 0.3")));
    let distances = still
        .coordinates
        .iter()
        .zip(&moved.coordinates)
        .map(|(a, b)| (a, (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)));
    for (x, distance) in distances {
        let inside = x.iter().all(|&x| x > 0.0 && x < 1.0);
        assert!(distance <= 0.3 * 0.25 && (distance > 0.0) == inside, "{x:?} moved by {distance}");
    }
    assert_close(volume(&moved), 1.0, 1e-13);
    assert_eq!(moved, make(&format!("{cube}PERTURB, 0.3")));
}

/// Mixes all coordinates and node numbers, so that a change of one bit shows.
fn fingerprint(mesh: &Mesh) -> u64 {
    let bits = mesh.coordinates.iter().flatten().map(|x| x.to_bits());
    let nodes = mesh.hexahedra().flat_map(|hex| hex.map(u64::from));
    bits.chain(nodes).fold(0xCBF2_9CE4_8422_2325, |hash, word| (hash ^ word).wrapping_mul(0x0000_0100_0000_01B3))
}

#[test]
fn the_same_bits_on_every_machine() {
    let mesh = make(
        "CYLINDER, 1, 1., 2., 3, 4, HALF\nSPHERE, 2, 1., 3, OCTANT\nSPHERE SHELL, 3, 2., 3., 3, 3, OCTANT, 3.\nROTATE, 3, X, 33.\nPERTURB, 0.1, 3",
    );
    assert_eq!(fingerprint(&mesh), 0x928A_E41A_FEA0_5766, "{:#X}", fingerprint(&mesh));
}

#[test]
fn the_meshes_that_are_provided() {
    // Recipe, nodes, elements, node sets, side sets.
    type Counts = &'static [(i64, usize)];
    let expected: &[(&str, usize, usize, Counts, Counts)] = &[
        ("bar_wave", 201 * 4, 200, &[(1, 4), (2, 4), (3, 804), (4, 804)], &[(100, 1), (200, 1)]),
        ("bending_beam", 22506, 19500, &[(1, 341), (2, 31), (3, 2 * 66 * 11)], &[(100, 1950)]),
        ("bending_beam_2", 21 * 2 * 3, 40, &[(1, 6), (2, 2), (3, 126)], &[(100, 20)]),
        ("bending_beam_4", 41 * 2 * 5, 160, &[(1, 10), (2, 2), (3, 410)], &[(100, 40)]),
        ("bending_beam_plane", 205, 160, &[(1, 5), (2, 1)], &[(100, 40)]),
        ("bending_beam_scaled", 61 * 19 * 7, 6480, &[(1, 133), (2, 19), (3, 2 * 61 * 7)], &[(100, 1080)]),
        ("bent_strip", 210, 80, &[(1, 10), (2, 5)], &[]),
        ("block", 125, 64, &[(1, 125)], &[(100, 96)]),
        ("borehole", 1910, 243 + 1188, &[(1, 290), (2, 290), (3, 191), (4, 191)], &[(500, 54)]),
        ("brick_wall", 11765, 8400, &[], &[]),
        ("brick_wall_scaled", 3486, 1890, &[], &[]),
        ("can_crush", 10088, 7152, &[(1, 444), (100, 164)], &[(4, 120), (10, 3680), (20, 1904)]),
        ("can_crush_paper", 10088, 7152, &[(1, 444), (100, 164)], &[(4, 120), (10, 3680), (20, 1904)]),
        ("can_crush_scaled", 2788, 1875, &[(1, 232), (100, 84)], &[(4, 60), (10, 1040), (20, 630)]),
        ("can_crush_shell", 5045, 3952, &[(1, 198), (100, 41)], &[]),
        ("cantilever", 44, 10, &[(1, 4), (2, 4), (3, 44)], &[(100, 1), (200, 10)]),
        ("commands", 81, 32, &[(1, 27), (2, 27), (3, 9), (4, 9), (5, 9)], &[(100, 4), (200, 4), (300, 16)]),
        ("contact_patch", 189, 91, &[(1, 41), (2, 41), (3, 16)], &[(100, 16)]),
        (
            "container_drop",
            1982,
            1692,
            &[(11, 9)],
            &[(100, 18), (999, 26), (200, 106), (300, 106), (400, 74), (500, 112)],
        ),
        ("cylinder_test", 17 * 121, 1920, &[(1, 1), (2, 34)], &[]),
        ("detonation", 804, 200, &[(1, 4), (2, 4), (3, 804), (4, 804)], &[(100, 1), (200, 1)]),
        ("flyer", 804, 200, &[(1, 4), (2, 4), (3, 804), (4, 804)], &[(100, 1), (200, 1)]),
        ("frame", 149, 168, &[(1, 4), (2, 1), (3, 117)], &[]),
        ("hertz", 70306, 65536, &[(1, 3202), (2, 3202)], &[]),
        ("lined_box", 2541, 2000, &[(1, 231), (2, 231)], &[(100, 100)]),
        ("materials", 378, 112, &[(1, 378), (2, 126), (3, 126)], &[]),
        ("newtons_cradle", 1020, 250, &[], &[]),
        ("patch_test", 16, 7, &[(1, 8), (2, 8)], &[(100, 6)]),
        ("perforation", 16406, 13860, &[(1, 1256), (2, 1256), (3, 273)], &[]),
        ("plate_triangles", 625, 1152, &[(1, 96), (2, 1)], &[(100, 1152)]),
        ("rigid_ball", 9586, 7424, &[(1, 330), (2, 490)], &[]),
        ("sedov", 31 * 31 * 31, 27000, &[(1, 961), (2, 961), (3, 961)], &[]),
        ("shell_strips", 126, 60, &[(1, 6), (11, 2), (12, 2), (13, 2)], &[]),
        ("simple_shear", 8, 1, &[(1, 2), (2, 2), (3, 2), (4, 2)], &[]),
        ("sliding_block", 125, 64, &[(1, 125)], &[(100, 96)]),
        ("sliding_on_block", 207, 82, &[(1, 66)], &[]),
        ("sphere", 369, 256, &[(1, 61), (2, 61), (3, 61)], &[(100, 48)]),
        ("spherical_cavity", 217 * 61, 11520, &[(1, 17 * 61), (2, 17 * 61), (3, 17 * 61)], &[(100, 192), (200, 192)]),
        ("spinning_rod", 51 * 9, 200, &[(1, 9), (2, 3), (3, 9), (4, 306)], &[(100, 4), (200, 4)]),
        ("square_tube", 17 * 61, 960, &[(1, 61), (2, 61), (3, 17), (11, 5), (12, 5)], &[(100, 1920)]),
        ("taylor_bar", 217 * 161, 30720, &[(1, 17 * 161), (2, 17 * 161), (3, 217)], &[(100, 192), (200, 2560)]),
        ("taylor_bar_axisymmetric", 17 * 161, 2560, &[(1, 17)], &[(100, 16), (200, 160)]),
        ("taylor_bar_steel", 37 * 82, 2187, &[(1, 7 * 82), (2, 7 * 82), (3, 37)], &[]),
        ("taylor_bar_wall", 37 * 61, 1620, &[(1, 7 * 61), (2, 7 * 61), (3, 37)], &[(100, 27), (200, 360)]),
        ("tied_bar", 101 * (25 + 16), 2500, &[(1, 25)], &[(100, 16), (200, 9)]),
        ("truss_pendulum", 2, 1, &[(1, 1)], &[]),
        ("two_bars", 408, 100, &[(1, 4), (2, 4)], &[]),
        ("two_waves", 401 * 4, 400, &[(1, 4), (2, 4), (3, 1604), (4, 1604)], &[(100, 1), (200, 1)]),
        ("uniaxial_wave", 401 * 4, 400, &[(1, 4), (2, 4), (3, 1604), (4, 1604)], &[(100, 1), (200, 1)]),
        ("wall_bar", 51 * 4, 50, &[(1, 4), (2, 4), (3, 204), (4, 204)], &[(100, 1), (200, 1)]),
        ("wall_bar_cut", 51 * 4, 50, &[], &[(100, 1)]),
        ("wall_bar_further", 51 * 4, 50, &[(1, 4), (2, 4), (3, 204), (4, 204)], &[(100, 1), (200, 1)]),
    ];
    let names: Vec<_> =
        files("meshes", "mesh").iter().map(|path| path.file_stem().map(|s| s.to_string_lossy().into_owned())).collect();
    assert_eq!(names, expected.iter().map(|e| Some(e.0.to_string())).collect::<Vec<_>>());
    for &(name, nodes, elements, node_sets, side_sets) in expected {
        let mesh = provided(name, 1);
        assert_eq!((mesh.coordinates.len(), mesh.element_count()), (nodes, elements), "{name}");
        assert_eq!((&node_counts(&mesh)[..], &side_counts(&mesh)[..]), (node_sets, side_sets), "{name}");
        assert!(check::geometry(&mesh).is_empty() && check::unreferenced_nodes(&mesh).is_empty(), "{name}");
        exterior_faces(&mesh);
    }
}

#[test]
fn the_can_and_its_plate_have_the_bounds_of_the_sample() {
    let mesh = provided("can_crush", 1);
    let bounds = [0, 1, 2].map(|i| {
        let values = mesh.coordinates.iter().map(|x| x[i]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    });
    let sample = [(-7.8784618, 8.3125820), (0.0, 8.0), (-15.0, 4.7781048)];
    for (found, sample) in bounds.iter().zip(sample) {
        assert!((found.0 - sample.0).abs() < 1e-6 && (found.1 - sample.1).abs() < 1e-6, "{found:?} {sample:?}");
    }
}

/// The small mesh files beside the recipes are what the recipes make; URTO_BLESS=1 writes them.
#[test]
fn the_mesh_files_that_are_provided_are_current() {
    /// Recipes whose mesh is kept as a file, so that the decks run from a fresh clone.
    const KEPT: [&str; 11] = [
        "bar_wave",
        "bending_beam_2",
        "bending_beam_4",
        "block",
        "cantilever",
        "commands",
        "patch_test",
        "spinning_rod",
        "taylor_bar_wall",
        "uniaxial_wave",
        "wall_bar",
    ];
    for name in KEPT {
        let path = Path::new("meshes").join(name).with_extension("g");
        let made = provided(name, 1);
        if std::env::var_os("URTO_BLESS").is_some() {
            exodus::write_mesh(&path, &made).unwrap_or_else(|why| panic!("{why}"));
        }
        let kept = exodus::read_mesh(&path).unwrap_or_else(|why| panic!("{why}"));
        assert!(Mesh { qa: made.qa.clone(), ..kept } == made, "{name}.g is stale; URTO_BLESS=1 writes it again");
        assert!(fs::metadata(&path).is_ok_and(|file| file.len() < 200_000), "{name}.g is too large to keep");
    }
}

#[test]
fn wrong_recipes_are_answered_as_written_down() {
    let recipes = files("tests/language/wrong_recipes", "mesh");
    assert!(recipes.len() >= 10, "only {} wrong recipes", recipes.len());
    for path in recipes {
        let text = fs::read_to_string(&path).expect("the file was listed");
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let answer = match mesher::make_with_warnings(Source::new(name, text), 1) {
            Ok((_, remarks)) => remarks.render(false),
            Err(messages) => messages.render(false),
        };
        assert!(!answer.is_empty(), "{}: nothing to say about it", path.display());
        let golden = path.with_extension("expected");
        if std::env::var_os("URTO_BLESS").is_some() {
            fs::write(&golden, &answer).expect("the folder can be written to");
        }
        let expected = fs::read_to_string(&golden).unwrap_or_default();
        assert_eq!(answer, expected, "{}: URTO_BLESS=1 accepts this", path.display());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    /// Recipes with letters lost, doubled and exchanged are answered, and never bring the mesher down.
    #[test]
    fn mutilated_recipes_are_survived(
        which in 0usize..64,
        cuts in proptest::collection::vec((0usize..4000, 0usize..6, "[-0-9A-Z.,$* \n']{0,3}"), 1..8),
    ) {
        let recipes = files("meshes", "mesh");
        let mut text = fs::read_to_string(&recipes[which % recipes.len()]).expect("the file was listed");
        for (at, length, new) in cuts {
            let start = at % (text.len() + 1);
            text.replace_range(start..(start + length).min(text.len()), &new);
        }
        let (recipe, _) = Recipe::read(Source::new("t.mesh", text.as_str()));
        if recipe.elements(1) < 3000.0 {
            let _ = mesher::make(&text, "t.mesh", 1).map_err(|messages| messages.render(false));
        }
    }
}

#[test]
fn a_refinement_of_zero_is_refused() {
    let answer = mesher::make("BOX, 1, 0., 0., 0., 1., 1., 1., 1, 1, 1", "t.mesh", 0).map_err(|e| e.to_string());
    assert!(answer.is_err_and(|text| text.contains("the refinement is 0")));
}
