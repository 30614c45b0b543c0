//! What stands for the third dimension: a unit of thickness, or the turn about the axis.

use crate::lanes::{Lanes, array};

/// One component at the four corners of an element, counter-clockwise.
pub type Corners<V> = [V; 4];

/// The mean gradient of an element and its measures.
pub struct Operator<V> {
    /// Gradient of the area, B_iI = ∂A/∂x_iI.
    pub plane: [Corners<V>; 2],
    /// For each corner: what multiplies its radial motion in the radial rate, its axial gradient ∂V/∂y, and what multiplies
    /// its radial motion in the hoop rate; all over `volume`.
    pub radial: Corners<V>,
    /// ∂V/∂y.
    pub axial: Corners<V>,
    /// Zero in plane strain.
    pub hoop: Corners<V>,
    /// Area in the plane.
    pub area: V,
    /// Volume, per radian of a body of revolution and per unit of thickness in plane strain.
    pub volume: V,
}

/// What is left out of the third dimension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Section {
    /// No motion and no change across the plane; a unit of thickness.
    PlaneStrain,
    /// Bodies of revolution about the y axis.
    ///
    /// Galerkin's method with test functions N_I and exact integrals over the ring, with the strain that is uniform in the mean
    /// over its volume: the operator is the volume's own gradient, so that the trace of the rate is V̇/V, axial momentum is
    /// conserved exactly, and a uniform pressure is in balance on distorted meshes. The radial gradient is taken apart, V_x = G + H,
    /// into what makes radial and what makes hoop strain.
    Axisymmetric,
}

impl Section {
    /// Whether x is the distance from an axis.
    #[inline(always)]
    pub fn about_axis(self) -> bool {
        self == Section::Axisymmetric
    }

    /// What `volume` is multiplied by to make that of the element: the radians of a turn.
    #[inline(always)]
    pub fn turn(self) -> f64 {
        if self.about_axis() { std::f64::consts::TAU } else { 1.0 }
    }

    /// The operator from corner positions; y is relative to the first corner, x only where there is no axis.
    #[inline(always)]
    pub fn operator<V: Lanes>(self, x: &[Corners<V>; 2]) -> Operator<V> {
        if self.about_axis() { of_ring(x) } else { of_plane(x) }
    }
}

/// ∂A/∂x and ∂A/∂y, and the area, by the diagonals.
#[inline(always)]
fn plane<V: Lanes>([x, y]: &[Corners<V>; 2]) -> ([Corners<V>; 2], V) {
    let half = V::splat(0.5);
    let (x31, y31, x42, y42) = (x[2] - x[0], y[2] - y[0], x[3] - x[1], y[3] - y[1]);
    let (ay, by, ax, bx) = (y42 * half, y31 * half, x42 * half, x31 * half);
    // B_xI = ½ (y_I+1 − y_I−1), B_yI = ½ (x_I−1 − x_I+1)
    ([[-ay, by, ay, -by], [ax, -bx, -ax, bx]], (x31 * y42 - x42 * y31) * half)
}

#[inline(always)]
fn of_plane<V: Lanes>(x: &[Corners<V>; 2]) -> Operator<V> {
    let (gradient, area) = plane(x);
    Operator { plane: gradient, radial: gradient[0], axial: gradient[1], hoop: [V::splat(0.0); 4], area, volume: area }
}

/// V_yI = (x_I−1 − x_I+1)(x_I−1 + x_I + x_I+1)/6, V_xI = [(x_I−1 + 2x_I)(y_I − y_I−1) + (2x_I + x_I+1)(y_I+1 − y_I)]/6,
/// H_I = ∫ N_I dA = (A + T_I)/6 with T_I the area of the triangle of a corner and its neighbours; V = Σ y_I V_yI.
#[inline(always)]
fn of_ring<V: Lanes>(position: &[Corners<V>; 2]) -> Operator<V> {
    let [x, y] = position;
    let (gradient, area) = plane(position);
    let (half, sixth) = (V::splat(0.5), V::splat(1.0 / 6.0));
    let edge: Corners<V> = array![i in 4 => y[(i + 1) % 4] - y[i]];
    let twice: Corners<V> = array![i in 4 => x[i] + x[i]];
    let hoop: Corners<V> = array![i in 4 => {
        let (before, after) = ((i + 3) % 4, (i + 1) % 4);
        let triangle = (x[i] - x[before]) * edge[i] - (x[after] - x[i]) * edge[before];
        (area + triangle * half) * sixth
    }];
    let axial: Corners<V> = array![i in 4 => {
        let (before, after) = ((i + 3) % 4, (i + 1) % 4);
        (x[before] - x[after]) * (x[before] + x[i] + x[after]) * sixth
    }];
    let radial: Corners<V> = array![i in 4 => {
        let (before, after) = ((i + 3) % 4, (i + 1) % 4);
        ((x[before] + twice[i]) * edge[before] + (twice[i] + x[after]) * edge[i]) * sixth - hoop[i]
    }];
    let volume = (y[1] * axial[1] + y[2] * axial[2]) + y[3] * axial[3];
    Operator { plane: gradient, radial, axial, hoop, area, volume }
}
