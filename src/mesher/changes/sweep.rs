//! Solids of two-dimensional meshes: turned about the y axis, or drawn out along z.

use crate::mesh::{Block, Dimension, Mesh, NodeSet, SideSet};

/// How a plane becomes a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sweep {
    /// Turned about the y axis by so many degrees, 360 at most, from the x axis towards z.
    Revolve(f64),
    /// Drawn out to this z.
    Extrude(f64),
}

/// What a sweep has made.
#[derive(Debug, Clone, PartialEq)]
pub struct Swept {
    /// The solid: blocks and sets have the numbers of those they come from.
    pub mesh: Mesh,
    /// Numbers of the node sets and side sets at the beginning and at the end; none of a closed ring.
    pub ends: Option<[i64; 2]>,
}

/// The solid of so many layers of hexahedra that a two-dimensional mesh sweeps; `None` of a mesh of space.
///
/// Nodes on the axis of revolution are one in all layers, and elements there wedges. Node sets hold the nodes of all layers,
/// side sets the faces that their edges sweep; the faces at both ends are sets of their own.
pub fn sweep(plane: &Mesh, sweep: Sweep, layers: usize) -> Option<Swept> {
    if plane.dimension != Dimension::Two || layers == 0 {
        return None;
    }
    let closed = matches!(sweep, Sweep::Revolve(angle) if angle >= 360.0);
    let rings = if closed { layers } else { layers + 1 };
    let positions = match sweep {
        Sweep::Revolve(_) => crate::mesh::plane::on_axis(plane),
        Sweep::Extrude(_) => plane.coordinates.clone(),
    };
    let mut mesh = Mesh { title: plane.title.clone(), qa: plane.qa.clone(), ..Mesh::default() };
    // Number of each node in each ring.
    let mut numbers: Vec<Vec<u32>> = Vec::with_capacity(rings);
    for ring in 0..rings {
        let part = ring as f64 / layers as f64;
        let of_ring = positions.iter().enumerate().map(|(node, &[x, y, _])| {
            if ring > 0 && x == 0.0 && matches!(sweep, Sweep::Revolve(_)) {
                return numbers[0][node];
            }
            mesh.coordinates.push(match sweep {
                Sweep::Extrude(length) => [x, y, if ring == layers { length } else { length * part }],
                Sweep::Revolve(angle) => {
                    let [c, s] = crate::mesher::turn::direction(angle * part / 90.0);
                    [x * c, y, x * s]
                }
            });
            mesh.coordinates.len() as u32 - 1
        });
        let of_ring = of_ring.collect();
        numbers.push(of_ring);
    }
    let node = |ring: usize, node: u32| numbers[ring % rings][node as usize];
    // Elements follow each other layer by layer within their blocks.
    let mut places: Vec<[usize; 2]> = Vec::with_capacity(plane.element_count());
    let mut first = 0;
    for block in &plane.blocks {
        let hexahedra = (0..layers).flat_map(|layer| {
            block.elements().map(move |nodes| std::array::from_fn(|corner| node(layer + corner / 4, nodes[corner % 4])))
        });
        mesh.blocks.push(Block { name: block.name.clone(), ..Block::hexahedra_of(block.id, hexahedra) });
        places.extend((0..block.len()).map(|place| [first + place, block.len()]));
        first += layers * block.len();
    }
    let element = |element: u32, layer: usize| {
        let [first, stride] = places[element as usize];
        (first + layer * stride) as u32
    };
    for set in &plane.node_sets {
        let all = (0..rings).flat_map(|ring| set.nodes.iter().map(move |&n| node(ring, n)));
        mesh.node_sets.push(NodeSet { id: set.id, name: set.name.clone(), nodes: sorted(all) });
    }
    for set in &plane.side_sets {
        let all = (0..layers).flat_map(|layer| set.sides.iter().map(move |&(e, side)| (element(e, layer), side)));
        mesh.side_sets.push(SideSet { id: set.id, name: set.name.clone(), sides: sorted(all) });
    }
    let ends = (!closed).then(|| {
        let used = plane.node_sets.iter().map(|set| set.id).chain(plane.side_sets.iter().map(|set| set.id));
        let last = used.max().unwrap_or(0);
        [last + 1, last + 2]
    });
    for ((id, ring), (layer, side)) in ends.into_iter().flatten().zip([0, layers]).zip([(0, 4), (layers - 1, 5)]) {
        let nodes = sorted((0..positions.len() as u32).map(|n| node(ring, n)));
        mesh.node_sets.push(NodeSet { id, name: String::new(), nodes });
        let sides = (0..places.len() as u32).map(|e| (element(e, layer), side)).collect();
        mesh.side_sets.push(SideSet { id, name: String::new(), sides });
    }
    mesh.node_ids = (1..=mesh.coordinates.len() as i64).collect();
    mesh.element_ids = (1..=mesh.element_count() as i64).collect();
    Some(Swept { mesh, ends })
}

fn sorted<T: Ord>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut items: Vec<T> = items.collect();
    items.sort_unstable();
    items.dedup();
    items
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::check::{geometry, hexahedron_volume};
    use crate::mesher::make;

    fn volume(mesh: &Mesh) -> f64 {
        mesh.hexahedra().map(|nodes| hexahedron_volume(&nodes.map(|n| mesh.coordinates[n as usize]))).sum()
    }

    #[test]
    fn a_rectangle_becomes_a_box_and_a_cylinder() {
        let plane =
            make("RECTANGLE, 7, 0., 1., 2., 3., 4, 3\nNODE SET PLANE, 1, Y, 1.\nSIDE SET FACE, 5, 7, RIGHT\n", "t", 1)
                .expect("a mesh");
        let Swept { mesh, ends } = sweep(&plane, Sweep::Extrude(0.5), 2).expect("a solid");
        assert!(geometry(&mesh).is_empty() && (volume(&mesh) - 3.0).abs() < 1e-12);
        assert_eq!((ends, mesh.element_count(), mesh.blocks[0].id), (Some([6, 7]), 24, 7));
        assert_eq!((mesh.node_sets[0].nodes.len(), mesh.side_sets[0].sides.len()), (15, 6));
        assert!(mesh.side_set_nodes(7).iter().all(|&n| mesh.coordinates[n as usize][2] == 0.5));
        assert!(mesh.side_set_nodes(5).iter().all(|&n| mesh.coordinates[n as usize][0] == 2.0));
        let quarter = sweep(&plane, Sweep::Revolve(90.0), 24).expect("a solid").mesh;
        assert!(geometry(&quarter).is_empty(), "{:?}", geometry(&quarter).list());
        let exact = std::f64::consts::PI * 3.0;
        assert!((volume(&quarter) / exact - 1.0).abs() < 1e-3);
        let whole = sweep(&plane, Sweep::Revolve(360.0), 60).expect("a solid");
        assert_eq!((whole.ends, whole.mesh.coordinates.len()), (None, 4 + 60 * 16));
        assert!(sweep(&whole.mesh, Sweep::Extrude(1.0), 1).is_none());
    }
}
