//! Debris: free nodes that erosion has left behind carry a good part of the energy.

use super::{Symptom, When};
use crate::comm::{Communicator, ExactSum};
use crate::solver::health::finding::{Evidence, percent};
use crate::solver::health::place::worst_nodes;
use crate::solver::health::watch::Exam;
use crate::solver::nodes::dot;

pub const SYMPTOM: Symptom = Symptom {
    code: 11,
    when: When::Lines,
    threshold: 0.1,
    cause: f64::INFINITY,
    measure,
    place: |exam, evidence, comm| {
        let [first, ..] = worst_nodes(exam, &energies(exam), comm);
        evidence.spots[0] = first;
    },
    label: |_| "debris carries energy".into(),
    words: |evidence| {
        let Evidence { share, amount, count, .. } = *evidence;
        format!(
            "{count} free nodes that eroded elements have left carry a kinetic energy of {amount:.4e}, {} of the largest \
             supplied so far; most at {}",
            percent(share),
            evidence.places()
        )
    },
    advice: "masses without elements around them push what they meet like hail: see whether elements go too early, or let \
             the nodes go with them: DEATH with DROP",
};

/// Kinetic energy of each free node that this rank owns.
fn energies(exam: &Exam) -> Vec<(u32, f64)> {
    let nodes = &exam.solver.domain.nodes;
    let free = exam.solver.domain.erosion.iter().flat_map(|erosion| erosion.free_nodes());
    let owned = free.filter(|&node| nodes.owned[node as usize]);
    owned.map(|node| (node, 0.5 * nodes.mass(node) * dot(nodes.velocity(node), nodes.velocity(node)))).collect()
}

fn measure(exam: &Exam, comm: &mut dyn Communicator) -> Vec<Evidence> {
    if exam.solver.domain.erosion.as_ref().is_none_or(|erosion| erosion.gone == 0) {
        return Vec::new();
    }
    let energies = energies(exam);
    let mut sum = [ExactSum::new()];
    energies.iter().for_each(|(_, energy)| sum[0].add(*energy));
    ExactSum::merge_ranks(&mut sum, comm);
    let mut count = [energies.len() as u64];
    comm.all_sum(&mut count);
    let amount = sum[0].value();
    vec![Evidence { share: amount / exam.supplied, amount, count: count[0], of: exam.supplied, ..Evidence::default() }]
}
