//! One rank's part of the problem: its nodes, element blocks, loads and constraints, and how it sums with others.

mod axis;
pub(super) mod body;
pub(super) mod constraints;
mod exchange;
pub(super) mod fit;
mod function;
pub(super) mod joints;
pub mod nodes;
mod rotations;
pub(super) mod trial;

pub(super) use axis::Axis;
pub use body::{Body, Cut, NoMaterial, centroid};
pub use rotations::Rotations;

use super::contact::{self, Contact};
use super::elements::{Element, ElementBlock, NewElement};
use super::erosion::Erosion;
use super::loads::{self, Load, PressureFace, PressureFaces, Setting};
use super::rigid::RigidBodies;
use super::tied::Ties;
use crate::comm::Communicator;
use crate::common::memory;
use crate::lanes::{Force, Row};
use crate::material::{Kernel, KernelVisitor, Law};
use crate::mesh::{Block, Mesh, counts_from_one};
use crate::model::{InitialVelocity, Model, Unknown};
use crate::partition::Share;
use body::LoadedFace;
use constraints::{Constraint, Motion};
use exchange::Exchange;
use nodes::{Nodes, Rates, add, cross, dot, scaled, subtract};
use std::collections::HashMap;

/// Everything a rank owns.
pub struct Domain {
    /// Nodes.
    pub nodes: Nodes,
    /// Element blocks that have elements here, in mesh order.
    pub blocks: Vec<ElementBlock>,
    /// File position of each local element, in the rank's canonical order.
    pub element_file: Vec<u32>,
    /// The analyst's number of each local element; empty where elements have the numbers of their places in the file, from 1.
    pub(in crate::solver) element_id: Vec<i64>,
    /// Canonical number of each local element in the whole body.
    pub element_canonical: Vec<u32>,
    /// Names of the state variables that the laws of the whole model store in elements with one point, ascending; the same on
    /// all ranks.
    pub law_states: Vec<&'static str>,
    /// Names of what the elements of the whole model store beside that, in the elements' order; the same on all ranks.
    pub element_rows: Vec<&'static str>,
    /// Names of what points of integration store, of elements that have several; the same on all ranks.
    pub point_rows: Vec<String>,
    /// Local nodes that can turn, with the numbers of their rotations, ascending.
    pub rotations: Vec<(u32, u32)>,
    /// Of each block of the mesh, whether its elements have points of integration in layers; the same on all ranks.
    pub layered: Vec<bool>,
    /// Faces under pressure.
    pub pressure_faces: PressureFaces,
    /// All other loads, in the order in which they act.
    pub loads: Vec<Box<dyn Load>>,
    /// Rigid bodies, when there are any.
    pub rigid: Option<RigidBodies>,
    /// Nodes of surfaces that are tied to others, when there are any.
    pub ties: Option<Ties>,
    /// Constraints.
    pub constraints: Vec<Constraint>,
    /// The axis that nodes may come to, of bodies of revolution.
    pub(in crate::solver) axis: Option<Axis>,
    /// External work of loads and constraints that a run had before it was continued and has no more; kept on one rank.
    pub carried_work: Vec<f64>,
    /// Contact and rigid surfaces, when there are any.
    pub contact: Option<Contact>,
    /// Elements that are taken away, when the deck asks for it.
    pub erosion: Option<Erosion>,
    /// What of each local node's mass MASS SCALING has added; empty without it.
    pub added_mass: Vec<f64>,
    /// What it has added to the whole body; `None` without it.
    pub mass_added: Option<f64>,
    /// Sums over nodes shared with other ranks.
    pub exchange: Exchange,
}

struct StateNames;
impl KernelVisitor for StateNames {
    type Output = &'static [&'static str];
    fn visit<K: Kernel>(self, _: K) -> Self::Output {
        K::STATE
    }
}

/// Names of the state variables that a law stores.
pub fn state_names(law: &Law) -> &'static [&'static str] {
    law.accept(StateNames)
}

/// Names of all state variables that the model's laws store in elements with one point, ascending.
fn law_states(mesh: &Mesh, model: &Model, body: &Body) -> Vec<&'static str> {
    let of_points = |block: i64| {
        let index = mesh.block_index(block);
        index.is_some_and(|index| body.elements[index].entry().points.is_some())
    };
    let materials = model.materials.iter().filter(|material| !of_points(material.block));
    let mut names: Vec<&str> = materials.flat_map(|material| state_names(&material.law)).copied().collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// Names of all that the points of integration of a body's elements store, where these have several: each once, with the
/// number of the point behind it.
fn point_rows(model: &Model, body: &Body) -> Vec<String> {
    let mut names = Vec::new();
    for (element, &material) in body.elements.iter().zip(&body.block_material) {
        let Some(entry) = &element.entry().points else { continue };
        let own = entry.rows.iter().map(|row| row.name);
        let all: Vec<&str> = own.chain(state_names(&model.materials[material].law).iter().copied()).collect();
        for point in 0..element.points() {
            names.extend(all.iter().map(|name| point_name(name, point)));
        }
    }
    let mut seen = std::collections::BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names
}

/// Name of what a point of integration stores.
pub(super) fn point_name(name: &str, point: usize) -> String {
    format!("{name}.{}", point + 1)
}

/// Names of all that the elements of a body store, each once, in the order in which its blocks come.
fn element_rows(body: &Body) -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    let own =
        |element: &Element| element.entry().rows.iter().map(|row| row.name).chain(element.carried().iter().copied());
    for name in body.elements.iter().flat_map(own) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

impl Domain {
    /// Cuts a rank's share out of the body and sets its initial state.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, share: &Share, comm: &mut dyn Communicator) -> Domain {
        // What finding the surface takes meanwhile is gone before the elements come.
        let surfaces = contact::surfaces(mesh, model, body);
        let local = local_numbers(body.rotations.unknowns(), &share.nodes);
        let elements = &share.groups[0].members;
        let element_file: Vec<u32> = elements.iter().map(|&e| body.element_order[e as usize]).collect();
        let mut domain = Domain {
            nodes: nodes(mesh, model, body, share),
            blocks: blocks(mesh, model, body, share, &local),
            element_id: element_numbers(mesh, &element_file),
            element_file,
            element_canonical: elements.clone(),
            law_states: law_states(mesh, model, body),
            element_rows: element_rows(body),
            point_rows: point_rows(model, body),
            rotations: rotations(body, share, &local),
            layered: body.elements.iter().map(|element| element.layers().is_some()).collect(),
            pressure_faces: pressure_faces(model, body, share, &local),
            loads: Vec::new(),
            rigid: None,
            ties: Ties::new(body, &local),
            constraints: Vec::new(),
            axis: None,
            carried_work: Vec::new(),
            contact: None,
            erosion: None,
            added_mass: body.added_mass.of_nodes(&share.nodes),
            mass_added: (!model.mass_scalings.is_empty()).then(|| body.added_mass.total()),
            exchange: Exchange::new(share, model.has_fluids()),
        };
        domain.erosion = Erosion::new(mesh, model, body, &mut domain.nodes, &local);
        domain.rigid = RigidBodies::new(mesh, model, body, &local, &domain.nodes);
        domain.nodes.passive = domain.rigid.iter().flat_map(RigidBodies::inside).collect();
        domain.loads = loads::make(&Setting { mesh, model, body, local: &local, nodes: domain.nodes.len() });
        let held = domain.set_constraints(mesh, model, body, &local);
        domain.contact = Contact::new(
            mesh,
            model,
            (body, surfaces),
            (&domain.nodes, held),
            (&local, &domain.element_canonical),
            comm,
        );
        if domain.erosion.is_none() {
            domain.contact.iter_mut().for_each(|contact| contact.release_construction_data(comm.size()));
        }
        domain.set_initial_velocities(mesh, model, &local);
        if let Some(ties) = &domain.ties {
            ties.set_off(&mut domain.nodes, comm);
        }
        if let Some(rigid) = &mut domain.rigid {
            rigid.set_off(&mut domain.nodes, comm);
        }
        domain
    }

    /// The analyst's number of a local element.
    pub fn element_number(&self, place: usize) -> i64 {
        self.element_id.get(place).copied().unwrap_or_else(|| i64::from(self.element_file[place]) + 1)
    }

    /// Forgets the forces of constraints and planes, when those of the elements are of no use.
    pub fn forget_reactions(&mut self) {
        self.constraints.iter_mut().for_each(|constraint| constraint.reaction = 0.0);
        self.axis.iter_mut().for_each(Axis::begin);
        self.contact.iter_mut().for_each(Contact::forget);
        self.rigid.iter_mut().for_each(RigidBodies::forget);
    }

    /// Returns which constraint takes each direction of each node, [`ABSENT`] where none does.
    fn set_constraints(&mut self, mesh: &Mesh, model: &Model, body: &Body, local: &[u32]) -> Vec<[u32; 3]> {
        let still = model.no_displacements.iter().map(|c| (c.node_set, (c.of, c.direction), None));
        let moving = model.prescribed_motions.iter().map(|m| {
            let motion = Motion { kind: m.kind, function: m.function, scale: m.scale };
            (m.node_set, (m.of, m.direction), Some(motion))
        });
        let mut taken = vec![[ABSENT; 3]; self.nodes.len()];
        for (set, (of, direction), motion) in still.chain(moving) {
            let axis = direction.axis();
            for node in unknowns_of_set(mesh, set, of, &body.rotations, local) {
                // What is said of a node of a rigid body is said of the body.
                let place = local[body.rotations.node(self.nodes.file[node as usize]) as usize];
                if self.rigid.as_ref().is_some_and(|rigid| rigid.of_node(place).is_some()) {
                    continue;
                }
                // What is tied to a surface goes where that goes.
                if body.tied.follows(self.nodes.file[node as usize]) {
                    continue;
                }
                // Sets overlap; a node is held once in each direction, the first command counts.
                if taken[node as usize][axis] == ABSENT {
                    taken[node as usize][axis] = self.constraints.len() as u32;
                    self.constraints.push(Constraint { node, axis, motion, begins: true, reaction: 0.0, work: 0.0 });
                }
            }
        }
        if model.analysis.about_axis() {
            axis::hold_on_it(&self.nodes, &mut taken, &mut self.constraints);
            // What is tied goes where its surface goes.
            let is_free =
                |node: u32| taken[node as usize][0] == ABSENT && !body.tied.follows(self.nodes.file[node as usize]);
            self.axis = Some(Axis::new(&self.nodes, is_free));
        }
        taken
    }

    fn set_initial_velocities(&mut self, mesh: &Mesh, model: &Model, local: &[u32]) {
        // Blocks that are to turn alike turn the nodes that they share once: which block has turned a node how.
        let mut turned: HashMap<u32, Vec<Turned>> = HashMap::new();
        for initial in &model.initial_velocities {
            match *initial {
                InitialVelocity::Material { block, velocity } => {
                    for node in nodes_of_block(mesh, block, local) {
                        self.set_velocity(node, velocity);
                        self.set_spin(node, [0.0; 3]);
                        turned.remove(&node);
                    }
                }
                InitialVelocity::NodeSet { node_set, velocity } => {
                    for node in nodes_of_set(mesh, node_set, local) {
                        self.set_velocity(node, velocity);
                        self.set_spin(node, [0.0; 3]);
                        turned.remove(&node);
                    }
                }
                InitialVelocity::Radial { block, speed, point, axis } => {
                    for node in nodes_of_block(mesh, block, local) {
                        let arm = subtract(self.nodes.position(node), point);
                        let along = axis.map_or([0.0; 3], |axis| scaled(axis, dot(arm, axis)));
                        let arm = subtract(arm, along);
                        let distance = dot(arm, arm).sqrt();
                        let factor = if distance > 0.0 { speed / distance } else { 0.0 };
                        self.set_velocity(node, scaled(arm, factor));
                        self.set_spin(node, [0.0; 3]);
                        turned.remove(&node);
                    }
                }
                InitialVelocity::Angular { block, omega, point, axis } => {
                    let spin = scaled(axis, omega);
                    for node in nodes_of_block(mesh, block, local) {
                        let known = turned.entry(node).or_default();
                        if known.iter().any(|(other, motion)| *other != block && *motion == [spin, point]) {
                            continue;
                        }
                        known.push((block, [spin, point]));
                        let arm = subtract(self.nodes.position(node), point);
                        self.set_velocity(node, add(self.nodes.velocity(node), cross(spin, arm)));
                        if let Some(rotation) = self.rotation_of(node) {
                            self.set_velocity(rotation, add(self.nodes.velocity(rotation), spin));
                        }
                    }
                }
            }
        }
        // Motion that a constraint forbids never was.
        for constraint in self.constraints.iter().filter(|c| c.motion.is_none()) {
            self.nodes.rows[constraint.node as usize].0[4 + constraint.axis] = 0.0;
        }
    }

    fn set_velocity(&mut self, node: u32, velocity: [f64; 3]) {
        self.nodes.rows[node as usize].0[4..7].copy_from_slice(&velocity);
    }

    /// Sets the rate at which a node turns, where it can.
    fn set_spin(&mut self, node: u32, rate: [f64; 3]) {
        if let Some(rotation) = self.rotation_of(node) {
            self.set_velocity(rotation, rate);
        }
    }

    /// The local number of a node's rotation, where it has one.
    fn rotation_of(&self, node: u32) -> Option<u32> {
        let place = self.rotations.binary_search_by_key(&node, |(node, _)| *node).ok()?;
        Some(self.rotations[place].1)
    }
}

/// See [`Domain::element_id`].
fn element_numbers(mesh: &Mesh, file: &[u32]) -> Vec<i64> {
    let of_place = |&element: &u32| mesh.element_ids[element as usize];
    if counts_from_one(&mesh.element_ids) { Vec::new() } else { file.iter().map(of_place).collect() }
}

/// A block that has been given a rotation: its number, angular velocity and a point of the axis.
type Turned = (i64, [[f64; 3]; 2]);

/// Marks a node that a rank does not have.
pub(super) const ABSENT: u32 = u32::MAX;

/// Local number of each node of the mesh, [`ABSENT`] where it has none.
pub(super) fn local_numbers(nodes: usize, used: &[u32]) -> Vec<u32> {
    let mut local = vec![ABSENT; nodes];
    for (here, &file) in used.iter().enumerate() {
        local[file as usize] = here as u32;
    }
    local
}

pub(super) fn nodes_of_set<'a>(mesh: &'a Mesh, set: i64, local: &'a [u32]) -> impl Iterator<Item = u32> + 'a {
    let nodes = mesh.node_set(set).map_or(&[][..], |set| &set.nodes);
    nodes.iter().map(|&n| local[n as usize]).filter(|&n| n != ABSENT)
}

/// The same of the nodes themselves or of their rotations, where they have any.
pub(super) fn unknowns_of_set<'a>(
    mesh: &'a Mesh,
    set: i64,
    of: Unknown,
    rotations: &'a Rotations,
    local: &'a [u32],
) -> impl Iterator<Item = u32> + 'a {
    let nodes = mesh.node_set(set).map_or(&[][..], |set| &set.nodes);
    let number = move |node: u32| match of {
        Unknown::Position => Some(node),
        Unknown::Rotation => rotations.of(node),
    };
    nodes.iter().filter_map(move |&node| number(node)).map(|n| local[n as usize]).filter(|&n| n != ABSENT)
}

/// Local nodes of a block, each once, ascending.
fn nodes_of_block(mesh: &Mesh, block: i64, local: &[u32]) -> Vec<u32> {
    let Some(index) = mesh.block_index(block) else { return Vec::new() };
    let mut nodes: Vec<u32> =
        mesh.blocks[index].nodes.iter().map(|&n| local[n as usize]).filter(|&n| n != ABSENT).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// The local nodes that can turn, with their rotations.
fn rotations(body: &Body, share: &Share, local: &[u32]) -> Vec<(u32, u32)> {
    let of = |(here, &file): (usize, &u32)| Some((here as u32, local[body.rotations.of(file)? as usize]));
    share.nodes.iter().enumerate().filter_map(of).filter(|(_, rotation)| *rotation != ABSENT).collect()
}

fn nodes(mesh: &Mesh, model: &Model, body: &Body, share: &Share) -> Nodes {
    let row = |&file: &u32| {
        let ([x, y, z], m) = (body.start_of(file), body.node_mass[file as usize]);
        let inverse = body.tied.inverse_mass(file, &body.node_mass).unwrap_or(1.0 / m);
        Row([x, y, z, m, 0.0, 0.0, 0.0, inverse])
    };
    let mut rows = memory::reserved(share.nodes.len());
    rows.extend(share.nodes.iter().map(row));
    Nodes {
        rows,
        forces: memory::repeated(Force::default(), share.nodes.len()),
        mesh: mesh.coordinates.clone(),
        beside: Vec::new(),
        places: share.nodes.partition_point(|&file| (file as usize) < mesh.coordinates.len()),
        file: share.nodes.clone(),
        owned: share.owned.clone(),
        rates: rates(mesh, model, body, share),
        passive: Vec::new(),
    }
}

/// How many corners of elements of fluids there are at the nodes of the mesh that a rank has, its own elements and others'.
fn rates(mesh: &Mesh, model: &Model, body: &Body, share: &Share) -> Rates {
    if !model.has_fluids() {
        return Rates::default();
    }
    // Elements of rigid bodies do not move of their own accord, and say nothing.
    let is_fluid =
        |block: usize| body.block_body[block].is_none() && model.materials[body.block_material[block]].law.is_fluid();
    let fluids: Vec<bool> = (0..body.block_material.len()).map(is_fluid).collect();
    let mut corners = vec![0u32; mesh.coordinates.len()];
    for (nodes, &block) in body.element_nodes.iter().zip(&*body.element_block) {
        if fluids[block as usize] {
            nodes.iter().for_each(|&node| corners[node as usize] += 1);
        }
    }
    let here = share.nodes.iter().map_while(|&node| corners.get(node as usize).copied());
    Rates::new(&here.collect::<Vec<u32>>())
}

/// Element blocks with elements on this rank. Elements come block by block, so each block is one run of them.
fn blocks(mesh: &Mesh, model: &Model, body: &Body, share: &Share, local: &[u32]) -> Vec<ElementBlock> {
    let elements = &share.groups[0];
    let places: Vec<u32> = (0..elements.members.len() as u32).collect();
    let block_of = |place: u32| body.element_block[elements.members[place as usize] as usize];
    let runs = places.chunk_by(|&a, &b| block_of(a) == block_of(b));
    runs.map(|run| {
        let index = block_of(run[0]) as usize;
        let material = &model.materials[body.block_material[index]];
        let state_names = state_names(&material.law);
        let (border, interior): (Vec<u32>, Vec<u32>) = run.iter().partition(|&&place| elements.border[place as usize]);
        let group = |places: Vec<u32>| {
            let new = |i: usize| new_element(places[i], &mesh.blocks[index], body, share, local);
            ElementBlock::group_of(&body.elements[index], &material.law, material.density, (places.len(), new))
        };
        ElementBlock {
            index,
            id: mesh.blocks[index].id,
            density: material.density,
            law: material.law.clone(),
            element: body.elements[index].clone(),
            state_names,
            keeps_steps: Erosion::watches_steps(model, mesh.blocks[index].id),
            rigid: body.block_body[index].is_some(),
            border: group(border),
            interior: group(interior),
        }
    })
    .collect()
}

fn new_element(place: u32, block: &Block, body: &Body, share: &Share, local: &[u32]) -> NewElement {
    let element = share.groups[0].members[place as usize] as usize;
    let nodes = &body.element_nodes[element];
    NewElement {
        place,
        nodes: body.element_unknowns[element].iter().map(|&n| local[n as usize]).collect(),
        corners: nodes.iter().map(|&n| body.positions[n as usize]).collect(),
        mass: body.element_mass[element],
        added: body.added_mass.of_element(element),
        attributes: block.attributes_of(body.place_in_block(element)).to_vec(),
    }
}

fn pressure_faces(model: &Model, body: &Body, share: &Share, local: &[u32]) -> PressureFaces {
    let face = |face: &LoadedFace| {
        let load = &model.pressures[face.pressure as usize];
        PressureFace {
            nodes: face.nodes.map(|n| local[n as usize]),
            element: face.element,
            gone: false,
            analysis: model.analysis,
            function: load.function,
            scale: load.scale,
            force: [[0.0; 3]; 4],
            work: 0.0,
        }
    };
    PressureFaces(share.groups[1].members.iter().map(|&f| face(&body.faces[f as usize])).collect())
}
