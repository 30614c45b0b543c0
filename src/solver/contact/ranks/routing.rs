//! History in messages: at a search it follows each point to its new owner rank.

use crate::comm::Communicator;
use crate::partition::dynamic::Parcels;
use crate::solver::contact::check::edge_edge::EdgeContact;
use crate::solver::contact::check::node_face::{FaceContact, MAX_FACES, NO_CONTACT};
use crate::solver::contact::check::planes::PlaneNode;
use crate::solver::contact::enforcement::carried::{Carried, WIDTH};
use crate::solver::contact::local_problem::{History, PlaneHistory};
use std::ops::Range;

/// Numbers that tell what a point touches.
const PASTS: usize = PAST * MAX_FACES;

/// Numbers of one of them: the face, the tolerated overlap, whether it yields, and what is carried.
const PAST: usize = 3 + WIDTH;

/// Numbers of a pair of edges: the second edge, the sense, the tolerated overlap, and what is carried.
const PAIR: usize = 3 + WIDTH;

/// Sends every part of a history to the `rank` of its point; `end_of` gives a point of an edge. All ranks call it.
pub fn route(
    history: History,
    rank: impl Fn(u32) -> u32,
    end_of: impl Fn(u32) -> u32,
    plane_nodes: &[PlaneNode],
    comm: &mut dyn Communicator,
) -> History {
    let [mut points, mut edges] = [PASTS, PAIR].map(|width| Parcels::new(&*comm, width));
    for (point, pasts) in &history.points {
        let values: Vec<f64> = pasts.iter().flat_map(|past| pack_past(*past)).collect();
        points.add(rank(*point), *point, &values);
    }
    for past in &history.edges {
        let own = [f64::from(past.pair[1]), past.sense, past.tolerated];
        let values = [own.as_slice(), &past.carried.to_array()].concat();
        edges.add(rank(end_of(past.pair[0])), past.pair[0], &values);
    }
    let mut come = History::default();
    for (point, numbers) in points.exchange(comm).rows::<PASTS>() {
        let mut pasts = NO_CONTACT;
        pasts.iter_mut().zip(numbers.as_chunks().0).for_each(|(past, numbers)| *past = unpack_past(*numbers));
        come.points.push((point, pasts));
    }
    for (first, [second, sense, tolerated, carried @ ..]) in edges.exchange(comm).rows::<PAIR>() {
        let pair = [first, second as u32];
        come.edges.push(EdgeContact { pair, sense, tolerated, carried: Carried::from_array(carried) });
    }
    let of = |number: u32| rank(plane_nodes[number as usize].point);
    come.planes = share_planes(&history.planes, |number| of(number)..of(number) + 1, comm);
    come
}

/// Sends the history of every plane's node to some `ranks`. All ranks call it.
pub fn share_planes(
    planes: &[PlaneHistory],
    ranks: impl Fn(u32) -> Range<u32>,
    comm: &mut dyn Communicator,
) -> Vec<PlaneHistory> {
    let mut parcels = Parcels::new(&*comm, WIDTH);
    for (number, carried) in planes {
        ranks(*number).for_each(|rank| parcels.add(rank, *number, &carried.to_array()));
    }
    let records = parcels.exchange(comm);
    records.rows().map(|(number, carried)| (number, Carried::from_array(carried))).collect()
}

fn pack_past(past: FaceContact) -> [f64; PAST] {
    let [penetration, normal_force, x, y, z] = past.carried.to_array();
    // The mark of no face is beyond all faces and exact in a double.
    [f64::from(past.face), past.tolerated, f64::from(u8::from(past.yields)), penetration, normal_force, x, y, z]
}

fn unpack_past([face, tolerated, yields, carried @ ..]: [f64; PAST]) -> FaceContact {
    FaceContact { face: face as u32, tolerated, yields: yields != 0.0, carried: Carried::from_array(carried) }
}
