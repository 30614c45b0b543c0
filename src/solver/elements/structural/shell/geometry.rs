//! Geometry of a four-node shell with one point in its plane, and its rates of strain.
//!
//! Fibres stand at the corners along pseudo-normals p_I = unit[(x_{I+1} − x_I) × (x_{I−1} − x_I)], which are found from the
//! positions at every step, so that no rotation is accumulated. Their rate is q_I = ω_I × p_I: a rotation about p_I drops out.
//! The rates of membrane strain and curvature are those of x + z p with bilinear x and p, taken at the centre; transverse shear
//! is measured along the four edges. What is left are the hourglass fields, made orthogonal to rigid motion also of a warped
//! element by X and P, and the rotation about the normal (drill). Forces are the transpose of the rates, so that the power is the
//! same to the last bit of rounding, and rigid motion does no work. In this form the twisted beam is passed, which plain
//! one-point shells (Belytschko, Lin and Tsay 1984) fail; it is equivalent in purpose to Belytschko, Wong and Chiang (1992).
//!
//! Strains of the hourglass fields are assumed in axes, and others in other axes; so is the bound of the stable step. As in solids
//! these are the rotation nearest to both natural coordinates, the R of J = R U (polar decomposition), which no numbering of the
//! corners chooses: another first corner, or a look from the other side, exchanges e₁ and e₂ and turns signs, and nothing else.

use super::facet::{self, Facet, Kind, Rates, Resultants, Stiffnesses};
use crate::lanes::{Lanes, array};

/// The kind of shell with four corners.
#[derive(Debug, Clone, Copy)]
pub struct Quadrilateral;

/// What is resisted beside strains: hourglass fields of membrane, bending and shear, two each, and the drills of the corners.
pub const RESISTANCES: usize = 10;

impl Kind<4, RESISTANCES> for Quadrilateral {
    type Facet<V: Lanes> = Geometry<V>;
    const PLAIN: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    const INERTIA: f64 = 1.0 / 8.0;
}

/// Corners at the ends of the edges 12, 23, 43, 14.
const ENDS: [[usize; 2]; 4] = [[0, 1], [1, 2], [3, 2], [0, 3]];

/// A vector per corner.
type Corners<V> = facet::Corners<V, 4>;

/// The three patterns of a corner field: ξ, η and hourglass; a quarter of the sum with the signs of the pattern.
type Pattern<V> = [[V; 3]; 3];

/// An element as it lies.
pub struct Geometry<V> {
    /// Axes: e₁ and e₂ the rotation nearest to ξ and η, e₃ normal to their plane. Each a vector.
    pub e: [[V; 3]; 3],
    /// ∂x_a/∂ξ_α, symmetric in these axes: (1,ξ), (1,η), (2,η).
    jacobian: [V; 3],
    /// ∂ξ_α/∂x_a, symmetric too: (ξ,1), (ξ,2), (η,2).
    inverse: [V; 3],
    /// Area.
    pub area: V,
    /// Fibres.
    p: Corners<V>,
    /// Their derivatives in the plane.
    slope: [[V; 3]; 2],
    /// Curvature b_ac = p,a · e_c.
    curvature: [[V; 2]; 2],
    /// ¼ h · x along e₁ and e₂.
    skew: [V; 2],
    /// Hourglass parts of positions and fibres.
    hourglass: [[V; 3]; 2],
    /// Edges 12, 23, 43, 14.
    edges: [[V; 3]; 4],
}

#[inline(always)]
pub fn dot<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub fn cross<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub fn minus<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    array![i in 3 => a[i] - b[i]]
}

#[inline(always)]
pub fn plus<V: Lanes>(a: &[V; 3], b: &[V; 3]) -> [V; 3] {
    array![i in 3 => a[i] + b[i]]
}

#[inline(always)]
pub fn times<V: Lanes>(a: &[V; 3], factor: V) -> [V; 3] {
    array![i in 3 => a[i] * factor]
}

/// Unit vector; zero for zero.
#[inline(always)]
pub fn unit<V: Lanes>(a: &[V; 3]) -> [V; 3] {
    let length = dot(a, a).max(V::splat(V::TINY)).sqrt();
    times(a, V::splat(1.0) / length)
}

/// Derivatives along e₁ and e₂ from those along ξ and η.
#[inline(always)]
fn gradient<V: Lanes>(inverse: &[V; 3], xi: &[V; 3], eta: &[V; 3]) -> [[V; 3]; 2] {
    [
        array![i in 3 => xi[i] * inverse[0] + eta[i] * inverse[1]],
        array![i in 3 => xi[i] * inverse[1] + eta[i] * inverse[2]],
    ]
}

#[inline(always)]
fn patterns<V: Lanes>(f: &Corners<V>) -> Pattern<V> {
    let quarter = V::splat(0.25);
    let (a, b) = (minus(&f[2], &f[0]), minus(&f[1], &f[3]));
    let (c, d) = (plus(&f[0], &f[2]), plus(&f[1], &f[3]));
    [times(&plus(&a, &b), quarter), times(&minus(&a, &b), quarter), times(&minus(&c, &d), quarter)]
}

impl<V: Lanes> Geometry<V> {
    /// From the positions of the corners.
    #[inline(always)]
    fn of_corners(x: &Corners<V>) -> Geometry<V> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let [g1, g2, gh] = patterns(x);
        let normal = cross(&g1, &g2);
        let e3 = unit(&normal);
        // The polar decomposition in the plane: (J₁₁ + J₂₂, J₂₁ − J₁₂) is along e₁ in any axes.
        let e1 = unit(&plus(&g1, &cross(&g2, &e3)));
        let e = [e1, cross(&e3, &e1), e3];
        let jacobian = [dot(&g1, &e[0]), dot(&g2, &e[0]), dot(&g2, &e[1])];
        // Of J without a difference, which would lose the digits of an element that is nearly a line.
        let determinant = dot(&normal, &e[2]);
        let over = one / determinant;
        let inverse = [jacobian[2] * over, (zero - jacobian[1]) * over, jacobian[0] * over];
        let edges = [minus(&x[1], &x[0]), minus(&x[2], &x[1]), minus(&x[2], &x[3]), minus(&x[3], &x[0])];
        // Corner by corner, the edge that leads away times the one that comes in.
        let p = [
            unit(&cross(&edges[0], &edges[3])),
            unit(&cross(&edges[0], &edges[1])),
            unit(&cross(&edges[2], &edges[1])),
            unit(&cross(&edges[2], &edges[3])),
        ];
        let [p_xi, p_eta, p_h] = patterns(&p);
        let slope = gradient(&inverse, &p_xi, &p_eta);
        let skew = [dot(&gh, &e[0]), dot(&gh, &e[1])];
        let hourglass =
            [times(&e[2], dot(&gh, &e[2])), array![i in 3 => p_h[i] - skew[0] * slope[0][i] - skew[1] * slope[1][i]]];
        let curvature =
            [[dot(&slope[0], &e[0]), dot(&slope[0], &e[1])], [dot(&slope[1], &e[0]), dot(&slope[1], &e[1])]];
        let area = V::splat(4.0) * determinant;
        Geometry { e, jacobian, inverse, area, p, slope, curvature, skew, hourglass, edges }
    }

    /// Derivatives of a field in the plane along e₁ and e₂, and its hourglass part.
    #[inline(always)]
    fn derivatives(&self, f: &Corners<V>) -> Pattern<V> {
        let [xi, eta, h] = patterns(f);
        let [d1, d2] = gradient(&self.inverse, &xi, &eta);
        let rest = array![i in 3 => h[i] - self.skew[0] * d1[i] - self.skew[1] * d2[i]];
        [d1, d2, rest]
    }

    /// Rates of fibres with these rotation rates.
    #[inline(always)]
    fn fibre_rates(&self, omega: &Corners<V>) -> Corners<V> {
        array![corner in 4 => cross(&omega[corner], &self.p[corner])]
    }

    /// Rates of strain of velocities and rotation rates of the corners.
    #[inline(always)]
    fn all_rates(&self, v: &Corners<V>, omega: &Corners<V>) -> Rates<V, RESISTANCES> {
        let (half, two) = (V::splat(0.5), V::splat(2.0));
        let q = self.fibre_rates(omega);
        let [v1, v2, vh] = self.derivatives(v);
        let [q1, q2, qh] = self.derivatives(&q);
        let [e1, e2, e3] = &self.e;
        let [p1, p2] = &self.slope;
        let strain = [dot(e1, &v1), dot(e2, &v2), half * (dot(e1, &v2) + dot(e2, &v1))];
        let b = &self.curvature;
        let curvature = [
            dot(e1, &q1) + dot(p1, &v1) - two * (b[0][0] * strain[0] + b[0][1] * strain[2]),
            dot(e2, &q2) + dot(p2, &v2) - two * (b[1][0] * strain[2] + b[1][1] * strain[1]),
            half * (dot(e1, &q2) + dot(e2, &q1) + dot(p1, &v2) + dot(p2, &v1))
                - (b[0][0] * strain[2] + b[0][1] * strain[1])
                - (b[1][0] * strain[0] + b[1][1] * strain[2]),
        ];
        let [s12, s23, s43, s14] = self.edge_shears(v, &q);
        let quarter = V::splat(0.25);
        let (xi, eta) = (quarter * (s12 + s43), quarter * (s23 + s14));
        let inverse = &self.inverse;
        let shear = [inverse[0] * xi + inverse[1] * eta, inverse[1] * xi + inverse[2] * eta];
        let [big_x, big_p] = &self.hourglass;
        let spin: [V; 3] = {
            let normal = half * (dot(e2, &v1) - dot(e1, &v2));
            let (s1, s2) = (dot(e3, &v2), dot(e3, &v1));
            array![i in 3 => s1 * e1[i] - s2 * e2[i] + normal * e3[i]]
        };
        let [d1, d2, d3, d4] = array![corner in 4 => dot(&self.p[corner], &minus(&omega[corner], &spin))];
        let resisted = [
            dot(e1, &vh) + dot(big_x, &v1),
            dot(e2, &vh) + dot(big_x, &v2),
            dot(e1, &qh) + dot(big_p, &v1),
            dot(e2, &qh) + dot(big_p, &v2),
            quarter * (s43 - s12),
            quarter * (s23 - s14),
            d1,
            d2,
            d3,
            d4,
        ];
        Rates { strain, curvature, shear, resisted, warping: dot(e3, &vh) }
    }

    /// Shear along the edges 12, 23, 43, 14: change of the angle between the edge and the fibres at its ends, times its length.
    #[inline(always)]
    fn edge_shears(&self, v: &Corners<V>, q: &Corners<V>) -> [V; 4] {
        let half = V::splat(0.5);
        array![edge in 4 => {
            let [i, j] = ENDS[edge];
            let fibre = plus(&self.p[i], &self.p[j]);
            half * (dot(&fibre, &minus(&v[j], &v[i])) + dot(&self.edges[edge], &plus(&q[i], &q[j])))
        }]
    }

    /// Forces and moments of the corners that have the power of the resultants, `[force, moment]`.
    #[inline(always)]
    fn all_forces(&self, s: &Resultants<V, RESISTANCES>) -> [Corners<V>; 2] {
        let (half, two) = (V::splat(0.5), V::splat(2.0));
        let [g1, g2, k1, k2, twist @ .., c1, c2, c3, c4] = s.resisted;
        let (membrane, bending, drill) = ([g1, g2], [k1, k2], [c1, c2, c3, c4]);
        let [e1, e2, e3] = &self.e;
        let [p1, p2] = &self.slope;
        let b = &self.curvature;
        let ([m11, m22, m12], [n11, n22, n12]) = (s.moment, s.force);
        // Membrane force without what the curvature takes for itself.
        let n11 = n11 - two * (b[0][0] * m11 + b[1][0] * m12);
        let n22 = n22 - two * (b[1][1] * m22 + b[0][1] * m12);
        let n12 = n12 - (b[0][1] * m11 + b[1][1] * m12 + b[1][0] * m22 + b[0][0] * m12);
        let couple: [V; 3] = array![i in 3 => {
            let p = &self.p;
            (p[0][i] * drill[0] + p[1][i] * drill[1]) + (p[2][i] * drill[2] + p[3][i] * drill[3])
        }];
        let (c1, c2, c3) = (dot(&couple, e1), dot(&couple, e2), half * dot(&couple, e3));
        let [big_x, big_p] = &self.hourglass;
        // What multiplies the derivatives of the velocity, and its hourglass part.
        let t1: [V; 3] = array![i in 3 => {
            let own = n11 * e1[i] + n12 * e2[i] + m11 * p1[i] + m12 * p2[i];
            own + membrane[0] * big_x[i] + bending[0] * big_p[i] + c2 * e3[i] - c3 * e2[i]
        }];
        let t2: [V; 3] = array![i in 3 => {
            let own = n12 * e1[i] + n22 * e2[i] + m12 * p1[i] + m22 * p2[i];
            own + membrane[1] * big_x[i] + bending[1] * big_p[i] - c1 * e3[i] + c3 * e1[i]
        }];
        let th: [V; 3] = array![i in 3 => membrane[0] * e1[i] + membrane[1] * e2[i]];
        let r1: [V; 3] = array![i in 3 => m11 * e1[i] + m12 * e2[i]];
        let r2: [V; 3] = array![i in 3 => m12 * e1[i] + m22 * e2[i]];
        let rh: [V; 3] = array![i in 3 => bending[0] * e1[i] + bending[1] * e2[i]];
        let mut force = self.transposed(&t1, &t2, &th);
        let mut fibre = self.transposed(&r1, &r2, &rh);
        self.add_edges(s.shear, twist, &mut force, &mut fibre);
        let moment = array![corner in 4 => {
            let m = cross(&self.p[corner], &fibre[corner]);
            array![i in 3 => m[i] + drill[corner] * self.p[corner][i]]
        }];
        [force, moment]
    }

    /// Adds the forces of edge shears to those of corners and fibres.
    #[inline(always)]
    fn add_edges(&self, shear: [V; 2], twist: [V; 2], force: &mut Corners<V>, fibre: &mut Corners<V>) {
        let quarter = V::splat(0.25);
        let xi = self.inverse[0] * shear[0] + self.inverse[1] * shear[1];
        let eta = self.inverse[1] * shear[0] + self.inverse[2] * shear[1];
        let weights = [xi - twist[0], eta + twist[1], xi + twist[0], eta - twist[1]];
        for edge in 0..4 {
            let [i, j] = ENDS[edge];
            let half = quarter * V::splat(0.5) * weights[edge];
            for k in 0..3 {
                let along = half * (self.p[i][k] + self.p[j][k]);
                force[j][k] = force[j][k] + along;
                force[i][k] = force[i][k] - along;
                let turn = half * self.edges[edge][k];
                fibre[i][k] = fibre[i][k] + turn;
                fibre[j][k] = fibre[j][k] + turn;
            }
        }
    }

    /// Transpose of [`Geometry::derivatives`].
    #[inline(always)]
    fn transposed(&self, t1: &[V; 3], t2: &[V; 3], th: &[V; 3]) -> Corners<V> {
        let quarter = V::splat(0.25);
        let mut corners = [[V::splat(0.0); 3]; 4];
        for i in 0..3 {
            let (t1, t2) = (t1[i] - self.skew[0] * th[i], t2[i] - self.skew[1] * th[i]);
            let xi = quarter * (self.inverse[0] * t1 + self.inverse[1] * t2);
            let eta = quarter * (self.inverse[1] * t1 + self.inverse[2] * t2);
            let h = quarter * th[i];
            corners[0][i] = h - xi - eta;
            corners[1][i] = xi - eta - h;
            corners[2][i] = xi + eta + h;
            corners[3][i] = eta - xi - h;
        }
        corners
    }

    /// Metric that hourglass fields are measured with: H₁₁, H₂₂, H₁₂ = A/3 ∂ξ_α/∂x_a ∂ξ_α/∂x_b; and A/3 times the squares of
    /// the gradients of ξ and η.
    #[inline(always)]
    fn hourglass_metric(&self) -> ([V; 3], [V; 2]) {
        let third = self.area * V::splat(1.0 / 3.0);
        let [a, b, d] = self.inverse;
        let (first, second) = (third * (a * a + b * b), third * (b * b + d * d));
        ([first, second, third * b * (a + d)], [first, second])
    }
}

impl<V: Lanes> Facet<V, 4, RESISTANCES> for Geometry<V> {
    #[inline(always)]
    fn new(x: &Corners<V>, _thickness: V) -> Geometry<V> {
        Geometry::of_corners(x)
    }

    #[inline(always)]
    fn area(&self) -> V {
        self.area
    }

    #[inline(always)]
    fn axes(&self) -> &[[V; 3]; 3] {
        &self.e
    }

    #[inline(always)]
    fn jacobian(&self) -> [V; 4] {
        let [j11, j12, j22] = self.jacobian;
        [j11, j12, j12, j22]
    }

    #[inline(always)]
    fn reference(&self) -> [V; 3] {
        let [j11, j12, j22] = self.jacobian;
        let first = (j11 * j11 + j12 * j12).sqrt();
        let determinant = self.area * V::splat(0.25);
        let along = j12 * (j11 + j22) / first;
        [V::splat(1.0) / first, V::splat(0.0) - along / determinant, first / determinant]
    }

    #[inline(always)]
    fn rates(&self, v: &Corners<V>, omega: &Corners<V>) -> Rates<V, RESISTANCES> {
        self.all_rates(v, omega)
    }

    #[inline(always)]
    fn forces(&self, s: &Resultants<V, RESISTANCES>) -> [Corners<V>; 2] {
        self.all_forces(s)
    }

    #[inline(always)]
    fn reduced(&self, shear: V) -> V {
        shear
    }

    #[inline(always)]
    fn rises(&self, rates: &[V; RESISTANCES], s: &Stiffnesses<V>) -> [V; RESISTANCES] {
        let ([h11, h22, h12], gradients) = self.hourglass_metric();
        let mixed = V::splat(s.poisson) * h12;
        let [m1, m2, b1, b2, t1, t2, d1, d2, d3, d4] = *rates;
        [
            s.membrane * (h11 * m1 - mixed * m2),
            s.membrane * (h22 * m2 - mixed * m1),
            s.bending * (h11 * b1 - mixed * b2),
            s.bending * (h22 * b2 - mixed * b1),
            s.shear * gradients[0] * t1,
            s.shear * gradients[1] * t2,
            s.drill * d1,
            s.drill * d2,
            s.drill * d3,
            s.drill * d4,
        ]
    }

    #[inline(always)]
    fn rooted(&self, rates: &[V; RESISTANCES], s: &Stiffnesses<V>) -> [V; RESISTANCES] {
        let ([h11, h22, h12], gradients) = self.hourglass_metric();
        // The symmetric root of the hourglass matrix A = [H₁₁, −ν H₁₂; −ν H₁₂, H₂₂], (A + √det A)/√(tr A + 2 √det A), which
        // does not depend on which axis is the first.
        let mixed = V::splat(-s.poisson) * h12;
        let root = (h11 * h22 - mixed * mixed).max(V::splat(0.0)).sqrt();
        let over = V::splat(1.0) / (h11 + h22 + (root + root)).sqrt();
        let (first, second, mixed) = ((h11 + root) * over, (h22 + root) * over, mixed * over);
        let [m1, m2, b1, b2, t1, t2, d1, d2, d3, d4] = *rates;
        let (membrane, bending, drill) = (s.membrane.sqrt(), s.bending.sqrt(), s.drill.sqrt());
        [
            membrane * (first * m1 + mixed * m2),
            membrane * (mixed * m1 + second * m2),
            bending * (first * b1 + mixed * b2),
            bending * (mixed * b1 + second * b2),
            (s.shear * gradients[0]).sqrt() * t1,
            (s.shear * gradients[1]).sqrt() * t2,
            drill * d1,
            drill * d2,
            drill * d3,
            drill * d4,
        ]
    }

    #[inline(always)]
    fn bends(resistance: usize) -> bool {
        resistance == 2 || resistance == 3
    }
}
