//! What can be foretold of a scene before it is run, from geometry, velocities and the first state.

use super::steps;
use super::walls::thin_blocks;
use crate::mesh::{Block, Mesh};
use crate::model::{ContactMaterials, Model};
use crate::solver::Solver;

/// How much farther than the fastest of its nodes at the start something may go: bodies spring back.
const ROOM: f64 = 2.0;

/// Lines for a person, of a solver whose first state is prepared and which is all there is.
pub fn foretold(mesh: &Mesh, model: &Model, solver: &Solver) -> Vec<String> {
    let mut lines = Vec::new();
    let steps = model.termination_time / solver.time_step;
    if steps < 0.5 {
        lines.push(format!("TERMINATION TIME is {:.1e} of the first step: the run is one step", steps));
    }
    lines.extend(steps::words(mesh, solver));
    for index in thin_blocks(mesh) {
        let id = mesh.blocks[index].id;
        lines.push(format!(
            "block {id} is a wall of one element: where it bends, nothing but hourglass resistance holds it"
        ));
    }
    let far = out_of_reach(mesh, model, solver);
    if !far.is_empty() {
        let ids = far.iter().map(i64::to_string).collect::<Vec<_>>().join(", ");
        let (blocks, reach) = if far.len() == 1 { ("block", "reaches") } else { ("blocks", "reach") };
        lines.push(format!(
            "{blocks} {ids} {reach} no other at the speeds of the start: CONTACT MATERIAL need not name them"
        ));
    }
    lines
}

/// Blocks of CONTACT MATERIAL whose boxes stay away from those of all others at twice the largest speed of the start; nothing is
/// known where loads or prescribed motions move something.
fn out_of_reach(mesh: &Mesh, model: &Model, solver: &Solver) -> Vec<i64> {
    let driven = !model.prescribed_motions.is_empty()
        || !model.prescribed_forces.is_empty()
        || !model.pressures.is_empty()
        || !model.gravities.is_empty();
    let chosen = |block: &&Block| match &model.contact.materials {
        None => false,
        Some(ContactMaterials::All) => true,
        Some(ContactMaterials::Blocks(ids)) => ids.contains(&block.id),
    };
    let blocks: Vec<&Block> = mesh.blocks.iter().filter(chosen).filter(|block| !block.is_empty()).collect();
    // What an equation of state drives has no speed yet.
    let fluid = model.materials.iter().any(|material| material.law.is_fluid());
    if driven || fluid || blocks.len() < 2 {
        return Vec::new();
    }
    let nodes = &solver.domain.nodes;
    let speed = |row: &crate::lanes::Row| row.0[4..7].iter().map(|v| v * v).sum::<f64>().sqrt();
    let fastest = nodes.rows.iter().take(nodes.places).map(speed).fold(0.0, f64::max);
    // Both may move.
    let reach = 2.0 * ROOM * fastest * model.termination_time;
    let boxes: Vec<[[f64; 3]; 2]> = blocks.iter().map(|block| box_of(mesh, block)).collect();
    let away =
        |a: &[[f64; 3]; 2], b: &[[f64; 3]; 2]| (0..3).any(|i| a[0][i] - b[1][i] > reach || b[0][i] - a[1][i] > reach);
    let alone = |place: &usize| (0..boxes.len()).all(|other| other == *place || away(&boxes[*place], &boxes[other]));
    (0..boxes.len()).filter(alone).map(|place| blocks[place].id).collect()
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
