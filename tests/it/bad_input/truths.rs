//! Exact solutions of another problem: the violated condition, its position, and the difference.

use super::samples::{BAR, COLUMN, PLATE, PULLED};
use super::{Edits, refused};
use crate::common::{edited, valid_suite};
use rstest::rstest;

/// Asserts an error with a position, a time and both values, in addition to `words`.
fn violated(sound: &str, edits: Edits<'_>, words: &[&str]) {
    let figures = [" is violated at X = (", "), t = ", "expected ", ", found ", " (off by "];
    let label = ["this is not a solution of the problem that the scene states"];
    refused(sound, edits, &[words, &figures, &label].concat());
}

#[rstest]
#[case::a_wrong_coefficient_in_the_formula(
    &[("[\"v0/omega*mode(X)*sin(omega*t)\"]", "[▸\"v0/omega/1.1*mode(X)*sin(1.1*omega*t)\"]")],
    &["equation of motion in X, rho0 u_tt = Div P + rho0 b", "N/m3 (off by "]
)]
#[case::another_stiffness(
    &[("young: E", "young: \"1.1*E\""), ("[\"v0/omega*", "[▸\"v0/omega*")],
    &["equation of motion in X, rho0 u_tt = Div P + rho0 b"]
)]
#[case::a_face_that_should_be_fixed(
    &[("  boundary: {left: fixed}\n", ""), ("[\"v0/omega*", "[▸\"v0/omega*")],
    &["boundary condition: left is free, traction in X", "X = (0.000000)", "expected 0.000000e0", "Pa (off by "]
)]
#[case::a_face_that_should_be_free(
    &[("{left: fixed}", "{left: fixed, right: fixed}"), ("[L + 5]", "[L]"), ("[\"v0/omega*", "[▸\"v0/omega*")],
    &["boundary condition: right is fixed, u_X = 0", "X = (25.000000)", "expected 0.000000e0", "m (off by "]
)]
#[case::an_initial_displacement(
    &[("[\"v0/omega*mode(X)*sin(omega*t)\"]", "[▸\"v0/omega*mode(X)*cos(omega*t)\"]")],
    &["initial condition u_X(X, 0) = 0", "t = 0.000000", "expected 0.000000e0", "m (off by "]
)]
#[case::a_stated_displacement_that_is_not_in_the_formula(
    &[
        ("  initial_velocity:", "  initial_displacement: [\"1e-3*X\"]\n  initial_velocity:"),
        ("[\"v0/omega*", "[▸\"v0/omega*"),
    ],
    &["initial condition u_X(X, 0) = u0(X)", "t = 0.000000", "found 0.000000e0", "m (off by -"]
)]
#[case::another_initial_velocity(
    &[("[\"v0*mode(X)\"]", "[\"2*v0*mode(X)\"]"), ("[\"v0/omega*", "[▸\"v0/omega*")],
    &["initial condition on the velocity in X", "t = 0.000000", "m/s (off by "]
)]
#[case::a_division_by_zero_at_the_start(
    &[("[\"v0/omega*mode(X)*sin(omega*t)\"]", "[▸\"sin(X)/t*v0/omega*mode(X)\"]")],
    &["initial condition u_X(X, 0) = 0", "t = 0.000000", "found inf m (off by inf)"]
)]
fn a_bar_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    violated(BAR, edits, words);
}

#[rstest]
#[case::zero_everywhere(
    &[
        ("[\"v0/omega*mode(X)*sin(omega*t)\"]", "[▸0]"),
        ("  initial_velocity: [\"v0*mode(X)\"]\n", ""),
    ],
    &["the displacement is zero everywhere, for example at X = (", "found 0.000000e0 m"]
)]
#[case::no_number_in_the_end(
    &[("[\"v0/omega*mode(X)*sin(omega*t)\"]", "[▸\"v0/omega*mode(X)*sin(omega*t)*sqrt(0.4 - t)\"]")],
    &["the displacement is not finite at X = (", "t = 0.4", "found NaN m"]
)]
fn a_displacement_that_is(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[rstest]
#[case::gravity_upwards(
    &[("[\"-g\"]", "[\"g\"]"), ("    - \"fall(t) -", "    - ▸\"fall(t) -")],
    &["equation of motion in X", "expected 1.962000e4, found 0.000000e0 N/m3"]
)]
#[case::no_gravity(
    &[("    - gravity: [\"-g\"]\n", "    - gravity: [\"0*g\"]\n"), ("    - \"fall(t) -", "    - ▸\"fall(t) -")],
    &["equation of motion in X"]
)]
#[case::a_wave_of_another_speed(
    &[("\"sqrt(E/rho)\"", "\"1.05*sqrt(E/rho)\""), ("    - \"fall(t) -", "    - ▸\"fall(t) -")],
    &["equation of motion in X", "N/m3 (off by "]
)]
#[case::a_blow_that_nothing_explains(
    // The whole column changes its velocity at the same time: the equation holds before and after.
    &[("max(tau, 0)^2\"", "max(tau, 0)^2 - max(tau - 0.2, 0)\""), ("    - \"fall(t) -", "    - ▸\"fall(t) -")],
    &["momentum balance across wave fronts (the equation of motion in weak form"]
)]
fn a_column_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    violated(COLUMN, edits, words);
}

#[rstest]
#[case::a_front_of_another_speed(
    // The solution is linear on both sides of the front, so the equation holds at every point.
    &[("\"sqrt(E/rho)\"", "\"1.05*sqrt(E/rho)\""), ("- \"sum(k, 0, 2", "- ▸\"sum(k, 0, 2")],
    &["momentum balance across wave fronts (the equation of motion in weak form"]
)]
#[case::another_load(
    &[("\"p0*c/E", "\"1.1*p0*c/E"), ("- \"sum(k, 0, 2", "- ▸\"sum(k, 0, 2")],
    &["boundary condition: right is loaded, traction in X", "expected 7.000000e-1, found 7.700000e-1 Pa"]
)]
#[case::a_pull_for_a_push(
    &[("value: [p0]", "value: [\"-p0\"]"), ("- \"sum(k, 0, 2", "- ▸\"sum(k, 0, 2")],
    &["boundary condition: right is loaded, traction in X", "expected -7.000000e-1"]
)]
fn a_pulled_bar_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    violated(PULLED, edits, words);
}

#[test]
fn bar_with_a_hundred_oscillations_is_valid() {
    let long = BAR.replace("until: 0.5, dt: 1e-3", "until: 1000, dt: 1e-2");
    valid_suite(&long);
}

const FORCED: &str =
    include_str!("../../../verification/bars-at-large-strain/mms-fixed-bar-small.yaml");

#[rstest]
#[case::a_motion_that_moves_a_fixed_end(
    &[("[\"G*sin(pi*X)*sin(c*pi*t)\"]", "[▸\"G*cos(pi*X)*sin(c*pi*t)\"]")],
    &["boundary condition: left is fixed, u_X = 0"]
)]
#[case::a_motion_that_is_not_there_at_the_start(
    &[("[\"G*sin(pi*X)*sin(c*pi*t)\"]", "[▸\"G*sin(pi*X)/t\"]")],
    &["initial condition u_X(X, 0) = 0", "t = 0.000000"]
)]
fn a_manufactured_motion_must_fit_the_scene(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    violated(FORCED, edits, words);
}

#[rstest]
#[case::a_law_in_rate_form(
    &[("neo_hookean: {young", "linear_elastic: {young"), ("manufactured:  #", "▸manufactured:  #")],
    &["a force can be manufactured for `neo_hookean`, `hencky` and `corotated` only", "a law in rate form has no stress"]
)]
#[case::plastic_flow(
    &[("neo_hookean: {young: E, poisson: 0", "j2: {young: E, poisson: 0, yield: 1"), ("manufactured:  #", "▸manufactured:  #")],
    &["a force can be manufactured for `neo_hookean`, `hencky` and `corotated` only", "plastic flow depends on the whole history"]
)]
#[case::a_fluid(
    &[("neo_hookean: {young: E, poisson: 0", "newtonian: {bulk: E, viscosity: 1"), ("manufactured:  #", "▸manufactured:  #")],
    &["a force can be manufactured for `neo_hookean`, `hencky` and `corotated` only", "viscous stress depends on the rate"]
)]
#[case::an_initial_velocity(
    &[("\nmanufactured:", "  ▸initial_velocity: [0]\n\nmanufactured:")],
    &["the manufactured motion defines the initial velocity"]
)]
#[case::an_initial_displacement(
    &[("\nmanufactured:", "  ▸initial_displacement: [0]\n\nmanufactured:")],
    &["the manufactured motion defines the initial displacement"]
)]
#[case::a_body_force_besides(
    &[("\nmanufactured:", "  loads: [{body_force: [0]}]\n\n▸manufactured:")],
    &["the manufactured motion defines the body force: remove `body_force`", "to have a stated force checked"]
)]
#[case::two_truths(
    &[("\nmanufactured:", "\nexact: {equation: small_strain, displacement: [0]}\n▸manufactured:")],
    &["the suite states both `exact` and `manufactured`: keep one"]
)]
fn a_manufactured_motion_is_refused_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(FORCED, edits, words);
}

/// With shear, and with principal stretches that coincide at times, two methods of differentiating
/// the stress must agree, and the weak form must be balanced.
#[rstest]
#[case::bar(FORCED, &[])]
#[case::plate(
    PLATE,
    &[
        ("boundary: {left: fixed}", "boundary: {left: fixed, right: fixed, bottom: fixed, top: fixed}"),
        ("  initial_velocity: [\"sin(pi*X/2)\", 0]\n", ""),
        ("exact:\n  equation: small_strain", "manufactured:"),
        ("\"sin(pi*X/2)*sin(omega*t)/omega\", 0", "\"0.05*sin(pi*X)*sin(2*pi*Y)*sin(omega*t)\", \"0.1*sin(2*pi*X)*sin(2*pi*Y)*sin(omega*t)\""),
    ]
)]
fn force_can_be_manufactured_for_hencky(#[case] sound: &str, #[case] edits: Edits<'_>) {
    let text = sound.replace("neo_hookean", "hencky").replace("linear_elastic", "hencky");
    valid_suite(&edited(&text, edits));
}
/// Creates the suite `FORCED` with a stated force (for nu = 0) instead of a manufactured one.
fn with_its_force(force: &str) -> String {
    let load =
        format!("  loads: [{{body_force: [\"{force}\"]}}]\n\nexact:\n  equation: neo_hookean\n");
    let motion = "u(x, s): \"G*sin(pi*x)*sin(c*pi*s)\"\n  f(x, s): \"1 + pi*G*cos(pi*x)*sin(c*pi*s)\"\n\nscene:";
    let (head, tail) = FORCED.split_once("\nmanufactured:").expect("a motion");
    let tail = tail.split_once('\n').expect("a comment").1;
    format!("{head}{load}{tail}")
        .replacen("scene:", &format!("functions:\n  {motion}"), 1)
        .replace("[\"G*sin(pi*X)*sin(c*pi*t)\"]", "[\"u(X, t)\"]")
}

const FORCE: &str = "pi^2*u(X, t)/rho*E*(0.5*(1 + 1/f(X, t)^2) - 1)";

#[test]
fn correct_stated_force_is_accepted() {
    valid_suite(&with_its_force(FORCE));
}

#[rstest]
#[case::a_force_of_the_wrong_sign(
    &[("[\"pi^2", "[\"-pi^2"), ("[\"u(X, t)\"]", "[▸\"u(X, t)\"]")],
    &["equation of motion in X, rho0 u_tt = Div P + rho0 b, solved for b,", "m/s2 (off by "]
)]
#[case::a_start_that_is_not_that_of_the_motion(
    &[("  loads:", "  initial_displacement: [\"1e-3*G*X\"]\n  loads:"), ("[\"u(X, t)\"]", "[▸\"u(X, t)\"]")],
    &["initial condition u_X(X, 0) = u0(X)"]
)]
#[case::a_velocity_that_is_not_that_of_the_motion(
    &[("  loads:", "  initial_velocity: [0]\n  loads:"), ("[\"u(X, t)\"]", "[▸\"u(X, t)\"]")],
    &["initial condition on the velocity in X"]
)]
fn a_stated_force_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    violated(&with_its_force(FORCE), edits, words);
}

#[rstest]
#[case::the_equation_of_another_material(
    &[("equation: neo_hookean", "equation: ▸small_strain")],
    &["equation `small_strain` does not belong to the material `neo_hookean`"]
)]
#[case::two_forces(
    &[("loads: [", "loads: [{body_force: [0]}, "), ("{body_force: [\"pi", "{body_force: ▸[\"pi")],
    &["a body force appears twice"]
)]
fn a_stated_force_is_refused_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(&with_its_force(FORCE), edits, words);
}
