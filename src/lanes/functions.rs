//! Exponential, logarithm and power of lanes, from sums, products and quotients alone: the same bits everywhere.

use super::Lanes;

/// ln 2 in two parts: the first has zeros in its last bits, so that its whole multiples are exact.
const LN2_HIGH: f64 = 0.693_147_180_369_123_8;
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Adding and taking off 1.5 · 2⁵² rounds to the nearest whole number.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// The same two parts and the rounding number for single precision, which has 24 bits.
const SINGLE_LN2: [f64; 2] = [0.693_359_375, -2.121_944_400_546_905_8e-4];
/// See [`SINGLE_LN2`].
const SINGLE_ROUNDING: f64 = 12_582_912.0;

/// 1/k! from k = 13 down to 2.
const FACTORIALS: [f64; 12] = [
    1.0 / 6_227_020_800.0,
    1.0 / 479_001_600.0,
    1.0 / 39_916_800.0,
    1.0 / 3_628_800.0,
    1.0 / 362_880.0,
    1.0 / 40_320.0,
    1.0 / 5_040.0,
    1.0 / 720.0,
    1.0 / 120.0,
    1.0 / 24.0,
    1.0 / 6.0,
    0.5,
];

/// eˣ, to two units in the last place. Arguments beyond ±708 are taken as ±708, where doubles end, in single precision beyond
/// ±87; NaN stays NaN.
///
/// x = n ln 2 + r with |r| ≤ ½ ln 2, and the series of eʳ, whose first term left out is 5e-18.
#[inline(always)]
pub fn exp<V: Lanes>(x: V) -> V {
    // In this order a NaN passes.
    let x = V::either(-708.0, -87.0).max(V::either(708.0, 87.0).min(x));
    let rounding = V::either(ROUNDING, SINGLE_ROUNDING);
    let n = (x * V::splat(std::f64::consts::LOG2_E) + rounding) - rounding;
    let r = (x - n * V::either(LN2_HIGH, SINGLE_LN2[0])) - n * V::either(LN2_LOW, SINGLE_LN2[1]);
    // From 1/7! on is enough for 24 bits: what is left out is 5e-9.
    let factorials = if V::SINGLE { &FACTORIALS[6..] } else { &FACTORIALS[..] };
    let mut sum = V::splat(factorials[0]);
    for factorial in &factorials[1..] {
        sum = sum * r + V::splat(*factorial);
    }
    (V::splat(1.0) + (r + r * r * sum)) * n.power_of_two()
}

/// 1/(2k + 1) from k = 11 down to 1.
const ODD: [f64; 11] = [
    1.0 / 23.0,
    1.0 / 21.0,
    1.0 / 19.0,
    1.0 / 17.0,
    1.0 / 15.0,
    1.0 / 13.0,
    1.0 / 11.0,
    1.0 / 9.0,
    1.0 / 7.0,
    1.0 / 5.0,
    1.0 / 3.0,
];

/// ln x, to two units in the last place. Numbers below the smallest normal one, 2e-308 or 1e-38, count as that; NaN and
/// infinity give NaN.
///
/// x = m 2ⁿ with √½ ≤ m < √2 and ln m = 2 artanh s, s = (m − 1)/(m + 1), |s| ≤ 0.172.
#[inline(always)]
pub fn ln<V: Lanes>(x: V) -> V {
    let one = V::splat(1.0);
    let (mantissa, exponent) = x.max(V::splat(V::TINY)).split_exponent();
    let half = V::splat(0.5);
    let root = V::splat(std::f64::consts::SQRT_2);
    let m = V::select_less(mantissa, root, mantissa, mantissa * half);
    let n = V::select_less(mantissa, root, exponent, exponent + one);
    let f = m - one;
    let s = f / (m + one);
    let square = s * s;
    // s¹⁰/11 is 2e-9.
    let odds = if V::SINGLE { &ODD[7..] } else { &ODD[..] };
    let mut sum = V::splat(odds[0]);
    for odd in &odds[1..] {
        sum = sum * square + V::splat(*odd);
    }
    // 2 s = f − s f keeps the digits of f.
    let tail = s * ((square + square) * sum - f);
    // The last term is 0, or NaN.
    let [high, low] = [V::either(LN2_HIGH, SINGLE_LN2[0]), V::either(LN2_LOW, SINGLE_LN2[1])];
    n * high + (f + (tail + n * low)) + x * V::splat(0.0)
}

/// ln(1 + x), to two units in the last place also where x is small: what 1 + x loses of x is added.
#[inline(always)]
pub fn ln_one_plus<V: Lanes>(x: V) -> V {
    let one = V::splat(1.0);
    let sum = one + x;
    ln(sum) + (x - (sum - one)) / sum.max(V::splat(V::TINY))
}

/// xᵖ of x ≥ 0 for a fixed p > 0; the relative error is about p ln x units in the last place. Zero stays zero as
/// far as p lets it: x counts as at least the smallest normal number.
#[inline(always)]
pub fn power<V: Lanes>(x: V, p: f64) -> V {
    exp(ln(x) * V::splat(p))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn units(x: f64, exact: f64) -> f64 {
        (x - exact).abs() / (exact.abs() * f64::EPSILON)
    }

    /// Against libm, itself good to one unit.
    #[test]
    fn exponential_and_logarithm_are_good_to_two_units() {
        let mut worst = [0.0f64; 2];
        for i in 0..200_000 {
            let t = f64::from(i) / 200_000.0;
            let x = -700.0 + 1400.0 * t;
            worst[0] = worst[0].max(units(exp(x), libm::exp(x)));
            let small = 2.0 * t - 1.0;
            worst[0] = worst[0].max(units(exp(small), libm::exp(small)));
            for y in [libm::exp(x), 0.5 + t, 1.0 + 1e-6 * t] {
                worst[1] = worst[1].max(if y == 1.0 { 0.0 } else { units(ln(y), libm::log(y)) });
            }
        }
        println!("exp {:.2}, ln {:.2} units in the last place", worst[0], worst[1]);
        assert!(worst[0] <= 3.0 && worst[1] <= 3.0, "{worst:?}");
        assert_eq!([exp(0.0), ln(1.0), exp(-1e9), exp(1e9)], [1.0, 0.0, exp(-708.0), exp(708.0)]);
        assert!(exp(f64::NAN).is_nan() && ln(f64::NAN).is_nan() && ln(f64::INFINITY).is_nan());
        assert!(ln(0.0) < -708.0 && ln(-1.0) < -708.0);
    }

    /// Down to strains that 1 + x does not see, in both precisions; the logarithm of 0 is the least there is.
    #[test]
    fn logarithm_of_one_and_little_keeps_its_digits() {
        for x in [1e-30, 1e-9, -3e-7, 1e-5, -0.01, 0.3, -0.9, 20.0] {
            let exact = libm::log1p(x);
            assert!((ln_one_plus(x) - exact).abs() <= 4.0 * f64::EPSILON * exact.abs(), "{x:e}");
            let single = x as f32;
            let exact = libm::log1p(f64::from(single));
            let found = f64::from(ln_one_plus(single));
            assert!((found - exact).abs() <= 4.0 * f64::from(f32::EPSILON) * exact.abs(), "{x:e}: {found:e}");
        }
        assert!(ln_one_plus(-1.0) < -708.0);
    }

    #[test]
    fn powers_of_small_and_large_numbers() {
        for x in [1e-100, 1e-12, 0.3, 1.0, 7.5, 1e12] {
            for p in [0.01, 0.26, 0.5, 1.0, 3.0] {
                let exact = libm::pow(x, p);
                assert!((power(x, p) - exact).abs() <= 1e-12 * exact, "{x} to {p}");
            }
        }
        assert!(power(0.0, 0.26) < 1e-79);
    }
}
