//! The largest stable step of a shell, rigorous: a bound on the highest frequency of the element from its own matrix.
//!
//! With R the rates of all strains, hourglass fields and drills, each times the root of its stiffness, for unit velocities of the
//! corners over the root of their masses, ω² is the largest eigenvalue of G = R Rᵀ, 18 × 18. Squared twice, the largest row sum of
//! G⁴ bounds its fourth power from above: 3 to 16 % too much in warped elements. It is found again when an element has changed by
//! a fiftieth, so that it costs next to nothing; in between the step is shortened by as much as the element has changed.

use super::geometry::{Corners, Geometry, Rates};
use crate::material::Moduli;

/// Change of an element, as a strain, from which on its step is found again.
pub const CHANGE: f64 = 0.02;

/// Drill resistance that the step is made for at least: the kernel's own is mostly far below, and grows with the moments.
const DRILL: f64 = 0.1;

/// Number of rates.
const ROWS: usize = 18;

/// What the stiffness of an element is made of.
#[derive(Debug, Clone, Copy)]
pub struct Stiffness {
    /// Elastic constants.
    pub moduli: Moduli,
    /// Factor of the rule through the thickness on the bending stiffness, 1 where it is exact; 0 of a membrane.
    pub bending: f64,
    /// Shear correction, 0 of a membrane.
    pub shear_correction: f64,
}

/// An element whose step is wanted.
#[derive(Debug, Clone, Copy)]
pub struct Body {
    /// Mass.
    pub mass: f64,
    /// Rotary inertia over mass, of each corner.
    pub inertia: f64,
    /// Thickness.
    pub thickness: f64,
    /// Drill resistance now.
    pub drill: f64,
}

/// 2/ω of an element whose corners are at these places; 0 of one without area, thickness or mass.
pub fn stable_step(corners: &Corners<f64>, stiffness: &Stiffness, body: &Body) -> f64 {
    let geometry = Geometry::new(corners);
    let sound = geometry.area > 0.0 && body.thickness > 0.0 && body.mass > 0.0;
    if !sound {
        return 0.0;
    }
    let body = &Body { drill: body.drill.max(DRILL), ..*body };
    let matrix = gram(&columns(&geometry, stiffness, body));
    let scale = (0..ROWS).map(|i| matrix[i][i]).sum::<f64>();
    if !(scale > 0.0 && scale.is_finite()) {
        return 0.0;
    }
    let unit = matrix.map(|row| row.map(|entry| entry / scale));
    let fourth = square(&square(&unit));
    let norm = fourth.iter().map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>()).fold(0.0, f64::max);
    2.0 / (scale * norm.sqrt().sqrt()).sqrt()
}

/// Columns of R.
fn columns(geometry: &Geometry<f64>, stiffness: &Stiffness, body: &Body) -> [[f64; ROWS]; 24] {
    let corner_mass = 0.25 * body.mass;
    let over = [1.0 / corner_mass.sqrt(), 1.0 / (corner_mass * body.inertia).sqrt()];
    let mut columns = [[0.0; ROWS]; 24];
    for (place, column) in columns.iter_mut().enumerate() {
        let (kind, corner, axis) = (place / 12, place % 12 / 3, place % 3);
        let mut fields = [[[0.0; 3]; 4]; 2];
        fields[kind][corner][axis] = over[kind];
        *column = weighted(&geometry.rates(&fields[0], &fields[1]), geometry, stiffness, body);
    }
    columns
}

/// Rates times the roots of their stiffnesses.
fn weighted(rates: &Rates<f64>, geometry: &Geometry<f64>, stiffness: &Stiffness, body: &Body) -> [f64; ROWS] {
    let (mu, nu) = (0.5 * stiffness.moduli.two_mu, stiffness.moduli.poisson());
    let young = 2.0 * mu * (1.0 + nu);
    let volume = geometry.area * body.thickness;
    let bending = stiffness.bending * body.thickness * body.thickness / 12.0;
    let ([h11, h22, h12], gradients) = geometry.hourglass_metric();
    // Cholesky's factor of the hourglass matrix [H₁₁, −ν H₁₂; −ν H₁₂, H₂₂].
    let first = h11.sqrt();
    let (mixed, second) = (-nu * h12 / first, (h22 - nu * nu * h12 * h12 / h11).max(0.0).sqrt());
    let plane = |[xx, yy, xy]: [f64; 3], volume: f64| {
        let (sum, difference) = ((xx + yy) / 2f64.sqrt(), (xx - yy) / 2f64.sqrt());
        let roots = [volume * young / (1.0 - nu), volume * 2.0 * mu, volume * mu].map(f64::sqrt);
        [roots[0] * sum, roots[1] * difference, 2.0 * roots[2] * xy]
    };
    let modes = |[a, b]: [f64; 2], factor: f64| {
        let root = (young * body.thickness * factor).sqrt();
        [root * (first * a + mixed * b), root * second * b]
    };
    let [m1, m2, m3] = plane(rates.strain, volume);
    let [b1, b2, b3] = plane(rates.curvature, volume * bending);
    let [h1, h2] = modes(rates.membrane, 1.0);
    let [h3, h4] = modes(rates.bending, bending);
    let shear = stiffness.shear_correction * mu;
    let [s1, s2] = rates.shear.map(|rate| (shear * volume).sqrt() * rate);
    let t1 = (shear * body.thickness * gradients[0]).sqrt() * rates.twist[0];
    let t2 = (shear * body.thickness * gradients[1]).sqrt() * rates.twist[1];
    let drill = (body.drill * mu * 0.25 * volume).sqrt();
    let [d1, d2, d3, d4] = rates.drill.map(|rate| drill * rate);
    [m1, m2, m3, b1, b2, b3, s1, s2, h1, h2, h3, h4, t1, t2, d1, d2, d3, d4]
}

fn gram(columns: &[[f64; ROWS]; 24]) -> [[f64; ROWS]; ROWS] {
    let mut matrix = [[0.0; ROWS]; ROWS];
    for column in columns {
        for (row, a) in matrix.iter_mut().zip(column) {
            row.iter_mut().zip(column).for_each(|(entry, b)| *entry += a * b);
        }
    }
    matrix
}

fn square(a: &[[f64; ROWS]; ROWS]) -> [[f64; ROWS]; ROWS] {
    let mut square = [[0.0; ROWS]; ROWS];
    for (row, left) in square.iter_mut().zip(a) {
        for (factor, right) in left.iter().zip(a) {
            row.iter_mut().zip(right).for_each(|(entry, b)| *entry += factor * b);
        }
    }
    square
}

/// What the tests make the exact frequencies from.
#[cfg(test)]
pub fn weighted_for_tests(
    geometry: &Geometry<f64>,
    fields: &[Corners<f64>; 2],
    stiffness: &Stiffness,
    body: &Body,
) -> Vec<f64> {
    weighted(&geometry.rates(&fields[0], &fields[1]), geometry, stiffness, body).to_vec()
}
