//! One step of one chunk of hexahedra with eight points.

use super::field::{Field, Moments, contraction};
use super::{point_rows, rows};
use crate::lanes::{Lanes, Matrix3, Sym3, array};
use crate::material::{Kernel, Step};
use crate::mesh::hexahedron::SIGNS;
use crate::model::BulkViscosity;
use crate::solver::elements::ahead::Ahead;
use crate::solver::elements::bulk_viscosity::{damped_step, damping};
use crate::solver::elements::hexahedron::geometry::{Corners, Gradient, Modes, dot, earlier, gradient, modes};
use crate::solver::elements::hexahedron::hourglass::Resistance;
use crate::solver::elements::hexahedron::kernel::{corner_forces, hourglass_rates, lengths};
use crate::solver::elements::hexahedron::kinematics::{self, Motion};
use crate::solver::elements::pass::{Given, Outcome, StepKernel};
use crate::solver::elements::solids::step_modulus::step_modulus;
use crate::solver::elements::state_rows::{accumulate, store};

/// Numbers that hold for a whole block and step.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Time of the present positions.
    pub time: f64,
    /// Time step Δt that led to them.
    pub time_step: f64,
    /// Elastic dilatational modulus λ + 2μ, force/length².
    pub dilatational: f64,
    /// Shear modulus μ, force/length².
    pub mu: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Bulk viscosity.
    pub viscosity: BulkViscosity,
    /// Whether the stable step follows the moduli of the last increment instead of the elastic ones.
    pub effective_moduli: bool,
}

/// What holds for a whole block: numbers and law.
pub struct EightPointStep<K> {
    /// Constitutive law.
    pub law: K,
    /// Numbers.
    pub settings: Settings,
}

/// What the points have answered.
struct Answer<V> {
    /// Stresses of the points, summed up.
    moments: Moments<V>,
    /// Mean stress before the step.
    old: Sym3<V>,
    /// Largest dilatational modulus, of laws that tell it.
    stiffest: V,
}

impl<K: Kernel> StepKernel<8> for EightPointStep<K> {
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
        let settings = &self.settings;
        let (zero, one, half) = (V::splat(0.0), V::splat(1.0), V::splat(0.5));
        let time_step = V::splat(settings.time_step);
        let x: [Modes<V>; 3] = array![i in 3 => modes(&positions[i])];
        let v: [Modes<V>; 3] = array![i in 3 => modes(&velocities[i])];

        // (i) velocity gradient and hourglass rates at mid-step
        let half_step = V::splat(0.5 * settings.time_step);
        let middle = earlier([&x, &v], half_step);
        let operator = gradient(&middle);
        let measure = stiffness_measure(&operator);
        let Gradient { g24, volume192: middle_volume192 } = operator;
        let inverse = one / middle_volume192;
        let velocity_gradient: Matrix3<V> = array![i in 3 => array![j in 3 => dot(&v[i], &g24[j]) * inverse]];
        let rates = hourglass_rates(&v, &middle, &velocity_gradient);

        // (ii) frame, stretch and mean strain increment
        let mut frame = array![i in 4 => V::load(&state[rows::FRAME + i], part)];
        let mut stretch = Sym3::load(&state[rows::STRETCH..], part);
        let Motion { strain, frame: r, middle: r_middle } =
            kinematics::advance(&velocity_gradient, &mut frame, &mut stretch, time_step, true);
        store(frame, state, rows::FRAME, part);
        store(stretch.to_array(), state, rows::STRETCH, part);

        // (iii) strain and stress at the points
        let local: Resistance<V> = array![i in 3 => array![a in 4 => {
            let along = r_middle[0][i] * rates[0][a] + r_middle[1][i] * rates[1][a] + r_middle[2][i] * rates[2][a];
            along * time_step
        }]];
        // The forces at the start of the step have the contraction that they were found with, and do their work by it.
        let poisson = V::splat(settings.poisson);
        let flowing = V::load(&state[rows::FLOWING], part);
        let before = V::load(&state[rows::FLOWING_BEFORE], part);
        flowing.store(&mut state[rows::FLOWING_BEFORE], part);
        let (across, across_before) = (contraction(poisson, flowing), contraction(poisson, before));
        let field = Field::of_rates(&local, &lengths(&middle, &r_middle, measure));
        let middle_volume = middle_volume192 * V::splat(1.0 / 192.0);
        let motion = (&strain, &field, [across_before, across]);
        let Answer { moments, old, stiffest } = self.points(motion, middle_volume, state, part);

        // (iv) stable step √(M V / 2(λ+2μ) B:B) and bulk viscosity, as with one point: the assumed strain's stiffness is the same
        let light = given.moving * given.least_share;
        let operator = gradient(&x);
        let b_squared = operator.square4608();
        let measure = stiffness_measure(&operator);
        let modulus = if K::STIFFNESS {
            stiffest
        } else {
            let elastic = [settings.dilatational, settings.mu];
            step_modulus(elastic, settings.effective_moduli, [&old, &moments.mean], &strain)
        };
        let bound = (light * operator.volume192 * V::splat(12.0) / (modulus * b_squared)).sqrt();
        let rate = velocity_gradient[0][0] + velocity_gradient[1][1] + velocity_gradient[2][2];
        let damping = damping(settings.viscosity, bound, rate);
        let viscous = damping * modulus * bound * rate;
        let last = V::load(&state[rows::VISCOUS_STRESS], part);
        viscous.store(&mut state[rows::VISCOUS_STRESS], part);
        accumulate((last + viscous) * half * strain.trace() * middle_volume, &mut state[rows::VISCOUS_ENERGY], part);
        let stable_step = damped_step(bound, damping);
        // An element that passed through itself within the step has failed, even if it looks sound at the end.
        let stable_step = V::select_less(zero, middle_volume192, stable_step, zero);

        // (v) corner forces, by the transpose of the strain field
        let volume = operator.volume192 * V::splat(1.0 / 192.0);
        let local = moments.resistance(&lengths(&x, &r, measure), across, volume);
        let resistance: Resistance<V> = array![i in 3 => array![a in 4 => {
            r[i][0] * local[0][a] + r[i][1] * local[1][a] + r[i][2] * local[2][a]
        }]];
        let total = moments.mean.rotate(&r).add_diagonal(viscous);
        let force = corner_forces(&total, &resistance, &x, &operator.g24, one / operator.volume192);
        Outcome { force, stable_step, motion_step: stable_step, rate: V::splat(0.0) }
    }
}

/// B:B/V.
#[inline(always)]
fn stiffness_measure<V: Lanes>(operator: &Gradient<V>) -> V {
    operator.square4608() * V::splat(192.0 / 4608.0) / operator.volume192
}

/// A point flows where this part of its strain increment or more is plastic: what creeps, or hardens nearly as stiffly as it is elastic, is
/// elastic.
const FLOWS: f64 = 0.01;

impl<K: Kernel> EightPointStep<K> {
    /// 1 where a point flows whose deviator of this `stress` is the `returned` part r of the elastic trial s*, else 0: the plastic part of its strain
    /// increment Δe is |s*| (1 − r)/2μ. Ones and zeros have the same sum in any order, so that what is symmetrical stays so.
    #[inline(always)]
    fn flows<V: Lanes>(&self, stress: &Sym3<V>, strain: &Sym3<V>, returned: V) -> V {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let (s, e) = (stress.deviator(), strain.deviator());
        let plastic = s.contract(s).sqrt() * (one - returned);
        let least = e.contract(e).sqrt() * returned * V::splat(2.0 * self.settings.mu * FLOWS);
        // Of a deviator that is returned to nothing both are nothing.
        let flows = V::select_less(returned, V::splat(0.5), one, V::select_less(plastic, least, zero, one));
        V::select_less(returned, one, flows, zero)
    }

    /// Advances all points and books their energy.
    #[inline(always)]
    fn points<V: Lanes>(
        &self,
        (mean, field, [across_before, across]): (&Sym3<V>, &Field<V>, [[V; 2]; 2]),
        volume: V,
        state: &mut [V::Row],
        part: usize,
    ) -> Answer<V> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let (own, points) = state.split_at_mut(rows::POINTS);
        let stride = point_rows::LAW + K::STATE.len();
        let mut answer = Answer { moments: Moments::new(), old: Moments::new().mean, stiffest: zero };
        let (mut work, mut flowing) = (zero, zero);
        for (point, signs) in points.chunks_exact_mut(stride).zip(SIGNS) {
            let (point_own, law_state) = point.split_at_mut(point_rows::LAW);
            let strain = mean.zip(field.at(signs, across), |a, b| a + b);
            let strain_before = mean.zip(field.at(signs, across_before), |a, b| a + b);
            let old = Sym3::load(&point_own[point_rows::STRESS..], part);
            let mut stress = old;
            let motion = Step {
                strain,
                // Laws that look at these are refused.
                biot_strain: strain,
                volume: one,
                middle_volume: one,
                energy: zero,
                swept: zero,
                time: self.settings.time,
                time_step: self.settings.time_step,
            };
            let response = self.law.update(&motion, &mut stress, law_state, part);
            // A point that is lost carries nothing.
            let carries = one - V::load(&point_own[point_rows::LOST], part);
            let stress = Sym3 {
                xx: stress.xx * carries,
                yy: stress.yy * carries,
                zz: stress.zz * carries,
                xy: stress.xy * carries,
                yz: stress.yz * carries,
                zx: stress.zx * carries,
            };
            store(stress.to_array(), point_own, point_rows::STRESS, part);
            work = work + (old.contract(strain_before) + stress.contract(strain));
            if V::any_less(response.returned, one) {
                flowing = flowing + self.flows(&stress, &strain, response.returned);
            }
            answer.old = answer.old.zip(old, |sum, stress| sum + V::splat(0.125) * stress);
            answer.moments.add(signs, &stress);
            if K::STIFFNESS {
                answer.stiffest = answer.stiffest.max(response.stiffness.dilatational);
            }
        }
        (flowing * V::splat(0.125)).store(&mut own[rows::FLOWING], part);
        accumulate(work * V::splat(0.5 * 0.125) * volume, &mut own[rows::INTERNAL_ENERGY], part);
        answer
    }
}
