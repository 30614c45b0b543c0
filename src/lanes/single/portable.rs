//! A single number.

use super::{BIAS, MANTISSA_BITS, ROUNDING, UPPER_HALF, WHOLE};
use crate::lanes::{Lanes, SingleRow};

impl Lanes for f32 {
    type Row = SingleRow;
    type Double = f64;
    const SINGLE: bool = true;
    const COUNT: usize = 1;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn load(row: &SingleRow, part: usize) -> Self {
        row.0[part]
    }
    #[inline(always)]
    fn store(self, row: &mut SingleRow, part: usize) {
        row.0[part] = self;
    }
    #[inline(always)]
    fn widened(self, _piece: usize) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn rounded([all, _]: [f64; 2]) -> Self {
        all as f32
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f32::sqrt(self)
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        if a < b { yes } else { no }
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        a < b
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let bits = self.to_bits();
        let mantissa = f32::from_bits((bits & MANTISSA_BITS) | 1f32.to_bits());
        (mantissa, f32::from_bits((bits >> 23) | WHOLE.to_bits()) - (WHOLE + BIAS))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        f32::from_bits((self + (WHOLE + BIAS)).to_bits() << 23)
    }
    #[inline(always)]
    fn halves(self) -> (Self, Self) {
        let bits = self.to_bits();
        (f32::from_bits(bits & UPPER_HALF), f32::from_bits(bits << 16))
    }
    #[inline(always)]
    fn of_halves(upper: Self, lower: Self) -> Self {
        let rounded = |x: f32| x.to_bits().wrapping_add(ROUNDING);
        f32::from_bits((rounded(upper) & UPPER_HALF) | (rounded(lower) >> 16))
    }
}
