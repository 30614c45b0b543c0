//! Elements that have been compressed beyond the end of the formula of their equation of state: a tangent stands for it there.

use super::{Symptom, When};
use crate::comm::Communicator;
use crate::material::EquationOfState;
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::health::finding::Evidence;
use crate::solver::health::place::{elements, worst_element};
use crate::solver::health::watch::Exam;
use crate::solver::nodes::Nodes;

pub const SYMPTOM: Symptom = Symptom {
    code: 17,
    when: When::Lines,
    threshold: 0.0,
    // What compresses it so far is the cause.
    cause: f64::INFINITY,
    measure,
    place: |exam, evidence, comm| {
        let nodes = &exam.solver.domain.nodes;
        let beyond = elements(&exam.solver.domain)
            .filter(|(block, ..)| block.id == evidence.block)
            .filter_map(|(block, group, i)| Some((group.places[i], beyond(block, group, i, nodes)?)));
        evidence.spots[0] = worst_element(exam, beyond, comm);
    },
    label: |evidence| format!("compression of block {} beyond its Hugoniot", evidence.block),
    words: |evidence| {
        let Evidence { count, amount, block, .. } = *evidence;
        let (plural, have) = if count == 1 { ("element", "has") } else { ("elements", "have") };
        format!(
            "{count} {plural} of block {block} {have} been compressed beyond 1 - V/V0 = {amount:.4}, where S (1 - V/V0) = 0.95 \
             and the Hugoniot goes on along its tangent; farthest {}",
            evidence.places()
        )
    },
    advice: "pressures there are hundreds of times the initial bulk modulus, and not those of the material: look at C0, S and the \
             units, and at what compresses the element so far; MG POWER SERIES has no such end",
};

/// How much farther than to the end of the formula an element is compressed, if it is.
fn beyond(block: &ElementBlock, group: &Group, i: usize, nodes: &Nodes) -> Option<f64> {
    let end = block.law.equation_of_state()?.end_of_formula()?;
    let compression = 1.0 - block.element.volume(group, i, nodes) * block.density / group.element_mass(i);
    Some(compression - end).filter(|beyond| *beyond > 0.0)
}

fn measure(exam: &Exam, comm: &mut dyn Communicator) -> Vec<Evidence> {
    let blocks = &exam.facts.blocks;
    let mut counts = vec![0u64; blocks.len()];
    // Of blocks of which no element is so far, here or anywhere, none is told.
    let mut ends = vec![f64::INFINITY; blocks.len()];
    for (block, group, i) in elements(&exam.solver.domain) {
        if beyond(block, group, i, &exam.solver.domain.nodes).is_some() {
            counts[block.index] += 1;
            let end = block.law.equation_of_state().and_then(EquationOfState::end_of_formula);
            ends[block.index] = end.unwrap_or(f64::INFINITY);
        }
    }
    comm.all_sum(&mut counts);
    comm.all_min(&mut ends);
    let of_blocks = blocks.iter().zip(counts).zip(ends);
    let evidence = of_blocks.map(|((block, count), amount)| Evidence {
        share: count as f64 / (block.elements as f64).max(1.0),
        amount,
        count,
        of: block.elements as f64,
        block: block.id,
        ..Evidence::default()
    });
    evidence.collect()
}
