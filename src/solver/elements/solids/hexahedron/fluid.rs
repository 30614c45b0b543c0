//! What keeps meshes of fluids untangled: hourglass modes are slowed, and corners that are about to turn inside out are held.
//!
//! Both take their size from mass and stable step alone, not from a modulus: a cold gas has none, and no shape is special.

use super::geometry::Corners;
use super::hourglass::Resistance;
use crate::lanes::{Lanes, array};
use crate::mesh::corners::NEIGHBOURS;
use crate::solver::elements::solids::fluid::{Brake, SLOWED, affordable, any_close};

/// Q = α (M/64) q̇/Δt, in space: a mode weighs M/64 per unit of its rate, and is slowed by the part α in a stable step Δt of its
/// element, whatever its shape. The step is that in which its forces act.
#[inline(always)]
pub fn resistance<V: Lanes>(rates: &Resistance<V>, factor: f64, mass: V, acting_step: V) -> Resistance<V> {
    let viscosity = V::splat(SLOWED * factor / 64.0) * mass / acting_step;
    array![i in 3 => array![a in 4 => viscosity * rates[i][a]]]
}

/// Corners of the faces, opposite ones side by side.
const FACES: [[[usize; 4]; 2]; 3] =
    [[[0, 3, 4, 7], [1, 2, 5, 6]], [[0, 1, 4, 5], [3, 2, 7, 6]], [[0, 1, 2, 3], [4, 5, 6, 7]]];

/// Means of what the corners have over the faces, opposite ones side by side.
#[inline(always)]
pub fn across<V: Lanes>(of: &Corners<V>) -> [[V; 2]; 3] {
    array![k in 3 => FACES[k].map(|f| ((of[f[0]] + of[f[1]]) + (of[f[2]] + of[f[3]])) * V::splat(0.25))]
}

/// The Jacobian of a corner, e₁·(e₂ × e₃) of its three edges: its derivatives by the edges, and its rate.
struct Corner<V> {
    jacobian: V,
    areas: [[V; 3]; 3],
    rate: V,
}

#[inline(always)]
fn cross<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn edges<V: Lanes>(x: &[Corners<V>; 3], corner: usize) -> [[V; 3]; 3] {
    let to = &NEIGHBOURS[corner];
    array![k in 3 => array![i in 3 => x[i][to[k]] - x[i][corner]]]
}

impl<V: Lanes> Corner<V> {
    #[inline(always)]
    fn of(x: &[Corners<V>; 3], v: &[Corners<V>; 3], corner: usize) -> Corner<V> {
        let [e1, e2, e3] = edges(x, corner);
        let areas = [cross(&e2, &e3), cross(&e3, &e1), cross(&e1, &e2)];
        let [w1, w2, w3] = edges(v, corner);
        let rate = dot(&areas[0], &w1) + dot(&areas[1], &w2) + dot(&areas[2], &w3);
        Corner { jacobian: dot(&e1, &areas[0]), areas, rate }
    }

    #[inline(always)]
    fn jacobian_of(x: &[Corners<V>; 3], corner: usize) -> V {
        let [e1, e2, e3] = edges(x, corner);
        dot(&e1, &cross(&e2, &e3))
    }

    /// See [`Brake::force`].
    #[inline(always)]
    fn push(&self, brake: &mut Brake<V>) -> [V; 2] {
        let own = self.own();
        let reach = (dot(&self.areas[0], &self.areas[0]) + dot(&self.areas[1], &self.areas[1]))
            + (dot(&self.areas[2], &self.areas[2]) + dot(&own, &own));
        brake.force(self.jacobian, self.rate, reach)
    }

    /// Derivative by the position of the corner itself, with its sign turned.
    #[inline(always)]
    fn own(&self) -> [V; 3] {
        array![i in 3 => self.areas[0][i] + self.areas[1][i] + self.areas[2][i]]
    }
}

/// Power of the forces Λ on the corners' Jacobians that are kept in `rows`, at a geometry.
#[inline(always)]
pub fn power<V: Lanes>(x: &[Corners<V>; 3], v: &[Corners<V>; 3], rows: &[V::Row], part: usize) -> V {
    let mut sum = V::splat(0.0);
    // Of corners that were not close there is none.
    if any_close::<V>(&rows[8], part) {
        for corner in 0..8 {
            sum = sum + V::load(&rows[corner], part) * Corner::of(x, v, corner).rate;
        }
    }
    sum
}

/// What holding the corners of an element means.
pub struct Held<V> {
    /// What is to be added to the corner forces, `[direction][corner]`.
    pub force: [Corners<V>; 3],
    /// Power of these forces, taken from the motion.
    pub power: V,
    /// Largest time step with them.
    pub stable_step: V,
}

/// Finds the forces Λ on the Jacobians of the corners and keeps them in `rows`, with the least Jacobian over the volume after
/// them. `b_squared` is B_iI B_iI, `taken` the energy that hourglass resistance and these forces have taken so far.
#[inline(always)]
pub fn hold<V: Lanes>(
    [x, v]: [&[Corners<V>; 3]; 2],
    rows: &mut [V::Row],
    part: usize,
    [volume, mass, stable_step, last_step, b_squared]: [V; 5],
    taken: V,
) -> Held<V> {
    let zero = V::splat(0.0);
    let mut held = Held { force: [[zero; 8]; 3], power: zero, stable_step };
    let mut least = Corner::jacobian_of(x, 0);
    for corner in 1..8 {
        least = Corner::jacobian_of(x, corner).min(least);
    }
    let least = least / volume;
    let before = any_close::<V>(&rows[8], part);
    least.store(&mut rows[8], part);
    if !before && !any_close::<V>(&rows[8], part) {
        return held;
    }
    let mut brake = Brake::new([volume, mass * V::splat(0.125), stable_step, last_step, b_squared]);
    let corners: [Corner<V>; 8] = array![corner in 8 => Corner::of(x, v, corner)];
    let pushes = array![corner in 8 => corners[corner].push(&mut brake)];
    let given = pushes.iter().fold(zero, |sum, [_, given]| sum + *given);
    let affordable = affordable(taken, given);
    for (corner, c) in corners.iter().enumerate() {
        let [force, given] = pushes[corner];
        let force = V::select_less(zero, given, force * affordable, force);
        force.store(&mut rows[corner], part);
        held.power = held.power + force * c.rate;
        let own = c.own();
        for i in 0..3 {
            held.force[i][corner] = held.force[i][corner] - force * own[i];
            for k in 0..3 {
                let to = NEIGHBOURS[corner][k];
                held.force[i][to] = held.force[i][to] + force * c.areas[k][i];
            }
        }
    }
    held.stable_step = brake.stable_step(stable_step);
    held
}
