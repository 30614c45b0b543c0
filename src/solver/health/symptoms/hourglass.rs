//! Hourglass energy that is no small part of a block's internal energy: the mesh is too coarse for what it does.

use super::{Symptom, When};
use crate::comm::Communicator;
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::health::finding::{Evidence, percent};
use crate::solver::health::place::{energies_of_blocks, worst_of_block};
use crate::solver::health::watch::{BlockFacts, Exam};

/// Less than this part of the energy supplied, times the block's part of the mass, does no harm: so begins every impact.
const WORTH_WORDS: f64 = 1e-3;

/// Part of the energy supplied below which all that is left beside a common flight may be its round-off, in single precision too.
const ROUND_OFF: f64 = 1e-6;

pub const SYMPTOM: Symptom = Symptom {
    code: 4,
    when: When::Lines,
    threshold: 0.1,
    // Above the internal energy, the block is its hourglass resistance rather than its material.
    cause: 1.0,
    measure,
    place: |exam, evidence, comm| {
        evidence.spots[0] = worst_of_block(exam, evidence.block, hourglass_energy, comm);
    },
    label: |evidence| format!("hourglass energy of block {}", evidence.block),
    words: |evidence| {
        let Evidence { share, amount, of, block, .. } = *evidence;
        format!(
            "hourglass energy of block {block} is {amount:.4e}, {} of its internal energy {of:.4e}; most of it in {}",
            percent(share),
            evidence.places()
        )
    },
    advice: "look there with PLOT ELEMENT, HOURGLASS: a finer mesh, more elements through a thickness, loads that act on \
             more than single nodes, or the other HOURGLASS CONTROL; results of the block are stiffer or softer than its \
             material",
};

/// Hourglass energy of an element, none of one that has no such modes, or of a fluid, in which it is heat: `damped_flow`.
fn hourglass_energy(block: &ElementBlock, group: &Group, i: usize) -> f64 {
    if block.law.is_fluid() {
        return 0.0;
    }
    block.element.entry().energies.hourglass.map_or(0.0, |row| group.value(i, row))
}

fn measure(exam: &Exam, comm: &mut dyn Communicator) -> Vec<Evidence> {
    let blocks = &exam.facts.blocks;
    let energies = |block: &ElementBlock, group: &Group, i| {
        [group.value(i, block.element.entry().energies.internal), hourglass_energy(block, group, i)]
    };
    let sums = energies_of_blocks(exam, energies, comm);
    let mass: f64 = blocks.iter().map(|block| block.mass).sum();
    // What all do together deforms nothing. Of a body that merely flies round-off is left.
    let supplied = (exam.supplied - exam.facts.flight_energy).max(ROUND_OFF * exam.supplied);
    let evidence = |(block, [internal, hourglass]): (&BlockFacts, [f64; 2])| {
        // A gas that has expanded has lost internal energy; what it has done counts.
        let share = hourglass / internal.abs();
        // The first waves of loads that rise are all edges; what they leave is small against what follows.
        let counts = !exam.begins && hourglass > WORTH_WORDS * supplied * block.mass / mass;
        counts.then_some(Evidence { share, amount: hourglass, of: internal, block: block.id, ..Evidence::default() })
    };
    blocks.iter().zip(sums).filter_map(evidence).collect()
}
