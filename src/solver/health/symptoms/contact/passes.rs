//! The passes of contact run out: overlaps are left from step to step.

use crate::comm::Communicator;
use crate::solver::health::finding::{Evidence, percent};
use crate::solver::health::place::worst_nodes;
use crate::solver::health::symptoms::{Symptom, When};
use crate::solver::health::watch::Exam;

/// Fewer steps with contact than these say nothing yet, since what strikes settles less at first than later; and fewer than the second nothing at the end
/// of a run.
const ENOUGH: [u64; 2] = [1000, 10];

pub const SYMPTOM: Symptom = Symptom {
    code: 9,
    when: When::Energies,
    threshold: 0.1,
    cause: f64::INFINITY,
    measure: |exam, _| {
        let contact = exam.solver.domain.contact.as_ref();
        let tally = contact.and_then(|contact| contact.report()).map(|report| report.tally);
        let least = ENOUGH[usize::from(exam.ends)];
        let enough = tally.filter(|tally| tally.steps >= least);
        let evidence = enough.map(|tally| Evidence {
            share: tally.capped as f64 / tally.steps as f64,
            amount: tally.left.max(tally.deepest),
            count: tally.capped,
            of: tally.steps as f64,
            ..Evidence::default()
        });
        evidence.into_iter().collect()
    },
    place,
    label: |_| "passes of contact run out".into(),
    words: |evidence| {
        let Evidence { share, amount, count, of, .. } = *evidence;
        let now = match evidence.spots[0] {
            Some(_) => format!("now the deepest is at {}", evidence.places()),
            None => "now nothing overlaps".to_string(),
        };
        format!(
            "the passes of contact have run out in {count} of {of} steps with contact, {}: its forces have not \
             settled there; overlaps are up to {amount:.1e} of a face; {now}",
            percent(share)
        )
    },
    advice: "more CONTACT PASSES, or a coarser tolerance there; light nodes between stiff faces and long chains of bodies \
             settle slowly: a mesh that is finer in the softer body, or a smaller TIME STEP SCALE, helps",
};

/// Nodes with the largest overlap now.
fn place(exam: &Exam, evidence: &mut Evidence, comm: &mut dyn Communicator) {
    let domain = &exam.solver.domain;
    let values = domain.contact.iter().flat_map(|contact| contact.node_values());
    let owned = values.filter(|(node, _)| domain.nodes.owned[*node as usize]);
    let overlaps: Vec<(u32, f64)> = owned.map(|(node, values)| (node, -values[3])).collect();
    let [first, ..] = worst_nodes(exam, &overlaps, comm);
    evidence.spots[0] = first;
}
