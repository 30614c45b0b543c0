//! Bulk viscosity of solid elements, and what it costs the stable step.

use crate::lanes::Lanes;
use crate::model::BulkViscosity;

/// Damping ratio of an element's highest mode, b₁ − b₂² Δt̂ min(0, tr D), without dimension: `bound` is the stable step Δt̂
/// without viscosity, `rate` tr D.
#[inline(always)]
pub fn damping<V: Lanes>(viscosity: BulkViscosity, bound: V, rate: V) -> V {
    let quadratic = V::splat(-viscosity.quadratic * viscosity.quadratic) * bound * rate.min(V::splat(0.0));
    V::splat(viscosity.linear) + quadratic
}

/// The stable step Δt̂ (√(1 + ζ²) − ζ) with a damping ratio ζ.
#[inline(always)]
pub fn damped_step<V: Lanes>(bound: V, damping: V) -> V {
    bound * ((V::splat(1.0) + damping * damping).sqrt() - damping)
}
