//! The plan of communication until the next search: which ranks must know of whose points, and what a local problem therefore
//! holds.

use super::regional::Regional;
use crate::comm::Communicator;
use crate::partition::dynamic::Parcels;
use crate::solver::contact::check::planes::PlaneNode;
use crate::solver::contact::local_problem::Numbering;
use crate::solver::contact::search::neighbourhood::SearchResult;
use crate::solver::contact::surface::layout::{Layout, inverse};
use std::collections::{BTreeMap, BTreeSet};

/// Who must know of whose points in the iterations.
#[derive(Default)]
pub struct CommunicationPlan {
    /// Points that this rank owns, and on which constraints may act.
    pub here: NumberSet,
    /// Points that may have to come from each rank.
    pub receive: BTreeMap<u32, BTreeSet<u32>>,
    /// Ranks with constraints that act on points of both.
    pub partners: BTreeSet<u32>,
    /// Candidate faces.
    faces: NumberSet,
    /// What ranks must know: the rank, a point, and the owner rank of this, which may be the same.
    deliveries: Vec<(u32, u32, u32)>,
}

/// Some of the numbers below a bound.
#[derive(Default)]
pub struct NumberSet(Vec<bool>);

impl NumberSet {
    fn none_of(count: usize) -> NumberSet {
        NumberSet(vec![false; count])
    }

    /// Chooses a number. Whether it was not chosen before.
    pub fn choose(&mut self, number: u32) -> bool {
        !std::mem::replace(&mut self.0[number as usize], true)
    }

    /// Those chosen, ascending.
    pub fn list(&self) -> Vec<u32> {
        let numbers = (0u32..).zip(&self.0);
        numbers.filter(|(_, is_chosen)| **is_chosen).map(|(number, _)| number).collect()
    }
}

impl CommunicationPlan {
    /// From the candidates of this rank and what others say of theirs.
    pub fn new(
        layout: &Layout,
        found: &SearchResult,
        regional: &Regional,
        comm: &mut dyn Communicator,
    ) -> CommunicationPlan {
        let me = comm.rank() as u32;
        let [points, faces] = [layout.nodes.len(), layout.faces.len()];
        let mut plan = CommunicationPlan {
            here: NumberSet::none_of(points),
            faces: NumberSet::none_of(faces),
            ..Default::default()
        };
        let face_places = inverse(regional.faces.ids.iter().copied(), faces);
        let mut ranks = Vec::new();
        for (i, &point) in found.slave_nodes.iter().enumerate() {
            plan.here.choose(point);
            ranks.clear();
            for near in &found.candidates[found.first[i] as usize..found.first[i + 1] as usize] {
                let is_new = plan.faces.choose(near.face);
                let Some(&owner_ranks) = regional.face_owners.get(face_places[near.face as usize] as usize) else {
                    continue;
                };
                let corners = layout.faces.corners[near.face as usize];
                if owner_ranks != [me; 4] {
                    note(&mut ranks, owner_ranks);
                    if is_new {
                        let mut of_face = vec![me];
                        note(&mut of_face, owner_ranks);
                        plan.tell(corners.into_iter().zip(owner_ranks), &of_face);
                    }
                } else if is_new {
                    corners.iter().for_each(|&corner| _ = plan.here.choose(corner));
                }
            }
            plan.tell([(point, me)].into_iter(), &ranks);
        }
        plan.agree_on_edges(me, layout, found, regional);
        plan.deliver(comm);
        plan.partners.remove(&me);
        plan
    }

    /// Tells ranks of which points they must hear, or tell others, and hears it from them.
    fn deliver(&mut self, comm: &mut dyn Communicator) {
        let me = comm.rank() as u32;
        self.deliveries.sort_unstable();
        self.deliveries.dedup();
        let mut parcels = Parcels::new(&*comm, 1);
        for (to, point, owner_rank) in self.deliveries.drain(..) {
            parcels.add(to, point, &[f64::from(owner_rank)]);
        }
        let records = parcels.exchange(comm);
        for (sender, range) in records.senders.clone() {
            self.partners.insert(sender as u32);
            for i in range {
                let (point, owner_rank) = (records.ids[i], records.values(i)[0] as u32);
                if owner_rank == me {
                    self.here.choose(point);
                } else {
                    self.receive.entry(owner_rank).or_default().insert(point);
                }
            }
        }
    }

    /// Agrees on the ends of edges that may cross: the owner ranks of all ends of a pair must know all of them.
    fn agree_on_edges(&mut self, me: u32, layout: &Layout, found: &SearchResult, regional: &Regional) {
        let ends = |edge: u32| layout.edges[edge as usize].points(&layout.faces);
        let mut ranks_of_edges: Vec<Vec<u32>> = vec![Vec::new(); regional.edges.ids.len()];
        for pair in &found.pairs {
            let places = pair.map(|edge| regional.edges.ids.binary_search(&edge).ok());
            let owner_ranks = || places.iter().flatten().flat_map(|&place| regional.edge_owners[place]);
            if owner_ranks().all(|owner_rank| owner_rank == me) {
                let known = places.iter().flatten().flat_map(|&place| ends(regional.edges.ids[place]));
                known.for_each(|end| _ = self.here.choose(end));
                continue;
            }
            for &place in places.iter().flatten() {
                note(&mut ranks_of_edges[place], owner_ranks().chain([me]));
            }
        }
        for (place, ranks) in ranks_of_edges.iter().enumerate() {
            self.tell(ends(regional.edges.ids[place]).into_iter().zip(regional.edge_owners[place]), ranks);
        }
    }

    /// Lets ranks know of points with these owner ranks, and have them as partners.
    fn tell(&mut self, points: impl Iterator<Item = (u32, u32)>, ranks: &[u32]) {
        for (point, owner_rank) in points {
            self.deliveries.extend(ranks.iter().map(|&rank| (rank, point, owner_rank)));
        }
        self.partners.extend(ranks);
    }
}

/// Adds those of some ranks that are not yet in a short list.
fn note(list: &mut Vec<u32>, ranks: impl IntoIterator<Item = u32>) {
    for rank in ranks {
        if !list.contains(&rank) {
            list.push(rank);
        }
    }
}

/// Local numbers of everything that the check of these candidates looks at.
pub fn numbering(
    layout: &Layout,
    found: &SearchResult,
    plan: &CommunicationPlan,
    plane_nodes: &[PlaneNode],
) -> Numbering {
    let faces = &layout.faces;
    let [mut chosen, mut points] = [faces.len(), layout.nodes.len()].map(NumberSet::none_of);
    let mut edges: Vec<u32> = found.pairs.iter().flatten().copied().collect();
    edges.sort_unstable();
    edges.dedup();
    let around = found.slave_nodes.iter().flat_map(|&point| faces.around(point).iter().copied());
    let met = plan.faces.list();
    let of_elements = met.iter().flat_map(|&face| faces.of_same_element(face));
    let beside = edges.iter().flat_map(|&edge| layout.edges[edge as usize].faces);
    // Where an edge ends, and what is beyond its ends, the faces there say: of those that may cross, and where edges hold, of sharp borders at which
    // nodes may come through faces. An element has some where two of its faces have a common edge.
    let at_ends = edges.iter().flat_map(|&edge| layout.edges[edge as usize].ends);
    let at_borders = met.iter().filter(|_| !layout.edges.is_empty()).flat_map(|&face| {
        let corners = faces.corners[face as usize];
        let common = move |other: u32| {
            let ends = corners.into_iter().filter(move |corner| faces.corners[other as usize].contains(corner));
            (other != face && ends.clone().count() == 2).then_some(ends)
        };
        faces.of_same_element(face).filter_map(common).flatten()
    });
    let beyond = at_ends.chain(at_borders).flat_map(|end| faces.around(end).iter().copied());
    for face in around.chain(of_elements).chain(beside).chain(beyond) {
        if chosen.choose(face) {
            faces.corners[face as usize].iter().for_each(|&corner| _ = points.choose(corner));
        }
    }
    let others = plan.here.list().into_iter().chain(plane_nodes.iter().map(|plane_node| plane_node.point));
    found.slave_nodes.iter().copied().chain(others).for_each(|point| _ = points.choose(point));
    let come = plan.receive.values().flatten().copied();
    let ghosts: BTreeSet<u32> = come.filter(|&point| !points.0[point as usize]).collect();
    Numbering { ghosts: ghosts.into_iter().collect(), points: points.list(), faces: chosen.list(), edges }
}
