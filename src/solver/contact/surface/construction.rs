//! How contact is made from a model and a mesh.

use crate::comm::Communicator;
use crate::mesh::Mesh;
use crate::model::{ContactOverlap, ContactSearch, Model, Watched};
use crate::solver::Body;
use crate::solver::contact::check::node_face;
use crate::solver::contact::check::planes::PlaneNode;
use crate::solver::contact::enforcement::accounts::certificate::Bank;
use crate::solver::contact::enforcement::accounts::gain::Gain;
use crate::solver::contact::enforcement::accounts::resultants::{Resultants, Subject};
use crate::solver::contact::enforcement::iterations::Limits;
use crate::solver::contact::enforcement::joints::Joints;
use crate::solver::contact::local_problem::{LocalProblem, Numbering};
use crate::solver::contact::nodes::ContactNodes;
use crate::solver::contact::observations::arcs::Arcs;
use crate::solver::contact::press_fit::PressFit;
use crate::solver::contact::ranks::remote::Remote;
use crate::solver::contact::ranks::routing::share_planes;
use crate::solver::contact::search::locate::Reach;
use crate::solver::contact::search::{SearchKind, neighbourhood};
use crate::solver::contact::surface::layout::Layout;
use crate::solver::contact::surface::pairings::Pairings;
use crate::solver::contact::surface::skin::Skin;
use crate::solver::contact::{Contact, Seen, Tally};
use crate::solver::erosion::Erosion;
use crate::solver::nodes::Nodes;
use std::sync::Arc;

/// The surfaces that a model lets touch, and how they are laid out.
pub type Surfaces = (Skin, Layout);

/// The surfaces that a model lets touch; `None` when it has neither contact nor rigid surfaces. They are found once for all ranks
/// of a process, by the first that asks: each gets a copy, which shares what is large.
pub fn surfaces(mesh: &Mesh, model: &Model, body: &Body) -> Option<Surfaces> {
    let found = body.surfaces.get_or_init(|| {
        if !model.contact.is_some() && model.rigid_surfaces.is_empty() {
            return None;
        }
        let mut skin = Skin::new(mesh, model, body, plane_node_sets(mesh, model).concat());
        let layout = skin.layout();
        if !Erosion::is_asked_for(model) {
            skin.settle(&layout);
        }
        Some((skin, layout))
    });
    found.clone()
}

/// Nodes of each rigid surface.
fn plane_node_sets(mesh: &Mesh, model: &Model) -> Vec<Vec<u32>> {
    model.rigid_surfaces.iter().map(|plane| mesh.side_set_nodes(plane.side_set)).collect()
}

impl Contact {
    /// Contact as the model asks for it, with the surfaces that were found; `None` when that is nothing. `held[i]` says which
    /// constraint holds which direction of local node i; `local` gives the local node of a node of the mesh, `elements` the
    /// canonical numbers of the elements here, ascending.
    pub fn new(
        mesh: &Mesh,
        model: &Model,
        (body, surfaces): (&Body, Option<Surfaces>),
        (nodes, held): (&Nodes, Vec<[u32; 3]>),
        (local, elements): (&[u32], &[u32]),
        comm: &mut dyn Communicator,
    ) -> Option<Contact> {
        let (skin, layout) = surfaces?;
        let plane_node_sets = plane_node_sets(mesh, model);
        let joints = Joints::of(mesh, model, body, &layout.nodes).map(Arc::new);
        let mut contact = Contact {
            contact_nodes: ContactNodes::default(),
            problem: LocalProblem::default(),
            remote: None,
            carried: None,
            search: kind(model.contact.control.search).make(),
            decomposition: model.contact.control.decomposition,
            reach: reach(model, body, &layout),
            planes: model.rigid_surfaces.clone(),
            mean_size: mean_size(&layout),
            plane_nodes: plane_points(&plane_node_sets, model, body, &layout),
            limits: limits(model, &plane_node_sets, joints.is_some()),
            joints,
            press_fit: PressFit::of(mesh, model, body),
            lost_work: Vec::new(),
            bank: Bank::default(),
            gain: Gain::default(),
            tally: Tally::default(),
            held_deepest: None,
            seen: Seen::nothing(mesh.blocks.len(), model.rigid_surfaces.len()),
            arcs: Arcs::new(layout.nodes.len(), layout.faces.len()),
            resultants: Resultants::new(model.histories.iter().filter_map(subject)),
            block_ids: mesh.blocks.iter().map(|block| block.id).collect(),
            searches: 0,
            age: 0,
            counts: [0; 2],
            pairings: Pairings::new(mesh, model, body),
            elements: elements.to_vec(),
            thicknesses: Vec::new(),
            held,
            skin,
            layout,
        };
        contact.attach_to_nodes(|node| local[node as usize], nodes, comm);
        Some(contact)
    }

    /// Lets go of what only a surface from which elements go has to know; on one rank who computes what is no question either.
    pub fn release_construction_data(&mut self, ranks: usize) {
        self.skin.release_construction_data();
        self.held = Vec::new();
        if ranks == 1 {
            self.elements = Vec::new();
        }
    }

    /// Finds the points that are nodes here, and gets to know the other ranks.
    pub(in crate::solver::contact) fn attach_to_nodes(
        &mut self,
        local: impl Fn(u32) -> u32,
        nodes: &Nodes,
        comm: &mut dyn Communicator,
    ) {
        let Contact { layout, held, elements, skin, .. } = self;
        let is_here = |number: u32| comm.size() == 1 || elements.binary_search(&(number / 6)).is_ok();
        let numbers = if layout.interfaces.is_empty() { &[][..] } else { &layout.faces.number[..] };
        let solid = |face: &u32| !layout.faces.is_two_sided(*face);
        let faces = (0..).zip(numbers).filter(|(face, number)| solid(face) && is_here(**number));
        self.thicknesses =
            faces.map(|(face, &number)| (face, skin.sides(number).map(|side| side.map(&local)))).collect();
        self.thicknesses.shrink_to_fit();
        let here = |point: u32| local(layout.nodes[point as usize]);
        self.contact_nodes = ContactNodes::new((layout.nodes.len(), layout.origin), here, held, nodes);
        if let Some(joints) = &self.joints {
            self.contact_nodes.join(joints, nodes);
        }
        if layout.interfaces.is_empty() {
            // Planes alone need nobody else's nodes. Where there was more before, their forces were known at owner ranks only.
            if let (Some(_), Some(history)) = (self.remote.take(), &mut self.carried) {
                let all = 0..comm.size() as u32;
                history.planes = share_planes(&history.planes, |_| all.clone(), comm);
            }
            self.problem = alone(layout, &self.contact_nodes, &self.plane_nodes, Default::default(), 0.0);
            // Nor a search, which would put history back.
            self.problem.restore(self.carried.take().unwrap_or_default());
            if self.joints.is_some() {
                self.tell_who_answers(comm);
            }
        } else if comm.size() > 1 {
            let is_here = |face: u32| elements.binary_search(&(face / 6)).is_ok();
            self.remote = Some(Remote::new((layout, &self.contact_nodes), self.decomposition, is_here, comm));
        }
    }
}

/// The local problem that holds what this rank has, and everything when there is no other.
pub(in crate::solver::contact) fn alone(
    layout: &Layout,
    contact_nodes: &ContactNodes,
    plane_nodes: &[PlaneNode],
    found: neighbourhood::SearchResult,
    depth: f64,
) -> LocalProblem {
    let numbering = Numbering {
        points: contact_nodes.list.iter().map(|contact_node| contact_node.point).collect(),
        ghosts: Vec::new(),
        faces: (0..layout.faces.len() as u32).collect(),
        edges: (0..layout.edges.len() as u32).collect(),
    };
    let here: Vec<PlaneNode> =
        plane_nodes.iter().filter(|plane_node| contact_nodes.of(plane_node.point).is_some()).copied().collect();
    LocalProblem::new(numbering, found, depth, layout, &here)
}

/// Whose contact forces a command watches, if any.
fn subject(watched: &Watched) -> Option<Subject> {
    match *watched {
        Watched::RigidSurface(id) => Some(Subject::Wall(id)),
        Watched::Contact(first, Some(second)) => Some(Subject::Pair(first, second)),
        Watched::Contact(block, None) => Some(Subject::Others(block)),
        Watched::Blocks | Watched::Block(_) | Watched::NodeSet(_) | Watched::Node(_) => None,
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

fn reach(model: &Model, body: &Body, layout: &Layout) -> Reach {
    let control = &model.contact.control;
    let mean = mean_size(layout);
    // A reach of one step at least: the search must hold for the step it is made for.
    let least = if control.reach > 0.0 { control.margin * mean } else { 0.0 };
    // Overlaps that stay are known while points are behind their faces, as deep as half an element.
    let stay =
        matches!(control.overlap, ContactOverlap::Keep | ContactOverlap::Stress(_)) || body.overlap.stuck.nodes > 0;
    Reach { steps: control.reach.max(1.0), least, depth: if stay { 1.0 } else { node_face::KEEP } }
}

/// How far the iterations go. All ranks must make the same number of them. With surfaces every rank sees all constraints and
/// stops at the same iteration; planes alone are each rank's own, and get as many iterations as they can need.
fn limits(model: &Model, plane_node_sets: &[Vec<u32>], are_joined: bool) -> Limits {
    let control = &model.contact.control;
    if model.contact.is_some() || !model.rigid_bodies.is_empty() || are_joined {
        return Limits {
            iterations: control.passes,
            unsettled: control.unsettled_passes,
            tolerance: control.tolerance,
            may_give_way: true,
            farthest: 0.0,
        };
    }
    let mut nodes = plane_node_sets.concat();
    nodes.sort_unstable();
    let alone = nodes.windows(2).all(|pair| pair[0] != pair[1]);
    let iterations = if alone { 1 } else { control.passes };
    // Nobody else hears what runs out here.
    let tolerance = f64::NEG_INFINITY;
    Limits { iterations, unsettled: iterations, tolerance, may_give_way: false, farthest: f64::INFINITY }
}

fn plane_points(plane_node_sets: &[Vec<u32>], model: &Model, body: &Body, layout: &Layout) -> Vec<PlaneNode> {
    let mut list = Vec::new();
    for (number, (plane, nodes)) in model.rigid_surfaces.iter().zip(plane_node_sets).enumerate() {
        for &node in nodes {
            if let Ok(point) = layout.nodes.binary_search(&node) {
                let reach = layout.faces.node_reach[point];
                let plane_node = PlaneNode::new(point as u32, number, plane, body.positions[node as usize], reach);
                list.push(PlaneNode { number: list.len() as u32, ..plane_node });
            }
        }
    }
    list
}
