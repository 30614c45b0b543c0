//! Two lanes in one register of 128 bits, which every x86-64 processor has; a chunk is worked off in four parts. Compilers find
//! these registers for [`Pair`](super::Pair) as well, but take twice as long over every kernel.
//!
//! SAFETY, for the whole file: SSE2 belongs to every x86-64 processor. Parts are 0 to 3, so the two
//! numbers from `part · 2` lie inside a row of eight, which is aligned to its line; slicing checks it.

use super::{BIAS, Corner, CornerForces, DoubleLanes, Force, Lanes, MANTISSA_BITS, Row, WHOLE};
use std::arch::x86_64::*;

/// Two doubles.
#[derive(Clone, Copy)]
pub struct F64x2(pub(super) __m128d);

lane_by_lane!(F64x2: _mm_add_pd, _mm_sub_pd, _mm_mul_pd, _mm_div_pd; sign _mm_xor_pd, _mm_set1_pd);

/// One part of a row.
#[inline(always)]
fn pair(Row(numbers): &Row, part: usize) -> __m128d {
    unsafe { _mm_load_pd(numbers[2 * part..2 * part + 2].as_ptr()) }
}

impl Lanes for F64x2 {
    type Row = Row;
    type Double = Self;
    const SINGLE: bool = false;
    const COUNT: usize = 2;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        F64x2(unsafe { _mm_set1_pd(value) })
    }
    #[inline(always)]
    fn load(row: &Row, part: usize) -> Self {
        F64x2(pair(row, part))
    }
    #[inline(always)]
    fn store(self, row: &mut Row, part: usize) {
        unsafe { _mm_store_pd(row.0[2 * part..2 * part + 2].as_mut_ptr(), self.0) }
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
        F64x2(unsafe { _mm_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        F64x2(unsafe { _mm_min_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        F64x2(unsafe { _mm_max_pd(self.0, other.0) })
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        unsafe {
            let less = _mm_cmplt_pd(a.0, b.0);
            F64x2(_mm_or_pd(_mm_and_pd(less, yes.0), _mm_andnot_pd(less, no.0)))
        }
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        unsafe { _mm_movemask_pd(_mm_cmplt_pd(a.0, b.0)) != 0 }
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        unsafe {
            let bits = _mm_castpd_si128(self.0);
            let mantissa = _mm_and_si128(bits, _mm_set1_epi64x(MANTISSA_BITS as i64));
            let [one, whole] = [1.0, WHOLE].map(|number| _mm_castpd_si128(_mm_set1_pd(number)));
            let exponent = F64x2(_mm_castsi128_pd(_mm_or_si128(_mm_srli_epi64::<52>(bits), whole)));
            (F64x2(_mm_castsi128_pd(_mm_or_si128(mantissa, one))), exponent - F64x2::splat(WHOLE + BIAS))
        }
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        unsafe {
            let shifted = self + F64x2::splat(WHOLE + BIAS);
            F64x2(_mm_castsi128_pd(_mm_slli_epi64::<52>(_mm_castpd_si128(shifted.0))))
        }
    }
}

impl DoubleLanes for F64x2 {
    #[inline(always)]
    fn gather(rows: &[Row], index: Corner, piece: usize) -> [Self; 8] {
        unsafe {
            let of = |i: usize| &rows[index[piece / 4][piece % 4 * 2 + i] as usize];
            let (first, second) = (of(0), of(1));
            let turned = array![i in 4 => {
                let (a, b) = (pair(first, i), pair(second, i));
                [F64x2(_mm_unpacklo_pd(a, b)), F64x2(_mm_unpackhi_pd(a, b))]
            }];
            array![c in 8 => turned[c / 2][c % 2]]
        }
    }
    #[inline(always)]
    fn spread([a, b, c, d]: [Self; 4], out: &mut CornerForces, corner: usize, piece: usize) {
        unsafe {
            let lows = [_mm_unpacklo_pd(a.0, b.0), _mm_unpacklo_pd(c.0, d.0)];
            let highs = [_mm_unpackhi_pd(a.0, b.0), _mm_unpackhi_pd(c.0, d.0)];
            for (i, [first, second]) in [lows, highs].into_iter().enumerate() {
                let Force(numbers) = &mut out[2 * piece + i][corner];
                _mm_store_pd(numbers[..2].as_mut_ptr(), first);
                _mm_store_pd(numbers[2..].as_mut_ptr(), second);
            }
        }
    }
}
