//! The incremental polar decomposition in the plane: one angle, and a stretch across that does not turn.
//!
//! The same update as that of the hexahedron (Flanagan and Taylor 1987, kept in the turning frame), whose terms of the third
//! direction are zero but for the stretch.

use crate::lanes::Lanes;

/// A symmetric tensor of the plane with what is across it: xx, yy, zz, xy.
pub type Flat<V> = [V; 4];

/// What the material and the hourglass control need to know of a step's motion.
pub struct Motion<V> {
    /// Strain increment Δt d in the frame, at mid-step.
    pub strain: Flat<V>,
    /// Cosine and sine of the frame's angle at the end of the step.
    pub frame: [V; 2],
    /// The same half way through it.
    pub middle: [V; 2],
}

/// Carries the frame, given by cosine and sine, and the stretch over one step Δt with the mid-step velocity gradient, in the
/// plane and across it.
#[inline(always)]
pub fn advance<V: Lanes>(
    gradient: &[[V; 2]; 2],
    across: V,
    frame: [V; 2],
    stretch: &mut Flat<V>,
    time_step: V,
) -> Motion<V> {
    let half = V::splat(0.5);
    let [cosine, sine] = frame;
    // d Δt in the frame at the start of the step; the spin is the same in every frame.
    let (xx, yy) = (gradient[0][0] * time_step, gradient[1][1] * time_step);
    let xy = (gradient[0][1] + gradient[1][0]) * half * time_step;
    let spin = (gradient[1][0] - gradient[0][1]) * half * time_step;
    let (cc, ss, cs) = (cosine * cosine, sine * sine, cosine * sine);
    let (shear, zz) = ((xy + xy) * cs, across * time_step);
    let d = [cc * xx + ss * yy + shear, ss * xx + cc * yy - shear, zz, (yy - xx) * cs + xy * (cc - ss)];
    let u = *stretch;
    // axial(U d) / (U11 + U22)
    let correction = ((u[3] * d[0] + u[1] * d[3]) - (u[0] * d[3] + u[3] * d[1])) / (u[0] + u[1]);
    let half_turn = (spin - correction) * half;
    // Cayley's rotation by t = half_turn: (1 + i t)² / (1 + t²)
    let square = half_turn * half_turn;
    let (real, imaginary) = (V::splat(1.0) - square, half_turn + half_turn);
    let scale = V::splat(1.0) / (V::splat(1.0) + square);
    let (c, s) = ((cosine * real - sine * imaginary) * scale, (sine * real + cosine * imaginary) * scale);
    // What rounding has left of the length one goes to second order: a step of Newton's towards 1/√(c² + s²).
    let nearer = V::splat(1.5) - half * (c * c + s * s);
    let new = [c * nearer, s * nearer];
    let turned = d[3] * half_turn;
    let strain = [d[0] + (turned + turned), d[1] - (turned + turned), d[2], d[3] + (d[1] - d[0]) * half_turn];
    *stretch = advance_stretch(&u, &strain, correction);
    Motion { strain, frame: new, middle: [(cosine + new[0]) * half, (sine + new[1]) * half] }
}

/// U + sym(l̃ U + ½ l̃ l̃ U) with l̃ = d + skew(c).
#[inline(always)]
fn advance_stretch<V: Lanes>(u: &Flat<V>, d: &Flat<V>, c: V) -> Flat<V> {
    let half = V::splat(0.5);
    let l = [[d[0], d[3] - c], [d[3] + c, d[1]]];
    let plane = [[u[0], u[3]], [u[3], u[1]]];
    let lu = product(&l, &plane);
    let middle = [
        [plane[0][0] + lu[0][0] * half, plane[0][1] + lu[0][1] * half],
        [plane[1][0] + lu[1][0] * half, plane[1][1] + lu[1][1] * half],
    ];
    let change = product(&l, &middle);
    [
        u[0] + change[0][0],
        u[1] + change[1][1],
        u[2] + d[2] * (u[2] + d[2] * u[2] * half),
        u[3] + (change[0][1] + change[1][0]) * half,
    ]
}

/// a · b. A function, not a closure: those are not always inlined, and then know no vector instructions.
#[inline(always)]
fn product<V: Lanes>(a: &[[V; 2]; 2], b: &[[V; 2]; 2]) -> [[V; 2]; 2] {
    [
        [a[0][0] * b[0][0] + a[0][1] * b[1][0], a[0][0] * b[0][1] + a[0][1] * b[1][1]],
        [a[1][0] * b[0][0] + a[1][1] * b[1][0], a[1][0] * b[0][1] + a[1][1] * b[1][1]],
    ]
}
