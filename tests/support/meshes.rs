//! Boxes of hexahedra with sets, and the meshes of recipes.

use urto::mesh::{Block, HEX_SIDES, Mesh, NodeSet, SideSet};

/// A box from the origin, with sets: node sets 1 and 2 are the planes x = 0 and x = max, 3 both planes of y, 4 both
/// planes of z, 5 the plane z = 0; side sets 100 to 600 are the planes x = 0, x = max, y = 0, y = max, z = 0, z = max.
pub fn brick(cells: [usize; 3], size: [f64; 3]) -> Mesh {
    let mut mesh = box_of_cells(cells, size);
    let on = |axis: usize, at: f64| move |p: [f64; 3]| (p[axis] - at).abs() < 1e-9 * size[axis];
    add_node_set(&mut mesh, 1, on(0, 0.0));
    add_node_set(&mut mesh, 2, on(0, size[0]));
    add_node_set(&mut mesh, 3, |p| on(1, 0.0)(p) || on(1, size[1])(p));
    add_node_set(&mut mesh, 4, |p| on(2, 0.0)(p) || on(2, size[2])(p));
    add_node_set(&mut mesh, 5, on(2, 0.0));
    for (axis, id) in (0..3).zip([100, 300, 500]) {
        add_side_set(&mut mesh, id, on(axis, 0.0));
        add_side_set(&mut mesh, id + 100, on(axis, size[axis]));
    }
    mesh
}

/// A box from the origin, as block 1, without sets.
pub fn box_of_cells(cells: [usize; 3], size: [f64; 3]) -> Mesh {
    let [nx, ny, nz] = cells;
    let axis = |n: usize, length: f64| (0..=n).map(move |i| length * i as f64 / n as f64);
    let mut coordinates = Vec::new();
    for z in axis(nz, size[2]) {
        for y in axis(ny, size[1]) {
            coordinates.extend(axis(nx, size[0]).map(|x| [x, y, z]));
        }
    }
    let node = |i: usize, j: usize, k: usize| ((k * (ny + 1) + j) * (nx + 1) + i) as u32;
    let mut connectivity = Vec::new();
    for k in 0..nz {
        for j in 0..ny {
            for i in 0..nx {
                let layer = |k| [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)];
                let [[a, b, c, d], [e, f, g, h]] = [layer(k), layer(k + 1)];
                connectivity.push([a, b, c, d, e, f, g, h]);
            }
        }
    }
    of_one_block(coordinates, connectivity)
}

/// The mesh of a recipe's text.
#[track_caller]
pub fn recipe(text: &str) -> Mesh {
    urto::mesher::make(text, "recipe", 1).unwrap_or_else(|found| panic!("{}", found.render(false)))
}

/// A node set of all nodes at which `on` holds.
pub fn add_node_set(mesh: &mut Mesh, id: i64, on: impl Fn([f64; 3]) -> bool) {
    mesh.node_sets.push(NodeSet { id, name: String::new(), nodes: nodes_where(mesh, on) });
}

/// Nodes at which `on` holds.
pub fn nodes_where(mesh: &Mesh, on: impl Fn([f64; 3]) -> bool) -> Vec<u32> {
    (0..mesh.coordinates.len() as u32).filter(|&n| on(mesh.coordinates[n as usize])).collect()
}

/// A side set of all element faces with all four nodes where `on` holds.
pub fn add_side_set(mesh: &mut Mesh, id: i64, on: impl Fn([f64; 3]) -> bool) {
    let mut sides = Vec::new();
    for (element, nodes) in mesh.hexahedra().enumerate() {
        for (side, corners) in HEX_SIDES.iter().enumerate() {
            if corners.iter().all(|&c| on(mesh.coordinates[nodes[c] as usize])) {
                sides.push((element as u32, side as u8));
            }
        }
    }
    mesh.side_sets.push(SideSet { id, name: String::new(), sides });
}

fn of_one_block(coordinates: Vec<[f64; 3]>, connectivity: Vec<[u32; 8]>) -> Mesh {
    Mesh {
        title: "made by a test".into(),
        node_ids: (1..=coordinates.len() as i64).collect(),
        element_ids: (1..=connectivity.len() as i64).collect(),
        coordinates: coordinates.into(),
        blocks: vec![Block::hexahedra_of(1, connectivity)],
        ..Mesh::default()
    }
}
