//! EXODUS files of every container, as this and other programs write them, are read; what is written is read back.

mod compare;
mod genesis;
mod kill;
mod support;

use std::fs;
use std::path::{Path, PathBuf};

use support::{results_header, two_block_mesh, written_state};
use urto::exodus::{Results, ResultsError, ResultsWriter, read_mesh, write_mesh};
use urto::mesh::Mesh;

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

#[test]
fn a_mesh_is_read_back_as_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.g");
    let mesh = two_block_mesh();
    write_mesh(&path, &mesh).unwrap();
    assert_eq!(&fs::read(&path).unwrap()[..4], b"CDF\x02");
    assert_eq!(read_mesh(&path).unwrap(), mesh);
    assert!(!folder.path().join("two.g.part").exists());
}

#[test]
fn numbers_beyond_32_bits_choose_the_64_bit_data_container() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wide.g");
    let mut mesh = two_block_mesh();
    mesh.node_ids[3] = 5_000_000_000;
    mesh.blocks[1].id = 1 << 40;
    write_mesh(&path, &mesh).unwrap();
    assert_eq!(&fs::read(&path).unwrap()[..4], b"CDF\x05");
    assert_eq!(read_mesh(&path).unwrap(), mesh);
    let mut writer = ResultsWriter::create(&path, &results_header(&mesh)).unwrap();
    for state in 0..3 {
        let (time, globals, nodal, element) = written_state(&mesh, state);
        writer.write_state(time, &globals, &nodal, &element).unwrap();
    }
    check_results(&path, &mesh, 3);
}

#[test]
fn empty_blocks_and_sets_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.g");
    let mut mesh = two_block_mesh();
    mesh.blocks.insert(1, urto::mesh::Block { id: 7, name: "nothing".into(), ..Default::default() });
    mesh.node_sets.push(urto::mesh::NodeSet { id: 8, ..Default::default() });
    mesh.side_sets.insert(0, urto::mesh::SideSet { id: 9, ..Default::default() });
    write_mesh(&path, &mesh).unwrap();
    assert_eq!(read_mesh(&path).unwrap(), mesh);
}

#[test]
fn results_are_read_back_as_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.e");
    let mesh = two_block_mesh();
    let mut writer = ResultsWriter::create(&path, &results_header(&mesh)).unwrap();
    check_results(&path, &mesh, 0);
    for state in 0..4 {
        let (time, globals, nodal, element) = written_state(&mesh, state);
        writer.write_state(time, &globals, &nodal, &element).unwrap();
        assert_eq!(writer.states(), state + 1);
        // The writer still holds the file open.
        check_results(&path, &mesh, state + 1);
    }
}

fn check_results(path: &Path, mesh: &Mesh, states: usize) {
    let results = Results::open(path).unwrap();
    let header = results_header(mesh);
    assert_eq!(results.mesh().unwrap(), Mesh { title: header.title, qa: results.qa(), ..mesh.clone() });
    assert_eq!(results.qa(), [mesh.qa[0].clone(), header.qa]);
    assert_eq!(results.info(), ["TITLE".to_string(), "x".repeat(80), "x".repeat(20), String::new(), "EXIT".into()]);
    assert_eq!(results.times().len(), states);
    assert_eq!(results.nodal_names(), ["DISPLX", "DISPLY", "DISPLZ"]);
    for state in 0..states {
        let (time, globals, nodal, element) = written_state(mesh, state);
        assert_eq!(results.times()[state], time);
        assert_eq!(results.global(state).unwrap(), globals);
        assert_eq!(results.nodal("displz", state).unwrap(), nodal[2]);
        assert_eq!(results.element("EQPS", state).unwrap(), element[0]);
        assert_eq!(results.element("SIGXX", state).unwrap(), element[1]);
    }
    assert!(matches!(results.nodal("DISPLX", states), Err(ResultsError::NoState { .. })));
    if states > 0 {
        let error = results.element("VONMISES", 0).unwrap_err().to_string();
        assert!(error.ends_with("there is no element variable VONMISES; the file has: EQPS, SIGXX"), "{error}");
    }
}

#[test]
fn arrays_of_the_wrong_length_are_refused_and_harm_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.e");
    let mesh = two_block_mesh();
    let mut writer = ResultsWriter::create(&path, &results_header(&mesh)).unwrap();
    let (time, globals, nodal, mut element) = written_state(&mesh, 0);
    element[1].pop();
    let error = writer.write_state(time, &globals, &nodal, &element).unwrap_err().to_string();
    assert!(error.ends_with("an array of element values has 2 values where 3 belong"), "{error}");
    check_results(&path, &mesh, 0);
}

/// The mesh of every fixture: three unit cubes in two blocks.
fn check_cubes(mesh: &Mesh) {
    let reference = two_block_mesh();
    assert_eq!(mesh.coordinates, reference.coordinates);
    let blocks: Vec<_> = mesh.blocks.iter().filter(|b| !b.is_empty()).collect();
    assert_eq!(blocks.len(), 2);
    for (block, expected) in blocks.iter().zip(&reference.blocks) {
        assert_eq!((block.id, &block.nodes), (expected.id, &expected.nodes));
    }
}

#[test]
fn packed_classic_files_of_old_programs_are_read() {
    let path = fixture("classic_packed.exo");
    let mesh = read_mesh(&path).unwrap();
    check_cubes(&mesh);
    assert_eq!(mesh.title, "packed");
    assert_eq!(mesh.element_ids, [1, 2, 3]);
    assert_eq!((mesh.node_sets[0].id, mesh.node_sets[0].nodes.as_slice()), (31, [0, 15].as_slice()));
    let results = Results::open(&path).unwrap();
    assert_eq!(results.times(), [0.0, 0.5]);
    assert_eq!(results.nodal_names(), ["DISPLX", "DISPLY"]);
    let expected: Vec<f64> = (0..16).map(|n| 100.0 + 10.0 + f64::from(n) / 4.0).collect();
    assert_eq!(results.nodal("DisplY", 1).unwrap(), expected);
    assert_eq!(results.global(1).unwrap(), [0.0; 0]);
}

#[test]
fn cdf5_files_with_64_bit_integers_are_read() {
    let mesh = read_mesh(&fixture("cdf5_int64.g")).unwrap();
    check_cubes(&mesh);
    assert_eq!(mesh.node_ids[1], 10_000_000_003);
    assert_eq!(mesh.element_ids, [70, 50, 90_000_000_000]);
    assert_eq!((mesh.side_sets[0].id, mesh.side_sets[0].sides.as_slice()), (200, [(0, 4), (2, 5)].as_slice()));
}

#[test]
fn compressed_netcdf4_files_with_long_names_are_read() {
    let mesh = read_mesh(&fixture("netcdf4_compressed.g")).unwrap();
    check_cubes(&mesh);
    assert_eq!(mesh.blocks[0].name, "a block with a name of more than thirty-two characters");
    assert_eq!(mesh.blocks[1].name, "");
}

#[test]
fn null_blocks_and_sets_are_kept_empty() {
    let mesh = read_mesh(&fixture("null_block.g")).unwrap();
    check_cubes(&mesh);
    let ids: Vec<_> = mesh.blocks.iter().map(|b| (b.id, b.name.as_str(), b.len())).collect();
    assert_eq!(ids, [(10, "first", 2), (77, "", 0), (4, "third", 1)]);
    let sets: Vec<_> = mesh.node_sets.iter().map(|s| (s.id, s.nodes.as_slice())).collect();
    assert_eq!(sets, [(5, [].as_slice()), (3, [1, 3, 5].as_slice())]);
    assert_eq!((mesh.side_sets[0].id, mesh.side_sets[0].sides.len()), (9, 0));
    assert_eq!(mesh.qa[1], ["NEM_SPREAD", "7.01", "2024/01/03", "01:02:03"]);
}

#[test]
fn a_variable_that_a_block_lacks_is_nan_there() {
    let results = Results::open(&fixture("partial_truth.exo")).unwrap();
    assert_eq!(results.info(), ["first line", "second line"]);
    assert_eq!(results.global(0).unwrap(), [5.0]);
    assert_eq!(results.element("SIGXX", 1).unwrap(), [11.0, 12.0, 13.0]);
    let eqps = results.element("EQPS", 1).unwrap();
    assert!(eqps[0].is_nan() && eqps[1].is_nan());
    assert_eq!(eqps[2], 0.5);
}

#[test]
fn the_least_that_a_mesh_can_be_is_read() {
    let mesh = read_mesh(&fixture("smallest.g")).unwrap();
    assert_eq!((mesh.blocks[0].id, mesh.element_count(), mesh.element_ids.as_slice()), (1, 3, [1, 2, 3].as_slice()));
}

#[test]
fn a_file_that_cannot_be_written_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let error = write_mesh(&folder.path().join("none/two.g"), &two_block_mesh()).unwrap_err().to_string();
    assert!(error.starts_with("cannot write ") && error.contains("No such file or directory"), "{error}");
}
