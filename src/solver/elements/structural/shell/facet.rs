//! What shells of different corners have in common, and what each kind of them says of itself.

use crate::lanes::{Lanes, Matrix3, array};
use std::fmt::Debug;

/// A vector per corner.
pub type Corners<V, const C: usize> = [[V; 3]; C];

/// A kind of shell: C corners, and R fields beside strain, curvature and shear that are resisted.
pub trait Kind<const C: usize, const R: usize>: Debug + Clone + Copy + Send + Sync + 'static {
    /// An element of this kind as it lies.
    type Facet<V: Lanes>: Facet<V, C, R>;

    /// Corners of an element of edge 1 in the plane of x and y.
    const PLAIN: [[f64; 2]; C];

    /// Rotary inertia over mass of a corner at least, over the area.
    const INERTIA: f64;

    /// Where the rows are.
    const ROWS: Rows = Rows::of(R);
}

/// Places of those rows of a shell's state that stand behind its R resistances.
#[derive(Debug, Clone, Copy)]
pub struct Rows {
    /// Membrane forces, moments and shear forces per length.
    pub resultants: usize,
    /// Internal energy since the start.
    pub internal_energy: usize,
    /// Energy of hourglass and drill resistance since the start.
    pub hourglass_energy: usize,
    /// Energy taken up by bulk viscosity since the start.
    pub viscous_energy: usize,
    /// Bulk viscosity of the last step as a mean stress in the plane.
    pub viscous_stress: usize,
    /// Damping of what is resisted in the last step, in the order of the resistances.
    pub damping: usize,
    /// First row of the points.
    pub points: usize,
}

impl Rows {
    /// Of a shell with so many resistances.
    pub const fn of(resistances: usize) -> Rows {
        let behind = super::rows::RESISTANCE + resistances;
        Rows {
            resultants: behind,
            internal_energy: behind + 8,
            hourglass_energy: behind + 9,
            viscous_energy: behind + 10,
            viscous_stress: behind + 11,
            damping: behind + 12,
            points: behind + 12 + resistances,
        }
    }
}

/// Rates of everything that resists, per time.
pub struct Rates<V, const R: usize> {
    /// Membrane strain 11, 22, 12 in the axes of the element.
    pub strain: [V; 3],
    /// Curvature 11, 22, 12.
    pub curvature: [V; 3],
    /// Transverse shear (twice the tensor component) 1, 2.
    pub shear: [V; 2],
    /// What else is resisted: hourglass fields, and last the rotation about the fibre against that of the surface, per corner.
    pub resisted: [V; R],
    /// Rate at which the element warps: the hourglass part of the velocity along e₃.
    pub warping: V,
}

/// What resists: all that is conjugate to [`Rates`], with the area in it.
pub struct Resultants<V, const R: usize> {
    /// Membrane force 11, 22, 12 times the area.
    pub force: [V; 3],
    /// Moment 11, 22, 12 times the area.
    pub moment: [V; 3],
    /// Shear force 1, 2 times the area.
    pub shear: [V; 2],
    /// Of what else is resisted; couples along the fibres last.
    pub resisted: [V; R],
}

/// What the stiffness of the other resistances is made of.
#[derive(Debug, Clone, Copy)]
pub struct Stiffnesses<V> {
    /// Poisson's ratio.
    pub poisson: f64,
    /// Young's modulus times the thickness.
    pub membrane: V,
    /// E t³/12, times the factor of the rule through the thickness.
    pub bending: V,
    /// Shear modulus times thickness and shear correction.
    pub shear: V,
    /// Of a couple along a fibre.
    pub drill: V,
}

/// An element as it lies.
pub trait Facet<V: Lanes, const C: usize, const R: usize>: Sized {
    /// From the positions of the corners; the thickness is of account only for shear that is reduced.
    fn new(x: &Corners<V, C>, thickness: V) -> Self;

    /// Area.
    fn area(&self) -> V;

    /// Axes: e₁ and e₂ in the plane, e₃ the normal. Each a vector.
    fn axes(&self) -> &[[V; 3]; 3];

    /// ∂x_a/∂ξ_α: (1,ξ), (1,η), (2,ξ), (2,η).
    fn jacobian(&self) -> [V; 4];

    /// ∂ξ_α/∂X_b of the element in axes of which the first is along ξ: (ξ,1), (ξ,2), (η,2), since (η,1) is zero there. The reference
    /// that [`Facet::turn`] wants of the start.
    fn reference(&self) -> [V; 3];

    /// Rates of strain of velocities and rotation rates of the corners.
    fn rates(&self, v: &Corners<V, C>, omega: &Corners<V, C>) -> Rates<V, R>;

    /// Forces and moments of the corners that have the power of the resultants, `[force, moment]`.
    fn forces(&self, s: &Resultants<V, R>) -> [Corners<V, C>; 2];

    /// A shear strain as the law sees it, and a shear force as that makes it: times the same factor.
    fn reduced(&self, shear: V) -> V;

    /// Rates of the resistances by those of the fields.
    fn rises(&self, rates: &[V; R], stiffness: &Stiffnesses<V>) -> [V; R];

    /// Rates of the fields times the roots of their stiffnesses: the sum of their squares is twice the energy.
    fn rooted(&self, rates: &[V; R], stiffness: &Stiffnesses<V>) -> [V; R];

    /// Whether plastic flow takes as much off this resistance as off bending, not as off the membrane.
    fn bends(resistance: usize) -> bool;

    /// Cosine and sine of the angle from e₁ to the material axis that was along ξ at the start, by the polar decomposition of the
    /// motion in the plane; and the stretch in these material axes: 11, 22, 12.
    #[inline(always)]
    fn turn(&self, reference: &[V; 3]) -> ([V; 2], [V; 3]) {
        let [j11, j12, j21, j22] = self.jacobian();
        let [r11, r12, r22] = *reference;
        // F_ab = ∂x_a/∂ξ_α ∂ξ_α/∂X_b
        let (f11, f12) = (j11 * r11, j11 * r12 + j12 * r22);
        let (f21, f22) = (j21 * r11, j21 * r12 + j22 * r22);
        let (a, b) = (f11 + f22, f21 - f12);
        let length = (a * a + b * b).max(V::splat(V::TINY)).sqrt();
        let (c, s) = (a / length, b / length);
        ([c, s], [c * f11 + s * f21, c * f22 - s * f12, c * f12 + s * f22])
    }

    /// Material axes in space, as columns.
    #[inline(always)]
    fn material_axes(&self, [c, s]: [V; 2]) -> Matrix3<V> {
        let [e1, e2, e3] = self.axes();
        array![i in 3 => [c * e1[i] + s * e2[i], c * e2[i] - s * e1[i], e3[i]]]
    }
}
