//! Numbers as FORTRAN writes them: `5`, `5.`, `.5`, `-1.2E-3`, `1.D-3`, `1.5+3`.

use nom::{
    IResult, Parser,
    branch::alt,
    character::complete::{char, digit0, digit1, one_of},
    combinator::{all_consuming, map, opt},
    sequence::preceded,
};

/// A numeric field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    /// The value; infinite when the exponent is too large for a double.
    pub value: f64,
    /// The value as an integer: whole numbers, and whole-valued reals up to 1E9 as in SUPES 2.
    pub integer: Option<i64>,
}

/// Longest numeric field of the SUPES reader; anything longer is a word.
const LONGEST: usize = 32;

/// Largest whole-valued real that also counts as an integer.
const LARGEST_WHOLE_REAL: f64 = 1e9;

/// Reads a field as a number; `None` when it is a word.
pub fn parse(text: &str) -> Option<Number> {
    if text.len() > LONGEST {
        return None;
    }
    let (_, parts) = all_consuming((opt(sign), digit0, opt(preceded(char('.'), digit0)), opt(exponent)))
        .parse_complete(text)
        .ok()?;
    let (sign, whole, fraction, exponent) = parts;
    if whole.is_empty() && fraction.unwrap_or("").is_empty() {
        return None;
    }
    let sign = sign.unwrap_or('+');
    let (exponent_sign, exponent_digits) = exponent.unwrap_or(('+', "0"));
    let digits = format!("{sign}{whole}.{}e{exponent_sign}{exponent_digits}", fraction.unwrap_or(""));
    let value: f64 = digits.parse().ok()?;
    let integer = if fraction.is_none() && exponent.is_none() {
        format!("{sign}{whole}").parse().ok()
    } else {
        (value.fract() == 0.0 && value.abs() <= LARGEST_WHOLE_REAL).then_some(value as i64)
    };
    Some(Number { value, integer })
}

/// Sign and digits of `E5`, `D-3`, or without letter as in `1.5+3`.
fn exponent(input: &str) -> IResult<&str, (char, &str)> {
    let lettered = preceded(one_of("EDed"), (opt(sign), digit1));
    let lettered = map(lettered, |(sign, digits)| (sign.unwrap_or('+'), digits));
    alt((lettered, (sign, digit1))).parse_complete(input)
}

fn sign(input: &str) -> IResult<&str, char> {
    one_of("+-").parse_complete(input)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Option<f64> {
        parse(text).map(|n| n.value)
    }

    #[test]
    fn fortran_forms() {
        assert_eq!(value("5"), Some(5.0));
        assert_eq!(value("5."), Some(5.0));
        assert_eq!(value(".5"), Some(0.5));
        assert_eq!(value("-1.2E-3"), Some(-1.2e-3));
        assert_eq!(value("1.D-3"), Some(1e-3));
        assert_eq!(value("1.5+3"), Some(1500.0));
        assert_eq!(value("1.5-3"), Some(1.5e-3));
        assert_eq!(value("+7"), Some(7.0));
        assert_eq!(value("1E999"), Some(f64::INFINITY));
    }

    #[test]
    fn words_are_not_numbers() {
        for word in
            ["", ".", "-", "E5", "D3", "1E", "1E+", "1.2.3", "12A", "INF", "NAN", "0x10", "1_000", "--5", "1E5.0"]
        {
            assert_eq!(value(word), None, "{word}");
        }
        assert_eq!(value(&"1".repeat(32)).map(|v| v > 1e31), Some(true));
        assert_eq!(value(&"1".repeat(33)), None);
    }

    #[test]
    fn whole_reals_are_integers_up_to_1e9() {
        let integer = |text: &str| parse(text).and_then(|n| n.integer);
        assert_eq!(integer("12.3E3"), Some(12300));
        assert_eq!(integer("2."), Some(2));
        assert_eq!(integer("2.5"), None);
        assert_eq!(integer("1E9"), Some(1_000_000_000));
        assert_eq!(integer("1E10"), None);
        assert_eq!(integer("9007199254740993"), Some(9007199254740993));
        assert_eq!(integer("99999999999999999999"), None);
    }
}
