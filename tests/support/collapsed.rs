//! Meshes of hexahedra cut into wedges, pyramids and tetrahedra, which are hexahedra with coinciding corners.

use std::cell::Cell;
use urto::mesh::{HEX_SIDES, Mesh};

/// Each hexahedron becomes two wedges, one above the other's diagonal seen along the third axis.
pub fn wedges(mesh: &Mesh) -> Mesh {
    cut(mesh, |[a, b, c, d, e, f, g, h], _| vec![[a, b, c, c, e, f, g, g], [a, c, d, d, e, g, h, h]])
}

/// Each hexahedron becomes six pyramids around its centre.
pub fn pyramids(mesh: &Mesh) -> Mesh {
    cut(mesh, around_centre)
}

fn around_centre(hex: [u32; 8], new_node: &mut dyn FnMut(&[u32]) -> u32) -> Vec<[u32; 8]> {
    let apex = new_node(&hex);
    let base = |side: [usize; 4]| side.map(|corner| hex[corner]);
    HEX_SIDES.map(base).map(|[p, q, r, s]| [s, r, q, p, apex, apex, apex, apex]).to_vec()
}

/// Every so many hexahedra, the first one among them, one becomes six pyramids; all others stay.
pub fn pyramids_here_and_there(mesh: &Mesh, every: usize) -> Mesh {
    let seen = Cell::new(0);
    cut(mesh, |hex, new_node| {
        seen.set(seen.get() + 1);
        if seen.get() % every == 1 { around_centre(hex, new_node) } else { vec![hex] }
    })
}

/// Each hexahedron becomes six tetrahedra around the diagonal from its first corner to the seventh, as its neighbours
/// in a regular box do: their triangles meet.
pub fn tetrahedra(mesh: &Mesh) -> Mesh {
    // The ways along edges from one end to the other; every other one is turned so that its volume is positive.
    const WAYS: [[usize; 2]; 6] = [[1, 2], [2, 3], [3, 7], [7, 4], [4, 5], [5, 1]];
    cut(mesh, |hex, _| {
        let tetrahedron = |[i, j]: [usize; 2]| {
            let (a, b, c, d) = (hex[0], hex[i], hex[j], hex[6]);
            [a, b, c, c, d, d, d, d]
        };
        WAYS.map(tetrahedron).to_vec()
    })
}

/// Replaces each element; `cells` may add nodes at the mean of others. Sets are not kept.
fn cut(mesh: &Mesh, cells: impl Fn([u32; 8], &mut dyn FnMut(&[u32]) -> u32) -> Vec<[u32; 8]>) -> Mesh {
    let mut made = mesh.clone();
    (made.side_sets, made.element_ids) = (Vec::new(), Vec::new());
    let coordinates = &mut made.coordinates;
    let mut add = |around: &[u32]| {
        let sum = around.iter().fold([0.0; 3], |sum, &node| {
            let x = coordinates[node as usize];
            [0, 1, 2].map(|i| sum[i] + x[i])
        });
        coordinates.push(sum.map(|x| x / around.len() as f64));
        coordinates.len() as u32 - 1
    };
    for block in &mut made.blocks {
        let cut: Vec<[u32; 8]> = block.hexahedra().iter().flat_map(|hex| cells(*hex, &mut add)).collect();
        block.nodes = cut.into_flattened();
    }
    made.node_ids = (1..=made.coordinates.len() as i64).collect();
    made.element_ids = (1..=made.element_count() as i64).collect();
    made
}
