//! Eight lanes in one 512-bit register.
//!
//! Measured need for `unsafe`: the same kernel left to the compiler's vectoriser takes two to four times as long
//! and varies with unrelated edits (`docs/performance.md`).
//!
//! SAFETY, for the whole file: the intrinsics demand AVX-512 F, DQ and VL. Values of [`F64x8`] are only made inside
//! kernels that `solver::elements` enters after [`super::InstructionSet::detect`] has found these features. Loads
//! and stores go through references to eight numbers, so they stay inside their object.

use super::{BIAS, CHUNK, Corner, CornerForces, DoubleLanes, Lanes, MANTISSA_BITS, Row, WHOLE};
use std::arch::x86_64::*;

/// Eight doubles.
#[derive(Clone, Copy)]
pub struct F64x8(pub(super) __m512d);

lane_by_lane!(F64x8: _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd, _mm512_div_pd; sign _mm512_xor_pd, _mm512_set1_pd);

/// Numbers 0 to 3 or 4 to 7 of a row.
#[inline(always)]
fn half(row: &Row, half: usize) -> __m256d {
    unsafe { _mm256_load_pd(row.0[half * 4..half * 4 + 4].as_ptr()) }
}

/// Eight 4-vectors transposed.
#[inline(always)]
fn transpose(r: [__m256d; 8]) -> [F64x8; 4] {
    const EVEN: i32 = 0b10_00_10_00;
    const ODD: i32 = 0b11_01_11_01;
    unsafe {
        let (a, b) = (_mm512_castpd256_pd512(r[0]), _mm512_castpd256_pd512(r[1]));
        let (c, d) = (_mm512_castpd256_pd512(r[4]), _mm512_castpd256_pd512(r[5]));
        let (a, b) = (_mm512_insertf64x4::<1>(a, r[2]), _mm512_insertf64x4::<1>(b, r[3]));
        let (c, d) = (_mm512_insertf64x4::<1>(c, r[6]), _mm512_insertf64x4::<1>(d, r[7]));
        let (l0, h0) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
        let (l1, h1) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
        [
            F64x8(_mm512_shuffle_f64x2::<EVEN>(l0, l1)),
            F64x8(_mm512_shuffle_f64x2::<EVEN>(h0, h1)),
            F64x8(_mm512_shuffle_f64x2::<ODD>(l0, l1)),
            F64x8(_mm512_shuffle_f64x2::<ODD>(h0, h1)),
        ]
    }
}

impl Lanes for F64x8 {
    type Row = Row;
    type Double = Self;
    const SINGLE: bool = false;
    const COUNT: usize = CHUNK;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        F64x8(unsafe { _mm512_set1_pd(value) })
    }
    #[inline(always)]
    fn load(row: &Row, _part: usize) -> Self {
        F64x8(unsafe { _mm512_load_pd(row.0.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, row: &mut Row, _part: usize) {
        unsafe { _mm512_store_pd(row.0.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn widened(self, _piece: usize) -> Self {
        self
    }
    #[inline(always)]
    fn rounded([all, _]: [Self; 2]) -> Self {
        all
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        F64x8(unsafe { _mm512_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        F64x8(unsafe { _mm512_min_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        F64x8(unsafe { _mm512_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        F64x8(unsafe { _mm512_mask_blend_pd(_mm512_cmp_pd_mask::<_CMP_LT_OQ>(a.0, b.0), no.0, yes.0) })
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a.0, b.0) != 0 }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm512_castpd_si512(self.0);
            let mantissa = _mm512_and_si512(bits, _mm512_set1_epi64(MANTISSA_BITS as i64));
            let one = _mm512_castpd_si512(_mm512_set1_pd(1.0));
            let whole = _mm512_castpd_si512(_mm512_set1_pd(WHOLE));
            let exponent = _mm512_castsi512_pd(_mm512_or_si512(_mm512_srli_epi64::<52>(bits), whole));
            let exponent = F64x8(exponent) - F64x8::splat(WHOLE + BIAS);
            (F64x8(_mm512_castsi512_pd(_mm512_or_si512(mantissa, one))), exponent)
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let shifted = self + F64x8::splat(WHOLE + BIAS);
        F64x8(unsafe { _mm512_castsi512_pd(_mm512_slli_epi64::<52>(_mm512_castpd_si512(shifted.0))) })
    }
}

impl DoubleLanes for F64x8 {
    /// Eight rows, one per lane, transposed in registers. Each register is loaded in two halves, of elements two apart: so 16 shuffles
    /// of pairs are enough where whole rows would need 24, and those for what nobody asks for are left out.
    #[inline(always)]
    fn gather(rows: &[Row], index: Corner, piece: usize) -> [Self; 8] {
        let r: [&Row; 8] = array![i in 8 => &rows[index[piece][i] as usize]];
        let [x, y, z, m] = transpose(array![i in 8 => half(r[i], 0)]);
        let [vx, vy, vz, inverse] = transpose(array![i in 8 => half(r[i], 1)]);
        [x, y, z, m, vx, vy, vz, inverse]
    }

    #[inline(always)]
    fn spread(force: [Self; 4], out: &mut CornerForces, corner: usize, piece: usize) {
        let out = &mut out[CHUNK * piece..][..CHUNK];
        unsafe {
            let (a, b) = (_mm512_unpacklo_pd(force[0].0, force[1].0), _mm512_unpackhi_pd(force[0].0, force[1].0));
            let (p, q) = (_mm512_unpacklo_pd(force[2].0, force[3].0), _mm512_unpackhi_pd(force[2].0, force[3].0));
            let low = _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0);
            let high = _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
            // Elements (0, 2), (1, 3), (4, 6), (5, 7).
            let pairs = [
                (_mm512_permutex2var_pd(a, low, p), 0, 2),
                (_mm512_permutex2var_pd(b, low, q), 1, 3),
                (_mm512_permutex2var_pd(a, high, p), 4, 6),
                (_mm512_permutex2var_pd(b, high, q), 5, 7),
            ];
            for (pair, first, second) in pairs {
                _mm256_store_pd(out[first][corner].0.as_mut_ptr(), _mm512_castpd512_pd256(pair));
                _mm256_store_pd(out[second][corner].0.as_mut_ptr(), _mm512_extractf64x4_pd::<1>(pair));
            }
        }
    }
}
