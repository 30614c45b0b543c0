//! Reductions whose result does not depend on the order in which ranks take part.

/// An integer that sorts as the number does: −∞ < … < −0 < +0 < … < +∞, and every NaN below them all. The minimum
/// of keys is exact and the same in any order, which `f64::min` and `MPI_MIN` do not promise for NaN and zeros.
pub(crate) fn key(value: f64) -> u64 {
    if value.is_nan() {
        return 0;
    }
    let bits = value.to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}

/// The number of a [`key`]; all NaNs come back as one.
pub(crate) fn number(key: u64) -> f64 {
    match key {
        0 => f64::NAN,
        key if key >> 63 == 1 => f64::from_bits(key & !(1 << 63)),
        key => f64::from_bits(!key),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_sort_as_numbers_with_nan_first() {
        let sorted = [
            f64::NEG_INFINITY,
            f64::MIN,
            -1.0,
            -5e-324,
            -0.0,
            0.0,
            5e-324,
            f64::MIN_POSITIVE,
            1.0,
            f64::MAX,
            f64::INFINITY,
        ];
        assert!(key(f64::NAN) < key(sorted[0]) && key(-f64::NAN) < key(sorted[0]));
        assert!(sorted.windows(2).all(|pair| key(pair[0]) < key(pair[1])));
        assert!(sorted.iter().all(|x| number(key(*x)).to_bits() == x.to_bits()));
        assert!(number(key(-f64::NAN)).is_nan());
    }
}
