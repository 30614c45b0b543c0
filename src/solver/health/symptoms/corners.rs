//! Elements whose corners have turned inside out although their volume is positive: the one point of integration does not
//! see it, their faces do.

use super::{Symptom, When};
use crate::comm::Communicator;
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::health::finding::Evidence;
use crate::solver::health::place::{elements, worst_element};
use crate::solver::health::watch::Exam;
use crate::solver::nodes::Nodes;

pub const SYMPTOM: Symptom = Symptom {
    code: 6,
    when: When::Lines,
    threshold: 0.0,
    cause: 0.0,
    measure,
    place: |exam, evidence, comm| {
        let nodes = &exam.solver.domain.nodes;
        let turned = elements(&exam.solver.domain)
            .filter(|(block, ..)| block.id == evidence.block)
            .filter_map(|(block, group, i)| Some((group.places[i], -turned(block, group, i, nodes)?)));
        evidence.spots[0] = worst_element(exam, turned, comm);
    },
    label: |evidence| format!("corners inside out in block {}", evidence.block),
    words: |evidence| {
        let Evidence { count, of, block, .. } = *evidence;
        let plural = if count == 1 { "element" } else { "elements" };
        format!(
            "corners of {count} {plural} of block {block}, of {of}, have turned inside out though the volume is positive; \
             worst in {}",
            evidence.places()
        )
    },
    advice: "forces and contact faces of such elements mean little: look there with PLOT ELEMENT, CORNERS; a finer or better \
             shaped mesh, more hourglass stiffness, or DEATH, block, CORNER, MIN, 0.",
};

/// The least corner of an element that has a positive volume, where that is inside out.
fn turned(block: &ElementBlock, group: &Group, i: usize, nodes: &Nodes) -> Option<f64> {
    if block.element.corners_are_sound(group, i, nodes) {
        return None;
    }
    let least = block.element.least_corner(group, i, nodes);
    (least <= 0.0 && block.element.volume(group, i, nodes) > 0.0).then_some(least)
}

fn measure(exam: &Exam, comm: &mut dyn Communicator) -> Vec<Evidence> {
    let blocks = &exam.facts.blocks;
    let mut counts = vec![0u64; blocks.len()];
    for (block, group, i) in elements(&exam.solver.domain) {
        counts[block.index] += u64::from(turned(block, group, i, &exam.solver.domain.nodes).is_some());
    }
    comm.all_sum(&mut counts);
    let evidence = blocks.iter().zip(counts).map(|(block, count)| Evidence {
        share: count as f64 / (block.elements as f64).max(1.0),
        count,
        of: block.elements as f64,
        block: block.id,
        ..Evidence::default()
    });
    evidence.collect()
}
