//! Every instruction set gives the same bits.

use super::*;
use crate::material::ElasticPlastic;

/// Sets this processor has, widest first.
fn instruction_sets() -> Vec<InstructionSet> {
    InstructionSet::available().collect()
}

/// Everything that a pass over 19 random elements leaves behind after each of twenty cycles, as bits; the elements
/// fill two chunks and three lanes of a third.
fn history(precision: Precision, law: Law, control: Hourglass, instructions: InstructionSet) -> Vec<u64> {
    let mut random = Random(13);
    let points: Vec<[f64; 3]> = (0..19).flat_map(|_| random.warped(0.3)).collect();
    let cells: Vec<[u32; 8]> = (0..19u32).map(|e| std::array::from_fn(|n| 8 * e + n as u32)).collect();
    let mut rig = Rig::of(precision, &points, &cells, law, control);
    rig.pass.bulk_viscosity = BulkViscosity { linear: 0.06, quadratic: 1.2 };
    rig.pass.moduli = StepModuli::Effective;
    rig.pass.instructions = instructions;
    // Late enough for all that is lit.
    rig.pass.time = 1.0;
    let mut bits = Vec::new();
    for _ in 0..20 {
        let velocities: Vec<[f64; 3]> = points.iter().map(|_| random.vector()).collect();
        let found = rig.step(3e-3, |n| velocities[n]);
        bits.push(found.stable_step.to_bits());
        bits.push(u64::from(found.controlling.unwrap_or(u32::MAX)));
        assert_eq!(found.failed, None);
        bits.extend(rig.forces.iter().flat_map(|f| f.0).map(f64::to_bits));
    }
    bits.extend(rig.block.interior.state.iter().flat_map(|row| row.0).map(f64::to_bits));
    bits.extend(rig.block.interior.single.iter().flat_map(|row| row.0).map(|x| u64::from(x.to_bits())));
    bits
}

/// In both precisions.
fn assert_agreement(law: &Law, control: Hourglass) {
    for precision in [Precision::Double, Precision::Single] {
        let histories: Vec<_> =
            instruction_sets().iter().map(|&set| history(precision, law.clone(), control, set)).collect();
        for (other, set) in histories.iter().zip(instruction_sets()) {
            let first = other.iter().zip(&histories[0]).position(|(a, b)| a != b);
            assert_eq!(first, None, "{precision:?}, {law:?}, {control:?}, {}", set.name());
        }
    }
}

#[test]
fn instruction_sets_agree_to_the_bit() {
    let plastic = |beta| {
        Law::ElasticPlastic(ElasticPlastic { young: 200e9, poisson: 0.3, yield_stress: 1e8, hardening: 1e9, beta })
    };
    let viscous = Hourglass::FlanaganBelytschko { stiffness: 0.05, viscosity: 0.02 };
    for law in [elastic(0.3), plastic(1.0), plastic(0.3)] {
        for control in [ASSUMED, flanagan_belytschko(0.05), viscous, flanagan_belytschko(0.4)] {
            assert_agreement(&law, control);
        }
    }
}

/// Every law there is, with the properties that a deck gives it.
#[test]
fn instruction_sets_agree_for_every_law() {
    let source = crate::deck::Source::new("materials.i", include_str!("../../../../../decks/materials.i"));
    let problem = crate::model::examine(source, None).unwrap_or_else(|found| panic!("{}", found.render(false)));
    for law in problem.model.materials.into_iter().map(|material| material.law) {
        for control in [ASSUMED, flanagan_belytschko(0.05)] {
            assert_agreement(&law, control);
        }
    }
}

/// The lanes that fill up a chunk neither count as elements nor disturb those that do: nineteen elements at once, or
/// one after the other, come to the same.
#[test]
fn chunks_do_not_matter() {
    let mut random = Random(14);
    let elements: Vec<Corners> = (0..19).map(|_| random.warped(0.3)).collect();
    let cells: Vec<[u32; 8]> = (0..19u32).map(|e| std::array::from_fn(|n| 8 * e + n as u32)).collect();
    let velocities: Vec<[f64; 3]> = (0..152).map(|_| random.vector()).collect();
    for precision in [Precision::Double, Precision::Single] {
        together_or_alone(precision, &elements, &cells, &velocities);
    }
}

fn together_or_alone(precision: Precision, elements: &[Corners], cells: &[[u32; 8]], velocities: &[[f64; 3]]) {
    let mut together = Rig::of(precision, &elements.concat(), cells, elastic(0.3), ASSUMED);
    let found = together.step(1e-3, |n| velocities[n]);
    let mut smallest = PassOutcome::NOTHING;
    for (e, corners) in elements.iter().enumerate() {
        let mut alone = Rig::of(precision, corners, &[[0, 1, 2, 3, 4, 5, 6, 7]], elastic(0.3), ASSUMED);
        let one = alone.step(1e-3, |n| velocities[8 * e + n]);
        smallest = smallest.and(PassOutcome { controlling: Some(e as u32), ..one });
        for n in 0..8 {
            assert_eq!(alone.force(n), together.force(8 * e + n), "element {e}");
        }
    }
    assert_eq!(found, smallest);
}
