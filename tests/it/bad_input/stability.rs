//! Stability studies: invalid sweeps, limits and expectations.

use super::{Edits, SWEPT, refused};
use rstest::rstest;

#[rstest]
#[case::of_nothing_declared(
    &[("sweep: {d: [", "sweep: {e: ▸[")], &["`e` is not a parameter", "did you mean"]
)]
#[case::of_two_parameters(
    &[("sweep: {d: [0.5", "sweep: ▸{C: [1], d: [0.5")], &["`sweep` must vary exactly one parameter"]
)]
#[case::of_nothing(&[("sweep: {d: [0.5, 0.1, 0.02, 0.01, 0.002, 0.001]}", "sweep: ▸{}")], &["exactly one parameter"])]
#[case::whose_limit_is_sought(
    &[("{parameter: C", "{parameter: ▸d")], &["`d` cannot be the parameter of both"]
)]
#[case::with_an_empty_range(
    &[("from: 0.01, to: 4", "from: 4, to: ▸4")], &["the range ends at 4 and starts at 4"]
)]
#[case::with_a_step_that_vanishes(&[("dt: \"C*h/c\"", "dt: ▸\"C*(h - h)\"")], &["the time step is 0"])]
#[case::whose_step_vanishes_at_one_end(
    &[("dt: \"C*h/c\"", "dt: ▸\"(C - 0.01)*h/c\"")], &["the time step is 0"]
)]
#[case::beside_the_grid(
    &[("{d: [0.5, 0.1,", "{d: [0.5, 7,"), ("extra: [[\"4 + d\"]]", "extra: [▸[\"4 + d\"]]")],
    &["at 11", "outside the grid"]
)]
#[case::beside_a_grid_of_half_metres(
    &[("cells: 10", "cells: 20"), ("extra: [[\"4 + d\"]]", "extra: [▸[9]]")],
    &["a particle at 9 is outside the grid", "expected a position from -2 to 8"]
)]
#[case::of_a_loaded_body(
    &[("\nparticles:", "  loads:\n    - gravity: [-1]\n\nparticles:"), ("frozen: true", "▸frozen: true")],
    &["a frozen run must start at rest"]
)]
#[case::of_a_body_that_starts_otherwise(
    &[("\nparticles:", "  initial_velocity: [1]\n\nparticles:"), ("frozen: true", "▸frozen: true")],
    &["a frozen run must start at rest"]
)]
#[case::in_load_steps(
    &[
        (
            "- mpm: {basis: linear, transfer: [flip, pic, apic], scheme: [usl, usf, musl]}",
            "- mpm: {basis: linear, scheme: ▸quasi_static}",
        ),
    ],
    &["a stability study needs time steps"]
)]
#[case::without_a_limit(
    &[("critical: {parameter: C, from: 0.01, to: 4}\n", ""), ("    critical: {is", "    ▸critical: {is")],
    &["a limit is expected, but the suite has no `critical`"]
)]
#[case::with_a_single_run(
    &[("    critical: {is: \"sqrt(2*d*(1 - d))\", within: \"0.6*d\"}", "    ▸verdict: stable")],
    &["no row is a single run"]
)]
#[case::with_half_a_closed_form(
    &[("critical: {is: \"sqrt(2*d*(1 - d))\", within: \"0.6*d\"}", "critical: ▸{within: 0.1}")],
    &["expected both"]
)]
#[case::with_nothing_said(
    &[("critical: {above: 1.7, below: 1.8}", "critical: ▸{}")], &["this figure has no bound"]
)]
#[case::with_a_figure_unknown(
    &[
        ("critical: {parameter: C, from: 0.01, to: 4}\n", ""),
        ("    critical: {is: \"sqrt(2*d*(1 - d))\", within: \"0.6*d\"}", "    figures: {▸energie: {above: 1}}"),
    ],
    &["unknown figure `energie`", "did you mean `energy`?"]
)]
#[case::with_a_figure_misspelt(
    &[("methods:", "show: [▸energie]\nmethods:")], &["did you mean `energy`?"]
)]
#[case::of_an_fem(
    &[("- mpm: {basis: linear, transfer: [flip, pic, apic], scheme: [usl, usf, musl]}", "- ▸fem: {element: linear, mass: lumped}")],
    &["a stability study supports MPM only"]
)]
#[case::with_uneven_particles(
    &[("dimension: 1", "dimension: 2"), ("from: [0], to: [4]", "from: [0, 0], to: [4, 4]"),
      ("from: [-2], to: [8]", "from: [-2, -2], to: [8, 8]"), ("ppc: 2", "ppc: ▸2")],
    &["not equally spaced"]
)]
#[case::with_a_series_of_nothing(
    &[("transfer: [flip, pic, apic]", "transfer: [flip, ▸{fmpm: 0}]")],
    &["a series of 0 terms", "expected a whole number from 1 to 64"]
)]
#[case::with_a_series_unknown(
    &[("transfer: [flip, pic, apic]", "transfer: [flip, {▸fmpn: 2}]")], &["fmpn"]
)]
#[case::with_steps_that_take_no_turns(
    &[("frozen: true", "frozen: true, ▸every: 2")], &["`every` needs a second step length"]
)]
#[case::with_turns_too_long(
    &[("frozen: true", "frozen: true, alternate: 1, every: ▸1e4")], &["expected at most 1000"]
)]
#[case::with_requirements_on_solvers_before_cases(
    &[("case: \"mpm-linear-apic-*\"", "▸any_method: true")],
    &["only the last entry can have `any_method`"]
)]
#[case::with_requirements_on_solvers_for_cases(
    &[(
        "  - case: [\"mpm-*gimp-apic-*\",",
        "  - any_method: true\n    ▸case: [\"mpm-*gimp-apic-*\",",
    )],
    &["an entry with `any_method` applies to no case of the suite"]
)]
#[case::with_an_unknown_word(&[("frozen: true", "▸frosen: true")], &["unknown key `frosen`", "did you mean `frozen`?"])]
fn a_stability_study(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(SWEPT, edits, words);
}

/// Replaces the bar by two halves.
const HALVES: [(&str, &str); 2] = [
    (
        "  body: {box: {from: [0], to: [4]}}\n",
        "  bodies:\n    - body: {box: {from: [0], to: [2]}}\n      material: {linear_elastic: {young: E, poisson: 0, density: rho}}\n    - body: {box: {from: [2], to: [4]}}\n      material: {linear_elastic: {young: E, poisson: 0, density: rho}}\n",
    ),
    (
        "  material: {linear_elastic: {young: E, poisson: 0, density: rho}}\n\nparticles",
        "\nparticles",
    ),
];

#[rstest]
#[case::with_a_further_particle(("extra: [[", "▸extra: [["), "`extra` is supported for a single body only")]
#[case::with_a_null_space(
    ("methods:", "show: [▸null_share]\nmethods:"), "`null_share` is supported for a single body only"
)]
#[case::with_an_expected_null_space(
    ("critical: {above: 1.7, below: 1.8}", "figures: {null_share: ▸{below: 1}}"),
    "`null_share` is supported for a single body only"
)]
#[case::in_contact_and_frozen(
    ("frozen: true", "▸frozen: true"), "`frozen` is not supported with contact"
)]
fn a_stability_study_of_several_bodies(#[case] place: (&str, &str), #[case] words: &str) {
    let mut edits = vec![HALVES[1], HALVES[0], place];
    if words != "`extra` is supported for a single body only" {
        edits.push((", extra: [[\"4 + d\"]]", ""));
        edits.push(("  grid: ", "  contact: {friction: 0}\n  grid: "));
        edits.push(("d: 0.5       #", "d: 0.5   #"));
        edits.push(("dt: \"C*h/c\"", "dt: \"C*h/c*d/d\""));
    }
    refused(SWEPT, &edits, &[words]);
}
