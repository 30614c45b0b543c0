//! Numbers as text, in the tables of the print log and wherever else columns of them line up.

/// A number in five significant digits, as the tables show it.
pub fn number(value: f64) -> String {
    scientific(value, 4)
}

/// A number with its exponent in two digits and a sign, as Fortran prints it: columns of them line up.
pub fn scientific(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$e}");
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    match exponent.strip_prefix('-') {
        Some(digits) => format!("{mantissa}e-{digits:0>2}"),
        None => format!("{mantissa}e+{exponent:0>2}"),
    }
}

#[cfg(test)]
mod tests {
    use super::scientific;

    #[test]
    fn exponents_have_a_sign_and_two_digits() {
        assert_eq!(scientific(0.0, 4), "0.0000e+00");
        assert_eq!(scientific(-1.5e-5, 1), "-1.5e-05");
        assert_eq!(scientific(2.0e123, 2), "2.00e+123");
        assert_eq!(scientific(f64::NAN, 2), "NaN");
    }
}
