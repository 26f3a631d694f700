//! Stability studies: what is swept, what is sought, what is expected of it.

use super::{Edits, LEDGER, SWEPT, refused};
use rstest::rstest;

#[rstest]
#[case::of_nothing_declared(
    &[("sweep: {d: [", "sweep: {e: ▸[")], &["`e` is not a parameter", "did you mean"]
)]
#[case::of_two_parameters(
    &[("sweep: {d: [0.5", "sweep: ▸{C: [1], d: [0.5")], &["one parameter is swept at a time"]
)]
#[case::of_nothing(&[("sweep: {d: [0.5, 0.1, 0.02, 0.01, 0.002, 0.001]}", "sweep: ▸{}")], &["one parameter"])]
#[case::whose_limit_is_sought(
    &[("{parameter: C", "{parameter: ▸d")], &["`d` is swept, and its limit sought"]
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
    &["a particle at 9 is outside the grid", "expected a place from -2 to 8"]
)]
#[case::of_a_loaded_body(
    &[("\nparticles:", "  loads:\n    - gravity: [-1]\n\nparticles:"), ("frozen: true", "▸frozen: true")],
    &["a frozen body rests"]
)]
#[case::of_a_body_that_starts_otherwise(
    &[("\nparticles:", "  initial_velocity: [1]\n\nparticles:"), ("frozen: true", "▸frozen: true")],
    &["a frozen body rests"]
)]
#[case::in_load_steps(
    &[
        (
            "- mpm: {basis: linear, transfer: [flip, pic, apic], scheme: [usl, usf, musl]}",
            "- mpm: {basis: linear, scheme: ▸quasi_static}",
        ),
    ],
    &["stability is studied of steps in time"]
)]
#[case::without_a_limit(
    &[("critical: {parameter: C, from: 0.01, to: 4}\n", ""), ("    critical: {is", "    ▸critical: {is")],
    &["no limit is sought"]
)]
#[case::with_a_single_run(
    &[("    critical: {is: \"sqrt(2*d*(1 - d))\", within: \"0.6*d\"}", "    ▸verdict: stable")],
    &["no row has a single run"]
)]
#[case::with_half_a_closed_form(
    &[("critical: {is: \"sqrt(2*d*(1 - d))\", within: \"0.6*d\"}", "critical: ▸{within: 0.1}")],
    &["expected both"]
)]
#[case::with_nothing_said(
    &[("critical: {above: 1.7, below: 1.8}", "critical: ▸{}")], &["nothing is said of this figure"]
)]
#[case::with_a_figure_unknown(
    &[
        ("critical: {parameter: C, from: 0.01, to: 4}\n", ""),
        ("    critical: {is: \"sqrt(2*d*(1 - d))\", within: \"0.6*d\"}", "    figures: {▸energie: {above: 1}}"),
    ],
    &["unknown figure `energie`", "did you mean `energy`?"]
)]
#[case::of_an_fem(
    &[("- mpm: {basis: linear, transfer: [flip, pic, apic], scheme: [usl, usf, musl]}", "- ▸fem: {element: linear, mass: lumped}")],
    &["stability is studied of MPM only"]
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
    &[("frozen: true", "frozen: true, ▸every: 2")], &["steps of one length take no turns"]
)]
#[case::with_turns_too_long(
    &[("frozen: true", "frozen: true, alternate: 1, every: ▸1e4")], &["expected at most 1000"]
)]
#[case::with_an_unknown_word(&[("frozen: true", "▸frosen: true")], &["unknown key `frosen`", "did you mean `frozen`?"])]
fn a_stability_study(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(SWEPT, edits, words);
}

/// Two halves in place of the bar.
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
#[case::with_a_further_particle(("extra: [[", "▸extra: [["), "is of one body")]
#[case::with_a_null_space(
    ("methods:", "show: [▸null_share]\nmethods:"), "`null_share` is a figure of one body"
)]
#[case::in_contact_and_frozen(
    ("frozen: true", "▸frozen: true"), "have no linear step"
)]
fn a_stability_study_of_several_bodies(#[case] place: (&str, &str), #[case] words: &str) {
    let mut edits = vec![HALVES[1], HALVES[0], place];
    if words != "is of one body" {
        edits.push((", extra: [[\"4 + d\"]]", ""));
        edits.push(("  grid: ", "  contact: {friction: 0}\n  grid: "));
        edits.push(("d: 0.5       #", "d: 0.5   #"));
        edits.push(("dt: \"C*h/c\"", "dt: \"C*h/c*d/d\""));
    }
    refused(SWEPT, &edits, &[words]);
}

/// The falling bar as a plate.
const PLATE: [(&str, &str); 5] = [
    ("dimension: 1", "dimension: 2"),
    ("from: [0], to: [4]", "from: [0, 0], to: [4, 4]"),
    ("initial_velocity: [\"v\"]", "initial_velocity: [\"v\", 0]"),
    ("gravity: [\"g\"]", "gravity: [\"g\", 0]"),
    ("ppc: 2", "ppc: 4"),
];

#[rstest]
#[case::of_two_bodies(
    &[
        (
            "  body: {box: {from: [0], to: [4]}}\n",
            "  bodies:\n    - body: {box: {from: [0], to: [2]}}\n      material: {neo_hookean: {young: 100, poisson: 0, density: \"m/4\"}}\n    - body: {box: {from: [2], to: [4]}}\n      material: {neo_hookean: {young: 100, poisson: 0, density: \"m/4\"}}\n",
        ),
        ("  material: {neo_hookean: {young: 100, poisson: 0, density: \"m/4\"}}\n  boundary", "  boundary"),
        ("  initial_velocity: [\"v\"]\n", ""),
        ("show: [ledger_gap]", "show: [▸ledger_gap]"),
    ],
    &["`ledger_gap` is a figure of one body, and the scene has several"]
)]
#[case::whose_limit_is_sought(
    &[("show: [ledger_gap]", "critical: {parameter: alpha, from: 1, to: 4}\nshow: [▸ledger_gap]")],
    &["a limit is sought, and no row has a run with `ledger_gap`"]
)]
#[case::of_a_law_without_energy(
    &[
        ("neo_hookean: {young: 100, poisson: 0", "jaumann: {young: 100, poisson: 0"),
        ("show: [ledger_gap]", "show: [▸ledger_gap]"),
    ],
    &["the law `jaumann`"]
)]
#[case::that_is_only_expected(
    &[
        ("neo_hookean: {young: 100, poisson: 0", "jaumann: {young: 100, poisson: 0"),
        ("show: [ledger_gap]\n", ""),
        ("      ledger_gap: {", "      ▸ledger_gap: {"),
    ],
    &["the law `jaumann`"]
)]
#[case::of_a_transfer_over_cells(
    &[("transfer: [flip, apic]", "transfer: ▸[flip, tls]"), ("cpdi, ", "")],
    &["the transfer `tls` integrates over cells"]
)]
#[case::misspelt(
    &[("show: [ledger_gap]", "show: [▸ledger_gaps]")], &["did you mean `ledger_gap`?"]
)]
#[case::in_load_steps(
    &[("scheme: [usl, musl]", "scheme: ▸quasi_static"), ("transfer: [flip, apic]\n      ", "")],
    &["`quasi_static` has none"]
)]
#[case::in_single_precision(
    &[("scheme: [usl, musl]", "scheme: [usl, musl]\n      precision: ▸single")],
    &["stability is studied in double precision"]
)]
fn a_study_with_an_energy_ledger(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(LEDGER, edits, words);
}

#[rstest]
#[case::of_revolution(
    &[
        ("  body: {box", "  plane: axisymmetric\n  body: {box"),
        ("{left: periodic, right: periodic}", "{left: roller, bottom: roller, top: roller}"),
        ("show: [ledger_gap]", "show: [▸ledger_gap]"),
    ],
    "no entry for the force of the hoop stress"
)]
#[case::of_averaged_volume_ratios(
    &[("scheme: [usl, musl]", "scheme: [usl, musl]\n      volume: ▸averaged"), ("cpdi, ", "")],
    "does not derive from a stored energy"
)]
fn a_plate_with_an_energy_ledger(#[case] edits: Edits<'_>, #[case] words: &str) {
    refused(LEDGER, &[&PLATE, edits].concat(), &[words]);
}
