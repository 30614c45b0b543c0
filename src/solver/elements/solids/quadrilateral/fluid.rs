//! What keeps plane meshes of fluids untangled: the hourglass mode is slowed, and corners that are about to turn inside out are held.
//! As in the hexahedron, with areas for volumes.

use super::kernel;
use super::sections::Corners;
use crate::lanes::{Lanes, array};
use crate::solver::elements::solids::fluid::{Brake, SLOWED, affordable, any_close};

/// Q = α (M/16) q̇/Δt, in space: the mode weighs M/16 per unit of its rate, and is slowed by the part α in a stable step Δt of its
/// element, whatever its shape. `mass` is four times that of the lightest corner.
#[inline(always)]
pub fn resistance<V: Lanes>(rates: &[V; 2], factor: f64, mass: V, acting_step: V) -> [V; 2] {
    let viscosity = V::splat(SLOWED * factor / 16.0) * mass / acting_step;
    [viscosity * rates[0], viscosity * rates[1]]
}

/// Σ Q_i q̇_i
#[inline(always)]
pub fn power_of_modes<V: Lanes>(resistance: &[V; 2], rates: &[V; 2]) -> V {
    resistance[0] * rates[0] + resistance[1] * rates[1]
}

/// Means of what the corners have over the sides, opposite ones side by side.
#[inline(always)]
pub fn across<V: Lanes>(of: &Corners<V>) -> [[V; 2]; 2] {
    let half = |a: usize, b: usize| (of[a] + of[b]) * V::splat(0.5);
    [[half(0, 3), half(1, 2)], [half(0, 1), half(2, 3)]]
}

/// Of the Jacobian of a corner, e₁ × e₂ of its two edges: the derivatives by the edges, and the rate.
struct Corner<V> {
    normals: [[V; 2]; 2],
    rate: V,
}

#[inline(always)]
fn dot<V: Lanes>(a: &[V; 2], b: &[V; 2]) -> V {
    a[0] * b[0] + a[1] * b[1]
}

/// To the next corner, and to the one before.
#[inline(always)]
fn edges<V: Lanes>(x: &[Corners<V>; 2], corner: usize) -> [[V; 2]; 2] {
    let (next, before) = ((corner + 1) % 4, (corner + 3) % 4);
    [[x[0][next] - x[0][corner], x[1][next] - x[1][corner]], [x[0][before] - x[0][corner], x[1][before] - x[1][corner]]]
}

/// Squared length of the edge from a corner to the next.
#[inline(always)]
fn squared_edge<V: Lanes>(x: &[Corners<V>; 2], corner: usize) -> V {
    let [to_next, _] = edges(x, corner);
    dot(&to_next, &to_next)
}

impl<V: Lanes> Corner<V> {
    #[inline(always)]
    fn of(x: &[Corners<V>; 2], v: &[Corners<V>; 2], corner: usize) -> Corner<V> {
        let [e1, e2] = edges(x, corner);
        let normals = [[e2[1], -e2[0]], [-e1[1], e1[0]]];
        let [w1, w2] = edges(v, corner);
        Corner { normals, rate: dot(&normals[0], &w1) + dot(&normals[1], &w2) }
    }

    #[inline(always)]
    fn jacobian_of(x: &[Corners<V>; 2], corner: usize) -> V {
        let [e1, e2] = edges(x, corner);
        e1[0] * e2[1] - e1[1] * e2[0]
    }

    /// Adds what a force Λ on the Jacobian is at the corners.
    #[inline(always)]
    fn add(&self, force: V, corner: usize, sum: &mut [Corners<V>; 2]) {
        let own = self.own();
        for i in 0..2 {
            sum[i][corner] = sum[i][corner] - force * own[i];
            for (k, to) in [(corner + 1) % 4, (corner + 3) % 4].into_iter().enumerate() {
                sum[i][to] = sum[i][to] + force * self.normals[k][i];
            }
        }
    }

    /// Derivative by the position of the corner itself, with its sign turned.
    #[inline(always)]
    fn own(&self) -> [V; 2] {
        [self.normals[0][0] + self.normals[1][0], self.normals[0][1] + self.normals[1][1]]
    }
}

/// Power of the forces Λ on the corners' Jacobians that are kept in `rows`, at a geometry; `weights` as in [`hold`].
#[inline(always)]
pub fn power<V: Lanes>(
    [x, v]: [&[Corners<V>; 2]; 2],
    rows: &[V::Row],
    part: usize,
    weights: Option<&(Corners<V>, V)>,
) -> V {
    let mut sum = V::splat(0.0);
    // Of corners that were not close there is none.
    if any_close::<V>(&rows[8], part) {
        if let Some((weights, _)) = weights {
            let mut force = [[sum; 4]; 2];
            for corner in 0..4 {
                Corner::of(x, v, corner).add(V::load(&rows[corner], part), corner, &mut force);
            }
            return power_of(&weighted(&force, weights), v);
        }
        for corner in 0..4 {
            sum = sum + V::load(&rows[corner], part) * Corner::of(x, v, corner).rate;
        }
    }
    sum
}

/// Forces of the compatible form: times the corners' weights, and without what they would move along the axis as a whole.
#[inline(always)]
fn weighted<V: Lanes>([along, across]: &[Corners<V>; 2], weights: &Corners<V>) -> [Corners<V>; 2] {
    let times: Corners<V> = array![i in 4 => weights[i] * across[i]];
    let mean =
        ((times[0] + times[1]) + (times[2] + times[3])) / ((weights[0] + weights[1]) + (weights[2] + weights[3]));
    [array![i in 4 => weights[i] * along[i]], array![i in 4 => times[i] - weights[i] * mean]]
}

#[inline(always)]
fn power_of<V: Lanes>(force: &[Corners<V>; 2], v: &[Corners<V>; 2]) -> V {
    kernel::dot(&force[0], &v[0]) + kernel::dot(&force[1], &v[1])
}

/// What holding the corners of an element means.
pub struct Held<V> {
    /// What is to be added to the corner forces, `[direction][corner]`.
    pub force: [Corners<V>; 2],
    /// Power of these forces, taken from the motion.
    pub power: V,
    /// Largest time step with them.
    pub stable_step: V,
}

impl<V: Lanes> Held<V> {
    /// Nothing is held.
    #[inline(always)]
    pub fn nothing(stable_step: V) -> Held<V> {
        let zero = V::splat(0.0);
        Held { force: [[zero; 4]; 2], power: zero, stable_step }
    }
}

/// Finds the forces Λ on the Jacobians of the corners and keeps them in `rows`, with the least Jacobian over the area after
/// them. `b_squared` is B_iI B_iI, `taken` the energy that hourglass resistance and these forces have taken so far.
/// `weights` are those of the compatible form, if it is that.
#[inline(always)]
pub fn hold<V: Lanes>(
    [x, v]: [&[Corners<V>; 2]; 2],
    rows: &mut [V::Row],
    part: usize,
    [area, mass, stable_step, last_step, b_squared]: [V; 5],
    taken: V,
    weights: Option<&(Corners<V>, V)>,
) -> Held<V> {
    let mut held = Held::nothing(stable_step);
    // Two corners of a triangle that are one have no Jacobian, and are not held.
    let edges: Corners<V> = array![i in 4 => squared_edge(x, i)];
    let corners: Corners<V> = array![i in 4 => {
        let shortest = edges[i].min(edges[(i + 3) % 4]);
        V::select_less(V::splat(0.0), shortest, Corner::jacobian_of(x, i), area)
    }];
    let least = corners[0].min(corners[1]).min(corners[2].min(corners[3])) / area;
    let before = any_close::<V>(&rows[8], part);
    least.store(&mut rows[8], part);
    if !before && !any_close::<V>(&rows[8], part) {
        return held;
    }
    let mut brake = Brake::new([area, mass * V::splat(0.25), stable_step, last_step, b_squared]);
    let pushes: [[V; 2]; 4] = array![corner in 4 => {
        let c = Corner::of(x, v, corner);
        let own = c.own();
        let reach = dot(&c.normals[0], &c.normals[0]) + dot(&c.normals[1], &c.normals[1]) + dot(&own, &own);
        brake.force(corners[corner], c.rate, reach)
    }];
    let affordable = affordable(taken, (pushes[0][1] + pushes[1][1]) + (pushes[2][1] + pushes[3][1]));
    for corner in 0..4 {
        let [force, given] = pushes[corner];
        let force = V::select_less(V::splat(0.0), given, force * affordable, force);
        let c = Corner::of(x, v, corner);
        force.store(&mut rows[corner], part);
        held.power = held.power + force * c.rate;
        c.add(force, corner, &mut held.force);
    }
    if let Some((weights, _)) = weights {
        held.force = weighted(&held.force, weights);
        held.power = power_of(&held.force, v);
    }
    held.stable_step = brake.stable_step(stable_step);
    held
}
