//! Sixteen lanes of single precision in one 512-bit register.
//!
//! SAFETY, for the whole file: as in `lanes::avx512`.

use super::{BIAS, MANTISSA_BITS, ROUNDING, UPPER_HALF, WHOLE};
use crate::lanes::{CHUNK, Corner, CornerForces, Lanes, MOST_LANES, Row, SingleRow};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Sixteen numbers of single precision.
#[derive(Clone, Copy)]
pub struct F32x16(__m512);

macro_rules! lane_by_lane {
    ($($trait:ident $method:ident $intrinsic:ident),+) => { $(
        impl $trait for F32x16 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self { F32x16(unsafe { $intrinsic(self.0, other.0) }) }
        }
    )+ };
}
lane_by_lane!(Add add _mm512_add_ps, Sub sub _mm512_sub_ps, Mul mul _mm512_mul_ps, Div div _mm512_div_ps);

impl Neg for F32x16 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        F32x16(unsafe { _mm512_xor_ps(self.0, _mm512_set1_ps(-0.0)) })
    }
}

/// Two halves of eight doubles rounded.
#[inline(always)]
fn rounded(low: __m512d, high: __m512d) -> __m512 {
    unsafe { _mm512_insertf32x8::<1>(_mm512_castps256_ps512(_mm512_cvtpd_ps(low)), _mm512_cvtpd_ps(high)) }
}

/// Four rows transposed within each quarter of the register.
#[inline(always)]
fn transpose_quarters(r: [__m512; 4]) -> [__m512; 4] {
    unsafe {
        let (l0, h0) = (_mm512_unpacklo_ps(r[0], r[1]), _mm512_unpackhi_ps(r[0], r[1]));
        let (l1, h1) = (_mm512_unpacklo_ps(r[2], r[3]), _mm512_unpackhi_ps(r[2], r[3]));
        [
            _mm512_shuffle_ps::<0x44>(l0, l1),
            _mm512_shuffle_ps::<0xee>(l0, l1),
            _mm512_shuffle_ps::<0x44>(h0, h1),
            _mm512_shuffle_ps::<0xee>(h0, h1),
        ]
    }
}

/// Sixteen rows of eight doubles, one per lane, turned: elements 0 to 7 in one register of four, 8 to 15 in another.
#[inline(always)]
fn turned([first, second]: [[__m512d; 8]; 2]) -> [F32x16; 8] {
    let a = transpose_quarters(array![i in 4 => rounded(first[i], first[i + 4])]);
    let b = transpose_quarters(array![i in 4 => rounded(second[i], second[i + 4])]);
    const EVEN: i32 = 0b10_00_10_00;
    const ODD: i32 = 0b11_01_11_01;
    let low: [F32x16; 4] = array![c in 4 => F32x16(unsafe { _mm512_shuffle_f32x4::<EVEN>(a[c], b[c]) })];
    let high: [F32x16; 4] = array![c in 4 => F32x16(unsafe { _mm512_shuffle_f32x4::<ODD>(a[c], b[c]) })];
    [low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]]
}

#[inline(always)]
fn whole(row: &Row) -> __m512d {
    unsafe { _mm512_load_pd(row.0.as_ptr()) }
}

#[inline(always)]
fn nodes(rows: &[Row], index: &[u32; CHUNK]) -> [__m512d; 8] {
    array![i in 8 => whole(&rows[index[i] as usize])]
}

#[inline(always)]
fn less(rows: &[Row], origins: &[Row], index: &[u32; CHUNK]) -> [__m512d; 8] {
    array![i in 8 => unsafe { _mm512_sub_pd(whole(&rows[index[i] as usize]), whole(&origins[i])) }]
}

impl Lanes for F32x16 {
    type Row = SingleRow;
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
    fn load_double(rows: &[Row], _part: usize) -> Self {
        F32x16(rounded(whole(&rows[0]), whole(&rows[1])))
    }
    #[inline(always)]
    fn store_double(self, rows: &mut [Row], _part: usize) {
        unsafe {
            _mm512_store_pd(rows[0].0.as_mut_ptr(), _mm512_cvtps_pd(_mm512_castps512_ps256(self.0)));
            _mm512_store_pd(rows[1].0.as_mut_ptr(), _mm512_cvtps_pd(_mm512_extractf32x8_ps::<1>(self.0)));
        }
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
    #[inline(always)]
    fn gather(rows: &[Row], index: Corner, _part: usize) -> [Self; 8] {
        turned([nodes(rows, index[0]), nodes(rows, index[1])])
    }
    #[inline(always)]
    fn gather_from(rows: &[Row], origins: &[Row; MOST_LANES], index: Corner, _part: usize) -> [Self; 8] {
        let (first, second) = origins.split_at(CHUNK);
        turned([less(rows, first, index[0]), less(rows, second, index[1])])
    }
    #[inline(always)]
    fn spread(force: [Self; 4], out: &mut CornerForces, corner: usize, _part: usize) {
        unsafe {
            let turned = transpose_quarters(force.map(|vector| vector.0));
            for (i, four) in turned.into_iter().enumerate() {
                let halves = [_mm512_castps512_ps256(four), _mm512_extractf32x8_ps::<1>(four)];
                for (h, half) in halves.into_iter().enumerate() {
                    let pair = _mm512_cvtps_pd(half);
                    let (first, second) = (8 * h + i, 8 * h + 4 + i);
                    _mm256_store_pd(out[first][corner].0.as_mut_ptr(), _mm512_castpd512_pd256(pair));
                    _mm256_store_pd(out[second][corner].0.as_mut_ptr(), _mm512_extractf64x4_pd::<1>(pair));
                }
            }
        }
    }
}
