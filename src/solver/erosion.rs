//! Erosion: elements that have failed are taken away, with their energy booked.
//!
//! An element that goes leaves its lane of the chunk to a cube at rest far larger than any element, made of eight nodes
//! that nobody else has: it exerts no force and never sets the time step, so the kernels know nothing of death.

mod delete;
mod state;

use super::Body;
use super::domain::ABSENT;
use super::elements::fields::{field_values, frame, positions, state_values, stress, volume};
use super::elements::geometry::{corners, gradient, modes};
use super::elements::hex8::rows;
use super::elements::{ElementBlock, Group};
use super::nodes::{Nodes, dot};
use crate::comm::{Communicator, numbers_of_others};
use crate::lanes::{CHUNK, Row};
use crate::mesh::{Mesh, UNIT_CUBE};
use crate::model::{Death, DeathVariable, Model};
use delete::Deletions;
use std::sync::Arc;

/// Edge of the cube that stands in for what is gone, in units of the body's size.
const STAND_IN: f64 = 1e3;

/// What is watched, what has gone, and its energy.
pub struct Erosion {
    rules: Vec<Death>,
    deletions: Deletions,
    element_order: Arc<Vec<u32>>,
    element_nodes: Arc<Vec<[u32; 8]>>,
    /// Local number of each node of the mesh.
    local: Vec<u32>,
    /// Whether a node of the mesh goes on when it has lost its elements: if any block around it wants that.
    keeps: Vec<bool>,
    /// Elements left at each local node, of all ranks.
    left: Vec<u32>,
    /// First of the eight nodes of the stand-in.
    stand_in: u32,
    edge: f64,
    /// Energy of what went, one entry for each element and each dropped node of this rank.
    pub energy: Vec<f64>,
    /// Number of elements of the whole body that are gone.
    pub gone: u64,
}

impl Erosion {
    /// `None` for a model without DEATH and DELETE MATERIAL. Adds the stand-in's nodes behind those of the rank.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, nodes: &mut Nodes, local: &[u32]) -> Option<Erosion> {
        if model.deaths.is_empty() && model.deletions.is_empty() {
            return None;
        }
        let mut left = vec![0; nodes.len()];
        for &node in body.element_nodes.iter().flatten().filter(|&&node| local[node as usize] != ABSENT) {
            left[local[node as usize] as usize] += 1;
        }
        let extent = body.positions.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()));
        let edge = STAND_IN * if extent > 0.0 { extent } else { 1.0 };
        let stand_in = nodes.len() as u32;
        for corner in UNIT_CUBE {
            let [x, y, z] = corner.map(|c| c * edge);
            nodes.rows.push(Row([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0]));
            nodes.forces.push(Default::default());
            nodes.initial.push([x, y, z]);
            nodes.file.push(ABSENT);
            nodes.owned.push(false);
        }
        let deletions = deletions(mesh, model, body);
        Some(Erosion {
            rules: model.deaths.clone(),
            element_order: body.element_order.clone(),
            element_nodes: body.element_nodes.clone(),
            local: local.to_vec(),
            keeps: deletions.keeps(&body.element_nodes, body.positions.len()),
            deletions,
            left,
            stand_in,
            edge,
            energy: Vec::new(),
            gone: 0,
        })
    }

    /// Takes away what fails and what is deleted now, and returns the canonical numbers of what went on all ranks,
    /// ascending; `None` when nothing has changed. `time` is that of the present positions, and `time_step` has led to them.
    pub fn advance(
        &mut self,
        blocks: &mut [ElementBlock],
        canonical: &[u32],
        nodes: &mut Nodes,
        [time, time_step]: [f64; 2],
        comm: &mut dyn Communicator,
    ) -> Option<Vec<u32>> {
        let deleted = self.deletions.due(time, time_step);
        let mut dead: Vec<u32> = Vec::new();
        for block in blocks {
            let rules: Vec<&Death> = self.rules.iter().filter(|rule| rule.block == block.id).collect();
            let mass = self.stand_in_mass(block);
            for border in [true, false] {
                let group = if border { &block.border } else { &block.interior };
                let failed = if deleted.contains(&block.id) {
                    (0..group.len()).filter(|&i| group.is_alive(i)).collect()
                } else {
                    failing(&rules, block, group, nodes)
                };
                let group = if border { &mut block.border } else { &mut block.interior };
                for i in failed {
                    dead.push(canonical[group.places[i] as usize]);
                    self.energy.push(stored_energy(group, i) + last_half_step(group, i, nodes, time_step));
                    group.retire(i, self.stand_in, mass);
                }
            }
        }
        let dead = everyone(dead, comm);
        self.gone += dead.len() as u64;
        self.release(&dead, nodes);
        if !deleted.is_empty() {
            self.drop_free_nodes(nodes);
        }
        (!dead.is_empty() || !deleted.is_empty()).then_some(dead)
    }

    /// Counts the elements that nodes lose, and drops free nodes where that is asked for.
    fn release(&mut self, dead: &[u32], nodes: &mut Nodes) {
        for &element in dead {
            for node in self.element_nodes[element as usize] {
                let here = self.local[node as usize];
                if here == ABSENT {
                    continue;
                }
                self.left[here as usize] -= 1;
                if self.left[here as usize] == 0 && !self.keeps[node as usize] {
                    self.energy.extend(drop_node(nodes, here));
                }
            }
        }
    }

    /// Mass of the stand-in of a block's elements.
    fn stand_in_mass(&self, block: &ElementBlock) -> f64 {
        block.density * self.edge * self.edge * self.edge
    }

    /// Whether a node of the mesh goes on when it has lost its elements.
    pub fn keeps(&self, node: u32) -> bool {
        self.keeps[node as usize]
    }

    /// Local nodes that have lost all their elements and go on as free masses.
    pub fn free_nodes(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.left).filter(|(_, left)| **left == 0).map(|(node, _)| node)
    }

    /// Local number of each node of the mesh.
    pub fn local(&self) -> &[u32] {
        &self.local
    }
}

fn deletions(mesh: &Mesh, model: &Model, body: &Body) -> Deletions {
    let wants = |block: i64| model.deaths.iter().any(|rule| rule.block == block && rule.keeps_nodes);
    Deletions {
        to_come: model.deletions.clone(),
        gone: Vec::new(),
        blocks: mesh.blocks.iter().map(|block| (block.id, wants(block.id))).collect(),
        element_block: body.element_block.clone(),
    }
}

/// Takes a node's mass away; its kinetic energy, where this rank answers for the node and it was not dropped before.
fn drop_node(nodes: &mut Nodes, node: u32) -> Option<f64> {
    let (mass, v) = (nodes.mass(node), nodes.velocity(node));
    nodes.rows[node as usize].0[3..8].fill(0.0);
    (nodes.owned[node as usize] && mass > 0.0).then(|| 0.5 * mass * dot(v, v))
}

/// The numbers of all ranks, ascending.
fn everyone(mut own: Vec<u32>, comm: &mut dyn Communicator) -> Vec<u32> {
    let mut count = [own.len() as u64];
    comm.all_sum(&mut count);
    if count[0] > 0 && comm.size() > 1 {
        let theirs = numbers_of_others(&own, comm);
        own.extend(theirs.into_iter().flat_map(|(_, numbers)| numbers));
    }
    own.sort_unstable();
    own
}

/// Elements that have passed the value of a rule, ascending. NaN has passed every value.
fn failing(rules: &[&Death], block: &ElementBlock, group: &Group, nodes: &Nodes) -> Vec<usize> {
    let mut failed = Vec::new();
    for rule in rules {
        let value = watched(rule, block, group, nodes);
        let passed = |value: f64| {
            if rule.is_maximum { value.is_nan() || value > rule.value } else { value.is_nan() || value <= rule.value }
        };
        failed.extend((0..group.len()).filter(|&i| group.is_alive(i) && passed(value(i))));
    }
    failed.sort_unstable();
    failed.dedup();
    failed
}

/// The variable of a rule as a function of the element.
fn watched<'a>(
    rule: &'a Death,
    block: &'a ElementBlock,
    group: &'a Group,
    nodes: &'a Nodes,
) -> Box<dyn Fn(usize) -> f64 + 'a> {
    match &rule.variable {
        DeathVariable::Volume => Box::new(|i| volume(group, i, nodes) * block.density / group.element_mass(i)),
        DeathVariable::TimeStep => Box::new(|i| stable_step(block, group, i, nodes)),
        DeathVariable::State(name) => match block.state_names.iter().position(|stored| stored == name) {
            Some(row) => Box::new(move |i| group.value(i, rows::LAW + row)),
            None => Box::new(|i| state(block, group, i, name)),
        },
        DeathVariable::Field(field, component) => {
            Box::new(|i| field_values(*field, block, group, i, nodes, 0)[*component])
        }
    }
}

/// The bound of Flanagan and Belytschko (1984) with the elastic moduli, √(M V/2(λ+2μ) B:B), as the element itself has it.
fn stable_step(block: &ElementBlock, group: &Group, i: usize, nodes: &Nodes) -> f64 {
    let x = positions(group, i, nodes);
    let operator = gradient(&[0, 1, 2].map(|axis| modes(&x.map(|corner| corner[axis] - x[0][axis]))));
    let square = operator.square4608() / 4608.0;
    let volume = operator.volume192 / 192.0;
    let light = group.element_mass(i) * block.least_share;
    (light * volume / (2.0 * block.law.moduli().dilatational() * square)).max(0.0).sqrt()
}

/// A state variable of an element's law, by name; zero where the law has none of that name.
fn state(block: &ElementBlock, group: &Group, i: usize, name: &str) -> f64 {
    let place = block.law.entry().state.iter().position(|variable| variable.name == name);
    place.map_or(0.0, |place| state_values(block, group, i)[place])
}

fn stored_energy(group: &Group, i: usize) -> f64 {
    group.value(i, rows::INTERNAL_ENERGY)
        + group.value(i, rows::HOURGLASS_ENERGY)
        + group.value(i, rows::VISCOUS_ENERGY)
}

/// Work that the element's last forces have done since the last state: they acted for half of the step that led here,
/// and no new forces come to be averaged with them. Stress and bulk viscosity; hourglass forces are left out.
fn last_half_step(group: &Group, i: usize, nodes: &Nodes, time_step: f64) -> f64 {
    let total = stress(group, i).add_diagonal(group.value(i, rows::VISCOUS_STRESS)).rotate(&frame(group, i)).matrix();
    let v = group.nodes(i).map(|node| nodes.velocity(node));
    let before = positions(group, i, nodes);
    let operator = gradient(&[0, 1, 2].map(|axis| {
        modes(
            &[0, 1, 2, 3, 4, 5, 6, 7]
                .map(|n: usize| (before[n][axis] - before[0][axis]) - time_step * (v[n][axis] - v[0][axis])),
        )
    }));
    let mut work = 0.0;
    for j in 0..3 {
        let g = operator.g24[j];
        let b = corners(&[g[0], g[1], g[2], g[3], g[4], g[5], 0.0]);
        for n in 0..8 {
            work += (0..3).map(|k| total[k][j] * v[n][k]).sum::<f64>() * b[n] / 192.0;
        }
    }
    let work = 0.5 * time_step * work;
    // An element that dies inverted may have moved beyond all measure.
    if work.is_finite() { work } else { 0.0 }
}

impl Group {
    /// Whether the `i`-th element is still there.
    pub fn is_alive(&self, i: usize) -> bool {
        self.gone.is_empty() || !self.gone[i]
    }

    /// Gives the lane of the `i`-th element to the stand-in, and with it the lanes that copy the last element.
    fn retire(&mut self, i: usize, stand_in: u32, mass: f64) {
        if self.gone.is_empty() {
            self.gone = vec![false; self.len()];
        }
        self.gone[i] = true;
        let copies = if i + 1 == self.len() { self.len()..self.connectivity.len() * CHUNK } else { 0..0 };
        for slot in std::iter::once(i).chain(copies) {
            let (chunk, lane) = (slot / CHUNK, slot % CHUNK);
            for corner in 0..8 {
                self.connectivity[chunk][corner][lane] = stand_in + corner as u32;
            }
            self.mass[chunk].0[lane] = mass;
            let state = &mut self.state[chunk * self.stride..(chunk + 1) * self.stride];
            state.iter_mut().for_each(|row| row.0[lane] = 0.0);
            for component in 0..3 {
                state[rows::STRETCH + component].0[lane] = 1.0;
            }
            state[rows::FRAME].0[lane] = 1.0;
        }
    }
}
