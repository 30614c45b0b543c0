//! Lanes on any machine: two numbers side by side, or a single one (for tests and set-up).

use super::{BIAS, Corner, CornerForces, Force, Lanes, MANTISSA_BITS, Row, WHOLE};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Two lanes without a promise of vector instructions; compilers find those that every 64-bit processor has. More
/// lanes would not run faster, and take long to compile.
#[derive(Debug, Clone, Copy)]
pub struct Pair([f64; 2]);

macro_rules! lane_by_lane {
    ($($trait:ident $method:ident $op:tt),+) => { $(
        impl $trait for Pair {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self { Pair([self.0[0] $op other.0[0], self.0[1] $op other.0[1]]) }
        }
    )+ };
}
lane_by_lane!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Pair {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Pair([-self.0[0], -self.0[1]])
    }
}

impl Lanes for Pair {
    type Row = Row;
    const SINGLE: bool = false;
    const COUNT: usize = 2;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Pair([value; 2])
    }
    #[inline(always)]
    fn load(row: &Row, part: usize) -> Self {
        Pair([row.0[2 * part], row.0[2 * part + 1]])
    }
    #[inline(always)]
    fn store(self, row: &mut Row, part: usize) {
        row.0[2 * part..2 * part + 2].copy_from_slice(&self.0);
    }
    #[inline(always)]
    fn load_double(rows: &[Row], part: usize) -> Self {
        Self::load(&rows[0], part)
    }
    #[inline(always)]
    fn store_double(self, rows: &mut [Row], part: usize) {
        self.store(&mut rows[0], part);
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Pair([self.0[0].sqrt(), self.0[1].sqrt()])
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        Pair([f64::select_less(a.0[0], b.0[0], yes.0[0], no.0[0]), f64::select_less(a.0[1], b.0[1], yes.0[1], no.0[1])])
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        a.0[0] < b.0[0] || a.0[1] < b.0[1]
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let [(m0, e0), (m1, e1)] = [self.0[0].split_exponent(), self.0[1].split_exponent()];
        (Pair([m0, m1]), Pair([e0, e1]))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Pair([self.0[0].power_of_two(), self.0[1].power_of_two()])
    }
    #[inline(always)]
    fn gather(rows: &[Row], [index, _]: Corner, part: usize) -> [Self; 8] {
        let (first, second) = (&rows[index[2 * part] as usize].0, &rows[index[2 * part + 1] as usize].0);
        array![c in 8 => Pair([first[c], second[c]])]
    }
    #[inline(always)]
    fn spread(force: [Self; 3], out: &mut CornerForces, corner: usize, part: usize) {
        for i in 0..2 {
            out[2 * part + i][corner] = Force([force[0].0[i], force[1].0[i], force[2].0[i], 0.0]);
        }
    }
}

impl Lanes for f64 {
    type Row = Row;
    const SINGLE: bool = false;
    const COUNT: usize = 1;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn load(row: &Row, part: usize) -> Self {
        row.0[part]
    }
    #[inline(always)]
    fn store(self, row: &mut Row, part: usize) {
        row.0[part] = self;
    }
    #[inline(always)]
    fn load_double(rows: &[Row], part: usize) -> Self {
        Self::load(&rows[0], part)
    }
    #[inline(always)]
    fn store_double(self, rows: &mut [Row], part: usize) {
        self.store(&mut rows[0], part);
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
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
        let mantissa = f64::from_bits((bits & MANTISSA_BITS) | 1f64.to_bits());
        (mantissa, f64::from_bits((bits >> 52) | WHOLE.to_bits()) - (WHOLE + BIAS))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        f64::from_bits((self + (WHOLE + BIAS)).to_bits() << 52)
    }
    #[inline(always)]
    fn gather(rows: &[Row], [index, _]: Corner, part: usize) -> [Self; 8] {
        rows[index[part] as usize].0
    }
    #[inline(always)]
    fn spread(force: [Self; 3], out: &mut CornerForces, corner: usize, part: usize) {
        out[part][corner] = Force([force[0], force[1], force[2], 0.0]);
    }
}
