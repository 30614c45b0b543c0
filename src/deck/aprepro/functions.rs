//! The functions that expressions can call.

use std::f64::consts::PI;

use super::Value;

/// What a function does with its arguments.
#[derive(Clone, Copy)]
pub(super) enum Body {
    /// A number from one.
    One(fn(f64) -> f64),
    /// A number from two.
    Two(fn(f64, f64) -> f64),
    /// A number from four.
    Four(fn(f64, f64, f64, f64) -> f64),
    /// A number from one or more, from left to right.
    Several(fn(f64, f64) -> f64),
    /// A text from a text.
    Words(fn(&str) -> String),
    /// The number of words in a text, given what separates them.
    WordCount,
    /// A word of a text: which, of what, and what separates them.
    Word,
    /// A number as text, as it is printed.
    ToText,
    /// The number that a text spells.
    ToNumber,
    /// A number as text in a format: which number, and how.
    Formatted,
    /// Ends with a message of the deck's writer.
    Error,
}

impl Body {
    /// How many arguments it takes, in words, and whether this many will do.
    pub fn arity(self, given: usize) -> (&'static str, bool) {
        match self {
            Body::Two(_) | Body::WordCount | Body::Formatted => ("two arguments", given == 2),
            Body::Word => ("three arguments", given == 3),
            Body::Four(_) => ("four arguments", given == 4),
            Body::Several(_) => ("one argument or more", given > 0),
            _ => ("one argument", given == 1),
        }
    }
}

/// Functions by name.
pub(super) const FUNCTIONS: &[(&str, Body)] = &[
    ("abs", Body::One(f64::abs)),
    ("acos", Body::One(libm::acos)),
    ("acosd", Body::One(|x| degrees(libm::acos(x)))),
    ("acosh", Body::One(libm::acosh)),
    ("asin", Body::One(libm::asin)),
    ("asind", Body::One(|x| degrees(libm::asin(x)))),
    ("asinh", Body::One(libm::asinh)),
    ("atan", Body::One(libm::atan)),
    ("atan2", Body::Two(libm::atan2)),
    ("atan2d", Body::Two(|y, x| degrees(libm::atan2(y, x)))),
    ("atand", Body::One(|x| degrees(libm::atan(x)))),
    ("atanh", Body::One(libm::atanh)),
    ("cbrt", Body::One(libm::cbrt)),
    ("ceil", Body::One(f64::ceil)),
    ("cos", Body::One(libm::cos)),
    ("cosd", Body::One(|x| sine_of_degrees(x + 90.0))),
    ("cosh", Body::One(libm::cosh)),
    ("d2r", Body::One(radians)),
    ("dim", Body::Two(|x, y| x - x.min(y))),
    ("dist", Body::Four(|x1, y1, x2, y2| libm::hypot(x1 - x2, y1 - y2))),
    ("exp", Body::One(libm::exp)),
    ("expm1", Body::One(libm::expm1)),
    ("floor", Body::One(f64::floor)),
    ("fmod", Body::Two(|x, y| x % y)),
    ("hypot", Body::Two(libm::hypot)),
    ("int", Body::One(f64::trunc)),
    ("lgamma", Body::One(libm::lgamma)),
    ("ln", Body::One(libm::log)),
    ("log", Body::One(libm::log)),
    ("log10", Body::One(libm::log10)),
    ("log1p", Body::One(libm::log1p)),
    ("max", Body::Several(f64::max)),
    ("min", Body::Several(f64::min)),
    ("nint", Body::One(|x| if x < 0.0 { -(0.5 - x).floor() } else { (x + 0.5).floor() })),
    ("polarX", Body::Two(|r, a| r * sine_of_degrees(a + 90.0))),
    ("polarY", Body::Two(|r, a| r * sine_of_degrees(a))),
    ("pow", Body::Two(libm::pow)),
    ("r2d", Body::One(degrees)),
    ("sign", Body::Two(|x, y| if y < 0.0 { -x.abs() } else { x.abs() })),
    ("sin", Body::One(libm::sin)),
    ("sind", Body::One(sine_of_degrees)),
    ("sinh", Body::One(libm::sinh)),
    ("sqrt", Body::One(f64::sqrt)),
    ("tan", Body::One(libm::tan)),
    ("tand", Body::One(|x| sine_of_degrees(x) / sine_of_degrees(x + 90.0))),
    ("tanh", Body::One(libm::tanh)),
    ("tgamma", Body::One(libm::tgamma)),
    ("Vangle", Body::Four(angle)),
    ("Vangled", Body::Four(|x1, y1, x2, y2| degrees(angle(x1, y1, x2, y2)))),
    ("error", Body::Error),
    ("format", Body::Formatted),
    ("get_word", Body::Word),
    ("strtod", Body::ToNumber),
    ("tolower", Body::Words(str::to_lowercase)),
    ("tostring", Body::ToText),
    ("toupper", Body::Words(str::to_uppercase)),
    ("word_count", Body::WordCount),
];

/// Functions of aprepro that are refused, and why.
pub(super) const REFUSED: &[(&str, &str)] = &[
    ("execute", "text is not evaluated a second time"),
    ("rescan", "text is not evaluated a second time"),
    ("getenv", "a deck must mean the same everywhere"),
    ("rand", "a deck must mean the same in every run"),
    ("rand_normal", "a deck must mean the same in every run"),
    ("srand", "a deck must mean the same in every run"),
    ("Units", "unit systems are not supported; set the factors that you need"),
    ("make_array", "arrays are not supported"),
    ("import", "use include"),
    ("output", "a deck writes no files"),
];

/// Names that have a value before anybody gives them one.
pub(super) const CONSTANTS: &[(&str, f64)] = &[
    ("PI", PI),
    ("PI_2", PI / 2.0),
    ("E", std::f64::consts::E),
    ("DEG", 180.0 / PI),
    ("RAD", PI / 180.0),
    ("SQRT2", std::f64::consts::SQRT_2),
    ("GAMMA", 0.577_215_664_901_532_9),
    ("PHI", 1.618_033_988_749_895),
    ("TRUE", 1.0),
    ("FALSE", 0.0),
];

fn degrees(radians: f64) -> f64 {
    radians * 180.0 / PI
}

fn radians(degrees: f64) -> f64 {
    degrees * PI / 180.0
}

/// Exact where the sine is 0, a half, or 1: a right angle in a deck is a right angle.
fn sine_of_degrees(angle: f64) -> f64 {
    let turned = angle % 360.0;
    let (angle, sign) = if turned < 0.0 { (-turned, -1.0) } else { (turned, 1.0) };
    let (angle, sign) = if angle >= 180.0 { (angle - 180.0, -sign) } else { (angle, sign) };
    let angle = if angle > 90.0 { 180.0 - angle } else { angle };
    sign * match angle {
        0.0 => 0.0,
        30.0 => 0.5,
        90.0 => 1.0,
        _ => libm::sin(radians(angle)),
    }
}

/// The angle between two vectors of the plane.
fn angle(x1: f64, y1: f64, x2: f64, y2: f64) -> f64 {
    libm::atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2).abs()
}

/// Words of a text between any of the separating characters.
pub(super) fn words<'t>(text: &'t str, separators: &'t str) -> impl Iterator<Item = &'t str> {
    text.split(|c: char| separators.contains(c)).filter(|word| !word.is_empty())
}

/// What a value is, for messages.
pub(super) fn kind(value: &Value) -> &'static str {
    match value {
        Value::Number(_) => "a number",
        Value::Text(_) => "text",
        Value::Unknown => "unknown",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_angles_are_right() {
        let angles = [(0.0, 0.0), (30.0, 0.5), (90.0, 1.0), (180.0, 0.0), (270.0, -1.0), (-90.0, -1.0), (450.0, 1.0)];
        for (angle, sine) in angles {
            assert_eq!(sine_of_degrees(angle), sine, "{angle}");
        }
        // And elsewhere as the sine of the angle in radians, to round-off of the reduction.
        for i in -100..100 {
            let angle = 7.3 * f64::from(i);
            assert!((sine_of_degrees(angle) - libm::sin(radians(angle))).abs() < 1e-14, "{angle}");
        }
    }

    #[test]
    fn names_are_given_once() {
        let names: Vec<&str> = FUNCTIONS
            .iter()
            .map(|f| f.0)
            .chain(REFUSED.iter().map(|r| r.0))
            .chain(CONSTANTS.iter().map(|c| c.0))
            .collect();
        let mut once = names.clone();
        once.sort_unstable();
        once.dedup();
        assert_eq!(once.len(), names.len());
    }
}
