//! A single number.

use super::{BIAS, MANTISSA_BITS, ROUNDING, UPPER_HALF, WHOLE};
use crate::lanes::{CHUNK, Corner, CornerForces, Force, Lanes, MOST_LANES, Numbers, Row, SingleRow};

/// Local node of an element of a row.
#[inline(always)]
fn node(index: Corner, element: usize) -> usize {
    index[element / CHUNK][element % CHUNK] as usize
}

impl Lanes for f32 {
    type Row = SingleRow;
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
    fn load_double(rows: &[Row], part: usize) -> Self {
        rows[part / CHUNK].number(part % CHUNK) as f32
    }
    #[inline(always)]
    fn store_double(self, rows: &mut [Row], part: usize) {
        rows[part / CHUNK].set(part % CHUNK, f64::from(self));
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
    #[inline(always)]
    fn gather(rows: &[Row], index: Corner, part: usize) -> [Self; 8] {
        rows[node(index, part)].0.map(|x| x as f32)
    }
    #[inline(always)]
    fn gather_from(rows: &[Row], origins: &[Row; MOST_LANES], index: Corner, part: usize) -> [Self; 8] {
        let (own, first) = (&rows[node(index, part)], &origins[part]);
        array![c in 8 => (own.0[c] - first.0[c]) as f32]
    }
    #[inline(always)]
    fn spread(force: [Self; 4], out: &mut CornerForces, corner: usize, part: usize) {
        out[part][corner] = Force(force.map(f64::from));
    }
}
