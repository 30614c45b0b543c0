//! The forces of a hexahedron's elastic stiffness and what its corners weigh, for the largest frequency of a mesh.
//!
//! A pass with this kernel takes the velocities of its nodes for displacements and gives K u of the elastic moduli in the present
//! geometry, with hourglass stiffness, times what damping costs the element's own step: where that is Δt̂ s, s = √(1 + e²) − e, the
//! step Δt is stable for K and a damping C ≤ e Δt̂ K together if it is for K/s². (It is if 4 M/Δt² ≥ K + 2 C/Δt, which 1 + 2e/s = 1/s²
//! makes so for every Δt ≥ Δt̂ s.) Nothing of the state changes.

use super::barrier::{self, stiffness};
use super::geometry::{self, Corners, dot, gradient, modes};
use super::hourglass::{self, Control, Either, Resistance, bounded};
use super::kernel::{corner_forces, hourglass_rates, lengths};
use super::kinematics::rotation_matrix;
use crate::lanes::{Lanes, Matrix3, Sym3, array};
use crate::material::Moduli;
use crate::model::BulkViscosity;
use crate::solver::elements::Probe;
use crate::solver::elements::ahead::Ahead;
use crate::solver::elements::pass::{Given, Outcome, StepKernel};

/// What holds for a whole block.
pub struct Vibration {
    /// What is asked.
    pub probe: Probe,
    /// Elastic moduli.
    pub moduli: Moduli,
    /// Hourglass control.
    pub control: Either,
    /// Bulk viscosity.
    pub viscosity: BulkViscosity,
    /// Where to look.
    pub rows: FrameRows,
    /// Whether hourglass resistance is bounded where elements are bent out of all shape.
    pub bounded: bool,
    /// Density at the start, of laws with a barrier of the volume.
    pub density: Option<f64>,
}

/// Where the elements of a kind store what is looked at.
pub struct FrameRows {
    /// First row of the frame.
    pub frame: usize,
    /// Row of the bulk viscosity of the last step.
    pub viscous_stress: usize,
}

impl StepKernel<8> for Vibration {
    // Masses are no forces.
    const BALANCED: bool = false;

    #[inline(always)]
    fn step<V: Lanes>(
        &self,
        positions: &[Corners<V>; 3],
        velocities: &[Corners<V>; 3],
        state: &mut [V::Row],
        part: usize,
        given: Given<V, 8>,
        _: &mut Ahead<V::Row>,
    ) -> Outcome<V, 8> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let light = given.moving * given.least_share;
        if matches!(self.probe, Probe::Mass) {
            // Forces are subtracted.
            let corner = zero - light * V::splat(0.125);
            return Outcome {
                force: [[corner; 8], [zero; 8], [zero; 8]],
                stable_step: one,
                motion_step: one,
                rate: zero,
            };
        }
        let x: [geometry::Modes<V>; 3] = array![i in 3 => modes(&positions[i])];
        let u: [geometry::Modes<V>; 3] = array![i in 3 => modes(&velocities[i])];
        let operator = gradient(&x);
        let inverse = one / operator.volume192;
        let l: Matrix3<V> = array![i in 3 => array![j in 3 => dot(&u[i], &operator.g24[j]) * inverse]];
        // (i) stress of the mean strain
        let strain = Sym3::of(&l);
        let (lambda, two_mu) = (V::splat(self.moduli.lambda), V::splat(self.moduli.two_mu));
        let stress = Sym3 {
            xx: strain.xx * two_mu,
            yy: strain.yy * two_mu,
            zz: strain.zz * two_mu,
            xy: strain.xy * two_mu,
            yz: strain.yz * two_mu,
            zx: strain.zx * two_mu,
        };
        let stress = stress.add_diagonal(lambda * strain.trace());
        // (ii) hourglass resistance in the frame
        let r = rotation_matrix(&array![i in 4 => V::load(&state[self.rows.frame + i], part)]);
        let rates = hourglass_rates(&u, &x, &l);
        let local: Resistance<V> = array![i in 3 => array![a in 4 => {
            r[0][i] * rates[0][a] + r[1][i] * rates[1][a] + r[2][i] * rates[2][a]
        }]];
        let measure = operator.square4608() * inverse * V::splat(192.0 / 4608.0);
        let bounded = self.bounded && bounded::any(&x, &operator);
        let factor = if bounded { bounded::factor(bounded::squares(&x, &operator)) } else { one };
        let elastic = hourglass::State {
            lengths: lengths(&x, &r, measure),
            stiffness_measure: measure,
            mass: light,
            mu: two_mu * V::splat(0.5) * factor,
            poisson: V::splat(self.moduli.poisson()),
            returned: one,
            time_step: one,
        };
        let local = self.control.resist(&local, &mut [[zero; 4]; 3], &elastic);
        let resistance: Resistance<V> = array![i in 3 => array![a in 4 => {
            r[i][0] * local[0][a] + r[i][1] * local[1][a] + r[i][2] * local[2][a]
        }]];
        // (iii) forces, and what damping costs
        let modulus = V::splat(self.moduli.dilatational());
        let damping = self.damping(V::load(&state[self.rows.viscous_stress], part) / modulus);
        let part_left = (one + damping * damping).sqrt() - damping;
        let factor = one / (part_left * part_left);
        let held = self.density.map(|density| given.material * V::splat(192.0 / density));
        let held = held.filter(|&initial192| barrier::any_near([operator.volume192; 2], initial192));
        let held = held.map(|initial192| stiffness(&x, &operator, initial192, modulus));
        let stress = held.map_or(stress, |[along, _]| stress.add_diagonal(along * strain.trace()));
        let mut force = corner_forces(&stress, &resistance, &x, &operator.g24, inverse);
        if let Some([_, all]) = held {
            // All that is no translation.
            for i in 0..3 {
                let moved = geometry::corners(&array![k in 7 => u[i][k] * V::splat(0.125)]);
                force[i] = array![n in 8 => force[i][n] + all * moved[n]];
            }
        }
        Outcome {
            force: array![i in 3 => array![n in 8 => force[i][n] * factor]],
            stable_step: one,
            motion_step: one,
            rate: zero,
        }
    }
}

impl Vibration {
    /// The damping e = b₁ + b₂² y of an element whose last bulk viscosity was q = −e y (λ+2μ), y = −Δt̂ tr D; b₁ where it expands.
    #[inline(always)]
    fn damping<V: Lanes>(&self, viscous: V) -> V {
        let BulkViscosity { linear, quadratic } = self.viscosity;
        let pressed = (V::splat(0.0) - viscous).max(V::splat(0.0));
        let root = (V::splat(linear * linear) + V::splat(4.0 * quadratic * quadratic) * pressed).sqrt();
        (V::splat(linear) + root) * V::splat(0.5)
    }
}
