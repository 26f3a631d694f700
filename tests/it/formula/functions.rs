//! Functions that a user defines.

use rstest::rstest;

use super::{Expr, Formula, Scope, bind, declare};

#[rstest]
#[case("s(x)", -20.0)]
#[case("s(-x)", 0.0)]
#[case("s(s(x)+x*12)", -80.0)]
#[case("s(x)+s(t)*s(1)", 205.0)]
#[case("s(1)+s(t)/s(x)-x", -4.75)]
#[case("wave(t,0)-wave(x,0)", -25.0)]
#[case("sum(n,1,2,s(n*x))", -100.0)]
fn calls_are_replaced_by_the_body(#[case] source: &str, #[case] value: f64) {
    assert_eq!(bind(source, &["x", "t"]).unwrap().eval(&[2.0, 3.0]), value);
}

#[test]
fn functions_are_declared_in_any_order() {
    let mut scope = Scope::new();
    declare(&mut scope, "outer", &["a", "b"], "inner(b)-inner(a)*k");
    declare(&mut scope, "inner", &["a"], "a^2");
    scope.constant("k", 2.0).unwrap();
    scope.constant("unused", 2.0).unwrap();
    let formula = Formula::bind(&Expr::parse("outer(x,3)").unwrap(), &scope, &["x"]).unwrap();
    assert_eq!(formula.eval(&[1.0]), 7.0);
    assert!(formula.uses().iter().eq(["inner", "k", "outer"]));
    assert!(scope.functions().eq(["inner", "outer"]));
    assert!(scope.constants().eq([("k", 2.0), ("unused", 2.0)]));
}

#[test]
fn a_series_takes_its_length_as_an_argument() {
    let mut scope = Scope::new();
    declare(&mut scope, "series", &["x", "terms"], "sum(n,0,terms-1,x^n)");
    let formula = Formula::bind(&Expr::parse("series(x,4)").unwrap(), &scope, &["x"]).unwrap();
    assert_eq!(formula.eval(&[2.0]), 15.0);
    let error = Formula::bind(&Expr::parse("series(2,x)").unwrap(), &scope, &["x"]).unwrap_err();
    assert_eq!(error.message, "a bound of a sum may not depend on a variable or an index");
    assert_eq!((error.span, error.within.as_deref()), (8..15, Some("series")));
}

#[test]
fn parameters_may_be_named_as_variables() {
    let formula = bind("wave(t,x)", &["x", "t"]).unwrap();
    assert_eq!(formula.eval(&[2.0, 3.0]), -45.0 + libm::sin(6.0));
}

#[test]
fn functions_without_parameters_are_constants() {
    let mut scope = Scope::new();
    declare(&mut scope, "two", &[], "2");
    let formula = Formula::bind(&Expr::parse("two()^two()").unwrap(), &scope, &[]).unwrap();
    assert_eq!(formula.constant(), Some(4.0));
}

#[test]
fn mutual_recursion_is_refused() {
    let mut scope = Scope::new();
    declare(&mut scope, "start", &["x"], "a(x)");
    declare(&mut scope, "a", &["x"], "1+b(x)");
    declare(&mut scope, "b", &["x"], "2*(c(x))");
    declare(&mut scope, "c", &["x"], "x-a(x)");
    let error = Formula::bind(&Expr::parse("start(1)").unwrap(), &scope, &[]).unwrap_err();
    assert_eq!(error.message, "functions may not be recursive: `a` calls `b` calls `c` calls `a`");
    assert_eq!((error.span, error.within.as_deref()), (2..3, Some("c")));
}

/// Each argument must be evaluated once. Otherwise these thirty doublings would take 2^30
/// operations.
#[test]
fn arguments_are_not_duplicated() {
    let mut scope = Scope::new();
    declare(&mut scope, "twice", &["a"], "a+a");
    let source = format!("{}x{}", "twice(".repeat(30), ")".repeat(30));
    let formula = Formula::bind(&Expr::parse(&source).unwrap(), &scope, &["x"]).unwrap();
    assert_eq!(formula.eval(&[1.0]), 1_073_741_824.0);
}
