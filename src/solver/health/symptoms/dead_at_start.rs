//! DEATH takes elements away at the first state, before anything has moved: a rule that already holds, or that watches what the
//! elements do not have.

use super::{Symptom, When, nowhere};
use crate::comm::Communicator;
use crate::mesh::check::counted;
use crate::solver::health::finding::Evidence;
use crate::solver::health::watch::Exam;

pub const SYMPTOM: Symptom = Symptom {
    code: 15,
    when: When::Start,
    threshold: 0.0,
    cause: f64::INFINITY,
    measure,
    place: nowhere,
    label: |evidence| format!("elements of block {} that are gone from the start", evidence.block),
    words: |evidence| {
        let Evidence { count, block, .. } = *evidence;
        format!(
            "DEATH takes {} of block {block} away at the first state, before anything has moved",
            counted(count as usize, "element")
        )
    },
    advice: "see whether MIN and MAX are the right way round, and whether these elements have what is watched: what they do not have is 0",
};

fn measure(exam: &Exam, comm: &mut dyn Communicator) -> Vec<Evidence> {
    let Some(erosion) = &exam.solver.domain.erosion else { return Vec::new() };
    let (blocks, mut counts): (Vec<i64>, Vec<u64>) = erosion.taken.iter().copied().unzip();
    comm.all_sum(&mut counts);
    let of_block = |(block, count)| Evidence { share: count as f64, count, block, ..Evidence::default() };
    blocks.into_iter().zip(counts).map(of_block).collect()
}
