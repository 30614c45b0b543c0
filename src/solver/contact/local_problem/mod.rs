//! The local contact problem: some points and faces of the layout, their candidates and their history; contact is computed here.
//!
//! On one rank it holds them all. On many it holds what the last decomposition has given to this rank and what that may
//! meet; it has numbers of its own, in the order of the layout, so that ties fall the same way.

mod costs;
mod history;
mod outcome;

use super::check::edge_edge::{self, EdgeCheck, EdgeContact, EdgeVerdict};
use super::check::node_face::unforeseen::{STOPPED, STRUCK};
use super::check::node_face::{self, DetectedContact, FaceContact, MAX_FACES, NO_CONTACT, NONE, NodeFaceCheck};
use super::check::planes::PlaneNode;
use super::enforcement::accounts::certificate::Bank;
use super::enforcement::accounts::ledger::Ledger;
use super::enforcement::carried::Carried;
use super::enforcement::constraint::{Constraint, Origin};
use super::enforcement::enforcer::Enforcer;
use super::enforcement::iterations::{Limits, Outcome};
use super::enforcement::other_ranks::OtherRanks;
use super::enforcement::pinned_bodies::{self, Among};
use super::geometry::edges::Edge;
use super::geometry::faces::Faces;
use super::geometry::motion::NodeMotion;
use super::nodes::result::NodeResult;
use super::nodes::sparse::Sparse;
use super::observations::meetings::{Blocks, Meetings};
use super::search::locate::{Candidate, Locator, Rule};
use super::search::neighbourhood::SearchResult;
use super::surface::layout::{ABSENT, Layout, inverse};
use super::surface::pairings::{Pairing, Pairings};
use crate::lanes::Vectors;
use crate::model::RigidSurface;
use crate::solver::constraints::StepTimes;
use std::sync::Arc;

pub use history::{History, PlaneHistory};

/// Numbers in the layout of the points, faces and edges of a local problem, ascending: the place in a list is the local number.
#[derive(Debug, Clone, Default)]
pub struct Numbering {
    /// Points whose motion is known here.
    pub points: Vec<u32>,
    /// Points that only take part in constraints of other ranks, not among `points`.
    pub ghosts: Vec<u32>,
    /// Faces.
    pub faces: Vec<u32>,
    /// Edges.
    pub edges: Vec<u32>,
}

/// Points that may touch, and everything about them.
#[derive(Default)]
pub struct LocalProblem {
    /// Motion of the points; where they are the contact nodes of this rank it is lent for a step, and else there are none.
    pub motion: NodeMotion,
    /// Candidates.
    pub locator: Locator,
    /// Which points, faces and edges are here.
    pub numbering: Numbering,
    /// Where each point of the layout is here.
    places: Vec<u32>,
    faces: Arc<Faces>,
    edges: Vec<Edge>,
    /// Whether edges of the layout hold each other, here or on another rank.
    edges_hold: bool,
    /// How far around itself each edge looks for others, a length.
    edge_reaches: Vec<f64>,
    /// The least of them of lines.
    least_line_reach: f64,
    point_block: Vec<u32>,
    /// Blocks that have a say at each point, and at each face.
    blocks_around: [Vec<Blocks>; 2],
    rules: Vec<Rule>,
    /// What each point touches.
    history: Sparse<[FaceContact; MAX_FACES]>,
    edge_history: Vec<EdgeContact>,
    planes: Vec<PlaneNode>,
    /// Constraints of this step.
    pub constraints: Vec<Constraint>,
    enforcer: Enforcer,
    /// What contact says of each point.
    pub results: Sparse<NodeResult>,
    /// Points on which contact forces act now, ascending.
    pub loaded: Vec<u32>,
    near: Vec<Candidate>,
    pair_places: Vec<u32>,
    contacts: Vec<DetectedContact>,
    /// Points that others stop, and places in their history of what they meet because of that.
    stopped: Vec<(u32, u32)>,
    /// Points that others may push to a face in this step, the places of these constraints among those of the point, and the faces.
    struck: Vec<(u32, u32, u32)>,
    /// Whether this rank answers for each point, where others may have it as well: planes alone with rigid bodies on many
    /// ranks; else empty.
    pub answers: Vec<bool>,
}

/// What a step needs to know of the model.
pub struct StepInput<'a> {
    /// What holds between blocks and pairs.
    pub pairings: &'a Pairings,
    /// Rigid planes.
    pub planes: &'a [RigidSurface],
    /// Mean size of the faces, a length: what overlaps with planes are small against.
    pub mean_size: f64,
    /// How far the iterations go.
    pub limits: Limits,
    /// Part of the tolerated overlaps that is left after the step.
    pub remaining: f64,
    /// Whether edges look for lines of faces in this step, see [`EdgeCheck`].
    pub lines: bool,
}

impl LocalProblem {
    /// A local problem with these points, faces and edges. `found` is in numbers of the layout, as is `plane_nodes`, the
    /// planes' points that this rank answers for.
    pub fn new(
        numbering: Numbering,
        found: SearchResult,
        depth: f64,
        layout: &Layout,
        plane_nodes: &[PlaneNode],
    ) -> LocalProblem {
        let points = numbering.points.len();
        let mut places = inverse(numbering.points.iter().copied(), layout.nodes.len());
        let face_places = inverse(numbering.faces.iter().copied(), layout.faces.len());
        let whole = points == layout.nodes.len() && numbering.faces.len() == layout.faces.len();
        let faces = if whole {
            layout.faces.clone()
        } else {
            Arc::new(layout.faces.subset(&numbering.faces, |point| places[point as usize], points))
        };
        let local = |point: u32| places[point as usize];
        let edges = numbering.edges.iter().map(|&edge| {
            let edge = layout.edges[edge as usize];
            let faces = edge.faces.map(|face| face_places[face as usize]);
            Edge { ends: edge.ends.map(local), faces, ..edge }
        });
        let edges: Vec<Edge> = edges.collect();
        let found = SearchResult {
            slave_nodes: found.slave_nodes.into_iter().map(local).collect(),
            first: found.first,
            candidates: found
                .candidates
                .into_iter()
                .map(|near| Candidate { face: face_places[near.face as usize], ..near })
                .collect(),
            pairs: found.pairs.into_iter().map(|pair| pair.map(|edge| place(&numbering.edges, edge))).collect(),
        };
        let planes =
            plane_nodes.iter().map(|plane_node| PlaneNode { point: local(plane_node.point), ..*plane_node }).collect();
        (points as u32..).zip(&numbering.ghosts).for_each(|(place, &ghost)| places[ghost as usize] = place);
        let all = points + numbering.ghosts.len();
        let mut problem = LocalProblem {
            locator: Locator::new(found, depth, points, &faces, &edges),
            edges,
            edges_hold: !layout.edges.is_empty(),
            point_block: numbering.points.iter().map(|&point| layout.point_block[point as usize]).collect(),
            blocks_around: [
                numbering.points.iter().map(|&point| layout.blocks_around[0][point as usize]).collect(),
                numbering.faces.iter().map(|&face| layout.blocks_around[1][face as usize]).collect(),
            ],
            rules: layout.interfaces.iter().map(|interface| interface.rule).collect(),
            history: Sparse::new(NO_CONTACT, points),
            planes,
            places,
            enforcer: Enforcer::new(all),
            results: Sparse::new(NodeResult::FREE, all),
            faces,
            numbering,
            ..Default::default()
        };
        problem.measure_edges();
        problem
    }

    /// Place of a point of the layout here, or [`ABSENT`].
    pub fn place(&self, point: u32) -> u32 {
        self.places.get(point as usize).copied().unwrap_or(ABSENT)
    }

    /// The candidates of the last search are replaced; history is kept of points that still have any.
    pub fn renew(&mut self, found: SearchResult, depth: f64) {
        let mut slave_nodes = found.slave_nodes.iter().peekable();
        for point in 0..self.history.len() {
            // Whether a point without candidates is looked at must not depend on when the search is made.
            if slave_nodes.next_if(|&&next| next as usize == point).is_none() {
                self.history.reset(point);
            }
        }
        let before = std::mem::take(&mut self.locator);
        self.locator = Locator::new(found, depth, self.numbering.points.len(), &self.faces, &self.edges);
        self.locator.take_over(&before, [&self.numbering; 2]);
    }

    /// Lets go of faces that it shares with the layout, so that they can be changed without a copy; until they are shared again.
    pub fn release_faces(&mut self) {
        self.faces = Arc::default();
    }

    /// Faces of the layout that all belong to this local problem, shared with it. `grown` says whether one of them has become deeper.
    pub fn share_faces(&mut self, faces: &Arc<Faces>, grown: bool) {
        if grown {
            self.locator.wake_all();
        }
        self.faces = faces.clone();
        self.measure_edges();
    }

    /// Gives faces of the layout, as far as they are here, their thinnings; see [`Faces::set_thinning`].
    pub fn update_depths(&mut self, changed: impl Iterator<Item = (u32, u8)>) {
        let faces = Arc::make_mut(&mut self.faces);
        let mut grown = false;
        for (face, thinning) in changed {
            let here = place(&self.numbering.faces, face);
            if (here as usize) < faces.len() {
                grown |= faces.set_thinning(here, thinning);
            }
        }
        if grown {
            self.locator.wake_all();
        }
        self.measure_edges();
    }

    /// Gives the edges, all of the layout, the shapes that they have now.
    pub fn update_edge_shapes(&mut self, edges: &[Edge]) {
        let LocalProblem { locator, edges: own, .. } = self;
        locator.wake_pairs(|edge| own[edge as usize].shape != edges[edge as usize].shape);
        self.edges.iter_mut().zip(edges).for_each(|(own, now)| own.shape = now.shape);
        self.edge_history = self.edge_history.iter().filter_map(|&past| edge_edge::in_order(past, edges)).collect();
        self.edge_history.sort_by_key(|past| past.pair);
        self.measure_edges();
    }

    fn measure_edges(&mut self) {
        let faces = &self.faces;
        self.edge_reaches = self.edges.iter().map(|edge| edge_edge::reach(faces, edge)).collect();
        let lines = self.edges.iter().zip(&self.edge_reaches).filter(|(edge, _)| !edge.stands_out());
        self.least_line_reach = lines.fold(f64::INFINITY, |least, (_, reach)| least.min(*reach));
    }

    /// Finds the constraints of a step, whose motion is in `motion`; `met` learns which blocks meet.
    pub fn find_constraints(&mut self, setting: &StepInput, step: &StepTimes, met: &mut Meetings) {
        match self.motion.instructions().vectors() {
            // SAFETY: an instruction set is one that this processor has, and AVX-512 includes AVX2.
            #[cfg(target_arch = "x86_64")]
            Vectors::Avx2 | Vectors::Avx512 => unsafe { self.find_constraints_avx2(setting, step, met) },
            _ => self.find_each(setting, step, met),
        }
    }

    /// The same with boxes and corners as whole vectors. `unsafe` for a tenth of the instructions of contact on a brick
    /// wall, with those of the sweeps.
    ///
    /// # Safety
    ///
    /// The processor must have AVX2.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn find_constraints_avx2(&mut self, setting: &StepInput, step: &StepTimes, met: &mut Meetings) {
        self.find_each(setting, step, met)
    }

    // Inlined, as what it calls most is, so that it is compiled for the instructions of its caller.
    #[inline(always)]
    fn find_each(&mut self, setting: &StepInput, step: &StepTimes, met: &mut Meetings) {
        self.constraints.clear();
        if !self.rules.is_empty() {
            self.locator.step(&self.motion, &self.faces);
            self.check(setting, step.drift, met);
            self.check_edges(setting.pairings, setting.lines, met);
        }
        // With rigid bodies or joints alone, no force of a step can push a node in that is farther away than a face is large.
        let reach = match (self.rules.is_empty(), self.are_coupled()) {
            (false, _) => f64::INFINITY,
            (true, true) => setting.mean_size,
            (true, false) => 0.0,
        };
        for plane_node in &mut self.planes {
            self.constraints.extend(plane_node.constraint(setting.planes, &self.motion, setting.mean_size, reach));
        }
        self.origins();
    }

    /// Finds the forces of the constraints; the velocities before the step of all their members are known by now.
    pub fn find_forces(
        &mut self,
        setting: &StepInput,
        step: &StepTimes,
        bank: &mut Bank,
        others: &mut dyn OtherRanks,
    ) -> Outcome {
        let coupled = self.are_coupled();
        let LocalProblem { constraints, enforcer, motion, answers, .. } = self;
        // Of planes alone each rank knows its own.
        let ledger = if coupled { Ledger::Bank(bank) } else { Ledger::EachNode };
        enforcer.prepare(constraints, motion, step.drift, &ledger);
        for (c, state) in constraints.iter().zip(enforcer.states()).filter(|_| !answers.is_empty()) {
            state.own = answers[c.members[0] as usize];
        }
        if !motion.mobility.bodies.is_empty() {
            pinned_bodies::share_room(constraints, enforcer.states(), motion, (Among::OneLine, others));
        }
        let own = constraints.len();
        others.copy(constraints, enforcer.states());
        let order = enforcer.merge(constraints, own);
        let outcome = enforcer.solve(constraints, motion, step, setting.limits, (ledger, others));
        match order {
            None => (0..own).for_each(|i| self.remember(i)),
            Some(order) => (0..order.len()).filter(|&i| order[i] < own as u32).for_each(|i| self.remember(i)),
        }
        self.forget_idle();
        self.tell_nodes();
        outcome
    }

    /// Tells which blocks have met only because others pushed them together.
    pub fn meet_struck(&self, met: &mut Meetings) {
        let [of_points, of_faces] = &self.blocks_around;
        for c in self.constraints.iter().filter(|c| c.carried.normal_force > 0.0) {
            let Origin::Face(_, place) = c.origin else { continue };
            let found = self.struck.binary_search_by_key(&(c.members[0], place), |&(point, place, _)| (point, place));
            if let Ok(found) = found {
                met.meet(of_points[c.members[0] as usize], of_faces[self.struck[found].2 as usize]);
            }
        }
    }

    /// Deepest penetration between members that nothing can move, as a part of the face's size, and one of them by its number in the
    /// layout; `None` where there is none.
    pub fn held(&self) -> Option<(f64, u32)> {
        let (part, point) = self.enforcer.held;
        (part > 0.0).then_some((part, *self.numbering.points.get(point as usize)?))
    }

    /// Whether constraints of different points act on each other.
    fn are_coupled(&self) -> bool {
        !self.rules.is_empty() || self.motion.mobility.is_coupled()
    }

    /// Origins tell the order of constraints to all ranks: they are in numbers of the layout.
    fn origins(&mut self) {
        for c in &mut self.constraints {
            c.origin = match c.origin {
                Origin::Face(point, place) => Origin::Face(self.numbering.points[point as usize], place),
                Origin::Edges(a, b) => {
                    Origin::Edges(self.numbering.edges[a as usize], self.numbering.edges[b as usize])
                }
                Origin::Plane(number) => Origin::Plane(number),
            };
        }
    }

    /// The detailed check of every point with candidates; what it touches becomes constraints and history.
    #[inline(always)]
    fn check(&mut self, setting: &StepInput, drift: f64, met: &mut Meetings) {
        let StepInput { pairings, remaining, .. } = *setting;
        let LocalProblem { motion, faces, point_block, blocks_around, rules, locator, history, .. } = self;
        let LocalProblem { constraints, near, contacts, stopped, struck, edges_hold, .. } = self;
        stopped.clear();
        struck.clear();
        let (edges_hold, have_friction) = (*edges_hold, pairings.have_friction);
        let longest_path = locator.longest_path();
        for i in 0..locator.slave_nodes().len() {
            if locator.is_quiet(i) {
                continue;
            }
            let point = locator.slave_nodes()[i];
            locator.locate(i, motion, faces, &history[point as usize], near);
            if near.is_empty() {
                if locator.is_held(i) {
                    history.reset(point as usize);
                    locator.set_held(i, false);
                }
                continue;
            }
            // The history of the many that nothing holds need not be fetched.
            let before = if locator.is_held(i) { history[point as usize] } else { NO_CONTACT };
            let check = NodeFaceCheck { motion, faces, rules, longest_path, edges_hold, have_friction };
            check.leave_out_symmetry_planes(point, near);
            check.point(point, near, &before, contacts);
            if contacts.is_empty() && !locator.is_held(i) {
                continue;
            }
            locator.set_held(i, contacts.iter().any(|contact| contact.time < STRUCK));
            history.reset(point as usize);
            for (place, contact) in contacts.iter().enumerate() {
                let interface = near.iter().find(|near| near.face == contact.face).map_or(0, |near| near.interface);
                let rule = rules[interface as usize];
                if contact.time < STRUCK {
                    met.meet(blocks_around[0][point as usize], blocks_around[1][contact.face as usize]);
                } else {
                    struck.push((point, place as u32, contact.face));
                }
                let pairing = pairings.of(rule, point_block[point as usize], faces.block[contact.face as usize]);
                let before_growth = contact.tolerated;
                let contact = &DetectedContact { tolerated: remaining * before_growth, ..*contact };
                if let Some(mut constraint) = node_face::constraint(faces, pairing, point, contact) {
                    constraint.growth = (contact.tolerated - before_growth) / drift;
                    let past = past_of(faces, &before, contacts, contact);
                    (constraint.carried, constraint.yields) =
                        past.map_or((Carried::NOTHING, false), |past| (past.carried, past.yields));
                    constraint.origin = Origin::Face(point, place as u32);
                    constraints.push(constraint);
                }
                if contact.time < STRUCK {
                    history.own(point as usize)[place] =
                        FaceContact { face: contact.face, tolerated: contact.tolerated, ..NO_CONTACT[0] };
                }
                if contact.time == STOPPED {
                    stopped.push((point, place as u32));
                }
            }
        }
    }

    /// The check of every pair of edges that may cross; of new ones with a line of a face only where `lines` are due, or where an edge
    /// comes fast.
    #[inline(always)]
    fn check_edges(&mut self, pairings: &Pairings, lines: bool, met: &mut Meetings) {
        let LocalProblem { motion, faces, locator, edges, edge_reaches, least_line_reach, edge_history, .. } = self;
        let LocalProblem { pair_places, constraints, blocks_around: [_, around], .. } = self;
        let blocks = |edge: u32| edges[edge as usize].faces.iter().fold(0, |set, &face| set | around[face as usize]);
        let block = |edge: u32| faces.block[edges[edge as usize].faces[0] as usize];
        let before = std::mem::take(edge_history);
        let steps = super::LINES_EVERY as f64;
        let until_lines = if lines { 0.0 } else { steps };
        let some_are_fast = steps * locator.farthest_approach() > edge_edge::unseen(*least_line_reach);
        locator.pairs_to_check(lines || some_are_fast, before.iter().map(|past| &past.pair), pair_places);
        let mut past = before.iter().peekable();
        for place in pair_places.iter().map(|&place| place as usize) {
            if !locator.is_pair_due(place) {
                continue;
            }
            let pair = locator.edge_pairs()[place];
            while past.next_if(|past| past.pair < pair).is_some() {}
            let past = past.next_if(|past| past.pair == pair);
            // Neither edge is the master.
            let pairing = || Pairing { share: 0.5, ..pairings.of(Rule::Blocks, block(pair[0]), block(pair[1])) };
            let [first, second] = pair.map(|edge| &edges[edge as usize]);
            let ([a, b], [c, d]) = (first.ends, second.ends);
            motion.place_all([a, b, c, d]);
            if second.is_ridge() {
                motion.place_all(second.points(faces));
            }
            let check = EdgeCheck { motion, faces, edges, reaches: edge_reaches };
            match check.pair(pair, past, until_lines, pairing) {
                EdgeVerdict::Touching(now, constraint) => {
                    locator.let_pair_wait(place, 0.0);
                    met.meet(blocks(pair[0]), blocks(pair[1]));
                    met.edges = true;
                    edge_history.push(now);
                    constraints.push(*constraint);
                }
                EdgeVerdict::Apart(apart) => locator.let_pair_wait(place, apart),
            }
        }
    }

    /// Forgets the forces of this step.
    pub fn forget(&mut self) {
        self.loaded.drain(..).for_each(|point| self.results.reset(point as usize));
        self.constraints.clear();
    }
}

/// Place of a number in an ascending list, or [`ABSENT`].
fn place(list: &[u32], number: u32) -> u32 {
    // Where a list is whole, every number is its own place.
    if list.get(number as usize) == Some(&number) {
        return number;
    }
    list.binary_search(&number).map_or(ABSENT, |place| place as u32)
}

/// What a touch was in the last step. A point that has slid on to the next face takes it along.
fn past_of<'a>(
    faces: &Faces,
    before: &'a [FaceContact; MAX_FACES],
    contacts: &[DetectedContact],
    contact: &DetectedContact,
) -> Option<&'a FaceContact> {
    let same = before.iter().find(|past| past.face == contact.face);
    let left = |past: &&FaceContact| past.face != NONE && contacts.iter().all(|contact| contact.face != past.face);
    let beside = || before.iter().filter(left).find(|past| faces.adjacent(past.face, contact.face));
    same.or_else(beside)
}
