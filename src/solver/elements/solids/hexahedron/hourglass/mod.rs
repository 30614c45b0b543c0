//! Resistance to hourglass modes, the twelve motions of a hexahedron that its mean strain does not see.
//!
//! A resistance Q_iα acts in direction i of the element's frame on mode α (ηζ, ζξ, ξη, ξηζ), with base vectors of
//! ±1. It is kept in the turning frame, so a rigid rotation leaves it alone.
//!
//! Plastic flow: a uniform stiffness of elastic size locks a flowing element, as that of Flanagan and Belytschko does.
//! In the assumed strain control the hourglass stress is therefore returned with the deviatoric stress: where radial
//! return scales the trial deviator by r, Q is scaled by the same r. This is the first-order change of the returned
//! stress across the element for modes orthogonal to the flow direction: s(ξ) = R s_trial(ξ)/|s_trial(ξ)|.

pub(super) mod bounded;

use crate::lanes::{Lanes, array};

/// Hourglass resistance or rate of an element, `[direction][mode]` in its frame.
pub type Resistance<V> = [[V; 4]; 3];

/// What a control may look at.
pub struct State<V> {
    /// Lengths L_i = Λ_i · x̂_i in the frame, positive; four edges each on a box. Not below L_j L_k V/(8 B:B).
    pub lengths: [V; 3],
    /// B_iI B_iI / V at the end of the step.
    pub stiffness_measure: V,
    /// Element mass, or eight times the mass of its lightest corner where that is less.
    pub mass: V,
    /// Shear modulus μ.
    pub mu: V,
    /// Poisson's ratio.
    pub poisson: V,
    /// Factor by which the material's return scaled the trial deviator, 1 where elastic.
    pub returned: V,
    /// Time step.
    pub time_step: V,
}

/// A kind of hourglass control. Implementations are compiled into the element loop.
pub trait Control: Copy + Send + Sync {
    /// Whether [`State::lengths`] is needed.
    const LENGTHS: bool;
    /// Advances the stored resistance `q` by the hourglass rates and returns the total resistance.
    fn resist<V: Lanes>(&self, rate: &Resistance<V>, q: &mut Resistance<V>, state: &State<V>) -> Resistance<V>;
    /// Factor on the stored resistance in a step, and on what is added to it.
    #[inline(always)]
    fn kept<V: Lanes>(&self, _state: &State<V>) -> V {
        V::splat(1.0)
    }
    /// Part of the viscosity by which a fluid's modes are resisted, at most 1.
    fn of_fluids(&self) -> f64;
    /// What the step of elements with bounded resistance has to allow for beside their own: the stiffness of a mode whose
    /// base vector is as long as that of a parallelepiped, over B:B/V: a modulus.
    fn further_modulus<V: Lanes>(&self, mu: V) -> V;
    /// Largest stable time step with hourglass control, given the one without, `stiffness_measure`, mass and μ.
    fn stable_step<V: Lanes>(&self, without: V, stiffness_measure: V, mass: V, mu: V) -> V;
}

/// Flanagan and Belytschko (1981): the same stiffness and viscosity for all modes.
#[derive(Debug, Clone, Copy)]
pub struct FlanaganBelytschko {
    /// Stiffness coefficient κ, without dimension.
    pub stiffness: f64,
    /// Viscosity coefficient ε, without dimension.
    pub viscosity: f64,
}

impl Control for FlanaganBelytschko {
    const LENGTHS: bool = false;

    /// ΔQ = κ μΔt B:B/(4V) q̇, and ε √(2μ M/a) q̇ beside it with a = V/(2 B:B).
    #[inline(always)]
    fn resist<V: Lanes>(&self, rate: &Resistance<V>, q: &mut Resistance<V>, state: &State<V>) -> Resistance<V> {
        let factor = V::splat(0.25 * self.stiffness);
        let stiffness = factor * state.mu * state.stiffness_measure * state.time_step;
        *q = array![i in 3 => array![a in 4 => q[i][a] + stiffness * rate[i][a]]];
        if self.viscosity == 0.0 {
            return *q;
        }
        let viscosity = V::splat(2.0 * self.viscosity) * (state.mu * state.mass * state.stiffness_measure).sqrt();
        array![i in 3 => array![a in 4 => q[i][a] + viscosity * rate[i][a]]]
    }

    /// The whole of it at the default κ = 0.05; κ and ε count alike.
    fn of_fluids(&self) -> f64 {
        ((self.stiffness + self.viscosity) / USUAL_STIFFNESS).min(1.0)
    }

    /// k |γ|² = 8 κμB:B/(4V)
    #[inline(always)]
    fn further_modulus<V: Lanes>(&self, mu: V) -> V {
        V::splat(2.0 * self.stiffness) * mu
    }

    /// A mode has stiffness k = κμB:B/(4V), damping c and mass M/64 per unit of its rate; with the damping force
    /// one half step behind, it is stable below 2/(√(ω² + ζ²) + ζ), ζ = c/2m.
    ///
    /// In a parallelepiped strain and hourglass modes are orthogonal, and any κ ≤ ⅔ leaves the element's own step
    /// as it is. In warped ones their stiffnesses add up, and the modes weigh up to half as much again; that is
    /// only taken into account where it matters, for coefficients above those in use.
    #[inline(always)]
    fn stable_step<V: Lanes>(&self, without: V, stiffness_measure: V, mass: V, mu: V) -> V {
        if self.viscosity == 0.0 && self.stiffness <= LARGEST_USUAL_STIFFNESS {
            return without;
        }
        let scale = V::splat(64.0) / mass;
        let mut omega2 = V::splat(0.25 * self.stiffness) * mu * stiffness_measure * scale;
        if self.stiffness > LARGEST_USUAL_STIFFNESS {
            omega2 = omega2 * V::splat(1.5) + V::splat(4.0) / (without * without);
        }
        let zeta = V::splat(self.viscosity) * (mu * mass * stiffness_measure).sqrt() * scale;
        let limit = V::splat(2.0) / ((omega2 + zeta * zeta).sqrt() + zeta);
        // In this order a NaN of the element's own step, its sign of failure, stays one.
        V::select_less(limit, without, limit, without)
    }
}

/// The stiffness coefficient of a deck that gives none.
const USUAL_STIFFNESS: f64 = 0.05;

/// Stiffness coefficients up to here have next to no influence on the stable step.
const LARGEST_USUAL_STIFFNESS: f64 = 0.15;

/// Belytschko and Bindeman (1993): stiffness from an assumed strain field that is free of locking.
#[derive(Debug, Clone, Copy)]
pub struct AssumedStrain {
    /// Factor on the stiffness; 1 is the theory.
    pub factor: f64,
}

impl Control for AssumedStrain {
    const LENGTHS: bool = true;

    #[inline(always)]
    fn resist<V: Lanes>(&self, rate: &Resistance<V>, q: &mut Resistance<V>, state: &State<V>) -> Resistance<V> {
        let [l1, l2, l3] = state.lengths;
        let nu = state.poisson;
        let one = V::splat(1.0);
        // H_ii = L_j L_k / (3 L_i), H_ij = L_k / 3.
        let areas = [l2 * l3, l3 * l1, l1 * l2];
        let third = V::splat(1.0 / 3.0);
        let scale = third / (l1 * areas[0]);
        let diagonal = [areas[0] * areas[0] * scale, areas[1] * areas[1] * scale, areas[2] * areas[2] * scale];
        let mixed = [l1 * third, l2 * third, l3 * third];
        // Both base vectors of ±1 stand for 1/8 of themselves in the theory.
        let mu = state.mu * state.time_step * V::splat(self.factor / 64.0);
        let bending = (mu + mu) / (one - nu);
        let torsion = mu * (one + nu) * V::splat(2.0 / 3.0);
        let kept = state.returned;
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let warping = (diagonal[j] + diagonal[k]) * rate[i][i] + mixed[k] * rate[j][j] + mixed[j] * rate[k][k];
            q[i][i] = (q[i][i] + mu * warping) * kept;
            q[i][j] = (q[i][j] + bending * (diagonal[i] * rate[i][j] + nu * mixed[k] * rate[j][i])) * kept;
            q[i][k] = (q[i][k] + bending * (diagonal[i] * rate[i][k] + nu * mixed[j] * rate[k][i])) * kept;
            q[i][3] = (q[i][3] + torsion * diagonal[i] * rate[i][3]) * kept;
        }
        *q
    }

    #[inline(always)]
    fn kept<V: Lanes>(&self, state: &State<V>) -> V {
        state.returned
    }

    fn of_fluids(&self) -> f64 {
        self.factor.min(1.0)
    }

    /// None: the stiffness is bounded to what it is just below the bound, where the floor under [`State::lengths`] suffices.
    #[inline(always)]
    fn further_modulus<V: Lanes>(&self, _mu: V) -> V {
        V::splat(0.0)
    }

    /// On a parallelepiped, whatever ν and however the frame lies, the floor under [`State::lengths`] keeps the
    /// stiffness below the one that the element's own step allows for; a factor above 1 is paid for in the step.
    #[inline(always)]
    fn stable_step<V: Lanes>(&self, without: V, _stiffness_measure: V, _mass: V, _mu: V) -> V {
        if self.factor > 1.0 {
            return without / V::splat(self.factor).sqrt();
        }
        without
    }
}

/// Either control, chosen at run time: for laws that are not worth a kernel of each.
#[derive(Debug, Clone, Copy)]
pub enum Either {
    /// The stiffness and viscosity of Flanagan and Belytschko.
    FlanaganBelytschko(FlanaganBelytschko),
    /// Assumed strain.
    AssumedStrain(AssumedStrain),
}

impl Control for Either {
    const LENGTHS: bool = true;

    #[inline(always)]
    fn resist<V: Lanes>(&self, rate: &Resistance<V>, q: &mut Resistance<V>, state: &State<V>) -> Resistance<V> {
        match self {
            Either::FlanaganBelytschko(control) => control.resist(rate, q, state),
            Either::AssumedStrain(control) => control.resist(rate, q, state),
        }
    }

    #[inline(always)]
    fn kept<V: Lanes>(&self, state: &State<V>) -> V {
        match self {
            Either::FlanaganBelytschko(control) => control.kept(state),
            Either::AssumedStrain(control) => control.kept(state),
        }
    }

    fn of_fluids(&self) -> f64 {
        match self {
            Either::FlanaganBelytschko(control) => control.of_fluids(),
            Either::AssumedStrain(control) => control.of_fluids(),
        }
    }

    #[inline(always)]
    fn further_modulus<V: Lanes>(&self, mu: V) -> V {
        match self {
            Either::FlanaganBelytschko(control) => control.further_modulus(mu),
            Either::AssumedStrain(control) => control.further_modulus(mu),
        }
    }

    #[inline(always)]
    fn stable_step<V: Lanes>(&self, without: V, stiffness_measure: V, mass: V, mu: V) -> V {
        match self {
            Either::FlanaganBelytschko(control) => control.stable_step(without, stiffness_measure, mass, mu),
            Either::AssumedStrain(control) => control.stable_step(without, stiffness_measure, mass, mu),
        }
    }
}
