//! A few elements that set the step of all.

use super::{Advice, Promise, Scene};
use crate::comm::Communicator;
use crate::common::numbers::scientific;
use crate::mesh::Mesh;
use crate::model::StepEstimate;
use crate::solver::{Section, Slivers, Solver};

/// How much longer steps must become for it to be worth words.
const WORTH_WORDS: f64 = 1.2;

/// Mass that a block may gain without a word in the command.
const LIMIT: f64 = 0.05;

pub fn advice(scene: &Scene, _: &mut dyn Communicator) -> Vec<Advice> {
    // A run that goes on has not seen its beginning, and other bounds of the step know nothing of single elements.
    let other =
        scene.model.step_estimate != StepEstimate::Element || scene.solver.time_step >= scene.model.time_step.longest;
    if scene.continued || other {
        return Vec::new();
    }
    let Some(words) = words(scene.mesh, scene.solver) else { return Vec::new() };
    let Some(Slivers { gain, step, block_gain, .. }) = scene.solver.slivers else { return Vec::new() };
    let limit = if block_gain > LIMIT { format!(", {}", scientific(1.01 * block_gain, 2)) } else { String::new() };
    let instead = format!("MASS SCALING, ALL, STEP, {}{limit}, or a better shape there", scientific(step, 3));
    vec![Advice::spare(words, instead, Promise::Nothing, Some((Section::Elements, 1.0 - 1.0 / gain)))]
}

/// What the first state says of the elements that set the step, where that is worth words.
pub fn words(mesh: &Mesh, solver: &Solver) -> Option<String> {
    let slivers = solver.slivers.filter(|slivers| slivers.gain >= WORTH_WORDS)?;
    let who = if slivers.count == 1 { "one element".to_string() } else { format!("{} elements", slivers.count) };
    Some(format!(
        "{who} of {} set the step at the start, element {} of block {} the shortest: {} % more mass there would make the steps \
         {:.1} times as long",
        mesh.element_count(),
        slivers.place.element,
        slivers.place.block,
        100.0 * Slivers::ADDED,
        slivers.gain
    ))
}
