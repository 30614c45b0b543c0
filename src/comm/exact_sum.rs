//! Sums of numbers that do not depend on the order of the numbers, so that energies summed by elements and by ranks
//! have the same bits for every decomposition.
//!
//! The sum is kept exactly, as a fixed-point number wide enough for every double (Kulisch's long accumulator) in
//! the form of R. M. Neal, "Fast exact summation using small and large superaccumulators", arXiv:1505.05571:
//! digits of 32 bits in words of 64, so that carries need resolving only once in many additions.

use super::Communicator;

/// Words of the accumulator. Word `i` counts units of 2^(32 i − 1074); 2144 bits hold 2^64 of the largest doubles.
const WORDS: usize = 67;
/// Words sent to other ranks: the digits and the counts of NaN, +∞ and −∞.
const MESSAGE: usize = WORDS + 3;
/// Additions between two resolutions of carries: each adds less than 2^52 + 2^32 to a word that starts below 2^32.
const ADDITIONS: u32 = 1 << 10;

const FRACTION: u64 = (1 << 52) - 1;
const DIGIT: i64 = 0xffff_ffff;

/// A sum of doubles, exact whatever their magnitudes and order; only [`ExactSum::value`] rounds.
#[derive(Debug, Clone)]
pub struct ExactSum {
    words: [i64; WORDS],
    /// Additions that may still come before carries must be resolved.
    room: u32,
    nan: u64,
    positive_infinity: u64,
    negative_infinity: u64,
}

impl Default for ExactSum {
    fn default() -> Self {
        Self::new()
    }
}

impl ExactSum {
    /// The empty sum, zero.
    pub const fn new() -> Self {
        Self { words: [0; WORDS], room: ADDITIONS, nan: 0, positive_infinity: 0, negative_infinity: 0 }
    }

    /// Adds one number.
    #[inline]
    pub fn add(&mut self, x: f64) {
        let bits = x.to_bits();
        let exponent = (bits >> 52) as u32 & 0x7ff;
        if exponent == 0x7ff {
            return self.add_special(x);
        }
        // Subnormal numbers have the place of exponent 1 and no leading bit.
        let fraction = (bits & FRACTION) | u64::from(exponent != 0) << 52;
        let place = exponent.saturating_sub(1);
        let (word, shift) = ((place / 32) as usize, place % 32);
        let low = ((fraction << shift) & DIGIT as u64) as i64;
        let high = (fraction >> (32 - shift)) as i64;
        let sign = bits as i64 >> 63;
        self.words[word] += (low ^ sign) - sign;
        self.words[word + 1] += (high ^ sign) - sign;
        self.room -= 1;
        if self.room == 0 {
            self.resolve_carries();
        }
    }

    #[cold]
    fn add_special(&mut self, x: f64) {
        if x.is_nan() {
            self.nan += 1;
        } else if x > 0.0 {
            self.positive_infinity += 1;
        } else {
            self.negative_infinity += 1;
        }
    }

    /// Brings every word but the last, which bears the sign, into 0 ≤ word < 2^32.
    #[cold]
    fn resolve_carries(&mut self) {
        let mut carry = 0;
        for word in &mut self.words[..WORDS - 1] {
            let sum = *word + carry;
            *word = sum & DIGIT;
            carry = sum >> 32;
        }
        self.words[WORDS - 1] += carry;
        self.room = ADDITIONS;
    }

    /// Adds all that another sum holds.
    pub fn merge(&mut self, other: &Self) {
        let mut message = other.message();
        self.message().iter().zip(&mut message).for_each(|(mine, sum)| *sum = sum.wrapping_add(*mine));
        *self = Self::from_message(&message);
    }

    /// Replaces each rank's sums by their totals over all ranks, in one collective call.
    pub fn merge_ranks(sums: &mut [Self], communicator: &mut dyn Communicator) {
        let mut message: Vec<u64> = sums.iter().flat_map(Self::message).collect();
        communicator.all_sum(&mut message);
        sums.iter_mut().zip(message.chunks_exact(MESSAGE)).for_each(|(sum, part)| *sum = Self::from_message(part));
    }

    /// The sum as words whose wrapping sums over up to 2^31 ranks form the total's words.
    fn message(&self) -> [u64; MESSAGE] {
        let mut resolved = self.clone();
        resolved.resolve_carries();
        let mut message = [0; MESSAGE];
        message.iter_mut().zip(resolved.words).for_each(|(to, word)| *to = word as u64);
        message[WORDS..].copy_from_slice(&[self.nan, self.positive_infinity, self.negative_infinity]);
        message
    }

    fn from_message(message: &[u64]) -> Self {
        let mut sum = Self::new();
        sum.words.iter_mut().zip(message).for_each(|(word, from)| *word = *from as i64);
        [sum.nan, sum.positive_infinity, sum.negative_infinity] =
            [message[WORDS], message[WORDS + 1], message[WORDS + 2]];
        sum.resolve_carries();
        sum
    }

    /// The double nearest to the exact sum, ties to even; ±∞ beyond the largest double; +0 for a zero sum. NaN once
    /// a NaN or both infinities were added, otherwise the infinity that was.
    pub fn value(&self) -> f64 {
        match (self.nan, self.positive_infinity, self.negative_infinity) {
            (0, 0, 0) => self.finite_value(),
            (0, _, 0) => f64::INFINITY,
            (0, 0, _) => f64::NEG_INFINITY,
            _ => f64::NAN,
        }
    }

    fn finite_value(&self) -> f64 {
        let mut magnitude = self.clone();
        magnitude.resolve_carries();
        let negative = magnitude.words[WORDS - 1] < 0;
        if negative {
            magnitude.words.iter_mut().for_each(|word| *word = -*word);
            magnitude.resolve_carries();
        }
        let rounded = round(&magnitude.words);
        if negative { -rounded } else { rounded }
    }
}

/// The double nearest to a number whose words are its digits, all 0 ≤ word < 2^32 but the last, which is ≥ 0.
fn round(words: &[i64; WORDS]) -> f64 {
    let Some(top) = words.iter().rposition(|word| *word != 0) else { return 0.0 };
    let highest = 32 * top as u32 + words[top].ilog2();
    if highest < 53 {
        // A multiple of the smallest double, below 2^53: its integer is the double's pattern.
        return f64::from_bits(bits_from(words, 0));
    }
    if highest > 2097 {
        return f64::INFINITY;
    }
    let last = highest - 52;
    let significand = bits_from(words, last) & ((1 << 53) - 1);
    let half = bits_from(words, last - 1) & 1 == 1;
    let (word, shift) = (((last - 1) / 32) as usize, (last - 1) % 32);
    let beyond = words[word] & ((1 << shift) - 1) != 0 || words[..word].iter().any(|word| *word != 0);
    let up = half && (beyond || significand & 1 == 1);
    // A carry out of the significand moves on into the exponent, up to infinity, as it should.
    f64::from_bits((u64::from(last) << 52) + significand + u64::from(up))
}

/// The 64 bits of a number from bit `first` on.
fn bits_from(words: &[i64; WORDS], first: u32) -> u64 {
    let (word, shift) = ((first / 32) as usize, first % 32);
    let digit = |i: usize| words.get(i).map_or(0, |word| u128::from(*word as u64));
    ((digit(word) | digit(word + 1) << 32 | digit(word + 2) << 64) >> shift) as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::comm::run_threads;
    use proptest::prelude::*;

    fn sum(numbers: &[f64]) -> ExactSum {
        let mut sum = ExactSum::new();
        numbers.iter().for_each(|x| sum.add(*x));
        sum
    }

    /// Exact reference: Shewchuk's expansion (non-overlapping parts), rounded with care as Python's `math.fsum` is
    /// described to do. Valid while no intermediate overflows.
    fn expansion_sum(numbers: &[f64]) -> f64 {
        let mut parts: Vec<f64> = Vec::new();
        for &number in numbers {
            let (mut x, mut kept) = (number, 0);
            for i in 0..parts.len() {
                let (big, small) = if x.abs() < parts[i].abs() { (parts[i], x) } else { (x, parts[i]) };
                let high = big + small;
                let low = small - (high - big);
                if low != 0.0 {
                    parts[kept] = low;
                    kept += 1;
                }
                x = high;
            }
            parts.truncate(kept);
            parts.push(x);
        }
        let Some(mut high) = parts.pop() else { return 0.0 };
        let mut low = 0.0;
        while let Some(part) = parts.pop() {
            let before = high;
            high = before + part;
            low = part - (high - before);
            if low != 0.0 {
                break;
            }
        }
        // Half-way cases round by the sign of what lies below.
        if parts.last().is_some_and(|part| (low < 0.0 && *part < 0.0) || (low > 0.0 && *part > 0.0)) {
            let twice = 2.0 * low;
            let next = high + twice;
            if next - high == twice {
                high = next;
            }
        }
        high
    }

    /// Finite numbers of any exponent, subnormal ones included, whose sums of up to 200 do not overflow.
    fn wild() -> impl Strategy<Value = f64> {
        (any::<bool>(), 0u64..2030, any::<u64>())
            .prop_map(|(negative, e, f)| f64::from_bits(u64::from(negative) << 63 | e << 52 | (f & FRACTION)))
    }

    /// Numbers of nearby exponents with few bits: many ties and cancellations.
    fn tame() -> impl Strategy<Value = f64> {
        (-8i32..8, 0i32..110).prop_map(|(m, e)| f64::from(m) * 2f64.powi(e - 55))
    }

    proptest! {
        #[test]
        fn equals_the_expansion(numbers in prop::collection::vec(wild(), 0..200)) {
            prop_assert_eq!(sum(&numbers).value(), expansion_sum(&numbers));
        }

        #[test]
        fn rounds_ties_as_the_expansion(numbers in prop::collection::vec(tame(), 0..40)) {
            prop_assert_eq!(sum(&numbers).value(), expansion_sum(&numbers));
        }

        #[test]
        fn small_sums_are_integers(numbers in prop::collection::vec(-(1i64 << 60)..1 << 60, 0..100)) {
            let units: i128 = numbers.iter().map(|m| i128::from(*m >> 8)).sum();
            let numbers: Vec<_> = numbers.iter().map(|m| (m >> 8) as f64 * f64::from_bits(1)).collect();
            // An integer below 2^59 times the smallest double: exact as a quotient of doubles of 53 bits.
            let expected = (units as f64) * f64::from_bits(1);
            prop_assert_eq!(sum(&numbers).value(), expected);
        }

        #[test]
        fn any_order_and_parts_give_the_same_bits(
            numbers in prop::collection::vec(wild(), 1..100).prop_shuffle(),
            cut in any::<prop::sample::Index>(),
        ) {
            let (left, right) = numbers.split_at(cut.index(numbers.len()));
            let mut merged = sum(right);
            merged.merge(&sum(left));
            let mut sorted = numbers.clone();
            sorted.sort_by(f64::total_cmp);
            prop_assert_eq!(merged.value().to_bits(), sum(&sorted).value().to_bits());
        }
    }

    #[test]
    fn single_numbers_come_back() {
        for x in [1.0, -1.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, -5e-324, f64::from_bits(FRACTION), 1e-300] {
            assert_eq!(sum(&[x]).value(), x);
            assert_eq!(sum(&[x, 1e300, -1e300]).value(), x);
        }
        assert_eq!(sum(&[]).value().to_bits(), 0);
        assert_eq!(sum(&[-0.0]).value().to_bits(), 0);
        assert_eq!(sum(&[1.0, -1.0]).value().to_bits(), 0);
    }

    #[test]
    fn overflow_is_undone_or_infinite() {
        assert_eq!(sum(&[f64::MAX, f64::MAX, -f64::MAX]).value(), f64::MAX);
        assert_eq!(sum(&[f64::MAX, f64::MAX]).value(), f64::INFINITY);
        assert_eq!(sum(&[f64::MIN, f64::MIN]).value(), f64::NEG_INFINITY);
        // Half a unit in the last place decides.
        let half = 2f64.powi(970);
        assert_eq!(sum(&[f64::MAX, half]).value(), f64::INFINITY);
        assert_eq!(sum(&[f64::MAX, half, -5e-324]).value(), f64::MAX);
    }

    #[test]
    fn specials_poison_in_any_order() {
        let (inf, nan) = (f64::INFINITY, f64::NAN);
        assert_eq!(sum(&[1.0, inf, -2.0]).value(), inf);
        assert_eq!(sum(&[-inf, 1e308]).value(), -inf);
        assert!(sum(&[inf, -inf]).value().is_nan() && sum(&[-inf, inf]).value().is_nan());
        assert!(sum(&[nan, 1.0]).value().is_nan() && sum(&[inf, nan]).value().is_nan());
    }

    #[test]
    fn ten_million_additions() {
        // k summed over 0 … n−1, alternately scaled by 2^±40: n(n−2)/4 and n²/4 have the closed sums below.
        let n = 10_000_000u64;
        let mut sum = ExactSum::new();
        (0..n).for_each(|k| sum.add(k as f64 * if k % 2 == 0 { 2f64.powi(40) } else { -(2f64.powi(-40)) }));
        let (even, odd) = ((n / 2) * (n / 2 - 1), (n / 2) * (n / 2));
        sum.add(-(even as f64) * 2f64.powi(40));
        assert_eq!(sum.value(), -(odd as f64) * 2f64.powi(-40));
    }

    #[test]
    fn ranks_agree_on_the_bits_of_one() {
        let numbers: Vec<f64> = (0..1000).map(|i| f64::from(i * i - 300_000) * 1.1f64.powi(i % 97 - 48)).collect();
        let one = sum(&numbers).value().to_bits();
        for ranks in [1, 2, 3, 5, 8, 64] {
            let values = run_threads(ranks, |communicator| {
                let mine: Vec<f64> = numbers.iter().skip(communicator.rank()).step_by(ranks).copied().collect();
                let mut sums = [sum(&mine), ExactSum::new()];
                sums[1].add(if communicator.rank() == 0 { f64::NAN } else { 1.0 });
                ExactSum::merge_ranks(&mut sums, communicator);
                Ok::<_, ()>((sums[0].value().to_bits(), sums[1].value().is_nan()))
            });
            assert!(values.unwrap().iter().all(|value| *value == (one, true)));
        }
    }
}
