//! The vocabulary in which a law describes itself.

use super::equation_of_state::{DetonationPoint, EquationOfState};
use std::cell::Cell;
use std::ops::Index;
use std::sync::Arc;

/// Dimension of stresses and moduli.
pub(super) const STRESS: &str = "force/length^2";

/// One parameter of a law.
pub struct Property {
    /// Keyword in the deck, e.g. `YOUNGS MODULUS`.
    pub keyword: &'static str,
    /// Symbol in the manual, e.g. `E`.
    pub symbol: &'static str,
    /// Dimension in words, e.g. `force/length^2`.
    pub dimension: &'static str,
    /// Values that make sense.
    pub range: Range,
    /// Value when the deck does not give one; `None` means it must.
    pub default: Option<f64>,
    /// One sentence for the manual.
    pub meaning: &'static str,
}

impl Property {
    /// One that the deck must give.
    pub const fn required(
        keyword: &'static str,
        symbol: &'static str,
        dimension: &'static str,
        range: Range,
        meaning: &'static str,
    ) -> Property {
        Property { keyword, symbol, dimension, range, default: None, meaning }
    }

    /// The same with a default.
    pub const fn or(self, default: f64) -> Property {
        Property { default: Some(default), ..self }
    }
}

/// The values a number may take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// > 0
    Positive,
    /// ≥ 0
    NotNegative,
    /// The number of a function of the deck.
    Function,
    /// Between two bounds; each says whether it is included.
    Between {
        /// Lower bound and whether it belongs to the range.
        low: (f64, bool),
        /// Upper bound and whether it belongs to the range.
        high: (f64, bool),
    },
}

impl Range {
    /// Whether a value lies in the range; NaN and infinities never do.
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Range::Any => true,
                Range::Positive => value > 0.0,
                Range::NotNegative => value >= 0.0,
                Range::Function => value >= 1.0 && value.trunc() == value,
                Range::Between { low, high } => {
                    (value > low.0 || (low.1 && value == low.0)) && (value < high.0 || (high.1 && value == high.0))
                }
            }
    }
}

impl std::fmt::Display for Range {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Range::Any => write!(f, "any number"),
            Range::Positive => write!(f, "greater than 0"),
            Range::NotNegative => write!(f, "0 or more"),
            Range::Function => write!(f, "the number of a function"),
            Range::Between { low, high } => write!(
                f,
                "from {}{} to {}{}",
                low.0,
                if low.1 { "" } else { " (excluded)" },
                high.0,
                if high.1 { "" } else { " (excluded)" }
            ),
        }
    }
}

/// One state variable of a law, stored per element.
pub struct StateVariable {
    /// Name in the plot file, at most 8 characters, upper case.
    pub name: &'static str,
    /// One sentence for the manual.
    pub meaning: &'static str,
}

/// Where the spelling of a command or property comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// Seen in a genuine deck or print file.
    Verified,
    /// Remembered from the manuals, not seen.
    Recalled,
    /// Our own addition.
    Ours,
}

/// A function of the deck as a law uses it: piecewise linear, through points with increasing arguments.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The function's number.
    pub id: i64,
    /// Points, at least one.
    pub points: Arc<[(f64, f64)]>,
}

/// What a deck gives a law, or another thing with properties: values by position, and more.
pub struct Given<'a> {
    /// Parameter values in the order of the entry's properties.
    pub values: &'a [f64],
    /// Initial mass density.
    pub density: f64,
    /// Finds the points of a function by its number.
    pub function: &'a dyn Fn(i64) -> Option<Vec<(f64, f64)>>,
    /// Equation of state, if there is one.
    pub equation: Option<EquationOfState>,
    /// Whether the law asked for it.
    pub equation_wanted: Cell<bool>,
    /// Where explosives are lit.
    pub detonation: &'a [DetonationPoint],
}

impl Index<usize> for Given<'_> {
    type Output = f64;
    fn index(&self, property: usize) -> &f64 {
        &self.values[property]
    }
}

impl Given<'_> {
    /// Values and density alone, for what is made without a deck or needs no more.
    pub fn new(values: &[f64], density: f64) -> Given<'_> {
        let equation_wanted = Cell::new(false);
        Given { values, density, function: &|_| None, equation: None, equation_wanted, detonation: &[] }
    }

    /// The equation of state, for a law that cannot do without.
    pub fn equation_of_state(&self) -> Result<EquationOfState, Refusal> {
        self.equation_wanted.set(true);
        let reason = "is missing; it is a group of its own with the number of the block".to_string();
        self.equation.ok_or(Refusal { keyword: "EQUATION OF STATE", reason })
    }

    /// The function that the property at a position names.
    pub fn curve(&self, property: usize, keyword: &'static str) -> Result<Curve, Refusal> {
        let id = self.values[property];
        let refusal = |reason: String| Refusal { keyword, reason };
        if id != id.trunc() || id < 1.0 {
            return Err(refusal(format!("is {id}, but must be the number of a function")));
        }
        let points =
            (self.function)(id as i64).ok_or_else(|| refusal(format!("is {id}, but there is no FUNCTION {id}")))?;
        Ok(Curve { id: id as i64, points: points.into() })
    }
}

/// Why parameter values that are each in range do not make a law together.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    /// Keyword of the property to blame.
    pub keyword: &'static str,
    /// What is wrong with it, as the end of a sentence that begins with the keyword.
    pub reason: String,
}
