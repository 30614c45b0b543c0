//! The largest stable step of a shell, rigorous: a bound on the highest frequency of the element from its own matrix.
//!
//! With R the rates of all strains, hourglass fields and drills, each times the root of its stiffness, for unit velocities
//! of the corners over the root of their masses, ω² is the largest eigenvalue of G = R Rᵀ, 18 × 18 of four corners. Squared
//! twice, the largest row sum of G⁴ bounds its fourth power from above: 3 to 12 % too much in warped elements. It is found
//! again when an element has changed by a fiftieth, so that it costs next to nothing; in between the step is shortened by
//! as much as the element has changed.

use super::facet::{Corners, Facet, Kind, Stiffnesses};
use crate::material::Moduli;

/// Change of an element, as a strain, from which on its step is found again.
pub const CHANGE: f64 = 0.02;

/// Drill resistance that the step is made for at least: the kernel's own is mostly far below, and grows with the moments.
const DRILL: f64 = 0.1;

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

/// 2/ω of an element whose corners are at these places; 0 of one without area, thickness or mass. W is the number of its
/// rates, R and 8 more.
pub fn stable_step<S: Kind<C, R>, const C: usize, const R: usize, const W: usize>(
    corners: &Corners<f64, C>,
    stiffness: &Stiffness,
    body: &Body,
) -> f64 {
    let geometry = S::Facet::<f64>::new(corners, body.thickness);
    let sound = geometry.area() > 0.0 && body.thickness > 0.0 && body.mass > 0.0;
    if !sound {
        return 0.0;
    }
    let body = &Body { drill: body.drill.max(DRILL), ..*body };
    let matrix = gram::<S, C, R, W>(&geometry, stiffness, body);
    let scale = (0..W).map(|i| matrix[i][i]).sum::<f64>();
    if !(scale > 0.0 && scale.is_finite()) {
        return 0.0;
    }
    let unit = matrix.map(|row| row.map(|entry| entry / scale));
    let fourth = square(&square(&unit));
    let norm = fourth.iter().map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>()).fold(0.0, f64::max);
    2.0 / (scale * norm.sqrt().sqrt()).sqrt()
}

/// R Rᵀ.
fn gram<S: Kind<C, R>, const C: usize, const R: usize, const W: usize>(
    geometry: &S::Facet<f64>,
    stiffness: &Stiffness,
    body: &Body,
) -> [[f64; W]; W] {
    let corner_mass = body.mass / C as f64;
    let over = [1.0 / corner_mass.sqrt(), 1.0 / (corner_mass * body.inertia).sqrt()];
    let mut matrix = [[0.0; W]; W];
    for place in 0..6 * C {
        let (kind, corner, axis) = (place / (3 * C), place % (3 * C) / 3, place % 3);
        let mut fields = [[[0.0; 3]; C]; 2];
        fields[kind][corner][axis] = over[kind];
        let column: [f64; W] = weighted::<S, C, R, W>(geometry, &fields, stiffness, body);
        for (i, (row, a)) in matrix.iter_mut().zip(column).enumerate() {
            row[i..].iter_mut().zip(&column[i..]).for_each(|(entry, b)| *entry += a * b);
        }
    }
    mirrored(matrix)
}

/// Rates of fields of velocities and rotations times the roots of their stiffnesses: the sum of their squares is twice the energy.
pub fn weighted<S: Kind<C, R>, const C: usize, const R: usize, const W: usize>(
    geometry: &S::Facet<f64>,
    fields: &[Corners<f64, C>; 2],
    stiffness: &Stiffness,
    body: &Body,
) -> [f64; W] {
    let rates = geometry.rates(&fields[0], &fields[1]);
    let (mu, nu) = (0.5 * stiffness.moduli.two_mu, stiffness.moduli.poisson());
    let young = 2.0 * mu * (1.0 + nu);
    let volume = geometry.area() * body.thickness;
    let bending = stiffness.bending * body.thickness * body.thickness / 12.0;
    let plane = |[xx, yy, xy]: [f64; 3], volume: f64| {
        let (sum, difference) = ((xx + yy) / 2f64.sqrt(), (xx - yy) / 2f64.sqrt());
        let roots = [volume * young / (1.0 - nu), volume * 2.0 * mu, volume * mu].map(f64::sqrt);
        [roots[0] * sum, roots[1] * difference, 2.0 * roots[2] * xy]
    };
    let [m1, m2, m3] = plane(rates.strain, volume);
    let [b1, b2, b3] = plane(rates.curvature, volume * bending);
    let shear = stiffness.shear_correction * mu;
    let [s1, s2] = rates.shear.map(|rate| (shear * volume).sqrt() * geometry.reduced(rate));
    let others = geometry.rooted(
        &rates.resisted,
        &Stiffnesses {
            poisson: nu,
            membrane: young * body.thickness,
            bending: young * body.thickness * bending,
            shear: shear * body.thickness,
            drill: body.drill * mu / C as f64 * volume,
        },
    );
    let mut all = [0.0; W];
    let strains = [m1, m2, m3, b1, b2, b3, s1, s2];
    all.iter_mut().zip(strains.into_iter().chain(others)).for_each(|(place, rate)| *place = rate);
    all
}

/// Of a symmetric matrix, whose square is symmetric to the last bit.
fn square<const W: usize>(a: &[[f64; W]; W]) -> [[f64; W]; W] {
    let mut square = [[0.0; W]; W];
    for (i, (row, left)) in square.iter_mut().zip(a).enumerate() {
        for (factor, right) in left.iter().zip(a) {
            row[i..].iter_mut().zip(&right[i..]).for_each(|(entry, b)| *entry += factor * b);
        }
    }
    mirrored(square)
}

/// What stands above the diagonal, below it too.
fn mirrored<const W: usize>(mut matrix: [[f64; W]; W]) -> [[f64; W]; W] {
    for i in 1..W {
        for j in 0..i {
            matrix[i][j] = matrix[j][i];
        }
    }
    matrix
}
