//! Bodies that come to rest, and the damping that they need.

use super::{Edits, refused};
use rstest::rstest;

/// A column that settles under its weight.
const SETTLED: &str =
    include_str!("../../../verification/equilibrium/column-hencky-small-load.yaml");

const MPM: &str = "methods:\n";
const FEM: &str = "methods:\n  - ▸fem: {element: linear, mass: lumped}\n";
const STATE: &str = "equilibrium:\n  equation: hencky";

#[rstest]
#[case::of_another_load(
    &[("\"-g*s(min(t/ramp, 1))\"", "\"-1.01*g*s(min(t/ramp, 1))\""), ("[\"E/(rho0*g)", "[▸\"E/(rho0*g)")],
    &["equation of motion in X", "t = 8.000000", "this is not a solution"]
)]
#[case::of_a_load_that_still_grows(
    &[("ramp: 2 ", "ramp: 10 "), ("[\"E/(rho0*g)", "[▸\"E/(rho0*g)")],
    &["equation of motion in X", "t = 8.000000"]
)]
#[case::of_another_law(
    &[("equation: hencky", "equation: ▸neo_hookean")],
    &["equation `neo_hookean` does not belong to the material `hencky`"]
)]
#[case::that_moves(&[(" - X\"]", " - X + ▸t\"]")], &["`t`"])]
#[case::beside_a_motion(
    &[(STATE, "▸exact:\n  equation: hencky\n  displacement: [\"X*t\"]\n\nequilibrium:\n  equation: hencky")],
    &["the suite states both `exact` and `equilibrium`: keep one"]
)]
#[case::at_two_times(
    &[("until: 8", "until: [8, ▸9]")],
    &["a suite with `equilibrium` has a single end time", "expected one end"]
)]
#[case::on_the_way(
    &[("norm: l1", "norm: ▸max_l1")],
    &["a `max_` norm needs a motion: with `equilibrium` the error exists only at the end", "expected a norm at the end"]
)]
#[case::of_its_motion(
    &[("of: stress", "of: ▸kinetic_energy")],
    &["the exact kinetic energy of the body is zero at all times"]
)]
#[case::of_finite_elements(
    &[("    - damping: \"pi*c/l0\" ", "   "), (MPM, FEM), ("of: stress, ", "")],
    &["the built-in FEM has no damping, so it does not reach an equilibrium"]
)]
#[case::at_a_driven_wall(
    &[("boundary: {left: fixed}", "boundary: {left: fixed, ▸right: {velocity: [0]}}"), ("  dimension: 1\n", "  dimension: 1\n  grid: {from: [0], to: [l0]}\n")],
    &["the face `right` has a given velocity, but `equilibrium` needs a body at rest"]
)]
#[case::with_a_driven_set(
    &[("  loads:\n", "  sets:\n    ▸tip: {box: {from: [49], to: [50]}}\n  loads:\n    - velocity: {on: tip, value: [0]}\n")],
    &["the set `tip` has a given velocity, but `equilibrium` needs a body at rest"]
)]
fn an_equilibrium(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(SETTLED, edits, words);
}

#[rstest]
#[case::twice(
    &[("    - damping: \"pi*c/l0\"", "    - damping: 1\n    - damping: ▸\"pi*c/l0\"")],
    &["damping appears twice"]
)]
#[case::that_drives(
    &[("\"pi*c/l0\"", "▸\"pi*c/l0*(1 - t/4)\"")],
    &["the rate of damping is -", "expected zero or a positive number (1/s)"]
)]
#[case::that_depends_on_place(&[("\"pi*c/l0\"", "\"pi*c/▸X\"")], &["`X`"])]
#[case::of_finite_elements(
    &[(STATE, "manufactured:"), (MPM, FEM), ("of: stress, ", "")],
    &["the built-in FEM does not support damping"]
)]
fn damping(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(SETTLED, edits, words);
}

const RATE: &str = "    - damping: \"pi*c/l0\"";

#[rstest]
#[case::of_the_whole_force(
    &[(RATE, "    - local_damping: ▸1")],
    &["the share of local damping is 1", "expected zero or a number below 1"]
)]
#[case::that_drives(&[(RATE, "    - local_damping: ▸\"-c\"")], &["expected zero or a number below 1"])]
#[case::that_changes(&[(RATE, "    - local_damping: \"1/(1 + ▸t)\"")], &["`t`"])]
#[case::twice(
    &[(RATE, "    - local_damping: 0.5\n    - local_damping: ▸0.5")],
    &["local damping appears twice"]
)]
#[case::of_a_manufactured_force(
    &[(RATE, "    - local_damping: 0.5"), (STATE, "▸manufactured:"), ("of: stress, ", "")],
    &["a part of it is manufactured", "use `damping`"]
)]
fn local_damping(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(SETTLED, edits, words);
}

#[test]
fn local_damping_of_finite_elements() {
    let bar = include_str!("../../../verification/damping/local-damping-bar.yaml");
    refused(bar, &[(MPM, FEM)], &["the built-in FEM does not support damping"]);
}

/// The exact solution of the oedometer is a motion, not a state of rest.
#[test]
fn bound_on_rest_needs_a_body_that_comes_to_rest() {
    let (order, bound) = ("    order: [1.5, 1.8]\n", "    ▸rest_below: 1e-6\n");
    let column = super::COLUMN;
    let line =
        column.lines().find(|line| line.trim_start().starts_with("order: [")).unwrap_or(order);
    let edit = format!("{line}\n{bound}");
    refused(
        column,
        &[(&format!("{line}\n"), &edit)],
        &["`rest_below` needs an `equilibrium`", "`equilibrium`"],
    );
}
