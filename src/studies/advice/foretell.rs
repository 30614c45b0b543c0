//! What can be foretold of a scene before it is run, from geometry, velocities and the first state.

use super::steps;
use super::walls::thin_blocks;
use crate::common::numbers::scientific;
use crate::mesh::{Block, Mesh};
use crate::model::{Jump, Model, Pulse};
use crate::solver::Solver;

/// How much farther than the fastest of its nodes at the start something may go: bodies spring back.
const ROOM: f64 = 2.0;

/// Part of a run without contact that is worth words.
const LATE: f64 = 0.1;

/// Lines for a person, of a solver whose first state is prepared and which is all there is.
pub fn foretold(mesh: &Mesh, model: &Model, solver: &Solver) -> Vec<String> {
    let mut lines = Vec::new();
    let steps = model.termination_time / solver.time_step;
    if steps < 0.5 {
        lines.push(format!("TERMINATION TIME is {:.1e} of the first step: the run is one step", steps));
    }
    lines.extend(steps::words(mesh, solver));
    if let Some(Pulse { function, start, length }) = model.shortest_pulse() {
        let seen = length / solver.time_step;
        if seen < Pulse::STEPS {
            lines.push(format!(
                "function {function} goes up or down and comes back within {seen:.2} steps from time {start:.4e} on: steps hardly see it"
            ));
        }
    }
    if let Some(Jump { node_set, direction, size }) = model.largest_jump() {
        lines.push(format!(
            "node set {node_set} jumps by {size:.4e} in {direction:?} within the first step, at a velocity of {:.3e}: its PRESCRIBED \
             DISPLACEMENT does not begin with 0",
            size.abs() / solver.time_step
        ));
    }
    for index in thin_blocks(mesh, model) {
        let id = mesh.blocks[index].id;
        lines.push(format!(
            "block {id} is a wall of one element: where it bends, nothing but hourglass resistance holds it"
        ));
    }
    lines.extend(apart(mesh, model, solver));
    lines
}

/// What CONTACT MATERIAL names for nothing, or too early: blocks whose boxes stay away from those of all others at twice the largest
/// speed of the start, and how long at least it takes at the speeds of the start until any two touch. Nothing is known where loads or
/// prescribed motions move something.
fn apart(mesh: &Mesh, model: &Model, solver: &Solver) -> Vec<String> {
    let driven = !model.prescribed_motions.is_empty()
        || !model.prescribed_forces.is_empty()
        || !model.pressures.is_empty()
        || !model.gravities.is_empty();
    let chosen = |block: &&Block| model.contact.names(block.id);
    let blocks: Vec<&Block> = mesh.blocks.iter().filter(chosen).filter(|block| !block.is_empty()).collect();
    // What an equation of state drives has no speed yet.
    if driven || model.has_fluids() || blocks.len() < 2 {
        return Vec::new();
    }
    let nodes = &solver.domain.nodes;
    let speed = |row: &crate::lanes::Row| row.0[4..7].iter().map(|v| v * v).sum::<f64>().sqrt();
    let fastest = nodes.rows.iter().take(nodes.places).map(speed).fold(0.0, f64::max);
    let boxes: Vec<[[f64; 3]; 2]> = blocks.iter().map(|block| box_of(mesh, block)).collect();
    // Both may move.
    let reach = 2.0 * ROOM * fastest * model.termination_time;
    let alone = |place: &usize| {
        (0..boxes.len()).all(|other| other == *place || distance(&boxes[*place], &boxes[other]) > reach)
    };
    let far: Vec<usize> = (0..boxes.len()).filter(alone).collect();
    let mut lines = Vec::new();
    if !far.is_empty() {
        let ids = far.iter().map(|&place| blocks[place].id.to_string()).collect::<Vec<_>>().join(", ");
        let (blocks, reach) = if far.len() == 1 { ("block", "reaches") } else { ("blocks", "reach") };
        lines.push(format!(
            "{blocks} {ids} {reach} no other at the speeds of the start: CONTACT MATERIAL need not name them"
        ));
    }
    let pairs = (0..boxes.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    let nearest = pairs.map(|(a, b)| distance(&boxes[a], &boxes[b])).fold(f64::INFINITY, f64::min);
    // Apart along an axis, so that it is the speed along it that counts, of which `fastest` is a bound.
    let first = nearest / (2.0 * fastest);
    let part = first / model.termination_time;
    if far.len() < blocks.len() && part > LATE {
        lines.push(format!(
            "no two blocks touch before time {} at the speeds of the start, {:.0} % of the run: they may begin closer to each other",
            scientific(first, 3),
            100.0 * part.min(1.0)
        ));
    }
    lines
}

/// Distance of two boxes along the axis along which they are farthest apart, negative where they overlap.
fn distance(a: &[[f64; 3]; 2], b: &[[f64; 3]; 2]) -> f64 {
    (0..3).map(|i| (a[0][i] - b[1][i]).max(b[0][i] - a[1][i])).fold(f64::NEG_INFINITY, f64::max)
}

fn box_of(mesh: &Mesh, block: &Block) -> [[f64; 3]; 2] {
    let mut corners = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for &node in &block.nodes {
        let x = mesh.coordinates[node as usize];
        for i in 0..3 {
            corners[0][i] = corners[0][i].min(x[i]);
            corners[1][i] = corners[1][i].max(x[i]);
        }
    }
    corners
}
