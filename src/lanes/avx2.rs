//! Four lanes in one 256-bit register; a chunk is worked off in two parts.
//!
//! SAFETY, for the whole file: as in `avx512.rs`, with AVX2 in place of AVX-512. Parts are 0 and 1, so the four
//! numbers from `part · 4` lie inside a row of eight; slicing checks it.

use super::{BIAS, Corner, CornerForces, DoubleLanes, Lanes, MANTISSA_BITS, Row, WHOLE};
use std::arch::x86_64::*;

/// Four doubles.
#[derive(Clone, Copy)]
pub struct F64x4(pub(super) __m256d);

lane_by_lane!(F64x4: _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd; sign _mm256_xor_pd, _mm256_set1_pd);

/// Four 4-vectors transposed.
#[inline(always)]
fn transpose(r: [__m256d; 4]) -> [F64x4; 4] {
    unsafe {
        let (l0, h0) = (_mm256_unpacklo_pd(r[0], r[1]), _mm256_unpackhi_pd(r[0], r[1]));
        let (l1, h1) = (_mm256_unpacklo_pd(r[2], r[3]), _mm256_unpackhi_pd(r[2], r[3]));
        [
            F64x4(_mm256_permute2f128_pd::<0x20>(l0, l1)),
            F64x4(_mm256_permute2f128_pd::<0x20>(h0, h1)),
            F64x4(_mm256_permute2f128_pd::<0x31>(l0, l1)),
            F64x4(_mm256_permute2f128_pd::<0x31>(h0, h1)),
        ]
    }
}

impl Lanes for F64x4 {
    type Row = Row;
    type Double = Self;
    const SINGLE: bool = false;
    const COUNT: usize = 4;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        F64x4(unsafe { _mm256_set1_pd(value) })
    }
    #[inline(always)]
    fn load(row: &Row, part: usize) -> Self {
        F64x4(unsafe { _mm256_load_pd(row.0[part * 4..part * 4 + 4].as_ptr()) })
    }
    #[inline(always)]
    fn store(self, row: &mut Row, part: usize) {
        unsafe { _mm256_store_pd(row.0[part * 4..part * 4 + 4].as_mut_ptr(), self.0) }
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
        F64x4(unsafe { _mm256_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        F64x4(unsafe { _mm256_min_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        F64x4(unsafe { _mm256_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        F64x4(unsafe { _mm256_blendv_pd(no.0, yes.0, _mm256_cmp_pd::<_CMP_LT_OQ>(a.0, b.0)) })
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(a.0, b.0)) != 0 }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm256_castpd_si256(self.0);
            let mantissa = _mm256_and_si256(bits, _mm256_set1_epi64x(MANTISSA_BITS as i64));
            let one = _mm256_castpd_si256(_mm256_set1_pd(1.0));
            let whole = _mm256_castpd_si256(_mm256_set1_pd(WHOLE));
            let exponent = _mm256_castsi256_pd(_mm256_or_si256(_mm256_srli_epi64::<52>(bits), whole));
            let exponent = F64x4(exponent) - F64x4::splat(WHOLE + BIAS);
            (F64x4(_mm256_castsi256_pd(_mm256_or_si256(mantissa, one))), exponent)
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let shifted = self + F64x4::splat(WHOLE + BIAS);
        F64x4(unsafe { _mm256_castsi256_pd(_mm256_slli_epi64::<52>(_mm256_castpd_si256(shifted.0))) })
    }
}

impl DoubleLanes for F64x4 {
    #[inline(always)]
    fn gather(rows: &[Row], index: Corner, piece: usize) -> [Self; 8] {
        let half = |i: usize, h: usize| unsafe {
            _mm256_load_pd(rows[index[piece / 2][piece % 2 * 4 + i] as usize].0[h * 4..h * 4 + 4].as_ptr())
        };
        let first = transpose([half(0, 0), half(1, 0), half(2, 0), half(3, 0)]);
        let second = transpose([half(0, 1), half(1, 1), half(2, 1), half(3, 1)]);
        [first[0], first[1], first[2], first[3], second[0], second[1], second[2], second[3]]
    }
    #[inline(always)]
    fn spread(force: [Self; 4], out: &mut CornerForces, corner: usize, piece: usize) {
        let turned = transpose(force.map(|vector| vector.0));
        for (i, vector) in turned.into_iter().enumerate() {
            unsafe { _mm256_store_pd(out[piece * 4 + i][corner].0.as_mut_ptr(), vector.0) }
        }
    }
}
