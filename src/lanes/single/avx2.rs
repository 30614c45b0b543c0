//! Eight lanes of single precision in one 256-bit register; a row is worked off in two parts.
//!
//! SAFETY, for the whole file: as in `lanes::avx512`, with AVX2 in place of AVX-512. Parts are 0 and 1, so the eight numbers
//! from `part · 8` lie inside a row of sixteen; slicing checks it.

use super::{BIAS, MANTISSA_BITS, ROUNDING, UPPER_HALF, WHOLE};
use crate::lanes::avx2::F64x4;
use crate::lanes::{CHUNK, Lanes, SingleRow};
use std::arch::x86_64::*;

/// Eight numbers of single precision.
#[derive(Clone, Copy)]
pub struct F32x8(__m256);

lane_by_lane!(F32x8: _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps; sign _mm256_xor_ps, _mm256_set1_ps);

impl Lanes for F32x8 {
    type Row = SingleRow;
    type Double = F64x4;
    const SINGLE: bool = true;
    const COUNT: usize = CHUNK;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        F32x8(unsafe { _mm256_set1_ps(value as f32) })
    }
    #[inline(always)]
    fn load(row: &SingleRow, part: usize) -> Self {
        F32x8(unsafe { _mm256_load_ps(row.0[part * 8..part * 8 + 8].as_ptr()) })
    }
    #[inline(always)]
    fn store(self, row: &mut SingleRow, part: usize) {
        unsafe { _mm256_store_ps(row.0[part * 8..part * 8 + 8].as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn widened(self, piece: usize) -> F64x4 {
        let half =
            unsafe { if piece == 0 { _mm256_castps256_ps128(self.0) } else { _mm256_extractf128_ps::<1>(self.0) } };
        F64x4(unsafe { _mm256_cvtps_pd(half) })
    }
    #[inline(always)]
    fn rounded([low, high]: [F64x4; 2]) -> Self {
        let low = unsafe { _mm256_castps128_ps256(_mm256_cvtpd_ps(low.0)) };
        F32x8(unsafe { _mm256_insertf128_ps::<1>(low, _mm256_cvtpd_ps(high.0)) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        F32x8(unsafe { _mm256_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        F32x8(unsafe { _mm256_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        F32x8(unsafe { _mm256_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        F32x8(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        F32x8(unsafe { _mm256_blendv_ps(no.0, yes.0, _mm256_cmp_ps::<_CMP_LT_OQ>(a.0, b.0)) })
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(a.0, b.0)) != 0 }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm256_castps_si256(self.0);
            let mantissa = _mm256_and_si256(bits, _mm256_set1_epi32(MANTISSA_BITS as i32));
            let one = _mm256_castps_si256(_mm256_set1_ps(1.0));
            let whole = _mm256_castps_si256(_mm256_set1_ps(WHOLE));
            let exponent = _mm256_castsi256_ps(_mm256_or_si256(_mm256_srli_epi32::<23>(bits), whole));
            let exponent = F32x8(exponent) - F32x8(_mm256_set1_ps(WHOLE + BIAS));
            (F32x8(_mm256_castsi256_ps(_mm256_or_si256(mantissa, one))), exponent)
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        unsafe {
            let shifted = self + F32x8(_mm256_set1_ps(WHOLE + BIAS));
            F32x8(_mm256_castsi256_ps(_mm256_slli_epi32::<23>(_mm256_castps_si256(shifted.0))))
        }
    }
    #[inline(always)]
    fn halves(self) -> (Self, Self) {
        unsafe {
            let bits = _mm256_castps_si256(self.0);
            let upper = _mm256_and_si256(bits, _mm256_set1_epi32(UPPER_HALF as i32));
            (F32x8(_mm256_castsi256_ps(upper)), F32x8(_mm256_castsi256_ps(_mm256_slli_epi32::<16>(bits))))
        }
    }
    #[inline(always)]
    fn of_halves(upper: Self, lower: Self) -> Self {
        unsafe {
            let rounding = _mm256_set1_epi32(ROUNDING as i32);
            let upper = _mm256_add_epi32(_mm256_castps_si256(upper.0), rounding);
            let lower = _mm256_add_epi32(_mm256_castps_si256(lower.0), rounding);
            let upper = _mm256_and_si256(upper, _mm256_set1_epi32(UPPER_HALF as i32));
            F32x8(_mm256_castsi256_ps(_mm256_or_si256(upper, _mm256_srli_epi32::<16>(lower))))
        }
    }
}
