//! Resistance to the one hourglass mode of each direction, that its mean strain does not see.
//!
//! A resistance Q_i acts in direction i of the element's frame on the mode Γ = (1, −1, 1, −1), per unit of thickness; it is
//! kept in the turning frame. It is returned with the deviatoric stress as in the hexahedron.

use crate::lanes::Lanes;
use crate::model::Hourglass;

/// What a control may look at; all per unit of thickness.
pub struct State<V> {
    /// L₂/L₁ and L₁/L₂ of the lengths L_i = Λ_i · x̂_i in the frame, positive; two edges each on a box.
    pub proportions: [V; 2],
    /// B_iI B_iI / A at the end of the step.
    pub stiffness_measure: V,
    /// One over the mass of the lightest corner, and the thickness that it belongs to.
    pub lightest: [V; 2],
    /// Shear modulus μ.
    pub mu: V,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Factor by which the material's return scaled the trial deviator, 1 where elastic.
    pub returned: V,
    /// Time step.
    pub time_step: V,
}

impl<V: Lanes> State<V> {
    /// Four times the mass of the lightest corner.
    #[inline(always)]
    fn mass(&self) -> V {
        let [inverse, thickness] = self.lightest;
        V::splat(4.0) / (inverse * thickness)
    }

    /// 4√2 ε √(μ M B:B/A)
    #[inline(always)]
    fn damping(&self, viscosity: f64) -> V {
        V::splat(4.0 * std::f64::consts::SQRT_2 * viscosity) * (self.mu * self.mass() * self.stiffness_measure).sqrt()
    }
}

/// The usual stiffness coefficient.
const USUAL_STIFFNESS: f64 = 0.05;

/// Stiffness coefficients up to here have next to no influence on the stable step.
const LARGEST_USUAL_STIFFNESS: f64 = 0.15;

/// Advances the stored resistance `q` by the hourglass rates and returns the total resistance.
///
/// Flanagan and Belytschko (1981): Q̇ = κ μ B:B/(2A) q̇, what the hexahedron's becomes when it is very thick, and beside it
/// 4√2 ε √(μ M B:B/A) q̇. Belytschko and Bindeman's assumed strain (1993): Q̇₁ = 2μ/(1−ν) (L₂/L₁)/12 q̇₁ and so on.
#[inline(always)]
pub fn resist<V: Lanes>(control: Hourglass, rate: &[V; 2], q: &mut [V; 2], state: &State<V>) -> [V; 2] {
    match control {
        Hourglass::FlanaganBelytschko { stiffness, viscosity } => {
            let factor = V::splat(0.5 * stiffness) * state.mu * state.stiffness_measure * state.time_step;
            *q = [q[0] + factor * rate[0], q[1] + factor * rate[1]];
            if viscosity == 0.0 {
                return *q;
            }
            let damping = state.damping(viscosity);
            [q[0] + damping * rate[0], q[1] + damping * rate[1]]
        }
        Hourglass::AssumedStrain { factor } => {
            let bending = state.mu * state.time_step * V::splat(factor / (6.0 * (1.0 - state.poisson)));
            // An element drawn out to a needle across its frame would else be stiffer than its own step allows.
            let [first, second] = state.proportions;
            let (first, second) = (first.min(state.stiffness_measure), second.min(state.stiffness_measure));
            let kept = state.returned;
            *q = [(q[0] + bending * first * rate[0]) * kept, (q[1] + bending * second * rate[1]) * kept];
            *q
        }
    }
}

/// Part of the viscosity by which a fluid's modes are resisted, at most 1: as in the hexahedron the whole of it at the default
/// κ = 0.05 of Flanagan and Belytschko, and with assumed strain.
pub fn of_fluids(control: Hourglass) -> f64 {
    match control {
        Hourglass::FlanaganBelytschko { stiffness, viscosity } => ((stiffness + viscosity) / USUAL_STIFFNESS).min(1.0),
        Hourglass::AssumedStrain { factor } => factor.min(1.0),
    }
}

/// Elastic stiffness of the stiffer of both modes, per unit of thickness.
#[inline(always)]
pub fn stiffness<V: Lanes>(control: Hourglass, mu: V, poisson: f64, proportions: &[V; 2], stiffness_measure: V) -> V {
    match control {
        Hourglass::FlanaganBelytschko { stiffness, .. } => V::splat(0.5 * stiffness) * mu * stiffness_measure,
        Hourglass::AssumedStrain { factor } => {
            let bending = mu * V::splat(factor / (6.0 * (1.0 - poisson)));
            bending * proportions[0].max(proportions[1]).min(stiffness_measure)
        }
    }
}

/// Largest stable time step with hourglass control, given the one without. See the hexahedron's; a mode has the mass M/16 per
/// unit of its rate.
#[inline(always)]
pub fn stable_step<V: Lanes>(control: Hourglass, without: V, state: &State<V>) -> V {
    match control {
        Hourglass::FlanaganBelytschko { stiffness, viscosity } => {
            if viscosity == 0.0 && stiffness <= LARGEST_USUAL_STIFFNESS {
                return without;
            }
            let scale = V::splat(16.0) / state.mass();
            let mut omega2 = V::splat(0.5 * stiffness) * state.mu * state.stiffness_measure * scale;
            if stiffness > LARGEST_USUAL_STIFFNESS {
                omega2 = omega2 * V::splat(1.5) + V::splat(4.0) / (without * without);
            }
            let zeta = V::splat(0.5) * state.damping(viscosity) * scale;
            let limit = V::splat(2.0) / ((omega2 + zeta * zeta).sqrt() + zeta);
            // In this order a NaN of the element's own step, its sign of failure, stays one.
            V::select_less(limit, without, limit, without)
        }
        Hourglass::AssumedStrain { factor } if factor > 1.0 => without / V::splat(factor).sqrt(),
        Hourglass::AssumedStrain { .. } => without,
    }
}
