//! Four lanes of single precision in one register of 128 bits, which every x86-64 processor has; a row is worked off in four parts.
//!
//! SAFETY, for the whole file: as in `lanes::sse2`. Parts are 0 to 3, so the four numbers from `part · 4` lie inside a row of
//! sixteen; slicing checks it.

use super::{BIAS, MANTISSA_BITS, ROUNDING, UPPER_HALF, WHOLE};
use crate::lanes::sse2::F64x2;
use crate::lanes::{Lanes, SingleRow};
use std::arch::x86_64::*;

/// Four numbers of single precision.
#[derive(Clone, Copy)]
pub struct F32x4(__m128);

lane_by_lane!(F32x4: _mm_add_ps, _mm_sub_ps, _mm_mul_ps, _mm_div_ps; sign _mm_xor_ps, _mm_set1_ps);

impl Lanes for F32x4 {
    type Row = SingleRow;
    type Double = F64x2;
    const SINGLE: bool = true;
    const COUNT: usize = 4;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        F32x4(unsafe { _mm_set1_ps(value as f32) })
    }
    #[inline(always)]
    fn load(row: &SingleRow, part: usize) -> Self {
        F32x4(unsafe { _mm_load_ps(row.0[4 * part..4 * part + 4].as_ptr()) })
    }
    #[inline(always)]
    fn store(self, row: &mut SingleRow, part: usize) {
        unsafe { _mm_store_ps(row.0[4 * part..4 * part + 4].as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn widened(self, piece: usize) -> F64x2 {
        F64x2(unsafe { _mm_cvtps_pd(if piece == 0 { self.0 } else { _mm_movehl_ps(self.0, self.0) }) })
    }
    #[inline(always)]
    fn rounded([low, high]: [F64x2; 2]) -> Self {
        F32x4(unsafe { _mm_movelh_ps(_mm_cvtpd_ps(low.0), _mm_cvtpd_ps(high.0)) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        F32x4(unsafe { _mm_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        F32x4(unsafe { _mm_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        F32x4(unsafe { _mm_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        F32x4(unsafe { _mm_andnot_ps(_mm_set1_ps(-0.0), self.0) })
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        unsafe {
            let less = _mm_cmplt_ps(a.0, b.0);
            F32x4(_mm_or_ps(_mm_and_ps(less, yes.0), _mm_andnot_ps(less, no.0)))
        }
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        unsafe { _mm_movemask_ps(_mm_cmplt_ps(a.0, b.0)) != 0 }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm_castps_si128(self.0);
            let mantissa = _mm_and_si128(bits, _mm_set1_epi32(MANTISSA_BITS as i32));
            let [one, whole] = [1.0, WHOLE].map(|number| _mm_castps_si128(_mm_set1_ps(number)));
            let exponent = F32x4(_mm_castsi128_ps(_mm_or_si128(_mm_srli_epi32::<23>(bits), whole)));
            (F32x4(_mm_castsi128_ps(_mm_or_si128(mantissa, one))), exponent - F32x4(_mm_set1_ps(WHOLE + BIAS)))
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        unsafe {
            let shifted = self + F32x4(_mm_set1_ps(WHOLE + BIAS));
            F32x4(_mm_castsi128_ps(_mm_slli_epi32::<23>(_mm_castps_si128(shifted.0))))
        }
    }
    #[inline(always)]
    fn halves(self) -> (Self, Self) {
        unsafe {
            let bits = _mm_castps_si128(self.0);
            let upper = _mm_and_si128(bits, _mm_set1_epi32(UPPER_HALF as i32));
            (F32x4(_mm_castsi128_ps(upper)), F32x4(_mm_castsi128_ps(_mm_slli_epi32::<16>(bits))))
        }
    }
    #[inline(always)]
    fn of_halves(upper: Self, lower: Self) -> Self {
        unsafe {
            let rounding = _mm_set1_epi32(ROUNDING as i32);
            let [upper, lower] = [upper, lower].map(|half| _mm_add_epi32(_mm_castps_si128(half.0), rounding));
            let upper = _mm_and_si128(upper, _mm_set1_epi32(UPPER_HALF as i32));
            F32x4(_mm_castsi128_ps(_mm_or_si128(upper, _mm_srli_epi32::<16>(lower))))
        }
    }
}
