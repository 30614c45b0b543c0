//! What each rank gets for its search: points at their owner ranks, and all faces and edges that these may meet.

use crate::comm::Communicator;
use crate::partition::dynamic::{Boxes as Regions, Parcels, Records};
use crate::solver::contact::contact_nodes::ContactNodes;
use crate::solver::contact::layout::Layout;
use crate::solver::contact::search::Box3;
use crate::solver::contact::search::neighbourhood::{self, Boxes};

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
        // One kind after the other, each let go of as soon as it is on its way: a search takes the most memory of all that a step does.
        let (points, _) = sorted::<0>(sent(neighbourhood::point_boxes(layout, contact_nodes), owner_rank, size, comm));
        let edges = neighbourhood::edge_boxes(edges.iter().copied(), layout, contact_nodes);
        let first_owner = |edge: u32| owner_rank(layout.edges[edge as usize].ends[0]);
        let (own_edges, _) = sorted::<0>(sent(edges.clone(), first_owner, size, comm));
        let all = points.boxes.iter().chain(&own_edges.boxes).filter(|of| of.is_sound());
        let all = all.fold(Box3::empty(), |all, one| all.joined(one));
        let own_edges = own_edges.ids;
        let regions = Regions::gather(all.low, all.high, comm);
        let mut ranks = Vec::new();
        let mut parcels = Parcels::new(size, 8);
        for (&edge, of) in edges.ids.iter().zip(&edges.boxes) {
            regions.ranks_meeting(of.low, of.high, &mut ranks);
            let ([a, b, c, d, e, f], [g, h]) = (flat(of), layout.edges[edge as usize].ends.map(owner_rank));
            let values = [a, b, c, d, e, f, g, h];
            ranks.iter().for_each(|&rank| parcels.add(rank, edge, &values));
        }
        drop(edges);
        let (edges, edge_owners) = sorted(parcels.exchange(comm));
        let faces = neighbourhood::face_boxes(faces.iter().copied(), layout, contact_nodes);
        let mut parcels = Parcels::new(size, 10);
        for (&face, of) in faces.ids.iter().zip(&faces.boxes) {
            regions.ranks_meeting(of.low, of.high, &mut ranks);
            let ([a, b, c, d, e, f], [g, h, i, j]) = (flat(of), layout.faces.corners[face as usize].map(owner_rank));
            let values = [a, b, c, d, e, f, g, h, i, j];
            ranks.iter().for_each(|&rank| parcels.add(rank, face, &values));
        }
        drop(faces);
        let (faces, face_owners) = sorted(parcels.exchange(comm));
        Regional { points, faces, edges, own_edges, face_owners, edge_owners }
    }
}

/// Sends each box to its rank; what has come instead. All ranks call it.
fn sent(boxes: Boxes, rank: impl Fn(u32) -> f64, size: usize, comm: &mut dyn Communicator) -> Records {
    let mut parcels = Parcels::new(size, 6);
    boxes.ids.iter().zip(&boxes.boxes).for_each(|(&id, of)| parcels.add(rank(id) as u32, id, &flat(of)));
    drop(boxes);
    parcels.exchange(comm)
}

fn flat(of: &Box3) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (of.low, of.high);
    [a, b, c, d, e, f]
}

/// Boxes that have come, by number, and the owner ranks behind each box.
fn sorted<const OWNERS: usize>(records: Records) -> (Boxes, Vec<[u32; OWNERS]>) {
    let (mut boxes, mut owners) = (Boxes::with_capacity(records.len()), Vec::with_capacity(records.len()));
    for i in records.by_id() {
        let v = records.values(i as usize);
        boxes.push(records.ids[i as usize], Box3 { low: [v[0], v[1], v[2]], high: [v[3], v[4], v[5]] });
        owners.push(std::array::from_fn(|owner| v[6 + owner] as u32));
    }
    (boxes, owners)
}
