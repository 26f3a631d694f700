//! Derivatives of formulas, compared with central differences, and points where differences are
//! useless.

use rstest::rstest;

use super::bind;
use mpm_verify::exact::formula::{Formula, Jet, Number, Slope};

const X: [&str; 2] = ["x", "y"];

fn jet(formula: &Formula, x: f64, y: f64) -> Jet<2> {
    formula.eval(&[Jet::variable(x, 0), Jet::variable(y, 1)])
}

/// Computes the central difference of `f` with respect to the variable `i`, accurate to fourth
/// order.
fn difference(f: impl Fn(f64, f64) -> f64, x: f64, y: f64, i: usize) -> f64 {
    let h = 1e-3;
    let at = |s: f64| if i == 0 { f(x + s * h, y) } else { f(x, y + s * h) };
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h)
}

/// Formulas of x and y.
const FORMULAS: &str = "x+y x-y -x*y x/y y/x x^2*y^3 x^y x^-2*y^0 x^1.5*y^1 2^x*y (x*y)^(x+y) sin(x*y) cos(x*y) \
    tan(x*y) asin(x*y) acos(x*y) atan(x*y) atan2(x,y) atan2(y,x) atan2(-x,y*y) atan2(x,-y) \
    atan2(-x*x,-y) sinh(x*y) cosh(x*y) tanh(x*y) asinh(x*y) exp(x*y) ln(x*y) sqrt(x*y) abs(x*y) \
    abs(-x*y) sign(x*y)*x step(x)*y*x floor(x*y)+x bessel_j0(x*y) bessel_j1(x*y) lambert_w(x*y) \
    min(x*x,y*x) max(x*x,y*x) wave(x*y,y) s(x*y)*s(y) sum(n,1,3,sin(n*x)*y^n/n) \
    sum(n,0,3,(x*y)^n)";

#[rstest]
fn derivatives_agree_with_differences(
    #[values((0.6, 0.7), (0.8, 0.3), (0.31, 0.93))] point: (f64, f64),
) {
    for source in FORMULAS.split(' ') {
        println!("{source}");
        agrees_with_differences(source, point);
    }
}

fn agrees_with_differences(source: &str, (x, y): (f64, f64)) {
    let formula = bind(source, &X).unwrap();
    let found = jet(&formula, x, y);
    assert_eq!(found.value().to_bits(), formula.eval(&[x, y]).to_bits());
    let slope = formula.eval(&[Slope::new(x, [1.0, 0.0]), Slope::new(y, [0.0, 1.0])]);
    assert_eq!(found.value().to_bits(), slope.value().to_bits());
    for i in 0..2 {
        assert_eq!(found.d(i).to_bits(), slope.d(i).to_bits());
        let first = difference(|x, y| formula.eval(&[x, y]), x, y, i);
        approx::assert_relative_eq!(found.d(i), first, max_relative = 1e-8, epsilon = 1e-9);
        for j in 0..2 {
            let second = difference(|x, y| jet(&formula, x, y).d(i), x, y, j);
            approx::assert_relative_eq!(
                found.dd(i, j),
                second,
                max_relative = 1e-8,
                epsilon = 1e-9
            );
            assert_eq!(found.dd(i, j).to_bits(), found.dd(j, i).to_bits());
        }
    }
}

#[rstest]
#[case("x^0", 0.0, [1.0, 0.0, 0.0])]
#[case("x^1", 0.0, [0.0, 1.0, 0.0])]
#[case("x^2", 0.0, [0.0, 0.0, 2.0])]
#[case("x^3", 0.0, [0.0, 0.0, 0.0])]
#[case("x^2", -3.0, [9.0, -6.0, 2.0])]
#[case("x^3", -2.0, [-8.0, 12.0, -12.0])]
#[case("x^-1", -2.0, [-0.5, -0.25, -0.25])]
#[case("x^2.5", 0.0, [0.0, 0.0, 0.0])]
#[case("sum(n,0,2,x^n)", 0.0, [1.0, 1.0, 2.0])]
#[case("bessel_j0(x)", 0.0, [1.0, 0.0, -0.5])]
#[case("bessel_j1(x)", 0.0, [0.0, 0.5, 0.0])]
#[case("lambert_w(x)", 0.0, [0.0, 1.0, -2.0])]
#[case("abs(x)", 0.0, [0.0, 1.0, 0.0])]
#[case("abs(x)", -2.0, [2.0, -1.0, 0.0])]
#[case("max(x,0)^2", -1.0, [0.0, 0.0, 0.0])]
#[case("max(x,0)^2", 0.0, [0.0, 0.0, 2.0])]
#[case("max(0,x)^2", 0.0, [0.0, 0.0, 0.0])]
#[case("min(x,2*x)", 0.0, [0.0, 1.0, 0.0])]
#[case("step(x)", 0.0, [1.0, 0.0, 0.0])]
#[case("sign(x)", 0.0, [0.0, 0.0, 0.0])]
#[case("floor(x)", 3.0, [3.0, 0.0, 0.0])]
#[case("sqrt(max(x,0))", -1.0, [0.0, 0.0, 0.0])]
#[case("max(x,0)^1.5", -1.0, [0.0, 0.0, 0.0])]
fn special_points(#[case] source: &str, #[case] x: f64, #[case] expected: [f64; 3]) {
    let found: Jet<1> = bind(source, &["x"]).unwrap().eval(&[Jet::variable(x, 0)]);
    assert_eq!([found.value(), found.d(0), found.dd(0, 0)], expected);
}

/// A singularity in one variable must not affect the derivatives with respect to the other
/// variable.
#[test]
fn singularities_do_not_spread() {
    let found = jet(&bind("sqrt(x)+y^2", &X).unwrap(), 0.0, 3.0);
    assert_eq!((found.d(0), found.d(1)), (f64::INFINITY, 6.0));
    assert_eq!((found.dd(0, 1), found.dd(1, 1)), (0.0, 2.0));
}

/// sqrt(x^2) has a kink at 0. Its derivative must not be finite there.
#[test]
fn hidden_kinks_are_not_finite() {
    let found = jet(&bind("sqrt(x^2)", &X).unwrap(), 0.0, 0.0);
    assert!(!found.d(0).is_finite());
}

#[test]
fn solutions_may_be_written_in_rust() {
    fn wave<T: Number>(x: T, t: T) -> T {
        (x * T::from(2.0)).sin() * t.exp().powi(2)
    }
    let formula = bind("sin(x*2)*exp(y)^2", &X).unwrap();
    let found = wave(Jet::<2>::variable(0.3, 0), Jet::variable(0.4, 1));
    assert_eq!(found, jet(&formula, 0.3, 0.4));
    assert_eq!(wave(0.3, 0.4), formula.eval(&[0.3, 0.4]));
}
