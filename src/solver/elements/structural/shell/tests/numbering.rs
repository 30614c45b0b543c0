//! Which corner of an element comes first in the mesh, and on which side it is looked at from, is nobody's choice: what it answers
//! must not depend on it.

use super::operators::Numbers;
use super::rig::{Rig, STEEL, close};
use crate::material::{ElasticPlastic, Law};
use crate::model::BulkViscosity;
use crate::solver::elements::shell::geometry::Quadrilateral;
use crate::solver::elements::shell::{QUADRILATERAL, rows, rule::Rule};

const PLASTIC: Law =
    Law::ElasticPlastic(ElasticPlastic { young: 200e9, poisson: 0.3, yield_stress: 400e6, hardening: 1e9, beta: 1.0 });

/// The four corners that may be first, and the same seen from the other side.
const NUMBERINGS: [[usize; 4]; 8] =
    [[0, 1, 2, 3], [1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2], [0, 3, 2, 1], [3, 2, 1, 0], [2, 1, 0, 3], [1, 0, 3, 2]];

/// A motion of four corners: where they begin, and velocities and rotation rates of each step.
struct Motion {
    corners: [[f64; 3]; 4],
    steps: Vec<[[[f64; 3]; 4]; 2]>,
}

impl Motion {
    /// A warped element that is sheared by up to a third and turned in its plane, bent, twisted and warped further.
    fn of(numbers: &mut Numbers) -> Motion {
        let corners = numbers.warped::<Quadrilateral, 4, 10>();
        let scaled = |numbers: &mut Numbers| [0; 4].map(|_| numbers.vector().map(|c| 5e-3 * c));
        let ways: Vec<_> = (0..3).map(|_| [scaled(numbers), scaled(numbers)]).collect();
        let spin = 0.02 * numbers.next();
        let steps = (0..60).map(|step| {
            let [mut v, omega] = ways[step / 20];
            v.iter_mut().zip(&corners).for_each(|(v, x)| (v[0], v[1]) = (v[0] - spin * x[1], v[1] + spin * x[0]));
            [v, omega.map(|[x, y, z]| [x, y, z + spin])]
        });
        Motion { corners, steps: steps.collect() }
    }

    /// Forces and moments of the corners, energies, and the stable step, with the corners in this order.
    fn answer(&self, order: [usize; 4], law: &Law) -> (Vec<f64>, Vec<f64>) {
        let mut rig = Rig::of(order.map(|c| self.corners[c]), law.clone(), Rule::Gauss.points(3), 0.05);
        rig.settings.bulk_viscosity = BulkViscosity { linear: 0.06, quadratic: 1.2 };
        for [v, omega] in &self.steps {
            rig.step(order.map(|c| v[c]), order.map(|c| omega[c]));
        }
        let mut forces = vec![0.0; 24];
        for (place, corner) in order.into_iter().enumerate() {
            for kind in [0, 1] {
                let of_node = rig.forces[place + 4 * kind].0;
                (0..3).for_each(|i| forces[12 * kind + 3 * corner + i] = of_node[i]);
            }
        }
        let sums = [QUADRILATERAL.internal_energy, QUADRILATERAL.hourglass_energy, QUADRILATERAL.viscous_energy];
        let mut others = sums.map(|row| rig.state(row)).to_vec();
        others.extend([rig.state(rows::STEP), rig.outcome.stable_step]);
        (forces, others)
    }
}

/// Forces, energies and steps are those of the first numbering to round-off: 1e-15 of the largest force after 60 steps, of which a
/// hundredfold is allowed.
#[test]
fn answers_do_not_depend_on_the_numbering_of_corners() {
    let mut numbers = Numbers::new();
    for case in 0..4 {
        let motion = Motion::of(&mut numbers);
        for law in [STEEL, PLASTIC] {
            let (forces, others) = motion.answer(NUMBERINGS[0], &law);
            let largest = forces.iter().fold(0.0, |largest: f64, f| largest.max(f.abs()));
            assert!(largest > 0.0 && others.iter().all(|other| other.abs() > 0.0), "{case}: {forces:?} {others:?}");
            for order in &NUMBERINGS[1..] {
                let what = format!("element {case}, corners {order:?}");
                let (forces_again, others_again) = motion.answer(*order, &law);
                let pairs = forces.iter().zip(forces_again);
                pairs.for_each(|(a, b)| close(&what, b / largest, a / largest, 1e-13));
                others.iter().zip(others_again).for_each(|(a, b)| close(&what, b / a, 1.0, 1e-13));
            }
        }
    }
}
