//! Messages for wrong formulas, and the position of the caret.

use std::ops::Range;

use rstest::rstest;

use super::{Expr, Formula, Scope, bar, bind, declare};

#[rstest]
#[case("", "expected a value, found the end of the formula", 0..0)]
#[case("1+", "expected a value, found the end of the formula", 2..2)]
#[case("(1+2", "expected `)`, found the end of the formula", 4..4)]
#[case("(1,2)", "expected `)`, found `,`", 2..3)]
#[case("sin(x*)", "expected a value, found `)`", 6..7)]
#[case("1)", "expected an operator or the end of the formula, found `)`", 1..2)]
#[case("max(1 2)", "expected `,` or `)`, found `2`", 6..7)]
#[case("max(1,2,3)", "`max` takes 2 arguments, not 3", 0..10)]
#[case("1+sin()", "`sin` takes 1 argument, not 0", 2..7)]
#[case("sin(1,)", "expected a value, found `)`", 6..7)]
#[case("s(1,2)", "`s` takes 1 argument, not 2", 0..6)]
#[case("1+sin*2", "the function `sin` is not called", 2..5)]
#[case("1+s*2", "the function `s` is not called", 2..3)]
#[case("L(2)", "`L` is a constant, not a function", 0..1)]
#[case("x(2)", "`x` is a variable, not a function", 0..1)]
#[case("pi(2)", "`pi` is a number, not a function", 0..2)]
#[case("sum(n,1,2,n(2))", "`n` is the index of a sum, not a function", 10..11)]
#[case("foo(1)", "unknown function `foo`", 0..3)]
#[case("1 + % 2", "unexpected character `%`", 4..5)]
#[case("2*ω*t", "unexpected character `ω`", 2..4)]
#[case("1 − x", "unexpected character `−`", 2..5)]
#[case("1.", "expected a digit after `.`", 0..2)]
#[case("x+.", "expected a digit after `.`", 2..3)]
#[case("1.2.3", "the number `1.2` is followed by a second `.`", 0..4)]
#[case("1e999", "the number `1e999` is too large", 0..5)]
#[case("sum(1,1,2,3)", "expected the name of the index, found `1`", 4..5)]
#[case("sum(n,1,2)", "expected `,`, found `)`", 9..10)]
#[case("sum(n,1,2,n,3)", "expected `)`, found `,`", 11..12)]
#[case("sum(pi,1,2,1)", "`pi` is a builtin name", 4..6)]
#[case("sum(sin,1,2,1)", "`sin` is a builtin name", 4..7)]
#[case("sum(L,1,2,1)", "`L` is already a constant", 4..5)]
#[case("sum(s,1,2,1)", "`s` is already a function", 4..5)]
#[case("sum(x,1,2,1)", "`x` is already a variable", 4..5)]
#[case("sum(n,1,2,sum(n,1,2,n))", "`n` is already the index of an enclosing sum", 14..15)]
#[case("sum(n,1,x,n)", "a bound of a sum may not depend on a variable or an index", 8..9)]
#[case("sum(n,1,2.5,n)", "a bound of a sum must be a whole number, not 2.5", 8..11)]
#[case("sum(n,1,1/0,n)", "a bound of a sum must be a whole number, not inf", 8..11)]
#[case("sum(n,1,100001,n)", "the sum has 100001 terms, more than 100000", 6..14)]
#[case("sum(n,1,n,n)", "unknown name `n`", 8..9)]
fn message_and_span(#[case] source: &str, #[case] message: &str, #[case] span: Range<usize>) {
    let error = bind(source, &["x", "t"]).unwrap_err();
    assert_eq!((error.to_string().as_str(), error.span), (message, span));
    assert_eq!(error.within, None);
}

#[rstest]
#[case("omgea*t", "unknown name `omgea`", 0..5, "did you mean `omega`? declared: `omega`, `E`, `g`, `L`, `rho`")]
#[case("1+l", "unknown name `l`", 2..3, "did you mean `L`? declared: `L`, `E`, `g`, `rho`, `omega`")]
#[case("2*velocity", "unknown name `velocity`", 2..10, "the variables are `x`, `t`; declared: `E`, `L`, `omega`, `rho`, `g`")]
#[case("e^x", "unknown name `e`", 0..1, "there is no constant `e`: write `exp(1)`")]
#[case("log(x)", "unknown function `log`", 0..3, "the natural logarithm is `ln`")]
#[case("sqr(x)", "unknown function `sqr`", 0..3, "did you mean `sqrt`?")]
#[case("2E", "`2E` is neither a number nor a name", 0..2, "write `2*E` to multiply")]
#[case("x+2E-x", "`2E` is neither a number nor a name", 2..4, "write `2*E` to multiply")]
#[case("1.5rho", "`1.5rho` is neither a number nor a name", 0..6, "write `1.5*rho` to multiply")]
#[case("L(2)", "`L` is a constant, not a function", 0..1, "write `L*(...)` to multiply")]
#[case("2**3", "expected a value, found `*`", 2..3, "a power is written `^`")]
#[case("+1", "expected a value, found `+`", 0..1, "there is no unary `+`")]
#[case(
    "2 x", "expected an operator or the end of the formula, found `x`", 2..3,
    "there is no implicit multiplication: write `*`"
)]
#[case("(2 x)", "expected `)`, found `x`", 3..4, "there is no implicit multiplication: write `*`")]
#[case(
    "sum(n,1)", "expected `,`, found `)`", 7..8, "the form is `sum(index, from, to, body)`"
)]
fn message_span_and_help(
    #[case] source: &str,
    #[case] message: &str,
    #[case] span: Range<usize>,
    #[case] help: &str,
) {
    let error = bind(source, &["x", "t"]).unwrap_err();
    assert_eq!((error.message.as_str(), error.span), (message, span));
    assert_eq!(error.help.as_deref(), Some(help));
}

#[test]
fn help_mentions_missing_variables() {
    let error = bind("velocity", &[]).unwrap_err();
    assert_eq!(
        error.help.as_deref(),
        Some("there are no variables here; declared: `E`, `L`, `omega`, `rho`, `g`")
    );
}

#[test]
fn most_similar_constants_are_listed() {
    let mut scope = Scope::new();
    for i in 0..12 {
        scope.constant(&format!("c{i}"), 1.0).unwrap();
    }
    scope.constant("rho", 1.0).unwrap();
    let error = Formula::bind(&Expr::parse("rhoo").unwrap(), &scope, &[]).unwrap_err();
    let help = error.help.expect("help");
    assert!(help.starts_with("did you mean `rho`? declared: `rho`, `c0`, "), "{help}");
    assert!(help.ends_with(" and 5 more"), "{help}");
    assert_eq!(error.unknown.as_deref(), Some("rhoo"));
}

#[test]
fn help_mentions_missing_names() {
    let error = Formula::bind(&Expr::parse("a").unwrap(), &Scope::new(), &[]).unwrap_err();
    assert_eq!(error.help.as_deref(), Some("there are no variables here"));
}

#[rstest]
#[case("L", "`L` is already a constant")]
#[case("s", "`s` is already a function")]
#[case("pi", "`pi` is already a builtin name")]
#[case("sqrt", "`sqrt` is already a builtin name")]
#[case("tau", "`tau` is already a parameter of the function `s`")]
#[case("2a", "`2a` is not a name")]
#[case("", "`` is not a name")]
#[case("ω", "`ω` is not a name")]
fn declarations_take_fresh_names(#[case] name: &str, #[case] message: &str) {
    let mut scope = bar();
    assert_eq!(scope.constant(name, 1.0).unwrap_err().message, message);
    let body = Expr::parse("1").unwrap();
    assert_eq!(scope.function(name, &[], body).unwrap_err().message, message);
}

#[rstest]
#[case(&["L"], "`L` is already a constant")]
#[case(&["s"], "`s` is already a function")]
#[case(&["sin"], "`sin` is already a builtin name")]
#[case(&["f"], "the parameter `f` of `f` is already in use")]
#[case(&["a", "a"], "the parameter `a` of `f` is already in use")]
#[case(&["n"], "`n` is already a parameter of `f`")]
fn parameters_take_fresh_names(#[case] parameters: &[&str], #[case] message: &str) {
    let parameters: Vec<String> = parameters.iter().map(ToString::to_string).collect();
    let body = Expr::parse("sum(n,1,2,n)").unwrap();
    assert_eq!(bar().function("f", &parameters, body).unwrap_err().message, message);
}

#[rstest]
#[case(&["L"], "`L` is already a constant")]
#[case(&["s"], "`s` is already a function")]
#[case(&["x", "x"], "`x` is already a variable")]
fn variables_take_fresh_names(#[case] variables: &[&str], #[case] message: &str) {
    assert_eq!(bind("1", variables).unwrap_err().message, message);
}

#[test]
fn constants_are_finite() {
    let error = Scope::new().constant("a", f64::NAN).unwrap_err();
    assert_eq!(error.message, "the constant `a` is NaN, which is not finite");
}

#[rstest]
#[case("1+X", "unknown name `X`", 2..3, Some("the parameters of `f` are `a`"))]
#[case("a(2)", "`a` is a parameter, not a function", 0..1, Some("write `a*(...)` to multiply"))]
#[case("1+f(a)", "functions may not be recursive: `f` calls `f`", 2..3, None)]
fn faults_in_a_body_name_the_function(
    #[case] body: &str,
    #[case] message: &str,
    #[case] span: Range<usize>,
    #[case] help: Option<&str>,
) {
    let mut scope = Scope::new();
    declare(&mut scope, "f", &["a"], body);
    let error = Formula::bind(&Expr::parse("f(X)").unwrap(), &scope, &["X"]).unwrap_err();
    assert_eq!((error.message.as_str(), error.span), (message, span));
    assert_eq!((error.help.as_deref(), error.within.as_deref()), (help, Some("f")));
}
