//! Names that refer to a table.

use rstest::rstest;

use super::{Expr, Formula, Scope};
use mpm_verify::exact::formula::Jet;

/// Creates a scope with a table that rises from 1 at t = 0.5 to 3 at 1 and falls to -1 at 2, and a
/// constant that another definition uses.
fn scope() -> Scope {
    let mut scope = Scope::new();
    scope.table("ramp", "t", &[(0.5, 1.0), (1.0, 3.0), (2.0, -1.0)]).unwrap();
    scope.constant("n", 1.25).unwrap();
    scope.table("fixed", "n", &[(1.0, 10.0), (2.0, -10.0)]).unwrap();
    scope
}

fn bind(text: &str, variables: &[&str]) -> Formula {
    Formula::bind(&Expr::parse(text).unwrap(), &scope(), variables).unwrap()
}

#[rstest]
#[case::before_the_first_row(-7.0, 1.0)]
#[case::the_first_row(0.5, 1.0)]
#[case::between(0.75, 2.0)]
#[case::a_row(1.0, 3.0)]
#[case::further_on(1.75, 0.0)]
#[case::the_last_row(2.0, -1.0)]
#[case::behind_the_last_row(9.0, -1.0)]
fn a_table_is_linear_between_its_rows(#[case] t: f64, #[case] value: f64) {
    assert_eq!(bind("ramp", &["t"]).eval(&[t]), value);
    assert_eq!(bind("x*ramp + fixed", &["x", "t"]).eval(&[2.0, t]), 2.0 * value + 5.0);
}

#[test]
fn a_table_has_the_slopes_of_its_intervals() {
    let formula = bind("2*ramp", &["t"]);
    for (t, slope) in [(0.0, 0.0), (0.75, 8.0), (1.5, -8.0), (3.0, 0.0)] {
        let jet = formula.eval(&[Jet::<1>::variable(t, 0)]);
        assert_eq!((jet.d(0), jet.dd(0, 0)), (slope, 0.0), "{t}");
    }
    assert!(!formula.is_smooth());
}

#[test]
fn a_table_by_a_constant_is_one() {
    let formula = bind("fixed", &[]);
    assert_eq!(formula.constant(), Some(5.0));
    assert!(formula.uses().contains("fixed"));
}

#[rstest]
#[case("ramp", &["X"], "`ramp` is a table by `t`, which is not defined here")]
#[case("ramp(1)", &["t"], "`ramp` is a table, not a function")]
fn table_is_evaluated_at_its_variable(
    #[case] text: &str,
    #[case] variables: &[&str],
    #[case] message: &str,
) {
    let error = Formula::bind(&Expr::parse(text).unwrap(), &scope(), variables).unwrap_err();
    assert_eq!(error.message, message);
}

#[rstest]
#[case("ramp", "t", "`ramp` is already a table")]
#[case("n", "t", "`n` is already a constant")]
#[case("new", "2*t", "`2*t` is not a name")]
fn invalid_table_names_are_refused(#[case] name: &str, #[case] by: &str, #[case] message: &str) {
    let error = scope().table(name, by, &[(0.0, 1.0), (1.0, 2.0)]).unwrap_err();
    assert_eq!(error.message, message);
}
