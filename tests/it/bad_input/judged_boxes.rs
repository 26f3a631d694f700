//! Boxes that judged errors are restricted to: their place, and the waves that reach them.

use super::samples::{BAR, PLATE};
use super::{Edits, refused};
use crate::common::valid_suite;
use rstest::rstest;

const EXACT: &str =
    "exact:\n  equation: small_strain\n  displacement: [\"v0/omega*mode(X)*sin(omega*t)\"]\n";
const OBSERVE: (&str, &str) = ("observe: {at: [12.5]}\n", "");
const FREE: (&str, &str) = ("  boundary: {left: fixed}\n", "");

/// The bar `BAR` has waves of 10 m/s, and ends at 0.5 s.
#[rstest]
#[case::an_empty_box(
    &[("{norm: rms}", "{norm: rms, within: {from: [10], to: [▸10]}}")],
    &["the box ends at 10 and starts at 10"]
)]
#[case::a_box_outside_the_body(
    &[("{norm: rms}", "{norm: rms, within: {from: [10], to: [▸26]}}")],
    &["26 is outside the body", "expected a number from 0 to 25"]
)]
#[case::a_box_in_another_dimension(
    &[("{norm: rms}", "{norm: rms, within: {from: ▸[10, 1], to: [20]}}")],
    &["2", "1"]
)]
#[case::a_misspelt_key(
    &[("{norm: rms}", "{norm: rms, within: {▸form: [10], to: [20]}}")],
    &["form", "from"]
)]
#[case::a_sum(
    &[
        ("{norm: rms}", "{of: kinetic_energy, ▸within: {from: [10], to: [20]}}"),
        ("  - fem: {element: linear, mass: lumped}\n", ""),
    ],
    &["`within` is not supported for the kinetic energy, a sum over the whole body", "judge a field"]
)]
#[case::a_reference(
    &[
        ("{norm: rms}", "{norm: rms, ▸within: {from: [10], to: [20]}}"),
        (EXACT, "reference:\n  equation: small_strain\n  fem: {element: linear, mass: lumped, cells: 100, dt: 1e-3}\n"),
    ],
    &["`within` needs a motion that is stated under `exact`", "state the solution under `exact`"]
)]
#[case::a_manufactured_motion(
    &[
        ("{norm: rms}", "{norm: rms, ▸within: {from: [10], to: [20]}}"),
        ("exact:\n  equation: small_strain\n", "manufactured:\n"),
        ("linear_elastic", "neo_hookean"),
        ("  initial_velocity: [\"v0*mode(X)\"]\n", ""),
        ("  - fem: {element: linear, mass: lumped}\n", ""),
    ],
    &["`within` needs a motion that is stated under `exact`"]
)]
#[case::an_observed_place_outside_the_box(
    &[("{norm: rms}", "{norm: rms, within: {from: [15], to: [20]}}"), ("at: [12.5]", "at: ▸[12.5]")],
    &["the observed point is outside `judge.within`", "expected a point in 15 to 20 m"]
)]
#[case::a_wave_from_the_low_face(
    &[FREE, OBSERVE, ("{norm: rms}", "{norm: rms, within: {from: [▸4.9], to: [20]}}")],
    &[
        "the box is 4.9 m from the left face, whose condition the solution violates",
        "an elastic wave from this face travels 5 m in 0.5 s at 10 m/s",
        "expected a distance of at least 5 m",
        "shorten the run, or move the box away from the face",
    ]
)]
#[case::a_wave_from_the_high_face(
    &[
        ("{left: fixed}", "{left: fixed, right: fixed}"),
        ("[L + 5]", "[L]"),
        OBSERVE,
        ("{norm: rms}", "{norm: rms, within: {from: [1], to: [▸21]}}"),
    ],
    &["the box is 4 m from the right face", "travels 5 m"]
)]
#[case::a_violated_equation(
    &[
        OBSERVE,
        ("{norm: rms}", "{norm: rms, within: {from: [10], to: [15]}}"),
        ("[\"v0/omega*mode(X)*sin(omega*t)\"]", "[▸\"v0/omega/1.1*mode(X)*sin(1.1*omega*t)\"]"),
    ],
    &["equation of motion in X", "is violated"]
)]
#[case::another_initial_velocity(
    &[
        OBSERVE,
        ("{norm: rms}", "{norm: rms, within: {from: [10], to: [15]}}"),
        ("[\"v0*mode(X)\"]", "[\"2*v0*mode(X)\"]"),
        ("[\"v0/omega*", "[▸\"v0/omega*"),
    ],
    &["initial condition on the velocity in X"]
)]
fn a_bar_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

/// A box at a distance of exactly one travel of a wave, next to a face whose condition holds.
#[rstest]
#[case::at_the_distance_of_a_wave("[5]", "[25]", "  boundary: {left: fixed}\n", "")]
#[case::the_whole_body("[0]", "[25]", "", "")]
fn box_that_no_wave_reaches_is_valid(
    #[case] from: &str,
    #[case] to: &str,
    #[case] condition: &str,
    #[case] instead: &str,
) {
    let within = format!("{{norm: rms, within: {{from: {from}, to: {to}}}}}");
    let text = BAR.replace("{norm: rms}", &within).replace(condition, instead);
    valid_suite(&text);
}

#[test]
fn a_wave_on_the_second_axis_is_refused() {
    let edits: Edits<'_> = &[
        ("boundary: {left: fixed}", "boundary: {left: fixed, top: fixed}"),
        ("methods:", "judge: {within: {from: [0, 0], to: [1, ▸0.4]}}\nmethods:"),
    ];
    refused(PLATE, edits, &["from the top face, whose condition the solution violates"]);
}
