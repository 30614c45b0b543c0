//! Hourglass resistance of elements that are bent out of all shape: bounded, and passive.
//!
//! The base vectors γ_α = Γ_α − B_j h_jα/V are made orthogonal to linear fields; h are the hourglass modes of the shape itself. Where
//! the mean volume V passes near nothing while h stays large, γ goes with 1/V, and so does the frequency of the modes:
//! the stable step, which takes strain and hourglass stiffness for orthogonal, is no bound there. So the stiffness k is multiplied by
//!
//! ```text
//! c = min(1, τ₀/τ),  τ = Σ_α |γ_α|²/8        (4 of a parallelepiped)
//! ```
//!
//! which bounds k|γ|². A resistance Q that is stored holds the energy Q²/2k. Where k falls Q would give back more than it
//! has taken; it is scaled by √(k/k_old) then, so that this energy does not grow: the rest is lost in the account of
//! hourglass resistance. The stiffness is taken to go with c B:B/V, as that of Flanagan and Belytschko does. That of
//! assumed strain goes with c and the lengths; to count c alone for it, tried, is nearer to passive on random paths, but
//! worse in scenes (docs/decisions.md).

use super::super::barrier::shared_step;
use super::super::geometry::{Gradient, HOURGLASS, Modes, earlier, gradient, square};
use super::Control;
use crate::lanes::{Lanes, array};

/// τ₀: elements of ordinary meshes have less, also thin and warped ones.
const LARGEST: f64 = 16.0;

/// A quick look: S = 3 Σ_j |B_j|² |h_j|²/V², in the measure of [`Gradient`], is below this in all but a few elements. Then
/// τ ≤ 4 + 2√3 √S + S < τ₀.
const QUICK: f64 = 4.5;

/// What holds for the hourglass resistance of elements of which some are bent out of all shape.
pub struct Bounded<V> {
    /// Factor c on the stiffness, 1 of the others.
    pub factor: V,
    /// Factor on the resistance stored at the start of the step, 1 of the others.
    pub kept: V,
    /// cτ where τ > τ₀, else 0: Σ|γ|²/8 as far as it is resisted.
    pub weight: V,
}

impl<V: Lanes> Bounded<V> {
    /// The stable step with hourglass control, given the one without, the measure B:B/V of stiffness, the mass and μ.
    #[inline(always)]
    pub fn stable_step<H: Control>(&self, control: &H, without: V, [measure, mass, mu]: [V; 3]) -> V {
        let zero = V::splat(0.0);
        let times = self.weight;
        // Frequency and damping of a viscosity both go with the square of the base vectors.
        let felt = V::select_less(zero, self.weight, mu * times * times, mu);
        let step = control.stable_step(without, measure, mass, felt);
        shared_step(step, control.further_modulus(mu) * measure * times, mass)
    }
}

/// Whether any element has to be looked at.
#[inline(always)]
pub fn any<V: Lanes>(x: &[Modes<V>; 3], operator: &Gradient<V>) -> bool {
    let mut sum = V::splat(0.0);
    for (x, g) in x.iter().zip(&operator.g24) {
        sum = sum + square(g) * ((x[3] * x[3] + x[4] * x[4]) + (x[5] * x[5] + x[6] * x[6]));
    }
    let volume = operator.volume192;
    V::any_less(V::splat(QUICK / 3.0) * volume * volume, sum)
}

/// τ
#[inline(always)]
pub fn squares<V: Lanes>(x: &[Modes<V>; 3], operator: &Gradient<V>) -> V {
    let inverse = V::splat(1.0) / operator.volume192;
    let g = &operator.g24;
    // The fourth mode itself is no mode of the operator.
    let mut sum = V::splat(1.0);
    for a in 0..4 {
        let h: [V; 3] = array![j in 3 => x[j][HOURGLASS + a] * inverse];
        for k in 0..6 {
            let own = V::splat(if k == HOURGLASS + a { 1.0 } else { 0.0 });
            let left = own - ((g[0][k] * h[0] + g[1][k] * h[1]) + g[2][k] * h[2]);
            sum = sum + left * left;
        }
    }
    sum
}

/// c
#[inline(always)]
pub fn factor<V: Lanes>(tau: V) -> V {
    (V::splat(LARGEST) / tau).min(V::splat(1.0))
}

/// The bound of elements with these positions, which have moved with these velocities; `None` where no τ is above τ₀.
#[inline(always)]
pub fn bounded<V: Lanes>(
    [x, v]: [&[Modes<V>; 3]; 2],
    operator: &Gradient<V>,
    square4608: V,
    time_step: V,
) -> Option<Bounded<V>> {
    let (zero, one, largest) = (V::splat(0.0), V::splat(1.0), V::splat(LARGEST));
    let tau = squares(x, operator);
    if !V::any_less(largest, tau) {
        return None;
    }
    let before = earlier([x, v], time_step);
    let operator_before = gradient(&before);
    let tau_before = squares(&before, &operator_before);
    let [factor, factor_before] = [factor(tau), factor(tau_before)];
    // Stiffness goes with c B:B/V.
    let now = factor * square4608 / operator.volume192;
    let then = factor_before * operator_before.square4608() / operator_before.volume192;
    let kept = (now / then).min(one).max(zero).sqrt();
    Some(Bounded {
        factor,
        kept: V::select_less(largest, tau, kept, one),
        weight: V::select_less(largest, tau, factor * tau, zero),
    })
}
