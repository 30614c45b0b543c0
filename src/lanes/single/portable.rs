//! Four numbers side by side, or a single one (for tests).

use super::{BIAS, MANTISSA_BITS, ROUNDING, UPPER_HALF, WHOLE};
use crate::lanes::{CHUNK, Corner, CornerForces, Force, Lanes, Numbers, Row, SingleRow};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Four lanes without a promise of vector instructions.
#[derive(Debug, Clone, Copy)]
pub struct Quad([f32; 4]);

macro_rules! lane_by_lane {
    ($($trait:ident $method:ident $op:tt),+) => { $(
        impl $trait for Quad {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self { Quad(array![i in 4 => self.0[i] $op other.0[i]]) }
        }
    )+ };
}
lane_by_lane!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Quad {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Quad(array![i in 4 => -self.0[i]])
    }
}

/// Local node of an element of a row.
#[inline(always)]
fn node(index: Corner, element: usize) -> usize {
    index[element / CHUNK][element % CHUNK] as usize
}

impl Lanes for Quad {
    type Row = SingleRow;
    const SINGLE: bool = true;
    const COUNT: usize = 4;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Quad([value as f32; 4])
    }
    #[inline(always)]
    fn load(row: &SingleRow, part: usize) -> Self {
        Quad(array![i in 4 => row.0[4 * part + i]])
    }
    #[inline(always)]
    fn store(self, row: &mut SingleRow, part: usize) {
        row.0[4 * part..4 * part + 4].copy_from_slice(&self.0);
    }
    #[inline(always)]
    fn load_double(rows: &[Row], part: usize) -> Self {
        let row = &rows[part / 2].0;
        Quad(array![i in 4 => row[part % 2 * 4 + i] as f32])
    }
    #[inline(always)]
    fn store_double(self, rows: &mut [Row], part: usize) {
        let row = &mut rows[part / 2].0;
        for i in 0..4 {
            row[part % 2 * 4 + i] = f64::from(self.0[i]);
        }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Quad(array![i in 4 => self.0[i].sqrt()])
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        Quad(array![i in 4 => if a.0[i] < b.0[i] { yes.0[i] } else { no.0[i] }])
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        (a.0[0] < b.0[0] || a.0[1] < b.0[1]) || (a.0[2] < b.0[2] || a.0[3] < b.0[3])
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        let all: [(f32, f32); 4] = array![i in 4 => self.0[i].split_exponent()];
        (Quad(array![i in 4 => all[i].0]), Quad(array![i in 4 => all[i].1]))
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Quad(array![i in 4 => self.0[i].power_of_two()])
    }
    #[inline(always)]
    fn halves(self) -> (Self, Self) {
        let all: [(f32, f32); 4] = array![i in 4 => self.0[i].halves()];
        (Quad(array![i in 4 => all[i].0]), Quad(array![i in 4 => all[i].1]))
    }
    #[inline(always)]
    fn of_halves(upper: Self, lower: Self) -> Self {
        Quad(array![i in 4 => f32::of_halves(upper.0[i], lower.0[i])])
    }
    #[inline(always)]
    fn gather(rows: &[Row], index: Corner, part: usize) -> [Self; 8] {
        array![c in 8 => Quad(array![i in 4 => rows[node(index, 4 * part + i)].0[c] as f32])]
    }
    #[inline(always)]
    fn gather_from(rows: &[Row], origin: Corner, index: Corner, part: usize) -> [Self; 8] {
        let own: [&Row; 4] = array![i in 4 => &rows[node(index, 4 * part + i)]];
        let first: [&Row; 4] = array![i in 4 => &rows[node(origin, 4 * part + i)]];
        array![c in 8 => Quad(array![i in 4 => (own[i].0[c] - first[i].0[c]) as f32])]
    }
    #[inline(always)]
    fn spread(force: [Self; 3], out: &mut CornerForces, corner: usize, part: usize) {
        for i in 0..4 {
            let [x, y, z] = [force[0].0[i], force[1].0[i], force[2].0[i]].map(f64::from);
            out[4 * part + i][corner] = Force([x, y, z, 0.0]);
        }
    }
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
    fn gather_from(rows: &[Row], origin: Corner, index: Corner, part: usize) -> [Self; 8] {
        let (own, first) = (&rows[node(index, part)], &rows[node(origin, part)]);
        array![c in 8 => (own.0[c] - first.0[c]) as f32]
    }
    #[inline(always)]
    fn spread(force: [Self; 3], out: &mut CornerForces, corner: usize, part: usize) {
        let [x, y, z] = force.map(f64::from);
        out[part][corner] = Force([x, y, z, 0.0]);
    }
}
