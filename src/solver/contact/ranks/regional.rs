//! What each rank gets for its search: points at their owner ranks, and all faces and edges that these may meet.

use crate::comm::Communicator;
use crate::partition::dynamic::{Boxes as Regions, Parcels, Records};
use crate::solver::contact::contact_nodes::ContactNodes;
use crate::solver::contact::layout::Layout;
use crate::solver::contact::search::Box3;
use crate::solver::contact::search::neighbourhood::{Boxes, Extents};

/// What has come to this rank for its search.
pub struct Regional {
    pub points: Boxes,
    pub faces: Boxes,
    pub edges: Boxes,
    pub own_edges: Vec<u32>,
    /// Owner ranks of the corners of each face.
    pub face_owners: Vec<[u32; 4]>,
    /// Owner ranks of the ends of each edge.
    pub edge_owners: Vec<[u32; 2]>,
}

impl Regional {
    /// Sends points to their owner ranks, and faces and edges to every owner rank whose points they may meet. `faces` and `edges`
    /// are those of elements that are here. All ranks call it.
    pub fn gather(
        (faces, edges): (&[u32], &[u32]),
        layout: &Layout,
        contact_nodes: &ContactNodes,
        comm: &mut dyn Communicator,
    ) -> Regional {
        let size = comm.size();
        let owner_rank = |point: u32| {
            f64::from(contact_nodes.of(point).map_or(0, |contact_node| contact_nodes.owner_ranks[contact_node]))
        };
        let extents = Extents::of_search(layout, contact_nodes);
        let own = extents.points();
        let edges = extents.edges(edges.iter().copied());
        let faces = extents.faces(faces.iter().copied());
        let [mut to_owner, mut edges_to_owner] = [6, 6].map(|width| Parcels::new(size, width));
        for (&point, of) in own.ids.iter().zip(&own.boxes) {
            to_owner.add(owner_rank(point) as u32, point, &flat(of));
        }
        for (&edge, of) in edges.ids.iter().zip(&edges.boxes) {
            edges_to_owner.add(owner_rank(layout.edges[edge as usize].ends[0]) as u32, edge, &flat(of));
        }
        let (points, _) = sorted(to_owner.exchange(comm));
        let (own_edges, _) = sorted(edges_to_owner.exchange(comm));
        let all = points.boxes.iter().chain(&own_edges.boxes).filter(|of| of.is_sound());
        let all = all.fold(Box3::empty(), |all, one| all.joined(one));
        let regions = Regions::gather(all.low, all.high, comm);
        let [mut face_parcels, mut edge_parcels] = [10, 8].map(|width| Parcels::new(size, width));
        let mut ranks = Vec::new();
        for (&face, of) in faces.ids.iter().zip(&faces.boxes) {
            regions.ranks_meeting(of.low, of.high, &mut ranks);
            let ([a, b, c, d, e, f], [g, h, i, j]) = (flat(of), layout.faces.corners[face as usize].map(owner_rank));
            let values = [a, b, c, d, e, f, g, h, i, j];
            ranks.iter().for_each(|&rank| face_parcels.add(rank, face, &values));
        }
        for (&edge, of) in edges.ids.iter().zip(&edges.boxes) {
            regions.ranks_meeting(of.low, of.high, &mut ranks);
            let ([a, b, c, d, e, f], [g, h]) = (flat(of), layout.edges[edge as usize].ends.map(owner_rank));
            let values = [a, b, c, d, e, f, g, h];
            ranks.iter().for_each(|&rank| edge_parcels.add(rank, edge, &values));
        }
        let (faces, face_owners) = sorted(face_parcels.exchange(comm));
        let (edges, edge_owners) = sorted(edge_parcels.exchange(comm));
        Regional {
            points,
            faces,
            edges,
            own_edges: own_edges.ids,
            face_owners: face_owners.chunks_exact(4).map(|v| [0, 1, 2, 3].map(|i| v[i] as u32)).collect(),
            edge_owners: edge_owners.chunks_exact(2).map(|v| [0, 1].map(|i| v[i] as u32)).collect(),
        }
    }
}

fn flat(of: &Box3) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (of.low, of.high);
    [a, b, c, d, e, f]
}

/// Boxes that have come, by number, and the numbers behind each box.
fn sorted(records: Records) -> (Boxes, Vec<f64>) {
    let (mut boxes, mut rest) = (Boxes::default(), Vec::new());
    for i in records.by_id() {
        let v = records.values(i as usize);
        boxes.push(records.ids[i as usize], Box3 { low: [v[0], v[1], v[2]], high: [v[3], v[4], v[5]] });
        rest.extend_from_slice(&v[6..]);
    }
    (boxes, rest)
}
