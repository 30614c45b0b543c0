//! Elements with an equation of state that have less internal energy than none: what no state of the material has. Something took most of
//! their volume in a single step, before any pressure had risen in them, and was paid back too much.

use super::{Symptom, When};
use crate::comm::Communicator;
use crate::solver::elements::fields::specific_energy;
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::health::finding::{Evidence, percent};
use crate::solver::health::place::{elements, worst_of_block};
use crate::solver::health::watch::{BlockFacts, Exam};

/// Missing energy below this part of the square of the wave speed is not what this looks for. A step that closes a fifth of an element is one
/// at a fifth of that speed and more, ½ v² of which is 0.02 of it: what such a step takes too much is of that order. What is less may be
/// round-off of a body that flies freely, or heat that does no harm: as much as a strain of 1.4 % holds.
const WORTH_WORDS: f64 = 1e-4;

pub const SYMPTOM: Symptom = Symptom {
    code: 20,
    when: When::Lines,
    threshold: 0.1,
    cause: 0.1,
    measure,
    place: |exam, evidence, comm| {
        let missing = |block: &ElementBlock, group: &Group, i| -own_energy(block, group, i).unwrap_or(0.0);
        evidence.spots[0] = worst_of_block(exam, evidence.block, missing, comm);
    },
    label: |evidence| format!("negative internal energy in block {}", evidence.block),
    words: |evidence| {
        let Evidence { share, amount, block, .. } = *evidence;
        format!(
            "an element of block {block} has the specific internal energy {amount:.4e}, below zero by {} of the largest in the block: \
             something has taken most of its volume in a single step; it is {}",
            percent(share),
            evidence.places()
        )
    },
    advice: "a body that meets a wall, another body or a driven node at about the speed of sound is stopped within a step, and heat and \
             pressure there are wrong: a smaller TIME STEP SCALE, by which a step closes less than a fifth of an element",
};

/// Specific internal energy of an element with an equation of state, energy/mass.
fn own_energy(block: &ElementBlock, group: &Group, i: usize) -> Option<f64> {
    block.law.equation_of_state().map(|_| specific_energy(block, group, i))
}

fn measure(exam: &Exam, comm: &mut dyn Communicator) -> Vec<Evidence> {
    let blocks = &exam.facts.blocks;
    // Of each block the least energy, and the largest with the opposite sign.
    let mut ends = vec![0.0f64; 2 * blocks.len()];
    for (block, group, i) in elements(&exam.solver.domain) {
        if let Some(energy) = own_energy(block, group, i) {
            let of_block = &mut ends[2 * block.index..2 * block.index + 2];
            (of_block[0], of_block[1]) = (of_block[0].min(energy), of_block[1].min(-energy));
        }
    }
    comm.all_min(&mut ends);
    let of_blocks = blocks.iter().zip(ends.chunks_exact(2));
    let is_missing = |(block, ends): &(&BlockFacts, &[f64])| -ends[0] > WORTH_WORDS * block.speed_squared;
    let evidence = of_blocks.filter(is_missing).map(|(block, ends)| Evidence {
        share: -ends[0] / ends[0].min(ends[1]).abs(),
        amount: ends[0],
        block: block.id,
        ..Evidence::default()
    });
    evidence.collect()
}
