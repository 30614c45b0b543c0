//! What plastic laws share: radial return to a yield stress that is any function of the plastic strain increment, and
//! the loss of strength of a point that has failed.

use crate::lanes::{Lanes, Sym3, power};

/// Yield stress within one step.
pub(in crate::material) trait Flow<V> {
    /// Yield stress Y(Δ) after an increment Δ of equivalent plastic strain, and its slope dY/dΔ ≥ 0, which may be
    /// infinite at zero. Y must not fall.
    fn stress(&self, increment: V) -> (V, V);
}

/// How a trial stress came back.
pub(in crate::material) struct Returned<V> {
    /// Increment of equivalent plastic strain.
    pub increment: V,
    /// Factor on the trial deviator.
    pub factor: V,
}

/// Part of the trial stress to which the yield condition is fulfilled, in double and in single precision.
const ACCURACY: [f64; 2] = [1e-13, 1e-6];

/// Bound on the iterations: bisection alone would leave 2⁻⁴⁰ of the increment.
const ITERATIONS: usize = 40;

/// Radial return of a trial deviator: the increment Δ that solves q − 3μ Δ = Y(Δ), where q is the von Mises stress of
/// the trial, and 0 where q ≤ Y(0). Newton's method, kept inside a bracket by bisection, since Y may have kinks and
/// infinite slopes. Lanes that are done stay as they are, so that the result of a lane does not depend on its
/// neighbours.
#[inline(always)]
pub(in crate::material) fn radial_return<V: Lanes, F: Flow<V>>(
    deviator: &Sym3<V>,
    three_mu: f64,
    flow: &F,
) -> Returned<V> {
    let (zero, one) = (V::splat(0.0), V::splat(1.0));
    let trial = (V::splat(1.5) * deviator.contract(*deviator)).sqrt();
    let (start, _) = flow.stress(zero);
    if !V::any_less(start, trial) {
        return Returned { increment: zero, factor: one };
    }
    let stiffness = V::splat(three_mu);
    let tolerance = trial * V::either(ACCURACY[0], ACCURACY[1]);
    let over = (trial - start).max(zero);
    let (mut low, mut high) = (zero, over / stiffness);
    let mut x = high;
    for _ in 0..ITERATIONS {
        let (stress, slope) = flow.stress(x);
        let residual = trial - stiffness * x - stress;
        let size = residual.max(-residual);
        // Elastic lanes have nothing over, and are done before they begin.
        let size = V::select_less(zero, over, size, zero);
        if !V::any_less(tolerance, size) {
            break;
        }
        low = V::select_less(zero, residual, x, low);
        high = V::select_less(zero, residual, high, x);
        let newton = x + residual / (stiffness + slope);
        let middle = (low + high) * V::splat(0.5);
        let inside = V::select_less(low, newton, V::select_less(newton, high, newton, middle), middle);
        x = V::select_less(tolerance, size, inside, x);
    }
    let factor = one - stiffness * x / trial.max(V::splat(V::TINY));
    Returned { increment: x, factor: factor.max(zero) }
}

/// Increments of plastic strain are taken for no smaller than this in the power of a rate.
const SMALLEST: f64 = 1e-30;

/// The stress Y (1 + (Δ r)^(1/p)) at which an increment Δ flows and its derivative with respect to Δ, given the stress Y at rest
/// with its slope, force/length², and r, one over the length of the step times the reference rate (Perzyna 1966; Cowper
/// and Symonds 1957).
#[inline(always)]
pub(in crate::material) fn raised_by_rate<V: Lanes>(
    [rest, slope]: [V; 2],
    increment: V,
    rate: V,
    exponent: f64,
) -> (V, V) {
    let (zero, one) = (V::splat(0.0), V::splat(1.0));
    let small = increment.max(V::splat(SMALLEST));
    let over = power(small * rate, 1.0 / exponent);
    let over = V::select_less(zero, increment, over, zero);
    (rest * (one + over), slope * (one + over) + rest * over / (small * V::splat(exponent)))
}

/// Largest eigenvalue of a deviator: 2√(J₂/3) cos θ with cos 3θ = c = (3√3/2) J₃/J₂^(3/2).
///
/// cos θ = ½ + δ solves 4δ³ + 6δ² = 1 + c; Newton's method from a start within a sixth, four times.
#[inline(always)]
pub(in crate::material) fn largest_principal<V: Lanes>(s: &Sym3<V>) -> V {
    let (zero, half) = (V::splat(0.0), V::splat(0.5));
    let tiny = V::splat(V::TINY);
    let radius = (s.contract(*s) * V::splat(0.5 / 3.0)).sqrt();
    let inverse = V::splat(1.0) / radius.max(V::either(1e-150, 1e-30));
    // Components over √(J₂/3), so that no power leaves the range.
    let (xx, yy, zz) = (s.xx * inverse, s.yy * inverse, s.zz * inverse);
    let (xy, yz, zx) = (s.xy * inverse, s.yz * inverse, s.zx * inverse);
    let determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    let sum = (V::splat(1.0) + determinant * half).max(zero).min(V::splat(2.0));
    let mut delta = (sum * V::splat(0.125)).sqrt().max(V::either(1e-100, 1e-18));
    for _ in 0..4 {
        let square = delta * delta;
        let value = V::splat(4.0) * square * delta + V::splat(6.0) * square - sum;
        delta = delta - value / (V::splat(12.0) * (square + delta)).max(tiny);
    }
    (radius + radius) * (half + delta)
}

/// Mean stress of a point that is failing: tension, but not pressure, shrinks from `before` to `after`, the parts of
/// its strength that were and are left.
#[inline(always)]
pub(in crate::material) fn weakened_tension<V: Lanes>(mean: V, before: V, after: V) -> V {
    let share = after / before.max(V::splat(V::TINY));
    V::select_less(V::splat(0.0), mean, mean * share, mean)
}

/// Deviator and mean stress put together again.
#[inline(always)]
pub(in crate::material) fn compose<V: Lanes>(deviator: &Sym3<V>, factor: V, mean: V) -> Sym3<V> {
    Sym3 {
        xx: deviator.xx * factor + mean,
        yy: deviator.yy * factor + mean,
        zz: deviator.zz * factor + mean,
        xy: deviator.xy * factor,
        yz: deviator.yz * factor,
        zx: deviator.zx * factor,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::point::{full, sym};

    #[test]
    fn largest_principal_value_is_that_of_an_eigenvalue_solver() {
        let mut seed = 7u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        let mut cases: Vec<[f64; 6]> = (0..2000).map(|_| [0; 6].map(|_| next())).collect();
        // Double eigenvalues on either side, pure shear, nothing.
        cases.extend([[2.0, -1.0, -1.0, 0.0, 0.0, 0.0], [1.0, 1.0, -2.0, 0.0, 0.0, 0.0], [0.0; 6]]);
        cases.extend([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0], [1e-100, -1e-100, 0.0, 0.0, 1e-100, 0.0]]);
        for case in cases {
            let s = sym(case).deviator();
            let exact = full(s.to_array()).symmetric_eigenvalues().max();
            let size = s.contract(s).sqrt();
            // Near a double eigenvalue a root of 1 + c loses half the digits.
            assert!((largest_principal(&s) - exact).abs() <= 2e-8 * size, "{case:?}");
        }
        let s = sym([3.0, -1.0, 0.4, 0.2, -0.7, 1.1]).deviator();
        let exact = full(s.to_array()).symmetric_eigenvalues().max();
        assert!((largest_principal(&s) - exact).abs() <= 1e-14 * exact);
    }
}
