//! What keeps plane meshes of fluids untangled: the hourglass mode is slowed, and corners that are about to turn inside out are held.
//! As in the hexahedron, with areas for volumes.

use super::sections::Corners;
use crate::lanes::{Lanes, Row, array};
use crate::solver::elements::fluid::{Brake, SLOWED, any_close};

/// Q = α (M/16) q̇/Δt, in space: the mode weighs M/16 per unit of its rate, and is slowed by the part α in a stable step Δt of its
/// element, whatever its shape. `mass` is four times that of the lightest corner.
#[inline(always)]
pub fn resistance<V: Lanes>(rates: &[V; 2], factor: f64, mass: V, stable_step: V) -> [V; 2] {
    let viscosity = V::splat(SLOWED * factor / 16.0) * mass / stable_step;
    [viscosity * rates[0], viscosity * rates[1]]
}

/// Σ Q_i q̇_i
#[inline(always)]
pub fn power_of_modes<V: Lanes>(resistance: &[V; 2], rates: &[V; 2]) -> V {
    resistance[0] * rates[0] + resistance[1] * rates[1]
}

/// The Jacobian of a corner, e₁ × e₂ of its two edges: its derivatives by the edges, and its rate.
struct Corner<V> {
    jacobian: V,
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

impl<V: Lanes> Corner<V> {
    #[inline(always)]
    fn of(x: &[Corners<V>; 2], v: &[Corners<V>; 2], corner: usize) -> Corner<V> {
        let [e1, e2] = edges(x, corner);
        let normals = [[e2[1], -e2[0]], [-e1[1], e1[0]]];
        let [w1, w2] = edges(v, corner);
        Corner { jacobian: dot(&e1, &normals[0]), normals, rate: dot(&normals[0], &w1) + dot(&normals[1], &w2) }
    }

    #[inline(always)]
    fn jacobian_of(x: &[Corners<V>; 2], corner: usize) -> V {
        let [e1, e2] = edges(x, corner);
        e1[0] * e2[1] - e1[1] * e2[0]
    }

    /// Derivative by the position of the corner itself, with its sign turned.
    #[inline(always)]
    fn own(&self) -> [V; 2] {
        [self.normals[0][0] + self.normals[1][0], self.normals[0][1] + self.normals[1][1]]
    }
}

/// Power of the forces Λ on the corners' Jacobians that are kept in `rows`, at a geometry.
#[inline(always)]
pub fn power<V: Lanes>(x: &[Corners<V>; 2], v: &[Corners<V>; 2], rows: &[Row], part: usize) -> V {
    let mut sum = V::splat(0.0);
    // Of corners that were not close there is none.
    if any_close::<V>(&rows[8], part) {
        for corner in 0..4 {
            sum = sum + V::load(&rows[corner], part) * Corner::of(x, v, corner).rate;
        }
    }
    sum
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
/// them. `b_squared` is B_iI B_iI.
#[inline(always)]
pub fn hold<V: Lanes>(
    [x, v]: [&[Corners<V>; 2]; 2],
    rows: &mut [Row],
    part: usize,
    [area, mass, stable_step, b_squared]: [V; 4],
) -> Held<V> {
    let mut held = Held::nothing(stable_step);
    let corners: Corners<V> = array![i in 4 => Corner::jacobian_of(x, i)];
    let least = corners[0].min(corners[1]).min(corners[2].min(corners[3])) / area;
    let before = any_close::<V>(&rows[8], part);
    least.store(&mut rows[8], part);
    if !before && !any_close::<V>(&rows[8], part) {
        return held;
    }
    let mut brake = Brake::new([area, mass * V::splat(0.25), stable_step, b_squared]);
    for corner in 0..4 {
        let c = Corner::of(x, v, corner);
        let own = c.own();
        let reach = dot(&c.normals[0], &c.normals[0]) + dot(&c.normals[1], &c.normals[1]) + dot(&own, &own);
        let force = brake.force(c.jacobian, c.rate, reach);
        force.store(&mut rows[corner], part);
        held.power = held.power + force * c.rate;
        for i in 0..2 {
            held.force[i][corner] = held.force[i][corner] - force * own[i];
            for (k, to) in [(corner + 1) % 4, (corner + 3) % 4].into_iter().enumerate() {
                held.force[i][to] = held.force[i][to] + force * c.normals[k][i];
            }
        }
    }
    held.stable_step = brake.stable_step(stable_step);
    held
}
