//! What an element does at the end of a step beside its stress: resistance to hourglass modes, as a solid or as a fluid,
//! and the barrier.

use super::barrier::{self, Barrier, Solid};
use super::exact::{self, Start};
use super::fluid::{self, Held};
use super::geometry::{Corners, Gradient, Modes, gradient};
use super::hourglass::{self, Resistance, bounded};
use super::kernel::{Settings, Slowed, lengths, resist};
use super::kinematics::Motion;
use super::rows;
use crate::lanes::Lanes;
use crate::material::Kernel;
use crate::solver::elements::solids::fluid::acting_step;
use crate::solver::elements::state_rows::store;

/// What is known of the end of the step.
pub struct End<'a, V> {
    /// Modes of the positions.
    x: &'a [Modes<V>; 3],
    /// Modes of the velocities, of mid-step.
    v: &'a [Modes<V>; 3],
    /// The operator B.
    pub gradient: Gradient<V>,
    /// One over 192 times the volume.
    pub inverse: V,
    /// 4608 B_iI B_iI
    pub b_squared: V,
    /// B_iI B_iI / V
    stiffness_measure: V,
    /// Eight times the mass of the lightest corner.
    pub light: V,
}

impl<'a, V: Lanes> End<'a, V> {
    /// Of modes of positions and velocities, and of eight times the mass of the lightest corner.
    #[inline(always)]
    pub fn of([x, v]: [&'a [Modes<V>; 3]; 2], light: V) -> Self {
        let gradient = gradient(x);
        let inverse = V::splat(1.0) / gradient.volume192;
        let b_squared = gradient.square4608();
        let stiffness_measure = b_squared * inverse * V::splat(192.0 / 4608.0);
        End { x, v, gradient, inverse, b_squared, stiffness_measure, light }
    }

    /// Hourglass resistance in space, and the stable step with it; given hourglass rates in space, and the shear modulus,
    /// the factor of the law's return and the stable step without resistance.
    #[inline(always)]
    pub fn resist_as_solid<K: Kernel, H: hourglass::Control>(
        &self,
        control: &H,
        (rate, motion): (&Resistance<V>, &Motion<V>),
        [mu, returned, without]: [V; 3],
        state: &mut [V::Row],
        part: usize,
        settings: &Settings,
    ) -> (Resistance<V>, V) {
        let time_step = V::splat(settings.time_step);
        let bounded = if bounded::any(self.x, &self.gradient) {
            bounded::bounded([self.x, self.v], &self.gradient, self.b_squared, time_step)
        } else {
            None
        };
        let r = &motion.frame;
        let mut felt = hourglass::State {
            lengths: if H::LENGTHS { lengths(self.x, r, self.stiffness_measure) } else { [self.light; 3] },
            stiffness_measure: self.stiffness_measure,
            mass: self.light,
            mu,
            poisson: V::splat(settings.poisson),
            returned,
            time_step,
        };
        if let Some(bounded) = &bounded {
            felt.mu = mu * bounded.factor;
            felt.mass = self.light * bounded.factor;
        }
        let kept = bounded.as_ref().map(|bounded| bounded.kept);
        let resistance = resist::<V, K, H>(control, rate, [&motion.middle, r], state, part, (&felt, kept));
        let stable_step = match &bounded {
            None => control.stable_step(without, self.stiffness_measure, self.light, mu),
            Some(bounded) => bounded.stable_step::<H>(control, without, [self.stiffness_measure, self.light, mu]),
        };
        (resistance, stable_step)
    }

    /// Hourglass resistance of a fluid and the rates that it slows, both in space, and what holds its corners.
    #[inline(always)]
    pub fn resist_as_fluid<K: Kernel, H: hourglass::Control>(
        &self,
        control: &H,
        [positions, velocities]: [&[Corners<V>; 3]; 2],
        (start, slowed): (&Start<V>, &Slowed<V>),
        state: &mut [V::Row],
        part: usize,
        settings: &Settings,
    ) -> (Resistance<V>, Resistance<V>, Held<V>) {
        let time_step = V::splat(settings.time_step);
        let sizes = [
            self.gradient.volume192 * V::splat(1.0 / 192.0),
            self.light,
            slowed.stable_step,
            time_step,
            self.b_squared * V::splat(1.0 / 4608.0),
        ];
        let rates = exact::rates(self.v, self.x, &start.flow, self.gradient.volume192);
        let acting = acting_step(slowed.whole_step, time_step);
        let resistance = fluid::resistance(&rates, control.of_fluids(), self.light, acting);
        for (i, along) in resistance.iter().enumerate() {
            store(*along, state, rows::HOURGLASS + 4 * i, part);
        }
        let taken = start.taken(state, part);
        let corners = &mut state[exact::corner_rows::<K>()];
        let held = fluid::hold([positions, velocities], corners, part, sizes, taken);
        (resistance, rates, held)
    }

    /// What the barrier does, where any element is or was pressed together or closes fast: given 192 times the volumes in
    /// the middle of the step and at the start of all, and the part of the volume by which it grows in a step of its own.
    #[inline(always)]
    pub fn barrier<K: Kernel>(
        &self,
        middle_volume192: V,
        initial192: V,
        growth: V,
        settings: &Settings,
    ) -> Option<Barrier<V>> {
        let volumes192 = [middle_volume192, self.gradient.volume192];
        if !K::HYPOELASTIC || !(barrier::any_near(volumes192, initial192) || barrier::any_fast(growth)) {
            return None;
        }
        let solid = Solid {
            motion: [self.x, self.v],
            operator: &self.gradient,
            middle_volume192,
            growth,
            square4608: self.b_squared,
            initial192,
            dilatational: V::splat(settings.dilatational),
        };
        Some(solid.held(settings.steps()))
    }
}
