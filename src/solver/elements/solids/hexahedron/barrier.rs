//! A barrier against elements of no volume, in laws whose stress follows the strain alone.
//!
//! Such a law gives the finite energy of about K V₀ to an element that is pressed to nothing. So a potential of the volume
//! V alone, without bound, joins the mean stress where little of the initial volume V₀ is left:
//!
//! ```text
//! φ = k (λ + 2μ) V₀ f(u),  u = V/(s V₀) < 1,  f = 1/3u − 1 + u − u²/3
//! ```
//!
//! f, f′ and f″ vanish at u = 1. Its force on the corners is φ′ B, B = ∂V/∂x: exactly the gradient of φ, whatever the shape.

use super::geometry::{Gradient, Modes, dot, earlier, gradient};
use crate::lanes::{Lanes, array};
use crate::solver::elements::solids::exact::Steps;

/// s: the barrier begins where this part of the volume is left.
const START: f64 = 0.15;

/// k: its strength, in moduli λ + 2μ.
const STRENGTH: f64 = 0.25;

/// Elements with less than this part of their volume at either end of the step are looked at.
const NEAR: f64 = 2.0 * START;

/// They may lose this part of their volume in a step, and grow by what undoes it: 1/(1 − 0.4) − 1. Work by the trapezoidal
/// rule of so long a step is 13 % above that of the potential, as much of one that opens as of one that closes.
const LARGEST_CLOSING: f64 = 0.4;
const LARGEST_OPENING: f64 = 1.0 / (1.0 - LARGEST_CLOSING) - 1.0;

/// So do elements of any volume that lose this part of it in a step of their own: that of a mesh may be some times as long.
const FAST: f64 = 0.1;

/// What the barrier does to elements of which some are pressed together.
pub struct Barrier<V> {
    /// Mean stress that it adds, force/length².
    pub stress: V,
    /// What it has taken from the motion in the step; nothing of elements that are not near it, whatever others of the chunk are.
    pub work: V,
    /// A bound of its stiffness, force/length.
    pub stiffness: V,
    /// The step in which the volume changes by no more than it may.
    pub motion_step: V,
}

/// Whether any element was or is pressed together so much, given 192 times its volume in the middle and at the end of the
/// step, and at the start of all.
#[inline(always)]
pub fn any_near<V: Lanes>(volumes192: [V; 2], initial192: V) -> bool {
    V::any_less(least(volumes192), V::splat(NEAR) * initial192)
}

/// Whether any element closes so fast that its next step is to be bounded, given the part of its volume by which it grows
/// in a step of its own.
#[inline(always)]
pub fn any_fast<V: Lanes>(growth: V) -> bool {
    V::any_less(growth, V::splat(-FAST))
}

/// The volume at the end of a step, or about that at its start where this is less: no more than that where volume grows
/// ever faster, as that of a body that is set free does.
#[inline(always)]
fn least<V: Lanes>([middle, end]: [V; 2]) -> V {
    end.min(middle + middle - end)
}

/// f′ and f″.
#[inline(always)]
fn slopes<V: Lanes>(u: V) -> [V; 2] {
    let (one, part) = (V::splat(1.0), V::splat(2.0 / 3.0));
    let inverse = one / u;
    let square = inverse * inverse;
    let first = (one - part * u) - square * V::splat(1.0 / 3.0);
    // A stress to which −0 is added keeps its bits.
    let [nothing, zero] = [V::splat(-0.0), V::splat(0.0)];
    [V::select_less(u, one, first, nothing), V::select_less(u, one, part * (square * inverse - one), zero)]
}

/// φ′, a mean stress, and φ″ V, a modulus: both of a volume, given 192 V and 192 V₀.
#[inline(always)]
pub fn stress_and_modulus<V: Lanes>(volume192: V, initial192: V, dilatational: V) -> [V; 2] {
    let u = volume192 / (initial192 * V::splat(START));
    let [first, second] = slopes(u);
    let scale = dilatational * V::splat(STRENGTH / START);
    [scale * first, scale * second * u]
}

/// The stiffness of the barrier: φ″ V, a modulus along B, and |φ′| times the largest eigenvalue that ∂B/∂x can have, in all
/// directions.
#[inline(always)]
pub fn stiffness<V: Lanes>(x: &[Modes<V>; 3], operator: &Gradient<V>, initial192: V, dilatational: V) -> [V; 2] {
    let [stress, modulus] = stress_and_modulus(operator.volume192, initial192, dilatational);
    [modulus, (V::splat(0.0) - stress) * largest_curvature(x)]
}

/// Positions and motion of elements, and what they are made of.
pub struct Solid<'a, V> {
    /// Modes of positions and velocities.
    pub motion: [&'a [Modes<V>; 3]; 2],
    /// The operator at these positions.
    pub operator: &'a Gradient<V>,
    /// 192 times the volume in the middle of the step.
    pub middle_volume192: V,
    /// Part of the volume by which it grows in a step of its own.
    pub growth: V,
    /// B:B at these positions.
    pub square4608: V,
    /// 192 times the volume at the start.
    pub initial192: V,
    /// λ + 2μ
    pub dilatational: V,
}

impl<V: Lanes> Solid<'_, V> {
    /// What the barrier does to the elements after this step.
    #[inline(always)]
    pub fn held(&self, steps: Steps) -> Barrier<V> {
        let Solid { motion: [x, v], operator, middle_volume192, growth: fast, square4608, initial192, dilatational } =
            *self;
        let before = earlier([x, v], V::splat(steps.time_step));
        let operator_before = gradient(&before);
        let [then, _] = stress_and_modulus(operator_before.volume192, initial192, dilatational);
        let [stress, _] = stress_and_modulus(operator.volume192, initial192, dilatational);
        let [along, all] = stiffness(x, operator, initial192, dilatational);
        let rates = [growth(v, &operator_before), growth(v, operator)];
        let work = V::splat(0.5 * steps.kick) * then * rates[0] + V::splat(0.5 * steps.time_step) * stress * rates[1];
        let volume = operator.volume192 * V::splat(1.0 / 192.0);
        let [least, near] = [least([middle_volume192, operator.volume192]), initial192 * V::splat(NEAR)];
        let of_near = |number: V, otherwise: f64| V::select_less(least, near, number, V::splat(otherwise));
        let longest = volume * largest_change(rates[1]);
        Barrier {
            stress,
            work: of_near(work, -0.0),
            stiffness: along * square4608 * V::splat(1.0 / 4608.0) / volume + all,
            motion_step: V::select_less(fast, V::splat(-FAST), longest, of_near(longest, f64::MAX)),
        }
    }
}

/// Time in which a volume of one that grows at this rate does so by no more than it may.
#[inline(always)]
fn largest_change<V: Lanes>(rate: V) -> V {
    let zero = V::splat(0.0);
    let part = V::select_less(zero, rate, V::splat(LARGEST_OPENING), V::splat(LARGEST_CLOSING));
    let size = rate.abs();
    V::select_less(zero, size, part / size, V::splat(f64::MAX))
}

/// Rate at which the volume grows.
#[inline(always)]
fn growth<V: Lanes>(v: &[Modes<V>; 3], operator: &Gradient<V>) -> V {
    let g = &operator.g24;
    ((dot(&v[0], &g[0]) + dot(&v[1], &g[1])) + dot(&v[2], &g[2])) * V::splat(1.0 / 192.0)
}

/// A bound of the largest eigenvalue of ∂B/∂x, √(4/3 Σ m²)/6: 192 V is 3 D(ξ, η, ζ) + D(ξ, ξη, ζξ) + D(η, ηζ, ξη) + D(ζ,
/// ζξ, ηζ), D the determinant of three modes. Each mode m is in four of these at most, counted with their factors, and the
/// squares of modes are eight times those of the corners.
#[inline(always)]
fn largest_curvature<V: Lanes>(x: &[Modes<V>; 3]) -> V {
    let squares = array![i in 3 => square(&x[i])];
    ((squares[0] + squares[1] + squares[2]) * V::splat(4.0 / 3.0)).sqrt() * V::splat(1.0 / 6.0)
}

/// Sum of the squares of the modes that the operator has. A function: see `geometry::square`, which adds in another order.
#[inline(always)]
fn square<V: Lanes>(m: &Modes<V>) -> V {
    ((m[0] * m[0] + m[1] * m[1]) + (m[2] * m[2] + m[3] * m[3])) + (m[4] * m[4] + m[5] * m[5])
}

/// The stable step Δt' of an element that has a further stiffness K: with its own, Δt, damped or not, (4/Δt²) Δt/Δt' + 8K/M
/// ≤ 4/Δt'² is enough.
#[inline(always)]
pub fn shared_step<V: Lanes>(own: V, stiffness: V, mass: V) -> V {
    let one = V::splat(1.0);
    let share = V::splat(8.0) * stiffness / mass * own * own;
    own * (V::splat(2.0) / (one + (one + share).sqrt()))
}
