//! Values of formulas: operators, precedence, names.

use std::f64::consts::PI;

use rstest::rstest;

use super::{Expr, bind};

#[rstest]
#[case("1", 1.0)]
#[case("1.5", 1.5)]
#[case(".5", 0.5)]
#[case("2e-3", 2e-3)]
#[case("2E-3", 2e-3)]
#[case("2e3", 2000.0)]
#[case("2E+3", 2000.0)]
#[case("2*E", 8.0)]
#[case("2*E-3", 5.0)]
#[case("pi", PI)]
#[case("1-2-3", -4.0)]
#[case("8/4/2", 1.0)]
#[case("1+2*3", 7.0)]
#[case("(1+2)*3", 9.0)]
#[case("2*3^2", 18.0)]
#[case("-2^2", -4.0)]
#[case("(-2)^2", 4.0)]
#[case("(-2)^3", -8.0)]
#[case("2^3^2", 512.0)]
#[case("2^-1", 0.5)]
#[case("2^-1*6", 3.0)]
#[case("2^-2^2", 0.0625)]
#[case("-2*-3", 6.0)]
#[case("1--1", 2.0)]
#[case("--1", 1.0)]
#[case("2*-3^2+1", -17.0)]
#[case("0^0", 1.0)]
#[case(" 1 +\t2\n", 3.0)]
#[case("sqrt(2*E/rho)", 2.0)]
#[case("min(1,2)+10*max(1,2)", 21.0)]
#[case("step(0)+step(-1)*10+sign(-3)*100+abs(-2)*1000", 1901.0)]
#[case("floor(-1.5)", -2.0)]
#[case("bessel_j0(1)", 0.765_197_686_557_966_6)]
#[case("bessel_j1(1)", 0.440_050_585_744_933_5)]
#[case("lambert_w(exp(1))", 1.0)]
#[case("4*atan2(1,1)", PI)]
#[case("atan2(0,-1)", PI)]
#[case("2*atan2(1,0)", PI)]
#[case("sum(n,1,4,n^2)", 30.0)]
#[case("sum(n,3,2,n)", 0.0)]
#[case("sum(n,-1,1,n+1)", 3.0)]
#[case("sum(n,1,E,(-1)^n*n)", 2.0)]
#[case("sum(n,1,3,sum(m,1,2,n*m))", 18.0)]
#[case("sum(n,1,2,n)*sum(n,1,3,n)", 18.0)]
fn constants(#[case] source: &str, #[case] value: f64) {
    let formula = bind(source, &[]).unwrap();
    assert_eq!(formula.constant(), Some(value));
    assert_eq!(formula.eval::<f64>(&[]), value);
}

#[rstest]
#[case("x", 2.0)]
#[case("x-y-x", -3.0)]
#[case("x/y/x", 1.0 / 3.0)]
#[case("(x+1)*(y-1)/(x*y)", 1.0)]
#[case("-x^2", -4.0)]
#[case("y^x^x", 81.0)]
#[case("sum(n,1,3,x*n)", 12.0)]
#[case("sum(n,1,3,sum(m,1,2,n*m*x)+y)", 45.0)]
#[case("x*sum(n,1,3,n)+sum(n,0,2,y^n)", 25.0)]
#[case("sum(n,2,1,x)", 0.0)]
#[case("atan2(x,y)*0+1", 1.0)]
fn variables(#[case] source: &str, #[case] value: f64) {
    assert_eq!(bind(source, &["x", "y"]).unwrap().eval(&[2.0, 3.0]), value);
}

#[test]
fn the_vibrating_bar() {
    let formula = bind("1/omega*sin(pi*X/(2*L))*sin(omega*t)", &["X", "t"]).unwrap();
    let expected = 1.0 / 3.0 * libm::sin(PI * 0.3 / 1.0) * libm::sin(3.0 * 0.7);
    assert_eq!(formula.eval(&[0.3, 0.7]), expected);
    assert_eq!(formula.constant(), None);
    assert_eq!(formula.source(), "1/omega*sin(pi*X/(2*L))*sin(omega*t)");
    assert!(formula.uses().iter().eq(["L", "omega"]));
}

#[rstest]
#[case("sin(x)", libm::sin)]
#[case("cos(x)", libm::cos)]
#[case("exp(x)", libm::exp)]
#[case("ln(x)", libm::log)]
#[case("tanh(x)", libm::tanh)]
#[case("x^0.3", |x| libm::pow(x, 0.3))]
#[case("x^3", |x| x * (x * x))]
fn values_are_bit_identical_to_libm(#[case] source: &str, #[case] reference: fn(f64) -> f64) {
    let formula = bind(source, &["x"]).unwrap();
    for i in 1..200 {
        let x = 0.037 * f64::from(i);
        assert_eq!(formula.eval(&[x]).to_bits(), reference(x).to_bits(), "at {x}");
    }
}

#[rstest]
#[case("min(x,1)")]
#[case("min(1,x)")]
#[case("max(x,1)")]
#[case("max(1,x)")]
#[case("sign(x)")]
#[case("step(x)")]
#[case("abs(x)")]
#[case("floor(x)")]
fn nan_is_passed_on(#[case] source: &str) {
    assert!(bind(source, &["x"]).unwrap().eval(&[f64::NAN]).is_nan());
}

#[test]
fn names_and_calls_are_listed_in_reading_order() {
    let expr = Expr::parse("s(a)+sum(n,1,N,n*pi*b)+sin(a)*r(s(1))").unwrap();
    let names = [("a", 2..3), ("N", 13..14), ("b", 20..21), ("a", 27..28)];
    assert_eq!(expr.names(), names.map(|(name, span)| (name.to_owned(), span)));
    let calls = [("s", 0..1), ("r", 30..31), ("s", 32..33)];
    assert_eq!(expr.calls(), calls.map(|(name, span)| (name.to_owned(), span)));
}

#[test]
#[should_panic(expected = "variables of `x`")]
fn the_number_of_variables_is_checked() {
    bind("x", &["x", "t"]).unwrap().eval(&[1.0]);
}
