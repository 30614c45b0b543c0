//! Mutated meshes by the hundred thousand: whatever the arrays or the bytes say, the reader answers with a mesh or
//! with a message.

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use urto::exodus::read_mesh;
use urto::exodus::tables::{BlockTable, NodeSetTable, SideSetTable, Tables};
use urto::mesh::check;

use crate::raw::Raw;

/// The arrays of two cubes.
fn good_tables() -> Tables {
    let corner = |n: usize| [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)][n % 4];
    let axis = |pick: fn(usize, (f64, f64)) -> f64| (0..12).map(|n| pick(n, corner(n))).collect();
    let block = |id, first: i64| BlockTable {
        id,
        element_type: "HEX8".into(),
        nodes_per_element: 8,
        connectivity: (first..first + 8).collect(),
        ..BlockTable::default()
    };
    Tables {
        dimensions: 3,
        coordinates: [axis(|n, _| (n / 4) as f64), axis(|_, c| c.0), axis(|_, c| c.1)],
        node_count: Some(12),
        element_count: Some(2),
        blocks: vec![block(1, 1), block(2, 5)],
        node_sets: vec![NodeSetTable { id: 1, nodes: vec![1, 2, 3, 4], ..NodeSetTable::default() }],
        side_sets: vec![SideSetTable { id: 1, elements: vec![1, 2], sides: vec![5, 6], ..SideSetTable::default() }],
        node_ids: Some((1..=12).collect()),
        element_ids: Some(vec![1, 2]),
        ..Tables::default()
    }
}

/// One change to one array.
#[derive(Debug, Clone)]
enum Mutation {
    Integer { array: usize, index: usize, value: i64 },
    Real { axis: usize, index: usize, value: f64 },
    Length { array: usize, length: usize },
    Count { which: usize, value: usize },
    Type { block: usize, name: String },
    Drop { which: usize },
}

fn integer() -> impl Strategy<Value = i64> {
    let special = [0, 1, -1, 12, 13, 6, 7, i64::MIN, i64::MAX, 1 << 31, 1 << 32, u32::MAX.into()];
    prop_oneof![4 => 0i64..20, 2 => proptest::sample::select(special.to_vec()), 1 => any::<i64>()]
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let types = ["HEX", "hex8", "HEX20", "", "H", "ΗΕΧ", "TETRA", "NULL"];
    prop_oneof![
        (0..8usize, 0..20usize, integer()).prop_map(|(array, index, value)| Mutation::Integer { array, index, value }),
        (0..3usize, 0..12usize, prop_oneof![any::<f64>(), -2.0..3.0]).prop_map(|(axis, index, value)| Mutation::Real {
            axis,
            index,
            value
        }),
        (0..11usize, 0..20usize).prop_map(|(array, length)| Mutation::Length { array, length }),
        (0..5usize, 0..28usize).prop_map(|(which, value)| Mutation::Count { which, value }),
        (0..2usize, proptest::sample::select(types.map(String::from).to_vec()))
            .prop_map(|(block, name)| Mutation::Type { block, name }),
        (0..6usize).prop_map(|which| Mutation::Drop { which }),
    ]
}

impl Mutation {
    fn apply(self, tables: &mut Tables) {
        match self {
            Mutation::Integer { array, index, value } => {
                if let Some(place) = integers(tables, array).and_then(|list| list.get_mut(index)) {
                    *place = value;
                }
            }
            Mutation::Real { axis, index, value } => {
                if let Some(place) = tables.coordinates[axis].get_mut(index) {
                    *place = value;
                }
            }
            Mutation::Length { array, length } if array < 3 => tables.coordinates[array].resize(length, 0.5),
            Mutation::Length { array, length } => {
                if let Some(list) = integers(tables, array - 3) {
                    list.resize(length, 1);
                }
            }
            Mutation::Count { which: 0, value } => tables.dimensions = value,
            Mutation::Count { which: 1, value } => tables.node_count = Some(value),
            Mutation::Count { which: 2, value } => tables.element_count = Some(value),
            Mutation::Count { which, value } => tables.blocks[which - 3].nodes_per_element = value,
            Mutation::Type { block, name } => tables.blocks[block].element_type = name,
            Mutation::Drop { which: 0 } => tables.node_count = None,
            Mutation::Drop { which: 1 } => tables.element_count = None,
            Mutation::Drop { which: 2 } => tables.node_ids = None,
            Mutation::Drop { which: 3 } => tables.element_ids = None,
            Mutation::Drop { which: 4 } => tables.node_sets.push(tables.node_sets[0].clone()),
            Mutation::Drop { .. } => tables.blocks.swap(0, 1),
        }
    }
}

fn integers(tables: &mut Tables, array: usize) -> Option<&mut Vec<i64>> {
    match array {
        0 | 1 => Some(&mut tables.blocks[array].connectivity),
        2 => Some(&mut tables.node_sets[0].nodes),
        3 => Some(&mut tables.side_sets[0].elements),
        4 => Some(&mut tables.side_sets[0].sides),
        5 => tables.node_ids.as_mut(),
        _ => tables.element_ids.as_mut(),
    }
}

/// The same cases in every run.
fn runner(cases: u32) -> TestRunner {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

#[test]
fn mutated_arrays_give_a_sound_mesh_or_a_message() {
    let strategy = proptest::collection::vec(mutation(), 1..4);
    let result = runner(100_000).run(&(strategy,), |(mutations,)| {
        let mut tables = good_tables();
        mutations.into_iter().for_each(|m| m.apply(&mut tables));
        match tables.assemble() {
            Ok(mesh) => {
                let nodes = mesh.coordinates.len();
                prop_assert!(mesh.elements().all(|(_, e)| e.iter().all(|&n| (n as usize) < nodes)));
                prop_assert_eq!(mesh.node_ids.len(), nodes);
                prop_assert_eq!(mesh.element_ids.len(), mesh.element_count());
                let elements = mesh.element_count();
                prop_assert!(
                    mesh.side_sets.iter().flat_map(|s| &s.sides).all(|&(e, s)| (e as usize) < elements && s < 6)
                );
                check::geometry(&mesh);
                check::unreferenced_nodes(&mesh);
            }
            Err(problems) => prop_assert!(!problems.is_empty() && problems.list().iter().all(|p| !p.what.is_empty())),
        }
        Ok(())
    });
    result.unwrap();
}

/// Set for the process that reads mutated files; its value is the folder to use.
const FOLDER: &str = "URTO_FUZZ_FOLDER";

/// Not a test by itself: reads files with changed bytes. A crash inside the C libraries would end this process only.
#[test]
fn process_that_reads_mutated_files() {
    let Ok(folder) = std::env::var(FOLDER) else { return };
    let folder = Path::new(&folder);
    let path = folder.join("can.g");
    Raw::cubes().write(&path);
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let others = ["cdf5_int64.g", "classic_packed.exo", "genesis_little_4.g", "genesis_big_8.g"];
    let mut seeds = vec![fs::read(&path).unwrap()];
    seeds.extend(others.map(|name| fs::read(fixtures.join(name)).unwrap()));
    let change = (0..5usize, any::<prop::sample::Index>(), any::<u8>(), 0..4u8);
    let strategy = proptest::collection::vec(change, 1..5);
    let run = runner(8_000).run(&(strategy,), |(changes,)| {
        let mut bytes = seeds[changes[0].0].clone();
        for (_, index, value, kind) in changes {
            let place = index.index(bytes.len());
            match kind {
                0 => bytes.truncate(place.max(4)),
                1 => bytes[place] = 0xFF,
                _ => bytes[place] = value,
            }
        }
        fs::write(&path, bytes).unwrap();
        if let Err(error) = read_mesh(&path) {
            prop_assert!(error.to_string().starts_with("error: "));
        }
        Ok(())
    });
    run.unwrap();
}

#[test]
fn mutated_files_give_a_mesh_or_a_message() {
    let folder = tempfile::tempdir().unwrap();
    let output = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "fuzz::process_that_reads_mutated_files", "--nocapture"])
        .env(FOLDER, folder.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}\n{}", output.status, String::from_utf8_lossy(&output.stderr));
}
