//! How a free body turns in a step.
//!
//! The angular momentum L about the centre, in space, is what a step changes: L ← L + Δt̄ M. The rotation δR over the step
//! Δt is the one by which the momentum of all its points, each going straight from where it is to where it will be, is L:
//!
//! Σ m r × (δR r − r)/Δt = L,   with the unit quaternion (q₀, q) of δR:   2 q₀ I q + 2 q × I q = Δt L.
//!
//! This is what central differences with rigid distances give (SHAKE; Moser and Veselov, "Discrete versions of some
//! classical integrable systems", Commun. Math. Phys. 139, 1991; in quaternions Hairer and Vilmart, "Preprocessed discrete
//! Moser–Veselov algorithm", 2006). Without moments it keeps L and the energy ½ L·I⁻¹L to round-off, for any sequence of
//! steps. In a steady spin ω the angle of such a rotation is arcsin ωΔt, too large by (ωΔt)²/6. So a step that turns far is
//! made of several, each of which keeps both.

use super::shape::Matrix;
use crate::common::vector::{add, cross, dot, scaled, subtract};

/// A unit quaternion, the real part first.
pub type Quaternion = [f64; 4];

/// No rotation.
pub const STRAIGHT: Quaternion = [1.0, 0.0, 0.0, 0.0];

/// M v
pub fn times(m: &Matrix, v: [f64; 3]) -> [f64; 3] {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

/// R M Rᵀ
pub fn turned(r: &Matrix, m: &Matrix) -> Matrix {
    // Rows of R M, then times Rᵀ; made symmetric, as it is but for round-off.
    let columns = [0, 1, 2].map(|j| [m[0][j], m[1][j], m[2][j]]);
    let half = [0, 1, 2].map(|i| columns.map(|column| dot(r[i], column)));
    let full = [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(half[i], r[j])));
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| 0.5 * (full[i][j] + full[j][i])))
}

/// M⁻¹ of a symmetric matrix.
pub fn inverse(m: &Matrix) -> Matrix {
    let [a, b, c] = *m;
    let (x, y, z) = (cross(b, c), cross(c, a), cross(a, b));
    let over = 1.0 / dot(a, x);
    [0, 1, 2].map(|i| scaled([x[i], y[i], z[i]], over))
}

/// x with M x = v.
pub fn solved(m: &Matrix, v: [f64; 3]) -> [f64; 3] {
    let [a, b, c] = [0, 1, 2].map(|j| [m[0][j], m[1][j], m[2][j]]);
    let over = 1.0 / dot(a, cross(b, c));
    [dot(v, cross(b, c)) * over, dot(a, cross(v, c)) * over, dot(a, cross(b, v)) * over]
}

/// The matrix of a unit quaternion.
pub fn matrix([w, x, y, z]: Quaternion) -> Matrix {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// The rotation `first` and then `second`, of length one.
pub fn then([a, b, c, d]: Quaternion, [w, x, y, z]: Quaternion) -> Quaternion {
    // second ⊗ first
    let product = [
        w * a - x * b - y * c - z * d,
        w * b + x * a + y * d - z * c,
        w * c - x * d + y * a + z * b,
        w * d + x * c - y * b + z * a,
    ];
    let length = product.iter().map(|p| p * p).sum::<f64>().sqrt();
    product.map(|p| p / length)
}

/// (δR − 1) r of the rotation of a unit quaternion.
pub fn moved([w, x, y, z]: Quaternion, r: [f64; 3]) -> [f64; 3] {
    let q = [x, y, z];
    let across = scaled(cross(q, r), 2.0);
    add(scaled(across, w), cross(q, across))
}

/// Iterations of Newton's method at most; it settles in four.
const MOST: usize = 20;

/// Angle of one of the rotations that a step is made of, at most; a step has no more than so many.
const FINEST: f64 = 0.0125;
const MOST_PARTS: f64 = 64.0;

/// The rotation over a step Δt of a body with inertia I and angular momentum L, given `impulse` = Δt L.
pub fn rotation(inertia: &Matrix, impulse: [f64; 3]) -> Quaternion {
    let angle = solved(inertia, impulse);
    let parts = (dot(angle, angle).sqrt() / FINEST).ceil().clamp(1.0, MOST_PARTS);
    // Also what is no number: it stays none.
    if parts.partial_cmp(&1.0) != Some(std::cmp::Ordering::Greater) {
        return rotation_of_chords(inertia, impulse);
    }
    let impulse = scaled(impulse, 1.0 / parts);
    let (mut whole, mut now) = (STRAIGHT, *inertia);
    for _ in 0..parts as u32 {
        let part = rotation_of_chords(&now, impulse);
        whole = then(whole, part);
        now = turned(&matrix(part), &now);
    }
    whole
}

/// The rotation by which points that go straight have the angular momentum of `impulse`. Where there is none, from about a right angle
/// on, it is the nearest that was found.
fn rotation_of_chords(inertia: &Matrix, impulse: [f64; 3]) -> Quaternion {
    let mut q = scaled(solved(inertia, impulse), 0.5);
    let mut real = 1.0;
    for _ in 0..MOST {
        let length = dot(q, q);
        if length > 0.5 {
            q = scaled(q, (0.5 / length).sqrt());
        }
        real = (1.0 - dot(q, q)).max(0.5).sqrt();
        let momentum = times(inertia, q);
        let rest = subtract(scaled(impulse, 0.5), add(scaled(momentum, real), cross(q, momentum)));
        // ∂/∂q (q₀ I q + q × I q) = q₀ I − I q qᵀ/q₀ + [q]× I − [I q]×
        let slope = [0, 1, 2].map(|j| {
            let mut e = [0.0; 3];
            e[j] = 1.0;
            let column = times(inertia, e);
            let straight = subtract(scaled(column, real), scaled(momentum, q[j] / real));
            add(straight, subtract(cross(q, column), cross(momentum, e)))
        });
        let rows = [0, 1, 2].map(|i| [slope[0][i], slope[1][i], slope[2][i]]);
        let change = solved(&rows, rest);
        let before = q;
        q = add(q, change);
        if q == before || dot(change, change) <= 1e-34 * dot(q, q) {
            break;
        }
    }
    real = (1.0 - dot(q, q)).max(0.25 * real * real).sqrt();
    [real, q[0], q[1], q[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A body that tumbles keeps its angular momentum by construction, and its energy to round-off, also with steps that change.
    #[test]
    fn a_tumbling_body_keeps_its_energy() {
        let inertia = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
        let momentum = [0.01, 3.0, 0.02];
        let energy = |r: &Matrix| 0.5 * dot(momentum, solved(&turned(r, &inertia), momentum));
        let mut turn = STRAIGHT;
        let first = energy(&matrix(turn));
        let (mut worst, mut flips, mut side) = (0.0f64, 0, 1.0);
        for step in 0..20_000 {
            let dt = if step % 3 == 0 { 0.04 } else { 0.025 };
            let r = matrix(turn);
            let q = rotation_of_chords(&turned(&r, &inertia), scaled(momentum, dt));
            let momentum_of_chords = scaled(
                add(scaled(times(&turned(&r, &inertia), [q[1], q[2], q[3]]), q[0]), {
                    let q = [q[1], q[2], q[3]];
                    cross(q, times(&turned(&r, &inertia), q))
                }),
                2.0 / dt,
            );
            (0..3).for_each(|i| assert!((momentum_of_chords[i] - momentum[i]).abs() < 1e-13));
            turn = then(turn, q);
            worst = worst.max((energy(&matrix(turn)) / first - 1.0).abs());
            // The middle axis turns over and over: Dzhanibekov's flip.
            let along = matrix(turn)[1][1];
            if along * side < -0.5 {
                (flips, side) = (flips + 1, -side);
            }
        }
        // Every 2 K(k)/λ with λ² = (I₃ − I₂)(L² − 2E I₁)/(I₁ I₂ I₃) = 0.125 and k'² = 3.33e-5 (Landau and Lifshitz, Mechanics, §37):
        // 37.0 time units, the first after half of that, in 600.
        assert_eq!(flips, 16);
        assert!(worst < 1e-12, "{worst}");
    }

    #[test]
    fn a_steady_spin_is_that_of_straight_paths() {
        let inertia = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 5.0]];
        let q = rotation_of_chords(&inertia, [0.0, 0.0, 0.5]);
        // I sin θ = Δt L.
        let angle = 2.0 * q[3].asin();
        assert!((angle.sin() - 0.1).abs() < 1e-15, "{angle}");
        // In eight parts it is too large by a sixth of the square of an eightieth.
        let whole = 2.0 * rotation(&inertia, [0.0, 0.0, 0.5])[3].asin();
        assert!((whole / 0.1 - 1.0 - 0.0125 * 0.0125 / 6.0).abs() < 1e-8, "{whole}");
        let r = [1.0, 2.0, 3.0];
        let by_matrix = subtract(times(&matrix(q), r), r);
        (0..3).for_each(|i| assert!((moved(q, r)[i] - by_matrix[i]).abs() < 1e-15));
        let m = [[2.0, 0.3, 0.1], [0.3, 3.0, -0.2], [0.1, -0.2, 4.0]];
        let back = times(&inverse(&m), times(&m, r));
        (0..3).for_each(|i| assert!((back[i] - r[i]).abs() < 1e-14));
    }
}
