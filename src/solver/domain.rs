//! One rank's part of the problem: its nodes, element blocks, loads and constraints, and how it sums with others.

use super::body::{Body, LoadedFace};
use super::constraints::{Constraint, Motion};
use super::contact::Contact;
use super::elements::{ElementBlock, NewElement};
use super::erosion::Erosion;
use super::exchange::Exchange;
use super::loads::{self, Load, PressureFace, PressureFaces, Setting};
use super::nodes::{Nodes, add, cross, dot, scaled, subtract};
use crate::comm::Communicator;
use crate::lanes::Row;
use crate::material::{Kernel, KernelVisitor, Law};
use crate::mesh::{Block, Mesh};
use crate::model::{Analysis, InitialVelocity, Model};
use crate::partition::Share;

/// Everything a rank owns.
pub struct Domain {
    /// Nodes.
    pub nodes: Nodes,
    /// Element blocks that have elements here, in mesh order.
    pub blocks: Vec<ElementBlock>,
    /// File position of each local element, in the rank's canonical order.
    pub element_file: Vec<u32>,
    /// The analyst's number of each local element.
    pub element_id: Vec<i64>,
    /// Canonical number of each local element in the whole body.
    pub element_canonical: Vec<u32>,
    /// Names of the state variables that the laws of the whole model store, ascending; the same on all ranks.
    pub law_states: Vec<&'static str>,
    /// Names of what the elements of the whole model store beside that, in the elements' order; the same on all ranks.
    pub element_rows: Vec<&'static str>,
    /// Faces under pressure.
    pub pressure_faces: PressureFaces,
    /// All other loads, in the order in which they act.
    pub loads: Vec<Box<dyn Load>>,
    /// Constraints.
    pub constraints: Vec<Constraint>,
    /// External work of loads and constraints that a run had before it was continued and has no more; kept on one rank.
    pub carried_work: Vec<f64>,
    /// Contact and rigid surfaces, when there are any.
    pub contact: Option<Contact>,
    /// Elements that are taken away, when the deck asks for it.
    pub erosion: Option<Erosion>,
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

/// Names of all state variables that the model's laws store, ascending.
fn law_states(model: &Model) -> Vec<&'static str> {
    let mut names: Vec<&str> =
        model.materials.iter().flat_map(|material| state_names(&material.law)).copied().collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// Names of all that the elements of a body store, each once, in the order in which its blocks come.
fn element_rows(body: &Body) -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    for row in body.elements.iter().flat_map(|element| element.entry().rows) {
        if !names.contains(&row.name) {
            names.push(row.name);
        }
    }
    names
}

impl Domain {
    /// Cuts a rank's share out of the body and sets its initial state.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, share: &Share, comm: &mut dyn Communicator) -> Domain {
        let local = local_numbers(body.positions.len(), &share.nodes);
        let elements = &share.groups[0].members;
        let element_file: Vec<u32> = elements.iter().map(|&e| body.element_order[e as usize]).collect();
        let mut domain = Domain {
            nodes: nodes(mesh, body, share),
            blocks: blocks(mesh, model, body, share, &local),
            element_id: element_file.iter().map(|&e| mesh.element_ids[e as usize]).collect(),
            element_file,
            element_canonical: elements.clone(),
            law_states: law_states(model),
            element_rows: element_rows(body),
            pressure_faces: pressure_faces(model, body, share, &local),
            loads: Vec::new(),
            constraints: Vec::new(),
            carried_work: Vec::new(),
            contact: None,
            erosion: None,
            exchange: Exchange::new(share),
        };
        domain.erosion = Erosion::new(mesh, model, body, &mut domain.nodes, &local);
        domain.loads = loads::make(&Setting { mesh, model, body, local: &local, nodes: domain.nodes.len() });
        let held = domain.set_constraints(mesh, model, &local);
        domain.contact =
            Contact::new(mesh, model, body, (&domain.nodes, held), (&local, &domain.element_canonical), comm);
        domain.set_initial_velocities(mesh, model, &local);
        domain
    }

    /// Forgets the forces of constraints and planes, when those of the elements are of no use.
    pub fn forget_reactions(&mut self) {
        self.constraints.iter_mut().for_each(|constraint| constraint.reaction = 0.0);
        self.contact.iter_mut().for_each(Contact::forget);
    }

    /// Returns which constraint takes each direction of each node, [`ABSENT`] where none does.
    fn set_constraints(&mut self, mesh: &Mesh, model: &Model, local: &[u32]) -> Vec<[u32; 3]> {
        let still = model.no_displacements.iter().map(|c| (c.node_set, c.direction, None));
        let moving = model.prescribed_motions.iter().map(|m| {
            let motion = Motion { kind: m.kind, function: m.function, scale: m.scale };
            (m.node_set, m.direction, Some(motion))
        });
        let mut taken = vec![[ABSENT; 3]; self.nodes.len()];
        for (set, direction, motion) in still.chain(moving) {
            let axis = direction.axis();
            for node in nodes_of_set(mesh, set, local) {
                // Sets overlap; a node is held once in each direction, the first command counts.
                if taken[node as usize][axis] == ABSENT {
                    taken[node as usize][axis] = self.constraints.len() as u32;
                    self.constraints.push(Constraint { node, axis, motion, reaction: 0.0, work: 0.0 });
                }
            }
        }
        if model.analysis == Analysis::Axisymmetric {
            self.hold_axis(&mut taken);
        }
        taken
    }

    /// Holds nodes on the axis of a body of revolution on it.
    fn hold_axis(&mut self, taken: &mut [[u32; 3]]) {
        for node in 0..self.nodes.len() as u32 {
            let taken = &mut taken[node as usize][0];
            // Nodes that are not of the mesh stand in for elements that are gone, at rest.
            let of_mesh = self.nodes.file[node as usize] != ABSENT;
            if of_mesh && *taken == ABSENT && self.nodes.position(node)[0] == 0.0 {
                *taken = self.constraints.len() as u32;
                self.constraints.push(Constraint { node, axis: 0, motion: None, reaction: 0.0, work: 0.0 });
            }
        }
    }

    fn set_initial_velocities(&mut self, mesh: &Mesh, model: &Model, local: &[u32]) {
        for initial in &model.initial_velocities {
            match *initial {
                InitialVelocity::Material { block, velocity } => {
                    for node in nodes_of_block(mesh, block, local) {
                        self.set_velocity(node, velocity);
                    }
                }
                InitialVelocity::NodeSet { node_set, velocity } => {
                    for node in nodes_of_set(mesh, node_set, local) {
                        self.set_velocity(node, velocity);
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
                    }
                }
                InitialVelocity::Angular { block, omega, point, axis } => {
                    let spin = scaled(axis, omega);
                    for node in nodes_of_block(mesh, block, local) {
                        let arm = subtract(self.nodes.position(node), point);
                        self.set_velocity(node, add(self.nodes.velocity(node), cross(spin, arm)));
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
}

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

/// Local nodes of a block, each once, ascending.
fn nodes_of_block(mesh: &Mesh, block: i64, local: &[u32]) -> Vec<u32> {
    let Some(index) = mesh.block_index(block) else { return Vec::new() };
    let mut nodes: Vec<u32> =
        mesh.blocks[index].nodes.iter().map(|&n| local[n as usize]).filter(|&n| n != ABSENT).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

fn nodes(mesh: &Mesh, body: &Body, share: &Share) -> Nodes {
    let row = |&file: &u32| {
        let ([x, y, z], m) = (body.positions[file as usize], body.node_mass[file as usize]);
        Row([x, y, z, m, 0.0, 0.0, 0.0, 1.0 / m])
    };
    Nodes {
        rows: share.nodes.iter().map(row).collect(),
        forces: vec![Default::default(); share.nodes.len()],
        initial: share.nodes.iter().map(|&file| mesh.coordinates[file as usize]).collect(),
        file: share.nodes.clone(),
        owned: share.owned.clone(),
    }
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
            let mesh_block = &mesh.blocks[index];
            let new: Vec<NewElement> =
                places.into_iter().map(|place| new_element(place, mesh_block, body, share, local)).collect();
            ElementBlock::group(&body.elements[index], &material.law, material.density, &new)
        };
        ElementBlock {
            index,
            id: mesh.blocks[index].id,
            density: material.density,
            law: material.law.clone(),
            element: body.elements[index].clone(),
            state_names,
            keeps_steps: Erosion::watches_steps(model, mesh.blocks[index].id),
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
        nodes: nodes.iter().map(|&n| local[n as usize]).collect(),
        corners: nodes.iter().map(|&n| body.positions[n as usize]).collect(),
        mass: body.element_mass[element],
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
