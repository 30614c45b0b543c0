//! Blocks that never flowed, and rules of erosion that took nothing away.

use super::{Advice, Promise, Scene};
use crate::comm::Communicator;
use crate::model::{BlockMaterial, Death, DeathVariable};
use crate::solver::Section;

/// Laws that are ELASTIC until they flow, and what replacing them by it keeps: all but the first put the stress together from
/// its parts again.
const ELASTIC_UNTIL_FLOW: [(&str, Promise); 4] = [
    ("ELASTIC PLASTIC", Promise::Bits),
    ("EP POWER HARD", Promise::Digits),
    ("PIECEWISE PLASTIC", Promise::Digits),
    ("VISCOPLASTIC", Promise::Digits),
];

/// The state variable that tells of flow.
const PLASTIC_STRAIN: &str = "EQPS";

pub fn advice(scene: &Scene, comm: &mut dyn Communicator) -> Vec<Advice> {
    let mut list = never_flowed(scene, comm);
    let gone = scene.solver.domain.erosion.as_ref().map(|erosion| erosion.gone);
    if gone == Some(0) && scene.model.deletions.is_empty() {
        let rules = scene.model.deaths.len();
        let one = if rules == 1 { "the rule of DEATH" } else { "none of the rules of DEATH" };
        let words = format!("{one} took {} away", if rules == 1 { "nothing" } else { "anything" });
        let instead = "a deck without DEATH".to_string();
        list.push(Advice::spare(words, instead, Promise::Bits, Some((Section::Erosion, 1.0))));
    }
    list
}

fn never_flowed(scene: &Scene, comm: &mut dyn Communicator) -> Vec<Advice> {
    let mut flowed: Vec<f64> = vec![1.0; scene.mesh.blocks.len()];
    for block in &scene.solver.domain.blocks {
        let Some(row) = block.state_names.iter().position(|name| *name == PLASTIC_STRAIN) else { continue };
        let rows: Vec<usize> = (0..block.element.points()).map(|point| block.first_of_law(point) + row).collect();
        let flows = block.groups().into_iter().any(|group| {
            // What has gone may have flowed before.
            (0..group.len()).any(|i| !group.is_alive(i) || rows.iter().any(|row| group.value(i, *row) > 0.0))
        });
        if flows {
            flowed[block.index] = 0.0;
        }
    }
    comm.all_min(&mut flowed);
    let elements = scene.mesh.element_count() as f64;
    let mut list = Vec::new();
    for (block, _) in scene.mesh.blocks.iter().zip(&flowed).filter(|(block, still)| **still > 0.0 && !block.is_empty())
    {
        let Some(material) = scene.model.materials.iter().find(|material| material.block == block.id) else { continue };
        let name = material.law.entry().name;
        let Some((_, promise)) = ELASTIC_UNTIL_FLOW.iter().find(|(law, _)| *law == name) else { continue };
        let words = format!("block {} never flowed", block.id);
        let instead = format!("MATERIAL, {}, ELASTIC{}", block.id, without(scene, block.id));
        // Elements of rigid bodies have no work.
        let is_rigid = scene.model.is_rigid(block.id);
        let cost = (!is_rigid).then_some((Section::Elements, block.len() as f64 / elements));
        list.push(Advice::spare(words, instead, *promise, cost));
    }
    list
}

/// What else must go from the deck with the variables of a block that becomes ELASTIC.
fn without(scene: &Scene, block: i64) -> String {
    let watches = |death: &Death| death.block == block && matches!(death.variable, DeathVariable::State(_));
    let has = |material: &BlockMaterial| {
        material.block != block && material.law.entry().state.iter().any(|variable| variable.name == PLASTIC_STRAIN)
    };
    let plotted = scene.model.plot_requests.state.iter().any(|name| name == PLASTIC_STRAIN);
    let mut gone = Vec::new();
    if scene.model.deaths.iter().any(watches) {
        gone.push("the DEATH that watches it");
    }
    if plotted && !scene.model.materials.iter().any(has) {
        gone.push("PLOT STATE, EQPS");
    }
    if gone.is_empty() { String::new() } else { format!(", without {},", gone.join(" and ")) }
}
