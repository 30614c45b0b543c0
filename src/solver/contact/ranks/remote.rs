//! Contact on many ranks: two decompositions and the messages between them (Attaway et al. 1996, "Parallel contact").
//!
//! Elements and nodes stay where they are. At every search the points of contact are shared out anew, by recursive bisection
//! unless CONTACT DECOMPOSITION says otherwise; each goes, with its history, to the rank of its region, its owner rank, and
//! faces and edges go to every rank whose points they may meet. That rank searches, and checks and enforces until the next
//! search. In between, only motion travels to the owner ranks, changes of velocity between owner ranks in the iterations, and
//! forces back.
//!
//! [`Regional`] is what a search brings to a rank, [`route`] takes history along, [`CommunicationPlan`] says who must know of whose
//! points in the iterations, and [`IterationMessages`] are these messages.

use super::communication_plan::{CommunicationPlan, numbering};
use super::iteration_messages::{IterationExchange, IterationMessages};
use super::node_ranks::NodeRanks;
use super::owner_ranks::OwnerRanks;
use super::regional::Regional;
use super::routing::route;
use super::traffic::{Lists, MessagePattern};
use crate::comm::Communicator;
use crate::model::ContactDecomposition;
use crate::partition::dynamic::{Parcels, Records};
use crate::solver::contact::check::planes::PlaneNode;
use crate::solver::contact::geometry::motion::NodeMotion;
use crate::solver::contact::local_problem::{History, LocalProblem};
use crate::solver::contact::nodes::ContactNodes;
use crate::solver::contact::nodes::result::{Details, FORCES, NodeResult, Status};
use crate::solver::contact::search::{Search, neighbourhood};
use crate::solver::contact::surface::layout::{ABSENT, Layout};

/// Forces on a node without contact. No sum that begins with +0 comes out as −0.
const AT_REST: [f64; FORCES] = [-0.0; FORCES];

/// What one rank knows of the others.
pub struct Remote {
    /// Who has the nodes of the points.
    pub node_ranks: NodeRanks,
    /// Faces and edges of elements that are here.
    faces: Vec<u32>,
    edges: Vec<u32>,
    /// How points are shared out.
    decomposition: OwnerRanks,
    motion: MessagePattern,
    /// Messages of the results to other ranks.
    results: MessagePattern,
    /// For every point of the local problem on which forces may act and whose node is here, its contact node; else [`ABSENT`].
    own: Vec<u32>,
    iteration_messages: IterationMessages,
}

impl Remote {
    /// Gets to know the others. `is_here` says whether the element of a face is on this rank. All ranks call it.
    pub fn new(
        (layout, contact_nodes): (&Layout, &ContactNodes),
        method: ContactDecomposition,
        is_here: impl Fn(u32) -> bool,
        comm: &mut dyn Communicator,
    ) -> Remote {
        let here = |face: &u32| is_here(layout.faces.number[*face as usize]);
        Remote {
            node_ranks: NodeRanks::gather(layout.nodes.len(), contact_nodes, comm),
            faces: (0..layout.faces.len() as u32).filter(here).collect(),
            edges: (0..layout.edges.len() as u32).filter(|&e| here(&layout.edges[e as usize].faces[0])).collect(),
            decomposition: OwnerRanks::new(method),
            motion: MessagePattern::default(),
            results: MessagePattern::default(),
            own: Vec::new(),
            iteration_messages: IterationMessages::default(),
        }
    }

    /// Faces of elements that are here, ascending.
    pub fn faces(&self) -> &[u32] {
        &self.faces
    }

    /// Brings the motion of a step to the owner ranks. What is a node here stays where it is.
    pub fn send_motion(
        &mut self,
        contact_nodes: &mut ContactNodes,
        problem: &mut LocalProblem,
        comm: &mut dyn Communicator,
    ) {
        let (from, to) = (&mut contact_nodes.motion, &mut problem.motion);
        self.motion.send(|contact_node| from.message(contact_node), comm);
        to.borrow_from(from);
        self.motion.receive(|point, message| to.receive(point, message), comm);
    }

    /// Contact nodes whose motion goes to other ranks.
    pub fn sent(&self) -> impl Iterator<Item = usize> + '_ {
        self.motion.sent().map(|contact_node| contact_node as usize)
    }

    /// Brings the forces that contact has found to the nodes.
    pub fn send_forces(
        &mut self,
        contact_nodes: &mut ContactNodes,
        problem: &LocalProblem,
        comm: &mut dyn Communicator,
    ) {
        contact_nodes.loaded.clear();
        self.results.exchange(
            &mut (&mut *contact_nodes, problem),
            |(_, problem), point| {
                let result = &problem.results[point as usize];
                if result.details.status == Status::Free { AT_REST } else { result.pack_forces() }
            },
            |(contact_nodes, _), contact_node, forces| {
                // All bits at once: comparing the arrays would be a call for every point.
                let unlike = forces.iter().zip(AT_REST).fold(0, |all, (a, b)| all | (a.to_bits() ^ b.to_bits()));
                if unlike != 0 {
                    contact_nodes.loaded.push((contact_node, NodeResult::unpack_forces(forces)));
                }
            },
            comm,
        );
        for &point in &problem.loaded {
            if let Some(&contact_node) = self.own.get(point as usize).filter(|&&contact_node| contact_node != ABSENT) {
                contact_nodes.loaded.push((contact_node, problem.results[point as usize]));
            }
        }
        contact_nodes.loaded.sort_unstable_by_key(|(contact_node, _)| *contact_node);
    }

    /// Brings the details of what contact has found in this step to the nodes that other ranks load: only output asks for them.
    pub fn send_details(
        &mut self,
        contact_nodes: &mut ContactNodes,
        problem: &LocalProblem,
        comm: &mut dyn Communicator,
    ) {
        self.results.exchange(
            &mut (contact_nodes, problem),
            |(_, problem), point| problem.results[point as usize].details.pack(),
            |(contact_nodes, _), contact_node, details| {
                // What takes part in nothing has no forces and no details.
                if let Some(result) = contact_nodes.result(contact_node) {
                    result.details = Details::unpack(details);
                }
            },
            comm,
        );
    }

    /// What owner ranks tell each other, for one step.
    pub fn others<'a>(&'a mut self, comm: &'a mut dyn Communicator) -> IterationExchange<'a> {
        self.iteration_messages.over(comm)
    }

    /// Shares out the points anew, searches, and makes the local problem of this rank.
    pub fn decompose(
        &mut self,
        search: &mut dyn Search,
        extent: (&Layout, &[PlaneNode], f64),
        contact_nodes: &mut ContactNodes,
        history: History,
        comm: &mut dyn Communicator,
    ) -> LocalProblem {
        let (layout, plane_nodes, depth) = extent;
        contact_nodes.owner_ranks = self.decomposition.find(contact_nodes, &self.node_ranks, &history.costs, comm);
        let history = self.forward(layout, contact_nodes, plane_nodes, history, comm);
        let regional = Regional::gather((&self.faces, &self.edges), layout, contact_nodes, comm);
        let lists = [&regional.points, &regional.faces, &regional.edges];
        let found = neighbourhood::find(search, lists, |edge| regional.own_edges.binary_search(&edge).is_ok(), layout);
        let plan = CommunicationPlan::new(layout, &found, &regional, comm);
        let is_own = |plane_node: &&PlaneNode| regional.points.ids.binary_search(&plane_node.point).is_ok();
        let plane_nodes: Vec<PlaneNode> = plane_nodes.iter().filter(is_own).copied().collect();
        let numbering = numbering(layout, &found, &plan, &plane_nodes);
        let node = |&point: &u32| {
            let own = self.node_ranks.owner(point) == comm.rank() as u32;
            contact_nodes.of(point).filter(|_| own).map(|contact_node| contact_nodes.list[contact_node].node)
        };
        let motion = NodeMotion::of_some(numbering.points.iter().map(node), layout.origin);
        let mut problem = LocalProblem::new(numbering, found, depth, layout, &plane_nodes);
        problem.motion = motion;
        self.connect(contact_nodes, &mut problem, &plan, &plane_nodes, comm);
        problem.restore(history);
        problem
    }

    /// Brings history from where it was to the new owner ranks, by way of the ranks that own the nodes and know the owner ranks.
    fn forward(
        &self,
        layout: &Layout,
        contact_nodes: &ContactNodes,
        plane_nodes: &[PlaneNode],
        history: History,
        comm: &mut dyn Communicator,
    ) -> History {
        let at = |point: u32| layout.edges.get(point as usize).map_or(0, |edge| edge.ends[0]);
        let first = route(history, |point| self.node_ranks.owner(point), at, plane_nodes, comm);
        let owner_rank =
            |point: u32| contact_nodes.of(point).map_or(0, |contact_node| contact_nodes.owner_ranks[contact_node]);
        route(first, owner_rank, at, plane_nodes, comm)
    }

    /// Makes the patterns of messages until the next search.
    fn connect(
        &mut self,
        contact_nodes: &ContactNodes,
        problem: &mut LocalProblem,
        plan: &CommunicationPlan,
        plane_nodes: &[PlaneNode],
        comm: &mut dyn Communicator,
    ) {
        self.connect_motion(contact_nodes, problem, comm);
        let mut loaded = plan.here.list();
        loaded.extend(plane_nodes.iter().map(|plane_node| plane_node.point));
        loaded.sort_unstable();
        loaded.dedup();
        self.connect_results(&loaded, contact_nodes, problem, comm);
        self.iteration_messages = IterationMessages::new(comm.rank() as u32, &problem.numbering, plan);
    }

    /// Tells every other rank that has the node of a point on which forces may act that they will come.
    fn connect_results(
        &mut self,
        loaded: &[u32],
        contact_nodes: &ContactNodes,
        problem: &LocalProblem,
        comm: &mut dyn Communicator,
    ) {
        let rank = comm.rank() as u32;
        let mut parcels = Parcels::new(&*comm, 0);
        let mut send = Lists::new();
        for &point in loaded {
            for &holder in self.node_ranks.holders(point).iter().filter(|&&holder| holder != rank) {
                parcels.add(holder, point, &[]);
                send.entry(holder as usize).or_default().push(problem.place(point));
            }
        }
        let records = parcels.exchange(comm);
        let contact_node = |point: &u32| contact_nodes.of(*point).map(|contact_node| contact_node as u32);
        let receive = by_sender(&records, |ids| ids.iter().filter_map(contact_node).collect());
        self.results = MessagePattern::new(send, receive, comm.rank());
        // Forces act on few: not all nodes that are here need be asked.
        self.own = vec![ABSENT; problem.numbering.points.len()];
        for point in loaded {
            if let Some(own) = self.own.get_mut(problem.place(*point) as usize) {
                *own = contact_node(point).unwrap_or(ABSENT);
            }
        }
    }

    /// Asks the owners for the motion of all points of the local problem, and for their masses.
    fn connect_motion(
        &mut self,
        contact_nodes: &ContactNodes,
        problem: &mut LocalProblem,
        comm: &mut dyn Communicator,
    ) {
        let rank = comm.rank();
        let mut parcels = Parcels::new(&*comm, 0);
        let mut receive = Lists::new();
        for (place, &point) in problem.numbering.points.iter().enumerate() {
            let owner = self.node_ranks.owner(point);
            parcels.add(owner, point, &[]);
            receive.entry(owner as usize).or_default().push(place as u32);
        }
        let records = parcels.exchange(comm);
        let contact_node = |point: &u32| contact_nodes.of(*point).map(|contact_node| contact_node as u32);
        let send = by_sender(&records, |ids| ids.iter().filter_map(contact_node).collect());
        self.motion = MessagePattern::new(send, receive, rank);
        self.motion.exchange(
            &mut (contact_nodes, &mut *problem),
            |(contact_nodes, _), contact_node| contact_nodes.motion.inverse_mass[contact_node as usize],
            |(_, problem), point, mass| problem.motion.inverse_mass[point as usize] = mass,
            comm,
        );
        let (theirs, points) = (&contact_nodes.motion.mobility, problem.motion.len());
        let own = &mut problem.motion.mobility;
        if theirs.joints.are_there() {
            own.joints.clone_from(&theirs.joints);
            own.joint = self.of_points(&theirs.joint, points, comm);
        }
        if !theirs.bodies.is_empty() {
            own.bodies.clone_from(&theirs.bodies);
            own.body = self.of_points(&theirs.body, points, comm);
        }
    }

    /// A number of each contact node, brought to so many points of the local problem.
    fn of_points(&mut self, of_contact_nodes: &[u32], points: usize, comm: &mut dyn Communicator) -> Vec<u32> {
        let mut numbers = vec![ABSENT; points];
        self.motion.exchange(
            &mut numbers,
            |_, contact_node| [f64::from(of_contact_nodes[contact_node as usize])],
            |numbers, point, [number]| numbers[point as usize] = number as u32,
            comm,
        );
        numbers
    }
}

fn by_sender(records: &Records, places: impl Fn(&[u32]) -> Vec<u32>) -> Lists {
    records.senders.iter().map(|(rank, range)| (*rank, places(&records.ids[range.clone()]))).collect()
}
