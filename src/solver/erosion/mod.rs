//! Erosion: elements that have failed are taken away, with their energy booked.
//!
//! An element that goes leaves its lane of the chunk to a cube at rest far larger than any element, made of eight nodes
//! that nobody else has: it exerts no force and never sets the time step, so the kernels know nothing of death.

mod delete;
mod points;
mod state;

use super::Body;
use super::domain::ABSENT;
use super::elements::fields::{field_values, state_values};
use super::elements::{Element, ElementBlock, Energies, Group, Steps};
use super::nodes::{Nodes, dot};
use crate::comm::{Communicator, numbers_of_others};
use crate::lanes::Row;
use crate::mesh::{Connectivity, Mesh, UNIT_CUBE};
use crate::model::{Death, DeathVariable, Model, Precision};
use delete::Deletions;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Edge of the cube that stands in for what is gone, in units of how far the body reaches from the origin.
const STAND_IN: f64 = 1e3;
/// The same in single precision, in units of the largest element: products of its mass and volume must stay in range, however large the
/// body, and wherever it is.
const SINGLE_STAND_IN: f64 = 30.0;

/// What is watched, what has gone, and its energy.
pub struct Erosion {
    rules: Vec<Death>,
    /// Factor of the deck on stable steps.
    step_scale: f64,
    deletions: Deletions,
    element_order: Arc<Vec<u32>>,
    /// Nodes of each element of the whole body, and the rotations of those that have them.
    element_unknowns: Arc<Connectivity>,
    /// Local number of each node of the mesh.
    local: Vec<u32>,
    /// Whether a node of the mesh goes on when it has lost its elements: if any block around it wants that.
    keeps: Vec<bool>,
    /// Elements left at each local node, of all ranks.
    left: Vec<u32>,
    /// Number of local nodes; behind them are rotations.
    places: usize,
    /// First of the eight nodes of the stand-in.
    stand_in: u32,
    edge: f64,
    /// Energy of what went, one entry for each element and each dropped node of this rank.
    pub energy: Vec<f64>,
    /// Number of elements of the whole body that are gone.
    pub gone: u64,
    /// Blocks that rules watch, ascending, each with its elements on this rank that rules have taken away at the present state.
    pub taken: Vec<(i64, u64)>,
}

/// Longest side of the box around any element.
fn largest_element(body: &Body) -> f64 {
    let side = |nodes: &[u32], axis: usize| {
        let along = nodes.iter().map(|&node| body.positions[node as usize][axis]);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        high - low
    };
    let sides = body.element_nodes.iter().flat_map(|nodes| (0..3).map(move |axis| (nodes, axis)));
    sides.fold(0.0, |most, (nodes, axis)| side(nodes, axis).max(most))
}

impl Erosion {
    /// Whether elements may go: by DEATH or DELETE MATERIAL.
    pub fn is_asked_for(model: &Model) -> bool {
        !model.deaths.is_empty() || !model.deletions.is_empty()
    }

    /// `None` for a model without either. Adds the stand-in's nodes behind those of the rank.
    pub fn new(mesh: &Mesh, model: &Model, body: &Body, nodes: &mut Nodes, local: &[u32]) -> Option<Erosion> {
        if !Erosion::is_asked_for(model) {
            return None;
        }
        let mut left = vec![0; nodes.len()];
        for &node in body.element_unknowns.nodes().iter().filter(|&&node| local[node as usize] != ABSENT) {
            left[local[node as usize] as usize] += 1;
        }
        let (factor, extent) = match model.precision {
            Precision::Single => (SINGLE_STAND_IN, largest_element(body)),
            Precision::Double => (STAND_IN, body.positions.iter().flatten().fold(0.0f64, |most, x| most.max(x.abs()))),
        };
        let edge = factor * if extent > 0.0 { extent } else { 1.0 };
        let stand_in = nodes.len() as u32;
        for corner in UNIT_CUBE {
            let [x, y, z] = corner.map(|c| c * edge);
            nodes.rows.push(Row([x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0]));
            nodes.forces.push(Default::default());
            nodes.beside.push([x, y, z]);
            nodes.file.push(ABSENT);
            nodes.owned.push(false);
        }
        let deletions = deletions(mesh, model, body);
        Some(Erosion {
            rules: model.deaths.clone(),
            step_scale: model.time_step.scale,
            element_order: body.element_order.clone(),
            element_unknowns: body.element_unknowns.clone(),
            local: local.to_vec(),
            keeps: deletions.keeps(&body.element_unknowns, body.rotations.unknowns()),
            deletions,
            places: nodes.places,
            left,
            stand_in,
            edge,
            energy: Vec::new(),
            gone: 0,
            taken: watched_blocks(model),
        })
    }

    /// Whether a rule for a block watches the time steps of its elements.
    pub fn watches_steps(model: &Model, block: i64) -> bool {
        model.deaths.iter().any(|rule| rule.block == block && rule.variable == DeathVariable::TimeStep)
    }

    /// Takes away what fails and what is deleted now, and returns the canonical numbers of what went on all ranks,
    /// ascending; `None` when nothing has changed. `time` is that of the present positions, and `steps` have led to them.
    pub fn advance(
        &mut self,
        blocks: &mut [ElementBlock],
        canonical: &[u32],
        nodes: &mut Nodes,
        time: f64,
        steps: Steps,
        comm: &mut dyn Communicator,
    ) -> Option<Vec<u32>> {
        let deleted = self.deletions.due(time, steps.time_step);
        let mut dead: Vec<u32> = Vec::new();
        self.taken.iter_mut().for_each(|(_, count)| *count = 0);
        for block in blocks {
            let rules: Vec<&Death> = self.rules.iter().filter(|rule| rule.block == block.id).collect();
            let stand_in = self.stand_in(block);
            for border in [true, false] {
                let mut lost = Vec::new();
                if block.element.entry().points.is_some() {
                    lost = Erosion::lose_points(block, border, &rules, nodes);
                }
                let group = if border { &block.border } else { &block.interior };
                let failed = if deleted.contains(&block.id) {
                    (0..group.len()).filter(|&i| group.is_alive(i)).collect()
                } else {
                    let failed = self.failing(&rules, block, group, nodes, lost);
                    let taken = self.taken.iter_mut().find(|(id, _)| *id == block.id);
                    taken.into_iter().for_each(|(_, count)| *count += failed.len() as u64);
                    failed
                };
                let ElementBlock { border: at_border, interior, element, law, .. } = block;
                let group = if border { at_border } else { interior };
                for i in failed {
                    dead.push(canonical[group.places[i] as usize]);
                    let exact = element.last_exact_work(group, i, nodes, law, steps);
                    let last = exact.unwrap_or_else(|| element.last_half_step(group, i, nodes, steps.time_step));
                    self.energy.push(stored_energy(element, group, i) + last);
                    stand_in.take_over(group, i);
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
            for &node in &self.element_unknowns[element as usize] {
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

    /// The stand-in of a block's elements.
    fn stand_in(&self, block: &ElementBlock) -> StandIn {
        let own = block.element.entry().rows.len();
        let mut numbers = vec![0.0; block.first_of_point(block.element.points())];
        let mass = block.element.stand_in(block.density, self.edge, &mut numbers[..own]);
        StandIn { nodes: [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| self.stand_in + corner), mass, numbers }
    }

    /// Whether a node of the mesh goes on when it has lost its elements.
    pub fn keeps(&self, node: u32) -> bool {
        self.keeps[node as usize]
    }

    /// Local nodes that have lost all their elements and go on as free masses.
    pub fn free_nodes(&self) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.left[..self.places]).filter(|(_, left)| **left == 0).map(|(node, _)| node)
    }

    /// Local number of each node of the mesh.
    pub fn local(&self) -> &[u32] {
        &self.local
    }
}

/// What takes the lane of an element that is gone.
struct StandIn {
    nodes: [u32; 8],
    mass: f64,
    numbers: Vec<f64>,
}

impl StandIn {
    fn take_over(&self, group: &mut Group, i: usize) {
        group.retire(i, &self.nodes, self.mass, &self.numbers);
    }
}

/// Blocks that rules watch, ascending, of which nothing has been taken away.
fn watched_blocks(model: &Model) -> Vec<(i64, u64)> {
    let blocks: BTreeSet<i64> = model.deaths.iter().map(|rule| rule.block).collect();
    blocks.into_iter().map(|block| (block, 0)).collect()
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

/// Watching.
impl Erosion {
    /// Elements that have passed the value of a rule, with those of which so many points have, ascending.
    fn failing(
        &self,
        rules: &[&Death],
        block: &ElementBlock,
        group: &Group,
        nodes: &Nodes,
        mut failed: Vec<usize>,
    ) -> Vec<usize> {
        for rule in rules.iter().filter(|rule| !points::is_of_points(rule, block)) {
            let value = self.watched(rule, block, group, nodes);
            let known_and_passed = |i: usize| value(i).is_some_and(|value| has_passed(rule, value));
            failed.extend((0..group.len()).filter(|&i| group.is_alive(i) && known_and_passed(i)));
        }
        failed.sort_unstable();
        failed.dedup();
        failed
    }

    /// The variable of a rule as a function of the element, where it is known. The time step is the stable one of the
    /// element at the last state, as the log prints it, without the bound of how far it may close in a step; before the
    /// first step it is not known.
    fn watched<'a>(
        &self,
        rule: &'a Death,
        block: &'a ElementBlock,
        group: &'a Group,
        nodes: &'a Nodes,
    ) -> Box<dyn Fn(usize) -> Option<f64> + 'a> {
        let scale = self.step_scale;
        match &rule.variable {
            DeathVariable::Volume => {
                Box::new(|i| Some(block.element.volume(group, i, nodes) * block.density / group.element_mass(i)))
            }
            DeathVariable::TimeStep => Box::new(move |i| group.stable_step(i).map(|step| scale * step)),
            DeathVariable::State(name) => match block.state_names.iter().position(|stored| stored == name) {
                Some(row) => Box::new(move |i| Some(group.value(i, block.first_of_law(0) + row))),
                None => Box::new(|i| Some(state(block, group, i, (nodes, name)))),
            },
            DeathVariable::Field(field, component) => {
                Box::new(|i| Some(field_values(*field, block, group, i, nodes, 0)[*component]))
            }
        }
    }
}

/// Whether a value has passed that of a rule; NaN has passed every value.
fn has_passed(rule: &Death, value: f64) -> bool {
    let beyond = if rule.is_maximum { value > rule.value } else { value <= rule.value };
    value.is_nan() || beyond
}

/// A state variable of an element's law, by name; zero where the law has none of that name.
fn state(block: &ElementBlock, group: &Group, i: usize, (nodes, name): (&Nodes, &str)) -> f64 {
    let place = block.law.entry().state.iter().position(|variable| variable.name == name);
    place.map_or(0.0, |place| state_values(block, group, i, nodes)[place])
}

/// All energy that an element has stored.
fn stored_energy(element: &Element, group: &Group, i: usize) -> f64 {
    let Energies { internal, hourglass, viscous } = &element.entry().energies;
    let others = [hourglass, viscous].into_iter().flatten();
    others.fold(group.value(i, *internal), |sum, &row| sum + group.value(i, row))
}
