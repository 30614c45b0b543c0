//! The plan of communication until the next search: which ranks must know of whose points, and what a local problem therefore
//! holds.

use super::regional::Regional;
use crate::comm::Communicator;
use crate::partition::dynamic::Parcels;
use crate::solver::contact::check::planes::PlaneNode;
use crate::solver::contact::local_problem::{LocalProblem, Numbering};
use crate::solver::contact::search::neighbourhood::SearchResult;
use crate::solver::contact::surface::layout::{Layout, inverse};
use std::collections::{BTreeMap, BTreeSet};

/// Who must know of whose points in the iterations.
#[derive(Default)]
pub struct CommunicationPlan {
    /// Points that this rank owns, and on which constraints may act.
    pub here: NumberSet,
    /// Points that go to each rank, and that come from each.
    pub send: BTreeMap<u32, BTreeSet<u32>>,
    pub receive: BTreeMap<u32, BTreeSet<u32>>,
    /// Ranks with constraints that act on points of both.
    pub partners: BTreeSet<u32>,
    /// Candidate faces, and owner ranks of ends of candidate edges.
    faces: NumberSet,
    end_owners: BTreeMap<u32, u32>,
    /// Ranks that must know points of another: the owner rank of the point, the rank that must know it, and the point.
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
        for (i, &point) in found.slave_nodes.iter().enumerate() {
            plan.here.choose(point);
            for near in &found.candidates[found.first[i] as usize..found.first[i + 1] as usize] {
                let is_new = plan.faces.choose(near.face);
                let Some(&owner_ranks) = regional.face_owners.get(face_places[near.face as usize] as usize) else {
                    continue;
                };
                let corners = layout.faces.corners[near.face as usize];
                if owner_ranks != [me; 4] {
                    plan.agree(corners.into_iter().zip(owner_ranks).chain([(point, me)]), me);
                } else if is_new {
                    corners.iter().for_each(|&corner| _ = plan.here.choose(corner));
                }
            }
        }
        for pair in &found.pairs {
            let ends = pair.iter().filter_map(|edge| {
                let place = regional.edges.ids.binary_search(edge).ok()?;
                Some(layout.edges[*edge as usize].points(&layout.faces).into_iter().zip(regional.edge_owners[place]))
            });
            let members = ends.flatten();
            if members.clone().all(|(_, owner_rank)| owner_rank == me) {
                members.for_each(|(end, _)| _ = plan.here.choose(end));
            } else {
                plan.end_owners.extend(members.clone());
                plan.agree(members, me);
            }
        }
        plan.deliver(comm);
        plan
    }

    /// Tells all owner ranks what they must tell others of, and hears it from them.
    fn deliver(&mut self, comm: &mut dyn Communicator) {
        let me = comm.rank() as u32;
        self.deliveries.sort_unstable();
        self.deliveries.dedup();
        let mut parcels = Parcels::new(&*comm, 2);
        for (from, to, point) in self.deliveries.drain(..) {
            parcels.add(from, point, &[0.0, f64::from(to)]);
            parcels.add(to, point, &[1.0, f64::from(from)]);
        }
        let records = parcels.exchange(comm);
        for (sender, range) in records.senders.clone() {
            if sender as u32 != me {
                self.partners.insert(sender as u32);
            }
            for i in range {
                let (point, v) = (records.ids[i], records.values(i));
                let list = if v[0] == 0.0 { &mut self.send } else { &mut self.receive };
                list.entry(v[1] as u32).or_default().insert(point);
                if v[0] == 0.0 {
                    self.here.choose(point);
                }
            }
        }
    }

    /// The owner rank of each point of a local problem that constraints may act on, `me` for all others; by places in the local
    /// problem.
    pub fn owner_ranks(&self, me: u32, layout: &Layout, regional: &Regional, problem: &LocalProblem) -> Vec<u32> {
        let mut owner_ranks = vec![me; problem.numbering.points.len() + problem.numbering.ghosts.len()];
        let mut note = |point: u32, owner_rank: u32| {
            if let Some(of) = owner_ranks.get_mut(problem.place(point) as usize) {
                *of = owner_rank;
            }
        };
        for (face, face_owners) in regional.faces.ids.iter().zip(&regional.face_owners) {
            if self.faces.0[*face as usize] && *face_owners != [me; 4] {
                let corners = layout.faces.corners[*face as usize];
                corners.iter().zip(face_owners).for_each(|(&corner, &owner_rank)| note(corner, owner_rank));
            }
        }
        self.end_owners.iter().for_each(|(&point, &owner_rank)| note(point, owner_rank));
        owner_ranks
    }

    /// The owner ranks of all members of a constraint know all of them.
    fn agree(&mut self, members: impl Iterator<Item = (u32, u32)> + Clone, me: u32) {
        let mut ranks: Vec<u32> = members.clone().map(|(_, owner_rank)| owner_rank).chain([me]).collect();
        ranks.sort_unstable();
        ranks.dedup();
        for (point, owner_rank) in members {
            if owner_rank == me {
                self.here.choose(point);
            }
            for &rank in ranks.iter().filter(|&&rank| rank != owner_rank) {
                self.deliveries.push((owner_rank, rank, point));
            }
        }
        self.partners.extend(ranks.into_iter().filter(|&rank| rank != me));
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
