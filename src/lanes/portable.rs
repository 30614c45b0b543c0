//! Lanes on any machine: a single number (for tests and set-up), or two of whatever lanes side by side.

use super::{BIAS, CHUNK, Corner, CornerForces, DoubleLanes, Force, Lanes, MANTISSA_BITS, Row, WHOLE};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Two lanes of either precision without a promise of vector instructions, for processors of which nothing is known; compilers find
/// registers of 128 bits there, which are a pair in double precision and a pair of pairs in single. More would not run faster, and
/// take long to compile.
#[derive(Debug, Clone, Copy)]
pub struct Pair<T>([T; 2]);

macro_rules! lane_by_lane {
    ($($trait:ident $method:ident $op:tt),+) => { $(
        impl<T: Lanes> $trait for Pair<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self { Pair([self.0[0] $op other.0[0], self.0[1] $op other.0[1]]) }
        }
    )+ };
}
lane_by_lane!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<T: Lanes> Neg for Pair<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Pair([-self.0[0], -self.0[1]])
    }
}

impl<T: Lanes> Pair<T> {
    /// What a function of a lane gives for both, taken apart.
    #[inline(always)]
    fn both(self, function: impl Fn(T) -> (T, T)) -> (Self, Self) {
        let [(first, other_first), (second, other_second)] = [function(self.0[0]), function(self.0[1])];
        (Pair([first, second]), Pair([other_first, other_second]))
    }
}

impl<T: Lanes> Lanes for Pair<T> {
    type Row = T::Row;
    type Double = Pair<T::Double>;
    const SINGLE: bool = T::SINGLE;
    const COUNT: usize = 2 * T::COUNT;
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Pair([T::splat(value); 2])
    }
    #[inline(always)]
    fn load(row: &T::Row, part: usize) -> Self {
        Pair([T::load(row, 2 * part), T::load(row, 2 * part + 1)])
    }
    #[inline(always)]
    fn store(self, row: &mut T::Row, part: usize) {
        self.0[0].store(row, 2 * part);
        self.0[1].store(row, 2 * part + 1);
    }
    #[inline(always)]
    fn widened(self, piece: usize) -> Self::Double {
        // Two of one piece make one of both; those of two have their pieces one after the other.
        let [first, second] = self.0;
        if T::PIECES == 1 {
            return Pair([first.widened(0), second.widened(0)]);
        }
        let one = if piece == 0 { first } else { second };
        Pair([one.widened(0), one.widened(1)])
    }
    #[inline(always)]
    fn rounded([first, second]: [Self::Double; 2]) -> Self {
        if T::PIECES == 1 {
            return Pair([T::rounded([first.0[0]; 2]), T::rounded([first.0[1]; 2])]);
        }
        Pair([T::rounded(first.0), T::rounded(second.0)])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Pair([self.0[0].sqrt(), self.0[1].sqrt()])
    }
    #[inline(always)]
    fn select_less(a: Self, b: Self, yes: Self, no: Self) -> Self {
        Pair([T::select_less(a.0[0], b.0[0], yes.0[0], no.0[0]), T::select_less(a.0[1], b.0[1], yes.0[1], no.0[1])])
    }
    #[inline(always)]
    fn any_less(a: Self, b: Self) -> bool {
        T::any_less(a.0[0], b.0[0]) || T::any_less(a.0[1], b.0[1])
    }
    #[inline(always)]
    fn split_exponent(self) -> (Self, Self) {
        self.both(T::split_exponent)
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        Pair([self.0[0].power_of_two(), self.0[1].power_of_two()])
    }
    #[inline(always)]
    fn halves(self) -> (Self, Self) {
        self.both(T::halves)
    }
    #[inline(always)]
    fn of_halves(upper: Self, lower: Self) -> Self {
        Pair([T::of_halves(upper.0[0], lower.0[0]), T::of_halves(upper.0[1], lower.0[1])])
    }
}

impl<T: DoubleLanes> DoubleLanes for Pair<T> {
    #[inline(always)]
    fn gather(rows: &[Row], index: Corner, piece: usize) -> [Self; 8] {
        let [first, second] = [T::gather(rows, index, 2 * piece), T::gather(rows, index, 2 * piece + 1)];
        array![c in 8 => Pair([first[c], second[c]])]
    }
    #[inline(always)]
    fn spread(force: [Self; 4], out: &mut CornerForces, corner: usize, piece: usize) {
        T::spread(array![i in 4 => force[i].0[0]], out, corner, 2 * piece);
        T::spread(array![i in 4 => force[i].0[1]], out, corner, 2 * piece + 1);
    }
}

impl Lanes for f64 {
    type Row = Row;
    type Double = Self;
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
    fn widened(self, _piece: usize) -> Self {
        self
    }
    #[inline(always)]
    fn rounded([all, _]: [Self; 2]) -> Self {
        all
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
}

impl DoubleLanes for f64 {
    #[inline(always)]
    fn gather(rows: &[Row], index: Corner, piece: usize) -> [Self; 8] {
        rows[index[piece / CHUNK][piece % CHUNK] as usize].0
    }
    #[inline(always)]
    fn spread(force: [Self; 4], out: &mut CornerForces, corner: usize, piece: usize) {
        out[piece][corner] = Force(force);
    }
}
