//! Pulses much narrower than the body: correct solutions are accepted, and wrong ones are refused.

use super::load;
use crate::common::folder::{assert_contains, flat};
use crate::common::valid_suite;
use rstest::rstest;

const GAUSS: &str = "exp(-(s/w)^2)";
const SECH: &str = "1/cosh(s/w)^2";
const WINDOW: &str = "cos(pi*max(-w, min(w, s))/(2*w))^6";
const TRIANGLE: &str = "max(0, 1 - abs(s)/w)";

/// Creates a bar of length 2 with free ends and c = 1, in which a pulse of `shape` and width `w`
/// splits into two pulses.
fn split(shape: &str, w: f64, displacement: &str) -> String {
    format!(
        r#"
suite: pulse
title: t
source: s
about: a
parameters: {{w: {w}, A: 1e-6}}
functions: {{f(s): "{shape}"}}
scene:
  dimension: 1
  body: {{box: {{from: [0], to: [2]}}}}
  material: {{linear_elastic: {{young: 1, poisson: 0, density: 1}}}}
  initial_displacement: ["A*f(X - 1)"]
exact:
  equation: small_strain
  displacement: ["{displacement}"]
run: {{until: 0.5, dt: "0.2*h"}}
refine: {{cells: [64, 128, 256], ppc: 4}}
methods: [{{mpm: {{basis: linear, transfer: flip, scheme: usl}}}}]
expect: [{{order: [1.8, 2.1], because: linear functions}}]
"#
    )
}

/// Changes the bar of `text` to a plate.
fn in_the_plane(text: &str) -> String {
    text.replace("dimension: 1", "dimension: 2")
        .replace("from: [0], to: [2]", "from: [0, 0], to: [2, 0.5]")
        .replace("\"]", "\", 0]")
}

const RIGHT: &str = "A/2*(f(X - 1 - t) + f(X - 1 + t))";

#[rstest]
fn correct_pulse_is_accepted(
    #[values(GAUSS, SECH, WINDOW, TRIANGLE)] shape: &str,
    #[values(0.03, 0.01, 0.003)] w: f64,
    #[values(1, 2)] dimension: usize,
) {
    let bar = split(shape, w, RIGHT);
    let text = if dimension == 1 { bar } else { in_the_plane(&bar) };
    valid_suite(&text);
}

#[rstest]
#[case::speed("A/2*(f(X - 1 - 1.05*t) + f(X - 1 + 1.05*t))")]
#[case::speed_of_one_branch("A/2*(f(X - 1 - t) + f(X - 1 + 0.9*t))")]
#[case::sign("A/2*(f(X - 1 - t) + f(X - 1 + t)) - A*f(X - 1 - t)*min(1, 10*t)")]
#[case::phase("A/2*(f(X - 1 - t - w/10) + f(X - 1 + t))")]
#[case::one_percent_elsewhere("A/2*(f(X - 1 - t) + f(X - 1 + t)) + A/100*f(X - 0.4)")]
fn a_wrong_pulse_is_refused(
    #[case] displacement: &str,
    #[values(GAUSS, SECH, WINDOW, TRIANGLE)] shape: &str,
    #[values(0.1, 0.03, 0.01, 0.003)] w: f64,
) {
    let diagnostic = load(&split(shape, w, displacement)).expect_err("a wrong pulse");
    assert!(diagnostic.message().contains(" at X = ("), "{diagnostic}");
}

/// The wrong term is 1 % of the pulse. It acts near one point and towards the end of the run.
#[rstest]
fn a_late_term_in_a_small_part_is_refused(
    #[values(GAUSS, SECH, WINDOW)] shape: &str,
    #[values(0.1, 0.03)] w: f64,
) {
    let late = format!("{RIGHT} + A/100*f(X - 0.4)*f((t - 0.45)/2)");
    let diagnostic = load(&split(shape, w, &late)).expect_err("a wrong pulse");
    assert!(diagnostic.message().contains(" at X = ("), "{diagnostic}");
}

/// A pulse in a plate with a manufactured force, far away from all faces.
#[rstest]
fn a_manufactured_pulse_is_accepted(#[values(GAUSS, WINDOW)] shape: &str) {
    let motion = "A*f(X - 0.8 - 0.3*t)*f(Y - 0.9)";
    let text = split(shape, 0.03, motion)
        .replace("dimension: 1", "dimension: 2")
        .replace("from: [0], to: [2]", "from: [0, 0], to: [2, 2]")
        .replace("  initial_displacement: [\"A*f(X - 1)\"]\n", "")
        .replace("exact:\n  equation: small_strain\n", "manufactured:\n")
        .replace("linear_elastic", "neo_hookean")
        .replace(&format!("\"{motion}\""), &format!("\"{motion}\", \"A*f(X - 0.8)*f(Y - 1)\""));
    valid_suite(&text);
}

/// Creates a pulse that crosses from a bar with E = 1 into one with E = 4, which transmits 2/3 of
/// it.
fn two_bars(w: f64, transmitted: &str) -> String {
    let bodies = r#"
  bodies:
    - body: {box: {from: [0], to: [1]}}
      material: {linear_elastic: {young: 1, poisson: 0, density: 1}}
      initial_displacement: ["A*f(X - 0.5)"]
      initial_velocity: ["2*A*(X - 0.5)/w^2*f(X - 0.5)"]
    - body: {box: {from: [1], to: [2]}}
      material: {linear_elastic: {young: 4, poisson: 0, density: 1}}
"#;
    let one = "
  body: {box: {from: [0], to: [2]}}
  material: {linear_elastic: {young: 1, poisson: 0, density: 1}}
  initial_displacement: [\"A*f(X - 1)\"]
";
    let left = "f(X - 0.5 - t) - f(1.5 - X - t)/3";
    let right = format!("{transmitted}*f((X - 1)/2 + 0.5 - t)");
    let motion = format!("A*({left} + step(X - 1)*({right} - ({left})))");
    split(GAUSS, w, &motion).replace(one, bodies).replace("until: 0.5", "until: 0.7")
}

#[rstest]
fn a_pulse_in_two_materials_is_accepted(#[values(0.03, 0.01)] w: f64) {
    valid_suite(&two_bars(w, "2/3"));
}

#[rstest]
fn wrong_transmission_is_refused_at_the_interface(#[values(0.03, 0.01)] w: f64) {
    let diagnostic = load(&two_bars(w, "0.66")).expect_err("a jump at the joint");
    let diagnostic = diagnostic.one_line();
    assert_contains(
        &diagnostic,
        &["where two bodies meet along X, their ", "off by ", " allowed)"],
    );
}

/// A difference that six digits do not show is printed with more digits, next to the tolerance.
#[test]
fn a_small_violation_shows_the_difference_and_the_tolerance() {
    let text = split(GAUSS, 0.1, &RIGHT.replace("A/2", "(1 + 1e-7)*A/2"));
    let diagnostic = flat(&load(&text).expect_err("a violation").to_string());
    assert!(diagnostic.contains("m (off by 9.9"), "{diagnostic}");
    assert!(diagnostic.contains("state `tolerance: 2e-7` next to it"), "{diagnostic}");
    let value = |from: &str| {
        let rest = diagnostic.split(from).nth(1).expect("a number");
        rest.split([',', ' ']).next().expect("a number").to_owned()
    };
    assert_ne!(value("expected "), value("found "), "{diagnostic}");
}
