//! The tokens of an expression → a tree. Operators bind as in aprepro: assignment, choice, `||`, `&&`, relations, sums
//! and joints of texts, products, signs, powers; powers and assignments from the right, so that `-2^2` is -4.

use super::{
    Fault,
    lexer::{Token, What},
};
use crate::deck::text::source::Span;

/// A part of an expression and its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub kind: Kind,
    pub span: Span,
}

/// What it is.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind {
    Number(f64),
    Text(String),
    Name(String),
    /// `-a`, `+a`, `!a`
    Unary(&'static str, Box<Node>),
    /// `a + b - c` and its like: operators that bind alike, worked through from the left. A list and no tree, so that a
    /// sum may be as long as it likes.
    Chain(Box<Node>, Vec<(&'static str, Node)>),
    /// `a ? b : c`
    Choice(Box<[Node; 3]>),
    /// `name = a`; with `+=` and its like, the operator.
    Assign(String, Option<&'static str>, Box<Node>),
    /// `++name` and `name++`: by how much, and whether the value is that before it.
    Step(String, f64, bool),
    /// `name(a, b)`
    Call(String, Vec<Node>),
}

/// Brackets and operators within each other at most.
const DEEPEST: usize = 100;

/// Left binding power and right binding power of the operators of two sides.
fn power(sign: &str) -> Option<(u8, u8)> {
    Some(match sign {
        "||" => (5, 6),
        "&&" => (7, 8),
        "<" | ">" | "<=" | ">=" | "==" | "!=" => (9, 10),
        "+" | "-" | "//" => (11, 12),
        "*" | "/" | "%" | "~" => (13, 14),
        "^" | "**" => (18, 17),
        _ => return None,
    })
}

/// What signs bind more strongly than products, and less than powers.
const OF_SIGNS: u8 = 15;
/// The left side of a choice binds like this.
const OF_CHOICE: u8 = 3;

/// The tree of an expression; `None` where there is nothing to evaluate.
pub(super) fn parse(tokens: &[Token]) -> Result<Option<Node>, Fault> {
    let mut parser = Parser { tokens, at: 0, depth: 0 };
    if parser.peek().what == What::End {
        return Ok(None);
    }
    let node = parser.expression(0)?;
    let next = parser.peek();
    match &next.what {
        What::End => Ok(Some(node)),
        What::Sign(")") => Err(Fault::at(next.span, "this ) has no ( before it", "")),
        What::Sign("=") => Err(Fault::at(node.span, "only a name can be given a value", "this is no name")
            .help("to compare two values, write ==")),
        What::Sign("," | ";") => {
            Err(Fault::at(next.span, "one pair of braces holds one expression", "the first one ends here")
                .help("write each in braces of its own"))
        }
        What::Sign("[") => Err(Fault::at(next.span, "arrays are not supported", "")),
        _ => Err(Fault::at(next.span, "an operator is missing before this", "the expression is complete without it")),
    }
}

struct Parser<'t> {
    tokens: &'t [Token],
    at: usize,
    depth: usize,
}

impl<'t> Parser<'t> {
    fn peek(&self) -> &'t Token {
        &self.tokens[self.at.min(self.tokens.len() - 1)]
    }

    fn next(&mut self) -> &'t Token {
        let token = self.peek();
        self.at += 1;
        token
    }

    fn takes(&mut self, sign: &str) -> bool {
        let is = matches!(self.peek().what, What::Sign(found) if found == sign);
        self.at += usize::from(is);
        is
    }

    /// The longest expression whose operators bind more strongly than `least`.
    fn expression(&mut self, least: u8) -> Result<Node, Fault> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(Fault::at(self.peek().span, "this expression is nested too deep", ""));
        }
        let mut left = self.operand()?;
        // What the chain on the left binds like, as long as it goes on; one in brackets does not.
        let mut open = None;
        while let What::Sign(sign) = self.peek().what {
            if sign == "?" && least <= OF_CHOICE {
                left = self.choice(left)?;
                open = None;
                continue;
            }
            let Some((_, right)) = power(sign).filter(|&(binds, _)| binds > least) else { break };
            self.at += 1;
            let other = self.expression(right)?;
            let span = left.span.join(other.span);
            left = match left.kind {
                Kind::Chain(first, mut links) if open == power(sign) => {
                    links.push((sign, other));
                    Node { kind: Kind::Chain(first, links), span }
                }
                _ => Node { kind: Kind::Chain(Box::new(left), vec![(sign, other)]), span },
            };
            open = power(sign);
        }
        self.depth -= 1;
        Ok(left)
    }

    fn choice(&mut self, condition: Node) -> Result<Node, Fault> {
        let question = self.next().span;
        let yes = self.expression(OF_CHOICE)?;
        if !self.takes(":") {
            return Err(Fault::at(self.peek().span, "this choice has no : and no second value", "expected : here")
                .help("a choice is: condition ? value : value"));
        }
        let no = self.expression(OF_CHOICE - 1)?;
        let span = condition.span.join(question).join(no.span);
        Ok(Node { kind: Kind::Choice(Box::new([condition, yes, no])), span })
    }

    fn operand(&mut self) -> Result<Node, Fault> {
        let token = self.next();
        let span = token.span;
        match &token.what {
            What::Number(value) => Ok(Node { kind: Kind::Number(*value), span }),
            What::Text(text) => Ok(Node { kind: Kind::Text(text.clone()), span }),
            What::Name(name) => self.named(name, span),
            What::Sign("(") => {
                let inner = self.expression(0)?;
                self.close(span)?;
                Ok(Node { span: span.join(self.tokens[self.at - 1].span), ..inner })
            }
            What::Sign(sign @ ("++" | "--")) => match &self.next().what {
                What::Name(name) => Ok(Node {
                    kind: Kind::Step(name.clone(), step(sign), false),
                    span: span.join(self.tokens[self.at - 1].span),
                }),
                _ => Err(Fault::at(span, format!("{sign} needs a name after it"), "")),
            },
            What::Sign(sign @ ("-" | "+" | "!")) => {
                let inner = self.expression(OF_SIGNS)?;
                let span = span.join(inner.span);
                Ok(Node { kind: Kind::Unary(sign, Box::new(inner)), span })
            }
            What::End => Err(Fault::at(span, "the expression ends too early", "expected a value here")),
            What::Sign(sign) => Err(Fault::at(span, format!("expected a value, but found {sign}"), "")),
        }
    }

    /// A name, with what makes an assignment or a call of it.
    fn named(&mut self, name: &str, span: Span) -> Result<Node, Fault> {
        let What::Sign(sign) = self.peek().what else { return Ok(Node { kind: Kind::Name(name.to_string()), span }) };
        let operator = match sign {
            "=" => None,
            "+=" | "-=" | "*=" | "/=" | "^=" | "**=" => Some(match sign {
                "+=" => "+",
                "-=" => "-",
                "*=" => "*",
                "/=" => "/",
                _ => "^",
            }),
            "++" | "--" => {
                let span = span.join(self.next().span);
                return Ok(Node { kind: Kind::Step(name.to_string(), step(sign), true), span });
            }
            "(" => return self.call(name, span),
            _ => return Ok(Node { kind: Kind::Name(name.to_string()), span }),
        };
        self.at += 1;
        let value = self.expression(0)?;
        let span = span.join(value.span);
        Ok(Node { kind: Kind::Assign(name.to_string(), operator, Box::new(value)), span })
    }

    fn call(&mut self, name: &str, span: Span) -> Result<Node, Fault> {
        let open = self.next().span;
        let mut arguments = Vec::new();
        if !self.takes(")") {
            loop {
                arguments.push(self.expression(0)?);
                if !self.takes(",") {
                    break;
                }
            }
            self.close(open)?;
        }
        let span = span.join(self.tokens[self.at - 1].span);
        Ok(Node { kind: Kind::Call(name.to_string(), arguments), span })
    }

    fn close(&mut self, open: Span) -> Result<(), Fault> {
        if self.takes(")") {
            return Ok(());
        }
        let next = self.peek();
        match &next.what {
            What::End => Err(Fault::at(open, "this ( is not closed", "no ) in these braces")),
            _ => Err(Fault::at(next.span, "expected an operator or ) here", "")),
        }
    }
}

fn step(sign: &str) -> f64 {
    if sign == "++" { 1.0 } else { -1.0 }
}
