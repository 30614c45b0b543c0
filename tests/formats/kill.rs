//! A run killed at any instant leaves a results file that opens, and every state it lists is whole.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::support::{results_header, two_block_mesh, written_state};
use urto::exodus::{Results, ResultsWriter};
use urto::mesh::{Block, Mesh};

/// Set for the process that writes until it is killed; its value is the file and the kind of mesh.
const FILE: &str = "URTO_KILL_TEST_FILE";
const MESH: &str = "URTO_KILL_TEST_MESH";

/// A mesh whose states are larger than any buffer on the way to the disk.
fn large_mesh() -> Mesh {
    const N: u32 = 25;
    let node = |i: u32, j: u32, k: u32| (i * (N + 1) + j) * (N + 1) + k;
    let range = || 0..=N;
    let triples = range().flat_map(|i| range().flat_map(move |j| range().map(move |k| [i, j, k])));
    let coordinates: Vec<[f64; 3]> = triples.clone().map(|p| p.map(f64::from)).collect();
    let inner = triples.filter(|p| p.iter().all(|&n| n < N));
    let connectivity: Vec<[u32; 8]> = inner
        .map(|[i, j, k]| {
            let face = |k| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
            let ([a, b, c, d], [e, f, g, h]) = (face(k), face(k + 1));
            [a, b, c, d, e, f, g, h]
        })
        .collect();
    Mesh {
        node_ids: (1..).take(coordinates.len()).collect(),
        element_ids: (1..).take(connectivity.len()).collect(),
        coordinates: coordinates.into(),
        blocks: vec![Block::hexahedra_of(1, connectivity)],
        qa: two_block_mesh().qa,
        ..Mesh::default()
    }
}

fn mesh(kind: &str) -> Mesh {
    if kind == "large" { large_mesh() } else { two_block_mesh() }
}

/// Not a test by itself: the process that the tests below start and kill.
#[test]
fn process_that_writes_until_killed() {
    let (Ok(file), Ok(kind)) = (std::env::var(FILE), std::env::var(MESH)) else { return };
    let mesh = mesh(&kind);
    let mut writer = ResultsWriter::create(Path::new(&file), &results_header(&mesh)).unwrap();
    for number in 0..1_000_000 {
        let (time, globals, nodal, element) = written_state(&mesh, number);
        writer.write_state(time, &globals, &nodal, &element).unwrap();
    }
}

fn start(file: &Path, kind: &str) -> Child {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", "kill::process_that_writes_until_killed"]).env(FILE, file).env(MESH, kind);
    command.stdout(Stdio::null()).spawn().unwrap()
}

/// Checks the last `depth` states of the file and returns how many states it lists.
fn check(file: &Path, mesh: &Mesh, depth: usize) -> usize {
    let results = Results::open(file).unwrap();
    let count = results.times().len();
    for number in count.saturating_sub(depth)..count {
        let (time, globals, nodal, element) = written_state(mesh, number);
        assert_eq!(results.times()[number], time);
        assert_eq!(results.global(number).unwrap(), globals);
        for (name, expected) in results.nodal_names().iter().zip(&nodal) {
            assert!(&results.nodal(name, number).unwrap() == expected, "state {number}, {name}");
        }
        for (name, expected) in results.element_names().iter().zip(&element) {
            assert!(&results.element(name, number).unwrap() == expected, "state {number}, {name}");
        }
    }
    count
}

fn kill_at_many_moments(kind: &str) {
    let folder = tempfile::tempdir().unwrap();
    let mesh = mesh(kind);
    let mut states = 0;
    for attempt in 0..10u64 {
        let file = folder.path().join(format!("run{attempt}.e"));
        let mut child = start(&file, kind);
        let patience = Instant::now() + Duration::from_secs(60);
        while !file.exists() && Instant::now() < patience {
            sleep(Duration::from_micros(200));
        }
        // The file is complete as soon as it has its name, and may be read while it grows.
        check(&file, &mesh, 3);
        sleep(Duration::from_micros(7_919 * attempt % 40_000));
        check(&file, &mesh, 3);
        child.kill().unwrap();
        child.wait().unwrap();
        states += check(&file, &mesh, 10);
        std::fs::remove_file(file).unwrap();
    }
    assert!(states > 0, "no process lived long enough to write a state");
}

#[test]
fn a_killed_run_with_small_states_leaves_whole_states() {
    kill_at_many_moments("small");
}

#[test]
fn a_killed_run_with_large_states_leaves_whole_states() {
    kill_at_many_moments("large");
}
