//! Contact on many ranks: two decompositions and the messages between them (Attaway et al. 1996, "Parallel contact").
//!
//! Elements and nodes stay where they are. At every search the points of contact are shared out anew by recursive
//! bisection; each goes, with its history, to the rank of its region, its home, and faces and edges go to every rank whose
//! points they may meet. That rank searches, and checks and enforces until the next search. In between, only motion
//! travels to the homes, changes of velocity between homes in the passes, and forces back.

use super::arena::{Arena, Cast, History};
use super::detect::{NONE, Past, TOUCHES, UNTOUCHED};
use super::edges::PastPair;
use super::enforce::{Constraint, MEMBERS, Moved, Origin, Others, State};
use super::neighbourhood::{self, Boxes, Found};
use super::planes::PlanePoint;
use super::search::{Box3, Search};
use super::setup::Layout;
use super::sites::{ANSWER, Sites};
use super::traffic::{Letters, Lists, Pattern};
use crate::comm::{Communicator, numbers_of_others};
use crate::model::Friction;
use crate::partition::dynamic::{self, Axes, Bisection, Boxes as Regions, Parcels, Records};
use std::collections::BTreeSet;

/// Numbers that tell what a point touches.
const PASTS: usize = 6 * TOUCHES;

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
    cuts: Option<Bisection>,
    motion: Pattern,
    answers: Pattern,
    links: Links,
}

/// What homes tell each other in a step.
#[derive(Default)]
pub struct Links {
    rank: u32,
    /// Home of each point of the arena, where constraints may act on it.
    homes: Vec<u32>,
    /// Points by number of the layout: those of the arena, then its ghosts.
    points: Vec<u32>,
    ghosts: Vec<u32>,
    shares: Pattern,
    letters: Letters,
}

impl Remote {
    /// Gets to know the others. `is_here` says whether the element of a face is on this rank. All ranks call it.
    pub fn new(layout: &Layout, sites: &Sites, is_here: impl Fn(u32) -> bool, comm: &mut dyn Communicator) -> Remote {
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
            cuts: None,
            motion: Pattern::default(),
            answers: Pattern::default(),
            links: Links::default(),
        }
    }

    /// Ranks of which a point is a node.
    fn holders(&self, point: u32) -> &[u32] {
        &self.holders[self.first[point as usize] as usize..self.first[point as usize + 1] as usize]
    }

    /// Brings the motion of a step to the homes.
    pub fn send_motion(&mut self, sites: &mut Sites, arena: &mut Arena, drift: f64, comm: &mut dyn Communicator) {
        arena.points.begin(drift);
        self.motion.exchange(
            &mut (sites, arena),
            |(sites, _), site| {
                let ([x, y, z], [u, v, w]) = (sites.points.start[site as usize], sites.points.velocity[site as usize]);
                [x, y, z, u, v, w]
            },
            |(_, arena), point, [x, y, z, u, v, w]| arena.points.set(point as usize, [x, y, z], [u, v, w]),
            comm,
        );
    }

    /// Brings what contact has found to the nodes.
    pub fn send_answers(&mut self, sites: &mut Sites, arena: &mut Arena, comm: &mut dyn Communicator) {
        sites.pushed.clear();
        self.answers.exchange(
            &mut (&mut *sites, arena),
            |(_, arena), point| arena.answers[point as usize],
            |(sites, _), site, answer: [f64; ANSWER]| {
                if answer[7] != 0.0 {
                    sites.answers[site as usize] = answer;
                    sites.pushed.push(site);
                }
            },
            comm,
        );
        sites.pushed.sort_unstable();
    }

    /// What homes tell each other, for one step.
    pub fn others<'a>(&'a mut self, comm: &'a mut dyn Communicator) -> Linked<'a> {
        Linked { links: &mut self.links, comm }
    }

    /// Shares out the points anew, searches, and makes the arena of this rank.
    pub fn decompose(
        &mut self,
        search: &mut dyn Search,
        problem: (&Layout, &[PlanePoint], f64),
        sites: &mut Sites,
        history: History,
        comm: &mut dyn Communicator,
    ) -> Arena {
        let (layout, watches, depth) = problem;
        sites.homes = self.find_homes(sites, comm);
        let history = self.forward(layout, sites, watches, history, comm);
        let mut regional = self.send_out(layout, sites, comm);
        let mine: BTreeSet<u32> = regional.own_edges.iter().copied().collect();
        let lists = [&regional.points, &regional.faces, &regional.edges];
        let found = neighbourhood::find(search, lists, |edge| mine.contains(&edge), layout);
        let contract = Contract::new(layout, &found, &mut regional, comm);
        let own: BTreeSet<u32> = regional.points.ids.iter().copied().collect();
        let watches: Vec<PlanePoint> = watches.iter().filter(|watch| own.contains(&watch.point)).copied().collect();
        let cast = cast(layout, &found, &contract, &watches);
        let mut arena = Arena::new(cast, found, depth, layout, &watches);
        self.connect(sites, &mut arena, &contract, &regional, &watches, comm);
        arena.restore(history);
        arena
    }

    /// The new home of every site.
    fn find_homes(&mut self, sites: &Sites, comm: &mut dyn Communicator) -> Vec<u32> {
        let own = sites.list.iter().enumerate().filter(|(_, site)| site.owned);
        let (places, ids): (Vec<[f64; 3]>, Vec<u32>) = own.map(|(i, site)| (sites.points.start[i], site.point)).unzip();
        let balanced = dynamic::balance(&places, &ids, &[], Axes::Longest, self.cuts.as_ref(), comm);
        let cuts = self.cuts.insert(balanced.bisection);
        sites.list.iter().zip(&sites.points.start).map(|(site, at)| cuts.owner(*at, site.point)).collect()
    }

    /// Brings history from where it was to the new homes, by way of the ranks that own the nodes and know the homes.
    fn forward(
        &self,
        layout: &Layout,
        sites: &Sites,
        watches: &[PlanePoint],
        history: History,
        comm: &mut dyn Communicator,
    ) -> History {
        let at = |point: u32| layout.edges.get(point as usize).map_or(0, |edge| edge.ends[0]);
        let first = self.route(history, |point| self.owner[point as usize], at, watches, comm);
        let home = |point: u32| sites.of(point).map_or(0, |site| sites.homes[site]);
        self.route(first, home, at, watches, comm)
    }

    /// Sends every part of a history to the rank of its point.
    fn route(
        &self,
        history: History,
        rank: impl Fn(u32) -> u32,
        end_of: impl Fn(u32) -> u32,
        watches: &[PlanePoint],
        comm: &mut dyn Communicator,
    ) -> History {
        let size = comm.size();
        let [mut points, mut edges, mut planes] = [PASTS, 7, 4].map(|width| Parcels::new(size, width));
        for (point, pasts) in &history.points {
            let values: Vec<f64> = pasts.iter().flat_map(|past| pack_past(*past)).collect();
            points.add(rank(*point), *point, &values);
        }
        for past in &history.edges {
            let [x, y, z] = past.drag;
            let values = [f64::from(past.pair[1]), past.sense, past.allowed, past.push, x, y, z];
            edges.add(rank(end_of(past.pair[0])), past.pair[0], &values);
        }
        for (number, push, [x, y, z]) in &history.planes {
            planes.add(rank(watches[*number as usize].point), *number, &[*push, *x, *y, *z]);
        }
        let mut come = History::default();
        let records = points.exchange(comm);
        for i in 0..records.len() {
            let mut pasts = UNTOUCHED;
            pasts.iter_mut().zip(records.values(i).chunks_exact(6)).for_each(|(past, v)| *past = unpack_past(v));
            come.points.push((records.ids[i], pasts));
        }
        let records = edges.exchange(comm);
        come.edges.extend((0..records.len()).map(|i| {
            let v = records.values(i);
            let pair = [records.ids[i], v[0] as u32];
            PastPair { pair, sense: v[1], allowed: v[2], push: v[3], drag: [v[4], v[5], v[6]] }
        }));
        let records = planes.exchange(comm);
        come.planes.extend((0..records.len()).map(|i| {
            let v = records.values(i);
            (records.ids[i], v[0], [v[1], v[2], v[3]])
        }));
        come
    }

    /// Sends points to their homes, and faces and edges to every home whose points they may meet.
    fn send_out(&self, layout: &Layout, sites: &Sites, comm: &mut dyn Communicator) -> Regional {
        let size = comm.size();
        let home = |point: u32| f64::from(sites.of(point).map_or(0, |site| sites.homes[site]));
        let own = neighbourhood::point_boxes(sites);
        let edges = neighbourhood::edge_boxes(self.edges.iter().copied(), layout, sites);
        let faces = neighbourhood::face_boxes(self.faces.iter().copied(), layout, sites);
        let [mut to_home, mut edges_to_home] = [6, 6].map(|width| Parcels::new(size, width));
        for (&point, of) in own.ids.iter().zip(&own.boxes) {
            to_home.add(home(point) as u32, point, &flat(of));
        }
        for (&edge, of) in edges.ids.iter().zip(&edges.boxes) {
            edges_to_home.add(home(layout.edges[edge as usize].ends[0]) as u32, edge, &flat(of));
        }
        let (points, _) = sorted(to_home.exchange(comm));
        let (own_edges, _) = sorted(edges_to_home.exchange(comm));
        let all = points.boxes.iter().chain(&own_edges.boxes).filter(|of| of.is_sound());
        let all = all.fold(Box3::empty(), |all, one| all.joined(one));
        let regions = Regions::gather(all.low, all.high, comm);
        let [mut face_parcels, mut edge_parcels] = [10, 8].map(|width| Parcels::new(size, width));
        let mut ranks = Vec::new();
        for (&face, of) in faces.ids.iter().zip(&faces.boxes) {
            regions.ranks_meeting(of.low, of.high, &mut ranks);
            let values = [&flat(of)[..], &layout.faces.corners[face as usize].map(home)].concat();
            ranks.iter().for_each(|&rank| face_parcels.add(rank, face, &values));
        }
        for (&edge, of) in edges.ids.iter().zip(&edges.boxes) {
            regions.ranks_meeting(of.low, of.high, &mut ranks);
            let values = [&flat(of)[..], &layout.edges[edge as usize].ends.map(home)].concat();
            ranks.iter().for_each(|&rank| edge_parcels.add(rank, edge, &values));
        }
        let (faces, face_homes) = sorted(face_parcels.exchange(comm));
        let (edges, edge_homes) = sorted(edge_parcels.exchange(comm));
        Regional {
            points,
            faces,
            edges,
            own_edges: own_edges.ids,
            face_homes: face_homes.chunks_exact(4).map(|v| [0, 1, 2, 3].map(|i| v[i] as u32)).collect(),
            edge_homes: edge_homes.chunks_exact(2).map(|v| [0, 1].map(|i| v[i] as u32)).collect(),
        }
    }

    /// Makes the patterns of messages until the next search.
    fn connect(
        &mut self,
        sites: &Sites,
        arena: &mut Arena,
        contract: &Contract,
        regional: &Regional,
        watches: &[PlanePoint],
        comm: &mut dyn Communicator,
    ) {
        let (rank, size) = (comm.rank(), comm.size());
        self.connect_motion(sites, arena, comm);
        // Forces go to every rank that has the node.
        let mut pushed: BTreeSet<u32> = contract.here.iter().copied().collect();
        pushed.extend(watches.iter().map(|watch| watch.point));
        let mut parcels = Parcels::new(size, 0);
        let mut send = Lists::new();
        for &point in &pushed {
            for &holder in self.holders(point) {
                parcels.add(holder, point, &[]);
                send.entry(holder as usize).or_default().push(arena.place(point));
            }
        }
        let records = parcels.exchange(comm);
        let site = |point: &u32| sites.of(*point).map(|site| site as u32);
        let receive = by_sender(&records, |ids| ids.iter().filter_map(site).collect());
        self.answers = Pattern::new(send, receive, rank);
        let places = |lists: &std::collections::BTreeMap<u32, BTreeSet<u32>>| -> Lists {
            lists.iter().map(|(&r, list)| (r as usize, list.iter().map(|&p| arena.place(p)).collect())).collect()
        };
        let shares = Pattern::new(places(&contract.send), places(&contract.receive), rank);
        let mut homes = vec![rank as u32; arena.cast.points.len() + arena.cast.ghosts.len()];
        for (face, corners) in &contract.corners {
            let Ok(place) = regional.faces.ids.binary_search(face) else { continue };
            for (&corner, home) in corners.iter().zip(regional.face_homes[place]) {
                if let Some(of) = homes.get_mut(arena.place(corner) as usize) {
                    *of = home;
                }
            }
        }
        for (&point, &home) in &contract.end_homes {
            if let Some(of) = homes.get_mut(arena.place(point) as usize) {
                *of = home;
            }
        }
        self.links = Links {
            rank: rank as u32,
            homes,
            points: arena.cast.points.clone(),
            ghosts: arena.cast.ghosts.clone(),
            shares,
            letters: Letters::new(contract.partners.iter().map(|&rank| rank as usize)),
        };
    }

    /// Asks the owners for the motion of all points of the arena, and for their masses.
    fn connect_motion(&mut self, sites: &Sites, arena: &mut Arena, comm: &mut dyn Communicator) {
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
        self.motion = Pattern::new(send, receive, rank);
        self.motion.exchange(
            &mut (sites, arena),
            |(sites, _), site| sites.points.inverse_mass[site as usize],
            |(_, arena), point, mass| arena.points.inverse_mass[point as usize] = mass,
            comm,
        );
    }
}

/// What has come to this rank for its search.
struct Regional {
    points: Boxes,
    faces: Boxes,
    edges: Boxes,
    own_edges: Vec<u32>,
    /// Homes of the corners of each face.
    face_homes: Vec<[u32; 4]>,
    /// Homes of the ends of each edge.
    edge_homes: Vec<[u32; 2]>,
}

/// Who must know of whose points in the passes.
#[derive(Default)]
struct Contract {
    /// Points that this rank is the home of, and on which constraints may act.
    here: BTreeSet<u32>,
    /// Points that go to each rank, and that come from each.
    send: std::collections::BTreeMap<u32, BTreeSet<u32>>,
    receive: std::collections::BTreeMap<u32, BTreeSet<u32>>,
    /// Ranks with constraints that act on points of both.
    partners: BTreeSet<u32>,
    /// Corners of candidate faces, and homes of ends of candidate edges.
    corners: std::collections::BTreeMap<u32, [u32; 4]>,
    end_homes: std::collections::BTreeMap<u32, u32>,
}

impl Contract {
    /// From the candidates of this rank and what others say of theirs.
    fn new(layout: &Layout, found: &Found, regional: &mut Regional, comm: &mut dyn Communicator) -> Contract {
        let me = comm.rank() as u32;
        let mut contract = Contract::default();
        let mut deliveries: BTreeSet<(u32, u32, u32)> = BTreeSet::new();
        for (i, &point) in found.watched.iter().enumerate() {
            contract.here.insert(point);
            for near in &found.near[found.first[i] as usize..found.first[i + 1] as usize] {
                let corners = layout.faces.corners[near.face as usize];
                contract.corners.insert(near.face, corners);
                let Ok(place) = regional.faces.ids.binary_search(&near.face) else { continue };
                let homes = regional.face_homes[place];
                let members = corners.into_iter().zip(homes).chain([(point, me)]);
                contract.agree(members, me, &mut deliveries);
            }
        }
        for pair in &found.pairs {
            let ends = pair.iter().filter_map(|edge| {
                let place = regional.edges.ids.binary_search(edge).ok()?;
                Some(layout.edges[*edge as usize].ends.into_iter().zip(regional.edge_homes[place]))
            });
            let members: Vec<(u32, u32)> = ends.flatten().collect();
            contract.end_homes.extend(members.iter().copied());
            contract.agree(members.into_iter(), me, &mut deliveries);
        }
        let mut parcels = Parcels::new(comm.size(), 2);
        for (from, to, point) in deliveries {
            parcels.add(from, point, &[0.0, f64::from(to)]);
            parcels.add(to, point, &[1.0, f64::from(from)]);
        }
        let records = parcels.exchange(comm);
        for (sender, range) in records.senders.clone() {
            if sender as u32 != me {
                contract.partners.insert(sender as u32);
            }
            for i in range {
                let (point, v) = (records.ids[i], records.values(i));
                let list = if v[0] == 0.0 { &mut contract.send } else { &mut contract.receive };
                list.entry(v[1] as u32).or_default().insert(point);
                if v[0] == 0.0 {
                    contract.here.insert(point);
                }
            }
        }
        contract
    }

    /// The homes of all members of a constraint know all of them.
    fn agree(
        &mut self,
        members: impl Iterator<Item = (u32, u32)> + Clone,
        me: u32,
        deliveries: &mut BTreeSet<(u32, u32, u32)>,
    ) {
        let mut ranks: Vec<u32> = members.clone().map(|(_, home)| home).chain([me]).collect();
        ranks.sort_unstable();
        ranks.dedup();
        for (point, home) in members {
            if home == me {
                self.here.insert(point);
            }
            for &rank in ranks.iter().filter(|&&rank| rank != home) {
                deliveries.insert((home, rank, point));
            }
        }
        self.partners.extend(ranks.into_iter().filter(|&rank| rank != me));
    }
}

/// Everything that the check of these candidates looks at.
fn cast(layout: &Layout, found: &Found, contract: &Contract, watches: &[PlanePoint]) -> Cast {
    let faces = &layout.faces;
    let mut chosen: BTreeSet<u32> = BTreeSet::new();
    found.watched.iter().for_each(|&point| chosen.extend(faces.around(point)));
    found.near.iter().for_each(|near| chosen.extend(faces.of_same_element(near.face)));
    let edges: BTreeSet<u32> = found.pairs.iter().flatten().copied().collect();
    edges.iter().for_each(|&edge| chosen.extend(layout.edges[edge as usize].faces));
    let mut points: BTreeSet<u32> = chosen.iter().flat_map(|&face| faces.corners[face as usize]).collect();
    points.extend(found.watched.iter().chain(&contract.here));
    points.extend(watches.iter().map(|watch| watch.point));
    let come = contract.receive.values().flatten().copied();
    Cast {
        ghosts: come.filter(|point| !points.contains(point)).collect::<BTreeSet<u32>>().into_iter().collect(),
        points: points.into_iter().collect(),
        faces: chosen.into_iter().collect(),
        edges: edges.into_iter().collect(),
    }
}

/// What homes tell each other, with the means to do it.
pub struct Linked<'a> {
    links: &'a mut Links,
    comm: &'a mut dyn Communicator,
}

impl Others for Linked<'_> {
    fn copy(&mut self, constraints: &mut Vec<Constraint>, states: &mut Vec<State>) {
        let Links { rank, homes, points, ghosts, letters, .. } = &mut *self.links;
        let number = |point: u32| match points.get(point as usize) {
            Some(&number) => number,
            None => ghosts[point as usize - points.len()],
        };
        let place = |number: u32| match points.binary_search(&number) {
            Ok(place) => place as u32,
            Err(_) => ghosts.binary_search(&number).map_or(0, |ghost| (points.len() + ghost) as u32),
        };
        let acts_on = |c: &Constraint, rank: u32| c.parts().any(|(point, _)| homes[point] == rank);
        let own: Vec<(usize, [u32; MEMBERS])> = (constraints.iter().enumerate())
            .filter(|(_, c)| c.parts().any(|(point, _)| homes[point] != *rank))
            .map(|(i, c)| (i, c.members.map(number)))
            .collect();
        let mut come: Vec<(Constraint, State)> = Vec::new();
        letters.exchange(
            |to, letter| {
                for (i, members) in own.iter().filter(|(i, _)| acts_on(&constraints[*i], to as u32)) {
                    letter.extend(pack(&constraints[*i], &states[*i], *members));
                }
            },
            |letter| come.extend(letter.chunks_exact(COPY).map(|v| unpack(v, place))),
            self.comm,
        );
        for (constraint, state) in come {
            constraints.push(constraint);
            states.push(state);
        }
    }

    fn share(&mut self, moved: &mut [Moved]) {
        self.links.shares.exchange(
            moved,
            |moved, point| {
                let Moved { change: [x, y, z], load } = moved[point as usize];
                [x, y, z, load]
            },
            |moved, point, [x, y, z, load]| moved[point as usize] = Moved { change: [x, y, z], load },
            self.comm,
        );
    }

    fn largest(&mut self, value: f64) -> f64 {
        let mut least = [-value];
        self.comm.all_min(&mut least);
        -least[0]
    }
}

/// Numbers of a constraint on its way.
const COPY: usize = 36 + 2 * MEMBERS;

fn pack(c: &Constraint, state: &State, members: [u32; MEMBERS]) -> [f64; COPY] {
    let mut v = Vec::with_capacity(COPY);
    v.extend(members.map(f64::from));
    v.extend(c.weights);
    v.extend(c.normal);
    v.extend(c.drag);
    v.extend(state.slip);
    let Friction { at_rest, high_speed, decay } = c.friction;
    let (kind, a, b) = match c.origin {
        Origin::Face(a, b) => (0, a, b),
        Origin::Edges(a, b) => (1, a, b),
        Origin::Plane(a) => (2, a, 0),
    };
    v.extend([at_rest, high_speed, decay, c.gap, c.size, c.share, c.push, state.strength, c.count as f64]);
    v.extend([kind, a, b].map(f64::from));
    v.extend(state.softness.as_flattened());
    v.resize(COPY, 0.0);
    v.try_into().unwrap_or([0.0; COPY])
}

fn unpack(v: &[f64], place: impl Fn(u32) -> u32) -> (Constraint, State) {
    let three = |at: usize| [v[at], v[at + 1], v[at + 2]];
    let (a, b) = (v[29] as u32, v[30] as u32);
    let mut state = State { strength: v[26], slip: three(16), ..Default::default() };
    state.softness.as_flattened_mut().copy_from_slice(&v[31..31 + 2 * MEMBERS]);
    let constraint = Constraint {
        members: [0, 1, 2, 3, 4].map(|i| place(v[i] as u32)),
        weights: [5, 6, 7, 8, 9].map(|i| v[i]),
        normal: three(10),
        drag: three(13),
        friction: Friction { at_rest: v[19], high_speed: v[20], decay: v[21] },
        gap: v[22],
        size: v[23],
        share: v[24],
        push: v[25],
        count: v[27] as usize,
        origin: match v[28] as u32 {
            0 => Origin::Face(a, b),
            1 => Origin::Edges(a, b),
            _ => Origin::Plane(a),
        },
    };
    (constraint, state)
}

fn pack_past(past: Past) -> [f64; 6] {
    let [x, y, z] = past.drag;
    // The mark of no face is beyond all faces and exact in a double.
    [f64::from(past.face), past.allowed, past.push, x, y, z]
}

fn unpack_past(v: &[f64]) -> Past {
    let face = v[0] as u32;
    Past { face: if face == u32::MAX { NONE } else { face }, allowed: v[1], push: v[2], drag: [v[3], v[4], v[5]] }
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

fn by_sender(records: &Records, places: impl Fn(&[u32]) -> Vec<u32>) -> Lists {
    records.senders.iter().map(|(rank, range)| (*rank, places(&records.ids[range.clone()]))).collect()
}
