//! The vocabulary in which a law describes itself.

use super::equation_of_state::{DetonationPoint, EquationOfState};
use std::cell::{Cell, RefCell};
use std::sync::Arc;

/// Dimension of stresses and moduli.
pub(super) const STRESS: &str = "force/length^2";

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
    /// What the law warns of.
    pub cautions: RefCell<Vec<Caution>>,
}

impl Given<'_> {
    /// Values and density alone, for what is made without a deck or needs no more.
    pub fn new(values: &[f64], density: f64) -> Given<'_> {
        let (equation_wanted, cautions) = (Cell::new(false), RefCell::new(Vec::new()));
        Given { values, density, function: &|_| None, equation: None, equation_wanted, detonation: &[], cautions }
    }

    /// Warns of a value: the reason is the end of a sentence that begins with the keyword.
    pub fn warn(&self, keyword: &'static str, reason: String, help: &str) {
        self.cautions.borrow_mut().push(Caution { keyword, reason, help: help.to_owned() });
    }

    /// The equation of state, for a law that cannot do without.
    ///
    /// # Errors
    ///
    /// The deck gives the block none.
    pub fn equation_of_state(&self) -> Result<EquationOfState, Refusal> {
        self.equation_wanted.set(true);
        let reason = "is missing; it is a group of its own with the number of the block".to_string();
        self.equation.ok_or(Refusal { keyword: "EQUATION OF STATE", reason })
    }

    /// The function that the property at a position names.
    ///
    /// # Errors
    ///
    /// The value is not the number of a function, or there is no such function.
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

/// Why parameter values that do make a law may not make the one that is meant.
#[derive(Debug, Clone, PartialEq)]
pub struct Caution {
    /// Keyword of the property to look at.
    pub keyword: &'static str,
    /// What is odd about it, as the end of a sentence that begins with the keyword.
    pub reason: String,
    /// What follows from it, or what to try.
    pub help: String,
}

/// Why parameter values that are each in range do not make a law together.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    /// Keyword of the property to blame.
    pub keyword: &'static str,
    /// What is wrong with it, as the end of a sentence that begins with the keyword.
    pub reason: String,
}
