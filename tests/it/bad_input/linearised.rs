//! Linearised solutions: the residual that the law may have, and the conditions that still need the
//! default tolerance.

use super::refused;
use crate::common::built_in_source;
use rstest::rstest;

/// Creates a column of water. Its relative residual is 2e-6, and its tolerance is 5e-6.
fn column() -> String {
    built_in_source("acoustic-column").text().to_owned()
}

/// The lines that state the tolerance.
const STATED: &str = "  linearised:
    tolerance: 5e-6
    because: >
      strains are 1e-6 and less, and the relative change of the modulus is eight times the strain
";

#[rstest]
#[case::less_than_is_left(
    &[("5e-6", "1e-6"), ("[\"mode(X)*cos(k*c*t)\"]", "[▸\"mode(X)*cos(k*c*t)\"]")],
    &[
        "equation of motion in X, rho0 u_tt = Div P + rho0 b",
        "the residual is 2.00e-6 of the terms of the equations, above the stated `tolerance` of 1.00e-6",
    ]
)]
#[case::a_larger_strain(
    &[("eps: 1e-6", "eps: 1e-3"), ("[\"mode(X)*cos(k*c*t)\"]", "[▸\"mode(X)*cos(k*c*t)\"]")],
    &["the residual is 2.00e-3 of the terms of the equations, above the stated `tolerance` of 5.00e-6"]
)]
#[case::another_frequency(
    &[("cos(k*c*t)\"]", "cos(1.001*k*c*t)\"]"), ("[\"mode(X)*cos(", "[▸\"mode(X)*cos(")],
    &["equation of motion in X", "of the terms of the equations, above the stated `tolerance` of 5.00e-6"]
)]
#[case::nothing(
    &[(STATED, ""), ("[\"mode(X)*cos(k*c*t)\"]", "[▸\"mode(X)*cos(k*c*t)\"]")],
    &[
        "this is not a solution of the problem that the scene states",
        "if the solution is linearised (its residual is 2.00e-6 of the terms of the equations)",
        "add `linearised: {tolerance: ..., because: ...}`",
    ]
)]
#[case::anything(&[("5e-6", "▸0.1")], &["a tolerance of 0.1 would let a wrong solution pass"])]
#[case::no_number(&[("5e-6", "▸some")], &["unknown name `some`"])]
#[case::less_than_nothing(&[("5e-6", "▸-5e-6")], &["the tolerance is -5e-6, but must be above zero"])]
#[case::no_reason(
    &[(STATED, "  linearised: ▸{tolerance: 5e-6}\n")],
    &["missing key `because` in `linearised`"]
)]
#[case::an_empty_reason(
    &[(STATED, "  linearised: {tolerance: 5e-6, because: ▸\"\"}\n")],
    &["`because` is empty: state the reason for this linearised solution", "expected a text"]
)]
#[case::no_tolerance(
    &[(STATED, "  linearised: ▸{because: strains are small}\n")],
    &["missing key `tolerance` in `linearised`", "tolerance: 1e-6"]
)]
#[case::another_word(
    &[("5e-6\n    because:", "5e-6\n    ▸reason:")],
    &["unknown key `reason`"]
)]
fn a_solution_that_is_stated_to_leave(#[case] edits: &[(&str, &str)], #[case] words: &[&str]) {
    refused(&column(), edits, words);
}

/// Conditions that are linear in u need the default tolerance, because only the law is linearised.
#[rstest]
#[case::an_initial_displacement(
    &[("[\"mode(X)\"]", "[\"mode(X)*(1 + 1e-6)\"]"), ("[\"mode(X)*cos(", "[▸\"mode(X)*cos(")],
    &["initial condition u_X(X, 0) = u0(X)"]
)]
#[case::a_wall_that_moves(
    &[
        ("[\"mode(X)\"]", "[\"mode(X) + 1e-6*A\"]"),
        ("[\"mode(X)*cos(k*c*t)\"]", "[▸\"(mode(X) + 1e-6*A)*cos(k*c*t)\"]"),
    ],
    &["boundary condition: left is fixed, u_X = 0"]
)]
fn a_linearised_solution_with(#[case] edits: &[(&str, &str)], #[case] words: &[&str]) {
    refused(&column(), edits, words);
}
