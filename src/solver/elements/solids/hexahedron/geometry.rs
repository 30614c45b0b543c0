//! Geometry of the uniform-gradient hexahedron, in the space of its eight modes.
//!
//! The corner values of any quantity are a sum of the modes 1, ξ, η, ζ, ηζ, ζξ, ξη, ξηζ (each ±1 at the corners,
//! mutually orthogonal). Seen there, the mean gradient operator of Flanagan and Belytschko (1981), B_iI = ∂V/∂x_iI,
//! is short: the volume does not depend on the constant and the ξηζ mode, and each of the other six components is a
//! 2 × 2 determinant or two. The hourglass base vectors are modes themselves. Nothing is approximated: the operator is
//! the isoparametric gradient integrated exactly over the element, warped or not.

use crate::lanes::{Lanes, array};

/// One component at the eight corners of an element.
pub type Corners<V> = [V; 8];

/// Modes ξ, η, ζ, ηζ, ζξ, ξη, ξηζ of one component, each the sum of the corner values times the mode's ±1.
pub type Modes<V> = [V; 7];

/// First hourglass mode (ηζ) among [`Modes`].
pub const HOURGLASS: usize = 3;

/// The modes of corner values; the constant mode is left out.
#[inline(always)]
pub fn modes<V: Lanes>(x: &Corners<V>) -> Modes<V> {
    // Opposite corners: odd modes live in their differences, even ones in their sums.
    let (d0, d1, d2, d3) = (x[6] - x[0], x[7] - x[1], x[4] - x[2], x[5] - x[3]);
    let (s0, s1, s2, s3) = (x[6] + x[0], x[7] + x[1], x[4] + x[2], x[5] + x[3]);
    let (dp, dm, ep, em) = (d0 + d1, d0 - d1, d2 + d3, d2 - d3);
    let (sp, sm, tp, tm) = (s0 + s1, s0 - s1, s2 + s3, s2 - s3);
    [dm - em, dp - ep, dp + ep, sp - tp, sm - tm, sm + tm, dm + em]
}

/// Corner values from modes: the transpose of [`modes`].
#[inline(always)]
pub fn corners<V: Lanes>(m: &Modes<V>) -> Corners<V> {
    let (a, b, c, d) = (m[1] + m[2], m[0] + m[6], m[2] - m[1], m[0] - m[6]);
    let (d0, d1, d2, d3) = (a + b, a - b, c - d, c + d);
    let (e, f) = (m[4] + m[5], m[5] - m[4]);
    let (s0, s1, s2, s3) = (m[3] + e, m[3] - e, f - m[3], -(m[3] + f));
    [s0 - d0, s1 - d1, s2 - d2, s3 - d3, s2 + d2, s3 + d3, s0 + d0, s1 + d1]
}

/// Modes of the positions a time ago, at these velocities since.
#[inline(always)]
pub fn earlier<V: Lanes>([x, v]: [&[Modes<V>; 3]; 2], time: V) -> [Modes<V>; 3] {
    array![i in 3 => array![k in 7 => x[i][k] - time * v[i][k]]]
}

/// The mean gradient operator of an element in the space of modes, with the volume.
pub struct Gradient<V> {
    /// 24 Σ_I φ_k(I) B_iI by direction i and mode k: ξ, η, ζ, ηζ, ζξ, ξη. The other two vanish.
    pub g24: [[V; 6]; 3],
    /// 192 times the volume.
    pub volume192: V,
}

/// Gradient operator and volume from the modes of the three coordinates.
#[inline(always)]
pub fn gradient<V: Lanes>(x: &[Modes<V>; 3]) -> Gradient<V> {
    let g24 = [component(&x[1], &x[2]), component(&x[2], &x[0]), component(&x[0], &x[1])];
    let volume192 = dot(&x[0], &g24[0]);
    Gradient { g24, volume192 }
}

/// The x component of the operator from the modes of y and z; the others follow by cyclic exchange.
#[inline(always)]
fn component<V: Lanes>(y: &Modes<V>, z: &Modes<V>) -> [V; 6] {
    let three = V::splat(3.0);
    let det = |a: usize, b: usize| y[a] * z[b] - y[b] * z[a];
    [
        det(1, 2) * three + det(5, 4),
        det(2, 0) * three + det(3, 5),
        det(0, 1) * three + det(4, 3),
        det(2, 4) + det(5, 1),
        det(0, 5) + det(3, 2),
        det(1, 3) + det(4, 0),
    ]
}

/// Σ_k a_k g_k over the six modes that the operator has.
#[inline(always)]
pub fn dot<V: Lanes>(a: &Modes<V>, g: &[V; 6]) -> V {
    (a[0] * g[0] + a[1] * g[1] + a[2] * g[2]) + (a[3] * g[3] + a[4] * g[4] + a[5] * g[5])
}

/// Sum of six squares. A function, not a closure: those are not always inlined, and then know no vector instructions.
#[inline(always)]
pub fn square<V: Lanes>(g: &[V; 6]) -> V {
    (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) + (g[3] * g[3] + g[4] * g[4] + g[5] * g[5])
}

impl<V: Lanes> Gradient<V> {
    /// B_iI B_iI, summed over directions and corners, times 4608.
    #[inline(always)]
    pub fn square4608(&self) -> V {
        square(&self.g24[0]) + square(&self.g24[1]) + square(&self.g24[2])
    }

    /// B_iI by direction i and corner I, as the books have it.
    #[cfg(test)]
    pub fn at_corners(&self) -> [Corners<V>; 3] {
        let scale = V::splat(1.0 / 192.0);
        array![i in 3 => {
            let g = &self.g24[i];
            let b = corners(&[g[0], g[1], g[2], g[3], g[4], g[5], V::splat(0.0)]);
            array![n in 8 => b[n] * scale]
        }]
    }
}
