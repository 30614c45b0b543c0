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
    /// Edges that look around whose first ends are here, ascending.
    pub own_edges: Vec<u32>,
    /// Owner ranks of the corners of each face.
    pub face_owners: Vec<[u32; 4]>,
    /// Owner ranks of the points on which each edge hangs, see [`Edge::points`](crate::solver::contact::geometry::edges::Edge::points).
    pub edge_owners: Vec<[u32; 4]>,
}

impl Regional {
    /// Sends points to their owner ranks, faces to every rank whose points they may meet, and edges to every rank that has the first
    /// ends of edges that look around and which they may cross. `faces` and `edges` are those of elements that are here. All ranks
    /// call it.
    pub fn gather(
        (faces, edges): (&[u32], &[u32]),
        layout: &Layout,
        contact_nodes: &ContactNodes,
        comm: &mut dyn Communicator,
    ) -> Regional {
        let owner_rank =
            |point: u32| contact_nodes.of(point).map_or(0, |contact_node| contact_nodes.owner_ranks[contact_node]);
        // One kind after the other, each let go of as soon as it is on its way: a search takes the most memory of all that
        // a step does.
        let points = sent(neighbourhood::point_boxes(layout, contact_nodes), owner_rank, comm);
        let here = edges.iter().copied();
        let looking_around = neighbourhood::looking_around(here.clone(), layout, contact_nodes);
        let first_owner = |edge: u32| owner_rank(layout.edges[edge as usize].ends[0]);
        let own_edges = sent(looking_around, first_owner, comm);
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

/// Cells along each axis of the space in which a rank has points, or edges that look around: every other rank learns
/// the 64 bytes of it, and the 48 of the box around.
const CELLS: usize = 8;

/// What boxes occupy on each rank. All ranks call it.
fn occupied_by_all(own: &[Box3], comm: &mut dyn Communicator) -> Vec<Occupancy> {
    let own = Occupancy::of(own, CELLS).to_bytes();
    let length = own.len();
    gather_for_all(own, comm).chunks_exact(length).map(|bytes| Occupancy::from_bytes(bytes, CELLS)).collect()
}

/// Sends each box, with the owner ranks of its corners or ends, to all ranks that occupy space near it, this one among them; what has
/// come instead. Boxes come by ascending numbers. All ranks call it.
fn sent_near<const OWNERS: usize>(
    boxes: impl ExactSizeIterator<Item = (u32, Box3)>,
    owners: impl Fn(u32) -> [u32; OWNERS],
    occupied: &[Occupancy],
    comm: &mut dyn Communicator,
) -> (Boxes, Vec<[u32; OWNERS]>) {
    let me = comm.rank();
    let mut parcels = Parcels::new(&*comm, 6 + OWNERS);
    let (mut own, mut own_owners) = (Boxes::with_capacity(boxes.len()), Vec::with_capacity(boxes.len()));
    let mut record = Vec::with_capacity(6 + OWNERS);
    for (id, of) in boxes {
        // Most boxes stay, and are not packed.
        if occupied[me].may_meet(&of) {
            own.push(id, of);
            own_owners.push(owners(id));
        }
        let near = occupied.iter().enumerate().filter(|(rank, by_rank)| *rank != me && by_rank.may_meet(&of));
        for (rank, _) in near {
            record.clear();
            record.extend_from_slice(&flat(&of));
            record.extend(owners(id).map(f64::from));
            parcels.add(rank as u32, id, &record);
        }
    }
    merged(own, own_owners, &parcels.exchange(comm))
}

/// Sends each box to its rank, which may be this one; what has come instead. Boxes come by ascending numbers. All ranks call it.
fn sent(boxes: Boxes, rank: impl Fn(u32) -> u32, comm: &mut dyn Communicator) -> Boxes {
    let me = comm.rank() as u32;
    let mut parcels = Parcels::new(&*comm, 6);
    let mut own = Boxes::with_capacity(boxes.ids.len());
    for (&id, of) in boxes.ids.iter().zip(&boxes.boxes) {
        match rank(id) {
            rank if rank == me => own.push(id, *of),
            rank => parcels.add(rank, id, &flat(of)),
        }
    }
    drop(boxes);
    let staying = vec![[]; own.ids.len()];
    merged(own, staying, &parcels.exchange(comm)).0
}

fn flat(of: &Box3) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (of.low, of.high);
    [a, b, c, d, e, f]
}

/// Boxes that have stayed, by ascending numbers, and those that have come from others, together; each with its owner ranks.
fn merged<const OWNERS: usize>(
    own: Boxes,
    own_owners: Vec<[u32; OWNERS]>,
    come: &Records,
) -> (Boxes, Vec<[u32; OWNERS]>) {
    if come.is_empty() {
        return (own, own_owners);
    }
    let count = own.ids.len() + come.len();
    let (mut boxes, mut owners) = (Boxes::with_capacity(count), Vec::with_capacity(count));
    let mut take = |id: u32, of: Box3, of_owners: [u32; OWNERS]| {
        boxes.push(id, of);
        owners.push(of_owners);
    };
    let mut others = come.by_id().into_iter().map(|record| record as usize).peekable();
    for (place, &id) in own.ids.iter().enumerate() {
        while let Some(record) = others.next_if(|&record| come.ids[record] < id) {
            let (of, of_owners) = unpacked(come.values(record));
            take(come.ids[record], of, of_owners);
        }
        take(id, own.boxes[place], own_owners[place]);
    }
    for record in others {
        let (of, of_owners) = unpacked(come.values(record));
        take(come.ids[record], of, of_owners);
    }
    (boxes, owners)
}

/// A box from its record, and the owner ranks behind it.
fn unpacked<const OWNERS: usize>(v: &[f64]) -> (Box3, [u32; OWNERS]) {
    let of = Box3 { low: [v[0], v[1], v[2]], high: [v[3], v[4], v[5]] };
    (of, std::array::from_fn(|owner| v[6 + owner] as u32))
}
