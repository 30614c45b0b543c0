//! Contact: a predictor finds where nodes would go, and forces take the overlaps out (Attaway et al. 1996).
//!
//! [`Contact::apply`] is steps 1.6 to 1.9 of the paper's figure 1: predict, locate, check in detail, enforce. Nodes of this
//! rank are `Sites`; check and enforcement happen in an `Arena`, of whole bodies on one rank, of a region
//! of space on many (`remote`). Nothing that comes out depends on how many there are.

pub mod check;
mod contact_nodes;
pub mod enforcement;
pub mod geometry;
mod local_problem;
mod ranks;
mod report;
mod reshape;
pub mod search;
mod setup;
mod state;

use super::body::Body;
use super::constraints::{Constraint as HeldDirection, StepTimes};
use super::erosion::Erosion;
use super::nodes::Nodes;
use crate::comm::{Communicator, Traffic};
use crate::mesh::Mesh;
use crate::model::{ContactDecomposition, ContactSearch, Model, RigidSurface};
use check::node_face::{self, NONE, Past, Touch};
use check::planes::PlanePoint;
use contact_nodes::Sites;
use enforcement::carried::Carried;
use enforcement::certificate::Bank;
use enforcement::enforcer::{Alone, Constraint, Limits, MEMBERS, Origin, Outcome};
use enforcement::gain::Gain;
use geometry::edges::{self, PastPair};
use geometry::faces::Faces;
use local_problem::{Arena, Cast, History, Setting};
use ranks::remote::Remote;
use ranks::routing::share_planes;
use search::locate::Reach;
use search::neighbourhood;
use search::{Search, SearchKind};
use setup::{ABSENT, Layout, Pairing, Pairings, Skin};

pub use check::embedded::Sunk;
pub use check::initial_overlap::{Left, Overlap, remove as remove_overlap};
pub use report::Work;

/// Contact of one rank: surfaces, rigid planes, and the account of their forces.
pub struct Contact {
    layout: Layout,
    skin: Skin,
    pairings: Pairings,
    /// Points that are nodes here.
    sites: Sites,
    arena: Arena,
    /// The other ranks, where there are any that this one must know.
    remote: Option<Remote>,
    /// What the next search puts back, where the arena has been given up.
    carried: Option<History>,
    /// For each axis of each local node, the constraint that holds it, or [`ABSENT`].
    held: Vec<[u32; 3]>,
    /// Canonical numbers of the elements that are here, ascending.
    elements: Vec<u32>,
    search: Box<dyn Search>,
    decomposition: ContactDecomposition,
    reach: Reach,
    planes: Vec<RigidSurface>,
    /// Mean size of the faces: what overlaps with planes are small against.
    mean_size: f64,
    /// All points that planes watch.
    watches: Vec<PlanePoint>,
    limits: Limits,
    /// Work of normal and friction forces at points that are gone, those of this rank.
    lost_work: Vec<[f64; 2]>,
    /// What contact may give back of what it has taken.
    bank: Bank,
    /// Energy that contact has made.
    gain: Gain,
    /// What the log tells.
    pub tally: Tally,
    /// Number of searches so far.
    searches: u64,
    /// Number of steps so far.
    age: u64,
    /// Watched points and pairs of the last search, of all ranks.
    counts: [u64; 2],
}

/// Contact in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report {
    /// Points of contact.
    pub points: usize,
    /// Faces that they may touch.
    pub faces: usize,
    /// Edges that stand out.
    pub edges: usize,
    /// Points that the last search found near faces.
    pub watched: usize,
    /// Pairs of these points and faces.
    pub pairs: usize,
    /// Searches so far.
    pub searches: u64,
    /// Enforcement.
    pub tally: Tally,
}

/// Counts for the log.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    /// Steps in which anything was enforced.
    pub steps: u64,
    /// Passes in all of them.
    pub passes: u64,
    /// Steps in which the passes ran out.
    pub capped: u64,
    /// Largest overlap that was left, as a part of the face's size.
    pub left: f64,
    /// Deepest penetration that motion has made, as a part of the face's size.
    pub deepest: f64,
    /// The same in motions of a step, the farthest of those so far.
    pub motions: f64,
    /// Farthest motion of a contact along its normal in a step so far, a length.
    pub farthest: f64,
}

impl Contact {
    /// Contact as the model asks for it; `None` when it does not. `held[i]` says which constraint holds which
    /// direction of local node i; `local` gives the local node of a node of the mesh, `elements` the canonical numbers
    /// of the elements here, ascending.
    pub fn new(
        mesh: &Mesh,
        model: &Model,
        body: &Body,
        (nodes, held): (&Nodes, Vec<[u32; 3]>),
        (local, elements): (&[u32], &[u32]),
        comm: &mut dyn Communicator,
    ) -> Option<Contact> {
        if !model.contact.is_some() && model.rigid_surfaces.is_empty() {
            return None;
        }
        let watched: Vec<Vec<u32>> =
            model.rigid_surfaces.iter().map(|plane| mesh.side_set_nodes(plane.side_set)).collect();
        let skin = Skin::new(mesh, model, body, watched.concat());
        let layout = skin.layout();
        let mut contact = Contact {
            sites: Sites::default(),
            arena: Arena::default(),
            remote: None,
            carried: None,
            search: kind(model.contact.control.search).make(),
            decomposition: model.contact.control.decomposition,
            reach: reach(model, &layout),
            planes: model.rigid_surfaces.clone(),
            mean_size: mean_size(&layout),
            watches: plane_points(&watched, model, body, &layout),
            limits: limits(model, &watched),
            lost_work: Vec::new(),
            bank: Bank::default(),
            gain: Gain::default(),
            tally: Tally::default(),
            searches: 0,
            age: 0,
            counts: [0; 2],
            pairings: Pairings::new(mesh, model, body),
            elements: elements.to_vec(),
            held,
            skin,
            layout,
        };
        contact.meet(|node| local[node as usize], nodes, comm);
        Some(contact)
    }

    /// Finds the points that are nodes here, and gets to know the other ranks.
    fn meet(&mut self, local: impl Fn(u32) -> u32, nodes: &Nodes, comm: &mut dyn Communicator) {
        let Contact { layout, held, elements, .. } = self;
        let here = |point: u32| local(layout.nodes[point as usize]);
        self.sites = Sites::new((layout.nodes.len(), layout.origin), here, held, nodes);
        if layout.interfaces.is_empty() {
            // Planes alone need nobody else's nodes. Where there was more before, their forces were known at homes only.
            if let (Some(_), Some(history)) = (self.remote.take(), &mut self.carried) {
                let all = 0..comm.size() as u32;
                history.planes = share_planes(&history.planes, |_| all.clone(), comm);
            }
            self.arena = alone(layout, &self.sites, &self.watches, Default::default(), 0.0);
            // Nor a search, which would put history back.
            self.arena.restore(self.carried.take().unwrap_or_default());
        } else if comm.size() > 1 {
            let is_here = |face: u32| elements.binary_search(&(face / 6)).is_ok();
            self.remote = Some(Remote::new((layout, &self.sites), self.decomposition, is_here, comm));
        }
    }

    /// Lets the surface grow inwards after elements have gone: `dead` are their canonical numbers, ascending.
    pub fn erode(&mut self, dead: &[u32], erosion: &Erosion, nodes: &Nodes, comm: &mut dyn Communicator) {
        let history = self.carried.take().unwrap_or_else(|| self.arena.history());
        self.skin.delete(dead, &self.layout, |node| erosion.keeps(node));
        let old = std::mem::replace(&mut self.layout, self.skin.layout());
        reshape::take_over(&mut self.layout, &old);
        let old_sites = std::mem::take(&mut self.sites);
        let new = &self.layout;
        self.watches.iter_mut().for_each(|watch| watch.point = new.point(old.nodes[watch.point as usize]));
        self.carried = Some(renumbered(history, &old, new));
        self.meet(|node| erosion.local()[node as usize], nodes, comm);
        for (site, work) in old_sites.list.iter().zip(&old_sites.works) {
            match self.sites.of(self.layout.point(old.nodes[site.point as usize])) {
                Some(now) => self.sites.works[now] = *work,
                None if site.owned => self.lost_work.push(*work),
                None => (),
            }
        }
    }

    /// Finds the contact forces of the step and adds them to the nodes; along directions that are held, the
    /// constraint's reaction takes them up.
    pub fn apply(
        &mut self,
        nodes: &mut Nodes,
        held: &mut [HeldDirection],
        step: &StepTimes,
        comm: &mut dyn Communicator,
    ) {
        self.bring_motion(nodes, step, comm);
        comm.enter(Traffic::ContactPasses);
        let outcome = self.enforce(step, comm);
        self.count(outcome);
        comm.enter(Traffic::ContactMotion);
        self.bring_forces(comm);
        self.sites.hand_over(nodes, |holder, force| held[holder as usize].reaction -= force);
    }

    /// Finds where the nodes would go, searches if that is due, and brings their motion to the arena.
    fn bring_motion(&mut self, nodes: &Nodes, step: &StepTimes, comm: &mut dyn Communicator) {
        self.sites.predict(nodes, step);
        comm.enter(Traffic::ContactSearch);
        let reshaped = self.reshape(comm);
        if !self.layout.interfaces.is_empty() && (self.expired(comm) || reshaped) {
            self.search(comm);
        }
        comm.enter(Traffic::ContactMotion);
        let Contact { sites, arena, remote, .. } = self;
        match remote {
            Some(remote) => remote.send_motion(sites, arena, step.drift, comm),
            // The arena's points are the sites: lent, not copied.
            None => std::mem::swap(&mut arena.points, &mut sites.points),
        }
    }

    /// Brings the forces that the arena has found to the sites.
    fn bring_forces(&mut self, comm: &mut dyn Communicator) {
        let Contact { sites, arena, remote, .. } = self;
        match remote {
            Some(remote) => remote.send_forces(sites, arena, comm),
            None => {
                std::mem::swap(&mut arena.points, &mut sites.points);
                sites.pushed.clone_from(&arena.pushed);
                for &point in &arena.pushed {
                    sites.answers[point as usize] = arena.answers[point as usize];
                }
            }
        }
    }

    /// Brings what [`Contact::node_values`] and [`Contact::plane_forces`] tell beside forces to the nodes; before them,
    /// and all ranks call it.
    pub fn complete(&mut self, comm: &mut dyn Communicator) {
        let Contact { sites, arena, remote, .. } = self;
        if let Some(remote) = remote {
            remote.send_rest(sites, arena, comm);
        }
    }

    /// Whether any rank needs a search.
    fn expired(&self, comm: &mut dyn Communicator) -> bool {
        let expired = self.sites.expired;
        if self.remote.is_none() {
            return expired;
        }
        let mut vote = [-f64::from(u8::from(expired))];
        comm.all_min(&mut vote);
        vote[0] < 0.0
    }

    /// Finds all candidates anew.
    fn search(&mut self, comm: &mut dyn Communicator) {
        let Contact { layout, sites, arena, remote, carried, search, watches, .. } = self;
        let depth = self.reach.depth;
        self.searches += 1;
        sites.renew(self.reach.steps, self.reach.least);
        if let Some(remote) = remote {
            let history = carried.take().unwrap_or_else(|| arena.history());
            *arena = remote.decompose(&mut **search, (layout, watches, depth), sites, history, comm);
        } else {
            let points = neighbourhood::point_boxes(sites);
            let faces = neighbourhood::face_boxes(0..layout.faces.len() as u32, layout, sites);
            let edges = neighbourhood::edge_boxes(0..layout.edges.len() as u32, layout, sites);
            let found = neighbourhood::find(&mut **search, [&points, &faces, &edges], |_| true, layout);
            if carried.is_some() || self.searches == 1 {
                *arena = alone(layout, sites, watches, found, depth);
                arena.restore(carried.take().unwrap_or_default());
            } else {
                arena.renew(found, depth);
            }
        }
        let points = if remote.is_some() { &mut arena.points } else { &mut sites.points };
        points.count(arena.locator.moving().iter().copied());
        self.counts = self.arena.locator.counts().map(|count| count as u64);
        if self.remote.is_some() {
            comm.all_sum(&mut self.counts);
        }
    }

    fn enforce(&mut self, step: &StepTimes, comm: &mut dyn Communicator) -> Outcome {
        let Contact { arena, remote, pairings, planes, mean_size, limits, bank, .. } = self;
        let setting = Setting { pairings, planes, mean_size: *mean_size, limits: *limits };
        match remote {
            Some(remote) => arena.step(&setting, step, bank, &mut remote.others(comm)),
            None => arena.step(&setting, step, bank, &mut Alone),
        }
    }

    fn count(&mut self, Outcome { passes, left, deepest, depth, motion }: Outcome) {
        self.tally.deepest = self.tally.deepest.max(deepest);
        self.tally.farthest = self.tally.farthest.max(motion);
        if depth > 0.0 {
            self.tally.motions = self.tally.motions.max(depth / self.tally.farthest);
        }
        self.tally.steps += u64::from(passes > 0);
        self.tally.passes += u64::from(passes);
        self.tally.capped += u64::from(left > self.limits.tolerance && self.limits.tolerance.is_finite());
        self.tally.left = self.tally.left.max(left);
    }

    /// Books half the step's work with the present velocities.
    pub fn book(&mut self, nodes: &Nodes, half_step: f64) {
        self.sites.book(nodes, half_step);
    }

    /// Work of normal and of friction forces so far, at every point that this rank owns, and of points now gone.
    pub fn works(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let owned = self.sites.list.iter().zip(&self.sites.works).filter(|(site, _)| site.owned);
        owned.map(|(_, work)| *work).chain(self.lost_work.iter().copied())
    }

    /// Forces of rigid planes at local nodes.
    pub fn plane_forces(&self) -> impl Iterator<Item = (u32, [f64; 3])> + '_ {
        self.answers().map(|(node, a)| (node, [a[9], a[10], a[11]])).filter(|(_, force)| *force != [0.0; 3])
    }

    fn answers(&self) -> impl Iterator<Item = (u32, &[f64; contact_nodes::ANSWER])> + '_ {
        let sites = &self.sites;
        sites.pushed.iter().map(|&i| (sites.list[i as usize].node, &sites.answers[i as usize]))
    }

    /// At each local node that is pushed: contact force, overlap that contact closes in the coming step, status (0 free,
    /// 1 pushed, 2 pushed by its own contact with a face), and the place in the mesh file, from 1, of the element whose face
    /// it meets.
    pub fn node_values(&self) -> Vec<(u32, [f64; 6])> {
        let value = |(node, a): (u32, &[f64; contact_nodes::ANSWER])| {
            let element = if a[7] == 2.0 { self.skin.file_number(a[8] as u32) } else { 0.0 };
            (node, [a[0] + a[3], a[1] + a[4], a[2] + a[5], a[6], a[7], element])
        };
        self.answers().map(value).collect()
    }

    /// Local nodes on the surface, and the ranks that compute their contact.
    pub fn homes(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let homes = self.sites.homes.iter().copied().chain(std::iter::repeat(0));
        self.sites.list.iter().map(|site| site.node).zip(homes)
    }

    /// Forgets the forces of this step.
    pub fn forget(&mut self) {
        self.sites.pushed.clear();
        self.arena.forget();
    }

    /// What the log tells at the end; nothing of planes alone, of which each rank knows its own only.
    pub fn report(&self) -> Option<Report> {
        let [watched, pairs] = self.counts.map(|count| count as usize);
        (!self.layout.interfaces.is_empty()).then_some(Report {
            points: self.layout.nodes.len(),
            faces: self.layout.faces.len(),
            edges: self.layout.edges.iter().filter(|edge| edge.stands_out()).count(),
            watched,
            pairs,
            searches: self.searches,
            tally: self.tally,
        })
    }
}

/// An arena that holds what this rank has, and everything when there is no other.
fn alone(layout: &Layout, sites: &Sites, watches: &[PlanePoint], found: neighbourhood::Found, depth: f64) -> Arena {
    let cast = Cast {
        points: sites.list.iter().map(|site| site.point).collect(),
        ghosts: Vec::new(),
        faces: (0..layout.faces.len() as u32).collect(),
        edges: (0..layout.edges.len() as u32).collect(),
    };
    let here: Vec<PlanePoint> = watches.iter().filter(|watch| sites.of(watch.point).is_some()).copied().collect();
    Arena::new(cast, found, depth, layout, &here)
}

/// A history in the numbers of a new layout.
fn renumbered(history: History, old: &Layout, new: &Layout) -> History {
    let point = |point: u32| new.point(old.nodes[point as usize]);
    let face = |past: Past| match past.face {
        NONE => past,
        face => Past { face: new.face(old.faces.number[face as usize]), ..past },
    };
    let edge = |edge: u32| new.edge(old.edges[edge as usize].ends.map(|point| old.nodes[point as usize]));
    let points = history.points.into_iter().map(|(p, pasts)| (point(p), pasts.map(face)));
    let edges = history
        .edges
        .into_iter()
        .filter_map(|past| Some(PastPair { pair: [edge(past.pair[0])?, edge(past.pair[1])?], ..past }))
        .filter_map(|past| edges::in_order(past, &new.edges));
    History {
        points: points.filter(|(point, _)| *point != ABSENT).collect(),
        edges: edges.collect(),
        planes: history.planes,
    }
}

fn kind(search: ContactSearch) -> SearchKind {
    match search {
        ContactSearch::PointInBox => SearchKind::PointInBox,
        ContactSearch::Grid => SearchKind::Grid,
        ContactSearch::Tree => SearchKind::Bvh,
    }
}

/// Mean size of the faces, 1 where there are none.
fn mean_size(layout: &Layout) -> f64 {
    let sizes = &layout.faces.size;
    if sizes.is_empty() { 1.0 } else { sizes.iter().sum::<f64>() / sizes.len() as f64 }
}

fn reach(model: &Model, layout: &Layout) -> Reach {
    let control = &model.contact.control;
    let mean = mean_size(layout);
    // A reach of one step at least: the search must hold for the step it is made for.
    let least = if control.reach > 0.0 { control.margin * mean } else { 0.0 };
    Reach { steps: control.reach.max(1.0), least, depth: node_face::KEEP }
}

/// How far the passes go. All ranks must make the same number of them. With surfaces every rank sees all constraints and
/// stops at the same pass; planes alone are each rank's own, and get as many passes as they can need.
fn limits(model: &Model, watched: &[Vec<u32>]) -> Limits {
    let control = &model.contact.control;
    if model.contact.is_some() {
        return Limits { passes: control.passes, tolerance: control.tolerance };
    }
    let mut nodes = watched.concat();
    nodes.sort_unstable();
    let alone = nodes.windows(2).all(|pair| pair[0] != pair[1]);
    Limits { passes: if alone { 1 } else { control.passes }, tolerance: f64::NEG_INFINITY }
}

fn plane_points(watched: &[Vec<u32>], model: &Model, body: &Body, layout: &Layout) -> Vec<PlanePoint> {
    let mut list = Vec::new();
    for (number, (plane, nodes)) in model.rigid_surfaces.iter().zip(watched).enumerate() {
        for &node in nodes {
            if let Ok(point) = layout.nodes.binary_search(&node) {
                let watch = PlanePoint::new(point as u32, number, plane, body.positions[node as usize]);
                list.push(PlanePoint { number: list.len() as u32, ..watch });
            }
        }
    }
    list
}

/// The constraint of a point on a face. `None` where the point is to be the master only.
fn constraint(faces: &Faces, pairing: Pairing, point: u32, touch: &Touch) -> Option<Constraint> {
    let face = touch.face as usize;
    // A point without faces of its own cannot be the master of anything.
    let share = if faces.around(point).is_empty() { 1.0 } else { pairing.share };
    if share <= 0.0 {
        return None;
    }
    let mut constraint = Constraint {
        members: [point; MEMBERS],
        weights: [1.0; MEMBERS],
        count: MEMBERS,
        normal: touch.stand.normal,
        gap: touch.stand.gap - touch.allowed,
        held: touch.time < 0.0,
        size: faces.size[face],
        share,
        friction: pairing.friction,
        carried: Carried::NOTHING,
        origin: Origin::Face(point, 0),
    };
    constraint.members[1..].copy_from_slice(&faces.corners[face]);
    for (weight, n) in constraint.weights[1..].iter_mut().zip(touch.stand.weights) {
        *weight = -n;
    }
    Some(constraint)
}
