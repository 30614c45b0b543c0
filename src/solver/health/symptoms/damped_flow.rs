//! Hourglass damping of a fluid that takes a good part of what was supplied: slow flow that it has stopped and made heat of.

use super::{Symptom, When};
use crate::solver::elements::{ElementBlock, Group};
use crate::solver::health::finding::{Evidence, percent};
use crate::solver::health::place::{energies_of_blocks, worst_of_block};
use crate::solver::health::watch::BlockFacts;

pub const SYMPTOM: Symptom = Symptom {
    code: 18,
    when: When::Lines,
    threshold: 0.1,
    // It takes motion and makes none.
    cause: f64::INFINITY,
    measure: |exam, comm| {
        let evidence = |(block, [hourglass, viscous]): (&BlockFacts, [f64; 2])| {
            // What heats a shock is bulk viscosity, and the modes that shocks excite have less. Where there are none, as in slow flow,
            // the modes are the flow itself, sheared and turned.
            let share = (hourglass - viscous) / exam.supplied;
            let counts = !exam.begins && share > 0.0;
            let of = exam.facts.damping;
            counts.then_some(Evidence { share, amount: hourglass, of, block: block.id, ..Evidence::default() })
        };
        exam.facts.blocks.iter().zip(energies_of_blocks(exam, taken, comm)).filter_map(evidence).collect()
    },
    place: |exam, evidence, comm| {
        let hourglass = |block: &ElementBlock, group: &Group, i| taken(block, group, i)[0];
        evidence.spots[0] = worst_of_block(exam, evidence.block, hourglass, comm);
    },
    label: |evidence| format!("hourglass damping of block {}, a fluid", evidence.block),
    words: |evidence| {
        let Evidence { share, amount, of, block, .. } = *evidence;
        format!(
            "hourglass damping of block {block}, a fluid, has made heat of {amount:.4e}; that is {} of the energy supplied more than \
             bulk viscosity has; its factor is {of}, and with HOURGLASS CONTROL, ASSUMED STRAIN, {} it is a hundredth; most of it in {}",
            percent(share),
            hundredth(of),
            evidence.places()
        )
    },
    advice: "flow that is slow against the speed of sound is stopped by it: a smaller factor damps as much less, and a finer mesh less too; \
             see explain HOURGLASS CONTROL",
};

/// A hundredth of a factor, rounded to what reads well in a deck.
fn hundredth(factor: f64) -> f64 {
    ((0.01 * factor * 1e6).round() / 1e6).max(1e-6)
}

/// What hourglass damping and bulk viscosity have taken in an element of a fluid; nothing in another.
fn taken(block: &ElementBlock, group: &Group, i: usize) -> [f64; 2] {
    if !block.law.is_fluid() {
        return [0.0; 2];
    }
    let energies = &block.element.entry().energies;
    [energies.hourglass, energies.viscous].map(|row| row.map_or(0.0, |row| group.value(i, row)))
}
