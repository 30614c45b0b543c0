//! The three-node shell: constant strain and curvature, all else as in the shell of four nodes.
//!
//! Fibres are the normal of the element at all corners, so that velocities and rotation rates are linear: strain and curvature are
//! constant, ε_ab = ½ (e_a·v,b + e_b·v,a), κ_ab = ½ (e_a·q,b + e_b·q,a) with q = ω × e₃. A linear field of rotations with one of
//! deflections would lock in shear. Transverse shear is therefore measured along the three edges, s_IJ = e₃·(v_J − v_I) +
//! ½ x_IJ·(q_I + q_J), and interpolated such that its tangential component is constant along each (Lee and Bathe 2004); at the centre
//! that is s₁₂ + c/3 and s₁₃ − c/3 with c = s₁₃ − s₁₂ − s₂₃, the same whichever corner comes first. What is left where the
//! element is much longer than thick is a stiffness that shrinks with t²/(t² + 0.4 A), in the manner of Lyly, Stenberg and Vihinen
//! (1993): both the shear strain that the law sees and the force that follows are reduced by the root of it, so that their power
//! is that of the law. c itself, a twist in the plane that no strain sees, is resisted by a tenth of the shear stiffness.

use super::facet::{Corners, Facet, Kind, Rates, Resultants, Rows, Stiffnesses};
use super::geometry::{cross, dot, minus, plus, times, unit};
use super::{Entry, Layered, POINTS, energies};
use crate::lanes::{Lanes, array};
use crate::mesh::Shape;
use crate::solver::elements::StoredRow;

/// The kind of shell with three corners.
#[derive(Debug, Clone, Copy)]
pub struct Three;

/// What is resisted beside strains: the twist and the drills of the corners.
const RESISTANCES: usize = 4;

const ROWS: Rows = Rows::of(RESISTANCES);

const STORED: [StoredRow; ROWS.points] = [
    StoredRow { name: "SHREF1", dimension: "1/length" },
    StoredRow { name: "SHREF2", dimension: "1/length" },
    StoredRow { name: "SHREF3", dimension: "1/length" },
    StoredRow { name: "SHTHICK", dimension: "length" },
    StoredRow { name: "SHTHICK0", dimension: "length" },
    StoredRow { name: "SHINERT", dimension: "length^2" },
    StoredRow { name: "SHSTEP", dimension: "time" },
    StoredRow { name: "SHCHANGE", dimension: "-" },
    StoredRow { name: "SHTWIST", dimension: "force" },
    StoredRow { name: "SHDRILL1", dimension: "force*length" },
    StoredRow { name: "SHDRILL2", dimension: "force*length" },
    StoredRow { name: "SHDRILL3", dimension: "force*length" },
    StoredRow { name: "SHNXX", dimension: "force/length" },
    StoredRow { name: "SHNYY", dimension: "force/length" },
    StoredRow { name: "SHNXY", dimension: "force/length" },
    StoredRow { name: "SHMXX", dimension: "force" },
    StoredRow { name: "SHMYY", dimension: "force" },
    StoredRow { name: "SHMXY", dimension: "force" },
    StoredRow { name: "SHQX", dimension: "force/length" },
    StoredRow { name: "SHQY", dimension: "force/length" },
    StoredRow { name: "EINTERN", dimension: "energy" },
    StoredRow { name: "EHOURGL", dimension: "energy" },
    StoredRow { name: "EVISCOUS", dimension: "energy" },
    StoredRow { name: "BULKQ", dimension: "force/length^2" },
    StoredRow { name: "SHDMPTW", dimension: "force" },
    StoredRow { name: "SHDMPD1", dimension: "force*length" },
    StoredRow { name: "SHDMPD2", dimension: "force*length" },
    StoredRow { name: "SHDMPD3", dimension: "force*length" },
];

pub(in crate::solver::elements) static ENTRY: Entry = Entry {
    name: "TRIANGULAR SHELL",
    summary: "Three nodes of a surface, with rotations; points and laws as in SHELL.",
    shape: Shape::Triangle,
    rotations: true,
    rows: &STORED,
    points: Some(POINTS),
    energies: energies(ROWS),
    viscous_stress: Some(ROWS.viscous_stress),
};

/// The shell of three nodes.
pub type Triangle = Layered<Three, 3, RESISTANCES, 6, 12>;

impl Kind<3, RESISTANCES> for Three {
    type Facet<V: Lanes> = Geometry<V>;
    const PLAIN: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    // Of an eighth of the square that two of them are.
    const INERTIA: f64 = 1.0 / 4.0;
}

/// Part of the shear stiffness that resists the twist.
const TWIST: f64 = 0.1;

/// Shear stiffness shrinks to a half where the area is t² over this.
const SLENDER: f64 = 0.4;

/// An element as it lies; ξ leads from the first corner to the second, η to the third.
pub struct Geometry<V> {
    e: [[V; 3]; 3],
    /// ∂x_a/∂ξ_α: (1,ξ), (1,η), (2,η); (2,ξ) is zero, since e₁ is along ξ.
    jacobian: [V; 3],
    /// ∂ξ_α/∂x_a: (ξ,1), (ξ,2), (η,2); (η,1) is zero.
    inverse: [V; 3],
    area: V,
    /// Edges 12, 13, 23.
    edges: [[V; 3]; 3],
    /// Factor on the shear stiffness, and its root.
    share: [V; 2],
}

impl<V: Lanes> Geometry<V> {
    /// Derivatives of a corner field along e₁ and e₂.
    #[inline(always)]
    fn derivatives(&self, f: &Corners<V, 3>) -> [[V; 3]; 2] {
        let (xi, eta) = (minus(&f[1], &f[0]), minus(&f[2], &f[0]));
        [times(&xi, self.inverse[0]), plus(&times(&xi, self.inverse[1]), &times(&eta, self.inverse[2]))]
    }

    /// Transpose of [`Geometry::derivatives`].
    #[inline(always)]
    fn transposed(&self, t1: &[V; 3], t2: &[V; 3]) -> Corners<V, 3> {
        let xi = plus(&times(t1, self.inverse[0]), &times(t2, self.inverse[1]));
        let eta = times(t2, self.inverse[2]);
        let zero = V::splat(0.0);
        [array![i in 3 => zero - xi[i] - eta[i]], xi, eta]
    }

    /// Shear along an edge from corner i to j: change of the angle between it and the fibres, times its length.
    #[inline(always)]
    fn edge_shear(&self, edge: usize, [vi, vj]: [&[V; 3]; 2], [qi, qj]: [&[V; 3]; 2]) -> V {
        dot(&self.e[2], &minus(vj, vi)) + V::splat(0.5) * dot(&self.edges[edge], &plus(qi, qj))
    }
}

impl<V: Lanes> Facet<V, 3, RESISTANCES> for Geometry<V> {
    #[inline(always)]
    fn new(x: &Corners<V, 3>, thickness: V) -> Geometry<V> {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let edges = [minus(&x[1], &x[0]), minus(&x[2], &x[0]), minus(&x[2], &x[1])];
        let e1 = unit(&edges[0]);
        let e3 = unit(&cross(&edges[0], &edges[1]));
        let e = [e1, cross(&e3, &e1), e3];
        let jacobian = [dot(&edges[0], &e[0]), dot(&edges[1], &e[0]), dot(&edges[1], &e[1])];
        let determinant = jacobian[0] * jacobian[2];
        let inverse = [one / jacobian[0], zero - jacobian[1] / determinant, one / jacobian[2]];
        let area = V::splat(0.5) * determinant;
        let square = thickness * thickness;
        let share = square / (square + V::splat(SLENDER) * area);
        Geometry { e, jacobian, inverse, area, edges, share: [share, share.sqrt()] }
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
        [j11, j12, V::splat(0.0), j22]
    }

    #[inline(always)]
    fn reference(&self) -> [V; 3] {
        self.inverse
    }

    #[inline(always)]
    fn rates(&self, v: &Corners<V, 3>, omega: &Corners<V, 3>) -> Rates<V, RESISTANCES> {
        let (half, third) = (V::splat(0.5), V::splat(1.0 / 3.0));
        let [e1, e2, e3] = &self.e;
        let q: Corners<V, 3> = array![corner in 3 => cross(&omega[corner], e3)];
        let ([v1, v2], [q1, q2]) = (self.derivatives(v), self.derivatives(&q));
        let s12 = self.edge_shear(0, [&v[0], &v[1]], [&q[0], &q[1]]);
        let s13 = self.edge_shear(1, [&v[0], &v[2]], [&q[0], &q[2]]);
        let s23 = self.edge_shear(2, [&v[1], &v[2]], [&q[1], &q[2]]);
        let twist = s13 - s12 - s23;
        let (xi, eta) = (s12 + third * twist, s13 - third * twist);
        let spin = half * (dot(e2, &v1) - dot(e1, &v2));
        let [d1, d2, d3] = array![corner in 3 => dot(e3, &omega[corner]) - spin];
        Rates {
            strain: [dot(e1, &v1), dot(e2, &v2), half * (dot(e1, &v2) + dot(e2, &v1))],
            curvature: [dot(e1, &q1), dot(e2, &q2), half * (dot(e1, &q2) + dot(e2, &q1))],
            shear: [self.inverse[0] * xi, self.inverse[1] * xi + self.inverse[2] * eta],
            resisted: [twist, d1, d2, d3],
            warping: V::splat(0.0),
        }
    }

    #[inline(always)]
    fn forces(&self, s: &Resultants<V, RESISTANCES>) -> [Corners<V, 3>; 2] {
        let (half, third) = (V::splat(0.5), V::splat(1.0 / 3.0));
        let [e1, e2, e3] = &self.e;
        let ([m11, m22, m12], [n11, n22, n12]) = (s.moment, s.force);
        let [twist, d1, d2, d3] = s.resisted;
        let couple = half * (d1 + d2 + d3);
        let t1: [V; 3] = array![i in 3 => n11 * e1[i] + n12 * e2[i] - couple * e2[i]];
        let t2: [V; 3] = array![i in 3 => n12 * e1[i] + n22 * e2[i] + couple * e1[i]];
        let r1: [V; 3] = array![i in 3 => m11 * e1[i] + m12 * e2[i]];
        let r2: [V; 3] = array![i in 3 => m12 * e1[i] + m22 * e2[i]];
        let (mut force, mut fibre) = (self.transposed(&t1, &t2), self.transposed(&r1, &r2));
        let xi = self.inverse[0] * s.shear[0] + self.inverse[1] * s.shear[1];
        let eta = self.inverse[2] * s.shear[1];
        let mixed = third * (xi - eta) + twist;
        let weights = [xi - mixed, eta + mixed, V::splat(0.0) - mixed];
        for (edge, [i, j]) in [[0, 1], [0, 2], [1, 2]].into_iter().enumerate() {
            let turn = half * weights[edge];
            for k in 0..3 {
                let along = weights[edge] * e3[k];
                force[j][k] = force[j][k] + along;
                force[i][k] = force[i][k] - along;
                fibre[i][k] = fibre[i][k] + turn * self.edges[edge][k];
                fibre[j][k] = fibre[j][k] + turn * self.edges[edge][k];
            }
        }
        let drill = [d1, d2, d3];
        let moment = array![corner in 3 => {
            let m = cross(e3, &fibre[corner]);
            array![i in 3 => m[i] + drill[corner] * e3[i]]
        }];
        [force, moment]
    }

    #[inline(always)]
    fn reduced(&self, shear: V) -> V {
        shear * self.share[1]
    }

    #[inline(always)]
    fn rises(&self, rates: &[V; RESISTANCES], s: &Stiffnesses<V>) -> [V; RESISTANCES] {
        let [twist, d1, d2, d3] = *rates;
        [V::splat(TWIST) * s.shear * self.share[0] * twist, s.drill * d1, s.drill * d2, s.drill * d3]
    }

    #[inline(always)]
    fn rooted(&self, rates: &[V; RESISTANCES], s: &Stiffnesses<V>) -> [V; RESISTANCES] {
        let ([twist, d1, d2, d3], drill) = (*rates, s.drill.sqrt());
        let twist = (V::splat(TWIST) * s.shear * self.share[0]).sqrt() * twist;
        [twist, drill * d1, drill * d2, drill * d3]
    }

    #[inline(always)]
    fn bends(_: usize) -> bool {
        false
    }
}
