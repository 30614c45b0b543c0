//! Hourglass damping of a fluid that takes a good part of what was supplied: slow flow that it has stopped and made heat of.

use super::{Symptom, When};
use crate::comm::ExactSum;
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::health::finding::{Evidence, percent};
use crate::solver::health::place::{elements, worst_element};

pub const SYMPTOM: Symptom = Symptom {
    code: 18,
    when: When::Lines,
    threshold: 0.1,
    // It takes motion and makes none.
    cause: f64::INFINITY,
    measure: |exam, comm| {
        let blocks = &exam.facts.blocks;
        let mut sums: Vec<ExactSum> = vec![ExactSum::new(); 2 * blocks.len()];
        for (block, group, i) in elements(&exam.solver.domain).filter(|(block, ..)| block.law.is_fluid()) {
            let [hourglass, viscous] = taken(block, group, i);
            sums[2 * block.index].add(hourglass);
            sums[2 * block.index + 1].add(viscous);
        }
        ExactSum::merge_ranks(&mut sums, comm);
        let evidence = |(block, sums): (&super::super::watch::BlockFacts, &[ExactSum])| {
            let [hourglass, viscous] = [sums[0].value(), sums[1].value()];
            // What heats a shock is bulk viscosity, and the modes that shocks excite have less. Where there are none, as in slow flow,
            // the modes are the flow itself, sheared and turned.
            let share = (hourglass - viscous) / exam.supplied;
            let counts = !exam.begins && share > 0.0;
            counts.then_some(Evidence { share, amount: hourglass, of: viscous, block: block.id, ..Evidence::default() })
        };
        blocks.iter().zip(sums.chunks_exact(2)).filter_map(evidence).collect()
    },
    place: |exam, evidence, comm| {
        let own = elements(&exam.solver.domain).filter(|(block, ..)| block.id == evidence.block);
        let energies = own.map(|(block, group, i)| (group.places[i], taken(block, group, i)[0]));
        evidence.spots[0] = worst_element(exam, energies, comm);
    },
    label: |evidence| format!("hourglass damping of block {}, a fluid", evidence.block),
    words: |evidence| {
        let Evidence { share, amount, of, block, .. } = *evidence;
        format!(
            "hourglass damping of block {block}, a fluid, has made heat of {amount:.4e}; that is {} of the energy supplied more than \
             bulk viscosity has, {of:.4e}; most of it in {}",
            percent(share),
            evidence.places()
        )
    },
    advice: "flow that is slow against the speed of sound is stopped by it: HOURGLASS CONTROL, ASSUMED STRAIN, 0.01 damps a hundredth \
             as much as the default, and a finer mesh less; see explain HOURGLASS CONTROL",
};

/// What hourglass damping and bulk viscosity have taken in an element.
fn taken(block: &ElementBlock, group: &Group, i: usize) -> [f64; 2] {
    let energies = &block.element.entry().energies;
    [energies.hourglass, energies.viscous].map(|row| row.map_or(0.0, |row| group.value(i, row)))
}
