//! What Lanczos iterations for the largest eigenvalue λ of a symmetric matrix have in common: how many, from which start, and
//! what they have found.
//!
//! They find θ ≤ λ. From a start that is uniform on the sphere the chance that θ < (1 − ε) λ after k of them is at most
//!
//! ```text
//! 1.648 √n exp(−√ε (2k − 1))            (Kuczyński and Woźniakowski 1992, for n unknowns, whatever the spectrum)
//! ```
//!
//! No criterion that looks at what was found can promise as much: two iterations may agree because both have missed.

/// Iterations after which the chance of missing more than a part `missed` of the largest eigenvalue of so many unknowns is `chance`.
pub fn iterations(unknowns: u64, missed: f64, chance: f64) -> u64 {
    let wanted = libm::log(1.648 * (unknowns as f64).sqrt() / chance) / missed.sqrt();
    ((0.5 * (wanted + 1.0)).ceil() as u64).clamp(1, unknowns.max(1))
}

/// The largest eigenvalue of a symmetric tridiagonal matrix, from above by bisection with Sturm's sequence.
pub fn largest_eigenvalue(diagonal: &[f64], beside: &[f64]) -> f64 {
    let at = |i: usize| beside.get(i).copied().unwrap_or(0.0);
    let reach = |i: usize| at(i) + if i > 0 { at(i - 1) } else { 0.0 };
    let count = diagonal.len();
    // The last of `beside` leads out of the matrix.
    let inner = |i: usize| if i + 1 < count { at(i) } else { 0.0 };
    let (mut low, mut high) = (0.0f64, 0.0f64);
    for (i, d) in diagonal.iter().enumerate() {
        low = low.max(*d);
        high = high.max(d + reach(i));
    }
    let is_above = |x: f64| {
        let mut q = 1.0;
        (0..count).all(|i| {
            let square = if i > 0 { inner(i - 1) * inner(i - 1) / q } else { 0.0 };
            q = diagonal[i] - x - square;
            q < 0.0
        })
    };
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if is_above(middle) { high = middle } else { low = middle }
    }
    high
}

/// A number that looks drawn from a normal distribution and follows from a seed.
pub fn normal(seed: u64) -> f64 {
    let mut dice = Dice(seed);
    let (radius, angle) = (libm::sqrt(-2.0 * libm::log(dice.next())), std::f64::consts::TAU * dice.next());
    radius * libm::cos(angle)
}

/// Numbers that look random and follow from a seed, above 0 and below 1 (splitmix64: Steele, Lea and Flood 2014).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (((z ^ (z >> 31)) >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix with 2 on its diagonal and −1 beside it has the eigenvalues 2 − 2 cos(kπ/(n + 1)).
    #[test]
    fn the_largest_eigenvalue_of_a_chain() {
        for n in [1usize, 2, 5, 40] {
            let found = largest_eigenvalue(&vec![2.0; n], &vec![1.0; n]);
            let exact = 2.0 + 2.0 * (std::f64::consts::PI / (n as f64 + 1.0)).cos();
            assert!((found / exact - 1.0).abs() < 1e-12, "{n}: {found} is not {exact}");
        }
    }

    #[test]
    fn iterations_grow_with_the_logarithm_of_the_unknowns() {
        assert_eq!([1, 100, 10_000, 3_000_000].map(|n| iterations(n, 0.06, 1e-8)), [1, 44, 49, 55]);
    }
}
