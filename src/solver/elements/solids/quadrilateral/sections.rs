//! What stands for the third dimension: a unit of thickness, or the turn about the axis.

use crate::lanes::{Lanes, array};
use crate::mesh::plane;

/// One component at the four corners of an element, counter-clockwise.
pub type Corners<V> = [V; 4];

/// The mean gradient of an element and its measures.
pub struct Operator<V> {
    /// Gradient of the area, B_iI = ∂A/∂x_iI.
    pub plane: [Corners<V>; 2],
    /// For each corner: what multiplies its radial motion in the radial rate, any motion in the axial gradient, and its radial
    /// motion in the hoop rate; all over what [`Section::inverses`] says.
    pub radial: Corners<V>,
    /// See `radial`.
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
    /// The same bodies, weighed by areas: PRONTO2D's form with test functions N/r, whose nodes move as those of the plane and so keep
    /// a spherical flow spherical, with forces x_I F_I on masses X_I μ_I, where μ_I is of an area and X_I the radius at the start.
    /// Momentum along the axis is kept exactly, and energies are the work of these forces (the compatible form of area-weighted
    /// schemes). What is on the axis weighs nothing and has no force: see [`radii`].
    Compatible,
}

/// Part of the radius of its neighbour that stands for the radius of a corner on the axis. Forces and masses there are so small that
/// no account sees them, and their ratio is that of the neighbour.
pub const ON_AXIS: f64 = 1e-12;

/// Radii x_I by which forces of the compatible form are multiplied.
#[inline(always)]
pub fn radii<V: Lanes>(x: &Corners<V>) -> Corners<V> {
    let (zero, part) = (V::splat(0.0), V::splat(ON_AXIS));
    array![i in 4 => {
        let neighbours = x[(i + 1) % 4] + x[(i + 3) % 4];
        let neighbours = V::select_less(zero, neighbours, neighbours, x[(i + 2) % 4]);
        V::select_less(zero, x[i], x[i], part * neighbours)
    }]
}

impl Section {
    /// Whether x is the distance from an axis.
    #[inline(always)]
    pub fn about_axis(self) -> bool {
        self != Section::PlaneStrain
    }

    /// What the sums of an operator over the corners are divided by to be rates, inverted, and one over the area.
    #[inline(always)]
    pub fn inverses<V: Lanes>(self, operator: &Operator<V>) -> [V; 2] {
        // One division, where there are two measures.
        let one = V::splat(1.0);
        match self {
            Section::Axisymmetric => {
                let both = one / (operator.area * operator.volume);
                [operator.area * both, operator.volume * both]
            }
            Section::PlaneStrain | Section::Compatible => [one / operator.area; 2],
        }
    }

    /// What `volume` is multiplied by to make that of the element: the radians of a turn.
    #[inline(always)]
    pub fn turn(self) -> f64 {
        if self.about_axis() { std::f64::consts::TAU } else { 1.0 }
    }

    /// The operator of strain rates from corner positions; y is relative to the first corner, x only where there is no axis.
    #[inline(always)]
    pub fn operator<V: Lanes>(self, x: &[Corners<V>; 2]) -> Operator<V> {
        match self {
            Section::PlaneStrain => of_plane(x),
            Section::Axisymmetric => of_ring(x),
            Section::Compatible => of_areas(x),
        }
    }

    /// The operator of forces, and of powers: that of rates but in the compatible form, where it is x_I times that of the plane.
    #[inline(always)]
    pub fn of_forces<V: Lanes>(self, operator: Operator<V>, x: &[Corners<V>; 2]) -> Operator<V> {
        if self != Section::Compatible {
            return operator;
        }
        let radii = radii(&x[0]);
        let Operator { plane, hoop, area, volume, .. } = operator;
        Operator {
            radial: array![i in 4 => radii[i] * (plane[0][i] - hoop[i])],
            axial: array![i in 4 => radii[i] * plane[1][i]],
            hoop: array![i in 4 => radii[i] * hoop[i]],
            plane,
            area,
            volume,
        }
    }

    /// x_I over its mean: by what other forces than those of stress are multiplied in the compatible form; the mean is the second.
    #[inline(always)]
    pub fn weights<V: Lanes>(self, x: &[Corners<V>; 2]) -> Option<(Corners<V>, V)> {
        if self != Section::Compatible {
            return None;
        }
        let mean = ((x[0][0] + x[0][1]) + (x[0][2] + x[0][3])) * V::splat(0.25);
        let (radii, inverse) = (radii(&x[0]), V::splat(1.0) / mean);
        Some((array![i in 4 => radii[i] * inverse], mean))
    }

    /// The part of an element's mass that belongs to each corner, from the positions at the start.
    pub fn mass_shares(self, nodes: &[u32; 4], corners: &plane::Corners) -> [f64; 4] {
        if self != Section::Compatible {
            return plane::mass_shares(nodes, corners, self.about_axis());
        }
        let x = corners.map(|corner| corner[0]);
        let sum: f64 = x.iter().sum();
        radii(&x).map(|radius| radius / sum)
    }
}

/// ∂A/∂x and ∂A/∂y, and the area, by the diagonals.
#[inline(always)]
fn gradient_of_area<V: Lanes>([x, y]: &[Corners<V>; 2]) -> ([Corners<V>; 2], V) {
    let half = V::splat(0.5);
    let (x31, y31, x42, y42) = (x[2] - x[0], y[2] - y[0], x[3] - x[1], y[3] - y[1]);
    let (ay, by, ax, bx) = (y42 * half, y31 * half, x42 * half, x31 * half);
    // B_xI = ½ (y_I+1 − y_I−1), B_yI = ½ (x_I−1 − x_I+1)
    ([[-ay, by, ay, -by], [ax, -bx, -ax, bx]], (x31 * y42 - x42 * y31) * half)
}

#[inline(always)]
fn of_plane<V: Lanes>(x: &[Corners<V>; 2]) -> Operator<V> {
    let (gradient, area) = gradient_of_area(x);
    Operator { plane: gradient, radial: gradient[0], axial: gradient[1], hoop: [V::splat(0.0); 4], area, volume: area }
}

/// B_I of the plane, and A/(4 r̄) for the hoop, r̄ the mean radius of the corners. Its volume is that of the ring all the same.
#[inline(always)]
fn of_areas<V: Lanes>(position: &[Corners<V>; 2]) -> Operator<V> {
    let (gradient, area) = gradient_of_area(position);
    let [x, y] = position;
    let hoop = area / ((x[0] + x[1]) + (x[2] + x[3]));
    let sixth = V::splat(1.0 / 6.0);
    let parts: Corners<V> = array![i in 4 => {
        let (before, after) = ((i + 3) % 4, (i + 1) % 4);
        y[i] * (x[before] - x[after]) * (x[before] + x[i] + x[after])
    }];
    let volume = ((parts[1] + parts[2]) + parts[3]) * sixth;
    Operator { plane: gradient, radial: gradient[0], axial: gradient[1], hoop: [hoop; 4], area, volume }
}

/// V_yI = (x_I−1 − x_I+1)(x_I−1 + x_I + x_I+1)/6, V_xI = [(x_I−1 + 2x_I)(y_I − y_I−1) + (2x_I + x_I+1)(y_I+1 − y_I)]/6,
/// H_I = ∫ N_I dA = (A + T_I)/6 with T_I the area of the triangle of a corner and its neighbours; V = Σ y_I V_yI.
#[inline(always)]
fn of_ring<V: Lanes>(position: &[Corners<V>; 2]) -> Operator<V> {
    let [x, y] = position;
    let (gradient, area) = gradient_of_area(position);
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
