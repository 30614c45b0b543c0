//! What each rank gets for its search: points at their owner ranks, all faces that these may meet, and edges that may cross.

use crate::comm::{Communicator, gather_for_all};
use crate::partition::dynamic::{Parcels, Records};
use crate::solver::contact::nodes::ContactNodes;
use crate::solver::contact::search::Box3;
use crate::solver::contact::search::neighbourhood::{self, Boxes};
use crate::solver::contact::search::occupancy::Occupancy;
use crate::solver::contact::surface::layout::Layout;

/// What has come to this rank for its search.
pub struct Regional {
    pub points: Boxes,
    pub faces: Boxes,
    pub edges: Boxes,
    /// Edges that stand out whose first ends are here, ascending.
    pub own_edges: Vec<u32>,
    /// Owner ranks of the corners of each face.
    pub face_owners: Vec<[u32; 4]>,
    /// Owner ranks of the points on which each edge hangs, see [`Edge::points`](crate::solver::contact::geometry::edges::Edge::points).
    pub edge_owners: Vec<[u32; 4]>,
}

impl Regional {
    /// Sends points to their owner ranks, faces to every rank whose points they may meet, and edges to every rank that has the first
    /// ends of edges that stand out and which they may cross. `faces` and `edges` are those of elements that are here. All ranks
    /// call it.
    pub fn gather(
        (faces, edges): (&[u32], &[u32]),
        layout: &Layout,
        contact_nodes: &ContactNodes,
        comm: &mut dyn Communicator,
    ) -> Regional {
        let owner_rank = |point: u32| {
            f64::from(contact_nodes.of(point).map_or(0, |contact_node| contact_nodes.owner_ranks[contact_node]))
        };
        // One kind after the other, each let go of as soon as it is on its way: a search takes the most memory of all that
        // a step does.
        let (points, _) = sorted::<0>(sent(neighbourhood::point_boxes(layout, contact_nodes), owner_rank, comm));
        let here = edges.iter().copied();
        let standing_out = neighbourhood::standing_out(here.clone(), layout, contact_nodes);
        let first_owner = |edge: u32| owner_rank(layout.edges[edge as usize].ends[0]);
        let (own_edges, _) = sorted::<0>(sent(standing_out, first_owner, comm));
        let occupied = occupied_by_all(&own_edges.boxes, comm);
        let own_edges = own_edges.ids;
        let cells: Vec<Box3> = occupied.iter().flat_map(Occupancy::boxes).collect();
        let cells = Occupancy::of(&cells, neighbourhood::CELLS);
        let edges = neighbourhood::edges_near(here, &cells, layout, contact_nodes);
        let hang_on = |edge: u32| layout.edges[edge as usize].points(&layout.faces).map(owner_rank);
        let (edges, edge_owners) = sent_near(edges.ids.into_iter().zip(edges.boxes), hang_on, &occupied, comm);
        let occupied = occupied_by_all(&points.boxes, comm);
        let corners = |face: u32| layout.faces.corners[face as usize].map(owner_rank);
        let faces = faces.iter().map(|&face| (face, neighbourhood::face_box(face, layout, contact_nodes)));
        let (faces, face_owners) = sent_near(faces, corners, &occupied, comm);
        Regional { points, faces, edges, own_edges, face_owners, edge_owners }
    }
}

/// Cells along each axis of the space in which a rank has points, or edges that stand out: every other rank learns
/// the 64 bytes of it, and the 48 of the box around.
const CELLS: usize = 8;

/// What boxes occupy on each rank. All ranks call it.
fn occupied_by_all(own: &[Box3], comm: &mut dyn Communicator) -> Vec<Occupancy> {
    let own = Occupancy::of(own, CELLS).to_bytes();
    let length = own.len();
    gather_for_all(own, comm).chunks_exact(length).map(|bytes| Occupancy::from_bytes(bytes, CELLS)).collect()
}

/// Sends each box, with the owner ranks of its corners or ends, to all ranks that occupy space near it; what has come
/// instead. All ranks call it.
fn sent_near<const OWNERS: usize>(
    boxes: impl Iterator<Item = (u32, Box3)>,
    owners: impl Fn(u32) -> [f64; OWNERS],
    occupied: &[Occupancy],
    comm: &mut dyn Communicator,
) -> (Boxes, Vec<[u32; OWNERS]>) {
    let mut parcels = Parcels::new(&*comm, 6 + OWNERS);
    let mut record = Vec::with_capacity(6 + OWNERS);
    for (id, of) in boxes {
        record.clear();
        record.extend_from_slice(&flat(&of));
        record.extend_from_slice(&owners(id));
        let near = (0..).zip(occupied).filter(|(_, by_rank)| by_rank.may_meet(&of));
        near.for_each(|(rank, _)| parcels.add(rank, id, &record));
    }
    sorted(parcels.exchange(comm))
}

/// Sends each box to its rank; what has come instead. All ranks call it.
fn sent(boxes: Boxes, rank: impl Fn(u32) -> f64, comm: &mut dyn Communicator) -> Records {
    let mut parcels = Parcels::new(&*comm, 6);
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
