//! Numbers as text in the manner of C's printf, which aprepro writes values with.

/// How a number is written: one conversion of printf, between other text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Format {
    before: String,
    after: String,
    left: bool,
    plus: bool,
    zeros: bool,
    width: usize,
    precision: Option<usize>,
    conversion: char,
}

/// Digits asked for at most; a double has 17.
const MOST_DIGITS: usize = 40;
/// Widths asked for at most.
const WIDEST: usize = 200;

impl Format {
    /// Reads a format such as `%.10g` or `%8.3f`; `None` if it is none for one number.
    pub fn read(text: &str) -> Option<Format> {
        let (before, rest) = text.split_once('%')?;
        let flags = rest.bytes().take_while(|b| b"-+0 #".contains(b)).count();
        let (flags, rest) = rest.split_at(flags);
        let (width, rest) = digits(rest);
        let (precision, rest) = match rest.strip_prefix('.') {
            Some(rest) => {
                let (precision, rest) = digits(rest);
                (Some(precision.unwrap_or(0)), rest)
            }
            None => (None, rest),
        };
        let conversion = rest.chars().next().filter(|c| "gGeEfFdi".contains(*c))?;
        let after = &rest[1..];
        let width = width.unwrap_or(0);
        let sensible = !after.contains('%') && width <= WIDEST && precision.is_none_or(|p| p <= MOST_DIGITS);
        sensible.then(|| Format {
            before: before.to_string(),
            after: after.to_string(),
            left: flags.contains('-'),
            plus: flags.contains('+'),
            zeros: flags.contains('0'),
            width,
            precision,
            conversion,
        })
    }

    /// A finite number in this format.
    pub fn write(&self, value: f64) -> String {
        let magnitude = value.abs();
        let precision = self.precision.unwrap_or(6);
        let digits = match self.conversion {
            'd' | 'i' => format!("{:.0}", magnitude.trunc()),
            'f' | 'F' => format!("{magnitude:.precision$}"),
            'e' | 'E' => scientific(magnitude, precision),
            _ => general(magnitude, precision.max(1)),
        };
        let digits = if self.conversion.is_uppercase() { digits.to_uppercase() } else { digits };
        let negative = value < 0.0 && digits.bytes().any(|b| (b'1'..=b'9').contains(&b));
        let sign = if negative {
            "-"
        } else if self.plus {
            "+"
        } else {
            ""
        };
        let room = self.width.saturating_sub(sign.len() + digits.len());
        let number = match (self.left, self.zeros) {
            (true, _) => format!("{sign}{digits}{}", " ".repeat(room)),
            (false, true) => format!("{sign}{}{digits}", "0".repeat(room)),
            (false, false) => format!("{}{sign}{digits}", " ".repeat(room)),
        };
        format!("{}{number}{}", self.before, self.after)
    }
}

fn digits(text: &str) -> (Option<usize>, &str) {
    let length = text.bytes().take_while(u8::is_ascii_digit).count();
    (text[..length].parse().ok(), &text[length..])
}

/// `1.5e+03`, with two digits of the exponent at least.
fn scientific(magnitude: f64, precision: usize) -> String {
    let text = format!("{magnitude:.precision$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, exponent) = exponent.strip_prefix('-').map_or(('+', exponent), |digits| ('-', digits));
    format!("{mantissa}e{sign}{exponent:0>2}")
}

/// The shorter of the two other forms for so many significant digits, without zeros at the end of a fraction.
fn general(magnitude: f64, significant: usize) -> String {
    let trimmed = |text: &str| match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => text.to_string(),
    };
    let text = scientific(magnitude, significant - 1);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let power: i32 = exponent.parse().unwrap_or(0);
    if power < -4 || power >= significant as i32 {
        return format!("{}e{exponent}", trimmed(mantissa));
    }
    trimmed(&format!("{magnitude:.*}", (significant as i32 - 1 - power).max(0) as usize))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(format: &str, value: f64) -> String {
        Format::read(format).expect("a format").write(value)
    }

    /// Expected texts are those of printf of the C library.
    #[test]
    fn numbers_are_written_as_printf_writes_them() {
        let general = [
            (0.0, "0"),
            (30e6, "30000000"),
            (3e10, "3e+10"),
            (1.0 / 3.0, "0.3333333333"),
            (-1e-4, "-0.0001"),
            (-1.25e-5, "-1.25e-05"),
            (9999999999.5, "1e+10"),
            (123456789.123, "123456789.1"),
            (1e100, "1e+100"),
            (5e-324, "4.940656458e-324"),
            (0.1, "0.1"),
        ];
        for (value, text) in general {
            assert_eq!(written("%.10g", value), text);
        }
        assert_eq!(written("%8.3f|", -2.0), "  -2.000|");
        assert_eq!(written("%-8.2e|", 12345.0), "1.23e+04|");
        assert_eq!(written("%05d", 42.7), "00042");
        assert_eq!(written("%+G", 1e-10), "+1E-10");
        assert_eq!(written("%.0f", -0.2), "0");
    }

    #[test]
    fn what_is_no_format_is_refused() {
        for text in ["", "10", "%s", "%.3g %g", "%", "%.100g", "%999g", "%x", "%5µ"] {
            assert_eq!(Format::read(text), None, "{text}");
        }
    }
}
