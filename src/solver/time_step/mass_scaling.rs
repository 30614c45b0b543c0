//! MASS SCALING: mass that is added to elements so that the run may take longer steps.
//!
//! The stable step of an element grows with the root of its mass, so that a step longer by q costs the mass q² − 1 times. Masses are
//! chosen once, from the elements as they begin: an element that is squeezed later has a shorter step again. What is added moves
//! with its nodes from the start, has its part of every initial velocity and of gravity, and takes no part in the law: volumes
//! and densities are those of the material.

use crate::lanes::{CHUNK, Force, InstructionSet, Row};
use crate::mesh::Mesh;
use crate::model::{MassScaling, Model, ScaleMass};
use crate::solver::Body;
use crate::solver::elements::{ElementBlock, NewElement, PassSettings, Sink, Unfit};

/// What MASS SCALING has added.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AddedMass {
    /// Of each element, in canonical order; empty without the command.
    elements: Vec<f64>,
    /// Of each node and, behind them, rotary inertia of each rotation, in file order; empty where nothing was added.
    nodes: Vec<f64>,
    /// Of each block that a command names, in the order of the mesh.
    pub blocks: Vec<BlockMass>,
}

/// What MASS SCALING has added to a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockMass {
    /// Number of the block.
    pub block: i64,
    /// Mass of its material.
    pub mass: f64,
    /// Mass that was added.
    pub added: f64,
    /// Elements that were made heavier.
    pub elements: usize,
    /// Largest factor on the mass of an element.
    pub most: f64,
    /// Largest share of its mass that the deck lets it gain.
    pub limit: f64,
}

impl BlockMass {
    /// Added mass over the mass of the material.
    pub fn share(&self) -> f64 {
        if self.mass > 0.0 { self.added / self.mass } else { 0.0 }
    }
}

impl AddedMass {
    /// What a model's commands add to the elements of a body that has been weighed.
    pub(in crate::solver) fn of(mesh: &Mesh, model: &Model, body: &Body) -> AddedMass {
        let mut found = AddedMass::default();
        if model.mass_scalings.is_empty() {
            return found;
        }
        found.elements = vec![0.0; body.element_mass.len()];
        let mut first = 0;
        for (index, block) in mesh.blocks.iter().enumerate() {
            let own = first..first + block.len();
            first = own.end;
            let rules: Vec<&MassScaling> = model.mass_scalings.iter().filter(|rule| rule.names(block.id)).collect();
            // What is rigid sets no step.
            if rules.is_empty() || body.block_body[index].is_some() {
                continue;
            }
            let steps = if rules.iter().any(|rule| matches!(rule.scale, ScaleMass::Step(_))) {
                stable_steps(mesh, model, body, own.clone())
            } else {
                vec![f64::INFINITY; own.len()]
            };
            let mut sums = BlockMass {
                block: mesh.blocks[index].id,
                mass: 0.0,
                added: 0.0,
                elements: 0,
                most: 1.0,
                limit: rules.iter().fold(0.0, |most, rule| rule.limit.max(most)),
            };
            for (element, step) in own.zip(steps) {
                let factor = rules.iter().fold(1.0, |most, rule| rule.factor(step * model.time_step.scale).max(most));
                let mass = body.element_mass[element];
                let added = (factor - 1.0) * mass;
                found.elements[element] = added;
                sums.mass += mass;
                sums.added += added;
                sums.elements += usize::from(added > 0.0);
                sums.most = sums.most.max(factor);
            }
            found.blocks.push(sums);
        }
        found
    }

    /// Number of elements that are known: none without the command.
    pub(in crate::solver) fn elements(&self) -> usize {
        self.elements.len()
    }

    /// Of an element, by its canonical number.
    pub fn of_element(&self, element: usize) -> f64 {
        self.elements.get(element).copied().unwrap_or(0.0)
    }

    /// Of these nodes, or nothing where nothing was added to any.
    pub(in crate::solver) fn of_nodes(&self, nodes: &[u32]) -> Vec<f64> {
        let known = if self.nodes.is_empty() { &[] } else { nodes };
        known.iter().map(|&node| self.nodes[node as usize]).collect()
    }

    /// Adds to one of so many nodes and rotations.
    pub(in crate::solver) fn add_to_node(&mut self, node: u32, mass: f64, unknowns: usize) {
        self.nodes.resize(unknowns, 0.0);
        self.nodes[node as usize] += mass;
    }

    /// All that was added.
    pub fn total(&self) -> f64 {
        self.blocks.iter().map(|block| block.added).sum()
    }

    /// Why a run with it may not begin: blocks that would gain more than the deck lets them.
    pub fn refusals(&self) -> Vec<(i64, Unfit)> {
        let is_over = |block: &&BlockMass| block.share() > block.limit * ROUND_OFF || block.share().is_nan();
        let over = self.blocks.iter().filter(is_over).map(|block| {
            let BlockMass { elements, limit, .. } = block;
            let reason = format!(
                "MASS SCALING: it would gain {:.3} of its mass, in {elements} of its elements, and {limit:.3} is the most",
                block.share()
            );
            (block.block, Unfit { reason, help: TOO_MUCH.into() })
        });
        over.collect()
    }
}

/// What may be done where a block would gain too much.
const TOO_MUCH: &str = "ask for a shorter step, or refine less; if its inertia is of no account, give the share that it may gain as the \
                        last number of the command";

impl MassScaling {
    /// Whether it holds for a block.
    fn names(&self, block: i64) -> bool {
        self.block.is_none_or(|own| own == block)
    }

    /// Factor on the mass of an element that lets the run take this step.
    fn factor(&self, step: f64) -> f64 {
        match self.scale {
            ScaleMass::Factor(factor) => factor,
            // An element without a positive step is refused elsewhere, with its place.
            ScaleMass::Step(wanted) if step > 0.0 => (wanted / step) * (wanted / step),
            ScaleMass::Step(_) => 1.0,
        }
    }
}

/// A sum of masses may be above the limit by what rounding makes of it.
const ROUND_OFF: f64 = 1.0 + 1e-9;

/// Elements whose steps are found together.
const BATCH: usize = 1024;

/// The stable steps of elements at rest, by their canonical numbers, as the elements themselves find them.
fn stable_steps(mesh: &Mesh, model: &Model, body: &Body, elements: std::ops::Range<usize>) -> Vec<f64> {
    let all: Vec<usize> = elements.collect();
    all.chunks(BATCH).flat_map(|batch| steps_of(mesh, model, body, batch)).collect()
}

fn steps_of(mesh: &Mesh, model: &Model, body: &Body, batch: &[usize]) -> Vec<f64> {
    let Some(&one) = batch.first() else { return Vec::new() };
    let block = body.element_block[one] as usize;
    let material = &model.materials[body.block_material[block]];
    let mut rows: Vec<Row> = Vec::new();
    let mut elements: Vec<NewElement> = Vec::new();
    for (place, &element) in batch.iter().enumerate() {
        let first = rows.len() as u32;
        rows.extend(body.element_unknowns[element].iter().map(|&unknown| {
            let [x, y, z] = body.start_of(unknown);
            Row([x, y, z, 1.0, 0.0, 0.0, 0.0, 1.0])
        }));
        // Coinciding corners stay so: masses depend on it.
        let own = &body.element_unknowns[element];
        let same = |k: usize| own.iter().position(|&node| node == own[k]).unwrap_or(k);
        elements.push(NewElement {
            place: place as u32,
            nodes: (0..own.len()).map(|k| first + same(k) as u32).collect(),
            corners: body.element_nodes[element].iter().map(|&node| body.positions[node as usize]).collect(),
            mass: body.element_mass[element],
            added: 0.0,
            attributes: mesh.blocks[block].attributes_of(body.place_in_block(element)).to_vec(),
        });
    }
    let group =
        |elements: &[NewElement]| ElementBlock::group(&body.elements[block], &material.law, material.density, elements);
    let mut at_rest = ElementBlock {
        index: block,
        id: mesh.blocks[block].id,
        density: material.density,
        law: material.law.clone(),
        element: body.elements[block].clone(),
        state_names: crate::solver::state_names(&material.law),
        border: group(&[]),
        interior: group(&elements),
        keeps_steps: true,
        rigid: false,
    };
    let mut forces = vec![Force::default(); rows.len()];
    let settings = PassSettings {
        time: 0.0,
        time_step: 0.0,
        kick: 0.0,
        bulk_viscosity: model.bulk_viscosity,
        moduli: model.time_step.moduli,
        instructions: InstructionSet::detect(),
    };
    at_rest.run(&rows, &[], Sink::Nodes { forces: &mut forces, border: &[] }, &settings);
    let steps = &at_rest.interior.steps;
    (0..batch.len()).map(|i| steps[i / CHUNK].0[i % CHUNK]).collect()
}
