//! Hostile formulas are refused, or evaluated without overflowing a test's stack of 2 MiB.

use rstest::rstest;

use super::{Expr, Formula, Scope, bind, declare};
use mpm_verify::exact::formula::Jet;

/// Returns the longest chain that the limit of tokens allows.
fn chain(link: &str) -> String {
    format!("x{}", link.repeat(2047))
}

#[rstest]
#[case("+1", 2049.0)]
#[case("-x", -4092.0)]
#[case("*1", 2.0)]
#[case("/1", 2.0)]
fn long_chains_are_flat(#[case] link: &str, #[case] value: f64) {
    let formula = bind(&chain(link), &["x"]).unwrap();
    assert_eq!(formula.clone().eval(&[2.0]), value);
    assert_eq!(formula.eval(&[Jet::<4>::variable(2.0, 0)]).value(), value);
    assert!(!format!("{:?}", Expr::parse(&chain(link)).unwrap().clone()).is_empty());
}

#[rstest]
#[case("(", "x", ")")]
#[case("-", "x", "")]
#[case("sin(", "x", ")")]
#[case("2^", "x", "")]
#[case("1+(", "x", ")")]
#[case("max(1,", "x", ")")]
#[case("s(", "x", ")")]
fn deep_formulas_are_refused(#[case] open: &str, #[case] inner: &str, #[case] close: &str) {
    let nest = |depth: usize| format!("{}{inner}{}", open.repeat(depth), close.repeat(depth));
    let formula = bind(&nest(60), &["x"]).unwrap();
    formula.eval(&[Jet::<4>::variable(0.5, 0)]);
    for depth in [128, 800] {
        let error = bind(&nest(depth), &["x"]).unwrap_err();
        assert_eq!(error.message, "the formula is nested more than 128 levels deep");
    }
}

#[test]
fn deep_sums_are_evaluated_in_a_loop() {
    let open: Vec<String> = (0..120).map(|i| format!("sum(n{i},1,1,")).collect();
    let formula = bind(&format!("{}x{}", open.concat(), ")".repeat(120)), &["x"]).unwrap();
    assert_eq!(formula.eval(&[Jet::<4>::variable(2.0, 3)]).d(3), 1.0);
}

#[test]
fn long_sources_are_refused() {
    let spaces = " ".repeat(16 * 1024);
    assert!(Expr::parse(&format!("1{}", &spaces[1..])).is_ok());
    let error = Expr::parse(&format!("1{spaces}")).unwrap_err();
    assert_eq!(error.message, "the formula is longer than 16384 bytes");
}

#[test]
fn many_tokens_are_refused() {
    let error = Expr::parse(&format!("{}+1", chain("+x"))).unwrap_err();
    assert_eq!(error.message, "the formula has more than 4096 tokens");
    assert_eq!(error.span, 4096..4097);
}

/// Creates a scope with functions `f0` to `f{last}`. Each one calls the previous one.
fn tower(last: usize, body: impl Fn(usize) -> String) -> Scope {
    let mut scope = Scope::new();
    declare(&mut scope, "f0", &["a"], "a+1");
    for i in 1..=last {
        declare(&mut scope, &format!("f{i}"), &["a"], &body(i - 1));
    }
    scope
}

fn refusal(scope: &Scope, source: &str) -> String {
    Formula::bind(&Expr::parse(source).unwrap(), scope, &["x"]).unwrap_err().message
}

#[test]
fn exponential_inlining_is_refused() {
    let scope = tower(60, |below| format!("f{below}(a)+f{below}(a)"));
    let message = "the formula and its functions have more than 100000 nodes";
    assert_eq!(refusal(&scope, "f60(x)"), message);
}

#[rstest]
#[case("sin(", ")")]
#[case("sum(n,1,1,n*", ")")]
#[case("a+max(-1,a*", ")")]
fn deep_inlining_is_refused(#[case] open: &str, #[case] close: &str) {
    let scope = tower(2000, |below| format!("{open}f{below}(a){close}"));
    let formula = Formula::bind(&Expr::parse("f60(x)").unwrap(), &scope, &["x"]).unwrap();
    formula.eval(&[Jet::<4>::variable(0.5, 0)]);
    let message = "the formula and its functions are nested more than 256 levels deep";
    assert_eq!(refusal(&scope, "f2000(x)"), message);
}

#[test]
fn endless_sums_are_refused() {
    let scope = Scope::new();
    let message = "the sums take more than 10000000 operations";
    assert_eq!(refusal(&scope, "sum(n,1,100000,sum(m,1,100000,1))"), message);
    let terms = "+sum(n,1,100000,n*n*n*n*n*n*n*n)".repeat(8);
    assert_eq!(refusal(&scope, &format!("0{terms}")), message);
}
