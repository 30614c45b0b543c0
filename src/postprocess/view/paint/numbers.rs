//! Numbers for people: round steps on a scale, and few digits.

/// Round numbers (steps of 1, 2 or 5 times a power of ten) from `low` to `high`, about `wanted` of them, each with
/// its text. All texts of a scale have the same form.
pub fn ticks(low: f64, high: f64, wanted: usize) -> Vec<(f64, String)> {
    let rough = (high - low) / wanted.max(1) as f64;
    if !(rough.is_finite() && rough > 0.0) {
        return Vec::new();
    }
    let power = rough.log10().floor() as i32;
    let digit = [1.0, 2.0, 5.0].into_iter().find(|digit| digit * 10f64.powi(power) >= 0.7 * rough);
    let (digit, power) = digit.map_or((1.0, power + 1), |digit| (digit, power));
    // Dividing by a power of ten is exact where multiplying by 0.001 is not.
    let value = |n: i64| match power {
        0.. => n as f64 * digit * 10f64.powi(power),
        _ => n as f64 * digit / 10f64.powi(-power),
    };
    let step = value(1);
    // Counting is useless when the step is lost beside the value.
    if low.abs().max(high.abs()) / step > 1e9 {
        return Vec::new();
    }
    let hair = 1e-9;
    let (first, last) = ((low / step - hair).ceil() as i64, (high / step + hair).floor() as i64);
    let form = Form::of(low.abs().max(high.abs()), power);
    (first..=last).map(|n| (value(n), form.text(value(n)))).collect()
}

/// A number with four significant digits, as `12.34` or `1.234E-05`.
pub fn number(value: f64) -> String {
    rounded(value, 4)
}

/// A number with so many significant digits.
pub fn rounded(value: f64, digits: i32) -> String {
    let power = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    Form::of(value.abs(), power + 1 - digits).text(value)
}

enum Form {
    /// Digits after the point.
    Fixed(usize),
    /// Digits after the point of the mantissa.
    Scientific(usize),
}

impl Form {
    /// How to write numbers up to `largest` whose last digit of interest counts 10 to the `last`.
    fn of(largest: f64, last: i32) -> Form {
        if largest == 0.0 {
            return Form::Fixed(0);
        }
        let power = largest.log10().floor() as i32;
        if (-3..5).contains(&power) {
            Form::Fixed(last.min(0).unsigned_abs() as usize)
        } else {
            Form::Scientific((power - last).max(0) as usize)
        }
    }

    fn text(&self, value: f64) -> String {
        // Zero has no sign and, beside numbers with exponents, needs none.
        match self {
            Form::Scientific(_) if value == 0.0 => "0".to_owned(),
            Form::Fixed(digits) => format!("{:.digits$}", value + 0.0).replace('-', "−"),
            Form::Scientific(digits) => {
                let text = format!("{value:.digits$e}");
                let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
                let (sign, power) = power.strip_prefix('-').map_or(("+", power), |power| ("−", power));
                format!("{}E{sign}{power:0>2}", mantissa.replace('-', "−"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(low: f64, high: f64) -> Vec<String> {
        ticks(low, high, 5).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn scales_have_round_steps() {
        assert_eq!(texts(0.0, 2.37), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert_eq!(texts(-310.0, 560.0), ["−200", "0", "200", "400"]);
        assert_eq!(texts(0.0, 3.1e8), ["0", "5.0E+07", "1.0E+08", "1.5E+08", "2.0E+08", "2.5E+08", "3.0E+08"]);
        assert_eq!(texts(1.2e-7, 1.6e-7), ["1.2E−07", "1.3E−07", "1.4E−07", "1.5E−07", "1.6E−07"]);
        assert!(texts(1.0, 1.0).is_empty() && texts(0.0, f64::INFINITY).is_empty());
        assert!(texts(1.0, 1.0 + 1e-14).is_empty());
    }

    #[test]
    fn numbers_have_four_digits() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(21.4378), "21.44");
        assert_eq!(number(-227.0), "−227.0");
        assert_eq!(number(8.0e-5), "8.000E−05");
        assert_eq!(number(-2.5e11), "−2.500E+11");
    }
}
