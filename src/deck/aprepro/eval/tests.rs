//! Expressions against APREPRO.

use super::super::{expr, lexer};
use super::*;

fn value(names: &mut Names, text: &str) -> Result<Value, Fault> {
    let node = expr::parse(&lexer::tokens(text, 0)?)?.expect("something");
    names.value(&node)
}

/// Values of expressions in order, each as it is printed.
fn printed(expressions: &[&str]) -> Vec<String> {
    let mut names = Names::new();
    let mut show = |text: &&str| match value(&mut names, text) {
        Ok(Value::Number(number)) => names.printed(number, Span::default()).expect("a format"),
        Ok(Value::Text(text)) => text,
        Ok(Value::Unknown) => "?".into(),
        Err(Fault::Mistake(diagnostic)) => diagnostic.message,
        Err(Fault::Consequence) => "!".into(),
    };
    expressions.iter().map(&mut show).collect()
}

#[test]
fn operators_bind_as_in_aprepro() {
    let pairs = [
        ("1 + 2 * 3", "7"),
        ("-2^2", "-4"),
        ("2**3**2", "512"),
        ("2^-1", "0.5"),
        ("(1+2)*3", "9"),
        ("7 - 2 - 1", "4"),
        ("8 / 2 / 2", "2"),
        ("7 % 4.9", "3"),
        ("1 < 2 && 2 < 1 || 1", "1"),
        ("1 + 1 == 2", "1"),
        ("!3", "0"),
        ("1 ? 2 : 0 ? 3 : 4", "2"),
        ("0 ? 2 : 0 ? 3 : 4", "4"),
        ("-0.0 == 0", "1"),
        ("-0.0 < 0", "0"),
        ("'a' // 'b' // 'c'", "abc"),
        ("'a' < 'b'", "1"),
        ("2 ~ 3", "6"),
        ("30e6", "30000000"),
        ("1/3", "0.3333333333"),
    ];
    for (expression, text) in pairs {
        assert_eq!(printed(&[expression]), [text], "{expression}");
    }
}

#[test]
fn long_expressions_need_no_depth() {
    let long = |first: &str, link: &str| format!("{first}{}", link.repeat(50_000));
    for (first, link, value) in [
        ("1", "+1", "50001"),
        ("1", "-1+1", "1"),
        ("1", "*1+1*1", "50001"),
        ("'a'", "//''", "a"),
        ("1", "<2", "1"),
        ("1", "&&1", "1"),
        ("0", "||0", "0"),
        ("(1)", "+(1)", "50001"),
        ("0", "+(1-1)", "0"),
    ] {
        assert_eq!(printed(&[&long(first, link)]), [value], "{first}{link}...");
    }
    assert_eq!(printed(&["1 - (2 - 3) - 4", "1 - 2 * 3 - (4 - 5 - 6) < 3"]), ["-2", "1"]);
}

#[test]
fn names_keep_their_values() {
    assert_eq!(printed(&["x = y = 3", "x += 2", "x++", "++x", "x ^= 2", "y"]), ["3", "5", "5", "7", "49", "3"]);
    assert_eq!(printed(&["E = 30e6", "E/2"]), ["30000000", "15000000"]);
    assert_eq!(printed(&["_FORMAT = '%.3e'", "PI"])[1], "3.142e+00");
    assert_eq!(printed(&["t = 5", "1 ? t : undefined"])[1], "5");
    assert_eq!(printed(&["a:b = 3", "a:b + 1"])[1], "4");
}

#[test]
fn functions_are_those_of_aprepro() {
    let pairs = [
        ("sqrt(16)", "4"),
        ("cosd(60)", "0.5"),
        ("cosd(90)", "0"),
        ("max(1, 5, 3)", "5"),
        ("min(2, 1)", "1"),
        ("int(-2.7)", "-2"),
        ("nint(-2.5)", "-3"),
        ("nint(2.5)", "3"),
        ("hypot(3, 4)", "5"),
        ("ln(E)", "1"),
        ("log10(1000)", "3"),
        ("pow(2, 10)", "1024"),
        ("sign(3, -2)", "-3"),
        ("d2r(180) - PI", "0"),
        ("r2d(PI)", "180"),
        ("tostring(2.5) // 'x'", "2.5x"),
        ("toupper('ab')", "AB"),
        ("word_count('a b,c', ' ,')", "3"),
        ("get_word(2, 'a b,c', ' ,')", "b"),
        ("dim(5, 3)", "2"),
        ("strtod('1.5') * 2", "3"),
        ("format(PI, '%.2f')", "3.14"),
        ("atan2d(1, 1)", "45"),
        ("Vangled(1, 0, 0, 1)", "90"),
    ];
    for (expression, text) in pairs {
        assert_eq!(printed(&[expression]), [text], "{expression}");
    }
}

#[test]
fn mistakes_have_words() {
    assert_eq!(printed(&["x = 1/0", "x + 1"]), ["this divides by zero", "!"]);
    assert_eq!(printed(&["sqrt(-1)"]), ["sqrt has no value here"]);
    assert_eq!(printed(&["sqrt(1, 2)"]), ["sqrt takes one argument; 2 are given"]);
    assert_eq!(printed(&["Dt"]), ["Dt has no value"]);
    assert_eq!(printed(&["1 2"]), ["an operator is missing before this"]);
    assert_eq!(printed(&["(1"]), ["this ( is not closed"]);
    assert_eq!(printed(&["3 = x"]), ["only a name can be given a value"]);
    assert_eq!(printed(&["1 +"]), ["the expression ends too early"]);
    assert_eq!(printed(&[&"(".repeat(5000)]), ["this expression is nested too deep"]);
    assert_eq!(printed(&["'a' + 1"]), ["+ between text and a number"]);
    assert_eq!(printed(&[&"1+".repeat(2_000_000)]), ["this expression is too long"]);
}
