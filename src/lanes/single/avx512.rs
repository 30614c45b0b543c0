//! Sixteen lanes of single precision in one 512-bit register.
//!
//! SAFETY, for the whole file: as in `lanes::avx512`.

use super::{BIAS, MANTISSA_BITS, ROUNDING, UPPER_HALF, WHOLE};
use crate::lanes::avx512::F64x8;
use crate::lanes::{Lanes, MOST_LANES, SingleRow};
use std::arch::x86_64::*;

/// Sixteen numbers of single precision.
#[derive(Clone, Copy)]
pub struct F32x16(__m512);

lane_by_lane!(F32x16: _mm512_add_ps, _mm512_sub_ps, _mm512_mul_ps, _mm512_div_ps; sign _mm512_xor_ps, _mm512_set1_ps);

impl Lanes for F32x16 {
    type Row = SingleRow;
    type Double = F64x8;
    const SINGLE: bool = true;
    const COUNT: usize = MOST_LANES;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        F32x16(unsafe { _mm512_set1_ps(value as f32) })
    }
    #[inline(always)]
    fn load(row: &SingleRow, _part: usize) -> Self {
        F32x16(unsafe { _mm512_load_ps(row.0.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, row: &mut SingleRow, _part: usize) {
        unsafe { _mm512_store_ps(row.0.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn widened(self, piece: usize) -> F64x8 {
        let half =
            unsafe { if piece == 0 { _mm512_castps512_ps256(self.0) } else { _mm512_extractf32x8_ps::<1>(self.0) } };
        F64x8(unsafe { _mm512_cvtps_pd(half) })
    }
    #[inline(always)]
    fn rounded([low, high]: [F64x8; 2]) -> Self {
        let low = unsafe { _mm512_castps256_ps512(_mm512_cvtpd_ps(low.0)) };
        F32x16(unsafe { _mm512_insertf32x8::<1>(low, _mm512_cvtpd_ps(high.0)) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        F32x16(unsafe { _mm512_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        F32x16(unsafe { _mm512_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        F32x16(unsafe { _mm512_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        F32x16(unsafe { _mm512_abs_ps(self.0) })
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        F32x16(unsafe { _mm512_mask_blend_ps(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(a.0, b.0), no.0, yes.0) })
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a.0, b.0) != 0 }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm512_castps_si512(self.0);
            let mantissa = _mm512_and_si512(bits, _mm512_set1_epi32(MANTISSA_BITS as i32));
            let one = _mm512_castps_si512(_mm512_set1_ps(1.0));
            let whole = _mm512_castps_si512(_mm512_set1_ps(WHOLE));
            let exponent = _mm512_castsi512_ps(_mm512_or_si512(_mm512_srli_epi32::<23>(bits), whole));
            let exponent = F32x16(exponent) - F32x16(_mm512_set1_ps(WHOLE + BIAS));
            (F32x16(_mm512_castsi512_ps(_mm512_or_si512(mantissa, one))), exponent)
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        unsafe {
            let shifted = self + F32x16(_mm512_set1_ps(WHOLE + BIAS));
            F32x16(_mm512_castsi512_ps(_mm512_slli_epi32::<23>(_mm512_castps_si512(shifted.0))))
        }
    }
    #[inline(always)]
    fn halves(self) -> (Self, Self) {
        unsafe {
            let bits = _mm512_castps_si512(self.0);
            let upper = _mm512_and_si512(bits, _mm512_set1_epi32(UPPER_HALF as i32));
            (F32x16(_mm512_castsi512_ps(upper)), F32x16(_mm512_castsi512_ps(_mm512_slli_epi32::<16>(bits))))
        }
    }
    #[inline(always)]
    fn of_halves(upper: Self, lower: Self) -> Self {
        unsafe {
            let rounding = _mm512_set1_epi32(ROUNDING as i32);
            let upper = _mm512_add_epi32(_mm512_castps_si512(upper.0), rounding);
            let lower = _mm512_add_epi32(_mm512_castps_si512(lower.0), rounding);
            let upper = _mm512_and_si512(upper, _mm512_set1_epi32(UPPER_HALF as i32));
            F32x16(_mm512_castsi512_ps(_mm512_or_si512(upper, _mm512_srli_epi32::<16>(lower))))
        }
    }
}
