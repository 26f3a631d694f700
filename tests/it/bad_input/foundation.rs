//! Loads that depend on the displacement: invalid names, and exact solutions for another load.

use super::refused;
use crate::common::{built_in_source, valid_suite};
use rstest::rstest;

fn bar() -> String {
    built_in_source("elastic-foundation").text().to_owned()
}

#[rstest]
#[case::another_stiffness(
    &[("\"3*E*k^2\"", "\"2*E*k^2\""), ("-kf*ux/rho", "-1.01*kf*ux/rho"), ("[\"v0/omega", "[▸\"v0/omega")],
    &["equation of motion in X, rho0 u_tt = Div P + rho0 b, solved for b,", "m/s2 (off by "]
)]
#[case::a_foundation_that_pushes(
    &[("-kf*ux/rho", "kf*ux/rho"), ("[\"v0/omega", "[▸\"v0/omega")],
    &["equation of motion in X", "solved for b,"]
)]
#[case::a_component_beyond_the_dimension(
    &[("[\"-kf*ux/rho\"]", "[\"-kf*▸uy/rho\"]")],
    &["unknown name `uy`"]
)]
#[case::both(&[("[\"-kf*ux/rho\"]", "[\"-kf*(ux + ▸uy)/rho\"]")], &["unknown name `uy`"])]
#[case::in_gravity(
    &[("body_force: [\"-kf*ux/rho\"]", "gravity: [\"-kf*▸ux/rho\"]")],
    &["unknown name `ux`"]
)]
#[case::in_a_traction(
    &[
        ("{left: fixed, right: fixed}", "{left: fixed}"),
        ("body_force: [\"-kf*ux/rho\"]", "traction: {on: right, value: [\"-kf*▸ux\"]}"),
    ],
    &["unknown name `ux`"]
)]
#[case::a_parameter_of_this_name(
    &[("  v0: 1e-4", "  ▸ux: 2\n  v0: 1e-4")],
    &["`ux` is a variable of formulas and cannot be declared", "rename it; the variables are X, t, ux"]
)]
fn a_bar_on_springs_with(#[case] edits: &[(&str, &str)], #[case] words: &[&str]) {
    refused(&bar(), edits, words);
}

/// If no load uses the name, the suite may declare it like any other name.
#[test]
fn a_suite_without_such_a_load_may_declare_the_name() {
    let text = bar().replace("-kf*ux/rho", "-kf*v0/omega*sin(k*X)*sin(omega*t)/rho");
    let text = text.replace("  v0: 1e-4", "  ux: 2\n  v0: 1e-4");
    let text = text.replace("until: \"pi/omega\"", "until: \"ux/2*pi/omega\"");
    valid_suite(&text);
}
