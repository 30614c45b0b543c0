//! The value of an expression's tree, and the names that have values.

use crate::deck::definitions::Definitions;
use std::collections::BTreeMap;
use std::sync::Arc;

use super::{
    Fault, Value,
    expr::{Kind, Node},
    format::Format,
    functions::{self, Body, CONSTANTS, FUNCTIONS, REFUSED},
};
use crate::deck::{text::source::Span, text::spelling};

/// The format that numbers are printed in unless `_FORMAT` says otherwise.
const FORMAT: &str = "%.10g";
/// Letters of a text at most, so that doubling it does not fill the memory.
const LONGEST: usize = 100_000;

/// Names and their values.
#[derive(Debug, Clone)]
pub(super) struct Names {
    values: BTreeMap<String, Value>,
    /// Values from the command line, which stand for those of assignments.
    given: Option<Arc<Definitions>>,
    /// Whether `E` is still the base of logarithms.
    own_e: bool,
    /// Where that was used first.
    pub used_e: Option<Span>,
}

impl Names {
    /// The names that need no definition.
    pub fn new() -> Names {
        let constants = CONSTANTS.iter().map(|&(name, value)| (name.to_string(), Value::Number(value)));
        let mut values: BTreeMap<String, Value> = constants.collect();
        values.insert("_FORMAT".into(), Value::Text(FORMAT.into()));
        values.insert("_C_".into(), Value::Text("$".into()));
        Names { values, given: None, own_e: true, used_e: None }
    }

    /// Gives a name a value.
    pub fn set(&mut self, name: &str, value: Value) {
        self.own_e &= name != "E";
        self.values.insert(name.to_string(), value);
    }

    /// The value of a name.
    pub fn get(&self, name: &str) -> Option<&Value> {
        if let Some(given) = &self.given {
            given.take(name);
        }
        self.values.get(name)
    }

    /// Takes values from the command line: names have them from the start, and keep them when they are assigned to.
    pub fn give(&mut self, given: &Arc<Definitions>) {
        for (name, value) in given.values() {
            self.set(name, value.into());
        }
        self.given = Some(given.clone());
    }

    /// The value that stands for that of any assignment to a name.
    fn instead(&self, name: &str) -> Option<Value> {
        self.given.as_ref()?.take(name).map(Value::from)
    }

    /// A number as it is printed, or what is wrong with the format.
    ///
    /// # Errors
    ///
    /// The format is none for numbers.
    pub fn printed(&self, number: f64, place: Span) -> Result<String, Fault> {
        let format = match self.get("_FORMAT") {
            Some(Value::Text(text)) => text.clone(),
            Some(Value::Unknown) => return Err(Fault::Consequence),
            _ => String::new(),
        };
        formatted(number, &format, place)
    }

    /// The value of a tree.
    ///
    /// # Errors
    ///
    /// A name without a value, a function that does not exist, or an operation that its operands do not allow.
    pub fn value(&mut self, node: &Node) -> Result<Value, Fault> {
        match &node.kind {
            Kind::Number(value) => Ok(Value::Number(*value)),
            Kind::Text(text) => Ok(Value::Text(text.clone())),
            Kind::Name(name) => self.named(name, node.span),
            Kind::Unary(sign, inner) => {
                let value = self.number(inner)?;
                Ok(Value::Number(match *sign {
                    "-" => -value,
                    "!" => truth(value == 0.0),
                    _ => value,
                }))
            }
            Kind::Chain(first, links) => self.chain(first, links),
            Kind::Choice(parts) => {
                let [condition, yes, no] = &**parts;
                let chosen = if self.holds(condition)? { yes } else { no };
                self.value(chosen)
            }
            Kind::Assign(name, operator, value) => self.assign(name, *operator, value, node.span),
            Kind::Step(name, by, before) => {
                let place = Node { kind: Kind::Name(name.clone()), span: node.span };
                let old = self.number(&place)?;
                self.set(name, Value::Number(old + by));
                Ok(Value::Number(if *before { old } else { old + by }))
            }
            Kind::Call(name, arguments) => self.call(name, arguments, node.span),
        }
    }

    /// Whether a condition holds: a number that is not zero, or a text that is not empty.
    ///
    /// # Errors
    ///
    /// As for its value.
    pub fn holds(&mut self, node: &Node) -> Result<bool, Fault> {
        is_true(&self.value(node)?)
    }

    /// The value of a tree that must be a number.
    ///
    /// # Errors
    ///
    /// As for its value; or it is a text.
    pub fn number(&mut self, node: &Node) -> Result<f64, Fault> {
        match self.value(node)? {
            Value::Number(value) => Ok(value),
            Value::Unknown => Err(Fault::Consequence),
            Value::Text(text) => {
                let message = format!("expected a number, but this is the text \"{}\"", spelling::cut(&text));
                Err(Fault::at(node.span, message, ""))
            }
        }
    }

    fn text(&mut self, node: &Node) -> Result<String, Fault> {
        as_text(self.value(node)?, node.span)
    }

    fn named(&mut self, name: &str, span: Span) -> Result<Value, Fault> {
        if name == "E" && self.own_e {
            self.used_e.get_or_insert(span);
        }
        match self.get(name) {
            Some(Value::Unknown) => Err(Fault::Consequence),
            Some(value) => Ok(value.clone()),
            None => {
                let fault = self.undefined(name, span);
                // Said once; what else uses the name is not worth a message.
                self.set(name, Value::Unknown);
                Err(fault)
            }
        }
    }

    fn undefined(&self, name: &str, span: Span) -> Fault {
        let fault = Fault::at(span, format!("{name} has no value"), "used before it is given one");
        let known: Vec<&str> = self.values.keys().map(String::as_str).filter(|n| !n.starts_with('_')).collect();
        let other_case = known.iter().find(|n| n.eq_ignore_ascii_case(name));
        if FUNCTIONS.iter().any(|(function, _)| *function == name) {
            fault.help(format!("the function {name} needs its arguments: {name}(...)"))
        } else if let Some(other) = other_case {
            fault.help(format!("did you mean {other}? small and capital letters differ in names"))
        } else if let Some(near) = nearest(name, known) {
            fault.help(format!("did you mean {near}?"))
        } else {
            fault.help(format!("give it one above this line: $ {{{name} = ...}}"))
        }
    }

    /// Operators that bind alike, from the left.
    fn chain(&mut self, first: &Node, links: &[(&'static str, Node)]) -> Result<Value, Fault> {
        let (mut value, mut place) = (self.value(first)?, first.span);
        for (sign, right) in links {
            value = self.binary(sign, value, place, right)?;
            place = place.join(right.span);
        }
        Ok(value)
    }

    /// The value on the left of an operator, its place, and what stands on the right.
    fn binary(&mut self, sign: &str, left: Value, place: Span, right: &Node) -> Result<Value, Fault> {
        let span = place.join(right.span);
        match sign {
            "&&" => return Ok(Value::Number(truth(is_true(&left)? && self.holds(right)?))),
            "||" => return Ok(Value::Number(truth(is_true(&left)? || self.holds(right)?))),
            "//" => {
                let mut joined = as_text(left, place)?;
                joined += &self.text(right)?;
                let fits = joined.len() <= LONGEST;
                return if fits { Ok(Value::Text(joined)) } else { Err(Fault::at(span, "this text is too long", "")) };
            }
            _ => {}
        }
        match (left, self.value(right)?) {
            (Value::Number(a), Value::Number(b)) => arithmetic(sign, a, b, right.span, span).map(Value::Number),
            (Value::Unknown, _) | (_, Value::Unknown) => Err(Fault::Consequence),
            (Value::Text(a), Value::Text(b)) => match relation(sign, a.cmp(&b)) {
                Some(holds) => Ok(Value::Number(truth(holds))),
                None => Err(Fault::at(span, format!("{sign} does not work on text"), "").help("// joins two texts")),
            },
            (a, b) => {
                let message = format!("{sign} between {} and {}", functions::kind(&a), functions::kind(&b));
                Err(Fault::at(span, message, "both must be of the same kind"))
            }
        }
    }

    fn assign(&mut self, name: &str, operator: Option<&str>, value: &Node, span: Span) -> Result<Value, Fault> {
        let outcome = match operator {
            None => match (self.value(value), self.instead(name)) {
                // What is wrong with the expression is told all the same.
                (Ok(_), Some(given)) => Ok(given),
                (outcome, _) => outcome,
            },
            Some(sign) => {
                let place = Span { start: span.start, end: span.start + name.len() };
                self.named(name, place).and_then(|old| self.binary(sign, old, place, value))
            }
        };
        // A name whose value is wrong is known to be so: what uses it is not worth a message.
        self.set(name, outcome.as_ref().map_or(Value::Unknown, Value::clone));
        outcome
    }

    fn call(&mut self, name: &str, arguments: &[Node], span: Span) -> Result<Value, Fault> {
        let Some(&(_, body)) = FUNCTIONS.iter().find(|(known, _)| *known == name) else {
            return Err(unknown_function(name, span));
        };
        if let (takes, false) = body.arity(arguments.len()) {
            let message = format!("{name} takes {takes}; {} given", counted(arguments.len()));
            return Err(Fault::at(span, message, ""));
        }
        let number = |value: f64| finite(value, name, span).map(Value::Number);
        match body {
            Body::One(f) => number(f(self.number(&arguments[0])?)),
            Body::Two(f) => number(f(self.number(&arguments[0])?, self.number(&arguments[1])?)),
            Body::Four(f) => {
                let mut x = [0.0; 4];
                for (x, argument) in x.iter_mut().zip(arguments) {
                    *x = self.number(argument)?;
                }
                number(f(x[0], x[1], x[2], x[3]))
            }
            Body::Several(f) => {
                let mut value = self.number(&arguments[0])?;
                for argument in &arguments[1..] {
                    value = f(value, self.number(argument)?);
                }
                number(value)
            }
            Body::Words(f) => Ok(Value::Text(f(&self.text(&arguments[0])?))),
            Body::WordCount => {
                let (text, separators) = (self.text(&arguments[0])?, self.text(&arguments[1])?);
                Ok(Value::Number(functions::words(&text, &separators).count() as f64))
            }
            Body::Word => self.word(arguments),
            Body::ToText => match self.value(&arguments[0])? {
                Value::Number(value) => self.printed(value, span).map(Value::Text),
                other => Ok(other),
            },
            Body::ToNumber => {
                let text = self.text(&arguments[0])?;
                let value = crate::deck::text::number::parse(text.trim()).map(|n| n.value);
                let message = || format!("\"{}\" spells no number", spelling::cut(&text));
                value.ok_or_else(|| Fault::at(arguments[0].span, message(), "")).and_then(number)
            }
            Body::Formatted => {
                let value = self.number(&arguments[0])?;
                let format = self.text(&arguments[1])?;
                formatted(value, &format, arguments[1].span).map(Value::Text)
            }
            Body::Error => {
                let text = self.text(&arguments[0])?;
                Err(Fault::at(span, spelling::cut(&text), "the deck itself says that this is wrong"))
            }
        }
    }

    fn word(&mut self, arguments: &[Node]) -> Result<Value, Fault> {
        let which = self.number(&arguments[0])?;
        let (text, separators) = (self.text(&arguments[1])?, self.text(&arguments[2])?);
        let words: Vec<&str> = functions::words(&text, &separators).collect();
        let found = (1..=words.len()).find(|&i| i as f64 == which).map(|i| words[i - 1].to_string());
        let message = || format!("there is no word {which} of {}", words.len());
        found.map(Value::Text).ok_or_else(|| Fault::at(arguments[0].span, message(), ""))
    }
}

/// Whether a value holds as a condition.
fn is_true(value: &Value) -> Result<bool, Fault> {
    match value {
        Value::Number(value) => Ok(*value != 0.0),
        Value::Text(text) => Ok(!text.is_empty()),
        Value::Unknown => Err(Fault::Consequence),
    }
}

fn as_text(value: Value, place: Span) -> Result<String, Fault> {
    match value {
        Value::Text(text) => Ok(text),
        Value::Unknown => Err(Fault::Consequence),
        Value::Number(_) => Err(Fault::at(place, "expected text, but this is a number", "")
            .help("text stands in quotes; tostring(x) makes text of a number")),
    }
}

/// The name nearest to a misspelt one; names of two letters are near to everything.
fn nearest<'n>(name: &str, known: Vec<&'n str>) -> Option<&'n str> {
    let known: Vec<&str> = known.into_iter().filter(|known| known.len() > 2).collect();
    let capitals: Vec<String> = known.iter().map(|known| known.to_uppercase()).collect();
    let near = spelling::nearest(name, capitals.iter().map(String::as_str))?;
    capitals.iter().position(|capital| capital == near).map(|index| known[index])
}

fn unknown_function(name: &str, span: Span) -> Fault {
    if let Some((_, why)) = REFUSED.iter().find(|(refused, _)| *refused == name) {
        return Fault::at(span, format!("the function {name} is not supported"), *why);
    }
    let fault = Fault::at(span, format!("there is no function {name}"), "");
    let known = || FUNCTIONS.iter().map(|(known, _)| *known);
    let near = known().find(|known| known.eq_ignore_ascii_case(name)).or_else(|| nearest(name, known().collect()));
    fault.help(near.map_or("a product needs a *".into(), |near| format!("did you mean {near}?")))
}

fn counted(count: usize) -> String {
    match count {
        0 => "none is".into(),
        1 => "one is".into(),
        n => format!("{n} are"),
    }
}

fn truth(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}

fn relation(sign: &str, order: std::cmp::Ordering) -> Option<bool> {
    Some(match sign {
        "<" => order.is_lt(),
        ">" => order.is_gt(),
        "<=" => order.is_le(),
        ">=" => order.is_ge(),
        "==" => order.is_eq(),
        "!=" => order.is_ne(),
        _ => return None,
    })
}

fn arithmetic(sign: &str, a: f64, b: f64, divisor: Span, span: Span) -> Result<f64, Fault> {
    // Both are finite, so they can be compared.
    if let Some(holds) = a.partial_cmp(&b).and_then(|order| relation(sign, order)) {
        return Ok(truth(holds));
    }
    if matches!(sign, "/" | "%") && b == 0.0 {
        return Err(Fault::at(divisor, "this divides by zero", "the divisor is 0"));
    }
    let value = match sign {
        "+" => a + b,
        "-" => a - b,
        "*" | "~" => a * b,
        "/" => a / b,
        // Whole numbers, as in aprepro.
        "%" if b.trunc() == 0.0 => return Err(Fault::at(divisor, "this divides by zero", "% takes whole numbers")),
        "%" => a.trunc() % b.trunc(),
        _ => libm::pow(a, b),
    };
    finite(value, sign, span)
}

fn finite(value: f64, what: &str, span: Span) -> Result<f64, Fault> {
    if value.is_nan() {
        Err(Fault::at(span, format!("{what} has no value here"), "the result is not a number"))
    } else if value.is_infinite() {
        Err(Fault::at(span, format!("{what} has no value here"), "the result is infinite"))
    } else {
        Ok(value)
    }
}

fn formatted(number: f64, format: &str, place: Span) -> Result<String, Fault> {
    let Some(format) = Format::read(format) else {
        let message = format!("\"{}\" is no format for a number", spelling::cut(format));
        return Err(Fault::at(place, message, "").help("a format is like %.10g, %12.4e or %8.3f"));
    };
    Ok(format.write(number))
}

#[cfg(test)]
mod tests;
