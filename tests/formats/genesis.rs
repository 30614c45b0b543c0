//! Meshes of EXODUS I, as FORTRAN wrote them on machines of either byte order and word size.

use std::fs;

use urto::exodus::{Results, read_mesh};
use urto::mesh::Mesh;

use super::{check_cubes, fixture};

/// The sets of every fixture that has any. Their sides are given by nodes in another order than ours.
fn check_sets(mesh: &Mesh) {
    let nodes: Vec<_> = mesh.node_sets.iter().map(|s| (s.id, s.nodes.as_slice())).collect();
    assert_eq!(nodes, [(5, [0, 1, 2, 3].as_slice()), (30, [15].as_slice())]);
    // The same faces as in the EXODUS II fixtures: both ends of the row; and y = 0 of the second cube.
    let sides: Vec<_> = mesh.side_sets.iter().map(|s| (s.id, s.sides.as_slice())).collect();
    assert_eq!(sides, [(200, [(0, 4), (2, 5)].as_slice()), (7, [(1, 0)].as_slice())]);
}

#[test]
fn every_byte_order_and_word_size_is_read() {
    let files = [
        ("genesis_little_4.g", "little endian, words of 4 bytes", 0),
        ("genesis_big_4.g", "big endian, words of 4 bytes", 2),
        ("genesis_little_8.g", "little endian, words of 8 bytes", 2),
        ("genesis_big_8.g", "big endian, words of 8 bytes", 2),
        ("genesis_little_mixed.g", "integers of 4 bytes, reals and marks of 8", 2),
    ];
    for (name, title, records) in files {
        let mesh = read_mesh(&fixture(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        check_cubes(&mesh);
        check_sets(&mesh);
        assert_eq!((mesh.title.as_str(), mesh.qa.len()), (title, records));
        if records > 0 {
            assert_eq!(mesh.qa[1], ["GEN3D", "1.0", "12/16/88", "13:14:15"]);
        }
        assert_eq!((mesh.node_ids[15], mesh.element_ids.as_slice()), (16, [1, 2, 3].as_slice()));
    }
}

#[test]
fn a_mesh_without_sets_is_read() {
    let mesh = read_mesh(&fixture("genesis_big_marks.g")).unwrap();
    check_cubes(&mesh);
    assert!(mesh.node_sets.is_empty() && mesh.side_sets.is_empty());
}

/// A file may end after the mesh, or after any of the records that close it, but nowhere else.
#[test]
fn a_file_ends_where_it_may_and_nowhere_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cut.g");
    let whole = fs::read(fixture("genesis_big_4.g")).unwrap();
    let mut ends = Vec::new();
    for length in 1..=whole.len() {
        fs::write(&path, &whole[..length]).unwrap();
        match read_mesh(&path) {
            Ok(mesh) => {
                check_cubes(&mesh);
                ends.push(whole.len() - length);
            }
            Err(error) => assert!(error.to_string().starts_with("error: "), "{error}"),
        }
    }
    // Behind it all; before the names of types (16 + 8 bytes), of axes (24 + 8), the information (80 + 8 and 4 + 8),
    // and the QA records (twice 32 + 8, and 4 + 8).
    assert_eq!(ends, [248, 156, 56, 24, 0].map(|left| left));
}

#[test]
fn results_of_exodus_one_are_refused_with_advice() {
    let refused = Results::open(&fixture("genesis_big_8.g")).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(refused.contains("of which urto reads the mesh, but no results"), "{refused}");
}
