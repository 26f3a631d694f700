//! Invalid keys, names and types.

use super::samples::{BAR, FORCE, SWEPT};
use super::{Edits, refused};
use rstest::rstest;

#[rstest]
#[case::an_unknown_key(&[("until:", "▸untill:")], &["unknown key `untill`", "did you mean `until`?"])]
#[case::an_unknown_key_at_the_top(&[("judge:", "▸judges:")], &["unknown key `judges`", "did you mean `judge`?"])]
#[case::a_wrong_type(
    &[("cells: [6, 12]", "cells: ▸{a: 1}")],
    &["expected a finite number or a formula, found a map"]
)]
#[case::a_list_for_a_number(&[("dimension: 1", "dimension: ▸[1]")], &["expected a finite number or a formula, found a list"])]
#[case::text_for_a_list(
    &[("[\"v0/omega*mode(X)*sin(omega*t)\"]", "▸\"v0/omega*mode(X)*sin(omega*t)\"")],
    &["expected a list, found the string"]
)]
#[case::a_missing_key(
    &[("{young: E, poisson: 0, density: rho}", "▸{young: E, poisson: 0}")],
    &["missing key `density` in `linear_elastic`", "add `density: 1` in `linear_elastic`"]
)]
#[case::a_missing_section(
    &[("suite: bar", "▸suite: bar"), ("refine: {cells: [6, 12], ppc: 4}\n", "")],
    &["missing key `refine`", "add `refine: {cells: [8, 16, 32, 64], ppc: 4}`"]
)]
#[case::a_run_without_an_end(
    &[("run: {until: 0.5, ", "run: ▸{")],
    &["a run needs an end", "add `until`"]
)]
#[case::an_empty_list(&[("[6, 12]", "▸[]")], &["an empty list selects nothing", "at least one value"])]
#[case::an_empty_list_of_names(&[("[musl, usl]", "▸[]")], &["an empty list selects nothing"])]
#[case::a_key_twice(&[("ppc: 4", "ppc: 4, ▸ppc: 2")], &["the key `ppc` is given twice", "the second time"])]
#[case::a_parameter_twice(&[("rho: 1\n", "rho: 1\n  ▸E: 2\n")], &["the key `E` is given twice"])]
#[case::a_tab(&[("  dimension", "▸\tdimension")], &["tab used for indentation; YAML needs spaces"])]
#[case::not_a_number(
    &[("poisson: 0", "poisson: ▸.nan")],
    &["expected a finite number, found NaN"]
)]
#[case::infinity(&[("until: 0.5", "until: ▸.inf")], &["expected a finite number, found infinity"])]
#[case::an_unknown_basis(&[("basis: linear", "basis: ▸liner")], &["unknown name `liner`", "did you mean `linear`?"])]
#[case::an_unknown_scheme(&[("[musl, usl]", "[▸mulsl, usl]")], &["unknown name `mulsl`", "did you mean `musl`?"])]
#[case::an_unknown_method(&[("- fem:", "- ▸fme:")], &["unknown name `fme`", "did you mean `fem`?"])]
#[case::an_unknown_study(
    &[("suite: bar", "suite: bar\nstudy: ▸convergance")],
    &["unknown name `convergance`", "did you mean `convergence`?"]
)]
#[case::an_unknown_verdict(
    &[("verdict: too_few_levels", "verdict: ▸too_few_level")],
    &["`too_few_level` is not a verdict", "did you mean `too_few_levels`?"]
)]
#[case::a_verdict_like_no_other(
    &[("verdict: too_few_levels", "verdict: ▸wonderful")],
    &["`wonderful` is not a verdict", "known verdicts: converging, too_good, "]
)]
#[case::an_unknown_face(
    &[("left: fixed", "▸lefft: fixed")],
    &["a body of dimension 1 has no face `lefft`", "did you mean `left`?"]
)]
#[case::a_face_of_more_dimensions(
    &[("left: fixed", "▸top: fixed")],
    &["a body of dimension 1 has no face `top`", "known faces: left, right"]
)]
#[case::a_load_on_an_unknown_face(
    &[("  boundary: {left: fixed}", "  boundary: {left: fixed}\n  loads: [{traction: {on: ▸rigth, value: [1]}}]")],
    &["no face `rigth`", "did you mean `right`?"]
)]
#[case::spaces_in_the_name_of_a_suite(
    &[("suite: bar", "suite: ▸vibrating bar")],
    &["this is not a name for a suite", "expected lower-case letters, digits and hyphens"]
)]
#[case::a_path_for_the_name_of_a_suite(&[("suite: bar", "suite: ▸../bar")], &["this is not a name for a suite"])]
fn a_bar_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

/// Convergence and stability studies both have a key `run`, with different sub-keys.
#[test]
fn a_stability_study_without_a_run() {
    let run = SWEPT.lines().find(|line| line.starts_with("run:")).expect("a run");
    let words = ["missing key `run`", "add `run: {dt: 1e-3, steps: 1000}`"];
    refused(SWEPT, &[("suite:", "▸suite:"), (run, "")], &words);
}

#[rstest]
#[case::the_study_forgotten(&[("study: internal_force\n", ""), ("internal_force:", "▸internal_force:")], &["unknown key `internal_force`"])]
#[case::a_negative_volume(
    &[("volume: Omega", "volume: ▸\"-Omega\"")],
    &["a particle's volume is -0.125, but must be above zero"]
)]
#[case::no_reason(
    &[("because: >\n", "because: ▸\"\" #\n"), ("      the gradients of", "      # the gradients of"), ("      force jumps when", "      # force jumps when")],
    &["`because` is empty: state the reason for this expectation"]
)]
#[case::a_basis_twice(
    &[("- mpm: {basis: [linear, ugimp, cpgimp, cpdi, quadratic_bspline, cubic_bspline]}", "▸- mpm: {basis: [linear, linear]}")],
    &["the case `mpm-linear` appears twice"]
)]
#[case::no_method(
    &[("\n  - mpm: {basis: [linear, ugimp, cpgimp, cpdi, quadratic_bspline, cubic_bspline]}", " ▸[]")],
    &["the suite has no cases: `methods` is empty"]
)]
#[case::two_expectations_at_once(
    &[("  - case: mpm-linear\n    agrees_within: 1e-14", "  - ▸case: mpm-linear\n    agrees_within: 1e-14\n    steps_below: 1")],
    &["expected either `agrees_within` or `steps_below`"]
)]
#[case::endless_work(
    &[("positions: 16", "positions: ▸1e7")],
    &["10000000 positions with 4 particles per cell each", "expected at most 1000000"]
)]
#[case::a_parameter_with_the_name_of_a_variable(
    &[("parameters:\n", "parameters:\n  ▸n_left: 4\n")],
    &["`n_left` is a variable of formulas and cannot be declared"]
)]
fn an_internal_force_study_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(FORCE, edits, words);
}
