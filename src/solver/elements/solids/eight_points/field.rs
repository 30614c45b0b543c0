//! The strain that the modes ηζ, ζξ, ξη and ξηζ cause at the eight points, and the forces that belong to it.
//!
//! With v_i = q_iα φ_α(ξ) in the frame, box lengths ℓ_i, j and k the other two directions and the points at ζ = ±1/√3 (Belytschko and
//! Bindeman 1993, the field whose integral is their assumed strain stabilisation):
//!
//! ```text
//! α = j (φ = ζ_k ζ_i), bending along i that varies along k:  d_ii = e, d_kk = −ν' e,         e = 2 ζ_k q_ij/ℓ_i, ν' = ν/(1 − ν)
//! α = i (φ = ζ_j ζ_k), warping:                              d_ij = ζ_k q_ii/ℓ_j, d_ik = ζ_j q_ii/ℓ_k
//! α = 4 (φ = ξηζ):                                           d_ii = e, d_jj = d_kk = −ν e,   e = 2 ζ_j ζ_k q_i4/ℓ_i
//! ```
//!
//! Left out are the shears by which a bent element would lock. ν is that of the law while it is elastic. In plastic flow, which keeps
//! its volume, the contraction across with an elastic ν would strain the volume of every point and lock in turn: ν goes to one
//! half with the share of the points that flow.

use crate::lanes::{Lanes, Sym3, array};
use crate::solver::elements::hexahedron::hourglass::Resistance;

/// 1/√3.
const PLACE: f64 = 0.577_350_269_189_625_8;

/// Amplitudes of the field, with 2ζ/ℓ and the like already in them.
pub struct Field<V> {
    /// `[i][n]`, 2 q/ℓ_i PLACE: of the modes of direction i that bend along i and vary along its second (0) and third (1) neighbour.
    bend: [[V; 2]; 3],
    /// q_ii PLACE over ℓ of the second and third neighbour.
    warp: [[V; 2]; 3],
    /// 2 q_i4/ℓ_i PLACE².
    twist: [V; 3],
}

/// ν/(1 − ν) and ν with this share of the points in flow.
#[inline(always)]
pub fn contraction<V: Lanes>(poisson: V, flowing: V) -> [V; 2] {
    let nu = poisson + flowing * (V::splat(0.5) - poisson);
    [nu / (V::splat(1.0) - nu), nu]
}

impl<V: Lanes> Field<V> {
    /// The field of hourglass rates in the frame, with base vectors of ±1, of an element with lengths L = 4ℓ.
    #[inline(always)]
    pub fn of_rates(rates: &Resistance<V>, lengths: &[V; 3]) -> Field<V> {
        // q is an eighth of the rate, and ℓ a fourth of L.
        let inverse: [V; 3] = array![i in 3 => V::splat(0.5) / lengths[i]];
        let (place, double) = (V::splat(PLACE), V::splat(2.0 * PLACE));
        Field {
            bend: array![i in 3 => {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                // Mode k varies along j, mode j along k.
                [double * rates[i][k] * inverse[i], double * rates[i][j] * inverse[i]]
            }],
            warp: array![i in 3 => {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                // Of the shear ij, which varies along k, and of ik, which varies along j.
                [place * rates[i][i] * inverse[j], place * rates[i][i] * inverse[k]]
            }],
            twist: array![i in 3 => V::splat(2.0 * PLACE * PLACE) * rates[i][3] * inverse[i]],
        }
    }

    /// Its strain at a point, beside the mean one, with this contraction across.
    #[inline(always)]
    pub fn at(&self, signs: [f64; 3], across: [V; 2]) -> Sym3<V> {
        let zero = V::splat(0.0);
        let mut normal = [zero; 3];
        let mut shear = [[zero; 3]; 3];
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let [sj, sk] = [V::splat(signs[j]), V::splat(signs[k])];
            let (along_j, along_k) = (sj * self.bend[i][0], sk * self.bend[i][1]);
            let twist = V::splat(signs[j] * signs[k]) * self.twist[i];
            normal[i] = normal[i] + along_j + along_k + twist;
            normal[j] = normal[j] - across[0] * along_j - across[1] * twist;
            normal[k] = normal[k] - across[0] * along_k - across[1] * twist;
            shear[i][j] = sk * self.warp[i][0];
            shear[i][k] = sj * self.warp[i][1];
        }
        Sym3 {
            xx: normal[0],
            yy: normal[1],
            zz: normal[2],
            xy: shear[0][1] + shear[1][0],
            yz: shear[1][2] + shear[2][1],
            zx: shear[2][0] + shear[0][2],
        }
    }
}

/// Sums of the stresses of the points, as the transpose of the field wants them.
pub struct Moments<V> {
    /// Mean stress.
    pub mean: Sym3<V>,
    /// Means of sign × stress, by direction of the sign.
    first: [Sym3<V>; 3],
    /// Means of sign × sign × stress; entry i is of the other two directions.
    second: [Sym3<V>; 3],
}

impl<V: Lanes> Moments<V> {
    /// Of no points.
    #[inline(always)]
    pub fn new() -> Moments<V> {
        let zero = V::splat(0.0);
        let none = Sym3 { xx: zero, yy: zero, zz: zero, xy: zero, yz: zero, zx: zero };
        Moments { mean: none, first: [none; 3], second: [none; 3] }
    }

    /// Adds the stress of a point.
    #[inline(always)]
    pub fn add(&mut self, signs: [f64; 3], stress: &Sym3<V>) {
        let share = V::splat(0.125);
        self.mean = self.mean.zip(*stress, |sum, one| sum + share * one);
        for i in 0..3 {
            let first = V::splat(0.125 * signs[i]);
            let second = V::splat(0.125 * signs[(i + 1) % 3] * signs[(i + 2) % 3]);
            self.first[i] = self.first[i].zip(*stress, |sum, one| sum + first * one);
            self.second[i] = self.second[i].zip(*stress, |sum, one| sum + second * one);
        }
    }

    /// Resistance to the hourglass modes with base vectors of ±1: the transpose of [`Field::of_rates`] and [`Field::at`], times
    /// the volume.
    #[inline(always)]
    pub fn resistance(&self, lengths: &[V; 3], across: [V; 2], volume: V) -> Resistance<V> {
        let inverse: [V; 3] = array![i in 3 => V::splat(0.5 * PLACE) * volume / lengths[i]];
        let first: [[[V; 3]; 3]; 3] = array![i in 3 => self.first[i].matrix()];
        let second: [[[V; 3]; 3]; 3] = array![i in 3 => self.second[i].matrix()];
        let two = V::splat(2.0);
        let twice_place = V::splat(2.0 * PLACE);
        let mut resistance = [[V::splat(0.0); 4]; 3];
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            resistance[i][i] = two * (first[k][i][j] * inverse[j] + first[j][i][k] * inverse[k]);
            resistance[i][j] = two * inverse[i] * (first[k][i][i] - across[0] * first[k][k][k]);
            resistance[i][k] = two * inverse[i] * (first[j][i][i] - across[0] * first[j][j][j]);
            let normal = second[i][i][i] - across[1] * (second[i][j][j] + second[i][k][k]);
            resistance[i][3] = twice_place * inverse[i] * normal;
        }
        resistance
    }
}
