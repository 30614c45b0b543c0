//! Elements that have been compressed beyond what their law describes: beyond the end of the formula of their equation of state, where a tangent stands
//! for it, and beyond what the data of a foam or a soil tell.

use super::{Symptom, When};
use crate::comm::Communicator;
use crate::material::{EquationOfState, Law};
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::health::finding::Evidence;
use crate::solver::health::place::{elements, worst_element};
use crate::solver::health::watch::Exam;
use crate::solver::nodes::Nodes;

pub const BEYOND_HUGONIOT: Symptom = Symptom {
    code: 17,
    when: When::Lines,
    threshold: 0.0,
    // What compresses it so far is the cause.
    cause: f64::INFINITY,
    measure: |exam, comm| measure(exam, end_of_formula, comm),
    place: |exam, evidence, comm| place(exam, evidence, end_of_formula, comm),
    label: |evidence| format!("compression of block {} beyond its Hugoniot", evidence.block),
    words: |evidence| {
        format!(
            "{} beyond 1 - V/V0 = {:.4}, where S (1 - V/V0) = 0.95 and the Hugoniot goes on along its tangent; farthest {}",
            compressed(evidence),
            evidence.amount,
            evidence.places()
        )
    },
    advice: "pressures there are hundreds of times the initial bulk modulus, and not those of the material: look at C0, S and the \
             units, and at what compresses the element so far; MG POWER SERIES has no such end",
};

pub const BEYOND_DATA: Symptom = Symptom {
    code: 24,
    when: When::Lines,
    threshold: 0.0,
    // What stiffens no more is squashed until its step collapses.
    cause: 0.0,
    measure: |exam, comm| measure(exam, Law::end_of_data, comm),
    place: |exam, evidence, comm| place(exam, evidence, Law::end_of_data, comm),
    label: |evidence| format!("compression of block {} beyond the data of its law", evidence.block),
    words: |evidence| {
        format!(
            "{} beyond 1 - V/V0 = {:.4}, where the data of its law end and it stiffens no more; farthest {}",
            compressed(evidence),
            evidence.amount,
            evidence.places()
        )
    },
    advice: "LOW DEN FOAM has nothing of the solid that is left at V/V0 = PHI, and SOIL N FOAMS keeps the pressure at the last point of its \
             FUNCTION: what is pressed farther does not resist as the material would; give the function its steep end, another law, or DEATH, \
             block, VOLUME, MIN",
};

/// The compression 1 − V/V₀ at which a law ends, if it does.
type End = fn(&Law) -> Option<f64>;

fn end_of_formula(law: &Law) -> Option<f64> {
    law.equation_of_state().and_then(EquationOfState::end_of_formula)
}

/// How many elements have been compressed, in words.
fn compressed(evidence: &Evidence) -> String {
    let (plural, have) = if evidence.count == 1 { ("element", "has") } else { ("elements", "have") };
    format!("{} {plural} of block {} {have} been compressed", evidence.count, evidence.block)
}

/// How much farther than to its end an element is compressed, if it is.
fn beyond(block: &ElementBlock, group: &Group, i: usize, (nodes, end): (&Nodes, End)) -> Option<f64> {
    let compression = 1.0 - block.element.volume(group, i, nodes) * block.density / group.element_mass(i);
    Some(compression - end(&block.law)?).filter(|beyond| *beyond > 0.0)
}

fn place(exam: &Exam, evidence: &mut Evidence, end: End, comm: &mut dyn Communicator) {
    let nodes = &exam.solver.domain.nodes;
    let beyond = elements(&exam.solver.domain)
        .filter(|(block, ..)| block.id == evidence.block)
        .filter_map(|(block, group, i)| Some((group.places[i], beyond(block, group, i, (nodes, end))?)));
    evidence.spots[0] = worst_element(exam, beyond, comm);
}

fn measure(exam: &Exam, end: End, comm: &mut dyn Communicator) -> Vec<Evidence> {
    let blocks = &exam.facts.blocks;
    let mut counts = vec![0u64; blocks.len()];
    // Of blocks of which no element is so far, here or anywhere, none is told.
    let mut ends = vec![f64::INFINITY; blocks.len()];
    let with_end = |(block, ..): &(&ElementBlock, &Group, usize)| end(&block.law).is_some();
    for (block, group, i) in elements(&exam.solver.domain).filter(with_end) {
        if beyond(block, group, i, (&exam.solver.domain.nodes, end)).is_some() {
            counts[block.index] += 1;
            ends[block.index] = end(&block.law).unwrap_or(f64::INFINITY);
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
