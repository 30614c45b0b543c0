//! How elements fall into chunks changes no bit.

use super::*;

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

/// Motion below 2⁻⁵⁰ of the speed of sound loads nothing in single precision; what is a little faster does, and in double all.
#[test]
fn single_precision_takes_the_slowest_motion_for_none() {
    let forces = |precision: Precision, speed: f64| {
        let mut rig = Rig::of(precision, &CUBE, &[[0, 1, 2, 3, 4, 5, 6, 7]], elastic(0.3), ASSUMED);
        rig.step(1e-3, |n| CUBE[n].map(|x| speed * (1.0 - x)));
        (0..8).map(|n| rig.force(n)).any(|force| force.iter().any(|&f| f != 0.0))
    };
    let least = (elastic(0.3).moduli().dilatational() / DENSITY).sqrt() * f64::powi(2.0, -50);
    // A mode is the sum of the differences along four edges.
    assert!(!forces(Precision::Single, 0.24 * least) && forces(Precision::Single, 0.26 * least));
    assert!(forces(Precision::Double, 0.24 * least));
}
