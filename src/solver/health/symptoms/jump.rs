//! A displacement that is prescribed for the first instant: the nodes are taken there within one step.

use super::{Symptom, When, nowhere};
use crate::solver::health::finding::Evidence;

pub const SYMPTOM: Symptom = Symptom {
    code: 19,
    when: When::Start,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure: |exam, _| {
        let of = |jump: crate::model::Jump| Evidence {
            share: jump.size.abs() / exam.solver.whole_step,
            amount: jump.size,
            count: jump.node_set.unsigned_abs(),
            of: jump.direction.axis() as f64,
            ..Evidence::default()
        };
        exam.facts.jump.map(of).into_iter().collect()
    },
    place: nowhere,
    label: |evidence| format!("a displacement of node set {} that jumps at the start", evidence.count),
    words: |evidence| {
        let Evidence { share, amount, count, of, .. } = *evidence;
        let axis = ["X", "Y", "Z"].get(of as usize).copied().unwrap_or_default();
        format!(
            "PRESCRIBED DISPLACEMENT, {axis} of node set {count} is {amount:.4e} at the start instead of 0: its nodes jump there within \
             the first step, at a velocity of {share:.3e}"
        )
    },
    advice: "let its function begin with 0 and rise over many steps; what is displaced before the start belongs into the mesh",
};
