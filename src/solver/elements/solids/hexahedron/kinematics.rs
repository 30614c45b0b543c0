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
//!
//! With U at the start of the step the error of ω falls with the step. `increment_of_second_order` corrects it to that of the
//! middle, by the same inverse: the error falls with the square of the step.

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

/// (tr(U) I − U)⁻¹ by cofactors. The matrix is singular only when two principal stretches sum to zero, which
/// an element that has not inverted cannot reach.
struct SpinInverse<V> {
    cofactors: Sym3<V>,
    inverse: V,
}

impl<V: Lanes> SpinInverse<V> {
    #[inline(always)]
    fn of(u: &Sym3<V>) -> Self {
        let (a, b, c) = (u.yy + u.zz, u.xx + u.zz, u.xx + u.yy);
        let (d, e, f) = (-u.xy, -u.yz, -u.zx);
        let (c00, c01, c02) = (b * c - e * e, e * f - d * c, d * e - b * f);
        let (c11, c12, c22) = (a * c - f * f, d * f - a * e, a * b - d * d);
        let inverse = V::splat(1.0) / (a * c00 + d * c01 + f * c02);
        SpinInverse { cofactors: Sym3 { xx: c00, yy: c11, zz: c22, xy: c01, yz: c12, zx: c02 }, inverse }
    }

    #[inline(always)]
    fn times(&self, z: &[V; 3]) -> [V; 3] {
        let Sym3 { xx, yy, zz, xy, yz, zx } = self.cofactors;
        [
            (xx * z[0] + xy * z[1] + zx * z[2]) * self.inverse,
            (xy * z[0] + yy * z[1] + yz * z[2]) * self.inverse,
            (zx * z[0] + yz * z[1] + zz * z[2]) * self.inverse,
        ]
    }
}

/// Carries frame and stretch over one step Δt with the mid-step velocity gradient `velocity_gradient[i][j]` =
/// ∂v_i/∂x_j, and returns the strain increment in the frame. `second_order` says of which order the spin is; it is the same for
/// all elements of a pass.
#[inline(always)]
pub fn advance<V: Lanes>(
    velocity_gradient: &Matrix3<V>,
    frame: &mut [V; 4],
    stretch: &mut Sym3<V>,
    time_step: V,
    second_order: bool,
) -> Motion<V> {
    let old = rotation_matrix(frame);
    let Increment { strain, half_turn, growth } = increment(velocity_gradient, &old, stretch, time_step, second_order);
    *frame = turn(frame, &half_turn);
    *stretch = stretch.zip(growth, |a, b| a + b);
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
    second_order: bool,
) -> (Sym3<V>, [V; 4], Sym3<V>) {
    let old = rotation_matrix(frame);
    let Increment { strain, half_turn, growth } = increment(velocity_gradient, &old, stretch, time_step, second_order);
    (strain, turn_by(frame, &half_turn), growth)
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
    /// Strain increment Δt d seen from the frame turned half-way.
    strain: Sym3<V>,
    /// Cayley's vector of the frame's turn, half of the angle for small ones.
    half_turn: [V; 3],
    /// What is to be added to the stretch.
    growth: Sym3<V>,
}

#[inline(always)]
fn increment<V: Lanes>(
    velocity_gradient: &Matrix3<V>,
    old: &Matrix3<V>,
    stretch: &Sym3<V>,
    time_step: V,
    second_order: bool,
) -> Increment<V> {
    // l Δt seen in the frame at the start of the step.
    let l = multiply_transposed(old, &multiply(velocity_gradient, old));
    let l = array![i in 3 => array![j in 3 => l[i][j] * time_step]];
    let d = Sym3::of(&l);
    let half = V::splat(0.5);
    let w = [(l[2][1] - l[1][2]) * half, (l[0][2] - l[2][0]) * half, (l[1][0] - l[0][1]) * half];
    let inverse = SpinInverse::of(stretch);
    let correction = inverse.times(&unsymmetric(stretch, &d));
    let half_turn = array![i in 3 => (w[i] - correction[i]) * half];
    let strain = at_half_turn(&d, &half_turn);
    if second_order {
        cold_path();
        let further = of_second_order(stretch, &inverse, [&d, &strain], [&w, &correction]);
        let half_turn = array![i in 3 => half_turn[i] + further.half_turn[i]];
        return Increment { strain, half_turn, growth: further.growth };
    }
    Increment { strain, half_turn, growth: stretch_increment(stretch, &strain, &correction) }
}

/// Tells the compiler that most runs do not come here: what they need stays in registers, and the choice costs them
/// nothing. Without it their pass over elements has six thousandths more instructions.
#[cold]
#[inline]
fn cold_path() {}

/// What a spin of second order makes of one of first order.
struct Further<V> {
    /// What is to be added to the half turn.
    half_turn: [V; 3],
    /// What is to be added to the stretch.
    growth: Sym3<V>,
}

/// The spin takes the stretch U½ in the middle of the step, found from half of all increments. With the c of the step's start the
/// increment P of the stretch is not symmetric there; what makes it so, δ, is small, so that it may be found with the inverse at the
/// start of the step: no second division is needed.
///
/// ```text
/// h = ½ Δt d,  c = (tr(U) I − U)⁻¹ axial(U h),  U½ = U + (h + skew c) U
/// e = h seen from the frame turned half-way, by ½Δt w − c,  P = (e + skew c) U½
/// δ = −(tr(U) I − U)⁻¹ axial(P),  half turn = ½Δt w − c − δ − ½Δt w × c
/// U ← U + 2 sym(P + skew(δ) U½)
/// ```
///
/// c and δ are seen from the frame turned half-way, w from that at the start: hence the product w × c. Given are `d` = 2h,
/// `strain` = 2e, `w` = Δt w and `c` twice what it is above.
#[inline(always)]
fn of_second_order<V: Lanes>(
    u: &Sym3<V>,
    inverse: &SpinInverse<V>,
    [d, strain]: [&Sym3<V>; 2],
    [w, c]: [&[V; 3]; 2],
) -> Further<V> {
    let (half, quarter) = (V::splat(0.5), V::splat(0.25));
    // Symmetric, as c is what makes it so.
    let growth = Sym3::of(&multiply(&with_skew(d, c), &u.matrix()));
    let middle = half_way(u, &growth).matrix();
    let p = multiply(&with_skew(strain, c), &middle);
    // −2δ
    let excess = inverse.times(&[p[2][1] - p[1][2], p[0][2] - p[2][0], p[1][0] - p[0][1]]);
    let seen = cross(w, c);
    // The columns of U½ are its rows.
    let turned: Matrix3<V> = array![j in 3 => cross(&excess, &middle[j])];
    Further {
        half_turn: array![i in 3 => excess[i] * half - seen[i] * quarter],
        growth: Sym3::of(&array![i in 3 => array![j in 3 => p[i][j] - turned[j][i]]]),
    }
}

/// u + ½ growth
#[inline(always)]
fn half_way<V: Lanes>(u: &Sym3<V>, growth: &Sym3<V>) -> Sym3<V> {
    let (u, growth) = (u.to_array(), growth.to_array());
    let [xx, yy, zz, xy, yz, zx] = array![k in 6 => u[k] + growth[k] * V::splat(0.5)];
    Sym3 { xx, yy, zz, xy, yz, zx }
}

#[inline(always)]
fn cross<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
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

/// d + skew(c).
#[inline(always)]
fn with_skew<V: Lanes>(d: &Sym3<V>, c: &[V; 3]) -> Matrix3<V> {
    [[d.xx, d.xy - c[2], d.zx + c[1]], [d.xy + c[2], d.yy, d.yz - c[0]], [d.zx - c[1], d.yz + c[0], d.zz]]
}

/// sym(l̃ U + ½ l̃ l̃ U) with l̃ = d + skew(c).
#[inline(always)]
fn stretch_increment<V: Lanes>(u: &Sym3<V>, d: &Sym3<V>, c: &[V; 3]) -> Sym3<V> {
    let l = with_skew(d, c);
    let lu = multiply(&l, &u.matrix());
    let half = V::splat(0.5);
    let m = u.matrix();
    let middle: Matrix3<V> = array![i in 3 => array![j in 3 => m[i][j] + lu[i][j] * half]];
    Sym3::of(&multiply(&l, &middle))
}
