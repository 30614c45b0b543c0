//! Small meshes and results that several tests share.
#![allow(dead_code)]

use urto::exodus::ResultsHeader;
use urto::mesh::{Block, Mesh, NodeSet, SideSet};

/// Three unit cubes in a row along x; the first two are block 10, the last is block 4. Node and element numbers
/// are not in order, and every kind of set is there.
pub fn two_block_mesh() -> Mesh {
    let coordinates: Vec<[f64; 3]> = (0..4)
        .flat_map(|i| [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(y, z)| [f64::from(i), y, z]))
        .collect();
    let element = |i: u32| std::array::from_fn(|corner| 4 * i + corner as u32);
    Mesh {
        title: "three cubes".into(),
        node_ids: (0..16).map(|n| 100 - n).collect(),
        element_ids: vec![7, 5, 9],
        coordinates: coordinates.into(),
        blocks: vec![
            Block { name: "bar".into(), ..Block::hexahedra_of(10, [element(0), element(1)]) },
            Block::hexahedra_of(4, [element(2)]),
        ],
        node_sets: vec![NodeSet { id: 1, name: "foot".into(), nodes: vec![0, 1, 2, 3] }],
        side_sets: vec![SideSet { id: 200, name: "ends".into(), sides: vec![(0, 4), (2, 5)] }],
        qa: vec![["mesher", "1.0", "1994-06-01", "12:00:00"].map(String::from)],
        ..Mesh::default()
    }
}

/// A header with two variables of every kind and a deck with a long and an empty line.
pub fn results_header(mesh: &Mesh) -> ResultsHeader<'_> {
    let names = |list: &[&str]| list.iter().map(|&name| name.to_string()).collect();
    ResultsHeader {
        mesh,
        title: "a run".into(),
        global: names(&["KE", "IE"]),
        nodal: names(&["DISPLX", "DISPLY", "DISPLZ"]),
        element: names(&["EQPS", "SIGXX"]),
        qa: ["urto", "0.1.0", "2026-01-01", "00:00:00"].map(String::from),
        info: vec!["TITLE".into(), "x".repeat(100), String::new(), "EXIT".into()],
    }
}

/// One state: time, globals, nodal arrays, element arrays.
pub type State = (f64, Vec<f64>, Vec<Vec<f64>>, Vec<Vec<f64>>);

/// Values that tell state, variable and entity apart.
pub fn written_state(mesh: &Mesh, state: usize) -> State {
    let value = |variable: usize, entity: usize| state as f64 + variable as f64 / 10.0 + entity as f64 / 1e6 + 0.01;
    let array = |variable: usize, count: usize| (0..count).map(|entity| value(variable, entity)).collect::<Vec<f64>>();
    (
        1e-3 * state as f64,
        array(1, 2),
        (0..3).map(|v| array(2 + v, mesh.coordinates.len())).collect(),
        (0..2).map(|v| array(5 + v, mesh.element_count())).collect(),
    )
}
