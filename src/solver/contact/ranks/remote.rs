//! Contact on many ranks: two decompositions and the messages between them (Attaway et al. 1996, "Parallel contact").
//!
//! Elements and nodes stay where they are. At every search the points of contact are shared out anew, by recursive
//! bisection unless CONTACT DECOMPOSITION says otherwise; each goes, with its history, to the rank of its region, its
//! home, and faces and edges go to every rank whose points they may meet. That rank searches, and checks and enforces
//! until the next search. In between, only motion travels to the homes, changes of velocity between homes in the passes,
//! and forces back.
//!
//! [`Regional`] is what a search brings to a rank, [`route`] takes history along, [`CommunicationPlan`] says who must know of whose
//! points in the passes, and [`IterationMessages`] are these messages.

use super::contract::{CommunicationPlan, cast};
use super::links::{IterationExchange, IterationMessages};
use super::regional::Regional;
use super::routing::route;
use super::traffic::{Lists, MessagePattern};
use crate::comm::{Communicator, numbers_of_others};
use crate::model::ContactDecomposition;
use crate::partition::dynamic::{self, Axes, Bisection, Earlier, Parcels, Records};
use crate::solver::contact::check::planes::PlaneNode;
use crate::solver::contact::contact_nodes::{ANSWER, ContactNode, ContactNodes, FORCES, STATUS};
use crate::solver::contact::layout::{ABSENT, Layout};
use crate::solver::contact::local_problem::{History, LocalProblem};
use crate::solver::contact::search::{Search, neighbourhood};
use std::collections::{BTreeMap, BTreeSet};

/// A cut stays where it is while it shares out its points to within this part. Where contact happens is not spread as
/// evenly as points are, so that exact cuts would gain little, and to find them anew takes many rounds.
const SLACK: f64 = 0.1;

/// What a point that was pushed in the last step weighs against one that was not: about what its check and its part in the
/// passes cost against a point that is merely put where it is.
const PUSHED: u32 = 12;

/// A point that is not pushed. No sum that begins with +0 comes out as −0.
const AT_REST: [f64; FORCES] = [-0.0; FORCES];

/// What one rank knows of the others.
pub struct Remote {
    /// Rank that answers for each point.
    owner: Vec<u32>,
    /// Ranks of which a point is a node: `holders[first[p]..first[p + 1]]`.
    first: Vec<u32>,
    holders: Vec<u32>,
    /// Faces and edges of elements that are here.
    faces: Vec<u32>,
    edges: Vec<u32>,
    /// How points are shared out, and the cuts of the last time.
    method: ContactDecomposition,
    cuts: Option<Bisection>,
    motion: MessagePattern,
    /// Ways of the answers to other ranks.
    answers: MessagePattern,
    /// For every point of the arena that may be pushed and is at home here, its site here; else [`ABSENT`].
    own: Vec<u32>,
    links: IterationMessages,
}

impl Remote {
    /// Gets to know the others. `is_here` says whether the element of a face is on this rank. All ranks call it.
    pub fn new(
        (layout, sites): (&Layout, &ContactNodes),
        method: ContactDecomposition,
        is_here: impl Fn(u32) -> bool,
        comm: &mut dyn Communicator,
    ) -> Remote {
        let count = layout.nodes.len();
        let own: Vec<u32> = sites.list.iter().map(|site| 2 * site.point + u32::from(site.owned)).collect();
        let mut all = numbers_of_others(&own, comm);
        all.push((comm.rank(), own));
        let mut owner = vec![0; count];
        let mut holding: Vec<(u32, u32)> = Vec::new();
        for (rank, numbers) in all {
            for number in numbers {
                holding.push((number / 2, rank as u32));
                if number % 2 == 1 {
                    owner[number as usize / 2] = rank as u32;
                }
            }
        }
        holding.sort_unstable();
        let first = (0..=count as u32).map(|point| holding.partition_point(|&(other, _)| other < point) as u32);
        let here = |face: &u32| is_here(layout.faces.number[*face as usize]);
        Remote {
            first: first.collect(),
            holders: holding.into_iter().map(|(_, rank)| rank).collect(),
            owner,
            faces: (0..layout.faces.len() as u32).filter(here).collect(),
            edges: (0..layout.edges.len() as u32).filter(|&e| here(&layout.edges[e as usize].faces[0])).collect(),
            method,
            cuts: None,
            motion: MessagePattern::default(),
            answers: MessagePattern::default(),
            own: Vec::new(),
            links: IterationMessages::default(),
        }
    }

    /// Ranks of which a point is a node.
    pub fn holders(&self, point: u32) -> &[u32] {
        &self.holders[self.first[point as usize] as usize..self.first[point as usize + 1] as usize]
    }

    /// Brings the motion of a step to the homes.
    pub fn send_motion(
        &mut self,
        sites: &mut ContactNodes,
        arena: &mut LocalProblem,
        drift: f64,
        comm: &mut dyn Communicator,
    ) {
        arena.points.begin(drift);
        self.motion.exchange_others(
            &mut (sites, arena),
            |(sites, _), site| {
                let ([x, y, z], [u, v, w]) = (sites.points.start(site), sites.points.velocity(site));
                let [p, q, r] = sites.points.velocity_before(site);
                [x, y, z, u, v, w, p, q, r]
            },
            |(_, arena), point, [x, y, z, u, v, w, p, q, r]| {
                arena.points.set(point as usize, [x, y, z], [u, v, w], [p, q, r]);
            },
            |(sites, arena), site, point| arena.points.copy(point as usize, &sites.points, site as usize),
            comm,
        );
    }

    /// Brings the forces that contact has found to the nodes.
    pub fn send_forces(&mut self, sites: &mut ContactNodes, arena: &LocalProblem, comm: &mut dyn Communicator) {
        sites.pushed.clear();
        self.answers.exchange(
            &mut (&mut *sites, arena),
            |(_, arena), point| {
                let answer = &arena.answers[point as usize];
                if answer[STATUS] == 0.0 { AT_REST } else { std::array::from_fn(|i| answer[i]) }
            },
            |(sites, _), site, forces| {
                // All bits at once: comparing the arrays would be a call for every point.
                let unlike = forces.iter().zip(AT_REST).fold(0, |all, (a, b)| all | (a.to_bits() ^ b.to_bits()));
                if unlike != 0 {
                    let answer = &mut sites.answers[site as usize];
                    answer[..FORCES].copy_from_slice(&forces);
                    answer[FORCES..].fill(0.0);
                    sites.pushed.push(site);
                }
            },
            comm,
        );
        for &point in &arena.pushed {
            if let Some(&site) = self.own.get(point as usize).filter(|&&site| site != ABSENT) {
                sites.answers[site as usize] = arena.answers[point as usize];
                sites.pushed.push(site);
            }
        }
        sites.pushed.sort_unstable();
    }

    /// Brings the rest of what contact has found in this step to the nodes that other ranks push: only output asks for it.
    pub fn send_rest(&mut self, sites: &mut ContactNodes, arena: &LocalProblem, comm: &mut dyn Communicator) {
        self.answers.exchange(
            &mut (sites, arena),
            |(_, arena), point| -> [f64; ANSWER - FORCES] {
                std::array::from_fn(|i| arena.answers[point as usize][FORCES + i])
            },
            |(sites, _), site, rest| sites.answers[site as usize][FORCES..].copy_from_slice(&rest),
            comm,
        );
    }

    /// What homes tell each other, for one step.
    pub fn others<'a>(&'a mut self, comm: &'a mut dyn Communicator) -> IterationExchange<'a> {
        self.links.over(comm)
    }

    /// Shares out the points anew, searches, and makes the arena of this rank.
    pub fn decompose(
        &mut self,
        search: &mut dyn Search,
        problem: (&Layout, &[PlaneNode], f64),
        sites: &mut ContactNodes,
        history: History,
        comm: &mut dyn Communicator,
    ) -> LocalProblem {
        let (layout, watches, depth) = problem;
        sites.homes = self.find_homes(sites, comm);
        let history = self.forward(layout, sites, watches, history, comm);
        let regional = Regional::gather((&self.faces, &self.edges), layout, sites, comm);
        let lists = [&regional.points, &regional.faces, &regional.edges];
        let found = neighbourhood::find(search, lists, |edge| regional.own_edges.binary_search(&edge).is_ok(), layout);
        let contract = CommunicationPlan::new(layout, &found, &regional, comm);
        let is_own = |watch: &&PlaneNode| regional.points.ids.binary_search(&watch.point).is_ok();
        let watches: Vec<PlaneNode> = watches.iter().filter(is_own).copied().collect();
        let cast = cast(layout, &found, &contract, &watches);
        let mut arena = LocalProblem::new(cast, found, depth, layout, &watches);
        self.connect((layout, sites), &mut arena, &contract, &regional, &watches, comm);
        arena.restore(history);
        arena
    }

    /// The new home of every site.
    fn find_homes(&mut self, sites: &ContactNodes, comm: &mut dyn Communicator) -> Vec<u32> {
        let axes = match self.method {
            ContactDecomposition::Bisection => Axes::Widest,
            ContactDecomposition::Slices => Axes::One,
            ContactDecomposition::Static => {
                return sites.list.iter().map(|site| self.owner[site.point as usize]).collect();
            }
        };
        let mut weights = vec![1; sites.list.len()];
        sites.pushed.iter().for_each(|&site| weights[site as usize] = PUSHED);
        let (mut places, mut ids, mut own_weights) = (Vec::new(), Vec::new(), Vec::new());
        for (i, site) in sites.list.iter().enumerate().filter(|(_, site)| site.owned) {
            places.push(sites.points.start(i as u32));
            ids.push(site.point);
            own_weights.push(weights[i]);
        }
        let earlier = self.cuts.as_ref().map(|cuts| Earlier { cuts, slack: SLACK });
        let balanced = dynamic::balance(&places, &ids, &own_weights, axes, earlier, comm);
        let cuts = self.cuts.insert(balanced.bisection);
        let owner = |(at, site): (u32, &ContactNode)| cuts.owner(sites.points.start(at), site.point);
        (0..).zip(&sites.list).map(owner).collect()
    }

    /// Brings history from where it was to the new homes, by way of the ranks that own the nodes and know the homes.
    fn forward(
        &self,
        layout: &Layout,
        sites: &ContactNodes,
        watches: &[PlaneNode],
        history: History,
        comm: &mut dyn Communicator,
    ) -> History {
        let at = |point: u32| layout.edges.get(point as usize).map_or(0, |edge| edge.ends[0]);
        let first = route(history, |point| self.owner[point as usize], at, watches, comm);
        let home = |point: u32| sites.of(point).map_or(0, |site| sites.homes[site]);
        route(first, home, at, watches, comm)
    }

    /// Makes the patterns of messages until the next search.
    fn connect(
        &mut self,
        (layout, sites): (&Layout, &ContactNodes),
        arena: &mut LocalProblem,
        contract: &CommunicationPlan,
        regional: &Regional,
        watches: &[PlaneNode],
        comm: &mut dyn Communicator,
    ) {
        self.connect_motion(sites, arena, comm);
        let mut pushed = contract.here.list();
        pushed.extend(watches.iter().map(|watch| watch.point));
        pushed.sort_unstable();
        pushed.dedup();
        self.connect_answers(&pushed, sites, arena, comm);
        let rank = comm.rank();
        let places = |lists: &BTreeMap<u32, BTreeSet<u32>>| -> Lists {
            lists.iter().map(|(&r, list)| (r as usize, list.iter().map(|&p| arena.place(p)).collect())).collect()
        };
        let shares = MessagePattern::new(places(&contract.send), places(&contract.receive), rank);
        let homes = contract.homes(rank as u32, layout, regional, arena);
        self.links = IterationMessages::new(rank as u32, homes, &arena.cast, shares, contract);
    }

    /// Tells every other rank that has the node of a point which may be pushed that forces will come for it.
    fn connect_answers(
        &mut self,
        pushed: &[u32],
        sites: &ContactNodes,
        arena: &LocalProblem,
        comm: &mut dyn Communicator,
    ) {
        let rank = comm.rank() as u32;
        let mut parcels = Parcels::new(comm.size(), 0);
        let mut send = Lists::new();
        for &point in pushed {
            for &holder in self.holders(point).iter().filter(|&&holder| holder != rank) {
                parcels.add(holder, point, &[]);
                send.entry(holder as usize).or_default().push(arena.place(point));
            }
        }
        let records = parcels.exchange(comm);
        let site = |point: &u32| sites.of(*point).map(|site| site as u32);
        let receive = by_sender(&records, |ids| ids.iter().filter_map(site).collect());
        self.answers = MessagePattern::new(send, receive, comm.rank());
        // Few are pushed: those that are at home here need not all be asked.
        self.own = vec![ABSENT; arena.cast.points.len()];
        for point in pushed {
            if let Some(own) = self.own.get_mut(arena.place(*point) as usize) {
                *own = site(point).unwrap_or(ABSENT);
            }
        }
    }

    /// Asks the owners for the motion of all points of the arena, and for their masses.
    fn connect_motion(&mut self, sites: &ContactNodes, arena: &mut LocalProblem, comm: &mut dyn Communicator) {
        let (rank, size) = (comm.rank(), comm.size());
        let mut parcels = Parcels::new(size, 0);
        let mut receive = Lists::new();
        for (place, &point) in arena.cast.points.iter().enumerate() {
            let owner = self.owner[point as usize];
            parcels.add(owner, point, &[]);
            receive.entry(owner as usize).or_default().push(place as u32);
        }
        let records = parcels.exchange(comm);
        let site = |point: &u32| sites.of(*point).map(|site| site as u32);
        let send = by_sender(&records, |ids| ids.iter().filter_map(site).collect());
        self.motion = MessagePattern::new(send, receive, rank);
        self.motion.exchange(
            &mut (sites, arena),
            |(sites, _), site| sites.points.inverse_mass[site as usize],
            |(_, arena), point, mass| arena.points.inverse_mass[point as usize] = mass,
            comm,
        );
    }
}

fn by_sender(records: &Records, places: impl Fn(&[u32]) -> Vec<u32>) -> Lists {
    records.senders.iter().map(|(rank, range)| (*rank, places(&records.ids[range.clone()]))).collect()
}
