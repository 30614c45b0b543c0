//! What tests of decks share: a mesh, a deck that says little, and what a deck means.

use urto::{
    deck::Source,
    mesh::{Block, Mesh, NodeSet, SideSet},
    model::{Problem, examine},
};

/// Two blocks of 1 × 1 × 2 hexahedra along z: node sets 1 (x = 0), 2 (y = 0), 3 (z = 0), 4 (top) and an empty 9;
/// side sets 100 (bottom) and 200 (top).
pub fn two_blocks() -> Mesh {
    let coordinates: Vec<[f64; 3]> =
        (0..20).map(|i| [f64::from(i % 2), f64::from(i / 2 % 2), f64::from(i / 4)]).collect();
    let hex = |layer: u32| [0, 1, 3, 2, 4, 5, 7, 6].map(|corner| 4 * layer + corner);
    let nodes = |keep: fn([f64; 3]) -> bool| -> Vec<u32> {
        (0..20).filter(|&i| keep([f64::from(i % 2), f64::from(i / 2 % 2), f64::from(i / 4)])).collect()
    };
    let node_set = |id, nodes| NodeSet { id, name: String::new(), nodes };
    let side_set = |id, sides| SideSet { id, name: String::new(), sides };
    Mesh {
        blocks: vec![
            Block { name: "lower".into(), ..Block::hexahedra_of(1, [hex(0), hex(1)]) },
            Block::hexahedra_of(2, [hex(2), hex(3)]),
        ],
        node_sets: vec![
            node_set(1, nodes(|x| x[0] == 0.0)),
            node_set(2, nodes(|x| x[1] == 0.0)),
            node_set(3, nodes(|x| x[2] == 0.0)),
            node_set(4, nodes(|x| x[2] == 4.0)),
            node_set(9, Vec::new()),
        ],
        side_sets: vec![side_set(100, vec![(0, 4)]), side_set(200, vec![(3, 5)])],
        node_ids: (1..=20).collect(),
        element_ids: (1..=4).collect(),
        coordinates: coordinates.into(),
        ..Mesh::default()
    }
}

/// What a deck means that has no errors.
pub fn problem(text: &str) -> Problem {
    examine(Source::new("t.i", text), None).unwrap_or_else(|messages| panic!("{messages}"))
}
