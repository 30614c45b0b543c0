//! Objective kinematics: the incremental polar decomposition of Flanagan and Taylor (1987), arranged so that it
//! does not drift.
//!
//! Each element carries a frame that turns with its material, a unit quaternion q, and its right stretch U seen in
//! that frame. With l the velocity gradient in the frame, d and w its symmetric part and axial vector, and
//! z = axial(U d):
//!
//! ```text
//! ω = w − (tr(U) I − U)⁻¹ z            rate at which the frame turns
//! q ← q ⊗ (1, ½Δt ω) / |…|             Cayley's exact rotation for any angle below π
//! U ← sym(U + Δt l̃ (U + ½Δt l̃ U)),  l̃ = l − skew(ω)
//! ```
//!
//! This is the update of V = R U Rᵀ of the paper, but kept in the turning frame: in a rigid rotation l̃ vanishes
//! and U does not change at all, whatever the angle. Stress, back stress and hourglass forces live in the same
//! frame. The frame starts along the element's own axes, so that hourglass modes mean bending and torsion.

use crate::lanes::{Lanes, Matrix3, Sym3, array, multiply, multiply_transposed};

/// What the material and the hourglass control need to know of a step's motion.
pub struct Motion<V> {
    /// Strain increment Δt d in the frame, at mid-step.
    pub strain: Sym3<V>,
    /// Columns are the frame's axes at the end of the step.
    pub frame: Matrix3<V>,
    /// The same half way through it: the mean of start and end, orthogonal up to the square of the angle.
    pub middle: Matrix3<V>,
}

/// Rotation matrix of a unit quaternion `[w, x, y, z]`.
#[inline(always)]
pub fn rotation_matrix<V: Lanes>(q: &[V; 4]) -> Matrix3<V> {
    let one = V::splat(1.0);
    let (x2, y2, z2) = (q[1] + q[1], q[2] + q[2], q[3] + q[3]);
    let (wx, wy, wz) = (q[0] * x2, q[0] * y2, q[0] * z2);
    let (xx, xy, xz) = (q[1] * x2, q[1] * y2, q[1] * z2);
    let (yy, yz, zz) = (q[2] * y2, q[2] * z2, q[3] * z2);
    [[one - (yy + zz), xy - wz, xz + wy], [xy + wz, one - (xx + zz), yz - wx], [xz - wy, yz + wx, one - (xx + yy)]]
}

/// q ⊗ (1, t), normalised.
#[inline(always)]
fn turn<V: Lanes>(q: &[V; 4], t: &[V; 3]) -> [V; 4] {
    let w = q[0] - (q[1] * t[0] + q[2] * t[1] + q[3] * t[2]);
    let x = q[1] + (q[0] * t[0] + (q[2] * t[2] - q[3] * t[1]));
    let y = q[2] + (q[0] * t[1] + (q[3] * t[0] - q[1] * t[2]));
    let z = q[3] + (q[0] * t[2] + (q[1] * t[1] - q[2] * t[0]));
    let scale = V::splat(1.0) / ((w * w + x * x) + (y * y + z * z)).sqrt();
    [w * scale, x * scale, y * scale, z * scale]
}

/// q ⊗ (1, t)/|(1, t)| − q, without the cancellation, and with a pull towards the length of one.
#[inline(always)]
fn turn_by<V: Lanes>(q: &[V; 4], t: &[V; 3]) -> [V; 4] {
    let one = V::splat(1.0);
    let across = [
        -(q[1] * t[0] + q[2] * t[1] + q[3] * t[2]),
        q[0] * t[0] + (q[2] * t[2] - q[3] * t[1]),
        q[0] * t[1] + (q[3] * t[0] - q[1] * t[2]),
        q[0] * t[2] + (q[1] * t[1] - q[2] * t[0]),
    ];
    let square = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
    let root = (one + square).sqrt();
    let scale = one / root;
    let excess = ((q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3])) - one;
    let shrink = square * scale / (root + one) + excess * V::splat(0.5);
    array![i in 4 => across[i] * scale - q[i] * shrink]
}

/// (tr(U) I − U)⁻¹ z by cofactors. The matrix is singular only when two principal stretches sum to zero, which
/// an element that has not inverted cannot reach.
#[inline(always)]
fn spin_correction<V: Lanes>(u: &Sym3<V>, z: &[V; 3]) -> [V; 3] {
    let (a, b, c) = (u.yy + u.zz, u.xx + u.zz, u.xx + u.yy);
    let (d, e, f) = (-u.xy, -u.yz, -u.zx);
    let (c00, c01, c02) = (b * c - e * e, e * f - d * c, d * e - b * f);
    let (c11, c12, c22) = (a * c - f * f, d * f - a * e, a * b - d * d);
    let inverse = V::splat(1.0) / (a * c00 + d * c01 + f * c02);
    [
        (c00 * z[0] + c01 * z[1] + c02 * z[2]) * inverse,
        (c01 * z[0] + c11 * z[1] + c12 * z[2]) * inverse,
        (c02 * z[0] + c12 * z[1] + c22 * z[2]) * inverse,
    ]
}

/// Carries frame and stretch over one step Δt with the mid-step velocity gradient `velocity_gradient[i][j]` =
/// ∂v_i/∂x_j, and returns the strain increment in the frame.
///
/// The spin takes the stretch at the start of the step, and its error falls with the step. With `MIDDLE` a first try finds the
/// stretch in the middle, from which the spin is taken anew: the error falls with the square of the step.
#[inline(always)]
pub fn advance<V: Lanes, const MIDDLE: bool>(
    velocity_gradient: &Matrix3<V>,
    frame: &mut [V; 4],
    stretch: &mut Sym3<V>,
    time_step: V,
) -> Motion<V> {
    let old = rotation_matrix(frame);
    let Increment { strain, half_turn, correction } =
        increment::<V, MIDDLE>(velocity_gradient, &old, stretch, time_step);
    *frame = turn(frame, &half_turn);
    *stretch = advance_stretch(stretch, &strain, &correction);
    motion(strain, &old, frame)
}

/// The same for a frame and a stretch that are sums of small parts and keep what their last digits cannot hold: what is to be
/// added to both.
#[inline(always)]
pub fn parts<V: Lanes>(
    velocity_gradient: &Matrix3<V>,
    frame: &[V; 4],
    stretch: &Sym3<V>,
    time_step: V,
) -> (Sym3<V>, [V; 4], Sym3<V>) {
    let old = rotation_matrix(frame);
    let Increment { strain, half_turn, correction } =
        increment::<V, false>(velocity_gradient, &old, stretch, time_step);
    (strain, turn_by(frame, &half_turn), stretch_increment(stretch, &strain, &correction))
}

/// The motion of a step whose strain increment, frame at the start and quaternion at the end are known.
#[inline(always)]
pub fn motion<V: Lanes>(strain: Sym3<V>, old: &Matrix3<V>, frame: &[V; 4]) -> Motion<V> {
    let new = rotation_matrix(frame);
    let middle = array![i in 3 => array![j in 3 => (old[i][j] + new[i][j]) * V::splat(0.5)]];
    Motion { strain, frame: new, middle }
}

/// What a step does to a frame and a stretch.
struct Increment<V> {
    strain: Sym3<V>,
    half_turn: [V; 3],
    correction: [V; 3],
}

#[inline(always)]
fn increment<V: Lanes, const MIDDLE: bool>(
    velocity_gradient: &Matrix3<V>,
    old: &Matrix3<V>,
    stretch: &Sym3<V>,
    time_step: V,
) -> Increment<V> {
    let half = V::splat(0.5);
    // l Δt seen in the frame at the start of the step.
    let l = multiply_transposed(old, &multiply(velocity_gradient, old));
    let l = array![i in 3 => array![j in 3 => l[i][j] * time_step]];
    let d = Sym3::of(&l);
    let w = [(l[2][1] - l[1][2]) * half, (l[0][2] - l[2][0]) * half, (l[1][0] - l[0][1]) * half];
    let u = *stretch;
    let mut correction = spin_correction(&u, &unsymmetric(&u, &d));
    let mut half_turn = array![i in 3 => (w[i] - correction[i]) * half];
    if MIDDLE {
        let strain = at_half_turn(&d, &half_turn);
        let end = advance_stretch(&u, &strain, &correction);
        let middle = u.zip(end, |a, b| (a + b) * half);
        correction = spin_correction(&middle, &unsymmetric(&middle, &strain));
        // It is seen from the frame turned half-way; w from the one before.
        let t = half_turn;
        let before = [
            correction[0] + (t[1] * correction[2] - t[2] * correction[1]),
            correction[1] + (t[2] * correction[0] - t[0] * correction[2]),
            correction[2] + (t[0] * correction[1] - t[1] * correction[0]),
        ];
        half_turn = array![i in 3 => (w[i] - before[i]) * half];
    }
    Increment { strain: at_half_turn(&d, &half_turn), half_turn, correction }
}

/// axial(U d): the part of U d that is not symmetric.
#[inline(always)]
fn unsymmetric<V: Lanes>(u: &Sym3<V>, d: &Sym3<V>) -> [V; 3] {
    [
        (u.zx * d.xy + u.yz * d.yy + u.zz * d.yz) - (u.xy * d.zx + u.yy * d.yz + u.yz * d.zz),
        (u.xx * d.zx + u.xy * d.yz + u.zx * d.zz) - (u.zx * d.xx + u.yz * d.xy + u.zz * d.zx),
        (u.xy * d.xx + u.yy * d.xy + u.yz * d.zx) - (u.xx * d.xy + u.xy * d.yy + u.zx * d.yz),
    ]
}

/// d seen from the frame turned by half the step's rotation, to second order: d + (d Ω − Ω d)/2. Trace and zero
/// are kept exactly.
#[inline(always)]
fn at_half_turn<V: Lanes>(d: &Sym3<V>, half_turn: &[V; 3]) -> Sym3<V> {
    let [t1, t2, t3] = *half_turn;
    // d Ω for Ω = skew(t): Ω_12 = −t3, Ω_13 = t2, Ω_23 = −t1.
    let xx = d.xy * t3 - d.zx * t2;
    let yy = d.yz * t1 - d.xy * t3;
    let zz = d.zx * t2 - d.yz * t1;
    let xy = (d.yy - d.xx) * t3 + (d.zx * t1 - d.yz * t2);
    let yz = (d.zz - d.yy) * t1 + (d.xy * t2 - d.zx * t3);
    let zx = (d.xx - d.zz) * t2 + (d.yz * t3 - d.xy * t1);
    Sym3 {
        xx: d.xx + (xx + xx),
        yy: d.yy + (yy + yy),
        zz: d.zz + (zz + zz),
        xy: d.xy + xy,
        yz: d.yz + yz,
        zx: d.zx + zx,
    }
}

/// U + sym(l̃ U + ½ l̃ l̃ U) with l̃ = d + skew(c).
#[inline(always)]
fn advance_stretch<V: Lanes>(u: &Sym3<V>, d: &Sym3<V>, c: &[V; 3]) -> Sym3<V> {
    u.zip(stretch_increment(u, d, c), |a, b| a + b)
}

/// sym(l̃ U + ½ l̃ l̃ U) with l̃ = d + skew(c).
#[inline(always)]
fn stretch_increment<V: Lanes>(u: &Sym3<V>, d: &Sym3<V>, c: &[V; 3]) -> Sym3<V> {
    let l = [[d.xx, d.xy - c[2], d.zx + c[1]], [d.xy + c[2], d.yy, d.yz - c[0]], [d.zx - c[1], d.yz + c[0], d.zz]];
    let lu = multiply(&l, &u.matrix());
    let half = V::splat(0.5);
    let m = u.matrix();
    let middle: Matrix3<V> = array![i in 3 => array![j in 3 => m[i][j] + lu[i][j] * half]];
    Sym3::of(&multiply(&l, &middle))
}
